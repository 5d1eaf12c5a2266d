//! Reading files: what can be read, and the message of every error.

use std::{fs, path::Path};

use mediant_formats::{MAX_FILE_BYTES, MapFile, ReadError, Scenario};

/// The message of an error without the folder of the test.
fn message(error: &ReadError, folder: &Path) -> String {
    error.to_string().replace(&format!("{}/", folder.display()), "")
}

#[test]
fn files_that_can_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let (map, scenario) = (folder.path().join("a.map"), folder.path().join("a.map.scen"));
    fs::write(&map, "type octile\nheight 1\nwidth 1\nmap\n.").unwrap();
    fs::write(&scenario, "version 1\n0\ta.map\t1\t1\t0\t0\t0\t0\t0\n").unwrap();
    assert_eq!(MapFile::read(&map).unwrap().as_bytes(), fs::read(&map).unwrap());
    assert_eq!(Scenario::read(&scenario).unwrap().as_bytes(), fs::read(&scenario).unwrap());
}

#[test]
fn files_that_cannot() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let read = |name: &str| message(&MapFile::read(at(name)).unwrap_err(), folder.path());
    assert_eq!(read("no.map"), "no.map: no such file; check the path and the folder that you are in");
    fs::create_dir(at("folder")).unwrap();
    assert_eq!(read("folder"), "folder: expected a file, found a directory; name a file in it");
    // A sparse file takes no room on the disk.
    fs::File::create(at("long")).unwrap().set_len(MAX_FILE_BYTES + 1).unwrap();
    assert_eq!(
        read("long"),
        "long: expected at most 2147483648 bytes, found more; is this the file that you meant?"
    );
    fs::write(at("empty"), "").unwrap();
    assert_eq!(
        read("empty"),
        "empty: line 1, column 1: expected a MovingAI map, found an empty file; is this the file that you meant?"
    );
    let error = Scenario::read(at("empty")).unwrap_err();
    assert_eq!(
        message(&error, folder.path()),
        "empty: line 1, column 1: expected a MovingAI scenario, found an empty file; is this the file that you meant?"
    );
    assert!(matches!(error, ReadError::Scenario { .. }));
    let error = MapFile::read("a\0b").unwrap_err();
    assert!(matches!(error, ReadError::Unreadable { .. }));
    assert!(error.to_string().starts_with("a\0b: cannot be read: "), "{error}");
}

#[cfg(unix)]
#[test]
fn a_device_is_not_read() {
    let error = Scenario::read("/dev/zero").unwrap_err();
    assert_eq!(
        error.to_string(),
        "/dev/zero: expected a regular file, found a device or pipe; save its content to a file first"
    );
}
