//! Robots of a team in time.

use crate::{
    animate::{Args, Shown, search::brief},
    failure::{Failure, Status},
    team,
};
use pf_core::{CancelToken, Outcome, Stop};
use pf_geom::{TeamPlan, TeamProblem, Timing};
use pf_moabc::Preference;
use pf_render::{Film, Picture, Reel, Shot};

pub(super) fn act(args: &Args, cancel: &CancelToken) -> Result<Shown, Failure> {
    let entry = team::entry(&args.planner)?;
    let problem = team::problem(&args.map, Timing::Exact, TeamProblem::EASE)?;
    let report = team::plan(&args.planner, args.evaluations, entry, &problem, cancel)?;
    let name = pf_planners::AnyEntry::name(entry);
    let file = args.map.file_name().unwrap_or_default().display();
    let (seed, frames) = (args.planner.seed, usize::from(args.frames));
    let status = match &report.outcome {
        _ if report.stop == Stop::Cancelled => Status::Interrupted,
        Outcome::Infeasible => Status::NoPath,
        Outcome::Unknown { .. } => Status::NotFound,
        Outcome::Optimal(_) | Outcome::Feasible(_) => Status::Done,
    };
    let front = report.outcome.solved();
    let members = front.map(|front| (front.cost.members(), front.solution.members()));
    let chosen = members.and_then(|(costs, plans)| {
        let k = args.prefer.choose(costs)?;
        Some((costs[k], &plans[k], costs.len()))
    });
    let Some(([length, danger, turning], plan, count)) = chosen else {
        let title = format!("{name} on {file}: {}, seed {seed}", report.outcome.word());
        let mut reel = Reel::of(Picture::of_world(problem.world(), 0.0));
        for _ in 0..frames {
            reel.push(Shot::default());
        }
        return Ok((Film::new(title, vec![reel]), status));
    };
    let title = format!(
        "{name} on {file}: {} of {count} plans: length {}, clearance {}, turning {:.0} deg, seed {seed}",
        best_for(args.prefer),
        brief(length),
        brief(problem.ease() - danger),
        turning.to_degrees(),
    );
    Ok((film(title, &problem, plan, frames), status))
}

/// What the preferred plan is.
fn best_for(preference: Preference) -> &'static str {
    match preference {
        Preference::Length => "shortest",
        Preference::Safety => "safest",
        Preference::Smooth => "smoothest",
        Preference::Knee => "knee",
    }
}

/// A plan, driven.
pub(crate) fn film(title: String, problem: &TeamProblem, plan: &TeamPlan, frames: usize) -> Film {
    Film::new(title, vec![Reel::team(problem, plan, frames)])
}
