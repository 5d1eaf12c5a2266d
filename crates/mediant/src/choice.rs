//! Which engine we would take.

use mediant_moves::K;

use crate::{configured::ConfiguredEngine, engine::Engine, setup::Setup, space::Space};

/// The engine that we would take, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The engine.
    pub engine: Engine,
    /// Why, in a sentence.
    pub why: &'static str,
}

/// The most cells of a map for which subgoal graphs pay (`docs/performance.md`).
const MOST_CELLS_FOR_SUBGOALS: u64 = 1 << 22;

impl Choice {
    /// For one path, after which everything is thrown away.
    pub(crate) fn for_one_path(k: K) -> Self {
        match k {
            K::Any => Self { engine: Engine::Anya, why: "it finds shortest paths and prepares nothing" },
            K::Finite(k) if k.get() <= 3 => {
                Self { engine: Engine::JpsBlock, why: "it prepares little and reads the map by words" }
            }
            K::Finite(_) => Self { engine: Engine::AStar, why: "it prepares nothing" },
        }
    }

    /// For many paths in a space.
    pub(crate) fn for_many_paths(space: &Space) -> Self {
        let (motion, map) = (space.motion(), space.map());
        let takes_subgoals = Setup::new(Engine::Subgoal, motion.k, motion.rules).check().is_ok();
        let cells = u64::from(map.width()) * u64::from(map.height());
        if takes_subgoals && cells <= MOST_CELLS_FOR_SUBGOALS {
            let why =
                "it prepares the map within about a second and then finds shortest paths in microseconds";
            return Self { engine: Engine::Subgoal, why };
        }
        match motion.k.finite().map(|k| k.get()) {
            None => {
                Self { engine: Engine::Anya, why: "on maps this large it is as fast as prepared engines" }
            }
            Some(2 | 3) => Self { engine: Engine::JpsBlock, why: "it reads the map by words of 64 cells" },
            Some(4 | 5) => Self { engine: Engine::Jps, why: "for these k jumping is faster than A*" },
            Some(_) => Self { engine: Engine::Canonical, why: "for large k pruning is faster than jumping" },
        }
    }
}

impl From<Choice> for ConfiguredEngine {
    fn from(choice: Choice) -> Self {
        choice.engine.into()
    }
}

impl std::fmt::Display for Choice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.engine, self.why)
    }
}
