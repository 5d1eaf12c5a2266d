//! Finding the labels: down a contraction hierarchy, each subgoal merges those of the subgoals above it.
//!
//! **Exact.** Let m be the highest of all subgoals on the shortest paths between c and h. A contraction
//! hierarchy has a shortest way from c to m that only goes up: its peak is on a shortest path between c and
//! h, too, so it is m. So m is found, with its cost, when c merges the hubs of the subgoals above it. A hub h
//! of c is dropped if another hub of h is on a path to it that is as short: then h is not the highest on the
//! shortest paths between c and h. m is not dropped from c, nor from h; so the two share it, and the sum is
//! the distance.
//!
//! A path that bends at the subgoal above as no shortest path does is left out: m is found without.
//!
//! **Fast.** Most of the time goes into the test whether another hub is between. It adds costs in 64 bits,
//! cut off at 2⁻³² cells; only sums that could be as small are added again as they are.
//!
//! **Order.** A level of the hierarchy depends on those above it alone. Its subgoals are merged on all cores,
//! with the same result.

use mediant_grid::{Interrupt, Interrupted};

use crate::contract::{ContractedGraph, SubgoalGeometry};

/// The stage that an interrupted call names.
const DURING: &str = "finding hub labels";

/// A hub of a subgoal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Label {
    pub(super) hub: u32,
    /// The next subgoal on a shortest path to the hub.
    pub(super) next: u32,
    /// The cost of this path, as the contraction compares costs, in two halves.
    cost: [u64; 2],
}

impl Label {
    pub(super) const fn new(hub: u32, next: u32, cost: u128) -> Self {
        Self { hub, next, cost: [cost as u64, (cost >> 64) as u64] }
    }

    /// The cost of the path to the hub, as the contraction compares costs.
    pub(super) const fn cost(&self) -> u128 {
        self.cost[0] as u128 | (self.cost[1] as u128) << 64
    }
}

/// Cuts off what a cost of the contraction has below 2⁻³² cells.
pub(super) type CutOff = fn(u128) -> u64;

/// The labels of all subgoals, sorted by hub; no subgoal is its own hub. `None` if the contraction left a
/// core, or if there are more than `most` labels. `progress` is told how many subgoals have theirs.
pub(super) fn merge(
    graph: &ContractedGraph,
    geometry: &(impl SubgoalGeometry + Sync),
    cut_off: CutOff,
    most: usize,
    progress: &mut dyn FnMut(usize),
    interrupt: &Interrupt,
) -> Result<Option<Vec<Vec<Label>>>, Interrupted> {
    if graph.contracted.contains(&false) {
        return Ok(None);
    }
    let mut labels: Vec<Vec<Label>> = vec![Vec::new(); graph.arcs.len()];
    let mut pool = Pool { count: graph.arcs.len(), cut_off, free: Vec::new() };
    let (mut total, mut done) = (0, 0);
    for level in levels(graph, interrupt)? {
        // So that there are never many more than that.
        for part in level.chunks(PART) {
            let made = pool.merge(part, (graph, geometry), &labels, interrupt)?;
            for (&id, own) in part.iter().zip(made) {
                total += own.len();
                labels[id as usize] = own;
            }
            if total > most {
                return Ok(None);
            }
            done += part.len();
            progress(done);
        }
    }
    Ok(Some(labels))
}

/// The subgoals that are merged at a time.
const PART: usize = 1 << 14;

/// The subgoals by the length of the longest way up from them, in the order of their numbers.
fn levels(graph: &ContractedGraph, interrupt: &Interrupt) -> Result<Vec<Vec<u32>>, Interrupted> {
    const PIECE: usize = 1 << 12;
    let count = graph.arcs.len();
    let mut below = vec![0_u32; count];
    for (number, arcs) in graph.arcs.iter().enumerate() {
        interrupt.check_every(PIECE, number, DURING)?;
        arcs.iter().for_each(|arc| below[arc.to as usize] += 1);
    }
    let mut order: Vec<u32> = (0..count as u32).filter(|&id| below[id as usize] == 0).collect();
    let mut next = 0;
    while let Some(&id) = order.get(next) {
        interrupt.check_every(PIECE, next, DURING)?;
        next += 1;
        for arc in &graph.arcs[id as usize] {
            below[arc.to as usize] -= 1;
            if below[arc.to as usize] == 0 {
                order.push(arc.to);
            }
        }
    }
    let mut height = vec![0_usize; count];
    let mut levels: Vec<Vec<u32>> = Vec::new();
    for (number, &id) in order.iter().rev().enumerate() {
        interrupt.check_every(PIECE, number, DURING)?;
        let own = graph.arcs[id as usize].iter().map(|arc| height[arc.to as usize] + 1).max().unwrap_or(0);
        height[id as usize] = own;
        if levels.len() <= own {
            levels.resize_with(own + 1, Vec::new);
        }
        levels[own].push(id);
    }
    levels.iter_mut().for_each(|level| level.sort_unstable());
    Ok(levels)
}

/// Scratch memory of all threads.
struct Pool {
    count: usize,
    cut_off: CutOff,
    free: Vec<Scratch>,
}

impl Pool {
    /// The labels of some subgoals of one level.
    #[cfg(feature = "parallel")]
    fn merge<G: SubgoalGeometry + Sync>(
        &mut self,
        part: &[u32],
        graph: (&ContractedGraph, &G),
        labels: &[Vec<Label>],
        interrupt: &Interrupt,
    ) -> Result<Vec<Vec<Label>>, Interrupted> {
        use rayon::prelude::*;
        /// Subgoals for which waking another thread pays.
        const LEAST: usize = 64;
        let cut_off = self.cut_off;
        let threads = rayon::current_num_threads().min(part.len().div_ceil(LEAST)).max(1);
        self.free.resize_with(self.free.len().max(threads), || Scratch::new(self.count));
        // Small pieces in turn: the subgoals of one level differ much in their work.
        let made = self.free[..threads]
            .par_iter_mut()
            .enumerate()
            .map(|(thread, scratch)| {
                let own = part.iter().skip(thread).step_by(threads);
                own.map(|&id| scratch.merge(id, graph, labels, (cut_off, interrupt))).collect()
            })
            .collect::<Result<Vec<Vec<Vec<Label>>>, _>>()?;
        let mut turns: Vec<_> = made.into_iter().map(Vec::into_iter).collect();
        Ok((0..part.len()).filter_map(|i| turns[i % threads].next()).collect())
    }

    #[cfg(not(feature = "parallel"))]
    fn merge<G: SubgoalGeometry + Sync>(
        &mut self,
        part: &[u32],
        graph: (&ContractedGraph, &G),
        labels: &[Vec<Label>],
        interrupt: &Interrupt,
    ) -> Result<Vec<Vec<Label>>, Interrupted> {
        let cut_off = self.cut_off;
        if self.free.is_empty() {
            self.free.push(Scratch::new(self.count));
        }
        let scratch = self.free.iter_mut().take(1);
        scratch
            .flat_map(|scratch| part.iter().map(|&id| scratch.merge(id, graph, labels, (cut_off, interrupt))))
            .collect()
    }
}

/// Scratch memory of a merge.
struct Scratch {
    /// By hub, the cost of the best known way to it, cut off; the largest number if there is none.
    rough: Vec<u64>,
    /// The same as it is, and the next subgoal on the way.
    best: Vec<(u128, u32)>,
    /// The hubs with a known way.
    hubs: Vec<u32>,
}

/// The cost of what has no known way: no sum with it overflows.
const NEVER: u64 = u64::MAX / 2;

impl Scratch {
    fn new(count: usize) -> Self {
        Self { rough: vec![NEVER; count], best: vec![(0, 0); count], hubs: Vec::new() }
    }

    /// The labels of a subgoal, from those of the subgoals above it.
    fn merge<G: SubgoalGeometry>(
        &mut self,
        id: u32,
        (graph, geometry): (&ContractedGraph, &G),
        labels: &[Vec<Label>],
        (cut_off, interrupt): (CutOff, &Interrupt),
    ) -> Result<Vec<Label>, Interrupted> {
        interrupt.check(DURING)?;
        let Self { rough, best, hubs } = self;
        let mut reach = |hub: u32, cost: u128, next: u32| {
            let (rough, known) = (&mut rough[hub as usize], &mut best[hub as usize]);
            if *rough == NEVER {
                hubs.push(hub);
            } else if *known <= (cost, next) {
                return;
            }
            (*rough, *known) = (cut_off(cost), (cost, next));
        };
        for arc in &graph.arcs[id as usize] {
            reach(arc.to, arc.cost, arc.first);
            let at = geometry.vertex(arc.to);
            let departures =
                geometry.bends(arc.to).map(|bends| bends.after(geometry.vertex(arc.last).to(at)));
            // Often the label before began with the same edge.
            let mut looked_at = (u32::MAX, false);
            for label in &labels[arc.to as usize] {
                if label.next != looked_at.0 {
                    let edge = at.to(geometry.vertex(label.next));
                    looked_at = (label.next, departures.is_none_or(|departures| departures.allows(edge)));
                }
                if looked_at.1 {
                    reach(label.hub, arc.cost + label.cost(), arc.first);
                }
            }
        }
        hubs.sort_unstable();
        let needed = |&hub: &u32| {
            let (cost, next) = best[hub as usize];
            // Cutting off takes less than 1 from each of the three.
            let most = cut_off(cost) + 1;
            let is_between = |label: &Label| {
                let way = label.hub as usize;
                rough[way] + cut_off(label.cost()) <= most && best[way].0 + label.cost() <= cost
            };
            let is_needed = !labels[hub as usize].iter().any(is_between);
            is_needed.then(|| Label::new(hub, next, cost))
        };
        let own = hubs.iter().filter_map(needed).collect();
        for hub in hubs.drain(..) {
            rough[hub as usize] = NEVER;
        }
        Ok(own)
    }
}
