//! A bound from above that knows no geometry but whether a segment is free.

use crate::PlanRng;
use pf_geom::{Point, WorldProblem};
use rand::RngExt;
use std::collections::BinaryHeap;

/// How many neighbours a node is joined to.
const NEIGHBOURS: usize = 12;

/// A path by a probabilistic roadmap of so many free nodes, pulled straight as far as shortcuts
/// go; `None` if the roadmap holds none, which proves nothing.
///
/// L. E. Kavraki, P. Svestka, J.-C. Latombe, M. H. Overmars: Probabilistic roadmaps for path
/// planning in high-dimensional configuration spaces. IEEE Transactions on Robotics and Automation
/// 12, 1996.
#[must_use]
pub fn roadmap(problem: &WorldProblem, nodes: usize, rng: &mut PlanRng) -> Option<Vec<Point>> {
    let ends = [problem.start(), problem.goal()];
    if ends.iter().any(|&end| !problem.is_free(end, end)) {
        return None;
    }
    let bounds = problem.world().bounds();
    let (min, max) = (bounds.min(), bounds.max());
    let mut points = ends.to_vec();
    // A world that is almost full ends the search for free places.
    for _ in 0..20 * nodes {
        if points.len() >= nodes {
            break;
        }
        let x = rng.random_range(min.x..=max.x);
        let y = rng.random_range(min.y..=max.y);
        let p = Point::new(x, y);
        if problem.is_free(p, p) {
            points.push(p);
        }
    }
    let mut path = search(problem, &points)?;
    pull(problem, &mut path, rng);
    Some(path)
}

/// A* from the first point to the second, each joined to its nearest ones; edges are tested when
/// their turn comes.
fn search(problem: &WorldProblem, points: &[Point]) -> Option<Vec<Point>> {
    let neighbours = neighbours(problem, points);
    let rest = |k: usize| (points[k] - points[1]).norm();
    let mut parents: Vec<Option<usize>> = vec![None; points.len()];
    let mut open = BinaryHeap::new();
    open.push(Way(rest(0), 0.0, 0, 0));
    while let Some(Way(_, length, here, from)) = open.pop() {
        let free = here == from || problem.is_free(points[from], points[here]);
        if parents[here].is_some() || !free {
            continue;
        }
        parents[here] = Some(from);
        if here == 1 {
            let mut way = vec![1];
            while let Some(parent) = parents[way[way.len() - 1]]
                && way.last() != Some(&0)
            {
                way.push(parent);
            }
            return Some(way.iter().rev().map(|&k| points[k]).collect());
        }
        for &next in &neighbours[here] {
            if parents[next].is_none() {
                let through = length + (points[next] - points[here]).norm();
                open.push(Way(through + rest(next), through, next, here));
            }
        }
    }
    None
}

/// Estimate, length so far, node, parent. The least estimate is the greatest.
struct Way(f64, f64, usize, usize);

impl PartialEq for Way {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Way {}
impl PartialOrd for Way {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Way {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        (other.0.total_cmp(&self.0)).then(other.2.cmp(&self.2))
    }
}

/// The nearest nodes of each, and those whose nearest it is.
fn neighbours(problem: &WorldProblem, points: &[Point]) -> Vec<Vec<usize>> {
    // Squares with about as many points as are wanted.
    let min = problem.world().bounds().min();
    let extent = problem.world().bounds().max() - min;
    #[expect(clippy::cast_precision_loss, reason = "a number of points")]
    let share = NEIGHBOURS as f64 / points.len() as f64;
    let cell = (extent.x * extent.y * share).sqrt();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a few hundred at most; casts of floats saturate"
    )]
    let square = |p: Point| ((p - min) / cell).map(|v| v.max(0.0) as usize + 1);
    let size = square(problem.world().bounds().max()).map(|n| n + 2);
    let mut squares = vec![vec![]; size.x * size.y];
    for (k, &p) in points.iter().enumerate() {
        squares[square(p).y * size.x + square(p).x].push(k);
    }
    let mut neighbours = vec![vec![]; points.len()];
    for (k, &p) in points.iter().enumerate() {
        let at = square(p);
        let rows = (at.y - 1..=at.y + 1).flat_map(|y| (at.x - 1..=at.x + 1).map(move |x| (x, y)));
        let around = rows.flat_map(|(x, y)| &squares[y * size.x + x]);
        let apart = |other: usize| (points[other] - p).norm_squared();
        let mut near: Vec<_> = around.copied().filter(|&other| other != k).collect();
        near.sort_by(|&a, &b| apart(a).total_cmp(&apart(b)));
        for &other in near.iter().take(NEIGHBOURS) {
            neighbours[k].push(other);
            neighbours[other].push(k);
        }
    }
    neighbours
}

/// Shortcuts between places of the path, and corners cut as far as there is room.
fn pull(problem: &WorldProblem, path: &mut Vec<Point>, rng: &mut PlanRng) {
    // From each node straight to the last one that is seen.
    let mut here = 0;
    while here + 2 < path.len() {
        let seen = (here + 2..path.len())
            .rev()
            .find(|&far| problem.is_free(path[here], path[far]));
        if let Some(far) = seen {
            path.drain(here + 1..far);
        }
        here += 1;
    }
    for _ in 0..40 * path.len() {
        if path.len() < 3 {
            return;
        }
        let k = rng.random_range(1..path.len() - 1);
        let (before, at, after) = (path[k - 1], path[k], path[k + 1]);
        if problem.is_free(before, after) {
            path.remove(k);
            continue;
        }
        let (back, on) = (rng.random_range(0.0..1.0f64), rng.random_range(0.0..1.0));
        let (a, b) = (at + (before - at) * back.powi(3), at + (after - at) * on);
        if problem.is_free(a, b) {
            path.splice(k..=k, [a, b]);
        }
    }
}
