//! What people use: a problem, its formulas, and its signals.
//!
//! These are few names with plain arguments over the layers beneath, which know more of each question. All
//! of them return [`Error`].

mod curve;
mod formula;
mod signal;

pub use curve::Curve;
pub use formula::Formula;
pub use signal::Signal;

use crate::error::Error;
use crate::field::{Fields, Mesh};
use crate::history::History;
use crate::limits::MAX_DIGITS;
use crate::problem::{Given, Problem, ProblemError, Values};
use crate::scenes;
use std::ops::RangeInclusive;
use wavestep_polynomial::Rational;

impl Problem {
    /// Reads a text; errors call it by `name`.
    ///
    /// ```
    /// let text = "scene \"A\"\nbar rod { impedance = 1, travel = 1, velocity = 1 }\nline free - rod | fixed";
    /// assert_eq!(wavestep::Problem::read("rod.wave", text)?.title(), "A");
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// All mistakes found in the text, see [`Error::diagnostics`]; or why the scene has no answers.
    ///
    /// # Cost
    /// Time linear in the text; the recurrence of a scene is derived when it is first asked for.
    pub fn read(name: &str, text: impl AsRef<[u8]>) -> Result<Problem, Error> {
        Ok(Problem::of_text(name, text, &Values::new())?)
    }

    /// Reads a text with values in place of symbols from the start, for texts that make no sense without.
    ///
    /// ```
    /// let text = "scene \"A\"\nsymbol z > 0\nbar rod { impedance = z, travel = 1, velocity = 1 }\nline free - rod | fixed";
    /// let rod = wavestep::Problem::read_with("rod.wave", text, [("z", "1/2")])?;
    /// assert_eq!(rod.symbols(), [""; 0]);
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`read`](Problem::read) and [`with`](Problem::with).
    pub fn read_with<N: AsRef<str>>(
        name: &str,
        text: impl AsRef<[u8]>,
        values: impl IntoIterator<Item = (N, impl Into<Given>)>,
    ) -> Result<Problem, Error> {
        let mut numbers = Values::new();
        for (symbol, value) in values {
            numbers.extend([Problem::value_of(symbol.as_ref(), value.into())?]);
        }
        Ok(Problem::of_text(name, text, &numbers)?)
    }

    /// Reads the built-in scene of this name, one of [`scenes::SCENES`].
    ///
    /// ```
    /// use wavestep::{Problem, scenes};
    ///
    /// assert_eq!(Problem::builtin("two-bars")?.waves(), ["f", "g", "F"]);
    /// assert!(scenes::SCENES.iter().all(|scene| Problem::builtin(scene.name).is_ok()));
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// Where there is no such scene.
    pub fn builtin(name: &str) -> Result<Problem, Error> {
        match scenes::find(name) {
            Some(scene) => Problem::read(scene.name, scene.text),
            None => Err(ProblemError::NotBuiltIn(name.to_owned()).into()),
        }
    }

    /// The same text with one more value in place of a symbol, put in before anything is derived.
    ///
    /// ```
    /// let mass = wavestep::Problem::builtin("rigid-mass")?;
    /// assert_eq!(mass.with("μ", "1/4")?.derive("f", 0..=0)?, mass.with("mu", 0.25)?.derive("f", 0..=0)?);
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`read`](Problem::read): also a value that is no number, or against the conditions of the symbol.
    pub fn with(&self, name: &str, value: impl Into<Given>) -> Result<Problem, Error> {
        Ok(self.substituted(name, value)?)
    }

    /// Exact functions of a wave or an observable on the periods `n` of a range: `f[n](s)`, in local time
    /// `0 ≤ s < D` since the beginning of the period. Where travel times have no common measure, the echoes
    /// of a wave in order of their arrival, within so many periods. Velocities and forces are in the units
    /// that [`scales`](Problem::scales) tells.
    ///
    /// ```
    /// let mass = wavestep::Problem::builtin("rigid-mass")?;
    /// let f = mass.derive("f", 0..=1)?;
    /// assert_eq!(f[1].to_string(), "f[1](s) = exp(-s)*(-2*s + 1 + exp(-2*mu))");
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// A name that is unknown; a function that would be too long (see [`limits`](crate::limits)), or has no
    /// formula, as that of an energy.
    ///
    /// # Cost
    /// About `n³/6` terms for the n-th function of a wave with one pole, each a product of small integers.
    pub fn derive(&self, name: &str, orders: RangeInclusive<usize>) -> Result<Vec<Formula>, Error> {
        formula::derive(self, name, orders)
    }

    /// A wave on every period, `f[n]` for all `n` at once, proved by substitution into the recurrence.
    ///
    /// ```
    /// let bars = wavestep::Problem::builtin("two-bars")?;
    /// let form = bars.general("F")?.remove(0);
    /// assert!(form.text().starts_with("F[n] = r/(1 + r)*((r - 1)/(r + 1))^n"));
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// Where no such form is known.
    pub fn general(&self, wave: &str) -> Result<Vec<Formula>, Error> {
        formula::general(self, wave)
    }

    /// A wave or an observable as a function of time.
    ///
    /// ```
    /// let bar = wavestep::Problem::builtin("pile")?;
    /// let unknown = bar.signal("hed").err().unwrap();
    /// assert!(unknown.is_bad_input());
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// A name that is unknown, or of a wave where contacts open.
    pub fn signal(&self, name: &str) -> Result<Signal<'_>, Error> {
        Ok(Signal { problem: self, wanted: self.wanted(name)? })
    }

    /// What contacts do until nothing can meet again, at most for a hundred of the longest travel times, or ten beside
    /// a local contact, and until some 250 events: every separation and re-impact, with proof that none is missed. Instants have `digits` proven digits.
    ///
    /// ```
    /// let hammer = wavestep::Problem::builtin("saint-venant")?.with("mu", 1)?;
    /// let parted = &hammer.events(12)?.events[1];
    /// assert_eq!(parted.time.to_string(), "3.06766764162"); // 3 + exp(-2)/2
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// Where there is no contact, a symbol has no value, or it stays undecided whether something happens.
    ///
    /// # Cost
    /// A few products of small matrices for each echo at each node; all again with twice the precision until
    /// the digits are proven.
    pub fn events(&self, digits: usize) -> Result<History, Error> {
        Ok(self.history(None, proven(digits)?)?)
    }

    /// What contacts do until a time.
    ///
    /// ```
    /// let hammer = wavestep::Problem::builtin("saint-venant")?.with("mu", 1)?;
    /// assert_eq!(hammer.events_until(2, 12)?.events.len(), 1);
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`events`](Problem::events).
    pub fn events_until(&self, time: impl Into<Given>, digits: usize) -> Result<History, Error> {
        let time = self.time("until", time)?;
        Ok(self.history(Some(&time), proven(digits)?)?)
    }

    /// Velocity, strain, displacement and force at a time, at the `cells + 1` nodes that divide each bar
    /// evenly; from larger `x` where a field jumps at a node.
    ///
    /// ```
    /// use wavestep::{Problem, Quantity};
    ///
    /// let bar = Problem::builtin("hopkinson")?.field("100 us", 10)?.bars.remove(0);
    /// assert_eq!((bar.x.len(), bar.of(Quantity::Force).len()), (11, 11));
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// A symbol without a value, a time before the start, no cells or more than
    /// [`MAX_FIELD_CELLS`](crate::limits::MAX_FIELD_CELLS).
    ///
    /// # Cost
    /// The waves are solved until the time, once; then each value is read off one piece of each wave.
    pub fn field(&self, time: impl Into<Given>, cells: usize) -> Result<Fields, Error> {
        let time = self.time("time", time)?;
        self.field_on(&time, &Mesh::new(cells)?)
    }

    /// The averages `∫ q dx/h` of the same fields over each of the cells: what a mesh of finite differences
    /// or finite volumes holds.
    ///
    /// ```
    /// use wavestep::{Problem, Quantity};
    ///
    /// let bar = Problem::builtin("hopkinson")?.field_averages("100 us", 10)?.bars.remove(0);
    /// assert_eq!((bar.x.len(), bar.of(Quantity::Force).len()), (11, 10));
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`field`](Problem::field).
    pub fn field_averages(&self, time: impl Into<Given>, cells: usize) -> Result<Fields, Error> {
        let time = self.time("time", time)?;
        self.field_on(&time, &Mesh::new(cells)?.averages())
    }

    fn field_on(&self, time: &Rational, mesh: &Mesh) -> Result<Fields, Error> {
        Ok(self.field_evaluator(time)?.at(time, mesh)?)
    }

    /// In which units the formulas of a scene are, and what the named constants in them are, a line each.
    ///
    /// ```
    /// let scales = wavestep::Problem::builtin("hopkinson")?.scales()?;
    /// assert!(scales[0].starts_with("times in "));
    /// # Ok::<(), wavestep::Error>(())
    /// ```
    ///
    /// # Errors
    /// Where a value would have to be divided by what may be zero.
    pub fn scales(&self) -> Result<Vec<String>, Error> {
        Ok(self.constants(None)?)
    }
}

/// A number of significant digits that can be proven.
fn proven(digits: usize) -> Result<usize, ProblemError> {
    match digits {
        1..=MAX_DIGITS => Ok(digits),
        _ => Err(ProblemError::Digits(digits)),
    }
}
