//! `pf plan MAP --scen FILE`: every row of a Moving AI scenario file.

use crate::{
    args::{PlannerArgs, QuestionArgs},
    failure::{Failure, Status},
    question, report, text,
};
use indicatif::{ProgressBar, ProgressStyle};
use pf_core::{CancelToken, Stop};
use pf_io::{Scen, ScenRow, read_scen};
use pf_planners::{Answer, AnyEntry, GridScene, Robot};
use serde::Serialize;
use std::{
    io::{Write, stdout},
    path::Path,
    time::Duration,
};

pub(crate) struct Request<'a> {
    pub(crate) map: &'a Path,
    pub(crate) rows: &'a Path,
    pub(crate) limit: Option<usize>,
    pub(crate) json: bool,
}

#[derive(Serialize)]
struct Summary<'a> {
    planner: &'a str,
    rows: usize,
    mismatches: usize,
    unsolved: usize,
    total_us: f64,
    median_us: f64,
}

/// What the rows came to.
#[derive(Default)]
struct Count {
    times: Vec<Duration>,
    mismatches: usize,
    infeasible: usize,
    not_found: usize,
}

pub(crate) fn act(
    request: &Request<'_>,
    entry: &dyn AnyEntry,
    planner: &PlannerArgs,
    question: &QuestionArgs,
    cancel: &CancelToken,
) -> Result<Status, Failure> {
    if entry.problem() != "grid" {
        let message = format!("--scen: {} is no planner on grids", entry.key());
        let help = "the lengths in such a file are those of paths from cell to cell";
        return Err(Failure::usage(message).help(help));
    }
    let grid = question::grid(request.map, question)?;
    let scen = read_scen(request.rows)?;
    scen.check_size(&grid)?;
    let first = scen
        .rows
        .first()
        .map_or_else(Default::default, |row| row.start);
    let robot = Robot {
        radius: question.radius.unwrap_or(0.0),
        clearance: question.clearance.unwrap_or(0.0),
    };
    let scene = GridScene::new(grid, first, first)?
        .with_moves(question.moves.unwrap_or_default())
        .with_robot(robot)?;
    let rows = &scen.rows[..request.limit.unwrap_or(usize::MAX).min(scen.rows.len())];
    // One planner for all rows: it keeps its memory.
    let mut runner = planner.runner(entry, &[])?;
    let mut count = Count::default();
    let bar = bar(rows.len());
    for row in rows {
        let scene = scene.clone().with_query(row.start, row.goal)?;
        let answer = runner.plan(&scene.into(), planner.order(cancel, None))?;
        if answer.stop == Stop::Cancelled {
            break;
        }
        if let Some(complaint) = count.row(&scen, row, &answer) {
            bar.suspend(|| writeln!(anstream::stderr(), "{complaint}"))
                .map_err(Failure::Output)?;
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    count.times.sort_unstable();
    let total: Duration = count.times.iter().sum();
    let median = count
        .times
        .get(count.times.len() / 2)
        .copied()
        .unwrap_or_default();
    let summary = Summary {
        planner: entry.key(),
        rows: count.times.len(),
        mismatches: count.mismatches,
        unsolved: count.infeasible + count.not_found,
        total_us: text::micros(total),
        median_us: text::micros(median),
    };
    let mut out = stdout().lock();
    if request.json {
        report::line(&mut out, &summary)?;
    } else {
        writeln!(
            out,
            "{} on {}: {} rows, {} mismatches, {} unsolved, {} in all, median {}",
            entry.name(),
            request.rows.display(),
            summary.rows,
            summary.mismatches,
            summary.unsolved,
            text::time(total),
            text::time(median),
        )?;
    }
    Ok(match count {
        _ if cancel.is_cancelled() => Status::Interrupted,
        Count {
            mismatches: 1.., ..
        } => Status::CheckFailed,
        Count {
            infeasible: 1.., ..
        } => Status::NoPath,
        Count { not_found: 1.., .. } => Status::NotFound,
        _ => Status::Done,
    })
}

impl Count {
    /// Counts a row; says what is wrong with it.
    fn row(&mut self, scen: &Scen, row: &ScenRow, answer: &Answer) -> Option<String> {
        self.times.push(answer.stats.elapsed);
        let found = match (answer.outcome, answer.costs.first()) {
            (_, Some(&cost)) if scen.agrees(row, cost) => return None,
            (_, Some(cost)) => {
                self.mismatches += 1;
                format!("found {cost}")
            }
            ("infeasible", None) => {
                self.infeasible += 1;
                "there is no path".to_owned()
            }
            (_, None) => {
                self.not_found += 1;
                "found no path within the budget".to_owned()
            }
        };
        let ScenRow {
            line,
            start,
            goal,
            optimum,
            ..
        } = row;
        let name = &scen.name;
        Some(format!(
            "{name}:{line}: {start} to {goal}: {found}, the file says {optimum}"
        ))
    }
}

/// Progress, where someone watches.
fn bar(rows: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} rows, {eta} left");
    let bar = ProgressBar::new(rows as u64);
    style.map_or(bar.clone(), |style| bar.with_style(style))
}
