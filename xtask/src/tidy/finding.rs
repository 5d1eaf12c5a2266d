//! Findings, and exceptions from the rules.

use std::{fmt, path::PathBuf};

/// A file or function that may be longer than the rule allows.
#[derive(Clone, Copy, Debug)]
pub struct Exception {
    /// The file, from the root.
    pub file: &'static str,
    /// The function; the whole file where there is none.
    pub function: Option<&'static str>,
    /// How many lines it may have.
    pub lines: usize,
    /// Why it is not made shorter.
    pub reason: &'static str,
}

/// A rule that is broken.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Finding {
    /// From the root.
    pub file: PathBuf,
    /// From 1; 0 for the whole file.
    pub line: usize,
    /// The fault, and why it matters.
    pub message: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, line, message } = self;
        match line {
            0 => write!(f, "{}: {message}", file.display()),
            _ => write!(f, "{}:{line}: {message}", file.display()),
        }
    }
}
