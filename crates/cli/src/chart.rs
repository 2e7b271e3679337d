//! `chart`: accuracy against speed, measured, as pictures with their data and one page.

use super::arguments::{Chart as Options, Scene};
use super::chart_page::{Figure, check, write};
use super::failure::Failure;
use super::input::{self, Subject};
use super::problem::{is_dimensional, with_problem};
use super::progress;
use super::quantity;
use num_rational::BigRational;
use num_traits::ToPrimitive as _;
use wavestep::answer::{Kind, Problem};
use wavestep::evaluate::EvaluateError;
use wavestep::network::ObservedValue;
use wavestep::recurrence::{Observation, Recurrence};
use wavestep_draw::{Axis, Caption, Curves, PlotError, Table};
use wavestep_studies::study::{self, Reference, Sampling, Settings};

/// The most times of a reference.
const MAX_POINTS: usize = 100_000;

/// How many periods, or lengths of the scene, the window has where none is asked for.
const PERIODS: i64 = 40;

/// The orders of maps and costs.
const ORDERS: [usize; 14] = [1, 5, 10, 15, 20, 30, 40, 60, 80, 100, 120, 140, 170, 200];
const FEW_ORDERS: [usize; 4] = [1, 5, 10, 20];

/// Orders at which exponentials underflow.
const HIGH_ORDERS: [usize; 6] = [10, 30, 100, 200, 400, 800];

/// Values of the parameter of maps, from 1/10000 to 10000; those about 1 are closest.
const PARAMETERS: [&str; 13] = [
    "1/10000", "1/1000", "1/100", "1/10", "1/4", "1/2", "1", "2", "4", "10", "100", "1000", "10000",
];
/// Above this, balls take thousands of bits at high orders: maps end at the last of these orders there.
const HUGE: f64 = 100.0;
const LAST_OF_HUGE: usize = 20;
const FEW_PARAMETERS: [&str; 3] = ["1/10000", "1", "10000"];

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
        let symbolic = symbolic(options, &quantity);
        on_problem(problem, symbolic.as_ref(), options, &command, (unit, axis), &tick)
    })?;
    if let Some(symbol) = single_symbol(options) {
        let tick = |text: &str| spinner.set_message(text.to_owned());
        figures.extend(maps(options, &quantity, &symbol, &command, &tick)?);
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

/// The recurrence with its symbols, and what is charted of it, where values were given to symbols.
fn symbolic(options: &Options, quantity: &str) -> Option<(Recurrence, Observation)> {
    if options.scene.set.is_empty() {
        return None;
    }
    let scene = Scene { scene: options.scene.scene.clone(), set: Vec::new() };
    match input::subject(&scene).ok()?.with_closed_contacts("chart").ok()? {
        Subject::Recurrence(recurrence) => {
            let observation = quantity::of_recurrence(&recurrence, quantity).ok()?;
            Some((*recurrence, observation))
        }
        Subject::Scene(network) => {
            let observed = quantity::of_scene(&network, quantity).ok()?;
            let ObservedValue::Linear(observation) = observed.value else { return None };
            Some((network.recurrence().ok()?, observation))
        }
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

/// The charts of one problem, and of what it is with its symbols.
fn on_problem(
    problem: &Problem<'_>,
    symbolic: Option<&(Recurrence, Observation)>,
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
         down is faster. A segment leads from the measured error to the proven bound, where there is one. \
         Markers do not count preparation; a ring above a marker does, spread over the points.",
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
         that a time is nearer to a zero.",
        study::near_zeros(
            problem,
            if options.quick { 5 } else { 40 },
            other(
                "the largest |computed − exact| / |exact| at each distance",
                "on both sides of certified roots from all over the window",
            ),
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
                other(
                    "|computed − exact| in parts of the largest value: its mean over the times, and the \
                     largest, as each curve says",
                    &sampling.law(),
                ),
            ),
        );
        add(
            "modes-near-a-jump",
            "After an arrival in the middle of the window. The nearer to a jump, of the quantity or of \
             its slope, the more modes it takes; at a jump of the quantity they give its mean.",
            study::near_jump(
                problem,
                unit,
                other(
                    "|computed − exact| at each time alone, in parts of the largest value",
                    "60 times after one arrival, their distances in geometric order",
                ),
            ),
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
            study::over_order(problem, period, high, other(NORM, &study::order_law())),
        );
        let sampling = "64 times on period n; derived are all periods to n";
        let costs = study::cost_over_order(
            problem,
            symbolic.map(|(recurrence, observation)| (recurrence, observation)),
            period,
            orders,
            settings,
            other("seconds, the least of several runs", sampling),
        );
        let (values, preparation) = match costs {
            Ok([values, preparation]) => (Ok(values), Ok(preparation)),
            Err(reason) => (Err(reason.clone()), Err(reason)),
        };
        add(
            "cost-by-order",
            "Sums of echoes cost the square of the order in the end; polynomials cost the same at any \
             order, once they are made.",
            values,
        );
        add(
            "preparation-by-order",
            "Derivation gives the closed forms of all periods to n, as `derive` does; a curve ends with \
             the first one that takes more than 0.3 s. The others prepare values on period n alone, from \
             nothing.",
            preparation,
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

/// The methods that have maps.
const MAPPED: [Kind; 6] = study::DOUBLES;

/// Maps over the order and the one symbol, and where the formula as printed loses its digits.
fn maps(
    options: &Options,
    quantity: &str,
    symbol: &str,
    command: &str,
    tick: &dyn Fn(&str),
) -> Result<Vec<Figure>, Failure> {
    let orders = if options.quick { &FEW_ORDERS[..] } else { &ORDERS };
    let mut rows: Vec<Vec<(f64, Vec<Option<f64>>)>> = vec![Vec::new(); MAPPED.len()];
    let mut refusals: Vec<Vec<String>> = vec![Vec::new(); MAPPED.len()];
    let mut lost = Vec::new();
    let parameters = if options.quick { &FEW_PARAMETERS[..] } else { &PARAMETERS };
    for parameter in parameters {
        let scene = Scene {
            scene: options.scene.scene.clone(),
            set: vec![format!("{symbol}={parameter}")],
        };
        // Not every value of a symbol need be possible.
        tick(&format!("maps, {symbol} = {parameter}"));
        let Ok(subject) = input::subject(&scene) else { continue };
        let Ok(end) = default_end(&subject) else { continue };
        let value = input::number("a parameter", parameter)?.to_f64().unwrap_or(f64::NAN);
        let end = end * BigRational::from_integer(10.into());
        let found = with_problem(subject, quantity, (BigRational::default(), end), |problem, _| {
            let Some(period) = problem.signal.period() else { return Ok(None) };
            let is_seen = |order: &&usize| value <= HUGE || **order <= LAST_OF_HUGE;
            let seen: Vec<usize> = orders.iter().take_while(is_seen).copied().collect();
            let found = study::errors_by_order(problem, period, &seen, &MAPPED);
            let known = (&seen[..], &found[0].errors[..]);
            Ok(Some((study::first_losses(problem, MAPPED[0], (value, period), known), found)))
        });
        let Ok(Some((loss, found))) = found else { continue };
        // Of an order that was not looked at nothing is known.
        if found[0].errors.len() == orders.len() || loss.all.is_some() {
            lost.push(loss);
        }
        for (i, mut row) in found.into_iter().enumerate() {
            if row.errors.len() < orders.len() {
                row.errors.resize(orders.len(), None);
                let remark = format!("not measured beyond n = {LAST_OF_HUGE}, for its cost");
                refusals[i].push(format!("{symbol} = {parameter}: {remark}."));
            }
            rows[i].push((value, row.errors));
            refusals[i].extend(row.refusal.map(|why| format!("{symbol} = {parameter}: {why}.")));
        }
    }
    let caption =
        |remarks: Vec<String>| Caption { remarks, ..caption(options, command, study::order_law()) };
    let mut figures = Vec::new();
    for ((kind, rows), refusals) in MAPPED.into_iter().zip(&rows).zip(refusals) {
        let refused = rows.iter().all(|(_, row)| row.iter().all(Option::is_none));
        let map = study::order_map(kind, symbol, orders, rows, caption(refusals));
        if let (false, Ok(map)) = (refused, map) {
            let name = format!("map-{}", kind.name());
            let text = "Colours are powers of ten of the error. The lines are where half of the digits \
                        are lost, and where nothing of use is left.";
            figures.push(Figure::new(&name, text, map));
        }
    }
    let last = orders.last().copied().unwrap_or(0);
    let between = "Near each of the two levels every order is looked at.".to_owned();
    let losses = study::losses(MAPPED[0], symbol, last, &lost, caption(vec![between]));
    if let Ok((chart, listing)) = losses {
        let text = "The formula as printed, order by order where its digits go.";
        figures.push(Figure::new("orders-of-loss", text, chart).listed(listing));
    }
    Ok(figures)
}

fn nothing(error: PlotError) -> Failure {
    Failure::Computation(error.to_string(), "choose another quantity or window".to_owned())
}
