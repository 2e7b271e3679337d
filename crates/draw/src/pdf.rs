//! SVG to PDF: one page as large as the picture, its lines as lines, its texts as text that can be searched.

use super::png::read;
use super::{NotDrawn, PlotError};
use krilla::Document;
use krilla::geom::Size;
use krilla::page::PageSettings;
use krilla_svg::{SurfaceExt as _, SvgSettings};

/// Points of PDF, 72 to an inch, for each pixel of SVG, of which there are 96.
const POINTS: f32 = 0.75;

/// A picture as PDF, with the fonts of [`png`](super::png) in it.
pub fn pdf(svg: &str) -> Result<Vec<u8>, PlotError> {
    let tree = read(svg)?;
    let not_drawn =
        |error: &dyn std::fmt::Debug| PlotError::NotDrawn(NotDrawn::Pdf(format!("{error:?}")));
    let size = tree.size();
    let size = Size::from_wh(size.width() * POINTS, size.height() * POINTS)
        .ok_or_else(|| not_drawn(&size))?;
    let mut document = Document::new();
    let mut page = document.start_page_with(PageSettings::new(size));
    let mut surface = page.surface();
    surface.draw_svg(&tree, size, SvgSettings::default());
    surface.finish();
    page.finish();
    document.finish().map_err(|error| not_drawn(&error))
}
