//! The swarm: flat arrays, a row of numbers for each particle.

use crate::{cost::Danger, params::PsoParams};
use pf_core::{Context, PlanRng};
use pf_geom::{Point, WorldProblem};
use rand::RngExt;

/// Particles, kept from plan to plan.
#[derive(Clone, Debug, Default)]
pub(crate) struct Swarm {
    /// Numbers a particle.
    width: usize,
    at: Vec<f64>,
    velocity: Vec<f64>,
    /// The best place each has been at, and its cost.
    best: Vec<f64>,
    cost: Vec<f64>,
    /// The best particle.
    leader: usize,
    /// The order of the particles by cost, while it is needed.
    order: Vec<usize>,
    /// The best place of all when an iteration begins.
    lead: Vec<f64>,
}

/// What all that costs depends on.
pub(crate) struct Task<'a> {
    pub(crate) problem: &'a WorldProblem,
    pub(crate) params: &'a PsoParams,
    pub(crate) danger: &'a Danger,
}

impl Task<'_> {
    fn cost(&self, waypoints: &[f64], cx: &mut Context<'_, WorldProblem>) -> f64 {
        cx.candidate(|| self.path(waypoints));
        self.danger.cost(self.problem, self.params, waypoints)
    }

    /// The path through waypoints.
    pub(crate) fn path(&self, waypoints: &[f64]) -> Vec<Point> {
        let mut path = Vec::with_capacity(waypoints.len() / 2 + 2);
        path.push(self.problem.start());
        path.extend(points(waypoints));
        path.push(self.problem.goal());
        path
    }

    fn draw(&self, rng: &mut PlanRng, into: &mut [f64]) {
        let bounds = self.problem.world().bounds();
        for (k, value) in into.iter_mut().enumerate() {
            *value = rng.random_range(bounds.min()[k % 2]..=bounds.max()[k % 2]);
        }
    }
}

fn points(waypoints: &[f64]) -> impl Iterator<Item = Point> + '_ {
    waypoints.chunks_exact(2).map(|w| Point::new(w[0], w[1]))
}

impl Swarm {
    /// Forgets all particles.
    pub(crate) fn clear(&mut self) {
        self.cost.clear();
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.cost.is_empty()
    }

    /// The best place of all.
    pub(crate) fn leader(&self) -> &[f64] {
        &self.best[self.leader * self.width..(self.leader + 1) * self.width]
    }

    pub(crate) fn leader_cost(&self) -> f64 {
        self.cost[self.leader]
    }

    /// Puts all particles anywhere, at rest.
    pub(crate) fn scatter(&mut self, task: &Task<'_>, cx: &mut Context<'_, WorldProblem>) {
        self.width = 2 * task.params.waypoints;
        let numbers = self.width * task.params.particles;
        self.at.clear();
        self.at.resize(numbers, 0.0);
        self.velocity.clear();
        self.velocity.resize(numbers, 0.0);
        task.draw(cx.rng(), &mut self.at);
        self.best.clone_from(&self.at);
        self.cost.clear();
        for particle in 0..task.params.particles {
            let row = particle * self.width..(particle + 1) * self.width;
            self.cost.push(task.cost(&self.at[row], cx));
        }
        self.find_leader();
        self.show(cx);
    }

    /// What each particle knows is evaluated anew; the worse half starts again.
    pub(crate) fn stir(&mut self, task: &Task<'_>, cx: &mut Context<'_, WorldProblem>) {
        for particle in 0..self.cost.len() {
            let row = particle * self.width..(particle + 1) * self.width;
            self.cost[particle] = task.cost(&self.best[row], cx);
        }
        self.order.clear();
        self.order.extend(0..self.cost.len());
        self.order
            .sort_by(|a, b| self.cost[*a].total_cmp(&self.cost[*b]));
        for &particle in &self.order[self.cost.len().div_ceil(2)..] {
            let row = particle * self.width..(particle + 1) * self.width;
            task.draw(cx.rng(), &mut self.at[row.clone()]);
            self.velocity[row.clone()].fill(0.0);
            self.cost[particle] = task.cost(&self.at[row.clone()], cx);
            self.best[row.clone()].copy_from_slice(&self.at[row]);
        }
        self.find_leader();
        self.show(cx);
    }

    /// Moves every particle once (eq. 1, 2); `inertia` is the share of its velocity that it keeps.
    /// Says whether there is a new best place.
    pub(crate) fn fly(
        &mut self,
        task: &Task<'_>,
        inertia: f64,
        cx: &mut Context<'_, WorldProblem>,
    ) -> bool {
        let bounds = task.problem.world().bounds();
        let (c1, c2) = (task.params.c1, task.params.c2);
        let before = self.leader_cost();
        self.lead.clear();
        let leader = self.leader * self.width..(self.leader + 1) * self.width;
        self.lead.extend_from_slice(&self.best[leader]);
        for particle in 0..self.cost.len() {
            let row = particle * self.width..(particle + 1) * self.width;
            for (k, goal) in row.clone().zip(&self.lead) {
                let (r1, r2): (f64, f64) = (cx.rng().random(), cx.rng().random());
                let here = self.at[k];
                let velocity = inertia * self.velocity[k]
                    + c1 * r1 * (self.best[k] - here)
                    + c2 * r2 * (goal - here);
                self.velocity[k] = velocity;
                self.at[k] = (here + velocity).clamp(bounds.min()[k % 2], bounds.max()[k % 2]);
            }
            let cost = task.cost(&self.at[row.clone()], cx);
            if cost < self.cost[particle] {
                self.cost[particle] = cost;
                self.best[row.clone()].copy_from_slice(&self.at[row]);
            }
        }
        self.find_leader();
        self.show(cx);
        self.leader_cost() < before
    }

    fn find_leader(&mut self) {
        let order = self.cost.iter().enumerate();
        let least = order.min_by(|a, b| a.1.total_cmp(b.1));
        self.leader = least.map_or(0, |(particle, _)| particle);
    }

    fn show(&self, cx: &mut Context<'_, WorldProblem>) {
        cx.points("particles", || points(&self.at).collect());
    }
}
