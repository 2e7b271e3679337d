//! Why there is no march, or why it cannot go on.

/// Why there is no march, or why it cannot go on.
#[expect(missing_docs, reason = "the messages say it")]
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MarchError {
    #[error("a value or its radius is not finite: give a finite number")]
    ParameterNotFinite,
    #[error("the radius {radius} is below zero: give its absolute value")]
    NegativeRadius { radius: f64 },
    #[error("the rate of decay may be as small as {rate}: it has to be positive")]
    RateNotPositive { rate: f64 },
    #[error(
        "the options are out of range: give a positive threshold and a limit from 1 to 1048575"
    )]
    Options,
    #[error(
        "period {period} needs more than {limit} coefficients: raise the limit or stop earlier"
    )]
    TooManyCoefficients { period: usize, limit: usize },
    #[error("the wave outgrows the doubles on period {period}: stop earlier")]
    NotFinite { period: usize },
    #[error("there are no waves; give one step at least")]
    NoWaves,
    #[error("give exactly one step for wave {0}")]
    Steps(usize),
    #[error(
        "wave {wave} follows from wave {other} of the same period; put the step of that one \
         before it"
    )]
    NotYetKnown { wave: usize, other: usize },
    #[error("wave {0} is given by numbers that are too large; change the units")]
    WaveNotFinite(usize),
    #[error("a wave turns or grows so often in a period that more than {limit} spans were needed")]
    TooManySpans { limit: usize },
    #[error("period {period} needs more than {limit} coefficients; ask for an earlier time")]
    TooManyTerms { period: usize, limit: usize },
    #[error("waves of period {period} are too large for doubles")]
    Overflow { period: usize },
}
