//! Energies as signals: their derivative is the power that flows in, their sum stays where nothing is spent,
//! and their extrema are those of dense samples; where contacts stay closed and where they open.

use wavestep::ball::Ball;
use wavestep::expression::Fraction;
use wavestep::language::{Source, parse_number, read_scene};
use wavestep::network::Network;
use wavestep::planner::{Purpose, of_scene};
use wavestep::problem::{Problem, Values};
use wavestep::signal::{
    At, Effort, EvaluateError, Goal, Limit, Marched, MethodError, Near, Place, Root, Search,
    Signal, Summation, Summed, Value, value,
};
use wavestep_polynomial::Rational;

/// A mass strikes a bar that is held by a spring at its end; what flows into each element is its power.
const STRUCK: &str = "scene \"Struck\"\nmass hammer { mass = 3/2, velocity = 1 }\n\
    bar rod { impedance = 1, travel = 1 }\nspring toe { stiffness = 2 }\nline free - hammer JOINT rod - toe - fixed\n\
    observe rod_energy = energy(rod)\nobserve hammer_energy = energy(hammer)\n\
    observe toe_energy = energy(toe)\nobserve all = energy(line)\n\
    observe force = force(rod.left)\nobserve v = velocity(rod.left)\nobserve speed = velocity(hammer)\n\
    observe end = force(rod.right)\nobserve u = velocity(rod.right)\n";

/// Steel on aluminium in units: travel times have no common measure and are no rational numbers.
const UNITS: &str = "scene \"Steel strikes aluminium\"\n\
    bar a { modulus = 210 GPa, density = 7850 kg/m^3, area = 1 cm^2, length = 1 m, velocity = 1 m/s }\n\
    spring k { stiffness = 30 MN/m }\n\
    bar b { modulus = 70 GPa, density = 2700 kg/m^3, area = 1 cm^2, length = 13/10 m }\n\
    line free - a - k - b - free\n\
    observe a_energy = energy(a)\nobserve b_energy = energy(b)\nobserve all = energy(line)\n\
    observe force = force(b.left)\nobserve v = velocity(b.left)\n";

const BITS: u64 = 160;

fn network(text: &str) -> Network {
    let source = Source::new("scene", text).unwrap();
    Network::new(&read_scene(&source, &Default::default()).unwrap()).unwrap()
}

fn closed() -> Network {
    network(&STRUCK.replace("JOINT", "-"))
}

fn open() -> Network {
    network(&(STRUCK.replace("JOINT", "|") + "contacts open\n"))
}

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn signal<'a>(network: &'a Network, name: &str, last: &Rational) -> Box<dyn Signal + 'a> {
    let observed = network.observables().iter().find(|own| own.name == name).expect("observed");
    of_scene(network, observed, [&Rational::default(), last], Purpose::Stretches).expect("a signal")
}

/// The stretch of a time that is no break.
fn stretch_of(signal: &dyn Signal, at: &Rational) -> usize {
    let begun = |stretch: &usize| {
        let start = signal.time(*stretch, Limit::Right, BITS).unwrap();
        start.subtract(&Ball::from_rational(at, BITS), BITS).sign()
            != Some(std::cmp::Ordering::Greater)
    };
    (0..signal.count().unwrap()).take_while(begun).last().expect("a stretch")
}

fn derivative(signal: &dyn Signal, order: usize, at: &Rational) -> Ball {
    signal.enclose(stretch_of(signal, at), order, At::Time(at), BITS).unwrap()
}

/// Whether two balls are about one number that is known to ten decimals beyond a scale.
fn assert_same(own: &Ball, other: &Ball, scale: f64, what: &str) {
    let off = own.subtract(other, BITS);
    let (_, bound) = off.to_double();
    assert!(off.contains_zero() && bound.to_double() <= 1e-10 * scale, "{what}: {own} {other}");
}

/// `E' = F v` at the ends of a bar, a mass and a spring, and one derivative more by the product of slopes.
#[test]
fn the_derivative_of_an_energy_is_the_power_that_flows_in() {
    for (kind, network) in [("closed", closed()), ("open", open())] {
        let last = rational(7, 1);
        let of = |name| signal(&network, name, &last);
        let [rod, hammer, toe] = ["rod_energy", "hammer_energy", "toe_energy"].map(of);
        let [force, v, speed, end, u] = ["force", "v", "speed", "end", "u"].map(of);
        for n in 0..40 {
            let at = rational(7 * (2 * n + 1), 81);
            let value = |signal: &dyn Signal| derivative(signal, 0, &at);
            let power = |force: &dyn Signal, v: &dyn Signal| value(force).multiply(&value(v), BITS);
            let (left, right) = (power(&*force, &*v), power(&*end, &*u));
            let what = format!("{kind} at {at}");
            assert_same(&derivative(&*rod, 1, &at), &left.subtract(&right, BITS), 1.0, &what);
            assert_same(&derivative(&*toe, 1, &at), &right, 1.0, &what);
            let lost = power(&*force, &*speed).negate();
            assert_same(&derivative(&*hammer, 1, &at), &lost, 1.0, &what);
            let slopes = [(&force, &v, 1), (&end, &u, -1)].map(|(force, v, sign)| {
                let one = derivative(&**force, 1, &at).multiply(&value(&**v), BITS);
                let other = derivative(&**v, 1, &at).multiply(&value(&**force), BITS);
                one.add(&other, BITS).multiply_rational(&rational(sign, 1), BITS)
            });
            let second = slopes[0].add(&slopes[1], BITS);
            assert_same(&derivative(&*rod, 2, &at), &second, 1.0, &what);
        }
    }
}

/// Values by the planner for values are those on stretches, and polynomials enclose both.
#[test]
fn values_stretches_and_polynomials_agree() {
    let networks =
        [("closed", closed(), 5.0), ("open", open(), 5.0), ("units", network(UNITS), 9e-4)];
    for (kind, network, last) in networks {
        let last = Rational::from_float(last).unwrap();
        for observed in network.observables().iter().filter(|own| own.name.ends_with("energy")) {
            let window = [&Rational::default(), &last];
            let values =
                of_scene(&network, observed, window, Purpose::Values { digits: 20 }).unwrap();
            let signal = signal(&network, &observed.name, &last);
            let scale = value(&*values, &(&last / rational(2, 1)), Limit::Right, 9, 4096).unwrap();
            let scale = scale.to_f64().abs().max(0.1);
            for n in 0..12 {
                let at = &last * rational(2 * n + 1, 25);
                let told = value(&*values, &at, Limit::Right, 20, 4096).unwrap().ball(BITS);
                let what = format!("{kind} {} at {at}", observed.name);
                assert_same(&derivative(&*signal, 0, &at), &told, scale, &what);
                // About a time near by, which may lie beyond the stretch.
                let stretch = stretch_of(&*signal, &at);
                let half = &last * rational(1, 1000);
                let place = (&(&at + &half * rational(1, 3)), &half);
                for order in 0..3 {
                    let taylor = signal
                        .taylor(stretch, Near { order, place, terms: 24, bits: BITS })
                        .unwrap();
                    let u = Ball::from_rational(&rational(-1, 3), BITS);
                    let horner = |sum: Ball, c: &Ball| sum.multiply(&u, BITS).add(c, BITS);
                    let sum = taylor.coefficients.iter().rev().fold(Ball::zero(), horner);
                    let own = signal.enclose(stretch, order, At::Time(&at), BITS).unwrap();
                    let size = own.magnitude().to_double().max(scale);
                    assert_same(&sum.widened(&taylor.remainder), &own, size, &what);
                }
            }
        }
    }
}

/// The work of a constant load, as far as it moves a mass, `t − 1 + e^(−t)`, goes on before and beyond its time.
#[test]
fn integrals_go_on_beyond_their_stretches() {
    let network = network(
        "scene \"Pushed\"\nload push { force = 1, until = 2 }\nmass m { mass = 1 }\nbar rod { impedance = 1 }\n\
         line free - push - m - rod - endless\nobserve u = work(push)\n",
    );
    let signal = signal(&network, "u", &rational(5, 1));
    assert_eq!(signal.count().unwrap(), 2);
    for (at, expected) in [
        (-1.0_f64, -2.0 + 1_f64.exp()),
        (0.5, -0.5 + (-0.5_f64).exp()),
        (3.0, 2.0 + (-3_f64).exp()),
    ] {
        let (middle, half) = (Rational::from_float(at).unwrap(), rational(1, 16));
        let near = Near { order: 0, place: (&middle, &half), terms: 20, bits: BITS };
        let value = signal.taylor(0, near).unwrap().coefficients[0].to_double().0;
        assert!((value - expected).abs() < 1e-14, "{at}: {value} {expected}");
    }
}

/// Where nothing is spent the sum stays; where all is known exactly that is proven on whole stretches.
#[test]
fn the_sum_of_energies_stays() {
    for (kind, network) in [("closed", closed()), ("open", open())] {
        let last = rational(6, 1);
        let all = signal(&network, "all", &last);
        for n in 0..30 {
            let at = rational(6 * (2 * n + 1), 61);
            let start = Ball::from_rational(&rational(3, 4), BITS);
            assert_same(&derivative(&*all, 0, &at), &start, 1.0, kind);
            assert_same(&derivative(&*all, 1, &at), &Ball::zero(), 1.0, kind);
        }
    }
    let closed = closed();
    let last = rational(3, 1);
    let all = signal(&closed, "all", &last);
    let search = Search::new(&*all).unwrap();
    for goal in [Goal::Largest, Goal::Smallest] {
        assert_eq!(search.extremum(goal, 9, 1 << 12).unwrap().value, Value::Exact(rational(3, 4)));
    }
    assert_eq!(search.roots(&rational(1, 2), 9, 1 << 12).unwrap().all, []);
}

/// No sample is above the largest value or below the smallest, and one comes near.
#[test]
fn extrema_are_those_of_dense_samples() {
    for (kind, network, name, last) in [
        ("closed", closed(), "rod_energy", "4"),
        ("open", open(), "rod_energy", "4"),
        ("open", open(), "toe_energy", "4"),
        ("units", network(UNITS), "b_energy", "3e-4"),
    ] {
        let last = parse_number(last).unwrap();
        let signal = signal(&network, name, &last);
        let search = Search::new(&*signal).unwrap();
        let extremum = |goal| search.extremum(goal, 12, 1 << 9).unwrap().value.to_f64();
        let (most, least) = (extremum(Goal::Largest), extremum(Goal::Smallest));
        let samples: Vec<f64> = (0..=400)
            .map(|n| derivative(&*signal, 0, &(&last * rational(n, 400))).to_double().0)
            .collect();
        let (top, bottom) =
            samples.iter().fold((0.0_f64, 1e9_f64), |(a, b), v| (a.max(*v), b.min(*v)));
        let near = 1e-3 * most;
        assert!(top <= most + 1e-12 && top >= most - near, "{kind} {name}: {top} {most}");
        assert!(
            bottom >= least - 1e-12 && bottom <= least + near,
            "{kind} {name}: {bottom} {least}"
        );
    }
}

/// Energy lost in dampers never comes back: a line has most at the start and least at the end, and no search is needed. Under a load,
/// of one element, or with work, this does not hold.
#[test]
fn what_only_flows_out_is_largest_at_the_start() {
    let text = |load: &str, before: &str| {
        format!(
            "scene \"Damped\"\nmass hammer {{ mass = 3/2, velocity = 1 }}\nbar rod {{ impedance = 1, travel = 1 }}\n\
             spring pad {{ stiffness = 2, damping = 1/3 }}\nmass anvil {{ mass = 2 }}\n\
             support soil {{ stiffness = 1, damping = 1/5 }}\n{load}\
             line free - {before}hammer - rod - pad - anvil - soil - free\n\
             observe all = energy(line)\nobserve lost = -energy(line)\nobserve held = energy(anvil)\n\
             observe mixed = energy(line) + work(rod.right)\n"
        )
    };
    let end = rational(9, 1);
    let passive = network(&text("", ""));
    let pushed = network(&text("load push { force = sin(t) }\n", "push - "));
    for (network, name, first) in [
        (&passive, "all", Some(Goal::Largest)),
        (&passive, "lost", Some(Goal::Smallest)),
        (&passive, "held", None),
        (&passive, "mixed", None),
        (&pushed, "all", None),
    ] {
        let observed = network.observables().iter().find(|own| own.name == name).unwrap();
        let window = [&Rational::default(), &end];
        let signal = of_scene(network, observed, window, Purpose::Search).unwrap();
        assert_eq!(signal.trend().is_some(), first.is_some(), "{name}");
        let at = |tenths| value(&*signal, &rational(tenths, 10), Limit::Right, 30, 1 << 12);
        let samples: Vec<f64> = (0..=90).map(|tenths| at(tenths).unwrap().to_f64()).collect();
        let search = Search::new(&*signal).unwrap();
        for goal in [Goal::Largest, Goal::Smallest] {
            let found = search.extremum(goal, 12, 1 << 12).unwrap();
            let best = match goal {
                Goal::Largest => samples.iter().copied().fold(f64::MIN, f64::max),
                Goal::Smallest => samples.iter().copied().fold(f64::MAX, f64::min),
            };
            let off = (found.value.to_f64() - best).abs();
            assert!(off < if first.is_some() { 1e-9 } else { 0.02 }, "{name} {goal:?}: {best}");
            // Nothing is lost before the wave comes to the pad.
            let exact = |time| Value::Exact(rational(time, 1));
            let place = match first {
                Some(first) if first == goal => {
                    Place::Plateau { from: exact(0), to: exact(1), closed: true }
                }
                Some(_) => Place::End(exact(9)),
                None => continue,
            };
            assert_eq!(found.places, [place], "{name} {goal:?}");
        }
    }
}

/// What is constant for a while is known to be, by an exact form of what flows: what dampers took, once all is at rest; and the
/// energy of a bar that takes up as much of a sine as a damper takes from it.
#[test]
fn extrema_on_stretches_without_flow_are_plateaus() {
    let bar = "bar rod { impedance = 1, travel = 1 }\nsupport toe { damping = 1 }\n\
        line free - push - rod - toe - free\n";
    let decays = "load push { force = exp(-t), until = 3 }\n";
    let sines = "load push { force = sin(pi*t), until = 3 }\n";
    for (load, observed, [from, to], trend) in [
        (decays, "work(push) - energy(line)", [4, 8], Some(std::cmp::Ordering::Greater)),
        (decays, "work(toe)", [4, 8], None),
        (sines, "energy(line)", [1, 3], None),
    ] {
        let network =
            network(&format!("scene \"Without flow\"\n{load}{bar}observe e = {observed}\n"));
        let window = [&Rational::default(), &rational(8, 1)];
        let observable = &network.observables()[0];
        let signal = of_scene(&network, observable, window, Purpose::Search).unwrap();
        assert_eq!(signal.trend(), trend, "{observed}");
        let found = Search::new(&*signal).unwrap().extremum(Goal::Largest, 12, 1 << 12).unwrap();
        let [Place::Plateau { from: first, to: last, .. }] = &found.places[..] else {
            panic!("{observed}: {:?}", found.places)
        };
        assert_eq!(
            [first, last].map(|own| own.exact().cloned()),
            [from, to].map(|own| Some(rational(own, 1)))
        );
    }
}

/// Digits far beyond those of a search, where contacts open.
#[test]
fn energies_have_many_digits() {
    let network = open();
    let all = network.observables().iter().find(|own| own.name == "all").unwrap();
    let at = rational(5, 2);
    let signal = of_scene(&network, all, [&at, &at], Purpose::Values { digits: 20 }).unwrap();
    let told = value(&*signal, &at, Limit::Right, 250, 1 << 12).unwrap();
    assert!(told.decimal(250).0.to_string().starts_with("0.7500000000"), "{told:?}");
}

/// A dashpot stores nothing: its energy is a signal that is zero, for values as for searches.
#[test]
fn a_dashpot_has_no_energy() {
    const SCENE: &str = "scene \"Dashpot\"\nbar rod { impedance = 1, travel = 1, velocity = 1 }\n\
        mass m { mass = 1 }\nspring d { damping = 1 }\nline free - rod JOINT d - m - free\n\
        observe energy = energy(d)\n";
    for scene in [SCENE.replace("JOINT", "-"), SCENE.replace("JOINT", "|") + "contacts open\n"] {
        let network = network(&scene);
        let signal = signal(&network, "energy", &rational(3, 1));
        for side in [Limit::Left, Limit::Right] {
            let told = value(&*signal, &rational(3, 2), side, 12, 1 << 12).unwrap();
            assert_eq!(told, Value::Exact(Rational::default()));
        }
        let search = Search::new(&*signal).unwrap();
        for goal in [Goal::Largest, Goal::Smallest] {
            let extremum = search.extremum(goal, 9, 1 << 12).unwrap();
            assert_eq!(extremum.value, Value::Exact(Rational::default()));
        }
        let roots = search.roots(&Rational::default(), 9, 1 << 12).unwrap();
        assert!(matches!(roots.all[..], [Root::Interval { .. }]), "{roots:?}");
        assert_eq!(search.roots(&rational(1, 2), 9, 1 << 12).unwrap().all, []);
    }
}

/// Methods that sum waves refuse energies, and say why.
#[test]
fn methods_that_sum_waves_refuse_energies() {
    for network in [closed(), open()] {
        let signal = signal(&network, "all", &rational(3, 1));
        for summation in [Summation::Scaled, Summation::Plain] {
            let refused = Summed::new(&*signal, summation).err();
            assert_eq!(refused, Some(MethodError::Evaluate(EvaluateError::NotLinear)));
        }
        let refused = Marched::new(&*signal).err();
        assert_eq!(refused, Some(MethodError::Evaluate(EvaluateError::NotLinear)));
    }
}

/// A pile with a dashpot within and a support at its toe; momentum flows into the support, energy into the
/// dashpots.
const PILE: &str = "scene \"Pile\"\nmass ram { mass = 2, velocity = 1 }\n\
    spring cushion { stiffness = 3, damping = 1/3 }\nbar upper { impedance = 1, travel = 1 }\n\
    support skin { stiffness = 1/5, damping = 1/2 }\nbar lower { impedance = 1/2, travel = 3/2 }\n\
    support toe { stiffness = 1/4, damping = 2/3 }\n\
    line free - ram JOINT cushion - upper - skin - lower - toe - free\n\
    observe all = energy(line)\nobserve momentum = momentum(line)\n\
    observe bars = energy(upper)/2 - 2*energy(lower)\nobserve above = momentum(upper)\n";

/// Bars that meet: what flows from one that counts to another that counts alike is no change.
const PISTON: &str = "scene \"Piston\"\nbar a { impedance = 2, travel = 1, velocity = 1 }\n\
    bar b { impedance = 1, travel = 1/2, velocity = 1 }\nbar c { impedance = 1, travel = 2 }\n\
    spring rock { stiffness = 1/2 }\nline free - a - b JOINT c - rock - fixed\n\
    observe both = energy(a) + energy(b)\nobserve some = energy(a) + energy(b)/2 + energy(c)/2\n\
    observe push = momentum(b) + momentum(c)\n";

/// Loads beside bars, a spring and a support, which begin late, end, overlap, oscillate, and impose a velocity.
const PULSES: &str = "scene \"Pulses\"\nload p { force = 1 + t, from = 1/3, until = 3/2 }\n\
    load q { force = -2*exp(-t), from = 1 }\nsupport u { stiffness = 2, damping = 1/3 }\n\
    bar a { impedance = 1, travel = 1 }\nbar b { impedance = 2, travel = 3/2 }\n\
    spring s { stiffness = 3, damping = 1/4 }\nload w { DRIVE = sin(2*t), until = 5/2 }\n\
    line free - p - q - u - a JOINT b - s - w - free\n\
    observe all = energy(line)\nobserve momentum = momentum(line)\n";

/// Loads on masses: weight, two pulses on one mass that overlap, and one that oscillates beside a support.
const WEIGHTS: &str = "scene \"Weights\"\nload weight { force = 1/3 }\nmass ram { mass = 2, velocity = 1 }\n\
    spring cushion { stiffness = 3, damping = 1/4 }\nload p { force = 1 + t, from = 1/3, until = 3/2 }\n\
    mass helmet { mass = 1/2 }\nload q { force = -2*exp(-t), from = 1 }\nbar pile { impedance = 1, travel = 1 }\n\
    load w { force = sin(2*t), until = 5/2 }\nmass foot { mass = 1/3 }\nsupport toe { stiffness = 1/4, damping = 2/3 }\n\
    line free - weight - ram JOINT cushion - p - helmet - q - pile - w - foot - toe - free\n\
    observe all = energy(line)\nobserve momentum = momentum(line)\n";

/// The same with units, which have scales of their own.
const HAMMER: &str = "scene \"Hammer\"\nload push { force = 3*sin(1000*pi*t) kN, until = 3/2 ms }\n\
    load weight { force = (1 - 500*t) kN, from = 1/4 ms }\nmass ram { mass = 1 kg, velocity = 2 m/s }\n\
    bar rod { impedance = 3000 N*s/m, travel = 200 us }\nsupport toe { stiffness = 2 MN/m, damping = 1 kN*s/m }\n\
    line free - push - weight - ram JOINT rod - toe - free\n\
    observe all = energy(line)\nobserve momentum = momentum(line)\n\
    observe passed = work(rod.at(1/3)) + 2*work(toe) - energy(toe)\nobserve given = work(push)\n";

/// What is searched, by its flow, is what is evaluated: values and derivatives agree, also with what is
/// conserved.
#[test]
fn what_flows_in_is_the_derivative() {
    let pile = || network(&PILE.replace("JOINT", "-"));
    let parting = || network(&(PILE.replace("JOINT", "|") + "contacts open\n"));
    let piston = network(&PISTON.replace("JOINT", "-"));
    let leaving = network(&(PISTON.replace("JOINT", "|") + "contacts open\n"));
    let pulses = |joint: &str, drive: &str| PULSES.replace("JOINT", joint).replace("DRIVE", drive);
    let weights = || network(&WEIGHTS.replace("JOINT", "-"));
    let falling = || network(&(WEIGHTS.replace("JOINT", "|") + "contacts open\n"));
    let hammer = || network(&HAMMER.replace("JOINT", "-"));
    let struck = || network(&(HAMMER.replace("JOINT", "|") + "contacts open\n"));
    let scenes: [(Network, &[&str], Rational); 14] = [
        (hammer(), &["all", "momentum", "passed", "given"], rational(1, 500)),
        (struck(), &["all", "momentum", "passed", "given"], rational(1, 500)),
        (weights(), &["all", "momentum"], rational(6, 1)),
        (falling(), &["all", "momentum"], rational(6, 1)),
        (network(&pulses("-", "force")), &["all", "momentum"], rational(6, 1)),
        (network(&pulses("-", "velocity")), &["all", "momentum"], rational(6, 1)),
        (
            network(&(pulses("|", "force") + "contacts open\n")),
            &["all", "momentum"],
            rational(6, 1),
        ),
        (piston, &["both", "some", "push"], rational(6, 1)),
        (leaving, &["both", "some", "push"], rational(6, 1)),
        (pile(), &["all", "momentum", "bars", "above"], rational(6, 1)),
        (parting(), &["all", "momentum", "bars", "above"], rational(6, 1)),
        (closed(), &["rod_energy", "all"], rational(6, 1)),
        (open(), &["rod_energy", "all"], rational(6, 1)),
        (network(UNITS), &["a_energy", "b_energy", "all"], rational(1, 1500)),
    ];
    let (mut compared, mut flat) = (0, 0);
    for (network, names, last) in &scenes {
        for name in *names {
            let observed = network.observables().iter().find(|own| own.name == *name).unwrap();
            let window = [&Rational::default(), last];
            let searched = of_scene(network, observed, window, Purpose::Search).expect("a signal");
            let evaluated = signal(network, name, last);
            let counts = [searched.count().unwrap(), evaluated.count().unwrap()];
            assert!(counts[0] <= counts[1] + 1, "{name}: {counts:?}");
            // Derivatives that are said to vanish do.
            for stretch in 0..counts[0] {
                for end in [Limit::Right, Limit::Left] {
                    let count = searched.flatness(stretch, end, 1).unwrap();
                    for order in 1..=count {
                        let slope = searched.enclose(stretch, order, At::End(end), BITS).unwrap();
                        let scale = 1500_f64.powi(order as i32);
                        let what = format!("{name}, {stretch}, {end:?}, {order}");
                        assert_same(&slope, &Ball::zero(), scale, &what);
                        flat += usize::from(count > 1);
                    }
                }
            }
            for place in 1..24 {
                let at = last * rational(place, 24) * rational(1001, 1000);
                if at >= *last {
                    continue;
                }
                for order in 0..3_i32 {
                    let [own, other] = [&searched, &evaluated]
                        .map(|signal| derivative(&**signal, order as usize, &at));
                    let scale = if *last < rational(1, 1) { 1500_f64.powi(order) } else { 1.0 };
                    assert_same(&own, &other, scale, &format!("{name}, {order}, {at}"));
                    compared += 1;
                }
            }
        }
    }
    assert_eq!(compared, 1035 + (2 * 7 + 6 + 4) * 3 * 23);
    assert!(flat >= 10, "{flat} derivatives");
}

/// The momentum of a free line is the impulse of the load on its mass, `∫ F dt`, in milliseconds as in seconds.
#[test]
fn a_load_on_a_mass_gives_its_impulse() {
    let network = network(
        "scene \"Impulse\"\nbar rod { impedance = 3000 N*s/m, travel = 200 us }\nmass ram { mass = 1 kg }\n\
         load push { force = sin(1000*pi*t) kN }\nline free - rod - ram - push - free\n\
         observe momentum = momentum(line)\n",
    );
    let window = [&Rational::default(), &rational(3, 2000)];
    let signal = of_scene(&network, &network.observables()[0], window, Purpose::Search).unwrap();
    let found = Search::new(&*signal).unwrap().extremum(Goal::Largest, 15, 1 << 12).unwrap();
    // 2/π, when the force changes its sign
    assert_eq!(found.value.to_text(15), "0.636619772367581");
    let [Place::Critical(time)] = &found.places[..] else { panic!("{:?}", found.places) };
    assert_eq!(time.to_f64(), 0.001);
}

/// A load that begins with zero, and what it gives to a mass at rest, begin flat: the least value is at the start alone.
#[test]
fn extrema_under_loads_that_begin_with_zero_are_decided() {
    for force in ["t*t", "sin(pi*t)"] {
        let network = network(&format!(
            "scene \"Push\"\nmass m {{ mass = 1 }}\nload p {{ force = {force} }}\n\
             line free - p - m - free\nobserve momentum = momentum(line)\n"
        ));
        let window = [&Rational::default(), &rational(1, 2)];
        let signal =
            of_scene(&network, &network.observables()[0], window, Purpose::Search).unwrap();
        let found = Search::new(&*signal).unwrap().extremum(Goal::Smallest, 12, 1 << 12).unwrap();
        assert_eq!(found.value, Value::Exact(Rational::default()), "{force}");
        assert!(matches!(found.places[..], [Place::End(_)]), "{force}: {:?}", found.places);
    }
}

/// What begins flat, with the square of a wave that begins at zero, is decided at the beginning.
#[test]
fn extrema_of_what_begins_flat_are_decided() {
    let pile = network(&PILE.replace("JOINT", "-"));
    let window = [&Rational::default(), &rational(3, 1)];
    let found = |name: &str, goal| {
        let observed = pile.observables().iter().find(|own| own.name == name).unwrap();
        let signal = of_scene(&pile, observed, window, Purpose::Search).expect("a signal");
        Search::new(&*signal).unwrap().extremum(goal, 12, 1 << 12).unwrap()
    };
    for name in ["above", "momentum", "all"] {
        for goal in [Goal::Largest, Goal::Smallest] {
            let places = found(name, goal).places;
            let is_open = |place: &Place| matches!(place, Place::Undecided { .. });
            assert!(!places.iter().any(is_open), "{name}: {places:?}");
        }
    }
    assert_eq!(found("all", Goal::Largest).value.to_f64(), 1.0);
}

/// A mass that leaves its bar with the velocity `(p(t) − p(0))/√2`, where `p` has zeros of fourth order, at which it is least and
/// too flat for balls to tell it from its neighbours, on both sides alike.
#[test]
fn what_is_undecided_on_both_sides_of_a_time_is_one_place() {
    for (force, at_first, flat, [from, to]) in [
        // The zero is where a cell of the search begins, or where one of the motion does; there are two.
        ("4*(t - 3/2)^3", 5.0625, vec![rational(3, 2)], [1.0, 1.75]),
        ("4*(t - 1)^3", 1.0, vec![rational(1, 1)], [0.0, 2.0]),
        ("8*(t - 1)^3*(t - 3)^3*(t - 2)", 81.0, vec![rational(1, 1), rational(3, 1)], [0.5, 3.75]),
    ] {
        let network = network(&format!(
            "scene \"Pull\"\nmass m {{ mass = sqrt(2) }}\nbar rod {{ impedance = 1 }}\n\
             load p {{ force = {force} }}\nline free - p - m | rod - endless\n\
             observe v = velocity(m)\ncontacts open\n"
        ));
        let window = [from, to].map(|time| Rational::from_float(time).unwrap());
        let window = [&window[0], &window[1]];
        let signal =
            of_scene(&network, &network.observables()[0], window, Purpose::Search).unwrap();
        let found = Search::new(&*signal).unwrap().extremum(Goal::Smallest, 12, 1 << 12).unwrap();
        let wanted = -at_first / 2f64.sqrt();
        assert!((found.value.to_f64() - wanted).abs() < 1e-9, "{:?}", found.value);
        assert_eq!(found.places.len(), flat.len(), "{found:?}");
        for (place, flat) in found.places.iter().zip(&flat) {
            let Place::Undecided { from, to } = place else { panic!("{found:?}") };
            assert!(from < flat && flat <= to && to - from < rational(1, 1 << 30), "{found:?}");
        }
    }
}

/// Only where no motion can be lost at once is an energy conserved by its balance: two masses with nothing
/// between them may strike each other.
#[test]
fn masses_that_may_strike_each_other_are_not_taken_for_conserved() {
    let scene = |middle: &str, more: &str| {
        network(&format!(
            "scene \"Masses\"\nmass a {{ mass = 1, velocity = 1 }}\nmass b {{ mass = 2, velocity = 1 }}\n\
             spring k {{ stiffness = 3 }}\nbar rod {{ impedance = 1, travel = 1 }}\n\
             line free - {middle} - rod - fixed\nobserve all = energy(line)\n{more}"
        ))
    };
    let open = "contacts open\n";
    for (middle, more, is_conserved) in [
        ("a | b - k", open, false),
        ("a | b - k", "", true),
        ("a - b | k", open, true),
        ("a - k | b", open, true),
        ("a - k - b", "", true),
    ] {
        let network = scene(middle, more);
        let window = [&Rational::default(), &rational(4, 1)];
        let signal =
            of_scene(&network, &network.observables()[0], window, Purpose::Search).unwrap();
        assert_eq!(signal.count().unwrap() == 1, is_conserved, "{middle}");
        let now = derivative(&*signal, 0, &rational(5, 2));
        assert_same(&now, &Ball::from_rational(&rational(3, 2), BITS), 1.0, middle);
    }
}

/// What no load pushes any more is conserved, and its largest value is found at once; beside a mass it is searched.
#[test]
fn energies_stay_after_a_pulse() {
    let closed = ("p - a - b - fixed", "", "2.25 = 9/4");
    let open = ("p - a | b - free", "contacts open\n", "2.25000000000000");
    for (line, joint, most) in [closed, open] {
        let network = network(&format!(
            "scene \"Pulse\"\nload p {{ force = 3*sin(pi*t), until = 1 }}\n\
             bar a {{ impedance = 2, travel = 1 }}\nbar b {{ impedance = 2, travel = 3/2 }}\n\
             line free - {line}\nobserve all = energy(line)\nobserve push = momentum(line)\n{joint}"
        ));
        let window = [&Rational::default(), &rational(9, 2)];
        let all = network.observables().iter().find(|own| own.name == "all").unwrap();
        let signal = of_scene(&network, all, window, Purpose::Search).unwrap();
        // `∫ F²/Z dt`
        let search = Search::new(&*signal).unwrap();
        let found = search.extremum(Goal::Largest, 15, 1 << 12).unwrap();
        assert_eq!(found.value.to_text(15), most, "{line}");
        let stays = |place: &Place| matches!(place, Place::Plateau { .. });
        let is_limit = |place: &Place| matches!(place, Place::Arrival { .. });
        let [.., place] = &found.places[..] else { panic!("no place") };
        assert!(stays(place) && !found.places.iter().any(is_limit), "{line}: {:?}", found.places);
        let push = network.observables().iter().find(|own| own.name == "push").unwrap();
        let signal = of_scene(&network, push, window, Purpose::Search).unwrap();
        // One stretch after the last break of the load, where no wall pushes.
        let last = stretch_of(&*signal, &rational(5, 4));
        let stays = last + 1 == signal.count().unwrap();
        assert_eq!(stays, line.ends_with("free"), "{line}");
    }
}

/// Masses that are joined begin with the momentum that they have together; what is lost then is lost before the start.
#[test]
fn masses_that_are_joined_begin_together() {
    for (joint, more) in [("-", ""), ("|", ""), ("-", "contacts open\n")] {
        let network = network(&format!(
            "scene \"Joined\"\nmass a {{ mass = 1, velocity = 3 }}\nmass b {{ mass = 2 }}\n\
             spring k {{ stiffness = 3 }}\nmass c {{ mass = 1, velocity = 5 }}\nmass d {{ mass = 1, velocity = 5 }}\n\
             line free - a {joint} b - k - c - d - free\nobserve all = energy(line)\n{more}"
        ));
        let window = [&Rational::default(), &rational(4, 1)];
        let signal =
            of_scene(&network, &network.observables()[0], window, Purpose::Search).unwrap();
        assert_eq!(signal.count().unwrap(), 1, "{joint} {more}");
        let now = derivative(&*signal, 0, &rational(5, 2));
        assert_same(&now, &Ball::from_rational(&rational(53, 2), BITS), 1.0, joint);
        // The same by the motion.
        let asked = Purpose::Values { digits: 15 };
        let signal = of_scene(&network, &network.observables()[0], window, asked).unwrap();
        let now = derivative(&*signal, 0, &rational(5, 2));
        assert_same(&now, &Ball::from_rational(&rational(53, 2), BITS), 1.0, joint);
    }
}

/// A mass between endless bars comes to rest at the rate `λ = (Z₁ + Z₂)/m`, and what has gone into a bar is
/// `Z₂ ∫ e^(−2λt) dt = Z₂ (1 − e^(−2λt))/(2λ)`: the same number of cells does for all rates, since nothing is left of
/// the motion on nearly all of a window.
#[test]
fn energies_that_come_in_fast_are_enclosed() {
    for first in [1_i64, 100_000, 100_000_000] {
        let network = network(&format!(
            "scene \"Lost\"\nbar west {{ impedance = {first} }}\nmass ram {{ mass = 1, velocity = 1 }}\n\
             bar east {{ impedance = 2 }}\nline endless - west - ram - east - endless\n\
             observe lost = energy(east)"
        ));
        let [at, rate] = [rational(7, 3), rational(2 * (first + 2), 1)];
        let lost = signal(&network, "lost", &at);
        let known = derivative(&*lost, 0, &at);
        let gone = Ball::from_rational(&(-&rate * &at), BITS).exp(BITS).unwrap();
        let rest = Ball::from_integer(&1.into()).subtract(&gone, BITS);
        let exact = rest.multiply_rational(&(rational(2, 1) / &rate), BITS);
        let off = known.subtract(&exact, BITS);
        assert!(off.contains_zero(), "{known} {exact}");
        assert!(*off.radius() <= exact.magnitude().scale(-120), "{first}: {known}");
    }
}

/// Dampers, an open contact, a strained bar, a load and an endless bar.
const WORKING: &str = "scene \"Working\"\nbar a { impedance = 2, travel = 1, velocity = 1 }\n\
    spring k { stiffness = 1, damping = 1/2 }\nbar b { impedance = 1, travel = 3/2, strain = -1/4, velocity = 1/3 }\n\
    mass m { mass = 1/2 }\nload p { force = t*exp(-t)/4, from = 1, until = 3 }\nbar c { impedance = 1/2 }\n\
    support u { damping = 1/3, stiffness = 2 }\nline free - u - a JOINT k - b - m - p - c - endless\n";

/// What enters a bar and does not leave it stays in it, and what no element holds was spent or not given yet: of values that
/// are told one by one, and of sums, of which only what does not cancel is told.
#[test]
fn work_is_energy_that_has_passed() {
    let named: [(&str, &str); 12] = [
        ("b", "energy(b)"),
        ("b0", "work(b.left)"),
        ("b1", "work(b.right)"),
        ("half", "work(b.at(1/2))"),
        ("c", "energy(c)"),
        ("c0", "work(c.left)"),
        ("line", "energy(line)"),
        ("p", "work(p)"),
        ("k", "work(k)"),
        ("in_k", "energy(k)"),
        ("u", "work(u)"),
        ("in_u", "energy(u)"),
    ];
    let sums: [&[(i64, &str)]; 4] = [
        &[(1, "b"), (-1, "b0"), (1, "b1")],
        &[(1, "c"), (-1, "c0")],
        &[(1, "b0"), (-1, "half"), (1, "half"), (-1, "b1"), (-1, "b")],
        &[(1, "line"), (-1, "p"), (1, "k"), (-1, "in_k"), (1, "u"), (-1, "in_u")],
    ];
    let mut observed: String =
        named.iter().map(|(name, of)| format!("observe q_{name} = {of}\n")).collect();
    for (number, sum) in sums.iter().enumerate() {
        let of = |name: &str| named.iter().find(|own| own.0 == name).unwrap().1;
        let terms = sum.iter().map(|(sign, name)| format!("{sign}*{}", of(name)));
        observed += &format!("observe sum{number} = {}\n", terms.collect::<Vec<_>>().join(" + "));
    }
    let observed = observed.replace("-1*", "(-1)*");
    for joint in ["-", "|", "|1/9|"] {
        let opens = if joint == "-" { "" } else { "contacts open\n" };
        let network = network(&(WORKING.replace("JOINT", joint) + opens + &observed));
        let last = rational(6, 1);
        for (number, sum) in sums.iter().enumerate() {
            let whole = signal(&network, &format!("sum{number}"), &last);
            let parts: Vec<_> =
                sum.iter().map(|own| signal(&network, &format!("q_{}", own.1), &last)).collect();
            let at_start = derivative(&*whole, 0, &rational(1, 1 << 20));
            for n in 1..12 {
                let at = rational(12 * n + 1, 25);
                let mut added = Ball::zero();
                for ((sign, _), part) in sum.iter().zip(&parts) {
                    let value = derivative(&**part, 0, &at);
                    added = added.add(&value.multiply_rational(&rational(*sign, 1), BITS), BITS);
                }
                let what = format!("sum {number} at {at}, joined by {joint}");
                assert_same(&added, &at_start, 1.0, &what);
                assert_same(&derivative(&*whole, 0, &at), &at_start, 1.0, &what);
            }
        }
    }
}

/// Nothing passes a free end or a wall, whatever the bar there holds; searches by what flows tell the same.
#[test]
fn nothing_passes_an_end() {
    let text = "scene \"Ends\"\nbar a { impedance = 1, travel = 1, velocity = 1 }\n\
        bar b { impedance = 2, travel = 1/2 }\nline free - a - b - fixed\nobserve at_ends = work(a.left) - 2*work(b.right)\n\
        observe with_b = work(b.right) + energy(b)\nobserve b = energy(b)\n"
        .replace("observe b =", "observe held =");
    let network = network(&text);
    let last = rational(3, 1);
    let search = |name: &str| {
        let observed = network.observables().iter().find(|own| own.name == name).unwrap();
        of_scene(&network, observed, [&Rational::default(), &last], Purpose::Search).unwrap()
    };
    for n in 1..12 {
        let at = rational(6 * n + 1, 25);
        let value = |name: &str, order: usize| derivative(&*search(name), order, &at);
        for order in 0..2 {
            assert_same(&value("at_ends", order), &Ball::zero(), 1.0, "ends");
            assert_same(&value("with_b", order), &value("held", order), 1.0, "bar");
        }
    }
}

/// A mass on an endless bar gives it `M V²/2 (1 − exp(−2Zt/M))`, and so it does to a damper.
#[test]
fn work_has_exact_values() {
    let text = "scene \"Ram\"\nmass m { mass = 2, velocity = 3 }\nREST\n";
    let bar = "bar b { impedance = 4 }\nline free - m - b - endless\nobserve w = work(b.left)";
    let damper = "support b { damping = 4 }\nline free - m - b - free\nobserve w = work(b)";
    let spring = "spring b { damping = 4 }\nline free - m - b - fixed\nobserve w = work(b)";
    for rest in [bar, damper, spring] {
        let network = network(&text.replace("REST", rest));
        let work = signal(&network, "w", &rational(3, 1));
        assert_eq!(work.count().unwrap(), 1);
        let half = Fraction::constant(&rational(1, 2));
        assert!(work.exact_at(0, &half, Effort::Much).is_some());
        let exp = Ball::from_integer(&(-2).into()).exp(BITS).unwrap();
        let exact = Ball::from_integer(&1.into()).subtract(&exp, BITS);
        let exact = exact.multiply_rational(&rational(9, 1), BITS);
        assert_same(&derivative(&*work, 0, &rational(1, 2)), &exact, 1e-20, rest);
    }
}

/// Each load of a place counts as it is given, in its work and in what the line takes up.
#[test]
fn a_balance_of_several_loads_is_zero() {
    let text = "scene \"Trapezoid\"\nload up { force = t, until = 1 }\nload flat { force = 1, from = 1, until = 2 }\n\
        load down { force = 3 - t, from = 2, until = 3 }\nbar rod { impedance = 1, travel = sqrt(2) }\n\
        support shaft { damping = 1/2 }\nbar tip { impedance = 2, travel = 1 }\nsupport toe { damping = 1, stiffness = 1 }\n\
        line free - up - flat - down - rod - shaft - tip - toe - free\n\
        observe balance = work(up) + work(flat) + work(down) - work(shaft) - work(toe) - energy(rod) - energy(tip)\n\
        observe whole = work(up) + work(flat) + work(down) - work(shaft) - energy(line)\n\
        observe given = work(up) + work(flat) + work(down)\nobserve taken = work(rod.left)\n";
    let problem = Problem::of_text("trapezoid.wave", text, &Values::new()).unwrap();
    let value = |name: &str, at: &str| problem.signal(name).unwrap().at(at, 12).unwrap();
    for at in ["1/2", "5/2", "7"] {
        assert_eq!(value("balance", at).to_string(), "0");
        let off = value("given", at).to_f64() - value("taken", at).to_f64();
        assert!(off.abs() < 1e-11 * value("given", at).to_f64(), "{at}");
    }
    // What the damper of the toe has taken is left out.
    assert!(value("whole", "7").to_f64() > 0.1);
}
