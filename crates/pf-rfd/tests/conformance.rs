//! Every law that binds them. The swarms are small, as the laws are about conduct, not about luck.

use pf_conformance::{
    Options, examine_replanner,
    grid::{self, Grids},
};
use pf_core::Replanner;
use pf_grid::GridProblem;
use pf_rfd::{Rfd, RfdExact, RfdField, RfdParams, RfdStar, RfdStarParams};

fn keeps_the_laws(make: &dyn Fn() -> Box<dyn Replanner<GridProblem>>) {
    let options = Options {
        cases: 40,
        largest: 900,
        ..Options::default()
    };
    let broken: Vec<_> = examine_replanner(&Grids, &options, make)
        .into_iter()
        .filter(|verdict| !verdict.passed())
        .map(|verdict| verdict.to_string())
        .collect();
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

fn star(params: &RfdStarParams) -> Box<dyn Replanner<GridProblem>> {
    let params = RfdStarParams {
        drops: 6,
        iterations: 12,
        ..params.clone()
    };
    Box::new(RfdStar::new(params).expect("sound parameters"))
}

#[test]
fn exact_rfd_keeps_the_laws() {
    grid::check_replanner(RfdExact::default);
}

#[test]
fn the_altitude_field_keeps_the_laws() {
    grid::check_replanner(RfdField::default);
}

#[test]
fn rfd_keeps_the_laws() {
    let params = RfdParams {
        drops: 6,
        iterations: 12,
        climb: 0.5,
        threads: 2,
        ..RfdParams::default()
    };
    keeps_the_laws(&|| Box::new(Rfd::new(params.clone()).unwrap()));
}

#[test]
fn rfd_star_of_the_paper_keeps_the_laws() {
    keeps_the_laws(&|| star(&RfdStarParams::paper()));
}

#[test]
fn rfd_star_of_the_authors_code_keeps_the_laws() {
    keeps_the_laws(&|| star(&RfdStarParams::authors_code()));
}

#[test]
fn seeded_rfd_star_keeps_the_laws() {
    keeps_the_laws(&|| star(&RfdStarParams::seeded()));
}
