//! Progress on stderr.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar of `len` steps with the time that is left; invisible where stderr is no terminal.
#[must_use]
pub fn progress(name: &str, len: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{prefix:<12} {bar:40} {pos}/{len} {eta} left");
    let bar = ProgressBar::new(len as u64).with_prefix(name.to_owned());
    style.map_or(bar.clone(), |style| bar.with_style(style))
}
