//! Where things lie in an animation of a given size.

use crate::{
    film::Film,
    page::{MARGIN, Page},
    palette, svg,
};
use std::fmt::Write;

/// Text below the map is set this much smaller than in pictures.
const TEXT: f64 = 0.8;
const ROOM: f64 = 8.0;
const WORDS: f64 = 13.0;

/// A film laid out for a width and height in pixels.
pub(crate) struct Sheet {
    pub(crate) page: Page,
    pub(crate) size: [f64; 2],
    /// The map's upper left corner.
    pub(crate) corner: [f64; 2],
    /// The base line of what is said of a frame.
    words: f64,
}

impl Sheet {
    /// The map as large as the text below it allows.
    pub(crate) fn of(film: &Film, [width, height]: [f64; 2]) -> Option<Self> {
        let frame = film.reels.first()?.ground.frame;
        let room = [width - 2.0 * ROOM, height * 0.7];
        let guess = Page::fitting(frame, room, width);
        let foot = foot(film, &guess, width).1;
        // A map is shown, however little room there is.
        let left = (height - foot - 2.0 * ROOM).max(height * 0.3);
        let page = Page::fitting(frame, [room[0], left], width);
        let x = ((width - page.map[0]) / 2.0).floor();
        Some(Self {
            corner: [x, ROOM],
            words: ROOM + page.map[1] + foot,
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
        let top = self.corner[1] + self.page.map[1];
        let (text, _) = foot(film, &self.page, width);
        let _ = write!(
            out,
            r#"</g><g transform="translate(0 {top}) scale({TEXT})">{text}</g></svg>"#
        );
        out
    }

    /// What is over it in a frame.
    pub(crate) fn moving(&self, things: &str, words: &str) -> String {
        let mut out = self.open();
        let [x, y] = self.corner;
        let _ = write!(
            out,
            r#"<g transform="translate({x} {y})">{things}</g><text x="{}" y="{}" font-size="{}">{}</text></svg>"#,
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

/// Legend, scale and title below a map, and how high they are with a line for words, in pixels.
fn foot(film: &Film, page: &Page, width: f64) -> (String, f64) {
    // In units of the smaller text.
    let page = Page {
        frame: page.frame,
        scale: page.scale / TEXT,
        map: page.map,
        width: width / TEXT,
        pen: page.pen,
        marker: page.marker,
    };
    let mut out = String::new();
    svg::scale_bar(&mut out, &page, 8.0);
    let mut y = svg::legend(&mut out, &film.legend(), &page, 8.0);
    y = svg::paragraph(&mut out, &page, y - 6.0, 14.0, &film.title);
    (out, (y + WORDS) * TEXT)
}
