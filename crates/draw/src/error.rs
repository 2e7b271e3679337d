//! Why data cannot be drawn.

use std::fmt;

/// Why data cannot be drawn.
///
/// Values that are not finite are no error: they are left out, counted, and the caption says so.
///
/// ```
/// use wavestep_draw::{Caption, PlotError, WorkPrecision};
///
/// let error = WorkPrecision::new("Nothing", vec![], Caption::default()).unwrap_err();
/// assert_eq!(error, PlotError::Empty { title: "Nothing".to_owned() });
/// assert!(error.to_string().contains("at least one point"));
/// ```
#[derive(Clone, PartialEq, Debug)]
pub enum PlotError {
    /// No value of the chart can be drawn.
    Empty {
        /// The title of the chart.
        title: String,
    },
    /// An error or a bound is less than zero.
    Negative {
        /// Whose value it is.
        what: String,
        /// The value.
        value: f64,
    },
    /// A value that is not above zero belongs on a logarithmic axis.
    NotPositive {
        /// Whose value it is.
        what: String,
        /// The value.
        value: f64,
    },
    /// A value is too large for a linear axis, whose span would overflow.
    TooLarge {
        /// Whose value it is.
        what: String,
        /// The value.
        value: f64,
    },
    /// The places of rows or columns do not ascend.
    NotAscending {
        /// The name of the axis.
        axis: String,
    },
    /// A map does not have one cell for each pair of places.
    CellCount {
        /// Rows times columns.
        expected: usize,
        /// The cells given.
        found: usize,
    },
    /// The lowest power of ten of a colour scale is not below its highest.
    EmptyColourScale {
        /// The exponent at the lower end.
        low: i32,
        /// The exponent at the upper end.
        high: i32,
    },
    /// A colour scale whose ends are not finite, or an outline with fewer than three corners.
    NotAnArea {
        /// What it is.
        what: String,
    },
    /// A picture cannot be turned into pixels.
    NotDrawn {
        /// Why.
        reason: String,
    },
}

impl fmt::Display for PlotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PlotError::Empty { title } => {
                write!(
                    f,
                    "the chart \"{title}\" has nothing to draw: give at least one point \
                     that is finite"
                )
            }
            PlotError::Negative { what, value } => {
                write!(f, "{what} is {value:e}, less than zero: give the magnitude")
            }
            PlotError::NotPositive { what, value } => write!(
                f,
                "{what} is {value:e}, which has no place on a logarithmic axis: give a value above \
                 zero, or make the axis linear"
            ),
            PlotError::TooLarge { what, value } => write!(
                f,
                "{what} is {value:e}, too large for a linear axis: make the axis logarithmic"
            ),
            PlotError::NotAscending { axis } => {
                write!(
                    f,
                    "the places along \"{axis}\" do not ascend: sort them, each once, all finite"
                )
            }
            PlotError::CellCount { expected, found } => write!(
                f,
                "the map has {found} cells, but rows times columns is {expected}: give one cell \
                 for each pair, row by row"
            ),
            PlotError::EmptyColourScale { low, high } => write!(
                f,
                "the colour scale from 10^{low} to 10^{high} is empty: let the first be the lower, \
                 both between -400 and 400"
            ),
            PlotError::NotAnArea { what } => {
                write!(f, "{what} is no area: give three corners or more, and finite numbers")
            }
            PlotError::NotDrawn { reason } => {
                write!(f, "the picture cannot be turned into pixels ({reason}): write it as SVG")
            }
        }
    }
}

impl std::error::Error for PlotError {}
