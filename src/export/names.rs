//! Symbols that are written otherwise than by their own names.

use std::collections::BTreeMap;
use wavestep_polynomial::Symbol;

/// The name of a symbol, in each notation.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Name {
    /// In plain text.
    pub text: String,
    /// In LaTeX.
    pub latex: String,
    /// Whether it is an expression, which takes brackets as a base or before a factor.
    pub compound: bool,
    /// Whether it begins with a number or a sign, which takes brackets after a factor as well.
    pub leads: bool,
}

/// The names of symbols that are not written by their own.
pub(crate) type Names = BTreeMap<Symbol, Name>;
