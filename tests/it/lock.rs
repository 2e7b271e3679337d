//! Locks: written, read, compared, and files of old versions.

use crate::snapshot;
use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use wavestep::language::{Source, parse_number, read_recurrence};
use wavestep::limits::MAX_LOCK_BYTES;
use wavestep::lock::{Derivable, Extent, Lock, Request};
use wavestep::scenes::{self, SCENES};
use wavestep::solution::Solution;

/// Through which period pieces are locked, and which values.
type Asked = (usize, Request);

fn solution(text: &str, (_, request): &Asked) -> Solution {
    let source = Source::new("scene", text).expect("a text");
    Solution::new(read_recurrence(&source, &request.set).unwrap_or_else(|error| panic!("{error}")))
}

fn derived(text: &str, asked: &Asked) -> Lock {
    Lock::of_pieces(Derivable::Equations(&solution(text, asked)), Some(asked.0), &asked.1)
        .unwrap_or_else(|error| panic!("{error}"))
}

fn read(name: &str, text: &str) -> Result<Lock, String> {
    let source = Source::with_limit(name, text, MAX_LOCK_BYTES).map_err(|e| e.to_string())?;
    Lock::read(&source).map_err(|error| error.to_string())
}

fn scene(name: &str) -> &'static str {
    scenes::find(name).expect("a scene of the library").text
}

fn request(through: usize, set: &str, times: &[&str]) -> Asked {
    let number = |text: &str| parse_number(text).expect("a number");
    let request = Request {
        set: set
            .split_terminator(',')
            .map(|setting| setting.split_once('=').expect("a setting"))
            .map(|(name, value)| (name.to_owned(), number(value)))
            .collect(),
        times: times.iter().map(|time| number(time)).collect(),
        ..Request::default()
    };
    (through, request)
}

/// What a lock was asked for.
fn asked(lock: &Lock) -> Asked {
    let Extent::Pieces { through: Some(through) } = lock.extent() else { panic!("pieces") };
    (through, lock.request().clone())
}

fn fixture(name: &str) -> PathBuf {
    Path::new(crate::ROOT).join("tests/locks").join(name)
}

/// Recurrences whose pieces hold denominators, several exponentials, and names with subscripts.
const OTHERS: [&str; 3] = [
    "recurrence \"  = spaces # and signs  \"\nperiod 1, local s, time t\nwave f\n\
     equation f[n] = f[n-1] + 1\n",
    "recurrence \"Two poles\"\nsymbol a > 0, b > 0\nnonzero a - b\nperiod 1, local s, time t\n\
     wave u_left, v\nequation u_left[n]' + a*u_left[n] = v[n-1]\n\
     equation v[n]' + b*v[n] = -u_left[n]\ncontinuous u_left[n] starts at 1\n\
     continuous v[n] starts at 0\n",
    "recurrence \"Forced\"\nperiod 1/3, local s, time t\nwave f\n\
     equation f[n]' + 2*f[n] = t*exp(-2*t) - f[n-1]\ncontinuous f[n] starts at 1/7\n",
];

#[test]
fn locks_are_read_as_they_were_written() {
    let numeric = request(3, "mu=1/4", &["0", "1/2", "33/10", "7"]);
    let mut all = vec![(scene("rigid-mass"), numeric.clone()), (scene("pulse-shape"), numeric)];
    all.push((scene("two-bars"), request(3, "r=3", &["0", "5"])));
    let stated = SCENES.iter().filter(|scene| scene.text.contains("\nrecurrence "));
    all.extend(stated.map(|scene| (scene.text, request(6, "", &[]))));
    all.extend(OTHERS.iter().map(|text| (*text, request(3, "", &[]))));
    for (text, request) in all {
        let lock = derived(text, &request);
        let read = read("own.lock", &lock.to_text()).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(read, lock, "{}", lock.to_text());
        assert!(read.differences(&lock).is_empty());
        assert_eq!(read.to_text(), lock.to_text());
        assert!(self::read("windows.lock", &lock.to_text().replace('\n', "\r\n")).is_ok());
    }
}

/// Lines of values that were put in another order hold the same.
#[test]
fn the_order_of_values_does_not_matter() {
    let lock = derived(scene("rigid-mass"), &request(0, "mu=1/4", &["1/2", "33/10"]));
    let text = lock.to_text();
    let (before, values) = text.split_once("value ").expect("values");
    let values: Vec<&str> = values.trim_end().rsplit("\nvalue ").collect();
    let turned = format!("{before}value {}\n", values.join("\nvalue "));
    assert_ne!(turned, text);
    assert_eq!(read("turned.lock", &turned).as_ref(), Ok(&lock));
}

/// Files of version 1 are never changed; they are read, and hold, for ever.
#[test]
fn old_files_are_read() {
    for (name, scene_name, values) in
        [("version-1.lock", "rigid-mass", 10), ("version-1-symbolic.lock", "two-bars", 0)]
    {
        let text = fs::read_to_string(fixture(name)).expect("a file");
        let lock = read(name, &text).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(lock.counts().1, values);
        let differences = lock.differences(&derived(scene(scene_name), &asked(&lock)));
        assert!(differences.is_empty(), "{}", differences[0]);
    }
}

#[test]
fn a_changed_coefficient_is_named() {
    let lock = derived(scene("rigid-mass"), &request(2, "", &[]));
    let changed = scene("rigid-mass").replace("= -(f[n] - g[n])  ", "= -(f[n] - 2*g[n])");
    assert_ne!(changed, scene("rigid-mass"));
    let differences = lock.differences(&derived(&changed, &request(2, "", &[])));
    let report: String = differences.iter().map(ToString::to_string).collect();
    assert!(report.contains("s*exp(-s): locked -2, now -3"), "{report}");
    snapshot("lock", "changed-coefficient", "rigid-mass, `g` doubled", &report);
    // Values as well.
    let numeric = request(0, "mu=1", &["1/2", "5/2"]);
    let lock = derived(scene("rigid-mass"), &numeric);
    let differences = lock.differences(&derived(&changed, &numeric));
    snapshot(
        "lock",
        "changed-values",
        "rigid-mass, `g` doubled",
        &differences.iter().map(ToString::to_string).collect::<String>(),
    );
}

/// Everything that the scene states is locked, not only its waves.
#[test]
fn changed_statements_are_named() {
    let lock = derived(scene("rigid-mass"), &request(0, "", &[]));
    for (old, new, named) in [
        ("period 2*mu", "period 3*mu", "period"),
        ("symbol mu > 0", "symbol mu > 1", "symbol mu"),
        ("-2*f(t - mu)", "-3*f(t - mu)", "observable strain_fixed"),
        ("velocity ", "speed ", "observable velocity"),
        ("Rigid mass on a fixed bar\"", "Rigid mass\"", "title"),
    ] {
        let changed = scene("rigid-mass").replace(old, new);
        let differences = lock.differences(&derived(&changed, &request(0, "", &[])));
        let report: String = differences.iter().map(ToString::to_string).collect();
        assert!(report.contains(named), "{old}: {report}");
    }
}

#[test]
fn what_is_gone_and_what_is_new_is_named() {
    let lock = derived(scene("two-bars"), &request(2, "", &[]));
    let later = derived(scene("two-bars"), &request(3, "", &[]));
    let report = |differences: Vec<wavestep::lock::Difference>| {
        differences.iter().map(ToString::to_string).collect::<String>()
    };
    snapshot("lock", "new-pieces", "two-bars through 2, then 3", &report(lock.differences(&later)));
    snapshot(
        "lock",
        "gone-pieces",
        "two-bars through 3, then 2",
        &report(later.differences(&lock)),
    );
    let other_impedance = scene("two-bars").replace("r*(f[n]", "(r + 1)*(f[n]");
    let changed = derived(&other_impedance, &request(2, "", &[]));
    snapshot(
        "lock",
        "changed-quotients",
        "two-bars, `r` replaced by `r + 1`",
        &report(lock.differences(&changed)),
    );
    let other_time = scene("two-bars").replace("local s", "local x");
    snapshot(
        "lock",
        "changed-variable",
        "two-bars, `s` replaced by `x`",
        &report(lock.differences(&derived(&other_time, &request(0, "", &[])))),
    );
}

#[test]
fn long_differences_are_cut() {
    let lock = derived(scene("rigid-mass"), &request(8, "", &[]));
    let changed = scene("rigid-mass").replace("starts at 1 ", "starts at 2 ");
    let differences = lock.differences(&derived(&changed, &request(8, "", &[])));
    let longest = differences.iter().map(|d| d.to_string().lines().count()).max();
    assert_eq!(longest, Some(12), "a heading, ten terms, and how many more");
    assert!(differences.iter().any(|d| d.to_string().contains("more terms")));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]
    /// Another digit anywhere in a piece or a value is a difference or an error, never passed over.
    #[test]
    fn no_changed_digit_is_passed_over(place in any::<prop::sample::Index>(), digit in 0_u8..10) {
        let text = fs::read_to_string(fixture("version-1.lock")).expect("a file");
        let lock = read("old.lock", &text).expect("a lock");
        let now = derived(scene("rigid-mass"), &asked(&lock));
        let start = text.find("f[0]").expect("pieces");
        let digits: Vec<usize> =
            (start..text.len()).filter(|i| text.as_bytes()[*i].is_ascii_digit()).collect();
        let at = *place.get(&digits);
        let mut bytes = text.clone().into_bytes();
        bytes[at] = b'0' + digit;
        let changed = String::from_utf8(bytes).expect("text");
        if changed == text {
            return Ok(());
        }
        if let Ok(lock) = read("changed.lock", &changed) {
            prop_assert!(!lock.differences(&now).is_empty(), "{}", changed);
        }
    }

    #[test]
    fn damaged_files_never_panic(start in 0_usize..600, length in 0_usize..40, with in "\\PC{0,12}") {
        let text = fs::read_to_string(fixture("version-1.lock")).expect("a file");
        let mut characters: Vec<char> = text.chars().collect();
        let start = start.min(characters.len());
        let end = (start + length).min(characters.len());
        characters.splice(start..end, with.chars());
        let _ = read("damaged.lock", &characters.into_iter().collect::<String>());
    }
}
