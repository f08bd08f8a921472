//! What a window shows, and that it shows nothing else.

#![expect(clippy::unwrap_used, reason = "tests")]
#![expect(clippy::many_single_char_names, reason = "points")]

use pf_core::{
    Budget, Context, LocalPlanner, Observable, PlanRng, Planner, Problem, Rollout, Step,
};
use pf_geom::{
    Circle, Observation, Point, Polygon, Rectangle, Segment, Shape, Vector, Window, World,
    WorldProblem,
};
use rand::{RngExt, SeedableRng};

fn point(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

fn rectangle(a: (f64, f64), b: (f64, f64)) -> Shape {
    Rectangle::new(point(a.0, a.1), point(b.0, b.1))
        .unwrap()
        .into()
}

fn polygon(corners: &[(f64, f64)]) -> Shape {
    let corners = corners.iter().map(|&(x, y)| point(x, y)).collect();
    Polygon::new(corners).unwrap().into()
}

fn problem(shapes: impl IntoIterator<Item = Shape>, radius: f64) -> WorldProblem {
    let bounds = Rectangle::new(point(-8.0, -8.0), point(8.0, 8.0)).unwrap();
    let world = World::with_shapes(bounds, shapes);
    WorldProblem::new(world, radius, Point::origin(), point(7.0, 7.0)).unwrap()
}

fn seen(problem: &WorldProblem, at: Point, half: f64) -> Observation {
    let mut seen = Observation::default();
    problem.observe(&at, &Window::new(half).unwrap(), &mut seen);
    seen
}

#[test]
fn it_shows_place_goal_and_limits() {
    let p = problem([], 0.5);
    let at = seen(&p, point(7.0, 0.0), 2.0);
    assert_eq!(
        (at.here(), at.goal(), at.radius()),
        (point(7.0, 0.0), p.goal(), 0.5)
    );
    assert_eq!(at.window(), (point(5.0, -2.0), point(8.5, 2.0)));
    assert_eq!(at.room(), (point(5.5, -1.5), point(8.0, 1.5)));
    assert!(!at.shows_goal() && seen(&p, point(6.0, 6.0), 2.0).shows_goal());
    assert!(at.is_free(point(5.5, 0.0), point(8.0, 0.0)));
    assert!(!at.is_free(point(5.4, 0.0), point(8.0, 0.0)));
    for half in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Window::new(half).is_err());
    }
}

/// Worlds that differ outside the window of half size 2 about the origin, and only there.
#[test]
fn worlds_that_agree_within_the_window_look_the_same() {
    let disc = |x, y, r| Shape::from(Circle::new(point(x, y), r).unwrap());
    let pairs: Vec<(Vec<Shape>, Vec<Shape>)> = vec![
        // Something far away, before and after, or touching from outside.
        (
            vec![rectangle((0.5, 0.5), (1.0, 1.0)), disc(-1.0, 0.0, 0.5)],
            vec![
                disc(6.0, 6.0, 1.0),
                disc(-1.0, 0.0, 0.5),
                rectangle((2.0, -1.0), (3.0, 1.0)),
                rectangle((0.5, 0.5), (1.0, 1.0)),
                disc(0.0, 4.0, 2.0),
                polygon(&[(-2.0, -1.0), (-3.0, 1.0), (-3.0, -1.0)]),
                polygon(&[(-1.0, -2.0), (-1.0, -3.0), (1.0, -3.0), (1.0, -2.0)]),
                disc(2.9, 2.9, 1.2),
            ],
        ),
        // A rectangle that goes on.
        (
            vec![rectangle((1.0, -0.5), (2.5, 0.5))],
            vec![rectangle((1.0, -0.5), (7.0, 0.5))],
        ),
        (
            vec![rectangle((1.0, -0.5), (2.0, 0.5))],
            vec![rectangle((1.0, -0.5), (2.5, 0.5))],
        ),
        // All is covered.
        (
            vec![rectangle((-3.0, -2.0), (2.0, 5.0))],
            vec![disc(0.5, 0.0, 6.0)],
        ),
        (
            vec![disc(0.0, 0.5, 6.0)],
            vec![polygon(&[
                (-3.0, -3.0),
                (7.0, -3.0),
                (7.0, 7.0),
                (-3.0, 7.0),
            ])],
        ),
        // A wedge whose sides go on, begun at another corner.
        (
            vec![polygon(&[(0.0, 0.0), (4.0, -4.0), (4.0, 4.0)])],
            vec![polygon(&[
                (5.0, 7.0),
                (3.0, 3.0),
                (0.0, 0.0),
                (8.0, -8.0),
                (8.0, 7.0),
            ])],
        ),
        // Two prongs of one fork, or two bars.
        (
            vec![polygon(&[
                (0.0, -1.0),
                (4.0, -1.0),
                (4.0, 1.0),
                (0.0, 1.0),
                (0.0, 0.5),
                (3.0, 0.5),
                (3.0, -0.5),
                (0.0, -0.5),
            ])],
            vec![
                polygon(&[(0.0, 0.5), (5.0, 0.5), (5.0, 1.0), (0.0, 1.0)]),
                polygon(&[(0.0, -1.0), (6.0, -1.0), (6.0, -0.5), (0.0, -0.5)]),
            ],
        ),
        // A corner of the window is inside, and the rest goes round outside.
        (
            vec![polygon(&[(0.5, 3.0), (3.0, 0.5), (3.0, 3.0)])],
            vec![polygon(&[
                (0.5, 3.0),
                (3.0, 0.5),
                (5.0, -1.5),
                (5.0, 5.0),
                (0.5, 5.0),
            ])],
        ),
    ];
    for (k, (one, other)) in pairs.into_iter().enumerate() {
        for radius in [0.0, 0.25] {
            let [a, b] = [&one, &other].map(|shapes| {
                seen(
                    &problem(shapes.iter().cloned(), radius),
                    Point::origin(),
                    2.0,
                )
            });
            assert_eq!(a, b, "pair {k}");
            // And nothing is lost: what is there can be entered.
            assert!(!a.shapes().is_empty(), "pair {k}");
        }
    }
}

fn random_shape(rng: &mut PlanRng) -> Shape {
    loop {
        let at = point(rng.random_range(-5.0..5.0), rng.random_range(-5.0..5.0));
        let mut near = || {
            let reach = [1.0, 6.0][usize::from(rng.random_range(0..3u32) == 0)];
            let by = Vector::new(rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
            at + by * reach
        };
        let (p, q) = (near(), near());
        let more = [near(), near(), near(), near()];
        let shape = match rng.random_range(0..4) {
            0 => Circle::new(p, (p - q).norm()).map(Shape::from),
            1 => Rectangle::new(p.inf(&q), p.sup(&q)).map(Shape::from),
            n => {
                let corners = [&[p, q], &more[..2 * n - 3]].concat();
                Polygon::new(corners).map(Shape::from)
            }
        };
        if let Ok(shape) = shape {
            return shape;
        }
    }
}

/// Within the room, what is seen answers as the world does; a window's answers to another's
/// questions follow from the same shapes.
#[test]
fn what_is_seen_is_what_is_there() {
    let mut rng = PlanRng::seed_from_u64(1);
    let mut view = Observation::default();
    let (mut counts, mut hits) = ([0u32; 2], [0u32; 2]);
    for round in 0..1_500 {
        let count = rng.random_range(0..8);
        let shapes: Vec<Shape> = (0..count).map(|_| random_shape(&mut rng)).collect();
        let radius = [0.0, 0.3][round % 2];
        let p = problem(shapes.clone(), radius);
        let side = |rng: &mut PlanRng| [rng.random_range(-8.0..8.0), 8.0, -8.0][round % 3];
        let at = point(side(&mut rng), rng.random_range(-8.0..8.0));
        let half = rng.random_range(0.5..4.0);
        p.observe(&at, &Window::new(half).unwrap(), &mut view);
        let (low, high) = view.room();
        if low.x > high.x || low.y > high.y {
            continue;
        }
        // Places in the room, often on its border.
        let mut place = || {
            let mut place = Point::origin();
            for k in 0..2 {
                place[k] = match rng.random_range(0..4) {
                    0 => low[k],
                    1 => high[k],
                    _ => rng.random_range(low[k]..=high[k]),
                };
            }
            place
        };
        for _ in 0..30 {
            let (a, b) = (place(), place());
            let free = p.is_free(a, b);
            counts[usize::from(free)] += 1;
            assert_eq!(view.is_free(a, b), free, "{a} {b} {shapes:?} {view:?}");
            // Rays are the world's as far as the window reaches.
            let way = Segment::new(a, b);
            let direct = p.world().cast_ray(a, b - a, way.length());
            let (ours, theirs) = (view.ray(a, b - a, way.length()), direct.ok().flatten());
            hits[usize::from(ours.is_some())] += 1;
            let grazes = p.world().clearance(&way) > 0.0 || free;
            match (ours, theirs) {
                (Some(x), Some((y, _))) => assert!((x - y).abs() < 1e-6, "{x} {y}"),
                (None, None) => {}
                _ => assert!(grazes, "{ours:?} {theirs:?} {a} {b} {shapes:?}"),
            }
        }
    }
    assert!(
        counts.iter().chain(&hits).all(|&n| n > 2_000),
        "{counts:?} {hits:?}"
    );
}

/// What is moved, added or removed beyond the window changes nothing in it.
#[test]
fn changes_out_of_sight_are_out_of_mind() {
    let mut rng = PlanRng::seed_from_u64(2);
    for _ in 0..500 {
        let shapes: Vec<Shape> = (0..12).map(|_| random_shape(&mut rng)).collect();
        let p = problem(shapes.clone(), 0.2);
        let view = seen(&p, Point::origin(), 2.0);
        let (min, max) = view.window();
        let unseen = |s: &Shape| {
            let (low, high) = s.bounding_box();
            (0..2).any(|k| high[k] <= min[k] || max[k] <= low[k])
        };
        // In another order, with others far away, drawn out where they go on.
        let mut others: Vec<Shape> = shapes.into_iter().filter(|s| !unseen(s)).collect();
        for shape in &mut others {
            if let Shape::Rectangle(r) = shape {
                let (mut low, mut high) = (r.min(), r.max());
                for k in 0..2 {
                    low[k] -= if low[k] <= min[k] { 1.5 } else { 0.0 };
                    high[k] += if high[k] >= max[k] { 0.5 } else { 0.0 };
                }
                *shape = Rectangle::new(low, high).unwrap().into();
            }
        }
        others.reverse();
        while others.len() < 15 {
            let shape = random_shape(&mut rng);
            if unseen(&shape) {
                others.insert(rng.random_range(0..=others.len()), shape);
            }
        }
        assert_eq!(seen(&problem(others, 0.2), Point::origin(), 2.0), view);
    }
}

#[test]
fn rays_reach_to_the_window_and_no_further() {
    let p = problem(
        [
            rectangle((1.0, -1.0), (7.0, 1.0)),
            rectangle((-1.0, 3.0), (1.0, 4.0)),
        ],
        0.0,
    );
    let view = seen(&p, Point::origin(), 2.0);
    let rays = view.axis_rays(Point::origin(), 2.0);
    assert_eq!(rays, [Some(1.0), None, None, None]);
    assert_eq!(view.axis_rays(Point::origin(), 0.5), [None; 4]);
    assert_eq!(view.ray(point(0.0, 1.5), Vector::y(), 4.0), None);
    assert_eq!(view.ray(point(1.5, 0.0), Vector::y(), 4.0), Some(0.0));
    assert_eq!(view.ray(Point::origin(), Vector::zeros(), 4.0), None);
    assert_eq!(view.entered(Point::origin(), point(1.5, 0.0)), 1);
    assert_eq!(view.entered(Point::origin(), point(-1.5, 0.0)), 0);
}

/// Goes straight for the goal as far as it sees, or a quarter turn aside.
struct Straight;

impl LocalPlanner<WorldProblem> for Straight {
    fn name(&self) -> &'static str {
        "straight"
    }
    fn sensor(&self) -> Window {
        Window::new(2.0).unwrap()
    }
    fn reset(&mut self) {}
    fn step(&mut self, seen: &Observation, _: &mut Context<'_, WorldProblem>) -> Step<Point> {
        let here = seen.here();
        if seen.is_free(here, seen.goal()) {
            return Step::To(seen.goal());
        }
        let ahead = (seen.goal() - here).normalize();
        let aside = Vector::new(ahead.y, -ahead.x);
        let ways = [ahead, (ahead + aside).normalize(), aside];
        let next = ways.map(|way| here + way * 0.5);
        let free = next.into_iter().find(|&next| seen.is_free(here, next));
        free.map_or(Step::GiveUp, Step::To)
    }
}

#[test]
fn a_walk_arrives_and_the_judge_agrees() {
    let p = problem([rectangle((2.0, 2.5), (3.0, 6.0))], 0.3);
    let mut cx = Context::seeded(0).within(Budget::unlimited().iterations(200));
    let report = Rollout(Straight).plan(&p, &mut cx).unwrap();
    let best = report.outcome.solved().unwrap();
    assert!((p.judge(&best.solution).unwrap() - best.cost).abs() < 1e-9);
    assert!(best.cost > 7.0 * 2f64.sqrt());
}
