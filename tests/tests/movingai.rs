//! A sample of the Moving AI benchmark's queries. All of them: `cargo pf plan MAP --scen FILE`.
//!
//! Reads `../shared/data/movingai` beside the workspace, and says so where that is missing.

use pf_classic::{AStar, Auto, DStarLite, Dijkstra, Jps, Prepared};
use pf_core::{Context, Planner};
use pf_grid::GridProblem;
use pf_io::{LoadOptions, load_grid, read_scen};
use std::{path::PathBuf, sync::Arc};

const MAPS: [&str; 10] = [
    "64room_000",
    "AR0300SR",
    "Aftershock",
    "Berlin_1_256",
    "arena2",
    "brc503d",
    "den520d",
    "maze512-8-0",
    "random512-35-0",
    "w_woundedcoast",
];

#[test]
fn stated_optima_are_met() {
    let folder = PathBuf::from(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../shared/data/movingai"
    ));
    if !folder.exists() {
        println!("skipped: ../shared is missing");
        return;
    }
    for map in MAPS {
        let file = folder.join(format!("{map}.map"));
        let grid = load_grid(&file, &LoadOptions::default()).unwrap().grid;
        let scen = read_scen(&folder.join(format!("{map}.map.scen"))).unwrap();
        scen.check_size(&grid).unwrap();
        let planners: [&mut dyn Planner<GridProblem>; 6] = [
            &mut AStar::default(),
            &mut Dijkstra::default(),
            &mut DStarLite::default(),
            &mut Jps::default(),
            &mut Prepared::default(),
            &mut Auto::default(),
        ];
        for planner in planners {
            for row in scen.rows.iter().step_by(scen.rows.len() / 40) {
                let problem = GridProblem::new(Arc::clone(&grid), row.start, row.goal).unwrap();
                let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
                let length = report
                    .outcome
                    .solved()
                    .map_or(f64::NAN, |best| best.cost.value());
                assert!(
                    scen.agrees(row, length),
                    "{}, {map}, line {}: {length}, stated {}",
                    planner.name(),
                    row.line,
                    row.optimum
                );
            }
        }
    }
}
