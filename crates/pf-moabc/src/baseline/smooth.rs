//! Shorter and smoother: straight moves, slower if need be, in place of several.

use super::intervals::Traffic;
use pf_geom::{Segment, TeamProblem, TimedPath, TimedPoint};

/// After so many points in a row that cannot be left out it stops looking farther.
const MISSES: usize = 4;

/// Leaves out points where a straight and even move in the same time is as safe.
pub(super) fn smoothed(
    problem: &TeamProblem,
    robot: usize,
    path: &[TimedPoint],
    traffic: &Traffic,
) -> TimedPath {
    let radius = problem.robots()[robot].radius;
    let fits = |i: usize, j: usize| {
        let segment = Segment::new(path[i].at, path[j].at);
        problem.world().is_free(&segment, radius) && traffic.is_clear(&path[i], &path[j])
    };
    let mut kept = vec![path[0]];
    let mut i = 0;
    while i + 1 < path.len() {
        let (mut best, mut missed) = (i + 1, 0);
        for j in i + 2..path.len() {
            if fits(i, j) {
                (best, missed) = (j, 0);
            } else {
                missed += 1;
                if missed > MISSES {
                    break;
                }
            }
        }
        kept.push(path[best]);
        i = best;
    }
    kept
}
