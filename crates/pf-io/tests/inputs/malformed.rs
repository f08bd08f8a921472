//! Malformed inputs, and the words that an error about each must contain. Shared with the
//! program's tests; it needs nothing but the standard library.

/// A malformed input.
#[derive(Debug)]
pub(crate) struct Malformed {
    /// The file that is handed in.
    pub(crate) file: &'static str,
    /// Its content.
    pub(crate) bytes: Vec<u8>,
    /// Files that lie beside it.
    pub(crate) beside: Vec<(&'static str, Vec<u8>)>,
    /// What the message must contain, the name of the guilty file aside.
    pub(crate) words: &'static [&'static str],
    /// The file that the message must name, if it is another.
    pub(crate) guilty: &'static str,
}

impl Malformed {
    /// The name's extension says which reader it is for: `scen`, `toml`, else a map's.
    pub(crate) fn extension(&self) -> &str {
        self.file.rsplit('.').next().unwrap_or("")
    }
}

type Words = &'static [&'static str];

/// Every malformed input.
pub(crate) fn all() -> Vec<Malformed> {
    let mut all = Vec::new();
    all.extend(maps());
    all.extend(pgms());
    all.extend(pngs());
    all.extend(ros());
    all.extend(scens());
    all.extend(scenarios());
    all
}

fn alone(file: &'static str, bytes: impl Into<Vec<u8>>, words: Words) -> Malformed {
    Malformed {
        file,
        bytes: bytes.into(),
        beside: Vec::new(),
        words,
        guilty: file,
    }
}

/// A map of three rows of four cells, with a header and a body of the caller's.
fn map(header: &str, body: &str) -> Vec<u8> {
    format!("{header}\nmap\n{body}").into_bytes()
}

const HEADER: &str = "type octile\nheight 3\nwidth 4";
const BODY: &str = "....\n.@@.\n....\n";

#[rustfmt::skip]
fn maps() -> Vec<Malformed> {
    let mut not_utf8 = map(HEADER, BODY);
    let at = not_utf8.len() - 3;
    not_utf8[at] = 0xff;
    let utf16: Vec<u8> = "type octile\n"
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    let zip_bomb_header = "type octile\nheight 16384\nwidth 16384";
    vec![
        alone("empty.map", "", &[":1:1", "end of the file", "\"type octile\""]),
        alone("picture.map", "P5 4 3 255\n............", &[":1:1", "\"P5 4 3 255\"", "type octile"]),
        alone("type.map", map("type hex\nheight 3\nwidth 4", BODY), &[":1:1", "\"type hex\"", "type octile"]),
        alone("typo.map", map("type octile\nheigth 3\nwidth 4", BODY), &[":2:1", "\"heigth 3\"", "\"height\" and a number"]),
        alone("swapped.map", map("type octile\nwidth 4\nheight 3", BODY), &[":2:1", "\"width 4\"", "\"height\""]),
        alone("negative.map", map("type octile\nheight -3\nwidth 4", BODY), &[":2:1", "\"height -3\"", "a number"]),
        alone("fraction.map", map("type octile\nheight 3\nwidth 4.5", BODY), &[":3:1", "\"width 4.5\"", "a number"]),
        alone("zero.map", map("type octile\nheight 3\nwidth 0", BODY), &[":2", "0 x 3", "1 to 268435456"]),
        alone("gigantic.map", map("type octile\nheight 4000000000\nwidth 4000000000", BODY), &[":2", "4000000000 x 4000000000", "268435456"]),
        alone("overflow.map", map("type octile\nheight 18446744073709551617\nwidth 4", BODY), &[":2:1", "18446744073709551617", "a number"]),
        alone("promises.map", map(zip_bomb_header, BODY), &[":5:5", "4 cells", "16384 cells (row 1 of 16384)"]),
        alone("promises-rows.map", map("type octile\nheight 268435456\nwidth 1", ".\n"), &[":6:1", "end of the file", "row 2 of 268435456"]),
        alone("headless.map", format!("{HEADER}\n{BODY}"), &[":4:1", "\"....\"", "\"map\""]),
        alone("cut-in-header.map", "type octile\nheight 3\n", &[":3:1", "end of the file", "\"width\""]),
        alone("cut-in-row.map", map(HEADER, "....\n.@"), &[":6:3", "2 cells", "4 cells (row 2 of 3)"]),
        alone("cut-after-row.map", map(HEADER, "....\n.@@.\n"), &[":7:1", "end of the file", "row 3 of 3"]),
        alone("short-row.map", map(HEADER, "....\n.@.\n....\n"), &[":6:4", "3 cells", "4 cells"]),
        alone("long-row.map", map(HEADER, "....\n.@@..\n....\n"), &[":6:5", "5 cells", "4 cells"]),
        alone("character.map", map(HEADER, "....\n.@X.\n....\n"), &[":6:3", "\"X\"", "one of . G S @ O T W"]),
        alone("too-many-rows.map", map(HEADER, "....\n.@@.\n....\n....\n"), &[":8:1", "\"....\"", "the end of the file after 3 rows"]),
        alone("not-utf8.map", not_utf8, &[":7:3", "byte 0xff at offset", "UTF-8"]),
        alone("utf16.map", [vec![0xff, 0xfe], utf16].concat(), &[":1:1", "byte 0xff at offset 0", "UTF-8"]),
        alone("zeros.map", vec![0; 4096], &[":1:1", "type octile"]),
        alone("what.xyz", "hello\n", &["\"hello\"", "a map: Moving AI .map, ROS .yaml"]),
    ]
}

#[rustfmt::skip]
fn pgms() -> Vec<Malformed> {
    vec![
        alone("empty.pgm", "", &["byte 0", "a picture: PNG, or PGM"]),
        alone("colour.pgm", "P6 1 1 255\nabc", &["byte 0", "P6", "P5 or P2"]),
        alone("negative.pgm", "P5 -4 3 255\n", &[":1:4", "\"-4\"", "the width"]),
        alone("gigantic.pgm", "P5 99999999 99999999 255\n", &["99999999 x 99999999", "268435456"]),
        alone("promises.pgm", "P5 16384 16384 255\nabc", &["byte 22", "3 bytes", "at least 268435456"]),
        alone("promises-plain.pgm", "P2 16384 16384 255\n1 2 3", &["5 characters", "at least 536870911"]),
        alone("truncated.pgm", "P5 4 3 255\n12345678901", &["11 bytes", "at least 12"]),
        alone("truncated-16.pgm", "P5 4 3 65535\n123456789012", &["12 bytes", "at least 24"]),
        alone("maximum.pgm", "P5 4 3 70000\n123456789012", &["largest gray value 70000", "1 to 65535"]),
        alone("no-maximum.pgm", "P5 4 3 0\n123456789012", &["largest gray value 0", "1 to 65535"]),
        alone("too-bright.pgm", "P5 2 2 9\n\x01\x02\x0a\x03", &["byte 11", "sample 10", "at most 9"]),
        alone("word.pgm", "P2 2 2 9\n1 2\nx 3\n", &[":3:1", "\"x\"", "sample 3 of 4"]),
        alone("ends.pgm", "P2 2 2 9\n1 2\n3             \n", &["end of the file", "sample 4 of 4"]),
    ]
}

#[rustfmt::skip]
fn pngs() -> Vec<Malformed> {
    let sound = png([4, 3], 8, 0, &[0; 15]);
    let mut bad_sum = sound.clone();
    let at = bad_sum.len() - 20;
    bad_sum[at] ^= 0x55;
    let mut later_lie = sound.clone();
    later_lie[18] = 0x40; // 16384 columns, though the header's checksum says otherwise
    vec![
        alone("signature.png", &b"\x89PNG\r\n\x1a\n"[..], &["end of the file", "a whole and sound PNG"]),
        alone("truncated.png", &sound[..sound.len() - 22], &["byte", "end of the file", "PNG"]),
        alone("cut-at-end.png", &sound[..sound.len() - 12], &["byte", "end of the file", "PNG"]),
        alone("checksum.png", bad_sum, &["a broken PNG", "sound PNG"]),
        alone("changed-size.png", later_lie, &["a broken PNG", "sound PNG"]),
        alone("lying.png", png([16384, 16384], 8, 0, &[0; 15]), &["PNG"]),
        alone("lying-bits.png", png([16384, 16384], 1, 0, &[0; 15]), &["PNG"]),
        alone("lying-colour.png", png([16384, 16384], 16, 6, &[0; 15]), &["PNG"]),
        alone("lying-row.png", png([268_435_456, 1], 16, 6, &[0; 15]), &["byte 16", "268435456 x 1", "columns"]),
        alone("gigantic.png", png([0x7fff_ffff, 0x7fff_ffff], 8, 0, &[0; 15]), &["byte 16", "2147483647 x 2147483647", "268435456"]),
        alone("zero.png", png([0, 3], 8, 0, &[]), &["a broken PNG", "sound PNG"]),
        alone("short-data.png", png([4, 3], 8, 0, &[0; 10]), &["PNG"]),
        alone("text.png", "not a picture", &["byte 0", "\"not a pi\"", "a picture"]),
    ]
}

const ROS: &str = "image: room.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n\
                   occupied_thresh: 0.65\nfree_thresh: 0.196\n";

/// A `map_server` file in which a line is replaced.
fn ros_with(file: &'static str, key: &str, line: &str, words: Words) -> Malformed {
    let lines = ROS
        .lines()
        .map(|old| if old.starts_with(key) { line } else { old });
    let text: Vec<&str> = lines.filter(|line| !line.is_empty()).collect();
    let mut row = alone(file, text.join("\n") + "\n", words);
    row.beside = vec![("room.pgm", b"P2 2 1 255 0 255\n".to_vec())];
    row
}

#[rustfmt::skip]
fn ros() -> Vec<Malformed> {
    let mut no_picture = ros_with(
        "no-picture.yaml",
        "image",
        "image: gone.pgm",
        &["cannot be read"],
    );
    no_picture.guilty = "gone.pgm";
    let mut bad_picture = ros_with(
        "bad-picture.yaml",
        "image",
        "image: bad.pgm",
        &["at least 6"],
    );
    bad_picture.beside = vec![("bad.pgm", b"P5 3 2 255\n123".to_vec())];
    bad_picture.guilty = "bad.pgm";
    let mut folder = ros_with("folder.yaml", "image", "image: .", &["cannot be read"]);
    folder.guilty = "";
    let deep = "[".repeat(100_000);
    vec![
        alone("empty.yaml", "", &["no key \"image\""]),
        alone("list.yaml", "- image\n- resolution\n", &[":1:1", "broken YAML", "a mapping"]),
        alone("deep.yaml", format!("image: {deep}"), &["broken YAML"]),
        alone("aliases.yaml", "a: &a [x, x]\nb: &b [*a, *a]\nimage: *b\n", &["broken YAML"]),
        ros_with("no-image.yaml", "image", "", &["no key \"image\"", "a picture's name"]),
        ros_with("no-resolution.yaml", "resolution", "", &["no key \"resolution\"", "metres per cell"]),
        ros_with("no-origin.yaml", "origin", "", &["no key \"origin\"", "yaw"]),
        ros_with("no-negate.yaml", "negate", "", &["no key \"negate\"", "0, 1, false or true"]),
        ros_with("no-threshold.yaml", "free_thresh", "", &["no key \"free_thresh\"", "0 to 1"]),
        ros_with("empty-image.yaml", "image", "image: ''", &[":1:8", "image \"\"", "a picture's name"]),
        ros_with("list-image.yaml", "image", "image: [a, b]", &[":1:8", "broken YAML"]),
        ros_with("negative.yaml", "resolution", "resolution: -0.05", &[":2:13", "resolution \"-0.05\"", "above 0"]),
        ros_with("nan.yaml", "resolution", "resolution: nan", &[":2:13", "resolution \"nan\"", "above 0"]),
        ros_with("infinite.yaml", "resolution", "resolution: 1e999", &[":2:13", "1e999"]),
        ros_with("word.yaml", "resolution", "resolution: fine", &[":2:13", "\"fine\"", "metres per cell"]),
        ros_with("origin-2.yaml", "origin", "origin: [0, 0]", &[":3:9", "origin \"[0, 0]\"", "three numbers"]),
        ros_with("origin-word.yaml", "origin", "origin: [0, 0, north]", &[":3:9", "north", "three numbers"]),
        ros_with("negate.yaml", "negate", "negate: 7", &[":4:9", "negate \"7\"", "0, 1, false or true"]),
        ros_with("percent.yaml", "occupied_thresh", "occupied_thresh: 65", &[":5:18", "occupied_thresh \"65\"", "0 to 1"]),
        ros_with("crossed.yaml", "free_thresh", "free_thresh: 0.9", &[":6:14", "free_thresh 0.9", "less than occupied_thresh, 0.65"]),
        ros_with("mode.yaml", "negate", "negate: 0\nmode: fancy", &[":5:7", "mode \"fancy\"", "trinary, scale or raw"]),
        ros_with("twice.yaml", "negate", "negate: 0\nnegate: 1", &[":5:1", "broken YAML", "negate"]),
        alone("not-utf8.yaml", &b"image: a.pgm\nresolution: \xc3\x28\n"[..], &[":2:13", "byte 0xc3", "UTF-8"]),
        no_picture,
        bad_picture,
        folder,
    ]
}

#[rustfmt::skip]
fn scens() -> Vec<Malformed> {
    let scen = |file, row: &str, words| {
        alone(
            file,
            format!("version 1\n0\ta.map\t4\t3\t0\t0\t3\t2\t4.41\n{row}\n"),
            words,
        )
    };
    vec![
        alone("empty.scen", "", &[":1:1", "end of the file", "\"version 1\""]),
        alone("version.scen", "version 2\n", &[":1:1", "\"version 2\"", "\"version 1\""]),
        scen("columns.scen", "0\ta.map\t4\t3\t0\t0", &[":3", "6 columns", "9: bucket"]),
        scen("outside.scen", "0\ta.map\t4\t3\t0\t0\t4\t2\t4.41", &[":3:17", "\"4\"", "goal's x: below 4"]),
        scen("negative.scen", "0\ta.map\t4\t3\t-1\t0\t3\t2\t4.41", &[":3:13", "\"-1\"", "start's x"]),
        scen("optimum.scen", "0\ta.map\t4\t3\t0\t0\t3\t2\tfar", &[":3:21", "\"far\"", "the optimum"]),
        scen("nan.scen", "0\ta.map\t4\t3\t0\t0\t3\t2\tNaN", &[":3:21", "\"NaN\"", "the optimum"]),
    ]
}

#[rustfmt::skip]
fn scenarios() -> Vec<Malformed> {
    let on_map = |file, text: &str, words| {
        let mut row = alone(file, text, words);
        row.beside = vec![("room.map", map(HEADER, BODY))];
        row
    };
    let asks = |file, more: &str, words| {
        let text = format!("map = 'room.map'\nstart = [0, 0]\ngoal = [3, 2]\n{more}\n");
        on_map(file, &text, words)
    };
    let mut no_map = alone(
        "no-map.toml",
        "map = 'gone.map'\nstart = [0, 0]\ngoal = [1, 1]\n",
        &["cannot be read"],
    );
    no_map.guilty = "gone.map";
    vec![
        alone("empty.toml", "", &["no \"map\"", "a map's file name"]),
        alone("broken.toml", "map = \n", &[":1:", "broken TOML"]),
        alone("not-utf8.toml", &b"map = '\xff'\n"[..], &[":1:8", "byte 0xff", "UTF-8"]),
        no_map,
        on_map("no-goal.toml", "map = 'room.map'\nstart = [0, 0]\n", &["no \"goal\"", "a cell [x, y]"]),
        on_map("map-number.toml", "map = 7\n", &[":1:7", "\"7\"", "a string"]),
        on_map("outside.toml", "map = 'room.map'\nstart = [4, 0]\ngoal = [3, 2]\n", &[":2:9", "[4, 0]", "inside the map of 4 x 3"]),
        on_map("negative.toml", "map = 'room.map'\nstart = [-1, 0]\ngoal = [3, 2]\n", &[":2:10", "\"-1\"", "a whole number from 0"]),
        on_map("triple.toml", "map = 'room.map'\nstart = [1, 0, 0]\ngoal = [3, 2]\n", &[":2:9", "[1, 0, 0]", "a cell [x, y]"]),
        asks("unknown-key.toml", "moevs = 'always'", &[":4:1", "\"moevs\"", "\"moves\""]),
        asks("moves.toml", "moves = 'sideways'", &[":4:9", "sideways", "no-corner-cutting"]),
        asks("radius.toml", "radius = -2", &[":4:10", "\"-2\"", "a number from 0"]),
        asks("no-time.toml", "[[event]]\nblocked = [[1, 1]]", &[":4:1", "no \"at\""]),
        asks("backwards.toml", "[[event]]\nat = 3\ngoal = [0, 0]\n[[event]]\nat = 1\ngoal = [1, 0]", &[":8:6", "\"1\"", "3 or later"]),
        asks("nothing.toml", "[[event]]\nat = 3", &[":4:1", "without a change", "blocked"]),
        asks("event-outside.toml", "[[event]]\nat = 3\nblocked = [[1, 1], [1, 3]]", &[":6:20", "[1, 3]", "inside the map"]),
        asks("rectangle.toml", "[[event]]\nat = 3\nfreed = [[1, 1, 4294967295, 2]]", &[":6:10", "4294967295", "inside the map"]),
        asks("cost.toml", "[[event]]\nat = 3\ncost = { value = 255, cells = [[1, 1]] }", &[":6:18", "\"255\"", "1 to 254"]),
        asks("twice.toml", "[[case]]\nname = 'a'\n[[case]]\nname = 'a'", &[":7:8", "'a'", "no other case"]),
        asks("follows.toml", "[[case]]\nname = 'a'\nfollows = 'b'", &[":6:11", "'b'", "an earlier case"]),
    ]
}

/// A PNG file whose header states `size`, bits per sample and colour type; `rows` is its data,
/// stored as it is.
fn png(size: [u32; 2], bits: u8, colour: u8, rows: &[u8]) -> Vec<u8> {
    let mut header = Vec::new();
    header.extend(size[0].to_be_bytes());
    header.extend(size[1].to_be_bytes());
    header.extend([bits, colour, 0, 0, 0]);

    let length = u16::try_from(rows.len()).expect("a short row");
    let mut data = vec![0x78, 0x01, 1];
    data.extend(length.to_le_bytes());
    data.extend((!length).to_le_bytes());
    data.extend(rows);
    let (mut a, mut b) = (1u32, 0u32);
    for &byte in rows {
        a = (a + u32::from(byte)) % 65521;
        b = (b + a) % 65521;
    }
    data.extend((b << 16 | a).to_be_bytes());

    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    for (kind, content) in [(b"IHDR", &header), (b"IDAT", &data), (b"IEND", &Vec::new())] {
        let checked = [kind.as_slice(), content].concat();
        file.extend(
            u32::try_from(content.len())
                .expect("a short chunk")
                .to_be_bytes(),
        );
        file.extend(&checked);
        file.extend(crc(&checked).to_be_bytes());
    }
    file
}

/// CRC-32, bit by bit.
fn crc(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| {
        if crc & 1 == 1 {
            crc >> 1 ^ 0xedb8_8320
        } else {
            crc >> 1
        }
    };
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), step)
    })
}
