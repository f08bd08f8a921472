//! Puts a planner to every case and story of a suite, and every law that binds it to what it did.

use crate::{
    answer::Finding,
    law::{Rule, Sums, Test, book},
    run::{Ran, Run, Setting},
    seeded,
    stage::{self, Stage},
    suite::{Case, Options, Plot, Suite},
    trial::Trial,
    verdict::{Breach, Verdict},
};
use pf_core::{Context, Planner, Problem, Replanner, Report, Unsupported};
use std::cell::RefCell;

/// Holds the planners that `make` makes to every law that binds them, on the cases of `suite`.
///
/// `cargo xtask conformance` prints what comes back; tests use [`grid::check`](crate::grid::check).
pub fn examine<S: Suite>(
    suite: &S,
    options: &Options,
    make: &dyn Fn() -> Box<dyn Planner<S::Problem>>,
) -> Vec<Verdict> {
    let mut exam = Exam::new(suite, options, &*make(), false);
    exam.planning(make);
    exam.verdicts()
}

/// Like [`examine`], and the laws of replanning too.
pub fn examine_replanner<S: Suite>(
    suite: &S,
    options: &Options,
    make: &dyn Fn() -> Box<dyn Replanner<S::Problem>>,
) -> Vec<Verdict> {
    let mut exam = Exam::new(suite, options, &*make(), true);
    exam.planning(&|| make());
    exam.replanning(make);
    exam.verdicts()
}

/// Makes calls and remembers what no single call shows.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    panic: RefCell<Option<String>>,
    sums: RefCell<Sums>,
}

impl Watch {
    /// The planner's answer; `None` if it declined or panicked.
    pub(crate) fn run<P: Problem>(
        &self,
        setting: &Setting,
        call: impl FnOnce(&mut Context<'_, P>) -> Result<Report<P>, Unsupported>,
    ) -> Option<Run<P>> {
        match setting.run(call) {
            Ran::Answered(run) => Some(run),
            Ran::Declined => None,
            Ran::Panicked(message) => {
                self.panic.borrow_mut().get_or_insert(message);
                None
            }
        }
    }

    /// Takes note of a case's first answer.
    pub(crate) fn saw<P: Problem>(&self, report: &Report<P>) {
        let mut sums = self.sums.borrow_mut();
        sums.answered += 1;
        sums.solved += u64::from(report.outcome.solved().is_some());
        sums.iterations += report.stats.iterations;
    }

    /// Whether somebody panicked since the last time this was asked.
    fn calm(&self) -> Finding {
        self.panic
            .take()
            .map_or(Ok(()), |message| Err(format!("it panicked: {message}")))
    }
}

/// A law with what is known of its being kept.
struct Entry<P: Problem> {
    rule: Rule<P>,
    cases: usize,
    breach: Option<Breach>,
}

struct Exam<'a, S: Suite> {
    suite: &'a S,
    options: &'a Options,
    planner: String,
    entries: Vec<Entry<S::Problem>>,
    watch: Watch,
}

impl<'a, S: Suite> Exam<'a, S> {
    fn new<T: Planner<S::Problem> + ?Sized>(
        suite: &'a S,
        options: &'a Options,
        planner: &T,
        replanner: bool,
    ) -> Self {
        let bound = |rule: &Rule<_>| rule.law.binds.holds_for(planner.claims(), replanner);
        let entry = |rule| Entry {
            rule,
            cases: 0,
            breach: None,
        };
        Self {
            suite,
            options,
            planner: planner.name().to_owned(),
            entries: book().into_iter().filter(bound).map(entry).collect(),
            watch: Watch::default(),
        }
    }

    /// Lets every law of which `test` has a finding note it.
    fn note(
        &mut self,
        name: &str,
        problem: &S::Problem,
        test: impl Fn(&Test<S::Problem>) -> Option<Finding>,
    ) {
        for entry in &mut self.entries {
            let Some(finding) = test(&entry.rule.test) else {
                continue;
            };
            entry.cases += 1;
            if let Err(how) = finding {
                let breach = entry.breach.get_or_insert_with(|| Breach {
                    times: 0,
                    case: name.to_owned(),
                    how,
                    drawing: self.suite.draw(problem),
                });
                breach.times += 1;
            }
        }
    }

    fn planning(&mut self, make: &dyn Fn() -> Box<dyn Planner<S::Problem>>) {
        let drawn = self.suite.cases(self.options);
        let suite = self.suite;
        for case in &drawn {
            self.case(make, case);
        }
        for i in 0..self.options.cases {
            let seed = self.options.seed.wrapping_add(u64::from(i));
            let problem = suite.random(&mut seeded(seed), self.options);
            self.case(
                make,
                &Case {
                    name: format!("made up from seed {seed}"),
                    truth: suite.truth(&problem),
                    problem,
                },
            );
        }
    }

    fn case(&mut self, make: &dyn Fn() -> Box<dyn Planner<S::Problem>>, case: &Case<S::Problem>) {
        self.watch.sums.get_mut().cases += 1;
        let rng = &mut seeded(self.options.seed);
        let others = [
            self.suite.random(rng, self.options),
            self.suite.lookalike(rng, &case.problem),
        ];
        let trial = Trial::of(make, &self.watch, case, &others, self.options);
        let calm = self.watch.calm();
        self.note(&case.name, &case.problem, |test| match (test, &trial) {
            (Test::Panic, _) => Some(calm.clone()),
            (Test::Case(test), Some(trial)) => Some(test(trial)),
            _ => None,
        });
    }

    fn replanning(&mut self, make: &dyn Fn() -> Box<dyn Replanner<S::Problem>>) {
        let cases = u64::from(self.options.cases);
        for (plot, stories) in [
            (Plot::Mixed, cases.div_ceil(2)),
            (Plot::Small, cases.div_ceil(5)),
            (Plot::Ends, cases.div_ceil(2)),
            (Plot::Long, cases.div_ceil(50)),
        ] {
            for i in 0..stories {
                self.story(make, plot, self.options.seed.wrapping_add(i));
            }
        }
    }

    fn story(&mut self, make: &dyn Fn() -> Box<dyn Replanner<S::Problem>>, plot: Plot, seed: u64) {
        let suite = self.suite;
        let rng = &mut seeded(seed);
        let story = suite.story(rng, plot, self.options);
        let stranger = suite.random(rng, self.options);
        let truth = |problem: &S::Problem| suite.truth(problem);
        let watch = std::mem::take(&mut self.watch);
        let stage = Stage::of(make, &watch, &story, &truth, stranger);
        let name = format!("{}, seed {seed}", story.name);
        let first = &story.worlds()[0];
        if let Some(stage) = &stage {
            if plot == Plot::Small {
                watch
                    .sums
                    .borrow_mut()
                    .savings
                    .extend(stage::savings(stage));
            }
            let ordinary = matches!(plot, Plot::Mixed | Plot::Ends) && stage.ordinary();
            self.note(&name, first, |test| match test {
                Test::Story(its, test) if *its == plot => Some(test(stage)),
                Test::Special(test) if ordinary => Some(test(stage)),
                _ => None,
            });
        }
        let calm = watch.calm();
        self.note(&name, first, |test| {
            matches!(test, Test::Panic).then(|| calm.clone())
        });
        self.watch = watch;
    }

    fn verdicts(mut self) -> Vec<Verdict> {
        let sums = self.watch.sums.take();
        for entry in &mut self.entries {
            if let Test::Whole(test) = entry.rule.test {
                entry.cases = usize::try_from(sums.cases).unwrap_or(usize::MAX);
                entry.breach = test(&sums).err().map(|how| Breach {
                    times: 1,
                    case: "all cases together".into(),
                    how,
                    drawing: None,
                });
            }
        }
        let planner = self.planner;
        let verdict = |entry: Entry<_>| Verdict {
            planner: planner.clone(),
            law: entry.rule.law,
            cases: entry.cases,
            result: entry.breach.map_or(Ok(()), Err),
        };
        self.entries.into_iter().map(verdict).collect()
    }
}
