//! What a kind of problem brings to the kit: cases, stories, and the truth about both.

use pf_core::{PlanRng, Problem};

/// What is known about a problem.
#[derive(Clone, Debug, PartialEq)]
pub enum Truth<C> {
    /// It has a solution, and the best costs this.
    Optimum(C),
    /// It has a solution, the best costs no less than the first, and what costs more than the
    /// second is not the best: where the best is a limit, or known only so well.
    Between(C, C),
    /// It has a solution.
    Solvable,
    /// It has none.
    Infeasible,
    /// Nothing is known: only laws that need no truth are checked.
    Unknown,
}

/// A problem with the truth about it.
#[derive(Clone, Debug)]
pub struct Case<P: Problem> {
    /// Shown when a law breaks.
    pub name: String,
    /// The question.
    pub problem: P,
    /// What is known about its answer.
    pub truth: Truth<P::Cost>,
}

/// A problem, and what happens to it batch by batch.
#[derive(Clone, Debug)]
pub struct Story<P: Problem> {
    /// Shown when a law breaks.
    pub name: String,
    /// The problem before the first batch, and after each.
    worlds: Vec<P>,
    batches: Vec<Vec<P::Change>>,
}

impl<P: Problem> Story<P> {
    /// The story in which `next` says, up to `most` times, what happens to the problem as it is.
    /// A batch that makes no sense ends it.
    pub fn new(
        name: impl Into<String>,
        problem: P,
        most: usize,
        mut next: impl FnMut(&P) -> Vec<P::Change>,
    ) -> Self {
        let mut story = Self {
            name: name.into(),
            worlds: vec![problem.clone()],
            batches: vec![],
        };
        let mut now = problem;
        for _ in 0..most {
            let batch = next(&now);
            if now.apply(&batch).is_err() {
                break;
            }
            story.worlds.push(now.clone());
            story.batches.push(batch);
        }
        story
    }

    /// The problem before the first batch, and after each.
    #[must_use]
    pub fn worlds(&self) -> &[P] {
        &self.worlds
    }

    /// What happens, in this order.
    #[must_use]
    pub fn batches(&self) -> &[Vec<P::Change>] {
        &self.batches
    }
}

/// What a story is to bring out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plot {
    /// All that may happen, but start and goal stay where one may be.
    Mixed,
    /// A few cells or obstacles at a time, on a problem large enough for repair to pay.
    Small,
    /// Start and goal are blocked, freed, and moved onto what is blocked.
    Ends,
    /// Hundreds of batches.
    Long,
}

/// A kind of problem, as far as the kit must know it.
///
/// [`grid::Grids`](crate::grid::Grids) and [`world::Worlds`](crate::world::Worlds) are two. With another for problems of your own,
/// [`examine`](crate::examine) holds planners for these to the same laws.
pub trait Suite {
    /// The problem.
    type Problem: Problem + 'static;

    /// Cases with a point, none larger than `options` allow.
    fn cases(&self, options: &Options) -> Vec<Case<Self::Problem>>;

    /// A problem made up.
    fn random(&self, rng: &mut PlanRng, options: &Options) -> Self::Problem;

    /// Another problem that a planner could mistake for `problem`: the same size, other content.
    fn lookalike(&self, rng: &mut PlanRng, problem: &Self::Problem) -> Self::Problem;

    /// A story made up.
    fn story(&self, rng: &mut PlanRng, plot: Plot, options: &Options) -> Story<Self::Problem>;

    /// What is known about `problem`, found without any planner.
    fn truth(&self, problem: &Self::Problem) -> Truth<<Self::Problem as Problem>::Cost>;

    /// A picture of `problem` in characters, if it is small enough for one.
    fn draw(&self, problem: &Self::Problem) -> Option<String>;
}

/// How thorough to be.
#[derive(Clone, Debug)]
pub struct Options {
    /// How many problems to make up beside the drawn ones; the number of stories follows from it.
    pub cases: u32,
    /// From which seed.
    pub seed: u64,
    /// Leave out what is larger: cells of a grid, shapes of a world. For planners that take seconds where others take
    /// milliseconds.
    pub largest: u64,
    /// At most so many iterations a run, for planners that would not end of their own accord.
    pub iterations: Option<u64>,
}

impl Default for Options {
    /// 100 cases from seed 1, of any size, without a limit.
    fn default() -> Self {
        Self {
            cases: 100,
            seed: 1,
            largest: u64::MAX,
            iterations: None,
        }
    }
}
