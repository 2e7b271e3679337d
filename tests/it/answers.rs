//! Questions that have an answer, each of which was once refused, or not answered in time.

use wavestep::problem::{Checked, Derivations, Form, Orders, ProblemError, ToDerive};
use wavestep::{Error, Method, Problem};

/// A ram, a cushion and a helmet on a pile with dashpots along it: two dashpots and a bar between two
/// bars of one impedance divide by `(δ + 2)² (4δ + 1)`.
const PILE: &str = r#"scene "A pile with dashpots"
material concrete { modulus = 40 GPa, density = 2400 kg/m^3 }
mass    ram    { mass = 5000 kg, velocity = sqrt(2*9.81*0.8) m/s }
spring  packing { stiffness = 1 GN/m }
mass    helmet { mass = 900 kg }
bar     upper  { material = concrete, diameter = 400 mm, length = 8 m }
support side1  { damping = 60 kN*s/m }
bar     middle { material = concrete, diameter = 400 mm, length = 8 m }
support side2  { damping = 60 kN*s/m }
bar     lower  { material = concrete, diameter = 400 mm, length = 8 m }
support toe    { damping = 150 kN*s/m, stiffness = 80 MN/m }
line free - ram | packing - helmet - upper - side1 - middle - side2 - lower - toe - free
observe head = force(upper.left)
observe set  = displacement(lower.right)
"#;

#[test]
fn dashpots_along_a_pile_divide_by_what_is_positive() -> Result<(), Error> {
    let closed = Problem::read("pile.wave", PILE)?;
    let open = Problem::read("pile.wave", format!("{PILE}contacts open\n"))?;
    for (quantity, time) in [("head", "4 ms"), ("head", "8 ms"), ("set", "9 ms")] {
        let value = |pile: &Problem| pile.signal(quantity)?.at(time, 12).map(|v| v.to_text(12));
        assert_eq!(value(&closed)?, value(&open)?, "{quantity} at {time}");
    }
    Ok(())
}

#[test]
fn roots_of_numbers_are_positive() -> Result<(), Error> {
    let text = "scene \"A\"\nmass m { mass = sqrt(2)/10, velocity = 1 }\n\
        bar b { impedance = 1, travel = 1 }\nline free - m - b - fixed\nobserve v = velocity(m)";
    // Until the first echo v = exp(−t/m).
    let value = Problem::read("root.wave", text)?.signal("v")?.at(1, 12)?.to_f64();
    assert!((value - (-10.0 / 2_f64.sqrt()).exp()).abs() < 1e-12);
    Ok(())
}

#[test]
fn a_load_may_act_from_pi_to_22_7() -> Result<(), Error> {
    let text = "scene \"A\"\nmass m { mass = 1 }\nload p { force = 1, from = FROM, until = UNTIL }\n\
        bar b { impedance = 1, travel = 9 }\nline free - p - m - b - free\nobserve v = velocity(m)";
    let read = |from: &str, until: &str| {
        Problem::read("pi.wave", text.replace("FROM", from).replace("UNTIL", until))
    };
    // `v = 1 − exp(−(t − π))` while the load acts.
    let v = read("pi", "22/7")?.signal("v")?.at("22/7", 9)?;
    let wanted = -(std::f64::consts::PI - 22.0 / 7.0).exp_m1();
    assert!((v.to_f64() / wanted - 1.0).abs() < 1e-8, "{v}");
    let told = read("22/7", "pi").err().expect("it ends before it begins").to_string();
    assert!(told.contains("may end before it begins"), "{told}");
    Ok(())
}

/// The rates of the node with the two supports have no closed form, so no exact arithmetic tells that waves
/// cancel at the ends: the laws there do.
#[test]
fn boundary_conditions_make_observables_zero() -> Result<(), Error> {
    let text = "scene \"A\"\nmass m { mass = 3 }\nsupport foot { damping = 2/3, stiffness = 7/5 }\n\
        spring pad { damping = 4/3, stiffness = 1/2 }\nload push { force = -2*t, until = 5/2 }\n\
        support ledge { damping = 9/5, stiffness = 13/4 }\nbar rod { impedance = 1, travel = 7/4 }\n\
        mass n_ { mass = 1 }\nbar root { impedance = 2, travel = 1 }\n\
        line free - m - foot - pad - push - ledge - rod - n_ - root - fixed\n\
        observe motion = displacement(root.right)\nobserve push_back = force(root.right)\n";
    let free = text.replace("root - fixed", "root - free");
    let [held, free] = [Problem::read("held.wave", text)?, Problem::read("free.wave", free)?];
    for (problem, zero, other) in [(&held, "motion", "push_back"), (&free, "push_back", "motion")] {
        let zero = problem.signal(zero)?;
        assert_eq!(zero.at("20/3", 30)?.to_text(30), "0");
        assert_eq!(zero.values_by(&["20/3"], Method::Certified)?.values, [0.0]);
        assert_ne!(problem.signal(other)?.at("20/3", 12)?.to_f64(), 0.0);
    }
    Ok(())
}

/// The pulse has passed and its echo arrives at this instant: of more than a hundred echoes that are not zero
/// by the laws alone few are, and their exact sum is.
#[test]
fn a_pulse_in_many_parts_that_has_passed_is_zero() -> Result<(), Error> {
    let parts = [(0, 3), (2, 8), (6, -5), (-4, -4), (-12, 6), (0, -8), (-8, 2), (-6, 1), (-5, 4)];
    let (mut loads, mut line) = (String::new(), "line free".to_owned());
    for (i, (from, slope)) in parts.into_iter().enumerate() {
        let (start, end) = (20 * i, 20 * i + 20);
        loads += &format!(
            "load p{i} {{ force = ({from} + {slope}e6*(t - {start}e-6)) kN, from = {start} us, until = {end} us }}\n"
        );
        line += &format!(" - p{i}");
    }
    let text = format!(
        "scene \"A\"\nmaterial steel {{ wave_speed = 5 km/s, density = 7800 kg/m^3 }}\n\
         bar input {{ material = steel, diameter = 20 mm, length = 2 m }}\n\
         spring sample {{ stiffness = 600 kN/mm }}\n\
         bar output {{ material = steel, diameter = 20 mm, length = 2 m }}\n\
         {loads}{line} - input - sample - output - free\nobserve gauge = strain(input.at(1/2))\n"
    );
    let gauge = Problem::read("ramps.wave", text)?.signal("gauge")?.at("0.6 ms", 15)?;
    assert_eq!(gauge.to_text(15), "0");
    Ok(())
}

/// Four named rates and springs beside dashpots: those of the third echo are too long.
#[test]
fn a_check_ends_before_formulas_are_too_long() -> Result<(), Error> {
    let soil = "damping = 60 kN*s/m, stiffness = 25 MN/m }";
    let problem = Problem::read("pile.wave", PILE.replace("damping = 60 kN*s/m }", soil)).unwrap();
    let Checked::Periods(found) = problem.check()? else { panic!("on a grid") };
    assert_eq!(found.derived, (Derivations::ByEchoes, 2));
    Ok(())
}

/// Echoes of travel times without a common measure: of many bars, numbered far beyond what any of them has returned; and
/// behind a place with four rates, where the second ones would have millions of terms.
#[test]
fn checks_of_lattices_end() -> Result<(), Error> {
    let bars = "scene \"Three materials and a specimen\"\n\
        bar a { impedance = 1, travel = 1, velocity = 1 }\nbar b { impedance = 2, travel = sqrt(2) }\n\
        bar c { impedance = 3, travel = sqrt(3) }\nbar d { impedance = 1/2, travel = sqrt(5) }\n\
        bar e { impedance = 5, travel = sqrt(7) }\n\
        line free - a | b | c - d - e - free\nobserve f = force(b.left)\n";
    let problem = Problem::read("scene", bars)?;
    let Checked::Lattice { echoes } = problem.check()? else { panic!("without a common measure") };
    assert!(echoes > 20, "{echoes}");
    let rates = "scene \"Ram, cushions, helmet\"\nmass ram { mass = 3, velocity = 1 }\n\
        spring cap { stiffness = 2, damping = 1/3 }\nmass helmet { mass = 1/2 }\n\
        spring cushion { stiffness = 5/7, damping = 1/5 }\n\
        bar follower { impedance = 1, travel = 1 }\nbar pile { impedance = 3/2, travel = sqrt(7) }\n\
        support toe { stiffness = 1/4, damping = 1/3 }\n\
        line free - ram - cap - helmet - cushion - follower - pile - toe - free\n\
        observe f = force(pile.left)\n";
    let problem = Problem::read("scene", rates)?;
    let Checked::Lattice { echoes } = problem.check()? else { panic!("without a common measure") };
    let (orders, long) = problem.first_orders(ToDerive::Waves, 0);
    assert!(echoes < 20 && long.is_some(), "{echoes} {orders:?}");
    let Orders::Through(0, through) = orders else { panic!("{orders:?}") };
    assert!(problem.functions(ToDerive::Waves, orders, Form::Echo).is_ok());
    let more = problem.functions(ToDerive::Waves, Orders::Through(0, through + 2), Form::Echo);
    assert!(matches!(more, Err(ProblemError::LongEchoes { .. })), "{more:?}");
    Ok(())
}

/// The rates of the masses are zeros of polynomials whose coefficients are themselves named: they are
/// wanted with thousands of bits, since the load has ended and the end is free.
#[test]
fn rates_are_enclosed_with_many_bits() -> Result<(), Error> {
    let text = "scene \"A\"\nload push { force = 1/3*t^2, until = 2 }\n\
        bar one { modulus = 1/4, density = 2, diameter = 3/4, length = 1, velocity = -1 }\n\
        mass m { mass = 1/8, velocity = -1 }\nsupport foot { stiffness = 1/3, damping = 1 }\n\
        spring pad { stiffness = 1 }\nmass cap { mass = 5/4, velocity = -1 }\n\
        bar two { modulus = 5/4, density = 2/5, diameter = 2/3, length = 1 }\n\
        line free - push - one | m - foot - pad - cap - two - free\n\
        observe head = strain(one.left)\nobserve v = velocity(cap)\n";
    let problem = Problem::read("masses.wave", text)?;
    assert_eq!(problem.signal("head")?.values_by(&["16/3"], Method::Certified)?.values, [0.0]);
    let v = problem.signal("v")?;
    let [few, many] = [v.at("16/3", 30)?, v.at("16/3", 300)?].map(|value| value.to_string());
    assert!(many.starts_with(&few[..28]), "{few} {many}");
    Ok(())
}

/// Echoes of a sum over all earlier periods have no closed form; pieces in balls go further.
#[test]
fn sums_over_periods_have_late_values() -> Result<(), Error> {
    let text = "recurrence \"Sums\"\nperiod 1/512, local s, time t\nwave w, total\n\
        equation w[n]' + 2*w[n] = -1 - sum(w[k], k < n)\ncontinuous w[n] starts at 0\n\
        equation total[n] = w[n] + sum(w[k], k < n)\n";
    let problem = Problem::read("sums.wave", text)?;
    let total = problem.signal("total")?;
    let value = total.at("7/8", 12)?.to_f64();
    let marched = total.values_by(&["7/8"], Method::Marched { proven: false })?.values[0];
    assert!((value - marched).abs() < 1e-11, "{value} {marched}");
    Ok(())
}

/// Two hundred seconds are far too much, by echoes and by cells: that is known, and said, before they are worked out.
#[test]
fn what_does_not_fit_into_memory_is_refused_at_once() -> Result<(), Error> {
    let text = "scene \"A\"\nmaterial brass { modulus = 100 GPa, density = 8500 kg/m^3 }\n\
        bar striker { material = brass, diameter = 20 mm, length = 250 mm, velocity = 5 m/s }\n\
        bar input { material = brass, diameter = 20 mm, length = 1250 mm }\n\
        spring sample { stiffness = 30 kN/mm }\nbar output { material = brass, diameter = 20 mm }\n\
        line free - striker - input - sample - output - endless\nobserve force = force(sample)\n";
    let problem = Problem::read("bars.wave", text)?;
    let force = problem.signal("force")?;
    for error in [force.at("200 s", 6).err(), force.roots("0 s"..="200 s", 6).err()] {
        let error = error.expect("it does not fit");
        assert!(error.is_too_much_work(), "{error}");
    }
    assert!(force.at("20 ms", 6)?.to_f64() != 0.0);
    Ok(())
}

/// Where travel times have no common measure it shows only while echoes are worked out that they are too many; then the
/// scene is followed, as it is with the statement that its contacts open, of which it has none.
#[test]
fn late_values_without_a_common_measure_are_followed() -> Result<(), Error> {
    let text = "scene \"A\"\nmass ram { mass = 2, velocity = 1 }\nspring s { stiffness = 1, damping = 1/100 }\n\
        bar rod { impedance = 1, travel = pi/3 }\nmass m { mass = 1/10 }\nbar end { impedance = 1/2, travel = 1 }\n\
        support sp { stiffness = 1/2 }\nline fixed - rod - m - end - s - ram - sp - free\n\
        observe x = displacement(end.left)";
    let value = |text: &str| -> Result<_, Error> {
        Ok(Problem::read("bars.wave", text)?.signal("x")?.at("60", 15)?.to_string())
    };
    assert_eq!(value(text)?, value(&format!("{text}\ncontacts open"))?);
    Ok(())
}

/// A scene with a local contact has thousands of cells, and no double of it is out of reach for that.
#[test]
fn doubles_beside_local_contacts_are_proven_on_long_windows() -> Result<(), Error> {
    use wavestep::answer::{Accuracy, Tolerance};
    use wavestep::signal::Limit;
    let text = "scene \"A\"\nbar a { impedance = 1, travel = 1, velocity = 1 }\nhertz h { stiffness = 2 }\n\
        bar b { impedance = 2, travel = 3/2 }\nline fixed - a - h - b - fixed\nobserve c = compression(h)";
    let problem = Problem::read("bars.wave", text)?;
    let times = ["1/2", "3", "6"].map(|time| problem.time("time", time).unwrap());
    let accuracy = Accuracy::Within(Tolerance::Relative(1e-9));
    let found = problem.doubles("c", &times, Limit::Right, accuracy).unwrap();
    let proven = problem.signal("c")?.values_by(&["1/2", "3", "6"], Method::Certified)?;
    for (proven, value) in proven.values.iter().zip(&found.values) {
        assert!((proven - value).abs() <= 1e-9, "{proven} and {value}");
    }
    Ok(())
}

/// A mass between a support and a spring that drives a bar of a small impedance: three poles, of which one is fast.
#[test]
fn a_march_tells_where_its_digits_are_lost() -> Result<(), Error> {
    let text = "scene \"A\"\nsymbol z > 0\nsupport base { stiffness = 3/2 }\nmass m { mass = 5/4, velocity = 1 }\n\
        spring k { stiffness = 4 }\nbar b { impedance = z }\nline free - base - m - k | b - endless\n\
        observe u = displacement(b.left)";
    let problem = Problem::read("soft.wave", text)?;
    let marched = Method::Marched { proven: true };
    for (impedance, is_refused) in [("1", false), ("1/10", false), ("1/1000", true)] {
        let problem = problem.with("z", impedance)?;
        let signal = problem.signal("u")?;
        let certified = signal.values_by(&["8/3"], Method::Certified)?.values[0];
        match signal.values_by(&["8/3"], marched) {
            Ok(found) if !is_refused => {
                assert!((found.values[0] - certified).abs() < 1e-8 * certified, "{impedance}");
            }
            Err(error) if is_refused => {
                assert!(error.to_string().contains("large parts cancel"), "{error}");
                assert_eq!(error.remedy().as_deref(), Some("use the method compiled or certified"));
            }
            other => panic!("{impedance}: {other:?}"),
        }
    }
    Ok(())
}

/// The wave arrives at the last time of the window.
#[test]
fn what_no_bits_tell_from_zero_is_zero() -> Result<(), Error> {
    let text = "scene \"A\"\nmass m { mass = 4 kg, velocity = 1 m/s }\n\
        bar b { impedance = 2/3 kN*s/m, travel = 1/3 ms }\n\
        spring k { stiffness = 1 MN/m, damping = 1/2 kN*s/m }\nline free - m | b - k - fixed\n\
        observe u = displacement(b.right)";
    let problem = Problem::read("first.wave", text)?;
    for method in [Method::Compiled, Method::Certified] {
        let values = problem.signal("u")?.values_by(&["1/3000 s"], method)?.values;
        assert_eq!(values, [0.0], "{method}");
    }
    Ok(())
}
