//! Outputs are whole, or what was there before.

#![cfg(unix)]

use std::{fs, process::Command};

use crate::common::{Files, succeeds};

/// Runs the program where no file can be longer than a block of 512 bytes: as on a full disk.
fn run_on_full_disk(line: &str) -> (Option<i32>, String) {
    let script = format!("trap '' XFSZ; ulimit -f 1; exec {} {line}", env!("CARGO_BIN_EXE_mediant"));
    let output = Command::new("sh").args(["-c", &script]).output().expect("a shell");
    (output.status.code(), String::from_utf8(output.stderr).expect("UTF-8"))
}

#[test]
fn a_full_disk_leaves_what_was_there() {
    let files = Files::new();
    let outputs = [
        ("reach builtin:cave --from 2,5 -o", "near.csv"),
        ("reach builtin:cave --from 2,5 -o", "near.npy"),
        ("reach builtin:cave --from 2,5 -o", "near.png"),
        ("reach builtin:cave --from 2,5 -o", "near.svg"),
        ("run builtin:cave --from 2,5 --to 62,33 --draw", "path.png"),
        ("run builtin:cave --from 2,5 --to 62,33 --draw", "path.svg"),
        ("run builtin:cave --from 2,5 --to 62,33 --trace", "search.json"),
        ("run builtin:cave --from 2,5 --engine dijkstra --distances", "all.csv"),
        ("convert builtin:town -o", "town.map"),
        ("convert builtin:town -o", "town.pgm"),
        ("convert builtin:town --resolution 1 -o", "town.yaml"),
        ("build builtin:town --engine subgoal -o", "town.idx"),
    ];
    let mut expected: Vec<&str> = outputs.map(|(_, name)| name).to_vec();
    for name in &expected {
        files.add(name, "older");
    }
    expected.sort_unstable();
    for (line, name) in outputs {
        let path = files.path(name);
        let (status, stderr) = run_on_full_disk(&format!("{line} {path}"));
        assert_eq!(status, Some(2), "{line}: {stderr}");
        assert!(stderr.contains("cannot be written: ") && !stderr.contains(".part"), "{line}: {stderr}");
        // The picture of a ROS map is written beside it: neither is changed.
        for name in [name, "town.pgm"] {
            assert_eq!(fs::read_to_string(files.path(name)).expect(name), "older", "{line}: {stderr}");
        }
    }
    let mut left: Vec<String> = fs::read_dir(files.path(""))
        .expect("the folder")
        .map(|entry| entry.expect("a name").file_name().to_string_lossy().into_owned())
        .collect();
    left.sort_unstable();
    assert_eq!(left, expected);
    // Where there is room, each is replaced.
    for (line, name) in outputs {
        let path = files.path(name);
        succeeds(&format!("{line} {path}"));
        assert_ne!(fs::read(&path).expect(name), b"older", "{line}");
    }
}
