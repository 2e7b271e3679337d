//! Names for rates that are no rational numbers.

use crate::enclosure::Numbers;
use crate::expression::{Assumptions, Condition, Constant, Definition, Fraction, Relation, Root};
use crate::recurrence::guess::approximate_roots;
use crate::recurrence::statement::Statement;
use std::cmp::Ordering;
use wavestep_polynomial::{Rational, Symbol};

/// The precision and the digits of a first guess.
const GUESS_BITS: u64 = 64;
const GUESS_DIGITS: usize = 17;

/// Into how many stretches a line is cut in search of a sign change.
const STRETCHES: i64 = 64;

/// The constants of a statement and those named since, with the assumptions on them.
pub(crate) struct Naming {
    pub numbers: Numbers,
    pub assumptions: Assumptions,
    /// Names that are taken besides those of symbols.
    taken: Vec<String>,
}

impl Naming {
    pub fn new(statement: &Statement) -> Naming {
        let times = [&statement.local, &statement.time].map(|symbol| symbol.name().to_owned());
        let taken = statement.waves.iter().cloned().chain(times).collect();
        let numbers = Numbers::new(&statement.constants);
        Naming { numbers, assumptions: statement.assumptions.clone(), taken }
    }

    /// `√square` as a named constant, times `i` where the square is negative; `None` where its sign
    /// is not known.
    pub fn square_root(&mut self, square: &Fraction) -> Option<Fraction> {
        let order = self.sign(square)?;
        let (size, factor) = match order {
            Ordering::Greater => (square.clone(), Fraction::one()),
            Ordering::Less => {
                let i = Symbol::square_root(-1).expect("the imaginary unit");
                (-square, Fraction::symbol(&i))
            }
            Ordering::Equal => return Some(Fraction::zero()),
        };
        let root = self.name("omega", Root::of(size.clone()).into(), Relation::Greater);
        self.assumptions.declare_square(root.clone(), size);
        Some(&Fraction::symbol(&root) * &factor)
    }

    /// A real zero of a polynomial, coefficients from the highest power down, as a named constant;
    /// `None` where no change of sign is found.
    pub fn real_zero(&mut self, polynomial: &[Fraction]) -> Option<Fraction> {
        let bound = self.bound(polynomial)?;
        let at = |k: i64| &bound * Rational::new(k.into(), STRETCHES.into());
        let value = |x: &Rational| {
            let x = Fraction::constant(x);
            polynomial.iter().fold(Fraction::zero(), |sum, c| &(&sum * &x) + c)
        };
        let mut before: Option<(Rational, Ordering)> = None;
        for k in -STRETCHES..=STRETCHES {
            let x = at(k);
            let sign = self.sign(&value(&x))?;
            if sign == Ordering::Equal {
                return Some(Fraction::constant(&x));
            }
            if let Some((lower, other)) = before
                && other != sign
            {
                let positive = x > Rational::default();
                let relation = if positive { Relation::Greater } else { Relation::Less };
                let polynomial = polynomial.to_vec();
                let zero = Definition::Zero { polynomial, between: [lower, x] };
                return Some(Fraction::symbol(&self.name("rho", zero, relation)));
            }
            before = Some((x, sign));
        }
        None
    }

    /// The parts `σ, ω` of a pair of complex zeros `σ ± iω` of a polynomial as named constants; `None`
    /// where there is no symbol-free one.
    pub fn complex_zero(&mut self, polynomial: &[Fraction]) -> Option<(Fraction, Fraction)> {
        let numbers = &self.numbers;
        let decimal = |c: &Fraction| {
            let ball = numbers.enclose(c, GUESS_BITS).ok()?;
            Some(ball.to_decimal(GUESS_DIGITS).midpoint().to_rational())
        };
        let coefficients: Vec<Rational> = polynomial.iter().map(decimal).collect::<Option<_>>()?;
        let guesses = approximate_roots(&coefficients)?;
        let (re, im) = guesses.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let near = (Rational::from_float(re)?, Rational::from_float(im)?);
        let part = |imaginary| Definition::ComplexZero {
            polynomial: polynomial.to_vec(),
            near: near.clone(),
            imaginary,
        };
        let (sigma, omega) = (part(false), part(true));
        let positive = |definition: &Definition| {
            let ball = numbers.enclose_definition(definition, GUESS_BITS).ok()?;
            (ball.sign() == Some(Ordering::Greater)).then_some(())
        };
        positive(&omega)?;
        let growing = positive(&sigma).is_none();
        let sigma =
            self.name("sigma", sigma, if growing { Relation::Unequal } else { Relation::Greater });
        let omega = self.name("omega", omega, Relation::Greater);
        Some((Fraction::symbol(&sigma), Fraction::symbol(&omega)))
    }

    /// All zeros are smaller in size than this number: `1 + max |c_i|`, for a monic polynomial.
    fn bound(&self, polynomial: &[Fraction]) -> Option<Rational> {
        let mut bound = Rational::from_integer(1.into());
        loop {
            let limit = Fraction::constant(&bound);
            let mut within = true;
            for c in polynomial {
                within &= self.sign(&(&limit - c))? == Ordering::Greater
                    && self.sign(&(&limit + c))? == Ordering::Greater;
            }
            if within {
                return Some(&bound + Rational::from_integer(1.into()));
            }
            bound *= Rational::from_integer(2.into());
        }
    }

    fn sign(&self, value: &Fraction) -> Option<Ordering> {
        self.numbers.compare(value, &Fraction::zero()).ok()
    }

    fn name(&mut self, name: &str, value: Definition, relation: Relation) -> Symbol {
        if let Some(known) = self.numbers.constants().iter().find(|known| known.value == value) {
            return known.symbol.clone();
        }
        let taken = |name: &str| {
            self.taken.iter().any(|other| other == name)
                || self.assumptions.symbols().any(|(symbol, _)| symbol.name() == name)
        };
        let numbered = (2..).map(|k| format!("{name}_{k}"));
        let mut names = std::iter::once(name.to_owned()).chain(numbered);
        let free = names.find(|name| !taken(name)).expect("there is always another number");
        let symbol = Symbol::new(&free).expect("a name with letters in front");
        let condition = Condition { relation, bound: Rational::default() };
        self.assumptions.declare_symbol(symbol.clone(), Some(condition));
        self.numbers.add(Constant { symbol: symbol.clone(), value });
        if let Some((lower, upper)) = self.numbers.bounds(&symbol) {
            self.assumptions.declare_bounds(symbol.clone(), lower, upper);
        }
        symbol
    }
}
