//! Suites: problems, contenders, seeds, budgets, out of a TOML file.

use crate::{
    digest::Digest,
    problem::{self, Reader, SuiteProblem},
};
use pf_core::{Budget, InvalidParams};
use pf_io::{
    FileError,
    toml_tree::{Table, TomlText, Value, nearest},
};
use pf_planners::{AnyEntry, find};
use std::{path::Path, time::Duration};

/// The most runs of a suite.
const MOST_RUNS: usize = 10_000_000;

/// The most choices of parameters of a planner.
const MOST_CHOICES: usize = 10_000;

/// A suite, read and checked.
#[derive(Debug)]
pub struct Suite {
    /// Its name, by which its results are known.
    pub name: String,
    /// What it shows.
    pub title: Option<String>,
    /// What is asked.
    pub problems: Vec<SuiteProblem>,
    /// Who is asked.
    pub contenders: Vec<Contender>,
    /// Whether to run planners that improve their answers a second time, for their improvements.
    pub convergence: bool,
    /// How often each run is made for its times: the least counts.
    pub repetitions: u32,
}

/// A planner with its parameters.
#[derive(Clone, Debug)]
pub struct Contender {
    /// Its name in the list of planners.
    pub planner: String,
    /// What tells it from others with the same planner; empty for one at its defaults.
    pub variant: String,
    /// Its parameters, where they are not the defaults.
    pub settings: Vec<(String, String)>,
    /// The seeds it runs with.
    pub seeds: Vec<u64>,
    /// What a run may take.
    pub limits: Limits,
    /// The problems it takes part in, by their names' beginnings; all if empty.
    pub only: Vec<String>,
}

/// What a run may take; what is not said is not limited.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Limits {
    /// Iterations of the planner's main loop.
    pub iterations: Option<u64>,
    /// Complete attempts.
    pub evaluations: Option<u64>,
    /// Time: results then depend on the machine.
    pub time: Option<Duration>,
}

impl Limits {
    /// As planners are told.
    #[must_use]
    pub fn budget(&self) -> Budget {
        let mut budget = Budget::unlimited();
        if let Some(n) = self.iterations {
            budget = budget.iterations(n);
        }
        if let Some(n) = self.evaluations {
            budget = budget.evaluations(n);
        }
        if let Some(time) = self.time {
            budget = budget.time(time);
        }
        budget
    }
}

/// One run of a suite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Job {
    /// The place of the problem in the suite.
    pub problem: usize,
    /// The place of the contender in the suite.
    pub contender: usize,
    /// The seed.
    pub seed: u64,
    /// Of all that its result and its times depend on, the program's version included.
    pub fingerprint: u64,
}

impl Suite {
    /// Reads a suite and all files it names.
    ///
    /// # Errors
    /// [`FileError`] about the suite or one of its files.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let text = TomlText::read(path)?;
        text.read_with("a suite of problems and planners", |root| {
            suite(path, &root)
        })
    }

    /// Its runs: by problem, seed and contender, so that the runs one compares are near in time.
    #[must_use]
    pub fn jobs(&self) -> Vec<Job> {
        let mut jobs = Vec::new();
        for (p, problem) in self.problems.iter().enumerate() {
            let mut here: Vec<Job> = Vec::new();
            for (c, contender) in self.contenders.iter().enumerate() {
                if !contender.takes_part(problem) {
                    continue;
                }
                let fingerprint = contender.digest(problem, self);
                here.extend(contender.seeds.iter().map(|&seed| Job {
                    problem: p,
                    contender: c,
                    seed,
                    fingerprint: fingerprint.number(seed).value(),
                }));
            }
            here.sort_by_key(|job| (job.seed, job.contender));
            jobs.append(&mut here);
        }
        jobs
    }
}

impl Contender {
    /// Its entry in the list of planners; none if that has none of the name.
    #[must_use]
    pub fn entry(&self) -> Option<&'static dyn AnyEntry> {
        find(&self.planner).ok()
    }

    fn takes_part(&self, problem: &SuiteProblem) -> bool {
        let begins = |only: &String| problem.name.starts_with(only.as_str());
        self.only.is_empty() || self.only.iter().any(begins)
    }

    fn digest(&self, problem: &SuiteProblem, suite: &Suite) -> Digest {
        Digest::default()
            .debug(&env!("CARGO_PKG_VERSION"))
            .number(problem.digest)
            .debug(&(&self.planner, &self.settings, self.limits))
            .debug(&(suite.convergence, suite.repetitions))
    }
}

const TOP_KEYS: [&str; 8] = [
    "name",
    "title",
    "seeds",
    "budget",
    "convergence",
    "repetitions",
    "problem",
    "planner",
];
const PLANNER_KEYS: [&str; 6] = ["name", "variant", "set", "seeds", "budget", "problems"];

fn suite(path: &Path, root: &Table<'_>) -> Result<Suite, FileError> {
    let top = root.with_keys(&TOP_KEYS)?;
    let stem = || path.file_stem().unwrap_or_default().to_string_lossy();
    let name = top.name()?.unwrap_or_else(|| stem().into_owned());
    let seeds = match top.get("seeds") {
        Some(value) => seeds(&value)?,
        None => vec![0],
    };
    let limits = limits(&top)?.unwrap_or_default();
    let convergence = top.get("convergence").map(|value| value.truth());
    let repetitions = match top.get("repetitions") {
        None => 1,
        Some(value) => match value.count("how often a run is made")? {
            n @ 1..=1000 => n,
            _ => return Err(value.error("how often a run is made: 1 to 1000")),
        },
    };
    let problems = problems(path, &top)?;
    let mut contenders: Vec<Contender> = Vec::new();
    let tables = top.tables("planner")?;
    if tables.is_empty() {
        top.needed("planner", "one [[planner]] at least")?;
    }
    for table in &tables {
        let table = table.with_keys(&PLANNER_KEYS)?;
        for contender in planner(&table, &seeds_or(&table, &seeds)?, limits, &problems)? {
            let same = |other: &&Contender| {
                (&other.planner, &other.variant) == (&contender.planner, &contender.variant)
            };
            if contenders.iter().any(|other| same(&other)) {
                let expected = "a \"variant\" that no other entry of this planner has";
                return Err(table.key_error("name", expected));
            }
            contenders.push(contender);
        }
    }
    let seeds = contenders.iter().map(|contender| contender.seeds.len());
    let runs = seeds.sum::<usize>().saturating_mul(problems.len());
    if runs > MOST_RUNS {
        return Err(top.error(format!("{runs} runs"), format!("at most {MOST_RUNS}")));
    }
    Ok(Suite {
        name,
        title: top.string("title")?.map(str::to_owned),
        problems,
        contenders,
        convergence: convergence.transpose()?.unwrap_or(true),
        repetitions,
    })
}

fn problems(path: &Path, top: &Table<'_>) -> Result<Vec<SuiteProblem>, FileError> {
    let tables = top.tables("problem")?;
    if tables.is_empty() {
        top.needed("problem", "one [[problem]] at least")?;
    }
    let mut reader = Reader::new(path);
    let mut problems: Vec<SuiteProblem> = Vec::new();
    for table in &tables {
        let table = table.with_keys(&problem::KEYS)?;
        for problem in reader.problems(&table)? {
            if problems.iter().any(|other| other.name == problem.name) {
                let found = format!("a second problem called \"{}\"", problem.name);
                return Err(table.error(found, "another \"name\""));
            }
            problems.push(problem);
        }
    }
    Ok(problems)
}

/// The contenders of a `[[planner]]`: one, or one for each choice of the parameters that are lists.
fn planner(
    table: &Table<'_>,
    seeds: &[u64],
    top: Limits,
    problems: &[SuiteProblem],
) -> Result<Vec<Contender>, FileError> {
    let name = table.needed("name", "a planner's name")?;
    let entry = find(name.string()?).map_err(|unknown| {
        name.error(match unknown.near() {
            Some(near) => format!("\"{near}\""),
            None if unknown.known().is_empty() => format!("a program that answers; {unknown}"),
            None => format!("one of {}", unknown.known().join(", ")),
        })
    })?;
    let only = only(table, problems)?;
    let given = table.string("variant")?;
    if let (Some(""), Some(value)) = (given, table.get("variant")) {
        return Err(value.error("a name, not an empty string"));
    }
    let limits = limits(table)?.unwrap_or(top);
    let mut choices = vec![(Vec::new(), Vec::new())];
    let set = table.get("set").map(|value| value.table()).transpose()?;
    for (key, value) in set.iter().flat_map(Table::entries) {
        let values = if value.is_array() {
            value.array("values")?.collect()
        } else {
            vec![value]
        };
        if values.is_empty() {
            return Err(value.error("one value at least"));
        }
        let count = choices.len().saturating_mul(values.len());
        if count > MOST_CHOICES || count.saturating_mul(seeds.len()) > MOST_RUNS {
            let what =
                format!("at most {MOST_CHOICES} choices of parameters, and {MOST_RUNS} runs");
            return Err(value.error(what));
        }
        let mut more = Vec::with_capacity(count);
        for (settings, words) in &choices {
            for one in &values {
                let scalar = one.scalar()?;
                let (mut settings, mut words) = (settings.clone(), words.clone());
                // Whoever has a name of its own is told apart by what differs only.
                if given.is_none() || values.len() > 1 {
                    words.push(format!("{key}={scalar}"));
                }
                settings.push((key.to_owned(), scalar));
                more.push((settings, words));
            }
        }
        choices = more;
    }
    if let Some(set) = &set {
        for (settings, _) in &choices {
            check(entry, settings, set)?;
        }
    }
    let contender = |(settings, words): (Vec<_>, Vec<String>)| Contender {
        planner: entry.key().to_owned(),
        variant: given
            .map(str::to_owned)
            .into_iter()
            .chain(words)
            .collect::<Vec<_>>()
            .join(" "),
        settings,
        seeds: seeds.to_vec(),
        limits,
        only: only.clone(),
    };
    Ok(choices.into_iter().map(contender).collect())
}

/// Refuses parameters that the planner does not have or that make no sense.
fn check(
    entry: &dyn AnyEntry,
    settings: &[(String, String)],
    set: &Table<'_>,
) -> Result<(), FileError> {
    let Err(error) = entry.runner(settings).map(drop) else {
        return Ok(());
    };
    Err(match &error {
        InvalidParams::UnknownKey { key, known } => {
            let names = known.iter().map(|key| key.name);
            let expected = match nearest(key, names.clone()) {
                Some(near) => format!("\"{near}\""),
                None if known.is_empty() => format!("none: {} has no parameters", entry.key()),
                None => format!("one of {}", names.collect::<Vec<_>>().join(", ")),
            };
            set.key_error(key, expected)
        }
        InvalidParams::BadValue {
            key,
            value,
            expected,
        } => match set.get(key) {
            Some(found) => one_of_them(found, value).error(format!("{expected} for \"{key}\"")),
            None => set.error(error.to_string(), "parameters that go together"),
        },
        other => set.error(other.to_string(), "parameters that go together"),
    })
}

/// The member of a list that reads so, else the whole.
fn one_of_them<'v>(value: Value<'v>, text: &str) -> Value<'v> {
    let mut members = value.array("").into_iter().flatten();
    let found = members.find(|member| member.scalar().is_ok_and(|scalar| scalar == text));
    found.unwrap_or(value)
}

fn only(table: &Table<'_>, problems: &[SuiteProblem]) -> Result<Vec<String>, FileError> {
    let Some(value) = table.get("problems") else {
        return Ok(Vec::new());
    };
    let mut only = Vec::new();
    for value in problem::some(&value, "the beginnings of problems' names")? {
        let begins = value.string()?;
        if !problems
            .iter()
            .any(|problem| problem.name.starts_with(begins))
        {
            let names = problems.iter().map(|problem| problem.name.as_str());
            return Err(value.error(match nearest(begins, names) {
                Some(near) => format!("\"{near}\""),
                None => "what the name of a [[problem]] begins with".to_owned(),
            }));
        }
        only.push(begins.to_owned());
    }
    Ok(only)
}

fn seeds_or(table: &Table<'_>, seeds_of_all: &[u64]) -> Result<Vec<u64>, FileError> {
    let own = table.get("seeds").map(|value| seeds(&value));
    Ok(own.transpose()?.unwrap_or_else(|| seeds_of_all.to_vec()))
}

/// So many from 0, or a list.
fn seeds(value: &Value<'_>) -> Result<Vec<u64>, FileError> {
    const WHAT: &str = "how many seeds, from 1 to 1000000, or a list of different ones";
    let whole = |value: &Value<'_>| {
        let number = value.index().and_then(|n| u64::try_from(n).ok());
        number.ok_or_else(|| value.error(WHAT))
    };
    if !value.is_array() {
        return match whole(value)? {
            n @ 1..=1_000_000 => Ok((0..n).collect()),
            _ => Err(value.error(WHAT)),
        };
    }
    let mut seeds: Vec<u64> = Vec::new();
    for value in value.array("seeds")? {
        let seed = whole(&value)?;
        if seeds.contains(&seed) {
            return Err(value.error("a seed that is not in the list yet"));
        }
        seeds.push(seed);
    }
    if seeds.is_empty() {
        return Err(value.error(WHAT));
    }
    Ok(seeds)
}

fn limits(table: &Table<'_>) -> Result<Option<Limits>, FileError> {
    let Some(value) = table.get("budget") else {
        return Ok(None);
    };
    let table = value.table()?;
    let table = table.with_keys(&["iterations", "evaluations", "time"])?;
    let count = |key, what: &str| -> Result<Option<u64>, FileError> {
        let Some(value) = table.get(key) else {
            return Ok(None);
        };
        match value.index().and_then(|n| u64::try_from(n).ok()) {
            Some(n @ 1..) => Ok(Some(n)),
            _ => Err(value.error(format!("{what}: a whole number from 1"))),
        }
    };
    let time = table.get("time").map(|value| {
        let time = humantime::parse_duration(value.string()?);
        let positive = time.ok().filter(|time| !time.is_zero());
        positive.ok_or_else(|| value.error("a time such as \"50ms\", \"2s\" or \"1m\""))
    });
    Ok(Some(Limits {
        iterations: count("iterations", "iterations")?,
        evaluations: count("evaluations", "evaluations")?,
        time: time.transpose()?,
    }))
}
