//! `cargo xtask download` with a manifest of the test's own; `mediant-sets` tests the downloads themselves.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::{
    fs::{self, File},
    io::Write,
    path::Path,
};

use mediant_sets::{DIGEST, Manifest, Set, cache};
use xtask::download::{Options, run_in};
use zip::{ZipWriter, write::SimpleFileOptions};

fn zip(path: &Path, name: &str, content: &str) {
    let mut archive = ZipWriter::new(File::create(path).unwrap());
    archive.start_file(name, SimpleFileOptions::default()).unwrap();
    archive.write_all(content.as_bytes()).unwrap();
    archive.finish().unwrap();
}

fn unknown(name: &str) -> Set {
    let url = "http://127.0.0.1:9/unused".to_owned();
    Set {
        name: name.to_owned(),
        title: "of the test".to_owned(),
        maps_url: url.clone(),
        scenarios_url: url,
        instances: None,
        maps: None,
    }
}

#[test]
fn the_command_with_a_manifest_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    let mirror = root.join("mirror");
    fs::create_dir(&mirror).unwrap();
    zip(&mirror.join("tiny-map.zip"), "a.map", "type octile\nheight 1\nwidth 3\nmap\n...\n");
    zip(&mirror.join("tiny-scen.zip"), "a.map.scen", "version 1\n0\ta.map\t3\t1\t0\t0\t2\t0\t2\n");
    let path = Manifest::path(root);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    let manifest = Manifest { digest: String::new(), sets: vec![unknown("absent"), unknown("tiny")] };
    manifest.write(&path).unwrap();
    let mirror = mirror.to_str().unwrap();
    let run = |sets: &[&str], mirror: &str, write_manifest| {
        let sets = sets.iter().map(|&set| set.to_owned()).collect();
        let done = run_in(root, &Options { sets, mirror: Some(mirror.to_owned()), write_manifest });
        done.map_err(|error| error.to_string().replace(&format!("{}/", root.display()), ""))
    };
    // All sets: one that the mirror lacks is passed over, and the manifest then knows the other.
    assert_eq!(run(&[], mirror, true), Ok(()));
    let written = Manifest::read(&path).unwrap();
    assert_eq!(written.sets[0], unknown("absent"));
    let tiny = &written.sets[1];
    assert_eq!(tiny.instances, Some(1));
    assert_eq!(tiny.maps.as_ref().unwrap().keys().collect::<Vec<_>>(), ["a.map"]);
    assert_eq!(written.digest, DIGEST);
    assert_eq!(run(&["tiny"], mirror, false), Ok(()));
    assert_eq!(Manifest::read(&path).unwrap(), written);
    let message = "mirror/absent-map.zip: not there; check --mirror, or leave the set out by --set";
    assert_eq!(run(&["tiny", "absent"], mirror, false), Err(message.to_owned()));
    let message = "unknown set `dao`: the manifest lists absent, tiny";
    assert_eq!(run(&["tiny", "dao"], mirror, false), Err(message.to_owned()));
    fs::remove_dir_all(cache(root)).unwrap();
    let message = "nowhere: none of the sets is there; \
                   check --mirror: it holds files like dao-map.zip and dao-scen.zip";
    assert_eq!(run(&[], "nowhere", false), Err(message.to_owned()));
}
