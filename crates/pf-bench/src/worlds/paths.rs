//! Shortest paths of a point, beside polyanya on a mesh of the same world.

use super::{Args, Case, anywhere, shapes, square};
use crate::protocol::{REPETITIONS, Tally, timed};
use anyhow::Result;
use glam::Vec2;
use pf_classic::VisibilityGraph;
use pf_core::{Context, PlanRng, Planner, Problem, Replanner, Report};
use pf_geom::{Point, Rectangle, Shape, World, WorldChange, WorldProblem};
use polyanya::{Mesh, Triangulation};
use rand::{RngExt, SeedableRng};
use std::time::Duration;

pub(super) fn run(args: &Args, tell: &mut impl FnMut(Case) -> Result<()>) -> Result<()> {
    for (count, one_shot, moved) in [
        (10, Some(0.25), None),
        (50, None, None),
        (200, Some(0.6), Some(1.0)),
    ] {
        let mut rng = PlanRng::seed_from_u64(args.seed ^ u64::from(count));
        let worlds: Vec<Vec<Shape>> = (0..args.worlds)
            .map(|_| shapes(&mut rng, count, false))
            .collect();
        tell(fresh(args, &mut rng, &worlds, count, one_shot)?)?;
        for (name, step) in [("goal anywhere", f64::INFINITY), ("goal drifts by 2", 2.0)] {
            let name = format!("{count} shapes, {name}");
            tell(kept(args, &mut rng, &worlds, &name, step, moved)?)?;
        }
    }
    Ok(())
}

/// All from nothing but the shapes: our index and graph, their mesh.
fn fresh(
    args: &Args,
    rng: &mut PlanRng,
    worlds: &[Vec<Shape>],
    count: u32,
    target: Option<f64>,
) -> Result<Case> {
    let bounds = square(count);
    let mut tallies = [Tally::default(), Tally::default()];
    for shapes in worlds {
        let world = World::with_shapes(bounds, shapes.clone());
        for _ in 0..args.queries {
            let (start, goal) = (free_place(rng, &world), free_place(rng, &world));
            let mut least = [Duration::MAX; 2];
            let mut lengths = [None; 2];
            for _ in 0..REPETITIONS {
                let given = shapes.clone();
                let (time, length) = timed(|| {
                    let world = World::with_shapes(bounds, given);
                    let problem = WorldProblem::new(world, 0.0, start, goal).ok()?;
                    let mut planner = VisibilityGraph::default();
                    length(planner.plan(&problem, &mut Context::seeded(0)).ok()?)
                });
                (least[0], lengths[0]) = (least[0].min(time), length);
                let (time, length) = timed(|| query(&mesh(&bounds, shapes), start, goal));
                (least[1], lengths[1]) = (least[1].min(time), length);
            }
            add(&mut tallies, least, lengths);
        }
    }
    Ok(case(&format!("{count} shapes, one shot"), tallies, target))
}

/// The graph and the mesh are there; only the goal is another. A graph learns from what it was
/// asked, so a query is not asked of it twice: a repetition is the whole walk of the goal anew.
fn kept(
    args: &Args,
    rng: &mut PlanRng,
    worlds: &[Vec<Shape>],
    name: &str,
    step: f64,
    target: Option<f64>,
) -> Result<Case> {
    let mut tallies = [Tally::default(), Tally::default()];
    for shapes in worlds {
        let count = u32::try_from(shapes.len()).unwrap_or(u32::MAX);
        let world = World::with_shapes(square(count), shapes.clone());
        let mesh = mesh(world.bounds(), shapes);
        let start = free_place(rng, &world);
        let mut goals = vec![free_place(rng, &world)];
        while goals.len() <= args.queries as usize {
            let last = goals[goals.len() - 1];
            goals.push(place_within(rng, &world, last, step));
        }
        let mut least = vec![[Duration::MAX; 2]; goals.len()];
        let mut lengths = vec![[None; 2]; goals.len()];
        for _ in 0..REPETITIONS {
            let mut problem = WorldProblem::new(world.clone(), 0.0, start, goals[0])?;
            let mut planner = VisibilityGraph::default();
            planner.plan(&problem, &mut Context::seeded(0))?;
            for (k, &goal) in goals.iter().enumerate().skip(1) {
                let moved = [WorldChange::GoalMoved(goal)];
                let (time, found) = timed(|| {
                    let revision = problem.revise(&moved).ok()?;
                    let cx = &mut Context::seeded(0);
                    length(planner.replan(&revision, cx).ok()?)
                });
                (least[k][0], lengths[k][0]) = (least[k][0].min(time), found);
                let (time, found) = timed(|| query(&mesh, start, goal));
                (least[k][1], lengths[k][1]) = (least[k][1].min(time), found);
            }
        }
        for (least, lengths) in least.into_iter().zip(lengths).skip(1) {
            add(&mut tallies, least, lengths);
        }
    }
    Ok(case(name, tallies, target))
}

fn case(name: &str, [ours, theirs]: [Tally; 2], target: Option<f64>) -> Case {
    let contenders = [("visibility-graph", ours), ("polyanya::Mesh::path", theirs)];
    Case::of(name, &contenders, target)
}

fn add(tallies: &mut [Tally; 2], least: [Duration; 2], lengths: [Option<f64>; 2]) {
    for (tally, least) in tallies.iter_mut().zip(least) {
        tally.add(least);
    }
    let [ours, theirs] = lengths;
    let ours_is_right = match (ours, theirs) {
        // Polyanya counts in f32.
        (Some(a), Some(b)) => a <= b * (1.0 + 1e-4) + 1e-3,
        (a, b) => a.is_some() == b.is_some(),
    };
    let theirs_is_right = match (ours, theirs) {
        (Some(a), Some(b)) => b <= a * (1.0 + 1e-4) + 1e-3,
        _ => true,
    };
    tallies[0].mismatches += u64::from(!ours_is_right);
    tallies[1].mismatches += u64::from(!theirs_is_right);
}

fn length(report: Report<WorldProblem>) -> Option<f64> {
    report.outcome.solved().map(|best| best.cost)
}

fn free_place(rng: &mut PlanRng, world: &World) -> Point {
    loop {
        let p = anywhere(rng, world.bounds());
        // Off the borders, where f32 puts it on the other side.
        if world.clearance_at(p) > 0.01 {
            return p;
        }
    }
}

fn place_within(rng: &mut PlanRng, world: &World, of: Point, step: f64) -> Point {
    if step.is_infinite() {
        return free_place(rng, world);
    }
    loop {
        let mut by = || rng.random_range(-step..step);
        let p = of + pf_geom::Vector::new(by(), by());
        if world.bounds().contains(p) && world.clearance_at(p) > 0.01 {
            return p;
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "polyanya counts in f32")]
fn single(p: Point) -> Vec2 {
    Vec2::new(p.x as f32, p.y as f32)
}

fn mesh(bounds: &Rectangle, shapes: &[Shape]) -> Mesh {
    let mut triangulation = Triangulation::from_outer_edges(&bounds.corners().map(single));
    triangulation.add_obstacles(shapes.iter().map(|shape| -> Vec<Vec2> {
        match shape {
            Shape::Circle(_) => Vec::new(),
            Shape::Rectangle(r) => r.corners().map(single).to_vec(),
            Shape::Polygon(p) => p.corners().iter().map(|&c| single(c)).collect(),
        }
    }));
    triangulation.as_navmesh()
}

fn query(mesh: &Mesh, start: Point, goal: Point) -> Option<f64> {
    mesh.path(single(start), single(goal))
        .map(|path| f64::from(path.length))
}
