//! Who answers a query, and under which moves.

use super::peers::{Jumping, Pathfinding, Petgraph};
use crate::{
    cases::unknown,
    contenders::{FRESH, entry},
};
use anyhow::{Result, bail};
use pf_core::{Context, Outcome, Replanner, Report};
use pf_grid::{Grid, GridCost, GridProblem, Moves};
use pf_planners::{Entry, grid_planners};

/// Somebody who finds shortest paths.
pub(super) trait Contender {
    fn name(&self) -> &'static str;

    /// Makes ready for a search: what is neither timed nor counted.
    fn prepare(&mut self) {}

    /// Searches: what is timed and counted.
    fn search(&mut self, problem: &GridProblem);

    /// What the last search found.
    fn answer(&mut self, problem: &GridProblem) -> Answer;
}

/// What a search found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Answer {
    pub(super) cost: Option<GridCost>,
    /// Whether it says that there is nothing better.
    pub(super) proof: bool,
    /// Unknown, and 0, of peers.
    pub(super) expanded: u64,
}

/// Contenders that answer the same problems; ours comes first.
pub(super) struct Group {
    pub(super) moves: Moves,
    pub(super) contenders: Vec<Box<dyn Contender>>,
}

/// The rules under which somebody is asked: Moving AI's, and the only one `grid_pathfinding` knows.
pub(super) const RULES: [Moves; 2] = [Moves::OnlyWhenNoObstacles, Moves::Always];

const JUMPING: &str = "grid_pathfinding::jps";

/// Who of ours answers beside it.
const JUMPS: &str = "jps";

const PEERS: [&str; 4] = [
    "pathfinding::astar",
    "pathfinding::dijkstra",
    "petgraph::astar",
    JUMPING,
];

/// All there are.
fn names() -> impl Iterator<Item = &'static str> {
    grid_planners().map(Entry::key).chain(PEERS)
}

/// Whom `--planner` asks for.
#[derive(clap::Args)]
pub(super) struct Asked {
    /// Only contenders of this name, or whose name contains it, beside the A* that others are compared
    /// with; may be given again. Ours by their names in `pf planners`; peers:
    /// `pathfinding::astar`, `pathfinding::dijkstra`, `petgraph::astar`, `grid_pathfinding::jps`
    #[arg(long, value_name = "NAME")]
    planner: Vec<String>,
}

impl Asked {
    /// Refuses what nobody is called.
    pub(super) fn check(&self) -> Result<()> {
        let names: Vec<&str> = names().collect();
        for asked in &self.planner {
            if !names.iter().any(|name| name.contains(asked.as_str())) {
                let names = names.iter().copied();
                bail!("{}", unknown("--planner", asked, "contender", names));
            }
        }
        Ok(())
    }

    fn wants(&self, name: &str) -> bool {
        let asked = |asked: &String| {
            let whole = names().any(|name| name == asked);
            name == asked || !whole && name.contains(asked.as_str())
        };
        self.planner.is_empty() || self.planner.iter().any(asked)
    }

    /// Those asked for on a map; nobody under moves under which only the A* would answer.
    pub(super) fn group(&self, grid: &Grid, moves: Moves) -> Result<Group> {
        let mut contenders = Vec::new();
        let asked = |name| self.wants(name) && grid.is_uniform();
        if moves == Moves::default() {
            contenders = self.ours()?;
            for guided in [true, false] {
                let peer = Pathfinding { guided, path: None };
                if asked(peer.name()) {
                    contenders.push(Box::new(peer));
                }
            }
            if asked("petgraph::astar") {
                contenders.push(Box::new(Petgraph::of(grid, moves)));
            }
        } else if moves == Moves::Always && asked(JUMPING) {
            contenders = vec![ours(entry(FRESH)?)?];
            if asked(JUMPS) {
                contenders.push(ours(entry(JUMPS)?)?);
            }
            contenders.push(Box::new(Jumping::of(grid)));
        }
        Ok(Group { moves, contenders })
    }

    /// The same of ours alone, for maps on which graphs of peers would not fit.
    pub(super) fn group_of_ours(&self) -> Result<Group> {
        Ok(Group {
            moves: Moves::default(),
            contenders: self.ours()?,
        })
    }

    /// The A*, then the others that prove their paths to be shortest: what proves nothing answers
    /// another question.
    fn ours(&self) -> Result<Vec<Box<dyn Contender>>> {
        let mut contenders = vec![ours(entry(FRESH)?)?];
        for entry in grid_planners().filter(|entry| entry.key() != FRESH) {
            if self.wants(entry.key()) && entry.make(&[])?.claims().optimal {
                contenders.push(ours(entry)?);
            }
        }
        Ok(contenders)
    }
}

impl Group {
    /// Whether an answer agrees with the first contender's: the same cost; of one that weighs steps
    /// otherwise, a path that is no shorter than that and no heavier in its own weights.
    pub(super) fn agrees(&self, k: usize, answer: Answer, first: Answer) -> bool {
        if !answer.proof || !first.proof {
            return false;
        }
        let (Some(cost), Some(best)) = (answer.cost, first.cost) else {
            return answer.cost == first.cost;
        };
        if self.contenders[k].name() != JUMPING {
            return cost == best;
        }
        let [straight, diagonal] = Jumping::WEIGHTS;
        let weight = |cost: GridCost| cost.straight * straight + cost.diagonal * diagonal;
        cost >= best && weight(cost) <= weight(best)
    }
}

/// Whether a contender is a peer.
pub(super) fn is_peer(name: &str) -> bool {
    PEERS.contains(&name)
}

struct Ours {
    name: &'static str,
    planner: Box<dyn Replanner<GridProblem>>,
    context: Option<Context<'static, GridProblem>>,
    report: Option<Report<GridProblem>>,
}

fn ours(entry: &Entry<GridProblem>) -> Result<Box<dyn Contender>> {
    Ok(Box::new(Ours {
        name: entry.key(),
        planner: entry.make(&[])?,
        context: None,
        report: None,
    }))
}

impl Contender for Ours {
    fn name(&self) -> &'static str {
        self.name
    }

    fn prepare(&mut self) {
        self.context = Some(Context::seeded(0));
    }

    fn search(&mut self, problem: &GridProblem) {
        let report = |cx: &mut Context<'_, _>| self.planner.plan(problem, cx).ok();
        self.report = self.context.as_mut().and_then(report);
    }

    fn answer(&mut self, _: &GridProblem) -> Answer {
        let report = self.report.take();
        let proved = |report: &Report<_>| match &report.outcome {
            Outcome::Optimal(best) => (Some(best.cost), true),
            Outcome::Infeasible => (None, true),
            _ => (None, false),
        };
        let (cost, proof) = report.as_ref().map_or((None, false), proved);
        Answer {
            cost,
            proof,
            expanded: report.map_or(0, |report| report.stats.expanded),
        }
    }
}
