//! The energy of errors in a line: what no node adds to, and what it tells of values.

use super::passivity::{cell, with_node};
use super::squares::truncation;
use super::{Values, network_of, rational, values};
use proptest::prelude::*;
use wavestep::ball::{Magnitude, Number};
use wavestep::history::motion::combined;
use wavestep::history::passive::{ErrorEnergy, Passage};
use wavestep::history::passivity::Passivity;
use wavestep::history::series::Series;
use wavestep::planner::Purpose;
use wavestep::signal::{At, Limit};
use wavestep_polynomial::Rational;

/// A bar that rings between a mass on a spring and its free end, once a hammer has left it.
const RINGING: &str = "scene \"A\"\nmass hammer { mass = 1, velocity = 1 }\nbar rod { impedance = 1, travel = 1 }\n\
     spring s { stiffness = 1 }\nmass anvil { mass = 2 }\nline free - hammer | rod - anvil - s - fixed\n\
     contacts open\nobserve v = velocity(anvil)\nobserve f = force(rod.at(1/3))";

/// Bars without masses, which a blow rings: all errors are those of waves.
const BLOWN: &str = "scene \"A\"\nload blow { force = 2*t*exp(-t/3) }\nbar a { impedance = 3, travel = 1/2 }\n\
     bar rod { impedance = 1, travel = 1 }\nline free - blow - a - rod | fixed\ncontacts open\n\
     observe v = velocity(a.at(1/3))\nobserve f = force(rod.at(1/3))";

const NONE: Values<'static> = &[];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Masses and springs hold no more energy at the end of a cell than at its start, but for what the waves bring in
    /// and take away.
    #[test]
    fn no_node_gives_energy(
        start in prop::collection::vec(-4_i64..5, 4), inputs in prop::collection::vec(-9_i64..10, 8),
    ) {
        with_node(|node, system, cut| {
            let passivity = Passivity::of(node, system).unwrap();
            let block = &passivity.blocks[0];
            let length = rational(1, 4);
            let norm = cell(&length, cut);
            let length = Number::Exact(length);
            let state: Vec<Number> = start.iter().map(|value| Number::integer(*value)).collect();
            let series = |own: &[i64]| {
                Series::new(own.iter().map(|c| Number::integer(*c)).collect(), Magnitude::ZERO)
            };
            let arriving = [series(&inputs[..4]), series(&inputs[4..])];
            let errors = passivity.errors(&state);
            let motion = system.solve(passivity.known(&state, &errors), &mut arriving.clone(), (&norm, cut)).unwrap();
            let held = |state: &[Number]| {
                let size = block.size(state.iter().map(Number::magnitude)).to_double();
                size * size / 2.0
            };
            let carried = |wave: &Series, impedance: f64| {
                wave.energy(cut).value(&length).ball(64).to_double().0 * impedance
            };
            let runs = node.side_runs();
            let parts = || motion.state.iter().chain(&arriving);
            let row = |side: usize| system.leaving_row((side, runs[side]), cut.bits);
            let leaving = [0, 1].map(|side| combined(&row(side), parts(), cut.bits));
            let (after, _) = system.ended(&passivity, &motion, (&errors, &mut None), &length, cut);
            let before = held(&state) + carried(&arriving[0], 1.0) + carried(&arriving[1], 3.0);
            let after = held(&after) + carried(&leaving[0], 1.0) + carried(&leaving[1], 3.0);
            prop_assert!(after <= before * (1.0 + 1e-9), "{after} {before}");
            // All that is lost goes into the damper of the support.
            prop_assert!(after >= before * 0.3, "{after} {before}");
            Ok(())
        })?;
    }
}

/// `√(2Zh)`.
fn passage_root(impedance: f64, length: &Magnitude) -> f64 {
    (2.0 * impedance * length.to_double()).sqrt() * (1.0 - 1e-9)
}

/// Of all polynomials with one mean square, `Σ (2k+1) P_k` is the largest at the end of its cell: `(d + 1)/√h` times
/// the root of its integral.
#[test]
fn values_are_no_larger_than_their_energy_allows() {
    let cut = truncation(128, 2);
    for (degree, length) in
        [(0_u64, rational(1, 1)), (3, rational(2, 1)), (9, rational(1, 100)), (20, rational(1, 7))]
    {
        let reach = Magnitude::from_rational(&length);
        let passage = Passage::of(&Number::integer(3), &Number::Exact(length.clone()));
        // With f(h) = 1 the integral is h/(d+1)², and the energy three times that; derivatives as Markov has them.
        let root = (3.0 * 2.0 * reach.to_double()).sqrt() / (degree + 1) as f64;
        let mut energy = ErrorEnergy::NONE;
        energy.add_state(&Magnitude::from_rational(&Rational::from_float(root).unwrap()));
        let steepest = 2.0 * (degree * degree) as f64 / reach.to_double() / 16.0;
        let rest = steepest.max(1.0).powi(degree as i32);
        let rest = Magnitude::from_rational(&Rational::from_float(rest).unwrap());
        let told = energy.settle(Series::new(Vec::new(), rest), &passage, &cut);
        assert!(told.error.to_double() >= 1.0 - 1e-9, "{degree}: {}", told.error.to_double());
        assert!(told.error <= rest && told.fresh.is_zero(), "{degree}");
        // What a wave or a state adds stays in the bound.
        let one = Magnitude::from_u64(1);
        let (wave, size) = (Series::new(Vec::new(), one), passage_root(3.0, &reach));
        let mut added = ErrorEnergy::NONE;
        added.add_wave(&one, &passage);
        assert!(
            added.of_state().to_double() >= size && added.of_state().to_double() < 1.001 * size
        );
        assert!(added.settle(wave, &passage, &cut).error >= one);
        added.add_state(&one);
        assert!(added.of_state().to_double() >= size + 1.0);
        // A function that bends wildly is bounded all the same.
        let wild = Series::new(Vec::new(), rest.scale(4000));
        let error = energy.settle(wild, &passage, &cut).error.to_double();
        assert!((1.0..9000.0).contains(&error), "{degree}: {error}");
    }
}

/// After six hundred reflections a value is known nearly as well as at first, and what is claimed of it is true.
#[test]
fn values_stay_known_while_a_bar_rings() {
    let [ringing, blown] = [RINGING, BLOWN].map(|text| network_of(text, NONE));
    for (network, name, end) in
        [(&ringing, "v", 600), (&ringing, "f", 600), (&blown, "v", 40), (&blown, "f", 40)]
    {
        let times = [rational(end, 1), rational(3 * end + 1, 3)];
        let late = &times[1];
        let window = [&times[0], late];
        let signal = super::signal(network, name, window, Purpose::Stretches).unwrap();
        let last = signal.stretch_at(late, Limit::Left).unwrap().unwrap();
        let few = signal.enclose(last, 0, At::Time(late), 192).unwrap();
        assert!(
            *few.radius() < Magnitude::power_of_two(-100),
            "{name}: {}",
            few.radius().to_double()
        );
        let more = signal.enclose(last, 0, At::Time(late), 448).unwrap();
        assert!(*more.radius() < Magnitude::power_of_two(-350), "{name}");
        let off = few.subtract(&more, 448);
        assert!(off.contains(&Rational::default()), "{name}: {few:?} {more:?}");
        // The digits that are told are those.
        let told = values(network, name, &times[1..], Limit::Left, 30).remove(0);
        assert!(told.ball(300).subtract(&more, 300).contains(&Rational::default()), "{name}");
    }
}
