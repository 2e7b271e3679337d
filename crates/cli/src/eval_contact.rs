//! `eval` for scenes with a local contact: there is no recurrence, and a model computes the values.

use super::arguments::Eval;
use super::eval_doubles::{method, written};
use super::failure::Failure;
use super::problem::Titles;
use super::quantity;
use super::rows::times;
use wavestep::answer::{Kind, Way, WayError};
use wavestep::language;
use wavestep::model::{ModelError, equivalent_stiffness};
use wavestep::network::{NetworkError, ScaledScene};
use wavestep::scene::Dimension;

/// Significant digits of the stiffness of an equivalent spring, which is an approximation itself.
const DIGITS: i32 = 6;

/// The digits that are asked for where nothing is said.
const USUAL_DIGITS: usize = 15;

/// What is told of a scene with a local contact by all that needs a recurrence.
pub fn refused(scaled: &ScaledScene) -> Failure {
    let Some(contact) = scaled.local_contact() else { unreachable!("only these are refused") };
    let name = &scaled.scene().elements[contact].name;
    let error = NetworkError::NotLinear(name.clone());
    let spring = match equivalent(scaled) {
        Some(spring) => format!("the equivalent one is `{spring}`"),
        None => format!("`spring {name} {{ stiffness = … }}`"),
    };
    let remedy = format!("ask for values, with `eval`, or put a spring in its place: {spring}");
    Failure::Computation(error.to_string(), remedy)
}

/// The equivalent spring, as a scene states it.
fn equivalent(scaled: &ScaledScene) -> Option<String> {
    let contact = scaled.local_contact()?;
    let stiffness = equivalent_stiffness(scaled, contact).ok()?;
    let unit = match scaled.scene().dimensional {
        true => format!(" {}", language::unit_of(Dimension::STIFFNESS)),
        false => String::new(),
    };
    let name = &scaled.scene().elements[contact].name;
    let decimals = DIGITS - 1 - stiffness.log10().floor() as i32;
    let stiffness = match usize::try_from(decimals) {
        Ok(decimals) => format!("{stiffness:.decimals$}"),
        Err(_) => {
            let step = 10_f64.powi(-decimals);
            format!("{:.0}", (stiffness / step).round() * step)
        }
    };
    Some(format!("spring {name} {{ stiffness = {stiffness}{unit} }}"))
}

/// Says how sure values by the method of steps are.
pub fn noted(scaled: &ScaledScene, kind: Kind) {
    let (Some(contact), Kind::Steps { tolerance }) = (scaled.local_contact(), kind) else { return };
    let name = &scaled.scene().elements[contact].name;
    eprintln!(
        "note: `{name}` is a local contact; these values are tested, not certified: computed to \
         {tolerance:e} of the largest"
    );
}

/// Evaluates an observable by a model: the method of steps, where none is named.
pub fn run(scaled: &ScaledScene, options: &Eval) -> Result<String, Failure> {
    let scene = scaled.scene();
    let contact = scaled.local_contact().map(|contact| &scene.elements[contact].name);
    let contact = contact.expect("a scene with a local contact");
    if let Some(tolerance) = &options.tol {
        let message = format!(
            "no value is proven to be within {tolerance}: `{contact}` is a local contact, and no exact \
             solution is known"
        );
        let remedy = "ask for tested values, as in `--method steps:1e-10`";
        return Err(Failure::Accuracy(message, remedy.to_owned()));
    }
    if options.digits != USUAL_DIGITS {
        let message = format!(
            "no digits are certified: `{contact}` is a local contact, and no exact solution is known"
        );
        let remedy = "leave out --digits; finer values are had by `--method steps:1e-13`";
        return Err(Failure::Accuracy(message, remedy.to_owned()));
    }
    if options.stats || options.piece.is_some() {
        let message = format!("with the local contact `{contact}` there are no echoes and periods");
        return Err(Failure::usage(message, "give --at T, or --from, --to and --points"));
    }
    let kind = method(options.method.as_deref().unwrap_or("steps"))?;
    let times = times(options, scene.dimensional)?;
    let place = quantity::of_model(scene, &options.quantity)?;
    let way = Way::of_model(kind, scaled, place).map_err(|error| match error {
        WayError::Model(ModelError::Refused { .. }) => {
            let remedy = "leave out --method, or ask for `--method steps:1e-10`";
            Failure::Computation(error.to_string(), remedy.to_owned())
        }
        other => other.into(),
    })?;
    let values = way.exact_values(&times, options.side)?;
    noted(scaled, kind);
    if options.explain {
        eprintln!("{kind}: {}", way.law());
        if let Some(spring) = equivalent(scaled) {
            eprintln!("near to it is the exact solution with the equivalent spring: {spring}");
        }
    }
    let observable = &scene.observables[place];
    let dimension = match scene.dimensional {
        true => observable.terms[0].measure.dimension(),
        false => Dimension::NONE,
    };
    let titles = Titles {
        title: scene.title.clone(),
        unit: language::unit_of(dimension),
        time_unit: if scene.dimensional { "s".to_owned() } else { String::new() },
    };
    Ok(written(&way, &titles, (&times, &values), options))
}
