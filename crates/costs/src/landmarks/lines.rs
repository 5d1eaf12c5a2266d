//! The numbers of all states, so that those of one state share a cache line.

use mediant_grid::{Interrupted, VersionEdit, Versioned, room_for};

use super::{NONE, error::LandmarksError};

/// The most numbers of a state: those of a line.
pub(super) const MOST: usize = 16;

/// A cache line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(align(64))]
pub(super) struct Line([u32; MOST]);

/// The numbers of one state, and zeros.
pub(crate) type Numbers = [u32; MOST];

/// As many numbers for each state.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Lines {
    lines: Versioned<Line>,
    layout: Rows,
}

/// The place of a state's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Rows {
    states: usize,
    /// 4, 8 or 16.
    count: usize,
}

impl Rows {
    const fn lines(self) -> usize {
        self.states.div_ceil(MOST / self.count)
    }

    #[inline]
    fn row(self, lines: &[Line], state: usize) -> &[u32] {
        let at = state * self.count;
        &lines[at / MOST].0[at % MOST..][..self.count]
    }
}

/// Lines while they are changed.
pub(super) struct LinesEdit {
    lines: VersionEdit<Line>,
    layout: Rows,
}

impl LinesEdit {
    #[inline]
    pub(super) fn number(&self, state: usize, slot: usize) -> u32 {
        self.layout.row(self.lines.words(), state)[slot]
    }

    pub(super) fn set(&mut self, state: usize, slot: usize, number: u32) {
        let at = state * self.layout.count + slot;
        self.lines.word_mut(at / MOST).0[at % MOST] = number;
    }

    pub(super) fn finish(self) -> Lines {
        Lines { lines: self.lines.finish(), layout: self.layout }
    }
}

/// The first possible count that is not less.
pub(super) fn rounded(count: usize) -> usize {
    count.clamp(4, MOST).next_power_of_two()
}

/// The stage that an interrupted call names.
const DURING: &str = "making room for landmarks";

impl Lines {
    pub(super) fn new(states: usize, count: usize) -> Result<Self, LandmarksError> {
        if !(1..=MOST).contains(&count) {
            return Err(LandmarksError::Count { count });
        }
        let layout = Rows { states, count: rounded(count) };
        room_for::<Line>(layout.lines(), DURING)?;
        Ok(Self { lines: vec![Line([NONE; MOST]); layout.lines()].into(), layout })
    }

    /// A copy for another number of states, as far as they have the same numbers.
    pub(super) fn resized(&self, states: usize) -> Result<Self, Interrupted> {
        let layout = Rows { states, ..self.layout };
        room_for::<Line>(self.lines.len().max(layout.lines()), DURING)?;
        let mut lines = self.lines.to_vec();
        lines.resize(layout.lines(), Line([NONE; MOST]));
        // Of states that are left out nothing stays in the last line.
        let rest = states * layout.count % MOST;
        if let Some(last) = lines.last_mut().filter(|_| rest > 0) {
            last.0[rest..].fill(NONE);
        }
        Ok(Self { lines: lines.into(), layout })
    }

    /// Begins an edit, whose work follows what it changes.
    pub(super) fn edit(&self) -> Result<LinesEdit, Interrupted> {
        Ok(LinesEdit { lines: self.lines.edit_if_room(DURING)?, layout: self.layout })
    }

    pub(super) const fn count(&self) -> usize {
        self.layout.count
    }

    pub(super) const fn states(&self) -> usize {
        self.layout.states
    }

    #[inline]
    pub(super) fn row(&self, state: usize) -> &[u32] {
        self.layout.row(&self.lines, state)
    }

    /// Writes the numbers of lines that have no versions yet.
    pub(super) fn writer(&mut self) -> Writer<'_> {
        Writer { lines: self.lines.make_mut(), layout: self.layout }
    }

    pub(super) fn numbers(&self, state: usize) -> Numbers {
        let mut numbers = [0; MOST];
        let row = self.row(state);
        numbers[..row.len()].copy_from_slice(row);
        numbers
    }

    /// The greatest difference between a number of a state and that of a goal.
    #[inline]
    pub(super) fn greatest_difference(&self, state: usize, goal: &Numbers) -> u32 {
        let row = self.row(state);
        // As many as are known to the compiler, which takes several at once.
        match self.layout.count {
            4 => greatest_difference::<4>(row, goal),
            8 => greatest_difference::<8>(row, goal),
            _ => greatest_difference::<MOST>(row, goal),
        }
    }

    pub(super) fn memory_bytes(&self) -> usize {
        size_of_val(&*self.lines)
    }
}

/// Writes the numbers of lines.
pub(super) struct Writer<'l> {
    lines: &'l mut [Line],
    layout: Rows,
}

impl Writer<'_> {
    #[inline]
    pub(super) fn row_mut(&mut self, state: usize) -> &mut [u32] {
        let at = state * self.layout.count;
        &mut self.lines[at / MOST].0[at % MOST..][..self.layout.count]
    }
}

#[inline]
fn greatest_difference<const N: usize>(row: &[u32], goal: &Numbers) -> u32 {
    let (Some(row), Some(goal)) = (row.first_chunk::<N>(), goal.first_chunk::<N>()) else { return 0 };
    row.iter().zip(goal).fold(0, |greatest, (one, other)| greatest.max(one.abs_diff(*other)))
}
