//! Every law that binds them.

use pf_conformance::team;
use pf_core::{FromScratch, Params};
use pf_moabc::{
    Moabc, MoabcParams, Moead, MoeadParams, Nsga2, Nsga2Params, Prioritised, PrioritisedParams,
    RandomSearch, RandomSearchParams,
};

/// A small population for a few cycles, as the laws are not about how good plans are.
fn quick<P: Params>(mut params: P) -> P {
    for (key, value) in [
        ("population", "12"),
        ("evaluations", "150"),
        ("patience", "3"),
    ] {
        params.set(key, value).expect("a parameter all have");
    }
    params
}

#[test]
fn bees_keep_the_laws() {
    team::check_replanner(|| Moabc::new(quick(MoabcParams::default())).expect("good parameters"));
}

#[test]
fn the_paper_s_bees_keep_the_laws() {
    team::check_replanner(|| Moabc::new(quick(MoabcParams::paper())).expect("good parameters"));
}

#[test]
fn classic_bees_keep_the_laws() {
    team::check_replanner(|| Moabc::new(quick(MoabcParams::classic())).expect("good parameters"));
}

#[test]
fn nsga2_keeps_the_laws() {
    team::check_replanner(|| Nsga2::new(quick(Nsga2Params::default())).expect("good parameters"));
}

#[test]
fn moead_keeps_the_laws() {
    team::check_replanner(|| Moead::new(quick(MoeadParams::default())).expect("good parameters"));
}

#[test]
fn random_search_keeps_the_laws() {
    let make = || RandomSearch::new(quick(RandomSearchParams::default()));
    team::check_replanner(|| make().expect("good parameters"));
}

#[test]
fn the_baseline_keeps_the_laws() {
    let params = PrioritisedParams {
        cells: 40,
        ..PrioritisedParams::default()
    };
    team::check_replanner(|| FromScratch(Prioritised::new(params.clone()).expect("good")));
}
