//! What was found about an equation, and how it is known.

use crate::book::entry::Equation;
use num_traits::Zero as _;
use std::fmt;
use wavestep::ball::Ball;
use wavestep_polynomial::Rational;

/// Significant digits of witnesses.
const DIGITS: usize = 12;

/// How an equation is known to hold.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Ground {
    /// Both sides are the same expression in normal form.
    SameExpression,
    /// The difference of both sides is a combination of the equations that the scene gives, on every
    /// period; the first periods are compared as well.
    EveryPeriod,
    /// Both sides are the same sum of powers in general n; the first periods are compared as well.
    EveryPower,
    /// It is the form that the scene makes continuous, and its start.
    Continuity,
    /// The pieces agree on the periods 0 … N; for every n there is no proof.
    PeriodsThrough(usize),
}

impl fmt::Display for Ground {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Ground::SameExpression => {
                f.write_str("both sides are the same expression in normal form")
            }
            Ground::EveryPeriod => f.write_str(
                "the difference of both sides is a combination of the equations of the scene, for \
                 every n; both sides are the same expression on the first periods",
            ),
            Ground::EveryPower => f.write_str(
                "both sides are the same sum of powers for every n; both sides are the same \
                 expression on the first periods",
            ),
            Ground::Continuity => {
                f.write_str("this is what the scene makes continuous, for every n, and its start")
            }
            Ground::PeriodsThrough(last) => {
                write!(f, "both sides are the same expression on the periods 0 to {last}")
            }
        }
    }
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

/// What is found about a numbered equation.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Verdict {
    /// Equal to what is derived, with the ground for each of its equations.
    Proved(Vec<Ground>),
    /// As read it differs from what is derived: the first equation that fails, and a witness.
    Refuted(Box<(Equation, Witness)>),
    /// It can be read in more than one way: the readings, and what was found about each.
    Unsure(Vec<(Equation, Finding)>),
    /// An estimate, with what was measured of its error.
    Checked(String),
    /// Nothing is claimed.
    Definition,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Verdict::Proved(_) => f.write_str("proved"),
            Verdict::Refuted(_) => f.write_str("refuted as read"),
            Verdict::Unsure(_) => f.write_str("reading unsure"),
            Verdict::Checked(bound) => write!(f, "checked numerically: {bound}"),
            Verdict::Definition => f.write_str("definition"),
        }
    }
}
