//! What is on top of cells.

use crate::{
    Line,
    page::{Page, short},
    palette,
    picture::Key,
    svg,
};
use std::fmt::Write;

/// What a thing stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// An attempt among many: an ant's way, a particle's path, an iterate.
    Try,
    /// The best so far.
    Best,
    /// The answer.
    Answer,
    /// The path before a change, or what is planned and not yet driven.
    Planned,
    /// A robot, or its way, in the colour of its number.
    Robot(usize),
    /// Bees, particles, members of a population.
    Swarm,
    /// Points of a world that a search has expanded.
    Reached,
    /// The range of a sensor.
    Sensor,
}

/// One thing in a frame, in the map's units.
#[derive(Clone, Debug, PartialEq)]
pub enum Thing {
    /// A line.
    Line {
        /// Its points.
        points: Vec<[f64; 2]>,
        /// What it is.
        look: Look,
    },
    /// Small dots, whatever the scale.
    Dots {
        /// Where.
        points: Vec<[f64; 2]>,
        /// What they are.
        look: Look,
    },
    /// A disc as large as said, but large enough to be seen.
    Disc {
        /// Its centre.
        at: [f64; 2],
        /// Its radius.
        radius: f64,
        /// What it is.
        look: Look,
    },
    /// A circle.
    Ring {
        /// Its centre.
        at: [f64; 2],
        /// Its radius.
        radius: f64,
        /// What it is.
        look: Look,
    },
    /// A square.
    Window {
        /// Its centre.
        at: [f64; 2],
        /// Half its side.
        half: f64,
        /// What it is.
        look: Look,
    },
    /// Where the way begins.
    Start([f64; 2]),
    /// Where it ends.
    Goal([f64; 2]),
    /// Where the way of a robot ends.
    GoalOf(usize, [f64; 2]),
}

impl Look {
    fn colour(self) -> &'static str {
        match self {
            Self::Try => palette::TRY,
            Self::Best | Self::Swarm => palette::PATHS[2],
            Self::Answer => palette::PATHS[0],
            Self::Planned => palette::DASHED,
            Self::Robot(k) => palette::ROBOTS[k % palette::ROBOTS.len()],
            Self::Reached => palette::HEAT[6],
            Self::Sensor => palette::GOAL,
        }
    }

    pub(crate) fn key(self) -> Key {
        match self {
            Self::Swarm | Self::Reached => Key::Dot(self.colour()),
            Self::Robot(_) => Key::Disc(self.colour()),
            Self::Sensor => Key::Window(self.colour()),
            Self::Planned => Key::Line(self.colour(), Line::Dashed),
            Self::Try => Key::Hair(self.colour()),
            Self::Best | Self::Answer => Key::Line(self.colour(), Line::Solid),
        }
    }
}

impl Thing {
    /// It on a page, from the map's upper left corner.
    pub(crate) fn svg(&self, page: &Page) -> String {
        let mut out = String::new();
        match self {
            Self::Line { points, look } => line(&mut out, page, points, *look),
            Self::Dots { points, look } => {
                let mut data = String::new();
                for &point in points {
                    let [x, y] = page.place(point).map(tenth);
                    let _ = write!(data, "M{x} {y}h0");
                }
                let (rim, width) = (short(page.pen + 3.0), short(page.pen + 1.5));
                let _ = write!(
                    out,
                    r##"<path fill="none" stroke="#fff" stroke-width="{rim}" stroke-linecap="round" d="{data}"/><path fill="none" stroke="{}" stroke-width="{width}" stroke-linecap="round" d="{data}"/>"##,
                    look.colour()
                );
            }
            Self::Disc { at, radius, look } => {
                let ([x, y], r) = (page.place(*at).map(tenth), page.length(*radius, 3.5));
                let _ = write!(
                    out,
                    r##"<circle cx="{x}" cy="{y}" r="{r}" fill="{}" stroke="#fff"/>"##,
                    look.colour()
                );
            }
            Self::Ring { at, radius, look } => {
                let ([x, y], r) = (page.place(*at).map(tenth), page.length(*radius, 3.5));
                let _ = write!(
                    out,
                    r#"<circle cx="{x}" cy="{y}" r="{r}" fill="none" stroke="{}"/>"#,
                    look.colour()
                );
            }
            Self::Window { at, half, look } => {
                let ([x, y], r) = (page.place(*at).map(tenth), page.length(*half, 3.5));
                let _ = write!(
                    out,
                    r#"<rect x="{}" y="{}" width="{2}" height="{2}" fill="{3}" fill-opacity=".12" stroke="{3}"/>"#,
                    tenth(x - r),
                    tenth(y - r),
                    tenth(2.0 * r),
                    look.colour()
                );
            }
            Self::Start(p) => svg::start(&mut out, page.place(*p), page.marker),
            Self::Goal(p) => svg::goal(&mut out, page.place(*p), page.marker, palette::GOAL),
            Self::GoalOf(k, p) => {
                let colour = Look::Robot(*k).colour();
                svg::goal(&mut out, page.place(*p), page.marker, colour);
            }
        }
        out
    }
}

/// Steps from point to point are shorter to write than points, and on a grid they are whole cells.
fn line(out: &mut String, page: &Page, points: &[[f64; 2]], look: Look) {
    let unit = if page.frame.cells { page.scale } else { 1.0 };
    let mut data = String::new();
    let mut last = [0, 0];
    for (k, &point) in points.iter().enumerate() {
        #[expect(clippy::cast_possible_truncation, reason = "casts of floats saturate")]
        let at = page.place(point).map(|x| (x / unit * 10.0).round() as i64);
        let step = [at[0] - last[0], at[1] - last[1]];
        if k > 0 && step == [0, 0] {
            continue;
        }
        data.push(if k == 0 { 'M' } else { 'l' });
        number(&mut data, step[0]);
        if step[1] >= 0 {
            data.push(' ');
        }
        number(&mut data, step[1]);
        last = at;
    }
    let (colour, pen) = (look.colour(), page.pen);
    let wide = |width: f64| short(width / unit);
    let (how, width) = match look {
        Look::Try => (" stroke-opacity=\".6\"".to_owned(), 1.0),
        Look::Planned => {
            let (dash, gap) = (wide(pen * 2.0), wide(pen * 1.5));
            (format!(" stroke-dasharray=\"{dash} {gap}\""), pen * 0.75)
        }
        Look::Robot(_) => (String::new(), pen * 0.6),
        _ => {
            let rim = wide(pen + 2.0);
            let _ = write!(
                out,
                "<path {} stroke=\"#fff\" stroke-opacity=\".8\" stroke-width=\"{rim}\" d=\"{data}\"/>",
                scaled(unit)
            );
            (String::new(), pen)
        }
    };
    let _ = write!(
        out,
        "<path {} stroke=\"{colour}\"{how} stroke-width=\"{}\" d=\"{data}\"/>",
        scaled(unit),
        wide(width)
    );
}

/// What lines in this unit have in common.
fn scaled(unit: f64) -> String {
    let scale = if (unit - 1.0).abs() < 1e-12 {
        String::new()
    } else {
        format!(" transform=\"scale({})\"", (unit * 1e4).round() / 1e4)
    };
    format!("fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\"{scale}")
}

/// Tenths, as a decimal number of as few letters as possible.
fn number(out: &mut String, tenths: i64) {
    let sign = if tenths < 0 { "-" } else { "" };
    let (whole, rest) = (tenths.abs() / 10, tenths.abs() % 10);
    let _ = match (whole, rest) {
        (_, 0) => write!(out, "{sign}{whole}"),
        (0, _) => write!(out, "{sign}.{rest}"),
        _ => write!(out, "{sign}{whole}.{rest}"),
    };
}

fn tenth(x: f64) -> f64 {
    (x * 10.0).round() / 10.0
}
