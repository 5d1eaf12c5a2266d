//! Setups as the command line names them: their engine may be `auto`.

use std::path::Path;

use mediant::{Choice, Demand, Index, K, Motion, Space, call::Call};

use super::{
    costs::{CostsArgs, WalkingArgs},
    map::MapArgs,
};
use crate::{failure::Failure, map::NamedMap};

/// The engine, its options and the motion of a command's arguments.
#[derive(Clone, Debug)]
pub(crate) struct Asked {
    pub(crate) call: Call,
    pub(crate) motion: Motion,
}

impl Asked {
    /// [`of`](Self::of), which may be on costs: there the k has another cure than the engine knows.
    pub(crate) fn of_numbers(
        call: &Call,
        needs_index: bool,
        map: &MapArgs,
        costs: &CostsArgs,
        walking: &WalkingArgs,
    ) -> Result<Self, Failure> {
        Self::of(call, needs_index).or_else(|error| {
            if call.k()? == Some(K::Any)
                && let Ok(loaded) = NamedMap::load_ground(map, costs.reading)
                && let Ok(loaded) = loaded.with_numbers(map, costs, walking)
                && loaded.has_costs()
            {
                loaded.space(call.motion()?)?;
            }
            Err(error)
        })
    }

    /// The engine, options and motion of a call, checked as far as can be without a map; `needs_index` asks
    /// for an engine with a saved index.
    pub(crate) fn of(call: &Call, needs_index: bool) -> Result<Self, Failure> {
        call.check()?;
        if let Some(engine) = call.engine().filter(|_| needs_index) {
            engine.index_version()?;
        }
        Ok(Self { call: call.clone(), motion: call.motion()? })
    }

    /// The index of a space: a new one for what is asked, or that of a file, whose engine is the one that was
    /// left open; and why its engine is this one.
    pub(crate) fn index(
        &self,
        space: &Space,
        demand: Demand,
        file: Option<&Path>,
    ) -> Result<(Index, Option<Choice>), Failure> {
        let call = &self.call;
        let (index, choice) = match (file, call.engine()) {
            (None, _) => {
                let (setup, choice) = space.setup(call, demand)?;
                (space.prepare(setup.engine)?, choice)
            }
            (Some(path), Some(engine)) => (space.load_for(call.configured(engine)?, path)?, None),
            (Some(path), None) => {
                let index = space.load(path)?.with_call(call)?;
                let engine = index.setup().engine.kind();
                (index, Some(Choice { engine, why: "the index is of this engine" }))
            }
        };
        Ok((index.with_smoothing(call.smoothing()), choice))
    }
}
