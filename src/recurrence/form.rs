//! Linear forms in wave functions: operators of lag, slope and sum.

use crate::expression::{Expression, Fraction};
use crate::recurrence::WaveIndex;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Neg;
use wavestep_polynomial::Symbol;

/// The operator that a linear form applies to one wave `w`:
///
/// ```text
/// Σ_j (value_j w[n−j] + slope_j w'[n−j] + sum_j Σ_{i<n−j} w[i])
/// ```
///
/// # Invariants
/// - coefficients are free of time.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Operator {
    /// The coefficients of `w[n−j]`.
    pub value: Lags,
    /// The coefficients of `w'[n−j]`.
    pub slope: Lags,
    /// The coefficients of `Σ_{i<n−j} w[i]`.
    pub sum: Lags,
}

/// Expressions by lag. On a lattice of several periods lags are large numbers, and few of them occur.
///
/// # Invariants
/// - no expression is zero.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Lags(BTreeMap<usize, Expression>);

impl Lags {
    fn add(&mut self, lag: usize, value: &Expression) {
        let sum = self.0.entry(lag).or_default();
        *sum += value;
        if sum.is_zero() {
            self.0.remove(&lag);
        }
    }

    /// The expression at a lag; `None` for zero.
    pub fn get(&self, lag: usize) -> Option<&Expression> {
        self.0.get(&lag)
    }

    /// Those that are not zero, by lag.
    pub fn iter(&self) -> impl Iterator<Item = (usize, &Expression)> {
        self.0.iter().map(|(lag, value)| (*lag, value))
    }

    /// Those up to and including a lag.
    pub fn up_to(&self, last: usize) -> impl Iterator<Item = (usize, &Expression)> {
        self.0.range(..=last).map(|(lag, value)| (*lag, value))
    }

    /// Those that are not zero.
    pub fn values(&self) -> impl Iterator<Item = &Expression> {
        self.0.values()
    }

    /// One more than the largest lag.
    pub fn reach(&self) -> usize {
        self.0.last_key_value().map_or(0, |(lag, _)| lag + 1)
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// All up to the largest lag, as the coefficients of a polynomial.
    pub(crate) fn dense(&self) -> Vec<Expression> {
        (0..self.reach()).map(|lag| self.get(lag).cloned().unwrap_or_default()).collect()
    }
}

impl Operator {
    /// One more than the largest lag of a value or a slope.
    pub fn reach(&self) -> usize {
        self.value.reach().max(self.slope.reach())
    }

    /// The lags of values and slopes, each once, ascending.
    pub(crate) fn lags(&self) -> impl Iterator<Item = usize> {
        let lags: BTreeSet<usize> =
            self.value.iter().chain(self.slope.iter()).map(|(lag, _)| lag).collect();
        lags.into_iter()
    }

    /// The coefficient of `w[n−lag]`.
    pub(crate) fn value_at(&self, lag: usize) -> Expression {
        self.value.get(lag).cloned().unwrap_or_default()
    }

    /// The coefficient of `w'[n−lag]`.
    pub(crate) fn slope_at(&self, lag: usize) -> Expression {
        self.slope.get(lag).cloned().unwrap_or_default()
    }

    pub(crate) fn value_now(&self) -> Expression {
        self.value_at(0)
    }

    pub(crate) fn slope_now(&self) -> Expression {
        self.slope_at(0)
    }

    fn is_zero(&self) -> bool {
        self.value.is_empty() && self.slope.is_empty() && self.sum.is_empty()
    }

    pub(crate) fn rows(&self) -> [&Lags; 3] {
        [&self.value, &self.slope, &self.sum]
    }

    fn rows_mut(&mut self) -> [&mut Lags; 3] {
        [&mut self.value, &mut self.slope, &mut self.sum]
    }
}

/// A linear form in the waves of a recurrence, on the n-th period:
///
/// ```text
/// Σ_w operator_w w  +  Σ_{j ≤ n} forcing_j(t − jD)
/// ```
///
/// with `t` the scene time: like a wave, forcing at lag `j` is the function of lag 0, `jD` later.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct LinearForm {
    pub(crate) operators: BTreeMap<WaveIndex, Operator>,
    pub(crate) forcing: Lags,
}

impl LinearForm {
    pub fn zero() -> LinearForm {
        LinearForm::default()
    }

    /// A function of scene time.
    pub fn forcing(function: Expression) -> LinearForm {
        let mut form = LinearForm::zero();
        form.forcing.add(0, &function);
        form
    }

    /// The wave `w[n−lag]`.
    pub fn wave(wave: WaveIndex, lag: usize) -> LinearForm {
        let mut form = LinearForm::zero();
        form.operators.entry(wave).or_default().value.add(lag, &Expression::one());
        form
    }

    /// The derivative `w'[n−lag]`.
    pub fn slope(wave: WaveIndex, lag: usize) -> LinearForm {
        let mut form = LinearForm::zero();
        form.operators.entry(wave).or_default().slope.add(lag, &Expression::one());
        form
    }

    /// The sum `Σ_{i<n−lag} w[i]`.
    pub fn sum(wave: WaveIndex, lag: usize) -> LinearForm {
        let mut form = LinearForm::zero();
        form.operators.entry(wave).or_default().sum.add(lag, &Expression::one());
        form
    }

    pub fn operators(&self) -> impl Iterator<Item = (WaveIndex, &Operator)> + '_ {
        self.operators.iter().map(|(wave, operator)| (*wave, operator))
    }

    pub(crate) fn operator(&self, wave: WaveIndex) -> Operator {
        self.operators.get(&wave).cloned().unwrap_or_default()
    }

    /// The forcing by lag: that of lag `j`, as a function of `t − jD`, acts from `t = jD` on.
    pub fn forcing_terms(&self) -> &Lags {
        &self.forcing
    }

    pub(crate) fn is_free_of_waves(&self) -> bool {
        self.operators.is_empty()
    }

    pub fn is_zero(&self) -> bool {
        self.operators.is_empty() && self.forcing.is_empty()
    }

    pub(crate) fn has_slopes(&self) -> bool {
        self.operators.values().any(|operator| !operator.slope.is_empty())
    }

    pub(crate) fn waves_now(&self) -> impl Iterator<Item = WaveIndex> + '_ {
        let now = |row: &Lags| row.get(0).is_some();
        let occurs = move |operator: &Operator| now(&operator.value) || now(&operator.slope);
        self.operators().filter(move |(_, operator)| occurs(operator)).map(|(wave, _)| wave)
    }

    /// Adds `factor · q^delay · other`.
    pub fn add_scaled(&mut self, other: &LinearForm, factor: &Expression, delay: usize) {
        for (wave, operator) in &other.operators {
            let own = self.operators.entry(*wave).or_default();
            for (own, other) in own.rows_mut().into_iter().zip(operator.rows()) {
                for (lag, coefficient) in other.iter() {
                    own.add(lag + delay, &(coefficient * factor));
                }
            }
        }
        self.operators.retain(|_, operator| !operator.is_zero());
        for (lag, function) in other.forcing.iter() {
            self.forcing.add(lag + delay, &(function * factor));
        }
    }

    /// The form so many periods earlier, `None` where it names a period before.
    pub(crate) fn earlier(&self, periods: usize) -> Option<LinearForm> {
        let earlier = |lags: &Lags| {
            let moved = lags.iter().map(|(lag, x)| Some((lag.checked_sub(periods)?, x.clone())));
            moved.collect::<Option<_>>().map(Lags)
        };
        let operators = self.operators().map(|(wave, Operator { value, slope, sum })| {
            let [value, slope, sum] = [earlier(value)?, earlier(slope)?, earlier(sum)?];
            Some((wave, Operator { value, slope, sum }))
        });
        let operators = operators.collect::<Option<_>>()?;
        Some(LinearForm { operators, forcing: earlier(&self.forcing)? })
    }

    /// The form times a factor that is free of time.
    pub fn scaled(&self, factor: &Expression) -> LinearForm {
        let mut form = LinearForm::zero();
        form.add_scaled(self, factor, 0);
        form
    }

    /// Adds `c(q) form`, with coefficients by lag.
    pub(crate) fn add_product(&mut self, form: &LinearForm, coefficients: &Lags) {
        for (lag, coefficient) in coefficients.iter() {
            self.add_scaled(form, coefficient, lag);
        }
    }

    /// Puts `by` in place of `wave`; `false` where that would need a second derivative.
    pub(crate) fn replace(&mut self, wave: WaveIndex, by: &LinearForm, time: &Symbol) -> bool {
        let Some(operator) = self.operators.remove(&wave) else { return true };
        if !operator.slope.is_empty() && by.has_slopes() {
            return false;
        }
        self.add_product(by, &operator.value);
        if !operator.slope.is_empty() {
            self.add_product(&by.derivative(time), &operator.slope);
        }
        true
    }

    /// The derivative of a form without slopes and sums, piece by piece.
    pub fn derivative(&self, time: &Symbol) -> LinearForm {
        let derive = |(wave, operator): (&WaveIndex, &Operator)| {
            assert!(operator.slope.is_empty() && operator.sum.is_empty(), "a second derivative");
            let slope = operator.value.clone();
            (*wave, Operator { slope, ..Operator::default() })
        };
        let mut form = LinearForm {
            operators: self.operators.iter().map(derive).collect(),
            forcing: Lags::default(),
        };
        for (lag, function) in self.forcing.iter() {
            form.forcing.add(lag, &function.derivative(time));
        }
        form
    }

    /// The form with sums over all earlier pieces removed: where there are any, the difference
    /// `form[n] − form[n−1]`, in which `Σ_{i<n} w[i]` leaves `w[n−1]`.
    pub fn without_sums(&self) -> LinearForm {
        if self.operators.values().all(|operator| operator.sum.is_empty()) {
            return self.clone();
        }
        let mut rest = self.clone();
        let mut differenced = LinearForm::zero();
        for (wave, operator) in &mut rest.operators {
            for (lag, coefficient) in std::mem::take(&mut operator.sum).iter() {
                differenced.add_scaled(&LinearForm::wave(*wave, lag + 1), coefficient, 0);
            }
        }
        differenced.add_scaled(&rest, &Expression::one(), 0);
        differenced.add_scaled(&rest, &-&Expression::one(), 1);
        differenced
    }

    /// The rate `a` of the operator `w' + a w` at lag 0, where the slope's coefficient is 1.
    pub(crate) fn rate_now(&self, wave: WaveIndex) -> Option<Fraction> {
        self.operator(wave).value_now().as_fraction()
    }
}

impl Neg for &LinearForm {
    type Output = LinearForm;
    fn neg(self) -> LinearForm {
        self.scaled(&-&Expression::one())
    }
}
