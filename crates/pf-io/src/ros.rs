//! Maps of ROS's `map_server`: a picture, and a YAML file that says what it means.
//!
//! The rules are those of `map_server` and Nav2's `map_io`. A pixel's darkness (lightness if
//! `negate`) from 0 to 1 is its occupancy, where lightness is the mean of its channels. By `mode`:
//!
//! * `trinary` (the default): above `occupied_thresh` is occupied, below `free_thresh` is free,
//!   what lies between is unknown. Transparency counts as a channel, as it does there.
//! * `scale`: the same ends, but what lies between is known; it becomes terrain whose cost grows
//!   linearly from 1 at `free_thresh` to 254 at `occupied_thresh`. Only what is not opaque is
//!   unknown.
//! * `raw`: the lightness from 0 to 255 *is* the occupancy in percent, whatever `negate` says: 0 is
//!   free, 1 to 99 is terrain whose cost grows linearly to 254, 100 is occupied, and above is
//!   unknown.

use crate::{
    FileError, Frame, Place, Unknown,
    error::quoted,
    pgm,
    raster::{self, Pixel},
    source::{self, Source},
    write,
};
use pf_grid::{Cell, Grid};
use serde_saphyr::{Location, Spanned};
use std::{
    io,
    path::{Path, PathBuf},
};

/// What a `map_server` YAML file says.
#[derive(Clone, Debug, PartialEq)]
pub struct RosMap {
    /// The picture, as the file names it: relative to the file.
    pub image: PathBuf,
    /// How the map lies in the world.
    pub frame: Frame,
    /// Whether light is occupied and dark is free.
    pub negate: bool,
    /// Occupancy above this is occupied: 0 to 1.
    pub occupied_thresh: f64,
    /// Occupancy below this is free: 0 to 1.
    pub free_thresh: f64,
    /// What lies between.
    pub mode: RosMode,
}

/// How `map_server` reads occupancy between the thresholds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RosMode {
    /// It is unknown.
    #[default]
    Trinary,
    /// It is terrain.
    Scale,
    /// There are no thresholds: the pixel's value is the occupancy in percent.
    Raw,
}

/// Scalars are read as text, so that each error is ours to word.
#[derive(serde::Deserialize)]
struct Keys {
    image: Option<Spanned<String>>,
    resolution: Option<Spanned<String>>,
    origin: Option<Spanned<Vec<String>>>,
    negate: Option<Spanned<String>>,
    occupied_thresh: Option<Spanned<String>>,
    free_thresh: Option<Spanned<String>>,
    mode: Option<Spanned<String>>,
}

/// Reads the content of a `map_server` YAML file; `name` is for errors. Further keys are left alone.
///
/// # Errors
/// [`FileError`] if it is not YAML, a key is missing or a value makes no sense.
///
/// ```
/// let yaml = b"image: hall.pgm
/// resolution: 0.05
/// origin: [0, 0, 0]
/// negate: 0
/// occupied_thresh: 0.65
/// free_thresh: 0.196
/// ";
/// let ros = pf_io::parse_ros("hall.yaml", yaml).unwrap();
/// // Black is occupied, white is free, gray is unknown.
/// let picture = b"P2 3 1 255\n0 254 205\n";
/// let grid = ros.grid("hall.pgm", picture, pf_io::Unknown::Blocked).unwrap();
/// assert_eq!(grid.to_string(), "#.#\n");
/// ```
pub fn parse_ros(name: &str, bytes: &[u8]) -> Result<RosMap, FileError> {
    let source = Source { name, bytes };
    let keys: Keys = serde_saphyr::from_str(source.text()?).map_err(|error| {
        let place = error.location().map_or(Place::Whole, |at| place(&at));
        let found = format!("broken YAML ({})", message(&error));
        source.error(
            place,
            found,
            "a map_server file: a mapping of keys to values",
        )
    })?;
    let reader = Reader { source };
    let image = reader.needed("image", "a picture's name", keys.image)?;
    let frame = Frame {
        resolution: reader.number(
            "resolution",
            "metres per cell, above 0",
            keys.resolution,
            |n| n > 0.0,
        )?,
        origin: reader.origin(keys.origin)?,
    };
    let negate = reader.needed("negate", NEGATE, keys.negate)?;
    let threshold = |key, value| {
        reader.number(key, "a number from 0 to 1", value, |n| {
            (0.0..=1.0).contains(&n)
        })
    };
    let free_place = keys.free_thresh.as_ref().map(|value| value.referenced);
    let ros = RosMap {
        image: match image.value.trim() {
            "" => return Err(reader.wrong("image", &image, "a picture's name")),
            image => image.into(),
        },
        frame,
        negate: match image_flag(&negate.value) {
            Some(flag) => flag,
            None => return Err(reader.wrong("negate", &negate, NEGATE)),
        },
        occupied_thresh: threshold("occupied_thresh", keys.occupied_thresh)?,
        free_thresh: threshold("free_thresh", keys.free_thresh)?,
        mode: match keys.mode {
            None => RosMode::default(),
            Some(mode) => match &mode.value[..] {
                "trinary" => RosMode::Trinary,
                "scale" => RosMode::Scale,
                "raw" => RosMode::Raw,
                _ => return Err(reader.wrong("mode", &mode, "trinary, scale or raw")),
            },
        },
    };
    if ros.free_thresh >= ros.occupied_thresh {
        let place = free_place.map_or(Place::Whole, |at| place(&at));
        let found = format!("free_thresh {}", ros.free_thresh);
        let expected = format!("less than occupied_thresh, {}", ros.occupied_thresh);
        return Err(source.error(place, found, expected));
    }
    Ok(ros)
}

const NEGATE: &str = "0, 1, false or true";

fn image_flag(text: &str) -> Option<bool> {
    match text.to_ascii_lowercase().as_str() {
        "0" | "false" | "no" | "off" => Some(false),
        "1" | "true" | "yes" | "on" => Some(true),
        _ => None,
    }
}

/// Finds values and words errors about them.
#[derive(Clone, Copy)]
struct Reader<'a> {
    source: Source<'a>,
}

impl Reader<'_> {
    fn needed<T>(
        &self,
        key: &str,
        expected: &str,
        value: Option<Spanned<T>>,
    ) -> Result<Spanned<T>, FileError> {
        value.ok_or_else(|| {
            let found = format!("no key \"{key}\"");
            let expected = format!("\"{key}\": {expected}");
            self.source.error(Place::Whole, found, expected)
        })
    }

    fn number(
        &self,
        key: &str,
        expected: &str,
        value: Option<Spanned<String>>,
        sensible: impl Fn(f64) -> bool,
    ) -> Result<f64, FileError> {
        let value = self.needed(key, expected, value)?;
        match value.value.parse::<f64>() {
            Ok(number) if number.is_finite() && sensible(number) => Ok(number),
            _ => Err(self.wrong(key, &value, expected)),
        }
    }

    fn origin(&self, value: Option<Spanned<Vec<String>>>) -> Result<[f64; 3], FileError> {
        let expected = "three numbers: x and y in metres, yaw in radians";
        let value = self.needed("origin", expected, value)?;
        let number = |text: &String| text.parse::<f64>().ok().filter(|n| n.is_finite());
        let numbers: Option<Vec<f64>> = value.value.iter().map(number).collect();
        let numbers = numbers.and_then(|numbers| <[f64; 3]>::try_from(numbers).ok());
        numbers.ok_or_else(|| {
            let found = format!(
                "origin {}",
                quoted(&format!("[{}]", value.value.join(", ")))
            );
            self.source.error(place(&value.referenced), found, expected)
        })
    }

    fn wrong(&self, key: &str, value: &Spanned<String>, expected: &str) -> FileError {
        let found = format!("{key} {}", quoted(&value.value));
        self.source.error(place(&value.referenced), found, expected)
    }
}

fn place(at: &Location) -> Place {
    let cap = |n: u64| u32::try_from(n).unwrap_or(u32::MAX);
    Place::Column(cap(at.line()), cap(at.column()))
}

/// The parser's message without the place, which the error states by itself.
fn message(error: &serde_saphyr::Error) -> String {
    let text = error.without_snippet().to_string();
    let text = text.lines().next().unwrap_or("");
    text.split(" at line ").next().unwrap_or(text).to_owned()
}

impl RosMap {
    /// The grid that a picture means; `name` is for errors.
    ///
    /// # Errors
    /// [`FileError`] if `bytes` is not a PNG or PGM picture.
    pub fn grid(&self, name: &str, bytes: &[u8], unknown: Unknown) -> Result<Grid, FileError> {
        let source = Source { name, bytes };
        let unknown = match unknown {
            Unknown::Blocked => 0,
            Unknown::Free => 1,
        };
        raster::costs(source, &|pixel| self.cost(pixel).unwrap_or(unknown))?.into_grid(source)
    }

    /// The cost of a pixel's cell, 0 for blocked; `None` if it is unknown.
    fn cost(&self, [red, green, blue, alpha]: Pixel) -> Option<u8> {
        let colour = f64::from(red) + f64::from(green) + f64::from(blue);
        let opaque = alpha == 255;
        let lightness = match self.mode {
            RosMode::Trinary if !opaque => (colour + f64::from(alpha)) / (4.0 * 255.0),
            _ => colour / (3.0 * 255.0),
        };
        let occupancy = if self.negate {
            lightness
        } else {
            1.0 - lightness
        };
        let (occupied, free) = (
            occupancy > self.occupied_thresh,
            occupancy < self.free_thresh,
        );
        match self.mode {
            RosMode::Trinary if occupied => Some(0),
            RosMode::Trinary if free => Some(1),
            RosMode::Trinary => None,
            RosMode::Scale if !opaque => None,
            RosMode::Scale if occupied => Some(0),
            RosMode::Scale if free => Some(1),
            RosMode::Scale => {
                let range = self.occupied_thresh - self.free_thresh;
                Some(terrain((occupancy - self.free_thresh) / range))
            }
            RosMode::Raw => match (lightness * 255.0).round() {
                percent if percent < 100.0 => Some(terrain(percent / 100.0)),
                percent if percent < 101.0 => Some(0),
                _ => None,
            },
        }
    }
}

/// The cost of terrain of this occupancy: 1 at 0, 254 at 1.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "1 to 254"
)]
fn terrain(occupancy: f64) -> u8 {
    (1.0 + 253.0 * occupancy.clamp(0.0, 1.0)).round() as u8
}

/// Writes a grid as a `map_server` map: `path` is the YAML file's, the PGM picture gets the same
/// name with the extension `pgm`. Terrain is kept, in mode `scale`.
///
/// # Errors
/// [`FileError`] if a file cannot be written.
pub fn write_ros(path: &Path, grid: &Grid, frame: Frame) -> Result<(), FileError> {
    let picture = path.with_extension("pgm");
    let uniform = grid.is_uniform();
    pgm::write_gray(&picture, grid.width(), grid.height(), |cell: Cell| {
        match (grid.is_free(cell), uniform) {
            (false, _) => 0,
            (true, true) => 254,
            // The darkness is the cost less 1, so the thresholds below give every cost back.
            (true, false) => 255 - (grid.cost(cell) - 1),
        }
    })?;
    let ros = RosMap {
        image: picture.file_name().unwrap_or_default().into(),
        frame,
        negate: false,
        // Cost 254 is darkness 253; a little more, so that no rounding blocks it.
        occupied_thresh: if uniform { 0.65 } else { 253.1 / 255.0 },
        free_thresh: if uniform { 0.196 } else { 0.0 },
        mode: if uniform {
            RosMode::Trinary
        } else {
            RosMode::Scale
        },
    };
    write_ros_yaml(path, &ros)
}

/// Writes a `map_server` YAML file alone.
///
/// # Errors
/// [`FileError`] if the file cannot be written.
pub fn write_ros_yaml(path: &Path, ros: &RosMap) -> Result<(), FileError> {
    let keys = KeysOut {
        image: ros.image.to_string_lossy().into_owned(),
        mode: match ros.mode {
            RosMode::Trinary => "trinary",
            RosMode::Scale => "scale",
            RosMode::Raw => "raw",
        },
        resolution: ros.frame.resolution,
        origin: serde_saphyr::FlowSeq(ros.frame.origin),
        negate: ros.negate.into(),
        occupied_thresh: ros.occupied_thresh,
        free_thresh: ros.free_thresh,
    };
    write::whole(path, |out| {
        let text = serde_saphyr::to_string(&keys).map_err(io::Error::other)?;
        writeln!(out, "{}", text.trim_end())
    })
}

#[derive(serde::Serialize)]
struct KeysOut {
    image: String,
    mode: &'static str,
    resolution: f64,
    origin: serde_saphyr::FlowSeq<[f64; 3]>,
    negate: u8,
    occupied_thresh: f64,
    free_thresh: f64,
}

/// Reads a `map_server` YAML file and the picture it names.
///
/// # Errors
/// [`FileError`] about whichever of the two is wrong.
pub fn read_ros(path: &Path, unknown: Unknown) -> Result<(Grid, RosMap), FileError> {
    with_picture(path, &source::read(path)?, unknown)
}

/// Reads the picture that a YAML file names; `yaml` is the content of the file at `path`.
pub(crate) fn with_picture(
    path: &Path,
    yaml: &[u8],
    unknown: Unknown,
) -> Result<(Grid, RosMap), FileError> {
    let ros = parse_ros(&path.display().to_string(), yaml)?;
    let image = path.parent().unwrap_or(Path::new("")).join(&ros.image);
    let bytes = source::read(&image)?;
    let grid = ros.grid(&image.display().to_string(), &bytes, unknown)?;
    Ok((grid, ros))
}
