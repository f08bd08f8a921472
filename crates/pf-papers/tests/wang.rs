//! Fronts: what is claimed of our bees, on problems on which nothing was tuned. Few seeds, as the
//! whole experiment is `cargo pf paper wang`.

use pf_core::{Budget, Context, Planner, Problem};
use pf_geom::TeamProblem;
use pf_moabc::{
    Moabc, MoabcParams, Moead, MoeadParams, Nsga2, Nsga2Params, indicators::hypervolume,
};
use pf_papers::wang::{Trial, further, three_discs};

/// The mean hypervolume of a few runs with 20,000 evaluations.
fn volume(trial: &Trial, mut planner: impl Planner<TeamProblem>) -> f64 {
    let one = |seed| {
        let mut cx = Context::seeded(seed).within(Budget::unlimited().evaluations(20_000));
        let report = planner.plan(&trial.problem, &mut cx).expect("supported");
        let front = report.outcome.solved().expect("a front");
        let judged = trial.problem.judge(&front.solution);
        let costs = judged.expect("every member passes the judge");
        let scaled: Vec<_> = costs.members().iter().map(|c| trial.scaled(c)).collect();
        hypervolume(&scaled, &[1.1; 3]) / 1.331
    };
    (0..4).map(one).sum::<f64>() / 4.0
}

fn bees(mut params: MoabcParams) -> Moabc {
    params.step = 7.0;
    Moabc::new(params).expect("good parameters")
}

fn directions() -> Moead {
    let params = MoeadParams {
        step: 7.0,
        ..MoeadParams::default()
    };
    Moead::new(params).expect("good parameters")
}

fn genes() -> Nsga2 {
    let params = Nsga2Params {
        step: 7.0,
        ..Nsga2Params::default()
    };
    Nsga2::new(params).expect("good parameters")
}

#[test]
fn hypervolumes_on_three_discs_are_as_in_the_literature() {
    let trial = three_discs().expect("a problem");
    let ours = volume(&trial, bees(MoabcParams::default()));
    assert!(ours > 0.715, "{ours}");
    let theirs = volume(&trial, genes());
    assert!(theirs > 0.70, "{theirs}");
    let theirs = volume(&trial, directions());
    assert!(theirs > 0.73, "{theirs}");
}

#[test]
fn mending_bees_beat_moead_where_nothing_was_tuned() {
    let trials = further().expect("problems");
    let ahead = trials
        .iter()
        .filter(|trial| volume(trial, bees(MoabcParams::mending())) > volume(trial, directions()));
    let ahead = ahead.count();
    assert!(ahead >= 5, "on {ahead} of {}", trials.len());
}
