//! Problems and answers as JSON.

use pf_core::Problem;
use pf_geom::{Point, Shape, WorldProblem};
use pf_grid::{Cell, GridCost, GridProblem};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// A problem that can be told to another program.
pub trait Wire: Problem {
    /// `grid` or `world`.
    const KIND: &'static str;

    /// What it asks, as the members of an object.
    fn question(&self) -> Value;

    /// A path out of numbers; `None` if they cannot be one.
    fn solution(path: &[[f64; 2]]) -> Option<Self::Solution>;

    /// A cost as the program states it.
    fn number(cost: &Self::Cost) -> f64;
}

impl Wire for GridProblem {
    const KIND: &'static str = "grid";

    fn question(&self) -> Value {
        let grid = self.grid();
        let cost = |cell| {
            if grid.is_free(cell) {
                grid.cost(cell)
            } else {
                0
            }
        };
        let row = |y| (0..grid.width()).map(move |x| cost(Cell::new(x, y)));
        let costs: Vec<Vec<u8>> = (0..grid.height()).map(|y| row(y).collect()).collect();
        json!({
            "width": grid.width(),
            "height": grid.height(),
            "moves": self.moves().to_string(),
            "costs": costs,
            "start": [self.start().x, self.start().y],
            "goal": [self.goal().x, self.goal().y],
        })
    }

    fn solution(path: &[[f64; 2]]) -> Option<Vec<Cell>> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole numbers of that size only"
        )]
        let whole = |x: f64| {
            let fits = x >= 0.0 && x <= f64::from(u32::MAX) && x.fract() == 0.0;
            fits.then_some(x as u32)
        };
        let cell = |[x, y]: &[f64; 2]| Some(Cell::new(whole(*x)?, whole(*y)?));
        path.iter().map(cell).collect()
    }

    fn number(cost: &GridCost) -> f64 {
        cost.value()
    }
}

impl Wire for WorldProblem {
    const KIND: &'static str = "world";

    fn question(&self) -> Value {
        let pair = |p: Point| [p.x, p.y];
        let shape = |shape: &Shape| match shape {
            Shape::Circle(c) => {
                json!({ "circle": { "centre": pair(c.centre()), "radius": c.radius() } })
            }
            Shape::Rectangle(r) => {
                json!({ "rectangle": { "min": pair(r.min()), "max": pair(r.max()) } })
            }
            Shape::Polygon(p) => {
                let points: Vec<_> = p.corners().iter().map(|&p| pair(p)).collect();
                json!({ "polygon": { "points": points } })
            }
        };
        let world = self.world();
        let bounds = world.bounds();
        let shapes: Vec<_> = world.shapes().map(|(_, one)| shape(one)).collect();
        json!({
            "bounds": { "min": pair(bounds.min()), "max": pair(bounds.max()) },
            "radius": self.radius(),
            "shapes": shapes,
            "start": pair(self.start()),
            "goal": pair(self.goal()),
        })
    }

    fn solution(path: &[[f64; 2]]) -> Option<Vec<Point>> {
        Some(path.iter().map(|&[x, y]| Point::new(x, y)).collect())
    }

    fn number(cost: &f64) -> f64 {
        *cost
    }
}

/// What a program says of itself.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Hello {
    pub(crate) name: String,
    /// `grid` or `world`.
    pub(crate) problem: String,
    #[serde(default)]
    pub(crate) claims: Vec<Claim>,
}

/// What can be claimed over the wire: the others need a planner that shows how it works.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Claim {
    Complete,
    Optimal,
    Deterministic,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Word {
    Optimal,
    Feasible,
    Infeasible,
    Unknown,
}

/// What a program answers.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Reply {
    pub(crate) id: u64,
    pub(crate) outcome: Word,
    #[serde(default)]
    pub(crate) path: Option<Vec<[f64; 2]>>,
    #[serde(default)]
    pub(crate) cost: Option<f64>,
    #[serde(default)]
    pub(crate) expanded: u64,
    #[serde(default)]
    pub(crate) evaluated: u64,
    #[serde(default)]
    pub(crate) notes: Vec<String>,
}
