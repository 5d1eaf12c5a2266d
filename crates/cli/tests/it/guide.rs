//! The commands of the guide that run the program, page by page.
#![cfg(unix)]

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

const PROGRAM: &str = env!("CARGO_BIN_EXE_mediant");

/// The pages below a folder, in order.
fn pages(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let mut all: Vec<PathBuf> = entries
        .flat_map(|path| if path.is_dir() { pages(&path) } else { vec![path] })
        .filter(|path| path.extension().is_some_and(|ending| ending == "md"))
        .collect();
    all.sort();
    all
}

/// The commands of a page's shell examples that run the program, each with what belongs to it: lines that
/// are continued, and its input.
fn commands(page: &str) -> Vec<String> {
    let (mut commands, mut is_in, mut end) = (Vec::new(), false, None);
    let mut whole = String::new();
    for line in page.lines() {
        if line.starts_with("```") {
            is_in = line == "```sh";
            continue;
        }
        if !is_in {
            continue;
        }
        whole += line.trim_end_matches('\\');
        if let Some((_, after)) = line.split_once("<<'") {
            end = after.split('\'').next();
        }
        if end.is_some_and(|end| end != line) {
            whole.push('\n');
        } else if !line.ends_with('\\') {
            end = None;
            commands.push(std::mem::take(&mut whole));
        }
    }
    commands.retain(|command| command.starts_with("mediant ") || command.contains("| mediant "));
    commands
}

/// On built-in maps, and on files that earlier commands of the page wrote, each ends well. Where readers have
/// files of their own, the arguments are right, and the file is not there.
#[test]
fn the_commands_of_the_guide_run_as_they_stand() {
    let guide = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/guide/src");
    let programs = Path::new(PROGRAM).parent().expect("a folder").to_owned();
    let path = env::join_paths(
        [programs].into_iter().chain(env::split_paths(&env::var_os("PATH").unwrap_or_default())),
    );
    let path = path.expect("no odd folders");
    let (mut whole, mut without) = (0, 0);
    for page in pages(&guide) {
        let folder = tempfile::tempdir().expect("a folder");
        for text in commands(&fs::read_to_string(&page).expect("a page")) {
            let mut command = Command::new("sh");
            command.args(["-c", &text]).current_dir(folder.path()).env("PATH", &path).stdin(Stdio::null());
            let output = command.output().expect("a shell");
            let said = String::from_utf8_lossy(&output.stderr);
            if output.status.success() {
                whole += 1;
            } else {
                let is_readers = said.contains("no such file") && !text.contains("builtin:");
                assert!(is_readers, "{}: {text}\n{said}", page.display());
                without += 1;
            }
        }
    }
    assert!(whole >= 20 && without > 0, "{whole} ran, {without} without their file");
}
