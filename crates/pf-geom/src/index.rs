//! Which obstacles are near: the one place where the tree of another crate is used.

use crate::{Point, Segment};
use parry2d::{
    bounding_volume::Aabb,
    math::Vector as Raw,
    partitioning::{Bvh, BvhBuildStrategy, BvhNode, TraversalAction},
};
use std::cell::Cell;

/// A bounding volume hierarchy over numbered boxes that follows changes.
#[derive(Clone, Default)]
pub(crate) struct Index {
    tree: Bvh,
}

fn raw(p: Point) -> Raw {
    Raw::new(p.x, p.y)
}

fn corners(node: &BvhNode) -> (Point, Point) {
    let (min, max) = (node.mins(), node.maxs());
    (Point::new(min.x, min.y), Point::new(max.x, max.y))
}

impl Index {
    pub(crate) fn of(boxes: impl Iterator<Item = (Point, Point)>) -> Self {
        let boxes: Vec<_> = boxes
            .map(|(min, max)| Aabb::new(raw(min), raw(max)))
            .collect();
        Self {
            tree: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes),
        }
    }

    /// Adds or moves a box.
    pub(crate) fn set(&mut self, id: usize, (min, max): (Point, Point)) {
        let Ok(id) = u32::try_from(id) else { return };
        // A leaf that already holds the new box would otherwise keep its old size.
        self.tree.remove(id);
        self.tree.insert(Aabb::new(raw(min), raw(max)), id);
    }

    pub(crate) fn remove(&mut self, id: usize) {
        if let Ok(id) = u32::try_from(id) {
            self.tree.remove(id);
        }
    }

    /// The first id that `wanted` takes among the boxes within `reach` of a segment.
    pub(crate) fn find_near(
        &self,
        segment: &Segment,
        reach: f64,
        mut wanted: impl FnMut(usize) -> bool,
    ) -> Option<usize> {
        let probe = Probe::new(segment, reach);
        let mut found = None;
        self.tree.traverse(|node| {
            let (min, max) = corners(node);
            if !probe.touches(min, max) {
                return TraversalAction::Prune;
            }
            if let Some(id) = node.leaf_data()
                && wanted(id as usize)
            {
                found = Some(id as usize);
                return TraversalAction::EarlyExit;
            }
            TraversalAction::Continue
        });
        found
    }

    /// Every id whose box touches a box.
    pub(crate) fn each_in_box(&self, min: Point, max: Point, mut found: impl FnMut(usize)) {
        self.tree.traverse(|node| {
            let (low, high) = corners(node);
            let apart = (0..2).any(|k| high[k] < min[k] || max[k] < low[k]);
            if apart {
                return TraversalAction::Prune;
            }
            if let Some(id) = node.leaf_data() {
                found(id as usize);
            }
            TraversalAction::Continue
        });
    }

    /// The least `distance` and whose it is; no box is nearer than what is in it. Ties go to the
    /// lowest id.
    pub(crate) fn nearest(
        &self,
        segment: &Segment,
        distance: impl Fn(usize) -> f64,
    ) -> Option<(f64, usize)> {
        let (low, high) = (segment.a.inf(&segment.b), segment.a.sup(&segment.b));
        let best: Cell<Option<(f64, usize)>> = Cell::new(None);
        // Nearer boxes first. The tree passes over what is not less than the best so far, so
        // boxes count as a little nearer than they are: one as near may hold a lower id.
        let to_box = |node: &BvhNode, least: f64| {
            let (min, max) = corners(node);
            let gap = |k: usize| (min[k] - high[k]).max(low[k] - max[k]).max(0.0);
            let (x, y) = (gap(0), gap(1));
            // The segment's own box is looked at first, for it takes less.
            let far = (x * x + y * y).sqrt();
            let far = if far < least {
                segment.distance_to_box(min, max)
            } else {
                far
            };
            far * (1.0 - 1e-15) - f64::MIN_POSITIVE
        };
        let to_shape = |id: u32, _| {
            let id = id as usize;
            let found = distance(id);
            let better = best.get().is_none_or(|(least, whose)| {
                found < least || found.total_cmp(&least).is_eq() && id < whose
            });
            if better {
                best.set(Some((found, id)));
            }
            Some(found)
        };
        self.tree.find_best(f64::INFINITY, to_box, to_shape);
        best.get()
    }
}

impl std::fmt::Debug for Index {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Index({} boxes)", self.tree.leaf_count())
    }
}

/// A segment made ready to be tested against many boxes: the separating axes of the two.
struct Probe {
    middle: Point,
    half: crate::Vector,
    reach: f64,
    /// How far the boxes may lie from the line in units of the segment's length.
    slack: f64,
}

impl Probe {
    fn new(segment: &Segment, reach: f64) -> Self {
        let half = (segment.b - segment.a) / 2.0;
        Self {
            middle: segment.a + half,
            half,
            reach,
            slack: reach * half.norm(),
        }
    }

    #[inline]
    fn touches(&self, min: Point, max: Point) -> bool {
        let extent = (max - min) / 2.0;
        let apart = self.middle - (min + extent);
        let x = apart.x.abs() <= extent.x + self.half.x.abs() + self.reach;
        let y = apart.y.abs() <= extent.y + self.half.y.abs() + self.reach;
        let across = (apart.x * self.half.y - apart.y * self.half.x).abs();
        let width = extent.x * self.half.y.abs() + extent.y * self.half.x.abs() + self.slack;
        // A little more than nothing for rounding: a box too many is no harm.
        x && y && across <= width * (1.0 + 1e-12) + f64::MIN_POSITIVE
    }
}
