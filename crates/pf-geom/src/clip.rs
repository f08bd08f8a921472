//! What of a polygon lies in a window.

use crate::{Point, cross};

/// A polygon clipped to a window, part by part. Keeps its lists from polygon to polygon.
#[derive(Clone, Debug, Default)]
pub(crate) struct Clipper {
    min: Point,
    max: Point,
    list: Vec<Point>,
    work: Vec<Point>,
    /// The parts' corners, one after the other, counterclockwise.
    corners: Vec<Point>,
    /// Where each part ends.
    ends: Vec<usize>,
    chains: Vec<Chain>,
}

/// A piece of border inside the window, from where it comes in to where it goes out.
#[derive(Clone, Copy, Debug)]
struct Chain {
    /// First corner and how many.
    from: usize,
    len: usize,
    /// Where on the window's border.
    entry: f64,
    exit: f64,
    used: bool,
}

/// One part of a polygon in a window.
pub(crate) struct Part<'a> {
    corners: &'a [Point],
    min: Point,
    max: Point,
}

impl Clipper {
    /// Clips a polygon, its corners counterclockwise. `false` if it covers the whole window.
    pub(crate) fn clip(&mut self, polygon: &[Point], (min, max): (Point, Point)) -> bool {
        (self.min, self.max) = (min, max);
        self.list.clear();
        self.list.extend_from_slice(polygon);
        for k in 0..2 {
            self.cut(k, min[k], 1.0);
            self.cut(k, max[k], -1.0);
        }
        self.corners.clear();
        self.ends.clear();
        let n = self.list.len();
        let along = (0..n).find(|&i| self.runs_along(i));
        match along {
            None => self.end_part_with_list(),
            Some(first) => {
                self.find_chains(first);
                if self.chains.is_empty() {
                    return twice_area(&self.list) <= 0.0;
                }
                self.link_chains();
            }
        }
        true
    }

    pub(crate) fn parts(&self) -> impl Iterator<Item = Part<'_>> {
        let begins = std::iter::once(0).chain(self.ends.iter().copied());
        begins.zip(&self.ends).map(|(from, &to)| Part {
            corners: &self.corners[from..to],
            min: self.min,
            max: self.max,
        })
    }

    /// Cuts off where coordinate `k` times `sign` is less than `limit` times `sign` (Sutherland
    /// and Hodgman 1974).
    fn cut(&mut self, k: usize, limit: f64, sign: f64) {
        let Self { list, work, .. } = self;
        let inside = |p: Point| (p[k] - limit) * sign >= 0.0;
        work.clear();
        for (i, &to) in list.iter().enumerate() {
            let from = list[(i + list.len() - 1) % list.len()];
            if inside(from) != inside(to) {
                // From the end inside, which is known; the other may be any point of the line.
                let (a, b) = if inside(from) { (from, to) } else { (to, from) };
                let mut crossing = a + (b - a) * ((limit - a[k]) / (b[k] - a[k]));
                crossing[k] = limit;
                work.push(crossing);
            }
            if inside(to) {
                work.push(to);
            }
        }
        work.dedup();
        while work.len() > 1 && work.first() == work.last() {
            work.pop();
        }
        std::mem::swap(list, work);
    }

    /// Whether the side from corner `i` of the list runs along the window's border.
    fn runs_along(&self, i: usize) -> bool {
        let (a, b) = (self.list[i], self.list[(i + 1) % self.list.len()]);
        border_of(a, b, self.min, self.max).is_some()
    }

    fn end_part_with_list(&mut self) {
        if self.list.len() > 2 {
            self.corners.extend_from_slice(&self.list);
            self.ends.push(self.corners.len());
        }
    }

    /// The pieces between sides along the window's border, of which `first` is one.
    fn find_chains(&mut self, first: usize) {
        let n = self.list.len();
        self.chains.clear();
        let mut from = first + 1;
        while from <= first + n {
            let sides = (from..first + n).take_while(|&i| !self.runs_along(i % n));
            let len = sides.count() + 1;
            if len > 1 {
                let chain = Chain {
                    from: from % n,
                    len,
                    entry: self.way_round(self.list[from % n]),
                    exit: self.way_round(self.list[(from + len - 1) % n]),
                    used: false,
                };
                self.chains.push(chain);
            }
            from += len;
        }
    }

    /// Joins the pieces to parts: counterclockwise along the window's border the polygon's inside
    /// goes on from where one piece goes out to where the next comes in.
    fn link_chains(&mut self) {
        let size = self.max - self.min;
        let around = 2.0 * (size.x + size.y);
        let ahead = |from: f64, to: f64| (to - from).rem_euclid(around);
        let (min, max) = (self.min, self.max);
        let window = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)];
        for first in 0..self.chains.len() {
            let mut at = first;
            while !self.chains[at].used {
                self.chains[at].used = true;
                let Chain {
                    from, len, exit, ..
                } = self.chains[at];
                let n = self.list.len();
                let piece = (from..from + len).map(|i| self.list[i % n]);
                self.corners.extend(piece);
                let open = (0..self.chains.len()).filter(|&k| k == first || !self.chains[k].used);
                let gap = |k: usize| ahead(exit, self.chains[k].entry);
                let next = open.min_by(|&a, &b| gap(a).total_cmp(&gap(b)));
                at = next.unwrap_or(first);
                let mut round = window.map(|p| (ahead(exit, self.way_round(p)), p));
                round.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
                let upto = gap(at);
                let between = round.iter().filter(|&&(way, _)| 0.0 < way && way < upto);
                self.corners.extend(between.map(|&(_, p)| p));
            }
            if self.ends.last().copied().unwrap_or(0) < self.corners.len() {
                self.ends.push(self.corners.len());
            }
        }
    }

    /// How far round the window's border a point of it is, counterclockwise from the lower left.
    #[expect(clippy::float_cmp, reason = "cutting puts points exactly there")]
    fn way_round(&self, p: Point) -> f64 {
        let size = self.max - self.min;
        if p.y == self.min.y {
            p.x - self.min.x
        } else if p.x == self.max.x {
            size.x + (p.y - self.min.y)
        } else if p.y == self.max.y {
            size.x + size.y + (self.max.x - p.x)
        } else {
            2.0 * size.x + size.y + (self.max.y - p.y)
        }
    }
}

impl Part<'_> {
    /// The part's corners, with what lies along the window's border moved out by `margin`. The
    /// list begins with the least corner, wherever the polygon began.
    pub(crate) fn draw_out(&self, margin: f64, into: &mut Vec<Point>) {
        into.clear();
        let n = self.corners.len();
        let side = |i: usize| {
            let (from, to) = (self.corners[i % n], self.corners[(i + 1) % n]);
            border_of(from, to, self.min, self.max)
        };
        let moved = |p: Point, (k, sign): (usize, f64)| {
            let mut p = p;
            p[k] += sign * margin;
            p
        };
        for i in 0..n {
            let (from, to) = (self.corners[i], self.corners[(i + 1) % n]);
            let (before, here) = (side(i + n - 1), side(i));
            into.push(match (before, here) {
                (Some(before), Some(here)) => moved(moved(from, before), here),
                _ => from,
            });
            into.extend(
                here.into_iter()
                    .flat_map(|here| [moved(from, here), moved(to, here)]),
            );
        }
        let places = into.iter().enumerate();
        let least = places.min_by(|(_, p), (_, q)| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
        let least = least.map_or(0, |(i, _)| i);
        into.rotate_left(least);
    }
}

/// On which border of a window two points both lie: the coordinate, and -1 for the lower one or 1.
#[expect(clippy::float_cmp, reason = "cutting puts points exactly there")]
fn border_of(a: Point, b: Point, min: Point, max: Point) -> Option<(usize, f64)> {
    (0..2).find_map(|k| {
        let on = |limit: f64| a[k] == limit && b[k] == limit;
        if on(min[k]) {
            Some((k, -1.0))
        } else if on(max[k]) {
            Some((k, 1.0))
        } else {
            None
        }
    })
}

fn twice_area(corners: &[Point]) -> f64 {
    let origin = corners.first().copied().unwrap_or_default();
    let triangles = corners.windows(2);
    triangles.map(|w| cross(w[0] - origin, w[1] - origin)).sum()
}
