//! Downloads of archives that the test makes, from a server that the test runs.

mod server;

use std::{
    collections::BTreeMap,
    fs,
    io::{Cursor, Write},
    path::{Path, PathBuf},
};

use mediant_formats::MapFile;
use mediant_sets::{Cache, Manifest, Report, Set, Source, map_digest, root};
use server::Server;
use zip::{ZipWriter, write::SimpleFileOptions};

const MAP: &str = "type octile\nheight 2\nwidth 9\nmap\n.@.......\n.........\n";
/// The same map, written otherwise: digests are taken of what a map says.
const SAME_MAP: &str = "type octile\r\nwidth 9\r\nheight 2\r\nmap\r\nGT.......\r\n.........";
const SCENARIO: &str =
    "version 1\n0\tmaps/a.map\t9\t2\t0\t0\t2\t0\t4\n1\tmaps/a.map\t9\t2\t0\t0\t8\t1\t8.41421\n";

fn zip(files: &[(&str, &str)]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in files {
        archive.start_file(*name, SimpleFileOptions::default()).expect("a new entry");
        archive.write_all(content.as_bytes()).expect("memory takes every byte");
    }
    archive.finish().expect("a whole archive").into_inner()
}

/// A second map, of noise that does not shrink in an archive: long enough to be cut.
fn long_map() -> String {
    let mut state = 1_u32;
    let mut cell = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        if state >> 31 == 0 { '.' } else { '@' }
    };
    let rows: String = (0..600).map(|_| (0..600).map(|_| cell()).collect::<String>() + "\n").collect();
    format!("type octile\nheight 600\nwidth 600\nmap\n{rows}")
}

fn digest(map: &str) -> String {
    map_digest(&MapFile::parse(map.as_bytes()).expect("a well-formed map"))
}

/// A set of the maps a and b, the folder that it goes to, and its archives.
struct Bench {
    folder: tempfile::TempDir,
    set: Set,
    maps: Vec<u8>,
    scenarios: Vec<u8>,
}

impl Bench {
    fn new() -> Self {
        let long = long_map();
        let maps = [("a.map", digest(MAP)), ("b.map", digest(&long))];
        let set = Set {
            name: "tiny".to_owned(),
            title: "of the test".to_owned(),
            maps_url: "http://127.0.0.1:9/unused".to_owned(),
            scenarios_url: "http://127.0.0.1:9/unused".to_owned(),
            instances: Some(2),
            maps: Some(maps.map(|(name, digest)| (name.to_owned(), digest)).into()),
        };
        Self {
            folder: tempfile::tempdir().expect("a temporary folder"),
            set,
            maps: zip(&[
                ("tiny/a.map", SAME_MAP),
                ("b.map", &long),
                ("__MACOSX/a.map", "junk"),
                ("tiny/._b.map", "junk"),
                ("README", ""),
            ]),
            scenarios: zip(&[("tiny/scen/a.map.scen", SCENARIO)]),
        }
    }

    fn cache(&self, source: Source) -> Cache {
        Cache { folder: self.folder.path().join("cache"), source }
    }

    /// Serves the archives.
    fn server(&self) -> Server {
        let server = Server::start();
        server.put("/tiny-map.zip", &self.maps);
        server.put("/tiny-scen.zip", &self.scenarios);
        server
    }

    fn mirror(&self) -> PathBuf {
        let mirror = self.folder.path().join("mirror");
        fs::create_dir_all(&mirror).expect("a folder");
        fs::write(mirror.join("tiny-map.zip"), &self.maps).expect("a file");
        fs::write(mirror.join("tiny-scen.zip"), &self.scenarios).expect("a file");
        mirror
    }

    /// Provides the set from a folder; the message of the error without the path of the folder.
    fn refused(&self) -> String {
        let error = self.cache(Source::Folder(self.mirror())).provide(&self.set).expect_err("to be refused");
        assert_eq!(listing(&self.folder.path().join("cache")), [""; 0], "nothing is left behind");
        error.to_string().replace(&format!("{}/", self.folder.path().display()), "")
    }
}

/// All files below a folder, sorted.
fn listing(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(next).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                found.push(path.strip_prefix(folder).expect("below it").to_string_lossy().into_owned());
            }
        }
    }
    found.sort();
    found
}

fn check(report: &Report, verified: bool, unpacked: bool) {
    assert_eq!((report.contents.maps.len(), report.contents.instances), (2, 2));
    assert_eq!((report.verified, report.unpacked), (verified, unpacked));
}

const UNPACKED: [&str; 3] = ["tiny/a.map", "tiny/a.map.scen", "tiny/b.map"];

#[test]
fn a_fresh_download_and_a_second_run_that_does_nothing() {
    let bench = Bench::new();
    let server = bench.server();
    let cache = bench.cache(Source::from_mirror(Some(&server.address())));
    let report = cache.provide(&bench.set).unwrap();
    check(&report, true, true);
    assert_eq!(report.to_string(), "tiny         verified 2 maps, 2 instances");
    assert_eq!(
        listing(&cache.folder),
        [&UNPACKED[..], &["zips/tiny-map.zip", "zips/tiny-scen.zip"]].concat()
    );
    assert_eq!(fs::read_to_string(cache.folder.join("tiny/a.map")).unwrap(), SAME_MAP);
    assert_eq!(server.requests(), ["/tiny-map.zip", "/tiny-scen.zip"]);

    check(&cache.provide(&bench.set).unwrap(), true, false);
    assert_eq!(server.requests().len(), 2, "no further request");

    // A map that was changed is unpacked again, from the archives that are there.
    fs::write(cache.folder.join("tiny/a.map"), MAP.replace('@', ".")).unwrap();
    check(&cache.provide(&bench.set).unwrap(), true, true);
    assert_eq!(server.requests().len(), 2, "no further request");
}

#[test]
fn a_cut_connection_is_taken_up_where_it_ended() {
    let bench = Bench::new();
    let server = bench.server();
    server.cut_after(&[20_000, 10_000]);
    let cache = bench.cache(Source::Url(server.address()));
    check(&cache.provide(&bench.set).unwrap(), true, true);
    let expected = [
        "/tiny-map.zip",
        "/tiny-map.zip bytes=20000- if \"v1\"",
        "/tiny-map.zip bytes=30000- if \"v1\"",
        "/tiny-scen.zip",
    ];
    assert_eq!(server.requests(), expected);
}

#[test]
fn a_later_run_resumes() {
    let bench = Bench::new();
    let server = bench.server();
    server.cut_after(&[20_000, 0, 5_000]);
    let cache = bench.cache(Source::Url(server.address()));
    let url = format!("{}/tiny-map.zip", server.address());
    let error = cache.provide(&bench.set).unwrap_err();
    let length = bench.maps.len();
    assert_eq!(
        error.to_string(),
        format!("{url}: cut off after 25000 of {length} bytes; run again to resume")
    );
    assert_eq!(listing(&cache.folder), ["zips/tiny-map.zip.part", "zips/tiny-map.zip.part.of"]);
    check(&cache.provide(&bench.set).unwrap(), true, true);
    assert_eq!(server.requests()[3], "/tiny-map.zip bytes=25000- if \"v1\"");
    assert_eq!(
        listing(&cache.folder),
        [&UNPACKED[..], &["zips/tiny-map.zip", "zips/tiny-scen.zip"]].concat()
    );
}

/// Cuts a download, lets `change` change the server, and sees that the whole file is fetched anew.
#[track_caller]
fn starts_anew(change: impl FnOnce(&Server, &Bench), requests: &[&str]) {
    let bench = Bench::new();
    let server = bench.server();
    server.put("/tiny-map.zip", &vec![b'x'; bench.maps.len()]);
    server.cut_after(&[20_000, 0, 0]);
    let cache = bench.cache(Source::Url(server.address()));
    cache.provide(&bench.set).expect_err("to be cut");
    server.put("/tiny-map.zip", &bench.maps);
    change(&server, &bench);
    check(&cache.provide(&bench.set).expect("a whole download"), true, true);
    assert_eq!(server.requests()[3..], [requests, &["/tiny-scen.zip"]].concat());
}

#[test]
fn another_version_of_the_file_is_fetched_from_its_start() {
    let part = "/tiny-map.zip bytes=20000- if \"v1\"";
    starts_anew(|server, _| server.set_etag("\"v2\""), &[part]);
    starts_anew(|server, _| server.ignore_ranges(), &[part]);
    // A server that gives the range all the same: the tag tells.
    let change = |server: &Server, _: &Bench| {
        server.set_etag("\"v2\"");
        server.ignore_conditions();
    };
    starts_anew(change, &[part, "/tiny-map.zip"]);
}

#[test]
fn without_a_tag_the_length_tells() {
    let bench = Bench::new();
    let server = bench.server();
    server.set_etag("W/\"weak\"");
    server.put("/tiny-map.zip", &[b'x'; 40_000]);
    server.cut_after(&[20_000, 0, 0]);
    let cache = bench.cache(Source::Url(server.address()));
    cache.provide(&bench.set).unwrap_err();
    server.put("/tiny-map.zip", &bench.maps);
    check(&cache.provide(&bench.set).unwrap(), true, true);
    assert_eq!(server.requests()[3..5], ["/tiny-map.zip bytes=20000-", "/tiny-map.zip"]);
}

#[test]
fn a_folder_as_mirror() {
    let bench = Bench::new();
    let mirror = bench.mirror();
    let cache = bench.cache(Source::from_mirror(mirror.to_str()));
    check(&cache.provide(&bench.set).unwrap(), true, true);
    assert_eq!(listing(&cache.folder), UNPACKED);
    fs::remove_file(mirror.join("tiny-scen.zip")).unwrap();
    check(&cache.provide(&bench.set).unwrap(), true, false);
    let message = cache.install(&bench.set).unwrap_err().to_string();
    let place = mirror.join("tiny-scen.zip");
    assert_eq!(
        message,
        format!("{}: not there; check --mirror, or leave the set out by --set", place.display())
    );
    assert_eq!(listing(&cache.folder), UNPACKED, "what was there stays");
}

#[test]
fn a_set_without_digests_is_unverified() {
    let mut bench = Bench::new();
    (bench.set.maps, bench.set.instances) = (None, None);
    let cache = bench.cache(Source::Folder(bench.mirror()));
    let report = cache.provide(&bench.set).unwrap();
    check(&report, false, true);
    assert_eq!(
        report.to_string(),
        "tiny         unverified 2 maps, 2 instances (the manifest knows no digest)"
    );
    let again = cache.provide(&bench.set).unwrap();
    check(&again, false, false);
}

#[test]
fn a_file_that_the_server_does_not_have() {
    let bench = Bench::new();
    let server = bench.server();
    let cache = bench.cache(Source::Url(format!("{}/elsewhere", server.address())));
    let message = cache.provide(&bench.set).unwrap_err().to_string();
    let url = format!("{}/elsewhere/tiny-map.zip", server.address());
    assert_eq!(message, format!("{url}: not there; check --mirror, or leave the set out by --set"));
    server.answer_with("503 Service Unavailable");
    let message = cache.provide(&bench.set).unwrap_err().to_string();
    assert_eq!(
        message,
        format!("{url}: expected the file, found HTTP status 503; try again later or use --mirror")
    );
}

#[test]
fn a_server_that_is_not_there() {
    let bench = Bench::new();
    // Nobody listens at port 1 (TCPMUX, long gone).
    let cache = bench.cache(Source::Url("http://127.0.0.1:1".to_owned()));
    let message = cache.provide(&bench.set).unwrap_err().to_string();
    assert!(message.starts_with("http://127.0.0.1:1/tiny-map.zip: "), "{message}");
    let mend = "; check the network, or name a folder or site that holds the same files by --mirror";
    assert!(message.ends_with(mend) && !message.contains('\n'), "{message}");
}

#[test]
fn a_bad_download_is_discarded_and_one_in_a_mirror_is_not() {
    let mut bench = Bench::new();
    bench.maps.truncate(30_000);
    let server = bench.server();
    let cache = bench.cache(Source::Url(server.address()));
    let message = cache.provide(&bench.set).unwrap_err().to_string();
    assert!(message.starts_with("tiny-map.zip: not a whole zip archive: "), "{message}");
    assert!(message.ends_with("; the download is discarded, run again to fetch it anew"), "{message}");
    assert_eq!(listing(&cache.folder), [""; 0]);
    drop(server);
    let message = bench.refused();
    assert!(message.starts_with("tiny-map.zip: not a whole zip archive: "), "{message}");
    assert!(bench.folder.path().join("mirror/tiny-map.zip").is_file());
}

#[test]
fn a_zip_with_a_flipped_bit() {
    let mut bench = Bench::new();
    let middle = bench.maps.len() / 2;
    bench.maps[middle] ^= 1;
    let message = bench.refused();
    assert!(message.starts_with("tiny-map.zip: not a whole zip archive: b.map: "), "{message}");
}

#[test]
fn files_that_differ_from_the_manifest() {
    let long = long_map();
    let changed = MAP.replace('@', ".");
    let mut bench = Bench::new();
    bench.maps = zip(&[("a.map", &changed), ("b.map", &long)]);
    let (expected, found) = (digest(MAP), digest(&changed));
    let mend = "the files differ from the manifest: fetch them from another place";
    assert_eq!(
        bench.refused(),
        format!("set tiny: map a.map: expected digest {expected}, found {found}; {mend}")
    );
    bench.maps = zip(&[("b.map", &long)]);
    assert_eq!(bench.refused(), format!("set tiny: map a.map is missing; {mend}"));
    bench.maps = zip(&[("a.map", MAP), ("b.map", &long), ("c.map", MAP)]);
    assert_eq!(bench.refused(), format!("set tiny: map c.map does not belong to it; {mend}"));
    bench.maps = zip(&[("a.map", MAP), ("b.map", &long)]);
    bench.scenarios = zip(&[("a.map.scen", "version 1\n")]);
    assert_eq!(bench.refused(), format!("set tiny: expected 2 instances, found 0; {mend}"));
    bench.scenarios = zip(&[("b.map.scen", SCENARIO)]);
    assert_eq!(
        bench.refused(),
        "b.map.scen: instance 0 of the scenario: expected the map `maps/a.map` of 9 × 2 cells, \
         found `b.map` of 600 × 600 cells; take the scenario that was made for this map"
    );
    bench.maps = zip(&[("a.map", "type octile\n")]);
    let message = bench.refused();
    assert!(message.contains("a.map: line 2, column 1: expected `height N` or `width N`"), "{message}");
}

#[test]
fn archives_that_are_not_unpacked() {
    let mend = "do not use this archive";
    for name in ["../evil.map", "maps/../../evil.map", "/evil.map", "C:\\evil.map", "..\\evil.map"] {
        let mut bench = Bench::new();
        bench.maps = zip(&[(name, MAP)]);
        let shown = name.escape_debug();
        assert_eq!(
            bench.refused(),
            format!("tiny-map.zip: the name `{shown}` leads out of the folder; {mend}")
        );
        let outside: Vec<String> = listing(bench.folder.path());
        assert_eq!(outside, ["mirror/tiny-map.zip", "mirror/tiny-scen.zip"]);
    }
    let mut bench = Bench::new();
    bench.maps = zip(&[("one/a.map", MAP), ("two/a.map", SAME_MAP)]);
    assert_eq!(bench.refused(), format!("tiny-map.zip: two different files of the name `a.map`; {mend}"));
    bench.maps = zip(&[("README", "no map here")]);
    assert_eq!(bench.refused(), format!("tiny-map.zip: it holds no `*.map` file; {mend}"));
}

#[test]
fn the_same_file_twice_is_no_conflict() {
    let mut bench = Bench::new();
    bench.maps = zip(&[("one/a.map", MAP), ("two/a.map", MAP), ("b.map", &long_map())]);
    check(&bench.cache(Source::Folder(bench.mirror())).provide(&bench.set).unwrap(), true, true);
}

#[test]
fn the_digest_has_the_documented_form() {
    // width 9, height 2, and 18 cells of which the second is blocked.
    let bytes = [9, 0, 0, 0, 2, 0, 0, 0, 0b10, 0, 0];
    let expected: String =
        <sha2::Sha256 as sha2::Digest>::digest(bytes).iter().map(|b| format!("{b:02x}")).collect();
    assert_eq!([digest(MAP), digest(SAME_MAP)], [expected.clone(), expected]);
}

#[test]
fn the_manifest_of_the_project() {
    let manifest = Manifest::read(&Manifest::path(&root())).unwrap();
    let counts: BTreeMap<&str, Option<(usize, u64)>> = manifest
        .sets
        .iter()
        .map(|set| (&*set.name, set.maps.as_ref().map(BTreeMap::len).zip(set.instances)))
        .collect();
    let expected = [
        ("dao", Some((156, 159_465))),
        ("da2", None),
        ("bg512", Some((75, 93_160))),
        ("wc3maps512", Some((36, 45_101))),
        ("sc1", Some((75, 198_230))),
        ("random", Some((70, 146_220))),
        ("room", Some((40, 78_840))),
        ("street", Some((90, 197_490))),
        ("maze", None),
    ];
    assert_eq!(counts, expected.into());
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path().join("manifest.json");
    manifest.write(&copy).unwrap();
    assert_eq!(fs::read(copy).unwrap(), fs::read(Manifest::path(&root())).unwrap());
    assert_eq!(
        manifest.set("quake").unwrap_err().to_string(),
        "unknown set `quake`: the manifest lists dao, da2, bg512, wc3maps512, sc1, random, room, street, maze"
    );
}
