//! Where the robot has been: a height over the plane that grows with every visit.
//!
//! A visit raises a cone of height 1 over the place. The sum of all cones is kept at the nodes of a
//! lattice, in tiles of which only those near the walk exist; so neither a visit nor a look at the
//! window costs more the longer the walk is. Between nodes the height is bilinear.

use pf_geom::Point;

/// Nodes along the radius of a cone.
const FINE: f64 = 8.0;
/// Nodes along the side of a tile.
const SIDE: i64 = 16;
const TILE: usize = 16 * 16;
/// Tiles there is room for from the first visit on: for cones of radius 6, a world of 120 by 120.
const ROOM: usize = 128;
/// Beyond this many nodes from the origin all is one place.
const FAR: f64 = 1e12;
/// More than a window can hold, but for rounding.
const WIDEST: i64 = 2 * 64 + 8;

/// See the [module's page](self).
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    radius: f64,
    spacing: f64,
    tiles: Tiles,
    patch: Patch,
}

/// The tiles by their places: a hash table with linear probing.
#[derive(Clone, Debug, Default)]
struct Tiles {
    /// Which tile lies in each slot, from 1; 0 for none.
    slots: Vec<u32>,
    places: Vec<[i64; 2]>,
    heights: Vec<f64>,
}

/// The heights in the window.
#[derive(Clone, Debug, Default)]
struct Patch {
    origin: [i64; 2],
    size: [usize; 2],
    heights: Vec<f64>,
}

impl Memory {
    /// Cones of this radius.
    pub(crate) fn new(radius: f64) -> Self {
        Self {
            radius,
            spacing: radius / FINE,
            ..Self::default()
        }
    }

    /// Forgets everything and keeps its room.
    pub(crate) fn clear(&mut self) {
        self.tiles.clear();
    }

    /// The same places and heights, in the room there is.
    pub(crate) fn copy(&mut self, other: &Self) {
        (self.radius, self.spacing) = (other.radius, other.spacing);
        self.tiles.slots.clone_from(&other.tiles.slots);
        self.tiles.places.clone_from(&other.tiles.places);
        self.tiles.heights.clone_from(&other.tiles.heights);
    }

    #[expect(clippy::cast_possible_truncation, reason = "bounded above")]
    fn node(&self, x: f64) -> i64 {
        (x / self.spacing).floor().clamp(-FAR, FAR) as i64
    }

    #[expect(clippy::cast_precision_loss, reason = "bounded by FAR")]
    fn place(&self, node: i64) -> f64 {
        node as f64 * self.spacing
    }

    /// Raises a cone over a place.
    pub(crate) fn visit(&mut self, p: Point) {
        let r = self.radius;
        let ends = |x: f64| [self.node(x - r) + 1, self.node(x + r)];
        let ([left, right], [low, high]) = (ends(p.x), ends(p.y));
        for row in low.div_euclid(SIDE)..=high.div_euclid(SIDE) {
            for column in left.div_euclid(SIDE)..=right.div_euclid(SIDE) {
                let tile = self.tiles.make([column, row]);
                for y in low.max(row * SIDE)..=high.min(row * SIDE + SIDE - 1) {
                    let dy = self.place(y) - p.y;
                    for x in left.max(column * SIDE)..=right.min(column * SIDE + SIDE - 1) {
                        let dx = self.place(x) - p.x;
                        let rise = 1.0 - (dx * dx + dy * dy).sqrt() / r;
                        if rise > 0.0 {
                            self.tiles.heights[tile * TILE + within(x, y)] += rise;
                        }
                    }
                }
            }
        }
    }

    /// Lowers everything in a box, grown by the radius of a cone, by a factor.
    pub(crate) fn fade(&mut self, (min, max): (Point, Point), factor: f64) {
        let from = [
            self.node(min.x - self.radius),
            self.node(min.y - self.radius),
        ];
        let to = [
            self.node(max.x + self.radius),
            self.node(max.y + self.radius),
        ];
        for tile in 0..self.tiles.places.len() {
            let corner = self.tiles.places[tile].map(|k| k * SIDE);
            let ends = |k: usize| from[k].max(corner[k])..=to[k].min(corner[k] + SIDE - 1);
            for y in ends(1) {
                for x in ends(0) {
                    self.tiles.heights[tile * TILE + within(x, y)] *= factor;
                }
            }
        }
    }

    /// Takes the heights in a window to hand.
    pub(crate) fn look(&mut self, low: Point, high: Point) {
        let origin = [self.node(low.x), self.node(low.y)];
        let ends = [self.node(high.x) + 1, self.node(high.y) + 1];
        let size = [0, 1].map(|k| (ends[k] - origin[k] + 1).clamp(2, WIDEST));
        let ends = [0, 1].map(|k| origin[k] + size[k] - 1);
        let patch = &mut self.patch;
        patch.origin = origin;
        patch.size = size.map(|side| usize::try_from(side).unwrap_or(2));
        patch.heights.clear();
        patch.heights.resize(patch.size[0] * patch.size[1], 0.0);
        for row in origin[1].div_euclid(SIDE)..=ends[1].div_euclid(SIDE) {
            for column in origin[0].div_euclid(SIDE)..=ends[0].div_euclid(SIDE) {
                let Some(tile) = self.tiles.find([column, row]) else {
                    continue;
                };
                let (left, right) = (
                    origin[0].max(column * SIDE),
                    ends[0].min(column * SIDE + SIDE - 1),
                );
                let width = usize::try_from(right - left + 1).unwrap_or(0);
                for y in origin[1].max(row * SIDE)..=ends[1].min(row * SIDE + SIDE - 1) {
                    let from = tile * TILE + within(left, y);
                    let into = offset(y - origin[1]) * patch.size[0] + offset(left - origin[0]);
                    let heights = &self.tiles.heights[from..from + width];
                    patch.heights[into..into + width].copy_from_slice(heights);
                }
            }
        }
    }

    /// The height at a place in the window that was looked at last.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_precision_loss,
        clippy::cast_sign_loss,
        reason = "bounded by the patch"
    )]
    pub(crate) fn height(&self, p: Point) -> f64 {
        let patch = &self.patch;
        let along = |k: usize| {
            let most = (patch.size[k] - 1) as f64;
            let at = (p[k] / self.spacing - patch.origin[k] as f64).clamp(0.0, most);
            let cell = (at as usize).min(patch.size[k] - 2);
            (cell, at - cell as f64)
        };
        let ((column, right), (row, up)) = (along(0), along(1));
        let between = |row: usize| {
            let at = row * patch.size[0] + column;
            patch.heights[at] * (1.0 - right) + patch.heights[at + 1] * right
        };
        between(row) * (1.0 - up) + between(row + 1) * up
    }
}

/// Where a node lies in its tile.
fn within(x: i64, y: i64) -> usize {
    offset(y.rem_euclid(SIDE) * SIDE + x.rem_euclid(SIDE))
}

fn offset(n: i64) -> usize {
    usize::try_from(n).unwrap_or(0)
}

impl Tiles {
    fn clear(&mut self) {
        self.slots.fill(0);
        self.places.clear();
        self.heights.clear();
    }

    /// The slot where a tile lies, or would.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a hash"
    )]
    fn slot(&self, place: [i64; 2]) -> usize {
        let mixed = (place[0] as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)
            ^ (place[1] as u64).wrapping_mul(0xc2b2_ae3d_27d4_eb4f);
        let mut slot = (mixed ^ mixed >> 32) as usize & (self.slots.len() - 1);
        loop {
            match self.slots[slot] {
                0 => return slot,
                tile if self.places[tile as usize - 1] == place => return slot,
                _ => slot = (slot + 1) & (self.slots.len() - 1),
            }
        }
    }

    fn find(&self, place: [i64; 2]) -> Option<usize> {
        if self.slots.is_empty() {
            return None;
        }
        (self.slots[self.slot(place)] as usize).checked_sub(1)
    }

    /// The tile at a place, made if there is none. From 2^32 tiles on, which would be 8 TB, the last
    /// one is everywhere.
    fn make(&mut self, place: [i64; 2]) -> usize {
        if self.slots.is_empty() {
            self.slots.resize(2 * ROOM, 0);
            self.places.reserve(ROOM);
            self.heights.reserve(ROOM * TILE);
        }
        let mut slot = self.slot(place);
        if let Some(tile) = (self.slots[slot] as usize).checked_sub(1) {
            return tile;
        }
        if 2 * (self.places.len() + 1) > self.slots.len() {
            let slots = self.slots.len() * 2;
            self.slots.clear();
            self.slots.resize(slots, 0);
            for (tile, at) in (1u32..).zip(0..self.places.len()) {
                let slot = self.slot(self.places[at]);
                self.slots[slot] = tile;
            }
            slot = self.slot(place);
        }
        self.places.push(place);
        self.heights.resize(self.places.len() * TILE, 0.0);
        self.slots[slot] = u32::try_from(self.places.len()).unwrap_or(u32::MAX);
        self.places.len() - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pf_geom::Vector;

    /// The sum of cones, one by one.
    fn plainly(visits: &[Point], p: Point, radius: f64) -> f64 {
        let cones = visits.iter().map(|v| 1.0 - (p - v).norm() / radius);
        cones.map(|rise| rise.max(0.0)).sum()
    }

    #[test]
    fn it_is_the_sum_of_cones_but_for_the_lattice() {
        let mut memory = Memory::new(4.0);
        let visits: Vec<_> = (0..300)
            .map(|k| Point::new(f64::from(k) * 1.3 - 200.0, f64::from(k * k % 97) - 40.0))
            .collect();
        for place in &visits {
            memory.visit(*place);
        }
        for (k, at) in visits.iter().enumerate() {
            let reach = Vector::repeat(2.0);
            memory.look(at - reach, at + reach);
            for step in 0..16 {
                let p = at + Vector::new(f64::from(step % 4) - 1.5, f64::from(step / 4) - 1.5);
                let (found, sum) = (memory.height(p), plainly(&visits, p, 4.0));
                assert!((found - sum).abs() < 0.2, "{k}: {found} for {sum}");
            }
        }
        memory.clear();
        memory.look(visits[0], visits[0]);
        assert!(memory.height(visits[0]) <= 0.0);
    }

    #[test]
    fn what_changed_fades_and_the_rest_does_not() {
        let mut memory = Memory::new(4.0);
        let (a, b) = (Point::new(0.0, 0.0), Point::new(50.0, 0.0));
        memory.visit(a);
        memory.visit(b);
        memory.fade((a, a), 0.25);
        let mut height = |p| {
            memory.look(p, p);
            (memory.height(p) * 100.0).round()
        };
        assert_eq!(
            (height(a).to_string(), height(b).to_string()),
            ("25".into(), "100".into())
        );
    }

    #[test]
    fn no_place_is_too_far() {
        let mut memory = Memory::new(1e-3);
        for x in [1e300, -1e300, 1e17, f64::MAX, 0.0] {
            let p = Point::new(x, -x);
            memory.visit(p);
            memory.look(p - Vector::repeat(1.0), p + Vector::repeat(1.0));
            assert!(memory.height(p).is_finite());
        }
    }
}
