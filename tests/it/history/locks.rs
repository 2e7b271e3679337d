//! Locks of histories: written, read, compared, and checked by the command.

use crate::history::{network_of, rational, shipped};
use std::fs;
use std::path::{Path, PathBuf};
use wavestep::ball::Decimal;
use wavestep::language::{Source, parse_number};
use wavestep::lock::{Extent, Lock, LockError, Request};
use wavestep::network::Network;

fn request(digits: usize, times: &[(i64, i64)], set: &[(&str, &str)]) -> Request {
    let set = set.iter().map(|(name, value)| ((*name).to_owned(), parse_number(value).unwrap()));
    let times = times.iter().map(|(above, below)| rational(*above, *below)).collect();
    Request { digits, times, set: set.collect() }
}

fn locked(network: &Network, request: &Request) -> Lock {
    Lock::of_events(network, None, request).unwrap_or_else(|error| panic!("{error}"))
}

fn read(text: &str) -> Result<Lock, String> {
    Lock::read(&Source::new("own.lock", text).unwrap()).map_err(|error| error.to_string())
}

fn report(old: &Lock, now: &Lock) -> String {
    old.differences(now).iter().map(ToString::to_string).collect()
}

fn saint_venant() -> Lock {
    let request = request(20, &[(1, 2), (5, 1)], &[("mu", "1")]);
    locked(&shipped("saint-venant", &[("mu", "1")]), &request)
}

fn fixture() -> PathBuf {
    Path::new(crate::ROOT).join("tests/locks/version-2.lock")
}

#[test]
fn histories_are_read_as_they_were_written() {
    let bars = shipped("bars-of-equal-length", &[]);
    let request_of_few = request(12, &[(1, 3), (5, 2)], &[]);
    let followed = Lock::of_events(&bars, Some(rational(3, 2)), &request_of_few).unwrap();
    for lock in [
        saint_venant(),
        locked(&bars, &request(20, &[(0, 1), (5, 2)], &[])),
        followed.clone(),
        locked(&shipped("hopkinson-with-release", &[]), &request(9, &[(1, 10_000)], &[])),
    ] {
        let text = lock.to_text();
        let read = read(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(read, lock, "{text}");
        assert_eq!(read.to_text(), text);
        assert!(read.differences(&lock).is_empty());
    }
    let text = followed.to_text();
    assert!(
        text.contains("until 3/2\n") && text.contains("ending = followed until 3/2\n"),
        "{text}"
    );
    // Rational numbers are fractions: the right bar has the velocity 1/2 while they touch.
    assert!(text.contains("event 1 velocity of second after = 1/2\n"), "{text}");
    assert!(text.contains("contact 1 duration 1 = still closed\n"), "{text}");
}

/// Files of version 2 are never changed; they are read, and hold, for ever.
#[test]
fn old_files_of_histories_are_read() {
    let text = fs::read_to_string(fixture()).unwrap();
    let source = Source::new("version-2.lock", &text[..]).unwrap();
    let old = Lock::read(&source).unwrap();
    assert_eq!(old.extent(), Extent::Events { until: None });
    assert_eq!(old.counts(), (4, 10));
    assert_eq!(report(&old, &saint_venant()), "");
}

/// e^(−1/2) and 3 + e^(−2)/2 stand there as correctly rounded decimals; numbers with fewer
/// digits are those with more, rounded.
#[test]
fn locked_numbers_are_correctly_rounded() {
    let network = shipped("saint-venant", &[("mu", "1")]);
    let [few, many] =
        [12, 30].map(|digits| locked(&network, &request(digits, &[(1, 2), (5, 1)], &[])).to_text());
    assert!(many.contains("event 2 time = 3.06766764161830634594699974749\n"), "{many}");
    assert!(many.contains("value velocity(1/2) = 0.606530659712633423603799534991\n"), "{many}");
    let body = |text: &str| {
        let lines = text.split("\n\n").skip(1).collect::<Vec<_>>().join("\n");
        let facts = lines.lines().filter_map(|line| line.split_once(" = "));
        facts.map(|(name, value)| (name.to_owned(), value.to_owned())).collect::<Vec<_>>()
    };
    let mut compared = 0;
    for ((name, few), (other, many)) in body(&few).iter().zip(&body(&many)) {
        assert_eq!(name, other);
        match many.contains('.') {
            true => {
                let rounded = Decimal::from_rational(&parse_number(many).unwrap(), 12).0;
                assert_eq!(parse_number(few).unwrap(), rounded.to_rational(), "{name}");
                compared += 1;
            }
            false => assert_eq!(few, many, "{name}"),
        }
    }
    assert!(compared > 20, "only {compared} decimals were compared");
}

/// Another digit in any fact is a difference or an error, never passed over.
#[test]
fn no_changed_digit_is_passed_over() {
    let bars = shipped("bars-of-equal-length", &[]);
    for now in [saint_venant(), locked(&bars, &request(20, &[(5, 2)], &[]))] {
        let text = now.to_text();
        let start = text.find("event 1").unwrap();
        let digits = (start..text.len()).filter(|at| text.as_bytes()[*at].is_ascii_digit());
        let mut refused = 0;
        for at in digits {
            let mut bytes = text.clone().into_bytes();
            bytes[at] = b'0' + (bytes[at] - b'0' + 1) % 10;
            match read(&String::from_utf8(bytes).unwrap()) {
                Ok(changed) => assert!(!changed.differences(&now).is_empty(), "at {at}"),
                Err(_) => refused += 1,
            }
        }
        // Numbers of events that are there already, or make one more of them.
        assert!(refused > 0);
    }
}

#[test]
fn what_differs_is_named_with_its_place() {
    let now = saint_venant();
    let text = now.to_text();
    let changed = |old: &str, new: &str| {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        read(&text.replace(old, new))
    };
    for (old, new, expected) in [
        (
            "event 2 kind = opening",
            "event 2 kind = release",
            "event 2 differs\n  kind: locked release, now opening\n",
        ),
        (
            "event 2 time = 3.0676676416183063459",
            "event 2 time = 3.0676676416183063458",
            "event 2 differs\n  time: locked 3.0676676416183063458, now 3.0676676416183063459\n",
        ),
        (
            "event 3 between = hammer | rod",
            "event 3 between = rod | hammer",
            "event 3 differs\n  between: locked rod | hammer, now hammer | rod\n",
        ),
        ("event 1 force after = 1\n", "", "event 1 differs\n  force after: not locked, now 1\n"),
        (
            "event 1 force after = 1\n",
            "event 1 force after = 1\nevent 1 force later = 7\n",
            "event 1 differs\n  force later: locked 7, not there now\n",
        ),
        (
            "ending = parted",
            "ending = followed until 100",
            "ending differs\n  locked followed until 100\n  now    parted\n",
        ),
        (
            "contact 1 duration 1 = 3.0676676416183063459",
            "contact 1 duration 1 = still closed",
            "contact 1 differs\n  duration 1: locked still closed, now 3.0676676416183063459\n",
        ),
        (
            "value velocity(1/2) = 0.60653065971263342360",
            "value velocity(1/2) = 0.60653065971263342361",
            "velocity(1/2) differs\n  locked 0.60653065971263342361\n  now    0.60653065971263342360\n",
        ),
        (
            "stated line = free - hammer | rod - fixed",
            "stated line = free - hammer | rod - free",
            "line differs\n  locked free - hammer | rod - free\n  now    free - hammer | rod - fixed\n",
        ),
    ] {
        let changed = changed(old, new).unwrap_or_else(|error| panic!("{old}: {error}"));
        assert_eq!(report(&changed, &now), expected);
    }
    // An event that is cut out is noticed by the count, and named where the count was changed as well.
    let third = text.find("event 3").unwrap()..text.find("event 4").unwrap();
    let mut cut = text.clone();
    cut.replace_range(third, "");
    assert!(read(&cut).unwrap_err().contains("something is missing, or was added"));
    let cut = read(&cut.replace("4 events", "3 events")).unwrap();
    assert_eq!(report(&cut, &now), "event 3 is derived now, and is not locked\n");
    assert_eq!(report(&now, &cut), "event 3 is locked, and is not derived now\n");
}

#[test]
fn damaged_files_are_refused() {
    let text = saint_venant().to_text();
    for (old, new, expected) in [
        ("lock 2", "lock 3", "versions up to 2 are supported"),
        ("lock 2", "lock 1", "expected `[`"),
        ("digits 20", "digits 0", "numbers have 1 to"),
        ("digits 20", "through 3", "remove it, or lock again"),
        ("ending = parted", "ending parted", "write it as `ending = parted`"),
        ("ending = parted", "ending = parted\nending = parted", "stands there twice"),
        ("digits ", "digits 9\ndigits ", "stands there twice"),
        ("holds ", "holds nothing\nholds ", "stands there twice"),
        ("ending = parted", "", "does not say how the events end"),
        ("event 2 kind = opening", "event 2 kind = leap", "this line cannot be read"),
        ("event 2 kind = opening", "event two kind = opening", "write a whole number"),
        ("event 2 kind = opening", "event 2 = opening", "write it as `event 1 time = 0`"),
        ("event 1 time = 0", "event 1 time = soon", "this line cannot be read"),
        ("event 1 time = 0", "event 1 time = 0\nevent 1 time = 0", "stands there twice"),
        ("value velocity(1/2)", "value velocity(-1/2)", "write a time from 0 on"),
    ] {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        let source = Source::new("own.lock", text.replace(old, new)).unwrap();
        let error = Lock::read(&source).unwrap_err().to_string();
        assert!(error.contains(expected), "{old} -> {new}: {error}");
    }
    let error = read(&text[..text.find("holds").unwrap()]).unwrap_err();
    assert!(error.contains("the file is cut off"), "{error}");
    assert!(read(&text.replace('\n', "\r\n")).is_ok());
    // Cut anywhere, it is no lock, or one that differs.
    let now = saint_venant();
    for end in (0..text.len()).step_by(7) {
        if let Ok(cut) = read(&text[..end]) {
            assert!(!cut.differences(&now).is_empty(), "{end}");
        }
    }
}

/// What is not decided to be zero is told with the bound of its digits; digits that are not proven are not
/// told.
#[test]
fn numbers_without_digits_are_refused_or_bounded() {
    let text = "scene \"A\"\nmass hammer { mass = 1, velocity = 1 }\nbar rod { impedance = 1, travel = 1 }\n\
                line free - hammer | rod - endless\ncontacts open\n\
                observe zero = force(rod.left) - velocity(rod.left)\n";
    let text = text.replace(", travel = 1", "");
    let lock = locked(&network_of(&text, &[]), &request(15, &[(1, 2)], &[]));
    let told = lock.to_text();
    assert!(told.ends_with("value zero(1/2) = 0 ± 1e-15\n"), "{told}");
    for digits in [0, 1_000_000] {
        let refused = Lock::of_events(&network_of(&text, &[]), None, &request(digits, &[], &[]));
        assert_eq!(refused, Err(LockError::Digits(digits)));
    }
}
