//! The chores that run engines hand their arguments on.

use std::ffi::OsString;

use mediant_sets::root;
use xtask::program::{COMPARE, REPRODUCE, VERIFY};

#[test]
fn arguments_are_handed_on_as_they_are() {
    let arguments = ["--set", "dao", "--", "--help"].map(OsString::from);
    for (program, package, name) in [
        (VERIFY, "mediant-bench", "verify"),
        (COMPARE, "mediant-bench", "compare"),
        (REPRODUCE, "mediant-papers", "reproduce-tables"),
    ] {
        let command = program.command(&arguments);
        let found: Vec<OsString> = command.get_args().map(Into::into).collect();
        let manifest = root().join("Cargo.toml");
        let mut expected: Vec<OsString> = vec!["run".into(), "--release".into(), "--manifest-path".into()];
        expected.push(manifest.into());
        expected.extend(["--package", package, "--bin", name, "--"].map(Into::into));
        expected.extend(arguments.clone());
        assert_eq!(found, expected);
        // Relative paths mean what the user means.
        assert_eq!(command.get_current_dir(), None);
    }
}
