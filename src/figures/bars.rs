//! Two bars, and a bar that is pushed: figures 6.10 to 6.13.

use super::Listed;
use super::error::FigureError;
use super::scene::{caption, network, ratio};
use crate::field::{FieldEvaluator, Quantity};
use crate::picture::{along_the_line, lagrange};
use crate::plot::Chart;

/// 6.10.
pub(super) fn diagram_of_impact(listed: &Listed) -> Result<Box<dyn Chart>, FigureError> {
    let network = network("striker-on-long-bar", &[("r", ratio(1, 2))]);
    let remarks = [
        "Times in L/c of the striker, velocities in V.",
        "The contact is kept closed; for Z1 < Z2 the bars part at 2L/c.",
    ];
    let window = [&ratio(0, 1), &ratio(6, 1)];
    let evaluator = FieldEvaluator::new(&network, window[1])?;
    let caption = caption(listed.number, &remarks);
    let diagram = lagrange(&evaluator, Quantity::Velocity, window, caption)?;
    Ok(Box::new(diagram.titled(listed.title)))
}

/// 6.11.
pub(super) fn progress(listed: &Listed) -> Result<Box<dyn Chart>, FigureError> {
    let network = network("striker-on-long-bar", &[("r", ratio(1, 1))]);
    let times = [ratio(1, 2), ratio(3, 2), ratio(5, 2)];
    let remarks = [
        "Times in L/c, velocities in V, forces in Z V.",
        "The pulse is 2L long; at 2L/c the striker is at rest, and the contact free of force.",
    ];
    let fields = [Quantity::Velocity, Quantity::Force];
    let evaluator = FieldEvaluator::new(&network, &times[times.len() - 1])?;
    let caption = caption(listed.number, &remarks);
    let figure = along_the_line(&evaluator, &fields, &times, caption)?;
    Ok(Box::new(figure.titled(listed.title)))
}

/// 6.12.
pub(super) fn pushed_fields(listed: &Listed) -> Result<Box<dyn Chart>, FigureError> {
    let network = network("pushed-bar", &[]);
    let times = [ratio(1, 2), ratio(7, 4)];
    let remarks =
        ["Times in L/c, velocities in cX/EA, forces in X: what the front has passed moves by \
                    one unit more."];
    let fields = [Quantity::Velocity, Quantity::Force];
    let evaluator = FieldEvaluator::new(&network, &times[times.len() - 1])?;
    let caption = caption(listed.number, &remarks);
    let figure = along_the_line(&evaluator, &fields, &times, caption)?;
    Ok(Box::new(figure.titled(listed.title)))
}

/// 6.13.
pub(super) fn pushed_diagram(listed: &Listed) -> Result<Box<dyn Chart>, FigureError> {
    let network = network("pushed-bar", &[]);
    let window = [&ratio(0, 1), &ratio(6, 1)];
    let remarks = ["Times in L/c, velocities in cX/EA."];
    let evaluator = FieldEvaluator::new(&network, window[1])?;
    let caption = caption(listed.number, &remarks);
    let diagram = lagrange(&evaluator, Quantity::Velocity, window, caption)?;
    Ok(Box::new(diagram.titled(listed.title)))
}
