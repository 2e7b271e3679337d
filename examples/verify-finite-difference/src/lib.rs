//! How to check a code of one's own: run it on meshes that get finer, compare each result with the
//! exact field at the same time, and read the order of convergence off the errors.
//!
//! The strain of a cell in a staggered mesh stands for its average, and that is what it is compared
//! with. Three cases: a bar pushed by a force `F = t^4`, whose fields are smooth, by a force `F = t`,
//! whose fields are continuous with kinks, and a mass that strikes it, whose fields jump.

mod leapfrog;

pub use leapfrog::{Leapfrog, LeftEnd};
use std::error::Error;
use wavestep::{Problem, Quantity};
use wavestep_draw::{Axis, Caption, Figure, Look, Panel, Series};

/// The cases, with how their fields are.
pub const CASES: [(LeftEnd, &str); 3] =
    [(LeftEnd::Smooth, "smooth"), (LeftEnd::Push, "continuous"), (LeftEnd::Mass, "with jumps")];

/// The errors of the strain on one mesh.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Errors {
    /// How many cells it has.
    pub cells: usize,
    /// `∫|e| dx`.
    pub mean: f64,
    /// `√∫e² dx`.
    pub square: f64,
    /// `max |e|`.
    pub largest: f64,
}

/// The scene of a case, as wavestep reads it.
pub fn scene(end: LeftEnd) -> &'static str {
    match end {
        LeftEnd::Mass => {
            "scene \"A mass strikes a fixed bar\"\n\
             mass hammer { mass = 1, velocity = 1 }\n\
             bar rod { impedance = 1, travel = 1 }\n\
             line free - hammer - rod - fixed\n"
        }
        LeftEnd::Push => {
            "scene \"A growing force on a fixed bar\"\n\
             load push { force = t }\n\
             bar rod { impedance = 1, travel = 1 }\n\
             line free - push - rod - fixed\n"
        }
        LeftEnd::Smooth => {
            "scene \"A force that begins smoothly on a fixed bar\"\n\
             load push { force = t^4 }\n\
             bar rod { impedance = 1, travel = 1 }\n\
             line free - push - rod - fixed\n"
        }
    }
}

/// Runs the code to the time 3/2 at Courant's number 4/5, and compares.
///
/// # Errors
/// Where there are no cells, or too many.
///
/// # Panics
/// Where the number of cells is no multiple of 8.
pub fn errors(end: LeftEnd, cells: usize) -> Result<Errors, wavestep::Error> {
    assert!(cells.is_multiple_of(8), "so that a step ends at 3/2");
    let mut code = Leapfrog::new(cells, 0.8, end);
    for _ in 0..cells * 15 / 8 {
        code.advance();
    }
    assert!((code.time() - 1.5).abs() < 1e-9);
    let problem = Problem::read("case.wave", scene(end))?;
    let exact = problem.field_averages("3/2", cells)?;
    let exact = exact.bars[0].of(Quantity::Strain);
    let off: Vec<f64> =
        code.strain.iter().zip(exact).map(|(own, exact)| (own - exact.value).abs()).collect();
    let mean = |power: i32| off.iter().map(|e| e.powi(power)).sum::<f64>() / cells as f64;
    let largest = off.iter().copied().fold(0.0, f64::max);
    Ok(Errors { cells, mean: mean(1), square: mean(2).sqrt(), largest })
}

/// The order that two errors show: `p` in `e ~ h^p`.
pub fn order(coarse: (usize, f64), fine: (usize, f64)) -> f64 {
    (coarse.1 / fine.1).log2() / (fine.0 as f64 / coarse.0 as f64).log2()
}

/// The errors over the number of cells, all cases and all norms; the orders between the coarsest and the
/// finest mesh stand beside the names.
///
/// # Errors
/// As [`errors`]; a figure where an error is zero.
pub fn figure(cells: &[usize]) -> Result<Figure, Box<dyn Error>> {
    let mut panels = Vec::new();
    for (end, name) in CASES {
        let found: Vec<Errors> =
            cells.iter().map(|cells| errors(end, *cells)).collect::<Result<_, _>>()?;
        let series = |name: &str, of: fn(&Errors) -> f64| {
            let points: Vec<(f64, f64)> =
                found.iter().map(|errors| (errors.cells as f64, of(errors))).collect();
            let ends = found.first().zip(found.last()).filter(|(a, b)| a.cells < b.cells);
            let name = match ends.map(|(a, b)| order((a.cells, of(a)), (b.cells, of(b)))) {
                Some(order) => format!("{name}: order {order:.2}"),
                None => name.to_owned(),
            };
            Series::new(&name, points).look(Look::Both)
        };
        let series = vec![
            series("mean", |errors| errors.mean),
            series("root of the mean square", |errors| errors.square),
            series("largest", |errors| errors.largest),
        ];
        panels.push(Panel::new(Axis::logarithmic(&format!("error of the strain, {name}")), series));
    }
    let title = "Leapfrog against the exact field";
    Ok(Figure::new(title, Axis::logarithmic("cells"), panels, Caption::default())?)
}
