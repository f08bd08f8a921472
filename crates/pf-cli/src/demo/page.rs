//! The report of a demo: `report.html`.

use crate::demo::Row;
use pf_geom::TeamProblem;
use pf_render::{Film, Found, Gallery};
use std::fmt::Write;

/// Frames a second.
const FPS: f64 = 10.0;
/// How large the map of a planner is at most, in pixels.
const CARD: [u16; 2] = [340, 340];
const WIDE: [u16; 2] = [640, 480];

/// A page as it grows.
#[derive(Default)]
pub(super) struct Page {
    gallery: Gallery,
    body: String,
}

impl Page {
    pub(super) fn begin() -> Self {
        let mut page = Self::default();
        page.raw(&format!(
            "<h1>Small 2D path planners</h1>\n<p>Made by <code>pf demo</code>, version {}, seed 0. \
             Times are those of this run; planners that never know that they are done had {} ms each. {} \
             Drag a slider, or play: every animation is drawn from what the planner itself told.</p>\n",
            env!("CARGO_PKG_VERSION"),
            super::PATIENCE.as_millis(),
            super::TIMES,
        ));
        page
    }

    pub(super) fn heading(&mut self, title: &str, about: &str) {
        let (title, about) = (escaped(title), escaped(about));
        self.raw(&format!("<h2>{title}</h2>\n<p>{about}</p>\n"));
    }

    /// A table without its first column, which the heading says.
    pub(super) fn table(&mut self, header: &[&str], rows: &[Row]) {
        let mut out = "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"table\"><table><thead><tr>".to_owned();
        for cell in &header[1..] {
            let _ = write!(out, "<th scope=\"col\">{}</th>", escaped(cell));
        }
        out.push_str("</tr></thead><tbody>");
        for row in rows {
            out.push_str("<tr>");
            for cell in &row[1..] {
                let _ = write!(out, "<td>{}</td>", escaped(cell));
            }
            out.push_str("</tr>");
        }
        out.push_str("</tbody></table></div>\n<p></p>\n");
        self.raw(&out);
    }

    /// Films side by side.
    pub(super) fn cards(&mut self, films: &[Film]) {
        self.raw("<div class=\"cards\">\n");
        for film in films {
            let figure = self.gallery.film(film, CARD, FPS);
            self.raw(&figure);
        }
        self.raw("</div>\n");
    }

    pub(super) fn film(&mut self, film: &Film) {
        let figure = self.gallery.film(film, WIDE, FPS);
        self.raw(&figure);
    }

    pub(super) fn fronts(
        &mut self,
        problem: &TeamProblem,
        fronts: &[Found<'_>],
        first: (usize, usize),
    ) {
        let figure = self.gallery.fronts(problem, fronts, first);
        self.raw(&figure);
    }

    pub(super) fn end(&self) -> String {
        let body = format!("<main>\n{}</main>", self.body);
        self.gallery.page("pf demo", &body)
    }

    fn raw(&mut self, html: &str) {
        self.body.push_str(html);
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
