//! Local contacts in scenes: values by the method of steps against the closed form of two endless bars,
//! against exact solutions of linear scenes, and against a step-by-step integration that shares nothing
//! with the library; balances of momentum and energy; what refuses, in the library and in the command.

use num_traits::ToPrimitive as _;
use wavestep::ball::Ball;
use wavestep::language::{Source, read_scene};
use wavestep::model::{
    Leapfrog, Model, ModelError, Modes, NotRepresented, Steps, equivalent_stiffness,
};
use wavestep::network::{Network, NetworkError, ScaledScene};
use wavestep::scene::{Hertz, Kind, Scene};
use wavestep::signal::{ClosedSignal, Limit, Value, digits};
use wavestep_polynomial::Rational;

fn scene_of(text: &str) -> Scene {
    let text = format!("scene \"A\"\n{text}");
    read_scene(&Source::new("test.wave", text.as_str()).unwrap(), &Default::default())
        .unwrap_or_else(|errors| panic!("{}\n{text}", errors[0]))
}

fn scaled(text: &str) -> ScaledScene {
    ScaledScene::of(&scene_of(text)).unwrap()
}

/// The values of the observable called `name`.
fn values(scene: &ScaledScene, tolerance: f64, name: &str, times: &[f64]) -> Vec<f64> {
    let place = scene.scene().observables.iter().position(|own| own.name == name).unwrap();
    Steps::new(scene, tolerance).unwrap().values(place, times).unwrap()
}

fn times(last: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|i| last * i as f64 / count as f64).collect()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().map(|value| value.abs()).fold(0.0, f64::max)
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

// ---- The closed form of two endless bars -------------------------------------------------------

/// 6.51: the dimensionless time at which `p² = (h/V)^{2/3} α`.
fn time_of(p: f64) -> f64 {
    let root = 3_f64.sqrt();
    let logarithm = ((p * p + p + 1.0) / ((1.0 - p) * (1.0 - p))).ln() / 2.0;
    let turn = root * ((2.0 * p + 1.0) / root).atan() - root * std::f64::consts::PI / 6.0;
    (logarithm - turn) * 2.0 / 3.0
}

/// The closed form is the integral of `dα̃/(1 − α̃^{3/2})`, `α̃ = p²`: Simpson's rule in `p`.
#[test]
fn the_closed_form_is_the_integral_that_it_stands_for() {
    for p in [0.1_f64, 0.5, 0.9] {
        let count = 20_000;
        let integrand = |p: f64| 2.0 * p / (1.0 - p.powi(3));
        let weight = |i: usize| match i {
            0 => 1.0,
            i if i == count => 1.0,
            i if i % 2 == 1 => 4.0,
            _ => 2.0,
        };
        let sum = (0..=count).map(|i| weight(i) * integrand(p * i as f64 / count as f64));
        let integral = sum.sum::<f64>() * p / (3 * count) as f64;
        assert!((integral - time_of(p)).abs() < 1e-12, "{p}");
    }
}

const ENDLESS: &str = "bar a { impedance = 3, velocity = 7/5 }\n\
    hertz tip { stiffness = 11/4 }\n\
    bar b { impedance = 2, velocity = -3/5 }\n\
    line endless - a - tip - b - endless\n\
    observe force = force(tip)\nobserve compression = compression(tip)\n\
    observe left = velocity(a.right)\nobserve right = force(b.at(3))";

/// The force over its largest value is `p³`, at the time `t̄(p)`.
#[test]
fn two_endless_bars_follow_the_closed_form() {
    let scene = scaled(ENDLESS);
    let compliance = 1.0 / 3.0 + 1.0 / 2.0;
    let (h, velocity): (f64, f64) = (2.75 * compliance, 2.0);
    let unit = h.powf(-2.0 / 3.0) * velocity.powf(-1.0 / 3.0);
    let largest_force = velocity / compliance;
    let shares: Vec<f64> = (0..=60).map(|i| f64::from(i) / 61.0).collect();
    let times: Vec<f64> = shares.iter().map(|p| time_of(*p).max(0.0) * unit).collect();
    let mut before = f64::INFINITY;
    for (tolerance, allowed) in [(1e-5, 1e-5), (1e-8, 1e-8), (1e-11, 1e-11), (1e-13, 1e-12)] {
        let forces = values(&scene, tolerance, "force", &times);
        let exact: Vec<f64> = shares.iter().map(|p| p.powi(3) * largest_force).collect();
        let error = difference(&forces, &exact) / largest_force;
        eprintln!("tolerance {tolerance:.0e}: {error:.1e}");
        assert!(error < allowed && error < before, "{tolerance}: {error:.2e}");
        before = error.max(1e-13);
    }
    let compressions = values(&scene, 1e-13, "compression", &times);
    let deepest = (velocity / h).powf(2.0 / 3.0);
    let exact: Vec<f64> = shares.iter().map(|p| p * p * deepest).collect();
    assert!(difference(&compressions, &exact) < 1e-12 * deepest);
    // The bar is slowed down by X/Z, and the force arrives 3 later in the other one.
    let slowed = values(&scene, 1e-13, "left", &times);
    let exact: Vec<f64> = shares.iter().map(|p| 1.4 - p.powi(3) * largest_force / 3.0).collect();
    assert!(difference(&slowed, &exact) < 1e-12 * velocity);
    let later: Vec<f64> = times.iter().map(|time| time + 3.0).collect();
    let passing = values(&scene, 1e-13, "right", &later);
    let exact: Vec<f64> = shares.iter().map(|p| p.powi(3) * largest_force).collect();
    assert!(difference(&passing, &exact) < 2e-12 * largest_force);
}

/// In units: the built-in scene by 6.54, with its own constant, in its first 40 microseconds.
#[test]
fn the_built_in_scene_follows_the_closed_form_in_units() {
    let text = wavestep::scenes::find("local-contact").unwrap().text;
    let scene = read_scene(&Source::new("local-contact", text).unwrap(), &Default::default());
    let scene = ScaledScene::of(&scene.unwrap()).unwrap();
    let (modulus, density, poisson) = (210e9_f64, 7850.0_f64, 0.3_f64);
    let (radius, nose, velocity) = (0.01_f64, 0.1_f64, 5.0_f64);
    let speed = f64::sqrt(modulus / density);
    let constant = 2.0 * 2_f64.sqrt() / (3.0 * std::f64::consts::PI * (1.0 - poisson * poisson));
    let rate =
        constant.powf(2.0 / 3.0) * (velocity / speed * nose / radius).cbrt() * speed / radius;
    let unit = 1.0 / rate;
    let largest_force = velocity * modulus * std::f64::consts::PI * radius * radius / (2.0 * speed);
    let shares: Vec<f64> = (0..=20).map(|i| f64::from(i) / 22.0).collect();
    let times: Vec<f64> = shares.iter().map(|p| time_of(*p).max(0.0) * unit).collect();
    let forces = values(&scene, 1e-13, "force", &times);
    let exact: Vec<f64> = shares.iter().map(|p| p.powi(3) * largest_force).collect();
    let error = difference(&forces, &exact) / largest_force;
    eprintln!("in units: {error:.1e}");
    assert!(error < 1e-12, "{error:.2e}");
}

// ---- Linear scenes -------------------------------------------------------------------------------

fn f64_of(ball: &Ball) -> f64 {
    ball.to_decimal(25).midpoint().to_rational().to_f64().unwrap()
}

/// The certified values of an observable of a linear scene.
fn exact(text: &str, name: &str, times: &[Rational]) -> Vec<f64> {
    exact_of(&scene_of(text), name, times)
}

fn exact_of(scene: &Scene, name: &str, times: &[Rational]) -> Vec<f64> {
    let network = Network::new(scene).unwrap();
    let observed = network.observables().iter().find(|own| own.name == name).unwrap();
    let window = [&Rational::default(), times.iter().max().unwrap()];
    let signal = ClosedSignal::of_scene(&network, observed, window).unwrap().echo_by_echo();
    let value = |time: &Rational| match digits(&signal, time, Limit::Right, 17, 1 << 14).unwrap() {
        Value::Exact(exact) => exact.to_f64().unwrap(),
        other => f64_of(&other.ball(64)),
    };
    times.iter().map(value).collect()
}

const STRIKER: &str = "bar striker { impedance = 2, travel = 3/4, velocity = 1 }\n\
    TIP\n\
    bar rod { impedance = 1, travel = 1/2 }\n\
    mass block { mass = 5 }\n\
    line free - striker - tip - rod - block - free\n\
    observe force = force(tip)\nobserve shortened = compression(tip)\n\
    observe gauge = strain(rod.at(1/2))\nobserve momentum = momentum(line)";

/// With `m = 1` a contact is a spring as long as it pushes: returning waves from both ends included.
#[test]
fn a_linear_contact_is_a_spring_while_it_pushes() {
    let spring = STRIKER.replace("TIP", "spring tip { stiffness = 7/3 }");
    let contact = STRIKER.replace("TIP", "hertz tip { stiffness = 7/3, exponent = 1 }");
    let grid: Vec<Rational> = (0..=144).map(|i| Rational::new(i.into(), 24.into())).collect();
    let doubles: Vec<f64> = (0..=144).map(|i| f64::from(i) / 24.0).collect();
    let force = exact(&spring, "force", &grid);
    let pushing = force.iter().take_while(|force| **force >= 0.0).count();
    // The wave from the block is back at 1, that from the free end of the striker at 3/2.
    assert!(pushing > 40 && pushing < 140, "{pushing}");
    for name in ["force", "shortened", "gauge"] {
        let exact = exact(&spring, name, &grid);
        let tested = values(&scaled(&contact), 1e-13, name, &doubles);
        let error = difference(&exact[..pushing], &tested[..pushing]);
        assert!(error < 2e-12, "{name}: {error:.1e}");
    }
    // The spring pulls then, and the contact does not.
    let after = values(&scaled(&contact), 1e-10, "force", &doubles);
    assert!(force[pushing] < 0.0 && after[pushing] == 0.0);
    assert!(after.iter().all(|force| *force >= 0.0));
}

// ---- An independent integration -----------------------------------------------------------------

/// Two bars that strike each other through `X = k α^m`, by the method of characteristics and the
/// classical rule of Runge and Kutta with a fixed step. The end of a bar sends the velocity wave `g` that
/// leaves the contact back as `σ g`, `σ = 1` where it is free and `−1` where it is fixed. With
/// `X = ±Z (σ g(t − 2τ) − g(t))`, `v = V + g(t) + σ g(t − 2τ)` the velocity of the end that is pressed is
/// `V ∓ (X(t) + 2 Σ_j σ^j X(t − 2jτ))/Z`, the upper sign at the left.
struct Characteristics {
    impedance: [f64; 2],
    trip: [f64; 2],
    sent_back: [f64; 2],
    velocity: f64,
    stiffness: f64,
    exponent: f64,
    step: f64,
    /// `α` and `α'` at the steps.
    states: Vec<[f64; 2]>,
}

impl Characteristics {
    fn force(&self, compression: f64) -> f64 {
        self.stiffness * compression.max(0.0).powf(self.exponent)
    }

    /// `α` at an earlier time by Hermite's cubic.
    fn compression(&self, time: f64) -> f64 {
        let place = (time / self.step).floor().min(self.states.len() as f64 - 2.0).max(0.0);
        let x = time / self.step - place;
        let [[a, da], [b, db]] = [self.states[place as usize], self.states[place as usize + 1]];
        let (da, db) = (da * self.step, db * self.step);
        let (y, z) = (1.0 - x, b - a);
        y * a + x * b + x * y * (y * (da - z) + x * (z - db))
    }

    /// `α'` where `α` is known.
    fn closing(&self, time: f64, compression: f64) -> f64 {
        let own = self.force(compression);
        let mut sum = self.velocity;
        for i in 0..2 {
            sum -= own / self.impedance[i];
            let (mut back, mut sign) = (time - self.trip[i], self.sent_back[i]);
            while back > 0.0 {
                sum -= 2.0 * sign * self.force(self.compression(back)) / self.impedance[i];
                back -= self.trip[i];
                sign *= self.sent_back[i];
            }
        }
        sum
    }

    fn run(&mut self, last: f64) {
        self.states = vec![[0.0, self.velocity]];
        let steps = (last / self.step).ceil() as usize;
        for i in 0..steps {
            let (time, step) = (i as f64 * self.step, self.step);
            let [own, first] = self.states[i];
            let second = self.closing(time + step / 2.0, own + step / 2.0 * first);
            let third = self.closing(time + step / 2.0, own + step / 2.0 * second);
            let fourth = self.closing(time + step, own + step * third);
            let next = own + step / 6.0 * (first + 2.0 * second + 2.0 * third + fourth);
            self.states.push([next, self.closing(time + step, next)]);
        }
    }
}

const TWO_BARS: &str = "bar a { impedance = 3, travel = 5/4, velocity = 1 }\n\
    hertz tip { stiffness = 40, exponent = EXPONENT }\n\
    bar b { impedance = 1, travel = 1/2 }\n\
    line free - a - tip - b - END\n\
    observe force = force(tip)\nobserve compression = compression(tip)\n\
    observe left = velocity(a.left)\nobserve right = velocity(b.right)\n\
    observe momentum = momentum(line)";

fn two_bars(exponent: &str, end: &str) -> ScaledScene {
    scaled(&TWO_BARS.replace("EXPONENT", exponent).replace("END", end))
}

/// Contacts open and close again: a long bar runs after a short one, which is free or comes back from a
/// wall.
#[test]
fn contacts_that_open_and_close_agree_with_characteristics() {
    let mut closed_again = 0;
    for (exponent, written) in [(1.5, "3/2"), (1.0, "1"), (2.5, "5/2")] {
        for (end, sent_back) in [("free", 1.0), ("fixed", -1.0)] {
            let grid = times(9.0, 360);
            let tested = values(&two_bars(written, end), 1e-11, "compression", &grid);
            let mut reference = Characteristics {
                impedance: [3.0, 1.0],
                trip: [2.5, 1.0],
                sent_back: [1.0, sent_back],
                velocity: 1.0,
                stiffness: 40.0,
                exponent,
                step: 1.0 / 4096.0,
                states: Vec::new(),
            };
            reference.run(9.5);
            let expected: Vec<f64> = grid.iter().map(|time| reference.compression(*time)).collect();
            let error = difference(&tested, &expected) / largest(&expected);
            let opened = tested.windows(2).filter(|pair| pair[0] > 0.0 && pair[1] <= 0.0).count();
            let closed = tested.windows(2).filter(|pair| pair[0] < 0.0 && pair[1] >= 0.0).count();
            eprintln!("m = {written}, {end}: {error:.1e}, opens {opened}, closes {closed}");
            assert!(error < 1e-6, "{written} {end}: {error:.1e}");
            assert!(opened >= 1, "{written} {end}");
            closed_again += closed;
        }
    }
    assert!(closed_again >= 4, "{closed_again}");
}

// ---- Balances ---------------------------------------------------------------------------------------

/// Without forces from outside momentum is kept, and without dampers energy. A bar of impedance `Z` that
/// waves pass in `τ` holds `Z ∫ (w₊² + w₋²)` over `τ`; each wave passes the free end within `τ` before or
/// after, where the velocity is twice the wave. So it holds `Z/4 ∫ v²` over the `2τ` around a time.
#[test]
fn momentum_and_energy_are_kept() {
    for (exponent, written) in [(1.5, "3/2"), (2.5, "5/2")] {
        let scene = two_bars(written, "free");
        let grid = times(8.0, 32);
        let momentum = values(&scene, 1e-10, "momentum", &grid);
        let lost = momentum.iter().map(|own| (own - 3.75).abs()).fold(0.0, f64::max);
        // 800 steps in a unit of time.
        let fine: Vec<f64> = (0..=7_400).map(|i| f64::from(i) / 800.0).collect();
        let left = values(&scene, 1e-10, "left", &fine);
        let right = values(&scene, 1e-10, "right", &fine);
        let square_between = |values: &[f64], from: f64, to: f64| {
            let (from, to) = ((from * 800.0) as usize, (to * 800.0) as usize);
            let weight = |i: usize| match i {
                i if i == from || i == to => 1.0,
                i if (i - from) % 2 == 1 => 4.0,
                _ => 2.0,
            };
            (from..=to).map(|i| weight(i) * values[i].powi(2)).sum::<f64>() / 2400.0
        };
        let whole: Vec<f64> = (2..=8).map(f64::from).collect();
        let compressions = values(&scene, 1e-10, "compression", &whole);
        let mut worst = 0.0_f64;
        for (time, compression) in whole.into_iter().zip(compressions) {
            let compression = compression.max(0.0);
            let energy = 0.75 * square_between(&left, time - 1.25, time + 1.25)
                + 0.25 * square_between(&right, time - 0.5, time + 0.5)
                + 40.0 / (exponent + 1.0) * compression.powf(exponent + 1.0);
            worst = worst.max((energy - 1.875).abs());
        }
        eprintln!("m = {written}: momentum {lost:.1e}, energy {worst:.1e}");
        assert!(lost < 1e-8 && worst < 1e-6, "{written}: {lost:.1e} {worst:.1e}");
    }
}

// ---- The ways to give a contact ------------------------------------------------------------------------

#[test]
fn contacts_are_exact_however_they_are_given() {
    let contact = |properties: &str| {
        let text = format!(
            "mass m {{ mass = 1, velocity = 1 }}\nhertz tip {{ {properties} }}\nline free - m - tip - fixed"
        );
        let Kind::Hertz(hertz) = scene_of(&text).elements[1].kind.clone() else { panic!() };
        let [force, compression] =
            [hertz.force, hertz.compression].map(|value| value.as_constant().unwrap().to_string());
        (force, compression, hertz.exponent.to_string())
    };
    let told = |force: &str, compression: &str, exponent: &str| {
        (force.to_owned(), compression.to_owned(), exponent.to_owned())
    };
    assert_eq!(contact("stiffness = 2/7"), told("2/7", "1", "3/2"));
    assert_eq!(contact("force = 3, compression = 1/4, exponent = 1.2"), told("3", "1/4", "6/5"));
    // R = 42 and 1/E* = (1 − 1/4)/1 + 1/2 = 5/4: F_0 = (4/3) (4/5) 42².
    let cup = "radius = 6, modulus = 1, poisson = 1/2, radius2 = -7, modulus2 = 2, poisson2 = 0";
    assert_eq!(contact(cup), told("9408/5", "42", "3/2"));
    // Of the same material, E* = E/(2 (1 − ν²)); a flat first body, and a flat second one.
    let ball = told("32/3", "2", "3/2");
    assert_eq!(contact("radius = 2, modulus = 3, poisson = 1/2"), ball);
    assert_eq!(contact("radius2 = 2, modulus = 3, poisson = 1/2"), ball);
}

/// A mass on a wall, without any bar: it comes back as fast as it came, and energy is kept on the way.
#[test]
fn a_mass_on_a_wall_comes_back() {
    let text = "mass m { mass = 2, velocity = 3 }\nhertz tip { stiffness = 5 }\nline free - m - tip - fixed\n\
        observe velocity = velocity(m)\nobserve compression = compression(tip)";
    let scene = scaled(text);
    let grid = times(4.0, 80);
    let velocity = values(&scene, 1e-12, "velocity", &grid);
    let compression = values(&scene, 1e-12, "compression", &grid);
    for (v, a) in velocity.iter().zip(&compression) {
        let energy = v * v + 5.0 / 2.5 * a.max(0.0).powf(2.5);
        assert!((energy - 9.0).abs() < 1e-10, "{energy}");
    }
    // E = 9 = 2 α^{5/2} at the deepest: α = 4.5^{2/5}, and the gap grows with 3 afterwards.
    let deepest = compression.iter().copied().fold(0.0, f64::max);
    assert!((deepest - 4.5_f64.powf(0.4)).abs() < 2e-3 && deepest < 4.5_f64.powf(0.4) + 1e-10);
    assert!((velocity[80] + 3.0).abs() < 1e-10 && compression[80] < 0.0);
    assert!((compression[80] - compression[79] + 0.15).abs() < 1e-10);
}

// ---- The equivalent spring ----------------------------------------------------------------------------

/// The pulse of a round-nosed striker against that of the equivalent spring, which is exact.
#[test]
fn the_equivalent_spring_gives_about_the_same_pulse() {
    let text = wavestep::scenes::find("hertz-striker").unwrap().text;
    let read = |text: &str| {
        read_scene(&Source::new("text", text).unwrap(), &Default::default())
            .unwrap_or_else(|errors| panic!("{}", errors[0]))
    };
    let scene = ScaledScene::of(&read(text)).unwrap();
    let Kind::Hertz(Hertz { force, compression, exponent }) = &scene.scene().elements[1].kind
    else {
        panic!("a contact")
    };
    // F_0 = (4/3) E/(2 (1 − ν²)) R², at α_0 = R.
    assert_eq!(compression.to_string(), "1/20");
    assert_eq!(force.as_constant().unwrap().to_string(), "5000000000/13");
    assert_eq!(exponent.to_string(), "3/2");
    let stiffness = equivalent_stiffness(&scene, 1).unwrap();
    let impedance = (210e9_f64 * 7850.0).sqrt() * std::f64::consts::PI * 1e-4;
    let k = 5e9 / 13.0 / 0.05_f64.powf(1.5);
    let by_hand = (2.0 * k / impedance).powf(2.0 / 3.0) * 10_f64.cbrt() * impedance / 2.0;
    assert!((stiffness / by_hand - 1.0).abs() < 1e-14, "{stiffness} {by_hand}");
    let spring: String = text
        .lines()
        .map(|line| match line.starts_with("hertz") {
            true => format!("spring nose {{ stiffness = {stiffness:.0} N/m }}\n"),
            false => format!("{line}\n"),
        })
        .collect();
    let grid: Vec<Rational> = (0..=60).map(|i| Rational::new(i.into(), 400_000.into())).collect();
    let doubles: Vec<f64> = (0..=60).map(|i| f64::from(i) / 400_000.0).collect();
    let linear = exact_of(&read(&spring), "force", &grid);
    let contact = values(&scene, 1e-10, "force", &doubles);
    // Both come near to Z V/2 before the wave returns.
    let highest = impedance * 10.0 / 2.0;
    let apart = difference(&linear[..45], &contact[..45]) / highest;
    eprintln!("apart by {apart:.3} of ZV/2; highest {:.4}", largest(&contact) / highest);
    assert!(apart > 0.05 && apart < 0.3, "{apart}");
    // The impulse of both is the same: all the momentum of the striker, as it stands still then.
    let impulse = |values: &[f64]| values.iter().sum::<f64>() / 400_000.0;
    let ratio = impulse(&contact) / impulse(&linear);
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
}

// ---- What refuses ----------------------------------------------------------------------------------

#[test]
fn a_contact_has_no_recurrence_and_one_model() {
    let scene = two_bars("3/2", "free");
    let refused = Network::new(scene.scene()).unwrap().recurrence();
    assert_eq!(refused.err(), Some(NetworkError::NotLinear("tip".to_owned())));
    let refusals = [Modes::new(&scene, 3).err(), Leapfrog::new(&scene, 4, 1.0).err()];
    for refusal in refusals {
        let Some(ModelError::Refused { reason, .. }) = refusal else { panic!("{refusal:?}") };
        assert_eq!(reason, NotRepresented::LocalContact("tip".to_owned()));
    }
    assert!(Steps::new(&scene, 1e-6).is_ok());
}
