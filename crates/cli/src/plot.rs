//! `plot`: observables against time, diagrams of place and time, fields along the line.

use super::arguments::Plot;
use super::failure::Failure;
use super::input;
use super::picture;
use super::validity::note_pulling;
use num_rational::BigRational;
use num_traits::ToPrimitive as _;
use wavestep::field::Quantity;
use wavestep::problem::{Problem, ProblemError};
use wavestep_draw::{Caption, Chart};
use wavestep_studies::picture::{against_time, along_the_line, courses, lagrange};

pub fn run(options: &Plot) -> Result<String, Failure> {
    picture::draw(&options.output, options.width, || chart(options))
}

fn chart(options: &Plot) -> Result<Box<dyn Chart>, Failure> {
    let problem = input::problem(&options.scene)?;
    if !options.at.is_empty() {
        return fields_at(&problem, options);
    }
    let [from, to] = input::window(&problem, &options.from, options.to.as_deref())?;
    note_pulling(&problem, &to);
    let caption = Caption::default();
    if let Some(quantity) = options.diagram {
        let evaluator = problem.field_evaluator(&to)?;
        let diagram = lagrange(&evaluator, quantity, [&from, &to], caption)?;
        return Ok(Box::new(match &options.title {
            Some(title) => diagram.titled(title),
            None => diagram,
        }));
    }
    let courses = courses(&problem, &options.quantity, [&from, &to])?;
    let title = options.title.as_deref().unwrap_or(problem.title());
    let ends = [from, to].map(|end| end.to_f64().unwrap_or(f64::NAN));
    Ok(Box::new(against_time(title, &courses, problem.has_units(), (ends[0], ends[1]), caption)?))
}

fn fields_at(problem: &Problem, options: &Plot) -> Result<Box<dyn Chart>, Failure> {
    let times = options.at.iter().map(|time| problem.time("--at", time.as_str()));
    let times = times.collect::<Result<Vec<BigRational>, ProblemError>>()?;
    let Some(last) = times.iter().max() else { unreachable!("there are times") };
    note_pulling(problem, last);
    let evaluator = problem.field_evaluator(last)?;
    let figure = along_the_line(&evaluator, &fields(options)?, &times, Caption::default())?;
    Ok(Box::new(match &options.title {
        Some(title) => figure.titled(title),
        None => figure,
    }))
}

fn fields(options: &Plot) -> Result<Vec<Quantity>, Failure> {
    if options.quantity.is_empty() {
        return Ok(vec![Quantity::Velocity, Quantity::Strain, Quantity::Displacement]);
    }
    let field = |name: &String| {
        let found = Quantity::ALL.into_iter().find(|quantity| quantity.name() == name);
        found.ok_or_else(|| {
            let message = format!("`{name}` is not a field along the line");
            Failure::usage(message, "choose velocity, strain, displacement or force")
        })
    };
    options.quantity.iter().map(field).collect()
}
