use crate::{Line, Scene};
use pf_geom::{Point, Segment, World, world_of};
use pf_grid::{Cell, Clearance};
use std::{f64::consts::SQRT_2, sync::OnceLock};

/// How long a line is, in the map's unit.
#[must_use]
pub fn length(line: &Line) -> f64 {
    // Straight and diagonal steps apart, so that no rounding adds up.
    let (mut diagonal, mut other) = (0u32, 0.0);
    for pair in line.windows(2) {
        let (dx, dy) = (pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]);
        if dx.abs().total_cmp(&1.0).is_eq() && dy.abs().total_cmp(&1.0).is_eq() {
            diagonal += 1;
        } else {
            other += dx.hypot(dy);
        }
    }
    other + f64::from(diagonal) * SQRT_2
}

/// Measures how far lines on one map stay away from its obstacles; what that takes is made once.
#[derive(Debug, Default)]
pub struct Ruler {
    cells: OnceLock<Clearance>,
    shapes: OnceLock<World>,
}

impl Ruler {
    /// The least distance of a line of the scene from an obstacle, without regard to the robot's
    /// size; none if there is no obstacle. `converted` says whether the line was found in a map
    /// made of the scene's: on a grid it then need not run from cell to cell.
    ///
    /// A ruler is for scenes on one map that does not change.
    #[must_use]
    pub fn clearance(&self, scene: &Scene, line: &Line, converted: bool) -> Option<f64> {
        let least = match scene {
            Scene::Grid(scene) if !converted => {
                let clearance = self.cells.get_or_init(|| Clearance::of(scene.map()));
                let along = line.iter().map(|&p| clearance.at(cell(p)));
                along.fold(f64::INFINITY, f64::min)
            }
            Scene::Grid(scene) => {
                let world = self.shapes.get_or_init(|| world_of(scene.map()));
                // The middle of a cell is where its column and row say.
                let points: Line = line.iter().map(|p| p.map(|v| v + 0.5)).collect();
                clearance_of(world, &points)
            }
            Scene::World(scene) => clearance_of(scene.world(), line),
        };
        least.is_finite().then_some(least)
    }
}

fn clearance_of(world: &World, line: &Line) -> f64 {
    let point = |[x, y]: [f64; 2]| Point::new(x, y);
    let piece = |k: usize| {
        let next = line[(k + 1).min(line.len() - 1)];
        world.clearance(&Segment::new(point(line[k]), point(next)))
    };
    (0..line.len()).map(piece).fold(f64::INFINITY, f64::min)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "points of a line on a grid lie in cells"
)]
fn cell([x, y]: [f64; 2]) -> Cell {
    Cell::new(x as u32, y as u32)
}
