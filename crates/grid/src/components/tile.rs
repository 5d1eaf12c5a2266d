//! The regions of one tile of a map, and where they meet those of the tiles around it.

use std::sync::Arc;

use super::{Connectivity, DURING, Sets};
use crate::interrupt::{Interrupt, Interrupted};

/// The side of a tile: its rows are words of the map.
pub(super) const SIDE: usize = 64;

/// Two regions that meet: one of the tile, and one of the tile beside it.
pub(super) type Contact = [u32; 2];

/// A tile: at most 64 rows of 64 cells. It holds nothing of the map but the bits of its border, so that what
/// joins two tiles is known from the two alone.
#[derive(Clone, Debug)]
pub(super) struct Tile {
    /// For each row the place in `labels` of its first run of free cells; from the last row on, their number.
    first: [u16; SIDE + 1],
    /// For each run, the number of its region.
    labels: Arc<[u32]>,
    /// The numbers that no other tile has, which its regions take; `regions` of them are in use.
    numbers: Arc<[u32]>,
    regions: u32,
    /// The free cells of the border, by [`Side`].
    border: [u64; 4],
    height: u8,
    /// Where regions meet those of the tiles in the first four [`DIRECTIONS`], in order and each pair once.
    /// The tiles in the others keep their contacts with this one.
    pub(super) contacts: [Arc<[Contact]>; 4],
}

/// A side of a tile. Its cells are numbered from left to right, or downwards.
#[derive(Clone, Copy)]
enum Side {
    Left,
    Right,
    Top,
    Bottom,
}

/// The runs of free cells of a row. Each is a set, and their numbers follow one another.
#[derive(Clone, Copy, Default)]
pub(super) struct RowRuns {
    pub(super) free: u64,
    first: u32,
}

impl RowRuns {
    /// The number of the set of a free cell.
    pub(super) const fn set(self, bit: u32) -> u32 {
        // The runs that begin up to the cell; its own is the last of them.
        let begun = self.free & !(self.free << 1) & !0 >> (63 - bit);
        self.first + begun.count_ones() - 1
    }
}

impl Tile {
    /// The tile of these words of free cells. Its regions are numbered from 0, row by row.
    pub(super) fn new(
        words: impl Iterator<Item = u64>,
        connectivity: Connectivity,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let (mut first, mut border, mut height) = ([0; SIDE + 1], [0; 4], 0);
        let (mut sets, mut above) = (Sets::default(), RowRuns::default());
        for word in words {
            interrupt.check(DURING)?;
            let row = RowRuns { free: word, first: sets.len() };
            first[height] = row.first as u16;
            sets.add((word & !(word << 1)).count_ones());
            sets.join_rows(above, row, connectivity);
            above = row;
            if height == 0 {
                border[Side::Top as usize] = word;
            }
            border[Side::Bottom as usize] = word;
            border[Side::Left as usize] |= (word & 1) << height;
            border[Side::Right as usize] |= word >> 63 << height;
            height += 1;
        }
        first[height..].fill(sets.len() as u16);
        let (labels, regions) = sets.names();
        Ok(Self {
            first,
            labels: labels.into(),
            numbers: Arc::default(),
            regions,
            border,
            height: height as u8,
            contacts: Default::default(),
        })
    }

    /// The number of rows.
    pub(super) fn height(&self) -> u32 {
        self.height.into()
    }

    /// For each run, the number of its region.
    pub(super) fn labels(&self) -> &[u32] {
        &self.labels
    }

    /// The tile with other runs in the rows from `row` on: so many in each, and with these labels.
    pub(super) fn with_labels(&self, row: usize, lengths: &[u16], new: &[u32]) -> Self {
        let end = row + lengths.len();
        let [from, to] = [row, end].map(|row| usize::from(self.first[row]));
        let labels = [&self.labels[..from], new, &self.labels[to..]].concat().into();
        let mut first = self.first;
        for (i, length) in (row..).zip(lengths) {
            first[i + 1] = first[i] + length;
        }
        let (old, new) = (self.first[end], first[end]);
        first[end..].iter_mut().zip(&self.first[end..]).for_each(|(first, &was)| *first = was - old + new);
        Self { first, labels, ..self.clone() }
    }

    /// The number of regions.
    pub(super) const fn regions(&self) -> u32 {
        self.regions
    }

    /// Gives its regions, which are numbered from 0, the numbers from `next` on.
    pub(super) fn number_from(&mut self, next: u32) {
        self.labels = self.labels.iter().map(|label| label + next).collect();
        self.numbers = (next..next + self.regions).collect();
    }

    /// Gives its regions, which are numbered from 0, numbers of an earlier version of the tile: a region that
    /// meets others beyond the border that of one that met others at the same cell, where there is one; the
    /// others numbers of regions that met none, or numbers from `next` on. `around` are the tiles around it,
    /// by [`DIRECTIONS`], and `met` the numbers of the earlier version whose regions met others.
    pub(super) fn number_like(
        &mut self,
        before: &Self,
        (around, met): (&[Option<&Self>; 8], &[u32]),
        connectivity: Connectivity,
        next: &mut u32,
    ) {
        let mut numbers = vec![u32::MAX; self.regions as usize];
        let mut taken = Vec::with_capacity(met.len());
        for (direction, other) in (0..).zip(around) {
            let Some(other) = other else { continue };
            self.for_each_contact(other, direction, connectivity, |[at, _]| {
                let number = &mut numbers[self.label(at) as usize];
                if *number == u32::MAX && before.border[at.0 as usize] >> at.1 & 1 == 1 {
                    // It met others, for the cell beside it did not change.
                    let like = before.label(at);
                    if !taken.contains(&like) {
                        *number = like;
                        taken.push(like);
                    }
                }
            });
        }
        let mut free = before.numbers.iter().copied().filter(|number| met.binary_search(number).is_err());
        let known = before.numbers.len();
        let mut all = before.numbers.to_vec();
        for number in numbers.iter_mut().filter(|number| **number == u32::MAX) {
            *number = free.next().unwrap_or_else(|| {
                all.push(*next);
                *next += 1;
                *next - 1
            });
        }
        self.numbers = if all.len() == known { Arc::clone(&before.numbers) } else { all.into() };
        self.labels = self.labels.iter().map(|&label| numbers[label as usize]).collect();
    }

    /// Where its regions meet those of the tile in a direction, in order and each pair once.
    pub(super) fn contacts_with(&self, other: &Self, direction: usize, how: Connectivity) -> Vec<Contact> {
        let mut contacts: Vec<Contact> = Vec::new();
        self.for_each_contact(other, direction, how, |[at, beside]| {
            let contact = [self.label(at), other.label(beside)];
            if contacts.last() != Some(&contact) {
                contacts.push(contact);
            }
        });
        contacts.sort_unstable();
        contacts.dedup();
        contacts
    }

    /// The cells of its border, and those of the tile in a direction, that meet.
    fn for_each_contact(
        &self,
        other: &Self,
        direction: usize,
        connectivity: Connectivity,
        mut meet: impl FnMut([(Side, u32); 2]),
    ) {
        let (dx, dy) = DIRECTIONS[direction];
        let across = |d: i32| if d > 0 { [Side::Right, Side::Left] } else { [Side::Left, Side::Right] };
        let along = |d: i32| if d > 0 { [Side::Bottom, Side::Top] } else { [Side::Top, Side::Bottom] };
        let is_free = |tile: &Self, (side, at): (Side, u32)| tile.border[side as usize] >> at & 1 == 1;
        if dx != 0 && dy != 0 {
            if connectivity == Connectivity::Eight {
                let (sides, heights) = (across(dx), [self, other].map(|tile| u32::from(tile.height) - 1));
                let rows = if dy > 0 { [heights[0], 0] } else { [0, heights[1]] };
                let cells = [(sides[0], rows[0]), (sides[1], rows[1])];
                if is_free(self, cells[0]) && is_free(other, cells[1]) {
                    meet(cells);
                }
            }
            return;
        }
        let [side, beside] = if dx != 0 { across(dx) } else { along(dy) };
        let (one, two) = (self.border[side as usize], other.border[beside as usize]);
        let reach = connectivity.reach() as i32;
        for shift in -reach..=reach {
            // Cell i of this side beside cell i + shift of the other.
            let mut cells = one & if shift < 0 { two << -shift } else { two >> shift };
            while cells != 0 {
                let at = cells.trailing_zeros();
                meet([(side, at), (beside, at.wrapping_add_signed(shift))]);
                cells &= cells - 1;
            }
        }
    }

    /// The region of a free cell of the border.
    fn label(&self, (side, at): (Side, u32)) -> u32 {
        match side {
            Side::Left => self.labels[usize::from(self.first[at as usize])],
            Side::Right => self.labels[usize::from(self.first[at as usize + 1]) - 1],
            Side::Top => self.of(0, at, self.border[Side::Top as usize]),
            Side::Bottom => self.of(usize::from(self.height) - 1, at, self.border[Side::Bottom as usize]),
        }
    }

    /// The region of the free cell in column `bit` of a row, whose free cells are `free`.
    pub(super) fn of(&self, row: usize, bit: u32, free: u64) -> u32 {
        self.labels[RowRuns { free, first: self.first[row].into() }.set(bit) as usize]
    }

    pub(super) fn memory_bytes(&self) -> usize {
        let contacts = self.contacts.iter().map(|contacts| size_of_val(&**contacts)).sum::<usize>();
        size_of::<Self>() + size_of_val(&*self.labels) + size_of_val(&*self.numbers) + contacts
    }
}

/// The directions to the tiles around a tile: four, and then the opposite ones in the same order.
pub(super) const DIRECTIONS: [(i32, i32); 8] =
    [(1, 0), (0, 1), (1, 1), (-1, 1), (-1, 0), (0, -1), (-1, -1), (1, -1)];
