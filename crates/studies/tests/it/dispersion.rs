//! Dispersion: formulas and their derivatives, certified quadrature against closed forms and against
//! another rule, cut-offs, errors, and pulses on their way.

use crate::snapshot;
use num_traits::ToPrimitive as _;
use proptest::prelude::*;
use std::collections::BTreeMap;
use wavestep::ball::{Ball, Value};
use wavestep::language::{Diagnostic, Source};
use wavestep_polynomial::{Rational, Symbol};
use wavestep_studies::dispersion::{
    Builtin, Component, DispersionError, Formula, Pulse, Quantity, Relation, Shape,
    exact_peak_velocity, peak_velocity, peak_velocity_at, peak_velocity_by_quadrature,
    peak_velocity_of_sum, propagate,
};
use wavestep_studies::dispersion::{formula_latex, formula_text, read_relation, read_spectrum};

const BITS: u64 = 2000;

fn rational(above: i64, below: i64) -> Rational {
    Rational::new(above.into(), below.into())
}

fn try_read(text: &str) -> Result<Relation, Diagnostic> {
    read_relation(&Source::new("relation", text)?, &BTreeMap::new())
}

fn read(text: &str) -> Relation {
    try_read(text).unwrap_or_else(|error| panic!("{error}"))
}

fn spectrum(text: &str) -> Formula {
    read_spectrum(&Source::new("spectrum", text).unwrap()).unwrap()
}

/// All relations that have names, with parameters set to 1/2 where numbers are needed.
fn with_numbers(one: Builtin) -> Relation {
    let parameters = one.relation().parameters();
    let values = parameters.iter().map(|symbol| (symbol.name().to_owned(), rational(1, 2)));
    one.relation().with_values(&values.collect()).unwrap()
}

#[test]
fn relations_that_have_names_look_like_this() {
    let mut shown = String::new();
    for one in Builtin::ALL {
        let relation = one.relation();
        shown += &format!("{}: {}\n", one.name(), one.title());
        for (name, formula) in [
            ("omega", relation.frequency()),
            ("c_p", relation.formula(Quantity::PhaseVelocity)),
            ("c_g", relation.formula(Quantity::GroupVelocity)),
        ] {
            shown += &format!("  {name} = {}\n", formula_text(formula));
            shown += &format!("      {}\n", formula_latex(formula));
        }
        for shape in Shape::ALL {
            if let Some(formula) = exact_peak_velocity(&relation, shape) {
                shown += &format!("  c_pp, {} = {}\n", shape.name(), formula_text(&formula));
                shown += &format!("      {}\n", formula_latex(&formula));
            }
        }
    }
    snapshot("dispersion", "relations", "all relations that have names", &shown);
}

const FORMULAS: [&str; 26] = [
    "k",
    "-k",
    "2*k - 1",
    "k - k^3/12",
    "k^2 + 3*k - 1/7",
    "(1 + k)^3*(2 - k)",
    "k*sqrt(1 + k^2/12)",
    "k/sqrt(1 + a*k^2)",
    "sqrt(k*tanh(k))",
    "sqrt(k*tanh(h*k)) + 1/k",
    "2*sin(k/2)",
    "sin(1 - k)*cos(-k)",
    "(sin(k) + cos(k))^2/k",
    "exp(-k^2)*exp(k)",
    "exp(k)^2 - 1",
    "k^(3/2) - k^(-2/3)",
    "(1 + k)^(2/3)/(1 + k)^(5/3)",
    "1/(1 + k) - k/(1 + k)^2",
    "(k^2 - 1)/(k - 1)",
    "sinc(k/2)^2",
    "sinc(k)*k",
    "sqrt(2)*k*sqrt(8)",
    "sqrt(3*k^2 + 6)",
    "pi*k/(pi + k)",
    "sqrt((1 + k)*(2 + sin(k)))",
    "-(1 + k)*(k - sin(k))/sqrt(1 + k)",
];

/// What is printed is read back as the same formula; so is what is derived from it.
#[test]
fn text_is_read_back() {
    for text in FORMULAS {
        let relation = read(text);
        for formula in [
            relation.frequency(),
            relation.formula(Quantity::PhaseVelocity),
            relation.formula(Quantity::GroupVelocity),
        ] {
            let printed = formula_text(formula);
            let whole = format!("k*0 + {printed}");
            match try_read(&whole) {
                Ok(again) => assert_eq!(again.frequency(), formula, "{text}: {printed}"),
                // A constant is no relation.
                Err(error) => {
                    assert!(error.message().contains("does not depend"), "{printed}: {error}")
                }
            }
        }
    }
}

#[test]
fn equal_formulas_have_one_form() {
    for (left, right) in [
        ("k*(1 + k)", "k + k^2"),
        ("(1 + k)^2 - (1 - k)^2", "4*k"),
        ("sqrt(4*k^2)", "2*k"),
        ("sqrt(k)*sqrt(k)", "k"),
        ("sqrt(1 + k)*sqrt(1 + k)", "1 + k"),
        ("exp(k)*exp(2*k)", "exp(3*k)"),
        ("sin(-k)", "-sin(k)"),
        ("(k - k^3)/k*k", "k - k^3"),
        ("sqrt(2)*sqrt(2)*k", "2*k"),
        ("(8*k^3)^(1/3)", "2*k"),
        ("sqrt(1 + k) + k^2/sqrt(1 + k)", "(1 + k + k^2)/sqrt(1 + k)"),
        ("k + 1/(1 + k) - 1/(k + 1)", "k"),
    ] {
        assert_eq!(read(left), read(right), "{left}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// The symbolic derivative agrees with a difference quotient, taken with 300 bits.
    #[test]
    fn derivatives_are_derivatives(which in 0..FORMULAS.len(), a in 1_i64..400, b in 100_i64..300) {
        let values: BTreeMap<String, Rational> =
            ["a", "h"].map(|name| (name.to_owned(), rational(2, 3))).into();
        let relation = read(FORMULAS[which]);
        let known = relation.parameters();
        let values = values.into_iter().filter(|(name, _)| known.iter().any(|x| x.name() == name));
        let relation = relation.with_values(&values.collect()).unwrap();
        let (k, step, bits) = (rational(a, b), rational(1, 1 << 40), 300);
        let at = |what, k: &Rational| relation.enclose(what, &Ball::from_rational(k, bits), bits);
        let both = (
            at(Quantity::Frequency, &(&k + &step)),
            at(Quantity::Frequency, &(&k - &step)),
            at(Quantity::GroupVelocity, &k),
        );
        if let (Ok(after), Ok(before), Ok(slope)) = both {
            let quotient = after.subtract(&before, bits).multiply_rational(&(step.recip() / rational(2, 1)), bits);
            // The third derivative of none of them exceeds 10⁹ on k ≥ 1/300.
            let near = Ball::symmetric(&rational(1, 1 << 40));
            let close = quotient.subtract(&slope, bits).add(&near, bits);
            let known = close.contains(&rational(0, 1));
            prop_assert!(known, "{} at {k}: {quotient} {slope}", FORMULAS[which]);
        }
    }

    /// A ball of wavenumbers gives a ball that holds the values at its points.
    #[test]
    fn enclosures_hold_all_points(
        which in 0..FORMULAS.len(), a in 1_i64..400, radius in 0_i64..50, share in -16_i64..=16,
    ) {
        let relation = read(&FORMULAS[which].replace(['a', 'h'], "(2/3)").replace("t(2/3)n(2/3)", "tanh"));
        let bits = 80;
        let middle = rational(a, 100);
        let radius = &middle * rational(radius, 100);
        let point = &middle + &radius * rational(share, 16);
        let ball = Ball::from_rational(&middle, bits).add(&Ball::symmetric(&radius), bits);
        for what in [Quantity::Frequency, Quantity::PhaseVelocity, Quantity::GroupVelocity] {
            let all = relation.enclose(what, &ball, bits);
            let one = relation.enclose(what, &Ball::from_rational(&point, 200), 200);
            if let (Ok(all), Ok(one)) = (all, one) {
                let middle = one.to_decimal(50).midpoint().to_rational();
                prop_assert!(all.contains(&middle), "{} at {point}: {all} {one}", FORMULAS[which]);
            }
        }
    }
}

/// Closed forms and quadrature, two derivations, agree to thirty digits.
#[test]
fn closed_forms_agree_with_quadrature() {
    let relations = ["k - k^3/12", "k^2", "k + k^2/3 - k^3/50", "1 + k^2", "k^5"];
    let mut compared = 0;
    for text in relations {
        let relation = read(text);
        for shape in [Shape::Square, Shape::Triangle] {
            for length in [rational(10, 1), rational(7, 2)] {
                let pulse = Pulse::in_space(shape, &length).unwrap();
                let peak = peak_velocity(&relation, &pulse, 30, BITS).unwrap();
                let quadrature = peak_velocity_by_quadrature(&relation, &pulse, 30, BITS);
                let decimal = quadrature.unwrap().to_string();
                assert_eq!(peak.value.to_string(), decimal, "{text}, {}", shape.name());
                compared += usize::from(peak.exact.is_some());
            }
        }
    }
    // All but the triangle where ω(0) is not zero, which needs the sine integral.
    assert_eq!(compared, 18);
}

/// `c_pp = 1 − (π² − 6)/(3b²)` for the square pulse on `ω = k − k³/12`, worked out by hand.
#[test]
fn the_square_pulse_on_the_cubic_relation() {
    let exact = exact_peak_velocity(&Builtin::Cubic.relation(), Shape::Square).unwrap();
    let (pi, b) = ("pi", "b").map_names();
    let expected = Formula::number(&rational(1, 1)).subtract(
        &pi.multiply(&pi)
            .subtract(&Formula::number(&rational(6, 1)))
            .multiply(&Formula::number(&rational(1, 3)))
            .divide(&b.multiply(&b))
            .unwrap(),
    );
    assert_eq!(exact, expected);
}

trait Names {
    fn map_names(self) -> (Formula, Formula);
}

impl Names for (&str, &str) {
    fn map_names(self) -> (Formula, Formula) {
        let symbol = |name| Formula::symbol(&Symbol::new(name).unwrap());
        (symbol(self.0), symbol(self.1))
    }
}

/// Gauss's rule in doubles, on many panels.
fn gauss(f: impl Fn(f64) -> f64, upper: f64) -> f64 {
    let nodes = [
        0.148_874_338_981_631_2,
        0.433_395_394_129_247_2,
        0.679_409_568_299_024_4,
        0.865_063_366_688_984_5,
        0.973_906_528_517_171_7,
    ];
    let weights = [
        0.295_524_224_714_752_87,
        0.269_266_719_309_996_35,
        0.219_086_362_515_982_04,
        0.149_451_349_150_580_6,
        0.066_671_344_308_688_14,
    ];
    let panels = 200;
    let half = upper / (2.0 * f64::from(panels));
    let panel = |i: i32| {
        let middle = half * f64::from(2 * i + 1);
        let pair = |(x, w): (&f64, &f64)| w * (f(middle - half * x) + f(middle + half * x));
        half * nodes.iter().zip(&weights).map(pair).sum::<f64>()
    };
    (0..panels).map(panel).sum()
}

fn double(value: &Value) -> f64 {
    match value {
        Value::Exact(value) => value.to_f64().unwrap(),
        other => other.decimal(17).0.to_rational().to_f64().unwrap(),
    }
}

/// The certified quadrature against Gauss's rule with functions of the standard library.
#[test]
fn quadrature_agrees_with_another_rule() {
    type Real = fn(f64) -> f64;
    let frequencies: [(&str, Real); 6] = [
        ("2*sin(k/2)", |k| 2.0 * (k / 2.0).sin()),
        ("k*sqrt(1 + k^2/12)", |k| k * (1.0 + k * k / 12.0).sqrt()),
        ("k/sqrt(1 + k^2/2)", |k| k / (1.0 + k * k / 2.0).sqrt()),
        ("sqrt(k*tanh(k))", |k| (k * k.tanh()).sqrt()),
        ("k^(4/3)", |k| k.powf(4.0 / 3.0)),
        ("k - k^3/12", |k| k - k * k * k / 12.0),
    ];
    let sinc = |z: f64| if z == 0.0 { 1.0 } else { z.sin() / z };
    let b = 5.0;
    for (text, omega) in frequencies {
        for shape in Shape::ALL {
            let spectrum = |k: f64| match shape {
                Shape::Square => sinc(k * b / 2.0),
                Shape::Triangle => sinc(k * b / 4.0).powi(2),
                Shape::Gaussian => (-k * k * b * b / 16.0).exp(),
            };
            let upper = 2.0 * std::f64::consts::PI / b;
            let seen = gauss(|k| spectrum(k) * k * omega(k), upper)
                / gauss(|k| spectrum(k) * k * k, upper);
            let pulse = Pulse::in_space(shape, &rational(5, 1)).unwrap();
            let peak = double(&peak_velocity(&read(text), &pulse, 16, BITS).unwrap().value);
            assert!((peak - seen).abs() < 1e-12, "{text} {}: {peak} {seen}", shape.name());
            let sample = peak_velocity_at(&read(text), shape, upper).unwrap();
            assert!((sample.value - peak).abs() < 1e-14 && sample.bound < 1e-12, "{text}");
        }
    }
}

/// `∫_0^K √k·…`: a spectrum of one's own, with a root at zero; `∫ k^{a} dk` is known.
#[test]
fn spectra_of_ones_own() {
    let pulse = Pulse::in_space(Shape::Square, &rational(4, 1)).unwrap();
    // U = 1: c_pp = (K⁴/4 − K⁶/72)/(K³/3)·… for ω = k − k³/12: 1·3/3 … = 1 − K²/20.
    let flat = pulse.with_spectrum(spectrum("1")).unwrap();
    let peak = peak_velocity(&Builtin::Cubic.relation(), &flat, 20, BITS).unwrap();
    let square =
        Ball::pi(200).multiply(&Ball::pi(200), 200).multiply_rational(&rational(1, 80), 200);
    let expected = Ball::from_rational(&rational(1, 1), 200).subtract(&square, 200);
    let Value::Certified { decimal, .. } = peak.value else { panic!("π is in it") };
    assert_eq!(decimal.to_string(), expected.to_decimal(20).midpoint().to_string());
    // ω = √k, U = 1: (2/5 K^{5/2})/(K³/3) = 6/(5 √K), K = π/2.
    let peak = peak_velocity(&read("sqrt(k)"), &flat, 20, BITS).unwrap();
    let root = Ball::pi(200).multiply_rational(&rational(1, 2), 200).sqrt(200).unwrap();
    let expected = root.reciprocal(200).unwrap().multiply_rational(&rational(6, 5), 200);
    assert_eq!(peak.value.to_string(), expected.to_decimal(20).midpoint().to_string());
    // No second moment, no peak.
    let none = pulse.with_spectrum(spectrum("0*k")).unwrap();
    let error = peak_velocity(&Builtin::Cubic.relation(), &none, 10, 300).unwrap_err();
    assert_eq!(error, DispersionError::NoPeak);
}

/// Many waves close together are the integral.
#[test]
fn finite_sums_tend_to_the_integral() {
    let relation = Builtin::Lattice.relation();
    let pulse = Pulse::in_space(Shape::Gaussian, &rational(6, 1)).unwrap();
    let integral = double(&peak_velocity(&relation, &pulse, 16, BITS).unwrap().value);
    let mut errors = Vec::new();
    for count in [20_i64, 40, 80] {
        let waves: Vec<Component> = (0..count)
            .map(|i| {
                let k = std::f64::consts::PI / 3.0 * (i as f64 + 0.5) / count as f64;
                let exact = |x: f64| num_traits::FromPrimitive::from_f64(x).unwrap();
                let amplitude = exact((-k * k * 36.0 / 16.0).exp());
                Component { amplitude, wave_number: exact(k) }
            })
            .collect();
        let ball = peak_velocity_of_sum(&relation, &waves, 80).unwrap();
        let value = ball.to_decimal(20).midpoint().to_rational().to_f64().unwrap();
        errors.push((value - integral).abs());
    }
    // The midpoint rule: a quarter with each doubling.
    for pair in errors.windows(2) {
        assert!((pair[0] / pair[1] - 4.0).abs() < 0.2, "{errors:?}");
    }
}

/// The length of the pulse is called b in closed forms, so that no parameter may be.
#[test]
fn no_closed_form_confuses_a_parameter_with_the_length() {
    for (formula, has_one) in [("k - b*k^3", false), ("k - a*k^3", true)] {
        let exact = exact_peak_velocity(&read(formula), Shape::Square);
        assert_eq!(exact.is_some(), has_one, "{formula}");
    }
}

/// The root of `ω(k) τ = 2π` in closed form: `k = √(2π/τ)` for the beam, `2 arcsin(π/τ)` for the chain.
#[test]
fn cut_offs_of_durations() {
    let pulse = |above, below| Pulse::in_time(Shape::Square, &rational(above, below)).unwrap();
    for (above, below) in [(1, 1), (7, 3), (1, 1000), (500, 1)] {
        let k = pulse(above, below).cut_off(&Builtin::Beam.relation(), 200).unwrap();
        let square = k.multiply(&k, 220);
        let two_pi = Ball::pi(220).multiply_rational(&rational(2 * below, above), 220);
        let close = square.subtract(&two_pi, 220);
        assert!(close.contains(&rational(0, 1)), "{k}");
        assert!(k.to_decimal(80).midpoint().to_string().len() > 58, "{k}");
    }
    let lattice = Builtin::Lattice.relation();
    let k = pulse(4, 1).cut_off(&lattice, 60).unwrap();
    let expected = 2.0 * (std::f64::consts::PI / 4.0).asin();
    assert!((k.to_decimal(17).midpoint().to_rational().to_f64().unwrap() - expected).abs() < 1e-14);
    // Beyond the maximum of ω there is none, and the message says how far was looked.
    let peaked = read("k^2*exp(-k)");
    for (relation, tau) in [(lattice, 3), (Builtin::Cubic.relation(), 4), (peaked, 4)] {
        let error = pulse(tau, 1).cut_off(&relation, 60).unwrap_err();
        assert!(matches!(error, DispersionError::NoCutOff { .. }), "{error}");
    }
    // Far above 2π/τ, and far below it.
    let slow = read("k/1000");
    let k = pulse(3, 1).cut_off(&slow, 60).unwrap();
    let two_pi = k.multiply_rational(&rational(3, 1000), 80);
    assert!(
        two_pi
            .subtract(&Ball::pi(80).multiply_rational(&rational(2, 1), 80), 80)
            .contains(&rational(0, 1))
    );
    let long = Rational::from_integer(10.into()).pow(25);
    let k = Pulse::in_time(Shape::Square, &long).unwrap().cut_off(&Builtin::Beam.relation(), 80);
    let k = k.unwrap();
    let two_pi = k.multiply(&k, 80).multiply_rational(&long, 80);
    assert!(
        two_pi
            .subtract(&Ball::pi(80).multiply_rational(&rational(2, 1), 80), 80)
            .contains(&rational(0, 1))
    );
    // √k is steep at zero, and has a root all the same: k = (2π/τ)².
    let k = pulse(2, 1).cut_off(&read("sqrt(k)"), 100).unwrap();
    let square = Ball::pi(120).multiply(&Ball::pi(120), 120);
    assert!(k.subtract(&square, 120).contains(&rational(0, 1)), "{k}");
}

/// For ω = k time is length, also in the peak velocity; for others the two differ.
#[test]
fn pulses_in_time() {
    let ten = rational(10, 1);
    let [space, time] = [Pulse::in_space(Shape::Square, &ten), Pulse::in_time(Shape::Square, &ten)]
        .map(Result::unwrap);
    let at = |relation: &Relation, pulse: &Pulse| {
        double(&peak_velocity(relation, pulse, 14, BITS).unwrap().value)
    };
    let string = Builtin::String.relation();
    assert_eq!(at(&string, &space), at(&string, &time));
    let cubic = Builtin::Cubic.relation();
    assert!((at(&cubic, &space) - at(&cubic, &time)).abs() < 0.005);
    assert_ne!(at(&cubic, &space), at(&cubic, &time));
}

#[test]
fn values_at_zero_are_limits() {
    let zero = Ball::from_rational(&rational(0, 1), 64);
    for one in Builtin::ALL {
        let relation = with_numbers(one);
        let c = relation.enclose(Quantity::PhaseVelocity, &zero, 64).unwrap();
        let expected = rational(i64::from(one != Builtin::Beam), 1);
        assert!(c.contains(&expected), "{}: {c}", one.name());
    }
    // ω(0) = 1: there is no limit of ω/k.
    assert!(read("1 + k").enclose(Quantity::PhaseVelocity, &zero, 64).is_err());
}

/// Rayleigh: `c_g = c_p + k dc_p/dk`, for every relation that has a name.
#[test]
fn group_velocity_from_phase_velocity() {
    for one in Builtin::ALL {
        let relation = one.relation();
        let slope = relation.formula(Quantity::PhaseVelocity).derivative();
        let rayleigh =
            relation.formula(Quantity::PhaseVelocity).add(&Formula::wave_number().multiply(&slope));
        // The two may be written differently: they are compared at points.
        let difference = Relation::new(
            rayleigh
                .subtract(relation.formula(Quantity::GroupVelocity))
                .add(&Formula::wave_number()),
        )
        .unwrap();
        let numbers = difference
            .with_values(
                &difference
                    .parameters()
                    .iter()
                    .map(|x| (x.name().to_owned(), rational(1, 2)))
                    .collect(),
            )
            .unwrap();
        for i in 1..40 {
            let k = rational(i, 7);
            let ball =
                numbers.enclose(Quantity::Frequency, &Ball::from_rational(&k, 100), 100).unwrap();
            assert!(ball.contains(&k), "{}", one.name());
        }
    }
}

/// The pulse on its way: it is seen where it was predicted while dispersion is moderate, and where the
/// angle by which the fastest and slowest parts are apart is large, it is not.
#[test]
fn pulses_are_seen_where_they_were_predicted() {
    let cubic = Builtin::Cubic.relation();
    let difference = |length: i64, time: f64| {
        let pulse = Pulse::in_space(Shape::Square, &rational(length, 1)).unwrap();
        let predicted = double(&peak_velocity(&cubic, &pulse, 15, BITS).unwrap().value);
        (propagate(&cubic, &pulse, time, None).unwrap().velocity - predicted).abs()
    };
    let [far, near] = [difference(40, 10.0), difference(20, 10.0)];
    assert!(far < 1e-7 && near < 1e-5, "{far:e} {near:e}");
    assert!(difference(10, 10.0) < 1e-3);
    assert!(difference(3, 10.0) > 1e-2);
    // For short times the prediction is the initial velocity: the difference falls with t².
    let ratio = difference(10, 4.0) / difference(10, 2.0);
    assert!((ratio - 4.0).abs() < 0.2, "{ratio}");
}

/// The transform, against the sum of cosines taken one by one.
#[test]
fn the_transform_is_the_sum_of_cosines() {
    let lattice = Builtin::Lattice.relation();
    let pulse = Pulse::in_space(Shape::Triangle, &rational(8, 1)).unwrap();
    let seen = propagate(&lattice, &pulse, 7.0, Some(1024)).unwrap();
    let step = 2.0 * std::f64::consts::PI / seen.length;
    let last = (seen.length / 8.0).round() as usize;
    let ends = [3.0 / 8.0, 7.0 / 6.0, 23.0 / 24.0];
    for i in [0, 100, 511, 512, 516, 1023] {
        let x = seen.length * (i as f64 / 1024.0 - 0.5);
        let mut sum = 0.0;
        for j in 0..=last {
            let k = step * j as f64;
            let z = k * 2.0;
            let spectrum = if j == 0 { 1.0 } else { (z.sin() / z).powi(2) };
            let weight = ends.get(j.min(last - j)).unwrap_or(&1.0);
            sum += weight * spectrum * (k * x - 2.0 * (k / 2.0).sin() * 7.0).cos();
        }
        assert!((sum - seen.displacement[i]).abs() < 1e-11, "{i}: {sum}");
    }
    for (time, points) in [(-1.0, None), (1.0, Some(8))] {
        let error = propagate(&lattice, &pulse, time, points).unwrap_err();
        assert!(matches!(error, DispersionError::Grid(_)), "{error}");
    }
}

/// The rows of the table in the document: predicted and seen velocities of square pulses.
fn table() -> String {
    let cubic = Builtin::Cubic.relation();
    let time = 20.0;
    let mut rows = "| length `b` | `k_co` | angle | predicted `c_pp` | seen | seen − predicted | height kept |\n\
         |---|---|---|---|---|---|---|\n"
        .to_owned();
    for (above, below) in [
        (40, 1),
        (30, 1),
        (20, 1),
        (15, 1),
        (12, 1),
        (10, 1),
        (8, 1),
        (7, 1),
        (6, 1),
        (5, 1),
        (4, 1),
        (3, 1),
        (5, 2),
        (2, 1),
    ] {
        let pulse = Pulse::in_space(Shape::Square, &rational(above, below)).unwrap();
        let predicted = double(&peak_velocity(&cubic, &pulse, 15, BITS).unwrap().value);
        let seen = propagate(&cubic, &pulse, time, None).unwrap();
        let b = f64::from(above as i32) / f64::from(below as i32);
        let k = 2.0 * std::f64::consts::PI / b;
        rows += &format!(
            "| {b} | {k:.3} | {:.2} | {predicted:.5} | {:.5} | {:.5} | {:.3} |\n",
            k.powi(3) * time / 12.0,
            seen.velocity,
            seen.velocity - predicted,
            seen.height / seen.first_height,
        );
    }
    rows
}

/// The table in `docs/dispersion.md` is what is computed; `UPDATE_DOCUMENTS=1` writes it anew.
#[test]
fn the_table_of_the_document_is_measured() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/dispersion.md");
    let document = std::fs::read_to_string(path).unwrap();
    let (before, rest) = document.split_once("<!-- table -->\n").unwrap();
    let (_, after) = rest.split_once("<!-- end of table -->\n").unwrap();
    let table = table();
    let real = format!("{before}<!-- table -->\n{table}<!-- end of table -->\n{after}");
    if std::env::var_os("UPDATE_DOCUMENTS").is_some() {
        std::fs::write(path, &real).unwrap();
    }
    assert_eq!(std::fs::read_to_string(path).unwrap(), real);
}
