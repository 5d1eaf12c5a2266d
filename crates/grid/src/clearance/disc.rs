//! The map of a disc: which cells are free for it.

use super::{Clearance, Fit, SizeError, exact::least_square};
use crate::{
    BitMatrix, Grid,
    interrupt::{Interrupt, Interrupted},
};

/// The stage that an interrupted call names.
const DURING: &str = "making the map of a disc";

impl Clearance {
    /// The map of a disc whose radius is given in cells: a cell is free if the disc fits, touching obstacles
    /// allowed. The [`Fit`] says which points of a cell count; radius 0 is the map itself. All engines can
    /// search it.
    ///
    /// The number is taken exactly as it is: a disc of radius ½ passes through a corridor of one cell, and
    /// one of the next larger number does not.
    ///
    /// # Errors
    /// [`SizeError::Radius`] for a negative or infinite radius, or one that is not a number.
    pub fn for_disc(&self, radius: f64) -> Result<Grid, SizeError> {
        self.for_disc_interruptible(radius, &Interrupt::NEVER)
    }

    /// [`for_disc`](Self::for_disc), which an interrupt can stop; it asks before each row.
    ///
    /// # Errors
    /// As for [`for_disc`](Self::for_disc), and [`SizeError::Interrupted`].
    pub fn for_disc_interruptible(&self, radius: f64, interrupt: &Interrupt) -> Result<Grid, SizeError> {
        let least = least_square(radius, self.scale())?;
        // No stored square is larger than `u32::MAX`, so larger discs fit nowhere.
        let least = u32::try_from(least).ok();
        let nowhere = || BitMatrix::from_words(self.grid.width(), self.grid.height(), true, |_, _| !0);
        Ok(match least {
            Some(least) => self.at_least(least, interrupt)?,
            None if self.unlimited => self.at_least(0, interrupt)?,
            None => Grid::of(nowhere(), interrupt)?,
        })
    }

    /// The map of the free cells whose stored square is at least so large.
    pub(super) fn at_least(&self, least: u32, interrupt: &Interrupt) -> Result<Grid, Interrupted> {
        if least == 0 || self.unlimited {
            return Ok((*self.grid).clone());
        }
        let width = self.columns();
        let near = |x: i32, y: i32| {
            let row = &self.squared[y as usize * width..][..width];
            below(&row[x as usize..], least)
        };
        let (width, height) = (self.grid.width(), self.grid.height());
        let stop = (interrupt, DURING);
        let rows = match self.fit {
            Fit::Centers => BitMatrix::from_words_interruptible((width, height), true, stop, near)?,
            Fit::WholeCells => {
                let size = (width + 1, height + 1);
                let near = BitMatrix::from_words_interruptible(size, true, stop, near)?;
                BitMatrix::from_words_interruptible((width, height), true, stop, |x, y| {
                    let [above, below] = [near.row(y), near.row(y + 1)];
                    above.word(x) | above.word(x + 1) | below.word(x) | below.word(x + 1)
                })?
            }
        };
        Grid::of(rows, interrupt)
    }
}

/// Which of the first 64 numbers are below `least`, the first in the lowest bit.
#[inline]
fn below(numbers: &[u32], least: u32) -> u64 {
    let mut bytes = [0_u8; 64];
    for (byte, &number) in bytes.iter_mut().zip(numbers) {
        *byte = u8::from(number < least);
    }
    // Of eight bytes, each 0 or 1, the product collects the lowest bits in its highest byte.
    bytes.chunks_exact(8).rev().fold(0, |word, eight| {
        let eight = eight.iter().rev().fold(0_u64, |eight, &byte| eight << 8 | u64::from(byte));
        word << 8 | eight.wrapping_mul(0x0102_0408_1020_4080) >> 56
    })
}
