//! The library `mediant` for C, and for whatever calls C: `libmediant`, with the header `mediant.h`.
//!
//! It has no algorithm: each function converts its arguments, asks the library, and converts the answer.
//!
//! - **Handles are numbers** (module `handles`): what a program holds of a map or a planner is a place in a
//!   table, and how often that was taken. So one that is null, made up, freed, or of another type is an
//!   error, and so is a planner that another thread uses: nothing that a program does with handles can
//!   crash. Only pointers to texts and arrays have to be trusted, beyond null and misaligned ones (module
//!   `memory`).
//! - **Every function returns a code**, 0 if it did what it should, and else that of the library's error;
//!   `mediant_message` has the sentence. Results are written to pointers, the last arguments.
//! - **Parameters are a text**, as `"k=any gap=closed"`, by the names and values that all languages have
//!   (module `words`).
//! - **Whose memory it is**: arrays are the caller's, but for those of a batch and of bytes, which stay until
//!   these are freed. A text that is returned stays for ever, but for `mediant_message`.
//! - **No panic crosses** to the caller (`failure::call`).

pub mod about;
pub mod answer;
pub mod batch;
pub mod bytes;
pub mod code;
pub mod failure;
pub mod field;
pub mod find;
pub mod goals;
mod handles;
pub mod index;
pub mod map;
mod memory;
pub mod paths;
pub mod planner;
pub mod points;
pub mod space;
pub mod watch;
mod words;

#[cfg(test)]
mod calls;
#[cfg(test)]
mod header;
#[cfg(test)]
mod mistakes;
