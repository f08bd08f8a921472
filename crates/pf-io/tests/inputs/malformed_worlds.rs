//! Malformed worlds and scenarios in worlds, and the words that an error about each must contain.
//! Shared with the program's tests; it needs nothing but the standard library.

/// A malformed input.
#[derive(Debug)]
pub(crate) struct Malformed {
    /// The file that is handed in.
    pub(crate) file: &'static str,
    /// Its content.
    pub(crate) bytes: Vec<u8>,
    /// Whether it is a scenario, else it is a world.
    pub(crate) scenario: bool,
    /// Files that lie beside it.
    pub(crate) beside: Vec<(&'static str, Vec<u8>)>,
    /// What the message must contain, the name of the guilty file aside.
    pub(crate) words: &'static [&'static str],
    /// The file that the message must name, if it is another.
    pub(crate) guilty: &'static str,
}

type Words = &'static [&'static str];

/// Every malformed input.
pub(crate) fn all() -> Vec<Malformed> {
    let mut all = Vec::new();
    all.extend(files());
    all.extend(circles());
    all.extend(rectangles());
    all.extend(polygons());
    all.extend(robots());
    all.extend(geojson_objects());
    all.extend(geojson_shapes());
    all.extend(scenarios());
    all.extend(changes());
    all
}

fn world(file: &'static str, bytes: impl Into<Vec<u8>>, words: Words) -> Malformed {
    Malformed {
        file,
        bytes: bytes.into(),
        scenario: false,
        beside: Vec::new(),
        words,
        guilty: file,
    }
}

const BOUNDS: &str = "bounds = { min = [0, 0], max = [9, 9] }\n";

/// Bounds in line 1, a table `[[kind]]` in line 2, its content from line 3.
fn with(file: &'static str, kind: &str, content: &str, words: Words) -> Malformed {
    world(file, format!("{BOUNDS}[[{kind}]]\n{content}\n"), words)
}

#[rustfmt::skip]
fn files() -> Vec<Malformed> {
    let bounds = |file, bounds: &str, words| world(file, format!("bounds = {bounds}\n"), words);
    let deep = "[".repeat(100_000);
    vec![
        world("broken.toml", "bounds = {\n[[circle]]\n", &[":2:1", "broken TOML"]),
        world("truncated.toml", format!("{BOUNDS}[[circle]]\ncentre = [1, "), &[":3:", "broken TOML"]),
        world("not-utf8.toml", &b"title = '\xff'\n"[..], &[":1:10", "byte 0xff", "UTF-8"]),
        world("deep.toml", format!("{BOUNDS}circle = {deep}"), &[":2:", "broken TOML"]),
        world("no-bounds.toml", "[[circle]]\ncentre = [1, 1]\nradius = 1\n", &["no \"bounds\"", "min = [x, y], max = [x, y]"]),
        world("key.toml", format!("{BOUNDS}tilte = 'T'\n"), &[":2:1", "\"tilte\"", "\"title\""]),
        world("kind.toml", format!("{BOUNDS}[[triangle]]\ncorners = []\n"), &[":2:3", "\"triangle\"", "one of title, source"]),
        world("title.toml", format!("{BOUNDS}title = 7\n"), &[":2:9", "\"7\"", "a string"]),
        world("shapes.toml", format!("{BOUNDS}circle = 3\n"), &[":2:10", "\"3\"", "an array of tables"]),
        bounds("bounds-list.toml", "[0, 0, 9, 9]", &[":1:10", "[0, 0, 9, 9]", "a table"]),
        bounds("bounds-half.toml", "{ min = [0, 0] }", &[":1:10", "no \"max\"", "a point [x, y]"]),
        bounds("bounds-flat.toml", "{ min = [0, 0], max = [9, 0] }", &[":1:10", "height 0 as bounds", "a positive number"]),
        bounds("bounds-swapped.toml", "{ min = [9, 9], max = [0, 0] }", &[":1:10", "width -9", "a positive number"]),
        bounds("bounds-nan.toml", "{ min = [0, nan], max = [9, 9] }", &[":1:22", "\"nan\"", "between -1e12 and 1e12"]),
        bounds("bounds-infinite.toml", "{ min = [0, 0], max = [inf, 9] }", &[":1:33", "\"inf\"", "between -1e12 and 1e12"]),
        bounds("bounds-huge.toml", "{ min = [0, 0], max = [1e300, 9] }", &[":1:33", "\"1e300\"", "between -1e12 and 1e12"]),
    ]
}

#[rustfmt::skip]
fn circles() -> Vec<Malformed> {
    let circle = |file, content: &str, words| with(file, "circle", content, words);
    vec![
        circle("circle-nan.toml", "centre = [nan, 1]\nradius = 1", &[":3:11", "\"nan\"", "the circle's centre"]),
        circle("circle-infinite.toml", "centre = [1, 1]\nradius = inf", &[":4:10", "\"inf\"", "the circle's radius"]),
        circle("circle-zero.toml", "centre = [1, 1]\nradius = 0", &[":2:1", "radius 0 in circle (shape 0)", "a positive number"]),
        circle("circle-negative.toml", "name = 'silo'\ncentre = [1, 1]\nradius = -2.5", &[":2:1", "radius -2.5 in circle \"silo\" (shape 0)", "a positive number"]),
        circle("circle-word.toml", "centre = [1, 1]\nradius = 'wide'", &[":4:10", "wide", "a number"]),
        circle("circle-overflow.toml", "centre = [1, 1]\nradius = 99999999999999999999999", &[":4:10", "99999999999999999999999"]),
        circle("circle-point.toml", "centre = [1, 1, 1]\nradius = 1", &[":3:10", "[1, 1, 1]", "a point [x, y]"]),
        circle("circle-place.toml", "centre = 4\nradius = 1", &[":3:10", "\"4\"", "a point [x, y]"]),
        circle("circle-no-radius.toml", "centre = [1, 1]", &[":2:1", "no \"radius\"", "a positive number"]),
        circle("circle-key.toml", "center = [1, 1]\nradius = 1", &[":3:1", "\"center\"", "\"centre\""]),
        circle("circle-name.toml", "name = ''\ncentre = [1, 1]\nradius = 1", &[":3:8", "a name, not an empty string"]),
    ]
}

#[rustfmt::skip]
fn rectangles() -> Vec<Malformed> {
    let rectangle = |file, content: &str, words| with(file, "rectangle", content, words);
    vec![
        rectangle("rectangle-flat.toml", "min = [1, 1]\nmax = [1, 4]", &[":2:1", "width 0 in rectangle (shape 0)", "a positive number"]),
        rectangle("rectangle-swapped.toml", "min = [1, 4]\nmax = [3, 1]", &[":2:1", "height -3", "a positive number"]),
        rectangle("rectangle-nan.toml", "min = [1, 1]\nmax = [2, -nan]", &[":4:11", "\"-nan\"", "the rectangle's upper corner"]),
        rectangle("rectangle-no-max.toml", "min = [1, 1]", &[":2:1", "no \"max\""]),
        rectangle("rectangle-peak.toml", "min = [1, 1]\nmax = [2, 2]\npeak = [2.5, 1.5]", &[":2:1", "peak (2.5, 1.5)", "a point in it"]),
        rectangle("rectangle-radius.toml", "min = [1, 1]\nmax = [2, 2]\nradius = 1", &[":5:1", "\"radius\"", "one of name, min, max, peak"]),
    ]
}

#[rustfmt::skip]
fn polygons() -> Vec<Malformed> {
    let polygon = |file, corners: &str, words| with(file, "polygon", &format!("corners = {corners}"), words);
    let many = "[1,2],".repeat(100_001);
    vec![
        polygon("polygon-crossing.toml", "[[0, 0], [2, 2], [2, 0], [0, 2]]", &[":2:1", "touched by its side 2 at its side 0 in polygon (shape 0)", "a simple one"]),
        polygon("polygon-touching.toml", "[[0, 0], [4, 0], [4, 2], [2, 0], [0, 2]]", &[":2:1", "border touched", "a simple one"]),
        polygon("polygon-spike.toml", "[[0, 0], [4, 0], [2, 0], [2, 3]]", &[":2:1", "border touched", "a simple one"]),
        polygon("polygon-flat.toml", "[[0, 0], [1, 1], [2, 2]]", &[":2:1", "border touched", "a simple one"]),
        polygon("polygon-twice.toml", "[[0, 0], [1, 0], [1, 0], [0, 2]]", &[":2:1", "corner 1 its corner 2", "another"]),
        polygon("polygon-closed.toml", "[[0, 0], [1, 0], [0, 2], [0, 0]]", &[":2:1", "corner 3 its corner 0", "another"]),
        polygon("polygon-two.toml", "[[0, 0], [1, 1]]", &[":2:1", "2 corners", "at least 3"]),
        polygon("polygon-empty.toml", "[]", &[":2:1", "0 corners", "at least 3"]),
        polygon("polygon-nan.toml", "[[0, 0], [1, 0], [nan, 2]]", &[":3:29", "\"nan\"", "a corner"]),
        polygon("polygon-numbers.toml", "[0, 0, 1, 0, 0, 2]", &[":3:12", "\"0\"", "a point [x, y]"]),
        polygon("polygon-many.toml", &format!("[{many}]"), &[":3:11", "at most 100000 corners"]),
        polygon("polygon-many-alike.toml", &format!("[{}]", &many[6..]), &[":2:1", "corner 0 its corner 1", "another"]),
    ]
}

#[rustfmt::skip]
fn robots() -> Vec<Malformed> {
    let robot = |file, content: &str, words| with(file, "robot", content, words);
    let ends = "start = [1, 1]\ngoal = [8, 8]";
    vec![
        robot("robot-radius.toml", &format!("{ends}\nradius = -1"), &[":5:10", "\"-1\"", "the robot's radius: a number from 0"]),
        robot("robot-nan.toml", &format!("{ends}\nradius = nan"), &[":5:10", "\"nan\"", "the robot's radius"]),
        robot("robot-outside.toml", "start = [1, 1]\ngoal = [8, 9.5]", &[":4:8", "[8, 9.5]", "within the bounds, [0, 0] to [9, 9]"]),
        robot("robot-no-start.toml", "goal = [8, 8]", &[":2:1", "no \"start\"", "a point [x, y]"]),
        robot("robot-speed.toml", &format!("{ends}\nspeed = 0"), &[":5:9", "\"0\"", "above 0"]),
    ]
}

#[rustfmt::skip]
fn geojson_objects() -> Vec<Malformed> {
    let deep = r#"{"type":"GeometryCollection","geometries":["#.repeat(10_000);
    let feature = |file, feature: &str, words| {
        let json = format!("{{\"type\": \"FeatureCollection\", \"bbox\": [0, 0, 9, 9], \"features\": [\n{feature}\n]}}");
        world(file, json, words)
    };
    let boxed = |file, bbox: &str, words| {
        world(file, format!("{{\"type\": \"FeatureCollection\", \"features\": [],\n\"bbox\": {bbox}}}"), words)
    };
    vec![
        world("empty.geojson", "", &[":1:1", "broken JSON: EOF", "a GeoJSON object"]),
        world("truncated.geojson", "{\"type\": \"FeatureCollection\",\n\"features\": [", &[":2:1", "broken JSON: EOF", "a GeoJSON object"]),
        world("list.geojson", "[1, 2]", &[":1:", "a GeoJSON object"]),
        world("untyped.geojson", "{\"features\": []}", &["missing field `type`", "a GeoJSON object"]),
        world("nan.json", "{\"type\": \"Polygon\",\n\"coordinates\": [[[0, NaN]]]}", &[":2:", "broken JSON", "a GeoJSON object"]),
        world("infinite.json", "{\"type\": \"Polygon\",\n\"coordinates\": [[[0, 1e999]]]}", &[":2:", "number out of range"]),
        world("not-utf8.geojson", &b"{\"type\": \"\xc3\x28\"}"[..], &[":1:11", "byte 0xc3", "UTF-8"]),
        world("deep.geojson", deep, &[":1:", "a GeoJSON object"]),
        world("line.geojson", "{\"type\": \"LineString\", \"coordinates\": [[0, 0], [1, 1]]}", &[":1:1", "\"LineString\"", "a FeatureCollection, a Feature, a Polygon"]),
        world("topology.json", "{\"type\": \"Topology\", \"arcs\": []}", &[":1:1", "\"Topology\"", "a FeatureCollection"]),
        world("no-features.geojson", "{\"type\": \"FeatureCollection\"}", &[":1:1", "no \"features\"", "an array of features"]),
        world("nothing.geojson", "{\"type\": \"FeatureCollection\", \"features\": []}", &[":1:1", "neither shapes nor a \"bbox\"", "as bounds"]),
        boxed("bbox-two.geojson", "[0, 0]", &[":2:9", "a bbox of 2 numbers", "[xmin, ymin, xmax, ymax]"]),
        boxed("bbox-swapped.geojson", "[9, 0, 0, 9]", &[":2:9", "width -9 as bbox", "a positive number"]),
        boxed("bbox-word.geojson", "\"all\"", &[":2:", "invalid type: string", "a bbox"]),
        boxed("bbox-huge.geojson", "[0, 0, 1e200, 9]", &[":2:9", "1e200", "between -1e12 and 1e12"]),
        feature("features.geojson", "{\"type\": \"Polygon\", \"coordinates\": []}", &[":2:1", "\"Polygon\"", "a Feature"]),
        feature("no-geometry.geojson", "{\"type\": \"Feature\", \"geometry\": null}", &[":2:1", "without a geometry", "a Polygon, a MultiPolygon"]),
        feature("multi-point.geojson", "{\"type\": \"Feature\", \"geometry\":\n{\"type\": \"MultiPoint\", \"coordinates\": [[1, 1]]}}", &[":3:1", "\"MultiPoint\"", "a Polygon, a MultiPolygon"]),
        feature("multi-line.geojson", "{\"type\": \"Feature\", \"geometry\":\n{\"type\": \"MultiLineString\", \"coordinates\": []}}", &[":3:1", "\"MultiLineString\""]),
        feature("inner-line.geojson", "{\"type\": \"Feature\", \"geometry\":\n{\"type\": \"GeometryCollection\", \"geometries\": [{\"type\": \"LineString\", \"coordinates\": [[1, 1], [2, 2]]}]}}", &[":3:1", "\"LineString\""]),
        feature("no-coordinates.geojson", "{\"type\": \"Feature\", \"geometry\":\n{\"type\": \"Polygon\"}}", &[":3:", "coordinates", "a GeoJSON Polygon"]),
        feature("properties.geojson", "{\"type\": \"Feature\", \"properties\": 7, \"geometry\": {\"type\": \"Point\", \"coordinates\": [1, 1]}}", &[":2:", "an object of properties"]),
    ]
}

#[rustfmt::skip]
fn geojson_shapes() -> Vec<Malformed> {
    let geometry = |file, properties: &str, kind: &str, coordinates: &str, words| {
        let json = format!("{{\"type\": \"Feature\", \"properties\": {{{properties}}}, \"geometry\":\n{{\"type\": \"{kind}\", \"coordinates\": {coordinates}}}}}");
        world(file, json, words)
    };
    let point = |file, properties: &str, words| geometry(file, properties, "Point", "[1, 1]", words);
    let polygon = |file, coordinates: &str, words| geometry(file, "\"name\": \"hall\"", "Polygon", coordinates, words);
    let square = "[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]]";
    let hole = "[[1, 1], [1, 2], [2, 2], [1, 1]]";
    vec![
        point("point.geojson", "", &[":2:1", "a Point without a property \"radius\"", "with a radius"]),
        point("radius-word.geojson", "\"radius\": \"big\"", &[":2:1", "the radius", "big", "a number"]),
        point("radius-zero.geojson", "\"radius\": 0", &[":2:1", "radius 0 in circle (shape 0)", "a positive number"]),
        point("radius-negative.geojson", "\"radius\": -3, \"name\": \"silo\"", &[":2:1", "radius -3 in circle \"silo\" (shape 0)", "a positive number"]),
        geometry("point-empty.geojson", "\"radius\": 1", "Point", "[]", &[":2:", "a GeoJSON Point"]),
        geometry("point-huge.geojson", "\"radius\": 1", "Point", "[1e300, 0]", &[":2:1", "[1e300, 0.0]", "between -1e12 and 1e12"]),
        polygon("hole.geojson", &format!("[{square}, {hole}]"), &[":2:1", "a hole in polygon \"hall\" (shape 0)", "no holes"]),
        polygon("no-ring.geojson", "[]", &[":2:1", "polygon", "ring"]),
        polygon("open.geojson", "[[[0, 0], [9, 0], [9, 9], [0, 9]]]", &[":2:1", "an open ring in polygon \"hall\"", "ends where it begins"]),
        polygon("crossing.geojson", "[[[0, 0], [2, 2], [2, 0], [0, 2], [0, 0]]]", &[":2:1", "touched by its side 2 at its side 0 in polygon \"hall\" (shape 0)", "a simple one"]),
        polygon("two.geojson", "[[[0, 0], [2, 2], [0, 0]]]", &[":2:1", "2 corners", "at least 3"]),
        polygon("position.geojson", "[[[0, 0], [2], [0, 1], [0, 0]]]", &[":2:1", "a position of 1 number", "two: [x, y]"]),
        polygon("position-word.geojson", "[[[0, 0], [\"a\", 2], [0, 1], [0, 0]]]", &[":2:", "a GeoJSON Polygon"]),
        polygon("flat-array.geojson", "[[0, 0], [2, 1], [0, 1], [0, 0]]", &[":2:", "a GeoJSON Polygon"]),
        polygon("many.geojson", &format!("[[{}[1, 2]]]", "[1,2],".repeat(100_001)), &[":2:1", "100002 corners in polygon", "at most 100000"]),
        geometry("second.geojson", "", "MultiPolygon", &format!("[[{square}], [[[0, 0], [1, 0], [0, 0]]]]"), &[":2:1", "2 corners in polygon (shape 1)", "at least 3"]),
    ]
}

/// A yard with a truck, a circle without a name, and two robots.
const YARD: &str = "bounds = { min = [0, 0], max = [20, 10] }
[[robot]]
name = 'courier'
start = [1, 1]
goal = [19, 9]
[[robot]]
name = 'sweeper'
start = [1, 2]
goal = [19, 2]
[[rectangle]]
name = 'truck'
min = [9, 4]
max = [12, 6]
[[circle]]
centre = [15, 3]
radius = 1
";

fn scenario(file: &'static str, bytes: impl Into<Vec<u8>>, words: Words) -> Malformed {
    let mut row = world(file, bytes, words);
    row.scenario = true;
    row.beside = vec![("yard.toml", YARD.into()), ("room.map", ROOM.into())];
    row
}

const ROOM: &str = "type octile\nheight 1\nwidth 3\nmap\n...\n";

#[rustfmt::skip]
fn scenarios() -> Vec<Malformed> {
    let mut gone = scenario("gone.toml", "world = 'gone-world.toml'\n", &["cannot be read"]);
    gone.guilty = "gone-world.toml";
    let mut grid = scenario("on-a-grid.toml", "world = 'room.map'\n", &["a grid", "a world"]);
    grid.guilty = "room.map";
    let mut bad = scenario("bad-world.toml", "world = 'bad.toml'\n", &[":1:10", "width 0", "a positive number"]);
    bad.beside = vec![("bad.toml", b"bounds = { min = [0, 0], max = [0, 9] }\n".to_vec())];
    bad.guilty = "bad.toml";
    let asks = |file, more: &str, words| scenario(file, format!("world = 'yard.toml'\n{more}\n"), words);
    vec![
        gone,
        grid,
        bad,
        scenario("both.toml", "world = 'yard.toml'\nmap = 'room.map'\n", &[":2:1", "\"map\"", "one of title"]),
        asks("which-robot.toml", "goal = [1, 1]", &["no \"start\"", "\"robot\" and its name"]),
        asks("robot.toml", "robot = 'corier'", &[":2:9", "corier", "one of courier, sweeper"]),
        asks("outside.toml", "robot = 'courier'\ngoal = [1, 11]", &[":3:8", "[1, 11]", "within the bounds, [0, 0] to [20, 10]"]),
        asks("nan-start.toml", "robot = 'courier'\nstart = [nan, 1]", &[":3:10", "\"nan\"", "a number"]),
        asks("radius.toml", "robot = 'courier'\nradius = -1", &[":3:10", "\"-1\"", "a number from 0"]),
        asks("grid-key.toml", "robot = 'courier'\n[[event]]\nat = 1\nblocked = [[1, 1]]", &[":5:1", "\"blocked\"", "one of at, name, start, goal, remove, move, add"]),
        asks("nothing.toml", "robot = 'courier'\n[[event]]\nat = 1", &[":3:1", "without a change", "one of start, goal, remove, move, add"]),
        asks("backwards.toml", "robot = 'courier'\n[[event]]\nat = 3\ngoal = [1, 1]\n[[event]]\nat = 2\ngoal = [2, 2]", &[":7:6", "\"2\"", "3 or later"]),
        asks("fixed.toml", "robot = 'courier'\n[[case]]\nname = 'a'\n[[case]]\nname = 'b'\nfollows = 'a'\nradius = 1", &[":8:10", "\"1\"", "no \"radius\" in a case that follows"]),
        asks("length.toml", "robot = 'courier'\nexpected = { length = -1 }", &[":3:23", "\"-1\"", "how long a shortest path is"]),
    ]
}

#[rustfmt::skip]
fn changes() -> Vec<Malformed> {
    let event = |file, more: &str, words| {
        scenario(file, format!("world = 'yard.toml'\nrobot = 'courier'\n[[event]]\nat = 1\n{more}\n"), words)
    };
    vec![
        event("remove-id.toml", "remove = [0, 2]", &[":5:14", "\"2\"", "ids go from 0 to 1"]),
        event("remove-name.toml", "remove = ['tuck']", &[":5:11", "tuck", "\"truck\""]),
        event("remove-stranger.toml", "remove = ['crane']", &[":5:11", "crane", "the name of a shape that is there"]),
        event("remove-twice.toml", "remove = [1]\n[[event]]\nat = 2\nremove = [1]", &[":8:11", "\"1\"", "the id of a shape that is there"]),
        event("remove-and-move.toml", "remove = ['truck']\nmove = { shape = 'truck', by = [1, 0] }", &[":6:18", "truck", "the name of a shape that is there"]),
        event("remove-all.toml", "remove = [0, 1]\n[[event]]\nat = 2\nremove = [0]", &[":8:11", "there are none"]),
        event("remove-negative.toml", "remove = [-1]", &[":5:11", "\"-1\"", "a shape's name or its id"]),
        event("remove-one.toml", "remove = 'truck'", &[":5:10", "truck", "an array of shapes' names and ids"]),
        event("move-by.toml", "move = { shape = 'truck' }", &[":5:8", "no \"by\"", "how far"]),
        event("move-nan.toml", "move = { shape = 'truck', by = [nan, 0] }", &[":5:33", "\"nan\"", "how far"]),
        event("move-to.toml", "move = { shape = 'truck', to = [1, 0] }", &[":5:27", "\"to\"", "\"by\""]),
        event("add-nothing.toml", "add = { name = 'ghost' }", &[":5:7", "none of the keys of a shape", "centre and radius"]),
        event("add-key.toml", "add = { center = [1, 1], radius = 1 }", &[":5:9", "\"center\"", "\"centre\""]),
        event("add-zero.toml", "add = [{ centre = [1, 1], radius = 1 }, { name = 'box', min = [1, 1], max = [1, 2] }]", &[":5:41", "width 0 in rectangle \"box\" (shape 3)", "a positive number"]),
        event("add-crossing.toml", "add = { corners = [[0, 0], [2, 2], [2, 0], [0, 2]] }", &[":5:7", "border touched", "polygon (shape 2)"]),
    ]
}
