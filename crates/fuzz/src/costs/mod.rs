//! Programs where cells have costs: edits, repairs, saved indexes, fields, and queries with wishes, in any
//! order. Each answer is held to the oracle, whose costs are exact integrals.
//!
//! Any bytes are a program, as in `sequence`; a first byte from 192 on means one on a map to walk on. The
//! message of a failure has its text.

mod ask;
mod known;

use std::fmt::Write as _;

use mediant::{Engine, Field, FiniteK, Index, Motion, Path, Planner, Rules, Space, Vertex};
use mediant_grid::Grid;
use mediant_oracle::WeightedMap;

use self::known::Known;
use crate::{bytes::Bytes, walk};

/// The most operations of a program.
const MOST: usize = 12;
/// The least first byte of a program on a map to walk on.
const WALKS: u8 = 192;
/// The costs that cells have: few, so that paths tie, and great ones beside small ones.
const WEIGHTS: [u32; 8] = [1, 1, 2, 3, 5, 40, 1000, 65_535];

/// The k of programs. The tables of a great one take longer than all else, anew after each edit.
pub(crate) const KS: [u32; 16] = [2, 3, 4, 5, 3, 2, 4, 3, 5, 4, 3, 2, 6, 4, 7, 8];

/// An engine on a map, and the operations so far.
struct Run {
    engine: Engine,
    motion: Motion,
    k: FiniteK,
    space: Space,
    index: Index,
    planner: Planner,
    known: Known,
    /// The last path that was found.
    path: Option<Path>,
    /// The last field, and its sources.
    field: Option<(Field, Vec<Vertex>)>,
    text: String,
}

/// A map with costs, an engine, and operations.
pub(crate) fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    if data.first().is_some_and(|&first| first >= WALKS) {
        bytes.byte();
        return walk::run(&mut bytes);
    }
    let map = map(&mut bytes);
    let rules = Rules::ALL[bytes.below(Rules::ALL.len())];
    let k = FiniteK::new(KS[bytes.below(KS.len())]).expect("a k");
    let engines: Vec<_> = Engine::ALL.into_iter().filter(|engine| engine.capabilities().costs).collect();
    let engine = engines[bytes.below(engines.len())];
    let motion = Motion::new(k, rules);
    let text = format!("{engine}, {motion}\n{map}");
    let costs = known::costs(&map);
    let space = costs.space(motion).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let index = space.prepare(engine).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let planner = index.planner();
    let known = Known::new(map, &costs, rules, k);
    let (path, field) = (None, None);
    let mut run = Run { engine, motion, k, space, index, planner, known, path, field, text };
    for _ in 0..MOST {
        if bytes.is_empty() {
            return;
        }
        run.operation(&mut bytes);
    }
}

/// The cost of a cell; `None` if it is blocked.
fn weight(bytes: &mut Bytes<'_>) -> Option<u32> {
    let byte = bytes.byte();
    (byte < 176).then_some(WEIGHTS[usize::from(byte % 8)])
}

/// A map of up to 6 × 5 cells, of one of four sizes.
fn map(bytes: &mut Bytes<'_>) -> WeightedMap {
    let (width, height) = (1 + bytes.below(6) as u32, 1 + bytes.below(5) as u32);
    let (x, y) = [(1.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.5, 0.3)][bytes.below(4)];
    let weights: Vec<_> = (0..width * height).map(|_| weight(bytes)).collect();
    let at = |x: u32, y: u32| weights[(y * width + x) as usize];
    let grid = Grid::from_fn(width, height, |x, y| at(x, y).is_none()).expect("a small map");
    WeightedMap::from_fn(grid, |x, y| at(x, y).unwrap_or(1)).with_cell_size(x, y)
}

impl Run {
    fn say(&mut self, text: &str) {
        let _ = writeln!(self.text, "{text}");
    }

    /// Fails with the program so far.
    fn check(&self, holds: bool, message: impl FnOnce() -> String) {
        assert!(holds, "{}\n{}", message(), self.text);
    }

    fn operation(&mut self, bytes: &mut Bytes<'_>) {
        match bytes.below(14) {
            0..3 => self.edit(bytes),
            3 => self.prepare_anew(),
            4 => self.save_and_load(),
            5 => self.make_field(bytes),
            6 => self.several_ends(bytes),
            7 => self.tolerance(bytes),
            8 | 9 => self.limits(bytes),
            10 => self.table(bytes),
            11 => self.stopped(bytes),
            _ => self.path(bytes),
        }
    }

    /// Other costs of some cells. What was prepared follows, and so do the last path and field.
    fn edit(&mut self, bytes: &mut Bytes<'_>) {
        let (width, height) = (self.known.map().grid().width(), self.known.map().grid().height());
        let count = 1 + bytes.below(4);
        let cell = |bytes: &mut Bytes<'_>| {
            let at = (bytes.below(width as usize) as i32, bytes.below(height as usize) as i32);
            (Vertex::from(at), weight(bytes))
        };
        let cells: Vec<_> = (0..count).map(|_| cell(bytes)).collect();
        self.say(&format!("edit {cells:?}"));
        let edits = cells.iter().map(|&(cell, weight)| (cell, weight.map(f64::from)));
        let change = self.space.edit_costs(edits).unwrap_or_else(|error| panic!("{error}\n{}", self.text));
        self.space = change.after().clone();
        self.index = self.index.repair(&change).unwrap_or_else(|error| panic!("{error}\n{}", self.text));
        self.planner.follow(&self.index).unwrap_or_else(|error| panic!("{error}\n{}", self.text));
        let map = known::edited(self.known.map(), &cells);
        let costs = self.space.costs().expect("a space with costs").clone();
        self.check(costs.map().id() == mediant::Map::from(map.grid().clone()).id(), || {
            "the edited map is another one".to_owned()
        });
        self.known = Known::new(map, &costs, self.motion.rules, self.k);
        // A path without a segment has none that is not legal: its cost is 0 wherever it stands.
        if let Some(path) = self.path.take().filter(|path| path.waypoints().len() > 1) {
            // A cost is that of the segments, also where they meet at a closed gap: that is asked by `check`.
            let (told, expected) = (self.space.cost(&path), self.known.measured(&path));
            let holds = self.space.check(&path).is_ok();
            self.check(holds == expected.is_some(), || format!("{path} holds: {holds}"));
            let is_same = expected.is_none_or(|expected| {
                told.is_some_and(|told| (told - expected).abs() <= known::ROOM * expected)
            });
            self.check(is_same, || format!("{path} costs {told:?}, not {expected:?}"));
        }
        if let Some((field, sources)) = self.field.take() {
            match field.repair(&change) {
                Ok(field) => self.check_field(field, sources),
                Err(error) => {
                    let are_free = sources.iter().all(|&at| self.known.is_free(at));
                    self.check(!are_free, || error.to_string());
                }
            }
        }
    }

    fn prepare_anew(&mut self) {
        self.say("prepare");
        self.index = self.space.prepare(self.engine).expect("a small map");
        self.planner = self.index.planner();
    }

    fn save_and_load(&mut self) {
        self.say("save and load");
        let Ok(bytes) = self.index.to_bytes() else { return };
        let loaded = self.space.index_from_bytes(bytes);
        self.index = loaded.unwrap_or_else(|error| panic!("{error}\n{}", self.text));
        self.planner = self.index.planner();
    }
}
