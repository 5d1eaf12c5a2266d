//! Where results come from.

use serde::{Deserialize, Serialize};

/// Where the numbers of a record come from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// The revision of the sources as `git describe` writes it, with `-dirty` if files were changed since.
    pub revision: String,
    /// The machine. It matters only to times.
    pub machine: Machine,
    /// The names of the sets of maps.
    pub sets: Vec<String>,
    /// The number of maps.
    pub maps: usize,
    /// The number of queries, or of other cases, from which the numbers were computed.
    pub instances: u64,
    /// How these were chosen, in words.
    pub drawn: String,
    /// The seed, if they were chosen at random.
    pub seed: Option<u64>,
    /// Whether only an even sample of the whole experiment was run.
    pub quick: bool,
    /// Whether the maps are those that come with the project, because the sets were not downloaded.
    pub bundled: bool,
    /// The number of timed passes of which each time is the median; `None` if nothing was timed.
    pub passes: Option<u32>,
}

/// The machine on which an experiment ran.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// The operating system.
    pub os: String,
    /// The processor architecture.
    pub arch: String,
    /// The name of the processor, if known.
    pub cpu: Option<String>,
    /// The number of threads that it runs at once, if known.
    pub threads: Option<usize>,
}
