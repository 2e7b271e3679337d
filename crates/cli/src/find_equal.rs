//! `find --equal`: the value of a symbol for which extrema in two windows are equal.
//!
//! The difference of the extrema, as a function of the symbol, is continuous as long as the two
//! windows keep the arrivals that lie in them. Where it has different signs at two values,
//! certainly, there is one in between for which it is zero; halving keeps such a pair. Whether
//! there is only one is not proven.

use super::arguments::{EvalFormat, Find};
use super::failure::Failure;
use super::find::{Seen, goal, quantity};
use super::input;
use super::json::SCHEMA_VERSION;
use super::progress;
use num_rational::BigRational;
use num_traits::Signed as _;
use serde_json::json;
use std::cmp::Ordering;
use wavestep::ball::{Ball, Decimal};
use wavestep::evaluate::{Goal, Search};
use wavestep::expression::Fraction;
use wavestep::language::{self, Source};
use wavestep_polynomial::Symbol;

/// The most digits: each costs more than three pairs of extrema.
const MAX_DIGITS: usize = 60;

/// What is asked for.
struct Question<'a> {
    options: &'a Find,
    name: String,
    goal: Goal,
    times: [String; 3],
}

/// Finds the value of the symbol.
pub fn run(options: &Find) -> Result<String, Failure> {
    let goal = goal(options).expect("arguments conflict with roots");
    let (name, low, high) = symbol(options.equal.as_deref().unwrap_or_default())?;
    if options.digits > MAX_DIGITS {
        let message = format!("{} digits of a symbol are too many", options.digits);
        return Err(Failure::usage(message, format!("ask for 1 to {MAX_DIGITS} digits")));
    }
    let times = options.between.as_deref().unwrap_or_default();
    let times: Vec<String> = times.split(',').map(|time| time.trim().to_owned()).collect();
    let Ok(times) = <[String; 3]>::try_from(times) else {
        let message = "`--between` needs three times";
        return Err(Failure::usage(message, "write --between T1,T2,T3"));
    };
    let question = Question { options, name, goal, times };
    let (mut low, mut high) = (low, high);
    let (first, last) = (question.sign(&low)?, question.sign(&high)?);
    let (Some(first), Some(last)) = (first, last) else {
        let message = "the extrema cannot be told apart at an end of the range";
        return Err(Failure::usage(message, "give another range"));
    };
    if first == last {
        let larger = if first == Ordering::Greater { "first" } else { "second" };
        let message = format!(
            "the extremum in the {larger} window is the larger one at both ends of the range"
        );
        return Err(Failure::usage(message, "give a range in which that changes"));
    }
    let progress = progress::spinner("halving");
    let half = BigRational::new(1.into(), 2.into());
    let mut told = true;
    while !is_narrow(&low, &high, options.digits) {
        let middle = (&low + &high) * &half;
        match question.sign(&middle)? {
            Some(sign) if sign == first => low = middle,
            Some(_) => high = middle,
            // As good as equal there: points beside it decide, or nothing does.
            None => {
                let quarter = (&high - &low) * &half * &half;
                let (left, right) = (&middle - &quarter, &middle + &quarter);
                match (question.sign(&left)?, question.sign(&right)?) {
                    (Some(a), Some(b)) if a == first && b == last => (low, high) = (left, right),
                    _ => {
                        told = false;
                        break;
                    }
                }
            }
        }
    }
    drop(progress);
    let report = question.written(&low, &high);
    match told {
        true => Ok(report),
        false => Err(Failure::Undecided {
            report,
            message: format!(
                "extrema cannot be told apart with {} bits in this range",
                Search::COMPARISON_BITS
            ),
            remedy: "ask for fewer digits".to_owned(),
        }),
    }
}

/// Whether an interval is shorter than one unit of the last digit.
fn is_narrow(low: &BigRational, high: &BigRational, digits: usize) -> bool {
    let scale = BigRational::from_integer(10.into()).pow(digits as i32);
    (high - low) * scale < low.abs().min(high.abs())
}

/// `SYMBOL=LOW..HIGH`.
fn symbol(text: &str) -> Result<(String, BigRational, BigRational), Failure> {
    let parts =
        text.split_once('=').and_then(|(name, range)| Some((name, range.split_once("..")?)));
    let Some((name, (low, high))) = parts.filter(|(name, _)| !name.trim().is_empty()) else {
        let message = format!("`--equal {text}` is no symbol with a range");
        return Err(Failure::usage(message, "write --equal SYMBOL=LOW..HIGH"));
    };
    let (low, high) = (input::number("--equal", low)?, input::number("--equal", high)?);
    if high <= low {
        let message = format!("the range from {low} to {high} is empty");
        return Err(Failure::usage(message, "give the lower bound first"));
    }
    Ok((language::normalise_name(name.trim()), low, high))
}

impl Question<'_> {
    /// The sign of the extremum in the first window less that in the second.
    fn sign(&self, value: &BigRational) -> Result<Option<Ordering>, Failure> {
        let mut set = self.options.scene.set.clone();
        set.push(format!("{}={value}", self.name));
        let scene = super::arguments::Scene { scene: self.options.scene.scene.clone(), set };
        let seen = Seen::of(input::subject(&scene)?, quantity(self.options)?.0)?;
        let mut times = Vec::new();
        for time in &self.times {
            times.push(self.time(time, value, seen.is_dimensional())?);
        }
        if !(times[0] < times[1] && times[1] < times[2]) {
            let message =
                format!("the times of --between do not ascend at {} = {value}", self.name);
            return Err(Failure::usage(message, "give T1 before T2 before T3"));
        }
        let first = seen.signal([&times[0], &times[1]])?;
        let second = seen.signal([&times[1], &times[2]])?;
        let first = Search::new(&*first)?.half_open();
        let second = Search::new(&*second)?.half_open();
        Ok(first.compare_extremum(&second, self.goal)?)
    }

    /// A time of `--between` with a value in place of the symbol.
    fn time(
        &self,
        text: &str,
        value: &BigRational,
        dimensional: bool,
    ) -> Result<BigRational, Failure> {
        let symbol = Symbol::new(&self.name);
        let expression = match symbol {
            Some(symbol) if text.contains(&self.name) || language::normalise_name(text) != text => {
                let read = language::read_expression(&Source::new("--between", text)?)?;
                read.substitute(&symbol, &Fraction::constant(value)).ok()
            }
            _ => return input::time("--between", text, dimensional),
        };
        match expression.and_then(|time| time.as_constant()).filter(|time| !time.is_negative()) {
            Some(time) => Ok(time),
            None => {
                let message = format!("the time `{text}` is no number from 0 on at {value}");
                Err(Failure::usage(message, format!("let it hold no symbol but {}", self.name)))
            }
        }
    }

    fn written(&self, low: &BigRational, high: &BigRational) -> String {
        let digits = self.options.digits;
        let bits = 8 * digits as u64 + 64;
        let half = BigRational::new(1.into(), 2.into());
        let middle = Ball::from_rational(&((low + high) * &half), bits);
        let ball = middle.add(&Ball::symmetric(&((high - low) * &half)), bits);
        let which = if self.goal == Goal::Largest { "largest" } else { "smallest" };
        let quantity = quantity(self.options).map_or("", |(name, _)| name);
        let [first, second, third] = &self.times;
        let name = &self.name;
        let enclosure = ball.to_decimal(digits + 2);
        match self.options.format {
            EvalFormat::Text => format!(
                "{name} = {enclosure}\n\
                 The {which} {quantity} for {first} <= t < {second} and for {second} <= t < {third} \
                 change places there.\nThat there is no other such value in the range is not proven.\n"
            ),
            EvalFormat::Json => {
                let (low, high) = (low.to_string(), high.to_string());
                let document = json!({
                    "schema_version": SCHEMA_VERSION,
                    "quantity": quantity,
                    "goal": which,
                    "symbol": name,
                    "set": self.options.scene.set,
                    "between": self.times,
                    "low": low,
                    "high": high,
                });
                format!("{document}\n")
            }
            EvalFormat::Csv => {
                let [a, b] = [low, high].map(|end| Decimal::from_rational(end, digits + 2).0);
                format!("symbol,low,high,low_decimal,high_decimal\n{name},{low},{high},{a},{b}\n")
            }
        }
    }
}
