//! `cargo xtask gallery`: draws the pictures of docs/gallery.md again, each by the command that stands
//! beside it, and writes the page.

use crate::{
    steps::{Verdict, cargo, passes},
    workspace::{self, root},
};
use anyhow::{Context, Result};
use std::{fmt::Write as _, fs};

/// Where the page stands, and its pictures.
const PAGE: &str = "docs/gallery.md";
const PICTURES: &str = "docs/images/gallery";

struct Piece {
    /// The file's name.
    file: &'static str,
    /// What one sees.
    caption: &'static str,
    /// What `pf` is told, but for where the picture goes.
    args: &'static str,
    /// The option that says where.
    option: &'static str,
}

const PIECES: &[Piece] = &[
    Piece {
        file: "office.png",
        caption: "A round robot in an office, mapped by a laser: grey is too near, blue is what A\\* looked at.",
        args: "plan maps/grids/office.yaml --planner astar --from 30,40 --to 330,270 --radius 3 --show-expanded",
        option: "--png",
    },
    Piece {
        file: "jump-points.png",
        caption: "The same question to jump point search: a few cells where a path may turn.",
        args: "plan maps/grids/office.yaml --planner jps --from 30,40 --to 330,270 --radius 3 --show-expanded",
        option: "--png",
    },
    Piece {
        file: "yard.png",
        caption: "The exact shortest path among 200 shapes, with the tangents the search found free.",
        args: "plan maps/worlds/yard.toml --clearance 0.2 --show-graph",
        option: "--png",
    },
    Piece {
        file: "waypoints.png",
        caption: "L-BFGS: a smooth path that keeps its distance, beside the same shapes.",
        args: "plan maps/worlds/yard.toml --planner lbfgs --clearance 0.2 --show-clearance",
        option: "--png",
    },
    Piece {
        file: "rivers.png",
        caption: "What RFD\\* finds on the paper's mosaic with the paper's parameters: a way, and not the shortest.",
        args: "plan maps/grids/redlarski/mosaic-50.map --planner rfd-star --from 0,0 --to 49,49",
        option: "--png",
    },
    Piece {
        file: "bees.png",
        caption: "Bees that walk out of a trap they cannot see, while things happen around them.",
        args: "walk maps/scenarios/busy-square.toml --seed 2",
        option: "--png",
    },
    Piece {
        file: "ants.gif",
        caption: "Ants (ACO\\*) on the paper's mosaic: pheromone gathers where ways are short.",
        args: "animate maps/grids/redlarski/mosaic-50.map --from 1,27 --to 48,27 --planner aco-star --iterations 60",
        option: "-o",
    },
    Piece {
        file: "team.gif",
        caption: "The plan of the knee, driven: robots that cross and never meet.",
        args: "animate maps/scenarios/three-robots.toml --evaluations 20000 --size 360x360",
        option: "-o",
    },
    Piece {
        file: "drive.png",
        caption: "D\\* Lite drives through a maze it does not know, replanning at every discovery.",
        args: "drive maps/grids/redlarski/maze-100.map --sensor 10",
        option: "--png",
    },
    Piece {
        file: "front.png",
        caption: "Three robots, a front of plans: length, safety and smoothness, none for free.",
        args: "team maps/scenarios/three-robots.toml --evaluations 20000 --prefer knee",
        option: "--png",
    },
];

pub(crate) fn run() -> Result<Verdict> {
    let folder = root().join(PICTURES);
    fs::create_dir_all(&folder).with_context(|| format!("{PICTURES}: cannot be made"))?;
    for piece in PIECES {
        let mut pf = cargo(["run", "--release", "--quiet", "--package", "pf-cli", "--"]);
        pf.args(piece.args.split(' '))
            .arg(piece.option)
            .arg(folder.join(piece.file));
        if passes(&mut pf)? == Verdict::Failed {
            return Ok(Verdict::Failed);
        }
    }
    workspace::write(&root().join(PAGE), &page()?)?;
    Ok(Verdict::Passed)
}

fn page() -> Result<String> {
    let mut page = String::from(
        "# Gallery\n\nEvery picture here was made by the command below it; `cargo xtask gallery` makes \
         them again.\n",
    );
    for piece in PIECES {
        let (file, caption) = (piece.file, piece.caption);
        writeln!(page, "\n{caption}\n\n![{caption}](images/gallery/{file})\n")?;
        writeln!(
            page,
            "```sh\ncargo pf {} {} {file}\n```",
            piece.args, piece.option
        )?;
    }
    Ok(page)
}
