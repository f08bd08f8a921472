//! `pf animate`: what a planner does, as a film.

mod drive;
pub(crate) mod replay;
pub(crate) mod search;
pub(crate) mod team;
mod walk;

use crate::{
    args::{PlannerArgs, QuestionArgs},
    failure::{Failure, Status},
    question,
};
use pf_core::CancelToken;
use pf_io::{FileKind, kind_of, read_world, write_whole};
use pf_moabc::Preference;
use pf_planners::{AnyEntry, team_planners};
use pf_render::Film;
use std::{
    io::{Write, stderr},
    path::{Path, PathBuf},
    str::FromStr,
};

/// Animate what a planner does, as GIF or as a page with a slider.
///
/// What is shown depends on the question. On a map or in a world: the search, then the answer, driven
/// from start to goal. A scenario with events is played, and every plan anew is shown. With --sensor
/// a robot drives through a grid that it does not know, and sees. The bees (abc) walk through a world
/// that they do not know. A world with several robots is planned for as a team, and the preferred
/// plan is driven.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf animate maps/grids/redlarski/mosaic-100.map --from 2,54 --to 97,54 -o astar.gif
  pf animate maps/grids/redlarski/mosaic-100.map --from 2,54 --to 97,54 --planner aco-star -o ants.html
  pf animate maps/worlds/yard.toml --from 5,5 --to 105,71 --radius 0.6 --planner lbfgs -o lbfgs.gif
  pf animate maps/scenarios/closing-doors.toml -o doors.gif --frames 120
  pf animate maps/grids/redlarski/maze-100.map --sensor 10 -o drive.gif
  pf animate maps/scenarios/busy-square.toml --planner abc -o bees.gif
  pf animate maps/scenarios/three-robots.toml --prefer safety -o team.html")]
pub(crate) struct Args {
    /// A map, a world or a scenario
    pub(crate) map: PathBuf,
    /// The file to write: .gif, or .html for a page with a slider that needs nothing else
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub(crate) out: PathBuf,
    /// How many frames
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = clap::value_parser!(u16).range(2..=5000),
        help_heading = "Output")]
    pub(crate) frames: u16,
    /// Width and height in pixels; of a page, those that the map has at most
    #[arg(
        long,
        value_name = "WxH",
        default_value = "480x360",
        help_heading = "Output"
    )]
    pub(crate) size: Size,
    /// Frames a second
    #[arg(long, value_name = "N", default_value_t = 12.0, value_parser = fps, help_heading = "Output")]
    pub(crate) fps: f64,
    #[command(flatten)]
    pub(crate) question: QuestionArgs,
    /// Drive with a sensor of this radius in cells through a grid that the robot does not know
    #[arg(long, value_name = "R", value_parser = crate::drive::radius, allow_negative_numbers = true,
        help_heading = "Question")]
    pub(crate) sensor: Option<f64>,
    #[command(flatten)]
    pub(crate) planner: PlannerArgs,
    /// For a team: stop after so many plans
    #[arg(long, value_name = "N", help_heading = "Planner")]
    pub(crate) evaluations: Option<u64>,
    /// For a team: which plan to show: length, safety, smooth, knee
    #[arg(long, value_name = "WHAT", default_value_t, help_heading = "Question")]
    pub(crate) prefer: Preference,
}

/// Width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size(pub(crate) [u16; 2]);

impl FromStr for Size {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let side = |text: &str| -> Option<u16> {
            let side = text.parse().ok()?;
            (120..=4096).contains(&side).then_some(side)
        };
        let parse = || {
            let (width, height) = text.split_once('x')?;
            Some(Self([side(width)?, side(height)?]))
        };
        parse().ok_or("a size is written 480x360: width and height in pixels, from 120 to 4096")
    }
}

fn fps(text: &str) -> Result<f64, &'static str> {
    let fps = text.parse().ok();
    fps.filter(|fps: &f64| (0.1..=50.0).contains(fps))
        .ok_or("frames a second are a number from 0.1 to 50")
}

/// What a file ends in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Gif,
    Html,
}

/// A film, and how what it shows ended.
pub(crate) type Shown = (Film, Status);

pub(crate) fn act(args: &Args, cancel: &CancelToken) -> Result<Status, Failure> {
    let form = form(&args.out)?;
    has_folder(&args.out)?;
    let (film, status) = film(args, cancel)?;
    if cancel.is_cancelled() {
        return Ok(Status::Interrupted);
    }
    let bytes = match form {
        Form::Gif => {
            let gif = film.gif_while(args.size.0, args.fps, || !cancel.is_cancelled());
            if cancel.is_cancelled() {
                return Ok(Status::Interrupted);
            }
            gif.map_err(|error| Failure::Internal(error.to_string()))?
        }
        Form::Html => film.html(args.size.0, args.fps).into_bytes(),
    };
    let stored = write_whole(&args.out, |out| out.write_all(&bytes));
    stored.map_err(|error| Failure::unwritten(&error))?;
    let (frames, place, size) = (
        film.frames(),
        args.out.display(),
        bytes.len().div_ceil(1024),
    );
    writeln!(stderr(), "{place}: {frames} frames, {size} KiB")?;
    Ok(status)
}

fn form(out: &Path) -> Result<Form, Failure> {
    let ending = out.extension().and_then(|ending| ending.to_str());
    match ending.map(str::to_ascii_lowercase).as_deref() {
        Some("gif") => Ok(Form::Gif),
        Some("html" | "htm") => Ok(Form::Html),
        _ => {
            let message = format!("--out {}: not the name of an animation", out.display());
            Err(Failure::usage(message).help("names end in .gif or .html"))
        }
    }
}

/// Says before any work is done that a file cannot be written where there is no folder.
fn has_folder(out: &Path) -> Result<(), Failure> {
    let folder = out.parent().filter(|folder| *folder != Path::new(""));
    match folder {
        Some(folder) if !folder.is_dir() => {
            let (file, folder) = (out.display(), folder.display());
            let message = format!("{file} cannot be written: there is no folder {folder}");
            Err(Failure::Internal(message))
        }
        _ => Ok(()),
    }
}

/// The film that fits the question.
fn film(args: &Args, cancel: &CancelToken) -> Result<Shown, Failure> {
    let kind = kind_of(&args.map)?;
    let asked = args.planner.planner.as_deref();
    if let Some(sensor) = args.sensor {
        return drive::film(args, sensor, cancel);
    }
    if kind == FileKind::World && args.question.case.is_none() && args.question.from.is_none() {
        let for_teams = asked.is_some_and(|key| team_planners().any(|e| e.key() == key));
        let several = || Ok::<_, Failure>(read_world(&args.map)?.robots.len() > 1);
        if for_teams || asked.is_none() && several()? {
            return team::act(args, cancel);
        }
    }
    let default = if question::is_about_a_world(kind) {
        "visibility-graph"
    } else if question::is_scenario(kind) {
        "d-star-lite"
    } else {
        "astar"
    };
    let entry: &'static dyn AnyEntry = args.planner.entry(default)?;
    let question = question::one(&args.map, &args.question)?;
    if entry.key() == "abc" && question::is_about_a_world(kind) {
        return walk::film(args, &question, cancel);
    }
    let mut runner = args.planner.runner(entry, &[])?;
    let search = search::Search {
        entry,
        planner: &args.planner,
        cancel,
        frames: usize::from(args.frames),
    };
    if question.events.is_empty() {
        let (film, answer) = search::search(&search, &question, runner.as_mut())?;
        return Ok((film, crate::report::status(&answer)));
    }
    replay::replay(&search, question, runner.as_mut())
}

/// Name and parameters of a film in a line.
pub(crate) fn title(
    planner: &str,
    question: &question::Question,
    words: &str,
    seed: u64,
) -> String {
    let file = Path::new(&question.file);
    let name = file.file_name().map_or_else(
        || question.file.clone(),
        |name| name.to_string_lossy().into_owned(),
    );
    let case = question.case.as_ref();
    let case = case.map(|case| format!(", {case}")).unwrap_or_default();
    format!("{planner} on {name}{case}: {words}, seed {seed}")
}

/// Which of `steps` things, the last included, the frame `k` of `frames` shows.
pub(crate) fn step_of(k: usize, frames: usize, steps: usize) -> usize {
    let last = steps.saturating_sub(1);
    (k * last + (frames - 1) / 2) / (frames - 1).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read() {
        assert_eq!("480x360".parse(), Ok(Size([480, 360])));
        for wrong in [
            "",
            "480",
            "480x",
            "0x9",
            "480x360x2",
            "9999x9999",
            "-480x360",
        ] {
            assert!(wrong.parse::<Size>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn frames_go_from_the_first_step_to_the_last() {
        let steps =
            |frames, steps| -> Vec<_> { (0..frames).map(|k| step_of(k, frames, steps)).collect() };
        assert_eq!(steps(5, 9), [0, 2, 4, 6, 8]);
        assert_eq!(steps(4, 2), [0, 0, 1, 1]);
        assert_eq!(steps(3, 1), [0, 0, 0]);
    }
}
