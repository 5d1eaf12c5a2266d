//! Fields over N(k) that follow a change of the map.
//!
//! Of a field only the distances are stored, and they are integers: the least sums of the costs of moves from
//! the sources. So whatever finds them finds the same ones. Two passes, each in the order of distances:
//!
//! 1. **Raising.** A vertex *is supported* if a legal move leads to it from a vertex whose distance is less
//!    by the cost of the move, and is not raised. The vertices near the changed cells that are not supported
//!    are raised, and then those that had no other support than raised ones. No move is shorter than a cell,
//!    so a vertex is looked at after all that may support it. Along its supports a path leads from each
//!    vertex that is not raised to a source: its old distance is not too short.
//! 2. **Lowering.** Dijkstra's algorithm, from the neighbors of raised vertices, and along all moves near the
//!    changed cells, where moves may have become legal. What it ends with is too short nowhere, and no move
//!    makes it shorter: everywhere else the old distances were so already. These are the distances. ∎
//!
//! *Near* a cell is what can have a move that depends on it: all within the longest move.
//!
//! **Closed gaps** (module `gaps`): a path ends at one, or starts, by the quadrant of the vertex's own cell.
//! Moves have a direction then ([`Repair::may_step`]): those to a gap lead no further. And at k = 2 a path of
//! two moves leads past a gap. All of this depends on cells that touch an end of the move.
//!
//! A vertex takes several times as long as in a new field, which looks at open ground by words. So a repair
//! gives up once it has looked at more than a small part of the vertices. What was cut off from all sources
//! takes a new field no time at all: there a repair looks at a small part of the vertices that are left.

use mediant_grid::{
    GridGraph, Interrupt, Interrupted, Placement, PlacementKind, Rectangle, VersionEdit, Versioned, Vertex,
    VertexId,
};
use mediant_moves::{Cost, Vector};

use super::{buckets::Buckets, gaps::past_a_gap};

/// One in so many vertices of a new field may be looked at before it is made: on open ground, where a new
/// field takes little, and elsewhere. Where they were cut off, of which a new field takes no notice, a third
/// of that. Measured so that even then both together mostly take at most 1.5 times as long as the new field:
/// see `docs/measurements/search.md`.
const SHARE: [u64; 2] = [32, 6];

/// One in so many may be looked at before all that is found out.
const FIRST_SHARE: u64 = 512;

/// So many vertices tell whether ground is open.
const SAMPLE: usize = 256;

/// So many are always looked at.
const AT_LEAST: u64 = 256;

/// The number of looks between two questions of an interrupt.
const LOOK: usize = crate::Limits::EXPANSIONS_PER_LOOK as usize;

/// The distances after a change of some cells, for a field that reaches so far from its sources; `None` if it
/// gives up. The grid graph is that after the change.
pub(super) fn repaired<P: Placement>(
    graph: &GridGraph<P>,
    (costs, reach): (&Versioned<Cost>, Cost),
    sources: &[Vertex],
    cells: &[Rectangle],
    interrupt: &Interrupt,
) -> Result<Option<Versioned<Cost>>, Interrupted> {
    interrupt.check("repairing the distances of a field")?;
    let longest = graph.steps().iter().map(|step| step.cost).max().unwrap_or(Cost::ZERO);
    // The ground around a source as far as the field reaches, if that is less than the map.
    let side = 2 * (reach.to_bits() >> Cost::FRACTION_BITS) + 3;
    let around = side.saturating_mul(side).saturating_mul(sources.len() as u64);
    let count = around.min(graph.vertex_count() as u64);
    let near = near(graph, cells);
    let area = |[x, y]: &[(i32, i32); 2]| (x.1 - x.0) as u64 * (y.1 - y.0) as u64;
    let all_near = near.iter().map(area).sum::<u64>();
    if all_near > count / SHARE[0] + AT_LEAST {
        return Ok(None);
    }
    let mut repair = Repair {
        graph,
        costs: costs.edit_if_room("repairing the distances of a field")?,
        reach,
        buckets: Buckets::new(0, longest),
        raised: Vec::new(),
        found: Vec::new(),
        sources,
        nearest: None,
        looks: count / FIRST_SHARE + AT_LEAST,
        count,
        interrupt,
    };
    let is_done = repair.run(&near);
    // The memory that is given up is that of the next one.
    let costs = repair.costs.finish();
    Ok(is_done?.then_some(costs))
}

/// The columns and rows of vertices that can have a move which depends on changed cells.
fn near<P: Placement>(graph: &GridGraph<P>, cells: &[Rectangle]) -> Vec<[(i32, i32); 2]> {
    let length = |v: Vector| v.x.abs().max(v.y.abs());
    let longest = graph.steps().iter().map(|step| length(step.vector())).max().unwrap_or(0);
    let (width, height) = P::vertices(graph.grid());
    // At corners a cell has one vertex more in each direction.
    let more = i32::from(P::KIND == PlacementKind::Corner);
    let span = |first: u32, count: u32, all: u32| {
        let end = first as i32 + count as i32 + more + longest;
        ((first as i32 - longest).max(0), end.min(all as i32))
    };
    cells.iter().map(|at| [span(at.x, at.width, width), span(at.y, at.height, height)]).collect()
}

fn vertices(near: &[[(i32, i32); 2]]) -> impl Iterator<Item = Vertex> {
    let rows = near.iter().flat_map(|&[x, y]| (y.0..y.1).map(move |y| (x, y)));
    rows.flat_map(|(x, y)| (x.0..x.1).map(move |x| Vertex::new(x, y)))
}

struct Repair<'r, P: Placement> {
    graph: &'r GridGraph<P>,
    costs: VersionEdit<Cost>,
    /// The greatest distance in the field.
    reach: Cost,
    /// One cell wide: each move leads to a later one.
    buckets: Buckets,
    /// The free ones.
    raised: Vec<Vertex>,
    /// Vertices with distances, on their way to the queue.
    found: Vec<(Cost, Vertex)>,
    sources: &'r [Vertex],
    /// The nearest free vertex that is raised.
    nearest: Option<(Cost, Vertex)>,
    /// The number of vertices that may be looked at yet.
    looks: u64,
    /// The vertices of a new field at most; 0 once it is known how many may be looked at.
    count: u64,
    interrupt: &'r Interrupt,
}

impl<P: Placement> Repair<'_, P> {
    /// Returns false if it gives up.
    fn run(&mut self, near: &[[(i32, i32); 2]]) -> Result<bool, Interrupted> {
        Ok(self.raise(near)? && self.lower(near)?)
    }

    /// Raises what is not supported any more. Returns false if it gives up.
    fn raise(&mut self, near: &[[(i32, i32); 2]]) -> Result<bool, Interrupted> {
        let mut seeds = Vec::new();
        for at in vertices(near) {
            let cost = self.cost(at);
            if cost != Cost::MAX && !(self.graph.is_free(at) && self.is_supported(at, cost)) {
                seeds.push((cost, at));
            }
            self.found.clear();
        }
        let free = seeds.iter().copied().filter(|&(_, at)| self.graph.is_free(at));
        self.nearest = free.min_by_key(|&(cost, _)| cost);
        self.in_order(seeds, Self::raise_one)
    }

    /// Finds the distances of raised vertices, and what is nearer than before. Returns false if it gives up.
    fn lower(&mut self, near: &[[(i32, i32); 2]]) -> Result<bool, Interrupted> {
        let mut seeds = Vec::new();
        let free = vertices(near).filter(|&at| self.graph.is_free(at));
        for at in free {
            self.find_nearer(at, |cost, to| seeds.push((cost, to)));
            seeds.extend(self.past_a_gap(at).map(|cost| (cost, at)));
        }
        for &at in &self.raised {
            seeds.extend(self.least(at).map(|cost| (cost, at)));
        }
        seeds.retain(|&(cost, at)| self.set_nearer(cost, at));
        self.in_order(seeds, Self::lower_one)
    }

    /// Visits vertices in the order of their distances, and with them what a visit queues. Returns false if
    /// it gives up.
    fn in_order(
        &mut self,
        mut seeds: Vec<(Cost, Vertex)>,
        visit: impl Fn(&mut Self, Vertex),
    ) -> Result<bool, Interrupted> {
        seeds.sort_unstable_by_key(|&(cost, _)| std::cmp::Reverse(cost.to_bits() >> Cost::FRACTION_BITS));
        self.buckets.clear();
        while let Some(&(first, _)) = seeds.last() {
            self.buckets.begin(first);
            loop {
                while let Some((cost, at)) = seeds.pop_if(|&mut (cost, _)| cost < self.buckets.end()) {
                    self.buckets.push(cost, at);
                }
                while let Some(at) = self.buckets.pop() {
                    self.interrupt.check_every(
                        LOOK,
                        self.looks as usize,
                        "repairing the distances of a field",
                    )?;
                    if self.looks == 0 && !self.looks_on() {
                        return Ok(false);
                    }
                    self.looks -= 1;
                    visit(self, at);
                }
                if !self.buckets.advance() {
                    break;
                }
            }
        }
        Ok(true)
    }

    /// Whether more vertices may be looked at.
    fn looks_on(&mut self) -> bool {
        let (graph, count) = (self.graph, std::mem::take(&mut self.count));
        let every = (graph.vertex_count() / SAMPLE).max(1);
        let sample = (0..graph.vertex_count() as u32).step_by(every).map(VertexId);
        let (mut sampled, mut free, mut open) = (0, 0, 0);
        for at in sample.map(|id| graph.vertex(id)) {
            sampled += 1;
            if graph.is_free(at) {
                let mut legal = 0;
                graph.for_each_legal_move(at, |_| legal += 1);
                free += 1;
                open += u64::from(legal == graph.steps().len());
            }
        }
        let mut left = free * count / sampled.max(1);
        let is_cut_off =
            |&(_, at): &(Cost, Vertex)| !self.sources.iter().any(|&source| graph.connected(source, at));
        if let Some((cost, _)) = self.nearest.filter(is_cut_off) {
            let nearer = self.costs.words().iter().filter(|&&other| other < cost).count();
            left = left.min(nearer as u64) / 3;
        }
        // By the square of the part that is open: whether two things are so in a row.
        let (all, open) = (free * free, open * open);
        self.looks = left * all / (SHARE[0] * open + SHARE[1] * (all - open)).max(1);
        self.looks > 0
    }

    fn raise_one(&mut self, at: Vertex) {
        let cost = self.cost(at);
        if cost == Cost::MAX {
            return;
        }
        if !self.graph.is_free(at) {
            // All its moves were, and near are those to which they led.
            return self.set(Cost::MAX, at);
        }
        self.found.clear();
        if self.is_supported(at, cost) {
            return;
        }
        self.set(Cost::MAX, at);
        self.raised.push(at);
        for (cost, at) in self.found.drain(..) {
            self.buckets.push(cost, at);
        }
    }

    /// Whether the distance of a free vertex has a support. Adds to the `found` those that it supports.
    #[inline]
    fn is_supported(&mut self, at: Vertex, cost: Cost) -> bool {
        let (graph, Some(id)) = (self.graph, self.graph.id(at)) else { return false };
        let mut is_supported = cost == Cost::ZERO;
        let mut found = std::mem::take(&mut self.found);
        graph.for_each_legal_move(at, |index| {
            let step = graph.step(index);
            let other = self.costs.words()[step.target(id).index()];
            if other < cost {
                is_supported |= other + step.cost == cost && self.may_step(at + step.vector(), at);
            } else if other == cost + step.cost && self.may_step(at, at + step.vector()) {
                found.push((other, at + step.vector()));
            }
        });
        self.found = found;
        is_supported || self.past_a_gap(at) == Some(cost)
    }

    fn lower_one(&mut self, at: Vertex) {
        let cost = self.cost(at);
        // It has become nearer since it was queued.
        if cost < self.buckets.start() {
            return;
        }
        let mut found = std::mem::take(&mut self.found);
        self.find_nearer(at, |cost, to| found.push((cost, to)));
        for (cost, to) in found.drain(..) {
            if self.set_nearer(cost, to) {
                self.buckets.push(cost, to);
            }
        }
        self.found = found;
    }

    /// The neighbors of a free vertex that are nearer by it than they are known to be.
    #[inline]
    fn find_nearer(&self, at: Vertex, mut nearer: impl FnMut(Cost, Vertex)) {
        let (graph, cost) = (self.graph, self.cost(at));
        let Some(id) = graph.id(at).filter(|_| cost != Cost::MAX) else { return };
        graph.for_each_legal_move(at, |index| {
            let step = graph.step(index);
            let (known, new) = (self.costs.words()[step.target(id).index()], cost + step.cost);
            if new < known && new <= self.reach && self.may_step(at, at + step.vector()) {
                nearer(new, at + step.vector());
            }
        });
    }

    /// The least distance of a free vertex by its neighbors, if it is in reach.
    fn least(&self, at: Vertex) -> Option<Cost> {
        let (graph, id) = (self.graph, self.graph.id(at)?);
        let mut least = self.past_a_gap(at).unwrap_or(Cost::MAX);
        graph.for_each_legal_move(at, |index| {
            let step = graph.step(index);
            let known = self.costs.words()[step.target(id).index()];
            if known < least && known + step.cost < least && self.may_step(at + step.vector(), at) {
                least = known + step.cost;
            }
        });
        (least <= self.reach).then_some(least)
    }

    /// At k = 2, the distance of a vertex to a source past a gap.
    #[inline]
    fn past_a_gap(&self, at: Vertex) -> Option<Cost> {
        if !self.graph.has_closed_gaps() {
            return None;
        }
        past_a_gap(self.graph, at, |to| self.cost(to) == Cost::ZERO)?;
        Some(Cost::of_move(Vector::new(1, 0)) * 2).filter(|&cost| cost <= self.reach)
    }

    /// Whether a shortest path may take a legal move, as far as closed gaps go.
    #[inline]
    fn may_step(&self, from: Vertex, to: Vertex) -> bool {
        !self.graph.has_closed_gaps() || self.may_step_at_gaps(from, to)
    }

    fn may_step_at_gaps(&self, from: Vertex, to: Vertex) -> bool {
        let graph = self.graph;
        if graph.is_closed_gap(from) {
            let is_source = self.cost(from) == Cost::ZERO;
            return is_source && !graph.is_closed_gap(to) && graph.may_turn(None, from, Some(to));
        }
        graph.may_turn(Some(from), to, None)
    }

    /// The distance as it is known; the greatest cost outside the map.
    #[inline]
    fn cost(&self, at: Vertex) -> Cost {
        self.graph.id(at).map_or(Cost::MAX, |id| self.costs.words()[id.index()])
    }

    fn set(&mut self, cost: Cost, at: Vertex) {
        if let Some(id) = self.graph.id(at) {
            self.costs.set(id.index(), cost);
        }
    }

    /// Returns whether the vertex was not as near before.
    fn set_nearer(&mut self, cost: Cost, at: Vertex) -> bool {
        let is_nearer = cost < self.cost(at);
        if is_nearer {
            self.set(cost, at);
        }
        is_nearer
    }
}
