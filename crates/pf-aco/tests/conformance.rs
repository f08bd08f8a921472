//! Every law that binds them. The swarms are small, as the laws are about conduct, not about luck.

use pf_aco::{Aco, AcoParams, AcoStar, AcoStarParams};
use pf_conformance::{Options, examine_replanner, grid::Grids};
use pf_core::Replanner;
use pf_grid::GridProblem;

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

#[test]
fn aco_keeps_the_laws() {
    keeps_the_laws(&|| {
        Box::new(
            Aco::new(AcoParams {
                ants: 6,
                iterations: 12,
                ..AcoParams::default()
            })
            .unwrap(),
        )
    });
}

#[test]
fn aco_star_keeps_the_laws_with_every_option() {
    keeps_the_laws(&|| {
        Box::new(
            AcoStar::new(AcoStarParams {
                ants: 6,
                iterations: 12,
                patience: 5,
                tabu: true,
                limits: true,
                loops: false,
                threads: 2,
                ..AcoStarParams::default()
            })
            .unwrap(),
        )
    });
}
