//! The river's bed: altitudes, where drops go by them, and what drops do to them.

use crate::{Pull, Slope, Toll, exp2::exp2};
use pf_core::Context;
use pf_grid::{
    Buckets, Cell, Chances, Draw, Ended, GridChange, GridCost, GridProblem, Medium, SwarmRules,
    Visited, Walk, Weights, Word,
};
use std::f64::consts::SQRT_2;

/// What RFD and RFD* have in common, and in what they differ.
#[derive(Clone, Debug)]
pub(crate) struct Rules {
    pub(crate) altitude: f64,
    pub(crate) law: Law,
    pub(crate) alpha: f64,
    pub(crate) pull: Pull,
    pub(crate) erosion: f64,
    pub(crate) toll: Toll,
    pub(crate) deposit: f64,
    pub(crate) climb: f64,
    pub(crate) clamp: bool,
    pub(crate) seeded: bool,
    pub(crate) swarm: SwarmRules,
}

/// How drops choose and erode.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Law {
    /// RFD, eq. 1-4.
    Linear {
        delta: f64,
        omega: f64,
        flat: f64,
        uphill: f64,
    },
    /// RFD*, eq. 6.
    Exponential { log_base: f64, slope: Slope },
}

/// Gradients as small as this are flat: sums of altitudes are not exact.
const FLAT: f64 = 1e-12;

/// Altitudes, and the chances that follow from them.
#[derive(Clone, Debug)]
pub(crate) struct Bed {
    rules: Rules,
    altitude: Vec<f64>,
    /// By id: the logarithm to base 2 of what nearness to the goal adds to a weight as a factor.
    pull: Vec<f64>,
    /// By all directions, and by those downhill.
    all: Chances,
    down: Chances,
    /// The probability that a step may go uphill or stay level.
    climb: f64,
    /// Ids of cells whose altitude changed since the chances were worked out, each once.
    changed: Vec<u32>,
    is_changed: Vec<bool>,
    /// Scratch: cells whose chances are to be worked out, each once.
    stale: Vec<u32>,
    is_stale: Vec<bool>,
    goal: u32,
}

impl Bed {
    pub(crate) fn new(rules: Rules) -> Self {
        Self {
            rules,
            altitude: Vec::new(),
            pull: Vec::new(),
            all: Chances::default(),
            down: Chances::default(),
            climb: 0.0,
            changed: Vec::new(),
            is_changed: Vec::new(),
            stale: Vec::new(),
            is_stale: Vec::new(),
            goal: 0,
        }
    }

    pub(crate) fn rules(&self) -> &Rules {
        &self.rules
    }

    /// A plain, or the distances to the goal.
    pub(crate) fn begin(&mut self, problem: &GridProblem) {
        let layout = problem.grid().layout();
        self.altitude.clear();
        self.altitude.resize(layout.len(), self.rules.altitude);
        self.is_changed.clear();
        self.is_changed.resize(layout.len(), false);
        self.is_stale.clear();
        self.is_stale.resize(layout.len(), false);
        self.changed.clear();
        if self.rules.seeded {
            distances(problem, &mut self.altitude);
        }
        self.goal = layout.id(problem.goal());
        self.altitude[self.goal as usize] = 0.0;
        self.look_to_goal(problem);
        self.weigh_all(problem);
    }

    /// Follows changes of the problem as the paper does: altitudes are kept, but freed cells get
    /// the first altitude, and an old goal the mean of its neighbours'.
    pub(crate) fn follow(&mut self, problem: &GridProblem, changes: &[GridChange]) {
        let layout = problem.grid().layout();
        for change in changes {
            if let GridChange::Freed(cells) = change {
                for &cell in cells {
                    self.altitude[layout.id(cell) as usize] = self.rules.altitude;
                }
            }
        }
        let goal = layout.id(problem.goal());
        if goal != self.goal {
            self.altitude[self.goal as usize] = self.mean_around(problem, self.goal);
            self.goal = goal;
        }
        self.altitude[goal as usize] = 0.0;
        self.look_to_goal(problem);
        self.weigh_all(problem);
    }

    fn mean_around(&self, problem: &GridProblem, id: u32) -> f64 {
        let around = problem.grid().around_id(id);
        let legal = problem.moves().legal(around);
        let (mut sum, mut count) = (0.0, 0.0);
        for (k, offset) in problem.grid().layout().offsets().into_iter().enumerate() {
            if legal >> k & 1 == 1 {
                sum += self.altitude[id.wrapping_add_signed(offset) as usize];
                count += 1.0;
            }
        }
        if count > 0.0 {
            sum / count
        } else {
            self.rules.altitude
        }
    }

    /// Whether nearness to the goal counts.
    fn is_pulled(&self) -> bool {
        self.rules.alpha > 0.0
    }

    fn look_to_goal(&mut self, problem: &GridProblem) {
        let layout = problem.grid().layout();
        self.pull.clear();
        self.pull.resize(layout.len(), 0.0);
        if !self.is_pulled() {
            return;
        }
        let (goal, alpha) = (problem.goal(), self.rules.alpha);
        let square = |a: u32, b: u32| f64::from(a.abs_diff(b)).powi(2);
        for cell in layout.cells() {
            let squared = square(cell.x, goal.x) + square(cell.y, goal.y);
            self.pull[layout.id(cell) as usize] = match self.rules.pull {
                Pull::Power => -0.5 * alpha * squared.log2(),
                Pull::Exponential => -alpha.log2() * squared.sqrt(),
            };
        }
    }

    fn weigh_all(&mut self, problem: &GridProblem) {
        let layout = problem.grid().layout();
        self.all.reset(layout);
        self.down.reset(layout);
        for cell in layout.cells() {
            self.weigh(problem, layout.id(cell));
        }
        for id in self.changed.drain(..) {
            self.is_changed[id as usize] = false;
        }
    }

    /// Works out the chances at one cell.
    fn weigh(&mut self, problem: &GridProblem, id: u32) {
        let grid = problem.grid();
        if !grid.is_free_id(id) {
            return;
        }
        let legal = problem.moves().legal(grid.around_id(id));
        let offsets = grid.layout().offsets();
        if self.is_pulled()
            && let Some(k) = (0..8)
                .find(|&k| legal >> k & 1 == 1 && id.wrapping_add_signed(offsets[k]) == self.goal)
        {
            // The goal's distance is 0: nothing else has a chance.
            let mut weights = [0.0; 8];
            weights[k] = 1.0;
            self.all.set(id, &weights);
            self.down.set(id, &weights);
            return;
        }
        let mut gradients = [0.0; 8];
        let mut pulls = [0.0; 8];
        let mut downhill = 0;
        for k in 0..8 {
            let next = id.wrapping_add_signed(offsets[k]);
            gradients[k] = self.gradient(problem, id, next, k);
            pulls[k] = self.pull[next as usize];
            downhill |= u8::from(gradients[k] > FLAT) << k;
        }
        let weights = self.rules.law.weights(legal, &gradients, &pulls);
        self.all.set(id, &weights);
        if self.rules.climb < 1.0 {
            let mut weights = weights;
            for (k, weight) in weights.iter_mut().enumerate() {
                if downhill >> k & 1 == 0 {
                    *weight = 0.0;
                }
            }
            self.down.set(id, &weights);
        }
    }

    /// By how much the bed falls on the step to the next cell, by the step's length; terrain makes
    /// it longer. In the authors' exponent lengths do not count.
    #[inline]
    fn gradient(&self, problem: &GridProblem, from: u32, to: u32, k: usize) -> f64 {
        let fall = self.altitude[from as usize] - self.altitude[to as usize];
        if let Law::Exponential {
            slope: Slope::Percent,
            ..
        } = self.rules.law
        {
            return fall * (100.0 / self.rules.altitude);
        }
        let grid = problem.grid();
        let length = if k < 4 { 1.0 } else { SQRT_2 };
        let terrain = f64::midpoint(f64::from(grid.cost_id(from)), f64::from(grid.cost_id(to)));
        fall / (length * terrain)
    }

    fn mark(&mut self, id: u32) {
        if !self.is_changed[id as usize] {
            self.is_changed[id as usize] = true;
            self.changed.push(id);
        }
    }

    /// Eq. 4, and what a drop that is stuck leaves behind. Says how much was eroded.
    #[expect(
        clippy::cast_precision_loss,
        reason = "numbers of cells, drops and steps"
    )]
    fn erode(&mut self, problem: &GridProblem, walk: &Walk, drops: usize) -> f64 {
        let layout = problem.grid().layout();
        let offsets = layout.offsets();
        let divisor = match self.rules.toll {
            Toll::Swarm => {
                let cells = problem.grid().free_cells().max(2) - 1;
                f64::from(cells) * drops as f64
            }
            Toll::Path => walk.steps().len().max(1) as f64,
        };
        let share = self.rules.erosion / divisor;
        let mut at = layout.id(problem.start());
        let mut carried = 0.0;
        for &k in walk.steps() {
            let k = usize::from(k);
            let next = at.wrapping_add_signed(offsets[k]);
            let gradient = self.gradient(problem, at, next, k);
            // A bed does not sink below the sea.
            let eroded = (share * self.rules.law.erosion(gradient)).min(self.altitude[at as usize]);
            self.altitude[at as usize] -= eroded;
            carried += eroded;
            self.mark(at);
            at = next;
        }
        if walk.ended() == Ended::Stuck && at != self.goal && self.rules.deposit > 0.0 {
            self.altitude[at as usize] += self.rules.deposit * carried;
            self.mark(at);
        }
        carried
    }

    /// Eq. 5.
    fn rise(&mut self, problem: &GridProblem, eroded: f64) {
        let cells = problem.grid().free_cells().max(2) - 1;
        let rise = eroded / f64::from(cells);
        if rise <= 0.0 {
            return;
        }
        if self.rules.clamp {
            let most = self.rules.altitude;
            for id in 0..self.altitude.len() {
                let before = self.altitude[id];
                let after = (before + rise).min(most);
                if after.total_cmp(&before).is_ne() {
                    self.altitude[id] = after;
                    #[expect(clippy::cast_possible_truncation, reason = "an id")]
                    self.mark(id as u32);
                }
            }
        } else {
            for altitude in &mut self.altitude {
                *altitude += rise;
            }
            // All falls stay as they were, but those to the goal.
            self.mark(self.goal);
        }
        self.altitude[self.goal as usize] = 0.0;
    }

    /// Works out the chances anew where an altitude changed, and around it.
    fn weigh_changed(&mut self, problem: &GridProblem) {
        let offsets = problem.grid().layout().offsets();
        let mut stale = std::mem::take(&mut self.stale);
        for id in self.changed.drain(..) {
            self.is_changed[id as usize] = false;
            if !problem.grid().is_free_id(id) {
                continue;
            }
            let around = offsets
                .into_iter()
                .map(|offset| id.wrapping_add_signed(offset));
            for id in around.chain([id]) {
                if !self.is_stale[id as usize] {
                    self.is_stale[id as usize] = true;
                    stale.push(id);
                }
            }
        }
        for id in stale.drain(..) {
            self.is_stale[id as usize] = false;
            self.weigh(problem, id);
        }
        self.stale = stale;
    }
}

impl Law {
    /// The weights of the legal directions, up to a common factor.
    fn weights(&self, legal: u8, gradients: &[f64; 8], pulls: &[f64; 8]) -> [f64; 8] {
        let mut weights = [0.0; 8];
        let is_legal = |k: usize| legal >> k & 1 == 1;
        match *self {
            Self::Linear { delta, omega, .. } => {
                for k in (0..8).filter(|&k| is_legal(k)) {
                    let gradient = gradients[k];
                    weights[k] = if gradient > FLAT {
                        gradient
                    } else if gradient < -FLAT {
                        omega / -gradient
                    } else {
                        delta
                    };
                }
            }
            Self::Exponential { log_base, .. } => {
                let mut logs = [f64::NEG_INFINITY; 8];
                let mut most = f64::NEG_INFINITY;
                for k in (0..8).filter(|&k| is_legal(k)) {
                    logs[k] = log_base * gradients[k] + pulls[k];
                    most = most.max(logs[k]);
                }
                if most > f64::NEG_INFINITY {
                    for k in 0..8 {
                        weights[k] = if is_legal(k) {
                            exp2(logs[k] - most)
                        } else {
                            0.0
                        };
                    }
                }
            }
        }
        weights
    }

    /// What stands for the gradient in eq. 4.
    #[inline]
    fn erosion(&self, gradient: f64) -> f64 {
        match *self {
            Self::Linear { flat, uphill, .. } => {
                if gradient > FLAT {
                    gradient
                } else if gradient < -FLAT {
                    uphill
                } else {
                    flat
                }
            }
            Self::Exponential { log_base, .. } => exp2(log_base * gradient),
        }
    }
}

impl Medium for Bed {
    fn next(&self, at: u32, draw: Draw, _: &Visited) -> Option<u32> {
        let chances = if self.climb >= 1.0 || draw.happens(self.climb) {
            &self.all
        } else {
            &self.down
        };
        chances.pick(at, draw.chance())
    }

    fn begin(&mut self, iteration: u64) {
        #[expect(clippy::cast_precision_loss, reason = "beyond 2^53 it is 1 long since")]
        let iteration = iteration as f64;
        self.climb = self.rules.climb * iteration;
    }

    fn learn(&mut self, problem: &GridProblem, walks: &[Walk], _: Option<GridCost>) {
        let mut eroded = 0.0;
        for walk in walks {
            eroded += self.erode(problem, walk, walks.len());
        }
        self.rise(problem, eroded);
        self.weigh_changed(problem);
    }

    fn show(&self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) {
        let layout = problem.grid().layout();
        cx.field("altitude", |&cell: &Cell| {
            if layout.contains(cell) {
                self.altitude[layout.id(cell) as usize]
            } else {
                0.0
            }
        });
    }
}

/// The distances to the goal, where there are any; the other altitudes stay. Dijkstra's algorithm.
fn distances(problem: &GridProblem, altitude: &mut [f64]) {
    let grid = problem.grid();
    let (layout, weights) = (grid.layout(), Weights::of(grid));
    if !grid.is_free(problem.goal()) {
        return;
    }
    let offsets = layout.offsets();
    let mut known = vec![u64::MAX; layout.len()];
    let mut open = Buckets::<u64>::default();
    open.reset(0, weights.reach(), weights.shift::<u64>());
    let goal = layout.id(problem.goal());
    known[goal as usize] = 0;
    open.push(0, goal, 0);
    while let Some((id, g)) = open.pop(u64::MAX) {
        if g > known[id as usize] {
            continue;
        }
        let mut legal = problem.moves().legal(grid.around_id(id));
        while legal != 0 {
            let k = legal.trailing_zeros();
            legal &= legal - 1;
            let next = id.wrapping_add_signed(offsets[k as usize]);
            let through = g + weights.step::<u64>(grid, id, next, k);
            if through < known[next as usize] {
                known[next as usize] = through;
                open.push(through, next, through);
            }
        }
    }
    // With terrain a step weighs twice what it costs.
    let unit = if weights.is_uniform() { 1.0 } else { 2.0 };
    for (altitude, g) in altitude.iter_mut().zip(known) {
        if g < u64::MAX {
            #[expect(clippy::cast_precision_loss, reason = "altitudes are not exact")]
            {
                *altitude = g as f64 / (u64::STRAIGHT as f64 * unit);
            }
        }
    }
}
