//! Our rules: start in the class of the exact shortest path, keep off obstacles by exact distances,
//! raise their weight until the judge is content, or hand out the exact shortest path.

mod warm;

use crate::{
    class::{lay, length, ratio, thin},
    hinge::Hinge,
    newton::{Limits, Newton, Weighted},
    params::{LbfgsParams, Obstacles},
    potential::Potential,
    published::points,
};
use pf_core::{Context, Outcome, Problem, Proof, Report, Stamp};
use pf_geom::{Answer, Point, Route, TangentGraph, WorldProblem};

/// The weights of what is missing at the clearance: the first, how they grow, and how often.
const WEIGHT: f64 = 1e3;
const GROWTH: f64 = 30.0;
const RAISES: u32 = 4;
/// The path aims at this much more than the clearance, as a share of its mean step, for a finite
/// weight does not reach all of it.
const SPARE: f64 = 2e-3;
/// A step of Newton's method that promises less than this share of the loss is not taken.
const WORTH: f64 = 1e-6;
/// How much longer than the exact path its polyline may be for its arcs, as a share.
const EXCESS: f64 = 1e-6;

/// The same for the path to begin with.
const COARSE: f64 = 0.05;
/// Corners nearer to each other than this share of a step are one in the path to begin with.
const CLOSE: f64 = 0.3;

/// What our rules remember from plan to plan.
#[derive(Clone, Debug, Default)]
pub(crate) struct Exact {
    /// At the asked clearance, and at none.
    wide: TangentGraph,
    narrow: TangentGraph,
    newton: Newton,
    pub(crate) hinge: Hinge,
    filled: Option<Stamp>,
    /// The last path handed out, flat; empty if there was none.
    last: Vec<f64>,
    /// Whether it was as good as it gets.
    finished: bool,
    /// A way that was not taken, as good as it gets, and where: hardly any better soon after.
    rival: Vec<f64>,
    rival_in: Option<Stamp>,
    /// The exact shortest path as it was laid out, the path in work, and others.
    corners: Vec<Point>,
    laid: Vec<f64>,
    path: Vec<f64>,
    kept: Vec<f64>,
    joined: Vec<f64>,
}

/// An exact shortest path, and at what distance from everything.
struct Guide {
    route: Route,
    distance: f64,
    /// Whose it is.
    wide: bool,
}

/// How a path came about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Origin {
    Kept,
    Repaired,
    Afresh,
}

impl Exact {
    /// Forgets all that may show in an answer.
    pub(crate) fn forget(&mut self) {
        self.wide.forget();
        self.narrow.forget();
        self.last.clear();
        self.rival.clear();
    }

    /// Plans from scratch.
    pub(crate) fn plan(
        &mut self,
        problem: &WorldProblem,
        params: &LbfgsParams,
        potential: &Potential,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Report<WorldProblem> {
        self.answer(problem, params, potential, false, cx)
    }

    /// Plans from the last path. With `unchanged` that is the answer.
    pub(crate) fn replan(
        &mut self,
        problem: &WorldProblem,
        params: &LbfgsParams,
        potential: &Potential,
        unchanged: bool,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Report<WorldProblem> {
        if unchanged && self.finished && !self.last.is_empty() {
            if !cx.proceed() {
                return cx.report(Outcome::Unknown { attempt: None });
            }
            let path = points(&self.last).collect();
            return self.close(problem, path, Origin::Kept, true, cx);
        }
        self.answer(problem, params, potential, true, cx)
    }

    fn answer(
        &mut self,
        problem: &WorldProblem,
        params: &LbfgsParams,
        potential: &Potential,
        warm: bool,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Report<WorldProblem> {
        let guide = match self.guide(problem, params.clearance, cx) {
            Ok(guide) => guide,
            Err(outcome) => {
                self.last.clear();
                return cx.report(outcome);
            }
        };
        if self.filled != Some(problem.world().stamp()) {
            self.hinge.solids.fill(problem.world());
            self.hinge.bounds = Some(*problem.world().bounds());
            self.filled = Some(problem.world().stamp());
        }
        let excess = COARSE * guide.route.length();
        guide.route.flatten_into(excess, &mut self.corners);
        thin(
            &mut self.corners,
            CLOSE * guide.route.length() / ratio(params.points + 1, 1),
        );
        let inner = match params.obstacles {
            Obstacles::Hinge => params.points.max(2 * self.corners.len()),
            // The paper's loss depends on their number.
            Obstacles::Potential => params.points,
        };
        lay(&self.corners, inner, &mut self.laid);
        let mut job = Job {
            problem,
            params,
            potential,
            distance: guide.distance,
        };
        let mut origin = None;
        if warm && !self.last.is_empty() {
            origin = self.keep_on(&mut job, cx);
        }
        if origin.is_none() && !cx.stopped() {
            self.path.clone_from(&self.laid);
            let steps = self.improve(&mut job, true, cx);
            origin = steps.map(|_| Origin::Afresh);
        }
        let path = if origin.is_some() {
            points(&self.path).collect()
        } else {
            cx.note("fallback", "the exact shortest path: no smooth one passed");
            flattened(problem, &guide)
        };
        let origin = origin.unwrap_or(Origin::Afresh);
        self.reclaim(guide);
        let finished = !cx.stopped();
        self.close(problem, path, origin, finished, cx)
    }

    /// Gives the memory of a guide back for the next one.
    fn reclaim(&mut self, guide: Guide) {
        let graph = if guide.wide {
            &mut self.wide
        } else {
            &mut self.narrow
        };
        graph.reclaim(guide.route);
    }

    /// The exact shortest path, at the asked clearance if one has it.
    fn guide(
        &mut self,
        problem: &WorldProblem,
        clearance: f64,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Result<Guide, Outcome<WorldProblem>> {
        let distance = problem.radius() + clearance;
        if clearance > 0.0 && distance.is_finite() {
            let grown = with_radius(problem, distance);
            match grown.map(|grown| self.wide.shortest(&grown, cx)) {
                Some(Answer::Route(route)) => {
                    let wide = true;
                    return Ok(Guide {
                        route,
                        distance,
                        wide,
                    });
                }
                Some(Answer::Cut) => return Err(Outcome::Unknown { attempt: None }),
                Some(Answer::Nothing) | None => {}
            }
        }
        match self.narrow.shortest(problem, cx) {
            Answer::Route(route) => {
                if clearance > 0.0 {
                    cx.note("asked clearance", format_args!("no path has {clearance}"));
                }
                let distance = problem.radius();
                let wide = false;
                Ok(Guide {
                    route,
                    distance,
                    wide,
                })
            }
            Answer::Nothing => Err(Outcome::Infeasible),
            Answer::Cut => Err(Outcome::Unknown { attempt: None }),
        }
    }

    /// Whether the loss of what is laid out is less than that of `path`.
    fn prefers_laid(&mut self, job: &Job<'_>) -> bool {
        let (path, laid) = (
            std::mem::take(&mut self.path),
            std::mem::take(&mut self.laid),
        );
        let prefers = self.loss(&laid, job) < self.loss(&path, job);
        (self.path, self.laid) = (path, laid);
        prefers
    }

    /// The loss by which two paths are compared.
    fn loss(&mut self, path: &[f64], job: &Job<'_>) -> f64 {
        match job.params.obstacles {
            Obstacles::Potential => {
                let lambda = job.params.lambda_obs;
                self.newton.loss(
                    &mut Weighted {
                        potential: job.potential,
                        lambda,
                    },
                    path,
                )
            }
            Obstacles::Hinge => {
                self.set_up_hinge(path, job, WEIGHT);
                self.newton.loss(&mut self.hinge, path)
            }
        }
    }

    fn set_up_hinge(&mut self, path: &[f64], job: &Job<'_>, weight: f64) {
        let step = length(path) / ratio(path.len() / 2 - 1, 1);
        let asked = job.problem.radius() + job.params.clearance;
        self.hinge.distance = asked + SPARE * step;
        self.hinge.weight = weight;
        self.hinge.begin(0.5 * step);
    }

    /// Minimises from `path`, in its place, with ever more weight on the obstacles until the judge
    /// is content; says in how many steps. `None` if it never is.
    fn improve(
        &mut self,
        job: &mut Job<'_>,
        cold: bool,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Option<u64> {
        let step = length(&self.path) / ratio(self.path.len() / 2 - 1, 1);
        let limits = Limits {
            iterations: job.params.iterations,
            cap: if cold { 0.5 * step } else { step },
            worth: WORTH,
        };
        let mut steps = 0;
        if job.params.obstacles == Obstacles::Potential {
            let mut lambda = job.params.lambda_obs;
            for _ in 0..=RAISES {
                let mut loss = Weighted {
                    potential: job.potential,
                    lambda,
                };
                let (taken, _) = self.newton.minimise(&mut loss, &mut self.path, limits, cx);
                steps += taken;
                if self.passes(job) {
                    return Some(steps);
                }
                lambda *= 2.0;
            }
        }
        let mut weight = WEIGHT;
        for _ in 0..=RAISES {
            if cx.stopped() {
                return None;
            }
            let path = std::mem::take(&mut self.path);
            self.set_up_hinge(&path, job, weight);
            self.path = path;
            let (taken, _) = self
                .newton
                .minimise(&mut self.hinge, &mut self.path, limits, cx);
            steps += taken;
            if self.passes(job) {
                return Some(steps);
            }
            weight *= GROWTH;
        }
        None
    }

    /// Whether the path, put back into the bounds where it is out of them by less than shows, keeps
    /// its distance.
    fn passes(&mut self, job: &Job<'_>) -> bool {
        let bounds = job.problem.world().bounds();
        let (min, max) = (bounds.min(), bounds.max());
        for p in self.path.chunks_exact_mut(2) {
            (p[0], p[1]) = (p[0].clamp(min.x, max.x), p[1].clamp(min.y, max.y));
        }
        job.passes(&self.path)
    }

    /// Hands out a path, and remembers it.
    fn close(
        &mut self,
        problem: &WorldProblem,
        path: Vec<Point>,
        origin: Origin,
        finished: bool,
        cx: &mut Context<'_, WorldProblem>,
    ) -> Report<WorldProblem> {
        self.finished = finished;
        self.last.clear();
        self.last.extend(path.iter().flat_map(|p| [p.x, p.y]));
        cx.note("replanned", origin.word());
        cx.note(
            "clearance",
            format_args!("{:.4}", clearance(problem, &path)),
        );
        let report = cx.answer(problem, path, Proof::None);
        if report.outcome.solved().is_none() {
            self.last.clear();
        }
        report
    }
}

impl Origin {
    fn word(self) -> &'static str {
        match self {
            Self::Kept => "kept",
            Self::Repaired => "repaired",
            Self::Afresh => "afresh",
        }
    }
}

/// One question.
struct Job<'a> {
    problem: &'a WorldProblem,
    params: &'a LbfgsParams,
    potential: &'a Potential,
    /// How far a path must keep from everything.
    distance: f64,
}

impl Job<'_> {
    fn passes(&self, path: &[f64]) -> bool {
        let world = self.problem.world();
        let point = |k: usize| Point::new(path[k], path[k + 1]);
        path.iter().all(|v| v.is_finite())
            && (0..path.len() - 2).step_by(2).all(|k| {
                let segment = pf_geom::Segment::new(point(k), point(k + 2));
                world.is_free(&segment, self.distance)
            })
    }
}

/// The same question for a robot of another radius; `None` if there is no such robot.
fn with_radius(problem: &WorldProblem, radius: f64) -> Option<WorldProblem> {
    WorldProblem::new(
        problem.shared_world(),
        radius,
        problem.start(),
        problem.goal(),
    )
    .ok()
}

/// How far a path stays from everything, less the robot's radius.
fn clearance(problem: &WorldProblem, path: &[Point]) -> f64 {
    let segments = path.windows(2).map(|w| pf_geom::Segment::new(w[0], w[1]));
    let nearest = segments.map(|segment| problem.world().clearance(&segment));
    nearest.fold(f64::INFINITY, f64::min) - problem.radius()
}

/// The exact path as a polyline that keeps its distance: where a piece outside an arc would touch
/// something else, the pieces are made smaller.
fn flattened(problem: &WorldProblem, guide: &Guide) -> Vec<Point> {
    let grown = with_radius(problem, guide.distance);
    let judge = grown.as_ref().unwrap_or(problem);
    let first = EXCESS * guide.route.length().max(f64::MIN_POSITIVE);
    let mut excess = first;
    loop {
        let path = guide.route.flattened(excess);
        if excess < first * 1e-9 || judge.judge(&path).is_ok() {
            return path;
        }
        excess /= 8.0;
    }
}
