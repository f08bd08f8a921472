//! Grids in scenes.

use crate::{Faith, FromScene, Line, Scene};
use pf_core::InvalidProblem;
use pf_grid::{Cell, GridChange, GridCost, GridProblem};

impl FromScene for GridProblem {
    const KIND: &'static str = "grid";

    fn from_scene(scene: &Scene) -> Result<(Self, Faith), InvalidProblem> {
        Ok((scene.grid_problem().clone(), Faith::Exact))
    }

    fn changes(&self, changes: &[GridChange]) -> Vec<GridChange> {
        changes.to_vec()
    }

    fn lines(&self, path: &Vec<Cell>) -> Vec<Line> {
        let point = |cell: &Cell| [f64::from(cell.x), f64::from(cell.y)];
        vec![path.iter().map(point).collect()]
    }

    fn costs(cost: &GridCost) -> Vec<f64> {
        vec![cost.value()]
    }
}
