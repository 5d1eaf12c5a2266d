//! `auto`: the engine for what is asked.
//!
//! `auto` is a word of calls, not an [`Engine`]: an engine has capabilities, options and a guarantee,
//! prepares indexes and is named by what it made, and `auto` has none of these before it is known what is
//! asked. So it stands beside the engines, in [`EngineName`](crate::options::EngineName), and is gone once a
//! [`Demand`] has met a [`Space`].

use crate::{
    call::Call,
    choice::Choice,
    configured::ConfiguredEngine,
    engine::Engine,
    map::Map,
    motion::Motion,
    option::{EngineOption, OptionValue},
    setup::Setup,
    setup_error::SetupError,
    space::Space,
};

/// The use of a space, as far as it decides which engine is recommended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Demand {
    /// So many paths or lengths, now.
    Paths(u64),
    /// So many paths or lengths between two edits of the map, on and on. 0 and 1: an edit before each path.
    Changing {
        /// The paths or lengths between two edits.
        paths: u64,
    },
    /// The distances from a vertex to all others.
    Distances,
    /// An index, to be saved.
    Index,
}

/// Up to so many paths an engine that prepares little is done sooner. On six maps of games, rooms and a city,
/// of 512 × 512 cells and less, the preparation of subgoals took as long as 240 to 30,000 queries of
/// block-based JPS at k = 3 (their geometric mean is 2,700), and as 380 to 25,000 of Anya at any angle.
const MOST_PATHS_WITHOUT_INDEX: u64 = 1_000;

/// Up to so many paths on costs A* is done sooner than landmarks are prepared and have answered. On surfaces
/// of 512 × 512 and 1024 × 1024 cells whose costs differ, the preparation took as long as 15 to 36 paths by
/// A* between random ends, of which each saved 72 to 90 %. Shorter paths save less.
const MOST_PATHS_WITHOUT_LANDMARKS: u64 = 100;

/// Up to so many paths between two edits of costs A* searches. A cell that became cheaper took landmarks 1 to
/// 5 ms in the mean there, one that became dearer or was blocked next to nothing; a path saved 9 to 67 ms.
const PATHS_BETWEEN_EDITS_OF_COSTS: u64 = 10;

/// For all distances.
const DISTANCES: Choice = Choice { engine: Engine::Dijkstra, why: "it finds the distances to all vertices" };

/// For an index where cells have costs.
const LANDMARKS: Choice =
    Choice { engine: Engine::Landmarks, why: "of the engines on costs it alone has an index" };

impl Space {
    /// The engine that we would take for what is asked, and why:
    /// - for one path [`Choice::for_next_path`], for up to 1,000 [`Choice::for_some_paths`], for more
    ///   [`Space::engine`];
    /// - for a map that changes an engine that follows the edits, by the motion, the size of the map, whether
    ///   it is noise or its obstacles stand alone, and the paths between two edits: up to 30 to 3,000 of them
    ///   one whose repair is quick, beyond that subgoals. These are reckoned as
    ///   [finished](crate::Index::finish) after every 40 edits; `docs/results/changes.md` has the figures;
    /// - for all distances Dijkstra's algorithm;
    /// - for an index subgoals, or JPS+ where they are not for this motion, or landmarks;
    /// - where cells have costs: for up to 100 paths, and for up to 10 between two edits, A*, for more
    ///   [`Space::engine`]; for an index landmarks.
    ///
    /// ```
    /// use mediant::{Demand, Engine, K, Map, Motion};
    /// let map = Map::from_fn(40, 40, |x, y| x % 9 == 4 && y % 7 != 3)?;
    /// let space = map.space(Motion::centers(K::N8))?;
    /// let engine = |demand| space.engine_for(demand).map(|choice| choice.engine);
    /// assert_eq!(engine(Demand::Paths(1)), Ok(Engine::Canonical));
    /// assert_eq!(engine(Demand::Paths(50)), Ok(Engine::JpsBlock));
    /// assert_eq!(engine(Demand::Paths(5_000)), Ok(Engine::Subgoal));
    /// assert_eq!(engine(Demand::Changing { paths: 1 }), Ok(Engine::JpsBlock));
    /// assert_eq!(engine(Demand::Changing { paths: 50 }), Ok(Engine::JpsPlus));
    /// assert_eq!(engine(Demand::Index), Ok(Engine::Subgoal));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`SetupError`] where no engine does that for the space's motion: an index between centers above k = 8;
    /// all distances at any angle (a [`field`](Self::field) has them); an index over elevation.
    pub fn engine_for(&self, demand: Demand) -> Result<Choice, SetupError> {
        if self.has_costs() { demand.choice_on_costs(self) } else { demand.choice(self.motion(), self.map()) }
    }

    /// The setup of a call in this space, whose motion is the space's, for what is asked; and why its engine
    /// is this one, if the call leaves that open.
    ///
    /// # Errors
    /// [`SetupError`] for an engine that does not take the motion, the options or the costs of cells.
    pub fn setup(&self, call: &Call, demand: Demand) -> Result<(Setup, Option<Choice>), SetupError> {
        if !self.has_costs() {
            return call.setup(demand, (self.motion(), self.map()));
        }
        let check = |engine| self.check_setup(&Setup::new(engine, self.motion()));
        let (engine, choice) = match call.engine() {
            Some(engine) => (call.configured(engine)?, None),
            None => {
                let choice = demand.choice_on_costs(self)?;
                let recommended = Choice::for_many_paths_on_costs(self).engine;
                let (engine, choice) = demand.with_options((choice, recommended), call.options(), check)?;
                (engine, Some(choice))
            }
        };
        let setup = Setup { smoothing: call.smoothing(), ..Setup::new(engine, self.motion()) };
        self.check_setup(&setup)?;
        Ok((setup, choice))
    }
}

impl Demand {
    /// The engine that we would take for this on a map: see [`Space::engine_for`].
    pub(crate) fn choice(self, motion: Motion, map: &Map) -> Result<Choice, SetupError> {
        let takes = |engine| Setup::new(engine, motion).check();
        match self {
            Self::Paths(0 | 1) => Ok(Choice::for_next_path(motion, map)),
            Self::Paths(2..=MOST_PATHS_WITHOUT_INDEX) => Ok(Choice::for_some_paths(motion)),
            Self::Paths(_) => Ok(Choice::for_many_paths(motion, map)),
            Self::Changing { paths } => Ok(Choice::for_changing_map(motion, map, paths)),
            Self::Distances => {
                takes(Engine::Dijkstra)?;
                Ok(DISTANCES)
            }
            Self::Index if takes(Engine::Subgoal).is_ok() => {
                let why = "of the engines with an index it has the fastest queries";
                Ok(Choice { engine: Engine::Subgoal, why })
            }
            Self::Index if takes(Engine::JpsPlus).is_ok() => Ok(Choice {
                engine: Engine::JpsPlus,
                why: "it has an index, and subgoals are not for these rules",
            }),
            Self::Index if takes(Engine::Landmarks).is_ok() => Ok(Choice {
                engine: Engine::Landmarks,
                why: "it has an index, and all others are not for this motion",
            }),
            Self::Index => Err(SetupError::NoIndex { motion }),
        }
    }

    /// The engine that we would take where cells have costs or elevations.
    fn choice_on_costs(self, space: &Space) -> Result<Choice, SetupError> {
        Ok(match self {
            Self::Paths(0..=MOST_PATHS_WITHOUT_LANDMARKS) => Choice::ON_COSTS,
            Self::Changing { paths: 0..=PATHS_BETWEEN_EDITS_OF_COSTS } => Choice::ON_COSTS,
            Self::Paths(_) | Self::Changing { .. } => Choice::for_many_paths_on_costs(space),
            Self::Distances => DISTANCES,
            Self::Index if space.walk().is_some() => return Err(SetupError::INDEX_OVER_ELEVATION),
            Self::Index => LANDMARKS,
        })
    }

    /// The same with options: the same engine if it takes them, else the first one that takes them and does
    /// what is asked.
    ///
    /// # Errors
    /// [`SetupError`] if there is none: that of the engine that we would take without the options.
    pub(crate) fn choice_with(
        self,
        (motion, map): (Motion, &Map),
        options: &[(&EngineOption, OptionValue)],
    ) -> Result<(ConfiguredEngine, Choice), SetupError> {
        let choices = (self.choice(motion, map)?, Choice::for_many_paths(motion, map).engine);
        self.with_options(choices, options, |engine| Setup::new(engine, motion).check())
    }

    /// The choice with options, among the engines that pass a check. After it comes the engine that is
    /// recommended for many paths.
    fn with_options(
        self,
        (choice, recommended): (Choice, Engine),
        options: &[(&EngineOption, OptionValue)],
        check: impl Fn(ConfiguredEngine) -> Result<(), SetupError>,
    ) -> Result<(ConfiguredEngine, Choice), SetupError> {
        let with_options = |engine: Engine| -> Result<ConfiguredEngine, SetupError> {
            let mut engine = ConfiguredEngine::from(engine);
            options.iter().try_for_each(|&(option, value)| engine.set(option, value))?;
            check(engine)?;
            Ok(engine)
        };
        let refused = match with_options(choice.engine) {
            Ok(engine) => return Ok((engine, choice)),
            Err(refused) => refused,
        };
        let does = |engine: Engine| match self {
            Self::Paths(_) | Self::Changing { .. } => true,
            Self::Distances => engine.capabilities().distances,
            Self::Index => engine.capabilities().index.is_some(),
        };
        // Then the engines in the order of their list.
        let others = [recommended].into_iter().chain(Engine::ALL).filter(|&engine| does(engine));
        let other = others.filter_map(|engine| with_options(engine).ok()).next();
        let why = "it takes the options that were given";
        other.map(|engine| (engine, Choice { engine: engine.kind(), why })).ok_or(refused)
    }
}
