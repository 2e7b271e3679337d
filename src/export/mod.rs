//! Exact results as text, LaTeX and JSON.
//!
//! [`arrange`] puts an expression in the order a person would write it; one walk with two
//! notations then writes plain text, which the language reads back, or LaTeX. Breaking of long
//! lines is shared as well. JSON gives reduced rationals, term by term.

mod arrangement;
mod formula;
mod general;
mod json;
mod lines;
mod names;
mod notation;
mod source;

pub use arrangement::{Arrangement, Exponents, Monomial, Node, Sign, Term, arrange};
pub use formula::{Formula, Head, LATEX_WIDTH, Right, TEXT_WIDTH, latex, latex_cases, text};
pub use general::{assumed_factors, general_form, operator_names, operator_of};
pub use json::{SCHEMA_VERSION, expression_json, fraction_json, pieces_json};
pub use lines::Writing;
pub use names::{Name, Names};
pub use notation::{Latex, Notation, Text, write, write_named};
pub use source::SourceForm;
