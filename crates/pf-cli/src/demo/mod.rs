//! `pf demo`: all planners on a grid, in a world and for a team.

mod page;
mod shows;

use crate::{
    animate::{
        replay,
        search::{Search, Seen, words},
        team::film,
    },
    args::PlannerArgs,
    failure::{Failure, Status},
    plan::draw,
    question::Question,
    report::{Told, length, status},
    text, view,
    view::Shown,
};
use comfy_table::{CellAlignment, Table, presets};
use page::Page;
use pf_core::{Budget, CancelToken, Context, Report};
use pf_geom::TeamProblem;
use pf_io::{make_folder, write_whole};
use pf_moabc::Preference;
use pf_planners::{Answer, AnyEntry, Entry, Order, Runner, all, find, team_planners};
use pf_render::{Film, Found};
use shows::{PLAYS, Play, SHOWS, Show};
use std::{
    io::{Write, stdout},
    path::PathBuf,
    time::Duration,
};

/// Compare all planners on a grid, in a world and for a team, and write a report.
///
/// The report is one page that needs nothing else: DIR/report.html. Every path is drawn over its map,
/// searches and swarms play as animations, replanning is shown before and after, and a point of the
/// team's front shows its plan. DIR also has a picture of every path, as SVG.
///
/// The maps are part of the program. Planners that never know that they are done stop after 60 ms, and
/// planners for teams after 5,000 evaluations: enough to see what they do, not what they can do.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  pf demo
  pf demo --out /tmp/pictures")]
pub(crate) struct Args {
    /// Where report and pictures go
    #[arg(long, value_name = "DIR", default_value = "demo")]
    out: PathBuf,
}

const REPETITIONS: usize = 3;
/// What the table's times are.
const TIMES: &str = "Others have the best of three runs, each made anew: tables and graphs of the map \
                     that they prepare are in their times.";
/// For planners that never know that they are done.
const PATIENCE: Duration = Duration::from_millis(60);
/// For planners of teams.
const EVALUATIONS: &str = "5000";
/// Frames of a planner's film, and of a scenario's.
const FRAMES: usize = 24;
const PLAY_FRAMES: usize = 45;

/// The cells of a row of a table.
type Row = Vec<String>;

const HEADER: [&str; 6] = [
    "map",
    "planner",
    "found",
    "length",
    "% over shortest",
    "time",
];
const TEAM_HEADER: [&str; 7] = [
    "team", "planner", "found", "plans", "shortest", "clearest", "time",
];

pub(crate) fn act(args: &Args, cancel: &CancelToken) -> Result<Status, Failure> {
    make_folder(&args.out).map_err(|error| Failure::unwritten(&error))?;
    let mut page = Page::begin();
    let mut rows = Vec::new();
    for show in SHOWS {
        let Some(found) = show.act(args, &mut page, cancel)? else {
            return Ok(Status::Interrupted);
        };
        rows.extend(found);
    }
    let team = team(&mut page, cancel)?;
    for play in PLAYS {
        play.act(&mut page, cancel)?;
    }
    if cancel.is_cancelled() {
        return Ok(Status::Interrupted);
    }
    let report = args.out.join("report.html");
    let stored = write_whole(&report, |out| out.write_all(page.end().as_bytes()));
    stored.map_err(|error| Failure::unwritten(&error))?;
    let mut out = stdout().lock();
    writeln!(out, "{}", table(&HEADER, 3, &rows))?;
    writeln!(out, "{}", table(&TEAM_HEADER, 3, &team))?;
    let (count, place) = (rows.len(), args.out.display());
    writeln!(
        out,
        "Planners for teams had {EVALUATIONS} evaluations, those that never know that they are done {} ms.",
        PATIENCE.as_millis()
    )?;
    writeln!(out, "{TIMES}")?;
    writeln!(
        out,
        "{count} pictures are in {place}/; open {}",
        report.display()
    )?;
    Ok(Status::Done)
}

/// A table whose columns from some one on are numbers.
fn table(header: &[&str], numbers: usize, rows: &[Row]) -> Table {
    let mut table = Table::new();
    table
        .load_style(presets::UTF8_FULL_CONDENSED)
        .set_header(header);
    for column in table.column_iter_mut().skip(numbers) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let mut before = "";
    for row in rows {
        let mut cells: Vec<&str> = row.iter().map(String::as_str).collect();
        // A map is named once.
        if cells[0] == std::mem::replace(&mut before, row[0].as_str()) {
            cells[0] = "";
        }
        table.add_row(cells);
    }
    table
}

impl Show {
    /// Plans with every planner; `None` if somebody pressed Ctrl-C.
    fn act(
        &self,
        args: &Args,
        page: &mut Page,
        cancel: &CancelToken,
    ) -> Result<Option<Vec<Row>>, Failure> {
        let question = Question::of(self.name, (self.scene)()?);
        let (mut answers, mut films) = (Vec::new(), Vec::new());
        for entry in all() {
            let (film, answer) = self.plan(entry, &question, args, cancel)?;
            if status(&answer) == Status::Interrupted {
                return Ok(None);
            }
            answers.push((entry, answer));
            films.push(film);
        }
        let rows = rows(self, &answers);
        page.heading(
            &format!("All planners on one map: {}", self.name),
            self.about,
        );
        page.table(&HEADER, &rows);
        page.cards(&films);
        Ok(Some(rows))
    }

    /// Plans, films and draws. The time told of one that ends by itself is the best of a few,
    /// without the listener that a film needs. Each is of a planner made anew, as in suites: what it
    /// prepares of a map is part of its time.
    fn plan(
        &self,
        entry: &dyn AnyEntry,
        question: &Question,
        args: &Args,
        cancel: &CancelToken,
    ) -> Result<(Film, Answer), Failure> {
        let claims = entry.claims();
        let ends = claims.complete || claims.optimal;
        let planner = PlannerArgs {
            settings: settings(entry),
            time: (!ends).then_some(PATIENCE),
            ..PlannerArgs::default()
        };
        let mut runner = planner.runner(entry, &[])?;
        let search = Search {
            entry,
            planner: &planner,
            cancel,
            frames: FRAMES,
        };
        let scene = &question.scene;
        let plan = |runner: &mut dyn Runner, order: Order<'_>| runner.plan(scene, order);
        let seen = search.reel(scene, view::ground(scene), FRAMES, runner.as_mut(), plan)?;
        let Seen {
            reel,
            mut answer,
            recorder,
        } = seen;
        if ends {
            for _ in 0..REPETITIONS {
                let mut anew = planner.runner(entry, &[])?;
                let again = anew.plan(scene, planner.order(cancel, None))?;
                answer.stats.elapsed = answer.stats.elapsed.min(again.stats.elapsed);
            }
        }
        let title = format!(
            "{}: {}, seed 0",
            runner.name(),
            words(entry, scene, &answer)
        );
        let told = Told {
            entry,
            question,
            seed: 0,
            notes: Vec::new(),
            nearest: None,
            answer,
        };
        let picture = told.picture(&Shown {
            recorder: &recorder,
            raster: runner.raster(),
            expanded: true,
            graph: true,
            clearance: false,
        });
        let file = args.out.join(format!("{}-{}", self.name, entry.key()));
        draw(&picture, Some(&file.with_extension("svg")), None)?;
        Ok((Film::new(title, vec![reel]), told.answer))
    }
}

/// Planners for teams work until they have made so many plans.
fn settings(entry: &dyn AnyEntry) -> Vec<(String, String)> {
    let takes = entry
        .parameters()
        .iter()
        .any(|key| key.name == "evaluations");
    let setting = ("evaluations".to_owned(), EVALUATIONS.to_owned());
    takes.then_some(setting).into_iter().collect()
}

/// A row per planner; the shortest is what some planner found, and proved if one proves.
fn rows(show: &Show, answers: &[(&dyn AnyEntry, Answer)]) -> Vec<Row> {
    let lengths = answers
        .iter()
        .filter_map(|(_, a)| a.lines.first().map(length));
    let shortest = lengths.fold(f64::INFINITY, f64::min);
    let row = |(entry, answer): &(&dyn AnyEntry, Answer)| {
        let (found, over) = match answer.lines.first().map(length) {
            Some(length) => {
                let over = 100.0 * (length / shortest - 1.0);
                (text::number(length), format!("{over:.2}"))
            }
            None => ("-".to_owned(), "-".to_owned()),
        };
        let time = text::time(answer.stats.elapsed);
        let name = show.name.to_owned();
        vec![
            name,
            entry.name(),
            answer.outcome.to_owned(),
            found,
            over,
            time,
        ]
    };
    answers.iter().map(row).collect()
}

/// The planners for teams, their fronts, and a plan that is driven.
fn team(page: &mut Page, cancel: &CancelToken) -> Result<Vec<Row>, Failure> {
    let problem = shows::robots()?;
    let mut answers: Vec<(String, Report<TeamProblem>)> = Vec::new();
    for entry in team_planners() {
        let internal = |error: &dyn std::fmt::Display| Failure::Internal(error.to_string());
        let any: &Entry<TeamProblem> = entry;
        let mut planner = any.make(&settings(entry)).map_err(|e| internal(&e))?;
        let budget = Budget::unlimited().cancel(cancel);
        let mut cx = Context::seeded(0).within(budget);
        let report = planner.plan(&problem, &mut cx).map_err(|e| internal(&e))?;
        answers.push((AnyEntry::name(entry), report));
    }
    let row = |(name, report): &(String, Report<TeamProblem>)| {
        let costs = report
            .outcome
            .solved()
            .map_or(&[][..], |s| s.cost.members());
        let least = |k: usize| costs.iter().map(|c| c[k]).min_by(f64::total_cmp);
        let number = |x: Option<f64>| x.map_or("-".to_owned(), text::number);
        vec![
            "three robots".to_owned(),
            name.clone(),
            report.outcome.word().to_owned(),
            costs.len().to_string(),
            number(least(0)),
            number(least(1).map(|danger| problem.ease() - danger)),
            text::time(report.stats.elapsed),
        ]
    };
    let rows: Vec<Row> = answers.iter().map(row).collect();
    let fronts: Vec<Found<'_>> = answers
        .iter()
        .filter_map(|(name, report)| {
            let solved = report.outcome.solved()?;
            Some(Found {
                name: name.clone(),
                plans: &solved.solution,
                costs: &solved.cost,
            })
        })
        .collect();
    page.heading(
        "A team of three robots: fronts of plans",
        &format!(
            "Short, safe or smooth: no plan is best in all. Each planner had {EVALUATIONS} \
             evaluations (prioritised planning makes one plan). Small is good; point at a plan, touch \
             it, or use the arrow keys."
        ),
    );
    page.table(&TEAM_HEADER, &rows);
    let knee = fronts
        .first()
        .and_then(|f| Preference::Knee.choose(f.costs.members()));
    if let (Some(knee), Some(found)) = (knee, fronts.first()) {
        page.fronts(&problem, &fronts, (0, knee));
        let title = format!(
            "{}: the plan at the knee of its front, driven, seed 0",
            found.name
        );
        page.film(&film(
            title,
            &problem,
            &found.plans.members()[knee],
            PLAY_FRAMES,
        ));
    }
    Ok(rows)
}

impl Play {
    /// Plays a scenario, and shows it before and after.
    fn act(&self, page: &mut Page, cancel: &CancelToken) -> Result<(), Failure> {
        let Some(question) = (self.question)()? else {
            return Ok(());
        };
        let entry = find(self.planner).map_err(|error| Failure::Internal(error.to_string()))?;
        let planner = PlannerArgs::default();
        let mut runner = planner.runner(entry, &[])?;
        let search = Search {
            entry,
            planner: &planner,
            cancel,
            frames: PLAY_FRAMES,
        };
        let (film, _) = replay::replay(&search, question, runner.as_mut())?;
        page.heading(&format!("Planning anew: {}", self.name), self.about);
        let last = film.reels().saturating_sub(1);
        let stills = [(0, "Before: the first plan"), (last, "After: the last")];
        let stills = stills.map(|(reel, title)| film.still(reel, title));
        page.cards(&stills.into_iter().flatten().collect::<Vec<_>>());
        page.film(&film);
        Ok(())
    }
}
