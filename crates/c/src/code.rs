//! The numbers of words: codes of errors, statuses of answers, limits.

use library::{ErrorCode, Limit, Status};

/// The outcome of a call. The numbers stay from version to version; new ones may come.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Code {
    /// It did what it should.
    Ok = 0,
    /// A map with a side of 0, or one that is too long.
    MapSize = 1,
    /// A map with rows of different lengths.
    MapRagged = 2,
    /// An edit outside the map.
    EditOutside = 3,
    /// A k that does not exist, or that nothing is made for.
    K = 4,
    /// Rules and a k that no engine searches together.
    Motion = 5,
    /// The name of an engine, or of a value of an option, that does not exist.
    UnknownName = 6,
    /// A text that is no setup.
    SetupText = 7,
    /// An option, or a value of it, that the engine does not take.
    EngineOption = 8,
    /// A k that the engine does not take.
    EngineK = 9,
    /// A placement or rule that the engine does not take.
    EngineRules = 10,
    /// Something that the engine does not have: a saved index, or distances.
    EngineWithout = 11,
    /// Two things that belong to other maps, rules or k.
    Mismatch = 12,
    /// A start that is blocked.
    StartBlocked = 13,
    /// A goal that is blocked.
    GoalBlocked = 14,
    /// A start outside the map.
    StartOutside = 15,
    /// A goal outside the map.
    GoalOutside = 16,
    /// No path was found, though there is one.
    GaveUp = 17,
    /// An index that cannot be made: too large, or with levels or a side that do not exist.
    IndexRange = 18,
    /// An index that does not have the levels, the side or the landmarks that were named.
    IndexOptions = 19,
    /// An index that is damaged, cut short, or none.
    IndexDamaged = 20,
    /// An index of another engine, or of another version.
    IndexEngine = 21,
    /// A file that does not exist.
    FileMissing = 22,
    /// A file that cannot be read.
    FileUnreadable = 23,
    /// A file that cannot be written.
    FileUnwritable = 24,
    /// A file that is no map.
    MapFormat = 25,
    /// A file that is no scenario.
    ScenarioFormat = 26,
    /// A query without a start or a goal.
    NoEnd = 27,
    /// An end lies between vertices, for an engine whose paths start and end at vertices.
    Between = 28,
    /// A tolerance, a limit, a radius or a spacing that is negative, or no number.
    Number = 29,
    /// A step of a search that was never begun.
    NotBegun = 30,
    /// Memory that there is not.
    Memory = 31,
    /// Work that its watcher stopped.
    Cancelled = 32,
    /// Work that a limit stopped: on its time, on cost or expansions.
    Stopped = 33,
    /// An argument of another type, or with a value that it cannot have.
    Argument = 34,
    /// A path that does not hold on a map.
    BrokenPath = 35,
    /// A map with a character that is neither free nor blocked, or with characters that cannot be either.
    MapTile = 36,
    /// A cost or an elevation of a cell that cannot be one, numbers that do not fit together or on the map,
    /// or a cell without one.
    Cost = 37,
    /// A handle that is null, was freed, is of another type, or was never made here.
    Handle = 38,
    /// An object that another call is using.
    Busy = 39,
    /// A mistake of a kind that has no name yet.
    Other = 255,
}

impl From<ErrorCode> for Code {
    fn from(code: ErrorCode) -> Self {
        match code {
            ErrorCode::MapSize => Self::MapSize,
            ErrorCode::MapRagged => Self::MapRagged,
            ErrorCode::EditOutside => Self::EditOutside,
            ErrorCode::K => Self::K,
            ErrorCode::Motion => Self::Motion,
            ErrorCode::UnknownName => Self::UnknownName,
            ErrorCode::SetupText => Self::SetupText,
            ErrorCode::EngineOption => Self::EngineOption,
            ErrorCode::EngineK => Self::EngineK,
            ErrorCode::EngineRules => Self::EngineRules,
            ErrorCode::EngineWithout => Self::EngineWithout,
            ErrorCode::Mismatch => Self::Mismatch,
            ErrorCode::StartBlocked => Self::StartBlocked,
            ErrorCode::GoalBlocked => Self::GoalBlocked,
            ErrorCode::StartOutside => Self::StartOutside,
            ErrorCode::GoalOutside => Self::GoalOutside,
            ErrorCode::GaveUp => Self::GaveUp,
            ErrorCode::IndexRange => Self::IndexRange,
            ErrorCode::IndexOptions => Self::IndexOptions,
            ErrorCode::IndexDamaged => Self::IndexDamaged,
            ErrorCode::IndexEngine => Self::IndexEngine,
            ErrorCode::FileMissing => Self::FileMissing,
            ErrorCode::FileUnreadable => Self::FileUnreadable,
            ErrorCode::FileUnwritable => Self::FileUnwritable,
            ErrorCode::MapFormat => Self::MapFormat,
            ErrorCode::ScenarioFormat => Self::ScenarioFormat,
            ErrorCode::NoEnd => Self::NoEnd,
            ErrorCode::Between => Self::Between,
            ErrorCode::Number => Self::Number,
            ErrorCode::NotBegun => Self::NotBegun,
            ErrorCode::Memory => Self::Memory,
            ErrorCode::Cancelled => Self::Cancelled,
            ErrorCode::Stopped => Self::Stopped,
            ErrorCode::Argument => Self::Argument,
            ErrorCode::BrokenPath => Self::BrokenPath,
            ErrorCode::MapTile => Self::MapTile,
            ErrorCode::Cost => Self::Cost,
            _ => Self::Other,
        }
    }
}

impl Code {
    /// Every code.
    pub(crate) const ALL: &[Self] = &[
        Self::Ok,
        Self::MapSize,
        Self::MapRagged,
        Self::EditOutside,
        Self::K,
        Self::Motion,
        Self::UnknownName,
        Self::SetupText,
        Self::EngineOption,
        Self::EngineK,
        Self::EngineRules,
        Self::EngineWithout,
        Self::Mismatch,
        Self::StartBlocked,
        Self::GoalBlocked,
        Self::StartOutside,
        Self::GoalOutside,
        Self::GaveUp,
        Self::IndexRange,
        Self::IndexOptions,
        Self::IndexDamaged,
        Self::IndexEngine,
        Self::FileMissing,
        Self::FileUnreadable,
        Self::FileUnwritable,
        Self::MapFormat,
        Self::ScenarioFormat,
        Self::NoEnd,
        Self::Between,
        Self::Number,
        Self::NotBegun,
        Self::Memory,
        Self::Cancelled,
        Self::Stopped,
        Self::Argument,
        Self::BrokenPath,
        Self::MapTile,
        Self::Cost,
        Self::Handle,
        Self::Busy,
        Self::Other,
    ];

    /// Its name in all languages, ended by 0.
    pub(crate) const fn name(self) -> &'static std::ffi::CStr {
        match self {
            Self::Ok => c"ok",
            Self::MapSize => c"map-size",
            Self::MapRagged => c"map-ragged",
            Self::EditOutside => c"edit-outside",
            Self::K => c"k",
            Self::Motion => c"motion",
            Self::UnknownName => c"unknown-name",
            Self::SetupText => c"setup-text",
            Self::EngineOption => c"engine-option",
            Self::EngineK => c"engine-k",
            Self::EngineRules => c"engine-rules",
            Self::EngineWithout => c"engine-without",
            Self::Mismatch => c"mismatch",
            Self::StartBlocked => c"start-blocked",
            Self::GoalBlocked => c"goal-blocked",
            Self::StartOutside => c"start-outside",
            Self::GoalOutside => c"goal-outside",
            Self::GaveUp => c"gave-up",
            Self::IndexRange => c"index-range",
            Self::IndexOptions => c"index-options",
            Self::IndexDamaged => c"index-damaged",
            Self::IndexEngine => c"index-engine",
            Self::FileMissing => c"file-missing",
            Self::FileUnreadable => c"file-unreadable",
            Self::FileUnwritable => c"file-unwritable",
            Self::MapFormat => c"map-format",
            Self::ScenarioFormat => c"scenario-format",
            Self::NoEnd => c"no-end",
            Self::Between => c"between-vertices",
            Self::Number => c"number",
            Self::NotBegun => c"not-begun",
            Self::Memory => c"memory",
            Self::Cancelled => c"cancelled",
            Self::Stopped => c"stopped",
            Self::Argument => c"argument",
            Self::BrokenPath => c"broken-path",
            Self::MapTile => c"map-tile",
            Self::Cost => c"cost",
            Self::Handle => c"handle",
            Self::Busy => c"busy",
            Self::Other => c"other",
        }
    }
}

/// The status of an answer.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathStatus {
    /// There is a path.
    Found = 0,
    /// There is none.
    Unreachable = 1,
    /// A path to the reachable vertex nearest to a goal.
    Nearest = 2,
    /// A limit stopped the search.
    Stopped = 3,
}

impl From<Status> for PathStatus {
    fn from(status: Status) -> Self {
        match status {
            Status::Found => Self::Found,
            Status::Nearest => Self::Nearest,
            Status::Stopped => Self::Stopped,
            // A kind that is newer than this table has no path that is known here.
            _ => Self::Unreachable,
        }
    }
}

/// The limit that stopped a search.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathLimit {
    /// None did.
    None = 0,
    /// The limit on the cost of the path.
    Cost = 1,
    /// The limit on expansions.
    Expansions = 2,
    /// The time.
    Timeout = 3,
    /// The watcher, which said so.
    Cancelled = 4,
}

impl From<Option<Limit>> for PathLimit {
    fn from(limit: Option<Limit>) -> Self {
        match limit {
            None => Self::None,
            Some(Limit::Cost) => Self::Cost,
            Some(Limit::Expansions) => Self::Expansions,
            Some(Limit::Timeout) => Self::Timeout,
            Some(_) => Self::Cancelled,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Programs that were compiled against an earlier header have these numbers in them.
    #[rustfmt::skip]
    const NUMBERS: &[(i32, &str)] = &[
        (0, "ok"), (1, "map-size"), (2, "map-ragged"), (3, "edit-outside"), (4, "k"), (5, "motion"),
        (6, "unknown-name"), (7, "setup-text"), (8, "engine-option"), (9, "engine-k"), (10, "engine-rules"),
        (11, "engine-without"), (12, "mismatch"), (13, "start-blocked"), (14, "goal-blocked"),
        (15, "start-outside"), (16, "goal-outside"), (17, "gave-up"), (18, "index-range"),
        (19, "index-options"), (20, "index-damaged"), (21, "index-engine"), (22, "file-missing"),
        (23, "file-unreadable"), (24, "file-unwritable"), (25, "map-format"), (26, "scenario-format"),
        (27, "no-end"), (28, "between-vertices"), (29, "number"), (30, "not-begun"), (31, "memory"),
        (32, "cancelled"), (33, "stopped"), (34, "argument"), (35, "broken-path"), (36, "map-tile"),
        (37, "cost"), (38, "handle"), (39, "busy"), (255, "other"),
    ];

    #[test]
    fn numbers_and_names_stay() {
        let known: Vec<_> =
            Code::ALL.iter().map(|&code| (code as i32, code.name().to_str().unwrap())).collect();
        assert_eq!(known, NUMBERS, "numbers never change; a new code is a new line at the end");
    }

    #[test]
    fn every_error_of_the_library_has_a_number_and_its_name() {
        for error in ErrorCode::ALL {
            let code = Code::from(error);
            assert_eq!(code.name().to_str(), Ok(error.name()), "give it a number in `Code`");
        }
    }

    #[test]
    fn every_status_and_limit_of_the_library_has_a_number() {
        let statuses = Status::ALL.iter().map(|&status| PathStatus::from(status) as i32);
        assert_eq!(statuses.collect::<std::collections::HashSet<_>>().len(), Status::ALL.len());
        let limits = Limit::ALL.iter().map(|&limit| PathLimit::from(Some(limit)) as i32);
        assert_eq!(limits.collect::<std::collections::HashSet<_>>().len(), Limit::ALL.len());
    }
}
