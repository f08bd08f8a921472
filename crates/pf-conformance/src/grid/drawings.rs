//! Problems drawn by hand, with optima counted by hand, and a few large ones drawn by rule.

use pf_core::InvalidProblem;
use pf_grid::{Cell, Grid, GridCost, GridProblem, Moves};

/// Reads a drawing like [`Grid::parse`], with the start and the goal in it: `S` and `G`, or `B`
/// where both are the same cell; in small letters the cell is blocked.
///
/// # Errors
/// [`InvalidProblem::BadValue`] if the rows differ in length, or start or goal is not drawn exactly
/// once.
///
/// ```
/// # use pf_conformance::grid::draw;
/// # use pf_grid::Cell;
/// let problem = draw("
///     S.#
///     ..g
/// ").unwrap();
/// assert_eq!(problem.goal(), Cell::new(2, 1));
/// assert!(!problem.grid().is_free(problem.goal()));
/// assert!(draw("S...").is_err());
/// ```
pub fn draw(drawing: &str) -> Result<GridProblem, InvalidProblem> {
    let grid = Grid::parse(&drawing.replace(['s', 'g', 'b'], "#"))?;
    let marks: Vec<char> = drawing.split_whitespace().flat_map(str::chars).collect();
    let find = |what: &'static str, mark: char| {
        let cells = grid.layout().cells().zip(&marks);
        let mut found = cells.filter(|(_, m)| [mark, 'B'].contains(&m.to_ascii_uppercase()));
        match (found.next(), found.count()) {
            (Some((cell, _)), 0) => Ok(cell),
            (first, more) => Err(InvalidProblem::BadValue {
                what: format!("the {what} of the drawing").into(),
                found: format!("drawn {} times", more + usize::from(first.is_some())),
                expected: format!("one `{mark}`").into(),
            }),
        }
    };
    let (start, goal) = (find("start", 'S')?, find("goal", 'G')?);
    GridProblem::new(grid, start, goal)
}

/// The drawing [`draw`] reads. Terrain under the start and the goal is not shown.
///
/// ```
/// # use pf_conformance::grid::{draw, drawing};
/// assert_eq!(drawing(&draw("S.5 ##g").unwrap()), "S.5\n##g\n");
/// ```
#[must_use]
pub fn drawing(problem: &GridProblem) -> String {
    let (start, goal) = (problem.start(), problem.goal());
    let drawn = problem.grid().to_string();
    let rows = drawn.lines().zip(0..).map(|(row, y)| {
        let cells = row.chars().zip(0..).map(|(mark, x)| {
            let mark = match (Cell::new(x, y) == start, Cell::new(x, y) == goal) {
                (true, true) => 'B',
                (true, false) => 'S',
                (false, true) => 'G',
                (false, false) => return mark,
            };
            if problem.grid().is_free(Cell::new(x, y)) {
                mark
            } else {
                mark.to_ascii_lowercase()
            }
        });
        cells.chain(['\n']).collect::<String>()
    });
    rows.collect()
}

/// An optimum counted by hand: straight and diagonal steps, or the same in half units of terrain.
pub(crate) type Optimum = Option<(u64, u64)>;

/// A drawing and its optimum under each of [`Moves::ALL`], in steps between cells of cost 1.
pub(crate) struct Drawn {
    pub(crate) name: &'static str,
    drawing: &'static str,
    optima: [Optimum; 4],
}

impl Drawn {
    pub(crate) fn problem(&self, moves: Moves) -> GridProblem {
        let problem = draw(self.drawing).expect("a drawing that can be read");
        problem.with_moves(moves)
    }

    /// Each rule of moving with the optimum under it.
    pub(crate) fn optima(&self) -> impl Iterator<Item = (Moves, Option<GridCost>)> {
        let cost = |optimum: Optimum| optimum.map(|(s, d)| GridCost::of_steps(s, d));
        Moves::ALL.into_iter().zip(self.optima.map(cost))
    }
}

const NONE: [Optimum; 4] = [None; 4];

const fn all(straight: u64) -> [Optimum; 4] {
    [Some((straight, 0)); 4]
}

/// Without diagonal steps, with two lenient rules for them, and where no corner may be cut.
const fn steps(orthogonal: u64, lenient: (u64, u64), strict: (u64, u64)) -> [Optimum; 4] {
    let lenient = Some(lenient);
    [Some((orthogonal, 0)), lenient, lenient, Some(strict)]
}

const fn drawn(name: &'static str, drawing: &'static str, optima: [Optimum; 4]) -> Drawn {
    Drawn {
        name,
        drawing,
        optima,
    }
}

pub(crate) const DRAWN: &[Drawn] = &[
    // Tiny.
    drawn("one free cell", "B", all(0)),
    drawn("one blocked cell", "b", NONE),
    drawn("one row", "S....G", all(5)),
    drawn("one column", "G . . S", all(3)),
    drawn("one row, cut", "S.#.G", NONE),
    drawn("side by side", "SG", all(1)),
    drawn("two by two", "S. .G", steps(2, (0, 1), (0, 1))),
    // Where the rules of moving part ways.
    drawn("a corner in the way", "S# .G", steps(2, (0, 1), (2, 0))),
    drawn("the other corner", "S. #G", steps(2, (0, 1), (2, 0))),
    drawn("both corners", "S# #G", [None, Some((0, 1)), None, None]),
    drawn(
        "a diagonal gap",
        "
            S.#..
            .#..G",
        [None, Some((3, 1)), None, None],
    ),
    drawn(
        "a diagonal gap and a way round",
        "
            S.#..
            .#..G
            .###.
            .....",
        [Some((9, 0)), Some((3, 1)), Some((5, 2)), Some((9, 0))],
    ),
    drawn(
        "round a pillar",
        "
            ...
            S#G
            ...",
        steps(4, (0, 2), (4, 0)),
    ),
    drawn(
        "round the end of a wall",
        "
            .S#G.
            ..#..
            .....",
        steps(6, (2, 2), (6, 0)),
    ),
    drawn(
        "a staircase",
        "
            S####
            ..###
            #..##
            ##..#
            ###.G",
        steps(8, (0, 4), (8, 0)),
    ),
    // Start and goal.
    drawn("already there", "... .B. ...", all(0)),
    drawn("already there, shut in", ".#. #B# .#.", all(0)),
    drawn("already there, blocked", "... .b. ...", NONE),
    drawn("blocked start", "s.. ... ..G", NONE),
    drawn("blocked goal", "S.. ... ..g", NONE),
    drawn("both ends blocked", "s.. ... ..g", NONE),
    // No way.
    drawn(
        "the goal walled in",
        "
            S.....
            ..###.
            ..#G#.
            ..###.
            ......",
        NONE,
    ),
    drawn(
        "the start walled in",
        "
            ###...
            #S#...
            ###..G",
        NONE,
    ),
    drawn(
        "a wall from edge to edge",
        "
            ..#...
            S.#..G
            ..#...
            ..#...",
        NONE,
    ),
    drawn(
        "walled in but for the corners",
        "
            S....
            ..#..
            .#G#.
            ..#..
            .....",
        [None, Some((0, 2)), None, None],
    ),
    // Several ways.
    drawn(
        "many best paths",
        "
            S....
            .....
            .....
            ....G",
        steps(7, (1, 3), (1, 3)),
    ),
    drawn(
        "two best ways round",
        "
            .......
            ..###..
            S.###.G
            ..###..
            .......",
        steps(10, (2, 4), (6, 2)),
    ),
    drawn(
        "a trap",
        "
            .......
            .####..
            ....#..
            S...#.G
            ....#..
            .####..
            .......",
        steps(12, (6, 3), (10, 1)),
    ),
    drawn(
        "a spiral",
        "
            S......
            ######.
            .....#.
            .###.#.
            .#G..#.
            .#####.
            .......",
        steps(30, (18, 6), (30, 0)),
    ),
    // Terrain: a step counts the mean of its two cells.
    drawn("through the swamp", "S5G", all(6)),
    drawn(
        "round the swamp",
        "
            S9G
            ...",
        steps(4, (0, 2), (0, 2)),
    ),
    drawn(
        "a swamp cheaper than the way round",
        "
            S2G
            .#.
            ...",
        all(3),
    ),
    drawn(
        "a swamp with a ford",
        "
            S.999.G
            ..999..
            ..292..
            ..222..",
        steps(15, (0, 9), (0, 9)),
    ),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::oracle;

    #[test]
    fn the_oracle_agrees_with_optima_counted_by_hand() {
        for drawn in DRAWN {
            for (moves, optimum) in drawn.optima() {
                let problem = drawn.problem(moves);
                assert_eq!(oracle(&problem), optimum, "{} {moves}", drawn.name);
            }
        }
    }

    #[test]
    fn what_is_drawn_is_read_back() {
        for drawn in DRAWN {
            let problem = drawn.problem(Moves::default());
            let again = draw(&drawing(&problem)).unwrap();
            assert_eq!(again.grid(), problem.grid(), "{}", drawn.name);
            assert_eq!(
                (again.start(), again.goal()),
                (problem.start(), problem.goal())
            );
        }
    }
}
