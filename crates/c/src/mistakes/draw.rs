//! Arguments, right and mistaken.

use std::{
    ffi::{CString, c_char},
    mem::MaybeUninit,
    ptr,
};

use super::{
    model::{End, SpaceModel},
    world::World,
};
use crate::{
    code::Code,
    points::{Cell, Point},
};

/// The bytes of an array before a call writes there.
pub(super) const UNTOUCHED: u8 = 0xa5;

/// An array of the caller's, with exactly the room that is stated, or a pointer that leads nowhere.
pub(super) struct Array<T> {
    /// A value of an enum that no call has written is none.
    data: Vec<MaybeUninit<T>>,
    pub(super) at: *mut T,
    pub(super) count: usize,
    shift: usize,
}

impl<T: Copy> Array<T> {
    /// Its values after a call that wrote there; numbers are values before, too.
    /// None of a pointer that led nowhere.
    pub(super) fn values(&self) -> Vec<T> {
        // SAFETY: the memory is this array's, and has so many values.
        (0..self.data.len()).map(|n| unsafe { self.at.add(n).read() }).collect()
    }

    /// An array without values.
    pub(super) const fn empty() -> Self {
        Self { data: Vec::new(), at: ptr::null_mut(), count: 0, shift: 0 }
    }

    /// Whether a call has left it as it was.
    pub(super) fn is_untouched(&self) -> bool {
        let bytes = self.data.len() * size_of::<T>();
        // SAFETY: the memory is this array's; the types that are drawn have no bytes between their parts.
        (0..bytes).all(|n| unsafe { self.at.cast::<u8>().add(n).read() } == UNTOUCHED)
    }
}

/// Memory that no call has written.
fn blank<T>() -> MaybeUninit<T> {
    let mut value = MaybeUninit::uninit();
    // SAFETY: it is memory for a value.
    unsafe { ptr::write_bytes(value.as_mut_ptr(), UNTOUCHED, 1) };
    value
}

/// A number that no call has written, or numbers and pointers.
pub(super) fn untouched<T: Copy>() -> T {
    // SAFETY: every pattern of bits is a value of the types that are asked for.
    unsafe { blank().assume_init() }
}

/// Counts that no memory can hold.
const IMPOSSIBLE: [usize; 3] = [usize::MAX, usize::MAX / 2, (isize::MAX as usize) / 2 + 1];

impl World {
    fn array_of<T: Copy>(&mut self, values: Vec<MaybeUninit<T>>) -> Array<T> {
        let mut data = values;
        data.shrink_to_fit();
        let mut array = Array { at: data.as_mut_ptr().cast(), count: data.len(), data, shift: 0 };
        match self.rng.below(100) {
            0 => {
                array.at = ptr::null_mut();
                if array.count > 0 {
                    self.wrong(Code::Argument);
                }
                array.data.clear();
            }
            1 if align_of::<T>() > 1 && array.count > 0 => {
                array.at = array.at.wrapping_byte_add(1);
                (array.shift, _) = (1, array.data.clear());
                self.wrong(Code::Argument);
            }
            2 if size_of::<T>() > 1 => {
                array.count = self.rng.pick(&IMPOSSIBLE).copied().unwrap_or_default();
                self.wrong(Code::Argument);
            }
            _ => {}
        }
        array
    }

    /// An array that is read.
    pub(super) fn values<T: Copy>(&mut self, values: &[T]) -> Array<T> {
        self.array_of(values.iter().copied().map(MaybeUninit::new).collect())
    }

    /// An array that is read beside another one, which has so many values.
    pub(super) fn beside<T: Copy>(&mut self, values: &[T], count: usize) -> Array<T> {
        let mut array = self.array_of(values.iter().copied().map(MaybeUninit::new).collect());
        if array.count != values.len() {
            // The count is that of the other, which is noted already.
            array.count = count;
            self.forgive(Code::Argument);
        }
        array
    }

    /// An array that is written, mostly with room enough.
    pub(super) fn room<T: Copy>(&mut self, enough: usize) -> Array<T> {
        let room = match self.rng.below(10) {
            0 => 0,
            1 => self.rng.below(enough as u32 + 1) as usize,
            2 => enough + 3,
            _ => enough,
        };
        self.array_of(vec![blank(); room])
    }

    /// A place for a result.
    pub(super) fn place<T: Copy>(&mut self) -> Array<T> {
        let mut place = Array { data: vec![blank::<T>()], at: ptr::null_mut(), count: 1, shift: 0 };
        place.at = place.data.as_mut_ptr().cast();
        match self.rng.below(150) {
            0 => place.at = ptr::null_mut(),
            1 if align_of::<T>() > 1 => (place.at, place.shift) = (place.at.wrapping_byte_add(1), 1),
            _ => return place,
        }
        place.data.clear();
        self.wrong(Code::Argument);
        place
    }

    /// A text, or null for none.
    pub(super) fn text(&mut self, text: Option<&str>) -> (Option<CString>, *const c_char) {
        let text = text.map(|text| CString::new(text).expect("no 0"));
        let at = text.as_ref().map_or(ptr::null(), |text| text.as_ptr());
        (text, at)
    }

    /// Parameters: mostly one of these texts, by its number, and else a text that says nothing of this kind.
    pub(super) fn words(&mut self, good: &[&str], bad: &[(&str, Code)]) -> (CString, Option<usize>) {
        let number = self.rng.below(good.len() as u32) as usize;
        let (bytes, code) = match self.rng.below(100) {
            0..92 => return (CString::new(good[number]).expect("no 0"), Some(number)),
            92 => (b"k=\xff\xfe".to_vec(), Code::Argument),
            93 => ("ä".repeat(1 + self.rng.below(20_000) as usize).into_bytes(), Code::Argument),
            94 => (b"weights=3 %s%n\x07=;".to_vec(), Code::Argument),
            _ => match self.rng.pick(bad) {
                Some(&(text, code)) => (text.as_bytes().to_vec(), code),
                None => (b"=".to_vec(), Code::Argument),
            },
        };
        self.wrong(code);
        (CString::new(bytes).expect("no 0"), None)
    }

    /// A point that a call takes as this end of a path, mostly a right one.
    pub(super) fn end(&mut self, space: Option<&SpaceModel>, end: End) -> Point {
        let at = self.point(space);
        self.note_end(space, at, end);
        at
    }

    /// Notes what is wrong with an end.
    pub(super) fn note_end(&mut self, space: Option<&SpaceModel>, at: Point, end: End) {
        let codes = space.map_or_else(|| SpaceModel::known_wrong(at, end), |space| space.wrong_end(at, end));
        codes.iter().for_each(|&code| self.wrong(code));
    }

    /// Ends, mostly one or two.
    pub(super) fn ends(&mut self, space: Option<&SpaceModel>, end: End) -> Vec<Point> {
        let count = [1, 1, 1, 1, 2, 2, 3, 0][self.rng.below(8) as usize];
        (0..count).map(|_| self.end(space, end)).collect()
    }

    /// Any point.
    pub(super) fn point(&mut self, space: Option<&SpaceModel>) -> Point {
        let known = space.map_or(&[][..], |space| &space.popular);
        let odd = [f64::NAN, f64::INFINITY, -1e300, -1.0, 0.0, -0.0, 1e9, 4.5, 2_147_483_647.9, 1e-300];
        match self.rng.below(100) {
            0..90 if !known.is_empty() => self.rng.pick(known).copied().unwrap_or(Point { x: 0.0, y: 0.0 }),
            90..96 => {
                let mut any = || f64::from(self.rng.below(14)) - 1.0;
                Point { x: any(), y: any() }
            }
            96..98 => {
                let mut any = || f64::from(self.rng.below(80)) / 8.0;
                Point { x: any(), y: any() }
            }
            _ => {
                let mut any = || self.rng.pick(&odd).copied().unwrap_or_default();
                Point { x: any(), y: any() }
            }
        }
    }

    /// A cell, mostly of a map of these sides.
    pub(super) fn cell(&mut self, (width, height): (u32, u32)) -> Cell {
        let odd = [-1, i32::MIN, i32::MAX, 40_000];
        let rng = &mut self.rng;
        if rng.chance(3) {
            let mut any = || rng.pick(&odd).copied().unwrap_or_default();
            return Cell { x: any(), y: any() };
        }
        Cell { x: rng.below(width) as i32, y: rng.below(height) as i32 }
    }
}
