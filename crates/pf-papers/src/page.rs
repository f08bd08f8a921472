//! A report: a page with tables and figures, and each figure as SVG and PNG.

use crate::{
    PaperError,
    row::{Row, html},
};
use pf_io::{make_folder, write_whole};
use pf_render::png_of;
use std::{fmt::Write, io, path::Path};

/// A picture with a file's name, as SVG.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The name, without an ending.
    pub name: String,
    /// What it shows.
    pub title: String,
    /// The picture.
    pub svg: String,
}

/// Writes `report.html` and the figures into a folder, which is made if need be.
///
/// # Errors
/// [`PaperError`] if a picture cannot be drawn or a file cannot be written; each file is written
/// whole or not at all.
pub fn write_report(
    folder: &Path,
    title: &str,
    rows: &[Row],
    figures: &[Figure],
) -> Result<(), PaperError> {
    let put = |name: &str, bytes: &[u8]| {
        write_whole(&folder.join(name), |out| io::Write::write_all(out, bytes))
    };
    make_folder(folder)?;
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{title}</title>\n\
         <style>body {{ font: 14px/1.45 'DejaVu Sans', Verdana, sans-serif; margin: 2em; }}\n\
         table {{ border-collapse: collapse; }} td, th {{ padding: .15em .6em; text-align: right; \
         border-bottom: 1px solid #ddd; }}\n\
         td:nth-child(-n+3), th:nth-child(-n+3) {{ text-align: left; }}</style></head><body>\n\
         <h1>{title}</h1>\n"
    );
    page.push_str(&html(rows));
    page.push_str("<h2>Figures</h2>\n");
    for figure in figures {
        put(&format!("{}.svg", figure.name), figure.svg.as_bytes())?;
        put(&format!("{}.png", figure.name), &png_of(&figure.svg)?)?;
        let _ = write!(page, "<h3>{}</h3>\n{}\n", figure.title, figure.svg);
    }
    page.push_str("</body></html>\n");
    put("report.html", page.as_bytes())?;
    Ok(())
}
