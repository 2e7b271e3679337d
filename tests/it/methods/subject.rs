//! What is evaluated: an observable of a scene or recurrence on a window, with its enclosures.

use crate::methods::{BITS, Values};
use num_rational::BigRational;
use std::collections::BTreeMap;
use wavestep::answer::Question;
use wavestep::ball::Ball;
use wavestep::evaluate::{
    ClosedForm, ClosedSignal, Compiled, Limit, Marched, MethodError, Recogniser, Stretch, Value,
    digits,
};
use wavestep::language::{self, Source, Stated, parse_number};
use wavestep::network::Network;
use wavestep::solution::Solution;

/// Precision that the exact forms may use.
const LIMIT_BITS: u64 = 1 << 14;

/// An observable on a window.
pub struct Subject<'a> {
    pub name: String,
    pub signal: &'a ClosedForm,
    pub recognise: &'a Recogniser<'a>,
    pub from: BigRational,
    pub to: BigRational,
    pub stretches: Vec<Stretch>,
    scene: Option<(&'a Network, usize)>,
    by_form: &'a dyn Fn(&BigRational, Limit, usize) -> Value,
}

impl<'a> Subject<'a> {
    /// An enclosure from the pieces in balls.
    pub fn enclose(&self, at: &BigRational, side: Limit, bits: u64) -> Ball {
        let stretch = self.signal.stretch_at(&self.stretches, at, side).expect("an order");
        let scaled = self.signal.slowness().scale(at);
        let value = self.signal.enclose(&self.stretches[stretch], 0, &scaled, bits);
        value.unwrap_or_else(|error| panic!("{} at {at}: {error}", self.name))
    }

    /// An enclosure as fine as comparisons need.
    pub fn exact(&self, at: &BigRational, side: Limit) -> Ball {
        self.enclose(at, side, BITS)
    }

    /// The value from the symbolic echoes, to so many digits.
    pub fn by_form(&self, at: &BigRational, side: Limit, digits: usize) -> Value {
        (self.by_form)(at, side, digits)
    }

    pub fn problem(&self) -> Question<'a> {
        let (from, to) = (self.from.clone(), self.to.clone());
        Question { signal: self.signal, scene: self.scene, recognise: self.recognise, from, to }
    }

    /// About the largest absolute value.
    pub fn scale(&self) -> f64 {
        self.problem().scale().expect("a scale")
    }

    pub fn compiled(&self, tolerance: Option<f64>) -> Result<Compiled<'a>, MethodError> {
        Compiled::new(self.signal, &self.from, &self.to, tolerance)
    }

    pub fn marched(&self, proven: bool) -> Result<Marched, MethodError> {
        Marched::new(self.signal, &self.from, &self.to, proven)
    }

    fn title(text: &str, quantity: &str, values: Values<'_>) -> String {
        let title = text.lines().find_map(|line| line.split('"').nth(1)).unwrap_or_default();
        format!("{title}, {quantity}, {values:?}")
    }
}

/// A scene's text by its name; other texts as they are.
fn text_of(scene: &str) -> &str {
    wavestep::scenes::find(scene).map_or(scene, |scene| scene.text)
}

/// The stretches of a window, begun earlier: what is seen just before its first time is known as well.
fn stretches(signal: &ClosedForm, from: &BigRational, to: &BigRational) -> Vec<Stretch> {
    let earlier = from - (to - from) / BigRational::from_integer(8.into());
    signal.stretches(&earlier, to).expect("stretches")
}

fn number(text: &str) -> BigRational {
    parse_number(text).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// Calls `work` with an observable of a scene or recurrence, given by its name or text, on a window.
pub fn with<T>(
    scene: &str,
    values: Values<'_>,
    quantity: &str,
    (from, to): (&str, &str),
    work: impl FnOnce(&Subject<'_>) -> T,
) -> T {
    let text = text_of(scene);
    let name = Subject::title(text, quantity, values);
    let source = Source::new("scene", text).expect("a text");
    let values: BTreeMap<String, BigRational> =
        values.iter().map(|(name, value)| ((*name).to_owned(), number(value))).collect();
    let (from, to) = (number(from), number(to));
    let stated = language::read(&source, &values).unwrap_or_else(|errors| {
        let texts: Vec<String> = errors.iter().map(ToString::to_string).collect();
        panic!("{}", texts.join("\n"))
    });
    match stated {
        Stated::Recurrence(recurrence) => {
            let solution = Solution::new(*recurrence);
            let observation = solution.recurrence().observation(quantity).expect(quantity);
            let exact = ClosedSignal::of_recurrence(&solution, &observation, [&from, &to]);
            let exact = exact.expect("numbers");
            let signal =
                ClosedForm::of_recurrence(solution.recurrence(), &observation).expect(&name);
            let stretches = stretches(&signal, &from, &to);
            let by_form = |at: &BigRational, side, count| {
                digits(&exact, at, side, count, LIMIT_BITS).expect("a value")
            };
            work(&Subject {
                name,
                signal: &signal,
                recognise: &|at, side| exact.rational(at, side),
                from,
                to,
                stretches,
                scene: None,
                by_form: &by_form,
            })
        }
        Stated::Scene(scene) => {
            let network = Network::new(&scene).expect("a network");
            let place = network.observables().iter().position(|known| known.name == quantity);
            let place = place.expect(quantity);
            let observed = &network.observables()[place];
            let signal = ClosedForm::of_scene(&network, observed, &to).expect(&name);
            let stretches = stretches(&signal, &from, &to);
            let exact = ClosedSignal::of_scene(&network, observed, [&from, &to]).expect("one");
            let exact = exact.echo_by_echo();
            let by_form = |at: &BigRational, side, count| {
                digits(&exact, at, side, count, LIMIT_BITS).expect("a value")
            };
            work(&Subject {
                name,
                signal: &signal,
                recognise: &|at, side| exact.rational(at, side),
                from,
                to,
                stretches,
                scene: Some((&network, place)),
                by_form: &by_form,
            })
        }
    }
}
