//! Functions of time as Chebyshev series piece by piece, with their integrals.

use std::collections::VecDeque;
use std::f64::consts::PI;
use std::sync::LazyLock;

pub const DEGREE: usize = 24;

pub const POINTS: usize = DEGREE + 1;

/// The values of one function at the points of a piece.
pub type Values = [f64; POINTS];

/// The points of Chebyshev and Lobatto in `[0, 1]`, ascending, where a piece takes its values.
pub fn points() -> Values {
    std::array::from_fn(|j| {
        let half = (PI * j as f64 / (2 * DEGREE) as f64).sin();
        half * half
    })
}

/// A series `Σ c_k T_k(2x − 1)` on one piece of a period.
#[derive(Clone, Debug)]
struct Piece {
    /// Since the period began.
    start: f64,
    length: f64,
    series: Values,
    /// `∫` from the piece's start, over its length.
    integral: [f64; POINTS + 1],
    /// The integral from time 0 to the start of the piece.
    total: f64,
}

impl Piece {
    /// The value at a time since the period began.
    fn value(&self, since: f64) -> f64 {
        let y = (2.0 * (since - self.start) / self.length - 1.0).clamp(-1.0, 1.0);
        sum(&self.series, y)
    }
}

/// A function of time, constant before the start, in periods of one length.
#[derive(Clone, Debug)]
pub struct Track {
    before: f64,
    /// The length of a period.
    period: f64,
    /// The periods that are held, from the first of them on.
    periods: VecDeque<Vec<Piece>>,
    first: usize,
    /// The integral from time 0 to the end.
    total: f64,
}

/// The sum of a series by the recurrence of Clenshaw, at `y` in `[−1, 1]`.
pub fn sum(series: &[f64], y: f64) -> f64 {
    let (mut next, mut after) = (0.0, 0.0);
    for c in series[1..].iter().rev() {
        (next, after) = (c + 2.0 * y * next - after, next);
    }
    series[0] + y * next - after
}

/// What each value at a point adds to each coefficient.
static COEFFICIENTS: LazyLock<[Values; POINTS]> = LazyLock::new(|| {
    let halved = |k: usize| if k == 0 || k == DEGREE { 0.5 } else { 1.0 };
    let entry = |k: usize, j: usize| {
        // The j-th point is at cos(π (N−j)/N) in [−1, 1].
        let turn = k * (DEGREE - j) % (2 * DEGREE);
        2.0 / DEGREE as f64 * halved(j) * halved(k) * (PI * turn as f64 / DEGREE as f64).cos()
    };
    std::array::from_fn(|k| std::array::from_fn(|j| entry(k, j)))
});

/// The coefficients of the polynomial with these values at [`points`].
pub fn series(values: &Values) -> Values {
    let sum = |row: &Values| row.iter().zip(values).map(|(c, value)| c * value).sum();
    COEFFICIENTS.each_ref().map(sum)
}

/// The integral of a series from the start of its piece, over a piece of length 1.
///
/// `∫ T_k = (T_{k+1}/(k+1) − T_{k−1}/(k−1))/2`, and `T_0 + T_1` for `k = 0`, over half the length.
pub fn integral(series: &Values) -> [f64; POINTS + 1] {
    let mut integral = [0.0; POINTS + 1];
    let c = |k: usize| series.get(k).copied().unwrap_or(0.0);
    for (k, entry) in integral.iter_mut().enumerate().skip(1) {
        let below = if k == 1 { 2.0 * c(0) } else { c(k - 1) };
        *entry = (below - c(k + 1)) / (4 * k) as f64;
    }
    integral[0] = -sum(&integral, -1.0);
    integral
}

impl Track {
    pub fn new(before: f64, period: f64) -> Track {
        Track { before, period, periods: VecDeque::new(), first: 0, total: 0.0 }
    }

    pub fn begin(&mut self) {
        self.periods.push_back(Vec::new());
    }

    /// Lets go of the periods before one.
    pub fn forget(&mut self, before: usize) {
        let count = before.saturating_sub(self.first).min(self.periods.len());
        self.periods.drain(..count);
        self.first += count;
    }

    pub fn push(&mut self, start: f64, length: f64, series: Values) {
        let integral = integral(&series).map(|entry| entry * length);
        let piece = Piece { start, length, series, integral, total: self.total };
        self.total += sum(&piece.integral, 1.0);
        self.periods.back_mut().expect("a period has begun").push(piece);
    }

    fn piece(&self, period: usize, since: f64) -> &Piece {
        let pieces = &self.periods[period - self.first];
        let count = pieces.partition_point(|piece| piece.start <= since);
        &pieces[count.saturating_sub(1)]
    }

    /// The values at the points of a piece of time in a period, at its end the limit from earlier times; before the start
    /// for a negative period.
    pub fn on(&self, period: i64, times: &Values) -> Values {
        let mut values = times.map(|since| self.within(period, since));
        if let Ok(period) = usize::try_from(period) {
            let last = times[POINTS - 1];
            let pieces = &self.periods[period - self.first];
            let count = pieces.partition_point(|piece| piece.start < last);
            values[POINTS - 1] = pieces[count.saturating_sub(1)].value(last);
        }
        values
    }

    /// The value in a period, some time after it began; before the start for a negative period.
    pub fn within(&self, period: i64, since: f64) -> f64 {
        let Ok(period) = usize::try_from(period) else { return self.before };
        self.piece(period, since).value(since)
    }

    /// The period that a time is in, and how long since it began; a time that is a rounding below a
    /// period is in it.
    fn place(&self, time: f64) -> (i64, f64) {
        let periods = time / self.period;
        let period = (periods + 1e-11 * periods.abs().max(1.0)).floor();
        let last = (self.first + self.periods.len()) as i64 - 1;
        let period = (period as i64).min(last);
        (period, (time - period as f64 * self.period).clamp(0.0, self.period))
    }

    /// The value at a time, behind a jump.
    pub fn value(&self, time: f64) -> f64 {
        let (period, since) = self.place(time);
        self.within(period, since)
    }

    /// The integral from the start to a time, also to one before.
    pub fn integral(&self, time: f64) -> f64 {
        if time <= 0.0 {
            return self.before * time;
        }
        let (period, since) = self.place(time);
        let Ok(period) = usize::try_from(period) else { return self.before * time };
        let piece = self.piece(period, since);
        let y = (2.0 * (since - piece.start) / piece.length - 1.0).clamp(-1.0, 1.0);
        piece.total + sum(&piece.integral, y)
    }
}
