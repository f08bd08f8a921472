//! Every law that binds it, with and without memory.

use pf_abc::{Abc, AbcParams};
use pf_conformance::world;

fn quick(params: &AbcParams) -> impl Fn() -> Abc + use<> {
    // Shorter walks of fewer bees, as the laws are about neither.
    let params = AbcParams {
        steps: 60,
        sources: 6,
        cycles: 3,
        half: 2.5,
        ..params.clone()
    };
    move || Abc::new(params.clone()).expect("good parameters")
}

#[test]
fn ours_keeps_the_laws() {
    world::check_replanner(quick(&AbcParams::default()));
}

#[test]
fn the_paper_s_keeps_the_laws() {
    world::check_replanner(quick(&AbcParams::paper()));
}
