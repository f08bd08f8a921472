//! `pf`: plan, replan and compare planners from the command line.
//!
//! Data goes to standard output, messages and progress to standard error. Exit codes: 0 ok,
//! 1 internal error, 2 usage, 3 bad input file, 4 proved that there is no path, 5 none found within
//! the budget, 6 a check failed, 130 interrupted.

mod animate;
mod args;
mod bench;
mod demo;
mod drive;
mod explain;
mod failure;
mod interrupt;
mod paper;
mod plan;
mod planners;
mod question;
mod replan;
mod report;
mod scen;
mod shell;
mod spot;
mod team;
mod text;
mod tune;
mod view;
mod walk;
mod words;

use clap::{CommandFactory, Parser, Subcommand};
use failure::{Failure, Status};
use std::process::ExitCode;

/// Small 2D path planners behind one trait.
#[derive(Parser)]
#[command(name = "pf", version, max_term_width = 100, after_help = EXAMPLES)]
struct Program {
    #[command(subcommand)]
    verb: Verb,
}

const EXAMPLES: &str = "\
Examples:
  pf demo
  pf plan office.yaml --from 20,30 --to 370,270 --radius 3 --svg office.svg
  pf plan yard.toml --planner visibility-graph --clearance 0.5 --png yard.png
  pf plan arena.map --scen arena.map.scen
  pf replan door.toml --planner d-star-lite --json
  pf drive maze.map --sensor 10 --svg drive.svg
  pf walk maps/scenarios/busy-square.toml --png walk.png
  pf team three-robots.toml --prefer safety --svg front.svg
  pf animate arena.map --from 3,4 --to 60,41 -o search.gif
  pf bench maps/suites/grid-small.toml -o runs

Exit codes:
  0 ok              3 bad input file                6 a check failed
  1 internal error  4 proved that there is no path  130 interrupted
  2 usage           5 no path found within the budget";

#[derive(Subcommand)]
enum Verb {
    /// Plan a path on a map, a grid or a world of shapes
    Plan(plan::Args),
    /// Play the timed changes of a scenario and plan anew after each
    Replan(replan::Args),
    /// Drive a robot with a sensor through a map it does not know
    Drive(drive::Args),
    /// Walk a robot through a world it does not know, step by step, while things happen there
    Walk(walk::Args),
    /// Plan for several robots at once and choose from a front of plans
    Team(team::Args),
    /// Animate what a planner does, as GIF or as a page with a slider
    Animate(animate::Args),
    /// Run a suite of problems and planners, and report on its runs
    Bench(bench::Args),
    /// Run the experiment of a paper again
    Paper(paper::Args),
    /// Search the weights by which bees walk short ways that arrive
    Tune(tune::Args),
    /// List the planners
    Planners(planners::Args),
    /// Compare all planners on a few maps and draw pictures
    Demo(demo::Args),
    /// Print what a shell needs to complete the program's arguments
    Completions(shell::CompletionsArgs),
    /// Write manual pages, one for the program and one for each verb
    Man(shell::ManArgs),
}

fn main() -> ExitCode {
    let program = match Program::try_parse() {
        Ok(program) => program,
        Err(said) => return tell(&said),
    };
    match act(program.verb) {
        Ok(status) => status.into(),
        Err(failure) => failure.tell(),
    }
}

/// Prints what clap has to say: help, or what is wrong with the arguments.
fn tell(said: &clap::Error) -> ExitCode {
    match said.print() {
        Err(error) if !said.use_stderr() => Failure::from(error).tell(),
        _ => u8::try_from(said.exit_code()).unwrap_or(2).into(),
    }
}

fn act(verb: Verb) -> Result<Status, Failure> {
    let cancel = interrupt::token()?;
    match verb {
        Verb::Plan(args) => plan::act(&args, &cancel),
        Verb::Replan(args) => replan::act(&args, &cancel),
        Verb::Drive(args) => drive::act(&args, &cancel),
        Verb::Walk(args) => walk::act(&args, &cancel),
        Verb::Tune(args) => tune::act(&args, &cancel),
        Verb::Team(args) => team::act(&args, &cancel),
        Verb::Animate(args) => animate::act(&args, &cancel),
        Verb::Bench(args) => bench::act(&args, &cancel),
        Verb::Paper(args) => paper::act(&args, &cancel),
        Verb::Planners(args) => planners::act(&args),
        Verb::Demo(args) => demo::act(&args, &cancel),
        Verb::Completions(args) => shell::completions(&args, Program::command()),
        Verb::Man(args) => shell::man(&args, Program::command()),
    }
}

#[cfg(test)]
mod tests {
    use super::Program;
    use clap::CommandFactory as _;

    #[test]
    fn the_arguments_are_sound() {
        Program::command().debug_assert();
    }
}
