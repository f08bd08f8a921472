//! One step: a colony of bees looks for the best place in the window.

use crate::{
    AbcParams,
    guide::{Guide, Worth},
    memory::Memory,
    params::Scouts,
};
use pf_core::{Context, InvalidParams, LocalPlanner, PlanRng, Step};
use pf_geom::{Observation, Point, Vector, Window, WorldProblem};
use rand::RngExt;
use std::collections::VecDeque;

/// What is left of the memory of places where something has changed.
const FADED: f64 = 0.25;

/// A colony of bees that decides where to step next, from nothing but what the robot sees and has
/// visited; see the [crate's page](crate). One iteration is one step.
///
/// It goes to the goal once it sees a free way there. Without a free place in sight it stays, and
/// the step counts. It forgets its way when the goal has moved further than the window is wide.
#[derive(Clone, Debug)]
pub struct Colony {
    params: AbcParams,
    window: Window,
    memory: Memory,
    /// What it remembers from before the walk.
    before: Memory,
    /// Changes that it has not been near since, before the walk and now.
    rumours: [Vec<(Point, Point)>; 2],
    /// Places too recent to count as visited.
    recent: VecDeque<Point>,
    steps: u64,
    at: Option<Point>,
    /// Where its memory leads.
    goal: Option<Point>,
    heading: Vector,
    swarm: Swarm,
}

impl Colony {
    /// A colony that walks as `params` say.
    ///
    /// # Errors
    /// [`InvalidParams`] with the name, the value and what would fit.
    pub fn new(params: AbcParams) -> Result<Self, InvalidParams> {
        params.check()?;
        let window = Window::new(params.half).map_err(|_| {
            InvalidParams::bad("half", &params.half.to_string(), "a positive number")
        })?;
        let memory = Memory::new(params.reach * params.half);
        Ok(Self {
            window,
            before: memory.clone(),
            memory,
            rumours: Default::default(),
            recent: VecDeque::with_capacity(params.delay + 1),
            steps: 0,
            at: None,
            goal: None,
            heading: Vector::zeros(),
            swarm: Swarm::default(),
            params,
        })
    }

    /// What it was given.
    #[must_use]
    pub fn params(&self) -> &AbcParams {
        &self.params
    }

    /// From the next walk on it remembers that the robot has walked here, and knows that something
    /// changed in these boxes. Memory of such a place fades when the robot sees it again, not
    /// before.
    pub fn recall(&mut self, walked: &[Point], changed: &[(Point, Point)]) {
        for &p in walked {
            notice(&mut self.rumours[0], &mut self.before, p, self.params.half);
            self.before.visit(p);
        }
        self.rumours[0].extend_from_slice(changed);
    }

    /// Forgets what it was told by [`recall`](Self::recall).
    pub fn forget(&mut self) {
        self.before.clear();
        self.rumours[0].clear();
    }

    fn arrive(&mut self, seen: &Observation) {
        let here = seen.here();
        let goal = *self.goal.get_or_insert(seen.goal());
        if (seen.goal() - goal).norm() > 2.0 * self.params.half {
            // What it learnt on the way to another place is worth nothing.
            self.memory.clear();
            self.recent.clear();
            self.goal = Some(seen.goal());
        }
        if let Some(at) = self.at
            && at != here
        {
            self.heading = here - at;
        }
        self.at = Some(here);
        if self.params.memory > 0.0 {
            let (memory, rumours) = (&mut self.memory, &mut self.rumours[1]);
            notice(rumours, memory, here, self.params.half);
            self.recent.push_back(here);
            if self.recent.len() > self.params.delay
                && let Some(place) = self.recent.pop_front()
            {
                memory.visit(place);
            }
            let (low, high) = seen.room();
            memory.look(low, high);
        }
    }
}

/// Lets the memory of changed places fade that the robot sees from here.
fn notice(rumours: &mut Vec<(Point, Point)>, memory: &mut Memory, here: Point, half: f64) {
    rumours.retain(|&(min, max)| {
        let seen = (0..2).all(|k| min[k] <= here[k] + half && here[k] - half <= max[k]);
        if seen {
            memory.fade((min, max), FADED);
        }
        !seen
    });
}

impl LocalPlanner<WorldProblem> for Colony {
    fn name(&self) -> &'static str {
        "cABC"
    }

    fn sensor(&self) -> Window {
        self.window
    }

    fn reset(&mut self) {
        let [before, now] = &mut self.rumours;
        now.clone_from(before);
        self.memory.copy(&self.before);
        self.recent.clear();
        self.steps = 0;
        self.at = None;
        self.goal = None;
        self.heading = Vector::zeros();
    }

    fn step(&mut self, seen: &Observation, cx: &mut Context<'_, WorldProblem>) -> Step<Point> {
        let (low, high) = seen.room();
        if low.x > high.x || low.y > high.y {
            let (radius, half) = (seen.radius(), self.params.half);
            let words =
                format!("a robot of radius {radius} does not see round itself, half={half}");
            cx.note("gave up", words);
            return Step::GiveUp;
        }
        if self.steps >= self.params.steps {
            cx.note("gave up", format_args!("after steps={}", self.params.steps));
            return Step::GiveUp;
        }
        self.steps += 1;
        self.arrive(seen);
        if seen.shows_goal() && seen.is_free(seen.here(), seen.goal()) {
            return Step::To(seen.goal());
        }
        let guide = Guide {
            params: &self.params,
            memory: &self.memory,
            heading: self.heading,
            seen,
        };
        let best = self.swarm.forage(&guide, cx.rng());
        cx.evaluated(self.swarm.flights);
        cx.points("bees", || self.swarm.places.clone());
        best.map_or(Step::Stay, Step::To)
    }
}

/// The food sources.
#[derive(Clone, Debug, Default)]
struct Swarm {
    places: Vec<Point>,
    worths: Vec<Worth>,
    /// How often nobody could improve each.
    trials: Vec<u32>,
    chances: Vec<f64>,
    best: Option<(f64, Point)>,
    /// How many places were looked at.
    flights: u64,
}

impl Swarm {
    /// The best feasible place that anybody sees.
    fn forage(&mut self, guide: &Guide<'_>, rng: &mut PlanRng) -> Option<Point> {
        let params = guide.params;
        self.best = None;
        self.flights = 0;
        self.places.clear();
        self.worths.clear();
        self.trials.clear();
        self.trials.resize(params.sources, 0);
        for _ in 0..params.sources {
            let place = anywhere(guide, rng);
            let worth = self.look(guide, place);
            self.places.push(place);
            self.worths.push(worth);
        }
        for _ in 0..params.cycles {
            for i in 0..params.sources {
                self.improve(i, guide, rng);
            }
            self.send_onlookers(guide, rng);
            self.send_scouts(guide, rng);
        }
        self.best.map(|(_, place)| place)
    }

    fn look(&mut self, guide: &Guide<'_>, place: Point) -> Worth {
        let worth = guide.worth(place);
        self.flights += 1;
        if worth.entered == 0 && self.best.is_none_or(|(phi, _)| worth.phi < phi) {
            self.best = Some((worth.phi, place));
        }
        worth
    }

    /// A bee moves along one axis, towards another source or away from it (eq. 8), and stays if
    /// it is better there by Deb's rules.
    fn improve(&mut self, i: usize, guide: &Guide<'_>, rng: &mut PlanRng) {
        let n = self.places.len();
        let axis = usize::from(rng.random_bool(0.5));
        let other = (i + rng.random_range(1..n)) % n;
        let apart = self.places[i][axis] - self.places[other][axis];
        let (low, high) = guide.seen.room();
        let mut place = self.places[i];
        place[axis] += rng.random_range(-1.0..=1.0) * apart;
        place[axis] = place[axis].clamp(low[axis], high[axis]);
        let worth = self.look(guide, place);
        if worth.beats(&self.worths[i]) {
            self.places[i] = place;
            self.worths[i] = worth;
            self.trials[i] = 0;
        } else {
            self.trials[i] = self.trials[i].saturating_add(1);
        }
    }

    /// Onlookers choose sources by their worth (eq. 10, of which the text at hand shows nothing;
    /// Karaboga and Akay 2011), until as many improvements have been tried as there are sources.
    fn send_onlookers(&mut self, guide: &Guide<'_>, rng: &mut PlanRng) {
        let feasible = self.worths.iter().filter(|worth| worth.entered == 0);
        let fitness: f64 = feasible.map(Worth::fitness).sum();
        let entered: f64 = self.worths.iter().map(|w| f64::from(w.entered)).sum();
        let share = |part: f64, sum: f64| if sum > 0.0 { part / sum } else { 0.0 };
        self.chances.clear();
        self.chances.extend(self.worths.iter().map(|worth| {
            if worth.entered == 0 {
                0.5 + 0.5 * share(worth.fitness(), fitness)
            } else {
                0.5 * (1.0 - share(f64::from(worth.entered), entered))
            }
        }));
        let mut tried = 0;
        let mut i = 0;
        while tried < self.places.len() {
            if rng.random_range(0.0..1.0) < self.chances[i] {
                self.improve(i, guide, rng);
                tried += 1;
            }
            i = (i + 1) % self.places.len();
        }
    }

    fn send_scouts(&mut self, guide: &Guide<'_>, rng: &mut PlanRng) {
        let limit = guide.params.too_many();
        let failed = |trials: u32| f64::from(trials) >= limit && trials > 0;
        match guide.params.scouts {
            Scouts::All => {
                for i in 0..self.places.len() {
                    if failed(self.trials[i]) {
                        self.abandon(i, guide, rng);
                    }
                }
            }
            Scouts::One => {
                let worst = (0..self.places.len()).rev().max_by_key(|&i| self.trials[i]);
                if let Some(i) = worst.filter(|&i| failed(self.trials[i])) {
                    self.abandon(i, guide, rng);
                }
            }
        }
    }

    fn abandon(&mut self, i: usize, guide: &Guide<'_>, rng: &mut PlanRng) {
        self.places[i] = anywhere(guide, rng);
        self.worths[i] = self.look(guide, self.places[i]);
        self.trials[i] = 0;
    }
}

/// Anywhere in the window (eq. 7).
fn anywhere(guide: &Guide<'_>, rng: &mut PlanRng) -> Point {
    let (low, high) = guide.seen.room();
    let mut along = |k: usize| {
        let at = low[k] + (high[k] - low[k]) * rng.random_range(0.0..=1.0);
        at.clamp(low[k], high[k])
    };
    let x = along(0);
    Point::new(x, along(1))
}
