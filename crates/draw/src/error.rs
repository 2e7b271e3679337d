//! Why data cannot be drawn.

/// Why data cannot be drawn.
///
/// Values that are not finite are no error: they are left out, counted, and the caption says so.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum PlotError {
    /// No value of the chart can be drawn.
    #[error("the chart \"{title}\" has nothing to draw: give at least one point that is finite")]
    Empty {
        /// The title of the chart.
        title: String,
    },
    /// An error or a bound is less than zero.
    #[error("{what} is {value:e}, less than zero: give the magnitude")]
    Negative {
        /// Whose value it is.
        what: String,
        /// The value.
        value: f64,
    },
    /// A value that is not above zero belongs on a logarithmic axis.
    #[error(
        "{what} is {value:e}, which has no place on a logarithmic axis: give a value above zero, or \
         make the axis linear"
    )]
    NotPositive {
        /// Whose value it is.
        what: String,
        /// The value.
        value: f64,
    },
    /// A value is too large for a linear axis, whose span would overflow.
    #[error("{what} is {value:e}, too large for a linear axis: make the axis logarithmic")]
    TooLarge {
        /// Whose value it is.
        what: String,
        /// The value.
        value: f64,
    },
    /// The places of rows or columns do not ascend.
    #[error("the places along \"{axis}\" do not ascend: sort them, each once, all finite")]
    NotAscending {
        /// The name of the axis.
        axis: String,
    },
    /// A map does not have one cell for each pair of places.
    #[error(
        "the map has {found} cells, but rows times columns is {expected}: give one cell for each pair, \
         row by row"
    )]
    CellCount {
        /// Rows times columns.
        expected: usize,
        /// The cells given.
        found: usize,
    },
    /// The lowest power of ten of a colour scale is not below its highest.
    #[error(
        "the colour scale from 10^{low} to 10^{high} is empty: let the first be the lower, both \
         between -400 and 400"
    )]
    EmptyColourScale {
        /// The exponent at the lower end.
        low: i32,
        /// The exponent at the upper end.
        high: i32,
    },
    /// A picture cannot be turned into pixels.
    #[error("the picture cannot be turned into pixels ({0}): write it as SVG")]
    NotDrawn(#[source] NotDrawn),
}

/// Why a picture cannot be turned into pixels.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NotDrawn {
    /// A width that pictures do not have.
    #[error("{width} pixels are not from 1 to {limit}")]
    Width {
        /// What was asked for.
        width: u32,
        /// The most.
        limit: u32,
    },
    /// A height, in pixels, for which there is no memory.
    #[error("it would be {0} pixels high")]
    Height(f32),
    /// A text that is no SVG, in the words of its reader.
    #[error("{0}")]
    Svg(String),
    /// Pixels that make no PNG, in the words of its writer.
    #[error("{0}")]
    Png(String),
}
