//! Subgoal graphs and hub labels, computed or read from bytes.

use std::sync::Arc;

use mediant_grid::{FreeSpace, Interrupt};
use mediant_search::Query;
use mediant_subgoal::{HubLabels, PreparedSubgoals, SubgoalGraph, SubgoalPlacement};

use super::{Index, parts::InFreeSpace, source::Source};
use crate::{
    choice::Choice,
    configured::{ConfiguredEngine, SubgoalOptions},
    engine::Engine,
    error::Error,
    map::Map,
    motion::Motion,
    option::{Levels, Memory},
    planner::Planner,
    setup::Setup,
    space::Space,
};

/// The subgoals of a setup; `None` where nothing was kept, since the [`substitute`] is faster. They share
/// what they can with hub labels for another k, which are `beside`.
pub(super) fn subgoals<P: SubgoalPlacement>(
    setup: Setup,
    space: &FreeSpace<P>,
    source: Source<'_>,
    beside: Option<&HubLabels<P>>,
) -> Result<Option<InFreeSpace<P>>, Error> {
    let (k, progress, interrupt) = (setup.k, |step| (source.progress)(step), source.interrupt);
    // Sub-Theta* searches graphs alone.
    let ConfiguredEngine::Subgoal(SubgoalOptions { levels, memory }) = setup.engine else {
        let hierarchy = setup.engine.levels().and_then(Levels::hierarchy).unwrap_or_default();
        let graph = match source.bytes {
            None => SubgoalGraph::with_progress(space, k, hierarchy, &progress, interrupt)?,
            Some(bytes) => SubgoalGraph::from_bytes_interruptible(space, k, bytes, interrupt)?,
        };
        return Ok(Some(InFreeSpace::Subgoals(Arc::new(graph))));
    };
    let most = |default: Memory| memory.unwrap_or(default).as_usize();
    let prepared = match (source.bytes, levels) {
        (Some(bytes), _) => PreparedSubgoals::from_bytes_interruptible(space, k, bytes, interrupt)?,
        (None, None) => {
            let grid = space.grid();
            let most = most(Memory::for_labels_of(grid.width(), grid.height()));
            // Made only if it is asked. The planner of the library, which is compiled anyway.
            let mut unprepared = None;
            let mut counted = |query: Query| {
                let planner = match &mut unprepared {
                    Some(planner) => planner,
                    none => match substitute_of(setup, space, interrupt) {
                        Ok(planner) => none.insert(planner),
                        // Asked again, so that it is known what stopped it.
                        Err(_) => return interrupt.check("comparing engines").map(|()| None),
                    },
                };
                planner.count_work(query, interrupt)
            };
            PreparedSubgoals::compared(space, k, beside, most, (&progress, interrupt), &mut counted)?
        }
        (None, Some(levels)) => match levels.hierarchy() {
            Some(hierarchy) => {
                let graph = SubgoalGraph::with_progress(space, k, hierarchy, &progress, interrupt)?;
                PreparedSubgoals::Contracted(graph)
            }
            None => {
                let most = most(Memory::MAX);
                PreparedSubgoals::Labels(match beside {
                    None => HubLabels::within(space, k, most, &progress, interrupt)?,
                    Some(labels) => labels.for_k(space, k, most, &progress, interrupt)?,
                })
            }
        },
    };
    Ok(match prepared {
        PreparedSubgoals::Labels(labels) => Some(InFreeSpace::Labels(Arc::new(labels))),
        PreparedSubgoals::Contracted(graph) => Some(InFreeSpace::Subgoals(Arc::new(graph))),
        PreparedSubgoals::Nothing(_) => None,
    })
}

/// A planner by the engine that searches where no subgoals are kept: Anya as the typed crate measures it,
/// with no dead ends left out.
fn substitute_of<P: SubgoalPlacement>(
    setup: Setup,
    space: &FreeSpace<P>,
    interrupt: &Interrupt,
) -> Result<Planner, Error> {
    let motion = setup.motion();
    let space = Space::new(&Map::from(Arc::clone(space.grid())), motion, interrupt)?;
    let source = Source { for_one_path: true, interrupt, ..Source::new(&|_| {}) };
    Index::from_source(&space, substitute(motion).into(), source)?.try_planner()
}

/// The engine that searches where no subgoals were kept: the best that prepares little.
pub(super) fn substitute(motion: Motion) -> Engine {
    Choice::for_some_paths(motion).engine
}
