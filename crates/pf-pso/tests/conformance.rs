//! Every law that binds it, by each set of rules.

use pf_conformance::world;
use pf_pso::{Pso, PsoParams};

fn quick(params: &PsoParams) -> impl Fn() -> Pso + use<> {
    // Fewer moves, as the laws are about their order and not their number.
    let params = PsoParams {
        iterations: 25,
        particles: 10,
        clearance: 0.1,
        ..params.clone()
    };
    move || Pso::new(params.clone()).expect("good parameters")
}

#[test]
fn ours_keeps_the_laws() {
    world::check_replanner(quick(&PsoParams::default()));
}

#[test]
fn the_paper_s_keeps_the_laws() {
    world::check_replanner(quick(&PsoParams::paper()));
}
