//! The equation on pieces: how a period is cut, and the constants of one piece.

use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};

use super::equation::DelayEquation;
use super::error::FixedError;
use super::multiplier::{Fraction, Multiplier};
use super::value::FRACTION_BITS;

/// The most terms of a piece.
pub(super) const MOST_TERMS: u32 = 64;
/// The most that the sizes of the coefficients of a piece may add up to, in units: 64.
///
/// `(m + 1) |w_{m+1}| ≤ 64 · 2 · 2^118 = 2^125` then fits, and two products with it.
pub(super) const LARGEST_SUM: u128 = 1 << (FRACTION_BITS + 6);
/// The fewest pieces of a period: so many are worked on at once.
pub(super) const FEWEST_PIECES: u32 = 4;
/// The most pieces of a period.
const MOST_PIECES: u32 = 1 << 20;
/// The most coefficients of a march.
const MOST_NUMBERS: u64 = 1 << 26;
/// The largest multiple `|k|` in `G = kB` that is exact.
const MOST_MULTIPLE: i64 = 4;
/// The largest chirp `n|A + B|h` of a piece. Half of it costs twice the pieces with fewer terms; a
/// larger one makes coefficients that cancel.
const LARGEST_CHIRP: f64 = 25.0;
/// The same where doubles alone are asked for, which need less of the bound. For the rigid mass sums
/// leave their range from 35 on.
const LARGEST_CHIRP_FOR_DOUBLES: f64 = 30.0;
/// Terms are dropped below about this size, `2^−116`.
const SMALLEST_TERM_LOGARITHM: f64 = -80.5;

/// How a march cuts its periods. What is left open is chosen from the equation and the count of
/// periods; the choice affects cost and bound, never the truth of the bound.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct MarchOptions {
    /// Pieces of a period: a power of two from 4 to `2^20`.
    pub pieces: Option<u32>,
    /// Terms of a piece, at most: 2 to 64.
    pub terms: Option<u32>,
}

/// The factor `G = ρ(A + B)` of the forcing, as it is multiplied with.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Forcing {
    /// `G = kB` with a small integer k: one product serves both.
    Multiple(i128),
    /// The multiplier next to `hG`.
    Separate(Multiplier),
}

/// The reflection ρ, as it is multiplied with.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Reflection {
    /// 1, which needs no rounding.
    One,
    /// −1, which needs none either.
    MinusOne,
    /// The multiplier next to a smaller one.
    Factor(Multiplier),
}

impl Reflection {
    /// `ρ·value`, off by at most [`slack`](Self::slack) units.
    #[inline(always)]
    pub(super) fn times(self, value: i128) -> i128 {
        match self {
            Reflection::One => value,
            Reflection::MinusOne => -value,
            Reflection::Factor(factor) => factor.times(value),
        }
    }

    /// The most units by which a product is off.
    pub(super) fn slack(self) -> u128 {
        match self {
            Reflection::One | Reflection::MinusOne => 0,
            Reflection::Factor(_) => 1,
        }
    }
}

/// The constants of a march: with pieces of half width `h = 1/(2S)` in parts of a period and
/// `u ∈ [−1, 1]` on each, `dv/du + hB v = −hG y₋`, where `y₋` is the period before and
/// `v = y − ρ y₋`.
///
/// # Invariants
/// - `pieces` is a power of two from 4 to `2^20`, `terms` is from 2 to 64.
/// - `hB ≤ 1/2` and `|hG| ≤ 1/2`; the multipliers are off by at most `2^−128`. A multiple is at
///   most 4 in size.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Scheme {
    pub(super) pieces: u32,
    pub(super) terms: u32,
    pub(super) decay: Fraction,
    pub(super) forcing: Forcing,
    pub(super) reflection: Reflection,
}

impl Scheme {
    /// The constants of an equation for a count of periods.
    pub(super) fn new(
        equation: &DelayEquation,
        periods: u32,
        options: &MarchOptions,
    ) -> Result<Self, FixedError> {
        Scheme::within(equation, periods, options, LARGEST_CHIRP)
    }

    /// The same with longer pieces, where doubles alone are asked for: half as many of them cost about
    /// two thirds and double the bound.
    pub(super) fn for_doubles(equation: &DelayEquation, periods: u32) -> Result<Self, FixedError> {
        Scheme::within(equation, periods, &MarchOptions::default(), LARGEST_CHIRP_FOR_DOUBLES)
    }

    /// The constants with at most such a chirp of a piece, where the count of pieces is not given.
    fn within(
        equation: &DelayEquation,
        periods: u32,
        options: &MarchOptions,
        largest: f64,
    ) -> Result<Self, FixedError> {
        if periods == 0 {
            return Err(FixedError::NoPeriods);
        }
        let (decay, forcing) = (equation.decay(), equation.forcing());
        let chirp = f64::from(periods) * equation.chirp().abs().to_f64().unwrap_or(f64::INFINITY);
        let pieces = match options.pieces {
            Some(pieces) if is_piece_count(pieces) => pieces,
            Some(pieces) => return Err(FixedError::InvalidPieces(pieces)),
            None => choose_pieces(&decay, &forcing, chirp, largest).ok_or(FixedError::TooLarge)?,
        };
        let terms = match options.terms {
            Some(terms) if (2..=MOST_TERMS).contains(&terms) => terms,
            Some(terms) => return Err(FixedError::InvalidTerms(terms)),
            None => choose_terms(chirp / f64::from(2 * pieces)),
        };
        if u64::from(periods) * u64::from(pieces) * u64::from(terms) > MOST_NUMBERS {
            return Err(FixedError::TooLarge);
        }
        let half_width = BigRational::new(1.into(), (2 * pieces).into());
        if !fits(&decay, &forcing, pieces) {
            return Err(FixedError::TooFewPieces(pieces));
        }
        let near = |value: &BigRational| {
            Multiplier::near(&(value * &half_width)).ok_or(FixedError::TooFewPieces(pieces))
        };
        let multiple = &forcing / &decay;
        let small = |value: i64| value.abs() <= MOST_MULTIPLE;
        let reflection = &equation.reflection;
        Ok(Self {
            pieces,
            terms,
            decay: near(&decay)?.size,
            forcing: match multiple.to_integer().to_i64() {
                Some(value) if multiple.is_integer() && small(value) => {
                    Forcing::Multiple(i128::from(value))
                }
                _ => Forcing::Separate(near(&forcing)?),
            },
            reflection: match Multiplier::near(reflection) {
                Some(factor) => Reflection::Factor(factor),
                None if reflection.is_negative() => Reflection::MinusOne,
                None => Reflection::One,
            },
        })
    }

    /// The count of coefficients of a period.
    pub(super) fn size(&self) -> usize {
        self.pieces as usize * self.terms as usize
    }
}

/// Whether a period can be cut into so many pieces.
fn is_piece_count(pieces: u32) -> bool {
    pieces.is_power_of_two() && (FEWEST_PIECES..=MOST_PIECES).contains(&pieces)
}

/// Whether `hB ≤ 1/2` and `|hG| ≤ 1/2`.
fn fits(decay: &BigRational, forcing: &BigRational, pieces: u32) -> bool {
    let pieces = BigRational::from(num_bigint::BigInt::from(pieces));
    *decay <= pieces && forcing.abs() <= pieces
}

/// The smallest count of pieces that the constants allow and with which none has more than the
/// largest chirp.
fn choose_pieces(
    decay: &BigRational,
    forcing: &BigRational,
    chirp: f64,
    largest: f64,
) -> Option<u32> {
    std::iter::successors(Some(FEWEST_PIECES), |pieces| Some(pieces * 2))
        .take_while(|&pieces| is_piece_count(pieces))
        .find(|&pieces| fits(decay, forcing, pieces) && chirp / f64::from(2 * pieces) <= largest)
}

/// The least M with `z^M/M!² ≤ 2^−116`, `z = n|A + B|h` the chirp of a piece and at least 4.
///
/// The n-th echo behaves as `J₀(2√(n(A + B)x))`, whose Taylor coefficients about any centre are, in
/// units of the half width, at most `z^m/m!²`; the exponential factors are smaller.
fn choose_terms(chirp: f64) -> u32 {
    let logarithm = chirp.max(4.0).ln();
    let mut size = 0.0;
    (1..MOST_TERMS)
        .find(|&terms| {
            size += logarithm - 2.0 * f64::from(terms).ln();
            size <= SMALLEST_TERM_LOGARITHM
        })
        .unwrap_or(MOST_TERMS)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rational(numerator: i64, denominator: i64) -> BigRational {
        BigRational::new(numerator.into(), denominator.into())
    }

    #[test]
    fn constants_follow_the_equation() {
        let [one, two] = [rational(1, 1), rational(2, 1)];
        let equation = DelayEquation::new(&two, &one, &one, &one).unwrap();
        let scheme = Scheme::new(&equation, 200, &MarchOptions::default()).unwrap();
        assert_eq!(scheme.forcing, Forcing::Multiple(2));
        assert_eq!(scheme.reflection, Reflection::One);
        assert_eq!(scheme.decay.0, (1 << 127) / u128::from(scheme.pieces) * 2);
        let skew = DelayEquation::new(&two, &one, &rational(-1, 3), &rational(-1, 2)).unwrap();
        let scheme = Scheme::new(&skew, 10, &MarchOptions::default()).unwrap();
        assert!(matches!(scheme.forcing, Forcing::Separate(_)));
        assert_eq!(scheme.reflection.slack(), 1);
        assert_eq!(scheme.reflection.times(-6), 3);
    }

    /// 201 periods of the rigid mass, μ = 1: a chirp of 804, that is 25.1 on 16 pieces.
    #[test]
    fn doubles_allow_longer_pieces() {
        let [one, two] = [rational(1, 1), rational(2, 1)];
        let equation = DelayEquation::new(&two, &one, &one, &one).unwrap();
        let pieces = |scheme: Result<Scheme, FixedError>| scheme.unwrap().pieces;
        let options = MarchOptions::default();
        assert_eq!(pieces(Scheme::new(&equation, 201, &options)), 32);
        assert_eq!(pieces(Scheme::for_doubles(&equation, 201)), 16);
        assert_eq!(pieces(Scheme::for_doubles(&equation, 241)), 32);
    }

    #[test]
    fn long_pieces_are_refused() {
        // B = 20 with G = 40 and with G = 0; B = 1 with G = 20; the last one fits.
        for (period, zero, refused) in
            [(20, 1, true), (20, -1, true), (1, 19, true), (16, -1, false)]
        {
            let [period, zero, one] = [period, zero, 1].map(|value| rational(value, 1));
            let equation = DelayEquation::new(&period, &one, &zero, &one).unwrap();
            let few = MarchOptions { pieces: Some(16), terms: None };
            let scheme = Scheme::new(&equation, 10, &few);
            assert_eq!(scheme.err(), refused.then_some(FixedError::TooFewPieces(16)));
        }
    }
}
