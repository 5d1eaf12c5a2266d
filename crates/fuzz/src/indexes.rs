//! Saved indexes.

use std::sync::LazyLock;

use mediant::{CornerRule, DiagonalGap, Engine, FiniteK, Index, K, Map, Motion, Query, Setup, Space, Vertex};
use mediant_formats::IndexFile;
use mediant_grid::Identity;

use crate::bytes::Bytes;

/// A space, an engine's index on it as bytes, and the header that these have.
pub(crate) struct Saved {
    space: Space,
    file: IndexFile,
}

const MAPS: [&[&str]; 3] = [
    &["........", ".##..#..", "..#..#..", "..####..", "........", ".#..#..#"],
    &["..#..#..", "#......#", "..#..#..", "...##...", ".#....#."],
    &["....", "...."],
];

/// All engines whose indexes are saved, on small maps, under a few rules; with all their options on the
/// first. A byte chooses one.
pub(crate) static SAVED: LazyLock<Vec<Saved>> = LazyLock::new(|| {
    let five = FiniteK::new(5).expect("a k");
    let motions = [
        Motion::centers(K::N8),
        Motion::new(K::N8, CornerRule::Always),
        Motion::corners(K::N4),
        Motion::new(five, DiagonalGap::Closed),
        Motion::corners(K::ANY),
    ];
    let maps = MAPS.map(|rows| Map::from_rows(rows).expect("a map"));
    let spaces = maps.iter().flat_map(|map| motions.iter().filter_map(|&motion| map.space(motion).ok()));
    let mut all = Vec::new();
    for space in spaces {
        let kinds = [Engine::JpsPlus, Engine::Subgoal, Engine::Hpa, Engine::Chpa];
        for setup in Setup::all(space.motion()) {
            let is_default = setup.engine == setup.engine.kind().into();
            let is_asked = is_default || space.map().id() == maps[0].id() && space.motion() == motions[0];
            if !kinds.contains(&setup.engine.kind()) || setup.smoothing.is_some() || !is_asked {
                continue;
            }
            let Ok(bytes) = space.prepare(setup.engine).and_then(|index| index.to_bytes()) else { continue };
            let file = IndexFile::from_bytes(bytes).expect("bytes that were written");
            all.push(Saved { space: space.clone(), file });
        }
    }
    let costs = maps[0].costs((0..48).map(|at| 1 + at % 3)).expect("costs");
    let space = costs.space(Motion::centers(K::N8)).expect("costs");
    if let Ok(bytes) = space.prepare(Engine::Landmarks).and_then(|index| index.to_bytes()) {
        all.push(Saved { file: IndexFile::from_bytes(bytes).expect("bytes that were written"), space });
    }
    // Options that do not change the bytes.
    all.dedup_by(|one, other| one.file == other.file);
    all
});

impl Saved {
    pub(crate) fn payload(&self) -> &[u8] {
        self.file.payload()
    }

    pub(crate) fn whole(&self) -> Vec<u8> {
        self.file.to_bytes()
    }
}

/// The first byte chooses whose index it is; the rest is the payload, or of the last choice an identity.
pub(crate) fn run_payload(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let which = bytes.below(SAVED.len() + 1);
    let Some(saved) = SAVED.get(which) else { return identity(bytes.rest()) };
    let file = IndexFile::new(saved.file.key().clone(), bytes.rest().to_vec()).to_bytes();
    if let Ok(index) = saved.space.index_from_bytes(file) {
        ask(&saved.space, &index);
    }
}

/// The first byte chooses the space; the rest is the file.
pub(crate) fn run_file(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let saved = &SAVED[bytes.below(SAVED.len())];
    if let Ok(file) = IndexFile::from_bytes(bytes.rest().to_vec()) {
        assert_eq!(file.to_bytes(), bytes.rest(), "a file has one form");
    }
    if let Ok(index) = saved.space.index_from_bytes(bytes.rest().to_vec()) {
        assert!(index.identity() == saved.space.identity());
        ask(&saved.space, &index);
    }
}

fn identity(bytes: &[u8]) {
    if let Some((identity, rest)) = Identity::split_from(bytes) {
        assert_eq!(identity.to_bytes()[..], bytes[..bytes.len() - rest.len()], "{identity}");
    }
}

/// An index that was taken answers: its paths are legal, and it can be saved again.
fn ask(space: &Space, index: &Index) {
    let mut planner = index.planner();
    let (width, height) = (space.map().width() as i32, space.map().height() as i32);
    let ends = [(0, 0), (width - 1, height - 1), (width / 2, 0), (0, height - 1), (width - 1, height / 2)];
    for start in ends {
        for goal in ends.into_iter().rev() {
            let Ok(answer) = planner.find(Query::new(start, goal)) else { continue };
            if let Some(path) = answer.path() {
                assert_eq!(space.check(path), Ok(()), "{path}");
                let found = [path.start(), path.goal()];
                assert_eq!(found, [start, goal].map(|at| Some(Vertex::from(at).into())), "{path}");
                assert!(space.connected(start, goal));
            }
        }
    }
    let _ = index.to_bytes();
}
