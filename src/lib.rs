//! Exact solutions of wave propagation in bars with lumped ends: derived, evaluated, explained.
//!
//! Data flows one way: text ([`language`]) → [`recurrence`] → [`solution`] → numbers ([`evaluate`])
//! and formulas ([`export`]), all in exact [`expression`]s; [`ball`] encloses what is not rational.
//! [`field`] gives velocities and strains along the bars of a scene.
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
pub mod limits;

// These modules are for the member crates of this repository, and no part of the public surface.
#[doc(hidden)]
pub mod answer;
#[doc(hidden)]
pub mod ball;
#[doc(hidden)]
pub mod enclosure;
#[doc(hidden)]
pub mod evaluate;
#[doc(hidden)]
pub mod export;
#[doc(hidden)]
pub mod expression;
#[doc(hidden)]
pub mod field;
#[doc(hidden)]
pub mod history;
#[doc(hidden)]
pub mod language;
#[doc(hidden)]
pub mod lock;
#[doc(hidden)]
pub mod model;
#[doc(hidden)]
pub mod network;
#[doc(hidden)]
pub mod problem;
#[doc(hidden)]
pub mod recurrence;
#[doc(hidden)]
pub mod scene;
#[doc(hidden)]
pub mod scenes;
pub mod signal;
#[doc(hidden)]
pub mod solution;

pub use error::Error;
