//! Simpler answers: bars that are springs or rigid, changes of a text, distances with proof, and advice.

use num_traits::Signed as _;
use wavestep::language::{Change, changed};
use wavestep::planner::Purpose;
use wavestep::problem::{Against, MapRequest, Need, Other, ProblemError, Simpler, Size, Verdict};
use wavestep::signal::{At, Limit, Near, Search, value};
use wavestep::{Method, Problem};
use wavestep_polynomial::Rational;

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn scene(body: &str) -> Problem {
    Problem::read("test.wave", format!("scene \"Test\"\n{body}")).unwrap()
}

fn builtin(name: &str, mu: &str) -> Problem {
    Problem::builtin(name).unwrap().with("mu", mu).unwrap()
}

/// The reason why a text is refused, or what makes of it another scene.
fn refused(body: &str) -> String {
    let text = format!("scene \"Test\"\n{body}");
    Problem::read("test.wave", text).err().expect("it is refused").to_string()
}

fn doubles(problem: &Problem, name: &str, times: &[f64]) -> Vec<f64> {
    let found = problem.signal(name).unwrap().values(times, "abs:1e-12".parse().unwrap());
    found.unwrap().values
}

/// A bar as a spring is Rayleigh's model: `(M + m/3) u'' + k u = 0`, with the momentum of the mass.
#[test]
fn a_bar_as_a_spring_is_rayleighs_model() {
    for mu in ["1/10", "1", "4"] {
        let rod = builtin("mass-on-fixed-bar", mu);
        let third = rod.changed(&[Change::Spring(None, None)]).unwrap();
        let times: Vec<f64> = (0..40).map(|i| f64::from(i) / 7.0).collect();
        let m = mu.parse::<f64>().unwrap_or(0.1);
        let (whole, stiffness) = (1.0 + m / 3.0, 1.0 / m);
        let (start, omega) = (1.0 / whole, f64::sqrt(stiffness / whole));
        for name in ["velocity", "strain_impact", "strain_fixed"] {
            let equation = times.iter().map(|t| match name {
                "velocity" => start * (omega * t).cos(),
                _ => -stiffness * start / omega * (omega * t).sin(),
            });
            let own = doubles(&third, name, &times);
            let model = rod.signal(name).unwrap().values_by(&times, Method::Third).unwrap().values;
            for ((own, model), exact) in own.iter().zip(&model).zip(equation) {
                assert!((own - exact).abs() < 1e-11, "{mu} {name}: {own} {exact}");
                assert!((own - model).abs() < 1e-11, "{mu} {name}: {own} {model}");
            }
        }
    }
}

/// A rigid bar between springs: `M u'' + d u' + k u = 0`, with the momentum of the bar.
#[test]
fn a_rigid_bar_is_the_rigid_body() {
    let text = "bar rod { impedance = 2, travel = 3/2, velocity = 1 }\nmass m { mass = 1/2 }\n\
        support soil { stiffness = 3, damping = 1/4 }\nline free - m - rod - soil - free\n\
        observe v = velocity(m)\nobserve u = displacement(m)\nobserve f = force(soil)";
    let bar = scene(text);
    let rigid = bar.changed(&[Change::Rigid(Some("rod".to_owned()))]).unwrap();
    let times: Vec<f64> = (0..40).map(|i| f64::from(i) / 7.0).collect();
    let (mass, stiffness, damping) = (3.5, 3.0, 0.25);
    let (start, beta) = (3.0 / mass, damping / 2.0 / mass);
    let omega = f64::sqrt(stiffness / mass - beta * beta);
    for name in ["v", "u", "f"] {
        let equation = times.iter().map(|t| {
            let (decay, sine, cosine) =
                ((-beta * t).exp(), (omega * t).sin() / omega, (omega * t).cos());
            let [u, v] = [start * decay * sine, start * decay * (cosine - beta * sine)];
            match name {
                "v" => v,
                "u" => u,
                _ => stiffness * u + damping * v,
            }
        });
        let own = doubles(&rigid, name, &times);
        let model = bar.signal(name).unwrap().values_by(&times, Method::Rigid).unwrap().values;
        for ((own, model), exact) in own.iter().zip(&model).zip(equation) {
            assert!((own - exact).abs() < 1e-11, "{name}: {own} {exact}");
            assert!((own - model).abs() < 1e-11, "{name}: {own} {model}");
        }
    }
}

/// With units a strain, a stress and a momentum of a bar that is a spring keep their units: `ε = −X/EA`, `σ = X/A` but for its
/// sign, and the momentum of a velocity that is linear along the bar is `m (v_left + v_right)/2`.
#[test]
fn measures_of_a_bar_as_a_spring_have_their_units() {
    let bar = scene(
        "bar rod { modulus = 200 GPa, density = 8000 kg/m^3, area = 5 cm^2, length = 2 m, as = spring }\n\
         mass m { mass = 3 kg, velocity = 4 m/s }\nline free - m - rod - free\n\
         observe strain = strain(rod.at(1/3))\nobserve stress = stress(rod.left)\n\
         observe force = force(rod.right)\nobserve momentum = momentum(rod)\n\
         observe middle = velocity(rod.at(0.5 m))\nobserve left = velocity(rod.left)\n\
         observe right = velocity(rod.right)\nobserve all = momentum(line)\nobserve e = energy(rod)\n\
         observe u = displacement(rod.left) - displacement(rod.right)",
    );
    let at = |name: &str| bar.signal(name).unwrap().at("130us", 15).unwrap().to_f64();
    let is = |name: &str, value: f64| {
        let own = at(name);
        assert!((own - value).abs() < 1e-9 * value.abs(), "{name}: {own} {value}");
    };
    let (area, modulus, mass) = (5e-4, 200e9, 8000.0 * 5e-4 * 2.0);
    is("strain", -at("force") / (modulus * area));
    is("stress", -at("force") / area);
    is("force", modulus * area / 2.0 * at("u"));
    is("middle", 0.75 * at("left") + 0.25 * at("right"));
    is("momentum", mass * (at("left") + at("right")) / 2.0);
    is("all", 12.0);
    let stored = at("force").powi(2) / (2.0 * modulus * area / 2.0);
    is("e", mass / 4.0 * (at("left").powi(2) + at("right").powi(2)) + stored);
    assert_eq!(bar.signal("strain").unwrap().unit(), "");
    assert_eq!(bar.signal("stress").unwrap().unit(), "Pa");
    assert_eq!(bar.signal("momentum").unwrap().unit(), "N*s");
}

/// A share of its mass at the end that moves changes the rate: `ω² = k/(M + αm)`.
#[test]
fn a_share_of_the_mass_moves_with_the_end() {
    for (share, whole) in [("1/2", 1.5), ("1/4", 1.25)] {
        let bar = scene(&format!(
            "bar rod {{ impedance = 1, travel = 1, as = spring, share = {share} }}\n\
             mass m {{ mass = 1, velocity = 1 }}\nline free - m - rod - fixed\nobserve v = velocity(m)"
        ));
        let own = bar.signal("v").unwrap().at("3/2", 12).unwrap().to_f64();
        let exact = (1.5_f64 / f64::sqrt(whole)).cos() / whole;
        assert!((own - exact).abs() < 1e-11, "{share}: {own} {exact}");
    }
}

#[test]
fn bars_without_waves_are_refused_where_they_make_no_sense() {
    let line =
        "\nmass m { mass = 1, velocity = 1 }\nline free - m - rod - fixed\nobserve v = velocity(m)";
    let bar = |as_what: &str| format!("bar rod {{ impedance = 1, travel = 1, {as_what} }}{line}");
    assert!(refused(&bar("as = rigid")).contains("this bar cannot move"));
    assert!(refused(&bar("as = rubber")).contains("a bar is a spring or rigid"));
    assert!(refused(&bar("share = 1/3")).contains("only a bar with `as = spring` has a share"));
    assert!(
        refused(&bar("as = rigid, share = 1/3"))
            .contains("only a bar with `as = spring` has a share")
    );
    assert!(refused(&bar("as = spring, strain = 1")).contains("no strain at the start"));
    assert!(refused(&bar("as = spring, share = 0")).contains("must be positive"));
    let endless = "bar rod { impedance = 1, as = spring }\nmass m { mass = 1, velocity = 1 }\n\
        line free - m - rod - endless\nobserve v = velocity(m)";
    assert!(refused(endless).contains("an endless bar cannot be rigid or a spring"));
    let wall = "bar rod { impedance = 1, travel = 1, velocity = 1, as = spring }\nline free - rod | fixed\n\
        contacts open\nobserve v = velocity(rod.left)";
    assert!(refused(wall).contains("cannot separate from a fixed end"));
    let rigid = "bar rod { impedance = 1, travel = 1, as = rigid, velocity = 1 }\nline free - rod - free\n\
        observe f = force(rod.left)";
    assert!(refused(rigid).contains("the force in a rigid bar is unknown"));
}

const PILE: &str = "scene \"Pile\"\nmaterial concrete { modulus = 30 GPa, density = 2400 kg/m^3 }\n\
    mass ram { mass = 5000 kg, velocity = 4 m/s }   # falls\nspring cushion { stiffness = 1 GN/m }\n\
    # The pile itself.\nbar pile { material = concrete, diameter = 500 mm, length = 20 m }\n\
    bar tip { length = 1 m, material = concrete, diameter = 400 mm }\nsupport toe { damping = 0.5 MN*s/m }\n\
    line free - ram | cushion - pile - tip - toe - free\ncontacts open\n\
    observe head = force(cushion)\nobserve end = velocity(tip.right)\nobserve energy = energy(line)\n";

/// What a change makes of a text, read by eye in the snapshot.
#[test]
fn changes_keep_what_the_author_wrote() {
    let pile = Problem::read("pile.wave", PILE).unwrap();
    let mut told = String::new();
    for change in [
        "without:cushion",
        "without:ram",
        "rigid:pile",
        "spring:tip,2/5",
        "third",
        "endless:pile.right",
        "endless:tip.left",
        "closed",
        "closed+without:toe+rigid",
    ] {
        let Ok(Simpler::Scene(changes)) = change.parse() else { panic!("{change}") };
        let text = match changed(pile.source(), &changes) {
            Ok(source) => source.text().to_owned(),
            Err(error) => format!("{error}\n"),
        };
        told += &format!("== {change}\n{text}\n");
    }
    insta::with_settings!({ snapshot_path => "../../snapshots/simpler", prepend_module_to_snapshot => false }, {
        insta::assert_snapshot!("changes", told);
    });
    for wrong in ["without:x", "rigid:ram", "endless:toe.right"] {
        let Ok(Simpler::Scene(changes)) = wrong.parse() else { panic!("{wrong}") };
        assert!(changed(pile.source(), &changes).is_err(), "{wrong}");
    }
    for wrong in
        ["", "thirds", "modes:0", "modes:x", "without:", "endless:pile", "rigid+", "echoes:-1"]
    {
        assert!(wrong.parse::<Simpler>().is_err(), "{wrong}");
    }
}

/// A later window sees the same arrivals: where the largest difference of a longer one lies in it, it is the same.
#[test]
fn arrivals_are_counted_from_the_start() {
    let rod = builtin("mass-on-fixed-bar", "1");
    let (wanted, to) = (rod.wanted("velocity").unwrap(), rational(7, 1));
    let size = |count: usize, from: i64| {
        let window = [&rational(from, 1), &to];
        let signal =
            rod.difference_on(Against::Arrivals(count), &wanted, window, Purpose::Search).unwrap();
        Size::of(&*signal, (9, 1 << 12), &Rational::default()).unwrap().bounds
    };
    // Waves arrive at 2, 4 and 6.
    for (count, from) in [(1, 3), (1, 5), (2, 5), (2, 6)] {
        let [[low, high], [less, more]] = [size(count, 0), size(count, from)];
        assert!(less.is_positive() && low <= more && less <= high, "{count} from {from}");
    }
    assert_eq!(size(3, 5), [Rational::default(), Rational::default()]);
}

/// A rigid bar has no known force, and an endless one is no rigid body: what is left is still compared.
#[test]
fn rigid_bars_leave_what_they_can_tell() {
    let rigid = "rigid".parse().unwrap();
    let told = |problem: &Problem, name: &str| {
        let (wanted, zero, one) =
            (problem.wanted(name).unwrap(), Rational::default(), rational(1, 1));
        let other = problem.simpler(&rigid).unwrap();
        let signal = problem.difference_on(&other, &wanted, [&zero, &one], Purpose::Search)?;
        Ok::<_, ProblemError>(Size::of(&*signal, (9, 1 << 12), &zero).unwrap().bounds)
    };
    let rod = builtin("struck-free-bar", "1/100");
    let Other::Problem(model) = rod.simpler(&rigid).unwrap() else { panic!("a scene") };
    assert_eq!(model.observables(), ["velocity", "far_velocity", "energy", "momentum"]);
    // All the momentum in both: 1/(1 + mu), and 1 at the first instant.
    assert_eq!(told(&rod, "velocity").unwrap(), [rational(1, 101), rational(1, 101)]);
    let refused = told(&rod, "impact_force").unwrap_err();
    assert!(matches!(&refused, ProblemError::LeftOut { name, .. } if name == "impact_force"));
    let striker = Problem::builtin("stepped-striker").unwrap();
    // What is rigid already stays so.
    let one = striker.changed(&["rigid:head".parse().unwrap()]).unwrap();
    let Other::Problem(all) = one.simpler(&rigid).unwrap() else { panic!("a scene") };
    let Other::Problem(same) = striker.simpler(&rigid).unwrap() else { panic!("a scene") };
    assert_eq!(all.source().text(), same.source().text());
    // The first force is Z v of a rigid striker, and half of that with bars of one impedance.
    assert_eq!(told(&striker, "pulse").unwrap(), [rational(1, 2), rational(1, 2)]);
}

/// Proven distances hold those of samples, and are within 1e-6 of the largest of them.
#[test]
fn distances_are_those_of_samples() {
    const SAMPLES: i32 = 24_000;
    for (mu, to) in [
        ("1/100", rational(1, 10)),
        ("1/10", rational(1, 1)),
        ("1", rational(6, 1)),
        ("10", rational(60, 1)),
    ] {
        let rod = builtin("mass-on-fixed-bar", mu);
        let wanted = rod.wanted("velocity").unwrap();
        let (zero, end) = (Rational::default(), num_traits::ToPrimitive::to_f64(&to).unwrap());
        let times: Vec<f64> =
            (0..=SAMPLES).map(|i| end * f64::from(i) / f64::from(SAMPLES)).collect();
        let exact = doubles(&rod, "velocity", &times);
        for (what, method) in [("third", Method::Third), ("modes:10", Method::Modes { count: 10 })]
        {
            let other = rod.simpler(&what.parse().unwrap()).unwrap();
            let signal = rod.difference_on(&other, &wanted, [&zero, &to], Purpose::Search).unwrap();
            let Size { bounds, .. } = Size::of(&*signal, (9, 1 << 12), &zero).unwrap();
            let [low, high] = bounds.map(|bound| num_traits::ToPrimitive::to_f64(&bound).unwrap());
            let model = rod.signal("velocity").unwrap().values_by(&times, method).unwrap().values;
            let seen = exact.iter().zip(&model).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(seen <= high + 1e-11 && high - seen < 1e-6, "{mu} {what}: {low} {high} {seen}");
            // The same, less narrowly.
            let near = Search::new(&*signal).unwrap().largest(&zero).unwrap();
            let [less, more] = near.map(|bound| num_traits::ToPrimitive::to_f64(&bound).unwrap());
            assert!(
                less <= high && low <= more && more <= less * 1.01,
                "{mu} {what}: {less} {more}"
            );
        }
    }
}

/// After the last arrival that counts the function goes on: of a rigid mass its first piece is `e^(−s)` for ever.
#[test]
fn arrivals_that_do_not_count_leave_the_last_function() {
    let rod = builtin("mass-on-fixed-bar", "1");
    let (wanted, zero, to) = (rod.wanted("velocity").unwrap(), Rational::default(), rational(5, 1));
    let other = rod.simpler(&Simpler::Arrivals(1)).unwrap();
    let signal = rod.difference_on(&other, &wanted, [&zero, &to], Purpose::Search).unwrap();
    let exact = doubles(&rod, "velocity", &[3.0, 4.5]);
    let known = doubles(&rod, "velocity", &[1.0])[0];
    assert!((known - f64::exp(-1.0)).abs() < 1e-12);
    // The first arrival is that at 2: f_1 = e^(−s)(−2s + 1 + e^(−2)), less the second half, which the far end gives.
    let first = |s: f64| f64::exp(-s) * (f64::exp(-2.0) - 2.0 * s);
    for (time, exact) in [3.0, 4.5].into_iter().zip(exact) {
        let at = Rational::from_float(time).unwrap();
        let off = value(&*signal, &at, Limit::Right, 15, 1 << 12).unwrap().to_f64();
        assert!((off - (exact - first(time - 2.0))).abs() < 1e-12, "{time}: {off}");
    }
}

/// What is enough keeps to the tolerance at all samples, and what is not has a time at which it does not.
#[test]
fn advice_is_proven_and_has_witnesses() {
    let cases = [
        (builtin("mass-on-fixed-bar", "1/10"), "velocity", rational(1, 1), rational(1, 10)),
        (builtin("mass-on-fixed-bar", "1/10"), "velocity", rational(1, 1), rational(1, 200)),
        (builtin("struck-free-bar", "1/2"), "velocity", rational(3, 1), rational(1, 20)),
    ];
    for (problem, name, to, tolerance) in cases {
        let wanted = problem.wanted(name).unwrap();
        let zero = Rational::default();
        let need = Need { wanted: &wanted, window: [&zero, &to], tolerance };
        let advice = problem.advise(&need, &|_| ()).unwrap();
        assert!(advice.enough().is_some(), "{advice:?}");
        let scale = &advice.largest.bounds;
        for own in &advice.tried {
            let Ok(other) = problem.simpler(&own.simpler) else {
                assert!(matches!(own.verdict, Verdict::Unsuited(_)));
                continue;
            };
            let off = |time: &Rational| {
                let signal =
                    problem.difference_on(&other, &wanted, [&zero, &to], Purpose::Search).unwrap();
                let [low, high] = value(&*signal, time, Limit::Right, 9, 1 << 10).unwrap().bounds();
                low.max(-high)
            };
            match &own.verdict {
                Verdict::Misses { by, at } => {
                    assert!(*by > need.tolerance);
                    assert!(off(at) > &need.tolerance * &scale[0], "{} at {at}", own.simpler);
                }
                Verdict::Enough([least, most]) => {
                    assert!(least <= most && *most <= need.tolerance);
                    for i in 0..=64 {
                        assert!(
                            off(&(&to * rational(i, 64))) <= most * &scale[1],
                            "{}",
                            own.simpler
                        );
                    }
                }
                _ => {}
            }
        }
    }
}

/// A light mass and a soft support far away do not matter: both go, and the scene that is left is read and near.
#[test]
fn elements_that_do_not_matter_are_left_out() {
    let text = "mass hammer { mass = 1, velocity = 1 }\nbar rod { impedance = 1, travel = 1 }\n\
        mass collar { mass = 1e-5 }\nbar tail { impedance = 1, travel = 4 }\n\
        support soft { stiffness = 1e-6 }\nline free - hammer - rod - collar - tail - soft - free\n\
        observe v = velocity(hammer)";
    let problem = scene(text);
    let (wanted, zero, to) = (problem.wanted("v").unwrap(), Rational::default(), rational(11, 1));
    let tolerance = rational(1, 1000);
    let need = Need { wanted: &wanted, window: [&zero, &to], tolerance: tolerance.clone() };
    let advice = problem.advise(&need, &|_| ()).unwrap();
    let (own, changes) = advice.scene().expect("a scene is enough");
    let reduced = problem.changed(changes).unwrap();
    let text = reduced.source().text();
    assert!(!text.contains("collar") && !text.contains("soft"), "{}: {text}", own.simpler);
    let times: Vec<f64> = (0..=1100).map(|i| f64::from(i) / 100.0).collect();
    let (exact, left) = (doubles(&problem, "v", &times), doubles(&reduced, "v", &times));
    let off = exact.iter().zip(&left).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off > 0.0 && off <= 1e-3, "{off}");
}

/// Formulas of the model with a third of the mass hold its rate by name; put in, they are the values of the model.
#[test]
fn formulas_of_a_third_hold_the_rate_by_name() {
    let rod = Problem::builtin("mass-on-fixed-bar").unwrap();
    let (model, told) = rod.model(&[Change::Spring(None, None)]).unwrap();
    assert_eq!(told.as_deref(), Some("omega^2 = 3/(mu*(3 + mu))"));
    let formula = model.derive("strain_fixed", 0..=0).unwrap().remove(0);
    assert_eq!(formula.to_string(), "strain_fixed[0](s) = -omega*sin(omega*s)");
    // With mu = 1 the square of the rate is 3/4; 433013/500000 is near its root.
    let near = model.with("mu", 1).unwrap().with("omega", "433012702/500000000").unwrap();
    let third = rod.with("mu", 1).unwrap().changed(&[Change::Spring(None, None)]).unwrap();
    let (own, exact) =
        (doubles(&near, "strain_fixed", &[0.7])[0], doubles(&third, "strain_fixed", &[0.7])[0]);
    assert!((own - exact).abs() < 1e-7, "{own} {exact}");
    // Where the scene has that name, in either spelling, the rate has none.
    for name in ["omega", "ω"] {
        let text = format!("{}\nsymbol {name} > 0\n", rod.source().text());
        let named = Problem::read("named.wave", text).unwrap();
        let (_, told) = named.model(&[Change::Spring(None, None)]).unwrap();
        assert_eq!(told, None, "{name}");
    }
}

/// A vibration as a signal is the sum of its modes, with its derivatives.
#[test]
fn modes_are_a_signal() {
    let bar = builtin("struck-free-bar", "1/2");
    let (wanted, zero, to) = (bar.wanted("velocity").unwrap(), Rational::default(), rational(3, 1));
    let other = bar.simpler(&Simpler::Modes(7)).unwrap();
    let signal = bar.difference_on(&other, &wanted, [&zero, &to], Purpose::Search).unwrap();
    let times = [0.3, 1.1, 2.6];
    let exact = doubles(&bar, "velocity", &times);
    let modes = bar
        .signal("velocity")
        .unwrap()
        .values_by(&times, Method::Modes { count: 7 })
        .unwrap()
        .values;
    signal.count().unwrap();
    for ((time, exact), modes) in times.iter().zip(exact).zip(modes) {
        let at = Rational::from_float(*time).unwrap();
        let stretch = signal.stretch_at(&at, Limit::Right).unwrap().unwrap();
        let derivative = |order: usize, at: &Rational| {
            let ball = signal.enclose(stretch, order, At::Time(at), 192).unwrap();
            ball.to_double().0
        };
        assert!((derivative(0, &at) - (exact - modes)).abs() < 1e-11, "{time}");
        // Taylor polynomials of each order hold values beside their middle.
        let half = rational(1, 50);
        let beside = &at + rational(1, 100);
        for order in 0..3 {
            let near = Near { order, place: (&at, &half), terms: 24, bits: 192 };
            let taylor = signal.taylor(stretch, near).unwrap();
            let sum = taylor
                .coefficients
                .iter()
                .enumerate()
                .fold(0.0, |sum, (k, own)| sum + own.to_double().0 * 0.5_f64.powi(k as i32));
            let value = derivative(order, &beside);
            assert!(
                (sum - value).abs() < 1e-9 * value.abs().max(1.0),
                "{time} {order}: {sum} {value}"
            );
        }
    }
}

/// Constants of two scenes with one name and different values are not one: with irrational travel times arrivals stay in
/// their own order, and nothing is seen before it arrives.
#[test]
fn arrivals_of_two_scenes_keep_their_order() {
    let drill = Problem::builtin("percussive-drill").unwrap();
    let (wanted, zero) = (drill.wanted("rock_force").unwrap(), Rational::default());
    let to = rational(500, 1_000_000);
    let changes = "spring:bit,2/5+rigid:piston".parse().unwrap();
    let other = drill.simpler(&changes).unwrap();
    let signal = drill.difference_on(&other, &wanted, [&zero, &to], Purpose::Search).unwrap();
    // Nothing has come to the rock before 232 us in either.
    for time in [57, 58, 59, 100, 200] {
        let at = rational(time, 1_000_000);
        let stretch = {
            signal.count().unwrap();
            signal.stretch_at(&at, Limit::Right).unwrap().unwrap()
        };
        let off = signal.enclose(stretch, 0, At::Time(&at), 192).unwrap().to_double().0;
        assert!(off.abs() < 1e-20, "{time} us: {off}");
    }
    let [low, high] = Search::new(&*signal).unwrap().largest(&zero).unwrap();
    let [low, high] = [low, high].map(|bound| num_traits::ToPrimitive::to_f64(&bound).unwrap());
    assert!(low > 71_000.0 && high < 80_000.0, "{low} {high}");
}

/// A wave of the reduced scene may have the name of what was observed: it is not compared.
#[test]
fn observables_are_compared_with_observables() {
    let rod = scene(
        "mass m { mass = 1, velocity = 1 }\nbar rod { impedance = 1, travel = 1 }\nline free - m - rod - fixed\n\
         observe v = velocity(m)\nobserve f = displacement(rod.at(1/2))",
    );
    let other = rod.simpler(&"endless:rod.right".parse().unwrap()).unwrap();
    let (wanted, window) = (rod.wanted("f").unwrap(), [&rational(0, 1), &rational(2, 1)]);
    assert!(rod.difference_on(&other, &wanted, window, Purpose::Search).is_err());
    assert!(rod.difference_on(&other, &rod.wanted("v").unwrap(), window, Purpose::Search).is_ok());
}

#[test]
fn what_is_no_change_is_refused() {
    let spring = scene(
        "mass m { mass = 1, velocity = 1 }\nbar rod { impedance = 1, travel = 1, as = spring }\n\
         line free - m - rod - free\nobserve v = velocity(m)",
    );
    for change in ["rigid", "third", "rigid:rod"] {
        let Ok(Simpler::Scene(changes)) = change.parse() else { panic!("{change}") };
        let error = spring.changed(&changes).err().expect("it is refused").to_string();
        assert!(error.contains("is already rigid or a spring"), "{change}: {error}");
    }
}

/// A scene is no distance from itself, where the search for extremes has nothing to find.
#[test]
fn no_distance_is_below_what_is_negligible() {
    let own = Problem::builtin("percussive-drill").unwrap();
    let other = Problem::builtin("percussive-drill").unwrap();
    let (wanted, zero, to) =
        (own.wanted("rock_force").unwrap(), rational(0, 1), rational(4, 10_000));
    let signal = own.difference_on(&other, &wanted, [&zero, &to], Purpose::Search).unwrap();
    // With nothing negligible, what is not told from zero is left at its bound.
    let [low, high] = Search::new(&*signal).unwrap().largest(&zero).unwrap();
    assert!(low == zero && high < rational(1, 1_000_000), "{low} {high}");
    let size = Size::of(&*signal, (9, 1 << 12), &rational(1, 1_000_000)).unwrap();
    assert!(size.bounds[1] <= rational(1, 1_000_000) && size.places.is_empty());
}

/// At the ends of each part of a map the answer it names keeps to the tolerance and all before it do not, by distances that
/// are worked out another way: from samples, and by the search to nine digits.
#[test]
fn maps_of_what_is_enough_are_proven_at_their_ends() {
    let open = Problem::builtin("mass-on-fixed-bar").unwrap();
    let simpler: Vec<Simpler> =
        ["third", "modes:2", "echoes:2"].map(|own| own.parse().unwrap()).into();
    let range: wavestep::problem::SymbolRange = "mu=1/5..2".parse().unwrap();
    let (tolerance, window) = (rational(1, 20), [rational(0, 1), rational(2, 1)]);
    let asked = MapRequest {
        range: &range,
        points: 5,
        quantity: "velocity",
        simpler: simpler.clone(),
        tolerance: tolerance.clone(),
        window: &|_| Ok(window.clone()),
        has_usual_end: false,
    };
    let map = open.map_enough(&asked, &|_| {}).unwrap();
    let off = |mu: &Rational, simpler: &Simpler| {
        let problem = Problem::builtin("mass-on-fixed-bar").unwrap().with("mu", mu).unwrap();
        let other = problem.simpler(simpler).unwrap();
        let wanted = problem.wanted("velocity").unwrap();
        let purpose = Purpose::Search;
        let difference =
            problem.difference_on(&other, &wanted, window.each_ref(), purpose).unwrap();
        let nothing = rational(1, 1 << 40);
        let size = Size::of(&*difference, (9, 1 << 12), &nothing).unwrap();
        let mut sampled = Rational::default();
        for i in 0..400 {
            let time = rational(i, 200);
            let here = value(&*difference, &time, Limit::Right, 20, 1 << 10).unwrap();
            let [low, high] = here.bounds();
            sampled = sampled.max(low.max(-high));
        }
        // The largest velocity is that of the mass as it strikes: 1.
        assert!(sampled <= &size.bounds[1] + &nothing, "{simpler} at {mu}");
        size.bounds
    };
    for part in &map.runs {
        for mu in &part.between {
            for (place, own) in simpler.iter().enumerate() {
                let [least, most] = off(mu, own);
                match part.state {
                    Some(first) if place == first => assert!(most <= tolerance, "{own} at {mu}"),
                    Some(first) if place > first => {}
                    _ => assert!(least > tolerance, "{own} at {mu}"),
                }
            }
        }
    }
    for pair in map.runs.windows(2) {
        let [before, after] = [&pair[0].between[1], &pair[1].between[0]];
        assert!(before < after && (after - before) * rational(500, 1) < *before);
    }
    let firsts: Vec<_> = map.runs.iter().map(|part| part.state).collect();
    assert_eq!(firsts, [Some(1), Some(2)], "{:?}", map.runs);
    assert_eq!(map.columns.len(), 5);
    for column in &map.columns {
        for (own, bounds) in simpler.iter().zip(&column.off) {
            let [low, high] = bounds.clone().unwrap();
            let [least, most] = off(&column.value, own);
            assert!(low <= most && least <= high, "{own} at {}", column.value);
        }
    }
}

/// Arrivals are those of a closed form, also where a search of the quantity itself follows the scene.
#[test]
fn arrivals_are_counted_on_long_windows() {
    let problem = builtin("mass-on-fixed-bar", "1/2");
    let window = [rational(0, 1), rational(90, 1)];
    let wanted = problem.wanted("velocity").unwrap();
    let signal = problem
        .difference_on(Against::Arrivals(2), &wanted, window.each_ref(), Purpose::Search)
        .unwrap();
    let before = value(&*signal, &rational(3, 2), Limit::Right, 20, 1 << 10).unwrap();
    assert!(
        before.bounds().into_iter().all(|bound| bound.abs() < rational(1, 1 << 40)),
        "{before}"
    );
    let late = value(&*signal, &rational(80, 1), Limit::Right, 20, 1 << 12).unwrap();
    let whole = problem.signal("velocity").unwrap().at(80, 20).unwrap();
    // After two arrivals the function decays, so that nothing of it is left.
    let off = late.bounds()[0].clone() - whole.bounds()[0].clone();
    assert!(off.abs() < rational(1, 1 << 40), "{late} {whole}");
}

/// The largest absolute value is that of the smallest value, of the largest, or of both.
#[test]
fn sizes_are_those_of_values_of_either_sign() {
    let zero = Rational::default();
    let size = |problem: &Problem, name: &str, to: i64, minus: Option<Simpler>| {
        let (wanted, window) = (problem.wanted(name).unwrap(), [rational(0, 1), rational(to, 1)]);
        let others = minus.map(|minus| problem.simpler(&minus).unwrap());
        let signal = match &others {
            Some(other) => {
                problem.difference_on(other, &wanted, window.each_ref(), Purpose::Search)
            }
            None => problem.signal_on(&wanted, window.each_ref(), Purpose::Search),
        };
        Size::of(&*signal.unwrap(), (12, 1 << 12), &zero).unwrap()
    };
    let mass = builtin("mass-on-fixed-bar", "1");
    // -2 - 2 exp(-2), where the front returns.
    let strain = size(&mass, "strain_fixed", 5, None);
    let exact = Rational::from_float(2.0 + 2.0 * f64::exp(-2.0)).unwrap();
    for bound in &strain.bounds {
        assert!((bound - &exact).abs() < rational(1, 1 << 40), "{bound}");
    }
    assert_eq!(strain.places.len(), 1);
    let velocity = size(&mass, "velocity", 5, None);
    assert_eq!((velocity.bounds, velocity.places.len()), ([rational(1, 1), rational(1, 1)], 1));
    // After the n-th return a pushed bar is faster than the rigid body by 1, and just before it slower by 1.
    let pushed = Problem::builtin("pushed-bar").unwrap();
    let off = size(&pushed, "velocity", 6, Some("rigid".parse().unwrap()));
    assert_eq!(off.bounds, [rational(1, 1), rational(1, 1)]);
    let (after, before): (Vec<_>, Vec<_>) =
        off.places.iter().partition(|place| place.is_attained());
    assert_eq!((after.len(), before.len()), (4, 3), "{:?}", off.places);
}
