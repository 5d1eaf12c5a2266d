//! The table of targets.

use crate::{costs, indexes, maps, numbers, pictures, rasters, scenarios, sequence, serialized, words};

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
    Target {
        name: "questions",
        about: "the program's files of paths, pairs, timelines: JSON lines and CSV",
        run: mediant_fuzz_cli::read,
    },
    Target { name: "words", about: "names, k, options, paces, setups, whole calls", run: words::run },
    Target { name: "serialized", about: "JSON and CBOR of all that serde reads", run: serialized::run },
    Target {
        name: "numbers",
        about: "costs, costmaps, elevations, paces, places in the world, limits",
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
