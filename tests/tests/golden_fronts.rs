//! One seed, one trace: the fronts of each planner for teams, cycle by cycle.

use pf_conformance::team::{TeamRecipe, crossing};
use pf_core::{Context, Event, Params, Planner};
use pf_geom::TeamProblem;
use pf_moabc::{
    Moabc, MoabcParams, Moead, MoeadParams, Nsga2, Nsga2Params, Prioritised, RandomSearch,
    RandomSearchParams,
};
use pf_tests::golden;
use std::fmt::Write as _;

fn problem() -> TeamProblem {
    let recipe = TeamRecipe {
        robots: 2,
        radius: 1.0,
        obstacles: 4,
        kind: None,
    };
    crossing(11, &recipe)
}

fn small<P: Params>(mut params: P) -> P {
    for (key, value) in [("population", "12"), ("evaluations", "240")] {
        params.set(key, value).expect("a parameter all have");
    }
    params
}

/// The fronts announced, and the last one's first plan.
fn trace(planner: &mut dyn Planner<TeamProblem>) -> String {
    let mut text = format!("{}\n\n", planner.name());
    let mut listen = |event: &Event<'_, TeamProblem>| {
        if let Event::Improved(front) = event {
            let _ = writeln!(text, "improved");
            for [length, danger, turning] in front.cost.members() {
                let _ = writeln!(text, "  {length:.9} {danger:.9} {turning:.9}");
            }
        }
    };
    let mut cx = Context::seeded(7).traced(&mut listen);
    let report = planner.plan(&problem(), &mut cx).expect("supported");
    let _ = writeln!(
        text,
        "{} in {}",
        report.outcome.word(),
        report.stats.iterations
    );
    for path in report
        .outcome
        .solved()
        .iter()
        .flat_map(|s| &s.solution.members()[0].paths)
    {
        for p in path {
            let _ = writeln!(text, "  {:.9} {:.9} {:.9}", p.time, p.at.x, p.at.y);
        }
    }
    text
}

#[test]
fn golden_trace_of_fronts() {
    let bees = |params| Moabc::new(small(params)).expect("good parameters");
    golden::check("moabc", &trace(&mut bees(MoabcParams::default())));
    golden::check("moabc-paper", &trace(&mut bees(MoabcParams::paper())));
    golden::check("moabc-classic", &trace(&mut bees(MoabcParams::classic())));
    golden::check("moabc-mending", &trace(&mut bees(MoabcParams::mending())));
    let mut genes = Nsga2::new(small(Nsga2Params::default())).expect("good parameters");
    golden::check("nsga2", &trace(&mut genes));
    let mut directions = Moead::new(small(MoeadParams::default())).expect("good parameters");
    golden::check("moead", &trace(&mut directions));
    let mut draws = RandomSearch::new(small(RandomSearchParams::default())).expect("good");
    golden::check("random-search", &trace(&mut draws));
    golden::check("prioritised", &trace(&mut Prioritised::default()));
}
