//! Calls that may fail, and what is told of it.

#![allow(unsafe_code, reason = "functions of C")]

use std::{
    cell::RefCell,
    ffi::{CStr, c_char},
    panic::{AssertUnwindSafe, catch_unwind},
};

use library::{Error, call::Spelling, errors::SetupError};

use crate::code::Code;

/// A mistake, as a function returns it.
#[derive(Debug)]
pub(crate) struct Failure {
    pub(crate) code: Code,
    pub(crate) text: String,
}

impl Failure {
    /// A mistake of an argument, by its name.
    pub(crate) fn argument(name: &str, wrong: &str) -> Self {
        Self { code: Code::Argument, text: format!("{name}: {wrong}") }
    }

    /// This mistake, where what the library calls starts are sources.
    pub(crate) fn of_sources(self) -> Self {
        let text = self.text.replacen("the start", "the source", 1).replacen("no start", "no source", 1);
        Self { text, ..self }
    }

    /// A panic.
    pub(crate) fn fault() -> Self {
        let text = "a fault in the library: please report it, with the call".to_owned();
        Self { code: Code::Other, text }
    }
}

impl<E: Into<Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        let error = error.into();
        // The library's advice in the words of Rust, in those of C.
        let text = match &error {
            Error::Call(wrong) => wrong.text(Spelling::Snake),
            Error::Freed { cell } => {
                format!("cell {cell} is freed, and has no cost: free it by mediant_map_edit_costs, with one")
            }
            Error::Setup(SetupError::WithoutCosts) => {
                "the cells of this map have no costs: give them some by mediant_map_costs".to_owned()
            }
            error => error.to_string(),
        };
        Self { code: error.code().into(), text }
    }
}

/// The bytes of the longest sentence, and its end. Longer ones are cut off.
const ROOM: usize = 1024;

thread_local! {
    /// The sentence about the last mistake. It is written over, never moved: a pointer to it that is too old
    /// leads to a later sentence.
    static MESSAGE: RefCell<[u8; ROOM]> = const { RefCell::new([0; ROOM]) };
}

/// Does the work of a call, and returns its code. No panic crosses to the caller, who could not go on after
/// it.
#[inline]
pub(crate) fn call(work: impl FnOnce() -> Result<(), Failure>) -> Code {
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => Code::Ok,
        Ok(Err(failure)) => remember(failure),
        Err(_) => remember(Failure::fault()),
    }
}

#[cold]
fn remember(Failure { code, text }: Failure) -> Code {
    let kept = (0..=text.len().min(ROOM - 1)).rev().find(|&end| text.is_char_boundary(end)).unwrap_or(0);
    // Where a thread is ending, nobody can ask any more.
    _ = MESSAGE.try_with(|message| {
        let mut message = message.borrow_mut();
        // A text of C ends at its first 0.
        let letters = text[..kept].bytes().map(|letter| if letter == 0 { b' ' } else { letter });
        message.iter_mut().zip(letters.chain([0])).for_each(|(place, letter)| *place = letter);
    });
    code
}

/// The sentence about the last mistake in this thread: it says what to do. Empty before the first one. The
/// next mistake in this thread writes over it.
#[unsafe(no_mangle)]
pub extern "C" fn mediant_message() -> *const c_char {
    MESSAGE.try_with(|message| message.borrow().as_ptr().cast()).unwrap_or(c"".as_ptr())
}

/// The name of a code, the same in all languages, such as `start-blocked`; null for a number that is none. It
/// stays for ever.
#[unsafe(no_mangle)]
pub extern "C" fn mediant_code_name(code: i32) -> *const c_char {
    let known = Code::ALL.iter().find(|known| **known as i32 == code);
    known.map_or(std::ptr::null(), |known| CStr::as_ptr(known.name()))
}
