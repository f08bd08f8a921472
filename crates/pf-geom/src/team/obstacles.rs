//! Obstacles as planners of fronts look at them: a hundred thousand paths, a few obstacles.

use crate::{Point, Segment, Shape, ShapeId, Vector, World};

/// The boxes around the obstacles, in one row.
#[derive(Clone, Debug, Default)]
pub(super) struct Obstacles {
    boxes: Vec<(Point, Point, ShapeId)>,
}

/// What a segment is to the obstacles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    /// The least distance that is left, at most as much as was asked for.
    pub(super) clearance: f64,
    /// How deep it enters obstacles, summed; 0 if it enters none.
    pub(super) depth: f64,
}

impl Obstacles {
    pub(super) fn of(world: &World) -> Self {
        let boxes = world.shapes().map(|(id, shape)| {
            let (min, max) = shape.bounding_box();
            (min, max, id)
        });
        Self {
            boxes: boxes.collect(),
        }
    }

    /// Looks at a disc of `radius` that moves along a segment; clearances from `limit` on are all
    /// one.
    #[inline]
    pub(super) fn near(&self, world: &World, segment: &Segment, radius: f64, limit: f64) -> Near {
        let (low, high) = (segment.a.inf(&segment.b), segment.a.sup(&segment.b));
        let mut near = Near {
            clearance: limit,
            depth: 0.0,
        };
        for &(min, max, id) in &self.boxes {
            let x = (min.x - high.x).max(low.x - max.x).max(0.0);
            let y = (min.y - high.y).max(low.y - max.y).max(0.0);
            let reach = near.clearance + radius;
            if x * x + y * y > reach * reach {
                continue;
            }
            let Some(shape) = world.shape(id) else {
                continue;
            };
            let distance = shape.distance(segment);
            near.clearance = near.clearance.min((distance - radius).max(0.0));
            if (distance < radius || distance <= 0.0) && shape.blocks(segment, radius) {
                near.depth += depth(shape, segment, radius);
            }
        }
        near
    }
}

/// How deep a segment that enters a grown shape does: for a circle the depth, for others the length
/// inside the grown box; never 0.
fn depth(shape: &Shape, segment: &Segment, radius: f64) -> f64 {
    let depth = if let Shape::Circle(c) = shape {
        c.radius() + radius - segment.distance_to_point(c.centre())
    } else {
        let (min, max) = shape.bounding_box();
        let grown = Vector::repeat(radius);
        let inside = segment.within_box(min - grown, max + grown);
        inside.map_or(0.0, |(from, to)| (to - from) * segment.length())
    };
    depth.max(f64::MIN_POSITIVE)
}
