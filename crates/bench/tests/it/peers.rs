//! `compare --peers`: programs that run alone, as a folder names them.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::{
    fs,
    os::unix::fs::PermissionsExt,
    path::Path,
    process::{Command, Output},
};

use mediant_report::Record;
use zip::{ZipWriter, write::SimpleFileOptions};

/// Says the lengths that the scenario has, but -1 for the last.
const KNOWS: &str = "#!/bin/sh\n\
    echo 'prepared 0.25 2000000'\n\
    printf 'pass 30\\npass 12\\npass 6\\n'\n\
    awk -F '\\t' 'NF > 1 { if (last != \"\") print \"cost\", last; last = $9 } END { print \"cost -1\" }' \"$2\"\n";

const FAILS: &str = "#!/bin/sh\necho 'first' >&2\necho 'no memory' >&2\nexit 3\n";

const LIST: &str = r#"[
    {"name": "knows", "version": "1", "command": ["knows.sh"], "beside": "jps-block:3:never"},
    {"name": "fails", "version": "2", "command": ["fails.sh"], "beside": "anya:any:closed"},
    {"name": "absent", "version": "3", "command": ["no-such-program"], "beside": "anya:any:closed"},
    {"name": "elsewhere", "version": "4", "command": ["fails.sh"], "beside": "jps-block:3:never", "maps": ["brc202d"]}
]"#;

/// A mirror whose set `dao` has a map of our own under the name arena2, with queries.
fn mirror(folder: &Path) {
    let scenario = "version 1\n0\tarena2.map\t4\t3\t0\t1\t3\t1\t5\n0\tarena2.map\t4\t3\t0\t0\t3\t0\t3\n";
    for (archive, name, text) in [
        ("dao-map.zip", "arena2.map", "type octile\nheight 3\nwidth 4\nmap\n....\n.@@.\n....\n"),
        ("dao-scen.zip", "arena2.map.scen", scenario),
    ] {
        let mut zip = ZipWriter::new(fs::File::create(folder.join(archive)).unwrap());
        zip.start_file(name, SimpleFileOptions::default()).unwrap();
        std::io::Write::write_all(&mut zip, text.as_bytes()).unwrap();
        zip.finish().unwrap();
    }
}

fn compare(folder: &Path, list: &str) -> Output {
    mirror(folder);
    for (name, text) in [("peers.json", list), ("knows.sh", KNOWS), ("fails.sh", FAILS)] {
        let path = folder.join(name);
        fs::write(&path, text).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    }
    let mut command = Command::new(env!("CARGO_BIN_EXE_compare"));
    // A project without a cache.
    command.env("CARGO_MANIFEST_DIR", folder);
    command
        .arg("--peers")
        .arg(folder)
        .arg("--mirror")
        .arg(folder)
        .arg("--json")
        .arg(folder.join("record.json"));
    command.args("--maps arena2 --rounds 2 --passes 3 --seconds 0".split(' ')).output().unwrap()
}

#[test]
fn ours_and_theirs_have_a_row_for_each_list() {
    let folder = tempfile::tempdir().unwrap();
    let output = compare(folder.path(), LIST);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("not measured: fails on arena2: it failed: no memory\n"), "{said}");
    assert!(said.contains("not measured: absent on arena2: it"), "{said}");
    assert!(!said.contains("elsewhere"), "{said}");

    let record = Record::parse(&fs::read_to_string(folder.path().join("record.json")).unwrap()).unwrap();
    let whole = [("list", "whole files"), ("map", "arena2")];
    let knows = [whole[0], whole[1], ("program", "knows")];
    let number = |column| record.number(&knows, column).unwrap();
    assert_eq!((number("instances"), number("query"), number("first")), (2.0, 4.5, 15.0));
    assert_eq!((number("prepared"), number("size"), number("differ")), (0.25, 2.0, 1.0));
    for ours in ["jps-block:3:never", "anya:any:closed"] {
        let keys = [whole[0], whole[1], ("program", ours)];
        assert_eq!(record.number(&keys, "differ"), Some(0.0), "{ours}");
        assert!(record.number(&keys, "query").is_some_and(|query| query > 0.0), "{ours}");
    }
    assert_eq!(record.rows.len(), 6);
    let every_20th = [("list", "every 20th"), knows[1], knows[2]];
    assert_eq!(record.number(&every_20th, "instances"), Some(1.0));
}

#[test]
fn lists_that_are_none_are_refused() {
    for (list, said) in [
        ("[]", "it names no program"),
        (r#"[{"name": "a", "version": "", "command": [], "beside": "astar"}]"#, "the command of a is empty"),
        (r#"[{"name": "a", "version": "", "command": ["a"], "beside": "best"}]"#, "`beside` of a: "),
        (r#"[{"name": "a"}]"#, "missing field"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let output = compare(folder.path(), list);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success() && errors.contains(said), "{list}: {errors}");
    }
}
