//! Films as pages: SVG below, a canvas of a pixel per block for cells, SVG above, and a short script.

use crate::{
    film::{Film, Shade, shade},
    page::Page,
    picture::Key,
    svg,
};
use serde_json::{Value, json};
use std::{collections::BTreeMap, fmt::Write};

/// Room around a map, for markers that stick out.
const RIM: f64 = 9.0;
/// A figure's width at least, for its slider and legend, if the screen is as wide.
const NARROWEST: f64 = 300.0;

/// Films and other figures of one page, which share what lies still below them.
///
/// ```
/// use pf_grid::Grid;
/// use pf_render::{Film, Gallery, Picture, Reel, Shot};
///
/// let mut reel = Reel::of(Picture::of(&Grid::open(4, 4).unwrap()));
/// reel.push(Shot::default());
/// let mut gallery = Gallery::default();
/// let figure = gallery.film(&Film::new("nothing", vec![reel]), [480, 360], 10.0);
/// let page = gallery.page("A page", &format!("<h1>A page</h1>{figure}"));
/// assert!(page.contains("<figure class=\"film\" ") && !page.contains("https:"));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Gallery {
    grounds: Vec<String>,
}

impl Film {
    /// The film as a page of its own that needs nothing else; the map is at most as wide and high as
    /// said, in pixels, and never wider than the screen. `fps` is frames a second.
    #[must_use]
    pub fn html(&self, size: [u16; 2], fps: f64) -> String {
        let mut gallery = Gallery::default();
        let figure = gallery.film(self, size, fps);
        let figure = figure.replacen("<figure ", "<figure data-autoplay=\"1\" ", 1);
        let width = size[0];
        let main = format!("<main style=\"max-width:{width}px;margin:auto\">{figure}</main>");
        gallery.page(&self.title, &main)
    }
}

impl Gallery {
    /// A film as a figure, with a slider and a button; the map is at most as wide and high as said,
    /// in pixels.
    pub fn film(&mut self, film: &Film, size: [u16; 2], fps: f64) -> String {
        let [width, height] = size.map(|side| (f64::from(side) - 2.0 * RIM).max(1.0));
        let Some(first) = film.reels.first() else {
            return String::new();
        };
        let page = Page::fitting(first.ground.frame, [width, height], width);
        let mut parts = Parts::default();
        let (mut grounds, mut tops, mut frames) = (Vec::new(), Vec::new(), Vec::new());
        for (r, reel) in film.reels.iter().enumerate() {
            let mut ground = String::new();
            svg::ground(&mut ground, &reel.ground, &page);
            grounds.push(format!("#ground{}", self.ground(ground)));
            let top = reel.top.iter().map(|thing| parts.number(thing.svg(&page)));
            tops.push(top.collect::<Vec<_>>());
            for shot in &reel.shots {
                // Of several shades of a block the last counts.
                let blocks = shot.cells.iter();
                let changes: BTreeMap<u32, u8> = blocks
                    .filter_map(|&(cell, shade)| Some((reel.block_of(cell)?, shade.0)))
                    .collect();
                let changes = changes.into_iter().map(|(block, shade)| (shade, block));
                let things = shot
                    .things
                    .iter()
                    .map(|thing| parts.number(thing.svg(&page)));
                let things: Vec<_> = things.collect();
                frames.push(json!([r, runs(changes.collect()), things, shot.words]));
            }
        }
        let data = json!({
            "fps": fps, "grounds": grounds, "tops": tops, "frames": frames, "parts": parts.all,
        });
        figure(film, &page, &data)
    }

    /// The number of a ground; one that was there before keeps its own.
    pub(crate) fn ground(&mut self, ground: String) -> usize {
        let found = self.grounds.iter().position(|other| *other == ground);
        found.unwrap_or_else(|| {
            self.grounds.push(ground);
            self.grounds.len() - 1
        })
    }

    /// A page with this body, the figures in it included. It needs nothing from anywhere else.
    #[must_use]
    pub fn page(&self, title: &str, body: &str) -> String {
        let mut grounds = String::new();
        for (k, ground) in self.grounds.iter().enumerate() {
            let _ = write!(grounds, "<g id=\"ground{k}\">{ground}</g>");
        }
        let style = include_str!("player.css");
        let player = concat!(include_str!("player.js"), include_str!("front.js"));
        let (title, shades) = (svg::escaped(title), shades());
        format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n\
             <title>{title}</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n{style}</style>\n</head>\n<body>\n\
             <svg width=\"0\" height=\"0\" style=\"position:absolute\" aria-hidden=\"true\"><defs>{grounds}</defs></svg>\n\
             {body}\n<script>\nconst SHADES = {shades};\n{player}</script>\n</body>\n</html>\n"
        )
    }
}

/// Text that occurs in many frames is written once.
#[derive(Default)]
struct Parts {
    all: Vec<String>,
    sorted: BTreeMap<String, usize>,
}

impl Parts {
    fn number(&mut self, part: String) -> usize {
        if let Some(&known) = self.sorted.get(&part) {
            return known;
        }
        self.sorted.insert(part.clone(), self.all.len());
        self.all.push(part);
        self.all.len() - 1
    }
}

/// Data as it may stand in a script's element: nothing in it ends that.
pub(super) fn in_script(data: &Value) -> String {
    data.to_string().replace('<', "\\u003c")
}

fn figure(film: &Film, page: &Page, data: &Value) -> String {
    let (view, [w, h]) = view(page);
    let count = film.frames();
    let last = count.saturating_sub(1);
    let things = last_things(data);
    let ground = data["grounds"]
        .as_array()
        .and_then(|all| all.last()?.as_str());
    let json = in_script(data);
    // A picture has nothing to play.
    let hidden = if count < 2 { " hidden" } else { "" };
    format!(
        "<figure class=\"film\" style=\"max-width:{:.0}px\">\n<div class=\"stage\" style=\"max-width:{w:.0}px;aspect-ratio:{w:.2}/{h:.2}\">\
         <svg viewBox=\"{view}\" role=\"img\" aria-label=\"{}\"><use href=\"{}\"/></svg>{}\
         <svg viewBox=\"{view}\" aria-hidden=\"true\">{things}</svg></div>\n\
         <p class=\"words\"></p>\n<div class=\"controls\"{hidden}><button type=\"button\">Play</button>\
         <input type=\"range\" min=\"0\" max=\"{last}\" value=\"{last}\" aria-label=\"frame\"></div>\n\
         <figcaption>{}{}</figcaption>\n<script type=\"application/json\">{json}</script>\n</figure>\n",
        w.max(NARROWEST),
        svg::escaped(&film.title).replace('"', "&quot;"),
        ground.unwrap_or_default(),
        canvas(film, page, [w, h]),
        svg::escaped(&film.title),
        legend(&film.legend(), page),
    )
}

/// What of a page is seen, and how wide and high that is.
pub(crate) fn view(page: &Page) -> (String, [f64; 2]) {
    let [w, h] = page.map.map(|side| side + 2.0 * RIM);
    (format!("{} {} {w:.2} {h:.2}", -RIM, -RIM), [w, h])
}

/// What is on top in the last frame, for those without scripts.
fn last_things(data: &Value) -> String {
    let part = |k: &Value| {
        let k = usize::try_from(k.as_u64()?).ok()?;
        data["parts"][k].as_str()
    };
    let frame = data["frames"].as_array().and_then(|all| all.last());
    let things = frame.and_then(|frame| frame[2].as_array());
    let top = data["tops"]
        .as_array()
        .and_then(|all| all.last()?.as_array());
    let all = things.into_iter().chain(top).flatten();
    all.filter_map(part).collect()
}

/// The canvas of cells, where they lie on the map, if any frame has some.
fn canvas(film: &Film, page: &Page, whole: [f64; 2]) -> String {
    let reels = || film.reels.iter();
    if reels().all(|reel| reel.shots.iter().all(|shot| shot.cells.is_empty())) {
        return String::new();
    }
    let Some(reel) = reels().next() else {
        return String::new();
    };
    let (corner, side) = reel.lattice();
    let [columns, rows] = reel.blocks;
    let far = [
        corner[0] + side * f64::from(columns),
        corner[1] + side * f64::from(rows),
    ];
    let ends = [page.place(corner), page.place(far)];
    let top = ends[0][1].min(ends[1][1]);
    let part = |length: f64, axis: usize| 100.0 * length / whole[axis];
    let flip = if page.up() {
        ";transform:scaleY(-1)"
    } else {
        ""
    };
    format!(
        "<canvas width=\"{columns}\" height=\"{rows}\" style=\"left:{:.4}%;top:{:.4}%;width:{:.4}%;height:{:.4}%{flip}\"></canvas>",
        part(ends[0][0] + RIM, 0),
        part(top + RIM, 1),
        part(ends[1][0] - ends[0][0], 0),
        part((ends[1][1] - ends[0][1]).abs(), 1),
    )
}

fn legend(entries: &[(Key, String)], page: &Page) -> String {
    let mut out = "<ul class=\"legend\">".to_owned();
    for (key, words) in entries {
        let mut swatch = String::new();
        svg::swatch(&mut swatch, *key, [0.0, 8.0]);
        let _ = write!(
            out,
            "<li><svg width=\"22\" height=\"16\" aria-hidden=\"true\">{swatch}</svg>{}</li>",
            svg::escaped(words)
        );
    }
    // As wide as the scale is on the map, whose width is that of the text at most.
    let share = 100.0 * page.bar() / (page.map[0] + 2.0 * RIM);
    let _ = write!(
        out,
        "</ul><div style=\"width:{share:.3}%;max-width:{:.0}px;border:1px solid;border-top:0;height:.3rem;box-sizing:border-box\"></div><span style=\"font-size:.8rem\">{}</span>",
        page.bar(),
        page.frame.words(page.frame.scale())
    );
    out
}

/// Blocks by shade, as runs: shade, number of runs, and of each run how far it is from the end of
/// the one before, and its length. Numbers are written in digits of five bits, the lowest first;
/// one of 32 and more says that another follows.
fn runs(mut changes: Vec<(u8, u32)>) -> String {
    changes.sort_unstable();
    changes.dedup();
    let mut out = String::new();
    for group in changes.chunk_by(|a, b| a.0 == b.0) {
        let stretches: Vec<_> = group.chunk_by(|a, b| a.1 + 1 == b.1).collect();
        number(&mut out, u32::from(group[0].0));
        number(&mut out, u32::try_from(stretches.len()).unwrap_or(u32::MAX));
        let mut end = 0;
        for stretch in stretches {
            let length = u32::try_from(stretch.len()).unwrap_or(u32::MAX);
            number(&mut out, stretch[0].1 - end);
            number(&mut out, length);
            end = stretch[0].1 + length;
        }
    }
    out
}

fn number(out: &mut String, mut n: u32) {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    loop {
        let more = n >= 32;
        let digit = n % 32 + if more { 32 } else { 0 };
        out.push(char::from(DIGITS[digit as usize]));
        if !more {
            return;
        }
        n /= 32;
    }
}

/// Red, green, blue and opacity of every shade, as the script wants them.
fn shades() -> Value {
    let shade = |k: u8| {
        let (hex, opacity) = Shade(k).colour().unwrap_or(("#000000", 0.0));
        let part = |at: usize| u8::from_str_radix(&hex[at..at + 2], 16).unwrap_or(0);
        json!([part(1), part(3), part(5), (opacity * 255.0).round()])
    };
    (0..shade::COUNT).map(shade).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_short() {
        assert_eq!(runs(vec![]), "");
        // Shade 1, one run: at 0, three long.
        assert_eq!(runs(vec![(1, 0), (1, 1), (1, 2)]), "BBAD");
        // A run at 40 (8 + 32, then 1), and one two further on.
        assert_eq!(runs(vec![(2, 43), (2, 40)]), "CCoBBCB");
    }

    #[test]
    fn nothing_ends_the_script_early() {
        use crate::{Picture, Reel, Shot};
        let mut reel = Reel::of(Picture::new(2, 2));
        reel.push(Shot {
            words: "</script><b>".to_owned(),
            ..Shot::default()
        });
        let page = Film::new("</title><script>x", vec![reel]).html([100, 100], 5.0);
        assert_eq!(page.matches("</script>").count(), 2);
        assert_eq!(page.matches("</title>").count(), 1);
    }
}
