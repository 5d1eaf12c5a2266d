//! Whether a graph that keeps a large core is worth having.
//!
//! In noise there is no hierarchy: most subgoals stay in the core, and each search goes through it. Over N(k)
//! that is still faster than the engines that prepare nothing, on all noise that was measured. At any angle
//! it depends on the map, by a factor of five either way. So both answer the same few queries, and their work
//! is compared; it is counted, so that the same map gives the same index everywhere.

use mediant_grid::{Corners, FreeSpace, Placement, Vertex};
use mediant_moves::K;
use mediant_search::{Anya, Counters, Planner, Query};

use crate::{graph::SubgoalGraph, planner::SubgoalAStar};

/// The queries that both answer.
const QUERIES: usize = 12;

/// How many arcs of a core a search follows in the time in which Anya expands a node. On noise of 10 % and on
/// open ground with sparse cells, 512 × 512 and 2048 × 2048, it is between 30 and 130: the more memory the
/// arcs take, the fewer.
const ARCS_OF_AN_EXPANSION: u64 = 40;

/// How many arcs it follows in the time in which it joins an end to one subgoal that it sees.
const ARCS_OF_A_SUBGOAL: u64 = 30;

/// Whether Anya, which prepares nothing, takes less time than a search on the graph.
pub(crate) fn is_outdone(space: &FreeSpace<Corners>, graph: &SubgoalGraph<Corners>) -> bool {
    if graph.k() != K::Any || graph.has_small_core() {
        return false;
    }
    let Ok(mut on_graph) = SubgoalAStar::new(space, graph) else { return false };
    let mut anya = Anya::new(space);
    let [mut arcs, mut expansions] = [0, 0];
    for query in queries(space) {
        let [mut graph_counts, mut anya_counts] = [Counters::default(), Counters::default()];
        let both = [
            on_graph.solve_observed(query, &mut graph_counts).is_ok(),
            anya.solve_observed(query, &mut anya_counts).is_ok(),
        ];
        if both == [true; 2] {
            arcs += graph_counts.expanded * (graph.core_arcs() / graph.core()) as u64;
            arcs += graph_counts.generated * ARCS_OF_A_SUBGOAL;
            expansions += anya_counts.expanded;
        }
    }
    arcs > ARCS_OF_AN_EXPANSION * expansions
}

/// Queries between connected vertices anywhere on the map, the same each time.
fn queries(space: &FreeSpace<Corners>) -> impl Iterator<Item = Query> {
    let (width, height) = Corners::vertices(space.grid());
    let mut state = 0x2545_F491_4F6C_DD1D_u64;
    let mut below = move |most: u32| {
        // The multiplier is Knuth's; the upper bits are the better ones.
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        ((state >> 33) % u64::from(most)) as i32
    };
    let mut vertex = move || Vertex::new(below(width), below(height));
    let tries = (0..100 * QUERIES).map(move |_| Query::new(vertex(), vertex()));
    tries.filter(|query| space.connected(query.start, query.goal)).take(QUERIES)
}
