//! The nine maps, the 45 cases and what the paper prints of them.

use crate::PaperError;
use pf_grid::{GridChange, GridCost, GridProblem};
use pf_io::{GridMap, parse_movingai, parse_scenario};
use std::{collections::BTreeMap, path::PathBuf, sync::Arc};

macro_rules! maps {
    ($($name:literal),* $(,)?) => {
        /// The maps, in the paper's order.
        pub const MAPS: &[&str] = &[$($name),*];
        const FILES: &[&[u8]] = &[$(include_bytes!(concat!(
            "../../../../maps/grids/redlarski/", $name, ".map"
        ))),*];
    };
}
maps!(
    "mosaic-20",
    "alley-20",
    "maze-20",
    "mosaic-50",
    "alley-50",
    "maze-50",
    "mosaic-100",
    "alley-100",
    "maze-100",
);

const SCENARIO: &[u8] = include_bytes!("../../../../maps/scenarios/redlarski.toml");
const TABLES: &str = include_str!("../../data/redlarski.json");

/// A map and what happens on it: Table 1, and what follows from it.
#[derive(Clone, Debug)]
pub struct Story {
    /// The map's name.
    pub map: &'static str,
    /// Table 1: the first question, and what a shortest path costs.
    pub first: (GridProblem, GridCost),
    /// Tables 2 to 5: what changes, the question then, and what a shortest path costs.
    pub then: Vec<(Vec<GridChange>, GridProblem, GridCost)>,
}

impl Story {
    /// The question of a table, and what a shortest path costs.
    #[must_use]
    pub fn table(&self, table: usize) -> (&GridProblem, GridCost) {
        match table {
            1 => (&self.first.0, self.first.1),
            _ => (&self.then[table - 2].1, self.then[table - 2].2),
        }
    }
}

/// All nine.
///
/// # Errors
/// [`PaperError::Data`] if what the program carries is broken.
pub fn stories() -> Result<Vec<Story>, PaperError> {
    let broken = |what: &str| PaperError::Data(format!("redlarski.toml: {what}"));
    let mut load = |name: &str, _: &_| {
        let file = MAPS
            .iter()
            .position(|map| name.ends_with(&format!("/{map}.map")));
        let bytes = file.map_or(&b""[..], |at| FILES[at]);
        Ok(GridMap {
            grid: Arc::new(parse_movingai(name, bytes)?),
            frame: None,
            source: PathBuf::from(name),
        })
    };
    let scenario = parse_scenario("redlarski.toml", SCENARIO, &mut load)
        .map_err(|error| PaperError::Data(error.to_string()))?;
    let mut cases: BTreeMap<String, _> = scenario
        .cases
        .into_iter()
        .map(|case| (case.name.clone(), case))
        .collect();
    let mut stories = Vec::new();
    for &map in MAPS {
        let mut take = |table: usize| {
            let case = cases.remove(&format!("{map} table {table}"));
            let case = case.ok_or_else(|| broken("a case is missing"))?;
            let cost = case.expected.as_ref().map(|expected| expected.cost);
            let cost = cost.ok_or_else(|| broken("a length is missing"))?;
            Ok::<_, PaperError>((case, cost))
        };
        let (first, cost) = take(1)?;
        let mut then = Vec::new();
        for table in 2..=5 {
            let (case, cost) = take(table)?;
            then.push((case.changes, case.problem, cost));
        }
        stories.push(Story {
            map,
            first: (first.problem, cost),
            then,
        });
    }
    Ok(stories)
}

/// One printed cell: a number, or `n/a`.
type Cells = BTreeMap<String, Option<f64>>;

#[derive(serde::Deserialize)]
struct Table {
    length: BTreeMap<String, Cells>,
    time_ms: BTreeMap<String, Cells>,
}

#[derive(serde::Deserialize)]
struct Tables {
    tables: BTreeMap<String, Table>,
}

/// The numbers of the paper's tables.
pub struct Published(Tables);

/// What the paper says of a length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Printed {
    /// A length.
    Length(f64),
    /// The text says that it was optimal, no number is at hand.
    Optimal,
    /// `n/a`: no path was found.
    None,
    /// Nothing.
    Nothing,
}

impl Published {
    /// The paper's numbers.
    ///
    /// # Errors
    /// [`PaperError::Data`] if what the program carries is broken.
    pub fn read() -> Result<Self, PaperError> {
        let tables = serde_json::from_str(TABLES);
        tables
            .map(Self)
            .map_err(|error| PaperError::Data(error.to_string()))
    }

    /// The length printed in a table for a planner by the paper's name.
    #[must_use]
    pub fn length(&self, table: usize, planner: &str, map: &str) -> Printed {
        let Some(table_) = self.0.tables.get(&table.to_string()) else {
            return Printed::Nothing;
        };
        match table_.length.get(planner).and_then(|row| row.get(map)) {
            Some(Some(length)) => Printed::Length(*length),
            Some(None) => Printed::None,
            // The rows of RFD* are missing from the text at hand. Of obstacles added it says that
            // all but RFD and ACO were optimal.
            None if planner == "RFD*" && table == 3 => Printed::Optimal,
            None => Printed::Nothing,
        }
    }

    /// The time printed, in milliseconds.
    #[must_use]
    pub fn time(&self, table: usize, planner: &str, map: &str) -> Option<f64> {
        let table = self.0.tables.get(&table.to_string())?;
        *table.time_ms.get(planner)?.get(map)?
    }
}

impl std::fmt::Debug for Published {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Published({} tables)", self.0.tables.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_missing() {
        let stories = stories().unwrap();
        assert_eq!(stories.len(), 9);
        assert!(stories.iter().all(|story| story.then.len() == 4));
        let published = Published::read().unwrap();
        for story in &stories {
            for table in 1..=5 {
                let Printed::Length(printed) = published.length(table, "A*", story.map) else {
                    panic!("no length of A* in table {table}");
                };
                assert!((printed - story.table(table).1.value()).abs() < 0.01);
                assert!(published.time(table, "RFD*", story.map).is_some());
            }
        }
        assert_eq!(published.length(1, "ACO", "maze-20"), Printed::None);
        assert_eq!(published.length(3, "RFD*", "maze-20"), Printed::Optimal);
        assert_eq!(published.length(2, "RFD*", "maze-20"), Printed::Nothing);
        assert_eq!(published.length(2, "D* Lite", "maze-20"), Printed::Nothing);
    }
}
