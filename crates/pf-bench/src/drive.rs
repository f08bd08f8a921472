//! `bench drive`: a robot with a sensor crosses a map it does not know, and plans anew at every
//! discovery.
//!
//! One planner drives; at each discovery all contenders plan on the same knowledge, one after the
//! other, a different one first each time, and each exactly as dear a path as the others or the same
//! proof that there is none. So equal costs mean equal costs at every discovery: travelled costs of
//! two drives may differ, as paths of equal cost lead past different discoveries. The first planner
//! asked for drives; the fresh A* drives nowhere.
//!
//! A contender's total is its first plan, all its answers and all its upkeep. The change of the known
//! map, the same for all, is left out.

use crate::{
    cases::{Case, Maps},
    contenders::{FRESH, Ours, Repairers, proved},
    protocol::{Tally, json, say, timed},
};
use anyhow::{Result, bail};
use pf_core::{Claims, Context, Planner, Replanner, Report, Revision, Unsupported};
use pf_grid::{Arrival, Drive, GridProblem, Moves};
use serde::Serialize;

#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  cargo xtask bench drive
  cargo xtask bench drive --filter maze512 --sensor 20 --limit 1
  cargo xtask bench drive --planner d-star-lite --set patience=0.3 --json")]
pub(crate) struct Args {
    #[command(flatten)]
    maps: Maps,
    #[command(flatten)]
    planners: Repairers,
    /// The sensor's radius in cells
    #[arg(long, value_name = "R", default_value_t = 10.0)]
    sensor: f64,
    /// Under which moves
    #[arg(long, value_name = "RULE", default_value_t)]
    moves: Moves,
    /// At most this many drives a map, of the longer half of its queries, spread evenly over their
    /// lengths: of four, a fresh A*'s mean answer differs from that of sixty by half
    #[arg(long, value_name = "N", default_value_t = 12)]
    limit: usize,
    /// Cut every cell into N x N
    #[arg(long, value_name = "N", default_value_t = 1)]
    upscale: u32,
    /// One JSON object a line
    #[arg(long)]
    json: bool,
}

/// Maps of 512 x 512 cells, asked for where no other is: caves, halls, a maze.
const MAPS: [&str; 3] = ["Aftershock", "AR0300SR", "maze512-8-0"];

/// What a contender did on one map.
#[derive(Default)]
struct Count {
    latency: Tally,
    upkeep: f64,
    first: f64,
    mismatches: u64,
}

impl Count {
    fn total(&self) -> f64 {
        self.first + self.latency.sum() + self.upkeep
    }
}

/// All contenders as one planner: they plan on the same knowledge, the driver's path is gone.
struct Rivals {
    ours: Vec<(Ours, Count)>,
    answered: usize,
}

impl Rivals {
    /// Lets all answer, times them and compares.
    fn answer(
        &mut self,
        cx: &mut Context<'_, GridProblem>,
        mut ask: impl FnMut(
            &mut dyn Replanner<GridProblem>,
            &mut Context<'_, GridProblem>,
        ) -> Result<Report<GridProblem>, Unsupported>,
        mut tell: impl FnMut(&mut Count, f64),
    ) -> Result<Report<GridProblem>, Unsupported> {
        let count = self.ours.len();
        let mut reports = vec![None; count];
        for k in 0..count {
            let k = (self.answered + k) % count;
            let (ours, count) = &mut self.ours[k];
            let (time, report) = timed(|| ask(ours.planner.as_mut(), &mut Context::seeded(0)));
            tell(count, time.as_secs_f64() * 1e6);
            let report = report?;
            count.latency.expanded += report.stats.expanded;
            reports[k] = Some(report);
        }
        self.answered += 1;
        let fresh = reports[0].as_ref().and_then(proved);
        for ((_, count), report) in self.ours.iter_mut().zip(&reports) {
            let cost = report.as_ref().and_then(proved);
            count.mismatches += u64::from(cost.is_none() || cost != fresh);
        }
        let driver = reports.into_iter().flatten().nth(usize::from(count > 1));
        Ok(driver.unwrap_or_else(|| cx.report(pf_core::Outcome::Unknown { attempt: None })))
    }
}

impl Planner<GridProblem> for Rivals {
    fn name(&self) -> &'static str {
        "rivals"
    }

    fn claims(&self) -> Claims {
        Claims::NONE
    }

    fn plan(
        &mut self,
        problem: &GridProblem,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        let ask =
            |planner: &mut dyn Replanner<_>, cx: &mut Context<'_, _>| planner.plan(problem, cx);
        self.answer(cx, ask, |count, time| count.first += time)
    }
}

impl Replanner<GridProblem> for Rivals {
    fn replan(
        &mut self,
        revision: &Revision<'_, GridProblem>,
        cx: &mut Context<'_, GridProblem>,
    ) -> Result<Report<GridProblem>, Unsupported> {
        let ask =
            |planner: &mut dyn Replanner<_>, cx: &mut Context<'_, _>| planner.replan(revision, cx);
        self.answer(cx, ask, |count, time| count.latency.add_us(time))
    }

    fn settle(&mut self, problem: &GridProblem, _: &mut Context<'_, GridProblem>) {
        for (ours, count) in &mut self.ours {
            let mut cx = Context::seeded(0);
            let (time, ()) = timed(|| ours.planner.settle(problem, &mut cx));
            count.upkeep += time.as_secs_f64() * 1e6;
        }
    }
}

/// One line of the answer.
#[derive(Debug, Serialize)]
struct Row {
    suite: &'static str,
    case: String,
    planner: &'static str,
    sensor: f64,
    moves: &'static str,
    /// How many drives.
    queries: usize,
    /// How many of them reached the goal; the others proved that it is closed.
    arrived: usize,
    /// The cost of the way gone, in cells, of all drives.
    travelled: f64,
    replans: usize,
    mean_us: f64,
    median_us: f64,
    p95_us: f64,
    worst_us: f64,
    /// All upkeep.
    upkeep_us: f64,
    /// All planning, upkeep included.
    total_us: f64,
    /// The fresh A*'s total divided by this one's.
    speedup: f64,
    mismatches: u64,
}

pub(crate) fn run(args: &Args) -> Result<()> {
    if !args.json {
        say(format_args!(
            "{:<20} {:<14} {:>6} {:>7} {:>10} {:>7} {:>10} {:>10} {:>10} {:>10} {:>10} {:>8} {:>10}",
            "map",
            "planner",
            "drives",
            "arrived",
            "travelled",
            "replans",
            "median us",
            "p95 us",
            "worst us",
            "upkeep ms",
            "total ms",
            "x fresh",
            "mismatches"
        ))?;
    }
    let mut mismatches = 0;
    for map in args.maps.files_or(&MAPS)? {
        for row in bench(args, &Case::load(&map)?.upscaled(args.upscale)?)? {
            mismatches += row.mismatches;
            if args.json {
                json(&row)?;
            } else {
                tell(&row)?;
            }
        }
    }
    if mismatches > 0 {
        bail!("{mismatches} answers do not agree with the fresh A*'s");
    }
    Ok(())
}

fn bench(args: &Args, case: &Case) -> Result<Vec<Row>> {
    let ours = args.planners.make()?;
    let mut rivals = Rivals {
        ours: ours
            .into_iter()
            .map(|one| (one, Count::default()))
            .collect(),
        answered: 0,
    };
    let (mut drives, mut arrived, mut travelled) = (0, 0, 0.0);
    for row in case.long(args.limit) {
        let problem = GridProblem::new(std::sync::Arc::clone(&case.grid), row.start, row.goal)?;
        let mut drive = Drive::new(&problem.with_moves(args.moves), args.sensor)?;
        let travel = drive.run(&mut rivals, || Context::seeded(0))?;
        match travel.arrival {
            Arrival::Arrived => arrived += 1,
            Arrival::Closed => {}
            other => bail!("{}, {} to {}: {other:?}", case.name, row.start, row.goal),
        }
        drives += 1;
        travelled += drive.cost().value();
    }
    let fresh = rivals.ours[0].1.total();
    let row = |(ours, count): (Ours, Count)| Row {
        suite: "drive",
        case: case.name.clone(),
        planner: ours.name,
        sensor: args.sensor,
        moves: args.moves.name(),
        queries: drives,
        arrived,
        travelled,
        replans: count.latency.queries(),
        mean_us: count.latency.mean(),
        median_us: count.latency.quantile(0.5),
        p95_us: count.latency.quantile(0.95),
        worst_us: count.latency.quantile(1.0),
        upkeep_us: count.upkeep,
        total_us: count.total(),
        speedup: fresh / count.total(),
        mismatches: count.mismatches,
    };
    Ok(rivals.ours.into_iter().map(row).collect())
}

fn tell(row: &Row) -> Result<()> {
    let name = if row.planner == FRESH {
        "astar afresh"
    } else {
        row.planner
    };
    say(format_args!(
        "{:<20} {:<14} {:>6} {:>7} {:>10.1} {:>7} {:>10.1} {:>10.1} {:>10.1} {:>10.2} {:>10.2} {:>8.2} {:>10}",
        row.case,
        name,
        row.queries,
        row.arrived,
        row.travelled,
        row.replans,
        row.median_us,
        row.p95_us,
        row.worst_us,
        row.upkeep_us / 1e3,
        row.total_us / 1e3,
        row.speedup,
        row.mismatches
    ))
}
