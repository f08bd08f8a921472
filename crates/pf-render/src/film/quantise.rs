//! A palette of few colours for many frames.

/// Colours of a palette; one number more stands for none.
pub(crate) const COLOURS: usize = 255;
/// Five bits of red, green and blue.
const BINS: usize = 1 << 15;

/// Counts colours.
pub(crate) struct Census {
    counts: Vec<u32>,
    sums: Vec<[u64; 3]>,
}

/// The colours that were seen most, and for every colour the nearest of them.
pub(crate) struct Palette {
    pub(crate) colours: Vec<[u8; 3]>,
    nearest: Vec<Option<u8>>,
}

impl Census {
    pub(crate) fn new() -> Self {
        Self {
            counts: vec![0; BINS],
            sums: vec![[0; 3]; BINS],
        }
    }

    /// Counts the pixels of a picture, four bytes each.
    pub(crate) fn take(&mut self, pixels: &[u8]) {
        for &[r, g, b, _] in pixels.as_chunks().0 {
            let bin = bin([r, g, b]);
            self.counts[bin] = self.counts[bin].saturating_add(1);
            for (sum, part) in self.sums[bin].iter_mut().zip([r, g, b]) {
                *sum += u64::from(part);
            }
        }
    }

    pub(crate) fn palette(self) -> Palette {
        let mut bins: Vec<usize> = (0..BINS).filter(|&bin| self.counts[bin] > 0).collect();
        bins.sort_by_key(|&bin| (std::cmp::Reverse(self.counts[bin]), bin));
        bins.truncate(COLOURS);
        let mean = |bin: usize| {
            let count = u64::from(self.counts[bin].max(1));
            self.sums[bin].map(|sum| u8::try_from((sum + count / 2) / count).unwrap_or(255))
        };
        Palette {
            colours: bins.into_iter().map(mean).collect(),
            nearest: vec![None; BINS],
        }
    }
}

impl Palette {
    /// The number of the colour nearest to one.
    pub(crate) fn of(&mut self, colour: [u8; 3]) -> u8 {
        let bin = bin(colour);
        if let Some(known) = self.nearest[bin] {
            return known;
        }
        let far = |other: &[u8; 3]| -> u32 {
            let parts = other.iter().zip(colour);
            parts.map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
        };
        let found = (0u8..).zip(&self.colours).min_by_key(|(_, c)| far(c));
        let found = found.map_or(0, |(k, _)| k);
        self.nearest[bin] = Some(found);
        found
    }
}

fn bin([r, g, b]: [u8; 3]) -> usize {
    usize::from(r >> 3) << 10 | usize::from(g >> 3) << 5 | usize::from(b >> 3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_colours_seen_most_are_kept_as_they_are() {
        let mut census = Census::new();
        let mut pixels = [[213u8, 94, 0, 255]; 40].concat();
        pixels.extend([[255u8; 4]; 60].concat());
        for k in 0..=255u8 {
            pixels.extend([k, 255 - k, k / 2, 255]);
        }
        census.take(&pixels);
        let mut palette = census.palette();
        assert!(palette.colours.len() <= COLOURS);
        let near = |palette: &mut Palette, colour| {
            let k = palette.of(colour);
            palette.colours[usize::from(k)]
        };
        assert_eq!(near(&mut palette, [213, 94, 0]), [213, 94, 0]);
        let white = near(&mut palette, [255; 3]);
        assert!(white.iter().all(|&part| part > 252), "{white:?}");
        let blue = near(&mut palette, [0, 0, 255]);
        assert!(palette.colours.contains(&blue));
    }
}
