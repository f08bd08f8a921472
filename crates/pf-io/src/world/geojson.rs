//! Worlds in GeoJSON (RFC 7946), its coordinates taken as those of a plane.
//!
//! The text is taken apart down to single geometries, so that each keeps its place for messages;
//! the geometries themselves are the `geojson` crate's.

mod write;

pub use write::write_geojson;

use super::{
    Names, Robot, WorldFile,
    shapes::{MOST_CORNERS, a_point_within, called, found_and_expected},
};
use crate::{
    FileError, Place,
    error::quoted,
    source,
    source::{Source, place_of},
    toml_tree::{A_NUMBER, LARGEST},
};
use ::geojson::{Geometry, GeometryValue, JsonObject, JsonValue, Position, feature::Id};
use pf_core::InvalidProblem;
use pf_geom::{Circle, Point, Polygon, Rectangle, Shape, Vector, World};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use serde_json::value::RawValue;
use std::path::Path;

const GEOMETRIES: &str =
    "a Polygon, a MultiPolygon, a GeometryCollection of those, or a Point with a \"radius\"";
const OBJECTS: &str = "a FeatureCollection, a Feature, a Polygon, a MultiPolygon, a \
                       GeometryCollection of those, or a Point with a \"radius\"";

/// Reads a GeoJSON file; bounds that it does not state (`bbox`) lie `margin` around its shapes.
///
/// # Errors
/// [`FileError`] if the file cannot be read or is not a world.
pub fn read_geojson(path: &Path, margin: f64) -> Result<WorldFile, FileError> {
    parse_geojson(&path.display().to_string(), &source::read(path)?, margin)
}

/// Reads the content of a GeoJSON file; `name` is for errors and becomes the world's
/// [`file`](WorldFile::file).
///
/// # Errors
/// As [`read_geojson`].
pub fn parse_geojson(name: &str, bytes: &[u8], margin: f64) -> Result<WorldFile, FileError> {
    parse(name, bytes, Some(margin))
}

/// Without a margin, a tenth of the longer side of the shapes' box.
pub(crate) fn parse(name: &str, bytes: &[u8], margin: Option<f64>) -> Result<WorldFile, FileError> {
    let source = Source { name, bytes };
    let text = source.text()?;
    let mut reader = Reader {
        source,
        text,
        shapes: Vec::new(),
        names: Names::default(),
    };
    let top: Node<'_> = reader.node(text)?;
    reader.object(&top, text)?;
    let bounds = match top.bbox {
        Some(bbox) => reader.bbox(bbox)?,
        None => reader.around(margin)?,
    };
    let robots = match top.robots {
        Some(raw) => reader.robots(raw, &bounds)?,
        None => Vec::new(),
    };
    Ok(WorldFile {
        world: World::with_shapes(bounds, reader.shapes).into(),
        names: reader.names,
        robots,
        title: text_of(top.title),
        source: text_of(top.source),
        provenance: text_of(top.provenance),
        file: name.into(),
    })
}

/// The members of an object of any type that matter here.
#[derive(Deserialize)]
struct Node<'a> {
    #[serde(rename = "type")]
    kind: String,
    #[serde(borrow)]
    features: Option<Vec<&'a RawValue>>,
    #[serde(borrow)]
    geometry: Option<&'a RawValue>,
    #[serde(borrow)]
    properties: Option<&'a RawValue>,
    id: Option<Id>,
    #[serde(borrow)]
    bbox: Option<&'a RawValue>,
    // Members of ours, on the outermost object; RFC 7946 section 6.1 lets them be.
    #[serde(borrow)]
    title: Option<&'a RawValue>,
    #[serde(borrow)]
    source: Option<&'a RawValue>,
    #[serde(borrow)]
    provenance: Option<&'a RawValue>,
    #[serde(borrow)]
    robots: Option<&'a RawValue>,
}

/// A member that others may mean otherwise: its text, if it is one.
fn text_of(member: Option<&RawValue>) -> Option<String> {
    serde_json::from_str(member?.get()).ok()
}

/// A robot as a member of ours.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct RobotMember {
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    radius: f64,
    start: [f64; 2],
    goal: [f64; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    speed: Option<f64>,
}

/// What a feature says of its shapes.
#[derive(Clone, Copy)]
struct About<'p> {
    name: Option<&'p str>,
    properties: &'p JsonObject,
}

struct Reader<'a> {
    source: Source<'a>,
    text: &'a str,
    shapes: Vec<Shape>,
    names: Names,
}

impl<'a> Reader<'a> {
    /// The place of a part of the text, or further on in it.
    fn place(&self, part: &str, offset: usize) -> Place {
        // A raw value is a slice of the text it was read from.
        let start = part.as_ptr().addr() - self.text.as_ptr().addr();
        place_of(self.text, start + offset)
    }

    fn error(
        &self,
        part: &str,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> FileError {
        self.source.error(self.place(part, 0), found, expected)
    }

    /// What serde found wrong in a part of the text.
    fn broken(&self, part: &str, error: &serde_json::Error, expected: &str) -> FileError {
        let mut message = error.to_string();
        if let Some(at) = message.rfind(" at line ") {
            message.truncate(at);
        }
        let before = error.line().saturating_sub(1);
        let line = part.split_inclusive('\n').take(before).map(str::len);
        let offset = line.sum::<usize>() + error.column().saturating_sub(1);
        let kind = if error.is_data() { "" } else { "broken JSON: " };
        let found = format!("{kind}{message}");
        self.source.error(self.place(part, offset), found, expected)
    }

    fn node(&self, part: &'a str) -> Result<Node<'a>, FileError> {
        serde_json::from_str(part).map_err(|error| self.broken(part, &error, "a GeoJSON object"))
    }

    fn of_ours<T: DeserializeOwned>(&self, part: &str, expected: &str) -> Result<T, FileError> {
        serde_json::from_str(part).map_err(|error| self.broken(part, &error, expected))
    }

    fn object(&mut self, node: &Node<'a>, part: &'a str) -> Result<(), FileError> {
        match node.kind.as_str() {
            "FeatureCollection" => {
                let Some(features) = &node.features else {
                    return Err(self.error(part, "no \"features\"", "an array of features"));
                };
                for feature in features {
                    let part = feature.get();
                    let node = self.node(part)?;
                    if node.kind != "Feature" {
                        let found = format!("the type {}", quoted(&node.kind));
                        return Err(self.error(part, found, "a Feature"));
                    }
                    self.feature(&node, part)?;
                }
                Ok(())
            }
            "Feature" => self.feature(node, part),
            _ => {
                let properties = JsonObject::new();
                let about = About {
                    name: None,
                    properties: &properties,
                };
                self.geometry(node, part, about, OBJECTS)
            }
        }
    }

    fn feature(&mut self, node: &Node<'a>, part: &'a str) -> Result<(), FileError> {
        let Some(geometry) = node.geometry else {
            let found = "a Feature without a geometry";
            return Err(self.error(part, found, GEOMETRIES));
        };
        let properties: JsonObject = match node.properties {
            Some(raw) => self.of_ours(raw.get(), "an object of properties")?,
            None => JsonObject::new(),
        };
        let id = node.id.as_ref().map(|id| match id {
            Id::String(id) => id.clone(),
            Id::Number(id) => id.to_string(),
        });
        let name = properties.get("name").and_then(JsonValue::as_str);
        let about = About {
            name: name.or(id.as_deref()).filter(|name| !name.is_empty()),
            properties: &properties,
        };
        let part = geometry.get();
        let node = self.node(part)?;
        self.geometry(&node, part, about, GEOMETRIES)
    }

    fn geometry(
        &mut self,
        node: &Node<'a>,
        part: &'a str,
        about: About<'_>,
        expected: &str,
    ) -> Result<(), FileError> {
        let known = ["Polygon", "MultiPolygon", "GeometryCollection", "Point"];
        if !known.contains(&node.kind.as_str()) {
            let found = format!("the type {}", quoted(&node.kind));
            return Err(self.error(part, found, expected));
        }
        let geometry: Geometry = serde_json::from_str(part)
            .map_err(|error| self.broken(part, &error, &format!("a GeoJSON {}", node.kind)))?;
        self.value(&geometry.value, part, about)
    }

    fn value(
        &mut self,
        value: &GeometryValue,
        part: &str,
        about: About<'_>,
    ) -> Result<(), FileError> {
        match value {
            GeometryValue::Polygon { coordinates } => self.polygon(coordinates, part, about),
            GeometryValue::MultiPolygon { coordinates } => coordinates
                .iter()
                .try_for_each(|rings| self.polygon(rings, part, about)),
            GeometryValue::GeometryCollection { geometries } => geometries
                .iter()
                .try_for_each(|geometry| self.value(&geometry.value, part, about)),
            GeometryValue::Point { coordinates } => self.circle(coordinates, part, about),
            other => {
                let found = format!("the type \"{}\"", other.type_name());
                Err(self.error(part, found, GEOMETRIES))
            }
        }
    }

    fn circle(&mut self, centre: &Position, part: &str, about: About<'_>) -> Result<(), FileError> {
        let centre = self.point(centre, part)?;
        let Some(radius) = about.properties.get("radius") else {
            let found = "a Point without a property \"radius\"";
            return Err(self.error(part, found, "a Point of a Feature with a radius"));
        };
        let radius = radius.as_f64().filter(|r| r.abs() <= LARGEST);
        let Some(radius) = radius else {
            let found = format!(
                "the radius {}",
                quoted(&about.properties["radius"].to_string())
            );
            return Err(self.error(part, found, A_NUMBER));
        };
        let circle = Circle::new(centre, radius).map(Shape::from);
        self.add(circle, "circle", part, about)
    }

    fn polygon(
        &mut self,
        rings: &[Vec<Position>],
        part: &str,
        about: About<'_>,
    ) -> Result<(), FileError> {
        let whose = called("polygon", self.shapes.len(), about.name);
        let ring = match rings {
            [ring] => ring,
            [] => {
                return Err(self.error(part, format!("no ring in {whose}"), "an outer ring"));
            }
            more => {
                let holes = match more.len() - 1 {
                    1 => "a hole".to_owned(),
                    n => format!("{n} holes"),
                };
                let found = format!("{holes} in {whose}");
                let expected = "no holes: what a hole leaves free cannot be said by one shape";
                return Err(self.error(part, found, expected));
            }
        };
        if ring.len() > MOST_CORNERS {
            let found = format!("{} corners in {whose}", ring.len());
            return Err(self.error(part, found, format!("at most {MOST_CORNERS}")));
        }
        let mut corners = Vec::with_capacity(ring.len());
        for position in ring {
            corners.push(self.point(position, part)?);
        }
        if corners.len() > 1 && corners.first() != corners.last() {
            let found = format!("an open ring in {whose}");
            return Err(self.error(part, found, "a ring that ends where it begins"));
        }
        corners.pop();
        // The format does not forbid to say a corner twice, and it changes nothing.
        corners.dedup();
        let shape = match upright(&corners) {
            Some((min, max)) if about.properties.get("shape") == Some(&"rectangle".into()) => {
                let peak = about.properties.get("peak").cloned();
                let peak = peak.map(serde_json::from_value::<[f64; 2]>).transpose();
                let Ok(peak) = peak else {
                    let found = format!("a \"peak\" in {whose}");
                    return Err(self.error(part, found, "an array [x, y]"));
                };
                Rectangle::new(min, max)
                    .and_then(|r| peak.map_or(Ok(r), |p| r.with_peak(p.into())))
                    .map(Shape::from)
            }
            _ => Polygon::new(corners).map(Shape::from),
        };
        self.add(shape, "polygon", part, about)
    }

    fn add(
        &mut self,
        shape: Result<Shape, InvalidProblem>,
        kind: &str,
        part: &str,
        about: About<'_>,
    ) -> Result<(), FileError> {
        let shape = shape.map_err(|error| {
            let (found, expected) = found_and_expected(&error);
            let whose = called(kind, self.shapes.len(), about.name);
            self.error(part, format!("{found} in {whose}"), expected)
        })?;
        self.names.push(about.name.map(str::to_owned));
        self.shapes.push(shape);
        Ok(())
    }

    /// A position's x and y; what follows (a height) does not matter in the plane.
    fn point(&self, position: &Position, part: &str) -> Result<Point, FileError> {
        match *position.as_slice() {
            [x, y, ..] if x.abs() <= LARGEST && y.abs() <= LARGEST => Ok(Point::new(x, y)),
            [x, y, ..] => {
                let expected = format!("coordinates: each {A_NUMBER}");
                Err(self.error(part, format!("the position [{x:?}, {y:?}]"), expected))
            }
            ref short => {
                let found = format!("a position of {} number", short.len());
                Err(self.error(part, found, "two: [x, y]"))
            }
        }
    }

    fn bbox(&self, raw: &RawValue) -> Result<Rectangle, FileError> {
        let part = raw.get();
        let expected = "a bbox [xmin, ymin, xmax, ymax]";
        let numbers: Vec<f64> = self.of_ours(part, expected)?;
        let ([xmin, ymin, xmax, ymax] | [xmin, ymin, _, xmax, ymax, _]) = numbers[..] else {
            let found = format!("a bbox of {} numbers", numbers.len());
            return Err(self.error(part, found, "4: [xmin, ymin, xmax, ymax]"));
        };
        if numbers.iter().any(|n| n.abs() > LARGEST) {
            return Err(self.error(part, quoted(part), format!("each {A_NUMBER}")));
        }
        let bounds = Rectangle::new(Point::new(xmin, ymin), Point::new(xmax, ymax));
        bounds.map_err(|error| {
            let (found, expected) = found_and_expected(&error);
            self.error(part, format!("{found} as bbox"), expected)
        })
    }

    /// Bounds some way around all shapes.
    fn around(&self, margin: Option<f64>) -> Result<Rectangle, FileError> {
        let boxes = self.shapes.iter().map(Shape::bounding_box);
        let Some((min, max)) = boxes.reduce(|(a, b), (c, d)| (a.inf(&c), b.sup(&d))) else {
            let found = "neither shapes nor a \"bbox\"";
            return Err(self.error(self.text, found, "shapes, or a \"bbox\" as bounds"));
        };
        let margin = margin.unwrap_or((max - min).amax() / 10.0);
        if !(0.0..=LARGEST).contains(&margin) {
            let found = format!("a margin of {margin}");
            return Err(self.source.error(Place::Whole, found, "a number from 0"));
        }
        let margin = Vector::repeat(margin);
        Rectangle::new(min - margin, max + margin).map_err(|error| {
            let (found, expected) = found_and_expected(&error);
            self.error(self.text, found, expected)
        })
    }

    fn robots(&self, raw: &RawValue, bounds: &Rectangle) -> Result<Vec<Robot>, FileError> {
        let part = raw.get();
        let expected = "robots: each with radius, start [x, y] and goal [x, y]";
        let members: Vec<RobotMember> = self.of_ours(part, expected)?;
        let robot = |(k, member): (usize, RobotMember)| {
            let (start, goal) = (Point::from(member.start), Point::from(member.goal));
            for point in [start, goal] {
                if !bounds.contains(point) {
                    let found = format!("[{:?}, {:?}] of robot {k}", point.x, point.y);
                    return Err(self.error(part, found, a_point_within(bounds)));
                }
            }
            let speed = member.speed.unwrap_or(1.0);
            if !((0.0..=LARGEST).contains(&member.radius) && speed > 0.0 && speed <= LARGEST) {
                let found = format!(
                    "radius {:?} and speed {speed:?} of robot {k}",
                    member.radius
                );
                return Err(self.error(part, found, "a radius from 0 and a speed above 0"));
            }
            Ok(Robot {
                name: member.name,
                radius: member.radius,
                start,
                goal,
                speed: member.speed,
            })
        };
        members.into_iter().enumerate().map(robot).collect()
    }
}

/// The corners of the upright rectangle that a border is, if it is one.
#[expect(
    clippy::float_cmp,
    reason = "the same numbers in the file, or it is none"
)]
fn upright(corners: &[Point]) -> Option<(Point, Point)> {
    let &[a, b, c, d] = corners else {
        return None;
    };
    let level_first = a.y == b.y && b.x == c.x && c.y == d.y && d.x == a.x;
    let upright_first = a.x == b.x && b.y == c.y && c.x == d.x && d.y == a.y;
    (level_first || upright_first).then(|| (a.inf(&c), a.sup(&c)))
}
