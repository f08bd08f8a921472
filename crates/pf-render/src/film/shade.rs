//! What colours of cells mean.

use crate::{palette, picture::bin};

/// How a cell looks. Parts go from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shade(pub(crate) u8);

const EXPANDED: u8 = 1;
const LEVEL: u8 = 9;
const UNSEEN: u8 = 25;
const BLOCKED: u8 = 26;
const TERRAIN: u8 = 27;
/// How many shades there are, none included.
pub(crate) const COUNT: u8 = 33;

impl Shade {
    /// As the ground is.
    pub const NONE: Self = Self(0);
    /// Nobody has seen it.
    pub const UNSEEN: Self = Self(UNSEEN);
    /// Seen, and blocked.
    pub const BLOCKED: Self = Self(BLOCKED);

    /// Expanded, at this part of the search.
    #[must_use]
    pub fn expanded(when: f64) -> Self {
        Self(EXPANDED + bin(when, palette::HEAT.len()))
    }

    /// A number between the least and the greatest.
    #[must_use]
    pub fn level(part: f64) -> Self {
        Self(LEVEL + bin(part, palette::LEVELS.len()))
    }

    /// Seen, and dear to cross: from cheap to dear.
    #[must_use]
    pub fn terrain(part: f64) -> Self {
        Self(TERRAIN + bin(part, palette::TERRAIN.len()))
    }

    /// Its colour and how opaque it is; `None` for none.
    pub(crate) fn colour(self) -> Option<(&'static str, f64)> {
        let of = |colours: &[&'static str], first| colours[usize::from(self.0 - first)];
        match self.0 {
            0 | COUNT.. => None,
            k if k < LEVEL => Some((of(&palette::HEAT, EXPANDED), 0.8)),
            k if k < UNSEEN => Some((of(&palette::LEVELS, LEVEL), 0.85)),
            UNSEEN => Some((palette::UNSEEN, 1.0)),
            BLOCKED => Some((palette::BLOCKED[3], 1.0)),
            _ => Some((of(&palette::TERRAIN, TERRAIN), 1.0)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shade_has_a_colour_of_its_own() {
        let colours: Vec<_> = (0..COUNT).filter_map(|k| Shade(k).colour()).collect();
        assert_eq!(colours.len(), usize::from(COUNT) - 1);
        for (k, colour) in colours.iter().enumerate() {
            assert!(!colours[..k].contains(colour), "{colour:?}");
        }
        assert_eq!(Shade::expanded(1.0), Shade(LEVEL - 1));
        assert_eq!(Shade::level(1.0), Shade(UNSEEN - 1));
        assert_eq!(Shade::terrain(1.0), Shade(COUNT - 1));
    }
}
