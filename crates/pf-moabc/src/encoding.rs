//! How a plan is a row of numbers: headings, one a step (Wang et al., eq. 7).
//!
//! Each robot goes steps of one length, each in a direction of its own; its path ends at the first
//! point within a step of the goal, and then goes straight to it. Whoever is not that near after the
//! last step is late. The rows of the robots follow one another.

use pf_core::PlanRng;
use pf_geom::{Mark, Point, TeamPlan, TeamProblem, TimedPoint, Vector};
use rand::RngExt;
use std::{f64::consts::PI, ops::Range};

/// How far headings may be from the straight way, in radians.
const BOUND: f64 = PI;

/// How many steps there are for the number that the straight way takes.
const SLACK: f64 = 1.2;

/// More steps than a robot ever needs.
const MOST_STEPS: f64 = 10_000.0;

/// Which number means what.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Encoding {
    step: f64,
    /// By robot: its numbers, and the direction of its goal.
    rows: Vec<(Range<usize>, f64)>,
}

/// Room for a decoded plan, kept from plan to plan.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    points: Vec<TimedPoint>,
    /// By robot: where its points end.
    ends: Vec<usize>,
}

impl Scratch {
    /// The points of a robot.
    fn path(&self, robot: usize) -> &[TimedPoint] {
        let from = match robot {
            0 => 0,
            robot => self.ends[robot - 1],
        };
        &self.points[from..self.ends[robot]]
    }

    /// What was decoded, as a plan.
    pub(crate) fn plan(&self) -> TeamPlan {
        let paths = (0..self.ends.len()).map(|robot| self.path(robot).to_vec());
        TeamPlan {
            paths: paths.collect(),
        }
    }
}

/// Where steps in these directions lead.
fn direction(headings: &[f64]) -> f64 {
    let (mut x, mut y) = (0.0, 0.0);
    for heading in headings {
        let (sin, cos) = libm::sincos(*heading);
        (x, y) = (x + cos, y + sin);
    }
    libm::atan2(y, x)
}

/// How rows begin.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Start {
    /// Anywhere within the bounds (eq. 2).
    Uniform,
    /// Along an arc of its own: from so far to one side at most to as far to the other, with as
    /// much noise.
    Fan(f64, f64),
}

impl Encoding {
    /// For a problem, with steps of a length; 0 for a twentieth of the longest straight way.
    pub(crate) fn of(problem: &TeamProblem, step: f64) -> Self {
        let ways = problem
            .robots()
            .iter()
            .map(|robot| robot.goal - robot.start);
        let longest = ways
            .clone()
            .fold(0.0, |longest: f64, way| longest.max(way.norm()));
        let step = if step > 0.0 { step } else { longest / 20.0 };
        // So that a robot which is there already has a step to stand on.
        let step = step.max(longest / MOST_STEPS).max(f64::MIN_POSITIVE);
        let mut begin = 0;
        let rows = ways.map(|way| {
            let count = (SLACK * way.norm() / step)
                .ceil()
                .clamp(1.0, SLACK * MOST_STEPS);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a number of steps"
            )]
            let row = begin..begin + count as usize;
            begin = row.end;
            (row, libm::atan2(way.y, way.x))
        });
        Self {
            rows: rows.collect(),
            step,
        }
    }

    /// How many numbers a plan has.
    pub(crate) fn width(&self) -> usize {
        self.rows.last().map_or(0, |(row, _)| row.end)
    }

    /// How many robots there are.
    pub(crate) fn robots(&self) -> usize {
        self.rows.len()
    }

    /// Puts numbers within their bounds.
    pub(crate) fn clamp(&self, genes: &mut [f64]) {
        for (row, bearing) in &self.rows {
            for gene in &mut genes[row.clone()] {
                *gene = gene.clamp(bearing - BOUND, bearing + BOUND);
            }
        }
    }

    /// How far apart the bounds are.
    pub(crate) fn range() -> f64 {
        2.0 * BOUND
    }

    /// The least that each number may be.
    pub(crate) fn least(&self, k: usize) -> f64 {
        let of = self.rows.iter().find(|(row, _)| row.contains(&k));
        of.map_or(-BOUND, |(_, bearing)| bearing - BOUND)
    }

    /// A row to begin with.
    pub(crate) fn draw(&self, start: Start, rng: &mut PlanRng, genes: &mut [f64]) {
        for robot in 0..self.rows.len() {
            self.draw_robot(robot, start, rng, genes);
        }
        self.clamp(genes);
    }

    fn draw_robot(&self, robot: usize, start: Start, rng: &mut PlanRng, genes: &mut [f64]) {
        let (row, bearing) = &self.rows[robot];
        let genes = &mut genes[row.clone()];
        match start {
            Start::Uniform => {
                for gene in genes {
                    *gene = bearing + rng.random_range(-BOUND..=BOUND);
                }
            }
            Start::Fan(opening, noise) => {
                let (open, noise) = (rng.random_range(-opening..=opening), noise);
                #[expect(clippy::cast_precision_loss, reason = "numbers of steps")]
                let (last, number) = ((genes.len().max(2) - 1) as f64, |j: usize| j as f64);
                for (j, gene) in genes.iter_mut().enumerate() {
                    let across = open * (1.0 - 2.0 * number(j) / last);
                    *gene = bearing + across + rng.random_range(-noise..=noise);
                }
            }
        }
    }

    /// Takes back what was changed but for one robot.
    pub(crate) fn keep_one(&self, rng: &mut PlanRng, before: &[f64], genes: &mut [f64]) {
        let (kept, _) = &self.rows[rng.random_range(0..self.rows.len())];
        genes[..kept.start].copy_from_slice(&before[..kept.start]);
        genes[kept.end..].copy_from_slice(&before[kept.end..]);
    }

    /// Makes a stretch of one robot's way straighter and its curve more even, in part or wholly; the
    /// stretch leads in the same direction as before.
    pub(crate) fn straighten(&self, rng: &mut PlanRng, genes: &mut [f64]) {
        let (row, _) = &self.rows[rng.random_range(0..self.rows.len())];
        if row.len() < 3 {
            return;
        }
        let (a, b) = (rng.random_range(row.clone()), rng.random_range(row.clone()));
        let stretch = &mut genes[a.min(b)..=a.max(b)];
        let weight = rng.random::<f64>();
        let before = direction(stretch);
        #[expect(clippy::cast_precision_loss, reason = "numbers of steps")]
        let last = (stretch.len() - 1).max(1) as f64;
        let (first, end) = (stretch[0], stretch[stretch.len() - 1]);
        for (j, gene) in stretch.iter_mut().enumerate() {
            #[expect(clippy::cast_precision_loss, reason = "numbers of steps")]
            let even = first + (end - first) * (j as f64 / last);
            *gene += weight * (even - *gene);
        }
        let turned = before - direction(stretch);
        let turned = libm::remainder(turned, 2.0 * PI);
        for gene in stretch {
            *gene += turned;
        }
    }

    /// Takes over from another encoding what still fits: robot `i` was `origin[i]` there.
    pub(crate) fn take_over(
        &self,
        before: &Self,
        origin: &[Option<usize>],
        old: &[f64],
        start: Start,
        rng: &mut PlanRng,
        genes: &mut [f64],
    ) {
        for (robot, origin) in origin.iter().enumerate() {
            self.draw_robot(robot, start, rng, genes);
            let Some((kept, _)) = origin.and_then(|robot| before.rows.get(robot)) else {
                continue;
            };
            let (row, bearing) = &self.rows[robot];
            let kept = &old[kept.clone()];
            for (j, gene) in genes[row.clone()].iter_mut().enumerate() {
                *gene = kept.get(j).copied().unwrap_or(*bearing);
            }
        }
        self.clamp(genes);
    }

    /// Turns numbers into paths; says how far robots are from being in time, summed.
    fn decode(&self, problem: &TeamProblem, genes: &[f64], scratch: &mut Scratch) -> f64 {
        scratch.points.clear();
        scratch.ends.clear();
        let mut late = 0.0;
        for ((row, _), robot) in self.rows.iter().zip(problem.robots()) {
            let (mut at, mut time) = (robot.start, 0.0);
            let pause = self.step / robot.speed;
            scratch.points.push(TimedPoint { at, time });
            let mut rest = (robot.goal - at).norm();
            for heading in &genes[row.clone()] {
                if rest <= self.step {
                    break;
                }
                let (sin, cos) = libm::sincos(*heading);
                at += Vector::new(cos, sin) * self.step;
                time += pause;
                scratch.points.push(TimedPoint { at, time });
                rest = (robot.goal - at).norm();
            }
            late += (rest - self.step).max(0.0);
            scratch.points.push(TimedPoint {
                at: robot.goal,
                time: time + rest / robot.speed,
            });
            scratch.ends.push(scratch.points.len());
        }
        late
    }

    /// What a row is worth. Allocates nothing once the scratch has grown.
    pub(crate) fn mark(&self, problem: &TeamProblem, genes: &[f64], scratch: &mut Scratch) -> Mark {
        let late = self.decode(problem, genes, scratch);
        let mut mark = problem.mark(|robot| scratch.path(robot));
        mark.excess += late;
        mark
    }

    /// The plan that a row is.
    pub(crate) fn plan(&self, problem: &TeamProblem, genes: &[f64]) -> TeamPlan {
        let mut scratch = Scratch::default();
        self.decode(problem, genes, &mut scratch);
        scratch.plan()
    }

    /// The places of all robots' steps, for a picture.
    pub(crate) fn points(&self, problem: &TeamProblem, genes: &[f64]) -> Vec<Point> {
        let plan = self.plan(problem, genes);
        plan.paths.iter().flatten().map(|p| p.at).collect()
    }
}
