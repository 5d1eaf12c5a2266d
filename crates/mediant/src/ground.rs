//! Grounds: maps of which some have costs of cells, or elevations.

use std::{path::Path as FilePath, sync::Arc};

use mediant_grid::{Rectangle, Vertex};
use mediant_search::Limits;

#[cfg(feature = "costs")]
use crate::costs::Costs;
#[cfg(feature = "costs")]
use crate::setup_error::SetupError;
#[cfg(feature = "walking")]
use crate::walking::Walking;
use crate::{
    call::{Call, CallError},
    error::Error,
    index::Index,
    map::Map,
    motion::Motion,
    planners::Planners,
    setup::Setup,
    space::Space,
};

/// A map, or [costs](Map::costs) or [elevations](Map::walking) of its cells: what a program holds that is
/// given one of them, such as the grids of other languages. It has what all have.
///
/// ```
/// use mediant::{Ground, Limits, Map, Motion};
///
/// let map = Map::from_rows(["...", ".#.", "..."])?;
/// let costs = map.costs([2.0; 9])?;
/// let length = |ground: Ground| -> Result<_, mediant::Error> {
///     let space = ground.keep_space(Motion::default(), Limits::new())?;
///     Ok(space.path((0, 0), (2, 0))?.map(|path| (path.cost(), path.length())))
/// };
/// assert_eq!((length(map.into())?, length(costs.into())?), (Some((2.0, 2.0)), Some((4.0, 2.0))));
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Ground {
    /// A map: a move costs its length.
    Map(Map),
    /// A map with a cost of each free cell.
    #[cfg(feature = "costs")]
    Costs(Costs),
    /// A map with an elevation of each free cell.
    #[cfg(feature = "walking")]
    Walking(Walking),
}

/// Asks the map, the costs or the elevations; these may have another answer.
macro_rules! either {
    ($ground:expr, $either:ident => $answer:expr) => {
        either!($ground, $either => $answer, $either => $answer)
    };
    ($ground:expr, $either:ident => $answer:expr, $walking:pat => $other:expr) => {
        match $ground {
            Ground::Map($either) => $answer,
            #[cfg(feature = "costs")]
            Ground::Costs($either) => $answer,
            #[cfg(feature = "walking")]
            Ground::Walking($walking) => $other,
        }
    };
}

impl Ground {
    /// The map: which cells are blocked.
    #[must_use]
    pub const fn map(&self) -> &Map {
        match self {
            Self::Map(map) => map,
            #[cfg(feature = "costs")]
            Self::Costs(costs) => costs.map(),
            #[cfg(feature = "walking")]
            Self::Walking(walking) => walking.map(),
        }
    }

    /// The costs of its cells, if they have any.
    #[cfg(feature = "costs")]
    #[must_use]
    pub const fn costs(&self) -> Option<&Costs> {
        if let Self::Costs(costs) = self { Some(costs) } else { None }
    }

    /// The elevations of its cells, if they have any.
    #[cfg(feature = "walking")]
    #[must_use]
    pub const fn walking(&self) -> Option<&Walking> {
        if let Self::Walking(walking) = self { Some(walking) } else { None }
    }

    /// The setup of a call: of the engine that it names, or for the next path here.
    ///
    /// # Errors
    /// [`CallError`] for parameters that do not go together.
    pub fn setup(&self, call: &Call) -> Result<Setup, CallError> {
        either!(self, ground => ground.setup(call))
    }

    /// The space of a motion, if it is kept here.
    #[must_use]
    pub fn kept_space(&self, motion: Motion) -> Option<Space> {
        either!(self, ground => ground.kept_space(motion))
    }

    /// The space of a motion, kept here for the next call. Of the limits the deadline and the flag count.
    ///
    /// # Errors
    /// As for [`Map::keep_space`].
    pub fn keep_space(&self, motion: Motion, limits: impl Into<Limits>) -> Result<Space, Error> {
        either!(self, ground => ground.keep_space(motion, limits))
    }

    /// The planners of a setup, if they are kept here.
    #[must_use]
    pub fn kept_planners(&self, setup: &Setup) -> Option<Arc<Planners>> {
        either!(self, ground => ground.kept_planners(setup))
    }

    /// The planners of a setup, kept here for the next call. Of the limits the deadline and the flag count.
    ///
    /// # Errors
    /// As for [`Map::keep_planners`].
    pub fn keep_planners(&self, setup: &Setup, limits: impl Into<Limits>) -> Result<Arc<Planners>, Error> {
        either!(self, ground => ground.keep_planners(setup, limits))
    }

    /// Reads an index that [`Index::save`] wrote: see [`Map::load`]. Of the limits the deadline and the flag
    /// count.
    ///
    /// # Errors
    /// As for [`Map::load`], and [`Error::Stopped`]; [`Error::Setup`] over elevation.
    pub fn load(&self, path: impl AsRef<FilePath>, limits: impl Into<Limits>) -> Result<Index, Error> {
        either!(self, ground => ground.within(limits).load(path),
            _ => Err(SetupError::INDEX_OVER_ELEVATION.into()))
    }

    /// The index that [`Index::to_bytes`] wrote: see [`Map::index_from_bytes`]. Of the limits the deadline
    /// and the flag count.
    ///
    /// # Errors
    /// As for [`Map::index_from_bytes`], and [`Error::Stopped`]; [`Error::Setup`] over elevation.
    pub fn index_from_bytes(&self, bytes: Vec<u8>, limits: impl Into<Limits>) -> Result<Index, Error> {
        either!(self, ground => ground.within(limits).index_from_bytes(bytes),
            _ => Err(SetupError::INDEX_OVER_ELEVATION.into()))
    }

    /// This ground with other cells in a rectangle: see [`Map::edit`].
    ///
    /// # Errors
    /// As for [`Map::edit`]; [`Error::Freed`] for a blocked cell that is freed where cells have costs: it
    /// needs one; [`Error::Setup`] where cells have elevations.
    pub fn edit(&self, at: Rectangle, blocked: impl FnMut(u32, u32) -> bool) -> Result<Self, Error> {
        either!(self, ground => Ok(ground.edit(at, blocked)?.into()),
            _ => Err(SetupError::EDITS_OVER_ELEVATION.into()))
    }

    /// This ground with other scattered cells: see [`Map::edit_cells`].
    ///
    /// # Errors
    /// As for [`Map::edit_cells`]; [`Error::Freed`] and [`Error::Setup`] as for
    /// [`edit`](Self::edit).
    pub fn edit_cells<C: Into<Vertex>>(
        &self,
        cells: impl IntoIterator<Item = (C, bool)>,
    ) -> Result<Self, Error> {
        match self {
            Self::Map(map) => Ok(map.edit_cells(cells)?.into()),
            #[cfg(feature = "costs")]
            Self::Costs(costs) => Ok(costs.block_cells(cells)?.into()),
            #[cfg(feature = "walking")]
            Self::Walking(_) => Err(SetupError::EDITS_OVER_ELEVATION.into()),
        }
    }

    /// This ground with other costs of some cells: see [`Costs::edit_cells`].
    ///
    /// # Errors
    /// As for [`Costs::edit_cells`]; [`SetupError::WithoutCosts`] for another ground.
    #[cfg(feature = "costs")]
    pub fn edit_costs<C: Into<Vertex>>(
        &self,
        cells: impl IntoIterator<Item = (C, Option<f64>)>,
    ) -> Result<Self, Error> {
        let costs = self.costs().ok_or(SetupError::WithoutCosts)?;
        Ok(costs.edit_cells(cells)?.into())
    }
}

impl From<Map> for Ground {
    fn from(map: Map) -> Self {
        Self::Map(map)
    }
}

#[cfg(feature = "costs")]
impl From<Costs> for Ground {
    fn from(costs: Costs) -> Self {
        Self::Costs(costs)
    }
}

#[cfg(feature = "walking")]
impl From<Walking> for Ground {
    fn from(walking: Walking) -> Self {
        Self::Walking(walking)
    }
}
