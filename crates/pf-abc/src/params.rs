//! What can be set.

use pf_core::{InvalidParams, params, words};

/// How far it is to the goal (f1, eq. 1; the text at hand shows neither squares nor root).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distance {
    /// As the crow flies.
    Euclidean,
    /// Along the axes.
    Manhattan,
}

/// What is bad about being near obstacles (f2), by four rays along the axes, as long as the window
/// reaches. The text at hand has lost eq. 2 and 3, so there are two readings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum F2 {
    /// For each ray that hits something, how much of the ray is left: near is bad.
    PushBack,
    /// For each ray that hits something, how far it goes: far is bad, and nothing is best.
    PaperPlus,
}

/// What has to be free for a place to be feasible.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Check {
    /// The way from here to there.
    Segment,
    /// The place alone, as in the paper: a step can lead through a wall.
    Point,
}

/// Who gives up a food source that nobody can improve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scouts {
    /// At most one source a cycle, that which failed most often.
    One,
    /// Every source that failed too often, as in the paper.
    All,
}

/// How a [`Colony`](crate::Colony) walks. The default is ours, [`paper`](Self::paper) the paper's.
#[derive(Clone, Debug, PartialEq)]
pub struct AbcParams {
    /// How far the robot sees to each side, H, in the world's unit.
    pub half: f64,
    /// How many food sources, N.
    pub sources: usize,
    /// How often employed bees, onlookers and scouts fly in a step, I; 0 takes the best of the
    /// first sources.
    pub cycles: u32,
    /// After how many steps it gives up, M.
    pub steps: u64,
    /// The weight of the distance to the goal, by the world's unit.
    pub w1: f64,
    /// The weight of obstacles near, by the world's unit.
    pub w2: f64,
    /// The weight of a turn, by the degree.
    pub w3: f64,
    /// The weight of places visited before; 0 is no memory.
    pub memory: f64,
    /// How far a visited place is felt, in units of `half`.
    pub reach: f64,
    /// After how many steps a place counts as visited before. At 0 the robot shuns the place where
    /// it is and zigzags through open ground.
    pub delay: usize,
    /// How far it is to the goal.
    pub distance: Distance,
    /// What is bad about obstacles.
    pub f2: F2,
    /// What has to be free.
    pub check: Check,
    /// Who gives up sources.
    pub scouts: Scouts,
    /// After how many failures, in units of `sources`.
    pub limit: f64,
}

impl Default for AbcParams {
    fn default() -> Self {
        Self {
            steps: 2000,
            memory: 2.0,
            reach: 3.0,
            delay: 2,
            check: Check::Segment,
            scouts: Scouts::One,
            limit: 1.0,
            ..Self::paper()
        }
    }
}

params!(AbcParams {
    half: f64 = "how far the robot sees to each side",
    sources: usize = "how many food sources",
    cycles: u32 = "how often the bees fly in a step",
    steps: u64 = "after how many steps it gives up",
    w1: f64 = "the weight of the distance to the goal",
    w2: f64 = "the weight of obstacles near",
    w3: f64 = "the weight of a turn, by the degree",
    memory: f64 = "the weight of places visited before; 0 is no memory",
    reach: f64 = "how far a visited place is felt, in units of half",
    delay: usize = "after how many steps a place counts as visited before",
    distance: Distance = "euclidean or manhattan",
    f2: F2 = "push-back (near obstacles are bad) or paper-plus (far ones are)",
    check: Check = "segment (the way must be free) or point (the place alone, the paper's)",
    scouts: Scouts = "one (a cycle) or all (that failed too often, the paper's)",
    limit: f64 = "after how many failures a source is given up, in units of sources",
});

impl AbcParams {
    /// The paper's, with its best weights on both maps and without memory. The number of sources
    /// and the size of the region are not published.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            half: 2.0,
            sources: 10,
            cycles: 8,
            steps: 200,
            w1: 1.0,
            w2: 0.0,
            w3: 0.0,
            memory: 0.0,
            reach: 3.0,
            delay: 0,
            distance: Distance::Euclidean,
            f2: F2::PushBack,
            check: Check::Point,
            scouts: Scouts::All,
            limit: 2.0,
        }
    }

    /// The same with these weights of distance, obstacles and turns.
    #[must_use]
    pub fn weighing(self, [w1, w2, w3]: [f64; 3]) -> Self {
        Self { w1, w2, w3, ..self }
    }

    /// How many failures are too many.
    #[expect(clippy::cast_precision_loss, reason = "a number of sources")]
    pub(crate) fn too_many(&self) -> f64 {
        self.limit * self.sources as f64
    }

    /// Refuses what makes no sense.
    pub(crate) fn check(&self) -> Result<(), InvalidParams> {
        InvalidParams::unless_whole("sources", self.sources, 2..=100_000)?;
        InvalidParams::unless_whole("cycles", self.cycles, 0..=100_000)?;
        InvalidParams::unless_whole("delay", self.delay, 0..=1000)?;
        let positive = self.half > 0.0 && self.half.is_finite();
        InvalidParams::unless("half", self.half, positive, "a positive number")?;
        let fine = (0.25..=16.0).contains(&self.reach);
        InvalidParams::unless("reach", self.reach, fine, "a number from 0.25 to 16")?;
        for (key, value) in [
            ("w1", self.w1),
            ("w2", self.w2),
            ("w3", self.w3),
            ("memory", self.memory),
            ("limit", self.limit),
        ] {
            let fine = value >= 0.0 && value.is_finite();
            InvalidParams::unless(key, value, fine, "a number from 0")?;
        }
        Ok(())
    }
}

words!(Distance { "euclidean" = Euclidean, "manhattan" = Manhattan });
words!(F2 { "push-back" = PushBack, "paper-plus" = PaperPlus });
words!(Check { "segment" = Segment, "point" = Point });
words!(Scouts { "one" = One, "all" = All });
