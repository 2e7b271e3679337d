//! Motions for all values of a symbol at once, and which simpler answer is proven to be enough for all of them.

use num_traits::ToPrimitive as _;
use wavestep::Problem;
use wavestep::ball::{Arithmetic, Ball, Binary, ComplexBall, Magnitude};
use wavestep::expression::Fraction;
use wavestep::history::family::Over;
use wavestep::history::family::envelope::{Envelope, StepWindow};
use wavestep::history::family::grid::Grid;
use wavestep::history::family::modes::frequency;
use wavestep::history::family::on_cell::OnCell;
use wavestep::model::shape::Part;
use wavestep::model::{Model as _, Modes};
use wavestep::planner::Purpose;
use wavestep::problem::{Claimed, MapRequest, ProblemError, Simpler, Size, SymbolRange};
use wavestep::signal::{At, Limit, Varying, value};
use wavestep_polynomial::{Rational, Symbol};

const BITS: u64 = 96;

/// Told values are evaluated with more bits than they have.
const FINE: u64 = 256;

pub(super) fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

/// A scene whose statements may be indented.
pub(super) fn scene(text: &str) -> Problem {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    Problem::read("test.wave", lines.join("\n")).unwrap()
}

/// So far between two values.
pub(super) fn at([low, high]: [&Rational; 2], place: &Rational) -> Rational {
    low + (high - low) * place
}

/// Steps that are one cell each.
fn whole() -> Grid {
    Grid::new(Fraction::one().into(), 1).unwrap()
}

/// The value at a parameter, which goes from −1 to 1 between two values.
pub(super) fn of_varying(own: &Varying, parameter: &Rational) -> Ball {
    own.value(&Ball::from_rational(parameter, FINE), FINE)
}

pub(super) fn of_step(own: &OnCell, x: &Rational, parameter: &Rational) -> Ball {
    let x = Ball::from_rational(x, FINE);
    let terms = own.coefficients.iter().rev();
    let sum = terms
        .fold(Ball::zero(), |sum, c| sum.multiply(&x, FINE).add(&of_varying(c, parameter), FINE));
    sum.widened(&own.error)
}

pub(super) fn meet(one: &Ball, [low, high]: &[Rational; 2]) -> bool {
    let (from, to) = one.endpoints();
    Rational::from(&from) <= *high && *low <= Rational::from(&to)
}

/// Sums, products, quotients and roots hold what they are of at single values, with the ends forced.
#[test]
fn numbers_that_vary_hold_their_values() {
    let places = [rational(-1, 1), rational(-3, 7), rational(0, 1), rational(1, 1)];
    for [low, high] in [[1, 2], [10, 11], [3, 100]] {
        let ends = [rational(low, 3), rational(high, 3)];
        let x = Varying::between(ends.each_ref(), BITS);
        let two = Varying::constant(&rational(2, 1), BITS);
        let product = x.multiply(&x, BITS).multiply(&x.add(&two, BITS), BITS);
        let power = (0..8).fold(Varying::one(), |power, _| power.multiply(&x, BITS));
        let inverse = x.reciprocal(BITS).unwrap();
        let quotient = two.subtract(&x, BITS).multiply(&inverse, BITS);
        let root = x.sqrt(BITS).unwrap();
        let square = root.multiply(&root, BITS);
        let wave = Varying::exp([&x, &x], BITS).ok();
        // What varies by more than so much has no exponential.
        assert_eq!(wave.is_none(), high == 100);
        for place in &places {
            let own = at(ends.each_ref(), &((place + rational(1, 1)) / rational(2, 1)));
            let two = rational(2, 1);
            let eighth = (0..8).fold(rational(1, 1), |power, _| power * &own);
            for (varying, exact) in [
                (&x, own.clone()),
                (&product, &own * &own * (&own + &two)),
                (&power, eighth),
                (&inverse, own.recip()),
                (&quotient, (&two - &own) / &own),
                (&square, own.clone()),
            ] {
                let told = of_varying(varying, place);
                assert!(told.contains(&exact), "{exact} at {place} of {low}..{high}");
                assert!(varying.number().ball(BITS).contains(&exact));
            }
            let of = |exact: Rational| Ball::from_rational(&exact, FINE);
            let exact = ComplexBall::new(of(own.clone()), of(own.clone()));
            let exact = exact.exp(FINE).unwrap();
            for (told, exact) in wave.iter().flatten().zip([exact.real(), exact.imaginary()]) {
                let told = of_varying(told, place);
                assert!(told.subtract(exact, FINE).contains_zero(), "{told:?} for {exact:?}");
                let most = Magnitude::power_of_two(if low == 10 { -12 } else { 0 });
                assert!(*told.radius() < most, "{told:?}");
            }
        }
    }
    // What may be zero has no inverse, and what may be negative no root.
    let around = Varying::between([&rational(-1, 1), &rational(2, 1)], BITS);
    assert!(around.reciprocal(BITS).is_err() && around.sqrt(BITS).is_none());
}

/// What is never passed and what is reached hold between the ends of a symbol, too, for functions that bend either way.
#[test]
fn sizes_hold_between_the_ends_of_a_symbol() {
    let ends = [rational(1, 1), rational(2, 1)];
    let x = Varying::between(ends.each_ref(), BITS);
    let square = |x: &Rational| x * x;
    // x² lies above its tangents, 5 − (x − 3)² below.
    let away = x.subtract(&Varying::constant(&rational(3, 1), BITS), BITS);
    let five = Varying::constant(&rational(5, 1), BITS);
    let below = five.subtract(&away.multiply(&away, BITS), BITS);
    let window = StepWindow { from: Default::default(), to: [rational(1, 2), rational(1, 2)] };
    type Exact<'a> = &'a dyn Fn(&Rational) -> Rational;
    let functions: [(Varying, Exact<'_>); 2] = [
        (x.multiply(&x, BITS), &square),
        (below, &|x| rational(5, 1) - square(&(x - rational(3, 1)))),
    ];
    for (varying, exact) in functions {
        let step = OnCell::new(vec![varying], Magnitude::ZERO);
        let envelope = Envelope::of((0, &[step]), &whole(), &window);
        let reached = envelope.reached().unwrap();
        let mean =
            |ends: &[Rational; 2], place: &Rational| &ends[1] + (&ends[0] - &ends[1]) * place;
        let places = || (0..=8).map(|i| rational(i, 8));
        let mut within = 0;
        for (high, low) in (0..40).flat_map(|i| (0..40).map(move |j| (i, j))) {
            let most = [rational(high, 8), rational(low, 8)];
            if envelope.is_within(&most) {
                within += 1;
                for place in places() {
                    assert!(exact(&at(ends.each_ref(), &place)) <= mean(&most, &place), "{most:?}");
                }
            }
        }
        assert!(within > 100, "{within}");
        for place in places() {
            let exact = exact(&at(ends.each_ref(), &place));
            assert!(mean(&reached, &place) <= exact && exact > rational(0, 1));
        }
        assert!(reached[0] > rational(2, 1), "{reached:?}");
    }
    // Of a window that is another one for each value, bounds hold on the longest and sizes are reached on the shortest.
    let time = |factors: [i64; 2]| {
        let coefficients = factors.map(|own| Varying::constant(&rational(own, 1), BITS)).to_vec();
        let window = StepWindow {
            from: [rational(1, 4), rational(1, 2)],
            to: [rational(3, 4), rational(7, 8)],
        };
        Envelope::of((0, &[OnCell::new(coefficients, Magnitude::ZERO)]), &whole(), &window)
    };
    for (falls, reached, most) in
        [(false, rational(3, 4), rational(7, 8)), (true, rational(1, 2), rational(3, 4))]
    {
        let time = time(if falls { [1, -1] } else { [0, 1] });
        let near = |size: &Rational, by| [size + rational(by, 1000), size + rational(by, 1000)];
        assert!(time.is_within(&near(&most, 1)) && !time.is_within(&near(&most, -1)));
        let told = time.reached().unwrap();
        assert!(told <= near(&reached, 0) && told >= near(&reached, -1), "{told:?}");
    }
    // Of both signs it is zero between.
    let across = x.subtract(&Varying::constant(&rational(3, 2), BITS), BITS);
    let step = OnCell::new(vec![across], Magnitude::ZERO);
    assert_eq!(Envelope::of((0, &[step]), &whole(), &window).reached(), None);
}

/// At sampled values of the symbol and sampled instants the values that are proven one by one lie in the enclosure that
/// holds for all of them: of every observable of several scenes, and of what simpler scenes say of it.
#[test]
fn enclosures_over_a_symbol_hold_single_values() {
    let units = "scene \"Units\"
        symbol k > 0
        bar rod { area = 1 cm^2, modulus = 200 GPa, density = 7800 kg/m^3, length = 1 m, velocity = 2 m/s }
        bar far { area = 2 cm^2, modulus = 70 GPa, density = 2700 kg/m^3 }
        spring pad { stiffness = k*30 MN/m }
        line free - rod | pad - far - endless
        observe force = force(pad)
        observe strain = strain(far.left)";
    let pushed = "scene \"Pushed\"
        symbol d > 0
        bar rod { impedance = d, travel = 2*d, velocity = 1/d }
        mass block { mass = d^2 }
        bar next { impedance = 3, travel = d }
        support ground { stiffness = 1/d, damping = d }
        load push { force = 2 }
        line fixed - rod - block - ground - next - push - free
        observe velocity = velocity(block)
        observe middle = force(next.at(1/2))
        observe sunk = force(ground)";
    let relayed = "scene \"Relayed\"
        symbol a > 0
        mass hammer { mass = a, velocity = 1 }
        bar rod { impedance = 1, travel = 1 }
        mass block { mass = 1 }
        bar far { impedance = 1 }
        line free - hammer - rod - block - far - endless
        observe velocity = velocity(block)";
    let loaded = "scene \"Loaded\"
        symbol z > 0
        load blow { force = 3*t - t^2, until = 1 }
        bar rod { impedance = z, travel = 1 }
        mass block { mass = 1 }
        load hold { force = z/2, from = 3/2, until = 5/2 }
        bar next { impedance = 2, travel = 1/2 }
        line free - blow - rod - block - hold - next - fixed
        observe velocity = velocity(block)
        observe pushed = force(rod.left)
        observe moved = displacement(rod.left)
        observe carried = momentum(rod)
        observe held = energy(next)";
    let driven = "scene \"Driven\"
        symbol z > 0
        load shake { velocity = t*exp(-z*t)*sin(2*t) + cos(z*t)/z, from = 1/2 }
        bar rod { impedance = 2*z, travel = 1 }
        mass block { mass = 1 }
        load push { force = (1 + t)*exp(-t/3) - sin(3*t), until = 2 }
        bar next { impedance = 2, travel = 1/2 }
        line free - shake - rod - block - push - next - fixed
        observe given = velocity(rod.left)
        observe velocity = velocity(block)
        observe pushed = force(rod.left)
        observe moved = displacement(rod.left)
        observe held = energy(next)";
    let builtin = |name| Problem::builtin(name).unwrap();
    let (mut steps, mut observed, mut gone_on) = (0, 0, 0);
    for (problem, symbol, ends, to) in [
        (builtin("mass-on-fixed-bar"), "mu", [rational(1, 3), rational(2, 5)], rational(2, 1)),
        (builtin("cushioned-impact"), "mu", [rational(1, 1), rational(3, 2)], rational(4, 1)),
        (builtin("mass-between-bars"), "m", [rational(1, 2), rational(3, 5)], rational(6, 1)),
        (builtin("striker-on-long-bar"), "r", [rational(1, 2), rational(5, 8)], rational(6, 1)),
        (builtin("struck-free-bar"), "mu", [rational(2, 1), rational(9, 4)], rational(8, 1)),
        (scene(pushed), "d", [rational(2, 1), rational(9, 4)], rational(9, 1)),
        (scene(loaded), "z", [rational(1, 2), rational(4, 7)], rational(5, 1)),
        (scene(driven), "z", [rational(1, 2), rational(4, 7)], rational(4, 1)),
        (scene(relayed), "a", [rational(1, 1), rational(7, 5)], rational(4, 1)),
        (scene(units), "k", [rational(1, 1), rational(11, 10)], rational(1, 1000)),
    ] {
        let change = |text: &str| {
            let Ok(Simpler::Scene(changes)) = text.parse() else { panic!("{text}") };
            problem.changed(&changes).ok()
        };
        let own = problem.changed(&[]).unwrap();
        let name = problem.title().to_owned();
        let symbol_of = Symbol::new(symbol).unwrap();
        for other in [Some(own), change("third"), change("rigid"), change("endless:rod.right")]
            .into_iter()
            .flatten()
        {
            for quantity in other.observables() {
                let over =
                    Over::new(other.scaled().unwrap(), quantity, (&symbol_of, ends.each_ref()));
                let over = [over.unwrap()];
                // As where the two are compared: what has no waves has no steps of its own.
                let whole =
                    Over::new(problem.scaled().unwrap(), quantity, (&symbol_of, ends.each_ref()));
                let grid = Over::grid(&[&whole.unwrap(), &over[0]]).unwrap();
                let [_, last] = over[0].in_steps(&Fraction::constant(&to), &grid.step).unwrap();
                let window = StepWindow { from: Default::default(), to: [last.clone(), last] };
                let mut followed = match over[0].follow(&grid, &[], window.count()) {
                    Ok(followed) => followed,
                    Err(error) => {
                        assert!(error.may_pass_if_narrower(), "{name}: {quantity}: {error}");
                        continue;
                    }
                };
                observed += 1;
                let told = followed.observed();
                // What happens, and what would where the function of a step went on.
                let mut paths = vec![(None, told.clone())];
                for last in 1..told.len().min(6) {
                    paths.push((Some(last), followed.observed_after(last).unwrap()));
                }
                for place in [rational(0, 1), rational(2, 7), rational(1, 1)] {
                    let own = at(ends.each_ref(), &place);
                    let single = other.substituted(symbol, own.clone()).unwrap();
                    let wanted = single.wanted(quantity).unwrap();
                    let zero = rational(0, 1);
                    let signal =
                        single.signal_on(&wanted, [&zero, &to], Purpose::Stretches).unwrap();
                    let length =
                        Over::new(other.scaled().unwrap(), quantity, (&symbol_of, [&own; 2]))
                            .unwrap();
                    let [_, per_unit] = length.in_steps(&Fraction::one(), &grid.step).unwrap();
                    let time_of = |number: usize, x: &Rational| {
                        // The instant, rounded where the length of a step is no rational number.
                        (rational(number as i64, 1) + x) / &per_unit
                    };
                    let parameter = &place * rational(2, 1) - rational(1, 1);
                    for (last, path) in &paths {
                        let first = last.map_or(0, |last| last + 1);
                        for (number, on_step) in path.iter().enumerate().skip(first) {
                            let x = rational(2, 7);
                            let time = time_of(number, &x);
                            if time > to {
                                continue;
                            }
                            let exact = match last {
                                None => value(&*signal, &time, Limit::Right, 30, 1 << 10)
                                    .unwrap()
                                    .bounds(),
                                Some(_) if signal.closed_form().is_err() => continue,
                                Some(last) => {
                                    let began = time_of(*last, &x);
                                    let stretch = signal.stretch_at(&began, Limit::Right);
                                    let stretch = stretch.unwrap().unwrap();
                                    let own = signal.enclose(stretch, 0, At::Time(&time), FINE);
                                    let (low, high) = own.unwrap().endpoints();
                                    [Rational::from(&low), Rational::from(&high)]
                                }
                            };
                            let mut here = of_step(on_step, &x, &parameter);
                            // Of what bars hold, integrals of waves, less is known.
                            let is_held =
                                ["energy", "momentum"].iter().any(|own| quantity.contains(own));
                            let most = if is_held { 100 } else { 1000 };
                            assert!(
                                *here.radius() <= Magnitude::from_rational(&rational(1, most)),
                                "{name}: {quantity} {:?}",
                                here.radius().to_double()
                            );
                            if other.title() == "Units" {
                                here = here.widened(&Magnitude::power_of_two(-60));
                            }
                            assert!(
                                meet(&here, &exact),
                                "{name}: {quantity} at t = {time}, {symbol} = {own}, after {last:?}: {here:?} and {exact:?}"
                            );
                            steps += 1;
                            gone_on += usize::from(last.is_some());
                        }
                    }
                }
                // The largest size is between what is reached and what is never passed.
                let envelope = Envelope::of((0, &told), &grid, &window);
                let Some(reached) = envelope.reached() else { continue };
                assert!(!envelope.is_within(&reached.map(|own| own * rational(99, 100))));
            }
        }
    }
    assert!(observed >= 25 && steps >= 1000 && gone_on >= 500, "{observed} {steps} {gone_on}");
}

/// Roundings add up where nothing else is left out, as are high powers of time: the velocity of a heavy mass on a bar is
/// `e^(−t/m)`, and an end that is moved moves as it is told to.
#[test]
fn what_is_left_out_over_a_symbol_is_counted() {
    let heavy = scene(
        "scene \"Heavy\"
        symbol m > 0
        mass block { mass = m, velocity = 1 }
        bar rod { impedance = 1, travel = 1 }
        bar far { impedance = 1 }
        line free - block - rod - far - endless
        observe velocity = velocity(block)",
    );
    let moved = scene(
        "scene \"Moved\"
        symbol m > 0
        load shake { velocity = sin(2*t) }
        bar rod { impedance = m, travel = 1 }
        line free - shake - rod - fixed
        observe velocity = velocity(rod.left)",
    );
    let symbol = Symbol::new("m").unwrap();
    let ends = [rational(1_000_000, 1), rational(1_000_001, 1)];
    let exponential = |time: Rational| {
        let exponent = -time / &ends[0];
        Ball::from_rational(&exponent, FINE).exp(FINE).unwrap()
    };
    let sine = |time: Rational| {
        Ball::from_rational(&(time * rational(2, 1)), FINE).cos_sin(FINE).unwrap().1
    };
    type Exact<'a> = &'a dyn Fn(Rational) -> Ball;
    let cases: [(Problem, Exact<'_>, i64); 2] = [(heavy, &exponential, -85), (moved, &sine, -30)];
    for (problem, exact, most) in cases {
        let scaled = problem.scaled().unwrap();
        let over = Over::new(scaled, "velocity", (&symbol, ends.each_ref())).unwrap();
        let grid = Over::grid(&[&over]).unwrap();
        let [_, per_unit] = over.in_steps(&Fraction::one(), &grid.step).unwrap();
        for (number, on_step) in over.follow(&grid, &[], 200).unwrap().observed().iter().enumerate()
        {
            let exact = exact(rational(2 * number as i64 + 1, 2) / &per_unit);
            let told = of_step(on_step, &rational(1, 2), &rational(-1, 1));
            assert!(told.subtract(&exact, FINE).contains_zero(), "{number}: {told:?}");
            assert!(*told.radius() < Magnitude::power_of_two(most));
        }
    }
}

/// A sum of modes holds that of doubles at single values: in lines that are held, that drift, and that are strained at the
/// start.
#[test]
fn modes_over_a_symbol_hold_those_in_doubles() {
    let strained = "scene \"A strained rod is let go\"
        symbol m > 0
        mass block { mass = m, velocity = 1 }
        bar a { impedance = 2, travel = 1, strain = -m/4, velocity = 1/3 }
        spring pad { stiffness = 3 }
        bar b { impedance = m, travel = 1/2 }
        support ground { stiffness = 2/m }
        line free - block - a - pad - b - ground - free
        observe v = velocity(block)
        observe X = force(a.at(1/3)) + force(b.left)
        observe F = force(pad) + force(ground)
        observe u = displacement(b.at(1/4)) - compression(pad)
        observe P = momentum(line)";
    let builtin = |name| Problem::builtin(name).unwrap();
    let mut compared = 0;
    for (problem, symbol, ends, count) in [
        (builtin("mass-on-fixed-bar"), "mu", [rational(1, 2), rational(11, 20)], 3),
        (builtin("struck-free-bar"), "mu", [rational(2, 1), rational(21, 10)], 4),
        (scene(strained), "m", [rational(1, 2), rational(21, 40)], 6),
    ] {
        let (scaled, symbol_of) = (problem.scaled().unwrap(), Symbol::new(symbol).unwrap());
        for (place, quantity) in problem.observables().iter().enumerate() {
            let over = Over::new(scaled, quantity, (&symbol_of, ends.each_ref())).unwrap();
            let modes = match over.modes(count) {
                Err(error) => {
                    assert!(quantity.contains("energy"), "{quantity}: {error}");
                    continue;
                }
                Ok(modes) => modes,
            };
            let grid = Over::grid(&[&over]).unwrap();
            let length = over.length(&grid.step).unwrap();
            let (grid, parts) = modes.split(&grid, &length).unwrap();
            let told = modes.on_cells(&grid, 24, &length).unwrap();
            // One cell alone is the same function.
            let alone = modes.on_cell(&grid, 17, &length).unwrap().less(&told[17]);
            let off = alone.coefficients.iter().map(|own| own.magnitude());
            let off = off.fold(Magnitude::ZERO, |sum, own| sum.add(&own));
            assert!(off <= alone.error, "{quantity}");
            for share in [rational(0, 1), rational(2, 7), rational(1, 1)] {
                let own = at(ends.each_ref(), &share);
                let single = problem.substituted(symbol, own.clone()).unwrap();
                let single = Modes::new(single.network().unwrap(), count).unwrap();
                let length = Over::new(scaled, quantity, (&symbol_of, [&own; 2])).unwrap();
                let [_, per_unit] = length.in_steps(&Fraction::one(), &grid.step).unwrap();
                let parameter = &share * rational(2, 1) - rational(1, 1);
                for (number, on_step) in told.iter().enumerate() {
                    let x = rational(3, 7);
                    let time = (rational(number as i64, 1) + &x) / rational(parts as i64, 1);
                    let time = time / &per_unit;
                    let exact = single.values(place, &[time.to_f64().unwrap()]).unwrap()[0];
                    let here = of_step(on_step, &x, &parameter);
                    let rounded = Ball::from_rational(&Rational::from_float(exact).unwrap(), FINE)
                        .widened(&Magnitude::power_of_two(-44));
                    let least = Magnitude::power_of_two(-12);
                    assert!(*here.radius() < least, "{quantity} {number}: {:?}", here.to_double());
                    assert!(
                        here.subtract(&rounded, FINE).contains_zero(),
                        "{quantity} at t = {time}, {symbol} = {own}: {:?}, not {exact}",
                        here.to_double()
                    );
                    compared += 1;
                }
            }
        }
    }
    assert!(compared >= 24 * 3 * 12, "{compared}");
}

/// With a mass `1` on a bar of the impedance `1` and the travel time `μ` that is held, `cos ωμ = ω sin ωμ`.
#[test]
fn frequencies_over_a_symbol_hold_roots_of_their_equation() {
    let ends = [rational(1, 1), rational(6, 5)];
    let travel = Varying::between(ends.each_ref(), BITS);
    let parts =
        [Part::Mass { mass: Varying::one() }, Part::Bar { impedance: Varying::one(), travel }];
    for near in [0.809405810, 3.136567885, 5.865500138] {
        let told = frequency(&parts, [false, true], near).unwrap();
        for parameter in [rational(-1, 1), rational(3, 7), rational(1, 1)] {
            let travel = at(ends.each_ref(), &((&parameter + rational(1, 1)) / rational(2, 1)));
            let equation = |frequency: Binary| {
                let frequency = Ball::new(frequency, Magnitude::ZERO);
                let angle = frequency.multiply_rational(&travel, FINE);
                let (cosine, sine) = angle.cos_sin(FINE).unwrap();
                cosine.subtract(&frequency.multiply(&sine, FINE), FINE).sign().unwrap()
            };
            let own = of_varying(&told, &parameter);
            assert!(*own.radius() < Magnitude::power_of_two(-16), "{:?}", own.to_double());
            let (low, high) = own.endpoints();
            assert_ne!(equation(low), equation(high), "{:?}", own.to_double());
        }
    }
    // What is not near a frequency is none.
    assert!(frequency(&parts, [false, true], 2.0).is_err());
}

/// The window of a scene.
type Window<'a> = &'a dyn Fn(&Problem) -> Result<[Rational; 2], ProblemError>;

fn asked<'a>(
    range: &'a SymbolRange,
    simpler: &[&str],
    (quantity, tolerance): (&'a str, Rational),
    window: Window<'a>,
) -> MapRequest<'a> {
    let simpler = simpler.iter().map(|own| own.parse().unwrap()).collect();
    MapRequest { range, points: 5, quantity, simpler, tolerance, window, has_usual_end: false }
}

/// How far an answer is off at one value, over the largest value, by the search of single values.
fn off(
    problem: &Problem,
    quantity: &str,
    simpler: &Simpler,
    window: [&Rational; 2],
) -> [Rational; 2] {
    let wanted = problem.wanted(quantity).unwrap();
    let other = problem.simpler(simpler).unwrap();
    let difference = problem.difference_on(&other, &wanted, window, Purpose::Search).unwrap();
    let whole = problem.signal_on(&wanted, window, Purpose::Search).unwrap();
    let size = |signal: &dyn wavestep::signal::Signal| {
        Size::of(signal, (9, 1 << 12), &rational(1, 1 << 40)).unwrap()
    };
    size(&*difference).over(&size(&*whole)).unwrap()
}

/// Neither a claim nor its opposite is proven of values with a border between them; of those at one side one is.
#[test]
fn nothing_is_proven_across_a_border() {
    let fixed = || ("mass-on-fixed-bar", "mu", 2);
    for ((name, symbol, to), simpler, quantity, tolerance, border, is_below) in [
        (fixed(), "third", "velocity", rational(1, 10), rational(3258, 10_000), true),
        (fixed(), "endless:rod.right", "velocity", rational(1, 10), rational(9737, 10_000), false),
        // Beyond the border the wave that makes the strain large comes too late for the window.
        (fixed(), "third", "strain_impact", rational(7, 10), rational(1, 1), true),
        (fixed(), "echoes:1", "velocity", rational(1, 10), rational(4859, 10_000), false),
        // Contacts open.
        (
            ("saint-venant", "mu", 3),
            "closed",
            "velocity",
            rational(1, 10),
            rational(16_667, 10_000),
            true,
        ),
        (
            ("mass-on-free-bar", "m", 4),
            "endless:rod.right",
            "velocity",
            rational(1, 10),
            rational(9160, 10_000),
            true,
        ),
    ] {
        let problem = Problem::builtin(name).unwrap();
        let range: SymbolRange = format!("{symbol}=1/10..10").parse().unwrap();
        let window = |_: &Problem| Ok([rational(0, 1), rational(to, 1)]);
        // Below its border it is enough, or above it.
        let asked = asked(&range, &[], (quantity, tolerance), &window);
        let simpler: Simpler = simpler.parse().unwrap();
        let [far, low, high, beyond] = [90, 99, 101, 110].map(|part| &border * rational(part, 100));
        for claimed in [Claimed::Enough, Claimed::NotEnough] {
            let proven = |ends: [&Rational; 2]| {
                problem.prove_between(&asked, ends, &[(&simpler, claimed)], &|_| {}).remove(0)
            };
            let open = proven([&low, &high]).expect_err("a border lies between");
            let [from, to] = open.parts()[0].clone();
            assert!(low <= from && from < to && to <= high && &to - &from < rational(1, 1000));
            assert_eq!(
                proven([&far, &low]).is_ok(),
                (claimed == Claimed::Enough) == is_below,
                "{simpler}"
            );
            assert_eq!(
                proven([&high, &beyond]).is_ok(),
                (claimed == Claimed::Enough) != is_below,
                "{simpler}"
            );
        }
    }
}

/// At `z = 1` one of two waves is not seen, and what is seen is zero at both ends of a range: other arrivals are the first
/// there, and what cannot be compared at the ends is not taken for proven between them.
#[test]
fn arrivals_that_vanish_are_not_counted() {
    let mixed = scene(
        "scene \"Mixed\"
        symbol z > 0
        bar s { impedance = 1, travel = 1, velocity = 1 }
        bar a { impedance = 1, travel = 4 }
        bar b { impedance = 6/5 }
        line free - s - a - b - endless
        observe moved = displacement(a.at(1/2)) + (1-z)/10*velocity(s.at(1/3))
        observe nothing = (z-1)*(z-2)*velocity(a.at(1/2))",
    );
    let window = |_: &Problem| Ok([rational(0, 1), rational(30, 1)]);
    let range: SymbolRange = "z=1/2..2".parse().unwrap();
    let request = asked(&range, &[], ("moved", rational(1, 5)), &window);
    let six: Simpler = "echoes:6".parse().unwrap();
    let proven = |from, to| {
        mixed.prove_between(&request, [&from, &to], &[(&six, Claimed::Enough)], &|_| {}).remove(0)
    };
    proven(rational(9, 10), rational(99, 100)).unwrap();
    let [from, to] = proven(rational(9, 10), rational(11, 10)).unwrap_err().parts()[0].clone();
    assert!(from < rational(1, 1) && rational(1, 1) <= to && to < rational(1001, 1000));
    let zero_to = [rational(0, 1), rational(30, 1)];
    let there = mixed.substituted("z", rational(1, 1)).unwrap();
    assert!(off(&there, "moved", &six, zero_to.each_ref())[0] > rational(7, 10));

    let range: SymbolRange = "z=1..2".parse().unwrap();
    let request = MapRequest {
        points: 2,
        ..asked(&range, &["echoes:20"], ("nothing", rational(1, 5)), &window)
    };
    let map = mixed.map_enough(&request, &|_| {}).unwrap();
    let states: Vec<_> = map.runs.iter().map(|run| run.state).collect();
    assert_eq!(states, [None, Some(0), None], "{:?}", map.runs);
}

/// Where the place of a quantity is left out, its name may be that of a wave: the model does not suit, and leaves nothing open.
#[test]
fn models_without_the_place_do_not_suit() {
    let parts = scene(
        "scene \"Three bars\"
        symbol mu > 0
        bar a { impedance = 1, travel = 1, velocity = 1 }
        bar b { impedance = mu, travel = 1 }
        bar c { impedance = 1, travel = 1 }
        line free - a - b - c - free
        observe v = velocity(a.left)
        observe f = force(b.right)",
    );
    let range: SymbolRange = "mu=1..3".parse().unwrap();
    let window = |_: &Problem| Ok([rational(0, 1), rational(6, 1)]);
    let simpler = ["endless:a.right", "echoes:4"];
    let request = asked(&range, &simpler, ("f", rational(1, 10)), &window);
    let map = parts.map_enough(&MapRequest { points: 3, ..request }, &|_| {}).unwrap();
    assert_eq!((map.runs.len(), map.runs[0].state, &map.open), (1, Some(1), &vec![vec![]]));
}

/// In each part of a map of which it is proven for all values, the answer it names keeps to the tolerance at values that the
/// map has not seen, and those before it do not.
#[test]
fn proven_parts_of_maps_hold_at_other_values() {
    let until_four = |_: &Problem| Ok([rational(0, 1), rational(4, 1)]);
    let usual = |problem: &Problem| Ok([rational(0, 1), problem.usual_length()?]);
    let driven = "scene \"Driven\"
        symbol mu > 0
        load push { force = sin(2*t)*exp(-t/3) }
        bar rod { impedance = mu, travel = 1 }
        mass block { mass = 1 }
        support ground { stiffness = 3 }
        line free - push - rod - block - ground - free
        observe force = force(rod.right)";
    let on_fixed_bar = || Problem::builtin("mass-on-fixed-bar").unwrap();
    let cushioned = || Problem::builtin("cushioned-impact").unwrap();
    for (problem, has_usual_end, quantity, simpler, tolerance, count) in [
        (on_fixed_bar(), false, "velocity", &["third", "endless:rod.right"][..], rational(1, 5), 3),
        (on_fixed_bar(), false, "strain_impact", &["echoes:1", "echoes:2"], rational(1, 5), 3),
        // The rigid striker is enough again beyond 1.35, which no value of the table shows.
        (cushioned(), false, "force", &["rigid:striker", "spring:striker"], rational(1, 10), 5),
        (on_fixed_bar(), true, "velocity", &["modes:1", "modes:3"], rational(1, 10), 2),
        // The window is as long as the bar.
        (on_fixed_bar(), true, "velocity", &["third", "echoes:2"], rational(1, 4), 2),
        (scene(driven), true, "force", &["echoes:1", "echoes:2"], rational(1, 2), 2),
    ] {
        let name = problem.title().to_owned();
        let range: SymbolRange = "mu=1/2..3".parse().unwrap();
        let window: Window<'_> = if has_usual_end { &usual } else { &until_four };
        let asked = asked(&range, simpler, (quantity, tolerance.clone()), window);
        let asked = MapRequest { has_usual_end, ..asked };
        let map = problem.map_enough(&asked, &|_| {}).unwrap();
        assert!(map.runs.len() >= count, "{name}: {:?}", map.runs);
        for (run, open) in map.runs.iter().zip(&map.open) {
            assert_eq!(open, &[], "{name}: {run:?}");
            let [from, to] = &run.between;
            for place in [rational(1, 1000), rational(13, 97), rational(5, 9), rational(997, 1000)]
            {
                let own = problem.substituted("mu", at([from, to], &place)).unwrap();
                for (number, simpler) in map.simpler.iter().enumerate() {
                    let window = window(&own).unwrap();
                    let [least, most] = off(&own, quantity, simpler, window.each_ref());
                    match run.state {
                        Some(first) if number == first => assert!(most <= tolerance),
                        Some(first) if number > first => {}
                        _ => assert!(least > tolerance, "{name}: {simpler} at {:?}", own.values()),
                    }
                }
            }
        }
    }
}

/// What is not followed over a symbol is told with its reason, not taken for proven.
#[test]
fn what_is_not_followed_over_a_symbol_is_told() {
    let zero_to_two = |_: &Problem| Ok([rational(0, 1), rational(2, 1)]);
    let usual = |problem: &Problem| Ok([rational(0, 1), problem.usual_length()?]);
    let apart = "scene \"Apart\"
        symbol a > 0
        bar one { impedance = 1, travel = a, velocity = 1 }
        bar two { impedance = 2, travel = 1 }
        line free - one - two - fixed
        observe force = force(two.right)";
    let apart = || scene(apart);
    let driven = |drive: &str| {
        scene(&format!(
            "scene \"Driven\"
            symbol z > 0
            load push {{ {drive} }}
            bar rod {{ impedance = z, travel = 1 }}
            line free - push - rod - fixed
            observe force = force(rod.right)"
        ))
    };
    let hidden = |travel: &str, far: &str| {
        scene(&format!(
            "scene \"Hidden\"
            symbol mu > 0
            bar rod {{ impedance = 1, travel = {travel}, velocity = 1 }}
            bar east {{ impedance = 2 }}
            line free - rod - east - endless
            observe v = velocity(rod.right)
            observe far = velocity(east.at({far}))"
        ))
    };
    let builtin = |name| Problem::builtin(name).unwrap();
    let dented = "scene \"Dented\"
        symbol a > 0
        bar striker { impedance = 1, travel = 1, velocity = 1 }
        hertz dome { stiffness = a }
        bar rod { impedance = 1 }
        line free - striker - dome - rod - endless
        observe force = force(dome)";
    let pulled = "scene \"Pulled\"
        symbol k > 0
        bar striker { impedance = 1, travel = 1/4, velocity = 1 }
        load pull { force = k/9 }
        bar long { impedance = 1 + k }
        line free - striker | pull - long - endless
        contacts open
        observe force = force(long.left)";
    let cases: [(Problem, &str, &str, &str, Window<'_>, &str); 10] = [
        (driven("force = t^20"), "z", "force", "echoes:1", &zero_to_two, "`push` is not supported"),
        (
            builtin("striker-on-long-bar"),
            "r",
            "interface_velocity",
            "modes:1",
            &zero_to_two,
            "no modes of vibration",
        ),
        (
            builtin("mass-on-fixed-bar"),
            "mu",
            "energy",
            "echoes:1",
            &zero_to_two,
            "echoes cannot be counted",
        ),
        (apart(), "a", "force", "third", &usual, "the default window changes"),
        // Usual windows are as long as it takes to come to all places, which at both ends does not count.
        (
            hidden("1", "16/(mu + 1/mu)"),
            "mu",
            "v",
            "echoes:4",
            &usual,
            "the default window changes",
        ),
        (hidden("mu + 1/mu", "20"), "mu", "v", "echoes:4", &usual, "the default window changes"),
        (scene(dented), "a", "force", "rigid:striker", &zero_to_two, "local contacts are not"),
        // What it acts on has no mass once the contact is open.
        (scene(pulled), "k", "force", "rigid:striker", &zero_to_two, "a contact that opens"),
        (apart(), "a", "force", "endless:one.left", &zero_to_two, "no common divisor"),
        (builtin("mass-on-fixed-bar"), "mu", "velocity", "without:rod", &zero_to_two, ""),
    ];
    for (problem, symbol, quantity, simpler, window, why) in cases {
        let range: SymbolRange = format!("{symbol}=1/2..3").parse().unwrap();
        let asked = asked(&range, &[], (quantity, rational(1, 10)), window);
        let asked = MapRequest { has_usual_end: why.contains("window"), ..asked };
        let simpler: Simpler = simpler.parse().unwrap();
        for claimed in [Claimed::Enough, Claimed::NotEnough] {
            let ends = [&rational(1, 2), &rational(3, 1)];
            match problem.prove_between(&asked, ends, &[(&simpler, claimed)], &|_| {}).remove(0) {
                Err(unproven) => {
                    assert!(format!("{unproven:?}").contains(why), "{simpler}: {unproven:?}");
                }
                // Without the bar the mass goes on: that is never enough.
                Ok(()) => assert!(why.is_empty() && claimed == Claimed::NotEnough, "{simpler}"),
            }
        }
    }
}
