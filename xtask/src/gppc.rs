//! `cargo xtask gppc --into FOLDER`: the entries of the Grid-Based Path Planning Competition, a folder for
//! each track, whose files are put over those of the track's kit.
//!
//! The dynamic track takes a shared library. The other two take C++ that their kit compiles: the entry, the
//! headers that it includes, the static library, and the script by which the kit compiles.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Stdio,
};

use clap::Args;
use mediant_sets::root;
use serde_json::Value;

use crate::{Error, project};

/// The libraries, by crate: for the dynamic track, and for the other two.
const LIBRARIES: [(&str, &str); 2] = [("mediant-gppc", "libGPPCentry.so"), ("mediant-c", "libmediant.a")];

/// The tracks with entries of C++, by their folders.
const TRACKS: [&str; 2] = ["classic", "any-angle"];

/// The options of `cargo xtask gppc`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// The folder that gets a folder for each track
    #[arg(long, value_name = "FOLDER")]
    pub into: PathBuf,
    /// Take what `cargo build --release -p mediant-c -p mediant-gppc` left in this folder, and build nothing
    #[arg(long, value_name = "FOLDER")]
    pub built: Option<PathBuf>,
}

/// Compiles the libraries for release, and writes the folders. Other files in them stay.
///
/// # Errors
/// [`Error::Step`] if cargo fails, [`Error::Io`] for a file.
pub fn run(options: &Options) -> Result<(), Error> {
    let [dynamic, library] = match &options.built {
        Some(folder) => LIBRARIES.map(|(_, name)| folder.join(name)),
        None => compile()?,
    };
    put(&dynamic, &options.into.join("dynamic/lib"))?;
    let entries = root().join("crates/gppc/entry");
    for track in TRACKS {
        let folder = options.into.join(track);
        for from in [entries.join("shared"), entries.join(track), root().join("crates/c/include")] {
            put_all(&from, &folder)?;
        }
        put(&library, &folder)?;
    }
    println!(
        "The entries: {}. Put the files of a track's folder over those of its kit.",
        options.into.display()
    );
    Ok(())
}

/// Compiles the libraries together, so that what they share is compiled once, and returns where they are.
fn compile() -> Result<[PathBuf; 2], Error> {
    let mut arguments = vec!["build", "--release", "--lib"];
    arguments.extend(LIBRARIES.iter().flat_map(|(package, _)| ["--package", package]));
    let shown = format!("cargo {}", arguments.join(" "));
    println!("$ {shown}");
    let failed = || Error::Step { command: shown.clone() };
    let mut cargo = project::cargo();
    // Cargo itself says where the libraries are: the folder depends on the user's settings.
    cargo.args(&arguments).args(["--message-format", "json-render-diagnostics"]).stderr(Stdio::inherit());
    let output = cargo.output().ok().filter(|output| output.status.success()).ok_or_else(failed)?;
    let messages = String::from_utf8_lossy(&output.stdout).into_owned();
    let [dynamic, library] = LIBRARIES.map(|(_, name)| made(&messages, name).ok_or_else(failed));
    Ok([dynamic?, library?])
}

/// The file of this name among those that cargo says that it made.
fn made(messages: &str, name: &str) -> Option<PathBuf> {
    messages.lines().find_map(|line| {
        let message: Value = serde_json::from_str(line).ok()?;
        let files = message.get("filenames")?.as_array()?;
        files.iter().filter_map(Value::as_str).map(PathBuf::from).find(|file| file.ends_with(name))
    })
}

/// Copies a file into a folder, which is made if need be.
fn put(file: &Path, folder: &Path) -> Result<(), Error> {
    fs::create_dir_all(folder).map_err(Error::at(folder))?;
    let Some(name) = file.file_name() else { return Ok(()) };
    fs::copy(file, folder.join(name)).map_err(Error::at(file))?;
    Ok(())
}

/// Copies all files of a folder, and of those in it, into another one.
fn put_all(from: &Path, into: &Path) -> Result<(), Error> {
    for file in fs::read_dir(from).map_err(Error::at(from))? {
        let file = file.map_err(Error::at(from))?;
        let path = file.path();
        if path.is_dir() {
            put_all(&path, &into.join(file.file_name()))?;
        } else {
            put(&path, into)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{made, put, put_all};
    use std::{fs, path::PathBuf};

    #[test]
    fn cargo_says_where_libraries_are() {
        let messages = "{\"reason\":\"compiler-artifact\",\"filenames\":[\"/a/libx.rlib\"]}\n\
                        no JSON\n\
                        {\"reason\":\"compiler-artifact\",\"filenames\":[\"/a/liby.so\",\"/a/liby.a\"]}\n";
        assert_eq!(made(messages, "liby.a"), Some(PathBuf::from("/a/liby.a")));
        assert_eq!(made(messages, "libz.a"), None);
    }

    #[test]
    fn other_files_stay() {
        let folder = tempfile::tempdir().unwrap();
        let [from, into] = ["from", "into/deep"].map(|name| folder.path().join(name));
        for (file, text) in [("a", "1"), ("in/b", "2")] {
            let file = from.join(file);
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            fs::write(file, text).unwrap();
        }
        fs::create_dir_all(&into).unwrap();
        fs::write(into.join("a"), "older").unwrap();
        fs::write(into.join("c"), "3").unwrap();
        put_all(&from, &into).unwrap();
        put(&from.join("a"), &into.join("other")).unwrap();
        for (file, text) in [("a", "1"), ("in/b", "2"), ("c", "3"), ("other/a", "1")] {
            assert_eq!(fs::read_to_string(into.join(file)).unwrap(), text, "{file}");
        }
    }
}
