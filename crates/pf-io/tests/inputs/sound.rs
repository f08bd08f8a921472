//! A small sound file of each format.

use pf_grid::Grid;
use std::fs;

/// A file that every reader of its kind must read.
#[derive(Clone, Debug)]
pub(crate) struct Sound {
    pub(crate) name: &'static str,
    pub(crate) bytes: Vec<u8>,
}

/// One of each.
pub(crate) fn all() -> Vec<Sound> {
    let text = |name, text: &str| Sound {
        name,
        bytes: text.as_bytes().to_vec(),
    };
    vec![
        text(
            "a.map",
            "type octile\nheight 3\nwidth 5\nmap\n..@T.\nGSOW.\n.....\n",
        ),
        text(
            "b.map",
            "\u{feff}type octile\r\nheight 2\r\nwidth 3\r\nmap\r\n..@\r\n...\r\n",
        ),
        text(
            "a.scen",
            "version 1\n0\tmaps/a.map\t5\t3\t0\t0\t4\t2\t4.82843\n1\ta b.map\t5\t3\t1\t0\t1\t2\t2\n",
        ),
        text(
            "b.scen",
            "version 1.0\r\n112 maps/b.map 512 512 135 383 354 187 450.32\r\n",
        ),
        text("plain.pgm", "P2\n# a comment\n3 2\n15\n0 7 15\n8 15 1\n"),
        Sound {
            name: "raw.pgm",
            bytes: b"P5 3 2 255\n\x00\xff\x80\x7f\x01\x02".to_vec(),
        },
        Sound {
            name: "wide.pgm",
            bytes: b"P5\n2 1 65535\n\x00\xff\xff\x0b".to_vec(),
        },
        Sound {
            name: "gray.png",
            bytes: png(),
        },
        text(
            "a.yaml",
            "image: room.pgm # beside\nmode: scale\nresolution: 0.05\norigin: [-1.5, 2.0, 0.1]\n\
             negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\nextra: {a: [1, 2]}\n",
        ),
        text(
            "a.toml",
            "title = 'T'\nmap = 'hall.map'\nmoves = 'always'\nradius = 1.5\nstart = [0, 1]\n\
             goal = [4, 3]\n[[case]]\nname = 'a'\nexpected = { straight = 1, diagonal = 3 }\n\
             [[case.event]]\nat = 2\nblocked = [[2, 1], [2, 2, 1, 2]]\n[[case.event]]\nat = 3.5\n\
             cost = { value = 5, cells = [[0, 0, 5, 1]] }\n[[case]]\nname = 'b'\nfollows = 'a'\n\
             start = [0, 0]\nfreed = [[1, 1]]\n",
        ),
    ]
}

fn png() -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("gray.png");
    let grid = Grid::parse("..#.. .#.#. #....").expect("a grid");
    pf_io::write_png(&path, &grid).expect("a picture");
    fs::read(path).expect("the picture")
}
