//! Preparation before the first query: its time and memory.

use mediant::{
    Index, Space,
    options::{EngineOption, Levels, OptionValue},
};
use serde::{Deserialize, Serialize};

/// The preparation of one of our engines before its first query: its search space and index.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Preparation {
    /// The time in seconds, measured once.
    pub seconds: f64,
    /// The memory in bytes, without the map.
    pub bytes: u64,
    /// The part of it that the index takes; the rest is the search space.
    pub index_bytes: u64,
    /// The kind of index of `subgoal`; `None` for other engines.
    pub kept: Option<Kept>,
}

/// The kind of index that the engine `subgoal` keeps of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kept {
    /// Hub labels.
    Labels,
    /// A contraction hierarchy.
    Contraction,
    /// A graph with levels.
    Levels,
    /// Nothing: another engine searches.
    Nothing,
}

impl Kept {
    /// As in JSON.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Labels => "labels",
            Self::Contraction => "contraction",
            Self::Levels => "levels",
            Self::Nothing => "nothing",
        }
    }

    fn of(index: &Index) -> Option<Self> {
        let engine = index.setup().engine.kind();
        if engine != mediant::Engine::Subgoal {
            return None;
        }
        if index.searched_by() != engine {
            return Some(Self::Nothing);
        }
        let levels = EngineOption::ALL.into_iter().find(|option| option.name == "levels")?;
        match index.value(levels)? {
            OptionValue::Levels(Levels::Labels) => Some(Self::Labels),
            OptionValue::Levels(Levels::Contracted) => Some(Self::Contraction),
            _ => Some(Self::Levels),
        }
    }
}

impl Preparation {
    /// The preparation of an index and its space, which took so many seconds together.
    pub(crate) fn of(space: &Space, index: &Index, seconds: f64) -> Self {
        let index_bytes = index.memory_bytes();
        Self { seconds, bytes: space.memory_bytes() + index_bytes, index_bytes, kept: Kept::of(index) }
    }
}

#[cfg(test)]
mod tests {
    use mediant::{Map, Setup};

    use super::*;

    #[test]
    fn it_is_known_what_is_kept() {
        let map = Map::from_fn(9, 9, |x, y| x == 4 && y != 8).unwrap();
        for (text, kept) in [
            ("subgoal:3:never", Some(Kept::Labels)),
            ("subgoal:any:open,memory=1", Some(Kept::Contraction)),
            ("subgoal:any:open,levels=contracted", Some(Kept::Contraction)),
            ("subgoal:3:open,levels=2", Some(Kept::Levels)),
            ("subgoal-theta:3:open", None),
            ("anya:any:open", None),
            ("astar:3:never", None),
        ] {
            let setup: Setup = text.parse().unwrap();
            let space = setup.space(&map).unwrap();
            let index = setup.prepare(&space).unwrap();
            let made = Preparation::of(&space, &index, 1.5);
            assert_eq!((made.kept, made.seconds), (kept, 1.5), "{text}");
            assert_eq!(made.index_bytes > 0, text != "astar:3:never", "{text}");
            assert_eq!(made.bytes, space.memory_bytes() + made.index_bytes, "{text}");
        }
    }
}
