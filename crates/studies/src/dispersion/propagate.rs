//! A pulse on its way, on a periodic grid: its Fourier components are turned by their own `e^{−iωt}`, and
//! the peak is looked for. In doubles, tested and not proven: it shows how long the predicted velocity
//! of the peak holds.

use std::f64::consts::PI;

use num_traits::FromPrimitive as _;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;
use wavestep_polynomial::Rational;

use super::error::{DispersionError, NoGrid};
use super::pulse::Pulse;
use super::relation::{Quantity, Relation, value};
use wavestep::ball::Ball;

/// The precision in which frequencies and amplitudes are enclosed before they are rounded.
const BITS: u64 = 64;
/// Points to the shortest wavelength.
const POINTS_A_WAVE: f64 = 16.0;
/// The least length of a grid, in shortest wavelengths.
const LEAST_WAVES: f64 = 256.0;
/// Gregory's weights of the first and last terms of a sum that stands for an integral; the error is of
/// the fourth order in the step.
const END_WEIGHTS: [f64; 3] = [3.0 / 8.0, 7.0 / 6.0, 23.0 / 24.0];
const MAX_POINTS: usize = 1 << 20;
/// Steps of Newton's method for the place of the peak.
const NEWTON_STEPS: usize = 8;

/// What is seen of a pulse at the end of its way.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// Where the highest point is at the end; the pulse is centred at 0 at first.
    pub position: f64,
    /// `position/T`, the mean velocity of the peak.
    pub velocity: f64,
    pub height: f64,
    pub first_height: f64,
    pub length: f64,
    pub points: usize,
    /// The displacements at `x = −length/2 + i length/points`.
    pub displacement: Vec<f64>,
}

/// A component: wavenumber, amplitude, frequency.
struct Wave {
    k: f64,
    amplitude: f64,
    omega: f64,
}

/// Sends a pulse, made of the components up to its cut-off, on its way until the time `T > 0`.
///
/// The period of the grid is the next multiple of `2π/k_co`, at least 256 of them, that holds four times
/// the way of the fastest component. It stands for endless space as long as nothing that matters has gone
/// half a period; the step of wavenumbers is `2π/length`. The cut-off is a component of the grid, so the
/// sum stands for the integral over wavenumbers, with Gregory's weights at both ends. Without a number of
/// points, it is the next power of two that gives the shortest wave sixteen. Not proven: rank *tested*.
/// Takes a ball evaluation for each component, and a transform of `points` numbers.
pub fn propagate(
    relation: &Relation,
    pulse: &Pulse,
    time: f64,
    points: Option<usize>,
) -> Result<Seen, DispersionError> {
    if !(time > 0.0 && time.is_finite()) {
        return Err(NoGrid::Time.into());
    }
    let (cut_off, _) = pulse.cut_off(relation, BITS)?.to_double();
    let wave = 2.0 * PI / cut_off;
    let way = 4.0 * fastest(relation, cut_off)? * time;
    let last = (LEAST_WAVES + way / wave).ceil();
    let length = last * wave;
    let step = 2.0 * PI / length;
    let (least, wanted) = (2.0 * last, last * POINTS_A_WAVE);
    let points = match points {
        Some(points) if least < MAX_POINTS as f64 => points,
        None if wanted <= MAX_POINTS as f64 => (wanted.ceil() as usize).next_power_of_two(),
        _ => return Err(NoGrid::TooLong { limit: MAX_POINTS }.into()),
    };
    if points > MAX_POINTS || points as f64 <= least {
        return Err(NoGrid::Points { least: least as usize, limit: MAX_POINTS }.into());
    }
    let spectrum = pulse.spectrum(relation);
    let mut waves = Vec::new();
    for j in 0..=last as usize {
        let k = step * j as f64;
        let ball = Ball::from_rational(&Rational::from_f64(k).expect("a finite number"), BITS);
        let double = |formula| value(formula, &ball, BITS).map(|ball| ball.to_double().0);
        let weight = END_WEIGHTS.get(j.min(last as usize - j)).unwrap_or(&1.0);
        let amplitude = weight * double(&spectrum)?;
        waves.push(Wave { k, amplitude, omega: double(relation.frequency())? });
    }
    let displacement = displacements(&waves, time, points);
    let highest = (0..points).max_by(|a, b| displacement[*a].total_cmp(&displacement[*b]));
    let coarse = length * (highest.expect("points") as f64 / points as f64 - 0.5);
    let position = refined(&waves, time, coarse, length / points as f64);
    Ok(Seen {
        position,
        velocity: position / time,
        height: at(&waves, time, position),
        first_height: waves.iter().map(|wave| wave.amplitude).sum(),
        length,
        points,
        displacement,
    })
}

/// The largest `|c_g|` among some components.
fn fastest(relation: &Relation, cut_off: f64) -> Result<f64, DispersionError> {
    let mut largest: f64 = 0.0;
    for i in 1..=64 {
        let sample = relation.sample(Quantity::GroupVelocity, cut_off * f64::from(i) / 64.0)?;
        largest = largest.max(sample.value.abs());
    }
    Ok(largest)
}

/// `Σ U_j cos(k_j x − ω_j t)` at all points, from `x = −length/2` on.
fn displacements(waves: &[Wave], time: f64, points: usize) -> Vec<f64> {
    let mut buffer = vec![Complex64::default(); points];
    for (j, (slot, wave)) in buffer.iter_mut().zip(waves).enumerate() {
        // Half a period to the left: e^{−ik length/2} = (−1)^j.
        let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
        *slot = Complex64::from_polar(1.0, -wave.omega * time) * (sign * wave.amplitude);
    }
    FftPlanner::new().plan_fft_inverse(points).process(&mut buffer);
    buffer.into_iter().map(|value| value.re).collect()
}

fn at(waves: &[Wave], time: f64, x: f64) -> f64 {
    waves.iter().map(|wave| wave.amplitude * (wave.k * x - wave.omega * time).cos()).sum()
}

/// The zero of the slope next to a grid point, by Newton's method on the Fourier sum; the grid point
/// itself where the steps lead more than one point away.
fn refined(waves: &[Wave], time: f64, coarse: f64, step: f64) -> f64 {
    let mut x = coarse;
    for _ in 0..NEWTON_STEPS {
        let (mut slope, mut curvature) = (0.0, 0.0);
        for Wave { k, amplitude, omega } in waves {
            let (sin, cos) = (k * x - omega * time).sin_cos();
            slope -= amplitude * k * sin;
            curvature -= amplitude * k * k * cos;
        }
        x -= slope / curvature;
        if x.is_nan() || (x - coarse).abs() > step {
            return coarse;
        }
    }
    x
}
