//! `cargo xtask browser`: the pages that `pf` writes, looked at in a real browser.

use crate::{
    steps::{Verdict, cargo, passes},
    workspace::root,
};
use anyhow::{Context as _, Result};
use std::{env, path::Path, process::Command};

/// Says why nothing is looked at where no browser is; a line that is easy to see in a log.
fn missing(what: &str) -> Verdict {
    println!("cargo xtask browser: SKIPPED: {what} is missing; nothing was looked at");
    Verdict::Passed
}

/// How `report.mjs` ends if the browser does not start.
const NO_BROWSER: i32 = 77;

/// Builds the demo and a few animations and runs `tests/browser/report.mjs` on them.
pub(crate) fn run() -> Result<Verdict> {
    let browser = env::var_os("CHROMIUM").unwrap_or_else(|| "/usr/bin/chromium".into());
    if !Path::new(&browser).exists() {
        return Ok(missing(&format!("chromium ({})", browser.display())));
    }
    for tool in ["node", "npm"] {
        let found = Command::new(tool).arg("--version").output();
        if !found.is_ok_and(|output| output.status.success()) {
            return Ok(missing(tool));
        }
    }
    let folder = tempfile::tempdir().context("no place for pages")?;
    let file = |name: &str| folder.path().join(name).display().to_string();
    let mut pages = vec![file("report.html")];
    let demo = [
        "demo".to_owned(),
        "--out".to_owned(),
        folder.path().display().to_string(),
    ];
    if pf(&demo)? == Verdict::Failed {
        return Ok(Verdict::Failed);
    }
    for (name, args) in FILMS {
        let out = file(name);
        let args = ["animate"].iter().chain(*args).map(|arg| (*arg).to_owned());
        let args: Vec<String> = args.chain(["-o".to_owned(), out.clone()]).collect();
        if pf(&args)? == Verdict::Failed {
            return Ok(Verdict::Failed);
        }
        pages.push(out);
    }
    let tests = root().join("tests/browser");
    let npm = ["ci", "--no-audit", "--no-fund"];
    if passes(Command::new("npm").args(npm).current_dir(&tests))? == Verdict::Failed {
        return Ok(missing("playwright-core (npm ci failed)"));
    }
    let mut look = Command::new("node");
    look.arg("report.mjs");
    if let Some(shots) = env::var_os("SHOTS") {
        look.arg("--shots").arg(shots);
    }
    let looked = look.args(pages).current_dir(tests).env("CHROMIUM", browser);
    let status = looked.status().context("cannot start node")?;
    Ok(match status.code() {
        Some(NO_BROWSER) => missing("a chromium that starts"),
        _ => Verdict::passed_if(status.success()),
    })
}

/// One of a search with cells, one with a swarm, one of a scenario in time, one of a drive.
const FILMS: &[(&str, &[&str])] = &[
    (
        "ants.html",
        &[
            "maps/grids/redlarski/mosaic-50.map",
            "--from",
            "1,27",
            "--to",
            "48,27",
            "--planner",
            "aco-star",
            "--iterations",
            "60",
        ],
    ),
    (
        "traffic.html",
        &["maps/scenarios/yard-traffic.toml", "--frames", "36"],
    ),
    (
        "drive.html",
        &["maps/grids/redlarski/maze-50.map", "--sensor", "8"],
    ),
    (
        "team.html",
        &["maps/scenarios/three-robots.toml", "--evaluations", "2000"],
    ),
];

/// The program, built as tests are.
fn pf(args: &[String]) -> Result<Verdict> {
    let run = ["run", "--quiet", "--package", "pf-cli", "--"].map(str::to_owned);
    passes(&mut cargo(run.iter().chain(args)))
}
