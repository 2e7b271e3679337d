//! How far values may be off.

use crate::ball::unit_in_the_last_place;
use std::fmt;
use std::str::FromStr;

/// A tolerance for all values of a window.
///
/// Written as a number, it is relative to the largest absolute value; `abs:1e-9` is in the unit of the
/// values; `ulp:4` is in units in the last place of the largest value, which are `2^(e−52)` for values
/// from `2^e` to `2^(e+1)`.
///
/// ```
/// use wavestep::Tolerance;
///
/// let (relative, ulps): (Tolerance, Tolerance) = ("1e-9".parse()?, "ulp:4".parse()?);
/// assert_eq!(relative, Tolerance::Relative(1e-9));
/// assert_eq!(ulps.absolute(1.0), 4.0 * f64::EPSILON);
/// # Ok::<(), wavestep::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Tolerance {
    /// In the unit of the values.
    Absolute(f64),
    /// In parts of the largest absolute value.
    Relative(f64),
    /// In units in the last place of the largest absolute value.
    Ulps(f64),
}

impl Tolerance {
    /// The tolerance in the unit of the values, the largest of which is `scale` in size.
    pub fn absolute(self, scale: f64) -> f64 {
        match self {
            Tolerance::Absolute(tolerance) => tolerance,
            Tolerance::Relative(tolerance) => tolerance * scale.abs(),
            Tolerance::Ulps(tolerance) => tolerance * unit_in_the_last_place(scale),
        }
    }
}

/// What is no tolerance.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("`{0}` is not a tolerance")]
pub struct InvalidTolerance(String);

impl FromStr for Tolerance {
    type Err = InvalidTolerance;

    fn from_str(text: &str) -> Result<Tolerance, InvalidTolerance> {
        let invalid = || InvalidTolerance(text.to_owned());
        let (kind, number) = match text.split_once(':') {
            Some(("", _)) => return Err(invalid()),
            Some(parts) => parts,
            None => ("", text),
        };
        let number: f64 = number.trim().parse().map_err(|_| invalid())?;
        if !(number.is_finite() && number > 0.0) {
            return Err(invalid());
        }
        match kind {
            "" => Ok(Tolerance::Relative(number)),
            "abs" => Ok(Tolerance::Absolute(number)),
            "ulp" => Ok(Tolerance::Ulps(number)),
            _ => Err(invalid()),
        }
    }
}

impl fmt::Display for Tolerance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Tolerance::Absolute(tolerance) => write!(f, "{tolerance:e}"),
            Tolerance::Relative(tolerance) => {
                write!(f, "{tolerance:e} of the largest value in the window")
            }
            Tolerance::Ulps(tolerance) => {
                write!(f, "{tolerance} units in the last place of the largest value in the window")
            }
        }
    }
}
