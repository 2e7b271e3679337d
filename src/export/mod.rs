//! Exact results as text, LaTeX and MathML, and numbers as C.
//!
//! A [`Formula`] holds an expression in the order a person would write it; one walk with three
//! notations then writes plain text, LaTeX or MathML. The language reads back the text of pieces and echoes
//! in a scene's own symbols. Breaking of long lines is shared as well.

mod arrangement;
mod c;
mod explain;
mod forms;
mod formula;
mod general;
mod impact;
mod lesson;
pub mod lines;
mod mathml;
mod names;
mod notation;
pub mod oscillation;
mod prose;
mod source;
mod terms;
mod transforms;
pub mod tree;
mod writer;

pub use c::{CHeading, to_c};
pub use explain::{Block, Derivation, definition_text};
pub use forms::{form_text, solved_equations};
pub use formula::{
    Formula, Head, LATEX_WIDTH, TEXT_WIDTH, expression_text, latex, latex_cases, text,
};
pub use general::{assumed_factors, general_form, general_form_from, operator_names, operator_of};
pub use impact::first_contact;
pub use names::latex_name;
pub use notation::Notation;
pub use prose::{capitalised, wrapped};
pub use source::SourceForm;
