//! Distance fields: from one search the distance of every vertex to the nearest of one or many sources, with
//! the paths and directions out of it. One goal for many agents (a flow field), what is within reach (a
//! movement range), and distances for what is computed outside.
//!
//! A legal move is legal in reverse, and so is a path. So 'from the sources' and 'to the sources' are the
//! same.
//!
//! # Over N(k)
//!
//! [`Fields`] makes a [`Field`] for every k, both placements and all rules of motion. It is Dijkstra's
//! algorithm, with three changes.
//!
//! - **Buckets instead of a heap** (Dial 1969). Costs are integers, and no move is shorter than 1 cell. With
//!   buckets one cell wide (k ≥ 4), a step leads from a bucket to a later one. So what a bucket holds when it
//!   is opened is final, in any order, and each vertex is expanded once.
//! - **Canonical pruning** ([`Pruning`](crate::Pruning)): on open ground each vertex is reached once, not by
//!   2^k moves. The proof (module `canonical`) orders all paths to a vertex from their ends; it needs neither
//!   a goal nor a single start. A path with a lower rank replaces one of the same cost.
//! - **Runs** (k ≤ 3). Buckets are eight cells wide, and a path is followed straight on to the end of its
//!   bucket, over open ground by words. A vertex may then be expanded before its distance is final; it is
//!   expanded again when a shorter or an earlier path is found. That does not change what is found: in the
//!   proof each vertex on the earliest path gets its final label at some time, and is expanded after that.
//!   A bucket is left when nothing in it is to be expanded, and no step leads back to an earlier one.
//!
//! Ties: distances do not depend on them. Directions follow from the distances by an order of their own: see
//! [`Field`]. Closed gaps: module `gaps`.
//!
//! # At any angle, at corners
//!
//! [`AnyAngleFields`] makes an [`AnyAngleField`]: each vertex's true shortest distance. A shortest path bends
//! only at convex corners of obstacles, around them. So the field is Dijkstra's algorithm over its *roots*,
//! the sources and the corners where paths bend, in the order of their distance; and each root labels the
//! vertices that it sees, with its own distance and that of the straight line. It does not look everywhere:
//!
//! - **Taut paths alone.** A path that bends at a corner leaves it between straight on and the edge of the
//!   obstacle: within one quadrant. One cone a blocked cell, so one a root, or two at an open gap.
//! - **Not where others are nearer.** Within the cone, the root follows the part of a line that it sees, from
//!   line to line, as Anya does (the ends are exact: [`mediant_grid::sight`]). From both ends of that part
//!   it leaves out what is farther by this root than by known paths, and with it all that lies behind
//!   (module `cone` says by which margin, and why no shortest path is lost).
//!
//! **Why it is exact.** Take a shortest path from a source to a vertex v, with as few bends as possible. By
//! induction along it, each bend has its true distance when it is settled: no root that is settled later is
//! nearer. It may have it by another path of the same length, which comes from another direction. The path to
//! v then leaves the bend within the cone of that one too: if it did not, it could be pulled tighter there,
//! and would be no shortest path. So the bend's cone holds the next bend or v; and the straight line to that
//! is left out on no line that it crosses, since only what is farther by a margin is left out, and rounding
//! is far below this margin. ∎
//!
//! **Sources between vertices** are roots like all others: a root is a place of the map, in parts of a cell
//! ([`mediant_grid::sight`]). It has a number, by which vertices name the next root on their way: that of its
//! vertex, or, for the nth source that is no vertex, the number of vertices plus n. No bend is such a root.
//! A field holds the distances of vertices alone. That of a point between them, when it is asked for, is the
//! least over what the point sees (module `sight`).
//!
//! # After a change of the map
//!
//! Over N(k) a field follows a change by work that follows the vertices whose distances change: module
//! `repair`. At any angle what a corner labels reaches as far as it sees, and which corners see a changed
//! cell is not stored. So there a field is kept where no path in it comes near the change, and else made
//! anew.
//!
//! A query a vertex costs a search each; the field costs a few steps a vertex: see
//! `docs/measurements/search.md`.

mod any_angle;
mod buckets;
mod cone;
mod costs;
mod gaps;
mod grid_graph;
mod lengths;
mod open_ground;
mod query;
mod repair;
mod sight;

pub use any_angle::AnyAngleFields;
pub use costs::Field;
pub use grid_graph::Fields;
pub use lengths::AnyAngleField;
pub use query::{FieldError, FieldQuery};
