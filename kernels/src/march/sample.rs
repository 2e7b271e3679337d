//! Values of a wave at ascending times, from one march that keeps one period at a time.

use super::reflection::Reflection;
use super::scalar::{Bounds, March, MarchError, MarchOptions};
use std::fmt;

/// A time: the number of a period and the time since its beginning, in periods.
///
/// Apart, the two lose nothing at large periods: the wave changes by up to `2nB` times a change of
/// the local time.
///
/// # Invariants
/// `local` is in `[0, 1]`. At 1 the time is the limit from the left at the period's end; the next
/// period's 0 is the limit from the right.
///
/// ```
/// use wavestep_kernels::march::LocalTime;
///
/// assert_eq!(LocalTime::new(3, 0.25).unwrap().period(), 3);
/// assert!(LocalTime::new(3, 1.5).is_none());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct LocalTime {
    period: usize,
    local: f64,
}

impl LocalTime {
    /// The time `local` after the beginning of `period`; `None` where `local` is not in `[0, 1]`.
    /// O(1).
    pub fn new(period: usize, local: f64) -> Option<LocalTime> {
        (0.0..=1.0).contains(&local).then_some(LocalTime { period, local })
    }

    /// The number of the period. O(1).
    pub fn period(self) -> usize {
        self.period
    }

    /// The time since its beginning, in periods. O(1).
    pub fn local(self) -> f64 {
        self.local
    }
}

/// The wave at `times`, which have to come by ascending periods. O(N) a period and a time.
///
/// No bounds are computed, whatever `options` says.
///
/// # Errors
/// [`SampleError::Order`] where a period comes after a later one; [`SampleError::March`] where the
/// march fails.
///
/// ```
/// use wavestep_kernels::march::{LocalTime, MarchOptions, Reflection, sample};
///
/// let times: Vec<_> = (0..6).map(|n| LocalTime::new(n, 0.0).unwrap()).collect();
/// let ends: Vec<_> = (0..6).map(|n| LocalTime::new(n, 1.0).unwrap()).collect();
/// let wave = Reflection::exact(2.0, 2.0, 1.0)?;
/// let after = sample(&wave, MarchOptions::default(), &times)?;
/// let before = sample(&wave, MarchOptions::default(), &ends)?;
/// // The rigid mass: every front jumps by 1.
/// assert!((1..6).all(|n| (after[n] - before[n - 1] - 1.0).abs() < 1e-14));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn sample(
    reflection: &Reflection,
    options: MarchOptions,
    times: &[LocalTime],
) -> Result<Vec<f64>, SampleError> {
    let options = MarchOptions { bounds: Bounds::None, ..options };
    let mut values = vec![0.0; times.len()];
    walk(reflection, options, times, &mut values, |_, _| ())?;
    Ok(values)
}

/// The wave at `times` as by [`sample`], and for each value a proven bound of its error, or `None`.
/// O(N) a period and a time.
///
/// # Errors
/// As [`sample`].
///
/// ```
/// use wavestep_kernels::march::{LocalTime, MarchOptions, Reflection, sample_with_bounds};
///
/// let wave = Reflection::exact(2.0, 2.0, 1.0)?;
/// let times = [LocalTime::new(0, 0.5).unwrap(), LocalTime::new(200, 0.5).unwrap()];
/// let (values, bounds) = sample_with_bounds(&wave, MarchOptions::default(), &times)?;
/// assert!((values[0] - (-1f64).exp()).abs() <= bounds[0].unwrap());
/// assert!(bounds[1].unwrap() < 1e-11);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[allow(clippy::type_complexity)]
pub fn sample_with_bounds(
    reflection: &Reflection,
    options: MarchOptions,
    times: &[LocalTime],
) -> Result<(Vec<f64>, Vec<Option<f64>>), SampleError> {
    let options = MarchOptions { bounds: Bounds::Proven, ..options };
    let mut values = vec![0.0; times.len()];
    let mut bounds = Vec::with_capacity(times.len());
    walk(reflection, options, times, &mut values, |march, points| {
        bounds.resize(bounds.len() + points, march.bound());
    })?;
    Ok((values, bounds))
}

/// Marches through the periods of `times`, fills `values`, and calls `visit` with the march and the
/// number of points on each period that has any.
fn walk(
    reflection: &Reflection,
    options: MarchOptions,
    times: &[LocalTime],
    values: &mut [f64],
    mut visit: impl FnMut(&March, usize),
) -> Result<(), SampleError> {
    if let Some(at) = times.windows(2).position(|pair| pair[0].period > pair[1].period) {
        return Err(SampleError::Order { position: at + 1 });
    }
    let mut march = March::new(reflection, options).map_err(SampleError::March)?;
    let mut points = Vec::new();
    let mut values = values;
    for group in times.chunk_by(|a, b| a.period == b.period) {
        while march.period() < group[0].period {
            march.advance().map_err(SampleError::March)?;
        }
        points.clear();
        points.extend(group.iter().map(|time| time.local));
        let (here, rest) = values.split_at_mut(group.len());
        march.values(&points, here);
        visit(&march, group.len());
        values = rest;
    }
    Ok(())
}

/// Why values cannot be given.
///
/// ```
/// use wavestep_kernels::march::{LocalTime, MarchOptions, Reflection, SampleError, sample};
///
/// let times = [LocalTime::new(2, 0.0).unwrap(), LocalTime::new(1, 0.0).unwrap()];
/// let refused = sample(&Reflection::exact(2.0, 2.0, 1.0)?, MarchOptions::default(), &times);
/// assert_eq!(refused.unwrap_err(), SampleError::Order { position: 1 });
/// # Ok::<(), wavestep_kernels::march::ReflectionError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SampleError {
    /// A time lies on an earlier period than the one before it.
    Order {
        /// The place of that time.
        position: usize,
    },
    /// The march failed.
    March(MarchError),
}

impl fmt::Display for SampleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Order { position } => write!(
                f,
                "the time at position {position} is on an earlier period than the one before it: \
                 sort the times"
            ),
            Self::March(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for SampleError {}
