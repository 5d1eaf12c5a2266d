//! An index file is used for nothing else than what it was built for.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use mediant_formats::{IndexError, IndexFile, IndexKey};
use mediant_grid::{AsciiMap, CornerRule, DiagonalGap, Identity, Rules};
use mediant_moves::K;

fn identity(drawing: &str, rules: Rules, k: Option<K>) -> Identity {
    Identity { map: Some(AsciiMap::parse(drawing).unwrap().grid.id()), rules, k }
}

const MAP: &str = "..#\n...";
const RULES: Rules = Rules::Center(CornerRule::Never);

fn key(engine: &str, version: u32, identity: Identity) -> IndexKey {
    IndexKey::new(engine, version, identity).unwrap()
}

fn read_back(key: IndexKey) -> IndexFile {
    IndexFile::from_bytes(IndexFile::new(key, vec![1, 2, 3]).to_bytes()).unwrap()
}

/// An index for every map, or for every k, is none for one map and k.
#[test]
fn a_file_for_something_else_is_refused() {
    let own = identity(MAP, RULES, Some(K::N8));
    let all = [
        own,
        identity(MAP, RULES, Some(K::N8)),
        identity("..#\n..#", RULES, Some(K::N8)),
        identity("..\n#.\n..", RULES, Some(K::N8)),
        identity(".", RULES, Some(K::N8)),
        identity(MAP, Rules::Center(CornerRule::One), Some(K::N8)),
        identity(MAP, Rules::Corner(DiagonalGap::Open), Some(K::N8)),
        identity(MAP, RULES, Some(K::N4)),
        identity(MAP, RULES, Some(K::Any)),
        Identity { k: None, ..own },
        Identity { map: None, ..own },
    ];
    let mut accepted = 0;
    for built in all {
        let file = read_back(key("jps-plus", 7, built));
        for needed in all {
            match file.check(&key("jps-plus", 7, needed)) {
                Ok(()) => {
                    assert_eq!(built, needed);
                    accepted += 1;
                }
                Err(IndexError::Mismatch(wrong)) => {
                    assert_ne!(built, needed);
                    assert_eq!((wrong.belongs_to, wrong.other_belongs_to), (built, needed));
                }
                Err(error) => panic!("{error}"),
            }
        }
    }
    assert_eq!(accepted, all.len() + 2);
}

#[test]
fn what_a_file_is_for_word_by_word() {
    let (own, other) = (identity(MAP, RULES, Some(K::N8)), identity("..#\n..#", RULES, Some(K::N4)));
    let file = read_back(key("jps-plus", 7, own));
    let refused = |engine, version| file.check(&key(engine, version, other)).unwrap_err().to_string();
    assert_eq!(
        refused("subgoal", 8),
        "expected an index of the engine subgoal, found one of jps-plus; \
         choose that engine, or prepare it again"
    );
    assert_eq!(
        refused("jps-plus", 8),
        "expected version 8 of the jps-plus index, found version 7; prepare it again"
    );
    assert_eq!(
        refused("jps-plus", 7),
        format!(
            "the saved index is for {own}; the space is for {other}: \
             use the saved index with what it was made for, or make a new one"
        )
    );
}
