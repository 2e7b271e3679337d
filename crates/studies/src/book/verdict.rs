//! What was found about an equation, and how it is known.

use crate::book::entry::Equation;
use num_traits::Zero as _;
use std::fmt;
use thiserror::Error;
use wavestep::ball::Ball;
use wavestep_polynomial::Rational;

/// Significant digits of witnesses.
const DIGITS: usize = 12;

/// How an equation is known to hold.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
pub enum Ground {
    #[error("both sides are the same expression in normal form")]
    SameExpression,
    #[error(
        "the difference of both sides is a combination of the equations of the scene, for every n; both \
         sides are the same expression on the first periods"
    )]
    EveryPeriod,
    #[error(
        "both sides are the same sum of powers for every n; both sides are the same expression on the \
         first periods"
    )]
    EveryPower,
    #[error("this is what the scene makes continuous, for every n, and its start")]
    Continuity,
    /// For every n there is no proof.
    #[error("both sides are the same expression on the periods 0 to {0}")]
    PeriodsThrough(usize),
}

/// Values of both sides of an equation that differ, with proof.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Witness {
    /// On which period, where the equation is about all of them.
    pub period: Option<usize>,
    pub at: Vec<(String, Rational)>,
    pub left: Ball,
    pub right: Ball,
}

impl Witness {
    /// Whether the two enclosures have no number in common.
    pub fn is_certain(&self) -> bool {
        !self.left.subtract(&self.right, 64).contains(&Rational::zero())
    }
}

impl fmt::Display for Witness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = |ball: &Ball| ball.to_decimal(DIGITS).midpoint().to_string();
        write!(f, "{} against {}", digits(&self.left), digits(&self.right))?;
        if let Some(n) = self.period {
            write!(f, " on period {n}")?;
        }
        for (i, (name, value)) in self.at.iter().enumerate() {
            write!(f, "{} {name} = {value}", if i == 0 { " at" } else { "," })?;
        }
        Ok(())
    }
}

/// Whether an equation holds.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Finding {
    Holds(Ground),
    Fails(Box<Witness>),
}

impl Finding {
    pub fn holds(&self) -> bool {
        matches!(self, Finding::Holds(_))
    }
}

#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum Verdict {
    /// Equal to what is derived, with the ground for each of its equations.
    #[error("proved")]
    Proved(Vec<Ground>),
    /// As read it differs from what is derived: the first equation that fails, and a witness.
    #[error("refuted as read")]
    Refuted(Box<(Equation, Witness)>),
    /// It can be read in more than one way: the readings, and what was found about each.
    #[error("reading unsure")]
    Unsure(Vec<(Equation, Finding)>),
    /// An estimate, with what was measured of its error.
    #[error("checked numerically: {0}")]
    Checked(String),
    /// Nothing is claimed.
    #[error("definition")]
    Definition,
}

impl Verdict {
    /// The verdicts in a word for programs, and as they are counted.
    pub(super) const KINDS: [(&'static str, &'static str); 5] = [
        ("proved", "proved"),
        ("refuted", "refuted as read"),
        ("unsure", "of unsure reading"),
        ("checked", "checked numerically"),
        ("definition", "definitions"),
    ];

    /// The place of a verdict among [`KINDS`](Self::KINDS).
    pub(super) fn kind(&self) -> usize {
        match self {
            Verdict::Proved(_) => 0,
            Verdict::Refuted(_) => 1,
            Verdict::Unsure(_) => 2,
            Verdict::Checked(_) => 3,
            Verdict::Definition => 4,
        }
    }
}
