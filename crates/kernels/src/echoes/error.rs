//! Why echoes cannot be described or summed.

/// Why echoes cannot be described or summed.
#[expect(missing_docs, reason = "the messages say it")]
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum EchoError {
    #[error("a number is not finite; give finite doubles")]
    NotFinite,
    #[error("the period is not positive; echoes need time to return")]
    PeriodNotPositive,
    #[error("a number is beyond 2^200 or below 2^-200; choose other units")]
    BeyondRange,
    #[error("the lag {lag} is too large; lags reach to {}", super::LARGEST_LAG)]
    LagTooLarge { lag: isize },
    #[error("echo {last} is too late; a sum reaches to echo {}", super::LARGEST_ECHO)]
    TooManyEchoes { last: usize },
    #[error(
        "more echoes have arrived than the sum holds; it ends with echo {last}, build it for a \
         later one"
    )]
    BeyondLast { last: usize },
    #[error("a time is too late for its rate; rate and scale times it reach to 2^40")]
    TimeTooLarge,
    #[error("{times} times but room for {values} values; give as many of both")]
    LengthsDiffer { times: usize, values: usize },
}
