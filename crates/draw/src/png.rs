//! SVG to PNG, with a font that comes along: pictures look the same on machines without fonts.

use super::{NotDrawn, PlotError};
use resvg::{tiny_skia, usvg};
use std::sync::Arc;

/// The widest picture in pixels.
const MAX_WIDTH: u32 = 10_000;

/// A picture as PNG, so many pixels wide, on its own paper.
///
/// Texts are set in DejaVu Sans, which is part of the program; no font of the machine is looked at.
/// Colours are those for light paper.
pub fn png(svg: &str, width: u32) -> Result<Vec<u8>, PlotError> {
    if width == 0 || width > MAX_WIDTH {
        return Err(PlotError::NotDrawn(NotDrawn::Width { width, limit: MAX_WIDTH }));
    }
    let tree = read(svg)?;
    let scale = width as f32 / tree.size().width();
    let height = (tree.size().height() * scale).round().max(1.0);
    let pixels = tiny_skia::Pixmap::new(width, height as u32);
    let mut pixels = pixels.ok_or(PlotError::NotDrawn(NotDrawn::Height(height)))?;
    let transform = tiny_skia::Transform::from_scale(scale, scale);
    resvg::render(&tree, transform, &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| PlotError::NotDrawn(NotDrawn::Png(error.to_string())))
}

/// A picture with its texts set in DejaVu Sans.
pub(crate) fn read(svg: &str) -> Result<usvg::Tree, PlotError> {
    let mut fonts = usvg::fontdb::Database::new();
    for font in [dejavu::sans::regular(), dejavu::sans::bold()] {
        fonts.load_font_source(usvg::fontdb::Source::Binary(Arc::new(font)));
    }
    fonts.set_sans_serif_family("DejaVu Sans");
    let options = usvg::Options {
        font_family: "DejaVu Sans".to_owned(),
        fontdb: Arc::new(fonts),
        ..usvg::Options::default()
    };
    usvg::Tree::from_str(svg, &options)
        .map_err(|error| PlotError::NotDrawn(NotDrawn::Svg(error.to_string())))
}
