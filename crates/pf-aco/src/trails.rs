//! The pheromone on the edges, and what ants make of it.

use crate::AcoParams;
use pf_core::Context;
use pf_grid::{
    Cell, Chances, Draw, Ended, GridChange, GridCost, GridProblem, Medium, Visited, Walk,
};

/// The tau of the papers, on every edge in both directions.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trails {
    /// By id and direction. An edge lies here twice, with one value.
    tau: Vec<[f64; 8]>,
    /// By id: what the cell's nearness to the goal adds to a weight, as a factor.
    pull: Vec<f64>,
    chances: Chances,
    params: AcoParams,
    alpha: f64,
    offsets: [i32; 8],
    /// Ids of cells whose edges were walked on since the chances were worked out, each once.
    walked: Vec<u32>,
    is_walked: Vec<bool>,
    /// Trail limits, once there is a path.
    limits: Option<(f64, f64)>,
    /// For cutting loops.
    place: Vec<u32>,
    path: Vec<u8>,
}

/// No trail fades away altogether.
const FAINTEST: f64 = 1e-30;

/// The other direction.
fn back(k: usize) -> usize {
    k & 4 | (k + 2) & 3
}

impl Trails {
    pub(crate) fn new(params: AcoParams, alpha: f64) -> Self {
        Self {
            params,
            alpha,
            ..Self::default()
        }
    }

    pub(crate) fn params(&self) -> &AcoParams {
        &self.params
    }

    /// The same pheromone everywhere.
    pub(crate) fn begin(&mut self, problem: &GridProblem) {
        let len = problem.grid().layout().len();
        self.offsets = problem.grid().layout().offsets();
        self.tau.clear();
        self.tau.resize(len, [self.params.tau0; 8]);
        self.is_walked.clear();
        self.is_walked.resize(len, false);
        self.walked.clear();
        self.limits = None;
        self.look_to_goal(problem);
        self.weigh_all(problem);
    }

    /// Follows changes of the problem: pheromone stays, but on the edges of freed cells.
    pub(crate) fn follow(&mut self, problem: &GridProblem, changes: &[GridChange]) {
        let layout = problem.grid().layout();
        for change in changes {
            match change {
                GridChange::Freed(cells) => {
                    for &cell in cells {
                        self.renew(layout.id(cell), &layout.offsets());
                    }
                }
                GridChange::GoalMoved(_) => self.look_to_goal(problem),
                GridChange::StartMoved(_)
                | GridChange::Blocked(_)
                | GridChange::CostChanged(..) => {}
            }
        }
        self.weigh_all(problem);
    }

    fn renew(&mut self, id: u32, offsets: &[i32; 8]) {
        for (k, offset) in offsets.iter().enumerate() {
            self.tau[id as usize][k] = self.params.tau0;
            self.tau[id.wrapping_add_signed(*offset) as usize][back(k)] = self.params.tau0;
        }
    }

    /// 1 / d^alpha for every cell, d being its straight distance to the goal.
    fn look_to_goal(&mut self, problem: &GridProblem) {
        let layout = problem.grid().layout();
        self.pull.clear();
        self.pull.resize(layout.len(), 1.0);
        if self.alpha == 0.0 {
            return;
        }
        let goal = problem.goal();
        let square = |a: u32, b: u32| f64::from(a.abs_diff(b)).powi(2);
        for cell in layout.cells() {
            let squared = square(cell.x, goal.x) + square(cell.y, goal.y);
            self.pull[layout.id(cell) as usize] = squared.powf(-0.5 * self.alpha);
        }
    }

    fn weigh_all(&mut self, problem: &GridProblem) {
        let layout = problem.grid().layout();
        self.chances.reset(layout);
        for cell in layout.cells() {
            self.weigh(problem, layout.id(cell));
        }
        for id in self.walked.drain(..) {
            self.is_walked[id as usize] = false;
        }
    }

    /// Works out the chances at one cell.
    fn weigh(&mut self, problem: &GridProblem, id: u32) {
        let grid = problem.grid();
        if !grid.is_free_id(id) {
            return;
        }
        let legal = problem.moves().legal(grid.around_id(id));
        let goal = grid.layout().id(problem.goal());
        let mut weights = [0.0; 8];
        for (k, offset) in grid.layout().offsets().into_iter().enumerate() {
            let next = id.wrapping_add_signed(offset);
            if legal >> k & 1 == 0 {
                continue;
            }
            if next == goal && self.alpha > 0.0 {
                // Its distance is 0: nothing else has a chance.
                weights = [0.0; 8];
                weights[k] = 1.0;
                break;
            }
            weights[k] = self.tau[id as usize][k] * self.pull[next as usize];
        }
        self.chances.set(id, &weights);
    }

    fn deposit(&mut self, problem: &GridProblem, start: u32, steps: &[u8], amount: f64) {
        let offsets = problem.grid().layout().offsets();
        let mut at = start;
        for &k in steps {
            let k = usize::from(k);
            let next = at.wrapping_add_signed(offsets[k]);
            self.tau[at as usize][k] += amount;
            self.tau[next as usize][back(k)] += amount;
            self.mark(at);
            self.mark(next);
            at = next;
        }
    }

    fn mark(&mut self, id: u32) {
        if !self.is_walked[id as usize] {
            self.is_walked[id as usize] = true;
            self.walked.push(id);
        }
    }

    /// The steps without those between two visits of one cell.
    fn cut_loops(&mut self, problem: &GridProblem, start: u32, steps: &[u8]) {
        let layout = problem.grid().layout();
        let offsets = layout.offsets();
        // 0 is nowhere on the path: the start is at 1.
        self.place.clear();
        self.place.resize(layout.len(), 0);
        self.path.clear();
        let mut at = start;
        self.place[at as usize] = 1;
        for &k in steps {
            let next = at.wrapping_add_signed(offsets[usize::from(k)]);
            if self.place[next as usize] > 0 {
                // Back to where it was: undo the steps since.
                while at != next {
                    self.place[at as usize] = 0;
                    let Some(undone) = self.path.pop() else { break };
                    at = at.wrapping_add_signed(-offsets[usize::from(undone)]);
                }
            } else {
                self.path.push(k);
                at = next;
                self.place[at as usize] = 1;
            }
        }
    }

    /// The bounds of Stuetzle and Hoos 2000, eq. 11, with `p_best` = 0.05, between which trails stay.
    #[expect(clippy::cast_precision_loss, reason = "numbers of steps")]
    fn set_limits(&mut self, best: Option<GridCost>, steps: usize) {
        let Some(best) = best.filter(|_| self.params.limits) else {
            return;
        };
        let most = self.params.q / (self.params.rho.max(1e-3) * best.value().max(1.0));
        let root = 0.05f64.powf(1.0 / steps.max(2) as f64);
        // A cell has eight neighbours: four are open on average, less one.
        let least = (most * (1.0 - root) / (3.0 * root)).min(most);
        self.limits = Some((least, most));
    }
}

impl Medium for Trails {
    fn next(&self, at: u32, draw: Draw, visited: &Visited) -> Option<u32> {
        if !self.params.tabu {
            return self.chances.pick(at, draw.chance());
        }
        let open = (0..8).fold(0, |set, k| {
            let next = at.wrapping_add_signed(self.offsets[k]);
            set | u8::from(!visited.contains(next)) << k
        });
        self.chances.pick_among(at, open, draw.chance())
    }

    /// Eq. 8, then eq. 9.
    fn learn(&mut self, problem: &GridProblem, walks: &[Walk], best: Option<GridCost>) {
        let start = problem.grid().layout().id(problem.start());
        let mut shortest = usize::MAX;
        for walk in walks.iter().filter(|walk| walk.ended() == Ended::Arrived) {
            if self.params.loops {
                let length = length(problem, start, walk.steps());
                self.deposit(
                    problem,
                    start,
                    walk.steps(),
                    self.params.q / length.max(1.0),
                );
                shortest = shortest.min(walk.steps().len());
            } else {
                self.cut_loops(problem, start, walk.steps());
                let path = std::mem::take(&mut self.path);
                let length = length(problem, start, &path);
                self.deposit(problem, start, &path, self.params.q / length.max(1.0));
                shortest = shortest.min(path.len());
                self.path = path;
            }
        }
        let stays = 1.0 - self.params.rho;
        for tau in self.tau.iter_mut().flatten() {
            *tau = (*tau * stays).max(FAINTEST);
        }
        if shortest < usize::MAX {
            self.set_limits(best, shortest);
        }
        if let Some((least, most)) = self.limits {
            for tau in self.tau.iter_mut().flatten() {
                *tau = tau.clamp(least, most);
            }
            self.weigh_all(problem);
            return;
        }
        // What evaporates everywhere alike changes no chances.
        let mut walked = std::mem::take(&mut self.walked);
        for id in walked.drain(..) {
            self.is_walked[id as usize] = false;
            self.weigh(problem, id);
        }
        self.walked = walked;
    }

    fn show(&self, problem: &GridProblem, cx: &mut Context<'_, GridProblem>) {
        let layout = problem.grid().layout();
        cx.field("pheromone", |&cell: &Cell| {
            if !layout.contains(cell) {
                return 0.0;
            }
            let legal = problem
                .moves()
                .legal(problem.grid().around_id(layout.id(cell)));
            let tau = &self.tau[layout.id(cell) as usize];
            let open = (0..8).filter(|k| legal >> k & 1 == 1);
            open.map(|k: usize| tau[k]).fold(0.0, f64::max)
        });
    }
}

/// What a walk costs, loops included.
fn length(problem: &GridProblem, start: u32, steps: &[u8]) -> f64 {
    let grid = problem.grid();
    let offsets = grid.layout().offsets();
    let (mut cost, mut at) = (GridCost::ZERO, start);
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
    cost.value()
}
