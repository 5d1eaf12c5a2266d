//! Links the shared library so that it needs nothing at run time but the C library.
//!
//! Rust's standard library asks the linker for `libgcc_s.so`, which has the unwinder of GCC: panics are
//! caught with it. The same unwinder is in `libgcc_eh.a`. So the linker finds, before any other, a
//! `libgcc_s.so` of our own, which sends it there. `mediant-gppc` is built by this script, too.
#![allow(clippy::print_stdout, reason = "a build script talks to cargo")]

use std::{env, error::Error, fs, path::Path, process::Command};

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-env-changed=RUSTC_LINKER");
    if has_static_unwinder() {
        let folder = env::var("OUT_DIR")?;
        fs::write(Path::new(&folder).join("libgcc_s.so"), "INPUT(-lgcc_eh)\n")?;
        println!("cargo::rustc-cdylib-link-arg=-L{folder}");
        println!("cargo::rustc-cdylib-link-arg=-static-libgcc");
    }
    Ok(())
}

/// Whether the library can be linked so: on Linux with glibc and the libraries of GCC. Compilers of other
/// machines are not asked: what they build needs `libgcc_s.so.1`, as all of Rust does.
fn has_static_unwinder() -> bool {
    let is = |name: &str, value: &str| env::var(name).is_ok_and(|is| is == value);
    let features = env::var("CARGO_CFG_TARGET_FEATURE").unwrap_or_default();
    is("CARGO_CFG_TARGET_OS", "linux")
        && is("CARGO_CFG_TARGET_ENV", "gnu")
        && env::var("HOST").ok() == env::var("TARGET").ok()
        && !features.split(',').any(|feature| feature == "crt-static")
        && linker_has("libgcc_eh.a")
}

/// Whether the linker's driver finds a library: it tells the whole path of one that it has.
fn linker_has(library: &str) -> bool {
    let linker = env::var_os("RUSTC_LINKER").unwrap_or_else(|| "cc".into());
    let output = Command::new(linker).arg(format!("-print-file-name={library}")).output();
    output.is_ok_and(|output| Path::new(String::from_utf8_lossy(&output.stdout).trim()).is_absolute())
}
