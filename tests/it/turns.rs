//! The number π: turns in exponents, and what is exact because of them.

use num_traits::One as _;
use wavestep::Problem;
use wavestep::ball::{Ball, ComplexBall, Magnitude};
use wavestep::enclosure::enclose_expression;
use wavestep::expression::{Expression, Fraction};
use wavestep_polynomial::{Rational, Symbol};

const BITS: u64 = 128;

fn named(name: &str) -> Fraction {
    Fraction::symbol(&Symbol::new(name).expect("a name"))
}

fn turn(r: &Rational) -> Fraction {
    let i = Fraction::symbol(&Symbol::square_root(-1).expect("the imaginary unit"));
    (&i * &named("pi")).scale(r)
}

fn enclosed(value: &Expression) -> ComplexBall {
    enclose_expression(value, &|_, _| None, BITS).unwrap()
}

/// `e^{iπr}` is what its ball says, for all multiples of a twenty-fourth and of a tenth in three turns; numbers in square
/// roots stand for twelfths.
#[test]
fn turns_have_their_values() {
    for (k, whole) in (-72..=72).map(|k| (k, 24)).chain((-30..=30).map(|k| (k, 10))) {
        let r = Rational::new(k.into(), whole.into());
        let exact = Expression::exponential(turn(&r));
        let has_value = 12 % i64::try_from(r.denom()).unwrap() == 0;
        assert_eq!(exact.as_fraction().is_some(), has_value, "{r}: {exact:?}");
        let exact = enclosed(&exact);
        let angle = Ball::pi(BITS).multiply_rational(&r, BITS);
        let ball = ComplexBall::new(Ball::zero(), angle).exp(BITS).unwrap();
        for (own, other) in [(exact.real(), ball.real()), (exact.imaginary(), ball.imaginary())] {
            let off = own.subtract(other, BITS);
            assert!(
                off.contains_zero() && off.to_double().1 < Magnitude::power_of_two(-100),
                "{r}: {own} and {other}"
            );
        }
    }
}

/// Powers of a turn are the turns of multiples, so that products go round and come back.
#[test]
fn turns_multiply() {
    for whole in 1..=24_i64 {
        let once = Expression::exponential(turn(&Rational::new(1.into(), whole.into())));
        let whole = u32::try_from(whole).unwrap();
        assert_eq!(once.pow(whole), Expression::integer(-1), "{whole}");
        assert!(once.pow(2 * whole).is_one(), "{whole}");
    }
}

/// However a turn is put together, it is the same: a half and two fifths are nine tenths.
#[test]
fn turns_add_up() {
    let once =
        |k: i64, whole: i64| Expression::exponential(turn(&Rational::new(k.into(), whole.into())));
    for whole in [5, 7, 8, 9, 10, 16, 25, 27, 49, 60] {
        for k in -whole..=whole {
            for m in 0..24 {
                let whole_turn = once(12 * k + m * whole, 12 * whole);
                assert_eq!(&once(k, whole) * &once(m, 12), whole_turn, "{k}/{whole} + {m}/12");
            }
            let cosine =
                Expression::cosine(&named("pi").scale(&Rational::new(k.into(), whole.into())));
            let i = Symbol::square_root(-1).expect("the imaginary unit");
            assert_eq!(cosine.conjugate(&i), cosine, "cos({k} pi/{whole})");
        }
    }
}

/// Whole turns are taken off functions of time as well.
#[test]
fn turns_are_taken_off_functions() {
    let [s, pi] = ["s", "pi"].map(named);
    let angle = |turns: i64| &(&pi * &s) + &pi.scale(&Rational::from_integer(turns.into()));
    assert_eq!(Expression::sine(&angle(2)), Expression::sine(&angle(0)));
    assert_eq!(Expression::sine(&angle(-3)), -&Expression::sine(&angle(0)));
    assert_eq!(Expression::cosine(&angle(1)), -&Expression::cosine(&angle(0)));
    let [l, m] = ["l", "m"].map(named);
    for below in [l.clone(), &(&l + &m) * &l] {
        let unit = Fraction::reciprocal(below.numerator()).unwrap();
        let angle =
            |turns: i64| &(&angle(0) * &unit) + &pi.scale(&Rational::from_integer(turns.into()));
        assert_eq!(Expression::sine(&angle(2)), Expression::sine(&angle(0)));
        assert_eq!(Expression::sine(&angle(5)), -&Expression::sine(&angle(0)));
        assert_ne!(Expression::sine(&angle(0)), -&Expression::sine(&angle(0)));
    }
    let third = &angle(0) + &pi.scale(&Rational::new(1.into(), 3.into()));
    let sum =
        &Expression::sine(&third) + &Expression::sine(&(&third - &pi.scale(&Rational::one())));
    assert!(sum.is_zero(), "{sum:?}");
}

/// A mass alone under a whole period of a sine is at rest afterwards, exactly; half a period gives it `2/π`.
#[test]
fn a_whole_period_leaves_a_mass_at_rest() {
    let text = "scene \"Push and pull\"\nmass m { mass = 1 }\n\
                load p { force = sin(pi*t), from = 0, until = 2 }\nline free - p - m - free\n\
                observe v = velocity(m)\nobserve P = momentum(m)\nobserve E = energy(m)\n";
    let problem = Problem::read("text", text).unwrap();
    for (name, half) in
        [("v", "0.636619772367581"), ("P", "0.636619772367581"), ("E", "0.202642367284676")]
    {
        let signal = problem.signal(name).unwrap();
        assert_eq!(signal.at("1", 15).unwrap().to_text(15), half, "{name}");
        for time in ["2", "3", "100", "2.7", "17/8"] {
            assert_eq!(signal.at(time, 15).unwrap().to_text(15), "0", "{name}({time})");
        }
    }
}

/// After a part of a sine an endless bar is at rest, whenever that is asked.
#[test]
fn a_cut_sine_leaves_an_endless_bar_at_rest() {
    for until in ["1/2", "1/4", "1/3", "5/6", "3/2", "1", "7/10", "5/8"] {
        let text = format!(
            "scene \"Cut\"\nbar rod {{ impedance = 1 }}\nload blow {{ force = sin(pi*t), until = {until} }}\n\
             line free - blow - rod - endless\nobserve v = velocity(blow)\n"
        );
        let problem = Problem::read("text", text).unwrap();
        let signal = problem.signal("v").unwrap();
        for time in ["1.6", "1.71", "1.8", "1.9", "13/8", "17/9"] {
            assert_eq!(signal.at(time, 15).unwrap().to_string(), "0", "until {until} at {time}");
        }
    }
}

/// A recurrence may hold π, in rates and in angles, and its values are those of the number.
#[test]
fn recurrences_hold_pi() {
    let text = "recurrence \"Rate π\"\nperiod 1, local s, time t\nwave f\n\
                equation f[n]' + pi*f[n] = f[n-1]\ncontinuous f[n] starts at 1\n";
    let problem = Problem::read("text", text).unwrap();
    assert!(problem.symbols().is_empty());
    let signal = problem.signal("f").unwrap();
    // On the second period the wave is e^{−πs} (s + e^{−π}).
    let pi = std::f64::consts::PI;
    let wanted = (-pi / 2.0).exp() * (0.5 + (-pi).exp());
    assert!((signal.at("3/2", 15).unwrap().to_f64() - wanted).abs() < 1e-15);
}

/// A mass on a spring, driven at its own rate π, which no formula tells from the rate of the load: `x = (sin πt − πt cos πt)/(2π²)`,
/// and afterwards it swings on.
#[test]
fn resonance_with_a_rate_of_pi_is_followed() {
    let text = "scene \"Resonance\"\nmass one { mass = 1 }\nspring k { stiffness = pi^2 }\n\
                load f { force = sin(pi*t), until = 2 }\nline fixed - k - one - f - free\n\
                observe x = displacement(one)\n";
    let problem = Problem::read("text", text).unwrap();
    let signal = problem.signal("x").unwrap();
    let largest = std::f64::consts::FRAC_1_PI;
    for (time, wanted) in [("1", largest / 2.0), ("2", -largest), ("3", largest)] {
        let off = signal.at(time, 12).unwrap().to_f64() - wanted;
        assert!(off.abs() < 1e-12, "{time}: {off:e}");
    }
}

/// A haversine on a rod whose mass is held by a spring: pieces divide by a quadratic in π and in named constants.
#[test]
fn haversines_with_units_have_pieces() {
    let text = "scene \"Haversine\"\nmaterial ti { modulus = 114 GPa, density = 4430 kg/m^3 }\n\
                bar rod { material = ti, diameter = 16 mm, length = 900 mm }\nmass tip { mass = 150 g }\n\
                support ground { stiffness = 8 kN/mm }\n\
                load push { force = 10 - 10*cos(10000*pi*t) kN, until = 200 us }\n\
                line free - push - rod - tip - ground - free\nobserve x = displacement(tip)\n";
    let problem = Problem::read("text", text).unwrap();
    assert!(problem.check().is_ok());
}
