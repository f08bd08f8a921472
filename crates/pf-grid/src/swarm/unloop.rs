use crate::{Cell, Grid, GridCost, Layout};

/// Cuts the loops out of a walk.
#[derive(Clone, Debug, Default)]
pub(crate) struct Unloop {
    path: Vec<u32>,
    /// Where on the path a cell stood last; it counts only if the path agrees.
    place: Vec<u32>,
}

impl Unloop {
    /// The ids of the walk from `start` without what lay between two visits of one cell.
    pub(crate) fn cut(&mut self, layout: &Layout, start: u32, steps: &[u8]) -> &[u32] {
        let offsets = layout.offsets();
        self.place.resize(layout.len(), 0);
        self.path.clear();
        self.put(start);
        let mut at = start;
        for &k in steps {
            at = at.wrapping_add_signed(offsets[usize::from(k)]);
            self.put(at);
        }
        &self.path
    }

    fn put(&mut self, id: u32) {
        let place = self.place[id as usize] as usize;
        if self.path.get(place) == Some(&id) {
            self.path.truncate(place + 1);
            return;
        }
        #[expect(clippy::cast_possible_truncation, reason = "no path has 2^32 cells")]
        {
            self.place[id as usize] = self.path.len() as u32;
        }
        self.path.push(id);
    }
}

/// What a path of neighbouring ids costs.
pub(crate) fn cost(grid: &Grid, path: &[u32]) -> GridCost {
    let straight = &grid.layout().offsets()[..4];
    let mut cost = GridCost::ZERO;
    for pair in path.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let sum = u64::from(grid.cost_id(from)) + u64::from(grid.cost_id(to));
        if straight.contains(&to.wrapping_sub(from).cast_signed()) {
            cost.straight += sum;
        } else {
            cost.diagonal += sum;
        }
    }
    cost
}

/// What a walk from `start` costs, loops and all.
pub(crate) fn walk_cost(grid: &Grid, start: u32, steps: &[u8]) -> GridCost {
    let offsets = grid.layout().offsets();
    let mut cost = GridCost::ZERO;
    let mut at = start;
    for &k in steps {
        let next = at.wrapping_add_signed(offsets[usize::from(k)]);
        let sum = u64::from(grid.cost_id(at)) + u64::from(grid.cost_id(next));
        if k < 4 {
            cost.straight += sum;
        } else {
            cost.diagonal += sum;
        }
        at = next;
    }
    cost
}

/// The cells of a path of ids.
pub(crate) fn cells(layout: &Layout, path: &[u32]) -> Vec<Cell> {
    path.iter().map(|&id| layout.cell(id)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_comes_back_to_a_cell_is_cut() {
        let grid = Grid::open(4, 4).unwrap();
        let layout = grid.layout();
        let mut unloop = Unloop::default();
        // East, south, west, north, east, south-east: a round, then on.
        let path = unloop.cut(layout, layout.id(Cell::new(0, 0)), &[0, 1, 2, 3, 0, 4]);
        let expected = [(0, 0), (1, 0), (2, 1)].map(|(x, y)| Cell { x, y });
        assert_eq!(cells(layout, path), expected);
        assert_eq!(cost(&grid, path), GridCost::of_steps(1, 1));
        // Places of the walk before do not count.
        let path = unloop
            .cut(layout, layout.id(Cell::new(1, 0)), &[1])
            .to_vec();
        assert_eq!(path.len(), 2);
    }
}
