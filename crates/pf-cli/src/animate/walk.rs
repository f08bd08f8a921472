//! Bees that look for the next step of a robot that sees what is near.

use crate::{
    animate::{Args, Shown, step_of, title},
    failure::Failure,
    question::{self, Question},
    view,
    walk::{self, Walked},
};
use pf_core::{CancelToken, Event};
use pf_geom::WorldProblem;
use pf_planners::Scene;
use pf_render::{Film, Look, Reel, Shot, Thing};

/// Where bees were when the robot had made so many steps to another place.
type Bees = Vec<(usize, Vec<[f64; 2]>)>;

pub(super) fn film(
    args: &Args,
    question: &Question,
    cancel: &CancelToken,
) -> Result<Shown, Failure> {
    let params = walk::params(&args.planner)?;
    if !matches!(question.scene, Scene::World(_)) {
        return Err(question::no_world(&args.map));
    }
    walk::check_events(&args.map, question)?;
    let half = params.half;
    let (mut bees, mut moved): (Bees, usize) = (Vec::new(), 0);
    let mut listen = |event: &Event<'_, WorldProblem>| match event {
        Event::Points { at, .. } => {
            bees.push((moved, at.iter().map(|p| [p.x, p.y]).collect()));
        }
        Event::Expanded(_) => moved += 1,
        _ => {}
    };
    let walked = walk::walk(&args.planner, question, params, cancel, Some(&mut listen))?;
    let status = walked.status(cancel)?;
    let reels = reels(&walked, &bees, half, usize::from(args.frames));
    let title = title("cABC", question, &walked.end(), args.planner.seed);
    Ok((Film::new(title, reels), status))
}

/// A reel for each world that is shown in a frame at least.
fn reels(walked: &Walked<'_>, bees: &Bees, half: f64, frames: usize) -> Vec<Reel> {
    let mut reels: Vec<(usize, Reel)> = Vec::new();
    for k in 0..frames {
        let step = step_of(k, frames, walked.places.len());
        let now = |(from, _): &(u64, Scene)| *from <= step as u64;
        let world = walked.worlds.iter().rposition(now).unwrap_or(0);
        if reels.last().is_none_or(|(shown, _)| *shown != world) {
            let before = world.saturating_sub(1);
            reels.push((
                world,
                ground(&walked.worlds[before].1, &walked.worlds[world].1),
            ));
        }
        if let Some((_, reel)) = reels.last_mut() {
            reel.push(shot(walked, bees, half, step, world));
        }
    }
    reels.into_iter().map(|(_, reel)| reel).collect()
}

fn ground(before: &Scene, now: &Scene) -> Reel {
    let [start, goal] = view::end_points(now);
    Reel::of(view::changed(view::ground(now), before, now))
        .ends(start, goal)
        .explain(Look::Answer, "walked")
        .explain(Look::Swarm, "bees")
        .explain(Look::Sensor, "what the robot sees")
}

fn shot(walked: &Walked<'_>, bees: &Bees, half: f64, step: usize, world: usize) -> Shot {
    let length = walked.places[step];
    let points: Vec<_> = walked.trail[..length].iter().map(|p| [p.x, p.y]).collect();
    let at = points[length - 1];
    let radius = walked.worlds[world].1.robot().radius;
    let look = Look::Sensor;
    let mut things = vec![Thing::Window { at, half, look }];
    let look = Look::Answer;
    things.push(Thing::Line { points, look });
    let here = bees.iter().rfind(|(moved, _)| moved + 1 == length);
    if let Some((_, places)) = here {
        things.push(Thing::Dots {
            points: places.clone(),
            look: Look::Swarm,
        });
    }
    things.push(Thing::Disc { at, radius, look });
    let last = walked.places.len() - 1;
    let words = if step == last {
        walked.end()
    } else {
        format!("step {step} of {last}, {world} events")
    };
    Shot {
        cells: Vec::new(),
        things,
        words,
    }
}
