//! Fronts of plans for teams: the objectives in pairs, a plan's paths, and where robots are when.

use crate::palette;
use pf_core::Front;
use pf_geom::{Objectives, Point, Shape, TeamPlan, TeamProblem};
use std::fmt::Write;

/// Colours of robots and of named members.
const COLOURS: [&str; 6] = palette::ROBOTS;
const NAMES: [&str; 3] = ["length", "danger", "turning, degrees"];
/// The pairs of objectives that are drawn: across and up.
const PAIRS: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];
const WIDTH: f64 = 1080.0;
const TOP: f64 = 44.0;
const PLOT: f64 = 300.0;
const MAP: f64 = 620.0;
const SNAP: f64 = 196.0;

/// A front, members of it that have names, and the first of these in detail.
#[derive(Clone, Debug)]
pub struct TeamSheet<'a> {
    /// What the plans are for.
    pub problem: &'a TeamProblem,
    /// The plans.
    pub plans: &'a Front<TeamPlan>,
    /// What they cost, in the same order.
    pub costs: &'a Front<Objectives>,
    /// Names of members, by place; the first is drawn in detail.
    pub named: &'a [(String, usize)],
    /// The heading.
    pub title: &'a str,
}

impl TeamSheet<'_> {
    /// The objectives in pairs above; below the paths of the first named plan, thinly those of the
    /// others, and where its robots are at six times.
    #[must_use]
    pub fn svg(&self) -> String {
        let height = TOP + PLOT + 50.0 + MAP + 20.0;
        let mut svg = format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" viewBox="0 0 {WIDTH} {height}" font-family="'DejaVu Sans',sans-serif" font-size="12" fill="#222"><rect width="100%" height="100%" fill="#fff"/><text x="20" y="26" font-size="16">{}</text>"##,
            escaped(self.title)
        );
        for (i, pair) in (0u32..).zip(PAIRS) {
            self.plot(&mut svg, 20.0 + 350.0 * f64::from(i), pair);
        }
        let top = TOP + PLOT + 50.0;
        self.paths(&mut svg, top);
        self.snapshots(&mut svg, top);
        svg.push_str("</svg>");
        svg
    }

    fn value(&self, member: usize, k: usize) -> f64 {
        let cost = self.costs.members()[member];
        if k == 2 {
            cost[2].to_degrees()
        } else {
            cost[k]
        }
    }

    /// All members by two objectives; those with names in colour.
    fn plot(&self, svg: &mut String, left: f64, (x, y): (usize, usize)) {
        let (width, height) = (PLOT - 60.0 + 30.0, PLOT - 60.0);
        let (left, bottom) = (left + 50.0, TOP + 10.0 + height);
        let count = self.costs.members().len();
        let range = |k: usize| {
            let values = (0..count).map(|i| self.value(i, k));
            let low = values.clone().fold(f64::INFINITY, f64::min);
            let high = values.fold(f64::NEG_INFINITY, f64::max);
            let room = ((high - low) * 0.04).max(1e-3);
            (low - room, high + room)
        };
        let (across, up) = (range(x), range(y));
        let place = |i: usize| {
            let share = |k: usize, (low, high): (f64, f64)| (self.value(i, k) - low) / (high - low);
            (
                left + width * share(x, across),
                bottom - height * share(y, up),
            )
        };
        let _ = write!(
            svg,
            r##"<rect x="{left}" y="{}" width="{width}" height="{height}" fill="none" stroke="#999"/><text x="{}" y="{}" text-anchor="middle">{}</text><text transform="translate({} {}) rotate(-90)" text-anchor="middle">{}</text>"##,
            bottom - height,
            left + width / 2.0,
            bottom + 30.0,
            NAMES[x],
            left - 36.0,
            bottom - height / 2.0,
            NAMES[y]
        );
        for (share, anchor) in [(0.0, "start"), (1.0, "end")] {
            let value = |(low, high): (f64, f64)| low + (high - low) * share;
            let _ = write!(
                svg,
                r#"<text x="{:.1}" y="{}" text-anchor="{anchor}" font-size="10">{:.1}</text><text x="{}" y="{:.1}" text-anchor="end" font-size="10">{:.1}</text>"#,
                left + width * share,
                bottom + 14.0,
                value(across),
                left - 4.0,
                bottom - (height - 8.0) * share,
                value(up)
            );
        }
        for i in 0..count {
            let (px, py) = place(i);
            let _ = write!(
                svg,
                r##"<circle cx="{px:.1}" cy="{py:.1}" r="2" fill="#888"/>"##
            );
        }
        for (k, (name, member)) in self.named.iter().enumerate().rev() {
            let ((px, py), colour) = (place(*member), COLOURS[k % COLOURS.len()]);
            let (dx, anchor) = if px > left + width * 0.6 {
                (-8.0, "end")
            } else {
                (8.0, "start")
            };
            let size = if k == 0 { 6 } else { 4 };
            let _ = write!(
                svg,
                r##"<circle cx="{px:.1}" cy="{py:.1}" r="{size}" fill="{colour}" stroke="#fff"/><text x="{:.1}" y="{:.1}" fill="{colour}" text-anchor="{anchor}">{}</text>"##,
                px + dx,
                py - 5.0,
                escaped(name)
            );
        }
    }

    fn paths(&self, svg: &mut String, top: f64) {
        let Some((name, first)) = self.named.first() else {
            return;
        };
        let frame = Frame::of(self.problem, 20.0, top, MAP);
        frame.world(svg, self.problem);
        for (k, (_, member)) in self.named.iter().enumerate().skip(1) {
            let colour = COLOURS[k % COLOURS.len()];
            for path in &self.plans.members()[*member].paths {
                let points = path.iter().map(|p| p.at);
                frame.line(
                    svg,
                    points,
                    colour,
                    "stroke-width=\"1\" stroke-dasharray=\"4 3\"",
                );
            }
        }
        let plan = &self.plans.members()[*first];
        for (robot, path) in plan.paths.iter().enumerate() {
            let colour = COLOURS[robot % COLOURS.len()];
            frame.line(
                svg,
                path.iter().map(|p| p.at),
                colour,
                "stroke-width=\"2.5\"",
            );
            let ends = &self.problem.robots()[robot];
            frame.disc(svg, ends.start, ends.radius, &format!("fill=\"{colour}\""));
            let goal = format!("fill=\"#fff\" stroke=\"{colour}\" stroke-width=\"2\"");
            frame.disc(svg, ends.goal, ends.radius, &goal);
            let (x, y) = frame.place(ends.start);
            let _ = write!(
                svg,
                r#"<text x="{:.1}" y="{:.1}">{robot}</text>"#,
                x + 7.0,
                y - 7.0
            );
        }
        let others: Vec<_> = self.named[1..]
            .iter()
            .map(|(name, _)| name.as_str())
            .collect();
        let dashed = if others.is_empty() {
            String::new()
        } else {
            format!("; dashed: {}", others.join(", "))
        };
        let words =
            format!("{name}: robots by number from their starts (full) to their goals{dashed}");
        let _ = write!(
            svg,
            r#"<text x="20" y="{}">{}</text>"#,
            top - 8.0,
            escaped(&words)
        );
    }

    fn snapshots(&self, svg: &mut String, top: f64) {
        let Some((_, first)) = self.named.first() else {
            return;
        };
        let plan = &self.plans.members()[*first];
        let duration = plan.duration();
        for (i, share) in (0u32..).zip([0.0, 0.2, 0.4, 0.6, 0.8, 1.0]) {
            let (column, row) = (f64::from(i % 2), f64::from(i / 2));
            let (left, above) = (
                MAP + 44.0 + column * (SNAP + 12.0),
                top + row * (SNAP + 16.0),
            );
            let frame = Frame::of(self.problem, left, above, SNAP);
            frame.world(svg, self.problem);
            let time = duration * share;
            for (robot, at) in plan.positions(time).into_iter().enumerate() {
                let colour = COLOURS[robot % COLOURS.len()];
                let path = &plan.paths[robot];
                let been = path.iter().take_while(|p| p.time < time).map(|p| p.at);
                frame.line(svg, been.chain([at]), colour, "stroke-width=\"1\"");
                let radius = self.problem.robots()[robot].radius;
                frame.disc(svg, at, radius, &format!("fill=\"{colour}\""));
            }
            let _ = write!(
                svg,
                r#"<text x="{left}" y="{}" font-size="10">{time:.1} s</text>"#,
                above - 3.0
            );
        }
    }
}

/// Where the world is on the sheet.
struct Frame {
    min: Point,
    scale: f64,
    left: f64,
    bottom: f64,
    size: (f64, f64),
}

impl Frame {
    fn of(problem: &TeamProblem, left: f64, top: f64, side: f64) -> Self {
        let bounds = problem.world().bounds();
        let extent = bounds.max() - bounds.min();
        let scale = side / extent.x.max(extent.y);
        let drawn = (extent.x * scale, extent.y * scale);
        Self {
            min: bounds.min(),
            scale,
            left,
            bottom: top + drawn.1,
            size: drawn,
        }
    }

    fn place(&self, p: Point) -> (f64, f64) {
        let offset = (p - self.min) * self.scale;
        (self.left + offset.x, self.bottom - offset.y)
    }

    fn world(&self, svg: &mut String, problem: &TeamProblem) {
        let (width, height) = self.size;
        let _ = write!(
            svg,
            r##"<rect x="{:.1}" y="{:.1}" width="{width:.1}" height="{height:.1}" fill="#fafafa" stroke="#999"/>"##,
            self.left,
            self.bottom - height
        );
        for (_, shape) in problem.world().shapes() {
            match shape {
                Shape::Circle(c) => {
                    let ((x, y), r) = (self.place(c.centre()), c.radius() * self.scale);
                    let _ = write!(
                        svg,
                        r##"<circle cx="{x:.1}" cy="{y:.1}" r="{r:.1}" fill="#555"/>"##
                    );
                }
                Shape::Rectangle(r) => self.polygon(svg, &r.corners()),
                Shape::Polygon(p) => self.polygon(svg, p.corners()),
            }
        }
    }

    fn polygon(&self, svg: &mut String, corners: &[Point]) {
        let points = corners.iter().map(|p| self.place(*p));
        let points: Vec<_> = points.map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        let _ = write!(
            svg,
            r##"<polygon points="{}" fill="#555"/>"##,
            points.join(" ")
        );
    }

    fn line(&self, svg: &mut String, points: impl Iterator<Item = Point>, colour: &str, how: &str) {
        let points = points.map(|p| self.place(p));
        let points: Vec<_> = points.map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        let _ = write!(
            svg,
            r#"<polyline points="{}" fill="none" stroke="{colour}" {how}/>"#,
            points.join(" ")
        );
    }

    fn disc(&self, svg: &mut String, at: Point, radius: f64, how: &str) {
        let ((x, y), r) = (self.place(at), (radius * self.scale).max(3.5));
        let _ = write!(svg, r#"<circle cx="{x:.1}" cy="{y:.1}" r="{r:.1}" {how}/>"#);
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
