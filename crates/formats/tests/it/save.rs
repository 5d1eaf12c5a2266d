//! Files are whole, or what was there before.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::{
    fs,
    io::{self, Write},
    path::Path,
};

use mediant_formats::{NewFile, WriteError};

/// The names in a folder, in order.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn a_writer_that_fails_midway_leaves_the_older_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("near.csv");
    let full = |file: &mut NewFile| {
        // More than a buffer holds, so that some of it is in the new file.
        file.write_all(&[b'x'; 100_000])?;
        Err(io::ErrorKind::StorageFull.into())
    };
    let error = NewFile::write_with(&path, full).unwrap_err();
    assert!(matches!(error, WriteError::Unwritable { .. }), "{error}");
    assert!(error.to_string().ends_with("near.csv: cannot be written: no storage space"), "{error}");
    assert!(names(folder.path()).is_empty(), "nothing is left");
    fs::write(&path, "older").unwrap();
    NewFile::write_with(&path, full).unwrap_err();
    assert_eq!(
        (fs::read(&path).unwrap(), names(folder.path())),
        (b"older".to_vec(), vec!["near.csv".to_owned()])
    );
    // One that was begun and is dropped is none.
    drop(NewFile::create(&path).unwrap());
    assert_eq!(fs::read(&path).unwrap(), b"older");
    NewFile::write_with(&path, |file| file.write_all(b"newer")).unwrap();
    assert_eq!(
        (fs::read(&path).unwrap(), names(folder.path())),
        (b"newer".to_vec(), vec!["near.csv".to_owned()])
    );
}

#[test]
fn what_is_in_the_way_is_told_before() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    assert!(matches!(NewFile::check(at("no/a.csv")), Err(WriteError::NoFolder { .. })));
    assert!(matches!(NewFile::check(folder.path()), Err(WriteError::NotRegular { .. })));
    assert!(matches!(NewFile::create(folder.path()), Err(WriteError::NotRegular { .. })));
    fs::write(at("file"), "").unwrap();
    assert!(matches!(NewFile::check(at("file/a.csv")), Err(WriteError::NoFolder { .. })));
    for name in ["file", "new"] {
        NewFile::check(at(name)).unwrap();
    }
    assert_eq!(names(folder.path()), ["file"]);
}

#[cfg(unix)]
#[test]
fn links_and_permissions_stay() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let [path, link] = ["private.csv", "link.csv"].map(|name| folder.path().join(name));
    fs::write(&path, "older").unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
    symlink("private.csv", &link).unwrap();
    NewFile::write_with(&link, |file| file.write_all(b"newer")).unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"newer");
    assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_is_written_at_once() {
    NewFile::write_with("/dev/null", |file| file.write_all(b"gone")).unwrap();
    let error = NewFile::write_with("/dev/full", |file| file.write_all(b"too much")).unwrap_err();
    assert!(error.to_string().starts_with("/dev/full: cannot be written: "), "{error}");
}
