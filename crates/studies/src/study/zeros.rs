//! Errors near zeros: certified roots, and times at given distances from them.

use crate::study::curves::{DOUBLES, by_method, empty};
use crate::study::reference::Reference;
use wavestep::answer::Question;
use wavestep::signal::{ClosedForm, Root, Search};
use wavestep_draw::{Axis, Caption, Curves, PlotError};
use wavestep_polynomial::Rational;

const DECADES: std::ops::RangeInclusive<i32> = 1..=12;

/// The digits of roots: some more than a double has.
const DIGITS: usize = 20;

/// The bits of balls that may be spent on a root.
const LIMIT_BITS: u64 = 1 << 13;

/// Certified simple roots in the window of a question, rounded to doubles: at most so many, from all over
/// the window. None where there are none, or they cannot be told.
pub fn simple_roots(question: &Question<'_>, most: usize) -> Vec<f64> {
    let roots = Search::new(&*question.signal)
        .and_then(|search| search.roots(&Rational::default(), DIGITS, LIMIT_BITS));
    let Ok(roots) = roots else { return Vec::new() };
    let simple = roots.all.iter().filter_map(|root| match root {
        Root::Simple { time, .. } => Some(time.to_f64()),
        _ => None,
    });
    let simple: Vec<f64> = simple.collect();
    simple.iter().copied().step_by(simple.len().div_ceil(most).max(1)).collect()
}

/// The error relative to the value itself by the distance from certified roots: what is left near zeros.
///
/// The distances are `10^−k` of a period, k = 1 … 12, on both sides of at most so many roots; without
/// periods they are such parts of the window.
pub fn near_zeros(
    question: &Question<'_>,
    most: usize,
    mut caption: Caption,
) -> Result<Curves, PlotError> {
    let title = "Error relative to the value, near zeros";
    let [from, to] = question.signal.window().map(crate::nearest);
    let roots = simple_roots(question, most);
    let period = question.signal.closed_form().ok().and_then(ClosedForm::period);
    let unit = period.unwrap_or(to - from);
    // Each time with the decade it belongs to.
    let mut times = Vec::new();
    for decade in DECADES {
        let distance = unit * 10f64.powi(-decade);
        let both = roots.iter().flat_map(|root| [root - distance, root + distance]);
        let within = both.filter(|time| (from..=to).contains(time));
        times.extend(within.map(|time| (decade, time)));
    }
    times.sort_by(|a, b| a.1.total_cmp(&b.1));
    let at: Vec<f64> = times.iter().map(|(_, time)| *time).collect();
    let reference = Reference::new(question, &at).map_err(|_| empty(title))?;
    let sizes = reference.sizes();
    let curves = by_method(&DOUBLES, question, &reference, &mut caption, |errors| {
        let relative = |i: usize| if sizes[i] == 0.0 { 0.0 } else { errors[i] / sizes[i] };
        let worst = |decade: i32| {
            let mine = (0..times.len()).filter(|i| times[*i].0 == decade);
            let worst = mine.map(relative).reduce(f64::max)?;
            Some((10f64.powi(-decade), worst))
        };
        DECADES.filter_map(worst).collect()
    });
    let of = if period.is_some() { "periods" } else { "parts of the window" };
    let axis = Axis::logarithmic(&format!("distance from the nearest certified root, in {of}"));
    caption.remarks.push(format!("{} roots.", roots.len()));
    Curves::new(title, axis, Axis::logarithmic("relative error"), curves, caption)
}
