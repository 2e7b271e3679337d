//! The harness of the charts, measured itself: a known error in is a known error out.

use wavestep::answer::{Kind, Problem};
use wavestep::evaluate::{Evaluator, Signal};
use wavestep::language::{Source, parse_number, read_recurrence};
use wavestep::solution::Solution;
use wavestep::study::{Reference, Sampling, Settings, errors, measure, worst};

fn with_problem(work: impl FnOnce(&Problem<'_>)) {
    let text = wavestep::scenes::find("rigid-mass").unwrap().text;
    let values = [("mu".to_owned(), parse_number("1/3").unwrap())].into();
    let source = Source::new("rigid-mass", text).unwrap();
    let solution = Solution::new(read_recurrence(&source, &values).unwrap());
    let f = solution.recurrence().observation("f").unwrap();
    let signal = Signal::of_recurrence(solution.recurrence(), &f).unwrap();
    let evaluator = Evaluator::new(&solution).unwrap();
    let recognise = |at: &_, side| evaluator.rational(&f, at, side);
    let (from, to) = (parse_number("0").unwrap(), parse_number("12").unwrap());
    work(&Problem { signal: &signal, scene: None, recognise: &recognise, from, to });
}

/// The reference's own values are off by half a unit in the last place at most, and an error that is
/// put in comes out, on each value alone.
#[test]
fn known_errors_are_measured() {
    with_problem(|problem| {
        let times = Sampling { points: 100, seed: 3 }.times(0.0, 12.0);
        let reference = Reference::new(problem, &times).unwrap();
        assert!(reference.radius() < 1e-29, "{:e}", reference.radius());
        let certified = wavestep::answer::Way::new(Kind::Certified, problem, None).unwrap();
        let values = certified.values(&times).unwrap();
        assert!(worst(&reference.errors(&values)) <= f64::EPSILON / 2.0);
        for (i, known) in [(0, 1e-3), (17, 1e-9), (99, 1e-13)] {
            let mut changed = values.clone();
            changed[i] += known * reference.scale();
            let measured = reference.errors(&changed);
            assert!(
                (measured[i] - known).abs() <= 2.0 * f64::EPSILON,
                "{known:e}: {:e}",
                measured[i]
            );
            assert!((worst(&measured) - known).abs() <= 2.0 * f64::EPSILON);
        }
        let mut broken = values;
        broken[5] = f64::NAN;
        assert_eq!(worst(&reference.errors(&broken)), f64::INFINITY);
    });
}

/// The reference agrees with certified digits, which come another way.
#[test]
fn references_agree_with_certified_digits() {
    with_problem(|problem| {
        let times = [0.0, 0.5, 2.0 / 3.0, 5.25, 11.999];
        let reference = Reference::new(problem, &times).unwrap();
        let certified = wavestep::answer::Way::new(Kind::Certified, problem, None).unwrap();
        for (time, error) in times.iter().zip(reference.errors(&certified.values(&times).unwrap()))
        {
            assert!(error <= f64::EPSILON / 2.0, "{time}: {error:e}");
        }
    });
}

/// Every proven bound holds where it is measured, and the harness sees the formula as printed fail.
#[test]
fn proven_bounds_hold_where_they_are_measured() {
    with_problem(|problem| {
        let times = Sampling { points: 300, seed: 4 }.times(0.0, 12.0);
        let reference = Reference::new(problem, &times).unwrap();
        let settings = Settings { runs: 1, time: std::time::Duration::ZERO };
        let scale = reference.scale();
        let kinds = [
            (Kind::Certified, None),
            (Kind::Compiled, None),
            (Kind::Compiled, Some(1e-6 * scale)),
            (Kind::Marched { proven: true }, None),
        ];
        for step in kinds {
            let measured = measure(problem, step, &reference, settings).unwrap();
            let bound = measured.bound.unwrap();
            assert!(measured.error <= bound, "{step:?}: {:e} > {bound:e}", measured.error);
            assert!(measured.seconds > 0.0 && measured.preparation >= 0.0);
        }
        assert!(worst(&errors(problem, Kind::Expanded, &reference).unwrap()) > 1e-13);
    });
}
