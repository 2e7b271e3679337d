//! Requests with extreme numbers: each is answered or refused, whatever stands in the scene.
//!
//! A number of a shipped scene or of an accepted text of the grammar, or two of them, are replaced by one that
//! nobody expects there; then something is asked of it. `WAVESTEP_REQUESTS=5000 cargo test --release -p
//! wavestep-cli extremes -- --nocapture` asks that many and says which of them the watch ended;
//! `WAVESTEP_FIRST=2000` beside it begins with that number.

use super::{ROOT, command, folder};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::{Duration, Instant};

/// How many requests are made where nobody says.
const REQUESTS: u64 = 40;

/// How long a request works at most in a long run, and where nobody says; what it may take beyond that to end.
const LIMITS: (&str, &str) = ("14s", "10s");
const PATIENCE: Duration = Duration::from_secs(15);

/// What a request may take, in kB.
const MEMORY: u64 = 1_000_000;

/// Requests of which the watch ends one at most, in a long run and where nobody says.
const ENDED: (u64, u64) = (50, 10);

/// Numbers that nobody expects.
const EXTREMES: [&str; 16] = [
    "0",
    "1e9",
    "1e-9",
    "pi",
    "sqrt(2)",
    "355/113",
    "1e-3",
    "1000",
    "1e5",
    "sqrt(2)/10",
    "1/3",
    "1e12",
    "7",
    "1e300",
    "1e-300",
    "22/7",
];

/// Numbers without an end, one for each request and choice (splitmix64).
struct Chance(u64);

impl Chance {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) % count as u64) as usize
    }

    fn one_of<'a>(&mut self, all: &[&'a str]) -> &'a str {
        all[self.below(all.len())]
    }
}

/// All scenes, and the texts that the grammar accepts.
fn texts() -> Vec<(PathBuf, String)> {
    let folders = ["scenes", "grammar/accepted", "grammar/accepted-scenes"];
    let mut texts: Vec<(PathBuf, String)> = (folders.iter())
        .flat_map(|folder| fs::read_dir(Path::new(ROOT).join(folder)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter_map(|path| Some((path.clone(), fs::read_to_string(path).ok()?)))
        .collect();
    texts.sort();
    texts
}

/// Where the numbers of a text stand that may be replaced: those of bars, elements, loads and equations.
fn numbers(text: &str) -> Vec<(usize, usize)> {
    let kept = ["scene", "recurrence", "#", "observe", "written", "symbol", "index"];
    let mut places = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let is_kept = kept.iter().any(|word| line.trim_start().starts_with(word));
        let mut rest = 0;
        while !is_kept && rest < line.len() {
            let is_digit = |c: char| c.is_ascii_digit();
            let Some(first) = line[rest..].find(is_digit).map(|first| rest + first) else { break };
            let length = line[first..]
                .find(|c: char| !is_digit(c) && c != '.')
                .unwrap_or(line.len() - first);
            let before = line[..first].chars().next_back().unwrap_or(' ');
            let after = line[first + length..].chars().next().unwrap_or(' ');
            if !before.is_alphanumeric()
                && before != '_'
                && before != '.'
                && !after.is_alphanumeric()
            {
                places.push((start + first, start + first + length));
            }
            rest = first + length;
        }
        start += line.len();
    }
    places
}

/// The names that stand first on the lines of a kind.
fn named<'a>(text: &'a str, kind: &str) -> Vec<&'a str> {
    let declared = text.lines().filter_map(|line| line.trim().strip_prefix(kind));
    declared
        .filter_map(|rest| {
            rest.strip_prefix(' ')?.split([' ', '=', ',']).find(|name| !name.is_empty())
        })
        .collect()
}

/// What is asked of a text, in words of the command.
fn request(chance: &mut Chance, text: &str) -> Vec<String> {
    let units = ["GPa", "kg", "m/s", "kN"].iter().any(|unit| text.contains(unit));
    let time =
        chance.one_of(&["1/2", "3", "7/3", "10"]).to_owned() + if units { " ms" } else { "" };
    let mut quantities = named(text, "observe");
    quantities.extend(named(text, "wave"));
    let quantity = if quantities.is_empty() { "f" } else { chance.one_of(&quantities) };
    let method = chance.one_of(&[
        "certified",
        "compiled",
        "marched",
        "stable",
        "leapfrog",
        "modes:10",
        "steps",
    ]);
    let (observed, at, to) = (["--quantity", quantity], ["--at", &time], ["--to", &time]);
    let (eval, find) =
        ([["eval", "X"], observed, at].concat(), ["find", "X", "--from", "0", "--to", &time]);
    let words: Vec<&str> = match chance.below(13) {
        0 => vec!["derive", "X"],
        1 => vec!["check", "X"],
        2 => eval,
        3 => [&eval[..], &["--digits", "30"]].concat(),
        4 => [&eval[..], &["--tol", "1e-6"]].concat(),
        5 => [&eval[..], &["--method", method]].concat(),
        6 => [&find[..], &["--zero", quantity]].concat(),
        7 => [&find[..], &["--max", quantity]].concat(),
        8 => [["plot", "X"], observed, to, ["-o", "plot.svg"]].concat(),
        9 => vec!["events", "X", "--to", &time],
        10 => vec!["field", "X", "--at", &time, "--mesh", "8"],
        11 => [["export", "X"], observed, to, ["--as", "c"]].concat(),
        _ => [["lock", "X"], at, ["-o", "X.lock"]].concat(),
    };
    let mut words: Vec<String> = words.into_iter().map(str::to_owned).collect();
    for symbol in named(text, "symbol") {
        words.extend([
            "--set".to_owned(),
            format!("{symbol}={}", chance.one_of(&["1", "1/4", "2", "3"])),
        ]);
    }
    words
}

/// The text that a request is made of: the one whose name and whose number give the largest hash, so that another
/// text beside them changes few requests.
fn drawn(texts: &[(PathBuf, String)], number: u64) -> &(PathBuf, String) {
    let hash = |path: &Path| {
        let name = path.file_name().unwrap().as_encoded_bytes();
        let bytes =
            name.iter().chain(&number.to_le_bytes()).fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
                (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3)
            });
        Chance(bytes).below(1 << 32)
    };
    texts.iter().max_by_key(|(path, _)| hash(path)).unwrap()
}

/// What became of a request.
struct Told {
    code: Option<i32>,
    errors: String,
    taken: Duration,
    /// The most memory that was seen, in kB, where the system tells.
    memory: u64,
}

impl Told {
    /// Answered, or refused by name.
    fn is_well(&self) -> bool {
        let is_told = self.errors.contains("error:") && !self.errors.contains("panicked");
        let is_ended = matches!(self.code, Some(0)) && !self.errors.contains("error:")
            || matches!(self.code, Some(1..=3)) && is_told;
        is_ended && self.memory <= MEMORY
    }

    /// The watch ended it.
    fn was_ended(&self) -> bool {
        self.errors.contains("error: no answer within")
            || self.errors.contains("error: the answer takes")
    }
}

/// Asks.
fn asked(folder: &Path, words: &[&str]) -> Told {
    let mut command = command(folder, words);
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    let begun = Instant::now();
    let mut child = command.spawn().unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut memory = 0;
    while child.try_wait().unwrap().is_none() {
        let told = fs::read_to_string(&status).unwrap_or_default();
        let held =
            told.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB"));
        memory = held.map_or(memory, |held| held.parse().unwrap());
        std::thread::sleep(Duration::from_millis(5));
    }
    let output = child.wait_with_output().unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    Told { code: output.status.code(), errors, taken: begun.elapsed(), memory }
}

#[test]
fn extreme_numbers_are_answered_or_refused() {
    let folder = folder("extremes");
    let texts = texts();
    let given = |name| std::env::var(name).ok().map(|count| count.parse::<u64>().unwrap());
    let (count, is_long) =
        (given("WAVESTEP_REQUESTS").unwrap_or(REQUESTS), given("WAVESTEP_REQUESTS").is_some());
    let (limit, each) = if is_long { (LIMITS.0, ENDED.0) } else { (LIMITS.1, ENDED.1) };
    let first = given("WAVESTEP_FIRST").unwrap_or(0);
    let mut failed = Vec::new();
    let (mut answered, mut ended) = (0, 0);
    for number in first..first + count {
        let mut chance = Chance(number << 32);
        let (path, text) = drawn(&texts, number);
        let mut text = text.clone();
        for _ in 0..1 + chance.below(3) / 2 {
            let places = numbers(&text);
            if !places.is_empty() {
                let (from, to) = places[chance.below(places.len())];
                text.replace_range(from..to, chance.one_of(&EXTREMES));
            }
        }
        let words = request(&mut chance, &text);
        let words: Vec<&str> =
            words.iter().map(|word| if word == "X" { "extreme.wave" } else { word }).collect();
        fs::write(folder.join("extreme.wave"), &text).unwrap();
        let words = [&words[..], &["--memory", "800MB", "--time-limit", limit]].concat();
        let told = asked(&folder, &words);
        answered += u64::from(told.code == Some(0));
        ended += u64::from(told.was_ended());
        let is_late = is_long && told.taken > PATIENCE;
        if told.is_well() && !told.was_ended() && !is_late {
            continue;
        }
        let (seconds, megabytes) = (told.taken.as_secs_f64(), told.memory / 1000);
        let asked = format!(
            "{number}: {} of {}: {:?} after {seconds:.1} s with {megabytes} MB: {}",
            words.join(" "),
            path.display(),
            told.code,
            told.errors
        );
        println!("{asked}");
        fs::copy(folder.join("extreme.wave"), folder.join(format!("{number}.wave"))).unwrap();
        if !told.is_well() || is_late {
            failed.push(asked);
        }
    }
    println!("{count} requests: {answered} answered, {ended} ended by the watch");
    assert!(failed.is_empty(), "{} requests:\n{}", failed.len(), failed.join("\n"));
    assert!(answered > count / 4, "most are refused: {answered}");
    assert!(ended * each <= count, "{ended} of {count} were ended by the watch");
}
