//! `cargo xtask ci`: everything that a change must pass besides the tests.

use std::process::{Command, Stdio};

use mediant_sets::root;

use crate::{
    Error,
    project::{self, LIBRARIES},
    tidy,
};

/// The arguments of cargo in each step. The environment makes warnings of rustdoc errors.
const STEPS: [&[&str]; 7] = [
    &["fmt", "--all", "--check"],
    &["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"],
    &["doc", "--no-deps", "--workspace"],
    &["build", "--package", "mediant-moves", "--no-default-features"],
    // The workspace as a whole turns the features of `mediant-formats` on.
    &["check", "--package", "mediant-formats"],
    // And those of `mediant`: as most users have it, and as the light module for WebAssembly does.
    &["clippy", "--package", "mediant", "--", "-D", "warnings"],
    &[
        "clippy",
        "--package",
        "mediant",
        "--package",
        "mediant-web",
        "--no-default-features",
        "--",
        "-D",
        "warnings",
    ],
];

/// Targets whose pointers have 32 bits: a browser's, and Linux's. Tests run on the first in `.ci/run`, on
/// both in `.ci/night`.
const TARGETS: [&str; 2] = ["wasm32-unknown-unknown", "i686-unknown-linux-gnu"];

/// Runs all steps in order, up to the first that fails.
///
/// # Errors
/// [`Error::Step`] names the command, [`Error::Tidy`] the number of findings.
pub fn run() -> Result<(), Error> {
    for arguments in STEPS {
        let mut command = project::cargo();
        command.args(arguments).env("RUSTDOCFLAGS", "-D warnings");
        let setting = if arguments[0] == "doc" { "RUSTDOCFLAGS='-D warnings' " } else { "" };
        step(&mut command, &format!("{setting}cargo {}", arguments.join(" ")))?;
    }
    println!("$ cargo xtask tidy");
    tidy::run()?;
    other_targets()?;
    minimum_version()
}

/// Compiles the libraries, which must compile wherever programs that link them do, for each of [`TARGETS`]
/// that is installed.
fn other_targets() -> Result<(), Error> {
    let installed = said_by_rustup(&["target", "list", "--installed"]);
    for target in TARGETS {
        if !installed.lines().any(|line| line == target) {
            println!("{target} is not installed: not checked (rustup target add {target})");
            continue;
        }
        let packages = LIBRARIES.iter().flat_map(|library| ["--package", library]);
        let arguments: Vec<&str> = ["check", "--target", target].into_iter().chain(packages).collect();
        let mut command = project::cargo();
        step(command.args(&arguments), &format!("cargo {}", arguments.join(" ")))?;
    }
    Ok(())
}

/// The output of rustup; empty where there is none.
fn said_by_rustup(arguments: &[&str]) -> String {
    let output = Command::new("rustup").args(arguments).stderr(Stdio::null()).output();
    output.map(|output| String::from_utf8_lossy(&output.stdout).into_owned()).unwrap_or_default()
}

/// Prints a command and runs it.
pub(crate) fn step(command: &mut Command, shown: &str) -> Result<(), Error> {
    println!("$ {shown}");
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        _ => Err(Error::Step { command: shown.to_owned() }),
    }
}

/// Compiles the libraries by the oldest Rust that the project promises to support, if it is installed. The
/// rest, with the many crates that it needs, is left to `.ci/night`; clippy knows what the standard library
/// did not have then.
fn minimum_version() -> Result<(), Error> {
    let packages = project::packages()?;
    let Some(version) = packages.iter().find_map(|package| package.rust_version.as_deref()) else {
        return Ok(());
    };
    let installed = said_by_rustup(&["toolchain", "list"]);
    if !lists(&installed, version) {
        println!(
            "Rust {version}, the oldest that Cargo.toml promises, is not installed: not checked by its \
             compiler, only by clippy's incompatible_msrv for the standard library (rustup toolchain install \
             {version})"
        );
        return Ok(());
    }
    let packages = LIBRARIES.iter().flat_map(|library| ["--package", library]);
    let arguments: Vec<&str> = ["run", version, "cargo", "check"].into_iter().chain(packages).collect();
    // Without this, rustup would run the toolchain of this process.
    let mut command = Command::new("rustup");
    command.args(&arguments).current_dir(root()).env_remove("RUSTUP_TOOLCHAIN").env_remove("CARGO");
    step(&mut command, &format!("rustup {}", arguments.join(" ")))
}

/// Whether `rustup toolchain list` has this version, with any patch level.
fn lists(installed: &str, version: &str) -> bool {
    let begins = |name: &str| {
        name.strip_prefix(version).is_some_and(|rest| rest.starts_with(['.', '-']) || rest.is_empty())
    };
    installed.lines().filter_map(|line| line.split(' ').next()).any(begins)
}

#[cfg(test)]
mod tests {
    use super::lists;

    #[test]
    fn toolchains_of_a_version() {
        let installed =
            "stable-x86_64-unknown-linux-gnu (active, default)\n1.88.0-x86_64-unknown-linux-gnu\n";
        assert!(lists(installed, "1.88") && lists(installed, "1.88.0"));
        assert!(!lists(installed, "1.8") && !lists(installed, "1.89") && !lists("", "1.88"));
    }
}
