//! Derivations in both ways, and what was stated, computed once more straight from the statement.

pub mod corpus;
pub mod mirror;
pub mod snapshot;

use wavestep::expression::{Expression, Fraction};
use wavestep::language::{Source, read_expression};
use wavestep::recurrence::{LinearForm, Recurrence};
use wavestep::solution::{EchoByEcho, PeriodByPeriod};
use wavestep_polynomial::{Polynomial, Rational};

/// A polynomial, as a text of the language.
pub fn polynomial(text: &str) -> Polynomial {
    let read = fraction(text);
    assert_eq!(read.denominator(), Polynomial::one(), "{text}");
    read.numerator().clone()
}

/// A fraction, as a text of the language.
pub fn fraction(text: &str) -> Fraction {
    let read = read_expression(&Source::new("fraction", text).unwrap());
    read.unwrap().as_fraction().expect("no exponential")
}

/// `pieces[wave][n]`, period by period.
pub fn by_periods(recurrence: &Recurrence, through: usize) -> Vec<Vec<Expression>> {
    let mut solver = PeriodByPeriod::new(recurrence);
    (0..=through).for_each(|_| solver.advance().unwrap_or_else(|error| panic!("{error}")));
    // Waves that are added to uncouple others come last.
    solver.pieces()[..recurrence.statement().waves.len()].to_vec()
}

/// `pieces[wave][n]`, echo by echo.
pub fn by_echoes(recurrence: &Recurrence, through: usize) -> Vec<Vec<Expression>> {
    let mut solver = EchoByEcho::new(recurrence);
    (0..=through).for_each(|_| solver.advance().unwrap_or_else(|error| panic!("{error}")));
    let waves = 0..recurrence.statement().waves.len();
    let pieces = |wave| {
        let sum = solver.sum(wave);
        (0..=through).map(|n| sum.piece(n).expect("the period can be put in")).collect()
    };
    waves.map(pieces).collect()
}

/// A stated form on the n-th period, as a function of local time.
pub fn form_on_period(
    recurrence: &Recurrence,
    form: &LinearForm,
    pieces: &[Vec<Expression>],
    n: usize,
) -> Expression {
    let statement = recurrence.statement();
    let mut total = Expression::zero();
    for (wave, operator) in form.operators() {
        let piece = |lag: usize| n.checked_sub(lag).map(|m| &pieces[wave][m]);
        for (lag, coefficient) in operator.value.iter() {
            if let Some(piece) = piece(lag) {
                total += &(piece * coefficient);
            }
        }
        for (lag, coefficient) in operator.slope.iter() {
            if let Some(piece) = piece(lag) {
                total += &(&piece.derivative(&statement.local) * coefficient);
            }
        }
        for (lag, coefficient) in operator.sum.iter() {
            for earlier in &pieces[wave][..n.saturating_sub(lag)] {
                total += &(earlier * coefficient);
            }
        }
    }
    let start = statement.period.scale(&Rational::from_integer(n.into()));
    let now = &Fraction::symbol(&statement.local) + &start;
    for (lag, function) in form.forcing_terms().up_to(n) {
        let late = statement.period.scale(&Rational::from_integer(lag.into()));
        let since = &now - &late;
        total += &function.substitute(&statement.time, &since).expect("time is in no denominator");
    }
    total
}

/// The first stated equation or continuity rule that the pieces break, if there is one.
pub fn violation(recurrence: &Recurrence, pieces: &[Vec<Expression>]) -> Option<String> {
    let statement = recurrence.statement();
    let periods = 0..pieces[0].len();
    for n in periods.clone() {
        for (i, equation) in statement.equations.iter().enumerate() {
            let rest = form_on_period(recurrence, equation, pieces, n);
            if !rest.is_zero() {
                return Some(format!("equation {i} on period {n} leaves {rest:?}"));
            }
        }
    }
    for (i, rule) in statement.continuity.iter().enumerate() {
        let mut before = rule.start.clone();
        for n in periods.clone() {
            let form = form_on_period(recurrence, &rule.form, pieces, n);
            if form.at_zero(&statement.local) != before {
                return Some(format!("rule {i} jumps where period {n} starts"));
            }
            before = form.substitute(&statement.local, &statement.period).expect("a period");
        }
    }
    None
}
