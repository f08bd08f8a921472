//! `bench worlds`: kernels, shortest paths among shapes, and changes of large worlds.

mod changes;
mod kernels;
mod paths;

use crate::{
    cases::unknown,
    protocol::{Row, Tally, json, say},
};
use anyhow::{Result, bail};
use pf_core::PlanRng;
use pf_geom::{Circle, Point, Polygon, Rectangle, Shape, Vector};
use rand::RngExt;
use std::cell::RefCell;

#[derive(clap::Args)]
pub(crate) struct Args {
    /// How many worlds of each size
    #[arg(long, default_value_t = 10)]
    worlds: u32,
    /// How many queries a world
    #[arg(long, default_value_t = 100)]
    queries: u32,
    /// Seed of worlds and queries
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Only cases whose name contains this
    #[arg(long, default_value = "")]
    case: String,
    /// One JSON object a line
    #[arg(long)]
    json: bool,
    /// The names of all cases that were come by.
    #[arg(skip)]
    known: RefCell<Vec<String>>,
}

impl Args {
    fn wants(&self, case: &str) -> bool {
        self.known.borrow_mut().push(case.to_owned());
        case.contains(&self.case)
    }

    /// Refuses a part that was in no name.
    fn check(&self) -> Result<()> {
        let mut known = self.known.take();
        if !known.iter().any(|case| case.contains(&self.case)) {
            known.dedup();
            let names = known.iter().map(String::as_str);
            bail!("{}", unknown("--case", &self.case, "case", names));
        }
        Ok(())
    }
}

/// The rows of one case, ours first, and what the first must not exceed in the others' times.
struct Case {
    rows: Vec<Row>,
    target: Option<f64>,
}

impl Case {
    fn of(name: &str, contenders: &[(&str, Tally)], target: Option<f64>) -> Self {
        let row = |(planner, tally): &(&str, Tally)| Row {
            suite: "worlds",
            ..tally.row(name, planner)
        };
        Self {
            rows: contenders.iter().map(row).collect(),
            target,
        }
    }
}

pub(crate) fn run(args: &Args) -> Result<()> {
    if !args.json {
        say(format_args!(
            "{:<28} {:<28} {:>8} {:>10} {:>10} {:>10} {:>7} {:>7} {:>10}",
            "case",
            "what",
            "queries",
            "mean us",
            "median us",
            "p95 us",
            "ratio",
            "target",
            "mismatches"
        ))?;
    }
    let mut mismatches = 0;
    let mut tell = |case: Case| -> Result<()> {
        for (k, row) in case.rows.iter().enumerate() {
            mismatches += row.mismatches;
            if args.json {
                json(row)?;
                continue;
            }
            // What ours takes of each other's time.
            let ratio = (k > 0).then(|| case.rows[0].median_us / row.median_us);
            let show = |v: Option<f64>| v.map_or(String::new(), |v| format!("{v:.3}"));
            say(format_args!(
                "{:<28} {:<28} {:>8} {:>10.3} {:>10.3} {:>10.3} {:>7} {:>7} {:>10}",
                row.case,
                row.planner,
                row.queries,
                row.mean_us,
                row.median_us,
                row.p95_us,
                show(ratio),
                show(case.target.filter(|_| k > 0)),
                row.mismatches
            ))?;
        }
        Ok(())
    };
    kernels::run(args, &mut tell)?;
    paths::run(args, &mut tell)?;
    changes::run(args, &mut tell)?;
    args.check()?;
    if mismatches > 0 {
        bail!("{mismatches} answers do not agree");
    }
    Ok(())
}

/// The square in which `count` shapes lie at a spacing of 10.
pub(crate) fn square(count: u32) -> Rectangle {
    let side = 10.0 * f64::from(count).sqrt();
    let corner = Point::new(side, side);
    Rectangle::new(Point::origin(), corner).unwrap_or_else(|_| unreachable!("it has a size"))
}

fn anywhere(rng: &mut PlanRng, bounds: &Rectangle) -> Point {
    let (min, max) = (bounds.min(), bounds.max());
    Point::new(
        rng.random_range(min.x..max.x),
        rng.random_range(min.y..max.y),
    )
}

/// A shape within a circle: a rectangle or a convex polygon, and if asked for also a circle.
fn shape_in(rng: &mut PlanRng, centre: Point, radius: f64, round: bool) -> Shape {
    loop {
        let on = |angle: f64| centre + Vector::new(angle.cos(), angle.sin()) * radius;
        let shape = match rng.random_range(0..if round { 3 } else { 2 }) {
            0 => {
                let to = on(rng.random_range(0.3..1.3)) - centre;
                Rectangle::new(centre - to, centre + to).map(Shape::from)
            }
            1 => {
                let n = rng.random_range(3..=8u32);
                let step = std::f64::consts::TAU / f64::from(n);
                let first = rng.random_range(0.0..step);
                let corners = (0..n)
                    .map(|k| on(first + step * (f64::from(k) + rng.random_range(0.0..0.8))))
                    .collect();
                Polygon::new(corners).map(Shape::from)
            }
            _ => Circle::new(centre, radius).map(Shape::from),
        };
        if let Ok(shape) = shape {
            return shape;
        }
    }
}

/// Shapes that keep apart, in the square of that many.
pub(crate) fn shapes(rng: &mut PlanRng, count: u32, round: bool) -> Vec<Shape> {
    let bounds = square(count);
    let mut circles: Vec<(Point, f64)> = Vec::new();
    while circles.len() < count as usize {
        let (centre, radius) = (anywhere(rng, &bounds), rng.random_range(1.0..5.0));
        let clear = |(other, r): &(Point, f64)| (centre - other).norm() > radius + r + 0.1;
        let (min, max) = (bounds.min(), bounds.max());
        let inside = (0..2).all(|k| min[k] + radius < centre[k] && centre[k] < max[k] - radius);
        if inside && circles.iter().all(clear) {
            circles.push((centre, radius));
        }
    }
    circles
        .into_iter()
        .map(|(centre, radius)| shape_in(rng, centre, radius, round))
        .collect()
}
