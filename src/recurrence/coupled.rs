//! Waves whose differential equations are coupled, uncoupled one by one.
//!
//! `x' + A x + R = 0`, with everything known in `R` and the rates `a_1 … a_m`, the roots of the
//! characteristic polynomial of `A`. With a row `r_0` and `r_k = r_{k−1} (a_k − A)` the waves
//! `y_k = r_k x` follow from one another,
//!
//! ```text
//! y_k' + a_{k+1} y_k = y_{k+1} − r_k R,        y_m = 0 by the theorem of Cayley and Hamilton,
//! ```
//!
//! so that only first-order equations are ever solved, whatever the rates are, equal ones included.
//! The rows are those of Krylov, `r_0 A^k`, up to multiples of earlier ones: whether `x` can be had
//! back from `y` depends on a determinant without rates in it.

use crate::expression::{Assumptions, Expression, Fraction};
use crate::recurrence::WaveIndex;
use crate::recurrence::form::LinearForm;
use crate::recurrence::naming::Naming;
use crate::recurrence::roots;
use wavestep_polynomial::Rational;

/// Why a system is not uncoupled.
pub(crate) enum Stuck {
    /// The derivatives do not determine each other.
    Degenerate,
    /// The roots of this polynomial, highest power first, have no short exact form.
    Roots(Vec<Fraction>),
}

/// The waves of a system, solved one by one: each with the form that is zero.
pub(crate) struct Uncoupled {
    pub steps: Vec<(WaveIndex, LinearForm)>,
    /// How many waves were added.
    pub hidden: usize,
    /// The rates at which the waves decay together.
    pub rates: Vec<Fraction>,
}

type Matrix = Vec<Vec<Fraction>>;

/// The most waves that are uncoupled together.
const MAX_SIZE: usize = 8;

/// With more waves than this, and more named constants in their rates, formulas have many thousands of terms.
const MANY_WAVES: usize = 6;
const MOST_NAMED: usize = 4;

/// Uncouples as many forms as waves. Added waves are numbered from `hidden` on.
pub(crate) fn uncouple(
    mut forms: Vec<LinearForm>,
    mut waves: Vec<WaveIndex>,
    hidden: WaveIndex,
    naming: &mut Naming,
) -> Result<Uncoupled, Stuck> {
    let tail = take_values(&mut forms, &mut waves, &naming.assumptions)?;
    solve_for_slopes(&mut forms, &waves, &naming.assumptions)?;
    let matrix = rates(&forms, &waves).ok_or(Stuck::Degenerate)?;
    let size = waves.len();
    if size > MAX_SIZE {
        return Err(Stuck::Degenerate);
    }
    let polynomial = characteristic(&matrix);
    let known = naming.numbers.constants().len();
    let rates = roots::of(&polynomial, naming);
    let named = naming.numbers.constants().len() - known;
    let rates = rates.filter(|_| size <= MANY_WAVES || named <= MOST_NAMED);
    let rates = rates.ok_or(Stuck::Roots(polynomial))?;
    let first = (0..size).find_map(|j| {
        let rows = rows(&matrix, j, &rates);
        let determinant = naming.assumptions.invert(&determinant(&rows).into()).ok()?;
        Some((j, rows, determinant.as_fraction()?))
    });
    let (j, rows, inverse) = first.ok_or(Stuck::Degenerate)?;
    let wave_of = |k: usize| if k == 0 { waves[j] } else { hidden + k - 1 };
    let rests: Vec<LinearForm> = forms.iter().map(|form| without(form, &waves)).collect();
    let mut steps = Vec::new();
    for k in (0..size).rev() {
        let mut equation = LinearForm::slope(wave_of(k), 0);
        equation.add_scaled(&LinearForm::wave(wave_of(k), 0), &rates[k].clone().into(), 0);
        if k + 1 < size {
            equation.add_scaled(&LinearForm::wave(wave_of(k + 1), 0), &-&Expression::one(), 0);
        }
        for (rest, weight) in rests.iter().zip(&rows[k]) {
            equation.add_scaled(rest, &weight.clone().into(), 0);
        }
        steps.push((wave_of(k), equation));
    }
    for i in (0..size).filter(|i| *i != j) {
        // x_i = Σ_k (T^{−1})_{ik} y_k, with T the rows; its entries are cofactors.
        let mut own = LinearForm::wave(waves[i], 0);
        for k in 0..size {
            let sign = if (i + k) % 2 == 0 { Fraction::one() } else { -&Fraction::one() };
            let cofactor = &(&determinant(&minor(&rows, k, i)) * &inverse) * &sign;
            own.add_scaled(&LinearForm::wave(wave_of(k), 0), &-&Expression::from(cofactor), 0);
        }
        steps.push((waves[i], own));
    }
    steps.extend(tail);
    Ok(Uncoupled { steps, hidden: size - 1, rates })
}

/// Waves without a derivative are given by one of the forms each, and leave the others.
fn take_values(
    forms: &mut Vec<LinearForm>,
    waves: &mut Vec<WaveIndex>,
    assumptions: &Assumptions,
) -> Result<Vec<(WaveIndex, LinearForm)>, Stuck> {
    let mut taken = Vec::new();
    let slopeless = |forms: &[LinearForm], wave: &WaveIndex| {
        forms.iter().all(|form| form.operator(*wave).slope_now().is_zero())
    };
    while let Some(place) = waves.iter().position(|wave| slopeless(forms, wave)) {
        let wave = waves.remove(place);
        let value = |form: &LinearForm| form.operator(wave).value_now();
        let (row, inverse) = pivot(forms.iter().map(value), assumptions)?;
        let own = forms.remove(row).scaled(&inverse);
        for form in forms.iter_mut() {
            let factor = -&value(form);
            form.add_scaled(&own, &factor, 0);
        }
        taken.push((wave, own));
    }
    if waves.is_empty() {
        return Err(Stuck::Degenerate);
    }
    taken.reverse();
    Ok(taken)
}

/// The first of some values that can be divided by, and its inverse.
fn pivot(
    values: impl Iterator<Item = Expression>,
    assumptions: &Assumptions,
) -> Result<(usize, Expression), Stuck> {
    let inverse = |(row, value): (usize, Expression)| Some((row, assumptions.invert(&value).ok()?));
    let mut values = values.enumerate();
    values.find_map(inverse).ok_or(Stuck::Degenerate)
}

/// The rows `r_0 = e_j`, `r_k = r_{k−1} (a_k − A)`.
fn rows(matrix: &Matrix, j: usize, rates: &[Fraction]) -> Matrix {
    let size = matrix.len();
    let unit = |i| if i == j { Fraction::one() } else { Fraction::zero() };
    let mut rows: Matrix = vec![(0..size).map(unit).collect()];
    for rate in &rates[..size - 1] {
        let last = rows.last().expect("one at least");
        let next = (0..size).map(|column| {
            let product =
                (0..size).fold(Fraction::zero(), |sum, k| &sum + &(&last[k] * &matrix[k][column]));
            &(&last[column] * rate) - &product
        });
        let next = next.collect();
        rows.push(next);
    }
    rows
}

/// The determinant, by expansion along the first row: for a few rows.
fn determinant(rows: &[Vec<Fraction>]) -> Fraction {
    if rows.is_empty() {
        return Fraction::one();
    }
    let mut sum = Fraction::zero();
    for (column, entry) in rows[0].iter().enumerate().filter(|(_, entry)| !entry.is_zero()) {
        let term = entry * &determinant(&minor(rows, 0, column));
        sum = if column % 2 == 0 { &sum + &term } else { &sum - &term };
    }
    sum
}

/// The rows without one of them and without a column.
fn minor(rows: &[Vec<Fraction>], row: usize, column: usize) -> Matrix {
    let rest = rows.iter().enumerate().filter(|(i, _)| *i != row);
    rest.map(|(_, entries)| {
        let kept = entries.iter().enumerate().filter(|(j, _)| *j != column);
        kept.map(|(_, entry)| entry.clone()).collect()
    })
    .collect()
}

/// Turns the forms into `x_i' + … = 0`, one slope each.
fn solve_for_slopes(
    forms: &mut [LinearForm],
    waves: &[WaveIndex],
    assumptions: &Assumptions,
) -> Result<(), Stuck> {
    for (i, wave) in waves.iter().enumerate() {
        let slope = |form: &LinearForm| form.operator(*wave).slope_now();
        let (row, inverse) = pivot(forms[i..].iter().map(slope), assumptions)?;
        forms.swap(i, i + row);
        let own = forms[i].scaled(&inverse);
        for (j, form) in forms.iter_mut().enumerate() {
            match i == j {
                true => *form = own.clone(),
                false => {
                    let factor = -&slope(form);
                    form.add_scaled(&own, &factor, 0);
                }
            }
        }
    }
    Ok(())
}

/// The matrix `A`: what each form holds of each wave at lag 0.
fn rates(forms: &[LinearForm], waves: &[WaveIndex]) -> Option<Matrix> {
    let row = |form: &LinearForm| {
        waves.iter().map(|wave| form.operator(*wave).value_now().as_fraction()).collect()
    };
    forms.iter().map(row).collect()
}

/// The form without values and slopes of these waves at lag 0.
fn without(form: &LinearForm, waves: &[WaveIndex]) -> LinearForm {
    let mut rest = form.clone();
    for wave in waves {
        let operator = form.operator(*wave);
        rest.add_scaled(&LinearForm::wave(*wave, 0), &-&operator.value_now(), 0);
        rest.add_scaled(&LinearForm::slope(*wave, 0), &-&operator.slope_now(), 0);
    }
    rest
}

/// The characteristic polynomial `det(λ − A)`, highest power first, by the method of Faddeev and
/// LeVerrier.
fn characteristic(matrix: &Matrix) -> Vec<Fraction> {
    let size = matrix.len();
    let mut polynomial = vec![Fraction::one()];
    let mut power: Matrix = vec![vec![Fraction::zero(); size]; size];
    (0..size).for_each(|i| power[i][i] = Fraction::one());
    for k in 1..=size {
        power = multiply(matrix, &power);
        let trace = (0..size).fold(Fraction::zero(), |sum, i| &sum + &power[i][i]);
        let coefficient = trace.scale(&Rational::new((-1).into(), k.into()));
        (0..size).for_each(|i| power[i][i] = &power[i][i] + &coefficient);
        polynomial.push(coefficient);
    }
    polynomial
}

fn multiply(left: &Matrix, right: &Matrix) -> Matrix {
    let size = left.len();
    let entry = |i: usize, j: usize| {
        (0..size).fold(Fraction::zero(), |sum, k| &sum + &(&left[i][k] * &right[k][j]))
    };
    (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect()
}
