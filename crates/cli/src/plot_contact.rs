//! `plot` for scenes with a local contact: observables against time, by the method of steps.

use super::arguments::Plot;
use super::eval_contact::noted;
use super::failure::Failure;
use super::plot::{double, names, no_end, two_figures, window_of};
use super::quantity;
use num_rational::BigRational;
use wavestep::answer::{Kind, Way};
use wavestep::network::ScaledScene;
use wavestep::scene::Dimension;
use wavestep_draw::{Caption, Chart};
use wavestep_studies::hertz::ContactOfScene;
use wavestep_studies::picture::{Course, Sampled, against_time};

/// The tolerance of the method of steps: far finer than a picture shows.
const STEPS: Kind = Kind::Steps { tolerance: 1e-8 };

/// At how many times one looks.
const POINTS: usize = 1000;

/// How many units of time of the contact are shown where no end is given.
const UNITS: f64 = 8.0;

/// Bits of these.
const BITS: u64 = 64;

/// Draws what is asked for.
pub fn chart(scaled: &ScaledScene, options: &Plot) -> Result<Box<dyn Chart>, Failure> {
    let scene = scaled.scene();
    if options.diagram.is_some() || !options.at_time.is_empty() {
        let message = "diagrams and fields need waves in closed form, and a local contact has none";
        return Err(Failure::usage(message, "draw observables against time, or use a spring"));
    }
    let (from, to) = window_of(options, scene.dimensional, || usual_length(scaled))?;
    let (from, to) = (double(&from), double(&to));
    let times: Vec<f64> =
        (0..=POINTS).map(|i| from + (to - from) * i as f64 / POINTS as f64).collect();
    let all = scene.observables.iter().map(|observable| observable.name.clone());
    let course = |name: String| -> Result<Course, Failure> {
        let place = quantity::of_model(scene, &name)?;
        let values = Way::of_model(STEPS, scaled, place)?.values(&times)?;
        let points = times.iter().copied().zip(values).collect();
        let measure = scene.observables[place].terms.first().map(|term| term.measure);
        let dimension = match scene.dimensional {
            true => scene.observables[place].terms[0].measure.dimension(),
            false => Dimension::NONE,
        };
        Ok(Course { name, dimension, measure, values: Sampled { points, jumps: Vec::new() } })
    };
    let courses: Vec<Course> =
        names(options, all)?.into_iter().map(course).collect::<Result<_, _>>()?;
    let title = options.title.as_deref().unwrap_or(&scene.title);
    let remark = "Tested, not certified: a local contact has no exact solution.";
    let caption = Caption { remarks: vec![remark.to_owned()], ..Caption::default() };
    noted(scaled, STEPS);
    Ok(Box::new(against_time(title, &courses, scene.dimensional, (from, to), caption)?))
}

/// Some units of time of the contact, and twice the time until a wave returns to it: two figures.
fn usual_length(scaled: &ScaledScene) -> Result<BigRational, Failure> {
    let contact = ContactOfScene::new(scaled, BITS).map_err(|_| no_end())?;
    let seconds = |ball: &wavestep::ball::Ball| ball.to_decimal(15).midpoint().to_rational();
    let units = double(&seconds(contact.bars.time_unit())) * UNITS;
    let returned = contact.first_return.as_ref().map_or(0.0, |time| 2.0 * double(&seconds(time)));
    two_figures(units.max(returned))
}
