//! Help and errors of clap, the errors in the form of the program's own.

use std::{
    io::{self, Write},
    process::ExitCode,
};

use clap::error::ErrorKind;

use crate::{
    failure::{Ending, FAILURE, Failure, finish},
    terminal::message::say_error,
};

/// Prints what clap returned instead of arguments: help and version as they are, an error in one line.
pub(crate) fn explain(error: &clap::Error) -> ExitCode {
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            let printed = error.print().and_then(|()| io::stdout().flush());
            finish(printed.map(|()| Ending::Answered).map_err(Failure::Output))
        }
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            _ = write!(anstream::stderr(), "{}", error.render().ansi());
            ExitCode::from(FAILURE)
        }
        _ => {
            say_error(&one_line(error));
            ExitCode::from(FAILURE)
        }
    }
}

/// clap's error in one line: what is wrong, what is possible, where to read more.
fn one_line(error: &clap::Error) -> String {
    // clap's tip on `--` is for positional arguments that look like options. There are none here.
    const NOISE: [&str; 3] = ["Usage:", "For more information", "tip: to pass"];
    let text = error.render().to_string();
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let mut parts: Vec<String> = Vec::new();
    for line in lines.filter(|line| !NOISE.iter().any(|noise| line.starts_with(noise))) {
        let line = line.strip_prefix("error: ").unwrap_or(line);
        match parts.last_mut() {
            // A list of arguments follows the line that announces it.
            Some(last) if last.ends_with(':') => *last = format!("{last} {line}"),
            Some(last) if line.starts_with('[') => *last = format!("{last} {line}"),
            _ => parts.push(line.to_owned()),
        }
    }
    parts.push("see --help".to_owned());
    parts.join("; ")
}
