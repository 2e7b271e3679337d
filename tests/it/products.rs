//! Sums of products of two waves of a recurrence: values, extrema and roots in closed form.
//!
//! The mass of the rigid bar moves with `v = e^(−t)` until 2, and `v = (e^(−2) − 2s) e^(−s)` with `s = t − 2` until 4:
//! it stands still at `2 + e^(−2)/2`, and is fastest on its way back at `3 + e^(−2)/2`, with `v = −2 e^(−s)`.

use num_traits::Signed;
use wavestep::Problem;
use wavestep::language::{Source, parse_number, read_recurrence};
use wavestep::lock::{Derivable, Lock, Request};
use wavestep::signal::{Goal, Limit, Place, Root, Search, Signal, Value, of_recurrence, value};
use wavestep::solution::Solution;
use wavestep_polynomial::Rational;

const RIGID: &str = "recurrence \"Rigid mass\"\nperiod 2, local s, time t\nwave f, g\n\
    equation g[n] = -f[n-1]\nequation f[n]' + g[n]' = -(f[n] - g[n])\n\
    continuous f[n] + g[n] starts at 1\nobserve energy = 1/2*(f[n] + g[n])^2\n\
    observe v = f[n] + g[n]\nobserve late = f(t - 1) + g(t - 1)\n\
    observe product = -(f[n] + g[n])*(f(t - 1) + g(t - 1))\n\
    observe still = (f[n] + g[n])*(f[n-1] + g[n])\n\
    observe mixed = f(t)*g(t - 1)/3 - 2*f(t)^2 + 1/2*g(t) - exp(-t) + 1\n\
    observe scaled = 3*(exp(-2)*f(t)*(g(t - 1) + t))\n\
    observe f_now = f(t)\nobserve g_late = g(t - 1)\nobserve g_now = g(t)\n\
    observe decay = exp(-t)\nobserve second = exp(-2)\n";

const TURNING: &str = "recurrence \"Turning\"\nperiod 1, local s, time t\nwave x, y\n\
    equation x[n]' = -y[n]\nequation y[n]' = x[n]\n\
    continuous x[n] starts at 1\ncontinuous y[n] starts at 0\n\
    observe radius = x[n]^2 + y[n]^2\nobserve both = x[n]*y[n]\n";

fn solution(text: &str) -> Solution {
    let source = Source::new("text", text).unwrap();
    Solution::new(read_recurrence(&source, &Default::default()).unwrap())
}

fn number(text: &str) -> Rational {
    parse_number(text).unwrap()
}

fn signal<'a>(solution: &'a Solution, name: &str, window: [&str; 2]) -> Box<dyn Signal + 'a> {
    let window = window.map(number);
    of_recurrence(solution, name, window.each_ref()).unwrap().expect("a known name")
}

fn text(value: &Value) -> String {
    value.to_text(30)
}

#[test]
fn energies_have_the_digits_of_their_closed_form() {
    let rigid = solution(RIGID);
    let energy = signal(&rigid, "energy", ["0", "4"]);
    let at = |time, side| value(&*energy, &number(time), side, 30, 1 << 12).unwrap();
    assert_eq!(text(&at("0", Limit::Right)), "0.500000000000000000000000000000");
    assert_eq!(at("0", Limit::Left), Value::Exact(number("0")));
    assert_eq!(text(&at("5/4", Limit::Right)), "0.0410424993119493975847643372336");
    assert_eq!(text(&at("5/2", Limit::Right)), "0.137521625717399951366737493642");
}

/// Values are those that the factors have, put together.
#[test]
fn products_are_products_of_their_factors() {
    let rigid = solution(RIGID);
    for time in ["0", "1/3", "1", "2", "5/2", "3", "41/10", "19/2"] {
        let of = |name| {
            let signal = signal(&rigid, name, ["0", "10"]);
            let found = value(&*signal, &number(time), Limit::Right, 60, 1 << 12).unwrap();
            found.decimal(60).0.to_rational()
        };
        let [v, late, f, g_late, g] = ["v", "late", "f_now", "g_late", "g_now"].map(of);
        let [decay, second] = ["decay", "second"].map(of);
        let [one, two, three] = ["1", "2", "3"].map(number);
        for (name, wanted) in [
            ("product", -v * late),
            ("mixed", &f * &g_late / &three - &two * &f * &f + g / two - decay + one),
            ("scaled", three * second * f * (g_late + number(time))),
        ] {
            let difference = of(name) - wanted;
            assert!(difference.abs() < number("1e-55"), "{name} at {time}: {difference}");
        }
    }
}

#[test]
fn the_largest_energy_is_that_of_the_closed_form() {
    let rigid = solution(RIGID);
    let energy = signal(&rigid, "energy", ["0", "4"]);
    let found = Search::new(&*energy).unwrap().extremum(Goal::Largest, 30, 1 << 12).unwrap();
    assert_eq!(found.value, Value::Exact(number("1/2")));
    assert_eq!(found.places, [Place::End(Value::Exact(number("0")))]);
    // On the way back, 2 e^(−2s) at s = 1 + e^(−2)/2.
    let energy = signal(&rigid, "energy", ["9/5", "4"]);
    let found = Search::new(&*energy).unwrap().extremum(Goal::Largest, 30, 1 << 12).unwrap();
    assert_eq!(text(&found.value), "0.236409903186286291997538980214");
    let [Place::Critical(time)] = &found.places[..] else { panic!("{found:?}") };
    assert_eq!(text(time), "3.06766764161830634594699974749");
}

/// A product changes its sign where one factor does; a square touches zero where what is squared changes its sign.
#[test]
fn roots_are_those_of_the_factors() {
    let (rigid, zero) = (solution(RIGID), number("0"));
    let product = signal(&rigid, "product", ["11/10", "29/10"]);
    let found = Search::new(&*product).unwrap().roots(&zero, 30, 1 << 12).unwrap().all;
    let [Root::Simple { time, rises: true }] = &found[..] else { panic!("{found:?}") };
    assert_eq!(text(time), "2.06766764161830634594699974749");
    let energy = signal(&rigid, "energy", ["0", "4"]);
    let search = Search::new(&*energy).unwrap();
    let found = search.roots(&zero, 30, 1 << 12).unwrap().all;
    let [Root::Double { time }] = &found[..] else { panic!("{found:?}") };
    assert_eq!(text(time), "2.06766764161830634594699974749");
    let least = search.extremum(Goal::Smallest, 30, 1 << 12).unwrap();
    assert_eq!((least.value, least.places.len()), (Value::Exact(zero), 1));
}

/// What is constant only as a whole is seen to be so by its exact functions.
#[test]
fn constant_sums_of_products_are_constants() {
    let (rigid, turning) = (solution(RIGID), solution(TURNING));
    for (solution, name, wanted) in [(&rigid, "still", "0"), (&turning, "radius", "1")] {
        let signal = signal(solution, name, ["0", "7"]);
        let search = Search::new(&*signal).unwrap();
        for goal in [Goal::Largest, Goal::Smallest] {
            let found = search.extremum(goal, 15, 1 << 10).unwrap();
            assert_eq!(found.value, Value::Exact(number(wanted)), "{name}");
        }
    }
    // cos t sin t is largest at π/4.
    let both = signal(&turning, "both", ["0", "3/2"]);
    let found = Search::new(&*both).unwrap().extremum(Goal::Largest, 15, 1 << 10).unwrap();
    let [Place::Critical(time)] = &found.places[..] else { panic!("{found:?}") };
    assert_eq!(
        [time.to_text(15), found.value.to_text(15)],
        ["0.785398163397448", "0.500000000000000"]
    );
}

/// A value that is zero only as a whole is decided by exact functions at its time.
#[test]
fn zeros_of_sums_of_products_are_exact() {
    let decaying = solution(
        "recurrence \"Decaying\"\nperiod 2, local s, time t\nwave f\nequation f[n] = exp(-t)\n\
         observe level = f[n]^2 - exp(-6)\nobserve earlier = f(t - 1)*f(t) - exp(-5)\n",
    );
    for (name, zero) in [("level", "3"), ("earlier", "3")] {
        let signal = signal(&decaying, name, ["0", "5"]);
        let at = |time| value(&*signal, &number(time), Limit::Right, 15, 1 << 12).unwrap();
        assert_eq!(at(zero), Value::Exact(number("0")), "{name}");
        assert!(at("5/2").to_f64() > 1e-3, "{name}");
    }
}

/// Names are told in the order of the text.
#[test]
fn products_keep_their_place_among_observables() {
    let statement = solution(RIGID).recurrence().statement().clone();
    let names = [
        "energy", "v", "late", "product", "still", "mixed", "scaled", "f_now", "g_late", "g_now",
        "decay", "second",
    ];
    assert_eq!(statement.observed(), names);
    assert_eq!(statement.quadratics[0].terms[0].factors.len(), 2);
}

/// There are no pieces of products; values are locked with the rest, and told as they are stated.
#[test]
fn products_are_locked_by_value_and_not_derived() {
    let problem = Problem::read("rigid", RIGID).unwrap();
    let refused = problem.derive("energy", 0..=1).unwrap_err().to_string();
    assert!(refused.contains("energy contains products of waves"), "{refused}");
    let rigid = solution(RIGID);
    let request = Request { times: vec![number("5/2")], digits: 20, ..Request::default() };
    let lock = Lock::of_pieces(Derivable::Equations(&rigid), None, &request).unwrap().to_text();
    for line in [
        "stated observable energy = 1/2*(f(t) + g(t))*(f(t) + g(t))\n",
        "stated observable mixed = 1/3*f(t)*g(t - 1) - 2*f(t)*f(t) + 1/2*g(t) + 1 - exp(-t)\n",
        "value energy(5/2) = 0.13752162571739995137\n",
    ] {
        assert!(lock.contains(line), "{line} in {lock}");
    }
}
