//! Contacts that open, for all values of a symbol at once.

use crate::over_symbol::{at, meet, of_step, of_varying, rational, scene};
use wavestep::Problem;
use wavestep::ball::{Ball, Magnitude};
use wavestep::expression::Fraction;
use wavestep::history::EventKind;
use wavestep::history::family::Over;
use wavestep::history::family::envelope::StepWindow;
use wavestep::history::family::grid::Grid;
use wavestep::planner::Purpose;
use wavestep::signal::{Limit, value};
use wavestep_polynomial::{Rational, Symbol};

/// A hammer that is pushed against a cap: both have a mass.
const CAP: &str = "scene \"Cap\"
    symbol a > 0
    load push { force = 1 - t/2, until = 1 }
    mass hammer { mass = a }
    mass cap { mass = 1/4 }
    bar rod { impedance = 1, travel = 1 }
    line free - push - hammer | cap - rod - fixed
    contacts open
    observe of_hammer = velocity(hammer)
    observe of_cap = velocity(cap)
    observe far = force(rod.right)
    observe energy = energy(line)";

/// Waves without jumps meet at a contact without mass, while a load acts elsewhere.
const SMOOTH: &str = "scene \"Smooth\"
    symbol a > 0
    mass hammer { mass = a, velocity = -1 }
    bar anvil { impedance = 2, travel = 1/2 }
    bar rod { impedance = 1, travel = 1 }
    support ground { stiffness = 1/3, damping = 1 }
    load push { force = sin(t)/3, until = 2 }
    line free - push - ground - rod | anvil - hammer - free
    contacts open
    observe of_hammer = velocity(hammer)
    observe left = velocity(rod.right)
    observe right = velocity(anvil.left)
    observe force = force(anvil.left)
    observe displacement = displacement(rod.right)
    observe momentum = momentum(line)";

/// Two contacts, of which one opens after the other, and a constant force.
const TWO: &str = "scene \"Two\"
    symbol a > 0
    load weight { force = 1/50 }
    mass hammer { mass = a, velocity = 1 }
    bar anvil { impedance = 1/2, travel = 1/2 }
    bar rod { impedance = 1, travel = 1 }
    line free - weight - hammer | anvil | rod - free
    contacts open
    observe of_hammer = velocity(hammer)
    observe of_anvil = velocity(anvil.left)
    observe left = velocity(anvil.right)
    observe force = force(rod.left)";

/// Nothing but waves meets at the contact, which opens where its force falls to zero.
const PULLED_BACK: &str = "scene \"Pulled back\"
    symbol a > 0
    load pull { force = -1/5 }
    mass hammer { mass = a, velocity = 1 }
    bar anvil { impedance = 1/2, travel = 1/2 }
    bar rod { impedance = 1 }
    line free - pull - hammer - anvil | rod - endless
    contacts open
    observe left = velocity(anvil.right)
    observe right = velocity(rod.left)";

/// In units, and a striker whose impedance is known but for a factor.
const UNITS: &str = "scene \"Units\"
    symbol k > 0
    material steel { modulus = 210 GPa, density = 7850 kg/m^3 }
    material soft { modulus = 210/k^2 GPa, density = 7850/k^2 kg/m^3 }
    bar striker { material = soft, diameter = 16 mm, length = 300 mm, velocity = 10 m/s }
    bar incident { material = steel, diameter = 20 mm, length = 3/2 m }
    spring specimen { stiffness = 40 kN/mm }
    bar output { material = steel, diameter = 20 mm }
    line free - striker | incident - specimen - output - endless
    contacts open
    observe force = force(specimen)
    observe gauge = strain(incident.at(1/2))
    observe velocity = velocity(striker.left)";

/// Where the last cell ends.
fn grid_end(grid: &Grid, count: usize) -> Rational {
    Rational::from_integer((count / grid.cells()).into())
}

/// At each value the motion is that of the scene with this value, on both sides of where a contact opens.
#[test]
fn motions_with_contacts_that_open_hold_those_at_each_value() {
    let builtin = |name| Problem::builtin(name).unwrap();
    let (mut places, mut changes) = (0, 0);
    // Where a contact is closed still that is open in truth.
    let end = rational(1, 1) - rational(1, 1 << 42);
    for (problem, symbol, ends, to) in [
        (builtin("saint-venant"), "mu", [rational(1, 1), rational(10001, 10000)], rational(6, 1)),
        // It opens at the end of a step, before or after it.
        (
            builtin("saint-venant"),
            "mu",
            [rational(105_999, 100_000), rational(106_004, 100_000)],
            rational(4, 1),
        ),
        (builtin("saint-venant"), "mu", [rational(5, 2), rational(2501, 1000)], rational(6, 1)),
        (builtin("mass-on-free-bar"), "m", [rational(1, 1), rational(1001, 1000)], rational(4, 1)),
        (builtin("bars-that-part"), "r", [rational(1, 2), rational(5, 8)], rational(5, 1)),
        (scene(CAP), "a", [rational(1, 2), rational(501, 1000)], rational(4, 1)),
        (scene(SMOOTH), "a", [rational(1, 1), rational(1001, 1000)], rational(4, 1)),
        (scene(TWO), "a", [rational(1, 1), rational(1001, 1000)], rational(4, 1)),
        (
            scene(PULLED_BACK),
            "a",
            [rational(1, 1), rational(100_000_001, 100_000_000)],
            rational(4, 1),
        ),
        (scene(UNITS), "k", [rational(1, 1), rational(1001, 1000)], rational(1, 2000)),
    ] {
        let (name, symbol_of) = (problem.title().to_owned(), Symbol::new(symbol).unwrap());
        let scaled = problem.scaled().unwrap();
        for quantity in problem.observables() {
            let own = Over::new(scaled, quantity, (&symbol_of, ends.each_ref())).unwrap();
            let asked = Over::grid(&[&own], None).unwrap();
            let [_, last] = own.in_steps(&Fraction::constant(&to), &asked.step).unwrap();
            let window = StepWindow { from: Default::default(), to: [last.clone(), last] };
            let followed = own.follow(&asked, &[], window.count()).unwrap();
            let grid = &followed.grid;
            for place in [rational(0, 1), rational(2, 7), rational(1, 1)] {
                let at_value = at(ends.each_ref(), &place);
                let single = problem.substituted(symbol, at_value.clone()).unwrap();
                let wanted = single.wanted(quantity).unwrap();
                let zero = rational(0, 1);
                let signal = single
                    .signal_on(&wanted, [&zero, &to], Purpose::Values { digits: 30 })
                    .unwrap();
                let one = Over::new(scaled, quantity, (&symbol_of, [&at_value; 2])).unwrap();
                let [_, per_unit] = one.in_steps(&Fraction::one(), &grid.step).unwrap();
                let parameter = &place * rational(2, 1) - rational(1, 1);
                let middle = |own: Ball| Rational::from(own.midpoint());
                let events = match problem.observables().first() {
                    Some(first) if *first == quantity => single.events(30).unwrap().events,
                    _ => Vec::new(),
                };
                for event in events.iter().skip(1) {
                    let time = event.time.bounds().map(|end| end * &per_unit);
                    let cut = |cell: usize| {
                        let own = of_varying(&grid.start(cell), &parameter);
                        match event.kind {
                            // Contacts open a little later there.
                            EventKind::Opening => own.widened(&Magnitude::power_of_two(-10)),
                            _ => own,
                        }
                    };
                    let count = followed.observed().len();
                    assert!(
                        time[0] > grid_end(grid, count)
                            || (0..count).any(|cell| meet(&cut(cell), &time)),
                        "{name}: {symbol} = {at_value}: {event:?}"
                    );
                    changes += 1;
                }
                for (cell, told) in followed.observed().iter().enumerate() {
                    let start = middle(of_varying(&grid.start(cell), &parameter));
                    let length = middle(of_varying(grid.length(cell), &parameter));
                    for x in [rational(1, 50), rational(2, 7), rational(49, 50), end.clone()] {
                        let time = (&start + &length * &x) / &per_unit;
                        if time > to {
                            continue;
                        }
                        let exact = value(&*signal, &time, Limit::Right, 30, 1 << 10).unwrap();
                        let here = of_step(told, &x, &parameter);
                        assert!(
                            *here.radius() <= Magnitude::from_rational(&rational(1, 1000)),
                            "{name}: {quantity} {:?}",
                            here.radius().to_double()
                        );
                        let here = here.widened(&Magnitude::power_of_two(-60));
                        assert!(
                            meet(&here, &exact.bounds()),
                            "{name}: {quantity} at t = {time}, {symbol} = {at_value}: {here:?} and {:?}",
                            exact.bounds()
                        );
                        places += 1;
                    }
                }
            }
        }
    }
    assert!(places >= 4000 && changes >= 25, "{places} {changes}");
}
