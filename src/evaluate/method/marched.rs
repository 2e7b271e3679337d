//! Marched: the recurrence on Chebyshev coefficients, period by period, for millions of reflections.
//!
//! Where all that is seen has one pole and one lag it is made of delayed copies of one impulse response,
//! and a bound can be proven. All other recurrences are marched through wave by wave, without a bound.

use super::marched_response::MarchedResponse;
use super::marched_waves::MarchedWaves;
use super::{Method, MethodError};
use crate::evaluate::evaluator::Limit;
use crate::evaluate::signal::Signal;
use crate::evaluate::taps::{NoTaps, Taps};
use wavestep_polynomial::Rational;

/// An observable on a window by a march.
///
/// ```
/// use wavestep::evaluate::{Marched, Method, Limit, Signal};
/// use wavestep::language::{Source, parse_number, read_recurrence};
///
/// let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// let values = [("mu".to_owned(), parse_number("1")?)].into();
/// let recurrence = read_recurrence(&Source::new("rigid-mass", text)?, &values)?;
/// let signal = Signal::of_recurrence(&recurrence, &recurrence.observation("f").unwrap()).unwrap();
/// let (from, to) = (parse_number("0")?, parse_number("20")?);
/// let marched = Marched::new(&signal, &from, &to, true).unwrap();
/// let value = marched.value(&parse_number("1")?, Limit::Right).unwrap();
/// assert!((value - (-1f64).exp()).abs() <= marched.bound().unwrap() + 1e-16);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
///
/// Waves with several poles have values without a bound:
///
/// ```
/// use wavestep::evaluate::{Marched, Method, Limit, Signal};
/// use wavestep::language::{Source, parse_number, read_recurrence};
///
/// let source = Source::new("two poles", r#"
///     recurrence "Two poles"
///     period 2, local s, time t
///     wave h, f
///     equation h[n]' + h[n] = h[n-1]' - h[n-1]
///     equation f[n]' + 2*f[n] = h[n]
///     continuous h[n] - h[n-1] starts at 1
///     continuous f[n] starts at 0
/// "#)?;
/// let recurrence = read_recurrence(&source, &Default::default())?;
/// let signal = Signal::of_recurrence(&recurrence, &recurrence.observation("f").unwrap()).unwrap();
/// let (from, to) = (parse_number("0")?, parse_number("20")?);
/// let marched = Marched::new(&signal, &from, &to, true).unwrap();
/// assert_eq!(marched.bound(), None);
/// assert!(marched.law().contains("no bound"));
/// // On the first period f = e^{−t} − e^{−2t}.
/// let value = marched.value(&parse_number("1")?, Limit::Right).unwrap();
/// assert!((value - (-1f64).exp() + (-2f64).exp()).abs() < 1e-15);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub struct Marched {
    march: Inner,
}

/// What is marched through.
enum Inner {
    /// One impulse response.
    Response(Box<MarchedResponse>),
    /// All waves.
    Waves(Box<MarchedWaves>),
}

impl Marched {
    /// The waves until the end of the window; where `proven`, they are marched through at once and
    /// a bound is proven, where there is one pole and one lag.
    ///
    /// # Errors
    /// [`MethodError::NoTaps`], where arrivals lie on no common grid; [`MethodError::TooManyPeriods`];
    /// [`MethodError::Echoes`], where a number is none that doubles can hold.
    ///
    /// # Cost
    /// With one pole and one lag some hundred operations a coefficient for each period, of which there
    /// are about `√(2nD)`; two or three times as many with a bound. Otherwise that for each term of each step.
    pub fn new(
        signal: &Signal,
        from: &Rational,
        to: &Rational,
        proven: bool,
    ) -> Result<Marched, MethodError> {
        let waves = || -> Result<Marched, MethodError> {
            let march = Inner::Waves(Box::new(MarchedWaves::new(signal, from, to)?));
            Ok(Marched { march })
        };
        let taps = match Taps::of(signal) {
            Ok(taps) => taps,
            Err(NoTaps::NoGrid) => return Err(NoTaps::NoGrid.into()),
            Err(_) => return waves(),
        };
        match MarchedResponse::new(taps, signal, from, to, proven) {
            Ok(response) => Ok(Marched { march: Inner::Response(Box::new(response)) }),
            // Growing reflections have no certificate; their waves have values as others have.
            Err(error @ (MethodError::Reflection(_) | MethodError::March(_))) => {
                waves().map_err(|_| error)
            }
            Err(error) => Err(error),
        }
    }

    fn method(&self) -> &dyn Method {
        match &self.march {
            Inner::Response(response) => response.as_ref(),
            Inner::Waves(waves) => waves.as_ref(),
        }
    }
}

impl Method for Marched {
    fn name(&self) -> &'static str {
        "marched"
    }

    fn law(&self) -> String {
        self.method().law()
    }

    fn bound(&self) -> Option<f64> {
        self.method().bound()
    }

    fn value(&self, at: &Rational, side: Limit) -> Result<f64, MethodError> {
        self.method().value(at, side)
    }

    fn exact_values(&self, at: &[Rational], side: Limit) -> Result<Vec<f64>, MethodError> {
        self.method().exact_values(at, side)
    }

    fn values(&self, at: &[f64], values: &mut [f64]) -> Result<(), MethodError> {
        self.method().values(at, values)
    }
}
