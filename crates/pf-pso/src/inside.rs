//! How much of a segment lies within a shape grown by a reach, in closed form.

use pf_geom::{Point, Segment, Shape, cross};

/// The length of a segment within `reach` of a shape.
pub(crate) fn length_inside(shape: &Shape, segment: &Segment, reach: f64) -> f64 {
    let part = match shape {
        Shape::Circle(c) => extent(in_disc(segment, c.centre(), c.radius() + reach)),
        Shape::Rectangle(r) => {
            // The grown rectangle is convex: what is inside is one piece.
            let grown = |x: f64, y: f64| {
                let by = pf_geom::Vector::new(x, y);
                segment.within_box(r.min() - by, r.max() + by)
            };
            let corners = r.corners().map(|c| in_disc(segment, c, reach));
            let boxes = [grown(reach, 0.0), grown(0.0, reach)];
            extent(boxes.into_iter().chain(corners).flatten())
        }
        Shape::Polygon(p) => {
            let mut pieces: Vec<(f64, f64)> = p
                .sides()
                .filter_map(|side| hull(in_capsule(segment, &side, reach)))
                .collect();
            pieces.extend(in_polygon(segment, p));
            together(pieces)
        }
    };
    part * segment.length()
}

/// From the first to the last place of pieces that make up one.
fn hull(pieces: impl IntoIterator<Item = (f64, f64)>) -> Option<(f64, f64)> {
    pieces
        .into_iter()
        .reduce(|(from, to), (f, t)| (from.min(f), to.max(t)))
}

fn extent(pieces: impl IntoIterator<Item = (f64, f64)>) -> f64 {
    hull(pieces).map_or(0.0, |(from, to)| to - from)
}

/// How much the pieces cover together.
fn together(mut pieces: Vec<(f64, f64)>) -> f64 {
    pieces.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut covered, mut upto) = (0.0, 0.0f64);
    for (from, to) in pieces {
        covered += (to - from.max(upto)).max(0.0);
        upto = upto.max(to);
    }
    covered
}

/// The piece of a segment within a disc, 0 to 1.
fn in_disc(segment: &Segment, centre: Point, radius: f64) -> Option<(f64, f64)> {
    let (along, from) = (segment.b - segment.a, segment.a - centre);
    let (a, b) = (along.norm_squared(), from.dot(&along));
    let rest = b * b - a * (from.norm_squared() - radius * radius);
    if a <= 0.0 || rest <= 0.0 {
        return None;
    }
    let root = rest.sqrt();
    let (from, to) = (((-b - root) / a).max(0.0), ((-b + root) / a).min(1.0));
    (from < to).then_some((from, to))
}

/// The pieces of a segment within the parts of a capsule, which is convex.
fn in_capsule(
    segment: &Segment,
    side: &Segment,
    radius: f64,
) -> impl Iterator<Item = (f64, f64)> + use<> {
    let along = side.b - side.a;
    let length = along.norm();
    // The box between the ends, seen along the side.
    let seen = |p: Point| {
        let from = p - side.a;
        Point::new(from.dot(&along) / length, cross(along, from) / length)
    };
    let turned = Segment::new(seen(segment.a), seen(segment.b));
    let middle = turned.within_box(Point::new(0.0, -radius), Point::new(length, radius));
    let ends = [side.a, side.b].map(|end| in_disc(segment, end, radius));
    ends.into_iter().flatten().chain(middle)
}

/// The pieces of a segment inside a polygon.
fn in_polygon(segment: &Segment, polygon: &pf_geom::Polygon) -> Vec<(f64, f64)> {
    let along = segment.b - segment.a;
    let mut breaks = vec![0.0, 1.0];
    for side in polygon.sides() {
        let across = cross(along, side.b - side.a);
        if across != 0.0 {
            let t = cross(side.a - segment.a, side.b - side.a) / across;
            breaks.push(t.clamp(0.0, 1.0));
        }
    }
    breaks.sort_by(f64::total_cmp);
    let pieces = breaks.windows(2).map(|w| (w[0], w[1]));
    pieces
        .filter(|(from, to)| polygon.contains(segment.at(f64::midpoint(*from, *to))))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pf_conformance::{
        seeded,
        world::{Obstacles, waypoint_world},
    };
    use rand::RngExt;

    #[test]
    fn lengths_are_those_of_many_samples() {
        let mut rng = seeded(4);
        let mut inside = 0;
        for seed in 0..300 {
            let problem = waypoint_world(seed, 1, Obstacles::Mixed);
            let (_, shape) = problem.world().shapes().next().unwrap();
            let (min, max) = shape.bounding_box();
            let reach = if seed % 3 == 0 {
                0.0
            } else {
                rng.random_range(0.0..1.5)
            };
            for _ in 0..10 {
                let mut place = |k: usize| rng.random_range(min[k] - 2.0..max[k] + 2.0);
                let segment = Segment::new(
                    Point::new(place(0), place(1)),
                    Point::new(place(0), place(1)),
                );
                let within = |k: &u32| {
                    shape.distance_to_point(segment.at((f64::from(*k) + 0.5) / 4000.0)) <= reach
                };
                let part =
                    f64::from(u32::try_from((0..4000).filter(within).count()).unwrap()) / 4000.0;
                let found = length_inside(shape, &segment, reach) / segment.length();
                assert!(
                    (part - found).abs() < 2e-3,
                    "{shape:?} {segment:?} {reach}: {part} {found}"
                );
                inside += usize::from(part > 0.0);
            }
        }
        assert!(inside > 1000);
    }
}
