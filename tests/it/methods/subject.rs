//! What is evaluated: an observable of a scene or recurrence on a window, with its enclosures.

use crate::methods::{BITS, Values};
use num_rational::BigRational;
use std::collections::BTreeMap;
use wavestep::answer::Question;
use wavestep::ball::Ball;
use wavestep::language::parse_number;
use wavestep::problem::Problem;
use wavestep::signal::{
    At, ClosedForm, ClosedSignal, Compiled, Limit, Marched, MethodError, Signal, Value, digits,
};

/// Precision that the exact forms may use.
const LIMIT_BITS: u64 = 1 << 14;

/// An observable on a window.
pub struct Subject<'a> {
    pub name: String,
    pub question: Question<'a>,
    /// The same, begun earlier: what is seen just before its first time is known as well.
    pub earlier: &'a ClosedSignal<'a>,
    pub from: BigRational,
    pub to: BigRational,
}

impl Subject<'_> {
    /// What methods are asked for.
    pub fn signal(&self) -> &dyn Signal {
        &*self.question.signal
    }

    /// Its closed form.
    pub fn form(&self) -> &ClosedForm {
        self.earlier.form().expect(&self.name)
    }

    /// An enclosure from the pieces in balls.
    pub fn enclose(&self, at: &BigRational, side: Limit, bits: u64) -> Ball {
        let stretch = self.earlier.stretch_at(at, side).expect("an order").expect("a stretch");
        let value = self.earlier.enclose(stretch, 0, At::Time(at), bits);
        value.unwrap_or_else(|error| panic!("{} at {at}: {error}", self.name))
    }

    /// An enclosure as fine as comparisons need.
    pub fn exact(&self, at: &BigRational, side: Limit) -> Ball {
        self.enclose(at, side, BITS)
    }

    /// The value from the symbolic echoes, to so many digits.
    pub fn by_form(&self, at: &BigRational, side: Limit, count: usize) -> Value {
        digits(self.earlier, at, side, count, LIMIT_BITS).expect("a value")
    }

    /// The value where it is known to be a rational number.
    pub fn rational(&self, at: &BigRational, side: Limit) -> Option<BigRational> {
        match self.by_form(at, side, 6) {
            Value::Exact(value) => Some(value),
            _ => None,
        }
    }

    /// About the largest absolute value.
    pub fn scale(&self) -> f64 {
        self.question.scale().expect("a scale")
    }

    pub fn compiled(&self, tolerance: Option<f64>) -> Result<Compiled<'_>, MethodError> {
        Compiled::new(self.signal(), tolerance)
    }

    pub fn marched(&self, proven: bool) -> Result<Marched, MethodError> {
        match proven {
            true => Marched::proven(self.signal()),
            false => Marched::new(self.signal()),
        }
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
    let values: BTreeMap<String, BigRational> =
        values.iter().map(|(name, value)| ((*name).to_owned(), number(value))).collect();
    let (from, to) = (number(from), number(to));
    let problem =
        Problem::of_text("scene", text, &values).unwrap_or_else(|error| panic!("{error}"));
    let begun = &from - (&to - &from) / BigRational::from_integer(8.into());
    let earlier = match problem.network() {
        Ok(network) => {
            let observed = network.observables().iter().find(|known| known.name == quantity);
            let earlier = ClosedSignal::of_scene(network, observed.expect(quantity), [&begun, &to]);
            earlier.expect("one").echo_by_echo()
        }
        Err(_) => {
            let solution = problem.solution().expect("equations");
            let observation = solution.recurrence().observation(quantity).expect(quantity);
            ClosedSignal::of_recurrence(solution, &observation, [&begun, &to]).expect("numbers")
        }
    };
    earlier.count().expect(&name);
    let question = problem.question(quantity, [from.clone(), to.clone()]).expect(&name);
    work(&Subject { name, question, earlier: &earlier, from, to })
}
