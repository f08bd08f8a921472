//! Where things lie in an animation of a given size.

use crate::{
    film::Film,
    frame::Frame,
    page::{MARGIN, Page},
    palette, svg,
};
use std::fmt::Write;

/// Text below the map is set this much smaller than in pictures.
const TEXT: f64 = 0.8;
const ROOM: f64 = 8.0;
const WORDS: f64 = 13.0;

/// A film laid out for a width and height in pixels: the legend below the map, or beside it where
/// that leaves the map larger.
pub(crate) struct Sheet {
    pub(crate) page: Page,
    pub(crate) size: [f64; 2],
    /// The map's upper left corner.
    pub(crate) corner: [f64; 2],
    /// Where legend and title begin.
    legend: [f64; 2],
    title: f64,
    /// How wide a legend beside the map is.
    column: Option<f64>,
    /// The base line of what is said of a frame.
    words: f64,
}

impl Sheet {
    /// The map as large as the text allows.
    pub(crate) fn of(film: &Film, size: [f64; 2]) -> Option<Self> {
        let below = Self::laid(film, size, false)?;
        let beside = Self::laid(film, size, true);
        // A little larger is not worth it.
        let larger = |other: &Self| other.page.scale > below.page.scale * 1.05;
        Some(beside.filter(larger).unwrap_or(below))
    }

    fn laid(film: &Film, [width, height]: [f64; 2], beside: bool) -> Option<Self> {
        let frame = film.reels.first()?.ground.frame;
        let title = title(film, width).1;
        let fitting = |w: f64, h: f64| {
            // A map is shown, however little room there is.
            let room = [w.max(width * 0.2), h.max(height * 0.3)];
            Page::fitting(frame, room, width)
        };
        let foot = title + 2.0 * ROOM + WORDS;
        let (page, corner, legend_at, title_at);
        let column = beside.then(|| widest(film));
        if let Some(column) = column {
            page = fitting(width - 2.0 * ROOM - column, height - foot);
            let (_, high) = legend(film, &page, column, beside);
            if high > page.map[1] {
                return None;
            }
            let left = (width - page.map[0] - column) / 2.0;
            corner = [left.floor().max(ROOM), ROOM];
            legend_at = [corner[0] + page.map[0], 0.0];
            title_at = ROOM + page.map[1] + ROOM;
        } else {
            // The height of the legend depends on the scale, which depends on its height.
            let guess = fitting(width - 2.0 * ROOM, height * 0.7);
            let (_, high) = legend(film, &guess, width, beside);
            page = fitting(width - 2.0 * ROOM, height - foot - high);
            let (_, high) = legend(film, &page, width, beside);
            corner = [((width - page.map[0]) / 2.0).floor(), ROOM];
            legend_at = [0.0, ROOM + page.map[1]];
            title_at = legend_at[1] + high;
        }
        Some(Self {
            corner,
            legend: legend_at,
            title: title_at,
            column,
            words: (title_at + title + WORDS * TEXT).min(height - ROOM / 2.0),
            page,
            size: [width, height],
        })
    }

    /// What lies still: the ground of a reel, and the text below it.
    pub(crate) fn still(&self, film: &Film, reel: usize) -> String {
        let [width, height] = self.size;
        let mut out = self.open();
        let _ = write!(
            out,
            r##"<rect width="{width}" height="{height}" fill="#fff"/><g transform="translate({} {})">"##,
            self.corner[0], self.corner[1]
        );
        svg::ground(&mut out, &film.reels[reel].ground, &self.page);
        let [x, y] = self.legend;
        let beside = self.column.is_some();
        let (entries, _) = legend(film, &self.page, self.column.unwrap_or(width), beside);
        let (title, _) = title(film, width);
        let _ = write!(
            out,
            r#"</g><g transform="translate({x} {y}) scale({TEXT})">{entries}</g><g transform="translate(0 {}) scale({TEXT})">{title}</g></svg>"#,
            self.title
        );
        out
    }

    /// What is over it in a frame.
    pub(crate) fn moving(&self, things: &str, words: &str) -> String {
        let mut out = self.open();
        // What sticks out of the map is cut, but for markers at its edge.
        let [x, y] = self.corner.map(|at| at - ROOM);
        let [w, h] = self.page.map.map(|side| side + 2.0 * ROOM);
        let _ = write!(
            out,
            r#"<svg x="{x}" y="{y}" width="{w}" height="{h}"><g transform="translate({ROOM} {ROOM})">{things}</g></svg><text x="{}" y="{}" font-size="{}">{}</text></svg>"#,
            MARGIN * TEXT,
            self.words,
            WORDS * TEXT,
            svg::escaped(words)
        );
        out
    }

    fn open(&self) -> String {
        let [width, height] = self.size;
        format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" font-family="'DejaVu Sans',Verdana,sans-serif" font-size="13" fill="{}">"#,
            palette::TEXT
        )
    }
}

/// Legend and scale in a column of that width, and how high they are, in pixels.
fn legend(film: &Film, page: &Page, width: f64, beside: bool) -> (String, f64) {
    let page = smaller(page, width);
    let mut out = String::new();
    let entries = film.legend();
    if beside {
        let y = svg::legend(&mut out, &entries, ROOM, 0.0);
        svg::scale_bar(&mut out, &page, y + ROOM);
        return (out, (y + 4.0 * ROOM) * TEXT);
    }
    svg::scale_bar(&mut out, &page, ROOM);
    let right = page.width - MARGIN - page.bar().max(70.0);
    let y = svg::legend(&mut out, &entries, ROOM, right);
    (out, (y - 6.0).max(30.0) * TEXT)
}

/// The width of the longest line of the legend with room around it, in pixels.
fn widest(film: &Film) -> f64 {
    let entries = film.legend();
    let lines = entries.iter().map(|(_, words)| svg::entry_width(words));
    (lines.fold(110.0, f64::max) + 2.0 * MARGIN) * TEXT
}

/// The title, and how high it is, in pixels.
fn title(film: &Film, width: f64) -> (String, f64) {
    let frame = Frame::of_cells(1, 1);
    let page = smaller(&Page::fitting(frame, [1.0, 1.0], width), width);
    let mut out = String::new();
    let y = svg::paragraph(&mut out, &page, 0.0, 14.0, &film.title);
    (out, y * TEXT)
}

/// A page in units of the smaller text.
fn smaller(page: &Page, width: f64) -> Page {
    Page {
        frame: page.frame,
        scale: page.scale / TEXT,
        map: page.map,
        width: width / TEXT,
        pen: page.pen,
        marker: page.marker,
    }
}
