//! The kit holds planners for other problems to the same laws: here one with two objectives, where
//! a smaller front must not pass for a better one, and one with an infinite cost.

use pf_conformance::{Case, Options, Plot, Story, Suite, Truth, Verdict, examine};
use pf_core::{
    Claims, Context, Cost, Front, InvalidProblem, Outcome, PlanRng, Planner, Problem, Report,
    Solved, Stamp, Unsupported, Violation,
};

/// Choose points; each costs itself.
#[derive(Clone, Debug)]
struct Choice(Stamp);

type Points = Front<[f64; 2]>;

impl Problem for Choice {
    type State = [f64; 2];
    type Solution = Points;
    type Cost = Points;
    type Change = ();

    fn judge(&self, points: &Points) -> Result<Points, Violation> {
        let undominated: Points = points.members().iter().copied().collect();
        if points.members().is_empty() || undominated.members().len() < points.members().len() {
            return Err(Violation::Empty);
        }
        Ok(points.clone())
    }
    fn apply(&mut self, _: &[()]) -> Result<(), InvalidProblem> {
        Ok(())
    }
    fn stamp(&self) -> Stamp {
        self.0
    }
}

struct Choices;

impl Suite for Choices {
    type Problem = Choice;

    fn cases(&self, _: &Options) -> Vec<Case<Choice>> {
        let problem = Choice(Stamp::fresh());
        vec![Case {
            name: "a choice".into(),
            truth: self.truth(&problem),
            problem,
        }]
    }
    fn random(&self, _: &mut PlanRng, _: &Options) -> Choice {
        Choice(Stamp::fresh())
    }
    fn lookalike(&self, _: &mut PlanRng, _: &Choice) -> Choice {
        Choice(Stamp::fresh())
    }
    fn story(&self, _: &mut PlanRng, _: Plot, _: &Options) -> Story<Choice> {
        Story::new("nothing happens", Choice(Stamp::fresh()), 3, |_| vec![])
    }
    fn truth(&self, _: &Choice) -> Truth<Points> {
        Truth::Solvable
    }
    fn draw(&self, _: &Choice) -> Option<String> {
        None
    }
}

/// Announces one set of points after the other and reports the last.
struct Announcer(&'static [&'static [[f64; 2]]]);

impl Planner<Choice> for Announcer {
    fn name(&self) -> &'static str {
        "announcer"
    }
    fn claims(&self) -> Claims {
        Claims::NONE.anytime().deterministic()
    }
    fn plan(
        &mut self,
        _: &Choice,
        cx: &mut Context<'_, Choice>,
    ) -> Result<Report<Choice>, Unsupported> {
        let mut best = None;
        for points in self.0 {
            if !cx.proceed() {
                break;
            }
            let cost = Front::unchecked(points.to_vec());
            let solved = Solved {
                solution: cost.clone(),
                cost,
            };
            cx.improved(|| solved.clone());
            best = Some(solved);
        }
        Ok(cx.report(match best {
            Some(solved) => Outcome::Feasible(solved),
            None => Outcome::Unknown { attempt: None },
        }))
    }
}

fn broken(fronts: &'static [&'static [[f64; 2]]]) -> Vec<&'static str> {
    let options = Options {
        cases: 3,
        ..Options::default()
    };
    let verdicts = examine(&Choices, &options, &|| Box::new(Announcer(fronts)));
    let broken = verdicts.iter().filter(|verdict| !verdict.passed());
    broken.map(|Verdict { law, .. }| law.name).collect()
}

#[test]
fn a_front_that_grows_gets_better() {
    assert_eq!(broken(&[&[[5.0, 5.0]], &[[4.0, 5.0], [5.0, 4.0]]]), [""; 0]);
}

#[test]
fn a_front_that_loses_its_ends_does_not() {
    assert_eq!(
        broken(&[&[[1.0, 9.0], [9.0, 1.0]], &[[5.0, 5.0]]]),
        ["anytime"]
    );
}

#[test]
fn a_front_a_hair_worse_does_not_either() {
    assert_eq!(broken(&[&[[1.0, 1.0]], &[[1.0, 1.0 + 1e-12]]]), ["anytime"]);
}

#[test]
fn a_dominated_member_is_found() {
    assert_eq!(broken(&[&[[1.0, 1.0], [1.0, 2.0]]]), ["sound"]);
}

#[test]
fn an_infinite_cost_is_honestly_stated() {
    assert!(f64::INFINITY.same_as(&f64::INFINITY));
    assert_eq!(broken(&[&[[f64::INFINITY, 1.0]]]), [""; 0]);
}
