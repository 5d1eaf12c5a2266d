//! Scenarios of maps that change, `.scen` of version 2 with a file of patches: those of the Grid-Based Path
//! Planning Competition, dynamic track.

pub(crate) mod error;
pub(crate) mod parse;
mod patch;

use std::{path::Path, sync::Arc};

use mediant_grid::{Change, Grid, Interrupt, Vertex, uninterrupted};

pub use error::{DynamicError, PatchError};
pub use patch::{Patch, PlacedPatch};

use crate::read::{ReadError, grid_of_checked_sides, read_regular};

/// A map that changes, and the queries between its changes, in the order of the file.
///
/// The header has the lines `version 2`, `height N`, `width N`, `cost N NAMES` and `patch FILE`, in any order
/// after the first, then `commands`. Each further line puts a patch on the map, `P bucket patch x y`, or asks
/// for a path, `Q bucket x y x y` from start to goal, with the known costs after it, one for each name. The
/// map begins without obstacles; the patches before the first query make the [map](Self::grid) for which an
/// engine prepares. The file of patches is beside the scenario, in the folder that has it.
///
/// Coordinates of a query may lie outside the map; a patch that reaches beyond it is an error.
///
/// ```
/// use std::sync::Arc;
/// use mediant_formats::{DynamicEvent, DynamicScenario, Optimal, Patch};
/// use mediant_grid::Change;
///
/// let patches = b"type patch\npatches 2\npatch 0\nheight 2\nwidth 1\nmap\n@\n@\n\
///                 patch 1\nheight 1\nwidth 1\nmap\n.\n";
/// let text = b"version 2\nheight 2\nwidth 3\ncost 1 octile\npatch hall.patch\ncommands\n\
///              P 0 0 1 0\nQ 0 0 0 2 0 -1\nP 1 1 1 1\nQ 1 0 1 2 1 2\n";
/// assert_eq!(DynamicScenario::patch_file(text)?, "hall.patch");
/// let scenario = DynamicScenario::parse(text, &Patch::parse_all(patches)?)?;
/// let mut grid = Arc::new(scenario.grid());
/// for event in scenario.events() {
///     match event {
///         DynamicEvent::Patch(placed) => {
///             let change = Change::new(grid).edit(placed.rectangle(), |x, y| placed.is_blocked(x, y));
///             grid = Arc::clone(change.after());
///         }
///         DynamicEvent::Query(query) => {
///             let is_open = grid.is_free(1, 1);
///             assert_eq!(query.optimal, if is_open { Optimal::Length(2.0) } else { Optimal::NoPath });
///         }
///     }
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct DynamicScenario {
    width: u32,
    height: u32,
    initial: Vec<PlacedPatch>,
    events: Vec<DynamicEvent>,
}

/// A line of a scenario of a map that changes.
#[derive(Clone, Debug, PartialEq)]
pub enum DynamicEvent {
    /// The cells of a patch take the place of those of the map. Patches without a query between them are one
    /// change.
    Patch(PlacedPatch),
    /// A path is asked for.
    Query(DynamicQuery),
}

/// One query of a scenario of a map that changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DynamicQuery {
    /// The bucket: queries of about the same optimal length share one.
    pub bucket: u32,
    /// Where the path begins. It may lie outside the map.
    pub start: Vertex,
    /// Where the path ends. It may lie outside the map.
    pub goal: Vertex,
    /// The cost `octile`: the length of a shortest path in cells over the 8-neighborhood (k = 3) between cell
    /// centers, without cutting corners (`CornerRule::Never`).
    pub optimal: Optimal,
}

/// A scenario's knowledge of a shortest path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Optimal {
    /// Nothing.
    Unknown,
    /// That there is no path.
    NoPath,
    /// Its length, as exactly as the file writes it.
    Length(f64),
}

impl DynamicScenario {
    /// Whether a text begins as such a scenario, with a line `version 2`.
    #[must_use]
    pub fn is_one(text: &[u8]) -> bool {
        parse::is_dynamic(text)
    }

    /// The name of the file of patches, from the header of the scenario.
    ///
    /// # Errors
    /// [`DynamicError`] for a header that is wrong.
    pub fn patch_file(text: &[u8]) -> Result<String, DynamicError> {
        Ok(parse::header(text)?.patch_file)
    }

    /// Parses a scenario of these patches.
    ///
    /// # Errors
    /// [`DynamicError`] says what is wrong and where.
    pub fn parse(text: &[u8], patches: &[Arc<Patch>]) -> Result<Self, DynamicError> {
        let header = parse::header(text)?;
        let (width, height) = header.size;
        let mut events = parse::events(header, patches)?;
        let is_query = |event: &DynamicEvent| matches!(event, DynamicEvent::Query(_));
        let first = events.iter().position(is_query).unwrap_or(events.len());
        let initial = events.drain(..first).filter_map(|event| match event {
            DynamicEvent::Patch(placed) => Some(placed),
            DynamicEvent::Query(_) => None,
        });
        let initial = initial.collect();
        Ok(Self { width, height, initial, events })
    }

    /// Reads and parses a file, and the file of patches that it names.
    ///
    /// # Errors
    /// [`ReadError`] for a file that is missing, cannot be read, or is none of these.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let wrong = |source| ReadError::Dynamic { path: path.to_owned(), source };
        let text = read_regular(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let beside = folder.join(Self::patch_file(&text).map_err(wrong)?);
        let patches = Patch::parse_all(&read_regular(&beside)?);
        let patches = patches.map_err(|source| ReadError::Patches { path: beside, source })?;
        Self::parse(&text, &patches).map_err(wrong)
    }

    /// The map's number of columns, 1 to [`Grid::MAX_SIDE`].
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// The map's number of rows, 1 to [`Grid::MAX_SIDE`].
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// The map at the first query: that of the patches before it. Its memory grows with the sides that the
    /// header states; all else grows with the text.
    #[must_use]
    pub fn grid(&self) -> Grid {
        let free = uninterrupted(|never: &Interrupt| {
            grid_of_checked_sides((self.width, self.height), never, |_, _| false)
        });
        let change = self.initial.iter().fold(Change::new(Arc::new(free)), |change, placed| {
            change.edit(placed.rectangle(), |x, y| placed.is_blocked(x, y))
        });
        Grid::clone(change.after())
    }

    /// The queries and patches from the first query on, in the order of the file.
    #[must_use]
    pub fn events(&self) -> &[DynamicEvent] {
        &self.events
    }
}
