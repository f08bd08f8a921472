//! What a place is worth: the guided function, and Deb's rules.

use crate::{
    AbcParams,
    memory::Memory,
    params::{Check, Distance, F2},
};
use pf_geom::{Observation, Point, Vector, cross};

/// What all places in a window are measured by.
pub(crate) struct Guide<'a> {
    pub(crate) params: &'a AbcParams,
    pub(crate) memory: &'a Memory,
    /// The last step that led elsewhere; null before the first.
    pub(crate) heading: Vector,
    pub(crate) seen: &'a Observation,
}

/// What a place is worth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Worth {
    /// How many obstacles are entered.
    pub(crate) entered: u32,
    /// The guided function, eq. 4; the less the better. Where something is entered nobody asks.
    pub(crate) phi: f64,
}

impl Worth {
    /// Eq. 9.
    pub(crate) fn fitness(&self) -> f64 {
        if self.phi >= 0.0 {
            1.0 / (1.0 + self.phi)
        } else {
            1.0 + self.phi.abs()
        }
    }

    /// Deb's rules: fewer obstacles entered, and where none is, the better fitness.
    pub(crate) fn beats(&self, other: &Self) -> bool {
        match (self.entered, other.entered) {
            (0, 0) => self.phi < other.phi,
            (mine, theirs) => mine < theirs,
        }
    }
}

impl Guide<'_> {
    pub(crate) fn worth(&self, place: Point) -> Worth {
        let from = match self.params.check {
            Check::Segment => self.seen.here(),
            Check::Point => place,
        };
        let entered = u32::try_from(self.seen.entered(from, place)).unwrap_or(u32::MAX);
        let phi = if entered == 0 { self.phi(place) } else { 0.0 };
        Worth { entered, phi }
    }

    /// Eq. 4, and what is remembered. Terms without weight are not looked at.
    fn phi(&self, place: Point) -> f64 {
        let AbcParams { w1, w2, w3, .. } = *self.params;
        let mut phi = w1 * self.distance(place);
        if w2 > 0.0 {
            phi += w2 * self.nearness(place);
        }
        if w3 > 0.0 {
            phi += w3 * self.turn(place);
        }
        if self.params.memory > 0.0 {
            phi += self.params.memory * self.memory.height(place);
        }
        phi
    }

    /// f1, eq. 1.
    fn distance(&self, place: Point) -> f64 {
        let to_goal = self.seen.goal() - place;
        match self.params.distance {
            Distance::Euclidean => to_goal.norm(),
            Distance::Manhattan => to_goal.abs().sum(),
        }
    }

    /// f2.
    fn nearness(&self, place: Point) -> f64 {
        let reach = self.params.half;
        let hits = self.seen.axis_rays(place, reach).into_iter().flatten();
        match self.params.f2 {
            F2::PushBack => hits.map(|hit| reach - hit).sum(),
            F2::PaperPlus => hits.sum(),
        }
    }

    /// f3, in degrees: in radians it would have no effect at the paper's weights. 0 on the first
    /// step, and for a step that leads nowhere.
    fn turn(&self, place: Point) -> f64 {
        let ahead = place - self.seen.here();
        let across = cross(self.heading, ahead).abs();
        across.atan2(self.heading.dot(&ahead)).to_degrees()
    }
}
