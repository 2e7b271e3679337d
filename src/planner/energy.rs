//! Energies as signals: `Σ c q²` of masses and springs, `Σ c q p` of local contacts, `Σ c ∫ q² dt` of the waves in bars,
//! `Σ c ∫ q p dt` of what has passed a place.

use super::SignalError;
use super::together::Sources;
use crate::expression::{Fraction, Root};
use crate::network::{EnergySum, EnergyTerm, FlowTerm, Network, Squared, Window};
use crate::signal::{
    ClosedSignal, Combination, Constant, EvaluateError, Integral, Operation, Product, Scale, Signal,
};
use num_traits::{Signed as _, Zero as _};
use std::rc::Rc;
use wavestep_polynomial::Rational;

/// Bits with which it is told how far back an integral reaches.
const REACH_BITS: u64 = 64;

/// An energy of a scene, the sum of its terms, on a window of the user's time, of sources that are known until its end.
pub(super) fn of_sources<'a>(
    sources: &Sources<'a>,
    EnergySum { start, held: terms, passed }: &EnergySum,
    unit: &Root,
    [from, to]: [&Rational; 2],
) -> Result<Box<dyn Signal + 'a>, SignalError> {
    let network = sources.network;
    let scale = Scale::of(network);
    let reaches: Vec<Rational> =
        terms.iter().map(|term| reach_of(&scale, term, from)).collect::<Result<_, _>>()?;
    let seen = terms.iter().zip(&reaches);
    let squared = seen.map(|(term, from)| (&term.of, term.squared.clone(), [from, to]));
    let others = terms
        .iter()
        .filter_map(|term| Some((&term.of, Squared::Reading(term.times.clone()?), [from, to])));
    let mut squared = sources.signals(squared.chain(others))?;
    let mut others = squared.split_off(terms.len()).into_iter();
    let (mut operands, mut products): (Vec<Rc<dyn Signal + 'a>>, Vec<Product>) = Default::default();
    for ((term, of), reach) in terms.iter().zip(squared).zip(&reaches) {
        let (coefficient, place) = (term.coefficient.clone(), operands.len());
        let last = match &term.window {
            Window::Now => {
                operands.push(of);
                let other = term.times.as_ref().and_then(|_| others.next());
                let second = if other.is_some() { place + 1 } else { place };
                operands.extend(other);
                products.push(Product { coefficient, factors: vec![place, second] });
                continue;
            }
            Window::Last(travel) => Some(travel.clone()),
            Window::Always => None,
        };
        let one = Product { coefficient: Fraction::one(), factors: vec![0, 0] };
        let square = combination(&scale, vec![of], vec![one]);
        let square = Operation::new(&scale, square, one_root(), [reach, to]);
        let before = term.before.pow(2);
        let integral = Integral::new(&scale, Rc::new(square), last, before, [from, to]);
        operands.push(Rc::new(Operation::new(&scale, integral, one_root(), [from, to])));
        products.push(Product { coefficient, factors: vec![place] });
    }
    let held = operands.len();
    if !passed.is_empty() {
        let power = power(sources, passed, [&Rational::zero(), to])?;
        let work = Integral::new(&scale, Rc::new(power), None, Fraction::zero(), [from, to]);
        operands.push(Rc::new(Operation::new(&scale, work, one_root(), [from, to])));
    }
    if !start.is_zero() || operands.is_empty() {
        let start = Constant::new(&scale, start.clone());
        operands.push(Rc::new(Operation::new(&scale, start, one_root(), [from, to])));
    }
    let alone = |place| Product { coefficient: Fraction::one(), factors: vec![place] };
    products.extend((held..operands.len()).map(alone));
    let sum = combination(&scale, operands, products);
    Ok(Box::new(Operation::new(&scale, sum, unit.clone(), [from, to])))
}

fn one_root() -> Root {
    Root::from(Fraction::one())
}

fn combination<'a>(
    scale: &Rc<Scale<'a>>,
    operands: Vec<Rc<dyn Signal + 'a>>,
    products: Vec<Product>,
) -> Combination<'a> {
    Combination { scale: Rc::clone(scale), operands, products }
}

/// What flows in, or past a place, on a window.
pub(super) fn power<'a>(
    sources: &Sources<'a>,
    flow: &[FlowTerm],
    window: [&Rational; 2],
) -> Result<Operation<'a, Combination<'a>>, SignalError> {
    let scale = Scale::of(sources.network);
    let factors = flow.iter().flat_map(|term| &term.factors);
    let mut operands = sources.signals(
        factors.map(|(reading, waves)| (waves, Squared::Reading(reading.clone()), window)),
    )?;
    let mut places = 0..operands.len();
    let mut products = Vec::new();
    for FlowTerm { coefficient, factors, acts, course } in flow {
        let mut factors: Vec<usize> = places.by_ref().take(factors.len()).collect();
        // What is known to be zero before and after is a product with zero there.
        let acting = acts.as_ref().map(|acts| Constant::within(&scale, acts, window));
        if let Some(Ok(acting)) = acting {
            factors.push(operands.len());
            operands.push(Rc::new(Operation::new(&scale, acting, one_root(), window)));
        }
        if let Some(course) = course {
            factors.push(operands.len());
            operands.push(Rc::new(ClosedSignal::of_course(sources.network, course, window)?));
        }
        products.push(Product { coefficient: coefficient.clone(), factors });
    }
    let flow = combination(&scale, operands, products);
    Ok(Operation::new(&scale, flow, one_root(), window))
}

/// A time before which no term is asked for its quantity.
pub(super) fn reach(
    network: &Network,
    EnergySum { held: terms, passed, .. }: &EnergySum,
    from: &Rational,
) -> Result<Rational, EvaluateError> {
    if !passed.is_empty() {
        return Ok(Rational::zero());
    }
    let scale = Scale::of(network);
    let mut terms = terms.iter();
    terms.try_fold(from.clone(), |least, term| Ok(least.min(reach_of(&scale, term, from)?)))
}

/// The same of one term.
fn reach_of(
    scale: &Scale<'_>,
    term: &EnergyTerm,
    from: &Rational,
) -> Result<Rational, EvaluateError> {
    let reach = match &term.window {
        Window::Now => from.clone(),
        Window::Last(travel) => {
            from - Rational::from(&scale.time(travel, REACH_BITS)?.endpoints().1)
        }
        Window::Always => Rational::zero(),
    };
    Ok(if reach.is_negative() { Rational::zero() } else { reach })
}
