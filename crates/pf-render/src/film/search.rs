//! What a planner did, as frames.

use crate::{
    Recorder,
    film::{Look, Reel, Shade, Shot, Thing, tape::Sample, tape::Tape},
    palette,
    picture::Key,
};
use pf_grid::Cell;

/// How a search is shown, and how it ended.
#[derive(Clone, Debug, Default)]
pub struct Ending {
    /// The answer, in the map's units.
    pub line: Option<Vec<[f64; 2]>>,
    /// The planner's name, for the legend.
    pub name: String,
    /// What to say in the end.
    pub words: String,
    /// The robot's radius, in the map's units.
    pub radius: f64,
    /// Attempts follow from one another: the latest is the one that counts.
    pub iterates: bool,
    /// What was expanded is the way of a robot, which sees a square with half this side.
    pub window: Option<f64>,
}

/// Points of a world that are shown of all that were expanded, about.
const DOTS: usize = 600;
/// Attempts that are seen at a time.
const TRIES: usize = 4;

impl Reel {
    /// As many frames of what a recorder for animations has heard: first the search, then the
    /// answer, driven from its start to its end. `free` says which cells are free; numbers of
    /// blocked ones are not shown.
    #[must_use]
    pub fn search(
        self,
        recorder: &Recorder,
        frames: usize,
        free: impl Fn(Cell) -> bool,
        ending: &Ending,
    ) -> Self {
        let empty = Tape::new(1, [0, 0]);
        let tape = recorder.tape().unwrap_or(&empty);
        let levels = Levels::of(tape, &free);
        let mut reel = self.described(recorder, tape, &levels, ending);
        let mut play = Play {
            recorder,
            tape,
            ending,
            levels,
            shades: vec![0; reel.blocks[0] as usize * reel.blocks[1] as usize],
            told: 0,
            dots: Vec::new(),
        };
        // What comes before the first iterate is a search for where to begin.
        let tries = tape.tries.all();
        let (first, last, moments) = match (tries.first(), tries.last()) {
            (Some((first, _)), Some((last, _))) if ending.iterates => {
                (first - 1, *last, tries.len())
            }
            _ if ending.iterates => (0, tape.now, 0),
            _ => (0, tape.now, usize::try_from(tape.now).unwrap_or(usize::MAX)),
        };
        let tail = match &ending.line {
            Some(_) => (frames / 5).max(1),
            None => (frames / 12).max(1),
        };
        // What happens in fewer moments than there are frames needs no more of them.
        let searching = frames.saturating_sub(tail).min(moments);
        let tail = frames - searching;
        for k in 1..=searching {
            let shot = play.at(&reel, first + part(last - first, k, searching));
            reel.push(shot);
        }
        for k in 1..=tail {
            // Who has no answer is seen as it stood when it gave up.
            let mut shot = match ending.line {
                Some(_) => play.cells_at(&reel, tape.now),
                None => play.at(&reel, tape.now),
            };
            #[expect(clippy::cast_precision_loss, reason = "a number of frames")]
            play.finish(&mut shot, k as f64 / tail as f64);
            reel.push(shot);
        }
        reel
    }

    fn described(
        mut self,
        recorder: &Recorder,
        tape: &Tape,
        levels: &Levels,
        ending: &Ending,
    ) -> Self {
        if !recorder.expanded().is_empty() {
            let key = Key::Ramp(&palette::HEAT);
            self = self.key(key, "expanded, darker later");
        }
        if let Some(words) = levels.words(tape) {
            self = self.key(Key::Ramp(&palette::LEVELS), &words);
        }
        if !recorder.reached().is_empty() && !ending.iterates {
            self = match ending.window {
                Some(_) => self.explain(Look::Best, "walked"),
                None => self.explain(Look::Reached, "expanded"),
            };
        }
        if ending.window.is_some() {
            self = self.explain(Look::Sensor, "what the robot sees");
        }
        if let Some((_, (name, _))) = tape.points.all().first() {
            self = self.explain(Look::Swarm, name);
        }
        if !tape.tries.all().is_empty() {
            let words = if ending.iterates {
                "iterates"
            } else {
                "attempts"
            };
            self = self.explain(Look::Try, words);
        }
        if tape.better.all().len() > 1 || ending.iterates {
            let words = if ending.iterates {
                "latest"
            } else {
                "best so far"
            };
            self = self.explain(Look::Best, words);
        }
        if ending.line.is_some() {
            self = self.explain(Look::Answer, &ending.name);
        }
        self
    }
}

struct Play<'a> {
    recorder: &'a Recorder,
    tape: &'a Tape,
    ending: &'a Ending,
    levels: Levels,
    /// Of blocks, as they are shown.
    shades: Vec<u8>,
    /// How many expansions were shown.
    told: usize,
    /// Points of a world that were expanded, by frame.
    dots: Vec<Thing>,
}

impl Play<'_> {
    /// The frame at a time.
    fn at(&mut self, reel: &Reel, now: u64) -> Shot {
        let mut shot = self.cells_at(reel, now);
        let things = &mut shot.things;
        let tries = self.tape.tries.until(now);
        let place = |line: &[[f64; 2]]| self.placed(reel, line);
        for (_, line) in &tries[tries.len().saturating_sub(TRIES)..] {
            things.push(Thing::Line {
                points: place(line),
                look: Look::Try,
            });
        }
        // Of a planner that announces one solution alone, that is the answer.
        let several = self.tape.better.all().len() > 1;
        let best = match self.tape.better.until(now).last() {
            Some((_, better)) if several => Some(&better.line),
            None if self.ending.iterates => tries.last().map(|(_, line)| line),
            _ => None,
        };
        if let Some(line) = best.filter(|line| line.len() > 1) {
            things.push(Thing::Line {
                points: place(line),
                look: Look::Best,
            });
        }
        if let Some((_, (_, points))) = self.tape.points.until(now).last() {
            things.push(Thing::Dots {
                points: place(points),
                look: Look::Swarm,
            });
        }
        shot.words = self.words(now);
        shot
    }

    /// Cells and points as they are at a time.
    fn cells_at(&mut self, reel: &Reel, now: u64) -> Shot {
        let count = self.tape.expanded_at.partition_point(|&at| at <= now);
        let mut shot = Shot::default();
        match self.tape.fields.until(now).last() {
            Some((_, sample)) => self.paint(reel, sample, &mut shot),
            None => self.expand(reel, count, &mut shot),
        }
        let reached = self.recorder.reached();
        if let Some(half) = self.ending.window {
            walker(
                &reached[..count.min(reached.len())],
                half,
                self.ending.radius,
                reel,
                &mut shot,
            );
        } else if let Some(new) = reached.get(self.told..count)
            && !new.is_empty()
            && !self.ending.iterates
        {
            let step = reached.len().div_ceil(DOTS);
            let points = new.iter().step_by(step).copied().collect();
            self.dots.push(Thing::Dots {
                points,
                look: Look::Reached,
            });
        }
        self.told = count.max(self.told);
        shot.things.extend(self.dots.iter().cloned());
        shot
    }

    fn expand(&mut self, reel: &Reel, count: usize, shot: &mut Shot) {
        let order = self.recorder.expanded();
        for (k, &cell) in order.iter().enumerate().take(count).skip(self.told) {
            #[expect(clippy::cast_precision_loss, reason = "a shade needs no precision")]
            let shade = Shade::expanded(k as f64 / order.len() as f64);
            self.shade(reel, cell, shade, shot);
        }
    }

    fn paint(&mut self, reel: &Reel, sample: &Sample, shot: &mut Shot) {
        let corners = Tape::corners(self.tape.size, self.tape.block);
        for ([x, y], k) in corners.zip(0..) {
            let shade = self.levels.shade(sample, k);
            self.shade(reel, Cell { x, y }, shade, shot);
        }
    }

    fn shade(&mut self, reel: &Reel, cell: Cell, shade: Shade, shot: &mut Shot) {
        let block = reel.block_of(cell);
        if let Some(now) = block.and_then(|block| self.shades.get_mut(block as usize))
            && *now != shade.0
        {
            *now = shade.0;
            shot.cells.push((cell, shade));
        }
    }

    /// A line of what was heard in the map's units.
    fn placed(&self, reel: &Reel, line: &[[f64; 2]]) -> Vec<[f64; 2]> {
        if !self.tape.in_cells {
            return line.to_vec();
        }
        let lattice = reel.ground.lattice;
        let place = |p: &[f64; 2]| [0, 1].map(|k| lattice.corner[k] + lattice.side * p[k]);
        line.iter().map(place).collect()
    }

    fn words(&self, now: u64) -> String {
        let mut words = Vec::new();
        if !self.tape.expanded_at.is_empty() && !self.ending.iterates {
            words.push(match self.ending.window {
                Some(_) => counted(self.told, "step"),
                None => format!("{} expanded", grouped(self.told)),
            });
        }
        let tried = self.tape.tries.offered(now);
        if tried > 0 {
            let what = if self.ending.iterates {
                "iterate"
            } else {
                "attempt"
            };
            words.push(counted(tried, what));
        }
        if let (Some((_, better)), true) = (
            self.tape.better.until(now).last(),
            self.tape.better.all().len() > 1,
        ) {
            words.push(format!("best {:.2}", better.cost));
        }
        words.join(", ")
    }

    /// The answer as far as a part of its length.
    fn finish(&self, shot: &mut Shot, part: f64) {
        shot.words.clone_from(&self.ending.words);
        let Some(line) = &self.ending.line else {
            return;
        };
        let points = up_to(line, part);
        if let (Some(&at), true) = (points.last(), self.ending.radius > 0.0) {
            shot.things.push(Thing::Disc {
                at,
                radius: self.ending.radius,
                look: Look::Answer,
            });
        }
        shot.things.push(Thing::Line {
            points,
            look: Look::Answer,
        });
    }
}

/// A robot's way, and what it sees.
fn walker(way: &[[f64; 2]], half: f64, radius: f64, reel: &Reel, shot: &mut Shot) {
    let start = reel.top.iter().find_map(|thing| match thing {
        Thing::Start(at) => Some(*at),
        _ => None,
    });
    let points: Vec<_> = start.into_iter().chain(way.iter().copied()).collect();
    let Some(&at) = points.last() else { return };
    shot.things.push(Thing::Window {
        at,
        half,
        look: Look::Sensor,
    });
    shot.things.push(Thing::Line {
        points,
        look: Look::Best,
    });
    shot.things.push(Thing::Disc {
        at,
        radius,
        look: Look::Best,
    });
}

/// The first part of a line, by its length.
pub(crate) fn up_to(line: &[[f64; 2]], part: f64) -> Vec<[f64; 2]> {
    let far = |a: [f64; 2], b: [f64; 2]| (b[0] - a[0]).hypot(b[1] - a[1]);
    let all: f64 = line.windows(2).map(|w| far(w[0], w[1])).sum();
    let mut left = all * part;
    let mut points: Vec<_> = line.first().copied().into_iter().collect();
    for w in line.windows(2) {
        let step = far(w[0], w[1]);
        if step > left && part < 1.0 {
            let t = left / step;
            points.push([0, 1].map(|k| w[0][k] + t * (w[1][k] - w[0][k])));
            return points;
        }
        left -= step;
        points.push(w[1]);
    }
    points
}

fn part(all: u64, k: usize, of: usize) -> u64 {
    let share = u128::from(all) * k as u128 / (of as u128).max(1);
    u64::try_from(share).unwrap_or(all)
}

/// So many of something.
fn counted(n: usize, what: &str) -> String {
    let many = if n == 1 { "" } else { "s" };
    format!("{} {what}{many}", grouped(n))
}

/// With a comma at every third digit.
fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

/// How numbers become shades: the same for all frames.
struct Levels {
    low: f64,
    high: f64,
    log: bool,
    free: Vec<bool>,
}

impl Levels {
    /// From the least number to the greatest, but for one in fifty at either end.
    fn of(tape: &Tape, free: &impl Fn(Cell) -> bool) -> Self {
        let mut levels = Self {
            low: 0.0,
            high: 1.0,
            log: false,
            free: Vec::new(),
        };
        let samples = tape.fields.all();
        if samples.is_empty() {
            return levels;
        }
        let corners = Tape::corners(tape.size, tape.block);
        levels.free = corners.map(|[x, y]| free(Cell { x, y })).collect();
        let mut values: Vec<f32> = Vec::new();
        for (_, sample) in samples.iter().step_by(samples.len().div_ceil(8)) {
            let free = sample.values.iter().zip(&levels.free);
            let known = free.filter(|(value, free)| **free && value.is_finite());
            values.extend(known.map(|(value, _)| *value));
        }
        values.sort_unstable_by(f32::total_cmp);
        let Some(last) = values.len().checked_sub(1) else {
            return levels;
        };
        let (mut low, mut high) = (values[last / 50], values[last - last / 50]);
        if low >= high {
            (low, high) = (values[0], values[last]);
        }
        (levels.low, levels.high) = (f64::from(low), f64::from(high));
        levels.log = low > 0.0 && high / low > 50.0;
        levels
    }

    fn shade(&self, sample: &Sample, block: usize) -> Shade {
        let value = sample.values.get(block).copied().unwrap_or(f32::NAN);
        if !value.is_finite() || !self.free.get(block).copied().unwrap_or(false) {
            return Shade::NONE;
        }
        let value = f64::from(value);
        let scaled = if self.log {
            (value.max(self.low) / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low).max(f64::MIN_POSITIVE)
        };
        Shade::level(scaled)
    }

    fn words(&self, tape: &Tape) -> Option<String> {
        let (_, sample) = tape.fields.all().first()?;
        let scale = if self.log { " (log)" } else { "" };
        // As many digits as tell the two apart.
        let apart = (self.high - self.low)
            .max(f64::MIN_POSITIVE)
            .log10()
            .floor();
        let number = |x: f64| {
            if x != 0.0 && x.abs() < 0.01 {
                return format!("{x:.1e}");
            }
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a few digits"
            )]
            let digits = (1.0 - apart).clamp(0.0, 6.0) as usize;
            format!("{x:.digits$}")
        };
        let (low, high) = (number(self.low), number(self.high));
        Some(format!("{} {low} to {high}{scale}", sample.name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_followed_by_its_length() {
        let line = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]];
        let ends = |part| up_to(&line, part).last().unwrap().map(f64::to_bits);
        assert_eq!(ends(0.25), [1.0, 0.0].map(f64::to_bits));
        assert_eq!(ends(0.75), [2.0, 1.0].map(f64::to_bits));
        assert_eq!(up_to(&line, 1.0), line);
        assert_eq!(up_to(&[], 0.5), Vec::<[f64; 2]>::new());
    }

    #[test]
    fn counts_are_grouped() {
        assert_eq!(
            [7, 1234, 1_234_567].map(grouped),
            ["7", "1,234", "1,234,567"]
        );
    }
}
