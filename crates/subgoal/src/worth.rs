//! The comparison of a graph that keeps a large core with an engine that prepares nothing.
//!
//! In noise and on open ground with sparse obstacles there is no hierarchy: most subgoals stay in the core,
//! and each search goes through it. Whether that is faster than an engine that prepares nothing depends on
//! the map, by a factor of five either way. So both answer the same few queries, and their work is compared;
//! it is counted, so that the same map gives the same index everywhere. The caller has that engine:
//! block-based JPS up to k = 3, and Anya beyond.

use mediant_grid::{FreeSpace, Interrupt, Interrupted, Placement, Vertex};
use mediant_moves::{FiniteK, K};
use mediant_search::{Counters, Ends, parts::count_work};

use crate::{graph::SubgoalGraph, placement::SubgoalPlacement, planner::SubgoalAStar};

/// How two engines are compared.
struct Comparison {
    /// The number of queries that both answer.
    queries: usize,
    /// How many arcs of a core a search follows, some 5 ns each, in the time in which it joins an end to one
    /// subgoal that it sees.
    arcs_of_a_subgoal: u64,
    /// And in the time in which the other engine expands a node.
    arcs_of_an_expansion: u64,
}

impl Comparison {
    /// Beside Anya. On noise of 10 % and on open ground with sparse cells, 512 × 512 and 2048 × 2048, a node
    /// takes as long as 30 to 130 arcs: the more memory the arcs take, the fewer.
    const ANYA: Self = Self { queries: 12, arcs_of_a_subgoal: 30, arcs_of_an_expansion: 40 };
    /// Lengths over N(k) take longer.
    const ANYA_OVER_K: Self = Self { arcs_of_an_expansion: 50, ..Self::ANYA };
    /// Beside block-based JPS up to k = 3, on noise of 5 to 20 %, on sparse cells and on maps of streets.
    const BLOCK_JPS: Self = Self { queries: 48, arcs_of_a_subgoal: 20, arcs_of_an_expansion: 30 };
    /// How many vertices are scanned in the time of an arc.
    const SCANNED_OF_AN_ARC: u64 = 3;
}

/// Answers a query by an engine that prepares nothing, and counts its work; `None` if it cannot. It may be
/// interrupted.
pub type Counted<'r> = dyn FnMut(Ends) -> Result<Option<Counters>, Interrupted> + 'r;

/// Whether the engine that prepares nothing takes less time than a search on the graph.
pub(crate) fn is_outdone<P: SubgoalPlacement>(
    space: &FreeSpace<P>,
    graph: &SubgoalGraph<P>,
    other: &mut Counted<'_>,
    interrupt: &Interrupt,
) -> Result<bool, Interrupted> {
    let by = match graph.k() {
        K::Finite(k) if k <= FiniteK::N8 => &Comparison::BLOCK_JPS,
        // Anya is not that fast.
        _ if graph.has_small_core() => return Ok(false),
        K::Any => &Comparison::ANYA,
        K::Finite(_) => &Comparison::ANYA_OVER_K,
    };
    let Ok(mut on_graph) = SubgoalAStar::new(space, graph) else { return Ok(false) };
    let of_a_core_node = (graph.core_arcs() / graph.core().max(1)) as u64;
    let [mut arcs, mut arcs_of_other] = [0, 0];
    for query in queries(space, by.queries) {
        if let (Some(here), Some(there)) = (count_work(&mut on_graph, query, interrupt)?.ok(), other(query)?)
        {
            arcs += here.expanded * of_a_core_node + here.generated * by.arcs_of_a_subgoal;
            arcs_of_other +=
                there.expanded * by.arcs_of_an_expansion + there.scanned / Comparison::SCANNED_OF_AN_ARC;
        }
    }
    Ok(arcs > arcs_of_other)
}

/// So many queries between connected vertices anywhere on the map, the same each time.
fn queries<P: Placement>(space: &FreeSpace<P>, count: usize) -> impl Iterator<Item = Ends> {
    let (width, height) = P::vertices(space.grid());
    let mut state = 0x2545_F491_4F6C_DD1D_u64;
    let mut below = move |most: u32| {
        // The multiplier is Knuth's; the upper bits are the better ones.
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        ((state >> 33) % u64::from(most)) as i32
    };
    let mut vertex = move || Vertex::new(below(width), below(height));
    let tries = (0..100 * count).map(move |_| Ends::new(vertex(), vertex()));
    tries.filter(|query| space.connected(query.start, query.goal)).take(count)
}
