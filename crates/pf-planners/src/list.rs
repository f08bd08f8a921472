//! The list itself.

use crate::{AnyEntry, Entry, UnknownPlanner, entry::entry, external};
use pf_abc::{Abc, AbcParams};
use pf_aco::{Aco, AcoParams, AcoStar, AcoStarParams};
use pf_classic::{
    AStar, AStarParams, Auto, AutoParams, DStarLite, DStarLiteParams, Dijkstra, DijkstraParams,
    Jps, JpsParams, Prepared, PreparedParams, VisibilityGraph, VisibilityGraphParams,
};
use pf_geom::{TeamProblem, WorldProblem};
use pf_grid::GridProblem;
use pf_lbfgs::{Lbfgs, LbfgsParams};
use pf_moabc::{
    Moabc, MoabcParams, Moead, MoeadParams, Nsga2, Nsga2Params, Prioritised, PrioritisedParams,
    RandomSearch, RandomSearchParams,
};
use pf_pso::{Pso, PsoParams};
use pf_rfd::{
    Rfd, RfdExact, RfdExactParams, RfdField, RfdFieldParams, RfdParams, RfdStar, RfdStarParams,
};

static GRID: &[Entry<GridProblem>] = &[
    entry!(plans "dijkstra", Dijkstra, DijkstraParams, "Dijkstra 1959"),
    entry!(plans "astar", AStar, AStarParams, "Hart, Nilsson, Raphael 1968"),
    entry!(replans "d-star-lite", DStarLite, DStarLiteParams, "Koenig, Likhachev 2002"),
    entry!(replans "jps", Jps, JpsParams, "Harabor, Grastien 2011, 2014"),
    entry!(replans "prepared", Prepared, PreparedParams, "Harabor, Grastien 2014 (JPS+)"),
    entry!(replans "auto", Auto, AutoParams, "A* or JPS, by a survey of the map"),
    entry!(replans "rfd", Rfd, RfdParams, "Rabanal, Rodriguez, Rubio 2007; Redlarski, Dabkowski, Palkowski"),
    entry!(replans "rfd-star", RfdStar, RfdStarParams, "Redlarski, Dabkowski, Palkowski"),
    entry!(replans "rfd-exact", RfdExact, RfdExactParams, "after Korf 1990; Koenig, Likhachev 2006"),
    entry!(replans "rfd-field", RfdField, RfdFieldParams, "after Redlarski, Dabkowski, Palkowski; Ramalingam, Reps 1996"),
    entry!(replans "aco", Aco, AcoParams, "Dorigo, Maniezzo, Colorni 1996"),
    entry!(replans "aco-star", AcoStar, AcoStarParams, "Redlarski, Dabkowski, Palkowski"),
];

static WORLD: &[Entry<WorldProblem>] = &[
    entry!(replans "visibility-graph", VisibilityGraph, VisibilityGraphParams, "Lozano-Perez, Wesley 1979; Liu, Arimoto 1992"),
    entry!(replans "pso", Pso, PsoParams, "Waypoint-Based Path Planning for Autonomous Robots with PSO"),
    entry!(replans "lbfgs", Lbfgs, LbfgsParams, "Real-Time Pathfinding in Dynamic Open World Conditions via L-BFGS Optimization"),
    entry!(replans "abc", Abc, AbcParams, "Dynamic pathfinding for uncrewed vehicles by a constrained artificial bee colony; after Korf 1990"),
];

static TEAM: &[Entry<TeamProblem>] = &[
    entry!(replans "moabc", Moabc, MoabcParams, "A Novel Multi-objective Artificial Bee Colony Algorithm for Multi-robot Path Planning"),
    entry!(replans "nsga2", Nsga2, Nsga2Params, "Deb, Pratap, Agarwal, Meyarivan 2002"),
    entry!(replans "moead", Moead, MoeadParams, "Zhang, Li 2007; Li, Zhang 2009"),
    entry!(replans "random-search", RandomSearch, RandomSearchParams, "what any of them must beat"),
    entry!(plans "prioritised", Prioritised, PrioritisedParams, "Erdmann, Lozano-Perez 1987; Phillips, Likhachev 2011"),
];

/// The planners on grids, each as a replanner; those that only plan start over
/// ([`FromScratch`](pf_core::FromScratch)).
pub fn grid_planners() -> impl Iterator<Item = &'static Entry<GridProblem>> {
    GRID.iter()
}

/// The planners in worlds of shapes, each as a replanner.
pub fn world_planners() -> impl Iterator<Item = &'static Entry<WorldProblem>> {
    WORLD.iter()
}

/// The planners for teams of robots, each as a replanner.
pub fn team_planners() -> impl Iterator<Item = &'static Entry<TeamProblem>> {
    TEAM.iter()
}

/// All planners, whatever their problem.
pub fn all() -> impl Iterator<Item = &'static dyn AnyEntry> {
    let grid = grid_planners().map(|entry| entry as &dyn AnyEntry);
    let world = world_planners().map(|entry| entry as &dyn AnyEntry);
    let team = team_planners().map(|entry| entry as &dyn AnyEntry);
    grid.chain(world).chain(team)
}

/// The planner called `key`; `external:COMMAND` is the one in another program
/// ([`External`](pf_external::External)), which is started to say who it is.
///
/// # Errors
/// [`UnknownPlanner`] if there is none, or its program does not answer.
pub fn find(key: &str) -> Result<&'static dyn AnyEntry, UnknownPlanner> {
    if let Some(command) = key.strip_prefix(external::PREFIX) {
        return external::find(command).map_err(|fault| UnknownPlanner::silent(key, &fault));
    }
    let found = all().find(|entry| entry.key() == key);
    found.ok_or_else(|| UnknownPlanner::new(key, all().map(AnyEntry::key)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Changes, GridScene, Order, Refusal};
    use pf_grid::{Cell, Grid};

    #[test]
    fn names_are_unique_and_every_default_works() {
        for entry in all() {
            assert_eq!(all().filter(|other| other.key() == entry.key()).count(), 1);
            let runner = entry.runner(&[]).unwrap();
            assert_eq!(runner.name(), entry.name());
            assert_eq!(runner.claims(), entry.claims());
            assert!(
                !entry.claims().incremental || entry.replans(),
                "{}",
                entry.key()
            );
        }
    }

    #[test]
    fn near_misses_are_guessed_and_far_ones_are_not() {
        let near = |asked| find(asked).unwrap_err().near();
        assert_eq!(near("dstar-lite"), Some("d-star-lite"));
        assert_eq!(near("A-Star"), Some("astar"));
        assert_eq!(near("quux"), None);
    }

    #[test]
    fn parameters_are_set_by_name() {
        let set = |key: &str, value: &str| {
            let entry = find("astar").unwrap();
            entry
                .runner(&[(key.to_owned(), value.to_owned())])
                .map(|_| ())
        };
        assert!(set("nearest", "true").is_ok());
        assert!(set("nearest", "7").is_err() && set("far", "true").is_err());
    }

    #[test]
    fn replanning_needs_a_plan() {
        let mut runner = find("d-star-lite").unwrap().runner(&[]).unwrap();
        let scene = GridScene::new(Grid::open(1, 1).unwrap(), Cell::new(0, 0), Cell::new(0, 0));
        let nothing = Changes::Grid(Vec::new());
        let refusal = runner
            .replan(&scene.unwrap().into(), &nothing, Order::seeded(0))
            .unwrap_err();
        assert_eq!(refusal, Refusal::NothingPlanned);
    }
}
