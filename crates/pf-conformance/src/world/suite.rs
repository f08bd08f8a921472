//! The suite of worlds.

use super::{
    batches::{calm_batch, ends_batch, random_batch, small_batch},
    cases,
    generate::{Kind, Recipe, random_world},
    oracle::{SLACK, oracle},
};
use crate::{Case, Options, Plot, Story, Suite, Truth};
use pf_core::{PlanRng, Problem};
use pf_geom::{Shape, WorldChange, WorldProblem};
use rand::RngExt;
use std::{fmt::Write, ops::RangeInclusive};

/// Worlds with more shapes are not listed.
const LISTABLE: usize = 40;

/// [`Suite`] of [`WorldProblem`]s: [`cases`] whose optima a formula tells, and made-up ones with
/// the [`oracle`]'s truth.
///
/// A path with arcs has no best polyline: one that is at most [`SLACK`] longer than the shortest
/// path with arcs is as good as a planner that claims to be optimal need find.
#[derive(Clone, Copy, Debug, Default)]
pub struct Worlds;

impl Suite for Worlds {
    type Problem = WorldProblem;

    fn cases(&self, options: &Options) -> Vec<Case<WorldProblem>> {
        let mut cases = cases();
        cases.retain(|case| size(&case.problem) as u64 <= options.largest);
        cases
    }

    fn random(&self, rng: &mut PlanRng, options: &Options) -> WorldProblem {
        let most = if rng.random_bool(0.1) { 40 } else { 16 };
        let recipe = Recipe::any(rng, sizes(5..=most, options));
        random_world(rng, &recipe)
    }

    fn lookalike(&self, rng: &mut PlanRng, problem: &WorldProblem) -> WorldProblem {
        let mut other = problem.clone();
        for _ in 0..3 {
            let batch = random_batch(rng, &other);
            // Batches are made for the problem, so this does not fail.
            let _ = other.apply(&batch);
        }
        other
    }

    fn story(&self, rng: &mut PlanRng, plot: Plot, options: &Options) -> Story<WorldProblem> {
        let (wished, batches) = match plot {
            Plot::Mixed => (5..=12, 12),
            Plot::Small => (12..=24, 5),
            Plot::Ends => (5..=8, 16),
            Plot::Long => (5..=6, 200),
        };
        let mut recipe = Recipe::any(rng, sizes(wished, options));
        if matches!(plot, Plot::Small | Plot::Long) {
            // A problem without a solution is no repair's business, and one that fills up no long
            // story.
            recipe.kind = Kind::Scattered;
            recipe.density = rng.random_range(0.1..0.2);
        }
        let problem = random_world(rng, &recipe);
        let usual = size(&problem);
        let name = format!("{:?} changes, {:?}", plot, recipe.kind);
        Story::new(name, problem, batches, |now| match plot {
            Plot::Mixed => calm_batch(rng, now),
            Plot::Small => small_batch(rng, now),
            Plot::Ends => ends_batch(rng, now),
            Plot::Long => {
                let mut batch = calm_batch(rng, now);
                if size(now) > 2 * usual {
                    batch.retain(|change| !matches!(change, WorldChange::Added(_)));
                }
                batch
            }
        })
    }

    fn truth(&self, problem: &WorldProblem) -> Truth<f64> {
        oracle(problem).map_or(Truth::Infeasible, |best| best_is(best.length))
    }

    fn draw(&self, problem: &WorldProblem) -> Option<String> {
        (size(problem) <= LISTABLE).then(|| listing(problem))
    }
}

/// That the shortest path with arcs has this length.
pub(super) fn best_is(length: f64) -> Truth<f64> {
    // A path may enter every obstacle by as much as counts as touching.
    let rounding = 1e-7 * length.max(1.0);
    Truth::Between(length - rounding, length + SLACK + rounding)
}

fn size(problem: &WorldProblem) -> usize {
    problem.world().shapes().count()
}

/// `wished` numbers of shapes, as far as the options allow.
fn sizes(wished: RangeInclusive<usize>, options: &Options) -> RangeInclusive<usize> {
    let most = usize::try_from(options.largest).unwrap_or(usize::MAX);
    *wished.start().min(&most)..=*wished.end().min(&most)
}

/// The problem in words, every number as it is.
#[must_use]
pub fn listing(problem: &WorldProblem) -> String {
    let mut text = String::new();
    let (min, max) = (
        problem.world().bounds().min(),
        problem.world().bounds().max(),
    );
    let (start, goal) = (problem.start(), problem.goal());
    // Writing to a string does not fail.
    let _ = writeln!(text, "bounds {:?} to {:?}", (min.x, min.y), (max.x, max.y));
    let _ = writeln!(text, "radius {:?}", problem.radius());
    let _ = writeln!(
        text,
        "start {:?}, goal {:?}",
        (start.x, start.y),
        (goal.x, goal.y)
    );
    for (id, shape) in problem.world().shapes() {
        let _ = match shape {
            Shape::Circle(c) => {
                let at = (c.centre().x, c.centre().y);
                writeln!(text, "{id}: circle at {at:?}, radius {:?}", c.radius())
            }
            Shape::Rectangle(r) => {
                let (min, max) = ((r.min().x, r.min().y), (r.max().x, r.max().y));
                writeln!(text, "{id}: rectangle {min:?} to {max:?}")
            }
            Shape::Polygon(p) => {
                let corners: Vec<_> = p.corners().iter().map(|c| (c.x, c.y)).collect();
                writeln!(text, "{id}: polygon {corners:?}")
            }
        };
    }
    text
}
