//! `bench grid`: shortest paths on the maps and queries of the Moving AI benchmark.
//!
//! Of each map's queries some are asked, spread evenly over their lengths. All contenders under the
//! same moves answer a query one after the other, each several times in a row, and the least time of each
//! counts: a planner has its own memory at hand, not what another left of it, as it does for whoever
//! asks it alone. Who begins changes with every query. What is timed is the search and, of ours, the
//! judge that marks the path. Costs are compared exactly
//! with those of our A*, and those under the file's moves with the optimum it states. Where all prove
//! that there is no path although the file states an optimum, the query counts as one without a path.
//!
//! Allocations and bytes are counted by [another program](allocations) from the same sources, so that
//! nobody is timed under an allocator that counts.

mod allocations;
mod contender;
mod peers;
mod plot;
mod upscale;

use crate::{
    Counter,
    cases::{Case, Maps},
    contenders::FRESH,
    protocol::{REPETITIONS, Row, Tally, geometric_mean, json, say, timed},
};
use anyhow::{Result, bail};
use contender::{Answer, Asked, Group, RULES, is_peer};
use pf_grid::{Grid, GridProblem};
use pf_io::{Scen, ScenRow};
use std::{path::PathBuf, sync::Arc, time::Duration};

#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  cargo xtask bench grid
  cargo xtask bench grid --filter Aftershock --planner astar --limit 500
  cargo xtask bench grid --maps ~/maps/dao --json > dao.json
  cargo xtask bench grid --plot grid.svg")]
pub(crate) struct Args {
    #[command(flatten)]
    maps: Maps,
    #[command(flatten)]
    asked: Asked,
    /// At most this many queries a map, spread evenly over their lengths
    #[arg(long, value_name = "N", default_value_t = 40, alias = "queries")]
    limit: usize,
    /// Also search maps of 512 x 512 cells with every cell cut into this many a side; 1 for none
    #[arg(long, value_name = "TIMES", default_value_t = 4)]
    upscale: u32,
    /// Draw mean times by map and contender: an .svg or .png file
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// One JSON object a line
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args, counter: Option<Counter>) -> Result<()> {
    args.asked.check()?;
    if let Some(counter) = counter {
        return allocations::count(args, counter);
    }
    if let Some(file) = &args.plot {
        plot::check(file)?;
    }
    let taken = allocations::ask();
    if !args.json {
        header()?;
    }
    let mut rows: Vec<Row> = Vec::new();
    for map in args.maps.files()? {
        let case = Case::load(&map)?;
        for moves in RULES {
            let group = args.asked.group(&case.grid, moves)?;
            if group.contenders.is_empty() {
                continue;
            }
            let mut round = Round::of(group);
            for row in case.spread(args.limit) {
                round.ask(&case.grid, Some(&case.scen), row)?;
            }
            let mut told = round.rows(&case.under(moves));
            for row in &mut told {
                taken.fill_in(row);
            }
            tell(args, &told)?;
            rows.extend(told);
        }
        if let Some(told) = upscale::bench(args, &case)? {
            tell(args, &told)?;
            rows.extend(told);
        }
    }
    if !args.json {
        summary(&rows)?;
    }
    if let Some(file) = &args.plot {
        plot::draw(file, &rows)?;
    }
    // What a peer gets wrong is its affair, and shown.
    let ours = rows.iter().filter(|row| !is_peer(&row.planner));
    let mismatches: u64 = ours.map(|row| row.mismatches).sum();
    if mismatches > 0 {
        bail!("{mismatches} answers do not agree");
    }
    Ok(())
}

/// Whom queries are asked, and what they took so far.
struct Round {
    group: Group,
    tallies: Vec<Tally>,
    asked: usize,
}

/// A query, and of each contender the least time and the answer.
struct Posed {
    problem: GridProblem,
    least: Vec<Duration>,
    answers: Vec<Option<Answer>>,
}

impl Round {
    fn of(group: Group) -> Self {
        let tallies = vec![Tally::default(); group.contenders.len()];
        Self {
            group,
            tallies,
            asked: 0,
        }
    }

    /// Asks all of them a query, each so many times in a row; `scen` states optima.
    fn ask(&mut self, grid: &Arc<Grid>, scen: Option<&Scen>, row: &ScenRow) -> Result<()> {
        let mut posed = self.pose(grid, row)?;
        for k in self.order() {
            for _ in 0..REPETITIONS {
                self.time(k, &mut posed);
            }
        }
        self.note(scen, row, &posed);
        Ok(())
    }

    /// Asks all of them each query once, one contender after the other.
    fn go_round(&mut self, posed: &mut [Posed]) {
        for k in self.order() {
            for posed in &mut *posed {
                self.time(k, posed);
            }
        }
    }

    /// Another one is the first each time.
    fn order(&mut self) -> impl Iterator<Item = usize> + use<> {
        let (first, count) = (self.asked, self.tallies.len());
        self.asked += 1;
        (0..count).map(move |k| (first + k) % count)
    }

    fn time(&mut self, k: usize, posed: &mut Posed) {
        let one = &mut self.group.contenders[k];
        one.prepare();
        let (time, ()) = timed(|| one.search(&posed.problem));
        posed.least[k] = posed.least[k].min(time);
        let answer = one.answer(&posed.problem);
        posed.answers[k].get_or_insert(answer);
    }

    fn pose(&self, grid: &Arc<Grid>, row: &ScenRow) -> Result<Posed> {
        let problem = GridProblem::new(Arc::clone(grid), row.start, row.goal)?;
        let count = self.tallies.len();
        Ok(Posed {
            problem: problem.with_moves(self.group.moves),
            least: vec![Duration::MAX; count],
            answers: vec![None; count],
        })
    }

    /// Takes down what they answered.
    fn note(&mut self, scen: Option<&Scen>, row: &ScenRow, posed: &Posed) {
        let Self { group, tallies, .. } = self;
        let stated = scen.filter(|_| group.moves == RULES[0]);
        let Some(first) = posed.answers.first().copied().flatten() else {
            return;
        };
        for (k, answer) in posed.answers.iter().copied().flatten().enumerate() {
            let as_stated = match (stated, answer.cost) {
                (Some(scen), Some(cost)) => scen.agrees(row, cost.value()),
                _ => true,
            };
            let tally = &mut tallies[k];
            tally.add(posed.least[k]);
            tally.expanded += answer.expanded;
            tally.unsolved += u64::from(answer.cost.is_none());
            tally.mismatches += u64::from(!as_stated || !group.agrees(k, answer, first));
        }
    }

    /// A row each.
    fn rows(&self, case: &str) -> Vec<Row> {
        let moves = self.group.moves.name();
        let rows = self.tallies.iter().zip(&self.group.contenders);
        rows.map(|(tally, one)| Row {
            kind: moves,
            moves: Some(moves),
            ..tally.row(case, one.name())
        })
        .collect()
    }
}

fn header() -> Result<()> {
    say(format_args!(
        "{:<24} {:>7}  {:<22} {:>10} {:>10} {:>10} {:>9} {:>8} {:>8} {:>7} {:>7} {:>8} {:>10}",
        "map",
        "queries",
        "planner",
        "mean us",
        "median us",
        "p95 us",
        "expanded",
        "ns/exp",
        "allocs",
        "B/cell",
        "x",
        "no path",
        "mismatches"
    ))
}

/// Rows of one map, ratios to the first.
fn tell(args: &Args, rows: &[Row]) -> Result<()> {
    let maybe = |value: Option<f64>| value.map_or("-".to_owned(), |v| format!("{v:.1}"));
    for row in rows {
        if args.json {
            json(row)?;
            continue;
        }
        let beside = row.original_ns_per_expansion.map_or(String::new(), |of| {
            let times = row.ns_per_expansion.unwrap_or(f64::NAN) / of;
            format!("  {of:.1} ns/exp at the original size: {times:.2} times that")
        });
        say(format_args!(
            "{:<24} {:>7}  {:<22} {:>10.1} {:>10.1} {:>10.1} {:>9} {:>8} {:>8} {:>7} {:>7.2} {:>8} {:>10}{beside}",
            row.case,
            row.queries,
            row.planner,
            row.mean_us,
            row.median_us,
            row.p95_us,
            row.expanded.map_or("-".to_owned(), |n| format!("{n:.0}")),
            maybe(row.ns_per_expansion),
            maybe(row.allocations),
            maybe(row.bytes_per_cell),
            row.mean_us / rows[0].mean_us,
            row.unsolved,
            row.mismatches
        ))?;
    }
    Ok(())
}

/// Each contender's time beside that of our A* under the same moves, over all maps.
fn summary(rows: &[Row]) -> Result<()> {
    let mut seen: Vec<(&str, &str)> = Vec::new();
    for row in rows {
        let key = (row.planner.as_str(), row.kind);
        if row.planner == FRESH || seen.contains(&key) {
            continue;
        }
        seen.push(key);
        let of = |planner: &str, case: &str| {
            let mut same = rows
                .iter()
                .filter(|row| row.kind == key.1 && row.case == case);
            same.find(|row| row.planner == planner)
                .map(|row| row.mean_us)
        };
        let ratios: Vec<f64> = rows
            .iter()
            .filter(|row| row.kind == key.1 && row.planner == FRESH && row.queries > 0)
            .filter_map(|row| Some(of(key.0, &row.case)? / row.mean_us))
            .collect();
        let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
        say(format_args!(
            "{}, {}: {:.2} times astar's time (geometric mean of {} maps; least {least:.2})",
            key.0,
            key.1,
            geometric_mean(&ratios),
            ratios.len()
        ))?;
    }
    let upscaled: Vec<f64> = rows
        .iter()
        .filter(|row| row.planner == FRESH)
        .filter_map(|row| Some(row.ns_per_expansion? / row.original_ns_per_expansion?))
        .collect();
    if !upscaled.is_empty() {
        let most = upscaled.iter().copied().fold(0.0, f64::max);
        say(format_args!(
            "astar, upscaled: {:.2} times the original's ns per expansion (geometric mean of {} \
             maps; most {most:.2})",
            geometric_mean(&upscaled),
            upscaled.len()
        ))?;
    }
    Ok(())
}
