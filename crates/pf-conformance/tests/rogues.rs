//! Every law bites: each rogue breaks exactly its own.

use pf_conformance::{
    Options, Verdict, examine_replanner,
    grid::Grids,
    laws,
    rogues::{Honest, rogues},
};

fn broken(verdicts: &[Verdict]) -> Vec<&'static str> {
    let broken = verdicts.iter().filter(|verdict| !verdict.passed());
    broken.map(|verdict| verdict.law.name).collect()
}

#[test]
fn each_rogue_breaks_exactly_its_law() {
    let mut wrong = vec![];
    for rogue in rogues() {
        let verdicts = rogue.examine();
        if broken(&verdicts) != [rogue.law] {
            let lines = verdicts.iter().filter(|verdict| !verdict.passed());
            let lines: Vec<_> = lines.map(ToString::to_string).collect();
            wrong.push(format!(
                "{} should break `{}`, and:\n{}",
                rogue.sin,
                rogue.law,
                lines.join("\n")
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn every_law_has_a_rogue() {
    for law in laws() {
        assert!(
            rogues().iter().any(|rogue| rogue.law == law.name),
            "{}",
            law.name
        );
    }
}

#[test]
fn the_honest_planner_breaks_none_and_every_law_is_checked_on_it() {
    let verdicts = examine_replanner(&Grids, &Options::default(), &|| Box::new(Honest::default()));
    assert_eq!(broken(&verdicts), [""; 0]);
    assert_eq!(verdicts.len(), laws().len());
    assert!(verdicts.iter().all(|verdict| verdict.cases > 0));
}
