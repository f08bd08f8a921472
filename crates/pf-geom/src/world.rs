use crate::{
    Point, Rectangle, Segment, Shape, TOUCH, Vector,
    index::Index,
    shape::{bad, check_finite},
};
use pf_core::{InvalidProblem, Stamp};
use std::sync::Arc;

/// A bounded region of the plane with obstacles, each under an id that is never used again.
///
/// A path may touch an obstacle and the bounds, and may not enter the one or leave the other by
/// more than [`TOUCH`]. Coordinates are in whatever unit the caller likes.
#[derive(Clone, Debug)]
pub struct World {
    bounds: Rectangle,
    /// By id; an obstacle that was removed leaves a gap.
    shapes: Vec<Option<Arc<Shape>>>,
    index: Index,
    stamp: Stamp,
}

/// Which obstacle.
pub type ShapeId = usize;

impl World {
    /// A region without obstacles.
    #[must_use]
    pub fn new(bounds: Rectangle) -> Self {
        Self {
            bounds,
            shapes: Vec::new(),
            index: Index::default(),
            stamp: Stamp::fresh(),
        }
    }

    /// The same with these obstacles; their ids are their places in the list.
    #[must_use]
    pub fn with_shapes(bounds: Rectangle, shapes: impl IntoIterator<Item = Shape>) -> Self {
        let shapes: Vec<_> = shapes.into_iter().map(|s| Some(Arc::new(s))).collect();
        let boxes = shapes.iter().flatten().map(|s| s.bounding_box());
        Self {
            bounds,
            index: Index::of(boxes),
            shapes,
            stamp: Stamp::fresh(),
        }
    }

    /// The region.
    #[must_use]
    pub fn bounds(&self) -> &Rectangle {
        &self.bounds
    }

    /// Names the present content; see [`Stamp`].
    #[must_use]
    pub fn stamp(&self) -> Stamp {
        self.stamp
    }

    /// The obstacle with this id, if it is there.
    #[must_use]
    pub fn shape(&self, id: ShapeId) -> Option<&Shape> {
        self.shapes.get(id)?.as_deref()
    }

    /// All obstacles with their ids, in ascending order.
    pub fn shapes(&self) -> impl Iterator<Item = (ShapeId, &Shape)> {
        let shapes = self.shapes.iter().enumerate();
        shapes.filter_map(|(id, shape)| Some((id, shape.as_deref()?)))
    }

    /// The id the next obstacle will have.
    #[must_use]
    pub fn next_id(&self) -> ShapeId {
        self.shapes.len()
    }

    /// Adds an obstacle and returns its id.
    pub fn add(&mut self, shape: Shape) -> ShapeId {
        let id = self.shapes.len();
        self.index.set(id, shape.bounding_box());
        self.shapes.push(Some(Arc::new(shape)));
        self.stamp = Stamp::fresh();
        id
    }

    /// Takes an obstacle away.
    ///
    /// # Errors
    /// [`InvalidProblem::NoSuchObstacle`] if it is not there.
    pub fn remove(&mut self, id: ShapeId) -> Result<(), InvalidProblem> {
        self.known(id)?;
        self.shapes[id] = None;
        self.index.remove(id);
        self.stamp = Stamp::fresh();
        Ok(())
    }

    /// Moves an obstacle.
    ///
    /// # Errors
    /// [`InvalidProblem`] if it is not there, or would have a coordinate that is not finite.
    pub fn translate(&mut self, id: ShapeId, by: Vector) -> Result<(), InvalidProblem> {
        let moved = self.known(id)?.translated(by)?;
        self.index.set(id, moved.bounding_box());
        self.shapes[id] = Some(Arc::new(moved));
        self.stamp = Stamp::fresh();
        Ok(())
    }

    pub(crate) fn known(&self, id: ShapeId) -> Result<&Shape, InvalidProblem> {
        self.shape(id).ok_or(InvalidProblem::NoSuchObstacle { id })
    }

    /// Refuses a point that is not finite or lies outside the bounds.
    pub(crate) fn check_point(&self, what: &'static str, p: Point) -> Result<(), InvalidProblem> {
        self.check_place(what, p)
    }

    /// The same for what has a name of its own.
    pub(crate) fn check_place(
        &self,
        what: impl Into<std::borrow::Cow<'static, str>>,
        p: Point,
    ) -> Result<(), InvalidProblem> {
        let what = what.into();
        if p.coords.iter().all(|v| v.is_finite()) && self.bounds.contains(p) {
            return Ok(());
        }
        check_finite(what.clone(), p)?;
        let (min, max) = (self.bounds.min(), self.bounds.max());
        Err(InvalidProblem::OutOfBounds {
            what,
            place: format!("({}, {})", p.x, p.y),
            world: format!("({}, {}) to ({}, {})", min.x, min.y, max.x, max.y),
        })
    }

    /// Whether a disc of `radius` whose centre moves along `segment` stays within the bounds (its
    /// centre does) and enters no obstacle.
    #[must_use]
    pub fn is_free(&self, segment: &Segment, radius: f64) -> bool {
        self.is_within_bounds(segment) && self.blocker(segment, radius).is_none()
    }

    /// Whether a segment stays within the bounds.
    #[must_use]
    pub fn is_within_bounds(&self, segment: &Segment) -> bool {
        let (min, max) = (self.bounds.min(), self.bounds.max());
        let inside = |p: Point| (0..2).all(|k| min[k] - TOUCH <= p[k] && p[k] <= max[k] + TOUCH);
        inside(segment.a) && inside(segment.b)
    }

    /// An obstacle that a disc of `radius` enters whose centre moves along `segment`.
    #[must_use]
    pub fn blocker(&self, segment: &Segment, radius: f64) -> Option<ShapeId> {
        self.index.find_near(segment, radius, |id| {
            self.shape(id)
                .is_some_and(|shape| shape.blocks(segment, radius))
        })
    }

    /// The distance from a segment to the nearest obstacle and which it is: 0 if it touches or
    /// enters one; `None` if there are none.
    #[must_use]
    pub fn nearest(&self, segment: &Segment) -> Option<(f64, ShapeId)> {
        self.index.nearest(segment, |id| {
            self.shape(id)
                .map_or(f64::INFINITY, |shape| shape.distance(segment))
        })
    }

    /// The distance from a segment to the nearest obstacle: 0 if it touches or enters one,
    /// infinite if there are none.
    #[must_use]
    pub fn clearance(&self, segment: &Segment) -> f64 {
        self.nearest(segment).map_or(f64::INFINITY, |found| found.0)
    }

    /// The distance from a point to the nearest obstacle.
    #[must_use]
    pub fn clearance_at(&self, p: Point) -> f64 {
        self.clearance(&Segment::new(p, p))
    }

    /// The obstacles whose bounding boxes touch a box, in ascending order of their ids.
    #[must_use]
    pub fn within(&self, min: Point, max: Point) -> Vec<ShapeId> {
        let mut ids = Vec::new();
        self.index.each_in_box(min, max, |id| ids.push(id));
        ids.sort_unstable();
        ids
    }

    /// Shows the obstacles whose bounding boxes touch a box, in no particular order.
    pub(crate) fn each_within(&self, min: Point, max: Point, mut found: impl FnMut(&Shape)) {
        self.index.each_in_box(min, max, |id| {
            self.shape(id).into_iter().for_each(&mut found);
        });
    }

    /// The first obstacle on the way of a ray from `origin` in `direction`, and how far it is, if
    /// it is no further than `reach`. From inside an obstacle the distance is 0.
    ///
    /// # Errors
    /// [`InvalidProblem`] if the direction is null or a number is not finite.
    pub fn cast_ray(
        &self,
        origin: Point,
        direction: Vector,
        reach: f64,
    ) -> Result<Option<(f64, ShapeId)>, InvalidProblem> {
        check_finite("the ray's origin", origin)?;
        let length = direction.norm();
        if !(length > 0.0 && length.is_finite()) {
            return Err(bad(
                "the ray's direction",
                length,
                "a vector of some length",
            ));
        }
        let ray = Segment::new(origin, origin + direction * (reach / length));
        let mut first: Option<(f64, ShapeId)> = None;
        let (min, max) = (ray.a.inf(&ray.b), ray.a.sup(&ray.b));
        for id in self.within(min, max) {
            let hit = self.shape(id).and_then(|shape| shape.first_touch(&ray));
            if let Some(hit) = hit
                && first.is_none_or(|(nearest, _)| hit * reach < nearest)
            {
                first = Some((hit * reach, id));
            }
        }
        Ok(first)
    }
}
