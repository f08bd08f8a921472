//! The paper's tables, and our maps in the spirit of its own.

use crate::{PaperError, row::Numbers};
use pf_geom::WorldProblem;
use pf_io::parse_world;
use serde_json::Value;

const MAPS: [&str; 2] = [
    include_str!("../../../../maps/worlds/cabc-1.toml"),
    include_str!("../../../../maps/worlds/cabc-2.toml"),
];

/// The two maps.
///
/// # Errors
/// [`PaperError::Data`] if one is broken.
pub fn maps() -> Result<[WorldProblem; 2], PaperError> {
    let broken = |error: &dyn std::fmt::Display| PaperError::Data(error.to_string());
    let read = |number: usize| -> Result<WorldProblem, PaperError> {
        let name = format!("cabc-{}.toml", number + 1);
        let file = parse_world(&name, MAPS[number].as_bytes()).map_err(|e| broken(&e))?;
        let robot = file.robots.first();
        let robot = robot.ok_or_else(|| broken(&format!("{name} has no robot")))?;
        WorldProblem::new(file.world.clone(), robot.radius, robot.start, robot.goal)
            .map_err(|e| broken(&e))
    };
    Ok([read(0)?, read(1)?])
}

/// What a row of a table prints.
#[derive(Clone, Debug)]
pub struct Printed {
    /// w1, w2, w3.
    pub weights: [f64; 3],
    /// Inner cycles.
    pub cycles: u32,
    /// How many runs arrived, of how many.
    pub target: u32,
    /// How many runs there were.
    pub of: u32,
    /// Everything, to print.
    pub numbers: Numbers,
    /// The mean length.
    pub length: Option<f64>,
}

/// A table of the paper's.
#[derive(Clone, Debug)]
pub struct Table {
    /// Its name.
    pub name: &'static str,
    /// 0 or 1.
    pub map: usize,
    /// Its rows.
    pub rows: Vec<Printed>,
}

/// The weights that the paper's inverse problem found, on map 1 and 2.
pub const FOUND: [[f64; 3]; 2] = [[1.05, 0.2, 0.03], [0.73, 0.09, 0.03]];

/// The tables: the key in the data, the name, the map, the runs and inner cycles where they are not
/// said row by row.
const TABLES: [(&str, &str, usize, u32, u32); 8] = [
    ("table1_map1", "Table 1, map 1", 0, 20, 8),
    ("table1_map2", "in words, map 2", 1, 20, 8),
    ("table2_map1", "Table 2, map 1", 0, 20, 8),
    ("table3_map2", "Table 3, map 2", 1, 20, 8),
    ("table4_map1", "Table 4, map 1", 0, 20, 8),
    ("table5_map2", "Table 5, map 2", 1, 20, 8),
    (
        "table6_map1_inner",
        "Table 6, map 1, inner cycles",
        0,
        30,
        8,
    ),
    (
        "table7_map2_inner",
        "Table 7, map 2, inner cycles",
        1,
        30,
        8,
    ),
];

/// All tables, and the two rows of the inverse problem as one.
///
/// # Errors
/// [`PaperError::Data`] if the data is broken.
pub fn tables() -> Result<Vec<Table>, PaperError> {
    let broken = |what: &str| PaperError::Data(format!("cabc.json: {what}"));
    let data: Value = serde_json::from_str(include_str!("../../data/cabc.json"))
        .map_err(|error| broken(&error.to_string()))?;
    let mut tables = Vec::new();
    for (key, name, map, of, cycles) in TABLES {
        let rows = data[key].as_array().ok_or_else(|| broken(key))?;
        let rows = rows.iter().map(|row| printed(row, FOUND[map], of, cycles));
        let rows: Option<Vec<_>> = rows.collect();
        let rows = rows.ok_or_else(|| broken(key))?;
        tables.push(Table { name, map, rows });
    }
    for (map, key) in ["map1", "map2"].into_iter().enumerate() {
        let row = printed(&data["inverse"][key], FOUND[map], 30, 3);
        tables.push(Table {
            name: ["inverse problem, map 1", "inverse problem, map 2"][map],
            map,
            rows: vec![row.ok_or_else(|| broken("inverse"))?],
        });
    }
    Ok(tables)
}

/// Rows without weights have those that the inverse problem found.
fn printed(row: &Value, found: [f64; 3], of: u32, cycles: u32) -> Option<Printed> {
    let number = |key: &str| row[key].as_f64();
    let whole = |key: &str| u32::try_from(row[key].as_u64()?).ok();
    let mut weights = found;
    if let Some(given) = row["weights"].as_array() {
        for (weight, given) in weights.iter_mut().zip(given) {
            *weight = given.as_f64()?;
        }
    }
    let target = whole("target")?;
    let mut numbers = Numbers::default().with("target", format!("{target}/{of}"));
    for key in ["avgP", "stdP", "avgT"] {
        if let Some(value) = number(key) {
            numbers = numbers.with(key, value);
        }
    }
    Some(Printed {
        weights,
        cycles: whole("inner").unwrap_or(cycles),
        target,
        of,
        numbers,
        length: number("avgP"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_data_is_sound() {
        let rows: Vec<_> = tables()
            .unwrap()
            .iter()
            .map(|table| table.rows.len())
            .collect();
        assert_eq!(rows, [3, 3, 7, 7, 9, 9, 6, 6, 1, 1]);
        assert_eq!(
            maps().unwrap().map(|map| map.world().shapes().count()),
            [34, 11]
        );
    }
}
