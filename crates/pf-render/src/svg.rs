//! The picture as text.

use crate::{
    Line, Picture,
    page::{MARGIN, Page, short},
    palette,
    picture::{Key, Layer},
};
use pf_geom::Shape;
use std::fmt::Write;

const LINE_HEIGHT: f64 = 20.0;
const TITLE: f64 = 15.0;
const FONT: f64 = 13.0;

pub(crate) fn write(picture: &Picture) -> String {
    let page = Page::of(picture);
    let mut body = String::new();
    let mut y = MARGIN + page.map[1] + 10.0;
    scale_bar(&mut body, &page, y);
    // The scale bar stands to the right.
    let right = page.width - MARGIN - page.bar().max(70.0);
    y = legend(&mut body, &picture.legend, y, right);
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

/// The map where it belongs on the page.
fn map(out: &mut String, picture: &Picture, page: &Page) {
    let left = page.left();
    let _ = writeln!(out, r#"<g transform="translate({left} {MARGIN})">"#);
    ground(out, picture, page);
    out.push_str("</g>\n");
}

/// The layers, clipped to the map, and a frame around it, from the map's upper left corner.
pub(crate) fn ground(out: &mut String, picture: &Picture, page: &Page) {
    let [w, h] = page.map.map(short);
    let _ = writeln!(
        out,
        r#"<svg width="{w}" height="{h}">
<rect width="{w}" height="{h}" fill="{}"/>"#,
        palette::FREE
    );
    // Markers stand over lines, lines over obstacles, obstacles over cells, whatever the order they
    // came in.
    let rank = |layer: &&Layer| match layer {
        Layer::Shapes { grown, .. } if *grown <= 0.0 => 1,
        Layer::Cells { .. } | Layer::Shapes { .. } => 0,
        Layer::Threads(_) | Layer::Dots { .. } => 2,
        Layer::Swath { .. } => 3,
        Layer::Line { .. } => 4,
        Layer::Band { .. } => 5,
        Layer::Start(_) | Layer::Goal(_) => 6,
    };
    let mut layers: Vec<_> = picture.layers.iter().collect();
    layers.sort_by_key(rank);
    let mut markers = String::new();
    for layer in layers {
        match layer {
            Layer::Start(p) => start(&mut markers, page.place(*p), page.marker),
            Layer::Goal(p) => goal(&mut markers, page.place(*p), page.marker, palette::GOAL),
            other => draw(out, page, other),
        }
    }
    // Markers may stick out of the map: they are drawn outside the clip.
    let (w, h) = (short(page.map[0] + 1.0), short(page.map[1] + 1.0));
    let _ = writeln!(
        out,
        r#"</svg>
<rect x="-0.5" y="-0.5" width="{w}" height="{h}" fill="none" stroke="{}"/>
{markers}"#,
        palette::FRAME
    );
}

fn draw(out: &mut String, page: &Page, layer: &Layer) {
    match layer {
        Layer::Cells {
            data,
            corner,
            side,
            fill,
            opacity,
        } => {
            let ([x, y], side) = (page.place(*corner), page.scale * side);
            let place = match (page.up(), x == 0.0 && y == 0.0) {
                (true, _) => format!("translate({x} {y}) scale({side} -{side})"),
                (false, false) => format!("translate({x} {y}) scale({side})"),
                (false, true) => format!("scale({side})"),
            };
            let _ = writeln!(
                out,
                r#"<path transform="{place}" shape-rendering="crispEdges" fill="{fill}" opacity="{opacity}" d="{data}"/>"#,
            );
        }
        Layer::Shapes {
            shapes,
            grown,
            fill,
            opacity,
        } => {
            // A little rim keeps the smallest shapes visible; a wide one grows all by the margin.
            let width = short(2.0 * grown * page.scale).max(0.5);
            let data = outlines(page, shapes);
            let _ = writeln!(
                out,
                r#"<path fill="{fill}" stroke="{fill}" stroke-width="{width}" stroke-linejoin="round" opacity="{opacity}" d="{data}"/>"#,
            );
        }
        Layer::Threads(pieces) => {
            let mut data = String::new();
            for piece in pieces {
                let [[ax, ay], [bx, by]] = piece.map(|p| page.place(p).map(short));
                let _ = write!(data, "M{ax} {ay}L{bx} {by}");
            }
            let _ = writeln!(
                out,
                r#"<path fill="none" stroke="{}" stroke-width="0.8" stroke-opacity="0.55" d="{data}"/>"#,
                palette::THREAD
            );
        }
        Layer::Dots { points, colour } => dots(out, page, points, colour),
        Layer::Band { lines, colour } => {
            let mut data = String::new();
            for line in lines {
                let _ = write!(data, "M{}", polyline(page, line));
            }
            let width = short(page.pen + 1.0);
            let _ = writeln!(
                out,
                r#"<path fill="none" stroke="{colour}" stroke-width="{width}" stroke-linejoin="round" stroke-linecap="round" d="{data}"/>"#
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
        } => path(out, page, points, colour, *line),
        Layer::Start(_) | Layer::Goal(_) => {}
    }
}

/// Longer lines are drawn in pieces of so many points: to fill a stroke takes the square of its length.
const PIECE: usize = 1000;

/// A path with a white rim, which keeps it readable on dark ground.
fn path(out: &mut String, page: &Page, points: &[[f64; 2]], colour: &str, line: Line) {
    let (dashes, pen) = (dashes(line, page.pen), short(page.pen));
    let halo = short(page.pen + 2.0);
    out.push_str(r#"<g fill="none" stroke-linejoin="round" stroke-linecap="round">"#);
    for stroke in [
        format!(r##"stroke="#fff" stroke-opacity="0.8" stroke-width="{halo}""##),
        format!(r#"stroke="{colour}" stroke-width="{pen}"{dashes}"#),
    ] {
        // A piece begins where the one before ends.
        for first in (0..points.len().saturating_sub(1).max(1)).step_by(PIECE) {
            let piece = &points[first..points.len().min(first + PIECE + 1)];
            let piece = polyline(page, piece);
            let _ = write!(out, r#"<polyline {stroke} points="{piece}"/>"#);
        }
    }
    out.push_str("</g>\n");
}

fn dots(out: &mut String, page: &Page, points: &[[f64; 2]], colour: &str) {
    let mut data = String::new();
    for &point in points {
        let [x, y] = page.place(point).map(short);
        let _ = write!(data, "M{x} {y}h0");
    }
    // A white rim keeps them apart from obstacles, at whose corners they lie.
    let _ = writeln!(
        out,
        r##"<g fill="none" stroke-linecap="round"><path stroke="#fff" stroke-width="7.5" d="{data}"/><path stroke="{colour}" stroke-width="5.5" d="{data}"/></g>"##
    );
}

/// The borders of shapes, all in one direction, so that where two overlap nothing is left out.
fn outlines(page: &Page, shapes: &[Shape]) -> String {
    let mut data = String::new();
    for shape in shapes {
        match shape {
            Shape::Circle(circle) => {
                let centre = circle.centre();
                let [x, y] = page.place([centre.x, centre.y]);
                let r = circle.radius() * page.scale;
                let (left, y, turn) = (short(x - r), short(y), u8::from(!page.up()));
                let (r, width) = (short(r), short(2.0 * r));
                let _ = write!(
                    data,
                    "M{left} {y}a{r} {r} 0 1 {turn} {width} 0a{r} {r} 0 1 {turn} -{width} 0z"
                );
            }
            Shape::Rectangle(rectangle) => outline(&mut data, page, &rectangle.corners()),
            Shape::Polygon(polygon) => outline(&mut data, page, polygon.corners()),
        }
    }
    data
}

fn outline(data: &mut String, page: &Page, corners: &[pf_geom::Point]) {
    for (k, corner) in corners.iter().enumerate() {
        let [x, y] = page.place([corner.x, corner.y]).map(short);
        let _ = write!(data, "{}{x} {y}", if k == 0 { "M" } else { "L" });
    }
    data.push('z');
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
pub(crate) fn start(out: &mut String, p: [f64; 2], size: f64) {
    let ([x, y], r) = (p.map(short), short(size * 0.85));
    let _ = write!(
        out,
        r##"<circle cx="{x}" cy="{y}" r="{r}" fill="{}" stroke="#fff" stroke-width="1.5"/>"##,
        palette::START
    );
}

/// A star.
pub(crate) fn goal(out: &mut String, [x, y]: [f64; 2], size: f64, colour: &str) {
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
        r##"<polygon points="{}" fill="{colour}" stroke="#fff" stroke-width="1.5"/>"##,
        points.trim_end()
    );
}

/// The scale, to the right.
pub(crate) fn scale_bar(out: &mut String, page: &Page, top: f64) {
    let (right, length) = (page.width - MARGIN, short(page.bar()));
    let (x, y, below) = (short(right - length), top - 2.0, top + 18.0);
    let words = page.frame.words(page.frame.scale());
    let _ = writeln!(
        out,
        r#"<path d="M{x} {y}v5h{length}v-5" fill="none" stroke="{}" stroke-width="1.5"/><text x="{right}" y="{below}" text-anchor="end">{words}</text>"#,
        palette::TEXT,
    );
}

/// Swatches and words, in as many lines as they need up to the right edge; returns where it ends.
pub(crate) fn legend(out: &mut String, entries: &[(Key, String)], top: f64, right: f64) -> f64 {
    let (mut x, mut y) = (MARGIN, top);
    for (key, words) in entries {
        let width = entry_width(words);
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

/// What stands beside a word of the legend: 22 wide, centred on a height.
pub(crate) fn swatch(out: &mut String, key: Key, [x, y]: [f64; 2]) {
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
        Key::Thread => {
            let _ = write!(
                out,
                r#"<path d="M{} {y}h20" stroke="{}" stroke-width="1"/>"#,
                x + 1.0,
                palette::THREAD
            );
        }
        Key::Dot(colour) => {
            let _ = write!(
                out,
                r#"<circle cx="{}" cy="{y}" r="3" fill="{colour}"/>"#,
                x + 11.0
            );
        }
        Key::Start => start(out, [x + 11.0, y], 7.0),
        Key::Goal => goal(out, [x + 11.0, y], 7.0, palette::GOAL),
        other => moving_swatch(out, other, [x, y]),
    }
}

/// Of what only animations show.
fn moving_swatch(out: &mut String, key: Key, [x, y]: [f64; 2]) {
    let _ = match key {
        Key::Disc(colour) => write!(
            out,
            r#"<circle cx="{}" cy="{y}" r="5.5" fill="{colour}"/>"#,
            x + 11.0
        ),
        Key::Window(colour) => write!(
            out,
            r#"<rect x="{}" y="{}" width="12" height="12" fill="{colour}" fill-opacity=".12" stroke="{colour}"/>"#,
            x + 5.0,
            y - 6.0
        ),
        Key::Hair(colour) => write!(
            out,
            r#"<path d="M{} {y}h20" stroke="{colour}" stroke-width="1.2"/>"#,
            x + 1.0
        ),
        Key::Ramp(colours) => {
            let step = 22.0 / f64::from(u32::try_from(colours.len()).unwrap_or(1));
            for (k, colour) in (0u32..).zip(colours) {
                let _ = write!(
                    out,
                    r#"<rect x="{}" y="{}" width="{}" height="13" fill="{colour}"/>"#,
                    short(x + f64::from(k) * step),
                    y - 6.5,
                    short(step + 0.2)
                );
            }
            Ok(())
        }
        _ => Ok(()),
    };
}

/// Text in as many lines as it needs, broken at blanks; returns where it ends.
pub(crate) fn paragraph(out: &mut String, page: &Page, top: f64, size: f64, text: &str) -> f64 {
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

/// How wide a swatch and its words are.
pub(crate) fn entry_width(words: &str) -> f64 {
    28.0 + text_width(words, FONT)
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

/// Text as XML may hold it; characters XML has no place for are left out.
pub(crate) fn escaped(text: &str) -> String {
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
