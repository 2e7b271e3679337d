//! `derive` from a recurrence: exact wave functions as text, LaTeX or JSON.

use super::arguments::{Derive, DeriveFormat, Form};
use super::bounds;
use super::failure::Failure;
use super::json;
use super::progress;
use serde_json::{Value, json};
use wavestep::export::{self, Formula, Head, SourceForm};
use wavestep::expression::{Expression, Fraction};
use wavestep::language;
use wavestep::recurrence::{Observable, Recurrence, WaveIndex};
use wavestep::solution::{
    GeneralForm, ObserveError, ObservedPieces, ObservedStretch, Solution, Unknown,
};

/// Derives what is asked for from a recurrence.
pub fn of_recurrence(
    recurrence: Recurrence,
    shown: usize,
    options: &Derive,
) -> Result<String, Failure> {
    let waves = waves(&recurrence, shown, options.wave.as_deref())?;
    if options.source_form {
        refuse_source_form(&recurrence, options)?;
    }
    if options.general {
        return general(&Solution::new(recurrence), &waves, options);
    }
    let (first, last) = options.orders();
    if first > last {
        let message = format!("no period lies from {first} through {last}");
        return Err(Failure::usage(message, "give --through N with N at least --from"));
    }
    let observable = options.observable.as_deref().map(|name| observable(&recurrence, name));
    let observable = observable.transpose()?;
    let parts = observable.as_ref().map_or(waves.len(), |o| o.observation.waves.len());
    refuse_explosion(&recurrence, options, parts)?;
    let solution = Solution::new(recurrence);
    let _progress = progress::spinner("deriving");
    if options.source_form {
        let formulas = source_form(&solution, &waves, options)?;
        return Ok(formulas_as(&formulas, options));
    }
    if let Some(observable) = &observable
        && options.form != Form::Echo
        && solution.offset(&observable.observation).is_none()
    {
        return between_arrivals(&solution, observable, options);
    }
    let functions = match observable {
        Some(observable) => vec![observed(&solution, &observable, options)?],
        None => waves
            .into_iter()
            .map(|wave| functions(&solution, wave, options))
            .collect::<Result<_, _>>()?,
    };
    Ok(written(&solution, &functions, options))
}

/// The wave asked for, or all that are shown: those after them only serve what is observed.
fn waves(
    recurrence: &Recurrence,
    shown: usize,
    name: Option<&str>,
) -> Result<Vec<WaveIndex>, Failure> {
    let names = &recurrence.statement().waves;
    let Some(name) = name else { return Ok((0..shown).collect()) };
    match recurrence.wave(&language::normalise_name(name)) {
        Some(wave) => Ok(vec![wave]),
        None => {
            let mut remedy = format!("the waves of this scene are {}", names[..shown].join(", "));
            if recurrence.observable(&language::normalise_name(name)).is_some() {
                remedy = format!("it is an observable: ask for --observable {name}");
            }
            Err(Failure::usage(format!("`{name}` is no wave of this scene"), remedy))
        }
    }
}

fn observable(recurrence: &Recurrence, name: &str) -> Result<Observable, Failure> {
    let observables = &recurrence.statement().observables;
    match recurrence.observable(&language::normalise_name(name)) {
        Some(observable) => Ok(observable.clone()),
        None => {
            let names: Vec<&str> = observables.iter().map(|o| o.name.as_str()).collect();
            let remedy = match &names[..] {
                [] => "this scene has no observables: derive its waves".to_owned(),
                names => format!("the observables of this scene are {}", names.join(", ")),
            };
            Err(Failure::usage(format!("`{name}` is no observable of this scene"), remedy))
        }
    }
}

/// Refuses before work starts what would have too many terms.
fn refuse_explosion(
    recurrence: &Recurrence,
    options: &Derive,
    parts: usize,
) -> Result<(), Failure> {
    let (_, last) = options.orders();
    let one = match options.form {
        Form::Echo => last as u128 + 1,
        Form::Period | Form::Piecewise => bounds::terms_of_piece(recurrence, last),
    };
    let terms = match options.piece {
        Some(_) => one.saturating_mul(parts.max(1) as u128),
        None => bounds::terms_through(one, last, parts),
    };
    bounds::refuse_terms(terms, "ask for a smaller order, one wave, one piece, or --form echo")
}

/// The functions asked for, of one wave or observable.
struct Functions {
    name: String,
    first: usize,
    /// When the first period begins.
    offset: Fraction,
    expressions: Vec<Expression>,
}

fn functions(solution: &Solution, wave: WaveIndex, options: &Derive) -> Result<Functions, Failure> {
    let (first, last) = options.orders();
    let expressions = match options.form {
        Form::Echo => solution.echoes(wave, last)?.echoes()[first..].to_vec(),
        Form::Period | Form::Piecewise => solution.pieces(wave, first, last)?,
    };
    let name = solution.recurrence().statement().waves[wave].clone();
    Ok(Functions { name, first, offset: Fraction::zero(), expressions })
}

fn observed(
    solution: &Solution,
    observable: &Observable,
    options: &Derive,
) -> Result<Functions, Failure> {
    let name = observable.name.clone();
    if options.form == Form::Echo {
        let message = format!("the echoes of {name} are those of its waves");
        return Err(Failure::usage(message, "derive the waves with --form echo"));
    }
    let (first, last) = options.orders();
    match solution.observed(&observable.observation, first, last) {
        Ok(ObservedPieces { offset, pieces }) => {
            Ok(Functions { name, first, offset, expressions: pieces })
        }
        Err(ObserveError::Solve(error)) => Err(error.into()),
        Err(ObserveError::MixedOffsets) => Err(Failure::Computation(
            format!("the waves in {name} do not arrive together, so it has no common periods"),
            "evaluate it with `wavestep eval`, or derive its waves".to_owned(),
        )),
    }
}

/// An observable whose waves arrive apart, from arrival to arrival.
fn between_arrivals(
    solution: &Solution,
    observable: &Observable,
    options: &Derive,
) -> Result<String, Failure> {
    let (first, last) = options.orders();
    let Observable { name, observation } = observable;
    let stretches = solution.observed_between_arrivals(observation, first, last);
    let stretches = stretches.map_err(|error| match error {
        ObserveError::Solve(error) => Failure::from(error),
        ObserveError::MixedOffsets => Failure::Computation(
            format!("the waves in {name} arrive apart, in an order that is not known"),
            "give values with --set, or evaluate it with `wavestep eval`".to_owned(),
        ),
    })?;
    let statement = solution.recurrence().statement();
    let local = &statement.local;
    if options.format == DeriveFormat::Json {
        let stretch = |stretch: &ObservedStretch| {
            json!({
                "from": json::fraction_json(&stretch.from),
                "to": json::fraction_json(&stretch.to),
                "terms": json::expression_json(&stretch.value),
            })
        };
        let mut document = header(solution.recurrence());
        document["form"] = json!("arrivals");
        document["observable"] = json!(name);
        document["functions"] = stretches.iter().map(stretch).collect();
        return Ok(format!("{document}\n"));
    }
    let formula = |(i, stretch): (usize, &ObservedStretch)| {
        let head = Head::Piece { wave: name.clone(), n: i, local: local.clone() };
        let formula = Formula::new(head, &stretch.value, local);
        formula.between(&stretch.from, &stretch.to, statement)
    };
    let formulas: Vec<Formula> = stretches.iter().enumerate().map(formula).collect();
    Ok(match (options.format, options.form) {
        (DeriveFormat::Latex, Form::Piecewise) => {
            export::latex_cases(name, &statement.time, &formulas, options.width())
        }
        _ => formulas_as(&formulas, options),
    })
}

/// Refuses what the source's form cannot say.
fn refuse_source_form(recurrence: &Recurrence, options: &Derive) -> Result<(), Failure> {
    if recurrence.statement().notation.is_empty() {
        let message = "this scene does not say how its source writes it";
        let remedy = "add a statement such as `written f in V/c, s as mu*z/L`, or leave out \
                      --source-form";
        return Err(Failure::usage(message, remedy));
    }
    if options.format == DeriveFormat::Json {
        let remedy = "ask for --format text or latex, or leave out --source-form";
        return Err(Failure::usage("the source's form is for reading, not for programs", remedy));
    }
    Ok(())
}

/// Pieces in the source's form.
fn source_form(
    solution: &Solution,
    waves: &[WaveIndex],
    options: &Derive,
) -> Result<Vec<Formula>, Failure> {
    let (first, last) = options.orders();
    let ends = &solution.recurrence().statement().notation.ends;
    let by_ends = (!ends.is_empty()).then(|| solution.pieces_by_ends(last, ends)).transpose()?;
    let kept = by_ends.as_ref().map(|(_, kept)| kept);
    let form = SourceForm::new(solution.recurrence(), kept);
    let mut formulas = Vec::new();
    for wave in waves {
        let pieces = match &by_ends {
            Some((pieces, _)) => pieces[*wave][first..].to_vec(),
            None => solution.pieces(*wave, first, last)?,
        };
        let piece = |(n, piece)| form.piece(*wave, n, piece);
        formulas.extend((first..).zip(&pieces).flat_map(piece));
    }
    Ok(formulas)
}

/// Formulas as text or LaTeX.
pub fn formulas_as(formulas: &[Formula], options: &Derive) -> String {
    match options.format {
        DeriveFormat::Latex => export::latex(formulas, options.width()),
        DeriveFormat::Text | DeriveFormat::Json => export::text(formulas, options.width()),
    }
}

fn written(solution: &Solution, all: &[Functions], options: &Derive) -> String {
    let time = &solution.recurrence().statement().time;
    let formulas = |functions: &Functions| formulas(solution, functions, options.form);
    match options.format {
        DeriveFormat::Json => json_document(solution, all, options.form),
        DeriveFormat::Latex if options.form == Form::Piecewise => {
            let cases = |functions: &Functions| {
                let formulas = formulas(functions);
                export::latex_cases(&functions.name, time, &formulas, options.width())
            };
            all.iter().map(cases).collect()
        }
        _ => formulas_as(&all.iter().flat_map(formulas).collect::<Vec<_>>(), options),
    }
}

fn formulas(solution: &Solution, functions: &Functions, form: Form) -> Vec<Formula> {
    let statement = solution.recurrence().statement();
    let formula = |(i, expression): (usize, &Expression)| {
        let (n, local) = (functions.first + i, statement.local.clone());
        let wave = functions.name.clone();
        let head = match form {
            Form::Echo => Head::Echo { wave, k: n, local },
            Form::Period | Form::Piecewise => Head::Piece { wave, n, local },
        };
        let formula = Formula::new(head, expression, &statement.local);
        // Periods that begin with those of the waves are said only where they are asked for.
        if form == Form::Piecewise || !functions.offset.is_zero() {
            formula.on_period(n, &functions.offset, statement)
        } else {
            formula
        }
    };
    functions.expressions.iter().enumerate().map(formula).collect()
}

fn json_document(solution: &Solution, all: &[Functions], form: Form) -> String {
    let statement = solution.recurrence().statement();
    let (form, index) = match form {
        Form::Period => ("period", "n"),
        Form::Echo => ("echo", "k"),
        Form::Piecewise => ("piecewise", "n"),
    };
    let waves: Vec<Value> = all
        .iter()
        .map(|functions| {
            let Functions { name, first, offset, expressions } = functions;
            let pieces = json::pieces_json(index, *first, &statement.local, expressions);
            json!({"wave": name, "offset": json::fraction_json(offset), "functions": pieces})
        })
        .collect();
    let mut document = header(solution.recurrence());
    document["form"] = json!(form);
    document["waves"] = Value::Array(waves);
    format!("{document}\n")
}

fn header(recurrence: &Recurrence) -> Value {
    let statement = recurrence.statement();
    json!({
        "schema_version": json::SCHEMA_VERSION,
        "title": statement.title,
        "period": json::fraction_json(&statement.period),
        "local": statement.local.name(),
        "time": statement.time.name(),
    })
}

/// A general formula as text that is not broken, with its remark apart.
fn general_json(formula: &Formula) -> Value {
    let remark = formula.remark.as_ref().map(|(text, _)| text);
    json!({"formula": formula.to_line(), "remark": remark})
}

fn general(solution: &Solution, waves: &[WaveIndex], options: &Derive) -> Result<String, Failure> {
    let recurrence = solution.recurrence();
    let mut formulas = Vec::new();
    let mut values = Vec::new();
    for wave in waves {
        let form: &GeneralForm = solution.general(*wave).map_err(|unknown: &Unknown| {
            let name = &recurrence.statement().waves[*wave];
            let operator = export::operator_of(recurrence, unknown);
            let (p, q) = export::operator_names(recurrence);
            Failure::Computation(
                format!(
                    "no closed form in n was found for {name}; with {p} the derivative and {q} \
                     the delay by one period, its equation is, apart from the start,\n    {operator}"
                ),
                match recurrence.symbols().next() {
                    Some(_) => {
                        "ask for single orders, with --through or --piece; where a factor of \
                         symbols may vanish, stating `nonzero …` can help"
                    }
                    None => "ask for single orders, with --through or --piece",
                }
                .to_owned(),
            )
        })?;
        let mut wave_formulas = export::general_form(recurrence, *wave, form);
        if options.source_form {
            let written = SourceForm::new(recurrence, None).general(*wave, form);
            let message = "a source gives no form for every n of a wave that is a sum of echoes";
            let remedy = "leave out --source-form, or --general";
            wave_formulas = written.ok_or_else(|| Failure::usage(message, remedy))?;
        }
        values.push(json!({
            "wave": recurrence.statement().waves[*wave],
            "formulas": wave_formulas.iter().map(general_json).collect::<Vec<_>>(),
        }));
        formulas.extend(wave_formulas);
    }
    match options.format {
        DeriveFormat::Text | DeriveFormat::Latex => Ok(formulas_as(&formulas, options)),
        DeriveFormat::Json => {
            let mut document = header(recurrence);
            document["form"] = json!("general");
            document["waves"] = Value::Array(values);
            Ok(format!("{document}\n"))
        }
    }
}
