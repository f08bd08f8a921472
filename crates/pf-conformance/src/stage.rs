//! The laws of replanning: a story played before a replanner, and what the laws say to it.

use crate::{
    answer::{Answer, Finding, ensure},
    exam::Watch,
    run::{Run, Setting},
    suite::{Story, Truth},
    trial::{no_work, same},
};
use pf_core::{Claims, Cost, Outcome, Problem, Replanner, Revision};

/// How many batches every replanner gets through: what breaks within them is not a matter of age.
const YOUNG: usize = 50;

/// A story, the truth about it, and what a replanner makes of it when it sees every batch.
pub(crate) struct Stage<'a, P: Problem> {
    make: &'a dyn Fn() -> Box<dyn Replanner<P>>,
    watch: &'a Watch,
    claims: Claims,
    story: &'a Story<P>,
    truth: &'a dyn Fn(&P) -> Truth<P::Cost>,
    /// A problem that has nothing to do with the story.
    stranger: P,
    /// About each of the story's worlds.
    truths: Vec<Truth<P::Cost>>,
    /// The answer to the first world, then one a batch; `None` where it declined.
    walk: Vec<Option<Run<P>>>,
}

impl<'a, P: Problem> Stage<'a, P> {
    /// `None` if the replanner declines the first world or panics.
    pub(crate) fn of(
        make: &'a dyn Fn() -> Box<dyn Replanner<P>>,
        watch: &'a Watch,
        story: &'a Story<P>,
        truth: &'a dyn Fn(&P) -> Truth<P::Cost>,
        stranger: P,
    ) -> Option<Self> {
        let mut stage = Self {
            make,
            watch,
            claims: make().claims(),
            story,
            truth,
            stranger,
            truths: story.worlds().iter().map(truth).collect(),
            walk: vec![],
        };
        stage.walk = stage.walk();
        stage.walk[0].is_some().then_some(stage)
    }

    fn walk(&self) -> Vec<Option<Run<P>>> {
        let (mut live, mut problem) = self.begin();
        let mut walk = vec![self.plan(&mut live, &problem)];
        for batch in self.story.batches() {
            walk.push(self.replan(&mut live, &mut problem, batch));
        }
        walk
    }

    /// Whether every answer is right when the replanner sees every batch. What goes wrong then
    /// says nothing about special circumstances.
    pub(crate) fn ordinary(&self) -> bool {
        self.first_wrong().is_ok()
    }

    fn first_wrong(&self) -> Result<(), (usize, String)> {
        for (i, run) in self.walk.iter().enumerate() {
            if let Some(run) = run {
                self.right(i, run).map_err(|how| (i, how))?;
            }
        }
        Ok(())
    }

    fn begin(&self) -> (Box<dyn Replanner<P>>, P) {
        ((self.make)(), self.story.worlds()[0].clone())
    }

    fn plan(&self, live: &mut Box<dyn Replanner<P>>, problem: &P) -> Option<Run<P>> {
        self.watch
            .run(&Setting::unlimited(), |cx| live.plan(problem, cx))
    }

    /// Makes `batch` happen and asks again. `None` if the replanner declines, panics, or the batch
    /// makes no sense.
    fn replan(
        &self,
        live: &mut Box<dyn Replanner<P>>,
        problem: &mut P,
        batch: &[P::Change],
    ) -> Option<Run<P>> {
        let revision = problem.revise(batch).ok()?;
        self.ask(live, &revision, &Setting::unlimited())
    }

    fn ask(
        &self,
        live: &mut Box<dyn Replanner<P>>,
        revision: &Revision<'_, P>,
        setting: &Setting,
    ) -> Option<Run<P>> {
        self.watch.run(setting, |cx| live.replan(revision, cx))
    }

    fn settle(
        &self,
        live: &mut Box<dyn Replanner<P>>,
        problem: &P,
        setting: &Setting,
    ) -> Option<Run<P>> {
        self.watch.run(setting, |cx| {
            live.settle(problem, cx);
            Ok(cx.report(Outcome::Unknown { attempt: None }))
        })
    }

    fn answer<'b>(&'b self, world: usize, run: &'b Run<P>) -> Answer<'b, P> {
        Answer {
            problem: &self.story.worlds()[world],
            truth: &self.truths[world],
            run,
        }
    }

    /// Honest, and as good as claimed.
    fn right(&self, world: usize, run: &Run<P>) -> Finding {
        let answer = self.answer(world, run);
        answer.honest()?;
        answer.as_claimed(self.claims)
    }

    fn check(&self, world: usize, run: Option<&Run<P>>, when: &str) -> Finding {
        let Some(run) = run else { return Ok(()) };
        self.right(world, run)
            .map_err(|how| format!("{when} batch {world}: {how}"))
    }

    /// Every answer after a change, when the replanner sees every batch.
    fn every<'s>(&'s self, law: impl Fn(&Answer<'s, P>) -> Finding) -> Finding {
        for (i, run) in self.walk.iter().enumerate().skip(1) {
            if let Some(run) = run {
                law(&self.answer(i, run)).map_err(|how| format!("after batch {i}: {how}"))?;
            }
        }
        Ok(())
    }
}

pub(crate) fn replan_equals_plan<P: Problem>(stage: &Stage<'_, P>) -> Finding {
    stage.every(|answer| answer.as_claimed(stage.claims))
}

pub(crate) fn sound_after_changes<P: Problem>(stage: &Stage<'_, P>) -> Finding {
    stage.every(Answer::honest)
}

pub(crate) fn repeatable<P: Problem>(stage: &Stage<'_, P>) -> Finding {
    for (i, (one, two)) in stage.walk.iter().zip(&stage.walk()).enumerate() {
        if let (Some(one), Some(two)) = (one, two) {
            same(one, two).map_err(|how| format!("after batch {i}, {how}"))?;
        }
    }
    Ok(())
}

pub(crate) fn empty_revision<P: Problem>(stage: &Stage<'_, P>) -> Finding {
    let (mut live, mut problem) = stage.begin();
    let mut last = stage.plan(&mut live, &problem);
    for (i, batch) in stage.story.batches().iter().enumerate() {
        let again = stage.replan(&mut live, &mut problem, &[]);
        stage.check(i, again.as_ref(), "asked again with no change since")?;
        if let (Some(last), Some(again)) = (&last, &again) {
            no_worse(&stage.answer(i, again), &stage.answer(i, last))
                .map_err(|how| format!("asked again with no change since batch {i}: {how}"))?;
            if stage.claims.incremental
                && let Some(fresh) = stage.plan(&mut (stage.make)(), &problem)
            {
                let (took, from_scratch) =
                    (again.report.stats.expanded, fresh.report.stats.expanded);
                ensure(took <= from_scratch, || {
                    format!(
                        "no change since batch {i}: {took} expansions, {from_scratch} from scratch"
                    )
                })?;
            }
        }
        last = stage.replan(&mut live, &mut problem, batch);
        stage.check(i + 1, last.as_ref(), "an empty revision before")?;
    }
    Ok(())
}

fn no_worse<P: Problem>(again: &Answer<'_, P>, last: &Answer<'_, P>) -> Finding {
    let kept = match (last.judged(), again.judged()) {
        (Some(before), Some(now)) => now.no_worse_than(&before),
        (Some(_), None) => false,
        (None, _) => {
            let refuted = matches!(last.run.report.outcome, Outcome::Infeasible);
            let unknown = matches!(again.run.report.outcome, Outcome::Unknown { .. });
            !(refuted && unknown)
        }
    };
    ensure(kept, || {
        format!(
            "answers {}, before: {}",
            again.run.words(),
            last.run.words()
        )
    })
}

pub(crate) fn skipped_revisions<P: Problem>(stage: &Stage<'_, P>) -> Finding {
    let (mut live, mut problem) = stage.begin();
    let _ = stage.plan(&mut live, &problem);
    for (i, batches) in stage.story.batches().chunks_exact(2).enumerate() {
        if problem.apply(&batches[0]).is_err() {
            return Ok(());
        }
        let run = stage.replan(&mut live, &mut problem, &batches[1]);
        stage.check(2 * i + 2, run.as_ref(), "having missed the batch before")?;
    }
    Ok(())
}

pub(crate) fn diverged_clones<P: Problem>(stage: &Stage<'_, P>) -> Finding {
    let batches = stage.story.batches();
    for i in (0..batches.len().saturating_sub(1)).step_by(2) {
        let mut live = (stage.make)();
        let mut original = stage.story.worlds()[i].clone();
        let _ = stage.plan(&mut live, &original);
        let mut clone = original.clone();
        let _ = stage.replan(&mut live, &mut clone, &batches[i]);
        let Some(run) = stage.replan(&mut live, &mut original, &batches[i + 1]) else {
            continue;
        };
        let truth = (stage.truth)(&original);
        let answer = Answer {
            problem: &original,
            truth: &truth,
            run: &run,
        };
        answer
            .honest()
            .and_then(|()| answer.as_claimed(stage.claims))
            .map_err(|how| format!("having seen batch {} happen to a clone: {how}", i + 1))?;
        let run = stage.replan(&mut live, &mut clone, &batches[i + 1]);
        stage.check(
            i + 2,
            run.as_ref(),
            "back from the original to its clone, after",
        )?;
    }
    Ok(())
}

pub(crate) fn cut_short<P: Problem>(stage: &Stage<'_, P>) -> Finding {
    let (mut live, mut problem) = stage.begin();
    let _ = stage.plan(&mut live, &problem);
    for (i, batch) in (1..).zip(stage.story.batches()) {
        let needs = stage.walk[i]
            .as_ref()
            .map_or(0, |run| run.report.stats.iterations);
        let iterations = [0, needs / 2, 1][i % 3];
        let Ok(revision) = problem.revise(batch) else {
            return Ok(());
        };
        let setting = Setting::iterations(iterations);
        if let Some(cut) = stage.ask(&mut live, &revision, &setting) {
            let when = |how| format!("after batch {i}, with {iterations} iterations: {how}");
            stage.answer(i, &cut).honest().map_err(when)?;
            if iterations == 0 {
                no_work(&cut).map_err(when)?;
            }
        }
        // Every other time the next batch comes at once.
        if i % 2 == 0 {
            let run = stage.replan(&mut live, &mut problem, &[]);
            stage.check(i, run.as_ref(), "asked again, having been cut short after")?;
        }
    }
    Ok(())
}

pub(crate) fn settle_harmless<P: Problem>(stage: &Stage<'_, P>) -> Finding {
    let (mut live, mut problem) = stage.begin();
    let full = Setting::unlimited();
    let worlds = stage.story.worlds();
    let _ = stage.settle(&mut live, &problem, &full);
    let run = stage.plan(&mut live, &problem);
    stage.check(0, run.as_ref(), "settled before")?;
    for (i, batch) in (1..).zip(stage.story.batches()) {
        // The world that comes next is the easiest to take for this one.
        let other = [&worlds[(i + 1) % worlds.len()], &stage.stranger];
        if let Some(other) = other.get(i % 3)
            // Batches that change nothing leave the problem what it was.
            && other.stamp() != problem.stamp()
            && let Some(run) = stage.settle(&mut live, other, &full)
        {
            no_work(&run).map_err(|how| format!("settling on another problem, {how}"))?;
        }
        // Not at all on a budget of nothing, then at leisure; or either alone; or twice.
        if i % 4 >= 2
            && let Some(run) = stage.settle(&mut live, &problem, &Setting::iterations(0))
        {
            no_work(&run).map_err(|how| format!("settling without budget, {how}"))?;
        }
        for _ in 0..[1, 2, 1, 0][i % 4] {
            let _ = stage.settle(&mut live, &problem, &full);
        }
        let run = stage.replan(&mut live, &mut problem, batch);
        stage.check(i, run.as_ref(), "having settled before")?;
    }
    Ok(())
}

pub(crate) fn long_life<P: Problem>(stage: &Stage<'_, P>) -> Finding {
    match stage.first_wrong() {
        Err((i, how)) if i > YOUNG => Err(format!("after batch {i}: {how}")),
        _ => Ok(()),
    }
}

pub(crate) fn blocked_ends<P: Problem>(stage: &Stage<'_, P>) -> Finding {
    stage
        .first_wrong()
        .map_err(|(i, how)| format!("after batch {i}: {how}"))
}

/// What replanning took of what planning from scratch took, batch by batch.
pub(crate) fn savings<P: Problem>(stage: &Stage<'_, P>) -> Vec<(u64, u64)> {
    let mut savings = vec![];
    for (world, run) in stage.story.worlds().iter().zip(&stage.walk).skip(1) {
        let Some(run) = run else { continue };
        if let Some(fresh) = stage.plan(&mut (stage.make)(), world) {
            savings.push((run.report.stats.expanded, fresh.report.stats.expanded));
        }
    }
    savings
}
