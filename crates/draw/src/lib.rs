//! Pictures: charts of accuracy against speed, figures of quantities, diagrams of place and time; as
//! SVG, PDF, PNG, JSON, CSV, and pages of HTML.
//!
//! The layer knows series of numbers only, not where they come from. A [`WorkPrecision`] diagram
//! shows methods, a [`Map`] shows the error over two parameters, [`Curves`] show it along one;
//! [`page`] puts several of them into one file. A [`Figure`] shows quantities in panels over one axis, a
//! [`Diagram`] waves over place and time; [`png`] turns any of them into pixels, [`pdf`] into a page. What a picture shows can
//! be drawn again from its data: equal data give equal bytes.
//!
//! Pictures are written as SVG here, by a few shapes in one file. Every chart needs what plotting
//! libraries do not offer together: gutters for exact zeros, bounds joined to errors, labels that
//! never overlap, titles for screen readers, and colours for light and dark paper.

#![allow(missing_docs, reason = "what a name or a message says is not said again")]

mod axis;
mod caption;
mod chart;
mod contour;
mod curves;
mod diagram;
mod drawing;
mod ends;
mod error;
mod figure;
mod frontier;
mod layout;
mod map;
mod marks;
mod number;
mod page;
mod palette;
mod pdf;
mod placement;
mod png;
mod text;
mod work_precision;

pub use axis::{Axis, Scale};
pub use caption::Caption;
pub use chart::Chart;
pub use curves::{Curve, Curves};
pub use diagram::{Cell, Diagram, Line, Part, Shape, Window};
pub use error::{NotDrawn, PlotError};
pub use figure::{Figure, Look, Panel, Series};
pub use frontier::frontier;
pub use map::Map;
pub use page::{Listing, Row, Section, Table, page, table};
pub use pdf::pdf;
pub use png::png;
pub use text::escape;
pub use work_precision::{Method, Point, WorkPrecision};
