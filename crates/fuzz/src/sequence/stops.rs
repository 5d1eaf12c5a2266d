//! Work that is stopped at the n-th look at its deadline. What was there before stays, and goes on.

use mediant::{Error, ErrorCode, Space};

use super::{Run, wishes::NthLook};
use crate::bytes::Bytes;

impl Run {
    /// The result, unless the work was stopped; it must have been where somebody heard that time is over.
    fn unless_stopped<T>(&self, made: Result<T, Error>, look: &NthLook) -> Option<T> {
        let code = made.as_ref().err().map(Error::code);
        let expected = look.is_heard().then_some(ErrorCode::Stopped);
        self.check(code == expected, || format!("{code:?}, though {expected:?} was to be heard"));
        made.ok()
    }

    pub(super) fn stopped(&mut self, bytes: &mut Bytes<'_>) {
        let (what, look) = (bytes.below(6), NthLook::new(bytes));
        self.say(&format!("stopped {what} within {:?}", look.limits()));
        match what {
            0 => self.stopped_edit(bytes, &look),
            1 => {
                let made = self.space.within(look.limits()).prepare(self.setup.engine);
                if let Some(index) = self.unless_stopped(made, &look) {
                    self.index = index.with_smoothing(self.setup.smoothing);
                    self.planner = self.index.planner();
                }
            }
            2 => {
                let made = self.index.within(look.limits()).finish();
                if let Some(index) = self.unless_stopped(made, &look) {
                    self.index = index;
                    self.planner.follow(&self.index).unwrap_or_else(|error| panic!("{error}\n{}", self.text));
                }
            }
            3 => {
                let sources = self.free(bytes, 3);
                if sources.is_empty() {
                    return;
                }
                let made = self.space.within(look.limits()).field(sources.iter().copied());
                if let Some(field) = self.unless_stopped(made, &look) {
                    self.check_field(&field, &sources);
                }
            }
            4 => {
                let (starts, goals) = (self.free(bytes, 3), self.free(bytes, 3));
                let made = self.index.within(look.limits()).table(starts, goals);
                let gave_up = made.as_ref().is_err_and(|error| error.code() == ErrorCode::GaveUp);
                if !gave_up {
                    self.unless_stopped(made, &look);
                }
            }
            _ => {
                let Ok(whole) = self.index.to_bytes() else { return };
                let made = self.index.within(look.limits()).to_bytes();
                if let Some(bytes) = self.unless_stopped(made, &look) {
                    self.check(bytes == whole, || "the bytes of an index differ".to_owned());
                    let look = NthLook::new(&mut Bytes::new(&[bytes.len() as u8]));
                    let made = self.space.within(look.limits()).index_from_bytes(bytes);
                    self.unless_stopped(made, &look);
                }
            }
        }
    }

    /// An edit whose repair is stopped, and done again.
    fn stopped_edit(&mut self, bytes: &mut Bytes<'_>, look: &NthLook) {
        let cells = self.cells(bytes);
        self.say(&format!("cells {cells:?}"));
        let change = self.space.edit_cells(cells.iter().copied()).expect("cells of the map");
        let before: Space = self.space.clone();
        let made = self.index.within(look.limits()).repair(&change);
        let is_before = self.index.identity() == before.identity();
        self.check(is_before, || "the index is another one".to_owned());
        self.unless_stopped(made, look);
        self.follow(&change, &cells);
    }
}
