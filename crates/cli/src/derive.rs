//! `derive`: exact wave functions as text, LaTeX or JSON, of a recurrence or of a scene.

use super::arguments::{Derive, Format};
use super::failure::Failure;
use super::first_contact;
use super::input;
use super::json;
use super::progress;
use super::table::Table;
use super::validity;
use serde_json::{Map, Value, json};
use wavestep::export::{self, Formula};
use wavestep::problem::{
    Derived, Form, Functions, GeneralFormulas, Orders, Problem, ProblemError, Simpler, Symbols,
    ToDerive,
};
use wavestep::signal::Arrival;
use wavestep::solution::ObservedStretch;

pub fn run(options: &Derive) -> Result<String, Failure> {
    if options.format == Format::Csv {
        let document = run(&Derive { format: Format::Json, ..options.clone() })?;
        return Ok(table(&json::read(&document)));
    }
    let problem = input::problem(&options.scene)?;
    let model = options.model.as_deref().map(|model| formulas_of(&problem, model)).transpose()?;
    if let Some(derived) = first_contact::derive(&problem, options)? {
        return Ok(derived);
    }
    let exact = formulas(&problem, options, options.orders())?;
    validity::note_derivation(&problem);
    let (Some(name), Some((model, definition))) = (&options.model, model) else {
        return Ok(exact);
    };
    let mark = if options.format == Format::Latex { "%" } else { "#" };
    let (orders, holds) = match model.last_arrival() {
        Some(0) => (None, "at all times"),
        _ => (options.orders(), "period by period"),
    };
    let derived = formulas(&model, options, orders)?;
    if options.format == Format::Json {
        let document = json!({
            "exact": json::read(&exact), "model": name, "rate": definition, "formulas": json::read(&derived),
        });
        return Ok(format!("{document}\n"));
    }
    let rate: String = definition.iter().map(|line| format!("{mark} {line}\n")).collect();
    Ok(format!("{exact}\n{mark} {name}, {holds}\n{rate}{derived}"))
}

/// What was derived as a table, with the name of the model before each row where one stands beside it.
fn table(document: &Value) -> String {
    let Some(exact) = document.get("exact") else { return Table::of(document).csv() };
    let mut table = Table::default();
    for (model, formulas) in
        [(json!("exact"), exact), (document["model"].clone(), &document["formulas"])]
    {
        table.add(formulas, &Map::from_iter([("model".to_owned(), model)]));
    }
    table.csv()
}

/// A scene with something left out, of which formulas are derived, and what stands for its rate.
fn formulas_of(problem: &Problem, model: &str) -> Result<(Problem, Option<String>), Failure> {
    match model.parse::<Simpler>().map_err(ProblemError::from)? {
        Simpler::Scene(changes) => Ok(problem.model(&changes)?),
        Simpler::Modes(_) | Simpler::Arrivals(_) => {
            let message = format!("{model} is no scene of which formulas could be derived");
            Err(Failure::usage(message, "name a change of the scene, such as `third`"))
        }
    }
}

fn formulas(
    problem: &Problem,
    options: &Derive,
    orders: Option<Orders>,
) -> Result<String, Failure> {
    if options.explain || options.exercise {
        return explanation(problem, options);
    }
    let (derived, names) = derived(problem, options, orders)?;
    with_constants(problem, derived, names.as_deref(), options)
}

fn explanation(problem: &Problem, options: &Derive) -> Result<String, Failure> {
    options.orders().map_or(Ok(()), refuse_empty)?;
    let derivation =
        problem.explanation(options.orders(), options.from, options.form, options.exercise)?;
    match options.format {
        Format::Latex => Ok(derivation.to_latex(options.width())),
        Format::Json => {
            let remedy = "ask for --format text or latex";
            Err(Failure::usage("a derivation is for reading, not for programs", remedy))
        }
        _ => Ok(derivation.to_text(options.width())),
    }
}

/// With the constants that the formulas hold, or of these the ones that stand in a text, and the unit of an observable.
fn with_constants(
    problem: &Problem,
    derived: String,
    text: Option<&str>,
    options: &Derive,
) -> Result<String, Failure> {
    let (mark, text) = match options.format {
        Format::Json => return Ok(derived),
        Format::Latex => ("%", text),
        _ => ("#", Some(derived.as_str())),
    };
    let mut lines = problem.constants(text)?;
    lines.extend(options.quantity.as_ref().and_then(|name| problem.unit_of_formulas(name)));
    let lines: String = lines.iter().map(|line| format!("{mark} {line}\n")).collect();
    Ok(lines + &derived)
}

/// What is derived, and the same as text where it is written otherwise and holds few of the constants.
fn derived(
    problem: &Problem,
    options: &Derive,
    orders: Option<Orders>,
) -> Result<(String, Option<String>), Failure> {
    let what = options.quantity.as_deref().map_or(ToDerive::Waves, ToDerive::Quantity);
    let symbols = if options.source_form { Symbols::Source } else { Symbols::Own };
    if options.general {
        let formulas = problem.general_formulas(what, symbols)?;
        return Ok((written_general(problem, &formulas, options)?, None));
    }
    let progress = progress::spinner("deriving");
    let orders = orders.unwrap_or_else(|| {
        let (orders, stopped) = problem.first_orders(what, options.from);
        if let Some(reason) = stopped {
            progress.suspend(|| eprintln!("note: {reason}; --through N derives more"));
        }
        orders
    });
    refuse_empty(orders)?;
    if symbols == Symbols::Source {
        let formulas = problem.source_form(what, orders)?;
        return match options.format {
            Format::Json => Err(source_form_as_json()),
            _ => Ok((formulas_as(&formulas, options), None)),
        };
    }
    written(problem, &problem.functions(what, orders, options.form)?, options)
}

fn refuse_empty(orders: Orders) -> Result<(), Failure> {
    match orders {
        Orders::Through(first, last) if first > last => {
            let message = format!("no period lies from {first} through {last}");
            Err(Failure::usage(message, "give --through N with N at least --from"))
        }
        _ => Ok(()),
    }
}

fn source_form_as_json() -> Failure {
    let remedy = "ask for --format text or latex, or leave out --source-form";
    Failure::usage("the source's form is for reading, not for programs", remedy)
}

fn formulas_as(formulas: &[Formula], options: &Derive) -> String {
    match options.format {
        Format::Latex => export::latex(formulas, options.width()),
        _ => export::text(formulas, options.width()),
    }
}

fn written(
    problem: &Problem,
    derived: &Derived,
    options: &Derive,
) -> Result<(String, Option<String>), Failure> {
    if options.format == Format::Json {
        return Ok((json_document(problem, derived, options.form)?, None));
    }
    let all = problem.formulas(derived, options.form)?;
    let plain = || {
        let formulas = all.iter().flat_map(|(_, formulas)| formulas);
        formulas.map(|formula| formula.to_text(options.width())).collect()
    };
    let names = matches!(derived, Derived::Arrivals(_)).then(plain);
    if (options.format, options.form) == (Format::Latex, Form::Piecewise) {
        let time = &problem.recurrence()?.statement().time;
        let cases = |(name, formulas): &(String, Vec<Formula>)| {
            export::latex_cases(name, time, formulas, options.width())
        };
        return Ok((all.iter().map(cases).collect(), names));
    }
    let all: Vec<Formula> = all.into_iter().flat_map(|(_, formulas)| formulas).collect();
    Ok((formulas_as(&all, options), names))
}

fn json_document(problem: &Problem, derived: &Derived, form: Form) -> Result<String, Failure> {
    let document = match derived {
        Derived::Arrivals(found) => arrivals_json(problem, found)?,
        Derived::Stretches(name, stretches) => {
            let stretch = |stretch: &ObservedStretch| {
                json!({
                    "from": json::fraction_json(&stretch.from),
                    "to": json::fraction_json(&stretch.to),
                    "terms": json::expression_json(&stretch.value),
                })
            };
            let mut document = header(problem, "arrivals")?;
            document["observable"] = json!(name);
            document["functions"] = stretches.iter().map(stretch).collect();
            document
        }
        Derived::Functions(all) => {
            let (form, index) = match form {
                Form::Period => ("period", "n"),
                Form::Echo => ("echo", "k"),
                Form::Piecewise => ("piecewise", "n"),
            };
            let local = &problem.recurrence()?.statement().local;
            let functions = |functions: &Functions| {
                let Functions { name, first, offset, expressions } = functions;
                let pieces = json::pieces_json(index, *first, local, expressions);
                json!({"wave": name, "offset": json::fraction_json(offset), "functions": pieces})
            };
            let mut document = header(problem, form)?;
            document["waves"] = all.iter().map(functions).collect();
            document
        }
    };
    Ok(format!("{document}\n"))
}

fn header(problem: &Problem, form: &str) -> Result<Value, Failure> {
    let statement = problem.recurrence()?.statement();
    Ok(json!({
        "schema_version": json::SCHEMA_VERSION,
        "title": statement.title,
        "period": json::fraction_json(&statement.period),
        "local": statement.local.name(),
        "time": statement.time.name(),
        "form": form,
    }))
}

fn arrivals_json(problem: &Problem, found: &[Arrival]) -> Result<Value, Failure> {
    let network = problem.network()?;
    let echo = |arrival: &Arrival| {
        json!({
            "wave": network.waves()[arrival.wave].name,
            "counts": arrival.counts,
            "delay": json::fraction_json(&arrival.delay),
            "terms": json::expression_json(&arrival.echo),
        })
    };
    let periods: Vec<Value> = network.lattice().periods().iter().map(json::fraction_json).collect();
    Ok(json!({
        "schema_version": json::SCHEMA_VERSION,
        "title": problem.title(),
        "form": "arrivals",
        "periods": periods,
        "local": network.local().name(),
        "echoes": found.iter().map(echo).collect::<Vec<_>>(),
    }))
}

fn written_general(
    problem: &Problem,
    all: &[GeneralFormulas],
    options: &Derive,
) -> Result<String, Failure> {
    if options.format != Format::Json {
        let all: Vec<Formula> = all.iter().flat_map(|wave| wave.formulas.clone()).collect();
        return Ok(formulas_as(&all, options));
    }
    if options.source_form {
        return Err(source_form_as_json());
    }
    // A formula is text that is not broken, with its remark apart.
    let formula = |formula: &Formula| {
        let remark = formula.remark.as_ref().map(|(text, _)| text);
        json!({"formula": formula.to_line(), "remark": remark})
    };
    let wave = |all: &GeneralFormulas| {
        let formulas: Vec<Value> = all.formulas.iter().map(formula).collect();
        json!({"wave": all.name, "offset": json::fraction_json(&all.offset), "formulas": formulas})
    };
    let mut document = header(problem, "general")?;
    document["waves"] = all.iter().map(wave).collect();
    Ok(format!("{document}\n"))
}
