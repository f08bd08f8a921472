//! A robot with a sensor in a grid that it does not know.

use crate::{
    animate::{
        Args, Shown,
        search::{brief, counted},
        step_of, title,
    },
    drive,
    failure::{Failure, Status},
};
use pf_core::{CancelToken, Context, Outcome, Replanner, Report, Stop};
use pf_grid::{Advance, Cell, Drive, Grid, GridProblem};
use pf_planners::Scene;
use pf_render::{Film, Look, Picture, Reel, Shade, Shot, Thing};

/// How a drive went.
struct Driven {
    drive: Drive,
    /// From which place of the trail on each plan counted.
    plans: Vec<(usize, Vec<Cell>)>,
    status: Status,
    words: &'static str,
}

pub(super) fn film(args: &Args, sensor: f64, cancel: &CancelToken) -> Result<Shown, Failure> {
    let entry = drive::entry(&args.planner)?;
    let question = drive::ask(&args.map, &args.question, None)?;
    let Scene::Grid(scene) = &question.scene else {
        return Err(drive::no_grid(&args.map));
    };
    let settings = |error| Failure::usage(format!("--set: {error}"));
    let mut planner = entry.make(&args.planner.settings).map_err(settings)?;
    let context = || {
        let order = args.planner.order(cancel, None);
        Context::seeded(order.seed).within(order.budget)
    };
    let start = Drive::new(scene.problem(), sensor)?;
    let driven = run(start, planner.as_mut(), context)?;
    let replans = driven.plans.len().saturating_sub(1);
    let cost = brief(driven.drive.cost().value());
    let words = format!(
        "{}, cost {cost}, {}, sensor {sensor}",
        driven.words,
        counted(replans, "replan")
    );
    let name = planner.name().to_owned();
    let reel = reel(
        &driven,
        scene.problem(),
        sensor,
        usize::from(args.frames),
        scene.robot().radius,
    );
    Ok((
        Film::new(
            title(&name, &question, &words, args.planner.seed),
            vec![reel],
        ),
        driven.status,
    ))
}

/// Drives to the end, and keeps what was planned.
fn run(
    mut drive: Drive,
    planner: &mut dyn Replanner<GridProblem>,
    context: impl Fn() -> Context<'static, GridProblem>,
) -> Result<Driven, Failure> {
    let refused = |error: pf_core::Unsupported| Failure::usage(error.to_string());
    let mut plans = Vec::new();
    let mut report: Report<GridProblem> = planner
        .plan(drive.known(), &mut context())
        .map_err(refused)?;
    let (status, words) = loop {
        planner.settle(drive.known(), &mut context());
        let path = match &report.outcome {
            _ if report.stop == Stop::Cancelled => break (Status::Interrupted, "interrupted"),
            Outcome::Infeasible => break (Status::NoPath, "proved that there is no way"),
            Outcome::Unknown { .. } => break (Status::NotFound, "found no path"),
            Outcome::Optimal(best) | Outcome::Feasible(best) => best.solution.clone(),
        };
        plans.push((drive.trail().len() - 1, path.clone()));
        match drive.advance(&path) {
            Advance::Arrived => break (Status::Done, "arrived"),
            Advance::Refused => {
                let message = format!("{} plans steps that cannot be made", planner.name());
                return Err(Failure::Internal(message));
            }
            Advance::Discovered(changes) => {
                let revision = drive.learn(&changes)?;
                report = planner.replan(&revision, &mut context()).map_err(refused)?;
            }
        }
    };
    Ok(Driven {
        drive,
        plans,
        status,
        words,
    })
}

fn reel(driven: &Driven, truth: &GridProblem, sensor: f64, frames: usize, radius: f64) -> Reel {
    let (grid, trail) = (truth.grid(), driven.drive.trail());
    let ends = [truth.start(), truth.goal()].map(middle);
    let mut reel = Reel::of(Picture::new(grid.width(), grid.height()))
        .ends(ends[0], ends[1])
        .explain_shade(Shade::UNSEEN, "not seen")
        .explain_shade(Shade::BLOCKED, "blocked");
    if !grid.is_uniform() {
        reel = reel.explain_shade(Shade::terrain(0.6), "terrain");
    }
    reel = reel
        .explain(Look::Answer, "driven")
        .explain(Look::Planned, "planned")
        .explain(Look::Sensor, "sensor");
    let mut seen = vec![false; grid.width() as usize * grid.height() as usize];
    let mut shown = 0;
    for k in 0..frames {
        let step = step_of(k, frames, trail.len());
        let mut shot = Shot::default();
        if k == 0 {
            shot.cells
                .extend(reel.tiles().map(|cell| (cell, Shade::UNSEEN)));
        }
        for &at in &trail[shown..=step] {
            look(grid, at, sensor, &mut seen, &mut shot);
        }
        shown = step;
        things(driven, step, sensor, radius, &mut shot);
        reel.push(shot);
    }
    reel
}

/// What is seen from a cell that was not seen before.
fn look(grid: &Grid, at: Cell, sensor: f64, seen: &mut [bool], shot: &mut Shot) {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "from 0, and casts of floats saturate"
    )]
    let reach = (sensor as u32).max(1);
    let most = f64::from(grid.cost_range().1).ln().max(f64::MIN_POSITIVE);
    for y in at.y.saturating_sub(reach)
        ..at.y
            .saturating_add(reach)
            .saturating_add(1)
            .min(grid.height())
    {
        for x in at.x.saturating_sub(reach)
            ..at.x
                .saturating_add(reach)
                .saturating_add(1)
                .min(grid.width())
        {
            let (dx, dy) = (at.x.abs_diff(x), at.y.abs_diff(y));
            let far = f64::from(dx).hypot(f64::from(dy));
            let place = y as usize * grid.width() as usize + x as usize;
            if far > sensor && dx.max(dy) > 1 || std::mem::replace(&mut seen[place], true) {
                continue;
            }
            let cell = Cell::new(x, y);
            let shade = match (grid.is_free(cell), grid.cost(cell)) {
                (false, _) => Shade::BLOCKED,
                (true, 0 | 1) => Shade::NONE,
                (true, cost) => Shade::terrain(f64::from(cost).ln() / most),
            };
            shot.cells.push((cell, shade));
        }
    }
}

fn things(driven: &Driven, step: usize, sensor: f64, radius: f64, shot: &mut Shot) {
    let trail = driven.drive.trail();
    let at = middle(trail[step]);
    let plan = driven.plans.iter().rposition(|(from, _)| *from <= step);
    if let Some(plan) = plan {
        let (from, path) = &driven.plans[plan];
        let points: Vec<_> = path.iter().skip(step - from).map(|&c| middle(c)).collect();
        if points.len() > 1 {
            let look = Look::Planned;
            shot.things.push(Thing::Line { points, look });
        }
    }
    shot.things.push(Thing::Ring {
        at,
        radius: sensor.max(1.0),
        look: Look::Sensor,
    });
    shot.things.push(Thing::Line {
        points: trail[..=step].iter().map(|&c| middle(c)).collect(),
        look: Look::Answer,
    });
    shot.things.push(Thing::Disc {
        at,
        radius,
        look: Look::Answer,
    });
    let replans = counted(plan.unwrap_or(0), "replan");
    shot.words = format!("step {step} of {}, {replans}", trail.len() - 1);
    if step + 1 == trail.len() {
        shot.words = format!("{} after {step} steps, {replans}", driven.words);
    }
}

fn middle(cell: Cell) -> [f64; 2] {
    [f64::from(cell.x) + 0.5, f64::from(cell.y) + 0.5]
}
