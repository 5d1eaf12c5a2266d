//! Saved indexes: what is saved comes back, and every other file is refused with the right error.

use std::{fs, path::Path};

use mediant_formats::{IndexError, IndexFile, IndexKey, ReadError, WriteError};
use mediant_grid::{AsciiMap, CornerRule, DiagonalGap, Identity, Rules};
use mediant_moves::K;
use sha2::{Digest, Sha256};

const RULES: Rules = Rules::Center(CornerRule::Never);

fn identity(rules: Rules, k: Option<K>) -> Identity {
    let grid = AsciiMap::parse("..#\n...").expect("a well-formed drawing").grid;
    Identity { map: Some(grid.id()), rules, k }
}

fn key(rules: Rules, k: Option<K>) -> IndexKey {
    IndexKey::new("jps-plus", 7, identity(rules, k)).expect("a plain name")
}

fn index() -> IndexFile {
    IndexFile::new(key(RULES, Some(K::N8)), (0..50).collect())
}

/// The bytes with a right checksum, as another program might have written them.
fn sealed(mut bytes: Vec<u8>) -> Vec<u8> {
    bytes.truncate(bytes.len() - 32);
    let digest = Sha256::digest(&bytes);
    bytes.extend_from_slice(&digest);
    bytes
}

fn refused(bytes: &[u8]) -> IndexError {
    IndexFile::from_bytes(bytes.to_vec()).expect_err("to be refused")
}

/// The error for the index of these tests with one field overwritten and a right checksum.
fn forged(at: usize, field: &[u8]) -> IndexError {
    let mut bytes = index().to_bytes();
    bytes[at..at + field.len()].copy_from_slice(field);
    refused(&sealed(bytes))
}

fn files(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn what_is_saved_comes_back() {
    for rules in Rules::ALL {
        for k in [None, Some(K::N4), Some(K::N8), Some(K::Any)] {
            for payload in [vec![], vec![9], (0..=255).collect()] {
                let saved = IndexFile::new(key(rules, k), payload.clone());
                let read = IndexFile::from_bytes(saved.to_bytes()).unwrap();
                assert_eq!(read, saved);
                assert_eq!(read.payload(), payload);
                assert_eq!(
                    (read.key().engine(), read.key().version(), read.key().identity()),
                    ("jps-plus", 7, identity(rules, k))
                );
                read.check(&key(rules, k)).unwrap();
                assert_eq!(read.into_payload(), payload);
            }
        }
    }
}

/// There are files of this layout on disk: it may change only together with its version.
#[test]
fn the_bytes_of_a_file() {
    let (rules, k) = (Rules::Corner(DiagonalGap::Closed), Some(K::Any));
    let bytes = IndexFile::new(key(rules, k), vec![0xaa, 0xbb]).to_bytes();
    let expected = [
        b"\x89MEDIDX\n\x02\0\0\0jps-plus\0\0\0\0\0\0\0\0\x07\0\0\0",
        &identity(rules, k).to_bytes()[..],
        b"\x02\0\0\0\0\0\0\0\xaa\xbb",
    ]
    .concat();
    let (content, checksum) = bytes.split_at(bytes.len() - 32);
    assert_eq!(content, expected);
    assert_eq!(checksum, &Sha256::digest(&expected)[..]);
}

#[test]
fn every_truncation_is_refused() {
    let bytes = index().to_bytes();
    let whole = bytes.len() as u64;
    for length in 0..bytes.len() {
        let expected = match length {
            0..8 => IndexError::NotAnIndex {
                found: match length {
                    0 => "nothing".to_owned(),
                    _ => format!("`{}`", bytes[..length].escape_ascii()),
                },
            },
            8..72 => IndexError::Length { expected: 104, found: length as u64 },
            _ => IndexError::Length { expected: whole, found: length as u64 },
        };
        assert_eq!(refused(&bytes[..length]), expected);
    }
    let longer = [&bytes[..], &[0]].concat();
    assert_eq!(refused(&longer), IndexError::Length { expected: whole, found: whole + 1 });
}

#[test]
fn every_flipped_bit_is_refused() {
    let bytes = index().to_bytes();
    for bit in 0..bytes.len() * 8 {
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        let error = refused(&flipped);
        let right = match bit / 8 {
            0..8 => matches!(error, IndexError::NotAnIndex { .. }),
            8..12 => matches!(error, IndexError::Format { .. }),
            64..72 => matches!(error, IndexError::Length { .. }),
            _ => error == IndexError::Damaged,
        };
        assert!(right, "bit {bit}: {error}");
    }
}

#[test]
fn a_claimed_length_allocates_nothing() {
    for claimed in [51, 1 << 32, u64::MAX - 104, u64::MAX] {
        let mut bytes = index().to_bytes();
        bytes[64..72].copy_from_slice(&claimed.to_le_bytes());
        let found = bytes.len() as u64;
        let expected = claimed.saturating_add(104);
        assert_eq!(refused(&sealed(bytes)), IndexError::Length { expected, found });
    }
}

#[test]
fn what_is_no_index_word_by_word() {
    let cases = [
        (
            refused(b"type octile\nheight 1"),
            "expected a saved index, found `type oct` at its start; \
             is this the file that you meant?",
        ),
        (
            refused(b""),
            "expected a saved index, found nothing at its start; \
             is this the file that you meant?",
        ),
        (forged(8, &[1]), "expected an index of format version 2, found version 1; prepare it again"),
        (
            refused(&index().to_bytes()[..100]),
            "expected an index of 154 bytes, found 100; copy the file again, or prepare it again",
        ),
        (
            IndexError::Damaged,
            "expected the checksum that was saved with the index, found another: the file is damaged; \
             copy it again, or prepare it again",
        ),
        (
            forged(12, b"jps\0plus"),
            "expected an engine's name of 1 to 16 printable ASCII characters without blanks, \
             found `jps\\x00plus\\x00\\x00\\x00\\x00\\x00\\x00\\x00\\x00`: \
             another program wrote this index; prepare it again",
        ),
    ];
    for (error, message) in cases {
        assert_eq!(error.to_string(), message);
    }
    assert!(matches!(forged(12, &[0; 16]), IndexError::Field { .. }), "no name");
    assert!(matches!(forged(12, "jps-plüs".as_bytes()), IndexError::Field { .. }), "not ASCII");
    // The codes of rules and k end the identity, which begins at byte 32.
    for (at, code) in [(32 + 24, 7), (32 + 28, 1)] {
        let text = forged(at, &[code]).to_string();
        assert!(text.starts_with("expected a map with the codes of its rules and k, found `"), "{text}");
        assert!(text.ends_with("another program wrote this index; prepare it again"), "{text}");
    }
}

#[test]
fn names_that_cannot_be_saved() {
    let make = |name: &str| IndexKey::new(name, 1, identity(RULES, None));
    for name in ["", "jps plus", "jps\n", "übersicht", "a-name-of-17-long"] {
        assert!(matches!(make(name), Err(IndexError::EngineName { .. })), "{name:?}");
    }
    assert_eq!(make("a-name-of-16-abc").unwrap().engine(), "a-name-of-16-abc");
    assert_eq!(
        make("").unwrap_err().to_string(),
        "expected an engine's name of 1 to 16 printable ASCII characters without blanks, found nothing; \
         give the engine a shorter or plainer name"
    );
}

#[test]
fn a_file_is_replaced_as_a_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.idx");
    fs::write(&path, "an older index").unwrap();
    index().write(&path).unwrap();
    assert_eq!(fs::read(&path).unwrap(), index().to_bytes());
    assert_eq!(IndexFile::read(&path).unwrap(), index());
    assert_eq!(files(folder.path()), ["map.idx"], "nothing else is left");
}

#[test]
fn what_cannot_be_written_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let message =
        |error: &WriteError| error.to_string().replace(&format!("{}/", folder.path().display()), "");
    let nowhere = folder.path().join("missing/map.idx");
    let error = index().write(&nowhere).unwrap_err();
    assert!(matches!(error, WriteError::NoFolder { .. }));
    let missing = message(&error).replace(folder.path().to_str().unwrap(), "");
    assert_eq!(missing, "missing/map.idx: there is no folder missing: make it first, or choose another one");
    fs::create_dir(folder.path().join("folder")).unwrap();
    let error = index().write(folder.path().join("folder")).unwrap_err();
    assert_eq!(
        message(&error),
        "folder: expected a regular file or none, found a directory or device; name a file to be made"
    );
    assert_eq!(files(folder.path()), ["folder"]);
    assert!(files(&folder.path().join("folder")).is_empty());
}

#[cfg(unix)]
#[test]
fn a_new_index_can_be_read_by_those_who_read_new_files() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let [plain, saved] = ["plain", "saved"].map(|name| folder.path().join(name));
    fs::write(&plain, "").unwrap();
    index().write(&saved).unwrap();
    let mode = |path| fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&saved), mode(&plain));
}

#[cfg(unix)]
#[test]
fn a_device_is_not_replaced() {
    let error = index().write("/dev/null").unwrap_err();
    assert!(matches!(error, WriteError::NotRegular { .. }), "{error}");
}

#[test]
fn files_that_cannot_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.idx");
    assert!(matches!(IndexFile::read(&path), Err(ReadError::Missing { .. })));
    fs::write(&path, &index().to_bytes()[..140]).unwrap();
    let error = IndexFile::read(&path).unwrap_err();
    let ReadError::Index { source, .. } = &error else { panic!("{error}") };
    assert!(matches!(**source, IndexError::Length { .. }));
    assert_eq!(
        error.to_string(),
        format!(
            "{}: expected an index of 154 bytes, found 140; copy the file again, or prepare it again",
            path.display()
        )
    );
}
