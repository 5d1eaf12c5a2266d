//! Stable names for the kinds of mistakes.

use std::io;

#[cfg(feature = "walking")]
use mediant_costs::WalkingError;
#[cfg(feature = "costs")]
use mediant_costs::{CostsError, LandmarksError};
use mediant_formats::{IndexError, ReadError};
use mediant_grid::{GridError, names};
use mediant_hierarchy::HierarchyError;
use mediant_search::{End, JumpError, Limit, QueryError};
use mediant_subgoal::SubgoalError;

use crate::{call::CallError, error::Error, setup_error::SetupError};

/// The kind of a mistake. The names are the same in all languages, and stay from version to version; new
/// ones may come.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorCode {
    /// A map with a side of 0, or one that is too long.
    MapSize,
    /// A map with rows of different lengths.
    MapRagged,
    /// An edit outside the map.
    EditOutside,
    /// A k that does not exist, or that nothing is made for.
    K,
    /// Rules and a k that no engine searches together.
    Motion,
    /// The name of an engine, or of a value of an option, that does not exist.
    UnknownName,
    /// A text that is no setup.
    SetupText,
    /// An option, or a value of it, that the engine does not take.
    EngineOption,
    /// A k that the engine does not take.
    EngineK,
    /// A placement or rule that the engine does not take.
    EngineRules,
    /// Something that the engine does not have: a saved index, or distances.
    EngineWithout,
    /// Two things that belong to other maps, rules or k.
    Mismatch,
    /// A start that is blocked.
    StartBlocked,
    /// A goal that is blocked.
    GoalBlocked,
    /// A start outside the map.
    StartOutside,
    /// A goal outside the map.
    GoalOutside,
    /// No path was found, though there is one.
    GaveUp,
    /// An index that cannot be made: too large, or with levels or a side that do not exist.
    IndexRange,
    /// An index that does not have the levels, the side or the landmarks that were named.
    IndexOptions,
    /// An index that is damaged, cut short, or none.
    IndexDamaged,
    /// An index of another engine, or of another version.
    IndexEngine,
    /// A file that does not exist.
    FileMissing,
    /// A file that cannot be read.
    FileUnreadable,
    /// A file that cannot be written.
    FileUnwritable,
    /// A file that is no map.
    MapFormat,
    /// A file that is no scenario.
    ScenarioFormat,
    /// A query without a start or a goal.
    NoEnd,
    /// An end lies between vertices, for an engine whose paths start and end at vertices.
    Between,
    /// A tolerance, a limit, a radius or a spacing that is negative, or no number.
    Number,
    /// A step of a search that was never begun.
    NotBegun,
    /// Memory that there is not.
    Memory,
    /// Work that a flag stopped.
    Cancelled,
    /// Work that a limit stopped: on its time, on cost or expansions.
    Stopped,
    /// An argument of another type, or with a value that it cannot have.
    Argument,
    /// A path that does not hold on a map.
    BrokenPath,
    /// A map with a character that is neither free nor blocked, or with characters that cannot be either.
    MapTile,
    /// A cost or an elevation of a cell that cannot be one, numbers that do not fit together or on the map,
    /// or a cell without one.
    Cost,
    /// A mistake of a kind that has no name yet.
    Other,
}

names!(ErrorCode:
    MapSize => "map-size",
    MapRagged => "map-ragged",
    EditOutside => "edit-outside",
    K => "k",
    Motion => "motion",
    UnknownName => "unknown-name",
    SetupText => "setup-text",
    EngineOption => "engine-option",
    EngineK => "engine-k",
    EngineRules => "engine-rules",
    EngineWithout => "engine-without",
    Mismatch => "mismatch",
    StartBlocked => "start-blocked",
    GoalBlocked => "goal-blocked",
    StartOutside => "start-outside",
    GoalOutside => "goal-outside",
    GaveUp => "gave-up",
    IndexRange => "index-range",
    IndexOptions => "index-options",
    IndexDamaged => "index-damaged",
    IndexEngine => "index-engine",
    FileMissing => "file-missing",
    FileUnreadable => "file-unreadable",
    FileUnwritable => "file-unwritable",
    MapFormat => "map-format",
    ScenarioFormat => "scenario-format",
    NoEnd => "no-end",
    Between => "between-vertices",
    Number => "number",
    NotBegun => "not-begun",
    Memory => "memory",
    Cancelled => "cancelled",
    Stopped => "stopped",
    Argument => "argument",
    BrokenPath => "broken-path",
    MapTile => "map-tile",
    Cost => "cost",
    Other => "other",
);

impl Error {
    /// The kind of the mistake.
    #[must_use]
    pub fn code(&self) -> ErrorCode {
        match self {
            Self::Grid(GridError::Size { .. } | GridError::LongSize { .. }) => ErrorCode::MapSize,
            Self::Grid(GridError::Ragged { .. }) => ErrorCode::MapRagged,
            Self::Tile(_) | Self::Tiles(_) => ErrorCode::MapTile,
            Self::Edit { .. } | Self::EditCell { .. } => ErrorCode::EditOutside,
            Self::Size(_) => ErrorCode::Number,
            Self::K(_) => ErrorCode::K,
            Self::Name(_) => ErrorCode::UnknownName,
            Self::Text(_) => ErrorCode::SetupText,
            Self::Setup(error) => of_setup(error),
            Self::Mismatch(_) => ErrorCode::Mismatch,
            Self::Query(error) => of_query(error),
            Self::Jump(error) => of_jump(error),
            Self::Subgoal(error) => of_subgoal(error),
            Self::InFile { source, .. } => source.code(),
            Self::Hierarchy(error) => of_hierarchy(error),
            Self::Levels { .. } | Self::Side { .. } | Self::LandmarkCount { .. } | Self::Memory { .. } => {
                ErrorCode::IndexOptions
            }
            #[cfg(feature = "costs")]
            Self::Landmarks(error) => of_landmarks(error),
            Self::IndexFile(error) => of_index(error),
            Self::Read(error) => of_read(error),
            Self::Write(_) => ErrorCode::FileUnwritable,
            Self::OutOfMemory { .. } | Self::NoRoom { .. } => ErrorCode::Memory,
            Self::Stopped { by: Limit::Cancelled, .. } => ErrorCode::Cancelled,
            Self::Stopped { .. } => ErrorCode::Stopped,
            Self::Call(error) => of_call(error),
            Self::Broken(_) => ErrorCode::BrokenPath,
            #[cfg(feature = "costs")]
            Self::Costs(error) => of_costs(error),
            #[cfg(feature = "walking")]
            Self::Walking(error) => of_walking(error),
            #[cfg(feature = "rasters")]
            Self::OtherSize { .. } | Self::Degrees | Self::NoCellSize => ErrorCode::Cost,
            Self::Freed { .. } => ErrorCode::Cost,
            Self::Grid(_) => ErrorCode::Other,
        }
    }
}

#[cfg(feature = "costs")]
const fn of_costs(error: &CostsError) -> ErrorCode {
    match error {
        CostsError::Size { .. } | CostsError::Inflated { .. } => ErrorCode::MapSize,
        CostsError::K { .. } | CostsError::Rules { .. } => ErrorCode::Motion,
        CostsError::CellSize { .. } | CostsError::Setting { .. } | CostsError::SmallInflation { .. } => {
            ErrorCode::Number
        }
        CostsError::Outside { .. } => ErrorCode::EditOutside,
        CostsError::Count { .. } | CostsError::Cost { .. } | CostsError::Range { .. } => ErrorCode::Cost,
        _ => ErrorCode::Other,
    }
}

#[cfg(feature = "walking")]
const fn of_walking(error: &WalkingError) -> ErrorCode {
    match error {
        WalkingError::Costs(error) => of_costs(error),
        WalkingError::Corners => ErrorCode::Motion,
        WalkingError::Heading => ErrorCode::Mismatch,
        WalkingError::Table | WalkingError::Pace { .. } => ErrorCode::Number,
        _ => ErrorCode::Cost,
    }
}

#[cfg(feature = "costs")]
const fn of_landmarks(error: &LandmarksError) -> ErrorCode {
    match error {
        LandmarksError::Count { .. } => ErrorCode::IndexRange,
        LandmarksError::Mismatch(_) => ErrorCode::Mismatch,
        LandmarksError::Bytes(_) => ErrorCode::IndexDamaged,
        _ => ErrorCode::Other,
    }
}

const fn of_call(error: &CallError) -> ErrorCode {
    match error {
        CallError::Type { .. } | CallError::Value { .. } | CallError::Together { .. } => ErrorCode::Argument,
        CallError::Name { .. } => ErrorCode::UnknownName,
        CallError::K { .. } => ErrorCode::K,
        CallError::Setup(error) => of_setup(error),
    }
}

const fn of_setup(error: &SetupError) -> ErrorCode {
    match error {
        SetupError::Option { .. }
        | SetupError::DetourAsPublished { .. }
        | SetupError::MemoryWithoutLabels { .. }
        | SetupError::Landmarks { .. }
        | SetupError::OtherEngine { .. }
        | SetupError::OtherPlanner { .. }
        | SetupError::OtherVariant { .. } => ErrorCode::EngineOption,
        SetupError::Motion { .. }
        | SetupError::AnyAngleWithCorners
        | SetupError::GapBetweenCenters { .. }
        | SetupError::CostsK { .. } => ErrorCode::Motion,
        SetupError::LongSide { .. } => ErrorCode::MapSize,
        SetupError::WithoutCosts => ErrorCode::Cost,
        SetupError::K { .. } | SetupError::NeedsFiniteK { .. } => ErrorCode::EngineK,
        SetupError::Placement { .. } | SetupError::Centers { .. } => ErrorCode::EngineRules,
        SetupError::Without { .. }
        | SetupError::NotBuilt { .. }
        | SetupError::NoIndex { .. }
        | SetupError::Costs { .. }
        | SetupError::Walking { .. }
        | SetupError::WithCosts { .. } => ErrorCode::EngineWithout,
    }
}

const fn of_query(error: &QueryError) -> ErrorCode {
    match error {
        QueryError::Outside { end: End::Start, .. } => ErrorCode::StartOutside,
        QueryError::Outside { end: End::Goal, .. } => ErrorCode::GoalOutside,
        QueryError::Blocked { end: End::Start, .. } | QueryError::NothingFree { end: End::Start, .. } => {
            ErrorCode::StartBlocked
        }
        QueryError::Blocked { end: End::Goal, .. } | QueryError::NothingFree { end: End::Goal, .. } => {
            ErrorCode::GoalBlocked
        }
        QueryError::GaveUp { .. } => ErrorCode::GaveUp,
        QueryError::OtherGoals => ErrorCode::Mismatch,
        QueryError::NoEnd { .. } => ErrorCode::NoEnd,
        QueryError::Between { .. } => ErrorCode::Between,
        QueryError::Tolerance | QueryError::CostLimit => ErrorCode::Number,
        QueryError::NotBegun => ErrorCode::NotBegun,
        QueryError::Smoothing => ErrorCode::EngineWithout,
        _ => ErrorCode::Other,
    }
}

const fn of_jump(error: &JumpError) -> ErrorCode {
    match error {
        JumpError::K(_) => ErrorCode::EngineK,
        JumpError::Mismatch(_) => ErrorCode::Mismatch,
        JumpError::Bytes | JumpError::Length { .. } | JumpError::Entry { .. } => ErrorCode::IndexDamaged,
        _ => ErrorCode::Other,
    }
}

const fn of_subgoal(error: &SubgoalError) -> ErrorCode {
    match error {
        SubgoalError::Centers { .. } => ErrorCode::EngineRules,
        SubgoalError::K(_) => ErrorCode::EngineK,
        SubgoalError::Arcs { .. }
        | SubgoalError::Core { .. }
        | SubgoalError::Memory { .. }
        | SubgoalError::Labels => ErrorCode::IndexRange,
        SubgoalError::Mismatch(_) => ErrorCode::Mismatch,
        SubgoalError::Bytes(_) => ErrorCode::IndexDamaged,
        _ => ErrorCode::Other,
    }
}

const fn of_hierarchy(error: &HierarchyError) -> ErrorCode {
    match error {
        HierarchyError::Side { .. } | HierarchyError::Levels { .. } | HierarchyError::TooLarge { .. } => {
            ErrorCode::IndexRange
        }
        HierarchyError::Moves { .. } => ErrorCode::EngineRules,
        HierarchyError::K(_) => ErrorCode::EngineK,
        HierarchyError::Mismatch(_) => ErrorCode::Mismatch,
        HierarchyError::Bytes(_) => ErrorCode::IndexDamaged,
        _ => ErrorCode::Other,
    }
}

fn of_read(error: &ReadError) -> ErrorCode {
    match error {
        ReadError::Unreadable { source, .. } if source.kind() == io::ErrorKind::OutOfMemory => {
            ErrorCode::Memory
        }
        ReadError::Missing { .. } => ErrorCode::FileMissing,
        ReadError::Map { .. }
        | ReadError::Raster { .. }
        | ReadError::Ros { .. }
        | ReadError::NoMap { .. } => ErrorCode::MapFormat,
        ReadError::RosImage { source, .. } => of_read(source),
        ReadError::Scenario { .. } | ReadError::Dynamic { .. } | ReadError::Patches { .. } => {
            ErrorCode::ScenarioFormat
        }
        ReadError::Index { source, .. } => of_index(source),
        _ => ErrorCode::FileUnreadable,
    }
}

const fn of_index(error: &IndexError) -> ErrorCode {
    match error {
        IndexError::Engine { .. } | IndexError::EngineVersion { .. } | IndexError::Format { .. } => {
            ErrorCode::IndexEngine
        }
        IndexError::Mismatch(_) => ErrorCode::Mismatch,
        _ => ErrorCode::IndexDamaged,
    }
}
