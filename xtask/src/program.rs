//! The chores that run engines: programs of other crates, compiled and run on demand.

use std::{
    env,
    ffi::OsString,
    process::{Command, ExitCode},
};

use mediant_sets::root;

use crate::Error;

/// A program of the workspace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Program {
    /// Its crate.
    pub package: &'static str,
    /// Its name in that crate.
    pub name: &'static str,
}

/// Compares costs with known ones.
pub const VERIFY: Program = Program { package: "mediant-bench", name: "verify" };
/// Asks every exact engine every public instance.
pub const PROVE: Program = Program { package: "mediant-bench", name: "prove" };
/// Times engines beside other programs.
pub const COMPARE: Program = Program { package: "mediant-bench", name: "compare" };
/// Runs all engines for a long time.
pub const SOAK: Program = Program { package: "mediant-bench", name: "soak" };
/// Reproduces the papers' tables and figures.
pub const REPRODUCE: Program = Program { package: "mediant-papers", name: "reproduce-tables" };
/// Draws the figures of the guide, and builds it.
pub const GUIDE: Program = Program { package: "mediant-guide", name: "mediant-guide" };

impl Program {
    /// The command that compiles the program for release and runs it with these arguments. It runs in the
    /// current folder, so that relative paths among the arguments mean what the user means.
    #[must_use]
    pub fn command(self, arguments: &[OsString]) -> Command {
        let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        command.args(["run", "--release", "--manifest-path"]).arg(root().join("Cargo.toml"));
        command.args(["--package", self.package, "--bin", self.name, "--"]).args(arguments);
        command
    }

    /// Runs the program and takes over its exit status; the program itself says what went wrong.
    ///
    /// # Errors
    /// [`Error::Step`] if cargo cannot be started.
    pub fn run(self, arguments: &[OsString]) -> Result<ExitCode, Error> {
        let status = self.command(arguments).status();
        let status = status.map_err(|_| Error::Step { command: format!("cargo run --bin {}", self.name) })?;
        // Without a code, a signal ended it.
        let code = status.code().and_then(|code| u8::try_from(code).ok());
        Ok(code.map_or(ExitCode::FAILURE, ExitCode::from))
    }
}
