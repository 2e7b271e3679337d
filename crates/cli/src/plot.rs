//! `plot`: observables against time, diagrams of place and time, fields along the line.

use super::arguments::{DiagramOption, Plot};
use super::failure::Failure;
use super::field::{evaluator, scene};
use super::input::{self, Readable, Subject};
use super::picture;
use super::plot_contact;
use super::quantity;
use num_rational::BigRational;
use num_traits::ToPrimitive as _;
use wavestep::evaluate::{ClosedForm, ClosedSignal, EvaluateError};
use wavestep::expression::Fraction;
use wavestep::field::Quantity;
use wavestep::language;
use wavestep::network::{Network, Observed, ObservedValue};
use wavestep::recurrence::Recurrence;
use wavestep::scene::{Dimension, Measure};
use wavestep::signal::{self, Purpose};
use wavestep_draw::{Caption, Chart};
use wavestep_studies::picture::{
    Course, against_time, along_the_line, lagrange, sampled, sampled_in_steps,
};

/// How many periods are shown at least where no end is given, and how often a wave may pass the whole line
/// in that time.
const PERIODS: i64 = 4;
const PASSAGES: i64 = 2;

/// At how many times an energy is looked at.
const ENERGY_STEPS: usize = 240;

/// Draws what is asked for.
pub fn run(options: &Plot) -> Result<String, Failure> {
    picture::draw(&options.output, options.width, || chart(options))
}

fn chart(options: &Plot) -> Result<Box<dyn Chart>, Failure> {
    let subject = match input::readable(&options.scene)? {
        Readable::Subject(subject) => subject,
        Readable::WithoutRecurrence(scaled) => return plot_contact::chart(&scaled, options),
    };
    let caption = Caption::default();
    if !options.at_time.is_empty() {
        let network = scene(subject)?;
        let times = options
            .at_time
            .iter()
            .map(|time| input::time("--at-time", time, network.scene().dimensional))
            .collect::<Result<Vec<BigRational>, Failure>>()?;
        let Some(last) = times.iter().max() else { unreachable!("there are times") };
        let evaluator = evaluator(&network, last)?;
        let figure = along_the_line(&evaluator, &fields(options)?, &times, caption)?;
        return Ok(Box::new(match &options.title {
            Some(title) => figure.titled(title),
            None => figure,
        }));
    }
    let window = window(&subject, options)?;
    if let Some(diagram) = options.diagram {
        let network = scene(subject)?;
        let quantity = match diagram {
            DiagramOption::Velocity => Quantity::Velocity,
            DiagramOption::Strain => Quantity::Strain,
            DiagramOption::Force => Quantity::Force,
        };
        let evaluator = evaluator(&network, &window.1)?;
        let diagram = lagrange(&evaluator, quantity, [&window.0, &window.1], caption)?;
        return Ok(Box::new(match &options.title {
            Some(title) => diagram.titled(title),
            None => diagram,
        }));
    }
    let (courses, title, dimensional) = courses(subject, options, &window)?;
    let title = options.title.as_deref().unwrap_or(&title);
    let ends = (double(&window.0), double(&window.1));
    Ok(Box::new(against_time(title, &courses, dimensional, ends, caption)?))
}

pub fn double(time: &BigRational) -> f64 {
    time.to_f64().unwrap_or(f64::NAN)
}

/// The fields asked for with `--at-time`.
fn fields(options: &Plot) -> Result<Vec<Quantity>, Failure> {
    if options.quantity.is_empty() {
        return Ok(vec![Quantity::Velocity, Quantity::Strain, Quantity::Displacement]);
    }
    let field = |name: &String| {
        let found = Quantity::ALL.into_iter().find(|quantity| quantity.name() == name);
        found.ok_or_else(|| {
            let message = format!("`{name}` is no field along the line");
            Failure::usage(message, "ask for velocity, strain, displacement or force")
        })
    };
    options.quantity.iter().map(field).collect()
}

/// The window of time; where no end is given, some periods.
fn window(subject: &Subject, options: &Plot) -> Result<(BigRational, BigRational), Failure> {
    let dimensional = matches!(subject, Subject::Scene(network) if network.scene().dimensional);
    window_of(options, dimensional, || default_length(subject))
}

/// The window of time, of a usual length where no end is given.
pub fn window_of(
    options: &Plot,
    dimensional: bool,
    usual_length: impl FnOnce() -> Result<BigRational, Failure>,
) -> Result<(BigRational, BigRational), Failure> {
    let from = input::time("--from", &options.from, dimensional)?;
    let to = match &options.to {
        Some(to) => input::time("--to", to, dimensional)?,
        None => &from + usual_length()?,
    };
    match from < to {
        true => Ok((from, to)),
        false => {
            let message = format!("the window from {from} to {to} is empty");
            Err(Failure::usage(message, "give --from before --to"))
        }
    }
}

/// What is told where no end is given, and no usual length is known.
pub fn no_end() -> Failure {
    Failure::usage("the window has no end", "give --to T")
}

/// A length with two figures, and not less.
pub fn two_figures(length: f64) -> Result<BigRational, Failure> {
    let step = 10_f64.powi(length.log10().floor() as i32 - 1);
    let steps = (length / step).ceil().to_i64().ok_or_else(no_end)?;
    let step = BigRational::from_float(step).ok_or_else(no_end)?;
    Ok(step * BigRational::from_integer(steps.into()))
}

/// Some periods: exactly where a period is rational, else a round number near them.
fn default_length(subject: &Subject) -> Result<BigRational, Failure> {
    let periods = BigRational::from_integer(PERIODS.into());
    let network = match subject {
        Subject::Recurrence(recurrence) => {
            let period = recurrence.statement().period.as_constant();
            return match (period, recurrence.symbols().next()) {
                (Some(period), _) => Ok(period * periods),
                (None, Some(symbol)) => Err(EvaluateError::MissingValue(symbol.clone()).into()),
                (None, None) => Err(no_end()),
            };
        }
        Subject::Scene(network) => network,
    };
    let [period] = network.lattice().periods() else { return Err(no_end()) };
    let periods = periods.max(passages(network, period));
    let slowness = &network.model().slowness;
    if let (Some(period), Some(slowness)) = (period.as_constant(), slowness.as_constant()) {
        return Ok(period / slowness * periods);
    }
    let linear = |observed: &&Observed| matches!(observed.value, ObservedValue::Linear(_));
    let observed = network.observables().iter().find(linear).ok_or_else(no_end)?;
    let signal = ClosedForm::of_scene(network, observed, &BigRational::default())?;
    let period = signal.period().ok_or_else(no_end)?;
    two_figures(period * double(&periods))
}

/// In how many periods a wave has passed the whole line twice and come to all places observed; none where
/// that is not known exactly.
fn passages(network: &Network, period: &Fraction) -> BigRational {
    let mut travel = Fraction::zero();
    for bar in network.model().bars.values() {
        if let Some(own) = &bar.travel {
            travel = &travel + own;
        }
    }
    let exact = |time: &Fraction| time.as_constant();
    let delays = network.observables().iter().flat_map(|observed| match &observed.value {
        ObservedValue::Linear(observation) => observation.waves.iter(),
        ObservedValue::Energy(_) => [].iter(),
    });
    let latest = delays.filter_map(|wave| exact(&wave.delay)).max().unwrap_or_default();
    match (exact(&travel), exact(period)) {
        (Some(travel), Some(period)) => {
            let passages = BigRational::from_integer(PASSAGES.into());
            ((travel * passages + latest) / period).ceil()
        }
        _ => BigRational::default(),
    }
}

/// The quantities asked for, or all observables, with the title of the scene and whether it has units.
fn courses(
    subject: Subject,
    options: &Plot,
    window: &(BigRational, BigRational),
) -> Result<(Vec<Course>, String, bool), Failure> {
    match subject {
        Subject::Recurrence(recurrence) => {
            let title = recurrence.statement().title.clone();
            Ok((of_recurrence(&recurrence, options, window)?, title, false))
        }
        Subject::Scene(network) => {
            let title = network.scene().title.clone();
            let dimensional = network.scene().dimensional;
            Ok((of_scene(&network, options, window)?, title, dimensional))
        }
    }
}

fn of_recurrence(
    recurrence: &Recurrence,
    options: &Plot,
    (from, to): &(BigRational, BigRational),
) -> Result<Vec<Course>, Failure> {
    let observables = &recurrence.statement().observables;
    let all = observables.iter().map(|observable| observable.name.clone());
    let course = |name: String| {
        let observation = quantity::of_recurrence(recurrence, &name)?;
        let form = ClosedForm::of_recurrence(recurrence, &observation)?;
        let values = sampled(&ClosedSignal::of_form(form, [from, to])?)?;
        Ok(Course { name, dimension: Dimension::NONE, measure: None, values })
    };
    names(options, all)?.into_iter().map(course).collect()
}

fn of_scene(
    network: &Network,
    options: &Plot,
    (from, to): &(BigRational, BigRational),
) -> Result<Vec<Course>, Failure> {
    let all = network.observables().iter().map(|observed| observed.name.clone());
    let course = |name: String| {
        let observed = match network.scene().contacts_open {
            true => quantity::of_phases(network, &name)?,
            false => quantity::of_scene(network, &name)?,
        };
        let is_energy = matches!(observed.value, ObservedValue::Energy(_));
        let purpose = if is_energy { Purpose::Values } else { Purpose::Stretches };
        let signal = signal::of_scene(network, &observed, [from, to], purpose)?;
        let values = match is_energy {
            true => sampled_in_steps(&*signal, ENERGY_STEPS)?,
            false => sampled(&*signal)?,
        };
        let measure = measure_of(network, &name);
        Ok(Course { name, dimension: observed.dimension, measure, values })
    };
    names(options, all)?.into_iter().map(course).collect()
}

/// What an observable measures; none where its terms differ, or where it is a wave.
fn measure_of(network: &Network, name: &str) -> Option<Measure> {
    let own = network.scene().observables.iter().find(|own| own.name == name)?;
    let mut measures = own.terms.iter().map(|term| term.measure);
    let first = measures.next()?;
    measures.all(|other| other == first).then_some(first)
}

/// The names asked for, or all.
pub fn names(options: &Plot, all: impl Iterator<Item = String>) -> Result<Vec<String>, Failure> {
    let names: Vec<String> = match options.quantity.is_empty() {
        true => all.collect(),
        false => options.quantity.iter().map(|name| language::normalise_name(name)).collect(),
    };
    match names.is_empty() {
        true => Err(Failure::usage("nothing is observed in this scene", "give --quantity NAME")),
        false => Ok(names),
    }
}
