//! The SVG, drawn.

use resvg::{
    tiny_skia::{Pixmap, Transform},
    usvg::{Options, Tree},
};
use std::sync::Arc;

/// Why there is no PNG.
#[derive(Debug, thiserror::Error)]
#[error("cannot draw the picture: {0}")]
pub struct NoPicture(pub(crate) String);

/// Any SVG as PNG, its text in `DejaVu` Sans: a chart, say, that another crate has made.
///
/// # Errors
/// [`NoPicture`] if it is no SVG, or too large.
pub fn png_of(svg: &str) -> Result<Vec<u8>, NoPicture> {
    let pixels = Drawer::new().pixels(svg)?;
    pixels.encode_png().map_err(|e| NoPicture(e.to_string()))
}

/// Draws one SVG after the other with the same font.
pub(crate) struct Drawer(Options<'static>);

impl Drawer {
    pub(crate) fn new() -> Self {
        let mut options = Options {
            font_family: "DejaVu Sans".to_owned(),
            ..Options::default()
        };
        Arc::make_mut(&mut options.fontdb).load_font_data(dejavu::sans::regular().to_vec());
        Self(options)
    }

    /// An SVG as large as it says.
    pub(crate) fn pixels(&self, svg: &str) -> Result<Pixmap, NoPicture> {
        let tree = self.tree(svg)?;
        let size = tree.size().to_int_size();
        let mut pixels = Pixmap::new(size.width(), size.height())
            .ok_or_else(|| NoPicture("it would have no size".to_owned()))?;
        resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
        Ok(pixels)
    }

    /// An SVG over what is there.
    pub(crate) fn over(&self, svg: &str, pixels: &mut Pixmap) -> Result<(), NoPicture> {
        let tree = self.tree(svg)?;
        resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
        Ok(())
    }

    fn tree(&self, svg: &str) -> Result<Tree, NoPicture> {
        Tree::from_str(svg, &self.0).map_err(|e| NoPicture(e.to_string()))
    }
}
