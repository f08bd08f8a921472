//! Worlds, to be written as GeoJSON.

use super::{Robot, RobotMember, WorldFile};
use crate::{FileError, write};
use ::geojson::{Feature, Geometry, GeometryValue, JsonObject, JsonValue};
use pf_geom::{Point, Shape};
use std::{io, path::Path};

/// Writes a world as a GeoJSON `FeatureCollection`, its bounds as `bbox`: a circle is a `Point`
/// with the properties `shape`, "circle", and `radius`; a rectangle a `Polygon` with `shape`,
/// "rectangle", and `peak` if it has one. Robots and what the file says about itself are members
/// `robots`, `title`, `source`, `provenance` of the collection, which other programs pass over.
///
/// # Errors
/// [`FileError`] if the file cannot be written.
pub fn write_geojson(path: &Path, file: &WorldFile) -> Result<(), FileError> {
    let about = [
        ("title", &file.title),
        ("source", &file.source),
        ("provenance", &file.provenance),
    ];
    let (min, max) = (file.world.bounds().min(), file.world.bounds().max());
    let bbox = JsonValue::from(vec![min.x, min.y, max.x, max.y]);
    let robots: Vec<JsonValue> = file.robots.iter().map(robot).collect();
    write::whole(path, |out| {
        writeln!(out, "{{\"type\":\"FeatureCollection\",\"bbox\":{bbox},")?;
        for (key, text) in about {
            if let Some(text) = text {
                writeln!(out, "\"{key}\":{},", JsonValue::from(text.as_str()))?;
            }
        }
        if !robots.is_empty() {
            writeln!(out, "\"robots\":{},", JsonValue::from(robots))?;
        }
        // A line for each, so that files can be compared by lines.
        write!(out, "\"features\":[")?;
        for (k, (id, shape)) in file.world.shapes().enumerate() {
            writeln!(out, "{}", if k > 0 { "," } else { "" })?;
            let feature = feature(shape, file.names.of(id));
            serde_json::to_writer(&mut *out, &feature).map_err(io::Error::from)?;
        }
        writeln!(out, "\n]}}")
    })
}

fn robot(robot: &Robot) -> JsonValue {
    let member = RobotMember {
        name: robot.name.clone(),
        radius: robot.radius,
        start: robot.start.into(),
        goal: robot.goal.into(),
        speed: robot.speed,
    };
    serde_json::to_value(member).unwrap_or_default()
}

fn feature(shape: &Shape, name: Option<&str>) -> Feature {
    let mut properties = JsonObject::new();
    let mut says = |key: &str, value: JsonValue| properties.insert(key.to_owned(), value);
    if let Some(name) = name {
        says("name", name.into());
    }
    let ring = |corners: &[Point]| {
        let closed = corners.iter().chain(corners.first());
        let ring: Vec<[f64; 2]> = closed.map(|&corner| corner.into()).collect();
        GeometryValue::new_polygon([ring])
    };
    let value = match shape {
        Shape::Circle(circle) => {
            says("shape", "circle".into());
            says("radius", circle.radius().into());
            GeometryValue::new_point(<[f64; 2]>::from(circle.centre()))
        }
        Shape::Rectangle(rectangle) => {
            says("shape", "rectangle".into());
            if let Some(peak) = rectangle.own_peak() {
                says("peak", vec![peak.x, peak.y].into());
            }
            ring(&rectangle.corners())
        }
        Shape::Polygon(polygon) => ring(polygon.corners()),
    };
    Feature {
        bbox: None,
        geometry: Some(Geometry::new(value)),
        id: None,
        properties: Some(properties),
        foreign_members: None,
    }
}
