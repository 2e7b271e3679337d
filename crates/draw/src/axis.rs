//! Axes: what is measured along them, and how values become places in the picture.

use super::PlotError;
use super::number::{decimal, power_of_ten};
use serde_json::{Value, json};

/// How distances along an axis stand for values.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Scale {
    /// Equal distances are equal differences.
    Linear,
    /// Equal distances are equal ratios; values are above zero.
    Logarithmic,
}

/// What is measured along an axis, in which unit, and on which scale.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Axis {
    pub name: String,
    /// Its unit; empty for a pure number.
    pub unit: String,
    pub scale: Scale,
}

impl Axis {
    pub fn linear(name: &str) -> Axis {
        Axis { name: name.to_owned(), unit: String::new(), scale: Scale::Linear }
    }

    pub fn logarithmic(name: &str) -> Axis {
        Axis { name: name.to_owned(), unit: String::new(), scale: Scale::Logarithmic }
    }

    #[must_use]
    pub fn unit(mut self, unit: &str) -> Axis {
        unit.clone_into(&mut self.unit);
        self
    }

    /// The name, with the unit in brackets if there is one.
    pub fn label(&self) -> String {
        match self.unit.is_empty() {
            true => self.name.clone(),
            false => format!("{} ({})", self.name, self.unit),
        }
    }

    pub(super) fn json(&self) -> Value {
        let scale = format!("{:?}", self.scale).to_lowercase();
        json!({"name": self.name, "unit": self.unit, "scale": scale})
    }

    /// Refuses a finite value that has no place on this axis: values at or below zero on a logarithmic
    /// axis, and magnitudes above 10³⁰⁰ on a linear one.
    pub(super) fn check(&self, value: f64) -> Result<(), PlotError> {
        let what = || format!("a value of \"{}\"", self.name);
        match self.scale {
            Scale::Logarithmic if value <= 0.0 => {
                Err(PlotError::NotPositive { what: what(), value })
            }
            Scale::Linear if value.is_finite() && value.abs() > 1e300 => {
                Err(PlotError::TooLarge { what: what(), value })
            }
            _ => Ok(()),
        }
    }

    /// Refuses a value that is not finite as well.
    pub(super) fn check_finite(&self, value: f64) -> Result<(), PlotError> {
        let what = format!("a value of \"{}\"", self.name);
        if value.is_finite() { self.check(value) } else { Err(PlotError::TooLarge { what, value }) }
    }
}

/// A mark on an axis: where in pixels, how long, and what stands beside it.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Tick {
    pub position: f64,
    /// Labelled, or a whole power of ten.
    pub major: bool,
    pub label: Option<String>,
}

impl Tick {
    pub fn length(&self) -> f64 {
        if self.major { 6.0 } else { 3.0 }
    }
}

/// The places of values in pixels: linear in the value, or in its decimal logarithm.
///
/// # Invariants
/// `low < high`, both finite, in terms of the scale; so the places are strictly monotone up to
/// rounding.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Mapping {
    scale: Scale,
    low: f64,
    high: f64,
    /// The pixel of `low`.
    pub from: f64,
    /// The pixel of `high`.
    pub to: f64,
}

impl Mapping {
    /// A mapping that shows all `values`, with some room on both sides. Values which are not finite
    /// or have no place on the scale are passed over; without any, one decade or unit is shown.
    pub fn around(scale: Scale, values: impl IntoIterator<Item = f64>) -> Mapping {
        let (low, high) = extremes(scale, values).unwrap_or((0.0, 1.0));
        let (low, high) = match scale {
            Scale::Logarithmic => {
                let room = (0.035 * (high - low)).max(0.1);
                let (low, high) = (low - room, high + room);
                // Two powers of ten at least, so that the scale can be read.
                match high.floor() - low.ceil() < 1.0 {
                    true => (low.floor(), high.ceil()),
                    false => (low, high),
                }
            }
            Scale::Linear => {
                let span = high - low;
                let size = low.abs().max(high.abs());
                match span <= 1e-9 * size {
                    true if size == 0.0 => (-1.0, 1.0),
                    true => (low - 0.1 * size, high + 0.1 * size),
                    false => (low - 0.03 * span, high + 0.03 * span),
                }
            }
        };
        Mapping { scale, low, high, from: 0.0, to: 1.0 }
    }

    /// A mapping from edge to edge without room, `low < high`, both [`on`] the scale.
    pub fn spanning(scale: Scale, low: f64, high: f64) -> Mapping {
        debug_assert!(low < high);
        Mapping { scale, low, high, from: 0.0, to: 1.0 }
    }

    /// The same values between other pixels.
    pub fn onto(mut self, from: f64, to: f64) -> Mapping {
        (self.from, self.to) = (from, to);
        self
    }

    pub fn position(&self, value: f64) -> f64 {
        self.pixel(on(self.scale, value))
    }

    /// The pixel of a value that is given [`on`] the scale.
    pub fn pixel(&self, value: f64) -> f64 {
        self.from + (value - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// Whether a value lies between the ends.
    pub fn contains(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&on(self.scale, value))
    }

    /// The marks of the axis, whose labels stand at least `spacing` pixels apart.
    pub fn ticks(&self, spacing: f64) -> Vec<Tick> {
        match self.scale {
            Scale::Linear => self.linear_ticks(spacing),
            Scale::Logarithmic => self.logarithmic_ticks(spacing),
        }
    }

    fn pixels_per_unit(&self) -> f64 {
        (self.to - self.from).abs() / (self.high - self.low)
    }

    /// Multiples of 1, 2 or 5 times a power of ten, from the smallest such step with enough room.
    fn linear_ticks(&self, spacing: f64) -> Vec<Tick> {
        let least = spacing / self.pixels_per_unit();
        let exponent = least.log10().floor() as i32;
        let steps = [(1, exponent), (2, exponent), (5, exponent), (1, exponent + 1)];
        let size = |(digit, exponent): (i64, i32)| digit as f64 * 10f64.powi(exponent);
        let step = steps.into_iter().find(|&step| size(step) >= least).unwrap_or((2, exponent + 1));
        let first = (self.low / size(step) - 1e-9).ceil() as i64;
        let last = (self.high / size(step) + 1e-9).floor() as i64;
        let tick = |i: i64| Tick {
            position: self.pixel(i as f64 * size(step)),
            major: true,
            label: Some(decimal(i.saturating_mul(step.0), step.1)),
        };
        (first..=last).map(tick).collect()
    }

    /// Powers of ten, labelled every so many, with their multiples between them if there is room;
    /// within less than two powers of ten, the multiples are labelled.
    fn logarithmic_ticks(&self, spacing: f64) -> Vec<Tick> {
        const EVERY: [i32; 13] = [1, 2, 3, 4, 5, 6, 10, 12, 20, 30, 50, 100, 200];
        let decade = self.pixels_per_unit();
        let enough = |every: &&i32| f64::from(**every) * decade >= spacing;
        let every = EVERY.iter().find(enough).copied().unwrap_or(500);
        let first = (self.low - 1e-9).ceil() as i32;
        let last = (self.high + 1e-9).floor() as i32;
        let labelled = (first..=last).filter(|exponent| exponent % every == 0).count();
        let inside = |place: f64| (self.low - 1e-9..=self.high + 1e-9).contains(&place);
        let mut ticks = Vec::new();
        for exponent in first - 1..=last {
            let digits = if decade >= 28.0 { 1..=9 } else { 1..=1 };
            for digit in digits.filter(|digit| inside(place(*digit, exponent))) {
                let between = labelled < 2 && [2, 5].contains(&digit);
                let label = match digit {
                    1 if exponent % every == 0 => Some(power_of_ten(exponent)),
                    _ if between => Some(decimal(digit, exponent)),
                    _ => None,
                };
                let position = self.pixel(place(digit, exponent));
                ticks.push(Tick { position, major: digit == 1 || between, label });
            }
        }
        if ticks.iter().filter(|tick| tick.label.is_some()).count() < 2 {
            // Less than a factor of about two: the values themselves in equal steps.
            let (low, high) = (10f64.powf(self.low), 10f64.powf(self.high));
            let values = Mapping::spanning(Scale::Linear, low, high).onto(self.from, self.to);
            let moved = |tick: Tick| {
                let share = (tick.position - self.from) / (self.to - self.from);
                Tick { position: self.position(low + share * (high - low)), ..tick }
            };
            return values.linear_ticks(spacing).into_iter().map(moved).collect();
        }
        ticks
    }
}

/// The place of `digit · 10^exponent` on a logarithmic scale.
fn place(digit: i64, exponent: i32) -> f64 {
    f64::from(exponent) + (digit as f64).log10()
}

/// A value in terms of the scale: itself or its decimal logarithm.
pub(super) fn on(scale: Scale, value: f64) -> f64 {
    match scale {
        Scale::Linear => value,
        Scale::Logarithmic => value.log10(),
    }
}

/// The least and the greatest value in terms of the scale, of those that have a place on it.
pub(super) fn extremes(scale: Scale, values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let places = values.into_iter().map(|value| on(scale, value)).filter(|value| value.is_finite());
    let wider = |(a, b): (f64, f64), (c, d): (f64, f64)| (a.min(c), b.max(d));
    places.map(|value| (value, value)).reduce(wider)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn between(scale: Scale, low: f64, high: f64) -> Mapping {
        Mapping::spanning(scale, on(scale, low), on(scale, high))
    }

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().filter_map(|tick| tick.label.as_deref()).collect()
    }

    #[test]
    fn places_are_monotone_and_hit_the_ends() {
        for scale in [Scale::Linear, Scale::Logarithmic] {
            let mapping = between(scale, 1e-3, 1e3).onto(400.0, 20.0);
            let values = (-30..=30).map(|i| 10f64.powf(f64::from(i) / 10.0));
            let places: Vec<f64> = values.map(|value| mapping.position(value)).collect();
            assert!(places.windows(2).all(|pair| pair[0] > pair[1]));
            assert!((places[0] - 400.0).abs() < 1e-9 && (places[60] - 20.0).abs() < 1e-9);
        }
        let mapping = between(Scale::Logarithmic, 1e-3, 1e3).onto(0.0, 600.0);
        assert!((mapping.position(1e-1) - 200.0).abs() < 1e-9);
        assert!(mapping.contains(1.0) && !mapping.contains(2e3) && !mapping.contains(0.0));
    }

    #[test]
    fn ticks_are_round_and_far_enough_apart() {
        let linear = between(Scale::Linear, -0.3, 1.04).onto(0.0, 500.0);
        assert_eq!(labels(&linear.ticks(60.0)), ["−0.2", "0", "0.2", "0.4", "0.6", "0.8", "1"]);
        let wide = between(Scale::Logarithmic, 1e-16, 1e0).onto(0.0, 500.0);
        assert_eq!(
            labels(&wide.ticks(60.0)),
            ["10⁻¹⁶", "10⁻¹⁴", "10⁻¹²", "10⁻¹⁰", "10⁻⁸", "10⁻⁶", "10⁻⁴", "10⁻²", "10⁰"]
        );
        let near = between(Scale::Logarithmic, 0.5, 8.0).onto(0.0, 500.0);
        assert_eq!(labels(&near.ticks(60.0)), ["0.5", "10⁰", "2", "5"]);
        let nearer = between(Scale::Logarithmic, 1.1, 1.32).onto(0.0, 500.0);
        assert_eq!(labels(&nearer.ticks(90.0)), ["1.1", "1.15", "1.2", "1.25", "1.3"]);
        let huge = between(Scale::Linear, 0.0, 2e9).onto(0.0, 300.0);
        assert_eq!(labels(&huge.ticks(60.0)), ["0", "5·10⁸", "10⁹", "1.5·10⁹", "2·10⁹"]);
        for (low, high) in [(1e-300, 1e300), (3.0, 4.0), (1e-9, 2e-3)] {
            for scale in [Scale::Linear, Scale::Logarithmic] {
                for spacing in [25.0, 50.0, 90.0] {
                    let ticks = between(scale, low, high).onto(0.0, 600.0).ticks(spacing);
                    let marked: Vec<f64> =
                        ticks.iter().filter(|t| t.label.is_some()).map(|t| t.position).collect();
                    assert!(marked.len() >= 2, "{low} {high} {scale:?} {spacing}");
                    // Multiples 1, 2, 5 of one power of ten are at most as close as log10(2).
                    let closest = if (low, high) == (3.0, 4.0) { 0.8 } else { 1.0 };
                    assert!(
                        marked.windows(2).all(|pair| pair[1] - pair[0] >= closest * spacing - 1e-6),
                        "{low} {high} {scale:?} {spacing}: {marked:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn ranges_leave_room_and_bear_any_data() {
        for values in
            [vec![], vec![f64::NAN], vec![2.0], vec![0.0], vec![5e-324, 1e300], vec![3.0; 4]]
        {
            for scale in [Scale::Linear, Scale::Logarithmic] {
                let mapping = Mapping::around(scale, values.clone()).onto(0.0, 500.0);
                assert!(mapping.low < mapping.high && mapping.high.is_finite(), "{values:?}");
                let seen = values
                    .iter()
                    .filter(|v| v.is_finite() && (scale == Scale::Linear || **v > 0.0));
                for value in seen {
                    let place = mapping.position(*value);
                    assert!(place > 1.0 && place < 499.0, "{values:?} {scale:?}: {place}");
                }
                assert!(labels(&mapping.ticks(50.0)).len() >= 2, "{values:?} {scale:?}");
            }
        }
    }
}
