//! Reads and writes maps as people have them: MovingAI maps, pictures, ROS maps; and scenarios. Features add
//! PNG, saved indexes, search traces, pictures of maps with paths, and rasters of numbers.
//!
//! [`read_map`] takes a file of any kind, told by its content, and gives a [`Grid`](mediant_grid::Grid):
//!
//! | file | type | its grid |
//! |---|---|---|
//! | MovingAI `.map` | [`MapFile`] | `.`, `G` and `S` are free: [`Tiles`] |
//! | PGM and PBM, P1, P2, P4, P5; PNG | [`Raster`] | dark and transparent pixels are blocked: [`MapOptions`] |
//! | ROS `map_server`: YAML, picture | [`RosMap`] | free cells by [`RosVersion`]; meters by [`WorldFrame`] |
//!
//! [`read_map_with`] does so where files are not on a disk, and [`map_size_with`] only looks at the header.
//!
//! ```no_run
//! use mediant_formats::{MapOptions, read_map};
//! let map = read_map("depot.yaml", &MapOptions::default())?;
//! let start = map.frame.and_then(|frame| frame.cell_at(1.25, -0.5));
//! # Ok::<(), mediant_formats::ReadError>(())
//! ```
//!
//! A `Surface` has a number a cell, as costs and heights are: from NPY, an ESRI ASCII grid, PGM, PNG or
//! GeoTIFF by `read_surface`, and written to each, with its place in the world where the format has one.
//!
//! A [`Scenario`] has queries on one map, a [`DynamicScenario`] those on a map that changes between them: one
//! of the Grid-Based Path Planning Competition, made of patches.
//!
//! **The key decision for MovingAI files: a parsed file keeps its bytes.** [`MapFile`] and [`Scenario`] hold
//! the text from which they were parsed beside what the parser found in it. So writing gives back every byte:
//! line ends, the order of the header, separators, the digits of a length. A parser that kept these as
//! properties could forget one. A map made from a grid, or a scenario made from a list of queries, gets its
//! text at once, in the plainest form.
//!
//! **That for pictures: no shade is rounded.** A [`Raster`] keeps the sum of a pixel's colours, and a
//! threshold is a [`Fraction`]. They are compared as whole numbers, so a pixel at a threshold is on the same
//! side of it on every platform. (ROS 2 compares in single precision, which is the same everywhere, too.)
//!
//! Input is not trusted: memory grows with the bytes that a file has, never with the sizes that it states. A
//! picture, which may be compressed, has at most [`Raster::MAX_PIXELS`] pixels, and a `Surface` at most the
//! bytes that its reader allows. Each error says where it is
//! (of a text the line, and the column in bytes, both from 1), what was expected, what was found, and how to
//! mend it.
//!
//! The formats of maps and scenarios are those of Sturtevant, *Benchmarks for Grid-Based Pathfinding* (2012);
//! of PGM and PBM, those of the manual pages of Netpbm; of PNG, that of its specification (W3C, third
//! edition), by the crate `png`; of ROS maps, what the `map_server` of nav2 reads today, or that of ROS 1; of
//! NPY, that of NumPy's NEP 1; of GeoTIFF, TIFF 6.0 and BigTIFF, by the crate `tiff`, with the tags of
//! GeoTIFF 1.1.
//!
//! | feature | adds | compiles in addition |
//! |---|---|---|
//! | none | [`MapFile`], [`Scenario`], [`DynamicScenario`], [`Raster`] of PGM and PBM, [`RosMap`] | `mediant-grid`, `thiserror` |
//! | `save` | `NewFile`: a file that is written whole or not at all; `RosMap::save` | `tempfile` |
//! | `index` | `IndexFile`: what an engine preprocessed, saved for later runs; `save` | `sha2` |
//! | `png` | PNG wherever there are pictures | `png` |
//! | `picture` | `Picture`: a map with paths, a field, a search, as PNG and SVG; `save` | `png` |
//! | `surface` | `Surface`: a number a cell, of NPY, ESRI ASCII grids, PGM, and PNG if it is on | – |
//! | `geotiff` | GeoTIFF for them; `surface` | `tiff` |
//! | `trace` | `TraceWriter`: a search, for the Posthoc visualizer | `serde`, `serde_json` |
//!
//! No feature is on by default, and none changes what is there without it.
//!
//! Not here: searches and engines. Indexes, traces and pictures are made of names, numbers and bytes. It is
//! not checked whether a query's start or goal is free, since that depends on where the vertices are.

mod dynamic;
mod foreign;
mod fraction;
#[cfg(feature = "index")]
mod index;
mod map;
#[cfg(feature = "picture")]
mod picture;
mod raster;
mod read;
#[cfg(doctest)]
mod readme;
mod ros;
#[cfg(feature = "save")]
mod save;
mod scenario;
mod source;
#[cfg(feature = "surface")]
mod surface;
mod text;
#[cfg(feature = "trace")]
mod trace;
mod world;

pub use dynamic::{
    DynamicError, DynamicEvent, DynamicQuery, DynamicScenario, Optimal, Patch, PatchError, PlacedPatch,
};
pub use fraction::{Fraction, FractionError};
#[cfg(feature = "index")]
pub use index::{IndexError, IndexFile, IndexKey};
pub use map::{Ground, MapError, MapFile, RowsError, TileError, Tiles, TilesError};
#[cfg(feature = "picture")]
pub use picture::{Picture, PictureError};
pub use raster::{MapOptions, Raster, RasterError, RasterFormat, RosVersion, Unknown};
pub use read::{MAX_FILE_BYTES, ReadError};
pub use ros::{RosError, RosMap, RosMode, RosSettings};
#[cfg(feature = "save")]
pub use save::{NewFile, WriteError};
pub use scenario::{Instance, MapMismatch, Scenario, ScenarioError, scenario_tolerance};
pub use source::{MapFormat, MapSource, map_size_with, read_map, read_map_interruptible, read_map_with};
#[cfg(feature = "geotiff")]
pub use surface::{GeoTiffOptions, TiffCompression};
#[cfg(feature = "surface")]
pub use surface::{
    Georeference, Samples, Surface, SurfaceError, SurfaceFormat, SurfaceOptions, read_surface,
    read_surface_interruptible, surface_size,
};
#[cfg(feature = "trace")]
pub use trace::{TraceEvent, TraceEventKind, TraceHeader, TraceWriter};
pub use world::{WorldError, WorldFrame};
