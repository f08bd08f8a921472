//! Draws the floor plan of an office: `maps/grids/office.yaml` and `office.pgm`.
//!
//! A cell is 5 cm. Rectangles are `[left, top, right, bottom]`, right and bottom not included.

use pf_io::{FileError, Frame, RosMap, RosMode, write_gray, write_ros_yaml};
use std::path::Path;

/// Columns of the plan.
pub(crate) const WIDTH: u32 = 400;
/// Rows of the plan.
pub(crate) const HEIGHT: u32 = 300;

const OCCUPIED: u8 = 0;
const UNKNOWN: u8 = 205;
const FREE: u8 = 254;

/// A door is 90 cm wide.
const DOOR: u32 = 18;

type Rect = [u32; 4];

/// The outer walls' outline, but for the light well.
const BUILDING: Rect = [10, 10, 390, 290];
const LIGHT_WELL: Rect = [199, 10, 259, 57];

/// Rooms by name: what lies inside their walls.
pub(crate) const ROOMS: [(&str, Rect); 21] = [
    ("director", [15, 15, 83, 108]),
    ("office 1", [86, 15, 136, 108]),
    ("office 2", [139, 15, 194, 108]),
    ("print room", [197, 62, 261, 108]),
    ("office 3", [264, 15, 312, 108]),
    ("meeting room", [315, 15, 385, 108]),
    ("corridor", [15, 111, 385, 137]),
    ("open-plan area", [15, 140, 165, 285]),
    ("focus room", [15, 212, 64, 256]),
    ("phone booth 1", [15, 259, 38, 285]),
    ("phone booth 2", [41, 259, 64, 285]),
    ("kitchen", [168, 140, 256, 182]),
    ("washroom 1", [168, 185, 210, 225]),
    ("washroom 2", [213, 185, 256, 225]),
    ("service closet", CLOSET),
    ("server room", [193, 228, 256, 252]),
    ("storage", [168, 255, 256, 285]),
    ("office 4", [288, 140, 335, 184]),
    ("office 5", [338, 140, 385, 184]),
    ("project room", [288, 187, 385, 229]),
    ("lobby", [259, 232, 385, 285]),
];

/// It has no door: nothing in it can be reached.
const CLOSET: Rect = [168, 228, 190, 252];

/// A picture of grays, row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Plan {
    gray: Vec<u8>,
}

/// Where a door's leaf stands open, seen from the wall.
#[derive(Clone, Copy, Debug)]
enum Leaf {
    /// Above a level wall, left of an upright one.
    Before,
    /// Below a level wall, right of an upright one.
    Behind,
    /// There is none.
    Gone,
}

/// Writes `office.yaml` and `office.pgm` into `folder`.
///
/// # Errors
/// [`FileError`] if they cannot be written.
pub(crate) fn write(folder: &Path) -> Result<(), FileError> {
    let plan = draw();
    let gray = |cell: pf_grid::Cell| plan.at(cell.x, cell.y);
    write_gray(&folder.join("office.pgm"), WIDTH, HEIGHT, gray)?;
    let ros = RosMap {
        image: "office.pgm".into(),
        frame: Frame {
            resolution: 0.05,
            origin: [-10.0, -7.5, 0.0],
        },
        negate: false,
        occupied_thresh: 0.65,
        free_thresh: 0.196,
        mode: RosMode::Trinary,
    };
    write_ros_yaml(&folder.join("office.yaml"), &ros)
}

/// Draws the plan.
#[must_use]
pub(crate) fn draw() -> Plan {
    let mut plan = Plan {
        gray: vec![UNKNOWN; (WIDTH * HEIGHT) as usize],
    };
    plan.walls();
    plan.doors();
    plan.offices();
    plan.meeting_rooms();
    plan.open_plan();
    plan.kitchen_and_washrooms();
    plan.stores();
    plan.lobby();
    plan
}

/// On which side of a desk its chair stands.
#[derive(Clone, Copy, Debug)]
enum Side {
    Below,
    Left,
    Right,
}

impl Plan {
    /// The gray of a pixel.
    #[must_use]
    pub(crate) fn at(&self, x: u32, y: u32) -> u8 {
        self.gray[(y * WIDTH + x) as usize]
    }

    fn fill(&mut self, [left, top, right, bottom]: Rect, gray: u8) {
        for y in top..bottom {
            let row = (y * WIDTH) as usize;
            self.gray[row + left as usize..row + right as usize].fill(gray);
        }
    }

    fn solid(&mut self, rect: Rect) {
        self.fill(rect, OCCUPIED);
    }

    /// What a laser sees of a desk, a counter or a shelf: its sides. Inside it is unknown.
    fn furniture(&mut self, rect: Rect) {
        let [left, top, right, bottom] = rect;
        self.solid(rect);
        self.fill([left + 1, top + 1, right - 1, bottom - 1], UNKNOWN);
    }

    fn disc(&mut self, x: u32, y: u32, radius: u32, gray: u8) {
        for dy in 0..=2 * radius {
            for dx in 0..=2 * radius {
                let (a, b) = (dx.abs_diff(radius), dy.abs_diff(radius));
                if a * a + b * b <= radius * radius + radius / 2 {
                    let at = (y + dy - radius) * WIDTH + x + dx - radius;
                    self.gray[at as usize] = gray;
                }
            }
        }
    }

    /// A level wall's door: its left end and the wall's top.
    fn level_door(&mut self, x: u32, y: u32, width: u32, leaf: Leaf) {
        self.fill([x, y, x + width, y + 3], FREE);
        match leaf {
            Leaf::Before => self.solid([x - 1, y - width, x, y]),
            Leaf::Behind => self.solid([x - 1, y + 3, x, y + 3 + width]),
            Leaf::Gone => {}
        }
    }

    /// An upright wall's door: the wall's left and the door's upper end.
    fn upright_door(&mut self, x: u32, y: u32, width: u32, leaf: Leaf) {
        self.fill([x, y, x + 3, y + width], FREE);
        match leaf {
            Leaf::Before => self.solid([x - width, y - 1, x, y]),
            Leaf::Behind => self.solid([x + 3, y - 1, x + 3 + width, y]),
            Leaf::Gone => {}
        }
    }

    /// The building is solid, then rooms are taken out of it.
    fn walls(&mut self) {
        self.solid(BUILDING);
        self.fill(LIGHT_WELL, UNKNOWN);
        // The rooms inside the open-plan area come after it.
        for (_, room) in ROOMS {
            let [left, top, right, bottom] = room;
            self.solid([left - 3, top - 3, right + 3, bottom + 3]);
            self.fill(room, FREE);
        }
        self.fill([259, 137, 285, 232], FREE);
    }

    fn doors(&mut self) {
        use Leaf::{Before, Behind, Gone};
        for x in [60, 90, 143, 290, 319] {
            self.level_door(x, 108, DOOR, Before);
        }
        self.level_door(218, 108, 26, Gone);
        // Wide openings, without doors, join the corridor with the open-plan area and the kitchen.
        self.level_door(36, 137, 34, Gone);
        self.level_door(112, 137, 34, Gone);
        self.level_door(186, 137, 40, Gone);
        for x in [312, 342] {
            self.level_door(x, 137, DOOR, Behind);
        }
        self.upright_door(64, 226, DOOR, Before);
        for x in [18, 45] {
            self.level_door(x, 256, 14, Gone);
        }
        self.upright_door(165, 190, DOOR, Gone);
        self.upright_door(256, 190, DOOR, Before);
        self.upright_door(256, 231, DOOR, Before);
        self.upright_door(256, 262, DOOR, Before);
        self.upright_door(285, 200, DOOR, Behind);
        // The entrance: a double door, and the step before it.
        self.fill([308, 285, 340, 296], FREE);
    }

    fn offices(&mut self) {
        use Side::{Below, Left, Right};
        self.furniture([28, 44, 64, 60]);
        self.disc(46, 35, 5, OCCUPIED);
        self.chairs(&[(38, 69), (54, 69)]);
        self.furniture([15, 60, 21, 104]);
        self.furniture([72, 22, 82, 52]);
        self.round_table(40, 91, 7);

        self.desk(97, 30, Below);
        self.furniture([129, 55, 136, 95]);
        self.desk(142, 30, Right);
        self.desk(180, 60, Left);
        self.furniture([172, 15, 194, 21]);
        self.desk(270, 28, Right);
        self.furniture([264, 70, 271, 104]);
        self.disc(306, 21, 4, OCCUPIED);
        self.desk(288, 151, Right);
        self.furniture([316, 177, 335, 184]);
        self.desk(371, 148, Left);
        self.furniture([338, 177, 362, 184]);

        // Copiers, a table and shelves.
        self.furniture([200, 62, 222, 76]);
        self.furniture([227, 62, 241, 72]);
        self.furniture([197, 84, 206, 104]);
        self.furniture([254, 72, 261, 104]);
    }

    fn meeting_rooms(&mut self) {
        self.furniture([340, 29, 362, 88]);
        for y in [36, 49, 62, 75] {
            self.chairs(&[(332, y + 3), (370, y + 3)]);
        }
        self.chairs(&[(351, 21), (351, 96)]);

        self.furniture([318, 197, 364, 213]);
        for x in [325, 341, 357] {
            self.chairs(&[(x, 221)]);
        }
        self.chairs(&[(372, 205)]);

        self.round_table(34, 233, 8);
        self.chairs(&[(34, 220), (21, 233)]);
        for left in [15, 41] {
            self.furniture([left, 277, left + 23, 285]);
            self.disc(left + 11, 271, 3, OCCUPIED);
        }
    }

    fn open_plan(&mut self) {
        for (x, y) in [(52, 174), (126, 174), (122, 245)] {
            self.desk_cluster(x, y);
        }
        for (x, y) in [(85, 147), (85, 211), (85, 272), (157, 211)] {
            self.solid([x, y, x + 8, y + 8]);
        }
        self.furniture([138, 277, 162, 285]);
        self.disc(71, 280, 4, OCCUPIED);
        self.disc(160, 145, 4, OCCUPIED);
    }

    fn kitchen_and_washrooms(&mut self) {
        self.furniture([168, 174, 256, 182]);
        self.furniture([168, 158, 178, 174]);
        for x in [204, 236] {
            self.round_table(x, 156, 7);
            self.chairs(&[(x - 11, 156), (x + 11, 156)]);
        }

        // Stalls, each with an opening, and a row of sinks.
        for (front, left, toilet) in [(191, 191, 205), (231, 213, 218)] {
            self.solid([front, 185, front + 2, 225]);
            for y in [198, 211] {
                self.solid([left, y, left + 20, y + 1]);
            }
            for y in [187, 200, 213] {
                self.fill([front, y, front + 2, y + 9], FREE);
                self.disc(toilet, y + 4, 3, OCCUPIED);
            }
        }
        self.furniture([170, 219, 188, 225]);
        self.furniture([236, 219, 254, 225]);
    }

    fn stores(&mut self) {
        // Racks and shelves along an aisle.
        self.furniture([196, 228, 232, 236]);
        self.furniture([196, 244, 232, 252]);
        self.furniture([168, 255, 256, 261]);
        self.furniture([168, 279, 246, 285]);
        self.furniture([166, 111, 190, 116]);
        self.disc(20, 124, 4, OCCUPIED);
    }

    fn lobby(&mut self) {
        self.furniture([348, 248, 354, 274]);
        self.furniture([354, 248, 372, 254]);
        self.disc(363, 263, 5, OCCUPIED);
        self.furniture([292, 232, 326, 241]);
        self.disc(309, 252, 5, OCCUPIED);
        self.chairs(&[(294, 256), (324, 256)]);
        self.disc(380, 237, 4, OCCUPIED);
        self.disc(380, 280, 4, OCCUPIED);
        self.solid([307, 269, 308, 285]);
        self.solid([340, 269, 341, 285]);
    }

    /// A desk of 140 cm by 70 cm by its upper left corner, and a chair on one of its long sides.
    fn desk(&mut self, x: u32, y: u32, chair: Side) {
        match chair {
            Side::Below => {
                self.furniture([x, y, x + 28, y + 14]);
                self.chairs(&[(x + 14, y + 22)]);
            }
            Side::Left => {
                self.furniture([x, y, x + 14, y + 28]);
                self.chairs(&[(x - 9, y + 14)]);
            }
            Side::Right => {
                self.furniture([x, y, x + 14, y + 28]);
                self.chairs(&[(x + 22, y + 14)]);
            }
        }
    }

    /// Four desks around a point, and their chairs.
    fn desk_cluster(&mut self, x: u32, y: u32) {
        for left in [x - 27, x] {
            self.furniture([left, y - 14, left + 27, y]);
            self.furniture([left, y, left + 27, y + 14]);
            self.chairs(&[(left + 14, y - 22), (left + 14, y + 22)]);
        }
    }

    fn round_table(&mut self, x: u32, y: u32, radius: u32) {
        self.disc(x, y, radius, OCCUPIED);
        self.disc(x, y, radius - 1, UNKNOWN);
    }

    fn chairs(&mut self, at: &[(u32, u32)]) {
        for &(x, y) in at {
            self.disc(x, y, 4, OCCUPIED);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pf_grid::{Cell, Grid, Moves};
    use pf_io::{LoadOptions, Unknown, load_grid};
    use std::fs;

    fn grids() -> std::path::PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../maps/grids")
    }

    #[test]
    fn the_committed_files_are_what_is_drawn() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path()).unwrap();
        for name in ["office.yaml", "office.pgm"] {
            let drawn = fs::read(folder.path().join(name)).unwrap();
            let committed = fs::read(grids().join(name)).unwrap();
            assert!(drawn == committed, "{name}: run `cargo xtask maps`");
        }
    }

    fn reached(grid: &Grid, from: Cell) -> Vec<bool> {
        let mut reached = vec![false; grid.layout().len()];
        let mut open = vec![from];
        while let Some(cell) = open.pop() {
            let id = grid.layout().id(cell) as usize;
            if !reached[id] {
                reached[id] = true;
                open.extend(
                    grid.neighbours(cell, Moves::Orthogonal)
                        .map(|(next, _)| next),
                );
            }
        }
        reached
    }

    #[test]
    fn a_robot_of_radius_3_gets_from_the_entrance_into_every_room_but_the_closet() {
        let map = load_grid(&grids().join("office.yaml"), &LoadOptions::default()).unwrap();
        let grid = map.grid.inflated(3.0);
        let reached = reached(&grid, Cell::new(324, 286));
        for (name, [left, top, right, bottom]) in ROOMS {
            let cells = (top..bottom).flat_map(|y| (left..right).map(move |x| Cell { x, y }));
            let free: Vec<Cell> = cells.filter(|&cell| grid.is_free(cell)).collect();
            let inside = |cell: &&Cell| reached[grid.layout().id(**cell) as usize];
            let entered = free.iter().filter(inside).count();
            if name == "service closet" {
                assert!(!free.is_empty() && entered == 0, "{name}");
            } else {
                let all = free.len();
                assert!(
                    10 * entered > 7 * all,
                    "{name}: {entered} of {all} free cells"
                );
            }
        }
    }

    #[test]
    fn what_is_unknown_can_be_free() {
        let unknown = Unknown::Free;
        let path = grids().join("office.yaml");
        let options = LoadOptions {
            unknown,
            ..LoadOptions::default()
        };
        let outside = load_grid(&path, &options).unwrap().grid;
        let inside = load_grid(&path, &LoadOptions::default()).unwrap().grid;
        assert!(outside.is_free(Cell::new(2, 2)) && !inside.is_free(Cell::new(2, 2)));
    }
}
