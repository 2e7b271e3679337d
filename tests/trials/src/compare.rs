//! The ways of the library compared with each other.

use crate::{DIGITS, DOUBLES, FORMULAS, MARCHED, TEXT, Tally, print};
use num_traits::{FromPrimitive as _, Signed as _, ToPrimitive as _};
use wavestep::answer::Accuracy;
use wavestep::expression::Fraction;
use wavestep::language::{Source, parse_recurrence, parse_scene, read_expression};
use wavestep::planner::{Origin, Purpose, Together, has_periods};
use wavestep::problem::{Problem, ProblemError};
use wavestep::signal::{ClosedSignal, Limit, Signal, Value, value};
use wavestep::{Method, Tolerance};
use wavestep_polynomial::{Rational, Symbol};

/// Digits of values.
const COUNT: usize = 17;

/// Bits of values at most: one below 2^−1024 is compared as an enclosure of zero. Following a stiff scene takes more cells with
/// each bit, so there the limit is 2^−256.
pub const BITS: u64 = 1 << 10;
pub const STIFF_BITS: u64 = 1 << 8;

/// The law of a march without a proven bound, in parts of the largest value.
const MARCHED_LAW: f64 = 1e-12;

/// A problem, the bits of its values at most, and what was compared of it.
pub struct Comparison<'a> {
    pub problem: &'a Problem,
    pub bits: u64,
    pub tally: &'a mut Tally,
}

/// A time with the side from which it is looked at.
pub type At = (Rational, Limit);

impl Comparison<'_> {
    /// An observable from all sources: enclosures of one value must overlap. Values of the first source that has them.
    pub fn digits(&mut self, name: &str, times: &[At]) -> Result<Vec<Option<Value>>, String> {
        let zero = Rational::default();
        let Some(last) = times.iter().map(|(time, _)| time).max() else { return Ok(Vec::new()) };
        let window = [&zero, last];
        let mut found: Vec<Option<Value>> = vec![None; times.len()];
        for (source, signal) in sources(self.problem, name, window) {
            let signal = match signal {
                Ok(signal) => signal,
                Err(error) => {
                    self.tally.refuse(source, &error);
                    continue;
                }
            };
            for ((time, side), known) in times.iter().zip(&mut found) {
                let told = match value(&*signal, time, *side, COUNT, self.bits) {
                    Ok(told) => told,
                    Err(error) => {
                        self.tally.refuse(source, &error);
                        continue;
                    }
                };
                let Some(known) = known else {
                    *known = Some(told);
                    continue;
                };
                let ([low, high], [least, most]) = (told.bounds(), known.bounds());
                if low > most || high < least {
                    return Err(format!("{name} at {time} {side:?}: {source} {told}, not {known}"));
                }
                self.tally.compared[DIGITS] += 1;
            }
        }
        Ok(found)
    }

    /// Doubles by all methods with a law, and within a tolerance, against digits just after each time. The largest wave is
    /// told in the unit of the values.
    pub fn doubles(
        &mut self,
        name: &str,
        (times, digits): (&[At], &[Option<Value>]),
        (tolerance, largest_wave): (f64, f64),
    ) -> Result<(), String> {
        let known = times.iter().zip(digits).filter(|((_, side), _)| *side == Limit::Right);
        let (times, digits): (Vec<Rational>, Vec<&Value>) =
            known.filter_map(|((time, _), told)| Some((time.clone(), told.as_ref()?))).unzip();
        if times.is_empty() {
            return Ok(());
        }
        let scale = match self.scale(name, &times) {
            Ok(scale) => scale,
            Err(error) => {
                self.tally.refuse("the largest value", &error);
                return Ok(());
            }
        };
        for accuracy in [
            Accuracy::Method(Method::Certified, None),
            Accuracy::Method(Method::Compiled, None),
            Accuracy::Method(Method::Marched { proven: true }, None),
            Accuracy::Within(Tolerance::Relative(tolerance)),
        ] {
            let is_marched = accuracy == Accuracy::Method(Method::Marched { proven: true }, None);
            let what = format!("{accuracy:?}");
            let doubles = match self.problem.doubles(name, &times, Limit::Right, accuracy) {
                Ok(doubles) => doubles,
                Err(error) => {
                    self.tally.refuse(what.split(',').next().expect("a name"), &error);
                    continue;
                }
            };
            let law = match doubles.bound {
                Some(bound) => bound,
                None if doubles.method == Method::Certified => 0.0,
                None => scale.max(largest_wave) * share(&doubles.law),
            };
            if let (Accuracy::Within(allowed), Some(bound)) = (accuracy, doubles.bound)
                && bound > allowed.absolute(if scale > 0.0 { scale * 1.01 } else { 1.0 })
            {
                return Err(format!("{name}: {what} has the bound {bound:e}"));
            }
            for ((double, told), time) in doubles.values.iter().zip(&digits).zip(&times) {
                let step = double.abs().next_up() - double.abs();
                let allowed = exact(law) + exact(step) / exact(2.0);
                let ([low, high], double) = (told.bounds(), exact(*double));
                if double < low - &allowed || double > high + &allowed {
                    let off = (&double - exact(told.to_f64())).to_f64().unwrap_or(f64::NAN);
                    let law = &doubles.law;
                    return Err(format!(
                        "{name} at {time}: {what} is off {told} by {off:e}; {law}"
                    ));
                }
                self.tally.compared[if is_marched { MARCHED } else { DOUBLES }] += 1;
            }
        }
        Ok(())
    }

    /// About the largest value.
    fn scale(&self, name: &str, times: &[Rational]) -> Result<f64, wavestep::Error> {
        let ends = [times.iter().min(), times.iter().max()].map(|time| time.expect("one").clone());
        Ok(self.problem.question_for(name, ends, Purpose::Polynomials)?.scale()?)
    }

    /// Formulas read back as themselves, and with values put in place of symbols they are those of the scene with values.
    pub fn formulas(&mut self, name: &str, valued: &Problem) -> Result<(), String> {
        let derived = [self.problem, valued].map(|problem| problem.derive(name, 0..=2));
        let (mut all, mut remarks) = (Vec::new(), Vec::new());
        for formulas in derived {
            let formulas = match formulas {
                Ok(formulas) => formulas,
                Err(error) => {
                    self.tally.refuse("derive", &error);
                    continue;
                }
            };
            for formula in &formulas {
                let text = formula.text();
                let right = text.split_once(" = ").ok_or_else(|| format!("no formula: {text}"))?.1;
                remarks.push(text.split_once('#').map(|(_, remark)| remark.to_owned()));
                if !formula.equals(right).map_err(|error| format!("{text}: {error}"))? {
                    return Err(format!("{text} does not read back"));
                }
                self.tally.compared[TEXT] += 1;
                let source = Source::new("formula", right).map_err(|error| error.to_string())?;
                all.push(read_expression(&source).map_err(|error| error.to_string())?);
            }
        }
        let has_values = !valued.values().is_empty() && all.len().is_multiple_of(2);
        if !has_values || !is_alike([self.problem, valued]).unwrap_or(false) {
            return Ok(());
        }
        let half = all.len() / 2;
        let names = |symbol: &String| {
            let named = move |remark: &String| {
                remark.split(|own: char| !own.is_alphanumeric()).any(|word| word == symbol)
            };
            remarks.first().and_then(Option::as_ref).is_some_and(named)
        };
        let is_timed = valued.values().keys().any(names);
        for (place, (general, special)) in all[..half].iter().zip(&all[half..]).enumerate() {
            // With values something may not arrive, and intervals are others.
            if !is_timed && remarks[place] != remarks[half + place] {
                break;
            }
            let mut own = general.clone();
            for (symbol, value) in valued.values() {
                own = match own.substitute(&Symbol::new(symbol).expect("a name"), &constant(value))
                {
                    Ok(own) => own,
                    Err(error) => {
                        self.tally.refuse("substitute", &error);
                        return Ok(());
                    }
                };
            }
            if own != *special {
                return Err(format!("{name}: with values {own:?}, not {special:?}"));
            }
            self.tally.compared[FORMULAS] += 1;
        }
        Ok(())
    }
}

/// Whether a problem with symbols and the same with values count in the same units and periods.
fn is_alike([general, special]: [&Problem; 2]) -> Result<bool, wavestep::Error> {
    let [mut period, own] = [general.recurrence()?, special.recurrence()?]
        .map(|recurrence| recurrence.statement().period.clone());
    for (symbol, value) in special.values() {
        let symbol = Symbol::new(symbol).expect("a name");
        let Ok(with_value) = period.substitute(&symbol, &constant(value)) else {
            return Ok(false);
        };
        period = with_value;
    }
    Ok(period == own && general.scales()? == special.scales()?)
}

/// What part of the largest value a law without a bound allows.
fn share(law: &str) -> f64 {
    let told = law.split_once("below ").and_then(|(_, rest)| rest.split(' ').next());
    told.and_then(|told| told.parse().ok()).unwrap_or(MARCHED_LAW)
}

/// A source by its name, and the signal that it gives.
type Named<'a> = (&'static str, Result<Box<dyn Signal + 'a>, ProblemError>);

/// All sources of an observable.
fn sources<'a>(problem: &'a Problem, name: &str, window: [&Rational; 2]) -> Vec<Named<'a>> {
    let few = Purpose::Values { digits: COUNT };
    let Ok(network) = problem.network() else {
        let solution = problem.solution().expect("equations");
        let observation = solution.recurrence().observation(name).expect("it is observed");
        let closed = || ClosedSignal::of_recurrence(solution, &observation, window);
        let boxed = |signal| Box::new(signal) as Box<dyn Signal>;
        let echoes = closed().map(ClosedSignal::echo_by_echo);
        return vec![
            ("pieces", closed().map(boxed).map_err(ProblemError::from)),
            ("echoes", echoes.map(boxed).map_err(ProblemError::from)),
        ];
    };
    let observed = network.observables().iter().find(|own| own.name == name).expect("one");
    let ways: &[_] = match has_periods(network) {
        true => &[
            ("pieces", Origin::Closed, few),
            ("echoes", Origin::Closed, Purpose::Echoes),
            ("followed", Origin::Followed, few),
        ],
        false => &[
            ("followed", Origin::Followed, few),
            ("stretches", Origin::Followed, Purpose::Polynomials),
        ],
    };
    let made = |(source, origin, purpose): &(&'static str, _, _)| {
        let signal =
            Together::new(network, &[observed], window, *purpose).of_origin(*origin, observed);
        (*source, signal.map_err(ProblemError::from))
    };
    ways.iter().map(made).collect()
}

/// A text is read, printed, and read again as the same.
pub fn reads_back(text: &str, is_scene: bool) -> Result<(), String> {
    let source = |text: &str| Source::new("random.wave", text).expect("plain text");
    let told = |error| format!("{error}");
    let (printed, is_same) = if is_scene {
        let tree = parse_scene(&source(text)).map_err(told)?;
        let printed = print::scene(&tree);
        let again = parse_scene(&source(&printed)).map_err(told)?;
        let is_same = again.statements == tree.statements && print::scene(&again) == printed;
        (printed, is_same)
    } else {
        let tree = parse_recurrence(&source(text)).map_err(told)?;
        let printed = print::recurrence(&tree);
        let again = parse_recurrence(&source(&printed)).map_err(told)?;
        let is_same = again.statements == tree.statements && print::recurrence(&again) == printed;
        (printed, is_same)
    };
    if is_same { Ok(()) } else { Err(format!("printed, it is something else:\n{printed}")) }
}

fn constant(value: &Rational) -> Fraction {
    Fraction::one().scale(value)
}

fn exact(value: f64) -> Rational {
    Rational::from_f64(value).expect("a finite number")
}

/// Whether a value is near a double, and how far it is off.
pub fn is_near(value: &Value, unit: f64, double: f64, close: f64) -> Result<(), String> {
    let own = value.to_f64() / unit;
    match (own - double).abs() <= close {
        true => Ok(()),
        false => Err(format!("{own}, and {double} by the solver")),
    }
}

/// A rational number near a double, with a denominator that no arrival has.
pub fn about(time: f64) -> Rational {
    let under = 9973;
    Rational::new((time * f64::from(under)).round().to_i64().unwrap_or(0).into(), under.into())
        .abs()
}
