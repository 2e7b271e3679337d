//! Studies built on wavestep, on which nothing in the library depends: the equations of the book with their
//! verdicts, its figures, pictures of scenes, charts of accuracy and speed, dispersion, and the closed forms
//! of local contact.

#![allow(missing_docs, reason = "what a name or a message says is not said again")]

pub mod book;
pub mod dispersion;
pub mod estimates;
pub mod figures;
pub mod hertz;
pub mod picture;
pub mod report;
pub mod study;
pub mod sweep;
pub mod told;
pub mod validity;

use wavestep_polynomial::Rational;

/// A fraction of whole numbers.
fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// The double nearest to a fraction.
fn nearest(value: &Rational) -> f64 {
    num_traits::ToPrimitive::to_f64(value).unwrap_or(f64::NAN)
}
