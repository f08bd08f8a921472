//! The planners of the experiment.

use pf_aco::{Aco, AcoParams, AcoStar, AcoStarParams};
use pf_classic::{AStar, DStarLite, Dijkstra};
use pf_core::{FromScratch, Replanner};
use pf_grid::GridProblem;
use pf_rfd::{Rfd, RfdExact, RfdField, RfdParams, RfdStar, RfdStarParams};

/// A planner that can be copied with all it has learnt, so that each change is made to the state
/// after Table 1.
pub trait Live: Replanner<GridProblem> {
    /// Another with the same memory.
    fn twin(&self) -> Box<dyn Live>;
}

impl<T: Replanner<GridProblem> + Clone + 'static> Live for T {
    fn twin(&self) -> Box<dyn Live> {
        Box::new(self.clone())
    }
}

/// One planner with one set of parameters.
#[derive(Clone, Copy)]
pub struct Contender {
    /// The name on the command line.
    pub planner: &'static str,
    /// Which parameters.
    pub variant: &'static str,
    /// The paper's name for it, if it is in the paper.
    pub published_as: Option<&'static str>,
    /// Whether the variant is one whose numbers the paper could have printed.
    pub is_published: bool,
    /// Whether chance is in it.
    pub is_stochastic: bool,
    /// Makes one that uses so many threads.
    pub make: fn(usize) -> Box<dyn Live>,
}

impl std::fmt::Debug for Contender {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Contender({} {})", self.planner, self.variant)
    }
}

fn star(mut params: RfdStarParams, threads: usize) -> Box<dyn Live> {
    params.threads = threads;
    Box::new(RfdStar::new(params).unwrap_or_default())
}

const fn exact(
    planner: &'static str,
    published_as: Option<&'static str>,
    make: fn(usize) -> Box<dyn Live>,
) -> Contender {
    Contender {
        planner,
        variant: "default",
        published_as,
        is_published: published_as.is_some(),
        is_stochastic: false,
        make,
    }
}

const fn swarm(
    planner: &'static str,
    variant: &'static str,
    published_as: &'static str,
    is_published: bool,
    make: fn(usize) -> Box<dyn Live>,
) -> Contender {
    Contender {
        planner,
        variant,
        published_as: Some(published_as),
        is_published,
        is_stochastic: true,
        make,
    }
}

/// All of them; A* is the yardstick.
pub const CONTENDERS: &[Contender] = &[
    exact("dijkstra", Some("Dijkstra"), |_| {
        Box::new(FromScratch(Dijkstra::default()))
    }),
    exact("astar", Some("A*"), |_| {
        Box::new(FromScratch(AStar::default()))
    }),
    exact("d-star-lite", None, |_| Box::new(DStarLite::default())),
    exact("rfd-exact", None, |_| Box::new(RfdExact::default())),
    exact("rfd-field", None, |_| Box::new(RfdField::default())),
    swarm("rfd", "paper", "RFD", true, |threads| {
        let params = RfdParams {
            threads,
            ..RfdParams::default()
        };
        Box::new(Rfd::new(params).unwrap_or_default())
    }),
    swarm("rfd-star", "paper", "RFD*", true, |threads| {
        star(RfdStarParams::paper(), threads)
    }),
    swarm("rfd-star", "authors_code", "RFD*", true, |threads| {
        star(RfdStarParams::authors_code(), threads)
    }),
    swarm("rfd-star", "seeded", "RFD*", false, |threads| {
        star(RfdStarParams::seeded(), threads)
    }),
    swarm("aco", "paper", "ACO", true, |threads| {
        let params = AcoParams {
            threads,
            ..AcoParams::default()
        };
        Box::new(Aco::new(params).unwrap_or_default())
    }),
    swarm("aco-star", "paper", "ACO*", true, |threads| {
        let params = AcoStarParams {
            threads,
            ..AcoStarParams::default()
        };
        Box::new(AcoStar::new(params).unwrap_or_default())
    }),
    swarm("aco-star", "tabu", "ACO*", false, |threads| {
        let params = AcoStarParams {
            threads,
            tabu: true,
            ..AcoStarParams::default()
        };
        Box::new(AcoStar::new(params).unwrap_or_default())
    }),
];
