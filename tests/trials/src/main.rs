//! `wavestep-trials [--hours H] [--scenes N] [--first NUMBER] [--workers W] [--kind K]`: trials one after another, of all
//! kinds or of the K-th alone, and what became of them.
//! `wavestep-trials --show NUMBER`: the text of one.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread::{self, ScopedJoinHandle};
use std::time::{Duration, Instant};
use wavestep_trials::{CHECKS, KINDS, Tally, Trial, Verdict, without_numbers};

/// Trials that take longer are told, in seconds.
const LONG: f64 = 20.0;

/// The stack of a worker, in bytes.
const STACK: usize = 64 << 20;

/// The trials of one kind.
#[derive(Clone, Default)]
struct Row {
    agree: usize,
    wrong: usize,
    /// Why others are no scenes.
    senseless: BTreeMap<String, usize>,
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

    /// Adds what became of a trial, and how many seconds it took.
    fn add(&mut self, told: &Told, verdict: std::thread::Result<Verdict>, seconds: f64) {
        let row = &mut self.rows[told.kind];
        row.seconds += seconds;
        if seconds > row.slowest.0 {
            row.slowest = (seconds, told.number);
        }
        let wrong = match verdict {
            Ok(Verdict::Senseless(reason)) => {
                return *row.senseless.entry(without_numbers(&reason)).or_default() += 1;
            }
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
        let wrong = format!("{}: {wrong}\n{}", told.title(), told.text);
        eprintln!("{wrong}");
        self.wrong.push(wrong);
    }

    /// Reasons of one sort, and how often each was given.
    fn print_reasons(&self, sort: &str, reasons: fn(&Row) -> &BTreeMap<String, usize>) {
        let mut all: BTreeMap<&str, usize> = BTreeMap::new();
        for (reason, count) in self.rows.iter().flat_map(reasons) {
            *all.entry(reason).or_default() += count;
        }
        println!("\n{sort}");
        all.iter().for_each(|(reason, count)| println!("{count:>8}  {reason}"));
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
            let senseless = senseless.values().sum::<usize>();
            let each = 1e3 * seconds / (*agree + *wrong).max(1) as f64;
            print!("{kind:<18}{agree:>8}{wrong:>6}{senseless:>10}{each:>8.1}{:>8.1}", slowest.0);
            tally.compared.iter().for_each(|count| print!("{count:>10}"));
            println!("{:>8}", tally.untold);
        }
        self.print_reasons("senseless", |row| &row.senseless);
        self.print_reasons("refused", |row| &row.tally.refused);
        println!();
        for (row, (kind, _)) in self.rows.iter().zip(KINDS) {
            println!("slowest of {kind}: trial {}, {:.1} s", row.slowest.1, row.slowest.0);
        }
        self.wrong.iter().for_each(|wrong| println!("\n{wrong}"));
    }
}

/// A trial as it is told to people.
#[derive(Clone, Default)]
struct Told {
    number: u64,
    kind: usize,
    text: String,
}

impl Told {
    fn title(&self) -> String {
        format!("trial {}, {}", self.number, KINDS[self.kind].0)
    }
}

thread_local! {
    /// The trial of a worker: where a panic ends the run, it is known which one it was.
    static CURRENT: RefCell<Told> = RefCell::default();
}

/// What the workers share.
struct Run {
    begun: Instant,
    /// When no trial is begun any more, if ever.
    end: Option<Instant>,
    /// The kind that is compared, where not all are.
    kind: Option<usize>,
    /// No trial is begun once so many scenes were compared.
    most: f64,
    /// The number of the next trial.
    next: AtomicU64,
    /// Which trials are under way, since when.
    running: Mutex<BTreeMap<u64, Instant>>,
    report: Mutex<Report>,
}

impl Run {
    fn is_over(&self) -> bool {
        let count = self.report.lock().expect("no worker panics").count();
        count as f64 >= self.most || self.end.is_some_and(|end| Instant::now() > end)
    }

    /// Runs one trial after another.
    fn work(&self) {
        while !self.is_over() {
            let number = self.next.fetch_add(1, Ordering::Relaxed);
            CURRENT.set(Told { number, ..Told::default() });
            let trial = Trial::new(number);
            if self.kind.is_some_and(|kind| kind != trial.kind) {
                continue;
            }
            let begun = Instant::now();
            self.running.lock().expect("no worker panics").insert(number, begun);
            let told = Told { number, kind: trial.kind, text: trial.text.clone() };
            CURRENT.set(told.clone());
            let verdict = catch_unwind(AssertUnwindSafe(|| trial.run()));
            let seconds = begun.elapsed().as_secs_f64();
            if seconds > LONG {
                eprintln!("{}: {seconds:.0} s\n{}", told.title(), told.text);
            }
            self.running.lock().expect("no worker panics").remove(&number);
            self.report.lock().expect("no worker panics").add(&told, verdict, seconds);
        }
    }

    /// How far it is, and which trials take long.
    fn tell(&self) {
        let report = self.report.lock().expect("no worker panics");
        let [count, wrong] = [report.count(), report.wrong.len()];
        let [seconds, next] = [self.begun.elapsed().as_secs(), self.next.load(Ordering::Relaxed)];
        eprintln!("{seconds} s: {count} trials below number {next}, {wrong} wrong");
        for (number, begun) in self.running.lock().expect("no worker panics").iter() {
            let seconds = begun.elapsed().as_secs_f64();
            if seconds > LONG {
                eprintln!("trial {number} has taken {seconds:.0} s");
            }
        }
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
    if let Some(number) = argument("--show") {
        print!("{}", Trial::new(number as u64).text);
        return ExitCode::SUCCESS;
    }
    if cfg!(panic = "abort") {
        eprintln!(
            "built with `--release`, a panic ends the run; with `--profile wheel` it is one more failure"
        );
    }
    set_hook(Box::new(|panic| {
        let told = CURRENT.with_borrow(Told::clone);
        eprintln!("{panic}\n{}\n{}", told.title(), told.text);
    }));
    let begun = Instant::now();
    let end = argument("--hours").map(|hours| begun + Duration::from_secs_f64(3600.0 * hours));
    let workers = argument("--workers").map_or(1, |count| count.max(1.0) as usize);
    let kind = argument("--kind").map(|place| place as usize);
    assert!(
        kind.is_none_or(|kind| (1..=KINDS.len()).contains(&kind)),
        "--kind is 1 to {}",
        KINDS.len()
    );
    let kind = kind.map(|kind| kind - 1);
    let run = Run {
        begun,
        end,
        kind,
        most: argument("--scenes").unwrap_or(if end.is_some() { f64::INFINITY } else { 1000.0 }),
        next: AtomicU64::new(argument("--first").unwrap_or(1.0) as u64),
        running: Mutex::default(),
        report: Mutex::new(Report { rows: vec![Row::default(); KINDS.len()], wrong: Vec::new() }),
    };
    thread::scope(|scope| {
        let begin = |_| thread::Builder::new().stack_size(STACK).spawn_scoped(scope, || run.work());
        let workers: Vec<_> = (0..workers).map(begin).collect::<Result<_, _>>().expect("threads");
        while !workers.iter().all(ScopedJoinHandle::is_finished) {
            thread::sleep(Duration::from_secs(1));
            if run.begun.elapsed().as_secs().is_multiple_of(10) {
                run.tell();
            }
        }
    });
    let report = run.report.into_inner().expect("no worker panics");
    report.print(begun.elapsed().as_secs_f64());
    ExitCode::from(u8::from(!report.wrong.is_empty()))
}
