//! Why echoes cannot be described or summed.

use std::fmt;

/// Why echoes cannot be described or summed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum EchoError {
    /// A number is infinite or not a number.
    NotFinite,
    /// The period is not positive.
    PeriodNotPositive,
    /// A rate, scale, ratio, period or coefficient is beyond `2^±200`.
    BeyondRange,
    /// A lag is beyond 1024.
    LagTooLarge {
        /// The lag.
        lag: isize,
    },
    /// More echoes were asked for than 2²⁰.
    TooManyEchoes {
        /// The last echo asked for.
        last: usize,
    },
    /// More echoes have arrived at a time than the sum holds.
    BeyondLast {
        /// The last echo that the sum holds.
        last: usize,
    },
    /// A time is so late that `|b| x` or `|c| x` passes `2^40`.
    TimeTooLarge,
    /// Times and values differ in number.
    LengthsDiffer {
        /// How many times were given.
        times: usize,
        /// How many values were asked for.
        values: usize,
    },
}

impl fmt::Display for EchoError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EchoError::NotFinite => write!(f, "a number is not finite; give finite doubles"),
            EchoError::PeriodNotPositive => {
                write!(f, "the period is not positive; echoes need time to return")
            }
            EchoError::BeyondRange => {
                write!(f, "a number is beyond 2^200 or below 2^-200; choose other units")
            }
            EchoError::LagTooLarge { lag } => {
                write!(f, "the lag {lag} is too large; lags reach to {}", super::LARGEST_LAG)
            }
            EchoError::TooManyEchoes { last } => {
                let most = super::LARGEST_ECHO;
                write!(f, "echo {last} is too late; a sum reaches to echo {most}")
            }
            EchoError::BeyondLast { last } => write!(
                f,
                "more echoes have arrived than the sum holds; it ends with echo {last}, build it \
                 for a later one"
            ),
            EchoError::TimeTooLarge => {
                write!(f, "a time is too late for its rate; rate and scale times it reach to 2^40")
            }
            EchoError::LengthsDiffer { times, values } => {
                write!(f, "{times} times but room for {values} values; give as many of both")
            }
        }
    }
}

impl std::error::Error for EchoError {}
