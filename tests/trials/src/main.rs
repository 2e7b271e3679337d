//! `wavestep-trials [--hours H] [--scenes N] [--first NUMBER]`: trials one after another, and what became of them.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook};
use std::process::ExitCode;
use std::time::{Duration, Instant};
use wavestep_trials::{CHECKS, KINDS, Tally, Trial, Verdict};

/// Trials that take longer are told, in seconds.
const LONG: f64 = 20.0;

/// The trials of one kind.
#[derive(Clone, Default)]
struct Row {
    agree: usize,
    wrong: usize,
    senseless: usize,
    seconds: f64,
    slowest: (f64, u64),
    tally: Tally,
}

struct Report {
    rows: Vec<Row>,
    wrong: Vec<String>,
}

impl Report {
    fn count(&self) -> usize {
        self.rows.iter().map(|row| row.agree + row.wrong).sum()
    }

    fn run(&mut self, number: u64) {
        let begun = Instant::now();
        let trial = Trial::new(number);
        let (kind, text) = (trial.kind, trial.text.clone());
        // Where a panic ends the run, it is known which trial it was.
        let told = format!("trial {number}, {}\n{text}", KINDS[kind].0);
        set_hook(Box::new(move |panic| eprintln!("{panic}\n{told}")));
        let verdict = catch_unwind(AssertUnwindSafe(|| trial.run()));
        let seconds = begun.elapsed().as_secs_f64();
        let row = &mut self.rows[kind];
        row.seconds += seconds;
        if seconds > LONG {
            eprintln!("trial {number}, {}: {seconds:.0} s\n{text}", KINDS[kind].0);
        }
        if seconds > row.slowest.0 {
            row.slowest = (seconds, number);
        }
        let wrong = match verdict {
            Ok(Verdict::Senseless(_)) => return row.senseless += 1,
            Ok(Verdict::Agrees(tally)) => {
                row.agree += 1;
                return row.tally.add(&tally);
            }
            Ok(Verdict::Wrong(wrong)) => wrong,
            Err(panic) => {
                let text = panic.downcast_ref::<String>().map(String::as_str);
                let text = text.or(panic.downcast_ref::<&str>().copied());
                format!("panic: {}", text.unwrap_or("not told"))
            }
        };
        row.wrong += 1;
        let wrong = format!("trial {number}, {}: {wrong}\n{text}", KINDS[kind].0);
        eprintln!("{wrong}");
        self.wrong.push(wrong);
    }

    fn print(&self, seconds: f64) {
        println!("{} trials in {seconds:.0} s, {} wrong", self.count(), self.wrong.len());
        println!();
        print!(
            "{:<18}{:>8}{:>6}{:>10}{:>8}{:>8}",
            "kind", "agree", "wrong", "senseless", "ms", "slowest"
        );
        CHECKS.iter().for_each(|check| print!("{check:>10}"));
        println!("{:>8}", "untold");
        for (row, (kind, _)) in self.rows.iter().zip(KINDS) {
            let Row { agree, wrong, senseless, seconds, slowest, tally } = row;
            let each = 1e3 * seconds / (*agree + *wrong).max(1) as f64;
            print!("{kind:<18}{agree:>8}{wrong:>6}{senseless:>10}{each:>8.1}{:>8.1}", slowest.0);
            tally.compared.iter().for_each(|count| print!("{count:>10}"));
            println!("{:>8}", tally.untold);
        }
        let mut refused: BTreeMap<&str, usize> = BTreeMap::new();
        for (error, count) in self.rows.iter().flat_map(|row| &row.tally.refused) {
            *refused.entry(error).or_default() += count;
        }
        println!("\nrefused");
        refused.iter().for_each(|(error, count)| println!("{count:>8}  {error}"));
        for (row, (kind, _)) in self.rows.iter().zip(KINDS) {
            println!("slowest of {kind}: trial {}, {:.1} s", row.slowest.1, row.slowest.0);
        }
        self.wrong.iter().for_each(|wrong| println!("\n{wrong}"));
    }
}

/// The number behind a name among the arguments.
fn argument(name: &str) -> Option<f64> {
    let arguments: Vec<String> = std::env::args().collect();
    let place = arguments.iter().position(|own| own == name)?;
    let number = arguments.get(place + 1).and_then(|text| text.parse().ok());
    Some(number.unwrap_or_else(|| panic!("{name} needs a number")))
}

fn main() -> ExitCode {
    if cfg!(panic = "abort") {
        eprintln!(
            "built with `--release`, a panic ends the run; with `--profile wheel` it is one more failure"
        );
    }
    let begun = Instant::now();
    let hours = argument("--hours");
    let end = hours.map(|hours| begun + Duration::from_secs_f64(3600.0 * hours));
    let most = argument("--scenes").unwrap_or(if end.is_some() { f64::INFINITY } else { 1000.0 });
    let mut report = Report { rows: vec![Row::default(); KINDS.len()], wrong: Vec::new() };
    let mut told = begun;
    for number in argument("--first").unwrap_or(1.0) as u64.. {
        if report.count() as f64 >= most || end.is_some_and(|end| Instant::now() > end) {
            break;
        }
        report.run(number);
        if told.elapsed().as_secs() >= 10 {
            told = Instant::now();
            let seconds = begun.elapsed().as_secs_f64();
            eprintln!(
                "{seconds:.0} s: {} trials through number {number}, {} wrong",
                report.count(),
                report.wrong.len()
            );
        }
    }
    report.print(begun.elapsed().as_secs_f64());
    ExitCode::from(u8::from(!report.wrong.is_empty()))
}
