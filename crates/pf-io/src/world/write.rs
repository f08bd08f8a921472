//! Worlds, to be written as TOML.

use super::{Robot, WorldFile};
use crate::{FileError, write};
use pf_geom::{Point, Shape};
use std::{
    io::{self, Write},
    path::Path,
};

/// Writes a world as TOML. Ids that are no longer used close up: the shapes' ids in the file are
/// their places in [`World::shapes`](pf_geom::World::shapes).
///
/// # Errors
/// [`FileError`] if the file cannot be written.
pub fn write_world(path: &Path, file: &WorldFile) -> Result<(), FileError> {
    write::whole(path, |out| {
        let about = [
            ("title", &file.title),
            ("source", &file.source),
            ("provenance", &file.provenance),
        ];
        for (key, text) in about {
            string(out, key, text.as_deref())?;
        }
        let bounds = file.world.bounds();
        let (min, max) = (point(bounds.min()), point(bounds.max()));
        writeln!(out, "bounds = {{ min = {min}, max = {max} }}")?;
        for robot in &file.robots {
            write_robot(out, robot)?;
        }
        for (id, shape) in file.world.shapes() {
            write_shape(out, shape, file.names.of(id))?;
        }
        Ok(())
    })
}

fn write_robot(out: &mut dyn Write, robot: &Robot) -> io::Result<()> {
    writeln!(out, "\n[[robot]]")?;
    string(out, "name", robot.name.as_deref())?;
    writeln!(out, "radius = {}", number(robot.radius))?;
    writeln!(out, "start = {}", point(robot.start))?;
    writeln!(out, "goal = {}", point(robot.goal))?;
    match robot.speed {
        Some(speed) => writeln!(out, "speed = {}", number(speed)),
        None => Ok(()),
    }
}

fn write_shape(out: &mut dyn Write, shape: &Shape, name: Option<&str>) -> io::Result<()> {
    let kind = match shape {
        Shape::Circle(_) => "circle",
        Shape::Rectangle(_) => "rectangle",
        Shape::Polygon(_) => "polygon",
    };
    writeln!(out, "\n[[{kind}]]")?;
    string(out, "name", name)?;
    match shape {
        Shape::Circle(circle) => {
            writeln!(out, "centre = {}", point(circle.centre()))?;
            writeln!(out, "radius = {}", number(circle.radius()))
        }
        Shape::Rectangle(rectangle) => {
            writeln!(out, "min = {}", point(rectangle.min()))?;
            writeln!(out, "max = {}", point(rectangle.max()))?;
            match rectangle.own_peak() {
                Some(peak) => writeln!(out, "peak = {}", point(peak)),
                None => Ok(()),
            }
        }
        Shape::Polygon(polygon) => {
            let corners: Vec<String> = polygon.corners().iter().map(|&c| point(c)).collect();
            if corners.len() <= 6 {
                return writeln!(out, "corners = [{}]", corners.join(", "));
            }
            writeln!(out, "corners = [")?;
            for row in corners.chunks(6) {
                writeln!(out, "    {},", row.join(", "))?;
            }
            writeln!(out, "]")
        }
    }
}

fn string(out: &mut dyn Write, key: &str, text: Option<&str>) -> io::Result<()> {
    match text {
        Some(text) => writeln!(out, "{key} = {}", toml::Value::from(text)),
        None => Ok(()),
    }
}

fn point(p: Point) -> String {
    format!("[{}, {}]", number(p.x), number(p.y))
}

/// The shortest digits that give the same number again.
pub(crate) fn number(n: f64) -> String {
    let digits = format!("{n:?}");
    digits
        .strip_suffix(".0")
        .map_or_else(|| digits.clone(), str::to_owned)
}
