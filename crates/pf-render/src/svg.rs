//! The picture as text.

use crate::{
    Line, Picture, palette,
    picture::{Key, Layer},
};
use std::fmt::Write;

/// The longer side of the map, in pixels, as far as whole pixels per cell allow.
const SIDE: f64 = 1024.0;
/// Cells of a small map do not grow beyond this.
const LARGEST_CELL: f64 = 32.0;
const MARGIN: f64 = 16.0;
/// Room for the caption, however narrow the map.
const NARROWEST: f64 = 560.0;
const LINE_HEIGHT: f64 = 20.0;
const TITLE: f64 = 15.0;
const FONT: f64 = 13.0;

/// Where things lie on the page, in pixels.
struct Page {
    /// Pixels per cell.
    scale: f64,
    map: [f64; 2],
    width: f64,
}

impl Page {
    fn of(picture: &Picture) -> Self {
        let [width, height] = picture.size.map(f64::from);
        let fit = SIDE / width.max(height);
        let scale = if fit < 1.0 {
            fit
        } else {
            fit.round().min(LARGEST_CELL)
        };
        let map = [width * scale, height * scale];
        Self {
            scale,
            map,
            width: (map[0] + 2.0 * MARGIN).max(NARROWEST).ceil(),
        }
    }

    /// The map's left edge: centred on the page.
    fn left(&self) -> f64 {
        ((self.width - self.map[0]) / 2.0).floor()
    }

    fn place(&self, p: [f64; 2]) -> [f64; 2] {
        [p[0] * self.scale, p[1] * self.scale]
    }

    /// A line's width: visible on any map, slim on a small one.
    fn pen(&self) -> f64 {
        (self.scale * 0.25).clamp(2.5, 6.0)
    }

    fn marker(&self) -> f64 {
        (self.scale * 0.36).clamp(8.0, 12.0)
    }
}

pub(crate) fn write(picture: &Picture) -> String {
    let page = Page::of(picture);
    let mut body = String::new();
    let mut y = MARGIN + page.map[1] + 10.0;
    scale_bar(&mut body, &page, y);
    y = legend(&mut body, picture, &page, y);
    for (i, text) in picture.caption.iter().enumerate() {
        let size = if i == 0 { TITLE } else { FONT };
        y = paragraph(&mut body, &page, y, size, text);
    }
    let (width, height) = (page.width, (y + MARGIN * 0.75).ceil());
    let mut out = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" font-family="'DejaVu Sans',Verdana,sans-serif" font-size="{FONT}" fill="{}">
"#,
        palette::TEXT
    );
    if let Some(title) = picture.caption.first() {
        let _ = writeln!(out, "<title>{}</title>", escaped(title));
    }
    let _ = writeln!(
        out,
        r##"<rect width="{width}" height="{height}" fill="#fff"/>"##
    );
    map(&mut out, picture, &page);
    out.push_str(&body);
    out.push_str("</svg>\n");
    out
}

/// The layers, clipped to the map, and a frame around it.
fn map(out: &mut String, picture: &Picture, page: &Page) {
    let (left, [w, h]) = (page.left(), page.map.map(short));
    let _ = writeln!(
        out,
        r#"<svg x="{left}" y="{MARGIN}" width="{w}" height="{h}">
<rect width="{w}" height="{h}" fill="{}"/>"#,
        palette::FREE
    );
    // Markers stand over lines, lines over cells, whatever the order they came in.
    let rank = |layer: &&Layer| match layer {
        Layer::Cells { .. } => 0,
        Layer::Swath { .. } => 1,
        Layer::Line { .. } => 2,
        Layer::Start(_) | Layer::Goal(_) => 3,
    };
    let mut layers: Vec<_> = picture.layers.iter().collect();
    layers.sort_by_key(rank);
    let mut markers = String::new();
    for layer in layers {
        match layer {
            Layer::Start(p) => start(&mut markers, page.place(*p), page.marker()),
            Layer::Goal(p) => goal(&mut markers, page.place(*p), page.marker()),
            other => draw(out, page, other),
        }
    }
    // Markers may stick out of the map: they are drawn outside the clip.
    let (x, y) = (left - 0.5, MARGIN - 0.5);
    let (w, h) = (short(page.map[0] + 1.0), short(page.map[1] + 1.0));
    let _ = writeln!(
        out,
        r#"</svg>
<rect x="{x}" y="{y}" width="{w}" height="{h}" fill="none" stroke="{}"/>
<g transform="translate({left} {MARGIN})">{markers}</g>"#,
        palette::FRAME
    );
}

fn draw(out: &mut String, page: &Page, layer: &Layer) {
    match layer {
        Layer::Cells {
            data,
            block,
            fill,
            opacity,
        } => {
            let scale = page.scale * f64::from(*block);
            let _ = writeln!(
                out,
                r#"<path transform="scale({scale})" shape-rendering="crispEdges" fill="{fill}" opacity="{opacity}" d="{data}"/>"#,
            );
        }
        Layer::Swath {
            points,
            colour,
            radius,
        } => {
            let width = short(2.0 * radius * page.scale);
            let points = polyline(page, points);
            let _ = writeln!(
                out,
                r#"<polyline fill="none" stroke="{colour}" stroke-opacity="0.18" stroke-width="{width}" stroke-linejoin="round" stroke-linecap="round" points="{points}"/>"#
            );
        }
        Layer::Line {
            points,
            colour,
            line,
        } => {
            let (pen, points) = (page.pen(), polyline(page, points));
            let (dashes, pen) = (dashes(*line, pen), short(pen));
            let halo = short(page.pen() + 2.0);
            // A white rim keeps the line readable on dark cells.
            let _ = writeln!(
                out,
                r##"<g fill="none" stroke-linejoin="round" stroke-linecap="round"><polyline stroke="#fff" stroke-opacity="0.8" stroke-width="{halo}" points="{points}"/><polyline stroke="{colour}" stroke-width="{pen}"{dashes} points="{points}"/></g>"##
            );
        }
        Layer::Start(_) | Layer::Goal(_) => {}
    }
}

fn polyline(page: &Page, points: &[[f64; 2]]) -> String {
    let mut text = String::new();
    for &point in points {
        let [x, y] = page.place(point).map(short);
        let _ = write!(text, "{x},{y} ");
    }
    text.truncate(text.trim_end().len());
    text
}

fn dashes(line: Line, pen: f64) -> String {
    match line {
        Line::Solid => String::new(),
        Line::Dashed => {
            format!(
                r#" stroke-dasharray="{} {}""#,
                short(pen * 2.5),
                short(pen * 2.0)
            )
        }
    }
}

/// A disc.
fn start(out: &mut String, p: [f64; 2], size: f64) {
    let ([x, y], r) = (p.map(short), short(size * 0.85));
    let _ = write!(
        out,
        r##"<circle cx="{x}" cy="{y}" r="{r}" fill="{}" stroke="#fff" stroke-width="1.5"/>"##,
        palette::START
    );
}

/// A star.
fn goal(out: &mut String, [x, y]: [f64; 2], size: f64) {
    let mut points = String::new();
    for i in 0..10u8 {
        let radius = if i % 2 == 0 { size * 1.25 } else { size * 0.55 };
        let (sin, cos) = (std::f64::consts::PI * f64::from(i) / 5.0).sin_cos();
        let _ = write!(
            points,
            "{},{} ",
            short(x + radius * sin),
            short(y - radius * cos)
        );
    }
    let _ = write!(
        out,
        r##"<polygon points="{}" fill="{}" stroke="#fff" stroke-width="1.5"/>"##,
        points.trim_end(),
        palette::GOAL
    );
}

/// The scale's length in cells: one, two or five times a power of ten.
fn scale_cells(page: &Page) -> f64 {
    let limit = (page.map[0] / page.scale / 4.0).max(1.0);
    let mut cells = 1.0;
    for step in [2.0, 2.5, 2.0].into_iter().cycle() {
        if cells * step > limit {
            break;
        }
        cells *= step;
    }
    cells
}

/// The scale, to the right.
fn scale_bar(out: &mut String, page: &Page, top: f64) {
    let cells = scale_cells(page);
    let (right, length) = (page.width - MARGIN, short(cells * page.scale));
    let (x, y, below) = (short(right - length), top - 2.0, top + 18.0);
    let noun = if cells > 1.5 { "cells" } else { "cell" };
    let _ = writeln!(
        out,
        r#"<path d="M{x} {y}v5h{length}v-5" fill="none" stroke="{}" stroke-width="1.5"/><text x="{right}" y="{below}" text-anchor="end">{cells} {noun}</text>"#,
        palette::TEXT,
    );
}

/// Swatches and words, in as many lines as they need; returns where it ends.
fn legend(out: &mut String, picture: &Picture, page: &Page, top: f64) -> f64 {
    // The scale bar stands to the right.
    let bar = scale_cells(page) * page.scale;
    let right = page.width - MARGIN - bar.max(70.0);
    let (mut x, mut y) = (MARGIN, top);
    for (key, words) in &picture.legend {
        let width = 28.0 + text_width(words, FONT);
        if x > MARGIN && x + width > right {
            x = MARGIN;
            y += LINE_HEIGHT;
        }
        swatch(out, *key, [x, y + 7.0]);
        let _ = writeln!(
            out,
            r#"<text x="{}" y="{}">{}</text>"#,
            short(x + 26.0),
            y + 12.0,
            escaped(words)
        );
        x += width + 14.0;
    }
    y + LINE_HEIGHT + 8.0
}

fn swatch(out: &mut String, key: Key, [x, y]: [f64; 2]) {
    let x = short(x);
    match key {
        Key::Cells(fill, opacity) => {
            let _ = write!(
                out,
                r#"<rect x="{}" y="{}" width="13" height="13" fill="{fill}" fill-opacity="{opacity}" stroke="{}"/>"#,
                x + 4.5,
                y - 6.5,
                palette::FRAME
            );
        }
        Key::Line(colour, line) => {
            let dashes = dashes(line, 2.0);
            let _ = write!(
                out,
                r#"<path d="M{} {y}h20" stroke="{colour}" stroke-width="3"{dashes}/>"#,
                x + 1.0
            );
        }
        Key::Start => start(out, [x + 11.0, y], 7.0),
        Key::Goal => goal(out, [x + 11.0, y], 7.0),
    }
}

/// Text in as many lines as it needs, broken at blanks; returns where it ends.
fn paragraph(out: &mut String, page: &Page, top: f64, size: f64, text: &str) -> f64 {
    let room = page.width - 2.0 * MARGIN;
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if text_width(line, size) + text_width(word, size) < room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    let mut y = top;
    for line in lines {
        let _ = writeln!(
            out,
            r#"<text x="{MARGIN}" y="{}" font-size="{size}">{}</text>"#,
            short(y + size),
            escaped(&line)
        );
        y += size + 6.0;
    }
    y
}

/// About how wide a text is, on the generous side: three widths of letters are enough to place it.
fn text_width(text: &str, size: f64) -> f64 {
    let width = |letter| match letter {
        ' ' | 'i' | 'j' | 'l' | 'f' | 't' | 'r' | 'I' | '.' | ',' | ':' | ';' | '\'' | '|' => 0.4,
        'm' | 'w' | 'M' | 'W' | '%' | '@' => 0.95,
        letter if letter.is_ascii() && !letter.is_ascii_uppercase() => 0.62,
        letter if letter.is_ascii() => 0.72,
        _ => 1.0,
    };
    size * text.chars().map(width).sum::<f64>()
}

/// Two decimals are finer than any pixel.
fn short(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}

/// Text as XML may hold it; characters XML has no place for are left out.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            c if c.is_control() => {}
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use pf_grid::{Cell, Grid};

    fn size_of(width: u32, height: u32) -> [f64; 2] {
        Page::of(&Picture::new(width, height)).map
    }

    #[test]
    fn small_maps_are_enlarged_and_large_ones_fit_the_screen() {
        let same = |a: [f64; 2], b: [f64; 2]| a.map(f64::to_bits) == b.map(f64::to_bits);
        assert!(same(size_of(20, 20), [640.0, 640.0]));
        assert!(same(size_of(512, 256), [1024.0, 512.0]));
        assert!(same(size_of(4096, 4096), [1024.0, 1024.0]));
    }

    #[test]
    fn a_large_map_makes_a_small_file() {
        let rooms = |c: Cell| u8::from(c.y & 31 > 0 && (c.x & 31 > 0 || c.y & 31 == 16));
        let svg = Picture::of(&Grid::new(512, 512, rooms).unwrap()).svg();
        assert!(svg.len() < 20_000, "{} bytes", svg.len());
        let noise = |c: Cell| u8::from((c.x * 7919 + c.y * 104_729) % 97 > 34);
        let svg = Picture::of(&Grid::new(4096, 4096, noise).unwrap()).svg();
        assert!(svg.len() < 16 << 20, "{} bytes", svg.len());
    }

    #[test]
    fn captions_cannot_break_the_file() {
        let grid = Grid::open(4, 4).unwrap();
        let picture = Picture::of(&grid).caption("a<b & \u{1}c > \"d\"");
        assert!(picture.svg().contains("a&lt;b &amp; c &gt; \"d\""));
        assert!(picture.png().is_ok());
    }

    #[test]
    fn degenerate_pictures_are_drawn_too() {
        for (width, height) in [(1, 1), (1, 5000), (5000, 1)] {
            let grid = Grid::open(width, height).unwrap();
            let end = Cell::new(width - 1, height - 1);
            let picture = Picture::of(&grid)
                .path("", Line::Dashed, &[Cell::new(0, 0), end])
                .ends(end, end);
            assert!(picture.png().is_ok(), "{width} x {height}");
        }
    }
}
