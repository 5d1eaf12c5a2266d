//! Least-cost paths, and fields of least costs, over the 2^k neighborhoods on grids whose cells have a cost.
//!
//! A cell has a cost a unit of length. A move costs the integral along its segment: the sum, over the cells
//! that it crosses, of the length in the cell times the cell's cost. This is what `MCP_Geometric` of
//! scikit-image, the cost distance of ArcGIS and `r.cost` of GRASS compute for 8 neighbors, and `r.cost -k`
//! for 16. Here it is defined for every k, at centers and at corners.
//!
//! - [`CostSurface`] is the surface ([`CostUnits`] say what its integers stand for), [`CostGraph`] its search
//!   graph under rules of motion and N(k).
//! - [`CostField`] has the cost of every vertex to the nearest of one or many sources, with limit,
//!   allocation, directions, paths and corridors. It is [repaired](CostField::repaired) after an edit.
//! - [`CostAStar`] finds one path after another; with [`Landmarks`], the index, several times as fast.
//! - [`CostTheta`] finds paths of straight segments at any angle, none dearer than the least cost over N(k);
//!   [`smooth`] makes a path one.
//! - [`Costmap`] is a robot's costmap, with the inflation of nav2.
//! - [`WalkingMap`], [`WalkingGraph`], [`WalkingField`] and [`WalkingAStar`] are the same for walking over
//!   elevation, where a move and the one back cost different times.
//!
//! **The key decision: costs are integers here, too.** The sum of shares times weights is exact, its product
//! with the length of a share is rounded once (module `moves`), and all else is integer sums. So results do
//! not depend on the order of work, nor on the platform; and where all cells cost 1 they are those of
//! `mediant-search`, to the last bit. The unit follows the map (module `scale`).
//!
//! **What takes long** takes an [`Interrupt`](mediant_grid::Interrupt), which stops it. Fields and landmarks
//! tell their [progress](mediant_grid::Interrupt::progress) to its listener: a field how many vertices have
//! their cost, at most some hundred times, on the thread that called it. Nobody needs to listen, and then
//! nothing is counted. The memory of a field is known before it is made ([`CostField::bytes`]).
//!
//! The promise is the least cost over N(k) on the raster. No bound against all paths is known.
//!
//! Not here: the engines for maps on which all cells cost the same, which are many times as fast there, and
//! of which nothing is compiled here but the words of queries and answers.

mod astar;
mod best_first;
mod costmap;
mod error;
mod field;
mod gaps;
mod graph;
mod guide;
mod landmarks;
mod layout;
mod line;
mod moves;
mod near;
#[cfg(doctest)]
mod readme;
mod scale;
mod scan;
mod surface;
mod theta;
mod walking;

pub use astar::CostAStar;
pub use costmap::{Costmap, Inflation, Traversal};
pub use error::{CostFieldError, CostsError};
pub use field::{CostField, CostFieldQuery, DirectionCode};
pub use graph::CostGraph;
pub use landmarks::{Landmarks, LandmarksError};
pub use surface::{CostSurface, CostUnits};
pub use theta::{CostTheta, smooth};
pub use walking::{
    Heading, Langmuir, Pace, WalkingAStar, WalkingBounds, WalkingError, WalkingField, WalkingGraph,
    WalkingMap,
};
