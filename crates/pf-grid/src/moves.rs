use std::{fmt, str::FromStr};

/// The eight directions as (dx, dy): east, south, west, north, then the diagonals so that
/// direction `4 + i` lies between the straight directions `i` and `(i + 1) % 4`.
///
/// A set of directions is a byte, bit `i` for direction `i`.
pub const DIRECTIONS: [(i32, i32); 8] = [
    (1, 0),
    (0, 1),
    (-1, 0),
    (0, -1),
    (1, 1),
    (-1, 1),
    (-1, -1),
    (1, -1),
];

/// Which steps between free cells a problem allows.
///
/// The rules for diagonal steps are those users know from `PathFinding.js`; they differ in how many
/// of the two cells beside the step may be blocked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Moves {
    /// No diagonal step: four-connected (`Never`).
    Orthogonal,
    /// Both may be blocked: an obstacle severs only its own connections.
    Always,
    /// At most one may be blocked.
    IfAtMostOneObstacle,
    /// Neither may be blocked: no corner is cut. Moving AI's rule.
    #[default]
    OnlyWhenNoObstacles,
}

impl Moves {
    /// Every rule.
    pub const ALL: [Self; 4] = [
        Self::Orthogonal,
        Self::Always,
        Self::IfAtMostOneObstacle,
        Self::OnlyWhenNoObstacles,
    ];

    /// The name on the command line and in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Orthogonal => "orthogonal",
            Self::Always => "always",
            Self::IfAtMostOneObstacle => "one-corner",
            Self::OnlyWhenNoObstacles => "no-corner-cutting",
        }
    }

    /// The directions one may step in from a free cell, given those in which the neighbour is
    /// free.
    #[must_use]
    pub const fn legal(self, around: u8) -> u8 {
        let straight = around & 0x0f;
        let first = straight << 4;
        // The other cell beside diagonal 4 + i is straight direction (i + 1) % 4.
        let second = (straight >> 1 | straight << 3) << 4;
        let passable = match self {
            Self::Orthogonal => 0,
            Self::Always => 0xf0,
            Self::IfAtMostOneObstacle => first | second,
            Self::OnlyWhenNoObstacles => first & second,
        };
        straight | around & passable & 0xf0
    }
}

impl fmt::Display for Moves {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Moves {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .into_iter()
            .find(|moves| moves.name() == text)
            .ok_or("expected orthogonal, always, one-corner or no-corner-cutting")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn diagonals_lie_between_their_straight_neighbours() {
        for i in 0..4 {
            let ((ax, ay), (bx, by)) = (DIRECTIONS[i], DIRECTIONS[(i + 1) % 4]);
            assert_eq!(DIRECTIONS[4 + i], (ax + bx, ay + by));
        }
    }

    #[test]
    fn the_rules_differ_by_the_blocked_cells_beside_a_diagonal() {
        for around in 0..=255u8 {
            let free = |k: usize| around >> k & 1 == 1;
            for i in 0..4 {
                let blocked = u8::from(!free(i)) + u8::from(!free((i + 1) % 4));
                let goes = |moves: Moves| moves.legal(around) >> (4 + i) & 1 == 1;
                assert!(!goes(Moves::Orthogonal));
                assert_eq!(goes(Moves::Always), free(4 + i));
                assert_eq!(goes(Moves::IfAtMostOneObstacle), free(4 + i) && blocked < 2);
                assert_eq!(
                    goes(Moves::OnlyWhenNoObstacles),
                    free(4 + i) && blocked == 0
                );
            }
        }
    }
}
