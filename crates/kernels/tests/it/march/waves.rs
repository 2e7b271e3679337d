//! Several waves: against the march with a proven bound, and against solutions that are known.

use wavestep_kernels::march::{
    Bounds, Complex, March, MarchError, MarchOptions, Reflection, Scalar, State, Term, WaveMarch,
    WaveStep, WaveSystem,
};

/// A wave that is a state with a rate, 1 at the start.
fn state(wave: usize, rate: f64, drive: Vec<Term<f64>>) -> WaveStep<f64> {
    let state = State { rate, drive, jumps: vec![], initial: 1.0 };
    WaveStep { wave, values: vec![], slopes: vec![], state: Some(state) }
}

fn march(steps: Vec<WaveStep<f64>>) -> Result<WaveMarch<f64>, MarchError> {
    WaveMarch::new(WaveSystem::new(steps).unwrap())
}

fn term(wave: usize, lag: usize, weight: f64) -> Term<f64> {
    Term { wave, lag, weight }
}

/// A rigid mass on a fixed bar: `v' + v = −2 y`, one period ago, `y[n] = y[n−1] + v[n]`, for a
/// period of 2. The same response as of the march with a proven bound, through 1000 periods.
#[test]
fn one_pole_is_as_proven() {
    let v = state(0, -2.0, vec![term(1, 1, -4.0)]);
    let values = vec![term(0, 0, 1.0), term(1, 1, 1.0)];
    let y = WaveStep { wave: 1, values, slopes: vec![], state: None };
    let mut waves = march(vec![v, y]).unwrap();
    let reflection = Reflection::exact(2.0, 2.0, 1.0).unwrap();
    let options = MarchOptions { bounds: Bounds::None, ..MarchOptions::default() };
    let mut proven = March::new(&reflection, options).unwrap();
    let points: Vec<f64> = (0..=40).map(|i| f64::from(i) / 40.0).collect();
    let mut worst = 0.0_f64;
    for _ in 0..1000 {
        for (x, value) in points.iter().zip(waves.values(1, &points)) {
            worst = worst.max((value.re - proven.value(*x)).abs());
            assert_eq!(value.im, 0.0);
        }
        waves.advance().unwrap();
        proven.advance().unwrap();
    }
    println!("1000 periods: {worst:e}");
    assert!(worst < 1e-13, "{worst:e}");
}

/// `u'' + (2π)² u = 0` as two waves that turn into each other comes back after each period.
#[test]
fn spans_are_short_enough_for_turning() {
    let rate = Complex { re: 0.0, im: std::f64::consts::TAU };
    let state = State { rate, drive: vec![], jumps: vec![], initial: Complex::ONE };
    let step = WaveStep { wave: 0, values: vec![], slopes: vec![], state: Some(state) };
    let mut march = WaveMarch::new(WaveSystem::new(vec![step]).unwrap()).unwrap();
    assert_eq!(march.spans(), 8);
    (0..50).for_each(|_| march.advance().unwrap());
    let half = 0.5f64.sqrt();
    let found = march.values(0, &[0.0, 0.25, 0.625]);
    for (found, (re, im)) in found.into_iter().zip([(1.0, 0.0), (0.0, 1.0), (-half, -half)]) {
        assert!((found - Complex { re, im }).size() < 2e-13, "{found:?}");
    }
}

/// `w' = w(t − 1)`, `w = 1` at the start: 1, then `1 + x`, then `2 + x + x²/2`.
#[test]
fn a_delay_equation_has_polynomials() {
    let mut march = march(vec![state(0, 0.0, vec![term(0, 1, 1.0)])]).unwrap();
    march.advance().unwrap();
    march.advance().unwrap();
    assert_eq!((march.period(), march.spans()), (2, 1));
    let points = [0.5, 1.0];
    for (found, exact) in march.values(0, &points).into_iter().zip([2.625, 3.5]) {
        assert!((found.re - exact).abs() < 1e-15 && found.im == 0.0);
    }
    for (found, exact) in march.slopes(0, &points).into_iter().zip([1.5, 2.0]) {
        assert!((found.re - exact).abs() < 1e-14 && found.im == 0.0);
    }
    assert!((2.0..4.0).contains(&march.largest(0)));
}

#[test]
fn what_cannot_be_marched_is_refused() {
    let refused = march(vec![state(0, 1e5, vec![])]).err();
    assert_eq!(refused, Some(MarchError::TooManySpans { limit: 4096 }));
    // It grows by e^{500} a period.
    let mut growing = march(vec![state(0, 500.0, vec![])]).unwrap();
    assert_eq!(growing.advance(), Err(MarchError::Overflow { period: 1 }));
}

#[test]
fn steps_that_make_no_system_are_refused() {
    let refused = |steps| WaveSystem::new(steps).unwrap_err();
    assert_eq!(refused(vec![]), MarchError::NoWaves);
    assert_eq!(refused(vec![state(1, 0.0, vec![])]), MarchError::Steps(1));
    assert_eq!(refused(vec![state(0, 0.0, vec![term(1, 1, 1.0)])]), MarchError::Steps(1));
    assert_eq!(refused(vec![state(0, f64::NAN, vec![])]), MarchError::WaveNotFinite(0));
    // w' = −2 w + v and v[n] = w[n]: each needs the other first, unless it is that of a period ago.
    let echo = WaveStep { wave: 1, values: vec![term(0, 0, 1.0)], slopes: vec![], state: None };
    let both = |lag| vec![state(0, -2.0, vec![term(1, lag, 1.0)]), echo.clone()];
    assert_eq!(refused(both(0)), MarchError::NotYetKnown { wave: 0, other: 1 });
    let system = WaveSystem::new(both(1)).unwrap();
    assert_eq!((system.waves(), system.largest_lag()), (2, 1));
}
