//! Exact solutions of wave propagation in bars with lumped ends: derived, evaluated, explained.
//!
//! Data flows one way: text ([`language`]) → [`recurrence`] → [`solution`] → numbers ([`evaluate`])
//! and formulas ([`export`]), all in exact [`expression`]s; [`ball`] encloses what is not rational.
//! [`field`] gives velocities and strains along the bars of a scene; [`plot`] draws what it is given, and
//! [`picture`] gives it scenes.
//!
//! ```
//! use wavestep::{language, solution::Solution};
//!
//! let source = language::Source::new("rigid-mass", wavestep::scenes::find("rigid-mass").unwrap().text)?;
//! let recurrence = language::read_recurrence(&source, &Default::default())?;
//! let pieces = Solution::new(recurrence).pieces(0, 1, 1).unwrap();
//! let f_1 = language::Source::new("6.80", "exp(-s)*(-2*s + 1 + exp(-2*mu))")?;
//! assert_eq!(pieces[0], language::read_expression(&f_1)?);
//! # Ok::<(), language::Diagnostic>(())
//! ```

/// The examples of the README are run as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod error;

pub mod answer;
pub mod ball;
pub mod book;
pub mod dispersion;
pub mod enclosure;
pub mod evaluate;
pub mod export;
pub mod expression;
pub mod field;
pub mod figures;
pub mod hertz;
pub mod history;
pub mod language;
pub mod lock;
pub mod model;
pub mod network;
pub mod picture;
pub mod plot;
pub mod recurrence;
pub mod scene;
pub mod scenes;
pub mod solution;
pub mod study;

pub use error::{Error, Remedy};
