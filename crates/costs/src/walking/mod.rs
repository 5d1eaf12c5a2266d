//! Walking over elevation: costs that depend on the direction of a move.
//!
//! A cell has an elevation, that of its center; between four centers the ground is bilinear. A move is cut
//! where it crosses the lines that join the centers of neighboring cells. Each piece has its own slope, from
//! end to end, and takes the time of the [`Pace`] on that slope. The friction of a cell counts along the
//! length in it. So a straight or a diagonal move, which is one piece, costs what it costs `r.walk` of GRASS:
//! its time, plus lambda times the mean friction times the length.
//!
//! Longer moves cost what the ground below them does. `r.walk -k` takes the slope of a knight's move from end
//! to end, and passes a ridge of one cell as if it were not there (75 s in place of 112 s, measured): on
//! rough ground its times fold along these moves. What is left here is the polygon of N(k), of 2.5 % at k =
//! 4, 1.2 % at k = 5, and 0.7 % at k = 6 on a slope with friction; friction once a move, whatever its length,
//! would make it 15.6 % at k = 4.
//!
//! Costs are exact integers here, too, and the same on every platform: elevations, slopes and times are
//! integers (see [`WalkingMap`]). The times come from arithmetic that IEEE 754 rounds alike everywhere and
//! from the `exp` of the crate `libm`. The cost of a move is rounded once.

mod astar;
mod error;
mod field;
mod graph;
mod map;
mod moves;
mod pace;
mod table;

pub use self::{
    astar::WalkingAStar,
    error::WalkingError,
    field::{Heading, WalkingField},
    graph::WalkingGraph,
    map::{WalkingBounds, WalkingMap},
    pace::{Langmuir, Pace},
};
