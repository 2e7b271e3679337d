//! Why a march, a position or a value is refused.

/// Why a march, a position or a value is refused.
#[expect(missing_docs, reason = "the messages say it")]
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FixedError {
    #[error("the period is not positive; give a positive one")]
    PeriodNotPositive,
    #[error("the rate of the pole is not positive; give a positive one")]
    RateNotPositive,
    #[error("the reflection is not between -1 and 1; larger ones are not supported here")]
    ReflectionTooLarge,
    #[error("a march has at least one period; ask for one")]
    NoPeriods,
    #[error("{0} pieces a period; give a power of two from 4 to 1048576")]
    InvalidPieces(u32),
    #[error("{0} terms a piece; give 2 to 64")]
    InvalidTerms(u32),
    #[error("{0} pieces a period are too few for these rates; give more")]
    TooFewPieces(u32),
    #[error("the march would have more than 2^26 coefficients; ask for fewer periods")]
    TooLarge,
    #[error(
        "the values of period {period} are too large for fixed-point numbers; ask for fewer \
         periods or more pieces"
    )]
    Overflow { period: u32 },
    #[error("the error cannot be bounded in period {period}; give more pieces or more terms")]
    NotProven { period: u32 },
    #[error("period {period} is after the {periods} periods of the march; march further")]
    BeyondMarch { period: u32, periods: u32 },
    #[error("the position is not between 0 and 1; reduce it to its period first")]
    PositionOutside,
    #[error("a time is infinite or not a number; give finite times")]
    TimeNotFinite,
    #[error("a time is too many periods after the start; give an earlier one")]
    TimeTooLate,
    #[error("{0} taps; give at most 8")]
    TooManyTaps(usize),
}
