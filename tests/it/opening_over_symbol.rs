//! Contacts that open, for all values of a symbol at once.

use crate::over_symbol::{at, meet, of_step, of_varying, rational, scene};
use wavestep::Problem;
use wavestep::ball::Magnitude;
use wavestep::expression::Fraction;
use wavestep::history::EventKind;
use wavestep::history::family::envelope::StepWindow;
use wavestep::history::family::grid::Grid;
use wavestep::history::family::on_cell::OnCell;
use wavestep::history::family::{NotOverSymbol, Over};
use wavestep::planner::Purpose;
use wavestep::signal::{Limit, Varying, value};
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

/// A spring that is unloaded while the contact is open, between masses that meet again.
const CUSHION: &str = "scene \"Cushion\"
    symbol a > 0
    mass hammer { mass = a, velocity = 1 }
    spring cushion { stiffness = 8 }
    mass anvil { mass = 1/4 }
    bar rod { impedance = 1, travel = 1 }
    line free - hammer | cushion - anvil - rod - fixed
    contacts open
    observe of_hammer = velocity(hammer)
    observe of_anvil = velocity(anvil)
    observe force = force(cushion)
    observe compression = compression(cushion)
    observe far = force(rod.right)
    observe energy = energy(line)
    observe momentum = momentum(line)";

/// The same at the right end of a bar, without masses.
const BUMPER: &str = "scene \"Bumper\"
    symbol a > 0
    bar rod { impedance = 2 }
    spring bumper { stiffness = 3 }
    bar striker { impedance = a, travel = 1/2, velocity = -1 }
    line endless - rod - bumper | striker - free
    contacts open
    observe force = force(bumper)
    observe compression = compression(bumper)
    observe of_rod = velocity(rod.right)
    observe of_striker = velocity(striker.left)
    observe displacement = displacement(striker.right)";

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

/// Of all lines that can be put together one in so many is tested.
const STEP: usize = 17;

/// A scene with a symbol, the values that it takes, and a time.
struct Case {
    problem: Problem,
    symbol: &'static str,
    ends: [Rational; 2],
    to: Rational,
}

/// What was compared.
#[derive(Default)]
struct Compared {
    places: usize,
    changes: usize,
}

impl Case {
    fn new(
        problem: Problem,
        symbol: &'static str,
        (from, part): (Rational, i64),
        to: Rational,
    ) -> Case {
        let ends = [from.clone(), &from + &from * rational(1, part)];
        Case { problem, symbol, ends, to }
    }

    /// Compares what is told for all values with the digits of single scenes; `radius` is how far off it may be at most.
    fn compare(&self, radius: &Rational, compared: &mut Compared) -> Result<(), NotOverSymbol> {
        let symbol = Symbol::new(self.symbol).unwrap();
        let scaled = self.problem.scaled().unwrap();
        for quantity in self.problem.observables() {
            let own = Over::new(scaled, quantity, (&symbol, self.ends.each_ref()))?;
            let asked = Over::grid(&[&own])?;
            let [_, last] = own.in_steps(&Fraction::constant(&self.to), &asked.step)?;
            let window = StepWindow { from: Default::default(), to: [last.clone(), last] };
            let followed = own.follow(&asked, &[], window.count())?;
            let told = followed.observed();
            for place in [rational(0, 1), rational(2, 7), rational(1, 1)] {
                let at_value = at(self.ends.each_ref(), &place);
                let one = Over::new(scaled, quantity, (&symbol, [&at_value; 2]))?;
                let [_, per_unit] = one.in_steps(&Fraction::one(), &asked.step)?;
                let here = Here {
                    case: self,
                    single: self.problem.substituted(self.symbol, at_value).unwrap(),
                    parameter: &place * rational(2, 1) - rational(1, 1),
                    per_unit,
                    grid: &followed.grid,
                };
                if self.problem.observables().first() == Some(&quantity) {
                    here.compare_changes(told.len(), compared);
                }
                here.compare_values(quantity, &told, radius, compared);
            }
        }
        Ok(())
    }
}

/// One value of the symbol.
struct Here<'a> {
    case: &'a Case,
    single: Problem,
    /// From −1 to 1.
    parameter: Rational,
    /// Steps in a unit of time.
    per_unit: Rational,
    grid: &'a Grid,
}

impl Here<'_> {
    /// Where contacts open and close is the beginning of a cell.
    fn compare_changes(&self, count: usize, compared: &mut Compared) {
        let last = Rational::from_integer((count / self.grid.cells()).into());
        for event in self.single.events(30).unwrap().events.iter().skip(1) {
            let time = event.time.bounds().map(|end| end * &self.per_unit);
            if time[0] >= last {
                continue;
            }
            let cut = |cell: usize| {
                let own = of_varying(&self.grid.start(cell), &self.parameter);
                match event.kind {
                    // Contacts open a little later there.
                    EventKind::Opening => own.widened(&Magnitude::power_of_two(-10)),
                    _ => own,
                }
            };
            let is_cut = (0..count).any(|cell| meet(&cut(cell), &time));
            assert!(is_cut, "{}: {event:?}", self.single.source().text());
            compared.changes += 1;
        }
    }

    fn compare_values(
        &self,
        quantity: &str,
        told: &[OnCell],
        radius: &Rational,
        compared: &mut Compared,
    ) {
        let (zero, to) = (rational(0, 1), &self.case.to);
        let wanted = self.single.wanted(quantity).unwrap();
        let purpose = Purpose::Values { digits: 30 };
        let signal = self.single.signal_on(&wanted, [&zero, to], purpose).unwrap();
        let middle = |own: &Varying| Rational::from(of_varying(own, &self.parameter).midpoint());
        // Where a contact is closed still that is open in truth.
        let end = rational(1, 1) - rational(1, 1 << 42);
        for (cell, told) in told.iter().enumerate() {
            let (start, length) = (middle(&self.grid.start(cell)), middle(self.grid.length(cell)));
            for x in [rational(1, 50), rational(2, 7), rational(49, 50), end.clone()] {
                let time = (&start + &length * &x) / &self.per_unit;
                if time > *to {
                    continue;
                }
                let exact = value(&*signal, &time, Limit::Right, 30, 1 << 10).unwrap().bounds();
                let here = of_step(told, &x, &self.parameter);
                let name = || {
                    format!(
                        "{} at t = {time}: {:?}",
                        self.single.source().text(),
                        self.single.values()
                    )
                };
                let off = here.radius().to_double();
                assert!(*here.radius() <= Magnitude::from_rational(radius), "{off}: {}", name());
                let here = here.widened(&Magnitude::power_of_two(-60));
                assert!(meet(&here, &exact), "{quantity}, {here:?} and {exact:?}: {}", name());
                compared.places += 1;
            }
        }
    }
}

/// At each value the motion is that of the scene with this value, on both sides of where a contact opens.
#[test]
fn motions_with_contacts_that_open_hold_those_at_each_value() {
    let builtin = |name| Problem::builtin(name).unwrap();
    let mut compared = Compared::default();
    let at_end = [rational(105_999, 100_000), rational(106_004, 100_000)];
    let saint_venant = || builtin("saint-venant");
    for case in [
        Case::new(saint_venant(), "mu", (rational(1, 1), 10_000), rational(6, 1)),
        // It opens at the end of a step, before or after it.
        Case { problem: saint_venant(), symbol: "mu", ends: at_end, to: rational(4, 1) },
        // It opens, and closes again soon after a wave has arrived.
        Case::new(saint_venant(), "mu", (rational(13, 20), 10_000), rational(5, 1)),
        Case::new(saint_venant(), "mu", (rational(5, 2), 2500), rational(6, 1)),
        // It closes again just before another cut, and so that the gap just grazes zero.
        Case::new(saint_venant(), "mu", (rational(937, 1000), 100_000), rational(5, 1)),
        Case::new(saint_venant(), "mu", (rational(101_065, 100_000), 500_000), rational(5, 1)),
        Case::new(builtin("mass-on-free-bar"), "m", (rational(1, 1), 1000), rational(4, 1)),
        Case::new(builtin("bars-that-part"), "r", (rational(1, 2), 4), rational(5, 1)),
        Case::new(scene(CAP), "a", (rational(1, 2), 1000), rational(4, 1)),
        Case::new(scene(SMOOTH), "a", (rational(1, 1), 1000), rational(4, 1)),
        Case::new(scene(TWO), "a", (rational(1, 1), 1000), rational(4, 1)),
        Case::new(scene(PULLED_BACK), "a", (rational(1, 1), 100_000_000), rational(4, 1)),
        Case::new(builtin("cushion-with-release"), "mu", (rational(1, 1), 1000), rational(8, 1)),
        Case::new(scene(CUSHION), "a", (rational(2, 1), 1000), rational(6, 1)),
        Case::new(scene(BUMPER), "a", (rational(1, 1), 1000), rational(6, 1)),
        Case::new(scene(UNITS), "k", (rational(1, 1), 1000), rational(1, 2000)),
    ] {
        case.compare(&rational(1, 1000), &mut compared).unwrap();
    }
    let Compared { places, changes } = compared;
    assert!(places >= 4000 && changes >= 25, "{places} {changes}");
}

/// The same of lines that are put together at random, where it is decided.
#[test]
fn lines_with_contacts_that_open_hold_those_at_each_value() {
    let lefts = [
        "hammer |",
        "striker |",
        "hammer - anvil |",
        "pull - hammer - anvil |",
        "hammer | anvil |",
        "striker - block |",
        "hammer | cushion -",
        "striker | cushion -",
        "hammer - cushion |",
    ];
    let rights =
        ["fixed", "free", "end - free", "ground - free", "far - endless", "pad - end - free"];
    let values = [(1, 3), (1, 2), (1, 1), (3, 2), (2, 1), (3, 1)];
    let (mut compared, mut decided, mut all) = (Compared::default(), 0, 0);
    let count = lefts.len() * rights.len() * values.len();
    for number in (0..count).step_by(STEP) {
        let left = lefts[number % lefts.len()];
        let right = rights[number / lefts.len() % rights.len()];
        let (numerator, denominator) = values[number / lefts.len() / rights.len()];
        let declared = [
            ("pull", "load pull { force = -1/5 }"),
            ("hammer", "mass hammer { mass = a, velocity = 1 }"),
            ("striker", "bar striker { impedance = a, travel = 3/4, velocity = 1 }"),
            ("anvil", "bar anvil { impedance = 1/2, travel = 1/2 }"),
            ("block", "mass block { mass = 1/3, velocity = 1 }"),
            ("ground", "support ground { stiffness = 1, damping = 1/2 }"),
            ("far", "bar far { impedance = 2 }"),
            ("cushion", "spring cushion { stiffness = 5 }"),
            ("pad", "spring pad { stiffness = 3 }"),
            ("end", "mass end { mass = 1/2 }"),
        ];
        let line = format!("line free - {left} rod - {right}");
        let named = |name: &str| line.split(' ').any(|own| own == name);
        let elements = declared.iter().filter(|(name, _)| named(name)).map(|(_, text)| *text);
        let text = [
            "scene \"Line\"",
            "symbol a > 0",
            &elements.collect::<Vec<_>>().join("\n"),
            "bar rod { impedance = 1, travel = 1 }",
            &line,
            "contacts open",
            "observe left = velocity(rod.left)",
            "observe right = force(rod.right)",
        ];
        let from = (rational(numerator, denominator), 20_000);
        let case = Case::new(scene(&text.join("\n")), "a", from, rational(5, 1));
        all += 1;
        match case.compare(&rational(1, 10), &mut compared) {
            Ok(()) => decided += 1,
            Err(error) => assert!(error.may_pass_if_narrower(), "{line}: {error}"),
        }
    }
    assert!(decided * 2 >= all && compared.changes >= 20, "{decided} of {all}");
}

/// A part of a cell is the same function on another scale.
#[test]
fn a_part_of_a_cell_is_the_same_function() {
    let (low, high) = (rational(1, 3), rational(1, 2));
    let symbol = Varying::between([&low, &high], 96);
    let constant = |value: &Rational| Varying::constant(value, 96);
    let whole = OnCell::new(
        vec![constant(&rational(1, 7)), symbol.clone(), constant(&rational(-5, 3)), symbol],
        Magnitude::power_of_two(-20),
    );
    let parts = [
        (whole.after(&rational(5, 11)), [rational(5, 11), rational(1, 1)]),
        (whole.equal_part(2, 5), [rational(2, 5), rational(3, 5)]),
        (whole.equal_part(0, 1), [rational(0, 1), rational(1, 1)]),
    ];
    for (part, [from, to]) in parts {
        assert!(part.error >= whole.error && part.error <= whole.error.scale(1));
        for x in [rational(0, 1), rational(2, 9), rational(1, 1)] {
            let there = &from + (&to - &from) * &x;
            for parameter in [rational(-1, 1), rational(3, 8)] {
                let at =
                    |own: &OnCell, x: &Rational| of_varying(&own.value(&constant(x)), &parameter);
                let [one, other] =
                    [at(&part, &x), at(&whole, &there)].map(|own| Rational::from(own.midpoint()));
                let off = Magnitude::from_rational(&(one - other));
                assert!(off <= Magnitude::power_of_two(-80), "{x}, {parameter}");
            }
        }
    }
}

/// Parts of cells follow each other to the end of the cell, also behind a cut that moves with the symbol.
#[test]
fn cells_are_split_in_equal_parts() {
    let (low, high) = (rational(1, 3), rational(5, 12));
    let cut = Varying::between([&low, &high], 96);
    let (grid, ..) = Grid::new(Fraction::one().into(), 2).unwrap().with_cut(&cut).unwrap();
    let fine = grid.split(3);
    assert_eq!((grid.cells(), fine.cells()), (3, 9));
    for (cell, part) in (0..2 * grid.cells()).flat_map(|cell| [0, 1, 2].map(|part| (cell, part))) {
        for parameter in [rational(-1, 1), rational(3, 8)] {
            let at = |own: &Varying| Rational::from(of_varying(own, &parameter).midpoint());
            let length = at(grid.length(cell)) / rational(3, 1);
            let start = at(&grid.start(cell)) + &length * rational(part as i64, 1);
            let own = 3 * cell + part;
            for off in [at(&fine.start(own)) - start, at(fine.length(own)) - length] {
                let off = Magnitude::from_rational(&off);
                assert!(off <= Magnitude::power_of_two(-80), "{cell} {part} {parameter}");
            }
        }
    }
}
