//! The inverse problem (eq. 11): which weights of a grid lead to short walks that arrive.
//!
//! Brute force as in the paper, and beside it a race (successive halving, Jamieson and Talwalkar
//! 2016), in which only the better points of the grid get more runs. Both winners walk again by
//! seeds that nobody was chosen by. What has been run is kept in a file, if one is named, and not run
//! again.

mod books;
mod text;

pub use text::text;

use super::walk;
use crate::{PaperError, parallel::spread, statistics::wilson};
use books::Books;
use pf_abc::AbcParams;
use pf_core::CancelToken;
use pf_geom::WorldProblem;
use serde::{Deserialize, Serialize};
use std::{num::NonZeroUsize, ops::Range, path::PathBuf};

/// Seeds from here on chose nobody.
const FRESH: u32 = 1_000_000;
/// Walked by one thread at a time.
const PIECE: u32 = 10;
/// What share of the points goes on after a leg of the race, and by how many times more each has
/// run then.
const THIRD: usize = 3;
/// Runs in the first leg.
const FIRST_LEG: u32 = 3;

/// A search.
#[derive(Clone, Debug)]
pub struct Search {
    /// What the world is called; a file of another is refused.
    pub world: String,
    /// Where to walk.
    pub problem: WorldProblem,
    /// How, but for the weights.
    pub params: AbcParams,
    /// Values of w1, w2 and w3, each with each.
    pub grid: [Vec<f64>; 3],
    /// Runs of each point, K.
    pub runs: u32,
    /// Runs of the winners by fresh seeds.
    pub fresh: u32,
    /// How many threads; nothing depends on it.
    pub threads: NonZeroUsize,
    /// Keeps what has been run.
    pub file: Option<PathBuf>,
    /// Stops it.
    pub cancel: CancelToken,
}

/// What some runs at a point came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Score {
    /// How many runs.
    pub runs: u32,
    /// How many arrived.
    pub target: u32,
    /// How long the ways of these were, in all.
    #[serde(with = "books::bits")]
    pub length: f64,
}

impl Score {
    fn and(self, other: Self) -> Self {
        Self {
            runs: self.runs + other.runs,
            target: self.target + other.target,
            length: self.length + other.length,
        }
    }

    /// The mean length by one more than the number that arrived of `of` runs (eq. 11); infinite if
    /// none did.
    #[must_use]
    pub fn value(&self, of: u32) -> f64 {
        if self.target == 0 {
            return f64::INFINITY;
        }
        let target = f64::from(self.target);
        let mean = self.length / target;
        mean / (target / f64::from(self.runs) * f64::from(of) + 1.0)
    }
}

/// A point of the grid that was chosen.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Chosen {
    /// `grid` or `race`.
    pub method: &'static str,
    /// Runs it took to choose.
    pub runs: u32,
    /// w1, w2, w3.
    pub weights: [f64; 3],
    /// By the seeds it was chosen by.
    pub chosen_by: Score,
    /// The same, to read: the score of so many runs.
    pub in_sample: f64,
    /// By fresh seeds.
    pub fresh: Score,
    /// The same, by as many runs.
    pub out_of_sample: f64,
    /// In which interval the rate of arrivals lies by the fresh seeds.
    pub arrives: [f64; 2],
}

/// What came of a search.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Found {
    /// How many points the grid has.
    pub points: usize,
    /// By brute force.
    pub grid: Chosen,
    /// By the race.
    pub race: Chosen,
}

impl Search {
    /// Every point of the grid.
    #[must_use]
    pub fn points(&self) -> Vec<[f64; 3]> {
        let [first, second, third] = &self.grid;
        let mut points = Vec::new();
        for &w1 in first {
            for &w2 in second {
                points.extend(third.iter().map(|&w3| [w1, w2, w3]));
            }
        }
        points
    }

    /// Searches both ways; `tell` is told how many runs of how many are done, and of what.
    ///
    /// # Errors
    /// [`PaperError::Interrupted`] if somebody asked to stop, with what was run in the file;
    /// [`PaperError::Data`] if the file is of another search or the parameters make no sense,
    /// [`PaperError::File`] if it cannot be read or written.
    pub fn run(&self, tell: &mut dyn FnMut(u64, u64, &str)) -> Result<Found, PaperError> {
        let points = self.points();
        if points.is_empty() {
            return Err(PaperError::Data("the grid has no point".to_owned()));
        }
        let mut books = Books::open(self)?;
        let everything: Vec<Job> = (0..points.len()).map(|k| (k, 0..self.runs)).collect();
        let scores = self.evaluate(&points, &everything, &mut books, "grid", tell)?;
        let best = best_of(&scores, self.runs);
        let brute = (best, scores[best], total(&everything));

        let race = self.race(&points, &mut books, tell)?;
        // In pieces, so that there is work for every thread.
        let ends = FRESH + self.fresh;
        let pieces = (FRESH..ends).step_by(PIECE as usize);
        let pieces: Vec<_> = pieces.map(|from| from..ends.min(from + PIECE)).collect();
        let mut winners = vec![brute.0, race.0];
        winners.dedup();
        let jobs = winners
            .iter()
            .flat_map(|&k| pieces.iter().map(move |seeds| (k, seeds.clone())));
        let jobs: Vec<Job> = jobs.collect();
        let scores = self.evaluate(&points, &jobs, &mut books, "fresh seeds", tell)?;
        let sum = |k: usize| {
            let of_k = jobs
                .iter()
                .zip(&scores)
                .filter(|((point, _), _)| *point == k);
            of_k.fold(Score::default(), |sum, (_, piece)| sum.and(*piece))
        };
        let again = [sum(brute.0), sum(race.0)];
        let chosen = |method, (k, score, runs): (usize, Score, u32), fresh: Score| Chosen {
            method,
            runs,
            weights: points[k],
            chosen_by: score,
            in_sample: score.value(self.runs),
            fresh,
            out_of_sample: fresh.value(self.runs),
            arrives: wilson(fresh.target, fresh.runs),
        };
        Ok(Found {
            points: points.len(),
            grid: chosen("grid", brute, again[0]),
            race: chosen("race", race, again[1]),
        })
    }

    /// Legs of 3, 9, 27 … runs, up to all; after each the best third goes on.
    fn race(
        &self,
        points: &[[f64; 3]],
        books: &mut Books,
        tell: &mut dyn FnMut(u64, u64, &str),
    ) -> Result<(usize, Score, u32), PaperError> {
        let mut field: Vec<(usize, Score)> =
            (0..points.len()).map(|k| (k, Score::default())).collect();
        let (mut from, mut taken) = (0, 0);
        loop {
            let to = match from {
                0 => FIRST_LEG,
                from => from * 3,
            };
            let to = to.min(self.runs);
            let jobs: Vec<Job> = field.iter().map(|&(k, _)| (k, from..to)).collect();
            taken += total(&jobs);
            let what = format!("race, {} points", field.len());
            let scores = self.evaluate(points, &jobs, books, &what, tell)?;
            for ((_, sum), score) in field.iter_mut().zip(scores) {
                *sum = sum.and(score);
            }
            field.sort_by(|a, b| {
                let values = a.1.value(self.runs).total_cmp(&b.1.value(self.runs));
                values.then(a.0.cmp(&b.0))
            });
            if to == self.runs {
                return Ok((field[0].0, field[0].1, taken));
            }
            field.truncate(field.len().div_ceil(THIRD));
            from = to;
        }
    }

    /// What these runs come to, from the books or by running.
    fn evaluate(
        &self,
        points: &[[f64; 3]],
        jobs: &[Job],
        books: &mut Books,
        what: &str,
        tell: &mut dyn FnMut(u64, u64, &str),
    ) -> Result<Vec<Score>, PaperError> {
        let open: Vec<&Job> = jobs
            .iter()
            .filter(|job| books.score(job).is_none())
            .collect();
        let all: u64 = jobs.iter().map(|(_, seeds)| seeds.len() as u64).sum();
        let left: u64 = open.iter().map(|(_, seeds)| seeds.len() as u64).sum();
        let mut done = all - left;
        let mut failed = None;
        tell(done, all, what);
        spread(
            self.threads,
            open.len(),
            |k| self.score(points[open[k].0], open[k].1.clone()),
            |k, score| {
                let saved = score.and_then(|score| match score {
                    Some(score) => books.enter(open[k], score),
                    None => Err(PaperError::Interrupted),
                });
                done += open[k].1.len() as u64;
                tell(done, all, what);
                if let Err(error) = saved
                    && failed.is_none()
                {
                    failed = Some(error);
                }
                failed.is_none()
            },
        );
        books.save()?;
        match failed {
            Some(error) => Err(error),
            None => Ok(jobs.iter().filter_map(|job| books.score(job)).collect()),
        }
    }

    /// None if somebody asked to stop.
    fn score(&self, weights: [f64; 3], seeds: Range<u32>) -> Result<Option<Score>, PaperError> {
        let params = self.params.clone().weighing(weights);
        let mut score = Score::default();
        for seed in seeds {
            if self.cancel.is_cancelled() {
                return Ok(None);
            }
            let trip = walk(&self.problem, &params, seed.into())?;
            score.runs += 1;
            if trip.arrived {
                score.target += 1;
                score.length += trip.length();
            }
        }
        Ok(Some(score))
    }
}

/// A point of the grid by its place, and the seeds it is to walk by.
type Job = (usize, Range<u32>);

fn total(jobs: &[Job]) -> u32 {
    jobs.iter().map(|(_, seeds)| seeds.end - seeds.start).sum()
}

/// The first of the best.
fn best_of(scores: &[Score], of: u32) -> usize {
    let values = scores.iter().map(|score| score.value(of)).enumerate();
    let best = values.min_by(|a, b| a.1.total_cmp(&b.1));
    best.map_or(0, |(k, _)| k)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cabc::maps;
    use pf_abc::Check;

    fn search(threads: usize, file: Option<PathBuf>) -> Search {
        let [problem, _] = maps().unwrap();
        Search {
            world: "map 1".to_owned(),
            problem,
            params: AbcParams {
                cycles: 1,
                sources: 4,
                steps: 60,
                check: Check::Segment,
                ..AbcParams::paper()
            },
            grid: [vec![0.7, 1.0, 1.2], vec![0.0, 0.1], vec![0.0, 0.03, 0.1]],
            runs: 12,
            fresh: 20,
            threads: NonZeroUsize::new(threads).unwrap(),
            file,
            cancel: CancelToken::default(),
        }
    }

    #[test]
    fn threads_interruptions_and_files_change_nothing() {
        let plain = search(1, None).run(&mut |_, _, _| ()).unwrap();
        assert_eq!(search(2, None).run(&mut |_, _, _| ()).unwrap(), plain);
        assert!(plain.race.runs < plain.grid.runs, "{plain:?}");

        let folder = std::env::temp_dir().join(format!("pf-tune-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let file = folder.join("books.json");
        let mut stops = 0;
        // Ctrl-C again and again, each time a little later.
        let found = loop {
            let search = search(2, Some(file.clone()));
            let cancel = search.cancel.clone();
            let mut told = 0;
            let result = search.run(&mut |_, _, _| {
                told += 1;
                if told == 9 {
                    cancel.cancel();
                }
            });
            match result {
                Err(PaperError::Interrupted) => stops += 1,
                other => break other.unwrap(),
            }
        };
        assert!(stops > 2, "{stops}");
        assert_eq!(found, plain);

        // All is in the file: nothing is left to do, and another search does not take it.
        let mut left = 0;
        let again = search(1, Some(file.clone()));
        let again = again.run(&mut |done, all, _| left = left.max(all - done));
        assert_eq!((again.unwrap(), left), (plain, 0));
        let other = Search {
            runs: 13,
            ..search(1, Some(file))
        };
        let error = other.run(&mut |_, _, _| ()).unwrap_err().to_string();
        assert!(error.contains("another search"), "{error}");
        std::fs::remove_dir_all(folder).unwrap();
    }
}
