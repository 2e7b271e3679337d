//! What the charts of accuracy and speed show of the rigid mass.

use std::cell::Cell;
use std::time::Duration;
use wavestep::answer::{Method, Question};
use wavestep::problem::Problem;
use wavestep_draw::{Axis, Caption, Curves};
use wavestep_studies::study::{
    Loss, Measured, Outcome, Reference, Sampling, Settings, Subject, at_arrivals, cost_over_order,
    derivation_cost, errors_by_order, ladder, losses, near_confluence, near_jump, order_map,
    over_courant, over_order, over_time, steps, work_precision,
};

const ONCE: Settings = Settings { runs: 1, time: Duration::ZERO };

/// Calls `work` with a quantity of a built-in scene, μ = 1, and the question until a time.
fn with_subject(
    scene: &str,
    quantity: &str,
    to: f64,
    work: impl FnOnce(Subject<'_>, &Question<'_>),
) {
    let problem = Problem::builtin(scene).unwrap().with("mu", "1").unwrap();
    let subject = Subject { problem: &problem, quantity };
    work(subject, &subject.between(0.0, to).unwrap());
}

/// The wave f of the rigid mass.
fn with_wave(to: f64, work: impl FnOnce(Subject<'_>, &Question<'_>)) {
    with_subject("rigid-mass", "f", to, work);
}

/// The same as a scene, which models take: the strain under the mass.
fn with_scene(to: f64, work: impl FnOnce(&Question<'_>)) {
    with_subject("mass-on-fixed-bar", "strain_impact", to, |_, question| work(question));
}

fn reference(question: &Question<'_>, to: f64) -> Reference {
    Reference::new(question, &Sampling { points: 40, seed: 1 }.times(0.0, to)).unwrap()
}

/// The last error of the curve called `name`.
fn last(chart: &Curves, name: &str) -> f64 {
    chart.curves().iter().find(|curve| curve.name == name).unwrap().points.last().unwrap().1
}

/// The formula as printed loses what sums in pairs keep.
#[test]
fn expanded_formulas_lose_digits_with_time_and_order() {
    with_wave(60.0, |_, question| {
        let (reference, axis) = (reference(question, 60.0), Axis::linear("time t"));
        let chart = over_time(&reference, question, axis, 10, Caption::default()).unwrap();
        assert!(last(&chart, "expanded") > 1e-8 && last(&chart, "stable") < 1e-13);
    });
    with_wave(8.0, |subject, _| {
        let chart = over_order(subject, 2.0, &[5, 40], Caption::default()).unwrap();
        assert!(last(&chart, "expanded") > 1e-3 && last(&chart, "double-double") < 1e-15);
        let methods = [Method::Expanded, Method::Compiled, Method::Rigid];
        let rows = errors_by_order(subject, 2.0, &[1, 30], &methods);
        let [expanded, compiled, rigid] = &rows[..] else { panic!("a row for each") };
        assert!(expanded.errors[0].unwrap() < 1e-14 && expanded.errors[1].unwrap() > 1e-8);
        assert!(compiled.errors.iter().all(|error| error.unwrap() < 1e-15));
        // A model has no values without a scene.
        assert_eq!(rigid.errors, [None, None]);
        assert!(rigid.refusal.as_ref().unwrap().to_string().contains("scenes of bars"));
    });
    // At a distance of 1/10 and 1/100 the formula loses digits, the polynomials do not.
    let chart = near_confluence(2, Caption::default()).unwrap();
    let [expanded, compiled] = chart.curves() else { panic!("two methods") };
    assert_eq!(expanded.points.len(), 3);
    assert!(expanded.points[2].1 > 1e3 * compiled.points[2].1);
}

#[test]
fn arrivals_are_all_there() {
    with_wave(9.0, |_, question| {
        let chart = at_arrivals(question, 100, Caption::default()).unwrap();
        let compiled = chart.curves().iter().find(|curve| curve.name == "compiled").unwrap();
        assert!(compiled.points.iter().map(|(n, _)| *n).eq([1.0, 2.0, 3.0, 4.0]));
        assert!(compiled.points.iter().all(|(_, error)| *error < 1e-15));
    });
}

#[test]
fn models_miss_jumps_and_keep_to_the_courant_number() {
    with_scene(9.0, |question| {
        // Thirty modes miss part of the jump that three thousand follow at a distance.
        let chart = near_jump(question, "", Caption::default()).unwrap();
        let [few, _, many] = chart.curves() else { panic!("three sums") };
        assert!(few.points.first().unwrap().1 > many.points.last().unwrap().1);
    });
    with_scene(8.0, |question| {
        let reference = reference(question, 8.0);
        let chart = over_courant(question, (&reference, 50), Caption::default()).unwrap();
        let mean = &chart.curves()[0];
        assert_eq!(mean.name, "50 cells, mean");
        // Best where a step of time takes a wave through one cell: at Courant's number 1.
        let (last, others) = mean.points.split_last().unwrap();
        assert!(last.0 == 1.0 && others.iter().all(|(_, error)| *error > last.1));
    });
}

#[test]
fn the_ladder_keeps_its_bounds() {
    // Tolerances of one way descend, so that its line goes from coarse to fine.
    let compiled = steps().filter(|(method, _)| *method == Method::Compiled);
    let tolerances: Vec<f64> = compiled.filter_map(|(_, tolerance)| tolerance).collect();
    assert!(tolerances.is_sorted_by(|a, b| a > b) && tolerances.len() > 5);
    with_wave(8.0, |subject, question| {
        let reference = reference(question, 8.0);
        let ticks = Cell::new(0);
        let outcomes =
            ladder((subject, question), &reference, (ONCE, true), |_| ticks.set(ticks.get() + 1));
        assert_eq!(ticks.get(), outcomes.len());
        // Models refuse a recurrence; every bound of the others is kept.
        assert!(outcomes[0].result.is_err());
        let mut measured = outcomes.iter().filter_map(|outcome| outcome.result.as_ref().ok());
        assert!(measured.all(|way| way.bound.is_none_or(|bound| way.error <= bound)));
        let measured = |method, seconds| Outcome {
            step: (method, None),
            result: Ok(Measured { method, error: 1e-16, bound: None, preparation: 0.0, seconds }),
        };
        let outcomes = [measured(Method::Compiled, 1e-9), measured(Method::Certified, 1e-6)];
        let (chart, table) =
            work_precision("Values", &outcomes, &reference, Caption::default()).unwrap();
        assert_eq!(chart.methods()[0].name, "compiled");
        // Nothing was prepared.
        assert_eq!(chart.methods()[0].points[0].prepared, Some(1e-9));
        // A thousand times as fast as certified values.
        assert!((table.rows[0].speed_up.unwrap() - 1000.0).abs() < 1e-9);
    });
}

#[test]
fn costs_are_told_for_every_order() {
    let problem = Problem::builtin("rigid-mass").unwrap();
    let recurrence = problem.recurrence().unwrap();
    let f = recurrence.observation("f").unwrap();
    let cost = derivation_cost(recurrence, &f, &[2, 20], ONCE).unwrap();
    let [(2.0, few), (20.0, many)] = cost[..] else { panic!("two orders") };
    assert!(few > 0.0 && many > 0.0);
    with_wave(8.0, |subject, _| {
        let [_, preparation] =
            cost_over_order(subject, None, 2.0, &[1, 4], ONCE, Caption::default()).unwrap();
        let curve = |name: &str| preparation.curves().iter().find(|curve| curve.name == name);
        assert!(curve("compiled, period n").is_some());
        assert_eq!(curve("derivation of 0 to n, numbers set").unwrap().points.len(), 2);
    });
}

#[test]
fn maps_and_losses_are_drawn_from_their_rows() {
    let rows = [(0.25, vec![Some(1e-16), Some(1e-9)]), (1.0, vec![Some(1e-14), None])];
    let map = order_map(Method::Expanded, "mu", &[10, 40], &rows, Caption::default()).unwrap();
    // Columns are orders, rows values of the parameter.
    assert_eq!((map.cell(1, 0), map.cell(1, 1)), (Some(1e-9), None));
    let rows = [
        Loss { parameter: 0.01, half: None, all: None },
        Loss { parameter: 1.0, half: Some(24), all: Some(46) },
    ];
    let (chart, listing) = losses(Method::Expanded, "mu", 200, &rows, Caption::default()).unwrap();
    assert_eq!(chart.curves()[1].points, [(1.0, 46.0)]);
    assert_eq!(listing.rows, [["0.01", "> 200", "> 200"], ["1", "24", "46"]]);
}
