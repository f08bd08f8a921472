//! What changed since a distance field was made, and what that does to its distances.

use crate::{
    Apart, Cell, GridProblem, Moves, Weights, Word,
    openings::Openings,
    window::{Window, square},
};

/// The changes since distances to a goal were known, boiled down to what bounds the distances now.
///
/// A path that uses nothing that became cheaper or free is no shorter than it was. One that does
/// comes, after the last such step, to a place near a changed cell from which it goes on as before:
/// [`bound`](Self::bound) is the least that can cost, as if nothing stood in the way there. And
/// where less was left than at every changed cell, nothing changed: [`is_below`](Self::is_below).
///
/// Source: ours. Heuristics that stay admissible as a map changes are those of Koenig and Likhachev,
/// *Adaptive A\**, 2005.
#[derive(Clone, Debug)]
pub struct Damage<W> {
    /// Less was left nowhere among the noted cells; where they are dense, nowhere at the edge of their window.
    below: W,
    openings: Openings<W>,
    /// Holds all places near what was noted together with anything freed.
    noted: Option<Window>,
}

/// A window of that many places is looked at place by place however few changed cells there are,
const FEW_PLACES: usize = 1 << 10;
/// and one of that many for each of them.
const PLACES_EACH: usize = 16;
/// Where one place in so many was changed, what was known between them is of little use.
const DENSE: usize = 8;
/// That many changed cells spread over a larger window are taken to change everything.
const MOST_SPREAD: usize = 256;

impl<W: Word> Default for Damage<W> {
    fn default() -> Self {
        Self {
            below: W::MAX,
            openings: Openings::default(),
            noted: None,
        }
    }
}

impl<W: Word> Damage<W> {
    /// No damage.
    pub fn clear(&mut self) {
        self.below = W::MAX;
        self.openings.clear();
        self.noted = None;
    }

    /// Takes note of changed cells. The distances are those to `goal`; `before` says of a place, its column, row and
    /// id, what the heuristic says and what was left before anything changed, or a bound of it from below. Says
    /// whether any of the cells may have made something shorter.
    pub fn add(
        &mut self,
        problem: &GridProblem,
        goal: Cell,
        changed: &[u32],
        weights: Weights,
        before: impl Fn((u32, u32), u32) -> (W, W),
    ) -> bool {
        let grid = problem.grid();
        let layout = grid.layout();
        // Freed cells come last, mostly.
        if !changed.iter().rev().any(|&id| grid.is_free_id(id)) {
            for &id in changed {
                self.hold_below(problem, id, weights, &before);
            }
            return false;
        }
        let most = FEW_PLACES + PLACES_EACH * changed.len();
        let mut window = None;
        for batch in changed.chunks(MOST_SPREAD) {
            for &id in batch {
                Window::hold(&mut window, layout.position(id));
            }
            if changed.len() > MOST_SPREAD && window.is_some_and(|all| all.places() > most) {
                // However much larger it is yet.
                window = Some(Window::whole(layout));
                break;
            }
        }
        // Their neighbours, too, within the border.
        let Some(window) = window.map(Window::grown) else {
            return false;
        };
        self.noted = Some(self.noted.map_or(window, |noted| noted.with(window)));
        let all = &mut self.openings;
        let room = if all.is_empty() && !all.has_places {
            window.places()
        } else {
            all.window.with(window).places()
        };
        let roomy = (all.is_empty() || all.has_places) && room <= most;
        let apart = weights.apart(problem.moves());
        if roomy && changed.len() * DENSE >= room {
            all.enclose(grid, goal, window, apart, before);
            self.below = self.below.min(all.least);
        } else if roomy {
            all.look(grid, changed, window, apart, before);
            let (opening, below) = (all.window, &mut self.below);
            for &id in changed {
                for place in hindered(layout.position(id), weights) {
                    *below = all.was[opening.place(place)].min(*below);
                }
            }
        } else if changed.len() > MOST_SPREAD {
            all.give_up(window);
            self.below = W::default();
        } else {
            all.forget_places(window);
            for &id in changed.iter().filter(|&&id| grid.is_free_id(id)) {
                for (x, y) in square(layout.position(id), 1) {
                    let id = layout.id_at((x, y));
                    if grid.is_free_id(id) {
                        let (heuristic, left) = before((x, y), id);
                        all.open(heuristic, left);
                    }
                }
            }
            for &id in changed {
                self.hold_below(problem, id, weights, &before);
            }
        }
        true
    }

    /// Whether no way from a place weighs less than so much whose last new step lies beside one of these changed cells,
    /// of which nothing is noted. `before` says of a place, its column, row and id, what was left before anything
    /// changed, or a bound of it from below.
    pub fn spares(
        problem: &GridProblem,
        (from, weight): ((u32, u32), W),
        changed: &[u32],
        weights: Weights,
        before: impl Fn((u32, u32), u32) -> W,
    ) -> bool {
        let grid = problem.grid();
        let layout = grid.layout();
        let apart: Apart<W> = weights.apart(problem.moves());
        let is_spared = |place: (u32, u32)| {
            let id = layout.id_at(place);
            if !grid.is_free_id(id) {
                return true;
            }
            let left = before(place, id);
            let (dx, dy) = (place.0.abs_diff(from.0), place.1.abs_diff(from.1));
            left >= weight || apart.by(dx, dy) + left >= weight
        };
        let freed = changed.iter().filter(|&&id| grid.is_free_id(id));
        freed
            .copied()
            .all(|id| square(layout.position(id), 1).all(is_spared))
    }

    /// Whether bounds may rest on what was left at a place, or on whether it was free, when something was noted.
    #[must_use]
    pub fn rests_on(&self, place: (u32, u32)) -> bool {
        self.noted.is_some_and(|noted| noted.has(place))
    }

    fn hold_below(
        &mut self,
        problem: &GridProblem,
        id: u32,
        weights: Weights,
        before: &impl Fn((u32, u32), u32) -> (W, W),
    ) {
        let layout = problem.grid().layout();
        for place in hindered(layout.position(id), weights) {
            let (_, left) = before(place, layout.id_at(place));
            self.below = self.below.min(left);
        }
    }

    /// Whether nothing that was noted changed anything for a cell from which `left` was left.
    #[inline]
    #[must_use]
    pub fn is_below(&self, left: W) -> bool {
        left < self.below
    }

    /// Bounds from below on what is left now.
    #[must_use]
    pub fn bound(&self, weights: Weights, moves: Moves) -> Bound<'_, W> {
        Bound {
            openings: &self.openings,
            apart: weights.apart(moves),
        }
    }

    /// Whether at least half of what was known above the heuristic still holds near what became
    /// free or cheaper: there the heuristic said `heuristic`, and `known` was known.
    #[must_use]
    pub fn leaves(&self, heuristic: W, known: W) -> bool {
        let all = &self.openings;
        all.is_empty()
            || all.has_places
            || all.excess + all.excess >= known.max(heuristic) - heuristic
    }

    /// Bytes held.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.openings.bytes()
    }
}

/// See [`Damage::bound`].
#[derive(Clone, Copy, Debug)]
pub struct Bound<'d, W> {
    openings: &'d Openings<W>,
    apart: Apart<W>,
}

impl<W: Word> Bound<'_, W> {
    /// A bound from below on every path from a place, given its column and its row, and what the
    /// heuristic says there and what was left before, as in [`Damage::add`].
    #[inline]
    pub fn at(&self, (x, y): (u32, u32), before: impl FnOnce() -> (W, W)) -> W {
        let all = self.openings;
        if all.is_empty() {
            return before().1;
        }
        let out = |at: u32, [from, to]: [u32; 2]| from.max(at) - at + (at.max(to) - to);
        let (dx, dy) = (out(x, all.window.columns), out(y, all.window.rows));
        if dx == 0 && dy == 0 && all.has_places {
            return all.both[all.window.place((x, y))];
        }
        let (heuristic, left) = before();
        left.min((self.apart.by(dx, dy) + all.least).max(heuristic + all.excess))
    }
}

/// From where a step may be hindered by a changed cell. A blocked one also hinders diagonal steps that pass it:
/// without terrain less was left at such a cell than where the step begins, with terrain it may be dear.
fn hindered(at: (u32, u32), weights: Weights) -> impl Iterator<Item = (u32, u32)> {
    square(at, u32::from(!weights.is_uniform()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Grid, GridChange, Search};
    use pf_core::{Context, Problem};

    /// A window that grows holds at every place the least over all openings, as a plain reading of
    /// the definition has it.
    #[test]
    fn two_passes_reach_every_place_by_the_shortest_way() {
        let grid = Grid::new(20, 20, |cell| u8::from((cell.x * 7 + cell.y * 11) % 5 > 1)).unwrap();
        let (start, goal) = (Cell::new(0, 0), Cell::new(19, 19));
        let mut problem = GridProblem::new(grid, start, goal).unwrap();
        let weights = Weights::of(problem.grid());
        let apart = weights.apart::<u32>(problem.moves());
        let was = |(x, y): (u32, u32), _: u32| (0, 10_000 * ((x * 13 + y * 29) % 31));
        let mut damage = Damage::default();
        let mut seeds = Vec::new();
        for freed in [
            vec![Cell::new(4, 5), Cell::new(11, 7)],
            vec![Cell::new(2, 12)],
        ] {
            problem.apply(&[GridChange::Freed(freed.clone())]).unwrap();
            let layout = *problem.grid().layout();
            let ids: Vec<u32> = freed.iter().map(|&cell| layout.id(cell)).collect();
            assert!(damage.add(&problem, goal, &ids, weights, was));
            let near = ids.iter().flat_map(|&id| square(layout.position(id), 1));
            seeds.extend(near.filter(|&at| problem.grid().is_free_id(layout.id_at(at))));
        }
        let bound = damage.bound(weights, problem.moves());
        let mut inside = 0;
        for at @ (x, y) in (1..=20).flat_map(|x| (1..=20u32).map(move |y| (x, y))) {
            let (x, y): (u32, u32) = (x, y);
            let over =
                |&(a, b): &(u32, u32)| was((a, b), 0).1 + apart.by(x.abs_diff(a), y.abs_diff(b));
            let least = seeds.iter().map(over).min().unwrap();
            let found = bound.at(at, || (0, u32::MAX));
            if damage.openings.window.has(at) {
                inside += 1;
                assert_eq!(found, least.min(was(at, 0).1), "{at:?}");
            } else {
                assert!(found <= least, "{at:?}");
            }
        }
        assert!(inside > 100 && inside < 400);
    }

    /// Whatever changes in a window, however densely, and wherever the distances lead to: nothing is further than
    /// it was said to be at the least, and near the window more is said than the heuristic knows.
    #[test]
    fn dense_changes_leave_bounds_from_below() {
        let free = |cell: Cell| (cell.x * cell.x * 7 + cell.y * 13 + cell.x * cell.y) % 7 > 1;
        let grid = Grid::new(40, 40, |cell| {
            u8::from(free(cell) && cell.x != 20 || cell.y == 0)
        });
        let problem = GridProblem::new(grid.unwrap(), Cell::new(0, 0), Cell::new(39, 0)).unwrap();
        let layout = *problem.grid().layout();
        let mut known_more = 0;
        for (goal, corner) in [(39, 0), (0, 0), (39, 30)].into_iter().flat_map(|(x, y)| {
            let corners = [(1, 1), (17, 4), (33, 27), (33, 1)];
            corners.map(|(left, top)| (Cell::new(x, y), Cell::new(left, top)))
        }) {
            let mut problem = problem.clone();
            let (weights, moves) = (Weights::of(problem.grid()), problem.moves());
            let octile = weights.octile::<u32>(problem.grid(), moves, goal);
            let (mut then, mut now) = (Search::default(), Search::default());
            let mut cx = Context::seeded(0);
            then.run(&problem, goal, None, |_| 0, &mut cx);
            let flipped = layout.cells().filter(|&cell| {
                let (dx, dy) = (cell.x.wrapping_sub(corner.x), cell.y.wrapping_sub(corner.y));
                dx < 7 && dy < 7 && (dx * 3 + dy * 5) % 4 == 0 && cell != goal && cell.y > 0
            });
            let (blocked, freed): (Vec<_>, _) =
                flipped.partition(|&cell| problem.grid().is_free(cell));
            let ids = blocked.iter().chain(&freed).map(|&cell| layout.id(cell));
            let ids: Vec<u32> = ids.collect();
            let changes = [GridChange::Blocked(blocked), GridChange::Freed(freed)];
            problem.apply(&changes).unwrap();
            let left = |search: &Search<u32>, id| search.weight(id).unwrap_or(u32::MAX);
            let mut damage = Damage::default();
            let before = |_, id| (octile(id), left(&then, id));
            assert!(damage.add(&problem, goal, &ids, weights, before));
            now.run(&problem, goal, None, |_| 0, &mut cx);
            let bound = damage.bound(weights, moves);
            for id in layout.cells().map(|cell| layout.id(cell)) {
                let least = bound.at(layout.position(id), || before((0, 0), id));
                let after = left(&now, id);
                assert!(least <= after, "{} to {goal}", layout.cell(id));
                if damage.is_below(least) {
                    assert_eq!(left(&then, id), after, "{} to {goal}", layout.cell(id));
                }
                let is_within = damage.openings.window.has(layout.position(id));
                known_more += u32::from(is_within && least > octile(id));
            }
        }
        assert!(known_more > 300, "{known_more}");
    }
}
