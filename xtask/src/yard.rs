//! Draws a freight yard: `maps/worlds/yard.toml`, 200 shapes of all kinds among which a robot finds
//! its way. A unit is a metre; what is built stands where it stands, what lies about is cast.

use pf_core::PlanRng;
use pf_geom::{Circle, Point, Polygon, Rectangle, Segment, Shape, Vector, World};
use pf_io::{FileError, Names, Robot, WorldFile, write_world};
use rand::{RngExt, SeedableRng};
use std::{f64::consts::TAU, path::Path};

/// How many shapes there are.
pub(crate) const SHAPES: usize = 200;

const WIDTH: f64 = 120.0;
const HEIGHT: f64 = 80.0;
/// Between things cast about: a robot as wide as the courier fits through.
const GAP: f64 = 1.35;
const RADIUS: f64 = 0.6;
const START: [f64; 2] = [5.0, 5.0];
const GOAL: [f64; 2] = [105.0, 71.0];

/// Writes `yard.toml` into `folder`.
///
/// # Errors
/// [`FileError`] if it cannot be written.
pub(crate) fn write(folder: &Path) -> Result<(), FileError> {
    write_world(&folder.join("yard.toml"), &draw())
}

/// Draws the yard.
#[must_use]
pub(crate) fn draw() -> WorldFile {
    let bounds = rectangle([0.0, 0.0, WIDTH, HEIGHT]);
    let mut yard = Yard {
        rng: PlanRng::seed_from_u64(3),
        world: World::new(bounds),
        names: Vec::new(),
    };
    yard.walls();
    yard.buildings();
    yard.stores();
    yard.cast();
    let robot = Robot {
        name: Some("courier".to_owned()),
        radius: RADIUS,
        start: START.into(),
        goal: GOAL.into(),
        speed: Some(1.5),
    };
    WorldFile {
        names: yard.names.into_iter().collect::<Names>(),
        robots: vec![robot],
        title: Some("A freight yard".to_owned()),
        provenance: Some(
            "Made for this project: drawn by xtask/src/yard.rs (cargo xtask maps). In metres."
                .to_owned(),
        ),
        ..WorldFile::of(yard.world)
    }
}

struct Yard {
    rng: PlanRng,
    world: World,
    names: Vec<Option<String>>,
}

/// `[left, bottom, right, top]`.
fn rectangle([left, bottom, right, top]: [f64; 4]) -> Rectangle {
    Rectangle::new(Point::new(left, bottom), Point::new(right, top)).expect("a rectangle")
}

fn circle(x: f64, y: f64, radius: f64) -> Shape {
    let circle = Circle::new(Point::new(x, y), radius);
    circle.expect("a circle").into()
}

fn polygon(corners: impl IntoIterator<Item = [f64; 2]>) -> Shape {
    let corners = corners.into_iter().map(Point::from).collect();
    Polygon::new(corners).expect("a simple polygon").into()
}

/// To centimetres, so that the file is short and the same everywhere.
fn rounded(metres: f64) -> f64 {
    (metres * 100.0).round() / 100.0
}

/// Corners at these angles, a share of a turn, and distances around a point.
fn around([x, y]: [f64; 2], corners: &[(f64, f64)]) -> Shape {
    polygon(corners.iter().map(|&(turn, reach)| {
        let (sin, cos) = (turn * TAU).sin_cos();
        [rounded(x + reach * cos), rounded(y + reach * sin)]
    }))
}

/// A rectangle of this length and width about a point, turned by a share of a turn.
fn turned([x, y]: [f64; 2], length: f64, width: f64, turn: f64) -> Shape {
    let (sin, cos) = (turn * TAU).sin_cos();
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    polygon(corners.map(|(a, b)| {
        let (along, across) = (a * length / 2.0, b * width / 2.0);
        [
            rounded(x + along * cos - across * sin),
            rounded(y + along * sin + across * cos),
        ]
    }))
}

impl Yard {
    fn add(&mut self, name: &str, shape: impl Into<Shape>) {
        self.names.push(Some(name.to_owned()));
        self.world.add(shape.into());
    }

    /// Three parts, joined by five gates whose leaves stand open.
    fn walls(&mut self) {
        for wall in [
            [38.0, 0.0, 39.0, 22.0],
            [38.0, 26.0, 39.0, 60.0],
            [38.0, 64.0, 39.0, 80.0],
            [79.0, 0.0, 80.0, 10.0],
            [79.0, 13.0, 80.0, 46.0],
            [79.0, 49.0, 80.0, 80.0],
            [39.0, 40.0, 55.0, 41.0],
            [58.0, 40.0, 79.0, 41.0],
        ] {
            self.add("wall", rectangle(wall));
        }
        for (hinge, length, turn) in [
            ([39.0, 26.0], 4.0, 0.07),
            ([39.0, 64.0], 4.0, 0.1),
            ([80.0, 13.0], 3.0, 0.04),
            ([80.0, 49.0], 3.0, 0.12),
            ([58.0, 41.0], 3.0, 0.16),
        ] {
            let (sin, cos) = (turn * TAU).sin_cos();
            let middle = [
                hinge[0] + length / 2.0 * cos + 0.2,
                hinge[1] + length / 2.0 * sin + 0.2,
            ];
            self.add("gate", turned(middle, length, 0.2, turn));
        }
    }

    fn buildings(&mut self) {
        let warehouse = [[8, 12], [28, 12], [28, 18], [16, 18], [16, 34], [8, 34]];
        self.build("warehouse", &warehouse);
        let hall = [
            [48, 6],
            [72, 6],
            [72, 30],
            [48, 30],
            [48, 26],
            [68, 26],
            [68, 10],
            [48, 10],
        ];
        self.build("hall", &hall);
        let office = [
            [10, 60],
            [26, 60],
            [26, 64],
            [20, 64],
            [20, 74],
            [16, 74],
            [16, 64],
            [10, 64],
        ];
        self.build("office", &office);
        let workshop = [
            [57, 52],
            [63, 52],
            [63, 59],
            [70, 59],
            [70, 65],
            [63, 65],
            [63, 74],
            [57, 74],
            [57, 65],
            [49, 65],
            [49, 59],
            [57, 59],
        ];
        self.build("workshop", &workshop);
        let shed = [
            [88, 30],
            [108, 30],
            [108, 36],
            [104, 33],
            [104, 36],
            [100, 33],
            [100, 36],
            [96, 33],
            [96, 36],
            [92, 33],
            [92, 36],
            [88, 33],
        ];
        self.build("shed", &shed);
        let canteen = [
            [98, 64],
            [118, 64],
            [118, 67],
            [101, 67],
            [101, 75],
            [114, 75],
            [114, 78],
            [98, 78],
        ];
        self.build("canteen", &canteen);
        self.build("kiosk", &[[29, 44], [35, 46], [29, 48], [31, 46]]);
    }

    fn build(&mut self, name: &str, corners: &[[i32; 2]]) {
        let corners = corners.iter().map(|corner| corner.map(f64::from));
        self.add(name, polygon(corners));
    }

    /// Silos and containers that touch each other, and a row of bollards too dense to pass.
    fn stores(&mut self) {
        for y in [18.0, 23.0] {
            for x in [86.0, 91.0, 96.0] {
                self.add("silo", circle(x, y, 2.5));
            }
        }
        for [x, y] in [
            [3.0, 40.0],
            [9.0, 40.0],
            [17.0, 40.0],
            [3.0, 42.4],
            [9.0, 42.4],
            [6.0, 50.0],
            [12.0, 50.0],
            [18.0, 50.0],
            [24.0, 50.0],
            [22.0, 29.0],
            [28.0, 29.0],
            [102.0, 4.0],
            [108.0, 4.0],
            [102.0, 6.4],
            [108.0, 6.4],
            [104.0, 12.0],
            [110.0, 14.4],
            [104.0, 20.0],
            [110.0, 20.0],
            [104.0, 50.0],
            [110.0, 52.4],
        ] {
            self.add("container", rectangle([x, y, x + 6.0, y + 2.4]));
        }
        for k in 0..22 {
            self.add("bollard", circle(44.0, 3.5 + 1.5 * f64::from(k), 0.3));
        }
    }

    /// What lies about.
    fn cast(&mut self) {
        for _ in 0..12 {
            let turn = self.rng.random_range(0.0..0.5);
            self.place("truck", 4.4, |at| turned(at, 8.4, 2.5, turn));
        }
        for k in 0..10 {
            let sides = 5 + k % 4;
            let reach = self.rng.random_range(1.2..2.6);
            let corners: Vec<_> = (0..sides)
                .map(|side| (f64::from(side) / f64::from(sides), reach))
                .collect();
            self.place("tank", reach, |at| around(at, &corners));
        }
        for _ in 0..8 {
            let reach = self.rng.random_range(1.0..2.0);
            let start = self.rng.random_range(0.0..0.2);
            let corners: Vec<_> = (0..10)
                .map(|k| {
                    let share = if k % 2 == 0 { 1.0 } else { 0.45 };
                    (start + f64::from(k) / 10.0, reach * share)
                })
                .collect();
            self.place("planter", reach, |at| around(at, &corners));
        }
        for _ in 0..14 {
            let mut corners: Vec<(f64, f64)> = Vec::new();
            for k in 0..6 {
                let turn = (f64::from(k) + self.rng.random_range(0.0..0.8)) / 6.0;
                corners.push((turn, self.rng.random_range(0.5..1.5)));
            }
            self.place("rubble", 1.5, |at| around(at, &corners));
        }
        for _ in 0..34 {
            let radius = rounded(self.rng.random_range(0.3..1.4));
            self.place("tree", radius, |[x, y]| circle(x, y, radius));
        }
        while self.names.len() < SHAPES {
            self.place("pallet", 1.5, |[x, y]| pallet(x, y));
            // Every other one has another right beside it.
            if self.names.len() + 1 < SHAPES && self.names.len().is_multiple_of(2) {
                let last = self.world.shape(self.world.next_id() - 1);
                if let Some(Shape::Rectangle(last)) = last {
                    let (left, bottom) = (last.max().x, last.min().y);
                    let corners = [left, bottom, left + 1.2, bottom + 0.8];
                    self.add("pallet", rectangle(corners.map(rounded)));
                }
            }
        }
    }

    /// Puts a thing that reaches so far around its middle where there is room.
    fn place(&mut self, name: &str, reach: f64, shape: impl Fn([f64; 2]) -> Shape) {
        loop {
            let x = rounded(self.rng.random_range(2.0..WIDTH - 2.0));
            let y = rounded(self.rng.random_range(2.0..HEIGHT - 2.0));
            let at = Point::new(x, y);
            let kept_free = [START, GOAL].map(Point::from);
            let room = self.world.clearance_at(at) > reach + GAP
                && kept_free.iter().all(|p| (p - at).norm() > reach + 2.0)
                && Self::leaves_lanes(at, reach);
            if room {
                self.add(name, shape([x, y]));
                return;
            }
        }
    }

    /// The gates and the canteen's door stay free.
    fn leaves_lanes(at: Point, reach: f64) -> bool {
        let lane = |x: f64, y: f64, dx: f64, dy: f64| {
            let from = Point::new(x, y);
            Segment::new(from, from + Vector::new(dx, dy)).distance_to_point(at) > reach + GAP
        };
        lane(35.0, 24.0, 8.0, 0.0)
            && lane(35.0, 62.0, 8.0, 0.0)
            && lane(76.0, 11.5, 8.0, 0.0)
            && lane(76.0, 47.5, 8.0, 0.0)
            && lane(56.5, 37.0, 0.0, 8.0)
            && lane(103.0, 71.0, 16.0, 0.0)
    }
}

fn pallet(x: f64, y: f64) -> Shape {
    let corners = [x - 0.6, y - 0.4, x + 0.6, y + 0.4];
    rectangle(corners.map(rounded)).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pf_classic::VisibilityGraph;
    use pf_core::{Context, Planner};
    use pf_geom::WorldProblem;
    use pf_io::read_world;
    use std::fs;

    fn worlds() -> std::path::PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../maps/worlds")
    }

    #[test]
    fn the_committed_file_is_what_is_drawn() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path()).unwrap();
        let drawn = fs::read(folder.path().join("yard.toml")).unwrap();
        let committed = fs::read(worlds().join("yard.toml")).unwrap();
        assert!(drawn == committed, "run `cargo xtask maps`");
    }

    #[test]
    fn the_yard_is_a_mixed_one() {
        let yard = read_world(&worlds().join("yard.toml")).unwrap();
        let shapes: Vec<&Shape> = yard.world.shapes().map(|(_, shape)| shape).collect();
        assert_eq!(shapes.len(), SHAPES);
        let count = |wanted: fn(&Shape) -> bool| shapes.iter().filter(|s| wanted(s)).count();
        assert!(count(|s| matches!(s, Shape::Circle(_))) > 40);
        assert!(count(|s| matches!(s, Shape::Rectangle(_))) > 40);
        assert!(count(|s| matches!(s, Shape::Polygon(p) if p.is_convex())) > 20);
        assert!(count(|s| matches!(s, Shape::Polygon(p) if !p.is_convex())) > 20);
    }

    #[test]
    fn the_way_to_the_canteen_is_a_detour() {
        let yard = read_world(&worlds().join("yard.toml")).unwrap();
        let robot = &yard.robots[0];
        let problem = WorldProblem::new(yard.world, robot.radius, robot.start, robot.goal).unwrap();
        let mut planner = VisibilityGraph::default();
        let report = planner.plan(&problem, &mut Context::seeded(0)).unwrap();
        let length = report.outcome.solved().expect("a way").cost;
        let straight = (robot.goal - robot.start).norm();
        assert!(length > 1.15 * straight, "{length} of {straight}");
    }
}
