//! Fronts of plans as a figure: choose a point, see its plan.

use crate::{
    Picture,
    film::{Gallery, Look, Thing, html},
    page::{Page, short},
    palette, svg,
};
use pf_core::Front;
use pf_geom::{Objectives, TeamPlan, TeamProblem};
use serde_json::json;
use std::fmt::Write;

/// Members of a front that are shown at most.
const MOST: usize = 40;
const WIDTH: f64 = 320.0;
const HEIGHT: f64 = 240.0;
const LEFT: f64 = 58.0;
const BOTTOM: f64 = 38.0;
/// What is shown across and up.
const CHARTS: [[usize; 2]; 2] = [[0, 1], [0, 2]];
const NAMES: [&str; 3] = ["length", "danger", "turning, degrees"];

/// A front, and who found it.
#[derive(Clone, Debug)]
pub struct Found<'a> {
    /// The planner's name.
    pub name: String,
    /// The plans.
    pub plans: &'a Front<TeamPlan>,
    /// What they cost, in the same order.
    pub costs: &'a Front<Objectives>,
}

/// A plan on the charts.
struct Mark<'a> {
    found: usize,
    cost: Objectives,
    plan: &'a TeamPlan,
    words: String,
}

impl Gallery {
    /// The fronts that several planners found for a team, in two charts, and a map that shows the
    /// plan of the point under the pointer; arrow keys go from point to point. `first` is the planner
    /// and the member that is shown to begin with. Of large fronts some members are shown, spread
    /// evenly.
    pub fn fronts(
        &mut self,
        problem: &TeamProblem,
        fronts: &[Found<'_>],
        first: (usize, usize),
    ) -> String {
        let marks = marks(problem, fronts, first);
        let Some(start) = marks.1 else {
            return String::new();
        };
        let marks = marks.0;
        let picture = Picture::of_world(problem.world(), 0.0);
        let page = Page::fitting(picture.frame, [400.0, 400.0], 400.0);
        let mut ground = String::new();
        svg::ground(&mut ground, &picture, &page);
        let ground = self.ground(ground);
        let scales = [0, 1, 2].map(|k| Scale::of(marks.iter().map(|mark| value(mark.cost, k))));
        let charts = CHARTS.map(|axes| chart(&marks, axes, &scales));
        let plans: Vec<_> = marks
            .iter()
            .map(|mark| {
                let at = CHARTS.map(|[x, y]| place(mark.cost, [x, y], &scales).map(short));
                json!({"at": at, "map": drawn(problem, mark.plan, &page), "said": mark.words})
            })
            .collect();
        let data = json!({"plans": plans, "first": start});
        let (view, [w, h]) = html::view(&page);
        let mut names = "<ul class=\"legend\">".to_owned();
        for (k, found) in fronts.iter().enumerate() {
            let count = found.costs.members().len();
            let _ = write!(
                names,
                "<li><svg width=\"16\" height=\"16\" aria-hidden=\"true\"><path transform=\"translate(8 8)\" {}/></svg>{}: {count} plan{}</li>",
                shape(k),
                svg::escaped(&found.name),
                if count == 1 { "" } else { "s" }
            );
        }
        format!(
            "<figure class=\"front\">\n<div class=\"sides\"><div>\
             <div class=\"stage\" style=\"max-width:{w:.0}px;aspect-ratio:{w:.2}/{h:.2}\"><svg viewBox=\"{view}\" role=\"img\" aria-label=\"the world of the team\"><use href=\"#ground{ground}\"/></svg>\
             <svg class=\"plan\" viewBox=\"{view}\" aria-hidden=\"true\">{}</svg></div>\n\
             <p class=\"words\" aria-live=\"polite\">{}</p></div><div class=\"charts\">{}{names}</ul></div></div>\n\
             <script type=\"application/json\">{}</script>\n</figure>\n",
            drawn(problem, marks[start].plan, &page),
            svg::escaped(&marks[start].words),
            charts.concat(),
            html::in_script(&data)
        )
    }
}

/// The members that are shown, by length; and the place of the first among them.
fn marks<'a>(
    problem: &TeamProblem,
    fronts: &[Found<'a>],
    first: (usize, usize),
) -> (Vec<Mark<'a>>, Option<usize>) {
    let mut marks = Vec::new();
    for (k, found) in fronts.iter().enumerate() {
        let (costs, plans) = (found.costs.members(), found.plans.members());
        let step = costs.len().div_ceil(MOST).max(1);
        for (i, (cost, plan)) in costs.iter().zip(plans).enumerate() {
            let asked = (k, i) == first;
            if i % step != 0 && !asked {
                continue;
            }
            let words = format!(
                "{}, plan {} of {}: length {:.1}, clearance {:.2}, turning {:.0} degrees, {:.1} s",
                found.name,
                i + 1,
                costs.len(),
                cost[0],
                problem.ease() - cost[1],
                cost[2].to_degrees(),
                plan.duration()
            );
            let mark = Mark {
                found: k,
                cost: *cost,
                plan,
                words,
            };
            marks.push((mark, asked));
        }
    }
    marks.sort_by(|a, b| a.0.cost[0].total_cmp(&b.0.cost[0]));
    let place = marks.iter().position(|(_, asked)| *asked);
    let place = place.or((!marks.is_empty()).then_some(0));
    (marks.into_iter().map(|(mark, _)| mark).collect(), place)
}

fn value(cost: Objectives, k: usize) -> f64 {
    if k == 2 {
        cost[2].to_degrees()
    } else {
        cost[k]
    }
}

/// From the least value to the greatest, with some room.
struct Scale {
    low: f64,
    high: f64,
}

impl Scale {
    fn of(values: impl Iterator<Item = f64> + Clone) -> Self {
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(f64::NEG_INFINITY, f64::max);
        let room = ((high - low) * 0.05).max(1e-6);
        Self {
            low: low - room,
            high: high + room,
        }
    }

    fn part(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }
}

fn place(cost: Objectives, [x, y]: [usize; 2], scales: &[Scale; 3]) -> [f64; 2] {
    let across = scales[x].part(value(cost, x));
    let up = scales[y].part(value(cost, y));
    [
        LEFT + (WIDTH - LEFT - 8.0) * across,
        (HEIGHT - BOTTOM) - (HEIGHT - BOTTOM - 8.0) * up,
    ]
}

/// A chart of two objectives; small is good in both.
fn chart(marks: &[Mark<'_>], axes: [usize; 2], scales: &[Scale; 3]) -> String {
    let [x, y] = axes.map(|k| NAMES[k]);
    let (bottom, right) = (HEIGHT - BOTTOM, WIDTH - 8.0);
    let mut out = format!(
        "<svg class=\"chart\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" tabindex=\"0\" role=\"group\" aria-label=\"{y} over {x}; arrow keys choose a plan\" font-size=\"11\" fill=\"{}\">\
         <path d=\"M{LEFT} 8V{bottom}H{right}\" fill=\"none\" stroke=\"{}\"/>\
         <text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{x}</text>\
         <text transform=\"translate(12 {}) rotate(-90)\" text-anchor=\"middle\">{y}</text>",
        palette::TEXT,
        palette::FRAME,
        f64::midpoint(LEFT, right),
        HEIGHT - 6.0,
        f64::midpoint(8.0, bottom),
    );
    for (part, anchor) in [(0.0, "start"), (1.0, "end")] {
        let at = |scale: &Scale| scale.low + part * (scale.high - scale.low);
        let _ = write!(
            out,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\">{:.1}</text><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{:.1}</text>",
            LEFT + part * (right - LEFT),
            bottom + 14.0,
            at(&scales[axes[0]]),
            LEFT - 4.0,
            bottom - part * (bottom - 18.0),
            at(&scales[axes[1]]),
        );
    }
    for mark in marks {
        let [px, py] = place(mark.cost, axes, scales);
        let _ = write!(
            out,
            "<path transform=\"translate({px:.1} {py:.1})\" {}/>",
            shape(mark.found)
        );
    }
    out.push_str(
        "<circle class=\"chosen\" r=\"8\" fill=\"none\" stroke=\"#000\" stroke-width=\"2\"/></svg>",
    );
    out
}

/// A mark of its own for every planner: shape and colour.
fn shape(k: usize) -> String {
    const SHAPES: [&str; 6] = [
        "M-3.5 0a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0-7 0z",
        "M-3.2-3.2h6.4v6.4h-6.4z",
        "M0-4.4L4.2 3.4H-4.2z",
        "M0-4.8L4.2 0L0 4.8L-4.2 0z",
        "M-1.5-4.5h3v3h3v3h-3v3h-3v-3h-3v-3h3z",
        "M0 4.4L4.2-3.4H-4.2z",
    ];
    let colour = palette::ROBOTS[k % palette::ROBOTS.len()];
    format!(
        "d=\"{}\" fill=\"{colour}\" stroke=\"#fff\" stroke-width=\".6\"",
        SHAPES[k % SHAPES.len()]
    )
}

/// A plan on the map: the robots' ways, where they begin and where they end.
fn drawn(problem: &TeamProblem, plan: &TeamPlan, page: &Page) -> String {
    let mut out = String::new();
    for (k, path) in plan.paths.iter().enumerate() {
        let (look, robot) = (Look::Robot(k), problem.robots()[k]);
        let points = path.iter().map(|p| [p.at.x, p.at.y]).collect();
        let at = [robot.start.x, robot.start.y];
        let radius = robot.radius;
        let goal = Thing::GoalOf(k, [robot.goal.x, robot.goal.y]);
        for thing in [
            Thing::Line { points, look },
            Thing::Disc { at, radius, look },
            goal,
        ] {
            out.push_str(&thing.svg(page));
        }
    }
    out
}
