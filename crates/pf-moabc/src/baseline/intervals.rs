//! When a place is safe, and whether a move is: the robots planned before, in time.

use pf_geom::{Point, Segment, TimedPath, TimedPoint};

/// How much farther away than they must robots stay, for rounding.
const SPARE: f64 = 1e-6;

/// Paths to keep away from, and how far.
#[derive(Clone, Debug, Default)]
pub(super) struct Traffic {
    others: Vec<(TimedPath, f64)>,
    settled: f64,
}

/// From when until when a place is safe.
pub(super) type Interval = (f64, f64);

impl Traffic {
    pub(super) fn add(&mut self, path: &[TimedPoint], reach: f64) {
        let end = path.last().map_or(0.0, |p| p.time);
        self.settled = self.settled.max(end);
        self.others.push((path.to_vec(), reach + SPARE));
    }

    /// When all have arrived.
    pub(super) fn settled(&self) -> f64 {
        self.settled
    }

    /// The intervals in which a place is safe, in their order.
    pub(super) fn safe(&self, place: Point, intervals: &mut Vec<Interval>) {
        let mut unsafe_ones: Vec<Interval> = Vec::new();
        for (path, reach) in &self.others {
            for pair in path.windows(2) {
                unsafe_ones.extend(too_near(place, &pair[0], &pair[1], *reach));
            }
            if let Some(end) = path.last().filter(|end| (end.at - place).norm() < *reach) {
                unsafe_ones.push((end.time, f64::INFINITY));
            }
        }
        unsafe_ones.sort_by(|a, b| a.0.total_cmp(&b.0));
        intervals.clear();
        let mut from = 0.0;
        for (begin, end) in unsafe_ones {
            if begin > from {
                intervals.push((from, begin));
            }
            from = end.max(from);
        }
        if from < f64::INFINITY {
            intervals.push((from, f64::INFINITY));
        }
    }

    /// Whether a straight move keeps away from all others.
    pub(super) fn is_clear(&self, from: &TimedPoint, to: &TimedPoint) -> bool {
        self.others.iter().all(|(path, reach)| {
            // The pieces of the other's path that fall into the time of the move.
            let first = path
                .partition_point(|p| p.time <= from.time)
                .saturating_sub(1);
            let last = path
                .partition_point(|p| p.time < to.time)
                .min(path.len() - 1);
            let other = &path[first..=last.max(first)];
            within(other, from, to, *reach)
        })
    }

    /// Whether the end of a path is safe for good.
    pub(super) fn lets_rest(&self, path: &[TimedPoint]) -> bool {
        let Some(end) = path.last() else { return false };
        let mut intervals = Vec::new();
        self.safe(end.at, &mut intervals);
        let last = intervals.last();
        last.is_some_and(|(from, to)| *from <= end.time && *to == f64::INFINITY)
    }
}

/// Whether a move stays so far from another path, of which it is shown what falls into its time.
fn within(other: &[TimedPoint], from: &TimedPoint, to: &TimedPoint, reach: f64) -> bool {
    let keeps = |theirs: [Point; 2], begin: f64, end: f64| {
        let ours = [place(from, to, begin), place(from, to, end)];
        let relative = Segment::new(
            Point::from(ours[0] - theirs[0]),
            Point::from(ours[1] - theirs[1]),
        );
        relative.distance_to_point(Point::origin()) >= reach
    };
    let moving = other.windows(2).all(|pair| {
        let (begin, end) = (pair[0].time.max(from.time), pair[1].time.min(to.time));
        let theirs = [begin, end].map(|time| place(&pair[0], &pair[1], time));
        begin > end || keeps(theirs, begin, end)
    });
    let rests = |last: &TimedPoint| {
        last.time >= to.time || keeps([last.at; 2], last.time.max(from.time), to.time)
    };
    moving && other.last().is_none_or(rests)
}

/// Where a straight and even move is at a time.
fn place(from: &TimedPoint, to: &TimedPoint, time: f64) -> Point {
    let span = to.time - from.time;
    if span <= 0.0 {
        return to.at;
    }
    from.at + (to.at - from.at) * ((time - from.time) / span).clamp(0.0, 1.0)
}

/// When a robot that moves straight is nearer to a place than it may be.
fn too_near(place: Point, from: &TimedPoint, to: &TimedPoint, reach: f64) -> Option<Interval> {
    let (apart, along) = (from.at - place, to.at - from.at);
    let (a, b) = (along.norm_squared(), apart.dot(&along));
    let c = apart.norm_squared() - reach * reach;
    if a <= 0.0 {
        return (c < 0.0).then_some((from.time, to.time));
    }
    let root = b * b - a * c;
    if root <= 0.0 {
        return None;
    }
    let (enter, leave) = ((-b - root.sqrt()) / a, (-b + root.sqrt()) / a);
    if leave <= 0.0 || enter >= 1.0 {
        return None;
    }
    let span = to.time - from.time;
    Some((
        from.time + span * enter.max(0.0),
        from.time + span * leave.min(1.0),
    ))
}
