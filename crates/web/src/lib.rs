//! The compiled part of the npm package `mediant`: the library for JavaScript and TypeScript, by WebAssembly.
//! It has names, conversions and words, and no algorithm.
//!
//! - `arguments`: what a call was given: points, numbers, bytes, objects of our classes; `keywords`: objects
//!   of motion, wishes and options. Each mistake names its argument.
//! - `grid`, `space`, `index`, `planner`, `trace`: the classes; `module`: functions that need no map.
//! - `agents`, `exceptions`, `field`, `goals`, `picture`, `posthoc`, `saved`, `scenario`, `world`: with the
//!   feature `full` further classes, and methods of those above.
//! - `answer`: what goes out; `types`: the types of plain objects, for `mediant.d.ts`.
//! - `errors`: the library's errors as those of JavaScript; `memory`: whether there is room.
//! - `clock`: the time, which the library does not read.
//!
//! # The key decision: nothing traps
//!
//! WebAssembly has no way back from a panic: the instance is lost with all its objects, and a page with it.
//! So nothing that a page gives may lead to one.
//!
//! - Every argument comes in as a value of JavaScript and is looked at here. wasm-bindgen's own conversions
//!   would be silent: `undefined` to 0, -1 to 4,294,967,295.
//! - Objects of our classes come in through `arguments::object`, which takes a second handle by a method that
//!   the type declarations do not show. wasm-bindgen's own way takes the object away from its owner, or
//!   throws an error without a name and a code. So every class is a handle (`Arc`, `Rc`), and what can be
//!   called back into while it works (a getter, a clock) is borrowed with a check.
//! - Memory is asked for before it is needed (`memory`), by what a vertex takes at most.
//!
//! A query's answer is made through setters, and points are read without iterators: on an index a search
//! takes ten microseconds, and the bindings should take fewer.
//!
//! # Threads
//!
//! There are none: a page that must not wait loads the package in a worker. The library's feature `parallel`
//! is off, and an index goes from worker to worker as bytes.

#![cfg_attr(not(feature = "full"), expect(dead_code, reason = "what the other modules share"))]

#[cfg(feature = "full")]
mod agents;
mod answer;
mod arguments;
mod clock;
#[cfg(feature = "full")]
mod costs;
mod errors;
#[cfg(feature = "full")]
mod exceptions;
#[cfg(feature = "full")]
mod field;
mod follow;
#[cfg(feature = "full")]
mod goals;
mod grid;
mod index;
mod keywords;
mod listening;
mod memory;
mod module;
#[cfg(feature = "full")]
mod picture;
mod planner;
#[cfg(feature = "full")]
mod posthoc;
mod prepare;
#[cfg(feature = "full")]
mod saved;
#[cfg(feature = "full")]
mod scenario;
mod space;
mod trace;
mod types;
#[cfg(feature = "full")]
mod world;

pub use grid::Grid;
pub use index::Index;
pub use module::{bound, check_setup, engines, moves, spaced, version};
pub use planner::Planner;
pub use space::Space;
pub use trace::Trace;
#[cfg(feature = "full")]
pub use {field::Field, goals::Goals, picture::Picture, scenario::Scenario, world::World};
