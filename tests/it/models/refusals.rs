//! Every refusal says what is not represented, by name.

use crate::models::{Settings, built_in, network};
use wavestep::model::{Leapfrog, Model, ModelError, Modes, Steps};
use wavestep::network::Network;

type Outcome = Result<Box<dyn Model>, ModelError>;

fn boxed(model: impl Model + 'static) -> Box<dyn Model> {
    Box::new(model)
}

fn make(model: &str, network: &Network) -> Outcome {
    match model {
        "modes" => Modes::new(network, 3).map(boxed),
        "leapfrog" => Leapfrog::new(network, 4, 1.0).map(boxed),
        "steps" => Steps::new(network, 1e-6).map(boxed),
        other => panic!("no model {other}"),
    }
}

const BAR: &str = "bar a { impedance = 1, travel = 1, velocity = 1 }\n";

/// The model, the scene behind its title, and what the message ends with.
const REFUSED: [(&str, &str, &str); 9] = [
    (
        "modes",
        "bar e { impedance = 1 }\nline free - a - e - endless",
        "bar e is endless, so waves leave and do not vibrate",
    ),
    ("modes", "support s { damping = 1 }\nline free - a - s - free", "s damps the motion"),
    (
        "modes",
        "spring k { stiffness = 1, damping = 1 }\nline free - a - k - fixed",
        "k damps the motion",
    ),
    ("modes", "load f { force = 1 }\nline free - f - a - free", "load f acts from outside"),
    (
        "modes",
        "mass m { mass = 1, velocity = 1 }\nspring k { stiffness = 1 }\nline free - m - k - fixed\n#no a",
        "it needs at least one bar",
    ),
    (
        "leapfrog",
        "mass m { mass = 1 }\nbar e { impedance = 1, velocity = 1 }\nline free - m | e - endless\n#no a",
        "no bar has a finite length that could set the size of a cell",
    ),
    (
        "leapfrog",
        "spring k { stiffness = 1 }\nspring j { stiffness = 1, damping = 1 }\nline free - a - k - j - fixed",
        "a joint without mass moves next to k",
    ),
    (
        "steps",
        "spring k { stiffness = 1 }\nspring j { stiffness = 1 }\nline free - a - k - j - fixed",
        "a joint without mass moves next to k, and nothing resists it",
    ),
    ("steps", "#units", "has no common measure with the times before it"),
];

#[test]
fn refusals_name_what_is_not_represented() {
    let mut seen = 0;
    for (model, scene, told) in REFUSED {
        let outcome = match scene {
            "#units" => make(model, &built_in("incommensurate", &[])).map(drop),
            scene => {
                let bar = if scene.ends_with("#no a") { "" } else { BAR };
                let text = format!("scene \"A\"\n{bar}{scene}\n");
                make(model, &network(&text, &[])).map(drop)
            }
        };
        let error = outcome.expect_err(told);
        assert!(matches!(error, ModelError::Refused { .. }), "{error:?}");
        let text = error.to_string();
        assert!(text.ends_with(told), "{model}: {text}");
        seen += 1;
    }
    assert_eq!(seen, REFUSED.len());
}

#[test]
fn energies_and_momenta_of_endless_bars_are_refused() {
    let energy = built_in("struck-free-bar", &[("mu", "1")]);
    for model in ["modes", "leapfrog", "steps"] {
        let error = make(model, &energy).unwrap().values(4, &[1.0]).unwrap_err().to_string();
        assert!(
            error.ends_with("energy observes an energy, which the model does not compute"),
            "{error}"
        );
    }
    let endless = built_in("striker-on-long-bar", &[("r", "2")]);
    let error = make("leapfrog", &endless).unwrap().values(3, &[1.0]).unwrap_err().to_string();
    assert!(error.ends_with("momentum observes the momentum of an endless bar"), "{error}");
}

#[test]
fn settings_times_and_symbols_are_checked() {
    let network = built_in("struck-free-bar", &[("mu", "1")]);
    let settings: [(Option<ModelError>, &str); 9] = [
        (
            Leapfrog::new(&network, 4, 1.01).err(),
            "a Courant number of 1.01 is unstable: a wave would cross more than a cell in a step; take at most 1",
        ),
        (
            Leapfrog::new(&network, 4, 0.0).err(),
            "the Courant number 0 is not positive; take 1 or less",
        ),
        (
            Leapfrog::new(&network, 4, f64::NAN).err(),
            "the Courant number NaN is not positive; take 1 or less",
        ),
        (Leapfrog::new(&network, 0, 1.0).err(), "it needs at least one cell"),
        (Modes::new(&network, 0).err(), "it needs at least one mode"),
        (Steps::new(&network, 0.5).err(), "the tolerance 5e-1 is not between 1e-13 and 1e-2"),
        (Steps::new(&network, f64::NAN).err(), "the tolerance NaN is not between 1e-13 and 1e-2"),
        (
            Leapfrog::new(&network, 2_000_000_000, 1.0).err(),
            "choose earlier times or a coarser model",
        ),
        (Modes::new(&network, 2_000_000).err(), "choose earlier times or a coarser model"),
    ];
    for (error, told) in settings {
        let text = error.expect(told).to_string();
        assert!(text.ends_with(told), "{text}");
    }
    let steps = Steps::new(&network, 1e-6).unwrap();
    assert_eq!(steps.values(0, &[f64::INFINITY]), Err(ModelError::Time(f64::INFINITY)));
    let error = steps.values(9, &[1.0]).unwrap_err();
    assert_eq!(error.to_string(), "there is no observable 9; the scene has 6, counted from 0");
    let late = steps.values(0, &[1e9]).unwrap_err();
    assert!(matches!(late, ModelError::TooMuch { limit: 2e6, .. }), "{late}");
    let cells = Leapfrog::new(&network, 1000, 1.0).unwrap().values(0, &[1e4]).unwrap_err();
    assert!(matches!(cells, ModelError::TooMuch { limit: 1e9, .. }), "{cells}");
    let many = Modes::new(&network, 20_000).unwrap().values(0, &vec![1.0; 60_000]).unwrap_err();
    assert!(matches!(many, ModelError::TooMuch { what: "terms", .. }), "{many}");
    let open: Settings<'_> = &[];
    for model in ["modes", "leapfrog", "steps"] {
        let Err(error) = make(model, &built_in("mass-on-fixed-bar", open)) else {
            panic!("{model}")
        };
        let told = "the symbol mu has no value; models in doubles need one for each";
        assert_eq!(error.to_string(), told, "{model}");
    }
}
