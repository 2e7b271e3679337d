//! `derive`: exact wave functions as text, LaTeX or JSON.

use super::arguments::{Derive, DeriveFormat, Form};
use super::failure::Failure;
use super::input;
use serde_json::{Value, json};
use wavestep::export::{self, Formula, Head, LATEX_WIDTH};
use wavestep::language;
use wavestep::recurrence::{Recurrence, WaveIndex};
use wavestep::solution::{GeneralForm, Solution, Unknown};

/// The most terms that are derived at once.
const MAX_TERMS: u128 = 5_000_000;

/// Derives what is asked for.
pub fn run(options: &Derive) -> Result<String, Failure> {
    let recurrence = input::recurrence(&options.scene)?;
    let waves = waves(&recurrence, options.wave.as_deref())?;
    if !options.general {
        refuse_explosion(&recurrence, options, waves.len())?;
    }
    let solution = Solution::new(recurrence);
    if options.general {
        general(&solution, &waves, options.format)
    } else {
        functions(&solution, &waves, options)
    }
}

fn waves(recurrence: &Recurrence, name: Option<&str>) -> Result<Vec<WaveIndex>, Failure> {
    let names = &recurrence.statement().waves;
    let Some(name) = name else { return Ok((0..names.len()).collect()) };
    match recurrence.wave(&language::normalise_name(name)) {
        Some(wave) => Ok(vec![wave]),
        None => {
            let remedy = format!("the waves of this scene are {}", names.join(", "));
            Err(Failure::usage(format!("`{name}` is no wave of this scene"), remedy))
        }
    }
}

/// Refuses before work starts what would have too many terms: a piece of a wave with one pole has
/// about n³/6, an echo n.
fn refuse_explosion(
    recurrence: &Recurrence,
    options: &Derive,
    waves: usize,
) -> Result<(), Failure> {
    let last = options.piece.unwrap_or(options.through) as u128;
    let differential = recurrence.steps().iter().any(|step| step.start.is_some());
    let one = match (options.form, differential) {
        (Form::Echo, true) => last + 1,
        (_, true) => (last + 1).saturating_pow(3) / 6 + 1,
        (_, false) => last + 1,
    };
    let all = if options.piece.is_some() { one } else { one.saturating_mul(last / 4 + 1) };
    let terms = all.saturating_mul(waves as u128);
    if terms <= MAX_TERMS {
        return Ok(());
    }
    let message =
        format!("this would have about {terms:.1e} terms; at most {MAX_TERMS} are derived at once");
    let message = message.replace(".0e", "e");
    Err(Failure::usage(message, "ask for a smaller order, one wave, one piece, or --form echo"))
}

/// The functions asked for, of one wave.
struct Functions {
    wave: String,
    first: usize,
    expressions: Vec<wavestep::expression::Expression>,
}

fn functions(
    solution: &Solution,
    waves: &[WaveIndex],
    options: &Derive,
) -> Result<String, Failure> {
    let (first, last) = match options.piece {
        Some(n) => (n, n),
        None => (0, options.through),
    };
    let statement = solution.recurrence().statement();
    let mut all = Vec::new();
    for wave in waves {
        let expressions = match options.form {
            Form::Echo => solution.echoes(*wave, last)?.echoes()[first..].to_vec(),
            Form::Period | Form::Piecewise => solution.pieces(*wave, first, last)?,
        };
        all.push(Functions { wave: statement.waves[*wave].clone(), first, expressions });
    }
    match options.format {
        DeriveFormat::Json => Ok(json_document(solution, &all, options.form)),
        DeriveFormat::Text => {
            let formulas = all.iter().flat_map(|wave| formulas(solution, wave, options.form));
            Ok(export::text(&formulas.collect::<Vec<_>>()))
        }
        DeriveFormat::Latex if options.form == Form::Piecewise => {
            let cases = |wave: &Functions| {
                let formulas = formulas(solution, wave, options.form);
                export::latex_cases(&wave.wave, &statement.time, &formulas, LATEX_WIDTH)
            };
            Ok(all.iter().map(cases).collect())
        }
        DeriveFormat::Latex => {
            let formulas = all.iter().flat_map(|wave| formulas(solution, wave, options.form));
            Ok(export::latex(&formulas.collect::<Vec<_>>(), LATEX_WIDTH))
        }
    }
}

fn formulas(solution: &Solution, functions: &Functions, form: Form) -> Vec<Formula> {
    let statement = solution.recurrence().statement();
    let formula = |(i, expression): (usize, &wavestep::expression::Expression)| {
        let (n, local) = (functions.first + i, statement.local.clone());
        let wave = functions.wave.clone();
        let head = match form {
            Form::Echo => Head::Echo { wave, k: n, local },
            Form::Period | Form::Piecewise => Head::Piece { wave, n, local },
        };
        let formula = Formula::new(head, expression, &statement.local);
        match form {
            Form::Piecewise => {
                formula.on_period(n, &statement.period, &statement.local, &statement.time)
            }
            Form::Period | Form::Echo => formula,
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
            let Functions { wave, first, expressions } = functions;
            let pieces = export::pieces_json(index, *first, &statement.local, expressions);
            json!({"wave": wave, "functions": pieces})
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
        "schema_version": export::SCHEMA_VERSION,
        "title": statement.title,
        "period": export::fraction_json(&statement.period),
        "local": statement.local.name(),
        "time": statement.time.name(),
    })
}

fn general(
    solution: &Solution,
    waves: &[WaveIndex],
    format: DeriveFormat,
) -> Result<String, Failure> {
    let recurrence = solution.recurrence();
    let mut formulas = Vec::new();
    let mut values = Vec::new();
    for wave in waves {
        let form: &GeneralForm = solution.general(*wave).map_err(|unknown: &Unknown| {
            let name = &recurrence.statement().waves[*wave];
            let operator = export::operator_of(recurrence, unknown);
            Failure::Computation(
                format!(
                    "no closed form in n was found for {name}; with p the derivative and q the \
                     delay by one period, its equation is\n    {operator}"
                ),
                "ask for single orders instead, with --through or --piece".to_owned(),
            )
        })?;
        let wave_formulas = export::general_form(recurrence, *wave, form);
        values.push(json!({
            "wave": recurrence.statement().waves[*wave],
            "formulas": wave_formulas.iter().map(Formula::to_text).collect::<Vec<_>>(),
        }));
        formulas.extend(wave_formulas);
    }
    match format {
        DeriveFormat::Text => Ok(export::text(&formulas)),
        DeriveFormat::Latex => Ok(export::latex(&formulas, LATEX_WIDTH)),
        DeriveFormat::Json => {
            let mut document = header(recurrence);
            document["form"] = json!("general");
            document["waves"] = Value::Array(values);
            Ok(format!("{document}\n"))
        }
    }
}
