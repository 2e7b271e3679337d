//! `--minus`: what a quantity is compared with.

use super::arguments::Scene;
use super::failure::Failure;
use super::input;
use wavestep::language::ChangeError;
use wavestep::problem::{Against, Other, Problem, ProblemError, Simpler};

/// What is subtracted.
pub enum Compared {
    Scene(Box<input::Asked>),
    Simpler(Other),
}

impl Compared {
    pub fn problem(&self) -> Option<&Problem> {
        match self {
            Compared::Scene(problem) => Some(problem),
            Compared::Simpler(Other::Problem(problem)) => Some(problem),
            Compared::Simpler(_) => None,
        }
    }

    /// Whether it tells an observable of a problem: echoes tell sums of waves alone.
    pub fn tells(&self, of: &Problem, name: &str) -> bool {
        match self {
            Compared::Simpler(Other::Arrivals(_)) => {
                of.wanted(name).is_ok_and(|wanted| wanted.observation().is_some())
            }
            other => other.problem().is_none_or(|own| own.observables().contains(&name)),
        }
    }
}

impl<'p> From<&'p Compared> for Against<'p> {
    fn from(compared: &'p Compared) -> Against<'p> {
        match compared {
            Compared::Scene(problem) => Against::Problem(problem),
            Compared::Simpler(other) => other.into(),
        }
    }
}

/// The scene, and what is taken from it: another scene, or this one with something left out. Each has the values that it
/// has symbols for; a value for a symbol of neither is given to the first, which says so.
pub fn scenes(
    asked: &Scene,
    minus: Option<&str>,
) -> Result<(input::Asked, Option<Compared>), Failure> {
    let Some(minus) = minus else { return Ok((input::problem(asked)?, None)) };
    if minus.trim().is_empty() {
        let remedy = "name a scene or a simplification, such as `third`";
        return Err(Failure::usage("`--minus` is empty", remedy));
    }
    let scene = &*asked.scene;
    if !input::is_scene(minus) {
        let simpler: Simpler = minus.parse().map_err(|error| match error {
            ChangeError::Unknown(_) if !minus.contains([':', '+']) => {
                input::unread(minus, &std::io::ErrorKind::NotFound.into())
            }
            error => ProblemError::from(error).into(),
        })?;
        let problem = input::problem(asked)?;
        let other = Compared::Simpler(problem.simpler(&simpler)?);
        return Ok((problem, Some(other)));
    }
    let values = input::values(&asked.set)?;
    let [own, other] = [scene, minus].map(|scene| input::problem_with(scene, &Default::default()));
    let (own, other) = (own?, other?);
    let of = |problem: &input::Asked, name: &str| problem.symbols().contains(&name);
    let (mut owns, mut others) = (values.clone(), values);
    owns.retain(|name, _| of(&own, name) || !of(&other, name));
    others.retain(|name, _| of(&other, name));
    let other = Compared::Scene(Box::new(input::problem_with(minus, &others)?));
    Ok((input::problem_with(scene, &owns)?, Some(other)))
}
