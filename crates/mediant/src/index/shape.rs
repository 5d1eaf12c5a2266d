//! The levels and the side of an index, against those that a setup names.

use std::num::NonZeroU32;

use crate::{
    configured::{ConfiguredEngine, HpaOptions},
    error::Error,
    option::Levels,
};

/// More levels than there can be are all levels: subgoal graphs have one word for both.
fn same(levels: Levels) -> Levels {
    if levels == Levels::Number(NonZeroU32::MAX) { Levels::All } else { levels }
}

/// Checks that an index has the levels and the side that the engine's options name, if they name them;
/// Sub-Theta* needs levels in any case.
pub(super) fn check(
    engine: ConfiguredEngine,
    levels: Option<Levels>,
    side: Option<u32>,
) -> Result<(), Error> {
    let named_side = match engine {
        ConfiguredEngine::Hpa(own) => own.side,
        ConfiguredEngine::Chpa(own) => own.side,
        _ => None,
    };
    if let Some((expected, found)) = named_side.zip(side)
        && expected.get() != found
    {
        return Err(Error::Side { expected: expected.get(), found });
    }
    let (is_named, expected) = match engine {
        ConfiguredEngine::Subgoal(own) => (own.levels.is_some(), own.levels),
        ConfiguredEngine::SubgoalTheta(own) => {
            (own.levels.is_some() || levels == Some(Levels::Contracted), engine.levels())
        }
        ConfiguredEngine::Hpa(own) => {
            // How many `all` levels are depends on the side.
            let on_its_side = HpaOptions { side: side.and_then(NonZeroU32::new), ..own };
            (own.levels.is_some(), ConfiguredEngine::Hpa(on_its_side).levels())
        }
        _ => (false, None),
    };
    match expected {
        Some(expected) if is_named && levels.map(same) != Some(same(expected)) => {
            Err(Error::Levels { expected, found: levels })
        }
        _ => Ok(()),
    }
}
