//! The setups that test suites try.

use std::num::NonZeroU32;

use mediant_search::Smoothing;

use crate::{
    configured::ConfiguredEngine,
    engine::Engine,
    engines::HpaOptions,
    motion::Motion,
    option::{EngineOption, Levels},
    setup::Setup,
};

/// The smoothed setups of [`Setup::all`]: by both methods, of paths over few and over many directions.
const SMOOTHED: [(Engine, Smoothing); 7] = [
    (Engine::AStar, Smoothing::Linear),
    (Engine::AStar, Smoothing::Taut),
    (Engine::Theta, Smoothing::Taut),
    (Engine::Anya, Smoothing::Taut),
    (Engine::Subgoal, Smoothing::Taut),
    (Engine::Hpa, Smoothing::Taut),
    (Engine::Chpa, Smoothing::Linear),
];

impl Setup {
    /// The setups for this motion that test suites try: each engine with its default options and
    /// with some values of each option, and a few with smoothing.
    ///
    /// For a finite k the first is A* with h_k. For k = ∞ the first is Anya at corners, and there is none at
    /// centers.
    pub fn all(motion: impl Into<Motion>) -> impl Iterator<Item = Self> {
        let motion = motion.into();
        let engines = Engine::ALL.into_iter().flat_map(samples).map(move |engine| Self::new(engine, motion));
        let smoothed = SMOOTHED
            .into_iter()
            .map(move |(engine, smoothing)| Self { smoothing: Some(smoothing), ..Self::new(engine, motion) });
        engines.chain(smoothed).filter(|setup| setup.check().is_ok())
    }
}

/// An engine with its default options, and with each sample of an option that it takes.
fn samples(kind: Engine) -> Vec<ConfiguredEngine> {
    let mut engines = vec![ConfiguredEngine::from(kind)];
    for option in EngineOption::ALL {
        for value in option.samples() {
            let mut engine = ConfiguredEngine::from(kind);
            if engine.set(option, value).is_ok() {
                engines.push(engine);
            }
        }
    }
    if kind == Engine::Hpa {
        // Small clusters, so that small maps have several on each level.
        let mut own = HpaOptions::default();
        (own.side, own.levels) = (NonZeroU32::new(3), NonZeroU32::new(3).map(Levels::Number));
        engines.push(ConfiguredEngine::Hpa(own));
    }
    engines
}
