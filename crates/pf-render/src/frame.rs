//! Which part of the plane a picture shows.

/// A rectangle of the plane, in the map's units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// The corner with the least coordinates.
    pub(crate) min: [f64; 2],
    /// Width and height, positive.
    pub(crate) size: [f64; 2],
    /// The units are cells and y runs down; otherwise y runs up.
    pub(crate) cells: bool,
}

impl Frame {
    pub(crate) fn of_cells(width: u32, height: u32) -> Self {
        Self {
            min: [0.0, 0.0],
            size: [f64::from(width), f64::from(height)],
            cells: true,
        }
    }

    /// A length, with its unit.
    pub(crate) fn words(&self, length: f64) -> String {
        let unit = if self.cells { "cell" } else { "unit" };
        let many = if (length - 1.0).abs() < 1e-9 { "" } else { "s" };
        format!("{length} {unit}{many}")
    }

    /// About a quarter of the width: one, two or five times a power of ten, of cells at least one.
    pub(crate) fn scale(&self) -> f64 {
        let limit = self.size[0] / 4.0;
        let power = power_of_ten(limit);
        let fits = |step: &f64| *step <= limit * (1.0 + 1e-12);
        let steps = [5.0, 2.0].map(|times| times * power);
        let length = steps.into_iter().find(fits).unwrap_or(power);
        if self.cells { length.max(1.0) } else { length }
    }
}

/// The greatest one that is no greater than a positive number.
fn power_of_ten(x: f64) -> f64 {
    #[expect(clippy::cast_possible_truncation, reason = "exponents are small")]
    let exponent = x.log10().floor() as i32;
    // The decimal number as it is written, not a product of tenths.
    format!("1e{exponent}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(width: f64, cells: bool, expected: &str) {
        let frame = Frame {
            min: [0.0, 0.0],
            size: [width, 1.0],
            cells,
        };
        assert_eq!(frame.words(frame.scale()), expected);
    }

    #[test]
    fn the_scale_is_round() {
        check(20.0, true, "5 cells");
        check(3.0, true, "1 cell");
        check(512.0, true, "100 cells");
        check(60.0, false, "10 units");
        check(4.0, false, "1 unit");
        check(0.003, false, "0.0005 units");
        check(2e7, false, "5000000 units");
    }
}
