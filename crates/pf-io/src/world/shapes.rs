//! Shapes as tables, in worlds and in what is added to them.

use crate::{
    FileError,
    toml_tree::{Table, Value},
};
use pf_core::InvalidProblem;
use pf_geom::{Circle, Point, Polygon, Rectangle, Shape, ShapeId};

/// Checking that a border is simple may take the square of the number of corners.
pub(crate) const MOST_CORNERS: usize = 100_000;

/// A kind of shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Circle,
    Rectangle,
    Polygon,
}

impl Kind {
    pub(crate) const ALL: [Self; 3] = [Self::Circle, Self::Rectangle, Self::Polygon];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Circle => "circle",
            Self::Rectangle => "rectangle",
            Self::Polygon => "polygon",
        }
    }

    fn keys(self) -> &'static [&'static str] {
        match self {
            Self::Circle => &["name", "centre", "radius"],
            Self::Rectangle => &["name", "min", "max", "peak"],
            Self::Polygon => &["name", "corners"],
        }
    }
}

/// What a shape is called in a message.
pub(crate) fn called(kind: &str, id: ShapeId, name: Option<&str>) -> String {
    match name {
        Some(name) => format!("{kind} \"{name}\" (shape {id})"),
        None => format!("{kind} (shape {id})"),
    }
}

/// What a constructor found and what it expected.
pub(crate) fn found_and_expected(error: &InvalidProblem) -> (String, String) {
    match error {
        InvalidProblem::BadValue {
            what,
            found,
            expected,
        } => (format!("{what} {found}"), expected.to_string()),
        other => (other.to_string(), "a sound value".to_owned()),
    }
}

/// A shape whose table says by its keys of what kind it is.
pub(crate) fn any_shape(
    table: &Table<'_>,
    id: ShapeId,
) -> Result<(Option<String>, Shape), FileError> {
    let kind = if table.get("centre").is_some() {
        Kind::Circle
    } else if table.get("corners").is_some() {
        Kind::Polygon
    } else if table.get("min").or(table.get("max")).is_some() {
        Kind::Rectangle
    } else {
        let all = ["name", "centre", "radius", "min", "max", "peak", "corners"];
        table.with_keys(&all)?;
        let expected = "a shape: centre and radius, min and max, or corners";
        return Err(table.error("none of the keys of a shape", expected));
    };
    shape(kind, table, id)
}

/// A shape and its name.
pub(crate) fn shape(
    kind: Kind,
    table: &Table<'_>,
    id: ShapeId,
) -> Result<(Option<String>, Shape), FileError> {
    let table = table.with_keys(kind.keys())?;
    let name = table.name()?;
    let point = |key, what| table.needed(key, "a point [x, y]")?.point(what);
    let shape = match kind {
        Kind::Circle => {
            let centre = point("centre", "the circle's centre")?;
            let radius = table.needed("radius", "a positive number")?;
            Circle::new(centre, radius.number("the circle's radius")?).map(Shape::from)
        }
        Kind::Rectangle => {
            let min = point("min", "the rectangle's lower corner")?;
            let max = point("max", "the rectangle's upper corner")?;
            let peak = table.get("peak");
            let peak = peak.map(|peak| peak.point("the rectangle's peak"));
            let peak = peak.transpose()?;
            Rectangle::new(min, max)
                .and_then(|r| peak.map_or(Ok(r), |peak| r.with_peak(peak)))
                .map(Shape::from)
        }
        Kind::Polygon => {
            let corners = corners(&table.needed("corners", "an array of points [x, y]")?)?;
            Polygon::new(corners).map(Shape::from)
        }
    };
    let shape = shape.map_err(|error| {
        let (found, expected) = found_and_expected(&error);
        let whose = called(kind.name(), id, name.as_deref());
        table.error(format!("{found} in {whose}"), expected)
    })?;
    Ok((name, shape))
}

fn corners(value: &Value<'_>) -> Result<Vec<Point>, FileError> {
    let corners = value.array("points [x, y]")?;
    let corners = corners.take(MOST_CORNERS + 1);
    let corners: Vec<Point> = corners
        .map(|corner| corner.point("a corner"))
        .collect::<Result<_, _>>()?;
    if corners.len() > MOST_CORNERS {
        return Err(value.error(format!("at most {MOST_CORNERS} corners")));
    }
    Ok(corners)
}

/// A point within the bounds.
pub(crate) fn inside(
    value: &Value<'_>,
    what: &str,
    bounds: &Rectangle,
) -> Result<Point, FileError> {
    let point = value.point(what)?;
    if bounds.contains(point) {
        return Ok(point);
    }
    Err(value.error(format!("{what}: {}", a_point_within(bounds))))
}

pub(crate) fn a_point_within(bounds: &Rectangle) -> String {
    let (min, max) = (bounds.min(), bounds.max());
    format!(
        "a point within the bounds, [{}, {}] to [{}, {}]",
        min.x, min.y, max.x, max.y
    )
}
