//! Finding files of benchmark sets, unpacked and zipped.

use std::{fs, io::Write, path::Path};

use mediant_bench::{Archive, Problem};
use zip::{ZipWriter, write::SimpleFileOptions};

const MAP: &[u8] = b"type octile\nheight 1\nwidth 3\nmap\n...\n";
const SCENARIO: &[u8] = b"version 1\n0\tyard.map\t3\t1\t0\t0\t2\t0\t2\n";

fn write_zip(path: &Path, entries: &[(&str, &[u8])]) {
    let mut zip = ZipWriter::new(fs::File::create(path).expect("a file"));
    for (name, text) in entries {
        zip.start_file(*name, SimpleFileOptions::default()).expect("an entry");
        zip.write_all(text).expect("its text");
    }
    zip.finish().expect("an archive");
}

#[test]
fn files_are_found_in_folders_and_zips_the_first_folder_first() {
    let (cache, mirror) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
    let archive = Archive::new([cache.path().to_owned(), mirror.path().to_owned()]);
    assert_eq!(archive.map("toy", "yard").expect("nothing unreadable"), None);

    write_zip(&mirror.path().join("toy-map.zip"), &[("maps/backyard.map", b"no"), ("maps/yard.map", MAP)]);
    write_zip(&mirror.path().join("toy-scen.zip"), &[("yard.map.scen", SCENARIO)]);
    assert_eq!(archive.map("toy", "yard").expect("readable").as_deref(), Some(MAP));
    assert_eq!(archive.scenario("toy", "yard").expect("readable").as_deref(), Some(SCENARIO));
    assert_eq!(archive.map("toy", "ard").expect("readable"), None);
    assert_eq!(archive.map("other", "yard").expect("readable"), None);
    let problem = Problem::load(&archive, "toy", "yard", 1).expect("a problem").expect("its files");
    assert_eq!((problem.name(), problem.len(), problem.grid().width()), ("yard", 1, 3));

    let nested = cache.path().join("toy").join("maps");
    fs::create_dir_all(&nested).expect("a folder");
    fs::write(nested.join("yard.map"), b"unpacked").expect("a file");
    assert_eq!(archive.map("toy", "yard").expect("readable").as_deref(), Some(&b"unpacked"[..]));
    let error = Problem::load(&archive, "toy", "yard", 1).expect_err("not a map").to_string();
    assert!(error.starts_with("map `yard`: "), "{error}");
}

#[test]
fn broken_archives_are_reported_with_their_path() {
    let mirror = tempfile::tempdir().expect("a folder");
    let path = mirror.path().join("toy-map.zip");
    fs::write(&path, b"no archive").expect("a file");
    let archive = Archive::new([mirror.path().to_owned()]);
    let error = archive.map("toy", "yard").expect_err("no zip archive").to_string();
    assert!(error.starts_with(&path.display().to_string()), "{error}");
}
