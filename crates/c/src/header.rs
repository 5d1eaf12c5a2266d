//! The header is that of the functions.

use std::{env, fs, path::Path};

use crate::about::{VERSION_MAJOR, VERSION_MINOR, VERSION_PATCH};

/// The heading of what a function of Rust asks of its caller, and the one of C: there every function is
/// called at the caller's risk.
const HEADINGS: (&str, &str) = ("// # Safety", "// Required:");

#[test]
fn header_is_of_the_version() {
    let version = format!("{VERSION_MAJOR}.{VERSION_MINOR}.{VERSION_PATCH}");
    assert_eq!(version, env!("CARGO_PKG_VERSION"), "change VERSION_MAJOR, VERSION_MINOR, VERSION_PATCH");
}

#[test]
fn header_is_that_of_the_functions() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(folder.join("cbindgen.toml")).unwrap();
    let built = cbindgen::Builder::new().with_src(folder.join("src/lib.rs")).with_config(config).generate();
    let mut header = Vec::new();
    built.unwrap().write(&mut header);
    let header = String::from_utf8(header).unwrap().replace(HEADINGS.0, HEADINGS.1);
    let path = folder.join("include/mediant.h");
    if env::var_os("MEDIANT_WRITE").is_some() {
        fs::create_dir_all(folder.join("include")).unwrap();
        fs::write(&path, &header).unwrap();
    }
    assert!(
        fs::read_to_string(path).unwrap() == header,
        "write it anew: MEDIANT_WRITE=1 cargo test -p mediant-c"
    );
}
