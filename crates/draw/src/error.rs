//! Why data cannot be drawn.

/// Why data cannot be drawn.
///
/// Values that are not finite are no error: they are left out, counted, and the caption says so.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say what each is")]
pub enum PlotError {
    #[error("the chart \"{title}\" has nothing to draw: give at least one point that is finite")]
    Empty { title: String },
    #[error("{what} is {value:e}, less than zero: give the magnitude")]
    Negative { what: String, value: f64 },
    #[error(
        "{what} is {value:e}, which has no place on a logarithmic axis: give a value above zero, or \
         make the axis linear"
    )]
    NotPositive { what: String, value: f64 },
    #[error("{what} is {value:e}, too large for a linear axis: make the axis logarithmic")]
    TooLarge { what: String, value: f64 },
    #[error("the places along \"{axis}\" do not ascend: sort them, each once, all finite")]
    NotAscending { axis: String },
    #[error(
        "the map has {found} cells, but rows times columns is {expected}: give one cell for each pair, \
         row by row"
    )]
    CellCount { expected: usize, found: usize },
    #[error(
        "the colour scale from 10^{low} to 10^{high} is empty: let the first be the lower, both \
         between -400 and 400"
    )]
    EmptyColourScale { low: i32, high: i32 },
    #[error("the picture cannot be turned into pixels ({0}): write it as SVG")]
    NotDrawn(#[source] NotDrawn),
}

/// Why a picture cannot be turned into pixels.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the messages say what each is")]
pub enum NotDrawn {
    #[error("{width} pixels are not from 1 to {limit}")]
    Width { width: u32, limit: u32 },
    #[error("it would be {0} pixels high")]
    Height(f32),
    #[error("{0}")]
    Svg(String),
    #[error("{0}")]
    Png(String),
    #[error("{0}")]
    Pdf(String),
}
