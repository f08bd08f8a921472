//! Strategies for [`proptest`], which shrinks what breaks.

use super::shapes::{circle, polygon, rectangle};
use pf_core::Problem;
use pf_geom::{Point, Rectangle, Shape, Vector, World, WorldChange, WorldProblem};
use proptest::{
    collection::{SizeRange, vec},
    prelude::*,
    sample::Index,
};
use std::f64::consts::TAU;

/// The side of the square in which all this happens.
const SIDE: f64 = 20.0;

fn points() -> impl Strategy<Value = Point> {
    // Whole numbers make for shapes that touch, and for corners in line.
    prop_oneof![
        3 => (0.0..=SIDE, 0.0..=SIDE).prop_map(|(x, y)| Point::new(x, y)),
        1 => (0..=20i32, 0..=20i32).prop_map(|(x, y)| Point::new(x.into(), y.into())),
    ]
}

fn lengths() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => 0.1..3.0,
        1 => (1..=3i32).prop_map(f64::from),
    ]
}

/// Circles, rectangles, and polygons, convex or not, in a square of 20 by 20; some touch.
pub fn shapes() -> impl Strategy<Value = Shape> {
    let star = (points(), vec((0.3..1.0, 0.0..0.4), 3..9));
    prop_oneof![
        (points(), lengths()).prop_map(|(p, r)| circle(p.x, p.y, r)),
        (points(), lengths(), lengths())
            .prop_map(|(p, w, h)| rectangle(p, p + Vector::new(w, h))),
        (star, lengths()).prop_map(|((middle, corners), size)| {
            // Every turn is less than half a one, so no border crosses itself.
            let step = TAU / f64::from(u32::try_from(corners.len()).unwrap_or(u32::MAX));
            let around = (0u32..).zip(&corners).map(|(k, (radius, shift))| {
                let angle: f64 = (f64::from(k) + shift) * step;
                middle + Vector::new(angle.cos(), angle.sin()) * (radius * size)
            });
            polygon(around.collect())
        }),
    ]
}

/// Worlds of so many [`shapes`].
pub fn worlds(numbers: impl Into<SizeRange>) -> impl Strategy<Value = World> {
    let bounds = Rectangle::new(Point::origin(), Point::new(SIDE, SIDE)).expect("a square");
    vec(shapes(), numbers).prop_map(move |shapes| World::with_shapes(bounds, shapes))
}

/// Problems in [`worlds`] of so many shapes, for a robot with a radius up to 1, often 0. Start and
/// goal may be blocked, or one.
pub fn problems(numbers: impl Into<SizeRange>) -> impl Strategy<Value = WorldProblem> {
    let radii = prop_oneof![Just(0.0), Just(0.5), 0.0..=1.0];
    (worlds(numbers), radii, points(), points()).prop_map(|(world, radius, start, goal)| {
        WorldProblem::new(world, radius, start, goal).expect("points within the bounds")
    })
}

/// One batch of changes that make sense for `problem`: obstacles added, removed and moved, start
/// and goal moved; all of these mixed; or nothing at all.
pub fn changes_for(problem: &WorldProblem) -> impl Strategy<Value = Vec<WorldChange>> + use<> {
    let problem = problem.clone();
    wishes().prop_map(move |wishes| granted(&problem, &wishes))
}

/// A problem as from [`problems`], and batches as from [`changes_for`] that happen to it one after
/// the other.
///
/// ```
/// use pf_conformance::world::{oracle, stories};
/// use pf_core::Problem;
/// use proptest::prelude::*;
///
/// proptest!(ProptestConfig::with_cases(20), |((mut problem, batches) in stories(0..5, 0..4))| {
///     for batch in &batches {
///         let revision = problem.revise(batch).unwrap();
///         // … a replanner's answer to `revision`, beside the truth:
///         let _ = oracle(revision.problem());
///     }
/// });
/// ```
pub fn stories(
    numbers: impl Into<SizeRange>,
    batches: impl Into<SizeRange>,
) -> impl Strategy<Value = (WorldProblem, Vec<Vec<WorldChange>>)> {
    (problems(numbers), vec(wishes(), batches)).prop_map(|(problem, wishes)| {
        let mut now = problem.clone();
        let mut batches = vec![];
        for wishes in wishes {
            let batch = granted(&now, &wishes);
            // Granted for the problem as it is.
            let _ = now.apply(&batch);
            batches.push(batch);
        }
        (problem, batches)
    })
}

/// A change of an obstacle that is yet to be found.
#[derive(Clone, Debug)]
enum Wish {
    Certain(WorldChange),
    Remove(Index),
    Move(Index, Vector),
}

fn wishes() -> impl Strategy<Value = Vec<Wish>> {
    let certain = prop_oneof![
        3 => shapes().prop_map(WorldChange::Added),
        1 => points().prop_map(WorldChange::StartMoved),
        1 => points().prop_map(WorldChange::GoalMoved),
    ];
    let by = (-3.0..3.0, -3.0..3.0).prop_map(|(x, y)| Vector::new(x, y));
    let wish = prop_oneof![
        3 => certain.prop_map(Wish::Certain),
        1 => any::<Index>().prop_map(Wish::Remove),
        2 => (any::<Index>(), by).prop_map(|(index, by)| Wish::Move(index, by)),
    ];
    vec(wish, 0..4)
}

/// The wishes as changes of the obstacles that are there by then.
fn granted(problem: &WorldProblem, wishes: &[Wish]) -> Vec<WorldChange> {
    let mut ids: Vec<_> = problem.world().shapes().map(|(id, _)| id).collect();
    let mut next = problem.world().next_id();
    let mut batch = vec![];
    for wish in wishes {
        match wish {
            Wish::Certain(change) => {
                if let WorldChange::Added(_) = change {
                    ids.push(next);
                    next += 1;
                }
                batch.push(change.clone());
            }
            _ if ids.is_empty() => {}
            Wish::Remove(index) => {
                let id = ids.remove(index.index(ids.len()));
                batch.push(WorldChange::Removed(id));
            }
            Wish::Move(index, by) => {
                batch.push(WorldChange::Moved(ids[index.index(ids.len())], *by));
            }
        }
    }
    batch
}
