//! The errors of the library.

use std::{
    fmt,
    path::{Path, PathBuf},
};

#[cfg(feature = "walking")]
use mediant_costs::WalkingError;
#[cfg(feature = "costs")]
use mediant_costs::{CostsError, LandmarksError};
use mediant_formats::{IndexError, ReadError, RowsError, TileError, TilesError, WriteError};
use mediant_grid::{
    GridError, Interrupted, Mismatch, Rectangle, SizeError, StoppedBy, Vertex, names::UnknownName,
};
use mediant_hierarchy::HierarchyError;
use mediant_moves::KError;
use mediant_search::{BrokenPath, JumpError, Limit, QueryError};
use mediant_subgoal::{GoalsError, SubgoalError};

use crate::{
    call::CallError,
    option::{Levels, Memory},
    setup_error::SetupError,
    setup_error::TextError,
};

/// Why something cannot be made, read, written, or asked.
///
/// [`code`](Self::code) is a stable name for each kind of mistake, the same in all languages; the text says
/// what was expected, what was found, and what to do, and may be worded better in any version.
///
/// ```
/// use mediant::{Error, ErrorCode, Map};
/// let map = Map::from_rows(["..#", "..."])?;
/// let error = map.path((2, 0), (0, 0)).unwrap_err();
/// assert_eq!((error.code(), error.code().name()), (ErrorCode::StartBlocked, "start-blocked"));
/// assert_eq!(error.to_string(), "the start (2, 0) is blocked: choose a free vertex");
/// # Ok::<(), Error>(())
/// ```
///
/// `{:?}` shows the code and the text, too, since that is what a program prints that ends with an error:
///
/// ```
/// use mediant::{Error, Map};
/// fn main() -> Result<(), Error> {
///     let map = Map::new(8, 8)?;
///     let error = map.path((0, 0), (8, 8)).unwrap_err();
///     assert!(format!("{error:?}").starts_with("goal-outside: the goal (8, 8) is outside the map"));
///     Ok(())
/// }
/// ```
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Work that a flag or a deadline stopped: see [`Within`](crate::Within).
    #[error("{} while {during}", if *by == Limit::Cancelled { "cancelled" } else { "out of time" })]
    Stopped {
        /// The cause.
        by: Limit,
        /// The stage, such as 'finding dead ends'.
        during: &'static str,
    },
    /// A map that cannot be made.
    #[error(transparent)]
    Grid(GridError),
    /// A character in the rows of a map that is neither free nor blocked.
    #[error(transparent)]
    Tile(TileError),
    /// Characters that cannot be free or blocked.
    #[error(transparent)]
    Tiles(#[from] TilesError),
    /// An edit outside the map.
    #[error("an edit of {at}, outside the map of {} × {} cells: name cells of the map", size.0, size.1)]
    Edit {
        /// The rectangle.
        at: Rectangle,
        /// The width and the height of the map.
        size: (u32, u32),
    },
    /// An edit of a cell outside the map.
    #[error("an edit of cell {cell}, outside the map of {} × {} cells: name cells of the map", size.0, size.1)]
    EditCell {
        /// The cell.
        cell: Vertex,
        /// The width and the height of the map.
        size: (u32, u32),
    },
    /// Costs of cells that cannot be.
    #[cfg(feature = "costs")]
    #[error(transparent)]
    Costs(CostsError),
    /// A raster of another size than the map.
    #[cfg(feature = "rasters")]
    #[error(
        "{} columns and {} rows of numbers, and the map has {} and {}: give one number for each cell",
        found.0, found.1, expected.0, expected.1
    )]
    OtherSize {
        /// The columns and the rows of the raster.
        found: (u32, u32),
        /// The columns and the rows of the map.
        expected: (u32, u32),
    },
    /// A raster in longitudes and latitudes.
    #[cfg(feature = "rasters")]
    #[error(
        "the coordinates are degrees, and the width of a cell differs from row to row: project it to meters \
         first, as by `gdalwarp -t_srs EPSG:3857`, or better by a projection that keeps lengths there"
    )]
    Degrees,
    /// A raster of elevations that does not state the size of a cell, by which slopes are measured.
    #[cfg(feature = "rasters")]
    #[error(
        "the raster does not state the size of its cells: give it with one, as a GeoTIFF or an ESRI ASCII grid has it"
    )]
    NoCellSize,
    /// Elevations or frictions of cells, or a pace, that cannot be; fields over elevation that do not go
    /// together.
    #[cfg(feature = "walking")]
    #[error(transparent)]
    Walking(WalkingError),
    /// A cell that is freed in a space with costs, without a cost.
    #[error(
        "cell {cell} is freed, and has no cost: give it one, as in `space.edit_costs([(cell, Some(1.0))])`"
    )]
    Freed {
        /// The cell.
        cell: Vertex,
    },
    /// An agent without a size.
    #[error(transparent)]
    Size(SizeError),
    /// A parameter of a call with a value that it cannot have.
    #[error(transparent)]
    Call(#[from] CallError),
    /// A path that does not hold on a map.
    #[error(transparent)]
    Broken(#[from] BrokenPath),
    /// A number that is no k.
    #[error(transparent)]
    K(#[from] KError),
    /// The name of an engine, or of a value of an option, that does not exist.
    #[error(transparent)]
    Name(#[from] UnknownName),
    /// A text that is no setup.
    #[error(transparent)]
    Text(#[from] TextError),
    /// An engine with options, a k or rules that it does not take, or asked for what it does not have.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// Two things that do not belong together: of another map, placement, rule or k.
    #[error(transparent)]
    Mismatch(#[from] Mismatch),
    /// An invalid query, or one at which the engine gave up.
    #[error(transparent)]
    Query(#[from] QueryError),
    /// A jump table that cannot be made or read.
    #[error(transparent)]
    Jump(JumpError),
    /// A subgoal graph that cannot be made or read.
    #[error(transparent)]
    Subgoal(SubgoalError),
    /// A graph of clusters or segments that cannot be made, repaired or read.
    #[error(transparent)]
    Hierarchy(HierarchyError),
    /// A saved index with other levels than the setup names.
    #[error(
        "needs an index with {}, found one with {}; choose the levels that it has, or prepare it again",
        expected.in_words(),
        found.map_or_else(|| "no subgoals".to_owned(), Levels::in_words)
    )]
    Levels {
        /// The levels of the setup.
        expected: Levels,
        /// The levels of the index; `None` for one of subgoals that kept [none](crate::Index::searched_by).
        found: Option<Levels>,
    },
    /// A saved index of clusters or segments of another size than the setup names.
    #[error(
        "needs an index whose clusters or segments have {expected} × {expected} cells, found one with \
         {found} × {found}; choose the side that it has, or prepare it again"
    )]
    Side {
        /// The side of the setup, in cells.
        expected: u32,
        /// The side of the index, in cells.
        found: u32,
    },
    /// A saved index with another number of landmarks than the setup names.
    #[error(
        "needs an index with {expected} landmarks, found one with {found}; choose the number that it has, or \
         prepare it again"
    )]
    LandmarkCount {
        /// The number of landmarks that are made for that of the setup.
        expected: u32,
        /// The number in the index.
        found: u32,
    },
    /// Landmarks that cannot be made or read.
    #[cfg(feature = "costs")]
    #[error(transparent)]
    Landmarks(LandmarksError),
    /// A saved index with hub labels that take more memory than the setup allows.
    #[error(
        "needs hub labels of at most {most}, found {found} in the index; allow more memory, or prepare it again"
    )]
    Memory {
        /// The most memory that the setup allows.
        most: Memory,
        /// The memory of the labels.
        found: Memory,
    },
    /// Memory that there is not.
    #[error(
        "there is no room for {what}, which takes {} MB: choose an engine that takes less, or free some memory",
        .bytes.div_ceil(1_000_000)
    )]
    OutOfMemory {
        /// `the planner` or `the index`, say, which needs it.
        what: &'static str,
        /// How much it needs, in bytes.
        bytes: u64,
    },
    /// Numbers of cells for which there is no memory.
    #[error(
        "there is no room for the numbers of {} × {} cells, which take {} MB: cut the raster, take larger cells, or \
         free some memory",
        size.0, size.1, .bytes.div_ceil(1_000_000)
    )]
    NoRoom {
        /// The columns and the rows.
        size: (u32, u32),
        /// The bytes that they need.
        bytes: u64,
    },
    /// Bytes that are no saved index, or one of another engine or version.
    #[error(transparent)]
    IndexFile(IndexError),
    /// A file that cannot be read.
    #[error(transparent)]
    Read(ReadError),
    /// An index or a raster in a file that cannot be used: its own error, and which file it is.
    #[error("{}: {source}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// The error of what is in it.
        source: Box<Error>,
    },
    /// A file that cannot be written.
    #[error(transparent)]
    Write(WriteError),
}

/// As `start-blocked: the start (2, 0) is blocked: choose a free vertex`.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {self}", self.code())
    }
}

impl From<Interrupted> for Error {
    fn from(Interrupted { by, during }: Interrupted) -> Self {
        match by {
            StoppedBy::Memory { bytes } => Self::OutOfMemory { what: "what is made of the map", bytes },
            by => Self::Stopped { by: by.into(), during },
        }
    }
}

impl From<GridError> for Error {
    fn from(error: GridError) -> Self {
        match error {
            GridError::Interrupted(interrupted) => interrupted.into(),
            error => Self::Grid(error),
        }
    }
}

impl From<SizeError> for Error {
    fn from(error: SizeError) -> Self {
        match error {
            SizeError::Interrupted(interrupted) => interrupted.into(),
            error => Self::Size(error),
        }
    }
}

impl From<GoalsError> for Error {
    fn from(error: GoalsError) -> Self {
        match error {
            GoalsError::Query(error) => error.into(),
            GoalsError::Interrupted(interrupted) => interrupted.into(),
        }
    }
}

impl From<WriteError> for Error {
    fn from(error: WriteError) -> Self {
        match error {
            WriteError::Interrupted(interrupted) => interrupted.into(),
            error => Self::Write(error),
        }
    }
}

impl From<ReadError> for Error {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::Interrupted(interrupted) => interrupted.into(),
            error => Self::Read(error),
        }
    }
}

/// Whatever has a mismatch or an interruption inside is one.
macro_rules! from_errors {
    ($($variant:ident: $source:ident),+) => {
        $(impl From<$source> for Error {
            fn from(error: $source) -> Self {
                match error {
                    $source::Mismatch(mismatch) => Self::Mismatch(mismatch),
                    $source::Interrupted(interrupted) => interrupted.into(),
                    other => Self::$variant(other),
                }
            }
        })+
    };
}

from_errors!(Jump: JumpError, Subgoal: SubgoalError, Hierarchy: HierarchyError, IndexFile: IndexError);
#[cfg(feature = "costs")]
from_errors!(Landmarks: LandmarksError);

#[cfg(feature = "costs")]
impl From<CostsError> for Error {
    fn from(error: CostsError) -> Self {
        match error {
            CostsError::Interrupted(interrupted) => interrupted.into(),
            error => Self::Costs(error),
        }
    }
}

impl From<RowsError> for Error {
    fn from(error: RowsError) -> Self {
        match error {
            RowsError::Tile(error) => Self::Tile(error),
            RowsError::Grid(error) => Self::Grid(error),
        }
    }
}

impl Error {
    /// This error of what is in a file.
    pub(crate) fn in_file(self, path: &Path) -> Self {
        if matches!(self, Self::Stopped { .. }) {
            return self;
        }
        Self::InFile { path: path.to_owned(), source: Box::new(self) }
    }
}
