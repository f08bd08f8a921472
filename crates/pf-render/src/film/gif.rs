//! Films as GIF.
//!
//! The ground of a reel is drawn once, with the text below it. A frame repaints the cells that
//! changed and draws its few things over them; the file holds the rectangle that differs from the
//! frame before, and in it only the pixels that do.

use crate::{
    film::{Film, Shade, quantise, quantise::Census, shade, sheet::Sheet},
    png::{Drawer, NoPicture},
};
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use resvg::tiny_skia::Pixmap;

/// Frames in which colours are counted.
const SAMPLES: usize = 8;
/// The number of no colour.
const CLEAR: u8 = 255;
/// How long the last frame stays, in hundredths of a second.
const LAST: u16 = 200;

impl Film {
    /// The film as a GIF of that width and height in pixels that plays over and over; `fps` is
    /// frames a second.
    ///
    /// # Errors
    /// [`NoPicture`] if there is no frame, or one cannot be drawn.
    pub fn gif(&self, size: [u16; 2], fps: f64) -> Result<Vec<u8>, NoPicture> {
        self.gif_while(size, fps, || true)
    }

    /// The same as long as it is wanted, which is asked at every frame.
    ///
    /// # Errors
    /// As [`gif`](Self::gif), and if it is not wanted any more.
    pub fn gif_while(
        &self,
        size: [u16; 2],
        fps: f64,
        wanted: impl Fn() -> bool,
    ) -> Result<Vec<u8>, NoPicture> {
        let frames = self.frames();
        let mut census = Census::new();
        let every = frames.div_ceil(SAMPLES).max(1);
        // The last frame of each stretch: there is most to see in it.
        let sampled = |k: usize| (k + 1).is_multiple_of(every) || k + 1 == frames;
        let go_on = || {
            let stopped = || NoPicture("it is not wanted any more".to_owned());
            wanted().then_some(()).ok_or_else(stopped)
        };
        let painter = Painter::of(self, size)?;
        painter.play(sampled, |_, pixels| {
            go_on()?;
            census.take(pixels.data());
            Ok(())
        })?;
        let mut palette = census.palette();
        let bad = |error: gif::EncodingError| NoPicture(error.to_string());
        let mut out = Vec::new();
        let colours = palette.colours.concat();
        let mut encoder = Encoder::new(&mut out, size[0], size[1], &colours).map_err(bad)?;
        encoder.set_repeat(Repeat::Infinite).map_err(bad)?;
        let mut before: Vec<u8> = Vec::new();
        painter.play(
            |_| true,
            |k, pixels| {
                go_on()?;
                let colour = |&[r, g, b, _]: &[u8; 4]| palette.of([r, g, b]);
                let now: Vec<u8> = pixels.data().as_chunks().0.iter().map(colour).collect();
                let mut frame = difference(&before, &now, size);
                frame.delay = if k + 1 == frames { LAST } else { delay(k, fps) };
                before = now;
                encoder.write_frame(&frame).map_err(bad)
            },
        )?;
        drop(encoder);
        Ok(out)
    }
}

/// Hundredths of a second for a frame, so that in the mean there are as many frames a second as
/// asked for.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "hundredths of a second, and casts of floats saturate"
)]
fn delay(frame: usize, fps: f64) -> u16 {
    let at = |k: usize| (k as f64 * 100.0 / fps).round() as u64;
    u16::try_from(at(frame + 1) - at(frame)).unwrap_or(u16::MAX)
}

/// The least rectangle that holds all that changed.
fn difference(before: &[u8], now: &[u8], [width, height]: [u16; 2]) -> Frame<'static> {
    let mut frame = Frame {
        width,
        height,
        dispose: DisposalMethod::Keep,
        ..Frame::default()
    };
    if before.is_empty() {
        frame.buffer = now.to_vec().into();
        return frame;
    }
    let wide = usize::from(width);
    let rows = || before.chunks(wide).zip(now.chunks(wide));
    let (mut top, mut bottom, mut left, mut right) = (usize::MAX, 0, wide, 0);
    for (y, (old, new)) in rows().enumerate() {
        let differs = |x: &usize| old[*x] != new[*x];
        let Some(first) = (0..wide).find(differs) else {
            continue;
        };
        let last = (0..wide).rev().find(differs).unwrap_or(first);
        (left, right) = (left.min(first), right.max(last));
        (top, bottom) = (top.min(y), y);
    }
    if top == usize::MAX {
        (top, bottom, left, right) = (0, 0, 0, 0);
    }
    let mut buffer = Vec::with_capacity((right - left + 1) * (bottom - top + 1));
    for (old, new) in rows().skip(top).take(bottom - top + 1) {
        let pixels = old[left..=right].iter().zip(&new[left..=right]);
        buffer.extend(pixels.map(|(a, b)| if a == b { CLEAR } else { *b }));
    }
    let short = |x: usize| u16::try_from(x).unwrap_or(u16::MAX);
    frame.transparent = Some(CLEAR);
    (frame.left, frame.top) = (short(left), short(top));
    (frame.width, frame.height) = (short(right - left + 1), short(bottom - top + 1));
    frame.buffer = buffer.into();
    frame
}

/// Draws one frame after the other.
struct Painter<'a> {
    film: &'a Film,
    sheet: Sheet,
    drawer: Drawer,
    /// What lies still, by reel.
    grounds: Vec<Pixmap>,
}

impl<'a> Painter<'a> {
    fn of(film: &'a Film, size: [u16; 2]) -> Result<Self, NoPicture> {
        let sheet = Sheet::of(film, size.map(f64::from));
        let sheet = sheet.ok_or_else(|| NoPicture("there are no frames".to_owned()))?;
        let drawer = Drawer::new();
        let grounds = (0..film.reels.len()).map(|reel| drawer.pixels(&sheet.still(film, reel)));
        Ok(Self {
            film,
            grounds: grounds.collect::<Result<_, _>>()?,
            sheet,
            drawer,
        })
    }

    /// Shows the frames that are wanted, by their numbers.
    fn play(
        &self,
        wanted: impl Fn(usize) -> bool,
        mut show: impl FnMut(usize, &Pixmap) -> Result<(), NoPicture>,
    ) -> Result<(), NoPicture> {
        let mut number = 0;
        for (reel, ground) in self.film.reels.iter().zip(&self.grounds) {
            let mut cells = ground.clone();
            let tiles = Tiles::of(&self.sheet, reel);
            let top: String = reel.top.iter().map(|t| t.svg(&self.sheet.page)).collect();
            for shot in &reel.shots {
                for &(cell, shade) in &shot.cells {
                    if let Some(block) = reel.block_of(cell) {
                        tiles.paint(&mut cells, ground, block, shade);
                    }
                }
                if wanted(number) {
                    let things = shot.things.iter().map(|t| t.svg(&self.sheet.page));
                    let things: String = things.chain([top.clone()]).collect();
                    let mut pixels = cells.clone();
                    let over = self.sheet.moving(&things, &shot.words);
                    self.drawer.over(&over, &mut pixels)?;
                    show(number, &pixels)?;
                }
                number += 1;
            }
        }
        Ok(())
    }
}

/// Where blocks of cells lie in pixels, and how shades look.
struct Tiles {
    columns: Vec<[usize; 2]>,
    rows: Vec<[usize; 2]>,
    colours: Vec<([u8; 3], u32)>,
}

impl Tiles {
    fn of(sheet: &Sheet, reel: &super::Reel) -> Self {
        let (corner, side) = reel.lattice();
        let pixel = |x: f64, most: f64| whole(x.clamp(0.0, most));
        let [width, height] = sheet.size;
        let place = |k: u32, axis: usize| {
            let mut p = corner;
            p[axis] += side * f64::from(k);
            sheet.page.place(p)[axis] + sheet.corner[axis]
        };
        let span = |axis: usize, most: f64| -> Vec<[usize; 2]> {
            (0..reel.blocks[axis])
                .map(|k| {
                    let ends = [place(k, axis), place(k + 1, axis)];
                    let low = pixel(ends[0].min(ends[1]), most);
                    // As wide as a pixel at least.
                    let high = pixel(ends[0].max(ends[1]), most).max(low + 1);
                    [low, high.min(whole(most))]
                })
                .collect()
        };
        let colour = |k: u8| {
            let (hex, opacity) = Shade(k).colour().unwrap_or(("#000000", 0.0));
            let part = |at: usize| u8::from_str_radix(&hex[at..at + 2], 16).unwrap_or(0);
            let opacity = u32::try_from(whole(opacity * 256.0)).unwrap_or(256);
            ([part(1), part(3), part(5)], opacity)
        };
        Self {
            columns: span(0, width),
            rows: span(1, height),
            colours: (0..shade::COUNT).map(colour).collect(),
        }
    }

    fn paint(&self, cells: &mut Pixmap, ground: &Pixmap, block: u32, shade: Shade) {
        let (block, wide) = (block as usize, ground.width() as usize);
        let [left, right] = self.columns[block % self.columns.len()];
        let [top, bottom] = self.rows[block / self.columns.len()];
        let (colour, opacity) = self.colours[usize::from(shade.0)];
        for y in top..bottom {
            for x in left..right {
                let at = (y * wide + x) * 4;
                for (k, part) in colour.into_iter().enumerate() {
                    let under = u32::from(ground.data()[at + k]);
                    let mixed = (under * (256 - opacity) + u32::from(part) * opacity) / 256;
                    cells.data_mut()[at + k] = u8::try_from(mixed).unwrap_or(255);
                }
            }
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "pixels, and casts of floats saturate"
)]
fn whole(x: f64) -> usize {
    x.round() as usize
}

const _: () = assert!(quantise::COLOURS == CLEAR as usize);

#[cfg(test)]
mod tests {
    use crate::{Film, Look, Picture, Reel, Shade, Shot, Thing};
    use gif::{ColorOutput, DecodeOptions};
    use pf_grid::{Cell, Grid};

    /// A robot that steps east and colours the cell it was in.
    fn film(frames: u32) -> Film {
        let mut reel = Reel::of(Picture::of(&Grid::open(frames, 3).unwrap()));
        for x in 0..frames {
            let look = Look::Robot(0);
            let at = [f64::from(x) + 0.5, 1.5];
            reel.push(Shot {
                cells: vec![(Cell::new(x, 1), Shade::level(1.0))],
                things: vec![Thing::Disc {
                    at,
                    radius: 0.3,
                    look,
                }],
                words: String::new(),
            });
        }
        Film::new("a robot steps east", vec![reel])
    }

    #[test]
    fn frames_hold_only_what_changed() {
        let gif = film(8).gif([320, 200], 7.0).unwrap();
        let mut options = DecodeOptions::new();
        options.set_color_output(ColorOutput::Indexed);
        let mut decoder = options.read_info(&gif[..]).unwrap();
        let mut sizes = Vec::new();
        let mut delays = 0;
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            sizes.push(u32::from(frame.width) * u32::from(frame.height));
            delays += frame.delay;
        }
        assert_eq!((sizes.len(), sizes[0]), (8, 320 * 200));
        // Two cells of 38 pixels.
        assert!(sizes[1..].iter().all(|&size| size < 4000), "{sizes:?}");
        // Seven frames a second in whole hundredths: they add up.
        assert_eq!(delays, 100 + 200);
    }

    #[test]
    fn it_ends_when_it_is_not_wanted() {
        let film = film(8);
        assert!(film.gif_while([320, 200], 7.0, || false).is_err());
        assert!(
            Film::new("nothing", Vec::new())
                .gif([320, 200], 7.0)
                .is_err()
        );
    }

    #[test]
    fn every_size_is_drawn() {
        for size in [[120, 120], [1000, 120], [120, 1000]] {
            assert!(film(60).gif(size, 10.0).is_ok(), "{size:?}");
        }
    }
}
