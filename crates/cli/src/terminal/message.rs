//! Messages on stderr.

use std::io::Write;

use anstyle::{AnsiColor, Style};

use super::text::printable;

/// Writes `error: …` on stderr.
pub(crate) fn say_error(text: &str) {
    say("error", AnsiColor::Red, text);
}

/// Writes `warning: …` on stderr.
pub(crate) fn say_warning(text: &str) {
    say("warning", AnsiColor::Yellow, text);
}

/// Writes a message, with its kind in bold and color.
fn say(kind: &str, color: AnsiColor, text: &str) {
    let style = Style::new().bold().fg_color(Some(color.into()));
    // If stderr is closed, there is nobody to tell.
    _ = writeln!(anstream::stderr(), "{style}{kind}:{style:#} {}", printable(text));
}
