//! `docs/saint-venant.md` is what the history says.

use crate::history::{ball, rational, shipped};
use std::fs;
use wavestep::history::History;
use wavestep::signal::{ClosedSignal, Goal, Place, Search};
use wavestep_polynomial::Rational;

const DIGITS: usize = 12;

/// One line of the table: the ratio of the masses, release, velocity then, largest strain and its period,
/// and until when the mass touches the bar altogether, with the velocity at the end.
fn line(ratio: i64) -> String {
    let mu = format!("1/{ratio}");
    let network = shipped("saint-venant", &[("mu", &mu)]);
    let history = History::of(&network, None, DIGITS).unwrap();
    let release = &history.events[1];
    // What the fixed end feels of the closed contact, and a little more.
    let instant = ball(&release.time).rounded().unwrap();
    let end = rational((instant * 1e3) as i64 + 1_002, 1_000);
    let strain = network.observables().iter().find(|own| own.name == "strain_fixed").unwrap();
    let signal = ClosedSignal::of_scene(&network, strain, [&Rational::default(), &end]).unwrap();
    let search = Search::new(&signal).unwrap();
    let largest = search.extremum(Goal::Smallest, DIGITS, 1 << 12).unwrap();
    let [Place::Arrival { time, .. }] = &largest.places[..] else { panic!("{:?}", largest.places) };
    let arrival = ball_of(time);
    let period = ((arrival - 1.0) / 2.0).round();
    let last = history.events.last().unwrap();
    let times = (history.events.len() - 2) / 2;
    format!(
        "| {ratio} | {} | {} | {} | {period} | {times} | {} | {} |",
        release.time.to_text(DIGITS),
        release.velocities[1][0].to_text(DIGITS),
        largest.value.to_text(DIGITS).trim_start_matches('-'),
        last.time.to_text(DIGITS),
        last.velocities[1][0].to_text(DIGITS),
    )
}

fn ball_of(time: &wavestep::signal::Value) -> f64 {
    ball(time).rounded().unwrap()
}

#[test]
fn the_page_on_saint_venant_is_true() {
    let page = fs::read_to_string(format!("{}/docs/saint-venant.md", crate::ROOT)).unwrap();
    let lines: Vec<String> = [1, 2, 4, 6, 10, 100].map(line).into();
    for line in &lines {
        assert!(page.contains(line), "the table is\n{}", lines.join("\n"));
    }
}
