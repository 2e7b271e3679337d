//! Local contact without returning waves: the closed form of Hertz' law, the series for other
//! exponents, their inverses, and an adaptive solver of differential equations.

use ode_solvers::{DVector, Dop853, OutputType, System};
use wavestep::ball::Ball;
use wavestep_polynomial::Rational;
use wavestep_studies::hertz::{
    HertzError, LongBars, PowerLaw, distance_from_spring, equal_bars_constant,
};

fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn ball(value: &Rational) -> Ball {
    Ball::from_rational(value, 200)
}

/// Whether two enclosures may hold the same number, and both are narrow.
fn agree(a: &Ball, b: &Ball, bits: u64) -> bool {
    let difference = a.subtract(b, 400);
    let wide = ratio(1, 1) / Rational::from_integer(num_bigint::BigInt::from(1) << bits);
    let fits = |ball: &Ball| {
        let width = ball.subtract(ball, 400);
        !width.contains(&wide)
    };
    difference.contains(&ratio(0, 1)) && fits(a) && fits(b)
}

fn shares() -> Vec<Rational> {
    let mut shares = vec![ratio(1, 1_000_000_000), ratio(999_999_999, 1_000_000_000)];
    shares.extend((1..40).map(|i| ratio(i, 40)));
    shares
}

#[test]
fn closed_forms_and_series_agree() {
    let exponents = [(1, 1), (3, 2), (2, 1), (5, 2), (4, 3), (3, 1), (7, 2), (12, 5), (24, 1)];
    let below_one = [(1, 2), (2, 5), (1, 10), (3, 8), (23, 24)];
    for (top, bottom) in exponents.into_iter().chain(below_one) {
        let law = PowerLaw::new(ratio(top, bottom)).unwrap();
        assert!(wavestep::solution::Rise::new(law.exponent()).is_some());
        for share in shares() {
            let closed = law.time(&share, 160).unwrap();
            let deficit = ratio(1, 1) - &share;
            let series = law.time_by_series(&ball(&share), &ball(&deficit), 200).unwrap();
            assert!(agree(&closed, &series, 120), "{top}/{bottom} {share}: {closed} {series}");
        }
    }
}

/// Early on nothing resists: β is the time, `t̄ = φ^{1/m}` but for a part φ of it.
#[test]
fn small_shares_keep_their_digits() {
    let tenth = |power: u32| ratio(1, 10).pow(power as i32);
    for (exponent, share, time) in [
        (ratio(1, 1), tenth(60), tenth(60)),
        (ratio(3, 2), tenth(60), tenth(40)),
        (ratio(3, 2), tenth(300), tenth(200)),
        (ratio(3, 1), tenth(60), tenth(20)),
        (ratio(1, 2), tenth(60), tenth(120)),
    ] {
        let law = PowerLaw::new(exponent.clone()).unwrap();
        let near = law.time(&share, 100).unwrap().multiply_rational(&time.recip(), 200);
        assert!(agree(&near, &near, 90), "{exponent} {share}: {near}");
        assert!(ball(&(ratio(1, 1) - tenth(15))).is_below(&near), "{exponent}: {near}");
        assert!(near.is_below(&ball(&(ratio(1, 1) + tenth(15)))), "{exponent}: {near}");
        let back = law.share(&time, 100).unwrap().force.multiply_rational(&share.recip(), 200);
        assert!(agree(&back, &back, 80), "{exponent} {share}: {back}");
    }
}

#[test]
fn after_a_very_long_time_the_largest_force_is_there() {
    for exponent in [ratio(1, 10), ratio(1, 1), ratio(3, 2), ratio(100, 1)] {
        let law = PowerLaw::new(exponent.clone()).unwrap();
        let share = law.share(&ratio(10, 1).pow(300), 100).unwrap();
        assert!(agree(&share.force, &ball(&ratio(1, 1)), 90), "{exponent}: {}", share.force);
    }
}

/// Of many times that with the largest difference, and from there by thirds of an interval: another way
/// than branch and bound.
#[test]
fn the_distance_from_a_spring_is_the_largest_difference() {
    let spring = PowerLaw::new(ratio(1, 1)).unwrap();
    for exponent in [ratio(1, 2), ratio(3, 2), ratio(5, 2), ratio(6, 5)] {
        let law = PowerLaw::new(exponent.clone()).unwrap();
        let difference = |time: f64| -> f64 {
            let time: Rational = num_traits::FromPrimitive::from_f64(time).unwrap();
            let [own, other] =
                [&law, &spring].map(|law| law.share(&time, 80).unwrap().force.clone());
            let difference = own.subtract(&other, 100).to_decimal(20).midpoint().to_rational();
            num_traits::ToPrimitive::to_f64(&difference).unwrap().abs()
        };
        let times = (0..400).map(|step| f64::from(step) / 100.0);
        let near = times.max_by(|a, b| difference(*a).total_cmp(&difference(*b))).unwrap();
        let (mut low, mut high) = ((near - 0.01).max(0.0), near + 0.01);
        for _ in 0..40 {
            let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if difference(left) < difference(right) { low = left } else { high = right }
        }
        let distance = distance_from_spring(&law, 10).unwrap();
        let told = distance.to_decimal(15).midpoint().to_rational();
        let told = num_traits::ToPrimitive::to_f64(&told).unwrap();
        assert!((told - difference(low)).abs() < 2e-10, "{exponent}: {told}");
        assert!(agree(&distance, &distance, 33), "{exponent}: {distance}");
    }
}

#[test]
fn inverses_undo_the_times() {
    for exponent in [ratio(1, 1), ratio(3, 2), ratio(5, 2), ratio(1, 2), ratio(2, 7), ratio(9, 1)] {
        let law = PowerLaw::new(exponent.clone()).unwrap();
        for share in shares() {
            let time = law.time(&share, 200).unwrap();
            let back = law.share_at(&time, 120).unwrap();
            assert!(back.force.contains(&share), "{exponent} {share}: {}", back.force);
            assert!(back.deficit.contains(&(ratio(1, 1) - &share)), "{exponent} {share}");
            assert!(agree(&back.force, &ball(&share), 80), "{exponent} {share}: {}", back.force);
            // (α/α_max)^m = X/X_max
            let power = back.compression.power(&exponent, 120).unwrap();
            assert!(agree(&power, &back.force, 70), "{exponent} {share}");
        }
    }
}

/// The force goes to its limit as the exponential of `−m t̄`, and is never lost among the digits.
#[test]
fn the_limit_is_approached_exponentially() {
    for exponent in [ratio(3, 2), ratio(4, 3), ratio(2, 1), ratio(1, 3)] {
        let law = PowerLaw::new(exponent.clone()).unwrap();
        let [early, late] = [200, 201].map(|t| law.share(&ratio(t, 1), 100).unwrap());
        let factor = late.deficit.multiply(&early.deficit.reciprocal(100).unwrap(), 100);
        let limit = ball(&-exponent.clone()).exp(100).unwrap();
        assert!(agree(&factor, &limit, 60), "{exponent}: {factor} {limit}");
    }
}

/// `β' = 1 − β^m` as a system for the solver.
struct Rise(f64);

impl System<f64, DVector<f64>> for Rise {
    fn system(&self, _: f64, state: &DVector<f64>, slope: &mut DVector<f64>) {
        slope[0] = 1.0 - state[0].powf(self.0);
    }
}

#[test]
fn a_solver_of_differential_equations_agrees() {
    let mut worst = 0.0_f64;
    for (exponent, m) in [(ratio(3, 2), 1.5), (ratio(5, 2), 2.5), (ratio(1, 1), 1.0)] {
        let law = PowerLaw::new(exponent).unwrap();
        for tenths in [1_i64, 5, 10, 20, 35] {
            let end = tenths as f64 / 10.0;
            let start = DVector::from_vec(vec![0.0]);
            let mut solver = Dop853::from_param(
                Rise(m),
                0.0,
                end,
                end,
                start,
                1e-14,
                1e-14,
                0.9,
                0.0,
                0.333,
                6.0,
                end,
                0.0,
                100_000,
                1000,
                OutputType::Sparse,
            );
            solver.integrate().unwrap();
            let solved = solver.y_out().last().unwrap()[0].powf(m);
            let share = law.share(&ratio(tenths, 10), 80).unwrap();
            let exact: f64 = share.force.rounded().unwrap();
            worst = worst.max((solved - exact).abs());
        }
    }
    println!("closed form and solver differ by at most {worst:.1e}");
    assert!(worst < 1e-12, "{worst:e}");
}

/// 6.49 to 6.53 for two equal bars give the constant of 6.54, which the source has as 0.478.
#[test]
fn the_constant_of_equal_bars_follows_from_the_general_case() {
    let nu = ratio(3, 10);
    let constant = equal_bars_constant(&nu, 120).unwrap();
    // Bars of radius r = 1 with E = 1, c = 1 have Z = π; noses of radius R = 1.
    let pi = Ball::pi(200);
    let velocity = ratio(1, 1000);
    // F₀ = (4/3) E* R'² at α₀ = R' = 1/2, E* = 1/(2(1 − ν²)).
    let stiff = (ratio(2, 1) * (ratio(1, 1) - &nu * &nu)).recip();
    let force = ratio(4, 3) * stiff * ratio(1, 4);
    let bars = LongBars::new(
        PowerLaw::hertz(),
        (ball(&force), ball(&ratio(1, 2))),
        &[pi.clone(), pi],
        ball(&velocity),
        200,
    );
    let unit = bars.unwrap().time_unit.reciprocal(200).unwrap();
    let expected = constant.multiply(&ball(&velocity).power(&ratio(1, 3), 200).unwrap(), 200);
    assert!(agree(&unit, &expected, 100), "{unit} {expected}");
    assert!(!constant.contains(&ratio(478, 1000)));
    assert!(constant.to_string().starts_with("0.477333207950017951"), "{constant}");
}

#[test]
fn bad_input_is_named() {
    let law = PowerLaw::hertz();
    assert!(matches!(PowerLaw::new(ratio(-3, 2)), Err(HertzError::Exponent(_))));
    assert!(matches!(PowerLaw::new(ratio(1, 101)), Err(HertzError::Exponent(_))));
    assert!(matches!(law.time(&ratio(1, 1), 60), Err(HertzError::Share(_))));
    assert!(matches!(law.time(&ratio(-1, 10), 60), Err(HertzError::Share(_))));
    assert!(matches!(law.share(&ratio(-1, 10), 60), Err(HertzError::Time(_))));
    assert!(matches!(equal_bars_constant(&ratio(3, 5), 60), Err(HertzError::Poisson(_))));
    let one = || ball(&ratio(1, 1));
    let still = LongBars::new(law, (one(), one()), &[one(), one()], ball(&ratio(0, 1)), 60);
    let told = still.unwrap_err().to_string();
    assert!(told.contains("velocity") && told.contains("must be positive"), "{told}");
}

/// Closed forms hold until anything from a far end may be felt.
#[test]
fn closed_forms_end_before_anything_else_arrives() {
    use wavestep::language::{Source, read_scene};
    use wavestep::network::ScaledScene;
    use wavestep_studies::hertz::ContactOfScene;
    let until = |rest: &str| {
        let text = format!(
            "scene \"A\"\nbar a {{ impedance = 1, velocity = 2 }}\nhertz h {{ stiffness = 1 }}\n\
             bar b {{ impedance = 1, travel = 3 }}\n{rest}"
        );
        let scene = read_scene(&Source::new("text", &text).unwrap(), &Default::default()).unwrap();
        let scaled = ScaledScene::of(&scene).unwrap();
        ContactOfScene::new(&scaled, 60)
            .unwrap()
            .first_return
            .unwrap()
            .to_decimal(9)
            .midpoint()
            .to_string()
    };
    assert_eq!(until("line endless - a - h - b - free"), "6");
    assert_eq!(until("line endless - a - h - b - fixed"), "6");
    let more = "bar c { impedance = 1, velocity = -3 }\nline endless - a - h - b | c - endless";
    assert_eq!(until(more), "3");
    let load = "load p { force = 1 }\nline endless - a - h - b - p - free";
    assert_eq!(until(load), "3");
}

/// The first contact, followed from cell to cell, is that of the closed form in twenty digits: while the force rises, and
/// when it is as good as at its largest.
#[test]
fn what_is_followed_is_the_closed_form() {
    use wavestep_studies::hertz::ContactOfScene;
    for (scene, times) in
        [("local-contact", ["1us", "20us", "150us"]), ("hertz-striker", ["2us", "40us", "115us"])]
    {
        let problem = wavestep::Problem::builtin(scene).unwrap();
        let contact = ContactOfScene::new(problem.scaled().unwrap(), 120).unwrap();
        let signal = problem.signal("force").unwrap();
        for time in times {
            let exact = problem.time("time", time).unwrap();
            let closed = contact.bars.force(&Ball::from_rational(&exact, 200)).unwrap();
            let followed = signal.at(time, 20).unwrap().to_text(20);
            assert_eq!(followed, closed.to_decimal(20).midpoint().to_string(), "{scene} at {time}");
        }
    }
}

/// Two steel bars until the first reflection returns, at 2L/c = 120 µs: the largest force until then, and the instants at
/// which shares of the limit are there, in twenty digits.
#[test]
fn the_closed_form_holds_until_the_first_reflection_returns() {
    use wavestep_studies::hertz::ContactOfScene;
    let text = "scene \"A\"\nmaterial steel { modulus = 200 GPa, density = 8000 kg/m^3 }\n\
        bar striker { material = steel, diameter = 20 mm, length = 300 mm, velocity = 5 m/s }\n\
        hertz nose { radius = 50 mm, material = steel, poisson = 3/10 }\n\
        bar rod { material = steel, diameter = 25 mm, length = 400 mm }\n\
        line free - striker - nose - rod - free\nobserve force = force(nose)";
    let problem = wavestep::Problem::read("steel.wave", text).unwrap();
    let contact = ContactOfScene::new(problem.scaled().unwrap(), 120).unwrap();
    let signal = problem.signal("force").unwrap();
    let returns = problem.time("time", "120us").unwrap();
    assert!(contact.first_return.as_ref().unwrap().contains(&returns));
    let told = |ball: &Ball| ball.to_decimal(20).midpoint().to_string();
    let closed = contact.bars.force(&Ball::from_rational(&returns, 200)).unwrap();
    assert_eq!(signal.at(returns.clone(), 20).unwrap().to_text(20), told(&closed));
    for share in [ratio(1, 2), ratio(99, 100)] {
        let time = contact.bars.rise_time(&share).unwrap().to_decimal(36).midpoint().to_rational();
        assert!(time < returns);
        let reached = contact.bars.largest_force.multiply_rational(&share, 120);
        assert_eq!(signal.at(time, 20).unwrap().to_text(20), told(&reached), "{share}");
    }
    // A little later the reflection is felt.
    let later = problem.time("time", "130us").unwrap();
    let closed = contact.bars.force(&Ball::from_rational(&later, 200)).unwrap();
    assert_ne!(
        signal.at(later, 6).unwrap().to_text(6),
        closed.to_decimal(6).midpoint().to_string()
    );
}
