//! Every law bites: each rogue breaks exactly its own.

use pf_conformance::{
    Options, Verdict, examine_replanner,
    grid::Grids,
    laws,
    rogues::{Honest, TeamHonest, WorldHonest, rogues, team_rogues, world_rogues},
    team::Teams,
    world::Worlds,
};

fn broken(verdicts: &[Verdict]) -> Vec<&'static str> {
    let broken = verdicts.iter().filter(|verdict| !verdict.passed());
    broken.map(|verdict| verdict.law.name).collect()
}

/// What is wrong with a rogue that is to break one law, sin by sin.
fn wrong(law: &str, sin: &str, verdicts: &[Verdict]) -> Option<String> {
    if broken(verdicts) == [law] {
        return None;
    }
    let lines = verdicts.iter().filter(|verdict| !verdict.passed());
    let lines: Vec<_> = lines.map(ToString::to_string).collect();
    let lines = lines.join("\n");
    Some(format!("{sin} should break `{law}`, and:\n{lines}"))
}

#[test]
fn each_rogue_breaks_exactly_its_law() {
    let all = rogues().into_iter();
    let wrong: Vec<_> = all
        .filter_map(|rogue| wrong(rogue.law, rogue.sin, &rogue.examine()))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn each_rogue_for_worlds_breaks_exactly_its_law() {
    let all = world_rogues().into_iter();
    let wrong: Vec<_> = all
        .filter_map(|rogue| wrong(rogue.law, rogue.sin, &rogue.examine()))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn each_rogue_for_teams_breaks_exactly_its_law() {
    let all = team_rogues().into_iter();
    let wrong: Vec<_> = all
        .filter_map(|rogue| wrong(rogue.law, rogue.sin, &rogue.examine()))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
    let options = Options {
        cases: 20,
        ..Options::default()
    };
    let verdicts = examine_replanner(&Teams, &options, &|| Box::new(TeamHonest));
    assert_eq!(broken(&verdicts), [""; 0]);
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

#[test]
fn the_same_holds_in_worlds() {
    let options = Options {
        cases: 40,
        largest: 60,
        ..Options::default()
    };
    let make = || Box::new(WorldHonest::default()) as _;
    let verdicts = examine_replanner(&Worlds, &options, &make);
    assert_eq!(broken(&verdicts), [""; 0]);
    assert_eq!(verdicts.len(), laws().len());
    assert!(verdicts.iter().all(|verdict| verdict.cases > 0));
}
