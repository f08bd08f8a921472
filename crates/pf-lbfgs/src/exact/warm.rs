//! From the last path to the next: which side of things is kept, and from where to improve.

use super::{Exact, Job, Origin};
use crate::class::{length, ratio, respace, same_class};
use pf_core::Context;
use pf_geom::{Point, WorldProblem};

/// What is to end where the ends are now.
#[derive(Clone, Copy)]
enum Followed {
    Last,
    Rival,
}

impl Exact {
    /// Tries to keep to the last path's side of things. Says how `path` came about; nothing if it is
    /// no good.
    pub(super) fn keep_on(
        &mut self,
        job: &mut Job<'_>,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Option<Origin> {
        let moved = self.follow_ends(job.problem, Followed::Last);
        let leapt = self.leapt(moved);
        if same_class(&self.hinge.solids, &self.path, &self.laid) {
            // The exact path may be the better beginning after a leap.
            let sticks = job.params.hysteresis > 0.0;
            return if leapt || sticks && self.prefers_laid(job) {
                None
            } else {
                self.repair(job, cx)
            };
        }
        if job.params.hysteresis <= 0.0 {
            return None;
        }
        let origin = self.improve_warm(job, cx)?;
        let enough = length(&self.path) * (1.0 - job.params.hysteresis);
        // What is laid out is hardly longer than any path of its class can be short.
        if length(&self.laid) >= enough {
            return Some(origin);
        }
        self.challenge(job, enough, origin, cx)
    }

    /// Improves the last path in `path`, which is of the exact path's class. A class may hold two valleys:
    /// where nothing is to be kept for its own sake, the exact path's is tried, too.
    fn repair(&mut self, job: &mut Job<'_>, cx: &mut Context<'_, WorldProblem>) -> Option<Origin> {
        let origin = self.improve_warm(job, cx)?;
        if job.params.hysteresis > 0.0 {
            return Some(origin);
        }
        self.kept.clone_from(&self.path);
        self.path.clone_from(&self.laid);
        let passes = self.improve(job, true, cx).is_some();
        std::mem::swap(&mut self.path, &mut self.laid);
        std::mem::swap(&mut self.path, &mut self.kept);
        if passes && self.prefers_laid(job) {
            std::mem::swap(&mut self.path, &mut self.laid);
            return Some(Origin::Afresh);
        }
        Some(origin)
    }

    fn improve_warm(
        &mut self,
        job: &mut Job<'_>,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Option<Origin> {
        let steps = self.improve(job, false, cx)?;
        Some(if steps == 0 {
            Origin::Kept
        } else {
            Origin::Repaired
        })
    }

    /// Tries whether the way of the exact path, which is another than `path`'s, comes out shorter than
    /// `enough`; the longer one is the rival from now on.
    fn challenge(
        &mut self,
        job: &mut Job<'_>,
        enough: f64,
        origin: Origin,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Option<Origin> {
        std::mem::swap(&mut self.path, &mut self.kept);
        let stamp = Some(job.problem.world().stamp());
        let mut known = !self.rival.is_empty() && self.rival_in == stamp;
        if known {
            let [from, to] = self.follow_ends(job.problem, Followed::Rival);
            known =
                !self.leapt([from, to]) && same_class(&self.hinge.solids, &self.path, &self.laid);
            // It can hardly have become shorter than by what its ends moved.
            if known && length(&self.rival) - (from + to) >= enough {
                std::mem::swap(&mut self.path, &mut self.kept);
                return Some(origin);
            }
        }
        if !known {
            self.path.clone_from(&self.laid);
        }
        let passes = self.improve(job, !known, cx).is_some();
        self.rival.clear();
        if !passes && !cx.stopped() {
            // Nothing smooth goes there, but the exact path does.
            return None;
        }
        let better = passes && length(&self.path) < enough;
        if !better {
            std::mem::swap(&mut self.path, &mut self.kept);
        }
        if passes && !cx.stopped() {
            self.rival.extend_from_slice(&self.kept);
            self.rival_in = stamp;
        }
        Some(if better { Origin::Afresh } else { origin })
    }

    /// Puts the last path, or its rival, into `path`, its ends where they are now: all else stays if that
    /// keeps its class, for near a minimum Newton's first step is best; else, or where there are not as
    /// many points as are laid out, with a straight piece to each and points spread evenly. Says how far
    /// the ends went.
    fn follow_ends(&mut self, problem: &WorldProblem, followed: Followed) -> [f64; 2] {
        let old = match followed {
            Followed::Last => &self.last,
            Followed::Rival => &self.rival,
        };
        let n = old.len() / 2;
        let ends = [problem.start(), problem.goal()];
        let before = [
            Point::new(old[0], old[1]),
            Point::new(old[2 * n - 2], old[2 * n - 1]),
        ];
        let by = [ends[0] - before[0], ends[1] - before[1]];
        self.path.clear();
        self.path.extend([ends[0].x, ends[0].y]);
        self.path.extend(old.iter().take(2 * n - 2).skip(2));
        self.path.extend([ends[1].x, ends[1].y]);
        let moved = by.map(|by| by.norm());
        let is_as_long = self.path.len() == self.laid.len();
        if is_as_long && moved.iter().all(|by| *by <= 0.0) {
            return moved;
        }
        self.joined.clear();
        self.joined.extend([ends[0].x, ends[0].y]);
        self.joined.extend_from_slice(old);
        self.joined.extend([ends[1].x, ends[1].y]);
        if !is_as_long || !same_class(&self.hinge.solids, &self.path, &self.joined) {
            respace(&self.joined, self.laid.len() / 2, &mut self.path);
        }
        moved
    }

    /// Whether an end went further than a step of the path: then what was followed is no good beginning.
    fn leapt(&self, moved: [f64; 2]) -> bool {
        moved[0].max(moved[1]) > length(&self.path) / ratio(self.path.len() / 2 - 1, 1)
    }
}
