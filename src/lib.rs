//! Exact solutions of wave propagation in bars with lumped ends: derived, evaluated, explained.
//!
//! A [`Problem`] is a text that was read: bars with what joins them, or the equations of a textbook between
//! the wave functions of successive periods. It gives exact [`Formula`]s of any order, [`Signal`]s, which
//! are functions of time with proven digits, roots and extrema, the [`History`] of contacts that open and
//! close, and [`Fields`] along the bars. Numbers are taken as text, integers, rationals or doubles
//! ([`Given`]), and given back as a [`Value`], exact or with proven digits, or as [`Doubles`] with a bound.
//!
//! ```
//! use wavestep::Problem;
//!
//! fn main() -> Result<(), wavestep::Error> {
//!     let p = Problem::builtin("rigid-mass")?;
//!     for f in p.derive("f", 0..=3)? {
//!         println!("{}", f.latex());
//!     }
//!     let p = p.with("mu", "1/4")?;
//!     let f = p.signal("f")?;
//!     println!("{}", f.at("33/10", 30)?); // 0.305385264408791064086396952466
//!     Ok(())
//! }
//! ```
//!
//! The language of texts is described in `docs/scene-language.md` and `docs/language.md`, what is exact, proven
//! or tested in `docs/guarantees.md`. [`scenes`] are built in; [`limits`] say how much is done at most.

/// The examples of the README are run as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod error;
mod facade;
pub mod limits;
pub mod scenes;

// These modules are for the member crates of this repository, and no part of the public surface.
#[doc(hidden)]
pub mod answer;
#[doc(hidden)]
pub mod ball;
#[doc(hidden)]
pub mod enclosure;
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
pub mod planner;
#[doc(hidden)]
pub mod problem;
#[doc(hidden)]
pub mod recurrence;
#[doc(hidden)]
pub mod scene;
#[doc(hidden)]
pub mod signal;
#[doc(hidden)]
pub mod solution;

pub use answer::{Doubles, Method, Tolerance};
pub use error::Error;
pub use facade::{Curve, Formula, Signal};
pub use field::{BarFields, Bounded, Fields, Quantity};
pub use history::{Body, ContactSummary, Ending, Event, EventKind, History};
pub use language::{Diagnostic, Label, Span};
pub use problem::{Given, Problem};
pub use signal::{Extremum, Goal, Place, Root, Roots, StablePrecision, Value};
pub use wavestep_polynomial::Rational;
