//! Errors in the states of a node and how they die out.

use proptest::prelude::*;
use std::sync::LazyLock;
use wavestep::ball::{Magnitude, Number};
use wavestep::enclosure::Numbers;
use wavestep::history::passivity::{Passivity, StateError};
use wavestep::history::series::{CellNorm, Series, Truncation};
use wavestep::language::{Source, read_scene};
use wavestep::network::{Contacts, Layout, Network, Node, System, dot};
use wavestep_polynomial::Rational;

type Own = (Node<Number>, System<Number>, Truncation);

/// The node of two masses, one of them on the ground, with springs, dampers and two bars.
static NODE: LazyLock<Own> = LazyLock::new(|| node("1/2", "2"));

/// The same with a light and a heavy mass, which act on each other.
static UNLIKE: LazyLock<Own> = LazyLock::new(|| node("1/1024", "40"));

fn node(left: &str, right: &str) -> Own {
    let text = format!(
        "scene \"A\"\nbar a {{ impedance = 1, travel = 1 }}\nmass m {{ mass = {left}, velocity = 1 }}\n\
         support s {{ stiffness = 3, damping = 1/5 }}\nspring k {{ stiffness = 7 }}\n\
         mass p {{ mass = {right} }}\nbar b {{ impedance = 3, travel = 2 }}\n\
         line free - a - m - s - k - p - b - free\nobserve v = velocity(m)"
    );
    let scene = read_scene(&Source::new("scene", text).unwrap(), &Default::default()).unwrap();
    let network = Network::new(&scene).unwrap();
    let layout = Layout::of(network.scene(), network.model(), Contacts::Links);
    let numbers = Numbers::new(&[]);
    let node = layout.nodes.iter().find(|node| node.elements.len() == 4).unwrap();
    let node = node.map(|value| numbers.number(value, 128)).unwrap();
    let system = System::of(&node, |_| true, 128).unwrap();
    let rate = Passivity::of(&node, &system).unwrap().rate();
    (node, system, Truncation::new(128, rate.top().unwrap()))
}

pub fn with_node<T>(what: impl Fn(&Node<Number>, &System<Number>, &Truncation) -> T) -> T {
    let (node, system, cut) = &*NODE;
    what(node, system, cut)
}

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

pub fn cell(length: &Rational, cut: &Truncation) -> CellNorm {
    CellNorm::new(Magnitude::from_rational(length), cut)
}

/// The first terms of a polynomial; those that are left out are in its bound.
fn shortened(own: &Series, kept: usize, norm: &CellNorm) -> Series {
    let sizes = own.coefficients.iter().enumerate().map(|(k, c)| match k < kept {
        true => Magnitude::ZERO,
        false => c.magnitude(),
    });
    let left = norm.of_sizes(&sizes.collect::<Vec<_>>());
    Series::new(own.coefficients.iter().take(kept).cloned().collect(), left)
}

#[test]
fn a_damped_node_forgets() {
    with_node(|node, system, _| {
        let passivity = Passivity::of(node, system).unwrap();
        let [block] = &passivity.blocks[..] else { panic!("one block") };
        assert_eq!(block.members, [0, 1, 2, 3]);
        let (_, left) = block.decay.expect("bars take energy up");
        assert!(left <= Magnitude::power_of_two(-1));
        let error = StateError::new(Magnitude::from_u64(1));
        let later = error.after(&Number::integer(40), &Magnitude::ZERO, block).size();
        assert!(later < Magnitude::power_of_two(-3), "{}", later.to_double());
    });
}

/// What is left of a state without inputs never exceeds what its size has been taken to die out to.
#[test]
fn a_state_dies_out_no_slower_than_told() {
    with_node(|node, system, cut| {
        let passivity = Passivity::of(node, system).unwrap();
        let block = &passivity.blocks[0];
        let still = [Series::zero(), Series::zero()];
        let length = rational(1, 4);
        let norm = cell(&length, cut);
        let length = Number::Exact(length);
        let mut state: Vec<Number> = [1, -2, 3, 1].map(Number::integer).to_vec();
        let mut told = StateError::new(block.size(state.iter().map(Number::magnitude)));
        let mut errors = passivity.errors(&state);
        for step in 0..160 {
            let motion = system
                .solve(passivity.known(&state, &errors), &mut still.clone(), (&norm, cut))
                .unwrap();
            (state, errors) = system.ended(&passivity, &motion, (&errors, &mut None), &length, cut);
            told = told.after(&length, &Magnitude::ZERO, block);
            let size = block.size(state.iter().map(Number::magnitude)).to_double();
            assert!(size <= told.size().to_double() * (1.0 + 1e-8), "{step}: {size} {told:?}");
        }
        assert!(told.size() < Magnitude::power_of_two(-8), "{told:?}");
    });
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// On a cell that is much longer than the free motion lasts, the forced motion and its bound are true of the
    /// motion as many short cells tell it.
    #[test]
    fn long_cells_enclose_short_ones(
        start in prop::collection::vec(-4_i64..5, 4), inputs in prop::collection::vec(-9_i64..10, 10),
        kept in 1_usize..6,
    ) {
        let start = thirds(&start);
        encloses_short_cells(&NODE, &separated(&NODE), (rational(16, 1), 64), start, (&inputs, kept))?;
    }

    /// The same where some motions last longer than the cell, and others are long gone.
    #[test]
    fn cells_that_are_long_for_some_motions_enclose_short_ones(
        start in prop::collection::vec(-4_i64..5, 4), inputs in prop::collection::vec(-9_i64..10, 10),
        kept in 1_usize..6,
    ) {
        let (own, start) = (separated(&UNLIKE), thirds(&start));
        encloses_short_cells(&UNLIKE, &own, (rational(1, 2), 128), start, (&inputs, kept))?;
    }

    /// What a slow motion leaves of the equation counts as an error: here it takes no part in what arrives that pushes
    /// the fast ones.
    #[test]
    fn what_is_left_of_the_equation_is_an_error(
        start in prop::collection::vec(-4_i64..5, 4), inputs in prop::collection::vec(-9_i64..10, 10),
    ) {
        let mut own = separated(&UNLIKE);
        let separation = own.blocks[0].separations.last_mut().unwrap();
        separation.fast_inverse = vec![vec![Number::zero(); 4]; 4];
        let start = thirds(&start);
        let slow = separation.slow.iter().map(|row| dot(row, &start, 128)).collect();
        encloses_short_cells(&UNLIKE, &own, (rational(1, 2), 128), slow, (&inputs, 5))?;
    }
}

fn thirds(start: &[i64]) -> Vec<Number> {
    start.iter().map(|value| Number::Exact(rational(*value, 3))).collect()
}

fn separated((node, system, cut): &Own) -> Passivity {
    Passivity::at(node, system, (&vec![Number::zero(); 4], cut.bits)).unwrap()
}

fn encloses_short_cells(
    (_, system, cut): &Own,
    passivity: &Passivity,
    (long, steps): (Rational, i64),
    start: Vec<Number>,
    (inputs, kept): (&[i64], usize),
) -> Result<(), TestCaseError> {
    let bits = cut.bits;
    let step = &long / rational(steps, 1);
    let (norm, short) = (cell(&long, cut), cell(&step, cut));
    prop_assert!(passivity.blocks[0].separation_on(&norm.length).is_some());
    let coefficient = |(k, c): (usize, &i64)| Number::Exact(rational(*c, 7 << (3 * k)));
    let exact = [&inputs[..5], &inputs[5..]]
        .map(|own| Series::new(own.iter().enumerate().map(coefficient).collect(), Magnitude::ZERO));
    let known = exact.each_ref().map(|own| shortened(own, kept, &norm));
    let errors = passivity.errors(&start);
    let told =
        system.solve(passivity.known(&start, &errors), &mut known.clone(), (&norm, cut)).unwrap();
    let (mut state, mut errors) = (start, errors);
    for count in 0..=steps {
        let x = Number::Exact(&step * rational(count, 1));
        for (told, state) in told.state.iter().zip(&state) {
            let off = told.value(&x, cut).subtract(state, bits).ball(bits);
            prop_assert!(off.contains_zero(), "at {count}: {off}");
        }
        let shifted = exact.each_ref().map(|own| own.shift(&x, cut));
        let motion = system
            .solve(passivity.known(&state, &errors), &mut shifted.clone(), (&short, cut))
            .unwrap();
        let length = Number::Exact(step.clone());
        (state, errors) = system.ended(passivity, &motion, (&errors, &mut None), &length, cut);
    }
    Ok(())
}

/// Some time after the start the motion of the light mass is gone, and what is left is told with as many digits.
#[test]
fn what_is_gone_is_not_followed() {
    let (_, system, cut) = &*UNLIKE;
    let start: Vec<Number> = [1, -2, 3, 1].map(Number::integer).to_vec();
    let passivity = separated(&UNLIKE);
    let length = rational(1, 256);
    let norm = cell(&length, cut);
    let still = [Series::zero(), Series::zero()];
    let free = |state: &[Number], errors: &[StateError]| {
        system.free_rate(passivity.known(state, errors), &still, (&norm, cut))
    };
    let (mut state, mut errors) = (start.clone(), passivity.errors(&start));
    assert_eq!(free(&state, &errors), passivity.rate());
    let (length, energy) = (Number::Exact(length), &mut None);
    for _ in 0..32 {
        let motion = system
            .solve(passivity.known(&state, &errors), &mut still.clone(), (&norm, cut))
            .unwrap();
        (state, errors) = system.ended(&passivity, &motion, (&errors, energy), &length, cut);
    }
    let rate = free(&state, &errors);
    assert!(rate.scale(6) < passivity.rate() && !rate.is_zero(), "{}", rate.to_double());
    let long = rational(1, 4);
    let norm = cell(&long, cut);
    let motion =
        system.solve(passivity.known(&state, &errors), &mut still.clone(), (&norm, cut)).unwrap();
    let (long, energy) = (Number::Exact(long), &mut None);
    let (_, after) = system.ended(&passivity, &motion, (&errors, energy), &long, cut);
    assert!(after[0].size() < errors[0].size().scale(2), "{:?} {:?}", after, errors);
}

proptest! {
    /// What is known of a state with an error is true of every state within that error: it is moved by
    /// all of it at the start, by all of what inputs leave out, and by what few terms leave out themselves.
    #[test]
    fn errors_are_bounded(
        moved in prop::collection::vec(-4_i64..5, 4), inputs in prop::collection::vec(-9_i64..10, 10),
        lengths in prop::collection::vec(1_i64..9, 1..6), kept in 1_usize..4, order in 2_usize..9,
    ) {
        with_node(|node, system, cut| {
            let passivity = Passivity::of(node, system).unwrap();
            let block = &passivity.blocks[0];
            let bits = cut.bits;
            let few = Truncation { order, ..*cut };
            let start: Vec<Number> = (1..5).map(|i| Number::Exact(rational(i, 3))).collect();
            let mut other: Vec<Number> = start.iter().zip(&moved)
                .map(|(value, by)| value.add(&Number::Exact(rational(*by, 1000)), bits))
                .collect();
            let error = block.size(moved.iter()
                .map(|by| Magnitude::from_rational(&rational(by.abs(), 1000))));
            let mut state: Vec<Number> = start.iter().enumerate()
                .map(|(i, value)| value.widened(&block.entry(i, &error), bits))
                .collect();
            let mut errors = vec![StateError::new(error)];
            let mut exact = passivity.errors(&other);
            for length in &lengths {
                let length = rational(*length, 40);
                let norm = cell(&length, cut);
                let series = |from: usize| {
                    let all = inputs[from..from + 5].iter().map(|c| Number::Exact(rational(*c, 7)));
                    Series::new(all.collect(), Magnitude::ZERO)
                };
                let whole = [series(0), series(5)];
                let short = whole.each_ref().map(|own| shortened(own, kept, &norm));
                let wide = passivity.known(&state, &errors);
                let wide = system.solve(wide, &mut short.clone(), (&norm, &few)).unwrap();
                let narrow = passivity.known(&other, &exact);
                let narrow = system.solve(narrow, &mut whole.clone(), (&norm, cut)).unwrap();
                let places: Vec<Number> =
                    (0..9).map(|part| Number::Exact(&length * rational(part, 8))).collect();
                let outputs = wide.velocities.iter().chain(&wide.state);
                for (a, b) in outputs.zip(narrow.velocities.iter().chain(&narrow.state)) {
                    let mut pair = [a.clone(), b.clone()];
                    for order in 0..3 {
                        for x in &places {
                            let [wide, narrow] = pair.each_ref().map(|own| own.value(x, cut));
                            let off = wide.subtract(&narrow, bits).ball(bits);
                            assert!(off.contains_zero(), "order {order}: {off}");
                        }
                        pair = pair.map(|own| own.derivative(cut));
                    }
                }
                let length = Number::Exact(length);
                (state, errors) = system.ended(&passivity, &wide, (&errors, &mut None), &length, &few);
                (other, exact) = system.ended(&passivity, &narrow, (&exact, &mut None), &length, cut);
                for (wide, narrow) in state.iter().zip(&other) {
                    assert!(wide.subtract(narrow, bits).ball(bits).contains_zero());
                }
            }
        });
    }
}
