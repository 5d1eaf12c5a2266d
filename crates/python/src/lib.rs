//! The compiled part of the Python package `mediant`: arrays of NumPy in, arrays out, the library `mediant`
//! in between. It has names, conversions and words, and no algorithm.
//!
//! - `arguments`: what a call was given: points, numbers, the keywords of motion, wishes and options. Each
//!   mistake names its argument.
//! - `grid`, `index`, `field`, `world`, `scenario`: the classes. All are frozen, so threads share them.
//! - `answer`, `paths`, `spaced`: what `find` and batches answer, and points along a path.
//! - `arrays`, `costs`, `walking`: maps, costs and elevations from arrays, and arrays from them and paths.
//! - `background`: the GIL is released wherever the library works; Ctrl-C is looked at while it does.
//! - `errors`: the library's errors as exceptions.
//!
//! # Points
//!
//! Python has (row, column), the library (x, y). They are exchanged where a point comes in (`arguments`),
//! where it goes out (`arrays`; in `field`, `world`, `spaced` and `moves` beside the values they make), and
//! in the text of an error (`errors`).
//!
//! # Time
//!
//! A query on an index of a small map takes microseconds: it runs on the caller's thread with the GIL
//! released. A longer call is watched. A search has a deadline that the library asks for every 64 expansions,
//! which looks at the clock, and every 20 ms for signals. Other work (preparation, fields, batches) runs on a
//! thread of its own, and the caller's thread looks. An interruption sets the flag that stops the work, and
//! is raised when the work has ended.
//!
//! Each call that works on all cores makes a pool of threads of its own. A process that was forked has no
//! threads of its parent's, and would wait forever for those of a shared pool.

mod answer;
mod arguments;
mod arrays;
mod background;
mod batch;
mod costs;
mod errors;
mod field;
mod grid;
mod index;
mod keywords;
mod module;
mod paths;
mod scenario;
mod spaced;
mod walking;
mod world;
