//! Readings: the few things that every solver knows of a motion, and of which measures are made.
//!
//! Echoes, the method of steps and the cheaper models each say what a reading is in their own terms. What an
//! element holds, and the force that it passes on, are sums of readings here, for all of them.

use crate::expression::Fraction;
use crate::network::layout::Layout;
use crate::network::model::Model;
use crate::network::node::{ElementLaw, Lumped, Node};
use crate::scene::{ElementIndex, Mistake};
use wavestep_polynomial::Rational;

/// What is read in a section of a bar: with the waves `w₊` and `w₋` that pass there, and the impedance `Z`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Field {
    /// `w₊ + w₋`
    Velocity,
    /// Its integral since the start.
    Displacement,
    /// `Z (w₊ − w₋)`, which compresses.
    Force,
}

/// A section of a bar.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Section<V = Fraction> {
    /// The bar, by its place among those of the line.
    pub bar: usize,
    /// How long ago the wave to the right and the wave to the left entered the bar; none for a wave from
    /// the far side of an endless bar, which never changes.
    pub delays: [Option<V>; 2],
}

/// A lumped element, by its node and its place there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Lump {
    pub node: usize,
    pub place: usize,
}

/// One of the two sides of a lumped element. Those of a spring move apart; those of a mass, a support or
/// a load are one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Face {
    Left(Lump),
    Right(Lump),
}

/// What measures are made of.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Reading<V = Fraction> {
    InBar(Field, Section<V>),
    /// The momentum of a bar: `Z ∫ (w₊ + w₋) dt` over the last travel time, of an endless bar since the
    /// start.
    Momentum(usize),
    /// The velocity beside a lumped element.
    Velocity(Face),
    /// Its integral since the start.
    Displacement(Face),
    /// By how much a spring or a local contact is shortened, or a support displaced, since the start.
    Compression(Lump),
    /// The force in a spring or a local contact, or that of the line on a support.
    Force(Lump),
}

/// A coefficient times a reading.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Term<V = Fraction> {
    pub coefficient: V,
    pub of: Reading<V>,
}

/// A part of an energy.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Energy {
    /// A coefficient times the square of a reading.
    Square(Box<Term>),
    /// This share of the force of a local contact times its compression.
    Work(Fraction, Lump),
    /// The energy of a bar: `Z ∫ (w₊² + w₋²) dt`, over the same time as its momentum.
    InBar(usize),
}

impl<V> Reading<V> {
    /// Whether it is an integral of waves over time.
    pub fn is_integral(&self) -> bool {
        matches!(self, Reading::InBar(Field::Displacement, _) | Reading::Momentum(_))
    }

    /// How long before the waves that it reads in a section entered the bar.
    pub fn delays(&self) -> impl Iterator<Item = &V> {
        let section = match self {
            Reading::InBar(_, section) => Some(section),
            _ => None,
        };
        section.into_iter().flat_map(|section| section.delays.iter().flatten())
    }
}

impl<V> Section<V> {
    /// How far it is from the left end, or from the one end of an endless bar, in time of a wave.
    pub fn distance(&self) -> &V {
        let [right, left] = &self.delays;
        right.as_ref().or(left.as_ref()).expect("a bar has an end")
    }

    /// Whether it is the left (0) or the right (1) end of the bar.
    pub fn end(&self, is_zero: impl Fn(&V) -> bool) -> Option<usize> {
        self.delays.iter().position(|delay| delay.as_ref().is_some_and(&is_zero))
    }
}

impl Face {
    pub fn lump(self) -> Lump {
        match self {
            Face::Left(lump) | Face::Right(lump) => lump,
        }
    }
}

impl<V> Node<V> {
    /// The run beside a lumped element.
    pub fn run_beside(&self, face: Face) -> usize {
        let Lumped { run, law, .. } = &self.elements[face.lump().place];
        run + usize::from(law.is_link() && matches!(face, Face::Right(_)))
    }
}

impl Term {
    pub fn one(of: Reading) -> Term {
        Term { coefficient: Fraction::one(), of }
    }

    /// The same with other numbers.
    pub fn map<V, E>(&self, convert: impl Fn(&Fraction) -> Result<V, E>) -> Result<Term<V>, E> {
        let of = match &self.of {
            Reading::InBar(field, Section { bar, delays: [right, left] }) => {
                let delay = |delay: &Option<Fraction>| delay.as_ref().map(&convert).transpose();
                let delays = [delay(right)?, delay(left)?];
                Reading::InBar(*field, Section { bar: *bar, delays })
            }
            Reading::Momentum(bar) => Reading::Momentum(*bar),
            Reading::Velocity(face) => Reading::Velocity(*face),
            Reading::Displacement(face) => Reading::Displacement(*face),
            Reading::Compression(lump) => Reading::Compression(*lump),
            Reading::Force(lump) => Reading::Force(*lump),
        };
        Ok(Term { coefficient: convert(&self.coefficient)?, of })
    }
}

/// The section of a bar that a wave reaches after a time from its left end, or from the one end of an
/// endless bar.
pub fn section(layout: &Layout, model: &Model, bar: usize, time: Fraction) -> Section {
    let delays = match &model.bars[&layout.bars[bar]].travel {
        Some(travel) => {
            let rest = travel - &time;
            [Some(time), Some(rest)]
        }
        None => layout.ends[bar].map(|end| end.map(|_| time.clone())),
    };
    Section { bar, delays }
}

/// The elements of a scene, with what they hold.
#[derive(Clone, Copy)]
pub struct Elements<'a> {
    pub model: &'a Model,
    pub layout: &'a Layout,
}

impl Elements<'_> {
    /// Where a lumped element stands.
    pub fn lump(&self, element: ElementIndex) -> Result<Lump, Mistake> {
        let node = self.layout.node_of(element).ok_or(Mistake::NotMeasurable)?;
        let place = self.layout.nodes[node].place(element).ok_or(Mistake::NotMeasurable)?;
        Ok(Lump { node, place })
    }

    fn law(&self, lump: Lump) -> &ElementLaw<Fraction> {
        &self.layout.nodes[lump.node].elements[lump.place].law
    }

    /// The place of a bar that holds no infinite energy or momentum.
    fn bar(&self, bar: usize) -> Result<usize, Mistake> {
        let data = &self.model.bars[&self.layout.bars[bar]];
        let at_rest = data.velocity.is_zero() && data.force.is_zero();
        if data.travel.is_some() || at_rest { Ok(bar) } else { Err(Mistake::Infinite) }
    }

    /// By how much an element is shortened. A damper alone has no spring that remembers: what its ends have
    /// moved tells.
    pub fn compression(&self, element: ElementIndex) -> Result<Vec<Term>, Mistake> {
        let lump = self.lump(element)?;
        Ok(match self.law(lump) {
            ElementLaw::Spring { stiffness, .. } if stiffness.is_zero() => {
                let right = Reading::Displacement(Face::Right(lump));
                vec![
                    Term::one(Reading::Displacement(Face::Left(lump))),
                    Term { coefficient: -&Fraction::one(), of: right },
                ]
            }
            _ => vec![Term::one(Reading::Compression(lump))],
        })
    }

    /// The force of a spring or a support, `k α + d α'`; none for a local contact, which is not linear.
    pub fn force(&self, lump: Lump) -> Option<Vec<Term>> {
        let law = self.law(lump);
        let [stiffness, damping] = law.resistance()?;
        let mut terms = vec![
            Term { coefficient: stiffness.clone(), of: Reading::Compression(lump) },
            Term { coefficient: damping.clone(), of: Reading::Velocity(Face::Left(lump)) },
        ];
        if law.is_link() {
            terms.push(Term { coefficient: -damping, of: Reading::Velocity(Face::Right(lump)) });
        }
        terms.retain(|term| !term.coefficient.is_zero());
        Some(terms)
    }

    /// The momentum of an element: that of a mass or a bar; others have none.
    pub fn momentum(&self, element: ElementIndex) -> Result<Vec<Term>, Mistake> {
        if let Some(bar) = self.layout.bar(element) {
            return Ok(vec![Term::one(Reading::Momentum(self.bar(bar)?))]);
        }
        let lump = self.lump(element)?;
        Ok(match self.law(lump) {
            ElementLaw::Mass { mass, .. } => {
                let of = Reading::Velocity(Face::Left(lump));
                vec![Term { coefficient: mass.clone(), of }]
            }
            _ => Vec::new(),
        })
    }

    /// The energy of an element: `m v²/2`, `k α²/2`, of a local contact `∫ X dα = X α/(m+1)`, or that of a bar.
    pub fn energy(&self, element: ElementIndex) -> Result<Vec<Energy>, Mistake> {
        if let Some(bar) = self.layout.bar(element) {
            return Ok(vec![Energy::InBar(self.bar(bar)?)]);
        }
        let lump = self.lump(element)?;
        let square = |value: &Fraction, of| {
            let coefficient = value.scale(&Rational::new(1.into(), 2.into()));
            vec![Energy::Square(Box::new(Term { coefficient, of }))]
        };
        let law = self.law(lump);
        Ok(match (law, law.resistance()) {
            (ElementLaw::Mass { mass, .. }, _) => square(mass, Reading::Velocity(Face::Left(lump))),
            (_, Some([stiffness, _])) if !stiffness.is_zero() => {
                square(stiffness, Reading::Compression(lump))
            }
            (ElementLaw::LocalContact { exponent, .. }, _) => {
                let share = (exponent + Rational::from_integer(1.into())).recip();
                vec![Energy::Work(Fraction::constant(&share), lump)]
            }
            _ => Vec::new(),
        })
    }
}
