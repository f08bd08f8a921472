//! What may happen in a world, made up by seed.

use super::shapes::{circle, pick, shape};
use crate::PlanRng;
use pf_core::Problem;
use pf_geom::{Point, Segment, ShapeId, Vector, WorldChange, WorldProblem};
use rand::RngExt;
use std::f64::consts::TAU;

/// A batch of everything that may happen to `problem`: shapes added, removed and moved, a little or
/// far away, some within one batch; start and goal moved, onto free places and blocked ones, or
/// under an obstacle; changes that change nothing; and sometimes no change at all.
///
/// ```
/// # use pf_conformance::{world::{Recipe, random_batch, random_world}, seeded};
/// use pf_core::Problem;
/// let mut rng = seeded(7);
/// let recipe = Recipe::any(&mut rng, 5..=20);
/// let mut problem = random_world(&mut rng, &recipe);
/// for _ in 0..10 {
///     let batch = random_batch(&mut rng, &problem);
///     let revision = problem.revise(&batch).unwrap();
///     // … a replanner's answer to `revision`, beside `oracle(revision.problem())`
/// }
/// ```
pub fn random_batch(rng: &mut PlanRng, problem: &WorldProblem) -> Vec<WorldChange> {
    if rng.random_bool(0.1) {
        return ends_batch(rng, problem);
    }
    let number = *pick(rng, &[0, 1, 1, 1, 1, 1, 2, 2, 3]);
    let mut now = problem.clone();
    let mut batch = vec![];
    for _ in 0..number {
        let change = any_change(rng, &now);
        // Made for the problem as it is by then, so this does not fail.
        let _ = now.apply(std::slice::from_ref(&change));
        batch.push(change);
    }
    batch
}

fn any_change(rng: &mut PlanRng, problem: &WorldProblem) -> WorldChange {
    use WorldChange::{Added, GoalMoved, Moved, Removed, StartMoved};
    match rng.random_range(0..10) {
        0..3 => {
            let (middle, size) = (any_point(rng, problem), rng.random_range(0.2..1.5));
            Added(shape(rng, middle, size))
        }
        // What is not there cannot go.
        3..5 => any_id(rng, problem)
            .map_or(GoalMoved(elsewhere(rng, problem, problem.goal())), |id| {
                Removed(id)
            }),
        5..8 => match any_id(rng, problem) {
            Some(id) => Moved(id, any_step(rng)),
            None => StartMoved(elsewhere(rng, problem, problem.start())),
        },
        8 => StartMoved(elsewhere(rng, problem, problem.start())),
        _ => GoalMoved(elsewhere(rng, problem, problem.goal())),
    }
}

/// Like [`random_batch`], but start and goal are never blocked or moved onto what is blocked.
pub(super) fn calm_batch(rng: &mut PlanRng, problem: &WorldProblem) -> Vec<WorldChange> {
    let mut now = problem.clone();
    let mut batch = random_batch(rng, problem);
    batch.retain(|change| {
        // A change that is left out may leave a later one without its shape.
        let mut after = now.clone();
        let keeps = after.apply(std::slice::from_ref(change)).is_ok() && is_open(&after);
        if keeps {
            now = after;
        }
        keeps
    });
    batch
}

fn is_open(problem: &WorldProblem) -> bool {
    let ends = [problem.start(), problem.goal()];
    ends.iter().all(|&end| problem.is_free(end, end))
}

/// One obstacle added, removed or moved, start and goal spared: what repair is for.
pub(super) fn small_batch(rng: &mut PlanRng, problem: &WorldProblem) -> Vec<WorldChange> {
    for _ in 0..20 {
        let (middle, size) = (any_point(rng, problem), rng.random_range(0.2..1.0));
        let change = match (rng.random_range(0..5), any_id(rng, problem)) {
            (3, Some(id)) => WorldChange::Removed(id),
            (4, Some(id)) => WorldChange::Moved(id, any_step(rng)),
            _ => WorldChange::Added(shape(rng, middle, size)),
        };
        let mut after = problem.clone();
        if after.apply(std::slice::from_ref(&change)).is_ok() && is_open(&after) {
            return vec![change];
        }
    }
    vec![]
}

/// Start or goal blocked, freed, moved into an obstacle, onto its border or onto each other; and
/// often something else besides, which must not be forgotten while there is no way anyhow.
pub(super) fn ends_batch(rng: &mut PlanRng, problem: &WorldProblem) -> Vec<WorldChange> {
    use WorldChange::{Added, GoalMoved, Moved, Removed, StartMoved};
    let end = *pick(rng, &[problem.start(), problem.goal()]);
    let moved = *pick(rng, &[StartMoved as fn(Point) -> _, GoalMoved]);
    let radius = problem.radius();
    let on_end: Vec<ShapeId> = blockers(problem).collect();
    let mut batch = match (rng.random_range(0..8), any_id(rng, problem)) {
        (0, _) => vec![Added(circle(end.x, end.y, rng.random_range(0.1..1.0)))],
        (1 | 2, Some(id)) if on_end.is_empty() => match middle_of(problem, id) {
            Some(middle) => vec![Moved(id, end - middle)],
            None => vec![Added(circle(end.x, end.y, 0.3))],
        },
        (1..4, _) => on_end.iter().map(|&id| Removed(id)).collect(),
        (4, _) => on_end
            .iter()
            .map(|&id| Moved(id, any_step(rng) * 4.0))
            .collect(),
        (5, Some(id)) => match middle_of(problem, id) {
            Some(middle) if problem.world().bounds().contains(middle) => vec![moved(middle)],
            _ => vec![],
        },
        // On the border of a circle that comes at the same time, or a hair inside.
        (6, _) => {
            let at = any_point(rng, problem);
            let hair = *pick(rng, &[0.0, 1e-6]);
            vec![
                moved(at),
                Added(circle(at.x + 0.5 + radius - hair, at.y, 0.5)),
            ]
        }
        _ => {
            let other = elsewhere(rng, problem, end);
            vec![moved(*pick(rng, &[end, other]))]
        }
    };
    if rng.random_bool(0.3) {
        let middle = any_point(rng, problem);
        batch.push(Added(shape(rng, middle, 0.5)));
    }
    batch
}

/// The obstacles that keep the robot from its start or its goal.
fn blockers(problem: &WorldProblem) -> impl Iterator<Item = ShapeId> + '_ {
    let ends = [problem.start(), problem.goal()];
    let shapes = problem.world().shapes();
    shapes
        .filter(move |(_, shape)| {
            let blocks = |&end: &Point| shape.blocks(&Segment::new(end, end), problem.radius());
            ends.iter().any(blocks)
        })
        .map(|(id, _)| id)
}

/// A place that this obstacle blocks, if its middle is one.
fn middle_of(problem: &WorldProblem, id: ShapeId) -> Option<Point> {
    let shape = problem.world().shape(id)?;
    let (min, max) = shape.bounding_box();
    let middle = min + (max - min) / 2.0;
    let there = Segment::new(middle, middle);
    shape.blocks(&there, problem.radius()).then_some(middle)
}

fn any_id(rng: &mut PlanRng, problem: &WorldProblem) -> Option<ShapeId> {
    let ids: Vec<_> = problem.world().shapes().map(|(id, _)| id).collect();
    (!ids.is_empty()).then(|| *pick(rng, &ids))
}

/// None at all, small, or large.
fn any_step(rng: &mut PlanRng) -> Vector {
    let length = *pick(rng, &[0.0, 0.01, 0.3, 0.3, 1.0, 1.0, 5.0]);
    let direction = rng.random_range(0.0..TAU);
    Vector::new(direction.cos(), direction.sin()) * length
}

fn any_point(rng: &mut PlanRng, problem: &WorldProblem) -> Point {
    let (min, max) = (
        problem.world().bounds().min(),
        problem.world().bounds().max(),
    );
    Point::new(
        rng.random_range(min.x..=max.x),
        rng.random_range(min.y..=max.y),
    )
}

/// A step away, or far; mostly where there is room.
fn elsewhere(rng: &mut PlanRng, problem: &WorldProblem, from: Point) -> Point {
    let (min, max) = (
        problem.world().bounds().min(),
        problem.world().bounds().max(),
    );
    if rng.random_bool(0.1) {
        return any_point(rng, problem);
    }
    let near = rng.random_bool(0.6);
    for _ in 0..50 {
        let to = if near {
            (from + any_step(rng)).sup(&min).inf(&max)
        } else {
            any_point(rng, problem)
        };
        if problem.is_free(to, to) {
            return to;
        }
    }
    from
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        seeded,
        world::{Recipe, oracle, random_world},
    };

    #[test]
    fn every_change_happens_and_changes_what_is_best() {
        let mut rng = seeded(2);
        let (mut seen, mut differ, mut blocked) = ([0; 6], 0, 0);
        for _ in 0..60 {
            let recipe = Recipe::any(&mut rng, 5..=10);
            let mut problem = random_world(&mut rng, &recipe);
            let best = |problem: &_| oracle(problem).map_or(f64::INFINITY, |best| best.length);
            let mut last = best(&problem);
            for _ in 0..10 {
                let batch = random_batch(&mut rng, &problem);
                problem.apply(&batch).expect("a batch that makes sense");
                for change in &batch {
                    seen[match change {
                        WorldChange::StartMoved(_) => 0,
                        WorldChange::GoalMoved(_) => 1,
                        WorldChange::Added(_) => 2,
                        WorldChange::Removed(_) => 3,
                        WorldChange::Moved(..) => 4,
                    }] += 1;
                }
                seen[5] += usize::from(batch.is_empty());
                blocked += usize::from(!is_open(&problem));
                let now = best(&problem);
                differ += usize::from(now.total_cmp(&last).is_ne());
                last = now;
            }
        }
        assert!(seen.iter().all(|&n| n > 30), "{seen:?}");
        assert!(differ > 100 && blocked > 30, "{differ} {blocked}");
    }

    #[test]
    fn calm_batches_spare_both_ends() {
        let mut rng = seeded(3);
        for _ in 0..50 {
            let recipe = Recipe {
                density: 0.1,
                ..Recipe::any(&mut rng, 5..=20)
            };
            let mut problem = random_world(&mut rng, &recipe);
            for _ in 0..20 {
                let batch = calm_batch(&mut rng, &problem);
                problem.apply(&batch).expect("a batch that makes sense");
                assert!(is_open(&problem), "{batch:?}");
            }
        }
    }
}
