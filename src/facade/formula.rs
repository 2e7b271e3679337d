//! Formulas: exact functions with what they are called.

use crate::error::Error;
use crate::export::{self, LATEX_WIDTH, TEXT_WIDTH};
use crate::expression::Expression;
use crate::language::{Source, read_expression};
use crate::problem::{Derived, Form, Orders, Problem, Symbols, ToDerive};
use std::fmt;
use std::ops::RangeInclusive;

/// An exact function, or a form for every period: `name = expression`.
///
/// Two formulas are equal where their right sides are the same function, however they were derived: exact
/// expressions have one normal form.
///
/// ```
/// let mass = wavestep::Problem::builtin("rigid-mass")?;
/// let f = &mass.derive("f", 1..=1)?[0];
/// assert!(f.equals("exp(-s)*(1 - 2*s) + exp(-s - 2*mu)")?);
/// assert_eq!((f.order(), f.latex().lines().count()), (Some(1), 3));
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Formula {
    written: export::Formula,
    order: Option<usize>,
    /// The right side; none where it is a form for every period.
    value: Option<Expression>,
}

impl Formula {
    /// Plain text, which reads back; long lines are broken, and a remark follows a `#`.
    #[must_use]
    pub fn text(&self) -> String {
        self.written.to_text(TEXT_WIDTH).trim_end().to_owned()
    }

    /// LaTeX: an `align*` environment, with long lines broken.
    #[must_use]
    pub fn latex(&self) -> String {
        export::latex(std::slice::from_ref(&self.written), LATEX_WIDTH).trim_end().to_owned()
    }

    /// The period on which it holds; none for echoes and for forms of every period.
    #[must_use]
    pub fn order(&self) -> Option<usize> {
        self.order
    }

    /// Whether the right side is the same function as this one, in the same symbols.
    ///
    /// # Errors
    /// A text that is no expression.
    pub fn equals(&self, expression: &str) -> Result<bool, Error> {
        let other = read_expression(&Source::new("expression", expression)?)?;
        Ok(self.value.as_ref() == Some(&other))
    }
}

impl PartialEq for Formula {
    fn eq(&self, other: &Formula) -> bool {
        match (&self.value, &other.value) {
            (None, None) => self.written == other.written,
            (own, other) => own == other,
        }
    }
}

impl Eq for Formula {}

impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text())
    }
}

/// See [`Problem::derive`].
pub(super) fn derive(
    problem: &Problem,
    name: &str,
    orders: RangeInclusive<usize>,
) -> Result<Vec<Formula>, Error> {
    let orders = match orders.into_inner() {
        (first, last) if first > last => return Ok(Vec::new()),
        (n, last) if n == last && n > 0 => Orders::Only(n),
        (first, last) => Orders::Through(first, last),
    };
    let derived = problem.functions(ToDerive::Quantity(name), orders, Form::Period)?;
    let written = problem.formulas(&derived, Form::Period)?.into_iter().flat_map(|(_, all)| all);
    let values: Vec<(Option<usize>, Expression)> = match derived {
        Derived::Functions(all) => {
            let numbered = |all: crate::problem::Functions| (all.first..).zip(all.expressions);
            all.into_iter().flat_map(numbered).map(|(n, value)| (Some(n), value)).collect()
        }
        Derived::Stretches(_, all) => {
            all.into_iter().enumerate().map(|(n, stretch)| (Some(n), stretch.value)).collect()
        }
        Derived::Arrivals(all) => all.into_iter().map(|arrival| (None, arrival.echo)).collect(),
    };
    let formula = |(written, (order, value))| Formula { written, order, value: Some(value) };
    Ok(written.zip(values).map(formula).collect())
}

/// See [`Problem::general`].
pub(super) fn general(problem: &Problem, wave: &str) -> Result<Vec<Formula>, Error> {
    let all = problem.general_formulas(ToDerive::Quantity(wave), Symbols::Own)?;
    let formulas = all.into_iter().flat_map(|general| general.formulas);
    Ok(formulas.map(|written| Formula { written, order: None, value: None }).collect())
}
