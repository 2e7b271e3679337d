//! Zeros that no precision tells from small values: double roots of squares, and beginnings that are flat.

use wavestep::ball::Ball;
use wavestep::language::{Source, read_scene};
use wavestep::network::Network;
use wavestep::planner::{Purpose, of_scene};
use wavestep::problem::Simpler;
use wavestep::scenes::SCENES;
use wavestep::signal::{At, Compiled, Evaluator as _, Limit, Near};
use wavestep::{Error, Goal, Place, Problem, Root, Value};
use wavestep_polynomial::Rational;

const DIGITS: usize = 20;

/// A bar in which waves are driven by a force that begins with zero, a spring, and another bar.
const RAMP: &str = "scene \"A ramp\"\nmaterial steel { wave_speed = 5 km/s, density = 8000 kg/m^3 }\n\
    bar in { material = steel, diameter = 19 mm, length = 2 m }\n\
    spring k { stiffness = 700 kN/mm }\n\
    bar out { material = steel, diameter = 19 mm, length = 2 m }\n\
    load ramp { force = 198000000*t N, from = 0 us, until = 20 us }\n\
    line free - ramp - in - k - out - free\n\
    observe gauge = strain(out.at(1/2))\nobserve held = energy(out)\n";

/// Masses on both sides of a spring, then a bar on a damper: at the start only the first mass moves.
const PILE: &str = "scene \"A pile\"\nmaterial steel { modulus = 210 GPa, density = 7850 kg/m^3 }\n\
    mass ram { mass = 8000 kg, velocity = 5 m/s }\nspring cushion { stiffness = 2 GN/m }\n\
    mass helmet { mass = 1200 kg }\n\
    bar shaft { material = steel, diameter = 610 mm, inner_diameter = 580 mm, length = 30 m }\n\
    support toe { damping = 200 kN*s/m, stiffness = 100 MN/m }\n\
    line free - ram - cushion - helmet - shaft - toe - free\n\
    observe held = energy(shaft)\nobserve toe_energy = energy(toe)\nobserve sinks = displacement(shaft.right)\n";

/// A bar struck by a mass of 1e-9 under a force of 1e9: the fast motion has died out after a few nanoseconds.
const LIGHT: &str = "scene \"A light mass under a large force\"\nload weight { force = 1e9 }\n\
    mass hammer { mass = 1e-9, velocity = 1 }\nbar rod { impedance = 1, travel = 1 }\n\
    line free - weight - hammer | rod - fixed\ncontacts open\n\
    observe way = displacement(hammer)\nobserve all = energy(line)\nobserve wall = strain(rod.right)\n";

fn read(text: &str) -> Result<Problem, Error> {
    Problem::read("scene", text)
}

fn times(roots: &[Root]) -> Vec<&Value> {
    let mut times = Vec::new();
    for root in roots {
        if let Root::Simple { time, .. } | Root::Double { time } = root {
            times.push(time);
        }
    }
    times
}

/// `F²/(2k)` and `k u²/2` are zero where force and displacement are, each root a double one, and nothing is open.
#[test]
fn an_energy_is_zero_where_what_is_squared_is() -> Result<(), Error> {
    let hopkinson = read(
        "scene \"Bars\"\nbar a { impedance = 1, travel = 1, velocity = 1 }\nspring k { stiffness = 2 }\n\
         bar b { impedance = 2, travel = 3/2 }\nline free - a - k - b - free\n\
         observe force = force(k)\nobserve held = energy(k)\nobserve other = 2*energy(k)\n",
    )?;
    let opens = read(
        "scene \"Drill\"\nbar piston { impedance = 1, travel = 1, velocity = 1 }\n\
         bar rod { impedance = 2/3, travel = 4 }\nsupport rock { stiffness = 1/2, damping = 1/8 }\n\
         line free - piston | rod - rock - free\ncontacts open\n\
         observe sinks = displacement(rod.right)\nobserve held = energy(rock)\n",
    )?;
    let drill = [("0", "20"), ("sinks", "held")];
    let bars = [("0", "12"), ("force", "held")];
    let twice = [("0", "12"), ("force", "other")];
    for (problem, [(from, to), (of, energy)]) in
        [(&opens, drill), (&hopkinson, bars), (&hopkinson, twice)]
    {
        let known = problem.signal(of)?.roots(from..=to, DIGITS)?;
        let signal = problem.signal(energy)?;
        let found = signal.roots(from..=to, DIGITS)?;
        assert_eq!((known.undecided(), found.undecided()), (0, 0), "{energy}");
        let digits =
            |roots: &[Root]| times(roots).iter().map(ToString::to_string).collect::<Vec<_>>();
        assert_eq!(digits(&found.all), digits(&known.all), "{energy}");
        assert!(times(&found.all).len() > 1, "{energy}");
        assert!(
            found.all.iter().all(|root| !matches!(root, Root::Simple { .. } | Root::Jump { .. }))
        );
        let least = signal.extremum(Goal::Smallest, from..=to, DIGITS)?;
        assert_eq!(least.value.exact(), Some(&wavestep::Rational::default()), "{energy}");
        let critical = |place: &&Place| matches!(place, Place::Critical(_));
        assert_eq!(least.places.iter().filter(critical).count(), times(&found.all).len());
        for time in times(&found.all) {
            let [before, after] = time.bounds();
            for time in [before, after] {
                let [from, to] = signal.at(time, 5)?.bounds();
                assert!(from >= wavestep::Rational::default(), "{from} to {to}");
                assert!(
                    to.clone() < wavestep::Rational::new(1.into(), 1_000_000_000.into()),
                    "{to}"
                );
            }
        }
    }
    Ok(())
}

/// A square that jumps where what is squared jumps over zero has no root there, and the least value of one without a root
/// is no zero.
#[test]
fn a_square_has_no_roots_but_those() -> Result<(), Error> {
    let mass = read(
        "scene \"A mass in a bar that moves\"\nbar a { impedance = 1, travel = 1, velocity = 1 }\n\
         mass m { mass = 1, velocity = 1 }\nbar b { impedance = 1, travel = 1, velocity = 1 }\n\
         line free - a - m - b - free\nobserve held = energy(m)\n",
    )?;
    let signal = mass.signal("held")?;
    assert!(signal.roots(0..=5, DIGITS)?.all.is_empty());
    let least = signal.extremum(Goal::Smallest, 0..=5, DIGITS)?;
    assert_eq!(least.value.exact(), Some(&wavestep::Rational::new(1.into(), 2.into())));
    Ok(())
}

/// The energy of a local contact is a product of two quantities: of its force, which is zero while it is open, and its
/// compression, which is not.
#[test]
fn a_product_is_no_square() -> Result<(), Error> {
    let balls = read(
        "scene \"Two masses\"\nmass a { mass = 1, velocity = 1 }\nhertz between { stiffness = 1 }\n\
         mass b { mass = 2 }\nline free - a - between - b - free\n\
         observe held = energy(between)\nobserve gap = compression(between)\n",
    )?;
    let found = balls.signal("held")?.roots(0..=10, DIGITS)?;
    let Some(Root::Interval { to, closed: true, .. }) = found.all.last() else {
        panic!("{:?}", found.all);
    };
    assert_eq!(to.to_f64(), 10.0);
    assert!(times(&found.all).is_empty(), "{:?}", found.all);
    Ok(())
}

/// What has died out below all doubles rounds to zero, whatever stretches a finer history would have.
#[test]
fn what_has_died_out_rounds_to_zero() -> Result<(), Error> {
    let light = read(LIGHT)?;
    let signal = light.signal("wall")?;
    let values =
        signal.values(&["0", "1", "3", "4", "9/2"], wavestep::Tolerance::Relative(1e-9))?;
    assert_eq!(values.values, [0.0, -2.0, -2_000_000_002.0, 0.0, 0.0]);
    Ok(())
}

/// What begins as a power of the time since an arrival is zero there, and nowhere near.
#[test]
fn a_flat_beginning_is_one_zero() -> Result<(), Error> {
    for (text, names) in [(RAMP, &["gauge", "held"][..]), (PILE, &["held", "toe_energy", "sinks"])]
    {
        for name in names {
            let problem = read(text)?;
            let signal = problem.signal(name)?;
            let found = signal.roots("0 ms"..="3 ms", DIGITS)?;
            assert_eq!(found.undecided(), 0, "{name}: {:?}", found.all);
            // Whatever comes first is at the start.
            let (Root::End { time } | Root::Interval { from: time, .. }) = &found.all[0] else {
                panic!("{name}: {:?}", found.all);
            };
            assert_eq!(time.to_f64(), 0.0);
        }
    }
    Ok(())
}

/// A mass that meets a spring at rest loses velocity and energy with slope zero at first: both are largest at the start, and
/// nowhere near, where contacts open too.
#[test]
fn what_leaves_its_start_with_slope_zero_is_largest_there() -> Result<(), Error> {
    let text = PILE.replace("line free - ram - cushion", "line free - ram | cushion")
        + "contacts open\nobserve falls = velocity(ram)\nobserve has = energy(ram)\n";
    let problem = read(&text)?;
    for (name, largest) in [("falls", 5), ("has", 100_000)] {
        let found = problem.signal(name)?.extremum(Goal::Largest, "0 ms"..="2 ms", DIGITS)?;
        assert_eq!(found.value.to_f64(), f64::from(largest), "{name}");
        let [Place::End(time)] = &found.places[..] else { panic!("{name}: {:?}", found.places) };
        assert_eq!(time.to_f64(), 0.0);
    }
    Ok(())
}

/// What has decayed to 2^−433 is not told from zero by the first enclosures, and nowhere taken for it.
#[test]
fn what_is_small_is_no_zero() -> Result<(), Error> {
    let struck = read(
        "scene \"A mass on a long bar that moves\"\nmass hammer { mass = 1, velocity = 2 }\n\
         bar rod { impedance = 1, travel = 1000, velocity = 1 }\n\
         mass stop { mass = 1, velocity = 2 }\nline free - hammer - rod | stop - free\ncontacts open\n\
         observe v = velocity(hammer) - velocity(rod.right)\n",
    )?;
    let found = struck.signal("v")?.roots(1..=300, DIGITS)?;
    let is_open = |root: &Root| matches!(root, Root::Undecided { .. });
    assert!(found.all.iter().all(is_open), "{:?}", found.all);
    Ok(())
}

/// A spring that lets go is unstrained from there on, and was not before.
#[test]
fn a_spring_that_lets_go_is_unstrained() -> Result<(), Error> {
    let cushion = Problem::builtin("cushion-with-release")?.with("mu", "3/2")?;
    let found = cushion.signal("compression")?.roots(0..=10, DIGITS)?;
    let [Root::End { .. }, Root::Interval { from, .. }] = &found.all[..] else {
        panic!("{:?}", found.all);
    };
    let events = cushion.events(DIGITS)?;
    let opening = &events.events[1].time;
    assert_eq!(from.to_f64(), opening.to_f64());
    Ok(())
}

/// With a damper the force comes to zero while the spring is still strained.
#[test]
fn a_damped_spring_is_strained_when_it_lets_go() {
    for (damping, is_zero) in [("0", true), ("1/2", false)] {
        let text = format!(
            "scene \"A cushion\"\nmass hammer {{ mass = 1, velocity = 1 }}\n\
             spring cushion {{ stiffness = 1, damping = {damping} }}\nbar rod {{ impedance = 1 }}\n\
             line free - hammer | cushion - rod - endless\ncontacts open\n\
             observe compression = compression(cushion)\n"
        );
        let scene = read_scene(&Source::new("scene", text).unwrap(), &Default::default()).unwrap();
        let network = Network::new(&scene).unwrap();
        let window = [0, 10].map(|time| wavestep::Rational::from_integer(time.into()));
        let observed = &network.observables()[0];
        let signal =
            of_scene(&network, observed, window.each_ref(), Purpose::Search).expect("a signal");
        let known = (0..signal.count().unwrap()).map(|stretch| {
            let value = signal.exact(stretch, At::End(Limit::Left)).unwrap();
            value.is_some_and(|value| value == wavestep::Rational::default())
        });
        assert_eq!(
            known.clone().any(|is_zero| is_zero),
            is_zero,
            "{:?}",
            known.collect::<Vec<_>>()
        );
    }
}

/// What the line holds is what the force has done, and enclosures do not grow at the rate of what has died out.
#[test]
fn energies_keep_their_digits_beside_a_light_mass() -> Result<(), Error> {
    let light = read(LIGHT)?;
    let number = |value: Value| wavestep::Rational::from(value.decimal(30).0.to_rational());
    let work = wavestep::Rational::from_integer(1_000_000_000.into());
    let first = wavestep::Rational::new(1.into(), 2_000_000_000.into());
    for time in ["1e-9", "1e-6", "1/1000", "1/2", "1", "3", "7/2"] {
        let (way, all) = (light.signal("way")?.at(time, 30)?, light.signal("all")?.at(time, 30)?);
        let (way, all) = (number(way), number(all));
        let off = &all - (&way * &work + &first);
        let most = &all / wavestep::Rational::from_integer(num_bigint::BigInt::from(10).pow(28));
        assert!(off <= most && -off <= most, "at {time}: {all} of {way}");
    }
    let found = light.signal("all")?.extremum(Goal::Largest, 0..=2, 10)?;
    assert_eq!(found.places.len(), 1);
    Ok(())
}

/// A polynomial that reaches beyond its stretch holds the function that goes on there.
#[test]
fn polynomials_hold_beyond_their_stretches() {
    let text = "scene \"A mass on a long bar\"\nmass hammer { mass = 1, velocity = 1 }\n\
        bar rod { impedance = 1, travel = 1000 }\nline free - hammer | rod - free\ncontacts open\n\
        observe v = velocity(hammer)\n";
    let scene = read_scene(&Source::new("scene", text).unwrap(), &Default::default()).unwrap();
    let network = Network::new(&scene).unwrap();
    let window = [0, 20].map(|time| wavestep::Rational::from_integer(time.into()));
    let observed = &network.observables()[0];
    let signal = of_scene(&network, observed, window.each_ref(), Purpose::Stretches).unwrap();
    assert!(signal.count().unwrap() > 2);
    let ends = [Limit::Right, Limit::Left].map(|end| signal.exact_time(1, end).unwrap());
    let [length, middle] = [&ends[1] - &ends[0], ends[1].clone()];
    for (reach, is_sharp) in [((1, 4096), true), ((1, 1), false), ((8, 1), false)] {
        let half = &length * wavestep::Rational::new(reach.0.into(), reach.1.into());
        let near = Near { order: 0, place: (&middle, &half), terms: 200, bits: 192 };
        let taylor = signal.taylor(1, near).unwrap();
        for u in [-1, 0, 1].map(|u| wavestep::Rational::from_integer(u.into())) {
            let time = Ball::from_rational(&-(&middle + &half * &u), 400);
            let off = taylor.value(&Ball::from_rational(&u, 400), 400);
            let off = off.subtract(&time.exp(400).unwrap(), 400);
            assert!(off.contains_zero(), "{reach:?} of {length} at {u}: {off}");
            let is_small = *off.radius() < wavestep::ball::Magnitude::power_of_two(-100);
            assert!(is_small || !is_sharp, "{off}");
        }
    }
}

/// What is said to vanish at an end of a stretch does, of all observables of the shipped scenes and of their differences from
/// simpler ones; other derivatives than those do not.
#[test]
fn what_is_flat_vanishes() -> Result<(), Error> {
    const BITS: u64 = 400;
    let (mut flat, mut told) = (0, 0);
    for scene in &SCENES {
        let mut problem = Problem::builtin(scene.name)?;
        let symbols: Vec<String> = problem.symbols().iter().map(ToString::to_string).collect();
        for symbol in symbols {
            problem = problem.with(&symbol, "3/2")?;
        }
        let Some(period) = problem.shortest_period() else { continue };
        let [from, to] = [Rational::default(), period * Rational::from_integer(4.into())];
        let simpler: Vec<Problem> = ["third", "rigid"]
            .iter()
            .filter_map(|simpler| match simpler.parse() {
                Ok(Simpler::Scene(changes)) => problem.changed(&changes).ok(),
                _ => None,
            })
            .collect();
        for name in problem.observables() {
            let wanted = problem.wanted(name)?;
            let window = [&from, &to];
            let mut signals = vec![problem.signal_on(&wanted, window, Purpose::Search)?];
            let differences = simpler.iter().filter_map(|other| {
                problem.difference_on(other, &wanted, window, Purpose::Search).ok()
            });
            signals.extend(differences);
            for signal in &signals {
                let Ok(count) = signal.count() else { continue };
                for stretch in (0..count).take(6).filter(|stretch| !signal.is_instant(*stretch)) {
                    for (end, order) in
                        [Limit::Right, Limit::Left].into_iter().flat_map(|end| [(end, 0), (end, 1)])
                    {
                        let zeros = signal.flatness(stretch, end, order)?;
                        told += 1;
                        flat += usize::from(zeros > 0);
                        for order in order..order + zeros {
                            let value = signal.enclose(stretch, order, At::End(end), BITS)?;
                            assert!(
                                value.contains_zero(),
                                "{}: derivative {order} of {name} at {end:?} of {stretch}",
                                scene.name
                            );
                        }
                    }
                }
            }
        }
    }
    assert!(flat > 100 && told > 500, "{flat} of {told}");
    Ok(())
}

/// Two halves of a line that are mirror images: what one has, the other has.
const MIRRORED: &str = "scene \"Mirrored\"\nmass one { mass = 1/3, velocity = 1 }\n\
    bar a { impedance = 1, travel = 1, velocity = 1 }\nspring soft { stiffness = 2 }\n\
    bar b { impedance = 1, travel = 1, velocity = -1 }\nmass other { mass = 1/3, velocity = -1 }\n\
    line free - one - a - soft - b - other - free\n\
    observe differ = energy(a) - energy(b)\nobserve carried = momentum(line)\n";

/// Terms that cancel on every stretch are proven to; a little more of one of them, and they do not.
#[test]
fn energies_that_cancel_are_zero() -> Result<(), Error> {
    let mirrored = read(MIRRORED)?;
    let roots = mirrored.signal("differ")?.roots(0..=5, 9)?.all;
    assert!(matches!(&roots[..], [Root::Interval { .. }]), "{roots:?}");
    for goal in [Goal::Largest, Goal::Smallest] {
        let extremum = mirrored.signal("differ")?.extremum(goal, 0..=5, 9)?;
        assert_eq!(extremum.value, Value::Exact(Rational::default()));
    }
    let other = MIRRORED.replace("velocity = -1 }\nmass", "velocity = -1001/1000 }\nmass");
    let extremum = read(&other)?.signal("differ")?.extremum(Goal::Smallest, 0..=5, 9)?;
    assert!(extremum.value.to_f64() < -1e-3, "{:?}", extremum.value);
    Ok(())
}

/// Polynomials of what is zero on all of a window are zero, with a bound that is.
#[test]
fn what_cancels_compiles_to_zero() -> Result<(), Error> {
    let held = "scene \"Held\"\nload push { velocity = 1/5*exp(-5/7*t), from = 1/2, until = 5/2 }\n\
        mass m { mass = 2, velocity = 5/7 }\nbar rod { impedance = 3, travel = 1, velocity = 2 }\n\
        line free - push - m - rod - free\nobserve v = velocity(rod.left)\nobserve k = energy(m)\n";
    for (text, name, window) in [
        (held, "v", [3, 5]),
        (held, "k", [3, 5]),
        (MIRRORED, "differ", [0, 5]),
        (MIRRORED, "carried", [0, 5]),
    ] {
        let problem = read(text)?;
        let network = problem.network().unwrap();
        let observed = network.observables().iter().find(|own| own.name == name).unwrap();
        let [from, to] = window.map(|end: i32| Rational::from_integer(end.into()));
        let signal = of_scene(network, observed, [&from, &to], Purpose::Polynomials).unwrap();
        let compiled = Compiled::new(&*signal, None).unwrap();
        assert_eq!(compiled.bound(), Some(0.0), "{name}");
        let mut values = [1.0; 3];
        compiled.values(&[3.0, 3.7, 4.9], &mut values).unwrap();
        assert_eq!(values, [0.0; 3], "{name}");
    }
    Ok(())
}

/// A front that arrives at the last instant of a window counts: what vanishes before it is not zero there.
#[test]
fn what_arrives_at_the_end_is_not_left_out() -> Result<(), Error> {
    let text = "scene \"Late\"\nload one { force = 1 }\nload extra { force = 1, from = 15 }\nload other { force = -1 }\n\
        bar a { impedance = 1, travel = 1/2 }\nbar c { impedance = 2, travel = 1/3 }\n\
        bar b { impedance = 1, travel = 1/2 }\nline free - one - extra - a - c - b - other - free\n\
        observe differ = velocity(a.left) + velocity(b.right)\n";
    let problem = read(text)?;
    let network = problem.network().unwrap();
    let observed = &network.observables()[0];
    for (last, value) in [(14, 0.0), (15, 1.0)] {
        let [from, to] = [0, last].map(|end: i32| Rational::from_integer(end.into()));
        let signal = of_scene(network, observed, [&from, &to], Purpose::Polynomials).unwrap();
        let compiled = Compiled::new(&*signal, None).unwrap();
        let told = compiled.value(&to, Limit::Right).unwrap();
        assert!((told - value).abs() <= compiled.bound().unwrap(), "{told} at {last}");
        assert_eq!(compiled.bound() == Some(0.0), last == 14);
    }
    Ok(())
}

/// An exact zero that takes long formulas with several named rates is told as nothing, with a radius, and soon.
#[test]
fn zeros_of_many_named_rates_have_a_radius() -> Result<(), Error> {
    let text = "scene \"Inches\"\nmass m { mass = 1/2 kg, velocity = 100 in/s }\n\
        spring s { stiffness = 1000 lbf/in, damping = 2 lbf*s/in }\n\
        bar r { modulus = 3e10 N/m^2, density = 7.8 g/cm^3, diameter = 1 in, length = 12 in }\n\
        support q { damping = 1 kg/s, stiffness = 2 J/m^2 }\nline free - m - s - r - q - free\n\
        observe mix = force(q)/2 - force(r.right)/2\n";
    let problem = read(text)?;
    let mix = problem.signal("mix")?;
    assert_eq!(mix.at("0.1 ms", 6)?, Value::Exact(Rational::default()));
    let late = mix.at("1.5 ms", 6)?.to_text(6);
    assert!(late.starts_with("0 ± ") && late.contains("e-1"), "{late}");
    Ok(())
}
