//! Why a march, a position or a value is refused.

use std::fmt;

/// Why a march, a position or a value is refused.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum FixedError {
    /// The period D is not positive.
    PeriodNotPositive,
    /// The rate b is not positive.
    RateNotPositive,
    /// The reflection is not between −1 and 1.
    ReflectionTooLarge,
    /// The count of periods is zero.
    NoPeriods,
    /// The count of pieces asked for is no power of two from 4 to `2^20`.
    InvalidPieces(u32),
    /// The count of terms asked for is not from 2 to 64.
    InvalidTerms(u32),
    /// The pieces asked for are longer than the constants allow.
    TooFewPieces(u32),
    /// The coefficients would fill more memory than the limit of `2^26` numbers.
    TooLarge,
    /// The coefficients of a piece add up to more than fixed-point numbers hold.
    Overflow {
        /// The period in which they do.
        period: u32,
    },
    /// The error bound is of no use: residuals and mismatches add up to more than `2^−12`.
    NotProven {
        /// The first period without a bound.
        period: u32,
    },
    /// A position after the last period of the march.
    BeyondMarch {
        /// The period of the position.
        period: u32,
        /// How many periods the march has.
        periods: u32,
    },
    /// A position that is not between 0 and 1.
    PositionOutside,
    /// A time that is infinite or not a number.
    TimeNotFinite,
    /// A time more than `2^32 − 2` periods after the start.
    TimeTooLate,
    /// More taps than eight.
    TooManyTaps(usize),
}

impl fmt::Display for FixedError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FixedError::PeriodNotPositive => {
                f.write_str("the period is not positive; give a positive one")
            }
            FixedError::RateNotPositive => {
                f.write_str("the rate of the pole is not positive; give a positive one")
            }
            FixedError::ReflectionTooLarge => f.write_str(
                "the reflection is not between -1 and 1; larger ones are not supported here",
            ),
            FixedError::NoPeriods => f.write_str("a march has at least one period; ask for one"),
            FixedError::InvalidPieces(pieces) => {
                write!(f, "{pieces} pieces a period; give a power of two from 4 to 1048576")
            }
            FixedError::InvalidTerms(terms) => {
                write!(f, "{terms} terms a piece; give 2 to 64")
            }
            FixedError::TooFewPieces(pieces) => {
                write!(f, "{pieces} pieces a period are too few for these rates; give more")
            }
            FixedError::TooLarge => f.write_str(
                "the march would have more than 2^26 coefficients; ask for fewer periods",
            ),
            FixedError::Overflow { period } => write!(
                f,
                "the values of period {period} are too large for fixed-point numbers; ask for \
                 fewer periods or more pieces"
            ),
            FixedError::NotProven { period } => write!(
                f,
                "the error cannot be bounded in period {period}; give more pieces or more terms"
            ),
            FixedError::BeyondMarch { period, periods } => {
                write!(
                    f,
                    "period {period} is after the {periods} periods of the march; march further"
                )
            }
            FixedError::PositionOutside => {
                f.write_str("the position is not between 0 and 1; reduce it to its period first")
            }
            FixedError::TimeNotFinite => {
                f.write_str("a time is infinite or not a number; give finite times")
            }
            FixedError::TimeTooLate => {
                f.write_str("a time is too many periods after the start; give an earlier one")
            }
            FixedError::TooManyTaps(taps) => write!(f, "{taps} taps; give at most 8"),
        }
    }
}

impl std::error::Error for FixedError {}
