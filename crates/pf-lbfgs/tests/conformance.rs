//! Every law that binds it, by each set of rules.

use pf_conformance::world;
use pf_lbfgs::{Lbfgs, LbfgsParams};

#[test]
fn ours_keeps_the_laws() {
    world::check_replanner(Lbfgs::default);
}

#[test]
fn ours_with_a_clearance_keeps_the_laws() {
    let params = LbfgsParams {
        clearance: 0.3,
        hysteresis: 0.0,
        ..LbfgsParams::default()
    };
    world::check_replanner(move || Lbfgs::new(params.clone()).expect("good parameters"));
}
