//! `soak` succeeds where engines agree, and fails for memory that is lost and for what takes too long.

use std::process::{Command, Output};

/// The outcome of a short soak with more arguments. A process of its own: of the memory of this one other
/// tests take their part.
fn soak(arguments: &[&str]) -> Output {
    let short = ["--minutes", "0", "--side", "16", "--operations", "4", "--threads", "2"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_soak"));
    command.args(short).args(arguments).output().expect("the program runs")
}

fn error(outcome: &Output) -> String {
    assert!(!outcome.status.success(), "{outcome:?}");
    String::from_utf8_lossy(&outcome.stderr).into_owned()
}

#[test]
fn engines_agree() {
    let outcome = soak(&["--longest-milliseconds", "60000"]);
    let printed = String::from_utf8_lossy(&outcome.stdout);
    assert!(outcome.status.success(), "{outcome:?}");
    assert!(printed.contains("4 rounds, 8 edits, "), "{printed}");
    assert!(printed.contains("all engines agree"), "{printed}");
}

#[test]
fn lost_memory_is_found() {
    let outcome = soak(&["--longest-milliseconds", "60000", "--leak-kibibytes", "4096"]);
    assert!(error(&outcome).contains("allocated memory grows: "), "{outcome:?}");
}

#[test]
fn no_operation_may_take_longer_than_the_bound() {
    let outcome = soak(&["--longest-milliseconds", "0", "--seed", "7"]);
    let error = error(&outcome);
    assert!(error.contains("seed 7, ") && error.contains("the bound is 0 ms"), "{error}");
}
