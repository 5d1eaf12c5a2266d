//! The table of options.

#[cfg(feature = "publications")]
use super::published::{DETOUR, JUMP_LIMIT, KEEP_INTERMEDIATE, SECOND, STEP, UNSTRAIGHTENED, VARIANT};
use super::{description::EngineOption, value::ValueKind};

/// The heuristic of the search.
pub(crate) static HEURISTIC: EngineOption = EngineOption {
    name: "heuristic",
    noun: "heuristic",
    kind: ValueKind::Heuristic,
    key: None,
    is_index_option: false,
    is_published: false,
    help: "The heuristic of the search: hk, the cost on an empty grid (the default), euclidean, the \
           straight-line distance, or zero",
    phrase: "heuristic {}",
    samples: if cfg!(feature = "publications") {
        &["euclidean", "zero", "squared"]
    } else {
        &["euclidean", "zero"]
    },
};

/// The levels of a subgoal graph or of clusters, or hub labels.
pub(crate) static LEVELS: EngineOption = EngineOption {
    name: "levels",
    noun: "levels",
    kind: ValueKind::Levels,
    key: Some("levels"),
    is_index_option: true,
    is_published: false,
    help: "The number of levels of the subgoal graph (1 is the graph without a hierarchy) or of the \
           clusters, or all; for subgoal also labels (hub labels) or contracted (a contraction hierarchy). By \
           default hub labels for subgoal if they fit in --memory, else a contraction hierarchy; 2 levels for \
           subgoal-theta, 3 for hpa; with --index, those of the index",
    phrase: "{}",
    samples: &["1", "2", "all", "contracted", "labels"],
};

/// The memory that hub labels may take.
pub(crate) static MEMORY: EngineOption = EngineOption {
    name: "memory",
    noun: "memory for hub labels",
    kind: ValueKind::Memory,
    key: Some("memory"),
    is_index_option: true,
    is_published: false,
    help: "The memory that the hub labels of subgoal may take, as 8MB: what they leave of it goes to labels \
           of vertices, with which queries are faster on most maps. By default they may take 64 bytes a cell, but \
           at least 48MB and at most 1GB, and vertices have none. A map whose labels take more has a \
           contraction hierarchy, and the same paths",
    phrase: "at most {} for labels",
    samples: &["1kB", "1MB"],
};

/// The side of clusters or segments.
pub(crate) static SIDE: EngineOption = EngineOption {
    name: "side",
    noun: "side",
    kind: ValueKind::Number,
    key: Some("side"),
    is_index_option: true,
    is_published: false,
    help: "Cut the map into clusters (on the lowest level) or segments of N × N cells. 10 by default for \
           hpa, 3 for chpa; with --index, those of the index",
    phrase: "side {}",
    samples: &["2", "5"],
};

/// The number of landmarks.
pub(crate) static LANDMARKS: EngineOption = EngineOption {
    name: "landmarks",
    noun: "number of landmarks",
    kind: ValueKind::Number,
    key: Some("landmarks"),
    is_index_option: true,
    is_published: false,
    help: "The number of landmarks from which landmarks has all distances: 4, 8 or 16, the first of these that \
           is not less than N. 8 by default; 16 take twice the memory and the time to prepare, for queries 1.1 \
           to 1.4 times as fast; with --index, those of the index",
    phrase: "{} landmarks",
    samples: &["4"],
};

impl EngineOption {
    /// All options, in the order of the program's help and reports.
    ///
    /// | in the text of a setup | flag of the program | meaning |
    /// |---|---|---|
    /// | `hk`, `euclidean`, `zero` | `--heuristic` | the heuristic of the search |
    /// | `levels=N`, `=all`, `=contracted`, `=labels` | `--levels` | the levels of graphs or clusters, or hub labels |
    /// | `memory=8MB` | `--memory` | the memory that hub labels may take, and labels of vertices with them |
    /// | `side=N` | `--side` | the side of a cluster or segment, in cells |
    /// | `landmarks=N` | `--landmarks` | the number of landmarks, up to 16 |
    ///
    /// The feature `publications` adds those that only reproduce publications:
    ///
    /// | in the text of a setup | flag of the program | meaning |
    /// |---|---|---|
    /// | `squared` | `--heuristic` | a heuristic that overestimates |
    /// | `exact`, `complete`, `paper` | `--variant` | the repaired or the published variant |
    /// | `limit=N` | `--jump-limit` | jumps of at most N steps |
    /// | `intermediate` | `--keep-intermediate` | intermediate jump points are kept |
    /// | `unstraightened` | `--unstraightened` | paths through clusters are not straightened |
    /// | `second=NAME` | `--second` | the heuristic of the second phase |
    /// | `step=N` | `--step` | a checkpoint every N segments |
    /// | `detour=N` | `--detour` | how many times h_k the path to a checkpoint may cost |
    pub const ALL: [&'static Self; if cfg!(feature = "publications") { 12 } else { 5 }] = [
        &HEURISTIC,
        #[cfg(feature = "publications")]
        &VARIANT,
        #[cfg(feature = "publications")]
        &JUMP_LIMIT,
        #[cfg(feature = "publications")]
        &KEEP_INTERMEDIATE,
        &LEVELS,
        &MEMORY,
        &SIDE,
        &LANDMARKS,
        #[cfg(feature = "publications")]
        &UNSTRAIGHTENED,
        #[cfg(feature = "publications")]
        &SECOND,
        #[cfg(feature = "publications")]
        &STEP,
        #[cfg(feature = "publications")]
        &DETOUR,
    ];
}
