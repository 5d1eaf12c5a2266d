//! The kinds of operations.

use std::fmt;

/// A kind of operation, whose latencies are counted together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// An index is made.
    Prepare,
    /// An index is made into bytes, or saved to a file.
    Save,
    /// An index is read from either.
    Load,
    /// An index follows an edit.
    Repair,
    /// A planner of its own follows to the repaired index.
    Follow,
    /// A query for a path.
    Path,
    /// A query for the length of a path.
    Distance,
    /// A query with wishes: the nearest vertex, a tolerance, snapped ends.
    Wish,
    /// A query with a limit on its cost, expansions, or time.
    Limit,
    /// A search in steps, of which some are forgotten.
    Steps,
    /// A query that another thread cancels, or whose deadline is over at some look.
    Cancel,
    /// Many queries at once.
    Batch,
    /// Distances of all vertices to a source.
    Field,
    /// Lengths from many starts to many goals.
    Table,
}

impl Kind {
    /// All kinds, in the order of their numbers.
    pub(super) const ALL: [Self; 14] = [
        Self::Prepare,
        Self::Save,
        Self::Load,
        Self::Repair,
        Self::Follow,
        Self::Path,
        Self::Distance,
        Self::Wish,
        Self::Limit,
        Self::Steps,
        Self::Cancel,
        Self::Batch,
        Self::Field,
        Self::Table,
    ];
    /// The kinds that threads ask in turn, as often as they stand here.
    pub(super) const ASKED: [Self; 16] = [
        Self::Path,
        Self::Path,
        Self::Path,
        Self::Distance,
        Self::Wish,
        Self::Wish,
        Self::Wish,
        Self::Limit,
        Self::Limit,
        Self::Steps,
        Self::Steps,
        Self::Cancel,
        Self::Cancel,
        Self::Batch,
        Self::Field,
        Self::Table,
    ];

    /// Its name in tables.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Prepare => "prepare",
            Self::Save => "save",
            Self::Load => "load",
            Self::Repair => "repair",
            Self::Follow => "follow",
            Self::Path => "path",
            Self::Distance => "distance",
            Self::Wish => "wish",
            Self::Limit => "limit",
            Self::Steps => "steps",
            Self::Cancel => "cancel",
            Self::Batch => "batch",
            Self::Field => "field",
            Self::Table => "table",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
