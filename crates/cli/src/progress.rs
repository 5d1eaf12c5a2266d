//! A progress bar on stderr, for people who wait.

use std::{
    fmt,
    io::{self, IsTerminal},
    time::{Duration, Instant},
};

use indicatif::{ProgressBar, ProgressState, ProgressStyle};

/// A bar that appears only when the job turns out to be a long one.
pub(crate) struct Progress {
    total: u64,
    done: u64,
    begin: Instant,
    allowed: bool,
    bar: Option<ProgressBar>,
}

impl Progress {
    const PATIENCE: Duration = Duration::from_millis(500);

    /// A bar for `total` queries. `wanted` is whether stdout leaves the screen to it.
    pub(crate) fn new(total: usize, wanted: bool) -> Self {
        let allowed = wanted && io::stderr().is_terminal();
        Self { total: total as u64, done: 0, begin: Instant::now(), allowed, bar: None }
    }

    /// One more query is answered.
    pub(crate) fn tick(&mut self) {
        self.done += 1;
        if self.bar.is_none() && self.allowed && self.begin.elapsed() > Self::PATIENCE {
            self.bar =
                Some(ProgressBar::new(self.total).with_style(style()).with_elapsed(self.begin.elapsed()));
        }
        if let Some(bar) = &self.bar {
            bar.set_position(self.done);
        }
    }

    /// Takes the bar away.
    pub(crate) fn clear(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn style() -> ProgressStyle {
    let template = "  {bar:40.cyan/blue} {human_pos} of {human_len} queries, {left} left";
    // indicatif's own estimate would take the queries before the bar appeared for instant ones.
    let left = |state: &ProgressState, text: &mut dyn fmt::Write| {
        let rest = state.len().unwrap_or(0).saturating_sub(state.pos());
        let seconds = state.elapsed().as_secs_f64() * rest as f64 / state.pos().max(1) as f64;
        // Nobody is told when a bar cannot be written.
        _ = write!(text, "{seconds:.0} s");
    };
    // The template is a constant; should a new version refuse it, the default serves.
    ProgressStyle::with_template(template)
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .with_key("left", left)
}
