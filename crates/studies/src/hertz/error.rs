//! What can be wrong with a contact.

use wavestep::ball::BallError;
use wavestep::enclosure::EnclosureError;

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HertzError {
    /// The exponent m is above [`PowerLaw::MOST`](super::PowerLaw::MOST), or below the inverse of
    /// [`PowerLaw::LEAST_INVERSE`](super::PowerLaw::LEAST_INVERSE).
    #[error(
        "the exponent m of X = k α^m is {0}; it must be positive, from 1/10 to 100 (3/2 is Hertz's, 1 a \
         spring)"
    )]
    Exponent(String),
    /// A share of the largest force is not from 0 to below 1.
    #[error(
        "{0} of the largest force: a share must be from 0 to below 1, since the largest force is never \
         reached"
    )]
    Share(String),
    /// A time is negative.
    #[error("the time {0} is before the impact, at 0")]
    Time(String),
    /// A quantity that must be positive is not: its name, and its value.
    #[error("{0} is {1}; it must be positive")]
    NotPositive(&'static str, String),
    /// A Poisson ratio is not above −1 and at most 1/2.
    #[error("a Poisson ratio of {0}: it must be above -1 and at most 1/2, as 3/10 for steel")]
    Poisson(String),
    /// A scene has no contact that closed forms describe.
    #[error(transparent)]
    Scene(#[from] NoContact),
    /// A value of the scene is not known.
    #[error(transparent)]
    Enclosure(#[from] EnclosureError),
    /// An enclosure failed.
    #[error(transparent)]
    Ball(#[from] BallError),
}

/// Why closed forms of local contact do not describe a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NoContact {
    /// A recurrence.
    #[error("a recurrence has no contact; give a scene")]
    Recurrence,
    /// A scene without a local contact.
    #[error("the scene has no `hertz` element; put one between two bars")]
    NoElement,
    /// A local contact beside something else than two bars without strain.
    #[error(
        "closed forms need a bar without strain on both sides of the `hertz` element; use `eval`"
    )]
    NotBetweenBars,
}
