//! Strategies for [`proptest`], which shrinks what breaks.

use super::shapes::{circle, polygon, rectangle};
use pf_core::Problem;
use pf_geom::{Point, Rectangle, Shape, Vector, World, WorldChange, WorldProblem};
use proptest::{
    collection::{SizeRange, vec},
    prelude::*,
    sample::{Index, select},
};
use std::f64::consts::TAU;

/// On what numbers things lie.
#[derive(Clone, Copy, Debug)]
enum Numbers {
    /// Any, in a square with a side of 20.
    Any,
    /// Whole and half ones in a square with a side of 8: many shapes touch, many corners lie in
    /// line.
    Whole,
}

impl Numbers {
    const ALL: [Self; 2] = [Self::Whole, Self::Any];

    fn side(self) -> f64 {
        match self {
            Self::Any => 20.0,
            Self::Whole => 8.0,
        }
    }

    fn point(self) -> BoxedStrategy<Point> {
        match self {
            Self::Any => (0.0..=20.0, 0.0..=20.0)
                .prop_map(|(x, y)| Point::new(x, y))
                .boxed(),
            Self::Whole => (0..=8i32, 0..=8i32)
                .prop_map(|(x, y)| Point::new(x.into(), y.into()))
                .boxed(),
        }
    }

    fn length(self) -> BoxedStrategy<f64> {
        match self {
            Self::Any => (0.1..3.0).boxed(),
            Self::Whole => (1..=4i32).prop_map(|n| f64::from(n) / 2.0).boxed(),
        }
    }

    fn radius(self) -> BoxedStrategy<f64> {
        match self {
            Self::Any => prop_oneof![Just(0.0), 0.0..=1.0].boxed(),
            Self::Whole => prop_oneof![Just(0.0), Just(0.5)].boxed(),
        }
    }
}

/// Circles, rectangles, and polygons, convex or not, in a square with a side of 20; those on whole
/// numbers in one with a side of 8, where many touch.
pub fn shapes() -> impl Strategy<Value = Shape> {
    select(&Numbers::ALL[..]).prop_flat_map(shapes_on)
}

fn shapes_on(numbers: Numbers) -> impl Strategy<Value = Shape> {
    let (points, lengths) = (|| numbers.point(), || numbers.length());
    let star = (points(), vec((0.3..1.0, 0.0..0.4), 3..9));
    prop_oneof![
        (points(), lengths()).prop_map(|(p, r)| circle(p.x, p.y, r)),
        (points(), lengths(), lengths()).prop_map(|(p, w, h)| rectangle(p, p + Vector::new(w, h))),
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

fn worlds_on(numbers: Numbers, size: SizeRange) -> impl Strategy<Value = World> {
    let corner = Point::new(numbers.side(), numbers.side());
    let bounds = Rectangle::new(Point::origin(), corner).expect("a square");
    vec(shapes_on(numbers), size).prop_map(move |shapes| World::with_shapes(bounds, shapes))
}

/// Worlds of so many [`shapes`].
pub fn worlds(size: impl Into<SizeRange>) -> impl Strategy<Value = World> {
    let size = size.into();
    select(&Numbers::ALL[..]).prop_flat_map(move |numbers| worlds_on(numbers, size.clone()))
}

/// Problems in [`worlds`] of so many shapes, for a robot with a radius up to 1, often 0. Start and
/// goal may be blocked, or one.
///
/// # Panics
/// Never, but for a fault of its own.
pub fn problems(size: impl Into<SizeRange>) -> impl Strategy<Value = WorldProblem> {
    let size = size.into();
    select(&Numbers::ALL[..]).prop_flat_map(move |numbers| {
        let world = worlds_on(numbers, size.clone());
        let ends = (numbers.point(), numbers.point());
        (world, numbers.radius(), ends).prop_map(|(world, radius, (start, goal))| {
            WorldProblem::new(world, radius, start, goal).expect("points within the bounds")
        })
    })
}

/// One batch of changes that make sense for `problem`: obstacles added, removed and moved, start
/// and goal moved; all of these mixed; or nothing at all.
pub fn changes_for(problem: &WorldProblem) -> impl Strategy<Value = Vec<WorldChange>> + use<> {
    let problem = problem.clone();
    wishes(*problem.world().bounds()).prop_map(move |wishes| granted(&problem, &wishes))
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
///
/// # Panics
/// Never, but for a fault of its own.
pub fn stories(
    size: impl Into<SizeRange>,
    batches: impl Into<SizeRange>,
) -> impl Strategy<Value = (WorldProblem, Vec<Vec<WorldChange>>)> {
    let common = Rectangle::new(Point::origin(), Point::new(8.0, 8.0)).expect("a square");
    let wished = vec(wishes(common), batches);
    (problems(size), wished).prop_map(|(problem, wishes)| {
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

/// Start and goal move within `bounds`.
fn wishes(bounds: Rectangle) -> impl Strategy<Value = Vec<Wish>> {
    let points = move || {
        let share = (0.0..=1.0, 0.0..=1.0).prop_map(|(x, y)| Vector::new(x, y));
        share.prop_map(move |share| {
            let extent = bounds.max() - bounds.min();
            let place = bounds.min() + extent.component_mul(&share);
            place.inf(&bounds.max())
        })
    };
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
