//! Waves whose differential equations are coupled, uncoupled one by one.
//!
//! `x' + A x + R = 0`, with everything known in `R`, has a left eigenvector `l` for each rate `a`:
//! `l A = a l`. So `z = l x` stands alone, `z' + a z + l R = 0`; with `z` known one of the `x` leaves
//! the system, and the rest goes on in the same way. Only first-order equations are ever solved.
//!
//! The rates are the roots of the characteristic polynomial, which comes with the adjugate of
//! `λ − A`, the source of the eigenvectors, from the method of Faddeev and LeVerrier.

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
    /// The roots of this polynomial, highest power first, are not known exactly.
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

/// Uncouples as many forms as waves, each with slopes of the waves at lag 0. Added waves are
/// numbered from `hidden` on.
pub(crate) fn uncouple(
    mut forms: Vec<LinearForm>,
    mut waves: Vec<WaveIndex>,
    hidden: WaveIndex,
    naming: &mut Naming,
) -> Result<Uncoupled, Stuck> {
    solve_for_slopes(&mut forms, &waves, naming.assumptions())?;
    let mut matrix = rates(&forms, &waves).ok_or(Stuck::Degenerate)?;
    let (polynomial, _) = characteristic(&matrix);
    let mut roots = roots::of(&polynomial, naming).ok_or(Stuck::Roots(polynomial))?;
    let rates_found = roots.clone();
    let (mut steps, mut algebraic) = (Vec::new(), Vec::new());
    let mut added = 0;
    while waves.len() > 1 {
        let rate = roots.pop().expect("as many roots as waves");
        let (place, vector) =
            left_eigenvector(&matrix, &rate, naming.assumptions()).ok_or(Stuck::Degenerate)?;
        let auxiliary = hidden + added;
        added += 1;
        // z' + a z + l R = 0
        let mut equation = LinearForm::slope(auxiliary, 0);
        equation.add_scaled(&LinearForm::wave(auxiliary, 0), &rate.clone().into(), 0);
        for (form, weight) in forms.iter().zip(&vector) {
            equation.add_scaled(&without(form, &waves), &weight.clone().into(), 0);
        }
        steps.push((auxiliary, equation));
        // x_k = z − Σ l_j x_j
        let (wave, form) = (waves.remove(place), LinearForm::wave(auxiliary, 0));
        forms.remove(place);
        let mut solved = form;
        let others = vector.iter().enumerate().filter(|(j, _)| *j != place).map(|(_, l)| l);
        for (other, weight) in waves.iter().zip(others) {
            let term = LinearForm::wave(*other, 0);
            solved.add_scaled(&term, &-&Expression::from(weight.clone()), 0);
        }
        for form in &mut forms {
            let value = form.operator(wave).value_now();
            form.add_scaled(&LinearForm::wave(wave, 0), &-&value, 0);
            form.add_scaled(&solved, &value, 0);
        }
        let mut own = LinearForm::wave(wave, 0);
        own.add_scaled(&solved, &-&Expression::one(), 0);
        algebraic.push((wave, own));
        matrix = rates(&forms, &waves).ok_or(Stuck::Degenerate)?;
    }
    // The last rate is the root that is left.
    let (wave, form) = (waves[0], &forms[0]);
    let mut equation = without(form, &waves);
    equation.add_scaled(&LinearForm::slope(wave, 0), &Expression::one(), 0);
    let rate = roots.pop().expect("as many roots as waves");
    equation.add_scaled(&LinearForm::wave(wave, 0), &rate.into(), 0);
    steps.push((wave, equation));
    steps.extend(algebraic.into_iter().rev());
    Ok(Uncoupled { steps, hidden: added, rates: rates_found })
}

/// Turns the forms into `x_i' + … = 0`, one slope each.
fn solve_for_slopes(
    forms: &mut [LinearForm],
    waves: &[WaveIndex],
    assumptions: &Assumptions,
) -> Result<(), Stuck> {
    for (i, wave) in waves.iter().enumerate() {
        let slope = |form: &LinearForm| form.operator(*wave).slope_now();
        let pivot = (i..forms.len())
            .find_map(|row| Some((row, assumptions.invert(&slope(&forms[row])).ok()?)));
        let (row, inverse) = pivot.ok_or(Stuck::Degenerate)?;
        forms.swap(i, row);
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

/// The characteristic polynomial `det(λ − A)`, highest power first, and the matrices `M_k` of the
/// adjugate `Σ_k λ^{m−k} M_k`.
fn characteristic(matrix: &Matrix) -> (Vec<Fraction>, Vec<Matrix>) {
    let size = matrix.len();
    let identity = |value: &Fraction| -> Matrix {
        let entry = |i, j| if i == j { value.clone() } else { Fraction::zero() };
        (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect()
    };
    let mut polynomial = vec![Fraction::one()];
    let mut matrices = vec![identity(&Fraction::one())];
    for k in 1..=size {
        let product = multiply(matrix, matrices.last().expect("one at least"));
        let trace = (0..size).fold(Fraction::zero(), |sum, i| &sum + &product[i][i]);
        let coefficient = trace.scale(&Rational::new((-1).into(), k.into()));
        let shift = identity(&coefficient);
        let add = |(a, b): (Vec<Fraction>, Vec<Fraction>)| -> Vec<Fraction> {
            a.iter().zip(&b).map(|(a, b)| a + b).collect()
        };
        matrices.push(product.into_iter().zip(shift).map(add).collect());
        polynomial.push(coefficient);
    }
    matrices.truncate(size);
    (polynomial, matrices)
}

fn multiply(left: &Matrix, right: &Matrix) -> Matrix {
    let size = left.len();
    let entry = |i: usize, j: usize| {
        (0..size).fold(Fraction::zero(), |sum, k| &sum + &(&left[i][k] * &right[k][j]))
    };
    (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect()
}

/// A left eigenvector for `rate`, scaled to 1 at the place that is told: a row of the adjugate of
/// `rate − A`, whose product with `rate − A` is the characteristic polynomial there, zero.
fn left_eigenvector(
    matrix: &Matrix,
    rate: &Fraction,
    assumptions: &Assumptions,
) -> Option<(usize, Vec<Fraction>)> {
    let (_, matrices) = characteristic(matrix);
    let size = matrix.len();
    (0..size).find_map(|i| {
        let entry = |j: usize| {
            // Horner in the rate.
            let terms = matrices.iter().map(|matrix| &matrix[i][j]);
            terms.fold(Fraction::zero(), |value, term| &(&value * rate) + term)
        };
        let row: Vec<Fraction> = (0..size).map(entry).collect();
        row.iter().enumerate().rev().find_map(|(place, entry)| {
            let inverse = assumptions.invert(&entry.clone().into()).ok()?.as_fraction()?;
            Some((place, row.iter().map(|entry| entry * &inverse).collect()))
        })
    })
}
