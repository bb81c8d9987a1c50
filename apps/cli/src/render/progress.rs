//! What a person at a terminal sees while many models are drawn.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, Write};

/// A bar on standard error if that is a terminal and there is more than one model; lines on standard error always.
pub(crate) struct Progress(ProgressBar);

impl Progress {
    pub(crate) fn new(models: usize) -> Self {
        let is_shown = models > 1 && std::io::stderr().is_terminal();
        let target = if is_shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(models as u64), target);
        if let Ok(style) = ProgressStyle::with_template("{bar:32} {pos}/{len}  {per_sec}  {eta} left  {msg}") {
            bar.set_style(style);
        }
        Self(bar)
    }

    /// A model is done with.
    pub(crate) fn step(&self, failed: usize) {
        if failed > 0 {
            self.0.set_message(format!("{failed} failed"));
        }
        self.0.inc(1);
    }

    /// Above the bar.
    pub(crate) fn lines(&self, lines: &[String]) {
        if lines.is_empty() {
            return;
        }
        self.0.suspend(|| {
            let mut out = std::io::stderr().lock();
            for line in lines {
                // Nobody is left to tell if standard error is closed.
                let _ = writeln!(out, "{line}");
            }
        });
    }

    pub(crate) fn finish(&self) {
        self.0.finish_and_clear();
    }
}
