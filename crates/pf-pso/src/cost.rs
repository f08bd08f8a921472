//! What a path through waypoints costs: its length, and a penalty for danger (eq. 3, 4).

use crate::{
    inside::length_inside,
    params::{Penalty, PsoParams, Zones},
};
use pf_geom::{Point, Segment, Shape, WorldProblem};

/// The cost of paths of one problem.
#[derive(Clone, Debug, Default)]
pub(crate) struct Danger {
    /// Middle and radius, for [`Zones::Circles`].
    circles: Vec<(Point, f64)>,
}

impl Danger {
    /// Takes the place of whatever it held.
    pub(crate) fn fill(&mut self, problem: &WorldProblem, params: &PsoParams) {
        self.circles.clear();
        if params.zones == Zones::Circles {
            let shapes = problem.world().shapes().map(|(_, shape)| shape);
            let zones = shapes.map(about).map(|(c, r)| (c, r + params.clearance));
            self.circles.extend(zones);
        }
    }

    /// What a segment in danger costs.
    pub(crate) fn penalty(
        &self,
        problem: &WorldProblem,
        params: &PsoParams,
        segment: &Segment,
    ) -> f64 {
        let inside = match (params.zones, params.penalty) {
            (Zones::Circles, Penalty::Crossing) => {
                let enters =
                    |&(centre, radius): &(Point, f64)| segment.distance_to_point(centre) < radius;
                f64::from(u8::from(self.circles.iter().any(enters)))
            }
            (Zones::Circles, Penalty::Length) => {
                let zones = self.circles.iter();
                zones
                    .map(|&(centre, radius)| chord(segment, centre, radius))
                    .sum()
            }
            (Zones::Shapes, Penalty::Crossing) => {
                let reach = problem.radius() + params.clearance;
                f64::from(u8::from(problem.world().blocker(segment, reach).is_some()))
            }
            (Zones::Shapes, Penalty::Length) => {
                let world = problem.world();
                let reach = problem.radius() + params.clearance;
                if world.blocker(segment, reach).is_none() {
                    return 0.0;
                }
                let by = pf_geom::Vector::repeat(reach);
                let (min, max) = (
                    segment.a.inf(&segment.b) - by,
                    segment.a.sup(&segment.b) + by,
                );
                let near = world
                    .within(min, max)
                    .into_iter()
                    .filter_map(|id| world.shape(id));
                near.map(|shape| length_inside(shape, segment, reach)).sum()
            }
        };
        params.weight * inside
    }

    /// Length and penalty of the path through `waypoints`, x and y by turns.
    pub(crate) fn cost(
        &self,
        problem: &WorldProblem,
        params: &PsoParams,
        waypoints: &[f64],
    ) -> f64 {
        let mut cost = 0.0;
        let mut from = problem.start();
        let inner = waypoints.chunks_exact(2).map(|w| Point::new(w[0], w[1]));
        for to in inner.chain([problem.goal()]) {
            let segment = Segment::new(from, to);
            cost += segment.length() + self.penalty(problem, params, &segment);
            from = to;
        }
        cost
    }
}

fn chord(segment: &Segment, centre: Point, radius: f64) -> f64 {
    pf_geom::Circle::new(centre, radius)
        .map_or(0.0, |circle| length_inside(&circle.into(), segment, 0.0))
}

/// The circle about a shape's middle that holds all of it.
fn about(shape: &Shape) -> (Point, f64) {
    let (min, max) = shape.bounding_box();
    let middle = between(min, max);
    let radius = match shape {
        Shape::Circle(circle) => circle.radius(),
        Shape::Rectangle(_) => (max - middle).norm(),
        Shape::Polygon(polygon) => {
            let corners = polygon.corners().iter();
            corners.map(|c| (c - middle).norm()).fold(0.0, f64::max)
        }
    };
    (middle, radius)
}

fn between(min: Point, max: Point) -> Point {
    min + (max - min) / 2.0
}
