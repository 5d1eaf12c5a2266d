//! Errors of a chore, whose messages are one line each.

use std::{
    io,
    path::{Path, PathBuf},
};

/// A chore that failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A benchmark set that cannot be provided.
    #[error(transparent)]
    Set(#[from] mediant_sets::Error),
    /// A mirror without any of the sets.
    #[error(
        "{mirror}: none of the sets is there; check --mirror: it holds files like dao-map.zip and \
         dao-scen.zip"
    )]
    NoSet {
        /// The address or path.
        mirror: String,
    },
    /// A file or folder that the system refuses.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// A package without a file that belongs in each.
    #[error("the package of {package} has no {file}: name it in `include`, in its Cargo.toml")]
    Missing {
        /// The crate.
        package: String,
        /// The file.
        file: &'static str,
    },
    /// Files that cannot be written from the description of the library.
    #[error("{wrong}")]
    Described {
        /// In words, the fault.
        wrong: String,
    },
    /// Rules that are broken; each was printed.
    #[error("broken rules: {count}")]
    Tidy {
        /// Their number.
        count: usize,
    },
    /// Inputs that a fuzzing target treats wrongly; each was printed with its message.
    #[error("inputs that are treated wrongly: {}", files.len())]
    Found {
        /// Their files.
        files: Vec<PathBuf>,
    },
    /// Mutants that no test notices, without a reason; each was printed.
    #[error("mutants that survive, and are not explained: {count}")]
    Survivors {
        /// Their number.
        count: usize,
    },
    /// A command that failed, or could not be started.
    #[error("`{command}` failed")]
    Step {
        /// The command.
        command: String,
    },
    /// An example that says something else than its page.
    #[error("an example does not say `{expected}`, but: {said}")]
    Said {
        /// Its output.
        said: String,
        /// The words of its page.
        expected: String,
    },
    /// A tool or crate that a chore needs and this machine lacks.
    #[error("{what}; {mend}")]
    Lacking {
        /// The missing tool or crate, in words.
        what: String,
        /// How to get it.
        mend: String,
    },
    /// A file that became too large.
    #[error("{what} has {bytes} bytes, at most {limit}: {reason}")]
    Large {
        /// The file, and how it was packed.
        what: String,
        /// Its size.
        bytes: usize,
        /// The most that it may have.
        limit: usize,
        /// Why.
        reason: &'static str,
    },
}

impl Error {
    /// Names the file or folder that an error of the system is about.
    pub fn at(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::Io { path: path.to_owned(), source }
    }
}
