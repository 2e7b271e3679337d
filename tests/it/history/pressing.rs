//! One cell beside a pressed local contact: what is told of it holds for exact motions, or the cell is too long.

use num_traits::ToPrimitive as _;
use wavestep::ball::{Ball, Magnitude, Number};
use wavestep::enclosure::Numbers;
use wavestep::history::motion::Motion;
use wavestep::history::passivity::{Passivity, StateError};
use wavestep::history::pressing::TooLong;
use wavestep::history::series::{CellNorm, Series, Truncation};
use wavestep::language::{Source, read_scene};
use wavestep::network::{Contacts, Layout, Network, Node, System};
use wavestep_polynomial::Rational;

const BITS: u64 = 64;

fn ratio(top: i64, bottom: i64) -> Rational {
    Rational::new(top.into(), bottom.into())
}

fn power_of_two(exponent: i64) -> Rational {
    Rational::from(&Magnitude::power_of_two(exponent))
}

fn exact(value: &Rational) -> Number {
    Number::Exact(value.clone())
}

/// The node with the local contact of a line.
struct Contact {
    node: Node<Number>,
    system: System<Number>,
    passivity: Passivity,
    cut: Truncation,
}

impl Contact {
    /// The law is `X = α^m`, by its force at `2^scale`: the larger this is, the sooner series are cut off.
    fn new(line: &str, exponent: &Rational, scale: i64) -> Contact {
        let elements = [
            ("a", "bar a { impedance = 2, velocity = 1 }"),
            ("b", "bar b { impedance = 2 }"),
            ("m", "mass m { mass = 1, velocity = 1 }"),
        ];
        let used = |name: &str| line.split(' ').any(|own| own == name);
        let used = elements.iter().filter(|(name, _)| used(name));
        let text = format!(
            "scene \"A\"\n{}hertz tip {{ force = {}, compression = {}, exponent = {exponent} }}\nline {line}\n\
             observe x = compression(tip)",
            used.map(|(_, own)| format!("{own}\n")).collect::<String>(),
            power_of_two((exponent * ratio(scale, 1)).to_integer().try_into().unwrap()),
            power_of_two(scale),
        );
        let scene = read_scene(&Source::new("scene", text).unwrap(), &Default::default()).unwrap();
        let network = Network::new(&scene).unwrap();
        let layout = Layout::of(network.scene(), network.model(), Contacts::Links);
        let is_own = |node: &&Node<_>| node.local_contact(0).is_some();
        let numbers = Numbers::new(&[]);
        let node = layout.nodes.iter().find(is_own).unwrap();
        let node = node.map(|value| numbers.number(value, 2 * BITS)).unwrap();
        let system = System::of(&node, |_| true, 2 * BITS).unwrap();
        let passivity = Passivity::of(&node, &system).unwrap();
        let longest = Magnitude::power_of_two(2);
        let top = passivity.rate().top().unwrap_or(0).max(8);
        let cut = Truncation { longest, ..Truncation::new(BITS, top) };
        Contact { node, system, passivity, cut }
    }

    /// The motion from a state, where this wave arrives from the left, with the force in the contact.
    fn press(
        &self,
        state: &[Number],
        errors: &[StateError],
        (wave, length): (&Rational, &Rational),
    ) -> Result<(Motion, Series), TooLong> {
        let norm = CellNorm::new(Magnitude::from_rational(length), &self.cut);
        let wave = Series::constant(exact(wave));
        let mut input = vec![wave, Series::zero(), Series::zero()];
        let known = self.passivity.known(state, errors);
        let motion = self.system.solve(known, &mut input, (&norm, &self.cut))?;
        Ok((motion, input.pop().unwrap()))
    }
}

const BARS: &str = "endless - a - tip - b - endless";

/// `α' = 1 − α²` from a on: `(a + tanh t)/(1 + a tanh t)`.
fn between_bars(start: &Rational, time: &Rational) -> Ball {
    let (bits, one) = (1024, Ball::from_integer(&1.into()));
    let fallen = Ball::from_rational(&(time * ratio(-2, 1)), bits).exp(bits).unwrap();
    let sum = one.add(&fallen, bits).reciprocal(bits).unwrap();
    let tanh = one.subtract(&fallen, bits).multiply(&sum, bits);
    let below = one.add(&tanh.multiply_rational(start, bits), bits).reciprocal(bits).unwrap();
    Ball::from_rational(start, bits).add(&tanh, bits).multiply(&below, bits)
}

/// The sum of the first exact terms of the same motion, `(k+1) α_(k+1) = −Σ α_i α_(k−i)` beside the first.
fn first_terms(start: &Rational, count: usize, time: &Rational) -> Rational {
    let mut terms = vec![start.clone()];
    for k in 0..count - 1 {
        let square = (0..=k).fold(ratio(0, 1), |sum, i| sum + &terms[i] * &terms[k - i]);
        let driven = ratio(i64::from(k == 0), 1) - square;
        terms.push(driven / ratio(k as i64 + 1, 1));
    }
    terms.into_iter().rev().fold(ratio(0, 1), |sum, term| sum * time + term)
}

/// Whether a series may have this value at a time.
fn encloses(told: &Series, time: &Rational, value: &Ball, cut: &Truncation) -> bool {
    told.value(&exact(time), cut).ball(BITS).subtract(value, 4 * BITS).contains_zero()
}

/// From an exact state; where few terms do, what they leave out is seen.
#[test]
fn cells_hold_the_motion_of_two_bars_or_are_too_long() {
    for (start, scale) in
        [(ratio(1, 2), 0), (ratio(1, 2), 20), (ratio(5, 2), 20), (ratio(1, 8), 16)]
    {
        let contact = Contact::new(BARS, &ratio(2, 1), scale);
        let mut told = [0, 0];
        for length in (-10..3).map(power_of_two) {
            let state = [exact(&start)];
            let errors = contact.passivity.errors(&state);
            let (motion, force) = match contact.press(&state, &errors, (&ratio(1, 2), &length)) {
                Ok(found) => found,
                Err(TooLong(shorter)) => {
                    assert!(shorter < length, "{shorter} is no shorter than {length}");
                    told[1] += 1;
                    continue;
                }
            };
            told[0] += 1;
            for time in [&length * ratio(1, 3), length.clone()] {
                let there = between_bars(&start, &time);
                let square = there.multiply(&there, 4 * BITS);
                let told = format!("{start} {scale} at {time} of {length}");
                assert!(encloses(&motion.state[0], &time, &there, &contact.cut), "{told}");
                assert!(encloses(&force, &time, &square, &contact.cut), "{told}: force");
                // What so many terms leave out is in the rest, not hidden among roundings.
                let terms = first_terms(&start, motion.state[0].coefficients.len(), &time);
                let left = there.subtract(&Ball::from_rational(&terms, 1024), 1024).magnitude();
                assert!(left <= motion.state[0].rest, "{told}: {}", left.to_double());
            }
        }
        assert!(told[0] > 2 && told[1] > 0, "{told:?}");
    }
}

/// An error of the state is all there at the end of a short cell, in compression and force.
#[test]
fn errors_are_carried_through_a_cell() {
    let (contact, start) = (Contact::new(BARS, &ratio(2, 1), 0), ratio(1, 2));
    let off = power_of_two(-20);
    let state = [Number::Enclosed(Ball::between(&(&start - &off), &(&start + &off), BITS))];
    let errors = contact.passivity.errors(&state);
    let length = power_of_two(-8);
    let (motion, force) = contact.press(&state, &errors, (&ratio(1, 2), &length)).unwrap();
    let at = exact(&length);
    let (ended, _) =
        contact.system.ended(&contact.passivity, &motion, (&errors, &mut None), &at, &contact.cut);
    for start in [&start - &off, &start + &off] {
        let there = between_bars(&start, &length);
        let square = there.multiply(&there, 4 * BITS);
        assert!(encloses(&motion.state[0], &length, &there, &contact.cut));
        assert!(encloses(&force, &length, &square, &contact.cut));
        assert!(ended[0].ball(BITS).subtract(&there, 4 * BITS).contains_zero(), "{:?}", ended[0]);
    }
}

/// While its force is below the precision, a contact that begins counts as light: what it pushes is an error.
#[test]
fn what_a_light_contact_pushes_is_an_error() {
    let contact = Contact::new(BARS, &ratio(2, 1), 26);
    let (state, length) = ([Number::zero()], power_of_two(-8));
    let errors = contact.passivity.errors(&state);
    let (motion, force) = contact.press(&state, &errors, (&ratio(1, 2), &length)).unwrap();
    assert!(force.coefficients.is_empty(), "no light contact");
    let there = between_bars(&Rational::default(), &length);
    assert!(encloses(&motion.state[0], &length, &there, &contact.cut));
    assert!(encloses(&force, &length, &there.multiply(&there, 4 * BITS), &contact.cut));
}

/// A mass that a bar pulls away from a wall, `α' = v`, `v' = 4 w − 2 v − α^m`.
fn beside_a_wall(start: [f64; 2], wave: f64, time: f64) -> [f64; 2] {
    by_small_steps(start, time, |[v, a]| [4.0 * wave - 2.0 * v - a * a.sqrt(), v])
}

/// The same without the bar.
fn beside_a_wall_alone(start: [f64; 2], time: f64) -> [f64; 2] {
    by_small_steps(start, time, |[v, a]| [-a * a.sqrt(), v])
}

fn by_small_steps(
    [mut v, mut a]: [f64; 2],
    time: f64,
    slope: impl Fn([f64; 2]) -> [f64; 2],
) -> [f64; 2] {
    let steps = 4000;
    let h = time / f64::from(steps);
    for _ in 0..steps {
        let after = |by: f64, [dv, da]: [f64; 2]| slope([v + by * dv, a + by * da]);
        let k1 = slope([v, a]);
        let k2 = after(h / 2.0, k1);
        let k3 = after(h / 2.0, k2);
        let k4 = after(h, k3);
        let mean = |i: usize| h * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0;
        (v, a) = (v + mean(0), a + mean(1));
    }
    [v, a]
}

/// The acceleration alone brings the contact near its end: a disc of times is small enough only if all of the box
/// stays in it. And errors of such a state grow.
#[test]
fn cells_hold_the_motion_of_a_mass_or_are_too_long() {
    let contact = Contact::new("endless - a - m - tip - fixed", &ratio(3, 2), 0);
    let wave = -25.0;
    let mut told = [0, 0];
    for off in [0.0, 1.0 / 1024.0] {
        for length in (-9..-2).map(power_of_two) {
            let around = |middle: i64| match off == 0.0 {
                true => Number::integer(middle),
                false => Number::integer(middle).widened(&Magnitude::power_of_two(-10), BITS),
            };
            let state = [around(0), around(1)];
            let errors = contact.passivity.errors(&state);
            let moved = (&Rational::from_float(wave).unwrap(), &length);
            let Ok((motion, _)) = contact.press(&state, &errors, moved) else {
                told[1] += 1;
                continue;
            };
            told[0] += 1;
            let at = exact(&length);
            let (ended, _) = contact.system.ended(
                &contact.passivity,
                &motion,
                (&errors, &mut None),
                &at,
                &contact.cut,
            );
            for (dv, da) in [(off, off), (off, -off), (-off, off), (-off, -off)] {
                let time = length.to_f64().unwrap();
                let there = beside_a_wall([dv, 1.0 + da], wave, time);
                for (place, value) in there.into_iter().enumerate() {
                    // As far as small steps tell.
                    let value = Ball::from_rational(&Rational::from_float(value).unwrap(), 128)
                        .widened(&Magnitude::power_of_two(-36));
                    let told = format!("{place} after {length}, off by {off}");
                    assert!(
                        encloses(&motion.state[place], &length, &value, &contact.cut),
                        "{told}"
                    );
                    let rest = ended[place].ball(BITS).subtract(&value, 128);
                    assert!(rest.contains_zero(), "{told}: {rest}");
                }
            }
        }
    }
    assert!(told[0] > 4 && told[1] > 2, "{told:?}");
}

/// Passivity at these compressions of a contact whose law is `X = α^m`.
fn at_compressions(contact: &Contact, compressions: [&Rational; 2]) -> [Passivity; 2] {
    compressions.map(|own| {
        let state = [Number::zero(), exact(own)];
        Passivity::at(&contact.node, &contact.system, (&state, 128)).unwrap()
    })
}

/// In the norm of another spring an error is as large as it was, and no larger than it has to be.
#[test]
fn errors_are_carried_to_other_springs() {
    let contact = Contact::new("endless - a - m - tip - fixed", &ratio(3, 2), 0);
    for (from, to) in [(ratio(1, 16), ratio(1, 1)), (ratio(1, 1), ratio(1, 16))] {
        let [before, after] = at_compressions(&contact, [&from, &to]);
        assert!(before.is_near(&[Number::zero(), exact(&from)]));
        assert!(!before.is_near(&[Number::zero(), exact(&to)]));
        let off = Magnitude::power_of_two(-20);
        for offs in [[off, Magnitude::ZERO], [Magnitude::ZERO, off], [off, off]] {
            let size = |passivity: &Passivity| passivity.blocks[0].size(offs.into_iter());
            let errors = [StateError::new(size(&before))];
            let carried = after.carried(&before, &errors)[0].size();
            assert!(size(&after) <= carried, "{offs:?} from {from} to {to}");
            // `X' = 3/2 √α`: four times as stiff, or no stiffer.
            let most = if from < to { 9 } else { 5 };
            assert!(carried <= errors[0].size().multiply(&Magnitude::from_u64(most)).scale(-2));
            assert!(after.rate() <= contact.passivity.rate());
        }
    }
}

/// A spring much stiffer than the contact would understate how far an error of velocity carries: the mismatch makes up
/// for it.
#[test]
fn errors_grow_beside_a_spring_that_is_too_stiff() {
    let contact = Contact::new("free - m - tip - fixed", &ratio(3, 2), 0);
    let (off, start) = (power_of_two(-20), ratio(1, 64));
    let still = Number::Exact(Rational::default());
    let mut state = vec![still.widened(&Magnitude::from_rational(&off), BITS), exact(&start)];
    let mut errors = contact.passivity.errors(&state);
    let (mut now, end) = (Rational::default(), ratio(2, 1));
    while now < end {
        let length = power_of_two(-5).min(&end - &now);
        let (motion, _) = contact.press(&state, &errors, (&Rational::default(), &length)).unwrap();
        let known = (&errors[..], &mut None);
        (state, errors) =
            contact.system.ended(&contact.passivity, &motion, known, &exact(&length), &contact.cut);
        now += length;
    }
    let moved = |velocity: f64| beside_a_wall_alone([velocity, 1.0 / 64.0], 2.0)[1];
    let spread = moved(off.to_f64().unwrap()) - moved(-off.to_f64().unwrap());
    let told = state[1].ball(BITS).radius().to_double();
    assert!(2.0 * told >= spread && told < 40.0 * spread, "{told} {spread}");
}
