//! The paper's maps and queries, and what its public code gives.

use crate::PaperError;
use pf_geom::{Point, Rectangle, World, WorldChange, WorldProblem};
use serde_json::Value;

/// What the paper prints and its public code gives, and the maps.
#[derive(Clone, Debug)]
pub struct Published {
    data: Value,
}

/// The maps by name.
pub const MAPS: [&str; 3] = ["toy", "curved", "maze"];
/// The queries by name, each after the one before.
pub const QUERIES: [&str; 3] = ["cold", "warm1", "warm2"];

/// What the public code gives for a case.
#[derive(Clone, Copy, Debug)]
pub struct Reference {
    /// Iterations.
    pub iterations: f64,
    /// The last loss.
    pub loss: f64,
    /// The path's length.
    pub length: f64,
    /// Milliseconds in Python.
    pub python_ms: f64,
    /// The path's least distance from a rectangle.
    pub clearance: f64,
}

fn broken(what: impl std::fmt::Display) -> PaperError {
    PaperError::Data(what.to_string())
}

fn numbers<const N: usize>(value: &Value) -> Result<[f64; N], PaperError> {
    let all: Option<Vec<f64>> = value
        .as_array()
        .and_then(|v| v.iter().map(Value::as_f64).collect());
    let all = all.ok_or_else(|| broken("not a list of numbers"))?;
    all.get(..N)
        .and_then(|all| all.try_into().ok())
        .ok_or_else(|| broken(format!("not {N} numbers")))
}

impl Published {
    /// Reads what the program carries.
    ///
    /// # Errors
    /// [`PaperError::Data`] if it is broken.
    pub fn read() -> Result<Self, PaperError> {
        let data = serde_json::from_str(include_str!("../../data/kim.json")).map_err(broken)?;
        Ok(Self { data })
    }

    /// A map with the ends of a query.
    ///
    /// # Errors
    /// [`PaperError::Data`] if there is none.
    pub fn problem(&self, map: &str, query: &str) -> Result<WorldProblem, PaperError> {
        let rows = self.data["maps"][map]
            .as_array()
            .ok_or_else(|| broken(map))?;
        let mut shapes = Vec::new();
        for row in rows {
            let [x0, x1, y0, y1, px, py] = numbers(row)?;
            let rectangle = Rectangle::new(Point::new(x0, y0), Point::new(x1, y1));
            let peaked = rectangle.and_then(|r| r.with_peak(Point::new(px, py)));
            shapes.push(peaked.map_err(broken)?.into());
        }
        let bounds = Rectangle::new(Point::new(-10.0, -10.0), Point::new(45.0, 40.0));
        let world = World::with_shapes(bounds.map_err(broken)?, shapes);
        let [start, goal] = self.ends(query)?;
        WorldProblem::new(world, 0.0, start, goal).map_err(broken)
    }

    fn ends(&self, query: &str) -> Result<[Point; 2], PaperError> {
        let end = |k: usize| -> Result<Point, PaperError> {
            let [x, y] = numbers(&self.data["queries"][query][k])?;
            Ok(Point::new(x, y))
        };
        Ok([end(0)?, end(1)?])
    }

    /// What leads to a query from any other.
    ///
    /// # Errors
    /// [`PaperError::Data`] if there is none.
    pub fn moves(&self, query: &str) -> Result<[WorldChange; 2], PaperError> {
        let [start, goal] = self.ends(query)?;
        Ok([WorldChange::StartMoved(start), WorldChange::GoalMoved(goal)])
    }

    /// What the public code gives for a case, if that is known.
    #[must_use]
    pub fn reference(&self, map: &str, query: &str) -> Option<Reference> {
        let row = &self.data["reference"][format!("{map} {query}")];
        let [iterations, loss, length, python_ms, clearance] = numbers(row).ok()?;
        Some(Reference {
            iterations,
            loss,
            length,
            python_ms,
            clearance,
        })
    }
}

/// Whether both ends of a problem are free.
#[must_use]
pub(super) fn has_free_ends(problem: &WorldProblem) -> bool {
    [problem.start(), problem.goal()]
        .iter()
        .all(|&end| problem.is_free(end, end))
}
