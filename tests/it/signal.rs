//! Signals against values of scenes, which are had in another way.
//!
//! A signal is enclosed from pieces of waves, or from the echoes that have arrived; a scene's value
//! from its echoes one by one, exactly where it is rational.

use num_traits::Signed as _;
use std::collections::BTreeMap;
use wavestep::language::parse_number;
use wavestep::network::Network;
use wavestep::problem::Problem;
use wavestep::scenes::SCENES;
use wavestep::signal::{At, ClosedSignal, EvaluateError, Limit, Signal as _, digits};
use wavestep_polynomial::Rational;

/// The shipped linear scenes with numbers for their symbols.
fn networks() -> impl Iterator<Item = (&'static str, Network)> {
    SCENES.iter().filter_map(|scene| {
        let third = parse_number("4/3").unwrap();
        let values = ["mu", "r", "m"].map(|name| (name.to_owned(), third.clone()));
        let named = |name: &str| scene.text.contains(&format!("symbol {name} "));
        let values: BTreeMap<_, _> = values.into_iter().filter(|(name, _)| named(name)).collect();
        let problem = Problem::of_text(scene.name, scene.text, &values).unwrap();
        // A local contact has no closed form.
        let network = problem.network().ok().filter(|network| network.local_contact().is_none())?;
        Some((scene.name, network.clone()))
    })
}

/// Both enclose the same number, to forty bits at least.
#[test]
fn signals_enclose_the_values_of_scenes() {
    let mut compared = 0;
    let fine = Rational::new(1.into(), (1_i64 << 40).into());
    for (name, network) in networks() {
        let unit =
            Rational::new(1.into(), if network.scene().dimensional { 5000 } else { 1 }.into());
        let last = &unit * Rational::from_integer(7.into());
        for observed in network.observables() {
            let exact = ClosedSignal::of_scene(&network, observed, [&Rational::default(), &last]);
            let exact = match exact {
                Err(EvaluateError::NotLinear) => continue,
                exact => exact.unwrap().echo_by_echo(),
            };
            for i in 0..12 {
                let at = &last * Rational::new((7 * i + 1).into(), 80.into());
                let stretch = exact.stretch_at(&at, Limit::Right).unwrap().unwrap();
                let value = exact.enclose(stretch, 0, At::Time(&at), 200).unwrap();
                let told = digits(&exact, &at, Limit::Right, 30, 1 << 12).unwrap();
                let told = told.ball(300);
                let place = format!("{name} {} {at}", observed.name);
                assert!(value.subtract(&told, 200).contains(&Rational::default()), "{place}");
                // An enclosure that is wide would agree with anything.
                let decimals = value.to_decimal(100);
                let radius = decimals.radius().to_rational();
                let size = decimals.midpoint().to_rational().abs().max(fine.clone());
                assert!(radius <= size * &fine, "{place} {value}");
                compared += 1;
            }
        }
    }
    assert!(compared > 300, "{compared}");
}
