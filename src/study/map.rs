//! Maps of the error over the order and a parameter of the scene.

use crate::answer::{Kind, Problem};
use crate::plot::{Axis, Caption, Level, Map, PlotError};
use crate::study::curves::USELESS;
use crate::study::harness::{errors, worst};
use crate::study::reference::{Reference, Sampling};
use wavestep_polynomial::Rational;

/// How many times a period are looked at.
const TIMES: usize = 8;

/// One row of a map: the largest error on each of some periods, for each of some ways; `None` where a
/// way has no values.
///
/// ```
/// use wavestep::answer::{Kind, Problem};
/// use wavestep::study::errors_by_order;
/// # use wavestep::evaluate::Signal;
/// # use wavestep::language::{Source, parse_number, read_recurrence};
/// # let text = wavestep::scenes::find("rigid-mass").unwrap().text;
/// # let values = [("mu".to_owned(), parse_number("1")?)].into();
/// # let recurrence = read_recurrence(&Source::new("rigid-mass", text)?, &values)?;
/// # let signal = Signal::of_recurrence(&recurrence, &recurrence.observation("f").unwrap()).unwrap();
/// # let (from, to) = (parse_number("0")?, parse_number("8")?);
/// # let problem = Problem { signal: &signal, scene: None, recognise: &|_, _| Ok(None), from, to };
/// let kinds = [Kind::Expanded, Kind::Compiled, Kind::Rigid];
/// let [expanded, compiled, rigid] = &errors_by_order(&problem, 2.0, &[1, 30], &kinds)[..] else {
///     panic!("a row for each")
/// };
/// // The formula as printed loses its digits with the order; polynomials do not.
/// assert!(expanded[0].unwrap() < 1e-14 && expanded[1].unwrap() > 1e-8);
/// assert!(compiled.iter().all(|error| error.unwrap() < 1e-15));
/// // A model has no values without a scene.
/// assert_eq!(*rigid, [None, None]);
/// # Ok::<(), wavestep::language::Diagnostic>(())
/// ```
pub fn errors_by_order(
    problem: &Problem<'_>,
    period: f64,
    orders: &[usize],
    kinds: &[Kind],
) -> Vec<Vec<Option<f64>>> {
    let mut times = Vec::new();
    for (i, order) in orders.iter().enumerate() {
        let (from, to) = (*order as f64 * period, (*order as f64 + 1.0) * period);
        let seed = i as u64;
        times.extend(Sampling { points: TIMES, seed }.times(from, to));
    }
    let end = Rational::from_float((orders.last().copied().unwrap_or(0) as f64 + 1.0) * period);
    let part = Problem { to: end.unwrap_or_default(), from: Rational::default(), ..*problem };
    let Ok(reference) = Reference::new(&part, &times) else {
        return vec![vec![None; orders.len()]; kinds.len()];
    };
    let row = |kind: &Kind| match errors(&part, *kind, &reference) {
        Ok(errors) => errors.chunks(TIMES).map(|errors| Some(worst(errors))).collect(),
        Err(_) => vec![None; orders.len()],
    };
    kinds.iter().map(row).collect()
}

/// A map from its rows, each for one value of the parameter, ascending.
///
/// # Errors
/// [`PlotError`], where there are no rows.
///
/// ```
/// use wavestep::answer::Kind;
/// use wavestep::plot::Caption;
/// use wavestep::study::order_map;
///
/// let rows = [(0.25, vec![Some(1e-16), Some(1e-9)]), (1.0, vec![Some(1e-14), None])];
/// let map = order_map(Kind::Expanded, "mu", &[10, 40], &rows, Caption::default())?;
/// // Columns are orders, rows values of the parameter.
/// assert_eq!((map.cell(1, 0), map.cell(1, 1)), (Some(1e-9), None));
/// # Ok::<(), wavestep::plot::PlotError>(())
/// ```
pub fn order_map(
    kind: Kind,
    parameter: &str,
    orders: &[usize],
    rows: &[(f64, Vec<Option<f64>>)],
    caption: Caption,
) -> Result<Map, PlotError> {
    let orders = orders.iter().map(|order| *order as f64).collect();
    let values = rows.iter().map(|(value, _)| *value).collect();
    let cells = rows.iter().flat_map(|(_, row)| row.iter().copied()).collect();
    let x = (Axis::linear("order n"), orders);
    let y = (Axis::logarithmic(parameter), values);
    let map = Map::new(&format!("Error of {kind} by order and {parameter}"), x, y, cells, caption)?;
    let half = Level { value: 1e-8, name: "8 digits lost".to_owned() };
    let useless = Level { value: USELESS, name: "useful no longer".to_owned() };
    let all = Level { value: 1.0, name: "all digits lost".to_owned() };
    map.level(half)?.level(useless)?.level(all)?.decades(-17, 1)
}
