//! A scenario in time: the search after each event.

use crate::{
    animate::{
        Shown,
        search::{Search, counted, words},
        title,
    },
    failure::{Failure, Status},
    question::Question,
    report, view, words as say,
};
use pf_planners::{Line, Order, Runner};
use pf_render::{Film, Look, Picture, Reel, Thing};

/// Plays a scenario. Each event has as many frames as any other; the path before it stays to be
/// seen.
pub(crate) fn replay(
    search: &Search<'_>,
    mut question: Question,
    runner: &mut dyn Runner,
) -> Result<Shown, Failure> {
    let events = std::mem::take(&mut question.events);
    let moments = events.len() + 1;
    if search.frames < moments {
        let message = format!(
            "--frames {}: the scenario has {moments} moments",
            search.frames
        );
        return Err(Failure::usage(message).help("each needs a frame at least"));
    }
    let share = |k: usize| search.frames * (k + 1) / moments - search.frames * k / moments;
    let scene = &question.scene;
    let plan = |runner: &mut dyn Runner, order: Order<'_>| runner.plan(scene, order);
    let first = search.reel(scene, view::ground(scene), share(0), runner, plan)?;
    let mut answer = first.answer;
    let mut reels = vec![first.reel.said("at first: ")];
    for (k, event) in events.into_iter().enumerate() {
        if search.cancel.is_cancelled() {
            return Ok((Film::new("", reels), Status::Interrupted));
        }
        runner.settle(search.planner.order(search.cancel, None));
        let before = question.scene.clone();
        let old = answer.lines.first().cloned();
        let followed = question.scene.change(&event.changes)?;
        let scene = &question.scene;
        let ground: Picture = view::changed(view::ground(scene), &before, scene);
        let replan =
            |runner: &mut dyn Runner, order: Order<'_>| runner.replan(scene, &followed, order);
        let seen = search.reel(scene, ground, share(k + 1), runner, replan)?;
        answer = seen.answer;
        let what = event
            .name
            .unwrap_or_else(|| say::of(&event.changes, &question.names));
        reels.push(below(seen.reel, scene, old.as_ref()).said(&format!("{}, {what}: ", event.at)));
    }
    let words = format!(
        "{}, in the end {}",
        counted(moments - 1, "replan"),
        words(search.entry, &question.scene, &answer)
    );
    let title = title(runner.name(), &question, &words, search.planner.seed);
    Ok((Film::new(title, reels), report::status(&answer)))
}

/// With the path before the event.
fn below(reel: Reel, scene: &pf_planners::Scene, old: Option<&Line>) -> Reel {
    let Some(line) = old else { return reel };
    let points = view::on_picture(scene, line);
    reel.explain(Look::Planned, "path before")
        .below(&Thing::Line {
            points,
            look: Look::Planned,
        })
}
