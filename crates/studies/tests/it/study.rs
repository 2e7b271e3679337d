//! The harness of the charts, measured itself: a known error in is a known error out.

use wavestep::answer::{Method, Question};
use wavestep::problem::Problem;
use wavestep::signal::StablePrecision;
use wavestep_draw::Caption;
use wavestep_studies::study::{
    Loss, Reference, Sampling, Settings, Subject, errors, errors_by_order, first_losses, measure,
    near_zeros, simple_roots, worst,
};

/// Calls `work` with the wave f of the rigid mass, μ = 1/3, and the question until 12.
fn with_question(work: impl FnOnce(Subject<'_>, &Question<'_>)) {
    let problem = Problem::builtin("rigid-mass").unwrap().with("mu", "1/3").unwrap();
    let subject = Subject { problem: &problem, quantity: "f" };
    work(subject, &subject.between(0.0, 12.0).unwrap());
}

/// The reference's own values are off by half a unit in the last place at most, and an error that is
/// put in comes out, on each value alone.
#[test]
fn known_errors_are_measured() {
    with_question(|_, question| {
        let times = Sampling { points: 100, seed: 3 }.times(0.0, 12.0);
        let reference = Reference::new(question, &times).unwrap();
        assert!(reference.radius() < 1e-29, "{:e}", reference.radius());
        let certified = wavestep::answer::Way::new(Method::Certified, question, None).unwrap();
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
    with_question(|_, question| {
        let times = [0.0, 0.5, 2.0 / 3.0, 5.25, 11.999];
        let reference = Reference::new(question, &times).unwrap();
        let certified = wavestep::answer::Way::new(Method::Certified, question, None).unwrap();
        for (time, error) in times.iter().zip(reference.errors(&certified.values(&times).unwrap()))
        {
            assert!(error <= f64::EPSILON / 2.0, "{time}: {error:e}");
        }
    });
}

/// Every proven bound holds where it is measured, and the harness sees the formula as printed fail.
#[test]
fn proven_bounds_hold_where_they_are_measured() {
    with_question(|subject, question| {
        let times = Sampling { points: 300, seed: 4 }.times(0.0, 12.0);
        let reference = Reference::new(question, &times).unwrap();
        let settings = Settings { runs: 1, time: std::time::Duration::ZERO };
        let scale = reference.scale();
        let kinds = [
            (Method::Certified, None),
            (Method::Compiled, None),
            (Method::Compiled, Some(1e-6 * scale)),
            (Method::Marched { proven: true }, None),
        ];
        for step in kinds {
            let measured =
                measure((subject, question.signal.window()), step, &reference, settings).unwrap();
            let bound = measured.bound.unwrap();
            assert!(measured.error <= bound, "{step:?}: {:e} > {bound:e}", measured.error);
            assert!(measured.seconds > 0.0 && measured.preparation >= 0.0);
        }
        assert!(worst(&errors(question, Method::Expanded, &reference).unwrap()) > 1e-13);
    });
}

/// Orders of loss are those that are found when every order is measured.
#[test]
fn orders_of_loss_are_the_first_ones() {
    let problem = Problem::builtin("rigid-mass").unwrap().with("mu", "1").unwrap();
    let subject = Subject { problem: &problem, quantity: "f" };
    let all: Vec<usize> = (1..=60).collect();
    let few = [1, 5, 10, 15, 20, 30, 40, 60];
    let method = Method::Expanded;
    let row = |orders: &[usize]| errors_by_order(subject, 2.0, orders, &[method]).swap_remove(0);
    let every = row(&all).errors;
    let loss = first_losses(subject, method, (1.0, 2.0), (&few, &row(&few).errors));
    let first = |level: f64| every.iter().position(|error| error.unwrap() >= level).map(|i| all[i]);
    assert_eq!(loss, Loss { parameter: 1.0, half: first(1e-8), all: first(1.0) });
    // Naive Horner in s, μ and E, measured by other means, loses them at 24 and 46.
    let near = |order: Option<usize>, known: usize| order.is_some_and(|n| n.abs_diff(known) <= 3);
    assert!(near(loss.half, 24) && near(loss.all, 46), "{loss:?}");
}

/// A way that refuses late periods is asked for the earlier ones, and says why.
#[test]
fn refused_periods_leave_the_others() {
    let text = "recurrence \"two poles\"\nperiod 2, local s, time t\nwave h, f\n\
        equation h[n]' + h[n] = h[n-1]' - h[n-1]\nequation f[n]' + 2*f[n] = h[n]\n\
        continuous h[n] - h[n-1] starts at 1\ncontinuous f[n] starts at 0\n";
    let problem = Problem::of_text("two poles", text, &Default::default()).unwrap();
    let subject = Subject { problem: &problem, quantity: "f" };
    // With two poles `expanded` sums 300 echoes at most, and `stable` none.
    let methods = [Method::Stable(StablePrecision::Double), Method::Expanded];
    let [stable, expanded] = &errors_by_order(subject, 2.0, &[1, 5, 310], &methods)[..] else {
        panic!("two rows")
    };
    assert_eq!(stable.errors, [None; 3]);
    assert!(stable.refusal.is_some());
    let [Some(first), Some(second), None] = expanded.errors[..] else { panic!("{expanded:?}") };
    assert!(first.max(second) < 1e-12, "{expanded:?}");
    assert!(expanded.refusal.is_some(), "{expanded:?}");
}

/// What is proven of `compiled` in parts of the largest value holds next to zeros, where its relative
/// error grows by a power of ten with each power of ten of the distance.
#[test]
fn relative_errors_grow_towards_zeros() {
    with_question(|_, question| {
        let roots = simple_roots(question, 100);
        assert!(roots.len() > 3 && roots.is_sorted(), "{roots:?}");
        let certified = wavestep::answer::Way::new(Method::Certified, question, None).unwrap();
        // Certified values change sign across each root.
        for root in &roots {
            let signs = certified.values(&[root - 1e-12, root + 1e-12]).unwrap();
            assert!(signs[0] * signs[1] < 0.0, "{root}: {signs:?}");
        }
        let chart = near_zeros(question, 100, Caption::default()).unwrap();
        let errors = |name: &str| -> Vec<f64> {
            let curve = chart.curves().iter().find(|curve| curve.name == name).unwrap();
            assert_eq!(curve.points.len(), 12);
            curve.points.iter().map(|(_, error)| *error).collect()
        };
        assert!(errors("double-double").iter().all(|error| *error < 1e-15));
        for pair in errors("compiled").windows(4) {
            assert!((20.0..5e4).contains(&(pair[3] / pair[0])), "{pair:?}");
        }
    });
}
