//! Trials of random scenes and recurrences; a long run is `cargo run --release -p wavestep-trials -- --hours 1`.

use wavestep_trials::{EVENTS, KINDS, Tally, Trial, Verdict, random_scene};

/// Trials of all kinds in all ways.
#[test]
fn random_texts_agree_in_all_ways() {
    let mut tally = Tally::default();
    let mut agree = [0; KINDS.len()];
    for number in 1..=90 {
        let trial = Trial::new(number);
        let (kind, text) = (trial.kind, trial.text.clone());
        match trial.run() {
            Verdict::Senseless(_) => {}
            Verdict::Agrees(own) => {
                agree[kind] += 1;
                tally.add(&own);
            }
            Verdict::Wrong(wrong) => panic!("trial {number}: {wrong}\n{text}"),
        }
    }
    assert!(agree[..5].iter().all(|count| *count > 0), "{agree:?}");
    assert!(tally.compared.iter().take(EVENTS).all(|count| *count > 0), "{tally:?}");
}

/// Scenes whose contacts open, followed longer.
#[test]
fn random_scenes_agree_with_plain_doubles() {
    let (mut agree, mut events) = (0, 0);
    for number in 1.. {
        match random_scene(number, 8) {
            (_, Verdict::Senseless(_)) => continue,
            (_, Verdict::Agrees(tally)) => events += tally.compared[EVENTS],
            (text, Verdict::Wrong(wrong)) => panic!("scene {number}: {wrong}\n{text}"),
        }
        agree += 1;
        if agree == 16 {
            break;
        }
    }
    assert!(events > 32, "{events} events");
}
