//! Progress on standard error, for work that takes longer than a second. Nothing is shown where
//! standard error is no terminal; it is cleared where the bar is dropped, also on an error.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};
use std::time::Duration;

pub fn counted(count: usize) -> ProgressBar {
    shown(Some(count as u64), "{wide_bar} {pos}/{len} points, {eta} left")
}

/// Progress that only says that work goes on, and for how long it has.
pub fn spinner(work: &'static str) -> ProgressBar {
    shown(None, "{spinner} {msg}, {elapsed} so far; Ctrl-C stops it").with_message(work)
}

fn shown(length: Option<u64>, template: &str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(length, ProgressDrawTarget::stderr())
        .with_finish(ProgressFinish::AndClear);
    bar.set_style(ProgressStyle::with_template(template).expect("a template without errors"));
    bar.enable_steady_tick(Duration::from_secs(1));
    bar
}
