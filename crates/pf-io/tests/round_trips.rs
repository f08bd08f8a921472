//! What is written is read back, and nothing is left half written.

use pf_grid::{Cell, Grid};
use pf_io::{
    Frame, GridMap, LoadOptions, Scen, ScenRow, Unknown, load_grid, parse_image, parse_movingai,
    parse_ros, parse_scen, read_image, read_movingai, read_ros, read_scen, write_movingai,
    write_path_csv, write_path_json, write_pgm, write_png, write_ros, write_scen, write_whole,
};
use proptest::{collection::vec, prelude::*};
use std::{fs, io, path::Path};

fn grids(costs: impl Strategy<Value = u8> + Clone) -> impl Strategy<Value = Grid> {
    (1..20u32, 1..20u32).prop_flat_map(move |(width, height)| {
        vec(costs.clone(), (width * height) as usize).prop_map(move |costs| {
            Grid::new(width, height, |c| costs[(c.y * width + c.x) as usize]).expect("a grid")
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn plain_grids_survive_every_format(grid in grids(0..2u8)) {
        let folder = tempfile::tempdir().unwrap();
        let path = |name| folder.path().join(name);
        write_movingai(&path("a.map"), &grid).unwrap();
        prop_assert_eq!(&read_movingai(&path("a.map")).unwrap(), &grid);
        write_png(&path("a.png"), &grid).unwrap();
        prop_assert_eq!(&read_image(&path("a.png")).unwrap(), &grid);
        write_pgm(&path("a.pgm"), &grid).unwrap();
        prop_assert_eq!(&read_image(&path("a.pgm")).unwrap(), &grid);
        let frame = Frame { resolution: 0.05, origin: [-1.5, 2.25, 0.1] };
        write_ros(&path("b.yaml"), &grid, frame).unwrap();
        let (read, ros) = read_ros(&path("b.yaml"), Unknown::Free).unwrap();
        prop_assert_eq!(&read, &grid);
        prop_assert_eq!(ros.frame, frame);
        for name in ["a.map", "a.png", "a.pgm", "b.yaml"] {
            let map = load_grid(&path(name), &LoadOptions::default()).unwrap();
            prop_assert_eq!(&*map.grid, &grid);
            prop_assert_eq!(map.frame, name.ends_with("yaml").then_some(frame));
            fs::rename(path(name), path("nameless")).unwrap();
            let map = load_grid(&path("nameless"), &LoadOptions::default()).unwrap();
            prop_assert_eq!(&*map.grid, &grid, "{} by its content", name);
        }
    }

    #[test]
    fn ros_maps_keep_terrain(grid in grids(0..=254u8)) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.yaml");
        let frame = Frame { resolution: 1.0, origin: [0.0; 3] };
        write_ros(&path, &grid, frame).unwrap();
        let (read, _) = read_ros(&path, Unknown::Blocked).unwrap();
        // What a blocked cell would cost is not in the file.
        for cell in grid.layout().cells() {
            prop_assert_eq!(read.is_free(cell), grid.is_free(cell));
            prop_assert!(!grid.is_free(cell) || read.cost(cell) == grid.cost(cell));
        }
    }

    #[test]
    fn cells_and_metres_are_one_to_one(
        grid in grids(0..2u8),
        resolution in 0.01..10.0f64,
        x in -50.0..50.0f64,
        y in -50.0..50.0f64,
        yaw in -4.0..4.0f64,
    ) {
        let frame = Some(Frame { resolution, origin: [x, y, yaw] });
        let map = GridMap { grid: grid.into(), frame, source: "a.yaml".into() };
        for cell in map.grid.layout().cells() {
            prop_assert_eq!(map.cell_at(map.metres(cell).unwrap()), Some(cell));
        }
        prop_assert_eq!(map.cell_at([f64::NAN, 0.0]), None);
        prop_assert_eq!(map.cell_at([1e300, 0.0]), None);
    }
}

#[test]
fn line_ends_and_byte_order_marks_do_not_matter() {
    let plain = "type octile\nheight 2\nwidth 3\nmap\n..@\nGT.\n";
    let grid = parse_movingai("a.map", plain.as_bytes()).unwrap();
    for text in [
        plain.replace('\n', "\r\n"),
        plain.trim_end().to_owned(),
        plain.replace('\n', "\r\n").trim_end().to_owned(),
        format!("\u{feff}{plain}\n\n"),
    ] {
        assert_eq!(
            parse_movingai("a.map", text.as_bytes()).unwrap(),
            grid,
            "{text:?}"
        );
    }
    let plain = "version 1\n0\ta.map\t4\t3\t0\t0\t3\t1\t3.41421\n";
    let rows = parse_scen("a.scen", plain.as_bytes()).unwrap().rows;
    for text in [
        plain.replace('\n', "\r\n"),
        plain.trim_end().to_owned(),
        plain.replace('\t', " ").replace("version 1", "version 1.0"),
        format!("\u{feff}{plain}\n"),
    ] {
        assert_eq!(
            parse_scen("a.scen", text.as_bytes()).unwrap().rows,
            rows,
            "{text:?}"
        );
    }
}

#[test]
fn scen_files_round_trip_and_know_their_map() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.scen");
    let row = ScenRow {
        line: 2,
        bucket: 1,
        map: "a map.map".to_owned(),
        width: 9,
        height: 7,
        start: Cell::new(0, 1),
        goal: Cell::new(8, 6),
        optimum: 3.0 + 5.0 * 2f64.sqrt(),
    };
    write_scen(&path, &Scen::new(vec![row.clone()])).unwrap();
    let scen = read_scen(&path).unwrap();
    assert!(scen.agrees(&scen.rows[0], row.optimum));
    assert_eq!(scen.rows[0].map, row.map);
    scen.check_size(&Grid::open(9, 7).unwrap()).unwrap();
    let error = scen.check_size(&Grid::open(7, 9).unwrap()).unwrap_err();
    let message = error.to_string();
    assert!(
        message.ends_with("a.scen:2: found a map of 9 x 7 cells, expected 7 x 9, as the map has")
    );
}

#[test]
fn optima_are_compared_at_the_precision_of_their_file() {
    let file = |optima: &[&str]| {
        let row = |optimum| format!("0 a.map 9 9 0 0 8 8 {optimum}\n");
        let rows: String = optima.iter().map(row).collect();
        parse_scen("a.scen", format!("version 1\n{rows}").as_bytes()).unwrap()
    };
    // %g: six significant digits, zeros dropped.
    let scen = file(&["6", "7.41421", "1234.57", "450.3"]);
    let agrees = |row: usize, length: f64| scen.agrees(&scen.rows[row], length);
    assert!(agrees(0, 6.000_004) && !agrees(0, 6.000_02));
    assert!(agrees(1, 6.0 + 2f64.sqrt()) && !agrees(1, 7.414_23));
    assert!(agrees(2, 1234.5651) && !agrees(2, 1234.58));
    assert!(agrees(3, 450.300_4) && !agrees(3, 450.31));
    // %.8f, summed with a root of 2 of eight decimals.
    let scen = file(&["141.42135600", "7.00000000"]);
    assert!(scen.agrees(&scen.rows[0], 100.0 * 2f64.sqrt()));
    assert!(!scen.agrees(&scen.rows[0], 141.421_37) && !scen.agrees(&scen.rows[1], 7.000_001));
    // %.2f: two decimals.
    let scen = file(&["450.32", "73.24", "1000.00"]);
    assert!(scen.agrees(&scen.rows[1], 73.2446) && !scen.agrees(&scen.rows[1], 73.25));
    assert!(scen.agrees(&scen.rows[2], 1000.004) && !scen.agrees(&scen.rows[2], 1000.01));
}

/// A `map_server` file of these settings read with a PGM picture of these grays.
fn ros(settings: &str, grays: &[u8], unknown: Unknown) -> Vec<u8> {
    let yaml = format!("image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\n{settings}\n");
    let mut picture = format!("P5 {} 1 255\n", grays.len()).into_bytes();
    picture.extend(grays);
    let ros = parse_ros("a.yaml", yaml.as_bytes()).expect("a file");
    let grid = ros.grid("a.pgm", &picture, unknown).expect("a picture");
    let cost = |cell| {
        if grid.is_free(cell) {
            grid.cost(cell)
        } else {
            0
        }
    };
    grid.layout().cells().map(cost).collect()
}

#[test]
fn ros_modes_mean_what_map_server_says() {
    use Unknown::{Blocked, Free};
    // 205 is the gray by which map_saver marks unknown cells; 0.196 just leaves it unknown.
    let usual = "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196";
    let grays = [0, 88, 90, 205, 206, 254, 255];
    assert_eq!(ros(usual, &grays, Blocked), [0, 0, 0, 0, 1, 1, 1]);
    assert_eq!(ros(usual, &grays, Free), [0, 0, 1, 1, 1, 1, 1]);
    let negated = usual.replace("negate: 0", "negate: true");
    assert_eq!(ros(&negated, &grays, Blocked), [1, 0, 0, 0, 0, 0, 0]);
    assert_eq!(ros(&negated, &[0, 49, 50, 165, 166], Free), [1, 1, 1, 1, 0]);

    let scale = "negate: 0\noccupied_thresh: 0.8\nfree_thresh: 0.2\nmode: scale";
    let grays = [0, 50, 52, 128, 203, 205, 255];
    assert_eq!(ros(scale, &grays, Free), [0, 0, 252, 127, 3, 1, 1]);

    let raw = "negate: 1\noccupied_thresh: 0.65\nfree_thresh: 0.196\nmode: raw";
    let grays = [0, 1, 50, 99, 100, 101, 255];
    assert_eq!(ros(raw, &grays, Blocked), [1, 4, 128, 251, 0, 0, 0]);
    assert_eq!(ros(raw, &grays, Free), [1, 4, 128, 251, 0, 1, 1]);
}

#[test]
fn pgm_samples_are_scaled_by_their_maximum() {
    for text in [
        "P2 4 1 1 0 1 1 0",
        "P2 4 1 15 7 8 15 0",
        "P2 4 1 65535 32767 32896 65535 0",
    ] {
        let grid = parse_image("a.pgm", text.as_bytes()).unwrap();
        assert_eq!(grid.to_string(), "#..#\n", "{text}");
    }
    let commented = b"P5 # gray\n# two comments\n2 1 #\n255\n\x00\xff";
    assert_eq!(parse_image("a.pgm", commented).unwrap().to_string(), "#.\n");
}

fn encode(kind: png::ColorType, bits: png::BitDepth, size: [u32; 2], data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size[0], size[1]);
    encoder.set_color(kind);
    encoder.set_depth(bits);
    if kind == png::ColorType::Indexed {
        encoder.set_palette(vec![0, 0, 0, 255, 255, 255]);
    }
    let mut writer = encoder.write_header().expect("a picture");
    writer.write_image_data(data).expect("a picture");
    writer.finish().expect("a picture");
    bytes
}

#[test]
fn pngs_of_every_kind_are_read() {
    use png::{BitDepth, ColorType};
    let cases: [(ColorType, BitDepth, &[u8]); 7] = [
        (ColorType::Grayscale, BitDepth::One, &[0b0110_0000]),
        (ColorType::Indexed, BitDepth::One, &[0b0110_0000]),
        (ColorType::Grayscale, BitDepth::Eight, &[127, 128, 255, 0]),
        (
            ColorType::Grayscale,
            BitDepth::Sixteen,
            &[127, 255, 128, 0, 255, 255, 0, 0],
        ),
        // Black that is transparent lies over white.
        (
            ColorType::GrayscaleAlpha,
            BitDepth::Eight,
            &[0, 255, 0, 0, 0, 100, 0, 200],
        ),
        // Blue is dark, green is light.
        (
            ColorType::Rgb,
            BitDepth::Eight,
            &[0, 0, 255, 0, 255, 0, 255, 255, 0, 255, 0, 0],
        ),
        (
            ColorType::Rgba,
            BitDepth::Eight,
            &[
                0, 0, 0, 255, 0, 0, 0, 0, 255, 255, 255, 255, 90, 90, 90, 255,
            ],
        ),
    ];
    for (kind, bits, data) in cases {
        let bytes = encode(kind, bits, [4, 1], data);
        let grid = parse_image("a.png", &bytes).unwrap();
        assert_eq!(grid.to_string(), "#..#\n", "{kind:?} {bits:?}");
    }
}

#[test]
fn interlaced_pngs_are_read() {
    // 9 x 6 pixels of one bit, in the seven passes of Adam7.
    let file = "\
        89504e470d0a1a0a0000000d49484452000000090000000601000000014ebbb9fe00000022494441\
        5478da6338c0c0c0a0c07080a1816102c3028602860f0cab18185a19803400588406d0557e51ae00\
        00000049454e44ae426082";
    let digits = file
        .as_bytes()
        .chunks(2)
        .map(|pair| str::from_utf8(pair).unwrap());
    let bytes: Vec<u8> = digits.map(|d| u8::from_str_radix(d, 16).unwrap()).collect();
    let drawing = "...##..#. .#.#.#.## .##.#...# .####.#.# #...#.#.. ....#####";
    let expected = Grid::parse(drawing).unwrap();
    assert_eq!(
        parse_image("a.png", &bytes).unwrap().to_string(),
        expected.to_string()
    );
}

#[test]
fn nothing_is_left_half_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    fs::write(&path, "old").unwrap();
    let error = write_whole(&path, |out| {
        out.write_all(b"half")?;
        Err(io::Error::other("the disk is full"))
    })
    .unwrap_err();
    let message = error.to_string();
    assert!(
        message.ends_with("a.txt: cannot be written: the disk is full"),
        "{message}"
    );
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    write_whole(&path, |out| write!(out, "new")).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "new");

    let error = write_pgm(
        Path::new("/no/such/folder/a.pgm"),
        &Grid::open(2, 2).unwrap(),
    );
    assert!(
        error
            .unwrap_err()
            .to_string()
            .starts_with("/no/such/folder/a.pgm")
    );
}

#[test]
fn paths_are_written_in_cells_and_in_metres() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("path");
    let cells = [Cell::new(0, 2), Cell::new(1, 1)];
    let mut map = GridMap {
        grid: Grid::open(4, 3).unwrap().into(),
        frame: None,
        source: "a.map".into(),
    };
    let written = |map: &GridMap| {
        write_path_csv(&file, &cells, map).unwrap();
        let csv = fs::read_to_string(&file).unwrap();
        write_path_json(&file, &cells, map).unwrap();
        (
            csv,
            serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap(),
        )
    };
    let (csv, json): (String, serde_json::Value) = written(&map);
    assert_eq!(csv, "x,y\n0,2\n1,1\n");
    assert_eq!(json, serde_json::json!({ "path": [[0, 2], [1, 1]] }));
    map.frame = Some(Frame {
        resolution: 0.5,
        origin: [10.0, 20.0, 0.0],
    });
    let (csv, json) = written(&map);
    assert_eq!(
        csv,
        "x,y,x_m,y_m\n0,2,10.250000,20.250000\n1,1,10.750000,20.750000\n"
    );
    assert_eq!(
        json["metres"],
        serde_json::json!([[10.25, 20.25], [10.75, 20.75]])
    );
}
