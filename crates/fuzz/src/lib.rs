//! Fuzzing targets: functions of bytes that panic when something is wrong.
//!
//! **The key decision: a target states what must hold, not only that nothing panics.** What is read is written
//! and read again, and is equal; two ways to read one file agree; a loaded index answers, and its paths are
//! legal by the oracle's definition. So a fuzzer, which knows nothing of paths, finds wrong answers as well.
//!
//! The targets know no fuzzer. `fuzz_targets/targets.rs` hands them to libFuzzer, which counts the edges of the
//! code that an input reaches and keeps inputs that reach new ones; `tests/replay.rs` runs the kept inputs, and
//! changed ones by seed, with stable Rust. `cargo xtask fuzz` runs all targets and keeps the record in
//! `docs/proof/fuzzing.json`.
//!
//! Few targets, and each broad: a first byte often chooses what the rest is. Each target is fuzzed until half an
//! hour passes without a new edge, so that many would take days.

mod bytes;
mod costs;
mod indexes;
mod maps;
mod numbers;
mod pictures;
mod rasters;
mod scenarios;
mod seeds;
mod sequence;
mod serialized;
mod words;

pub use seeds::{kept, seeds};

/// A function of bytes that a fuzzer tries.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its name, one word.
    pub name: &'static str,
    /// The bytes that it takes, in words.
    pub about: &'static str,
    /// Takes any bytes. It panics if what they mean is treated wrongly.
    pub run: fn(&[u8]),
}

/// All targets.
pub const TARGETS: &[Target] = &[
    Target {
        name: "sequence",
        about: "edits, repairs, saved indexes, queries with wishes",
        run: sequence::run,
    },
    Target {
        name: "sequence-costs",
        about: "the same where cells have costs: edits, repairs, fields, wishes",
        run: costs::run,
    },
    Target {
        name: "c-calls",
        about: "calls of the library for C, right and mistaken",
        run: mediant_fuzz_c::run,
    },
    Target { name: "map", about: "MovingAI maps, maps drawn as text, tiles", run: maps::run },
    Target { name: "picture", about: "pictures of maps: PNG, PGM, PBM", run: pictures::run_picture },
    Target { name: "ros", about: "maps of ROS: YAML and picture", run: pictures::run_ros },
    Target {
        name: "raster",
        about: "rasters of numbers: NPY, ESRI ASCII, PGM, PNG, GeoTIFF",
        run: rasters::run,
    },
    Target {
        name: "scenario",
        about: "scenarios, scenarios of maps that change, patches",
        run: scenarios::run,
    },
    Target { name: "words", about: "names, k, options, paces, setups, whole calls", run: words::run },
    Target { name: "serialized", about: "JSON and CBOR of all that serde reads", run: serialized::run },
    Target {
        name: "numbers",
        about: "costs, elevations, paces, places in the world, limits",
        run: numbers::run,
    },
    Target { name: "index-file", about: "saved indexes as whole files", run: indexes::run_file },
    Target {
        name: "index",
        about: "saved indexes behind a right header and checksum",
        run: indexes::run_payload,
    },
];

impl Target {
    /// The target of a name.
    #[must_use]
    pub fn find(name: &str) -> Option<&'static Self> {
        TARGETS.iter().find(|target| target.name == name)
    }

    /// All names, for a message.
    #[must_use]
    pub fn names() -> String {
        TARGETS.iter().map(|target| target.name).collect::<Vec<_>>().join(", ")
    }
}
