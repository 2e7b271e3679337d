//! Lines that are drawn go through the values.

use wavestep::language::{Source, parse_number, read_scene};
use wavestep::network::Network;
use wavestep::planner::{Purpose, of_scene};
use wavestep::signal::{Limit, Signal, Value, value};
use wavestep_polynomial::Rational;
use wavestep_studies::picture::{Prefixed, sampled};

fn network(text: &str, values: &[(&str, &str)]) -> Network {
    let number = |(name, value): &(&str, &str)| ((*name).to_owned(), parse_number(value).unwrap());
    let source = Source::new("text", text).unwrap();
    let scene = read_scene(&source, &values.iter().map(number).collect());
    Network::new(&scene.unwrap_or_else(|errors| panic!("{}", errors[0]))).unwrap()
}

fn shipped(name: &str, values: &[(&str, &str)]) -> Network {
    network(wavestep::scenes::find(name).expect("a built-in scene").text, values)
}

fn signal<'a>(network: &'a Network, name: &str, window: &[Rational; 2]) -> Box<dyn Signal + 'a> {
    let observed = network.observables().iter().find(|observed| observed.name == name).unwrap();
    of_scene(network, observed, window.each_ref(), Purpose::Search).unwrap()
}

fn rational(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn double(value: &Value) -> f64 {
    value.to_f64()
}

/// A line that is drawn goes through values, and jumps where they do.
#[test]
fn lines_go_through_values() {
    for (name, values, observable) in [
        ("saint-venant", &[("mu", "1")][..], "strain_fixed"),
        ("saint-venant", &[("mu", "2")], "strain_impact"),
        ("saint-venant", &[("mu", "2")], "momentum"),
        ("bars-of-unequal-length", &[], "force"),
    ] {
        let network = shipped(name, values);
        let window = [rational(0, 1), rational(5, 1)];
        let signal = signal(&network, observable, &window);
        let line = sampled(&*signal).unwrap();
        let points = line.points.iter().filter(|(time, _)| time.is_finite());
        for (time, drawn) in points.step_by(7) {
            let at = Rational::from_float(*time).unwrap();
            let known = [Limit::Left, Limit::Right]
                .map(|side| double(&value(&*signal, &at, side, 12, 1 << 12).unwrap()));
            let off = known.map(|known| (known - drawn).abs());
            assert!(off[0].min(off[1]) < 1e-9, "{name} {observable} at {time}: {drawn} {known:?}");
        }
    }
}

/// The bar is stopped, and thrown back from the wall.
#[test]
fn jumps_are_where_waves_pass() {
    let rod = network(
        "scene \"A\"\nbar rod { impedance = 1, travel = 1, velocity = 1 }\nline free - rod | fixed\n\
         contacts open\nobserve v = velocity(rod.at(1/2))",
        &[],
    );
    let window = [rational(0, 1), rational(9, 1)];
    let signal = signal(&rod, "v", &window);
    assert_eq!(sampled(&*signal).unwrap().jumps, [(0.5, 1.0, 0.0), (1.5, 0.0, -1.0)]);
}

#[test]
fn units_take_prefixes_and_plain_numbers_powers_of_ten() {
    let time = Prefixed::of("s", 3.5e-4);
    assert_eq!((time.unit.as_str(), time.factor), ("µs", 1e6));
    assert_eq!(time.axis("time").label(), "time (µs)");
    assert_eq!(Prefixed::of("N*s", 4e3).unit, "kN s");
    assert_eq!(Prefixed::of("m/s", 12.0).unit, "m/s");
    let strain = Prefixed::of("", 2e-4);
    assert_eq!((strain.unit.as_str(), strain.factor), ("10⁻⁶", 1e6));
    assert_eq!(Prefixed::of("", 0.3), Prefixed { unit: String::new(), factor: 1.0 });
}

/// What is zero but for what no enclosure tells is drawn as zero: the energy of a mass that an imposed velocity held.
#[test]
fn nothing_is_drawn_as_zero() {
    let text = "scene \"Held\"\nload push { velocity = 1/5*exp(-5/7*t), from = 1/2, until = 5/2 }\n\
        mass m { mass = 2, velocity = 5/7 }\nbar rod { impedance = 3, travel = 1, velocity = 2 }\n\
        line free - push - m - rod - free\nobserve k = energy(m)\n";
    let network = network(text, &[]);
    let window = [rational(3, 1), rational(7, 1)];
    let drawn = sampled(&*signal(&network, "k", &window)).unwrap();
    assert!(drawn.points.iter().all(|(_, value)| *value == 0.0), "{:?}", drawn.points);
    assert_eq!(drawn.jumps, []);
}
