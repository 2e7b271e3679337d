//! The equations of a node on a short piece of time, by collocation at Chebyshev points.
//!
//! The slopes at 25 points of a piece of length `h` stand for the polynomial of degree 24 through them, and
//! the state at the points is `y_j = y_0 + h Σ_k Q_jk y'_k` with its exact integrals. With
//! `y' = A y + B u` that is one linear system for each length, `(1 − h Q ⊗ A) Y = y_0 + h Q B U`, which is
//! solved once. The force of a local contact is an input that depends on the state: its compressions at the
//! points are found by the method of Newton.
//!
//! Order: 25. Where the solution is smooth, half the length divides the error by some `2^25`, until rounding
//! is larger. The last coefficients of the series through the points tell how large the error is; it is below
//! them. Stiff nodes need no shorter pieces than their solution does.

use crate::model::line::LocalContact;
use crate::model::track::{POINTS, Values, integral, points, series, sum};
use crate::network::System;
use std::sync::LazyLock;

/// The most steps of the method of Newton.
const MAX_STEPS: usize = 30;

/// `Q_jk = ∫ ℓ_k` from 0 to the j-th point, where `ℓ_k` is 1 at the k-th point and 0 at the others.
static INTEGRALS: LazyLock<[Values; POINTS]> = LazyLock::new(|| {
    let mut matrix = [[0.0; POINTS]; POINTS];
    for k in 0..POINTS {
        let unit = std::array::from_fn(|j| f64::from(u8::from(j == k)));
        let integral = integral(&series(&unit));
        for (row, at) in matrix.iter_mut().zip(points()) {
            row[k] = sum(&integral, 2.0 * at - 1.0);
        }
    }
    matrix
});

type Matrix = Vec<Vec<f64>>;

fn dot(row: &[f64], column: &[f64]) -> f64 {
    row.iter().zip(column).map(|(a, b)| a * b).sum()
}

/// The inverse of a matrix, by elimination with pivots; `None` where it has none.
fn inverse(mut matrix: Matrix) -> Option<Matrix> {
    let size = matrix.len();
    let mut result: Matrix =
        (0..size).map(|i| (0..size).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    for i in 0..size {
        let largest = |a: &usize, b: &usize| matrix[*a][i].abs().total_cmp(&matrix[*b][i].abs());
        let pivot = (i..size).max_by(largest)?;
        let whole = matrix[pivot][i];
        if !(whole.abs() > f64::MIN_POSITIVE && whole.is_finite()) {
            return None;
        }
        matrix.swap(i, pivot);
        result.swap(i, pivot);
        for entry in matrix[i].iter_mut().chain(&mut result[i]) {
            *entry /= whole;
        }
        for row in (0..size).filter(|row| *row != i) {
            let factor = matrix[row][i];
            if factor == 0.0 {
                continue;
            }
            for rows in [&mut matrix, &mut result] {
                let own = rows[i].clone();
                rows[row].iter_mut().zip(own).for_each(|(entry, above)| *entry -= factor * above);
            }
        }
    }
    Some(result)
}

/// A local contact in the system of its node.
#[derive(Clone, Copy, Debug)]
pub struct Pressing {
    pub contact: LocalContact,
    /// Where its compression stands in the state, and its force in the input.
    pub state: usize,
    pub input: usize,
}

/// A node on pieces of one length.
#[derive(Debug)]
pub struct Collocation<'a> {
    system: &'a System<f64>,
    contacts: &'a [Pressing],
    length: f64,
    /// The inverse of `1 − h Q ⊗ A`, state by state and point by point.
    inverse: Matrix,
    /// What each force at each point adds to the compressions of all local contacts at all points.
    response: Matrix,
}

impl<'a> Collocation<'a> {
    /// The equations of a node; `None` where they cannot be solved on this length.
    pub fn of(
        system: &'a System<f64>,
        contacts: &'a [Pressing],
        length: f64,
    ) -> Option<Collocation<'a>> {
        let entry = |row: usize, column: usize| {
            let rate = system.change[row / POINTS][column / POINTS];
            let unit = f64::from(u8::from(row == column));
            unit - length * rate * INTEGRALS[row % POINTS][column % POINTS]
        };
        let size = system.states() * POINTS;
        let row = |row: usize| (0..size).map(|column| entry(row, column)).collect();
        let inverse = inverse((0..size).map(row).collect())?;
        let response = Vec::new();
        let mut collocation = Collocation { system, contacts, length, inverse, response };
        let still = vec![0.0; system.states()];
        for own in contacts {
            for point in 0..POINTS {
                let mut input = vec![[0.0; POINTS]; system.inputs()];
                input[own.input][point] = 1.0;
                let answer = collocation.compressions(&still, &input);
                collocation.response.push(answer);
            }
        }
        Some(collocation)
    }

    /// The states at all points of a piece that begins with `from`. Forces of local contacts, zero in the
    /// input that is given, are filled in; they are found until no step changes a compression by more than
    /// the share `accuracy` of its scale. `None` where they are not found.
    pub fn solve(
        &self,
        from: &[f64],
        input: &mut [Values],
        scales: &[f64],
        accuracy: f64,
    ) -> Option<Vec<Values>> {
        if !self.contacts.is_empty() {
            self.press(from, input, scales, accuracy)?;
        }
        let right = self.right(from, input);
        Some((0..from.len()).map(|state| self.state(state, &right)).collect())
    }

    /// `y_0 + h Q B U`.
    fn right(&self, from: &[f64], input: &[Values]) -> Vec<f64> {
        let mut right = Vec::with_capacity(self.inverse.len());
        for (row, from) in self.system.change.iter().zip(from) {
            let row = &row[self.system.states()..];
            let forced: Values =
                std::array::from_fn(|j| row.iter().zip(input).map(|(c, u)| c * u[j]).sum());
            right
                .extend(INTEGRALS.iter().map(|weights| from + self.length * dot(weights, &forced)));
        }
        right
    }

    fn state(&self, state: usize, right: &[f64]) -> Values {
        std::array::from_fn(|j| dot(&self.inverse[state * POINTS + j], right))
    }

    /// The compressions of all local contacts at all points.
    fn compressions(&self, from: &[f64], input: &[Values]) -> Vec<f64> {
        let right = self.right(from, input);
        self.contacts.iter().flat_map(|own| self.state(own.state, &right)).collect()
    }

    /// Fills in the forces of local contacts: `α = α_0 + G X(α)`, with what is without them, `α_0`.
    fn press(
        &self,
        from: &[f64],
        input: &mut [Values],
        scales: &[f64],
        accuracy: f64,
    ) -> Option<()> {
        let free = self.compressions(from, input);
        let own = |i: usize| &self.contacts[i / POINTS];
        let mut found: Vec<f64> = (0..free.len()).map(|i| from[own(i).state]).collect();
        for _ in 0..MAX_STEPS {
            let forces: Vec<f64> =
                found.iter().enumerate().map(|(i, a)| own(i).contact.force_at(*a)).collect();
            let slopes: Vec<f64> =
                found.iter().enumerate().map(|(i, a)| own(i).contact.slope_at(*a)).collect();
            let rest = |i: usize| {
                let answers = self.response.iter().zip(&forces);
                free[i] - found[i] + answers.map(|(answer, force)| answer[i] * force).sum::<f64>()
            };
            let rest: Vec<f64> = (0..free.len()).map(rest).collect();
            let entry =
                |i: usize, k: usize| f64::from(u8::from(i == k)) - self.response[k][i] * slopes[k];
            let row = |i: usize| (0..free.len()).map(|k| entry(i, k)).collect();
            let inverse = inverse((0..free.len()).map(row).collect())?;
            let mut is_found = true;
            for (i, row) in inverse.iter().enumerate() {
                let step = dot(row, &rest);
                found[i] += step;
                is_found &= step.abs() <= accuracy * scales[own(i).state].max(found[i].abs());
            }
            if is_found {
                for (i, compression) in found.iter().enumerate() {
                    let own = own(i);
                    input[own.input][i % POINTS] = own.contact.force_at(*compression);
                }
                return Some(());
            }
        }
        None
    }
}
