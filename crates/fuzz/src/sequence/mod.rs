//! Programs: edits of a map, repairs, saved and loaded indexes, and queries with wishes, in any order. Each
//! answer is held to the oracle.
//!
//! Any bytes are a program: a map, a motion and an engine with options, then operations until the bytes
//! end. The text of the program is in the message of a failure, so that it can be written as a test.

mod ask;
mod known;
mod stops;
mod tables;
mod wishes;

use std::{cell::RefCell, fmt::Write as _, rc::Rc};

use mediant::{
    Change, Engine, FiniteK, Goals, Index, K, Map, Motion, Path, Planner, Rectangle, Rules, Setup, Space,
    Vertex,
};
use mediant_grid::{CornerRule, DiagonalGap, Grid};

pub(crate) use self::wishes::NthLook;

use self::known::Known;
use crate::bytes::Bytes;

/// The most operations of a program.
const MOST: usize = 12;

/// The least first byte of a program that asks for paths between points alone, or nearly so.
const POINTS: u8 = 224;

/// That of a program whose paths lead between centers at any angle.
const BETWEEN_CENTERS: u8 = 208;

/// An engine on a map, and the operations so far.
struct Run {
    setup: Setup,
    space: Space,
    index: Index,
    planner: Planner,
    known: Known,
    /// The last path that was found.
    path: Option<Path>,
    /// Goals that were prepared, perhaps for the map before an edit.
    goals: Option<Goals>,
    text: String,
}

/// A map, an engine, and operations.
pub(crate) fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let first = data.first().copied().unwrap_or_default();
    let is_of_points = first >= POINTS;
    if first >= BETWEEN_CENTERS {
        bytes.byte();
    }
    let grid = grid(&mut bytes);
    let motion = match first {
        POINTS.. => any_angle(Rules::Corner, &mut bytes),
        BETWEEN_CENTERS.. => any_angle(Rules::CenterGap, &mut bytes),
        _ => motion(&mut bytes),
    };
    let setups = setups(motion, is_of_points);
    let which = usize::from(bytes.byte()) << 8 | usize::from(bytes.byte());
    let setup = setups[which % setups.len()];
    let space = setup.space(&Map::from(grid.clone())).expect("engines search these motions");
    let index = setup.prepare(&space).unwrap_or_else(|error| panic!("{setup}: {error}\n{}", drawn(&grid)));
    let planner = index.planner();
    let known = Known::new(grid, setup);
    let text = format!("{setup}\n{}", drawn(known.grid()));
    let mut run = Run { setup, space, index, planner, known, path: None, goals: None, text };
    for _ in 0..MOST {
        if bytes.is_empty() {
            return;
        }
        if is_of_points && bytes.byte() < 240 { run.points(&mut bytes) } else { run.operation(&mut bytes) }
    }
}

/// A map of up to 7 × 6 cells; one in eight is a single row or column.
fn grid(bytes: &mut Bytes<'_>) -> Grid {
    let shape = bytes.byte();
    let (mut width, mut height) = (1 + u32::from(shape & 7), 1 + u32::from(shape >> 3 & 7).min(5));
    match shape >> 6 {
        3 if shape & 1 == 1 => width = 1,
        3 => height = 1,
        _ => {}
    }
    let cells = bytes.word() & if shape >> 6 == 0 { bytes.word() } else { !0 };
    Grid::from_fn(width, height, |x, y| cells >> ((y * width + x) % 64) & 1 == 1).expect("a small map")
}

/// One of the motions that every engine's suite has.
fn motion(bytes: &mut Bytes<'_>) -> Motion {
    let rules = Rules::ALL[bytes.below(Rules::ALL.len())];
    let k = match bytes.below(8) {
        5.. if matches!(rules, Rules::Corner(_)) => K::Any,
        // The tables of canonical search for a greater k take seconds, once a process.
        number => K::Finite(FiniteK::new([2, 3, 4, 5, 3, 2, 6, 4][number]).expect("a k")),
    };
    Motion::new(k, rules)
}

/// A motion whose paths may begin and end at any point.
fn any_angle(rules: fn(DiagonalGap) -> Rules, bytes: &mut Bytes<'_>) -> Motion {
    Motion::new(K::Any, rules(DiagonalGap::ALL[bytes.below(DiagonalGap::ALL.len())]))
}

type Setups = Rc<[Setup]>;

/// The engines with their options that take part, found once for each motion; those that take any point, if
/// it is asked for.
fn setups(motion: Motion, take_points: bool) -> Setups {
    thread_local! {
        static KNOWN: RefCell<Vec<((Motion, bool), Setups)>> = const { RefCell::new(Vec::new()) };
    }
    KNOWN.with_borrow_mut(|known| {
        if let Some((_, setups)) = known.iter().find(|(of, _)| *of == (motion, take_points)) {
            return Rc::clone(setups);
        }
        let fits = |setup: &Setup| {
            let of_points = [Engine::Anya, Engine::Subgoal].contains(&setup.engine.kind());
            takes_part(setup, motion) && (of_points || !take_points)
        };
        let setups: Setups = Setup::all(motion).filter(fits).collect();
        known.push(((motion, take_points), Rc::clone(&setups)));
        setups
    })
}

/// Where corners are always cut and k = 2, segments at any angle connect more than N(2).
fn takes_part(setup: &Setup, motion: Motion) -> bool {
    let is_special = motion.k == K::N4 && motion.rules == Rules::Center(CornerRule::Always);
    let is_any_angle = setup.paths() == K::Any;
    // Its searches of another map for one path are another engine's.
    !(is_special && is_any_angle) && setup.engine.kind() != Engine::Landmarks
}

/// The map as rows.
fn drawn(grid: &Grid) -> String {
    let mut text = String::new();
    for y in 0..grid.height() as i32 {
        let row = (0..grid.width() as i32).map(|x| if grid.is_free(x, y) { '.' } else { '#' });
        text.extend(row.chain(['\n']));
    }
    text
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
        match bytes.below(24) {
            0 | 1 => self.edit(bytes),
            2 => self.prepare_anew(),
            3 => self.save_and_load(),
            4 => self.field(bytes),
            5 => self.except(bytes),
            6 | 7 => self.several_ends(bytes),
            8 => self.nearest(bytes),
            9 => self.tolerance(bytes),
            10 | 11 => self.limits(bytes),
            12 => self.points(bytes),
            13 | 14 if self.setup.k() == K::Any => self.points(bytes),
            13..16 => self.path(bytes),
            16 => self.stopped(bytes),
            17 => self.table(bytes),
            18 => self.goals(bytes),
            19 => self.earlier_goals(bytes),
            20 => self.mistake(bytes),
            _ => self.wish(bytes),
        }
    }

    /// A rectangle on the map.
    fn rectangle(&self, bytes: &mut Bytes<'_>) -> Rectangle {
        let map = self.space.map();
        let (x, y) = (bytes.below(map.width() as usize) as u32, bytes.below(map.height() as usize) as u32);
        let sides = bytes.byte();
        let width = (1 + u32::from(sides & 3)).min(map.width() - x);
        let height = (1 + u32::from(sides >> 2 & 3)).min(map.height() - y);
        Rectangle::new(x, y, width, height)
    }

    /// Cells of the map, each blocked or free.
    fn cells(&self, bytes: &mut Bytes<'_>) -> Vec<(Vertex, bool)> {
        let at = self.rectangle(bytes);
        let blocked = bytes.byte();
        let cells = (at.y..at.y + at.height).flat_map(|y| (at.x..at.x + at.width).map(move |x| (x, y)));
        let cell = |(bit, (x, y)): (u32, (u32, u32))| {
            (Vertex::new(x as i32, y as i32), blocked >> (bit % 8) & 1 == 1)
        };
        (0..).zip(cells).map(cell).collect()
    }

    fn edit(&mut self, bytes: &mut Bytes<'_>) {
        let cells = self.cells(bytes);
        self.say(&format!("edit {cells:?}"));
        let change = self.space.edit_cells(cells.iter().copied()).expect("cells of the map");
        self.follow(&change, &cells);
        if bytes.byte() < 64 {
            self.say("finish");
            self.index = self.index.finish().unwrap_or_else(|error| panic!("{error}\n{}", self.text));
            self.planner.follow(&self.index).unwrap_or_else(|error| panic!("{error}\n{}", self.text));
        }
    }

    /// All that was prepared follows a change of some cells, and so does the oracle.
    fn follow(&mut self, change: &Change, cells: &[(Vertex, bool)]) {
        self.index = self.index.repair(change).unwrap_or_else(|error| panic!("{error}\n{}", self.text));
        self.space = change.after().clone();
        self.planner.follow(&self.index).unwrap_or_else(|error| panic!("{error}\n{}", self.text));
        self.known = Known::new(known::edited(self.known.grid(), cells), self.setup);
        let id = Map::from(self.known.grid().clone()).id();
        self.check(self.space.map().id() == id, || "the edited map is another one".to_owned());
        if let Some(path) = self.path.take() {
            let (holds, expected) = (self.space.check(&path).is_ok(), self.known.holds(&path));
            self.check(holds == expected, || format!("{path} holds: {holds}"));
        }
    }

    fn prepare_anew(&mut self) {
        self.say("prepare");
        self.index = self.setup.prepare(&self.space).expect("a small map");
        self.planner = self.index.planner();
    }

    fn save_and_load(&mut self) {
        self.say("save and load");
        let Ok(bytes) = self.index.to_bytes() else { return };
        let loaded =
            self.space.index_from_bytes(bytes).and_then(|index| index.with_options(self.setup.engine));
        let loaded = loaded.unwrap_or_else(|error| panic!("{error}\n{}", self.text));
        let smoothed = loaded.with_smoothing(self.setup.smoothing);
        self.planner = smoothed.planner();
        self.index = smoothed;
    }
}
