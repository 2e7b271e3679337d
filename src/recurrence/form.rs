//! Linear forms in wave functions: operators of lag, slope and sum.

use crate::expression::{Expression, Fraction};
use crate::recurrence::WaveIndex;
use std::collections::BTreeMap;
use std::ops::Neg;
use wavestep_polynomial::Symbol;

/// The operator that a linear form applies to one wave `w`:
///
/// ```text
/// Σ_j (value_j w[n−j] + slope_j w'[n−j] + sum_j Σ_{i<n−j} w[i])
/// ```
///
/// # Invariants
/// - coefficients are free of time; trailing zeros are dropped.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Operator {
    /// The coefficients of `w[n−j]`.
    pub value: Vec<Expression>,
    /// The coefficients of `w'[n−j]`.
    pub slope: Vec<Expression>,
    /// The coefficients of `Σ_{i<n−j} w[i]`.
    pub sum: Vec<Expression>,
}

fn add_at(row: &mut Vec<Expression>, lag: usize, coefficient: &Expression) {
    if row.len() <= lag {
        row.resize(lag + 1, Expression::zero());
    }
    row[lag] += coefficient;
    while row.last().is_some_and(Expression::is_zero) {
        row.pop();
    }
}

impl Operator {
    /// One more than the largest lag of a value or a slope.
    pub(crate) fn reach(&self) -> usize {
        self.value.len().max(self.slope.len())
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

    fn rows(&self) -> [&Vec<Expression>; 3] {
        [&self.value, &self.slope, &self.sum]
    }

    fn rows_mut(&mut self) -> [&mut Vec<Expression>; 3] {
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
    pub(crate) forcing: Vec<Expression>,
}

impl LinearForm {
    pub fn zero() -> LinearForm {
        LinearForm::default()
    }

    /// A function of scene time.
    pub fn forcing(function: Expression) -> LinearForm {
        let mut form = LinearForm::zero();
        add_at(&mut form.forcing, 0, &function);
        form
    }

    /// The wave `w[n−lag]`.
    pub fn wave(wave: WaveIndex, lag: usize) -> LinearForm {
        let mut form = LinearForm::zero();
        add_at(&mut form.operators.entry(wave).or_default().value, lag, &Expression::one());
        form
    }

    /// The derivative `w'[n−lag]`.
    pub fn slope(wave: WaveIndex, lag: usize) -> LinearForm {
        let mut form = LinearForm::zero();
        add_at(&mut form.operators.entry(wave).or_default().slope, lag, &Expression::one());
        form
    }

    /// The sum `Σ_{i<n−lag} w[i]`.
    pub fn sum(wave: WaveIndex, lag: usize) -> LinearForm {
        let mut form = LinearForm::zero();
        add_at(&mut form.operators.entry(wave).or_default().sum, lag, &Expression::one());
        form
    }

    pub fn operators(&self) -> impl Iterator<Item = (WaveIndex, &Operator)> + '_ {
        self.operators.iter().map(|(wave, operator)| (*wave, operator))
    }

    pub(crate) fn operator(&self, wave: WaveIndex) -> Operator {
        self.operators.get(&wave).cloned().unwrap_or_default()
    }

    /// The forcing by lag: `forcing_terms()[j]`, as a function of `t − jD`, acts from `t = jD` on.
    pub fn forcing_terms(&self) -> &[Expression] {
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
        let now = |row: &Vec<Expression>| row.first().is_some_and(|c| !c.is_zero());
        let occurs = move |operator: &Operator| now(&operator.value) || now(&operator.slope);
        self.operators().filter(move |(_, operator)| occurs(operator)).map(|(wave, _)| wave)
    }

    /// Adds `factor · q^delay · other`.
    pub fn add_scaled(&mut self, other: &LinearForm, factor: &Expression, delay: usize) {
        for (wave, operator) in &other.operators {
            let own = self.operators.entry(*wave).or_default();
            for (own, other) in own.rows_mut().into_iter().zip(operator.rows()) {
                for (lag, coefficient) in other.iter().enumerate() {
                    add_at(own, lag + delay, &(coefficient * factor));
                }
            }
        }
        self.operators.retain(|_, operator| !operator.is_zero());
        for (lag, function) in other.forcing.iter().enumerate() {
            add_at(&mut self.forcing, lag + delay, &(function * factor));
        }
    }

    /// The form times a factor that is free of time.
    pub fn scaled(&self, factor: &Expression) -> LinearForm {
        let mut form = LinearForm::zero();
        form.add_scaled(self, factor, 0);
        form
    }

    /// Puts `by` in place of `wave`; `false` where that would need a second derivative.
    pub(crate) fn replace(&mut self, wave: WaveIndex, by: &LinearForm, time: &Symbol) -> bool {
        let Some(operator) = self.operators.remove(&wave) else { return true };
        if !operator.slope.is_empty() && by.has_slopes() {
            return false;
        }
        for (lag, value) in operator.value.iter().enumerate() {
            self.add_scaled(by, value, lag);
        }
        for (lag, slope) in operator.slope.iter().enumerate() {
            self.add_scaled(&by.derivative(time), slope, lag);
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
            forcing: Vec::new(),
        };
        for (lag, function) in self.forcing.iter().enumerate() {
            add_at(&mut form.forcing, lag, &function.derivative(time));
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
            for (lag, coefficient) in std::mem::take(&mut operator.sum).iter().enumerate() {
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
