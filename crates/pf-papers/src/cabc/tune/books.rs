//! What has been run, in memory and in a file.

use super::{Job, Score, Search};
use crate::PaperError;
use pf_core::Clock;
use pf_io::write_whole;
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, fs, io, path::PathBuf, time::Duration};

/// How often the file is written anew.
const PAUSE: Duration = Duration::from_secs(1);

/// Scores by point and seeds.
pub(super) struct Books {
    file: Option<PathBuf>,
    content: Content,
    clock: Clock,
    written: Duration,
    fresh: bool,
}

#[derive(Serialize, Deserialize)]
struct Content {
    /// What was searched, in words.
    search: String,
    done: Vec<Entry>,
    #[serde(skip)]
    by_job: BTreeMap<(usize, u32, u32), Score>,
}

#[derive(Serialize, Deserialize)]
struct Entry {
    point: usize,
    seeds: [u32; 2],
    score: Score,
}

/// Numbers to the last bit, which their decimals may not keep.
pub(super) mod bits {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde wants it")]
    pub(in super::super) fn serialize<S: Serializer>(x: &f64, to: S) -> Result<S::Ok, S::Error> {
        x.to_bits().serialize(to)
    }

    pub(in super::super) fn deserialize<'a, D: Deserializer<'a>>(from: D) -> Result<f64, D::Error> {
        u64::deserialize(from).map(f64::from_bits)
    }
}

impl Books {
    /// The books of a search, with what its file says if there is one.
    pub(super) fn open(search: &Search) -> Result<Self, PaperError> {
        let Search {
            problem,
            params,
            grid,
            runs,
            fresh,
            ..
        } = search;
        let (start, goal) = (problem.start(), problem.goal());
        let words = format!(
            "{}: {} shapes, {start} to {goal}, radius {}; {params:?}; {grid:?}; {runs} runs, {fresh} fresh",
            search.world,
            problem.world().shapes().count(),
            problem.radius(),
        );
        let mut content = Content {
            search: words,
            done: Vec::new(),
            by_job: BTreeMap::new(),
        };
        if let Some(file) = search.file.as_ref().filter(|file| file.exists()) {
            let broken = |what: &str| PaperError::Data(format!("{}: {what}", file.display()));
            let text = fs::read_to_string(file).map_err(|error| broken(&error.to_string()))?;
            let read: Content = serde_json::from_str(&text)
                .map_err(|error| broken(&format!("no file of `pf tune`: {error}")))?;
            if read.search != content.search {
                let message = format!(
                    "it is of another search:\n  there: {}\n  here:  {}",
                    read.search, content.search
                );
                return Err(broken(&message));
            }
            content.done = read.done;
        }
        for Entry {
            point,
            seeds,
            score,
        } in &content.done
        {
            content.by_job.insert((*point, seeds[0], seeds[1]), *score);
        }
        let clock = Clock::default();
        let mut books = Self {
            file: search.file.clone(),
            content,
            clock,
            written: clock.now(),
            // A file that cannot be written is known before anything is run.
            fresh: true,
        };
        books.save()?;
        Ok(books)
    }

    pub(super) fn score(&self, (point, seeds): &Job) -> Option<Score> {
        let key = (*point, seeds.start, seeds.end);
        self.content.by_job.get(&key).copied()
    }

    pub(super) fn enter(&mut self, (point, seeds): &Job, score: Score) -> Result<(), PaperError> {
        let seeds = [seeds.start, seeds.end];
        let key = (*point, seeds[0], seeds[1]);
        if self.content.by_job.insert(key, score).is_none() {
            let point = *point;
            self.content.done.push(Entry {
                point,
                seeds,
                score,
            });
            self.fresh = true;
        }
        if self.clock.now().saturating_sub(self.written) > PAUSE {
            self.save()?;
        }
        Ok(())
    }

    /// Writes the file, whole or not at all, if there is anything new.
    pub(super) fn save(&mut self) -> Result<(), PaperError> {
        self.written = self.clock.now();
        let Some(file) = self.file.as_ref().filter(|_| self.fresh) else {
            return Ok(());
        };
        let text = serde_json::to_string(&self.content)
            .map_err(|error| PaperError::Data(error.to_string()))?;
        write_whole(file, |out| io::Write::write_all(out, text.as_bytes()))?;
        self.fresh = false;
        Ok(())
    }
}
