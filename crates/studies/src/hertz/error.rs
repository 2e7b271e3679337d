//! Errors of the closed forms of local contact.

use wavestep::ball::BallError;
use wavestep::enclosure::EnclosureError;

#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HertzError {
    #[error(
        "the exponent m of X = k α^m is {0}; it must be positive, from 1/10 to 100 (3/2 is Hertz's, 1 a \
         spring)"
    )]
    Exponent(String),
    #[error(
        "{0} of the largest force: a share must be from 0 to below 1, since the largest force is never \
         reached"
    )]
    Share(String),
    #[error("the time {0} is before the impact, at 0")]
    Time(String),
    #[error("{0} is {1}; it must be positive")]
    NotPositive(&'static str, String),
    #[error("a Poisson ratio of {0}: it must be above -1 and at most 1/2, as 3/10 for steel")]
    Poisson(String),
    #[error("a recurrence has no contact; give a scene")]
    Recurrence,
    #[error("the scene has no `hertz` element; put one between two bars")]
    NoElement,
    #[error(
        "closed forms need a bar without strain on both sides of the `hertz` element; use `eval`"
    )]
    NotBetweenBars,
    #[error(transparent)]
    Enclosure(#[from] EnclosureError),
    #[error(transparent)]
    Ball(#[from] BallError),
}
