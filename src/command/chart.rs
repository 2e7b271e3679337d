//! `chart`: accuracy against speed, measured, as pictures with their data and one page.

use super::arguments::{Chart as Options, Scene};
use super::chart_page::{Figure, check, write};
use super::failure::Failure;
use super::input::{self, Subject};
use super::problem::{is_dimensional, with_problem};
use super::progress;
use num_rational::BigRational;
use num_traits::ToPrimitive as _;
use wavestep::answer::{Kind, Problem};
use wavestep::evaluate::{EvaluateError, StablePrecision};
use wavestep::plot::{Axis, Caption, Curves, PlotError, Table};
use wavestep::study::{self, Reference, Sampling, Settings};

/// The most times of a reference.
const MAX_POINTS: usize = 100_000;

/// How many periods, or lengths of the scene, the window has where none is asked for.
const PERIODS: i64 = 40;

/// The orders of maps and costs.
const ORDERS: [usize; 14] = [1, 5, 10, 15, 20, 30, 40, 60, 80, 100, 120, 140, 170, 200];
const FEW_ORDERS: [usize; 4] = [1, 5, 10, 20];

/// Orders at which exponentials underflow.
const HIGH_ORDERS: [usize; 6] = [10, 30, 100, 200, 400, 800];

/// Values of the parameter of maps: twelve from 1/100 to 10, a factor of about two apart.
const PARAMETERS: [&str; 12] =
    ["1/100", "1/50", "1/25", "1/12", "1/6", "1/4", "1/2", "1", "2", "4", "7", "10"];

/// Draws all charts.
pub fn run(options: &Options) -> Result<String, Failure> {
    if options.points == 0 || options.points > MAX_POINTS {
        let message = format!("{} times cannot be measured", options.points);
        return Err(Failure::usage(message, format!("ask for 1 to {MAX_POINTS}")));
    }
    check(&options.output)?;
    let subject = input::subject(&options.scene)?.with_closed_contacts("chart")?;
    let quantity = match &options.quantity {
        Some(quantity) => quantity.clone(),
        None => first_quantity(&subject)?,
    };
    let dimensional = is_dimensional(&subject);
    let from = input::time("--from", &options.from, dimensional)?;
    let to = match &options.to {
        Some(to) => input::time("--to", to, dimensional)?,
        None => default_end(&subject)?,
    };
    if to <= from {
        let message = format!("the window from {from} to {to} is empty");
        return Err(Failure::usage(message, "give --from before --to"));
    }
    let spinner = progress::spinner("measuring");
    let command = command(options, &quantity);
    let (mut figures, table) = with_problem(subject, &quantity, (from, to), |problem, titles| {
        let unit = titles.time_unit.as_str();
        let axis = || match unit.is_empty() {
            true => Axis::linear("time"),
            false => Axis::linear("time").unit(unit),
        };
        let tick = |text: &str| spinner.set_message(text.to_owned());
        on_problem(problem, options, &command, (unit, axis), &tick)
    })?;
    if let Some(symbol) = single_symbol(options) {
        spinner.set_message("maps".to_owned());
        figures.extend(maps(options, &quantity, &symbol, &command)?);
    }
    drop(spinner);
    let title = format!("{}: accuracy and speed of {quantity}", options.scene.scene);
    write(&options.output, &title, &figures, &table)
}

/// The quantity that is charted where none is named: the first observable, or wave.
fn first_quantity(subject: &Subject) -> Result<String, Failure> {
    let name = match subject {
        Subject::Recurrence(recurrence) => {
            let statement = recurrence.statement();
            let observable = statement.observables.first().map(|observable| &observable.name);
            observable.or(statement.waves.first()).cloned()
        }
        Subject::Scene(network) => {
            network.observables().first().map(|observed| observed.name.clone())
        }
    };
    name.ok_or_else(|| Failure::usage("the scene observes nothing", "give --quantity NAME"))
}

/// The end of the window where none is given: so many of the shortest period.
fn default_end(subject: &Subject) -> Result<BigRational, Failure> {
    let period = match subject {
        Subject::Recurrence(recurrence) => recurrence.statement().period.as_constant(),
        Subject::Scene(network) => {
            let slowness = network.model().slowness.as_constant();
            let period =
                network.lattice().periods().first().and_then(|period| period.as_constant());
            period.zip(slowness).map(|(period, slowness)| period / slowness)
        }
    };
    if let Some(period) = period {
        return Ok(period * BigRational::from_integer(PERIODS.into()));
    }
    let missing = match subject {
        Subject::Recurrence(recurrence) => recurrence.symbols().next().cloned(),
        Subject::Scene(network) if network.lattice().periods().len() == 1 => {
            network.recurrence()?.symbols().next().cloned()
        }
        Subject::Scene(_) => None,
    };
    Err(match missing {
        Some(symbol) => EvaluateError::MissingValue(symbol).into(),
        None => Failure::usage("the window has no end", "give --to T"),
    })
}

/// The symbol that has a value, where it is one only.
fn single_symbol(options: &Options) -> Option<String> {
    match &options.scene.set[..] {
        [set] => set.split_once('=').map(|(name, _)| name.trim().to_owned()),
        _ => None,
    }
}

/// The command that draws the charts again.
fn command(options: &Options, quantity: &str) -> String {
    let set: String = options.scene.set.iter().map(|set| format!(" --set {set}")).collect();
    let to = options.to.as_ref().map_or(String::new(), |to| format!(" --to {to}"));
    let quick = if options.quick { " --quick" } else { "" };
    format!(
        "wavestep chart {}{set} --quantity {quantity} --from {}{to} --points {} --seed {}{quick} -o DIR",
        options.scene.scene, options.from, options.points, options.seed
    )
}

/// The norm of most charts.
const NORM: &str = "the largest |computed − exact|, in parts of the largest value";

fn caption(options: &Options, command: &str, sampling: String) -> Caption {
    let level = wavestep::evaluate::instructions();
    Caption {
        norm: NORM.to_owned(),
        sampling,
        versions: vec![
            ("wavestep".to_owned(), env!("CARGO_PKG_VERSION").to_owned()),
            (std::env::consts::ARCH.to_owned(), level),
        ],
        seed: Some(options.seed),
        command: command.to_owned(),
        remarks: Vec::new(),
    }
}

/// The charts of one problem.
fn on_problem(
    problem: &Problem<'_>,
    options: &Options,
    command: &str,
    (unit, axis): (&str, impl Fn() -> Axis),
    tick: &dyn Fn(&str),
) -> Result<(Vec<Figure>, Table), Failure> {
    let sampling = Sampling { points: options.points, seed: options.seed };
    let ends = [&problem.from, &problem.to].map(|end| end.to_f64().unwrap_or(f64::NAN));
    let reference = Reference::new(problem, &sampling.times(ends[0], ends[1]))?;
    let caption = || caption(options, command, sampling.law());
    let other = |norm: &str, sampling: &str| Caption {
        norm: norm.to_owned(),
        sampling: sampling.to_owned(),
        ..caption()
    };
    let settings = match options.quick {
        true => Settings { runs: 1, time: std::time::Duration::ZERO },
        false => Settings::default(),
    };
    let outcomes = study::ladder(problem, &reference, (settings, options.quick), |kind| {
        tick(&kind.to_string());
    });
    let (work, table) =
        study::work_precision("Work against precision", &outcomes, &reference, caption())
            .map_err(nothing)?;
    let mut figures = vec![Figure::new(
        "work-precision",
        "Each line is a method, each marker one of its settings. Further left is more accurate, further \
         down is faster. A segment leads from the measured error to the proven bound, where there is one; \
         preparation is not counted here and stands in the table.",
        work,
    )];
    let mut add = |name, text, chart: Result<Curves, PlotError>| match chart {
        Ok(chart) => figures.push(Figure::new(name, text, chart)),
        Err(reason) => eprintln!("note: {name} is left out: {reason}"),
    };
    tick("errors over time");
    let parts = if options.quick { 10 } else { 100 };
    add(
        "error-over-time",
        "The largest error in each of equal parts of the window. Where a line crosses the upper level \
         its method is of no use any more.",
        study::over_time(&reference, problem, axis(), parts, caption()),
    );
    add(
        "error-at-arrivals",
        "Just after an echo has arrived, a rounding of its delay costs a method that rounds delays as \
         many units as echoes have arrived.",
        study::at_arrivals(
            problem,
            if options.quick { 10 } else { 100 },
            other(NORM, "the first double at each arrival, and the next one"),
        ),
    );
    add(
        "error-near-zeros",
        "Relative to the value itself: methods with an absolute error lose a digit for each power of ten \
         that the value is smaller than the largest.",
        study::near_zeros(
            &reference,
            problem,
            other("the largest |computed − exact| / |exact| in each power of ten", &sampling.law()),
        ),
    );
    if problem.scene.is_some() {
        tick("models");
        add(
            "finite-differences",
            "At Courant's number 1 finite differences follow the characteristics; below, jumps are smeared \
             and ring, however small the cells. Above 1 they are unstable, and refused.",
            study::over_courant(
                problem,
                (&reference, if options.quick { 50 } else { 800 }),
                caption(),
            ),
        );
        add(
            "modes-near-a-jump",
            "After an arrival in the middle of the window. The nearer to a jump, of the quantity or of \
             its slope, the more modes it takes; at a jump of the quantity they give its mean.",
            study::near_jump(problem, unit, other(NORM, "60 times after one arrival")),
        );
    }
    if let Some(period) = problem.signal.period() {
        tick("costs");
        let orders = if options.quick { &FEW_ORDERS[..] } else { &ORDERS };
        let high = if options.quick { &HIGH_ORDERS[..2] } else { &HIGH_ORDERS };
        add(
            "error-at-high-orders",
            "At n = 400 the exponential of an echo is below all doubles long before the echo is: methods \
             that carry its exponent apart do not notice.",
            study::over_order(problem, period, high, other(NORM, "8 times on each period")),
        );
        add(
            "cost-by-order",
            "Sums of echoes cost the square of the order in the end; polynomials cost the same at any \
             order, once they are made.",
            study::cost_over_order(
                problem,
                period,
                orders,
                settings,
                other("seconds, the least of several runs", "64 times on each period"),
            ),
        );
    }
    tick("near equal poles");
    add(
        "error-near-equal-poles",
        "With two poles the formula holds powers of one over their distance, which cancel; polynomials \
         are made from balls that have the bits for it.",
        study::near_confluence(
            if options.quick { 2 } else { 12 },
            other(NORM, "50 times on five periods"),
        ),
    );
    Ok((figures, table))
}

/// Maps over the order and the one symbol.
fn maps(
    options: &Options,
    quantity: &str,
    symbol: &str,
    command: &str,
) -> Result<Vec<Figure>, Failure> {
    let kinds = [
        Kind::Expanded,
        Kind::Plain,
        Kind::Stable(StablePrecision::Double),
        Kind::Stable(StablePrecision::DoubleDouble),
        Kind::Compiled,
    ];
    let orders = if options.quick { &FEW_ORDERS[..] } else { &ORDERS };
    let mut rows: Vec<Vec<(f64, Vec<Option<f64>>)>> = vec![Vec::new(); kinds.len()];
    let parameters = if options.quick { &PARAMETERS[5..8] } else { &PARAMETERS };
    for parameter in parameters {
        let scene = Scene {
            scene: options.scene.scene.clone(),
            set: vec![format!("{symbol}={parameter}")],
        };
        // Not every value of a symbol need be possible.
        let Ok(subject) = input::subject(&scene) else { continue };
        let Ok(end) = default_end(&subject) else { continue };
        let value = input::number("a parameter", parameter)?.to_f64().unwrap_or(f64::NAN);
        let end = end * BigRational::from_integer(10.into());
        let found = with_problem(subject, quantity, (BigRational::default(), end), |problem, _| {
            let Some(period) = problem.signal.period() else { return Ok(None) };
            Ok(Some(study::errors_by_order(problem, period, orders, &kinds)))
        });
        if let Ok(Some(found)) = found {
            rows.iter_mut().zip(found).for_each(|(rows, row)| rows.push((value, row)));
        }
    }
    let sampling = "8 times a period, one in each of equal parts, uniform there".to_owned();
    let mut figures = Vec::new();
    for (kind, rows) in kinds.into_iter().zip(&rows) {
        let refused = rows.iter().all(|(_, row)| row.iter().all(Option::is_none));
        let caption = caption(options, command, sampling.clone());
        if let (false, Ok(map)) = (refused, study::order_map(kind, symbol, orders, rows, caption)) {
            let name = format!("map-{}", kind.name());
            let text = "Colours are powers of ten of the error. The lines are where half of the digits \
                        are lost, and where nothing of use is left.";
            figures.push(Figure::new(&name, text, map));
        }
    }
    Ok(figures)
}

fn nothing(error: PlotError) -> Failure {
    Failure::Computation(error.to_string(), "choose another quantity or window".to_owned())
}
