//! `bench grid`: shortest paths on the maps and queries of the Moving AI benchmark.

use crate::{
    peers,
    protocol::{REPETITIONS, Row, Tally, geometric_mean, json, say, timed},
};
use anyhow::{Context as _, Result, bail};
use pf_classic::{AStar, Dijkstra};
use pf_core::{Context, Planner};
use pf_grid::{GridCost, GridProblem};
use pf_io::{LoadOptions, Scen, load_grid, read_scen};
use std::{
    path::{Path, PathBuf},
    sync::Arc,
    time::Duration,
};

#[derive(clap::Args)]
pub(crate) struct Args {
    /// A folder of .map files, each with its .map.scen beside it
    #[arg(long, default_value = "../shared/data/movingai")]
    maps: PathBuf,
    /// Only maps whose name contains this
    #[arg(long, default_value = "")]
    map: String,
    /// At most this many queries a map, spread evenly over the file
    #[arg(long, default_value_t = 100)]
    queries: usize,
    /// One JSON object a line
    #[arg(long)]
    json: bool,
}

/// Name, and how it answers: the cost of its path and how many cells it expanded.
type Contender = (&'static str, Box<dyn FnMut(&GridProblem) -> Answer>);

#[derive(Default)]
struct Answer {
    cost: Option<GridCost>,
    expanded: u64,
    bytes: Option<usize>,
}

/// Ours first: ratios are to the first.
fn contenders() -> Vec<Contender> {
    let (mut astar, mut dijkstra) = (AStar::default(), Dijkstra::default());
    vec![
        (
            "astar",
            Box::new(move |p| Answer {
                bytes: Some(astar.bytes()),
                ..ours(&mut astar, p)
            }),
        ),
        (
            "dijkstra",
            Box::new(move |p| Answer {
                bytes: Some(dijkstra.bytes()),
                ..ours(&mut dijkstra, p)
            }),
        ),
        (
            "pathfinding::astar",
            Box::new(|p| peer(p, peers::pathfinding_astar)),
        ),
        (
            "pathfinding::dijkstra",
            Box::new(|p| peer(p, peers::pathfinding_dijkstra)),
        ),
    ]
}

fn ours(planner: &mut impl Planner<GridProblem>, problem: &GridProblem) -> Answer {
    planner.plan(problem, &mut Context::seeded(0)).map_or_else(
        |_| Answer::default(),
        |report| Answer {
            cost: report.outcome.solved().map(|best| best.cost),
            expanded: report.stats.expanded,
            bytes: None,
        },
    )
}

fn peer(problem: &GridProblem, search: fn(&GridProblem) -> Option<Vec<pf_grid::Cell>>) -> Answer {
    Answer {
        cost: peers::cost(problem, search(problem)),
        ..Answer::default()
    }
}

pub(crate) fn run(args: &Args) -> Result<()> {
    let maps = maps(&args.maps, &args.map)?;
    let mut ratios: Vec<Vec<f64>> = vec![];
    let mut names = vec![];
    if !args.json {
        say(format_args!(
            "{:<26} {:>7}  {:<24} {:>10} {:>10} {:>10} {:>9} {:>7} {:>6} {:>10}",
            "map",
            "queries",
            "planner",
            "mean us",
            "median us",
            "p95 us",
            "ns/exp",
            "B/cell",
            "x",
            "mismatches"
        ))?;
    }
    let mut mismatches = 0;
    for map in maps {
        let rows = bench_map(&map, args.queries)?;
        let first = rows[0].mean_us;
        ratios.push(rows.iter().map(|row| row.mean_us / first).collect());
        names = rows.iter().map(|row| row.planner.clone()).collect();
        for row in &rows {
            mismatches += row.mismatches;
            if args.json {
                json(row)?;
            } else {
                tell(row, row.mean_us / first)?;
            }
        }
    }
    if !args.json {
        for (k, name) in names.iter().enumerate().skip(1) {
            let of_maps: Vec<f64> = ratios.iter().map(|ratios| ratios[k]).collect();
            let least = of_maps.iter().copied().fold(f64::INFINITY, f64::min);
            say(format_args!(
                "{name}: {:.2} times astar's time (geometric mean of {} maps; least {least:.2})",
                geometric_mean(&of_maps),
                of_maps.len()
            ))?;
        }
    }
    if mismatches > 0 {
        bail!("{mismatches} answers do not agree");
    }
    Ok(())
}

fn tell(row: &Row, ratio: f64) -> Result<()> {
    let maybe = |value: Option<f64>| value.map_or(String::new(), |v| format!("{v:.1}"));
    say(format_args!(
        "{:<26} {:>7}  {:<24} {:>10.1} {:>10.1} {:>10.1} {:>9} {:>7} {:>6.2} {:>10}",
        row.case,
        row.queries,
        row.planner,
        row.mean_us,
        row.median_us,
        row.p95_us,
        maybe(row.ns_per_expansion),
        maybe(row.bytes_per_cell),
        ratio,
        row.mismatches
    ))
}

/// The maps of a folder in the order of their names.
fn maps(folder: &Path, containing: &str) -> Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir(folder)
        .with_context(|| format!("{}: expected a folder of .map files", folder.display()))?;
    let mut maps = vec![];
    for entry in entries {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if name.ends_with(".map") && name.contains(containing) {
            maps.push(path.clone());
        }
    }
    maps.sort();
    if maps.is_empty() {
        bail!("{}: no .map file of that name in it", folder.display());
    }
    Ok(maps)
}

fn bench_map(map: &Path, queries: usize) -> Result<Vec<Row>> {
    let grid = load_grid(map, &LoadOptions::default())?.grid;
    let scen = read_scen(&PathBuf::from(format!("{}.scen", map.display())))?;
    scen.check_size(&grid)?;
    let case = map.file_stem().unwrap_or_default().to_string_lossy();
    let mut contenders = contenders();
    let mut tallies = vec![Tally::default(); contenders.len()];
    let mut bytes = vec![None; contenders.len()];
    let every = scen.rows.len().div_ceil(queries.max(1)).max(1);
    for row in scen.rows.iter().step_by(every) {
        let problem = GridProblem::new(Arc::clone(&grid), row.start, row.goal)?;
        let mut least = vec![Duration::MAX; contenders.len()];
        let mut agreed = None;
        for repetition in 0..REPETITIONS {
            for (k, (_, answer)) in contenders.iter_mut().enumerate() {
                let (time, answer) = timed(|| answer(&problem));
                least[k] = least[k].min(time);
                if repetition == 0 {
                    tallies[k].expanded += answer.expanded;
                    bytes[k] = answer.bytes.or(bytes[k]);
                    let agreed = *agreed.get_or_insert(answer.cost);
                    let right = agrees(&scen, row, answer.cost) && answer.cost == agreed;
                    tallies[k].mismatches += u64::from(!right);
                }
            }
        }
        for (tally, least) in tallies.iter_mut().zip(least) {
            tally.add(least);
        }
    }
    let cells = f64::from(grid.width()) * f64::from(grid.height());
    let rows = tallies.iter().zip(contenders).zip(bytes);
    Ok(rows
        .map(|((tally, (name, _)), bytes)| Row {
            #[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
            bytes_per_cell: bytes.map(|bytes| bytes as f64 / cells),
            ..tally.row(&case, name)
        })
        .collect())
}

fn agrees(scen: &Scen, row: &pf_io::ScenRow, cost: Option<GridCost>) -> bool {
    cost.is_some_and(|cost| scen.agrees(row, cost.value()))
}
