//! Landmarks as bytes.

use std::sync::Arc;

use mediant_grid::{Identity, Interrupt, Interrupted, room_for};

use super::{Landmarks, error::LandmarksError, lines::Lines};
use crate::{graph::CostGraph, scan::Visit};

impl Landmarks {
    /// The version of the format of [`to_bytes`](Self::to_bytes).
    pub const VERSION: u32 = 1;

    /// The landmarks as bytes: what they belong to, their number and their unit, then the numbers of all
    /// vertices, row by row, and those of the second states of closed gaps.
    ///
    /// # Errors
    /// [`LandmarksError::Mismatch`] for another graph than theirs.
    pub fn to_bytes(&self, graph: &CostGraph) -> Result<Vec<u8>, LandmarksError> {
        self.to_bytes_interruptible(graph, &Interrupt::NEVER)
    }

    /// [`to_bytes`](Self::to_bytes), which an interrupt can stop.
    ///
    /// # Errors
    /// As for [`to_bytes`](Self::to_bytes); [`LandmarksError::Interrupted`].
    pub fn to_bytes_interruptible(
        &self,
        graph: &CostGraph,
        interrupt: &Interrupt,
    ) -> Result<Vec<u8>, LandmarksError> {
        self.identity.check_equal("the landmarks", ("the graph", graph.identity()))?;
        let length = Self::length(graph, self.count());
        room_for::<u8>(length, Interrupted::WRITING)?;
        let mut bytes = Vec::with_capacity(length);
        bytes.extend(self.identity.to_bytes());
        bytes.extend([self.count() as u32, self.shift].into_iter().flat_map(u32::to_le_bytes));
        for (number, state) in states(graph).enumerate() {
            interrupt.check_every(1 << 14, number, Interrupted::WRITING)?;
            bytes.extend(self.lines.row(state).iter().flat_map(|number| number.to_le_bytes()));
        }
        Ok(bytes)
    }

    /// The number of bytes.
    fn length(graph: &CostGraph, count: usize) -> usize {
        Identity::BYTES + 8 + states(graph).count().saturating_mul(count * size_of::<u32>())
    }

    /// The landmarks from their bytes. Of every move it is checked that the bounds at its ends differ by its
    /// cost at most. So paths by accepted bytes are the cheapest ones, whatever the bytes. It takes as long
    /// as about two fields.
    ///
    /// # Errors
    /// [`LandmarksError::Mismatch`] for the landmarks of another graph, [`LandmarksError::Bytes`] for bytes
    /// that are none, [`LandmarksError::Interrupted`].
    pub fn from_bytes(
        graph: &CostGraph,
        bytes: &[u8],
        interrupt: &Interrupt,
    ) -> Result<Self, LandmarksError> {
        let damaged = LandmarksError::Bytes;
        let (identity, bytes) =
            Identity::split_from(bytes).ok_or(damaged("they do not begin with what they belong to"))?;
        identity.check_equal("the landmarks", ("the graph", graph.identity()))?;
        let (words, []) = bytes.as_chunks::<4>() else {
            return Err(damaged("their number is not a multiple of four"));
        };
        let word = |&word: &[u8; 4]| u32::from_le_bytes(word);
        let [count, shift, numbers @ ..] = words else { return Err(damaged("they are too few")) };
        let (count, shift) = (word(count) as usize, word(shift));
        if !matches!(count, 4 | 8 | 16) || shift > 31 {
            return Err(damaged("they have no such number of landmarks or no such unit"));
        }
        if Identity::BYTES + bytes.len() != Self::length(graph, count) {
            return Err(damaged("their number is not that of the graph"));
        }
        let mut lines = Lines::new(graph.states(), count)?;
        let mut writer = lines.writer();
        for (number, (state, row)) in states(graph).zip(numbers.chunks(count)).enumerate() {
            interrupt.check_every(1 << 14, number, "reading the landmarks")?;
            writer.row_mut(state).iter_mut().zip(row).for_each(|(to, from)| *to = word(from));
        }
        let mut check = Check { graph, lines: &lines, shift, from: 0, is_right: true };
        for (number, state) in states(graph).filter(|&state| !graph.is_blocked(state)).enumerate() {
            interrupt.check_every(1 << 12, number, "checking the landmarks")?;
            check.from = state;
            graph.scan((state, 0), &mut check);
            if !check.is_right {
                return Err(damaged("two numbers differ by more than a move"));
            }
        }
        Ok(Self { identity, lines: Arc::new(lines), shift })
    }
}

/// The states of all vertices, row by row, then the second states of gaps.
fn states(graph: &CostGraph) -> impl Iterator<Item = usize> {
    let (width, height) = graph.size();
    let layout = graph.layout();
    let position = move |x, y| layout.position(x, y);
    let positions = (0..height as i32).flat_map(move |y| (0..width as i32).map(move |x| position(x, y)));
    positions.chain(layout.len()..graph.states())
}

/// Compares the numbers at the ends of moves.
struct Check<'s> {
    graph: &'s CostGraph,
    lines: &'s Lines,
    shift: u32,
    from: usize,
    is_right: bool,
}

impl Visit for Check<'_> {
    #[inline]
    fn known(&self, to: usize) -> u64 {
        if self.graph.is_blocked(to) { 0 } else { u64::MAX }
    }

    #[inline]
    fn relax(&mut self, _: usize, to: usize, cost: u64) {
        let pairs = self.lines.row(self.from).iter().zip(self.lines.row(to));
        let greatest = pairs.fold(0, |greatest, (one, other)| one.abs_diff(*other).max(greatest));
        self.is_right &= u64::from(greatest) << self.shift <= cost;
    }
}
