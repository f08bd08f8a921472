//! A taut path: straight pieces and arcs.

use super::disc::{Disc, Turn};
use crate::{Point, Vector};

/// A path of straight pieces and arcs, as taut as a string.
#[derive(Clone, Debug)]
pub struct Route {
    pub(super) start: Point,
    pub(super) goal: Point,
    pub(super) bends: Vec<Bend>,
    pub(super) length: f64,
}

/// Where a [`Route`] goes round something: a corner, or an arc.
#[derive(Clone, Copy, Debug)]
pub struct Bend {
    /// The middle of the arc.
    pub centre: Point,
    /// Its radius; 0 at the corner of an obstacle that a point robot passes.
    pub radius: f64,
    /// By how much the path turns, in radians: positive to the left.
    pub angle: f64,
    /// Unit vector from the middle to where the arc begins.
    pub from: Vector,
}

impl Bend {
    pub(super) fn new(disc: &Disc, from: Vector, angle: f64, turn: Turn) -> Self {
        Self {
            centre: disc.centre,
            radius: disc.radius,
            angle: angle * turn.sign(),
            from,
        }
    }

    /// Unit vector from the middle to where the path is after turning by `angle`.
    fn towards(&self, angle: f64) -> Vector {
        let (sine, cosine) = angle.sin_cos();
        let (x, y) = (self.from.x, self.from.y);
        Vector::new(x * cosine - y * sine, x * sine + y * cosine)
    }

    fn at(&self, angle: f64, radius: f64) -> Point {
        self.centre + self.towards(angle) * radius
    }
}

impl Route {
    /// The same route, from its goal to its start.
    pub(super) fn reversed(mut self) -> Self {
        std::mem::swap(&mut self.start, &mut self.goal);
        self.bends.reverse();
        for bend in &mut self.bends {
            bend.from = bend.towards(bend.angle);
            bend.angle = -bend.angle;
        }
        self
    }

    /// Its length, arcs and all.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Where it bends, in the order of the path.
    #[must_use]
    pub fn bends(&self) -> &[Bend] {
        &self.bends
    }

    /// The route as a polyline whose pieces never cut into an arc: they touch it from outside, and
    /// the whole is at most `excess` longer.
    #[must_use]
    pub fn flattened(&self, excess: f64) -> Vec<Point> {
        let mut path = Vec::new();
        self.flatten_into(excess, &mut path);
        path
    }

    /// The same, in place of what `path` held.
    pub fn flatten_into(&self, excess: f64, path: &mut Vec<Point>) {
        let arcs = self.bends.iter().filter(|bend| is_arc(bend)).count().max(1);
        #[expect(clippy::cast_precision_loss, reason = "a number of bends")]
        let share = excess / arcs as f64;
        path.clear();
        path.push(self.start);
        for bend in &self.bends {
            if !is_arc(bend) {
                path.push(bend.at(0.0, bend.radius));
                continue;
            }
            let pieces = pieces(bend, share);
            let step = bend.angle / f64::from(pieces);
            path.push(bend.at(0.0, bend.radius));
            // Between two points of contact the tangents meet outside.
            let outside = bend.radius / (step / 2.0).cos();
            path.extend((0..pieces).map(|k| bend.at(step * (f64::from(k) + 0.5), outside)));
            path.push(bend.at(bend.angle, bend.radius));
        }
        path.push(self.goal);
        path.dedup_by(|a, b| (*a - *b).norm() <= 1e-12);
        if path.len() == 1 {
            path.push(self.goal);
        }
    }
}

fn is_arc(bend: &Bend) -> bool {
    bend.radius * bend.angle.abs() > 1e-12
}

/// Into how many pieces an arc must be cut to gain no more than `excess` in length: a piece of
/// angle d gains r (2 tan(d/2) - d), which is below r d^3 / 11 up to a third of a turn.
fn pieces(bend: &Bend, excess: f64) -> u32 {
    let angle = bend.angle.abs();
    let wanted = (bend.radius * angle.powi(3) / (11.0 * excess)).sqrt();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a small number; casts of floats saturate"
    )]
    let pieces = wanted.max(angle).ceil() as u32;
    pieces.clamp(1, 100_000)
}
