//! The options that only reproduce publications.

use super::{description::EngineOption, value::ValueKind};

/// The variant of an engine.
pub(crate) static VARIANT: EngineOption = EngineOption {
    name: "variant",
    noun: "variant",
    kind: ValueKind::Variant,
    key: None,
    is_index_option: false,
    is_published: true,
    help: "For an engine that was published with a flaw: the repaired variant (the default; exact for \
           canonical, complete for chpa), or paper, the published one",
    phrase: "variant {}",
    samples: &["paper"],
};

/// The most steps that a jump may take.
pub(crate) static JUMP_LIMIT: EngineOption = EngineOption {
    name: "jump-limit",
    noun: "jump limit",
    kind: ValueKind::Number,
    key: Some("limit"),
    is_index_option: false,
    is_published: true,
    help: "Limit each jump to N steps",
    phrase: "jumps up to {}",
    samples: &["2"],
};

/// Whether to keep intermediate jump points.
pub(crate) static KEEP_INTERMEDIATE: EngineOption = EngineOption {
    name: "keep-intermediate",
    noun: "intermediate jump points",
    kind: ValueKind::Flag,
    key: Some("intermediate"),
    is_index_option: false,
    is_published: true,
    help: "Keep intermediate jump points, at which a path only turns on its way to another jump point",
    phrase: "intermediate jump points kept",
    samples: &[""],
};

/// Whether HPA* leaves out its straightening.
pub(crate) static UNSTRAIGHTENED: EngineOption = EngineOption {
    name: "unstraightened",
    noun: "option unstraightened",
    kind: ValueKind::Flag,
    key: Some("unstraightened"),
    is_index_option: false,
    is_published: true,
    help: "Leave out the straightening of hpa, which shortens each path after the search",
    phrase: "paths not straightened",
    samples: &[""],
};

/// The heuristic of the second phase.
pub(crate) static SECOND: EngineOption = EngineOption {
    name: "second",
    noun: "second heuristic",
    kind: ValueKind::Heuristic,
    key: Some("second"),
    is_index_option: false,
    is_published: true,
    help: "The heuristic of chpa's second phase, from checkpoint to checkpoint. That of the first phase by \
           default",
    phrase: "second heuristic {}",
    samples: &["squared"],
};

/// Every how many segments there is a checkpoint.
pub(crate) static STEP: EngineOption = EngineOption {
    name: "step",
    noun: "step",
    kind: ValueKind::Number,
    key: Some("step"),
    is_index_option: false,
    is_published: true,
    help: "Plan a checkpoint every N segments. 2 by default",
    phrase: "step {}",
    samples: &["1"],
};

/// The greatest length of the path to a checkpoint.
pub(crate) static DETOUR: EngineOption = EngineOption {
    name: "detour",
    noun: "detour",
    kind: ValueKind::Number,
    key: Some("detour"),
    is_index_option: false,
    is_published: true,
    help: "Skip a checkpoint to which the path costs more than N times what it would cost on an empty grid. \
           3 by default",
    phrase: "detours up to {}",
    samples: &["1"],
};
