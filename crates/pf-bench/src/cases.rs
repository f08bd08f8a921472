//! Which maps and queries a suite asks about.

use anyhow::{Context as _, Result, bail};
use pf_classic::AStar;
use pf_core::{Context, PlanRng, Planner};
use pf_grid::{Cell, Grid, GridProblem, Moves};
use pf_io::{LoadOptions, Scen, ScenRow, load_grid, read_scen, toml_tree::there_are};
use rand::{RngExt, SeedableRng};
use std::{
    borrow::Cow,
    path::{Path, PathBuf},
    sync::Arc,
};

/// Where maps come from.
#[derive(clap::Args)]
pub(crate) struct Maps {
    /// A folder of Moving AI .map files, each with its .map.scen (or .scen) beside it; where there is
    /// none, queries are made up
    #[arg(long, value_name = "DIR", default_value = "../shared/data/movingai")]
    maps: PathBuf,
    /// Only maps whose name contains this; may be given again
    #[arg(long, value_name = "TEXT", alias = "map", alias = "case")]
    filter: Vec<String>,
}

/// A map and the queries of its scenario file.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) grid: Arc<Grid>,
    pub(crate) scen: Scen,
}

impl Maps {
    /// The files asked for, in the order of their names.
    pub(crate) fn files(&self) -> Result<Vec<PathBuf>> {
        self.files_or(&[])
    }

    /// The same; where no map is asked for, those whose names contain one of `usual`, if there are
    /// any.
    pub(crate) fn files_or(&self, usual: &[&str]) -> Result<Vec<PathBuf>> {
        let all = self.all()?;
        let names: Vec<_> = all.iter().map(|path| name(path)).collect();
        for asked in &self.filter {
            if !names.iter().any(|name| name.contains(asked.as_str())) {
                let names = names.iter().map(|name| name.trim_end_matches(".map"));
                bail!("{}", unknown("--filter", asked, "map", names));
            }
        }
        let among = |parts: &[&str]| -> Vec<PathBuf> {
            let wanted = |path: &&PathBuf| parts.iter().any(|part| name(path).contains(part));
            all.iter().filter(wanted).cloned().collect()
        };
        let asked: Vec<&str> = self.filter.iter().map(String::as_str).collect();
        let maps = among(if asked.is_empty() { usual } else { &asked });
        Ok(if maps.is_empty() { all } else { maps })
    }

    /// All maps of the folder.
    fn all(&self) -> Result<Vec<PathBuf>> {
        let folder = &self.maps;
        let entries = std::fs::read_dir(folder)
            .with_context(|| format!("{}: expected a folder of .map files", folder.display()))?;
        let mut maps = vec![];
        for entry in entries {
            let path = entry?.path();
            if name(&path).ends_with(".map") {
                maps.push(path);
            }
        }
        if maps.is_empty() {
            bail!("{}: no .map file in it", folder.display());
        }
        maps.sort();
        Ok(maps)
    }
}

/// A file's name, its ending included.
fn name(path: &Path) -> Cow<'_, str> {
    path.file_name().unwrap_or_default().to_string_lossy()
}

/// What is said of a part that is in no name: what was asked, what was probably meant, and what there is.
pub(crate) fn unknown<'n>(
    option: &str,
    asked: &str,
    what: &str,
    names: impl Iterator<Item = &'n str>,
) -> String {
    let names: Vec<&str> = names.collect();
    let there_are = there_are(asked, what, &names);
    format!("{option}: no {what}'s name contains `{asked}`; {there_are}")
}

impl Case {
    pub(crate) fn load(map: &Path) -> Result<Self> {
        let grid = load_grid(map, &LoadOptions::default())?.grid;
        let beside = PathBuf::from(format!("{}.scen", map.display()));
        let without = map.with_extension("scen");
        let scen = if beside.exists() {
            read_scen(&beside)?
        } else if without.exists() {
            read_scen(&without)?
        } else {
            made_up(&grid)?
        };
        scen.check_size(&grid)?;
        let name = map.file_stem().unwrap_or_default().to_string_lossy();
        Ok(Self {
            name: name.into_owned(),
            grid,
            scen,
        })
    }

    /// The same with every cell cut into `times` x `times`, and the queries between their middles;
    /// stated optima stay those of the whole map.
    pub(crate) fn upscaled(&self, times: u32) -> Result<Self> {
        let (name, whole) = (self.name.clone(), &self.grid);
        let mut scen = self.scen.clone();
        if times <= 1 {
            let grid = Arc::clone(whole);
            return Ok(Self { name, grid, scen });
        }
        let [width, height] =
            [whole.width(), whole.height()].map(|side| side.saturating_mul(times));
        let fine = Grid::new(width, height, |cell| {
            let cell = Cell::new(cell.x / times, cell.y / times);
            if whole.is_free(cell) {
                whole.cost(cell)
            } else {
                0
            }
        })?;
        let middle = |cell: Cell| Cell::new(cell.x * times + times / 2, cell.y * times + times / 2);
        for row in &mut scen.rows {
            (row.start, row.goal) = (middle(row.start), middle(row.goal));
        }
        Ok(Self {
            name: format!("{name} x{times}"),
            grid: Arc::new(fine),
            scen,
        })
    }

    /// The name under moves: as it is under Moving AI's.
    pub(crate) fn under(&self, moves: Moves) -> String {
        if moves == Moves::default() {
            return self.name.clone();
        }
        format!("{}, {moves}", self.name)
    }

    /// At most so many queries, spread evenly over all in the order of their lengths.
    pub(crate) fn spread(&self, limit: usize) -> Vec<&ScenRow> {
        evenly(&self.by_length(), limit)
    }

    /// The same of the longer half.
    pub(crate) fn long(&self, limit: usize) -> Vec<&ScenRow> {
        let rows = self.by_length();
        evenly(&rows[rows.len() / 2..], limit)
    }

    fn by_length(&self) -> Vec<&ScenRow> {
        let mut rows: Vec<_> = self.scen.rows.iter().collect();
        rows.sort_by(|a, b| a.optimum.total_cmp(&b.optimum));
        rows
    }
}

/// Queries between free cells by chance, the same for every map of a size, with Moving AI's optima.
fn made_up(grid: &Arc<Grid>) -> Result<Scen> {
    const QUERIES: u32 = 200;
    let mut rng = PlanRng::seed_from_u64(1);
    let (width, height) = (grid.width(), grid.height());
    let mut planner = AStar::default();
    let mut rows = Vec::new();
    for line in 1..=20 * QUERIES {
        let mut cell = || Cell::new(rng.random_range(0..width), rng.random_range(0..height));
        let (start, goal) = (cell(), cell());
        let problem = GridProblem::new(Arc::clone(grid), start, goal)?;
        let report = planner.plan(&problem, &mut Context::seeded(0))?;
        if let Some(best) = report.outcome.solved() {
            rows.push(ScenRow {
                line,
                bucket: 0,
                map: "made up".into(),
                width,
                height,
                start,
                goal,
                optimum: best.cost.value(),
            });
        }
        if rows.len() == QUERIES as usize {
            break;
        }
    }
    Ok(Scen::new(rows))
}

/// The middle one of each of `limit` equal parts.
fn evenly<T: Copy>(all: &[T], limit: usize) -> Vec<T> {
    let count = limit.min(all.len());
    (0..count)
        .map(|k| all[(2 * k + 1) * all.len() / (2 * count)])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn queries_are_made_up_the_same_again_and_cut_with_their_map() {
        let grid = Arc::new(Grid::parse("..@.. ..@.. .....").unwrap());
        let scen = made_up(&grid).unwrap();
        assert_eq!(scen, made_up(&grid).unwrap());
        assert!(
            scen.rows
                .iter()
                .all(|row| grid.is_free(row.start) && grid.is_free(row.goal))
        );
        let name = "small".to_owned();
        let cut = Case { name, grid, scen }.upscaled(3).unwrap();
        assert_eq!((cut.grid.width(), cut.grid.height()), (15, 9));
        assert!(!cut.grid.is_free(Cell::new(8, 5)) && cut.grid.is_free(Cell::new(8, 6)));
        assert!(
            cut.scen
                .rows
                .iter()
                .all(|row| row.start.x % 3 == 1 && row.goal.y % 3 == 1)
        );
    }

    #[test]
    fn samples_are_spread_evenly() {
        let all: Vec<u32> = (0..10).collect();
        assert_eq!(evenly(&all, 2), [2, 7]);
        assert_eq!(evenly(&all, 10), all);
        assert_eq!(evenly(&all, 99), all);
        assert!(evenly(&all[..0], 3).is_empty());
    }
}
