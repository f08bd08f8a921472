use crate::{Cell, Grid, GridCost, Moves, Word};

/// What steps weigh on a grid, in a search that counts in a [`Word`].
///
/// On a grid without terrain a step weighs its length. With terrain it weighs its length times the
/// sum of the two cells' costs: twice the mean, and whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Weights {
    least: u32,
    most: u32,
    uniform: bool,
}

/// What the way between two cells weighs if nothing stands in it and every cell is the cheapest.
#[derive(Clone, Copy, Debug)]
pub struct Apart<W> {
    straight: W,
    /// What a diagonal step saves against two straight ones.
    saved: W,
}

impl<W: Word> Apart<W> {
    /// For cells so many columns and rows apart.
    #[inline]
    #[must_use]
    pub fn by(self, dx: u32, dy: u32) -> W {
        self.straight.times(dx) + self.straight.times(dy) - self.saved.times(dx.min(dy))
    }
}

impl Weights {
    /// The weights on `grid` as it is now.
    #[must_use]
    pub fn of(grid: &Grid) -> Self {
        let uniform = grid.is_uniform();
        let (least, most) = if uniform { (1, 1) } else { grid.cost_range() };
        let cells = if uniform { 1 } else { 2 };
        Self {
            least: cells * u32::from(least),
            most: cells * u32::from(most),
            uniform,
        }
    }

    /// Whether every step weighs its length.
    #[must_use]
    pub fn is_uniform(&self) -> bool {
        self.uniform
    }

    /// Whether a heuristic made for these weights is still consistent, and a weight still means
    /// the same, on a grid with weights `now`.
    #[must_use]
    pub fn hold_under(&self, now: Self) -> bool {
        self.uniform == now.uniform && self.least <= now.least && self.most >= now.most
    }

    /// What the step from one id to the next in direction `k` weighs.
    #[inline]
    #[must_use]
    pub fn step<W: Word>(&self, grid: &Grid, from: u32, to: u32, k: u32) -> W {
        let length = if k < 4 { W::STRAIGHT } else { W::DIAGONAL };
        if self.uniform {
            return length;
        }
        length.times(u32::from(grid.cost_id(from)) + u32::from(grid.cost_id(to)))
    }

    /// What the step between neighbouring ids weighs.
    #[inline]
    #[must_use]
    pub fn between<W: Word>(&self, grid: &Grid, from: u32, to: u32) -> W {
        let layout = grid.layout();
        let is_straight = |offset: i32| from.wrapping_add_signed(offset) == to;
        let k = layout.offsets()[..4]
            .iter()
            .any(|&offset| is_straight(offset));
        self.step(grid, from, to, if k { 0 } else { 4 })
    }

    /// What a path weighs that costs so much; `None` beyond [`Word::LIMIT`].
    #[must_use]
    pub fn of_cost<W: Word>(&self, cost: GridCost) -> Option<W> {
        let half = if self.uniform { 2 } else { 1 };
        let [straight, diagonal] = [cost.straight / half, cost.diagonal / half];
        let weight =
            u128::from(straight) * W::STRAIGHT.wide() + u128::from(diagonal) * W::DIAGONAL.wide();
        let times = |length: W, n: u64| Some(length.times(u32::try_from(n).ok()?));
        (weight < W::LIMIT.wide())
            .then(|| Some(times(W::STRAIGHT, straight)? + times(W::DIAGONAL, diagonal)?))?
    }

    /// The heuristic of A*: from an id, the weight of the shortest way to `goal` if nothing stood
    /// in it and every cell were the cheapest. It is consistent for every move rule.
    pub fn octile<W: Word>(
        &self,
        grid: &Grid,
        moves: Moves,
        goal: Cell,
    ) -> impl Fn(u32) -> W + use<W> {
        let layout = *grid.layout();
        let (goal_x, goal_y) = layout.position(layout.id(goal));
        let apart = self.apart(moves);
        move |id| {
            let (x, y) = layout.position(id);
            apart.by(x.abs_diff(goal_x), y.abs_diff(goal_y))
        }
    }

    /// The same between two cells.
    #[must_use]
    pub fn apart<W: Word>(&self, moves: Moves) -> Apart<W> {
        let straight = W::STRAIGHT.times(self.least);
        let saved = match moves {
            Moves::Orthogonal => W::default(),
            _ => straight + straight - W::DIAGONAL.times(self.least),
        };
        Apart { straight, saved }
    }

    /// By how much one step raises the key of a search at most: by its weight, and the heuristic
    /// by no more than that.
    #[must_use]
    pub fn reach<W: Word>(&self) -> W {
        W::DIAGONAL.times(2 * self.most)
    }

    /// How wide the buckets of an open list should be, as a power of two: a half to a quarter of
    /// the cheapest step. Measured: narrower ones lie empty, wider ones expand cells again.
    #[must_use]
    pub fn shift<W: Word>(&self) -> u32 {
        W::STRAIGHT.times(self.least).wide().ilog2() - 1
    }

    /// Whether `layers` weights of up to [`Word::LIMIT`], a heuristic and a few steps add up within
    /// the word.
    #[must_use]
    pub fn fit<W: Word>(&self, grid: &Grid, layers: u32) -> bool {
        let across = u128::from(grid.width()) + u128::from(grid.height());
        let heuristic = across * W::STRAIGHT.wide() * u128::from(self.least);
        let step = W::DIAGONAL.wide() * u128::from(self.most);
        W::LIMIT.wide() * u128::from(layers) + heuristic + 4 * step <= W::MAX.wide()
    }
}
