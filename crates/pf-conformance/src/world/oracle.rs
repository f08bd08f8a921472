//! The truth about worlds: a plain Dijkstra over everything that touches, slow and easy to believe.
//!
//! A shortest path is made of straight pieces that touch two of the discs it may bend around, and
//! of arcs on these (T. Lozano-Perez, M. A. Wesley 1979; Y.-H. Liu, S. Arimoto 1992). So all these
//! pieces are listed, whichever way the path would turn and whether or not it could be shortened
//! there, and each is asked whether it is free. Nothing is kept, nothing is left out.

use super::arc::{Arc, on_circle};
use pf_core::Problem;
use pf_geom::{Point, Shape, TOUCH, WorldProblem};
use std::{cmp::Ordering, collections::BinaryHeap, f64::consts::TAU};

/// How much longer than the shortest path, arcs and all, a polyline may be and still be called
/// optimal, in the world's unit.
pub const SLACK: f64 = 1e-4;

/// A shortest path.
#[derive(Clone, Debug)]
pub struct Shortest {
    /// Its length with true arcs: no polyline is shorter, and some come as near as one likes.
    pub length: f64,
    /// A polyline at most half of [`SLACK`] longer.
    pub path: Vec<Point>,
}

/// The shortest path, or `None` if there is none.
///
/// ```
/// use pf_conformance::world::oracle;
/// use pf_geom::{Circle, Point, Rectangle, World, WorldProblem};
///
/// let bounds = Rectangle::new(Point::new(-5.0, -5.0), Point::new(5.0, 5.0)).unwrap();
/// let circle = Circle::new(Point::origin(), 1.0).unwrap();
/// let world = World::with_shapes(bounds, [circle.into()]);
/// let (start, goal) = (Point::new(-2.0, 0.0), Point::new(2.0, 0.0));
/// let problem = WorldProblem::new(world, 0.0, start, goal).unwrap();
///
/// let exact = 2.0 * 3f64.sqrt() + std::f64::consts::FRAC_PI_3;
/// assert!((oracle(&problem).unwrap().length - exact).abs() < 1e-12);
/// ```
#[must_use]
pub fn oracle(problem: &WorldProblem) -> Option<Shortest> {
    match search(problem, |_| true) {
        Found::Path(shortest) => Some(shortest),
        Found::Nothing | Found::Stopped => None,
    }
}

/// How a [`search`] ended.
pub(crate) enum Found {
    /// With a best path.
    Path(Shortest),
    /// Knowing that there is none.
    Nothing,
    /// When it was told to.
    Stopped,
}

/// Settles places in the order of their distance from the start, until the goal is. Each is shown
/// to `visit` before it is settled, which may say `false` to stop the search.
pub(crate) fn search(problem: &WorldProblem, mut visit: impl FnMut(Point) -> bool) -> Found {
    if !visit(problem.start()) {
        return Found::Stopped;
    }
    let ends = [problem.start(), problem.goal()];
    if ends.iter().any(|&end| !problem.is_free(end, end)) {
        return Found::Nothing;
    }
    let graph = Graph::of(problem);
    let mut reached: Vec<Option<(f64, Step)>> = vec![None; graph.places.len()];
    let mut open = BinaryHeap::new();
    let stay = Step {
        from: START,
        turn: 0.0,
    };
    reached[START] = Some((0.0, stay));
    open.push(Reached(0.0, START));
    while let Some(Reached(length, here)) = open.pop() {
        if reached[here].is_some_and(|(best, _)| best < length) {
            continue;
        }
        if here == GOAL {
            let mut way = vec![];
            let mut at = GOAL;
            while let Some((_, step)) = reached[at].filter(|_| at != START) {
                way.push((at, step.turn));
                at = step.from;
            }
            way.push((START, 0.0));
            way.reverse();
            let path = graph.polyline(problem, &way, length);
            return Found::Path(Shortest { length, path });
        }
        if here != START && !visit(graph.places[here].at) {
            return Found::Stopped;
        }
        graph.each_way_on(problem, here, |next, piece, turn| {
            let (best, through) = (&mut reached[next], length + piece);
            if best.is_none_or(|(best, _)| through < best) {
                *best = Some((through, Step { from: here, turn }));
                open.push(Reached(through, next));
            }
        });
    }
    Found::Nothing
}

/// How a place was reached.
#[derive(Clone, Copy)]
struct Step {
    from: usize,
    /// By what angle along a disc, counterclockwise; 0 for a straight piece.
    turn: f64,
}

/// The nearest is the greatest.
struct Reached(f64, usize);

impl PartialEq for Reached {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Reached {}
impl PartialOrd for Reached {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Reached {
    fn cmp(&self, other: &Self) -> Ordering {
        (other.0.total_cmp(&self.0)).then(other.1.cmp(&self.1))
    }
}

const START: usize = 0;
const GOAL: usize = 1;

/// What a path may bend around; a point if it has no radius.
struct Disc {
    centre: Point,
    radius: f64,
    /// The places on it, by angle.
    places: Vec<usize>,
}

/// Where a straight piece may end.
struct Place {
    at: Point,
    disc: usize,
    angle: f64,
    /// Where straight pieces from here lead that are free.
    straight: Vec<usize>,
    /// Its number among those of its disc.
    rank: usize,
}

struct Graph {
    discs: Vec<Disc>,
    places: Vec<Place>,
}

impl Graph {
    fn of(problem: &WorldProblem) -> Self {
        let mut graph = Self {
            discs: vec![],
            places: vec![],
        };
        // The points come first, so that start and goal are the first two places.
        let mut discs = vec![(problem.start(), 0.0), (problem.goal(), 0.0)];
        for (_, shape) in problem.world().shapes() {
            let corner = |&at: &Point| (at, problem.radius());
            match shape {
                Shape::Circle(c) => discs.push((c.centre(), c.radius() + problem.radius())),
                Shape::Rectangle(r) => discs.extend(r.corners().iter().map(corner)),
                Shape::Polygon(p) => discs.extend(p.corners().iter().map(corner)),
            }
        }
        for (centre, radius) in discs {
            graph.discs.push(Disc {
                centre,
                radius,
                places: vec![],
            });
            if radius <= 0.0 {
                graph.place(graph.discs.len() - 1, 0.0);
            }
        }
        for one in 0..graph.discs.len() {
            for other in 0..one {
                graph.join(problem, one, other);
            }
        }
        for disc in &mut graph.discs {
            let angle = |&place: &usize| graph.places[place].angle;
            disc.places
                .sort_by(|a, b| angle(a).total_cmp(&angle(b)).then(a.cmp(b)));
            for (rank, &place) in disc.places.iter().enumerate() {
                graph.places[place].rank = rank;
            }
        }
        graph
    }

    /// The place of a disc in the direction of an angle; a point has but one.
    fn place(&mut self, disc: usize, angle: f64) -> usize {
        let Disc { centre, radius, .. } = self.discs[disc];
        let points = &mut self.discs[disc].places;
        if radius <= 0.0
            && let Some(&place) = points.first()
        {
            return place;
        }
        points.push(self.places.len());
        self.places.push(Place {
            at: on_circle(centre, radius, angle),
            disc,
            angle: angle.rem_euclid(TAU),
            straight: vec![],
            rank: 0,
        });
        self.places.len() - 1
    }

    /// Lists the common tangents of two discs that are free: up to two that have both on one side,
    /// and up to two that pass between them.
    fn join(&mut self, problem: &WorldProblem, one: usize, other: usize) {
        let (a, b) = (&self.discs[one], &self.discs[other]);
        let (from, to) = ((a.centre, a.radius), (b.centre, b.radius));
        let apart = to.0 - from.0;
        let (distance, heading) = (apart.norm(), apart.y.atan2(apart.x));
        let both_points = from.1 <= 0.0 && to.1 <= 0.0;
        // Two discs about one point have no tangents, two points in one place have this one.
        if distance <= 0.0 && !both_points {
            return;
        }
        let one_point = from.1 <= 0.0 || to.1 <= 0.0;
        for (offset, across) in [(from.1 - to.1, 0.0), (from.1 + to.1, TAU / 2.0)] {
            // A point's tangents pass it on both sides.
            if across > 0.0 && one_point || offset.abs() > distance + TOUCH {
                continue;
            }
            let lean = (offset / distance.max(f64::MIN_POSITIVE))
                .clamp(-1.0, 1.0)
                .acos();
            for side in [lean, -lean] {
                let angles = [heading + side, heading + side + across];
                let p = on_circle(from.0, from.1, angles[0]);
                let q = on_circle(to.0, to.1, angles[1]);
                if problem.is_free(p, q) {
                    let (p, q) = (self.place(one, angles[0]), self.place(other, angles[1]));
                    self.places[p].straight.push(q);
                    self.places[q].straight.push(p);
                }
                if both_points {
                    return;
                }
            }
        }
    }

    /// The places that can be reached from here by one straight piece, or by an arc without
    /// another place on it; how far they are, and by what turn.
    fn each_way_on(
        &self,
        problem: &WorldProblem,
        here: usize,
        mut found: impl FnMut(usize, f64, f64),
    ) {
        let Place { at, rank, .. } = self.places[here];
        for &next in &self.places[here].straight {
            found(next, (self.places[next].at - at).norm(), 0.0);
        }
        let on_disc = &self.discs[self.places[here].disc].places;
        let all = on_disc.len();
        if all < 2 {
            return;
        }
        let (next, last) = (on_disc[(rank + 1) % all], on_disc[(rank + all - 1) % all]);
        for (from, to, reached, sign) in [(here, next, next, 1.0), (last, here, last, -1.0)] {
            let arc = self.arc(from, to);
            if arc.is_free(problem.world(), problem.radius()) {
                found(reached, arc.radius * arc.sweep, sign * arc.sweep);
            }
        }
    }

    /// From one place of a disc counterclockwise to the next.
    fn arc(&self, from: usize, to: usize) -> Arc {
        let (from, to) = (&self.places[from], &self.places[to]);
        let disc = &self.discs[from.disc];
        let sweep = (to.angle - from.angle).rem_euclid(TAU);
        Arc {
            centre: disc.centre,
            radius: disc.radius,
            from: from.angle,
            sweep,
        }
    }

    /// A way as a polyline that keeps outside the arcs, fine enough to be free and not too long.
    fn polyline(&self, problem: &WorldProblem, way: &[(usize, f64)], length: f64) -> Vec<Point> {
        let mut step = 0.2;
        loop {
            let path = self.flattened(way, step);
            let good = |cost| cost <= length + SLACK / 2.0;
            if step < 1e-5 || problem.judge(&path).is_ok_and(good) {
                return path;
            }
            step /= 2.0;
        }
    }

    /// In pieces of at most an angle of `step`.
    fn flattened(&self, way: &[(usize, f64)], step: f64) -> Vec<Point> {
        let mut path = vec![self.places[START].at];
        let mut rest = &way[1..];
        let mut here = START;
        while let Some(&(_, turn)) = rest.first() {
            // Arcs that follow each other are one.
            let pieces = rest.iter().take_while(|(_, on)| turn * on > 0.0).count();
            let pieces = pieces.max(1);
            let angle = rest[..pieces].iter().map(|(_, on)| on).sum::<f64>();
            if angle != 0.0 {
                let first = &self.places[here];
                let disc = &self.discs[first.disc];
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "some hundred thousand at most"
                )]
                let corners = (angle.abs() / step).ceil() as u32;
                let piece = angle / f64::from(corners);
                // Between two points of contact the tangents meet outside.
                let outside = disc.radius / (piece / 2.0).cos();
                path.extend((0..corners).map(|k| {
                    let angle = first.angle + piece * (f64::from(k) + 0.5);
                    on_circle(disc.centre, outside, angle)
                }));
            }
            here = rest[pieces - 1].0;
            path.push(self.places[here].at);
            rest = &rest[pieces..];
        }
        path
    }
}
