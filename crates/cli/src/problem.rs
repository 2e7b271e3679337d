//! From a scene or recurrence and the name of a quantity to a problem for evaluation in doubles.

use super::failure::Failure;
use super::input::Subject;
use super::quantity;
use num_rational::BigRational;
use wavestep::answer::Problem;
use wavestep::evaluate::{ClosedForm, ClosedSignal, Limit};
use wavestep::language;
use wavestep::network::Network;
use wavestep::solution::Solution;

/// What a problem is called.
pub struct Titles {
    /// The title of the scene.
    pub title: String,
    /// The unit of the values, empty where there is none.
    pub unit: String,
    /// The unit of time, empty where there is none.
    pub time_unit: String,
}

/// Whether times of a subject are given with units.
pub fn is_dimensional(subject: &Subject) -> bool {
    matches!(subject, Subject::Scene(network) if network.scene().dimensional)
}

/// Calls `work` with the problem of a quantity on a window.
pub fn with_problem<T>(
    subject: Subject,
    name: &str,
    (from, to): (BigRational, BigRational),
    work: impl FnOnce(&Problem<'_>, &Titles) -> Result<T, Failure>,
) -> Result<T, Failure> {
    match subject {
        Subject::Recurrence(recurrence) => {
            let observation = quantity::of_recurrence(&recurrence, name)?;
            let solution = Solution::new(*recurrence);
            let exact = ClosedSignal::of_recurrence(&solution, &observation, [&from, &to])?;
            let signal = ClosedForm::of_recurrence(solution.recurrence(), &observation)?;
            let recognise = |at: &BigRational, side: Limit| exact.rational(at, side);
            let title = solution.recurrence().statement().title.clone();
            let titles = Titles { title, unit: String::new(), time_unit: String::new() };
            let recognise = &recognise;
            let problem = Problem { signal: &signal, scene: None, recognise, from, to };
            work(&problem, &titles)
        }
        Subject::Scene(network) => of_scene(&network, name, (from, to), work),
    }
}

fn of_scene<T>(
    network: &Network,
    name: &str,
    (from, to): (BigRational, BigRational),
    work: impl FnOnce(&Problem<'_>, &Titles) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let observed = quantity::of_scene(network, name)?;
    let signal = ClosedForm::of_scene(network, &observed, &to)?;
    let exact = ClosedSignal::of_scene(network, &observed, [&from, &to])?;
    let recognise = |at: &BigRational, side: Limit| exact.rational(at, side);
    let dimensional = network.scene().dimensional;
    let titles = Titles {
        title: network.scene().title.clone(),
        unit: language::unit_of(observed.dimension),
        time_unit: if dimensional { "s".to_owned() } else { String::new() },
    };
    let place = network.observables().iter().position(|known| known.name == observed.name);
    let scene = place.map(|place| (network, place));
    let recognise = &recognise;
    work(&Problem { signal: &signal, scene, recognise, from, to }, &titles)
}
