//! The radii at which the map of a disc changes.

use super::Clearance;
use crate::interrupt::{Interrupt, Interrupted, uninterrupted};

impl Clearance {
    /// The radii at which the map of a disc changes, from the smallest to the largest: the
    /// [`largest_disc`](Self::largest_disc) of each free cell, each number once. For all radii above one of
    /// them and up to the next, the map is the same.
    #[must_use]
    pub fn radii(&self) -> Vec<f64> {
        uninterrupted(|never| self.squared_radii(never))
            .into_iter()
            .map(|squared| self.root(squared))
            .collect()
    }

    /// The [`radii`](Self::radii) as stored squares.
    pub(super) fn squared_radii(&self, interrupt: &Interrupt) -> Result<Vec<u32>, Interrupted> {
        let (width, height) = (self.grid.width() as usize, self.grid.height() as usize);
        let mut squares = Numbers::default();
        for y in 0..height {
            interrupt.check("collecting the radii of discs")?;
            let row = self.grid.rows().row(y as i32);
            for x in (0..width).filter(|&x| !row.is_blocked(x as i32)) {
                squares.insert(self.squared_of_cell(x, y));
            }
        }
        Ok(squares.sorted())
    }
}

/// A set of numbers: a bit each, in pages that exist where numbers do.
#[derive(Default)]
struct Numbers {
    pages: Vec<Option<Box<[u64; 64]>>>,
}

impl Numbers {
    const PAGE: u32 = 64 * 64;

    #[inline]
    fn insert(&mut self, number: u32) {
        let (page, bit) = ((number / Self::PAGE) as usize, number % Self::PAGE);
        if page >= self.pages.len() {
            self.pages.resize(page + 1, None);
        }
        let page = self.pages[page].get_or_insert_with(|| Box::new([0; 64]));
        page[bit as usize / 64] |= 1 << (bit % 64);
    }

    fn sorted(&self) -> Vec<u32> {
        let pages = (0..).zip(&self.pages).filter_map(|(at, page)| Some((at, page.as_deref()?)));
        let words = pages.flat_map(|(at, page)| (64 * at..).zip(page));
        let numbers = words.flat_map(|(at, word)| {
            (0..64).filter(move |bit| word >> bit & 1 == 1).map(move |bit| 64 * at + bit)
        });
        numbers.collect()
    }
}
