//! A progress bar on stderr, for people who wait.

use std::{
    fmt,
    io::{self, IsTerminal},
    sync::OnceLock,
    time::{Duration, Instant},
};

use indicatif::{ProgressBar, ProgressState, ProgressStyle};
use mediant::search::Stage;

/// The time that a job may take without a bar.
const PATIENCE: Duration = Duration::from_millis(500);

/// The bar of `mediant run`, which appears only if the job takes long.
pub(crate) struct Progress {
    total: u64,
    done: u64,
    begin: Instant,
    allowed: bool,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// A bar for `total` queries; none if it is not wanted, or if stderr is no terminal.
    pub(crate) fn new(total: usize, wanted: bool) -> Self {
        let allowed = wanted && io::stderr().is_terminal();
        Self { total: total as u64, done: 0, begin: Instant::now(), allowed, bar: None }
    }

    /// Counts one more answered query.
    pub(crate) fn tick(&mut self) {
        self.done += 1;
        if self.bar.is_none() && self.allowed && self.begin.elapsed() > PATIENCE {
            self.bar = Some(
                ProgressBar::new(self.total).with_style(style(QUERIES)).with_elapsed(self.begin.elapsed()),
            );
        }
        if let Some(bar) = &self.bar {
            bar.set_position(self.done);
        }
    }

    /// Removes the bar.
    pub(crate) fn clear(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// The bar of `mediant build`, which any thread may move.
#[derive(Debug)]
pub(crate) struct BuildProgress {
    begin: Instant,
    allowed: bool,
    bar: OnceLock<ProgressBar>,
}

impl BuildProgress {
    /// A bar; none if stderr is no terminal.
    pub(crate) fn new() -> Self {
        Self { begin: Instant::now(), allowed: io::stderr().is_terminal(), bar: OnceLock::new() }
    }

    /// Shows how far the preparation is.
    pub(crate) fn tell(&self, progress: mediant::search::Progress) {
        let mediant::search::Progress { stage, done, total } = progress;
        if !self.allowed || self.begin.elapsed() < PATIENCE {
            return;
        }
        let doing = match stage {
            Stage::Edges => "edges",
            Stage::Hierarchy => "hierarchy",
            Stage::Sight => "sight",
            Stage::Labels => "labels",
            Stage::Vertices => "labels of vertices",
        };
        let bar = || {
            let bar = ProgressBar::new(total as u64).with_style(style(SUBGOALS)).with_message(doing);
            bar.with_elapsed(self.begin.elapsed())
        };
        let bar = self.bar.get_or_init(bar);
        if bar.message() != doing {
            bar.set_message(doing);
            bar.reset();
        }
        bar.set_position(done as u64);
    }

    /// Removes the bar.
    pub(crate) fn clear(&self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }
}

/// The template of a run's bar.
const QUERIES: &str = "  {bar:40.cyan/blue} {human_pos} of {human_len} queries, {left} left";
/// The template of a build's bar.
const SUBGOALS: &str = "  {bar:40.cyan/blue} {msg}: {human_pos} of {human_len} subgoals, {left} left";

fn style(template: &str) -> ProgressStyle {
    // indicatif's own estimate would count the queries before the bar appeared as taking no time.
    let left = |state: &ProgressState, text: &mut dyn fmt::Write| {
        let rest = state.len().unwrap_or(0).saturating_sub(state.pos());
        let seconds = state.elapsed().as_secs_f64() * rest as f64 / state.pos().max(1) as f64;
        // A bar that cannot be written is no failure.
        _ = write!(text, "{seconds:.0} s");
    };
    // The template is a constant that is valid; if a new version of indicatif refuses it, the default serves.
    ProgressStyle::with_template(template)
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .with_key("left", left)
}
