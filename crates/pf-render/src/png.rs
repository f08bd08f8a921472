//! The SVG, drawn.

use resvg::{
    tiny_skia::{Pixmap, Transform},
    usvg::{Options, Tree},
};
use std::sync::Arc;

/// Why there is no PNG.
#[derive(Debug, thiserror::Error)]
#[error("cannot draw the picture: {0}")]
pub struct NoPicture(String);

/// Draws an SVG; its text is set in `DejaVu` Sans.
///
/// # Errors
/// [`NoPicture`] if the text is no SVG, or has no size.
pub fn png_of_svg(svg: &str) -> Result<Vec<u8>, NoPicture> {
    let mut options = Options {
        font_family: "DejaVu Sans".to_owned(),
        ..Options::default()
    };
    Arc::make_mut(&mut options.fontdb).load_font_data(dejavu::sans::regular().to_vec());
    let tree = Tree::from_str(svg, &options).map_err(|e| NoPicture(e.to_string()))?;
    let size = tree.size().to_int_size();
    let mut pixels = Pixmap::new(size.width(), size.height())
        .ok_or_else(|| NoPicture("it would have no size".to_owned()))?;
    resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
    pixels.encode_png().map_err(|e| NoPicture(e.to_string()))
}
