//! Colours after Okabe and Ito, "Color Universal Design" (2008).

/// Paths, in the order they are added.
pub(crate) const PATHS: [&str; 5] = ["#d55e00", "#009e73", "#cc79a7", "#e69f00", "#000000"];
/// Lines and marks of charts, red, green and blue, in the order they are added.
pub const SERIES: [(u8, u8, u8); 8] = [
    (0xd5, 0x5e, 0x00),
    (0x00, 0x72, 0xb2),
    (0x00, 0x9e, 0x73),
    (0xcc, 0x79, 0xa7),
    (0xe6, 0x9f, 0x00),
    (0x56, 0xb4, 0xe9),
    (0x00, 0x00, 0x00),
    (0x8a, 0x91, 0x9c),
];
pub(crate) const DASHED: &str = "#0072b2";
pub(crate) const START: &str = "#009e73";
pub(crate) const GOAL: &str = "#0072b2";
pub(crate) const NEW_BLOCKED: &str = "#cc79a7";
pub(crate) const NEW_FREE: &str = "#f0e442";
pub(crate) const NEW_COST: &str = "#e69f00";

pub(crate) const FREE: &str = "#ffffff";
pub(crate) const INFLATED: &str = "#d9dde3";
pub(crate) const FRAME: &str = "#8a919c";
pub(crate) const TEXT: &str = "#24292f";

/// Blocked cells: all, and on a map drawn coarser than its cells the parts of one in four.
pub(crate) const BLOCKED: [&str; 4] = ["#b9bfc8", "#8a919c", "#5d646e", "#2f343b"];

/// Cells that a world's obstacles block: unlike the tint of what is too near, which they cover.
pub(crate) const BLOCKED_CELL: &str = "#c49c4c";

/// Terrain from cheap to dear.
pub(crate) const TERRAIN: [&str; 6] = [
    "#fbf3df", "#f3e3bb", "#e8cf95", "#d8b76f", "#c49c4c", "#a87d30",
];

/// Expanded cells from the first to the last.
pub(crate) const HEAT: [&str; 8] = [
    "#e8f4fb", "#d3eaf8", "#bce0f4", "#a3d3ee", "#88c4e6", "#6cb2da", "#4f9dca", "#3586b6",
];

/// Clearance along a path from the least to the greatest.
pub(crate) const CLEARANCE: [&str; 5] = ["#d55e00", "#e69f00", "#f0e442", "#56b4e9", "#0072b2"];

/// What a planner knows, below what it found.
pub(crate) const THREAD: &str = "#4f9dca";

/// Numbers from the least to the greatest: viridis (Smith, van der Walt 2015), from its light end.
pub(crate) const LEVELS: [&str; 16] = [
    "#fde725", "#d2e21b", "#a5db36", "#7ad151", "#54c568", "#35b779", "#22a884", "#1f988b",
    "#23888e", "#2a788e", "#31688e", "#39568c", "#414487", "#472f7d", "#481a6c", "#440154",
];

/// Cells that nobody has seen.
pub(crate) const UNSEEN: &str = "#e3e6ea";

/// An attempt among many.
pub(crate) const TRY: &str = "#5d646e";

/// Robots of a team, in their order.
pub(crate) const ROBOTS: [&str; 6] = [
    "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
];
