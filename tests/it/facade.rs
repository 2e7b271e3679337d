//! What people use: the same answers as the layers beneath, in fewer words, and errors where there are none.

use wavestep::{
    Error, EventKind, Goal, Method, Place, Problem, Rational, Root, Tolerance, Value, scenes,
};

fn mass() -> Problem {
    Problem::builtin("rigid-mass").and_then(|mass| mass.with("mu", 1)).unwrap()
}

fn ratio(above: i64, below: i64) -> Rational {
    Rational::new(above.into(), below.into())
}

#[test]
fn the_example_of_the_readme_has_thirty_digits() -> Result<(), Error> {
    let problem = Problem::builtin("rigid-mass")?.with("mu", "1/4")?;
    let value = problem.signal("f")?.at("33/10", 30)?;
    assert_eq!(value.to_string(), "0.305385264408791064086396952466");
    assert_eq!(Ok(value.to_f64()), value.to_string().parse());
    Ok(())
}

/// A value given in any way is the same number; a double is its exact value.
#[test]
fn numbers_are_taken_as_they_come() -> Result<(), Error> {
    let problem = mass();
    let signal = problem.signal("strain_fixed")?;
    let exact = signal.at("5/2", 20)?;
    let half = ratio(5, 2);
    for value in [signal.at(2.5, 20)?, signal.at(&half, 20)?, signal.at(half.clone(), 20)?] {
        assert_eq!(value, exact);
    }
    assert_eq!(signal.at(3, 20)?, signal.at("3".to_owned(), 20)?);
    assert_ne!(signal.at(2.6, 30)?, signal.at("2.6", 30)?);
    assert!(signal.at(f64::NAN, 30).is_err_and(|error| error.is_bad_input()));
    Ok(())
}

#[test]
fn what_cannot_be_answered_is_an_error() {
    let problem = mass();
    let signal = problem.signal("velocity").unwrap();
    let errors = [
        signal.at(1, 0).err(),
        signal.at(1, 10_001).err(),
        signal.at(-1, 10).err(),
        signal.at("one and a half", 10).err(),
        signal.roots(0..=2, 0).err(),
        signal.extremum(Goal::Largest, 2..=2, 5).err(),
        signal.breaks("3"..="1", 5).err(),
        problem.events_until(1, 0).err(),
        problem.signal("speed").err(),
        problem.derive("speed", 0..=1).err(),
        problem.field("1", 0).err(),
        problem.with("mu", -1).err(),
        Problem::builtin("rigid").err(),
        "nearly".parse::<Tolerance>().err().map(Error::from),
        "magic".parse::<Method>().err().map(Error::from),
    ];
    for (place, error) in errors.into_iter().enumerate() {
        let error = error.unwrap_or_else(|| panic!("answered: {place}"));
        assert!(error.is_bad_input(), "{place}: {error}");
        let is_told = error.to_string().contains("give ") || !error.diagnostics().is_empty();
        assert!(error.remedy().is_some() || is_told, "{place}: {error}");
    }
    let unset = Problem::builtin("rigid-mass").unwrap();
    assert!(unset.signal("velocity").unwrap().at(1, 10).is_err());
}

/// Limits from both sides of every break agree with what lies beside it, and differ where it jumps.
#[test]
fn breaks_and_limits_from_the_left() -> Result<(), Error> {
    let problem = mass();
    let strain = problem.signal("strain_fixed")?;
    let breaks = strain.breaks("0"..="6", 9)?;
    let times: Vec<f64> = breaks.iter().map(Value::to_f64).collect();
    assert_eq!(times, [1.0, 3.0, 5.0]);
    assert_eq!(strain.before(1, 9)?.exact(), Some(&ratio(0, 1)));
    assert_eq!(strain.at(1, 9)?.exact(), Some(&ratio(-2, 1)));
    let near = strain.at("2999999/1000000", 9)?.to_f64();
    assert!((strain.before(3, 9)?.to_f64() - near).abs() < 1e-5);
    Ok(())
}

#[test]
fn roots_extrema_and_doubles_agree_with_digits() -> Result<(), Error> {
    let problem = mass();
    let strain = problem.signal("strain_impact")?;
    let found = strain.roots(2..=4, 30)?;
    let Root::Simple { time, .. } = &found.all[0] else { panic!("{found:?}") };
    let [from, to] = time.bounds();
    let signs = [from, to].map(|time| strain.at(time, 40).map(|value| value.to_f64() > 0.0));
    assert!(matches!(signs, [Ok(false), Ok(true)]), "{time}");
    let level = strain.crossings("-1/2", 0..=2, 12)?;
    assert!(level.all.iter().any(|root| matches!(root, Root::Simple { rises: true, .. })));
    let most = strain.extremum(Goal::Smallest, 0..=4, 15)?;
    let Place::Arrival { time, .. } = &most.places[0] else { panic!("{most:?}") };
    assert_eq!(strain.at(time.exact().unwrap(), 15)?.to_string(), most.value.to_string());

    let times: Vec<f64> = (0..50).map(|i| f64::from(i) / 10.0).collect();
    let found = strain.values(&times, Tolerance::Absolute(1e-12))?;
    let certified = strain.values_by(&times, Method::Certified)?;
    assert_eq!((certified.method, found.values.len()), (Method::Certified, 50));
    for (i, time) in times.iter().enumerate() {
        let exact = strain.at(*time, 25)?.to_f64();
        assert_eq!(certified.values[i], exact, "correctly rounded at {time}");
        assert!((found.values[i] - exact).abs() <= 1e-12, "at {time}");
    }
    Ok(())
}

/// A window that is compiled once, and values rounded by the slice, agree with digits, in any order.
#[test]
fn slices_of_doubles_agree_with_digits() -> Result<(), Error> {
    let problem = mass();
    let strain = problem.signal("strain_impact")?;
    let curve = strain.compiled(0..=6, None)?;
    let rough = strain.compiled("0"..="6", Some(Tolerance::Absolute(1e-6)))?;
    assert_eq!(curve.window(), [0.0, 6.0]);
    assert!(curve.bound() < 1e-14 && rough.bound() <= 1e-6 && curve.law().contains("proven"));
    // More than are worked out at a time, backwards at the end.
    let step = 6.0 / 600_000.0;
    let mut times: Vec<f64> = (0..600_000).map(|i| f64::from(i) * step).collect();
    times[530_000..].reverse();
    let (mut values, mut others) = (vec![0.0; times.len()], vec![0.0; times.len()]);
    curve.values(&times, &mut values)?;
    rough.values(&times, &mut others)?;
    for i in (0..times.len()).step_by(20_001) {
        let mut exact = [0.0];
        strain.rounded(&times[i..=i], &mut exact)?;
        assert_eq!(exact[0], strain.at(times[i], 25)?.to_f64(), "at {}", times[i]);
        assert!((values[i] - exact[0]).abs() <= curve.bound() + f64::EPSILON, "at {}", times[i]);
        assert!((others[i] - exact[0]).abs() <= rough.bound() + f64::EPSILON, "at {}", times[i]);
    }
    strain.rounded(&[], &mut [])?;
    for wrong in [-0.5, 6.5, f64::NAN, f64::INFINITY] {
        let mut values = [0.0; 3];
        let errors = [[0.0, 1.0, wrong], [wrong, 1.0, 0.5]].map(|times| {
            curve.values(&times, &mut values).is_err_and(|error| error.is_bad_input())
        });
        assert_eq!(errors, [true, true], "{wrong}");
        let rounded = strain.rounded(&[0.0, wrong, 1.0], &mut values);
        assert_eq!(rounded.is_err(), wrong != 6.5, "{wrong}");
    }
    Ok(())
}

/// Where contacts open the same is asked in the same way.
#[test]
fn contacts_that_open_have_the_same_surface() -> Result<(), Error> {
    let problem = Problem::builtin("saint-venant")?.with("mu", 1)?;
    let history = problem.events(12)?;
    let [impact, opening, ..] = &history.events[..] else { panic!("two events") };
    assert_eq!((impact.kind, opening.kind), (EventKind::Impact, EventKind::Opening));
    let force = problem.signal(problem.observables()[0])?;
    let breaks = force.breaks(0..=4, 9)?;
    assert!(breaks.iter().any(|time| (time.to_f64() - opening.time.to_f64()).abs() < 1e-8));
    let times = [0.5, 1.5, 3.0, 3.5];
    let found = force.values(&times, Tolerance::Absolute(1e-9))?;
    for (time, value) in times.iter().zip(&found.values) {
        assert!((force.at(*time, 20)?.to_f64() - value).abs() <= 1e-9, "at {time}");
    }
    assert!(problem.signal(problem.waves()[0]).is_err());
    Ok(())
}

/// Formulas are equal where they are the same function, whatever they are called.
#[test]
fn formulas_compare_by_mathematics() -> Result<(), Error> {
    let problem = Problem::builtin("rigid-mass")?;
    let [zero, one] = &problem.derive("f", 0..=1)?[..] else { panic!("two formulas") };
    assert_eq!((zero.order(), one.order()), (Some(0), Some(1)));
    assert_eq!(one, &problem.derive("f", 1..=1)?[0]);
    assert_ne!(zero, one);
    assert!(one.equals("(1 - 2*s + exp(-2*μ))/exp(s)")? && !one.equals("exp(-s)")?);
    assert!(one.equals("exp(-s").is_err());
    let [first, last] = [2, 1];
    assert!(problem.derive("f", first..=last)?.is_empty());
    assert_eq!(problem.derive("velocity", 0..=2)?.len(), 3);
    let lattice = Problem::builtin("incommensurate")?;
    assert!(lattice.derive(lattice.waves()[0], 0..=2)?.iter().all(|echo| echo.order().is_none()));
    Ok(())
}

/// Rational values round correctly, ties to even, whatever their size.
#[test]
fn rational_values_round_correctly() {
    for (above, below, double) in [
        (1, 3, 1.0 / 3.0),
        ((1 << 53) + 1, 1, 9007199254740992.0),
        ((1 << 53) + 3, 1, 9007199254740996.0),
        (-1, 10, -0.1),
        (0, 1, 0.0),
    ] {
        assert_eq!(Value::Exact(ratio(above, below)).to_f64(), double);
    }
}

/// All that is built in can be read, has names, and tells which symbols it waits for.
#[test]
fn every_scene_has_a_surface() -> Result<(), Error> {
    for scene in scenes::SCENES {
        let problem = Problem::builtin(scene.name)?;
        assert_eq!(problem.title(), scene.title());
        for symbol in problem.symbols() {
            assert!(scene.text.contains(symbol) || symbol == "mu", "{symbol} in {}", scene.name);
        }
        for name in problem.observables() {
            assert_eq!(problem.signal(name)?.name(), name);
        }
    }
    Ok(())
}

/// A tolerance relative to values that doubles cannot tell from zero is refused, and digits answer.
#[test]
fn tolerances_of_tiny_values_are_refused() -> Result<(), Error> {
    for velocity in ["1e-200", "1e-305", "1e-400"] {
        let text = format!(
            "scene \"Tiny\"\nbar a {{ impedance = 1, travel = 1, velocity = {velocity} }}\n\
             bar b {{ impedance = 1, travel = 2 }}\nline free - a - b - free\n\
             observe v = velocity(b.left)\nobserve e = energy(b)"
        );
        let problem = Problem::read("tiny", &text)?;
        for (name, is_told) in [("v", velocity == "1e-200"), ("e", false)] {
            let signal = problem.signal(name)?;
            assert!(signal.at("1/2", 20)?.bounds()[0] > ratio(0, 1), "{name}");
            for tolerance in [Tolerance::Relative(1e-9), Tolerance::Ulps(1.0)] {
                let doubles = signal.values(&["1/2"], tolerance);
                assert_eq!(doubles.is_ok(), is_told, "{name} {velocity}: {doubles:?}");
            }
            // In the unit of the values zero is near enough.
            assert!(signal.values(&["1/2"], Tolerance::Absolute(1e-9)).is_ok());
        }
    }
    Ok(())
}

/// Waves and the local time have other names where a scene calls symbols so.
#[test]
fn symbols_keep_their_names() -> Result<(), Error> {
    let scene = |mass: &str, travel: &str| {
        let text = format!(
            "scene \"Names\"\nsymbol {mass} > 0\nsymbol {travel} > 0\n\
             mass m {{ mass = {mass}, velocity = 1 }}\n\
             bar rod {{ impedance = 1, travel = {travel} }}\nline free - m - rod - fixed\n"
        );
        Problem::read("names", &text)
    };
    let texts = |problem: Problem, wave: &str| {
        Ok::<_, Error>(
            problem.derive(wave, 0..=3)?.iter().map(|own| own.text()).collect::<Vec<_>>(),
        )
    };
    let plain = texts(scene("a", "b")?, "f")?;
    let renamed = texts(scene("f", "s")?, "f_")?;
    let with = |text: &String| {
        text.replace("f_", "F").replace("s_", "S").replace('f', "a").replace('s', "b")
    };
    let renamed: Vec<String> =
        renamed.iter().map(|text| with(text).replace('F', "f").replace('S', "s")).collect();
    let joined = |texts: &[String]| texts.join(" ").split_whitespace().collect::<String>();
    assert_eq!(joined(&renamed), joined(&plain));
    Ok(())
}
