//! Progress on standard error, for work that takes longer than a second. It is shown where standard error is a
//! terminal, and cleared where it is dropped, also on an error. What will take minutes is told anywhere.

use super::budget;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};
use std::ops::Deref;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};
use wavestep::limits::share_done;

/// How often progress is looked at.
const TICK: Duration = Duration::from_millis(250);

/// Nothing is foretold before.
const SOON: Duration = Duration::from_secs(20);

/// Nor before this share is done: the first cells of a contact are far shorter than those that follow.
const LEAST: f64 = 0.01;

/// What takes longer than this is told.
const LONG: Duration = Duration::from_secs(180);

pub struct Progress {
    bar: ProgressBar,
    /// Ends the watch where it is dropped.
    _watch: Sender<()>,
}

impl Deref for Progress {
    type Target = ProgressBar;

    fn deref(&self) -> &ProgressBar {
        &self.bar
    }
}

pub fn counted(count: usize) -> Progress {
    budget::tell("evaluating");
    shown(
        Some(count as u64),
        "{wide_bar} {pos}/{len} points{msg}, {elapsed} so far; Ctrl-C stops it",
        "",
    )
}

/// Progress of work that is not counted.
pub fn spinner(work: &'static str) -> Progress {
    budget::tell(work);
    shown(None, "{spinner} {msg}, {elapsed} so far; Ctrl-C stops it", work)
}

fn shown(length: Option<u64>, template: &str, work: &'static str) -> Progress {
    let bar = ProgressBar::with_draw_target(length, ProgressDrawTarget::stderr())
        .with_finish(ProgressFinish::AndClear)
        .with_message(work);
    bar.set_style(ProgressStyle::with_template(template).expect("a template without errors"));
    bar.enable_steady_tick(4 * TICK);
    let (watch, ended) = channel();
    let watched = bar.downgrade();
    thread::spawn(move || {
        let (mut pace, mut told, mut is_shown) = (Pace::default(), false, false);
        while ended.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
            let Some(bar) = watched.upgrade() else { return };
            let (share, of) = share_done();
            let percent = format!("{:.0} % {of}", 100.0 * share);
            match (share > 0.0, is_shown) {
                (true, _) => bar.set_message(format!("{work}, {percent}")),
                (false, true) => bar.set_message(work),
                (false, false) => {}
            }
            is_shown = share > 0.0;
            let Some(left) = pace.left(Instant::now(), share).filter(|left| !told && *left > LONG)
            else {
                continue;
            };
            told = true;
            let minutes = left.as_secs().div_ceil(60);
            bar.suspend(|| {
                eprintln!(
                    "note: {percent} is done; the rest takes about {minutes} minutes more; an earlier end takes \
                     less, and Ctrl-C stops it"
                );
            });
        }
    });
    Progress { bar, _watch: watch }
}

/// How work goes on: when which share of a window was reached.
#[derive(Default)]
struct Pace {
    reached: Vec<(Instant, f64)>,
}

impl Pace {
    /// How long the rest takes about, some time after the beginning. Where half of what is done took a share `q`
    /// of the time, work grows as the power `p = −log₂ q` of the window, and all of it takes `f^{−p}` times as
    /// long as the part `f`.
    fn left(&mut self, now: Instant, share: f64) -> Option<Duration> {
        if self.reached.last().is_some_and(|(_, last)| share < *last) {
            self.reached.clear();
        }
        self.reached.push((now, share));
        let took = now - self.reached[0].0;
        if took < SOON || share < LEAST {
            return None;
        }
        let half =
            self.reached.iter().find(|(_, then)| *then >= share / 2.0)?.0 - self.reached[0].0;
        let power = -(half.max(TICK).as_secs_f64() / took.as_secs_f64()).log2();
        Duration::try_from_secs_f64(took.as_secs_f64() * (share.powf(-power.clamp(1.0, 2.5)) - 1.0))
            .ok()
    }
}
