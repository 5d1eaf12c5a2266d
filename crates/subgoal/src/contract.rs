//! Contracting the subgoals of a graph, one after another.

use std::{cmp::Reverse, collections::BinaryHeap};

use mediant_grid::{Vector, Vertex};

use crate::{arc::NONE, bends::BendRule};

/// An arc of the overlay graph, which holds the subgoals that are not contracted yet: an edge or a shortcut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct OverlayArc {
    pub(crate) cost: u128,
    pub(crate) to: u32,
    /// The contracted subgoal that a shortcut passes; [`NONE`] for an edge.
    pub(crate) middle: u32,
    /// The end of the first edge of the path that the arc stands for.
    first: u32,
    /// The beginning of its last edge.
    last: u32,
}

/// The geometry of the subgoals that are contracted.
pub(crate) trait SubgoalGeometry {
    /// The vertex of a subgoal.
    fn vertex(&self, id: u32) -> Vertex;

    /// How the paths whose distances are kept may bend at a subgoal; `None` if nothing is known.
    fn bends(&self, id: u32) -> Option<BendRule>;

    /// The cost from one subgoal to another where no obstacle is in the way.
    fn distance(&self, from: u32, to: u32) -> u128;
}

/// The most arcs that one witness search scans.
const WITNESS_LIMIT: u64 = 800;
/// The most arcs that the contraction of a subgoal may add, less those that it removes.
const MAX_GROWTH: i64 = 200;

/// The most arcs that all witness searches scan together; the subgoals that remain then are the core. Only
/// maps of noise reach it, and are prepared in 0.7 to 0.8 s.
const WITNESS_BUDGET: u64 = 1 << 26;

/// A graph whose subgoals are contracted one after another. The distances between those that remain do not
/// change.
pub(crate) struct Contraction<G> {
    /// The arcs of a contracted subgoal are those that it had when it was contracted.
    arcs: Vec<Vec<OverlayArc>>,
    contracted: Vec<bool>,
    geometry: G,
    witness: WitnessSearch,
    /// The shortcuts that the last [`find_shortcuts`](Self::find_shortcuts) found: pairs of arcs of one
    /// subgoal.
    shortcuts: Vec<(OverlayArc, OverlayArc)>,
    /// Scratch memory: the displacements along the first edges of a subgoal's arcs.
    steps: Vec<Vector>,
}

/// The graph after contraction.
pub(crate) struct ContractedGraph {
    /// The arcs of a contracted subgoal to those that were contracted later or not at all; the arcs of each
    /// of the others to one another.
    pub(crate) arcs: Vec<Vec<OverlayArc>>,
    /// Which subgoals were contracted.
    pub(crate) contracted: Vec<bool>,
}

impl<G: SubgoalGeometry> Contraction<G> {
    pub(crate) fn new(count: usize, edges: &[(u32, u32)], geometry: G) -> Self {
        let mut arcs: Vec<Vec<OverlayArc>> = vec![Vec::new(); count];
        for &(a, b) in edges {
            let cost = geometry.distance(a, b);
            arcs[a as usize].push(OverlayArc { cost, to: b, middle: NONE, first: b, last: a });
            arcs[b as usize].push(OverlayArc { cost, to: a, middle: NONE, first: a, last: b });
        }
        Self {
            arcs,
            contracted: vec![false; count],
            geometry,
            witness: WitnessSearch::new(count),
            shortcuts: Vec::new(),
            steps: Vec::new(),
        }
    }

    pub(crate) fn finish(self) -> ContractedGraph {
        ContractedGraph { arcs: self.arcs, contracted: self.contracted }
    }

    /// Makes the next level. In the order of their numbers, contracts all subgoals that need no shortcut, or
    /// only shortcuts between subgoals that are h_k-reachable from one another. Returns whether there was
    /// one.
    pub(crate) fn contract_level(&mut self, progress: &mut dyn FnMut(usize)) -> bool {
        let mut any = false;
        for id in 0..self.arcs.len() as u32 {
            progress(id as usize);
            if self.contracted[id as usize] {
                continue;
            }
            self.find_shortcuts(id, u64::MAX);
            if self.shortcuts_are_reachable() {
                self.contract(id);
                any = true;
            }
        }
        any
    }

    fn shortcuts_are_reachable(&self) -> bool {
        self.shortcuts.iter().all(|(p, q)| p.cost + q.cost == self.geometry.distance(p.to, q.to))
    }

    /// Contracts subgoals, lowest priority first, until the remaining graph is too dense or the budget is
    /// used up.
    pub(crate) fn contract_by_priority(&mut self, progress: &mut dyn FnMut(usize)) {
        let count = self.arcs.len();
        let mut depth = vec![0_u32; count];
        let mut queue = BinaryHeap::with_capacity(count);
        // The first priorities are guesses: the number of neighbors.
        queue.extend(self.arcs.iter().zip(0..).map(|(arcs, id)| Reverse((arcs.len() as i64, id))));
        let mut done = 0;
        while let Some(Reverse((_, id))) = queue.pop() {
            let priority = self.priority(id, &depth);
            if queue.peek().is_some_and(|&Reverse((next, _))| priority > next) {
                queue.push(Reverse((priority, id)));
                continue;
            }
            let growth = self.shortcuts.len() as i64 - self.arcs[id as usize].len() as i64;
            if self.witness.arcs_scanned > WITNESS_BUDGET || growth > MAX_GROWTH {
                break;
            }
            for arc in &self.arcs[id as usize] {
                let (next, neighbor) = (depth[id as usize] + 1, &mut depth[arc.to as usize]);
                *neighbor = (*neighbor).max(next);
            }
            self.contract(id);
            done += 1;
            progress(done);
        }
    }

    /// The priority of a subgoal: the lower, the earlier it is contracted. Leaves its shortcuts in
    /// `shortcuts`.
    fn priority(&mut self, id: u32, depth: &[u32]) -> i64 {
        self.find_shortcuts(id, WITNESS_LIMIT);
        let (added, removed) = (self.shortcuts.len() as i64, self.arcs[id as usize].len() as i64);
        2 * added - removed + i64::from(depth[id as usize])
    }

    /// Finds the pairs of neighbors between which every path is longer than the one over the subgoal, as far
    /// as witness searches that scan `limit` arcs each can tell.
    fn find_shortcuts(&mut self, id: u32, limit: u64) {
        let Self { arcs, geometry, witness, shortcuts, steps, .. } = self;
        shortcuts.clear();
        let around = &arcs[id as usize];
        let (at, bends) = (geometry.vertex(id), geometry.bends(id));
        steps.clear();
        steps.extend(around.iter().map(|arc| at.to(geometry.vertex(arc.first))));
        for (i, p) in around.iter().enumerate() {
            let others = || around.iter().zip(&*steps).skip(i + 1);
            let departures = bends.map(|bends| bends.after(-steps[i]));
            let may_pass = |step: Vector| departures.is_none_or(|departures| departures.allows(step));
            let pairs = || others().filter(|&(_, &step)| may_pass(step)).map(|(q, _)| q);
            witness.start(p.to, pairs().map(|q| (q.to, p.cost + q.cost)));
            witness.run(arcs, id, limit);
            shortcuts.extend(pairs().filter(|q| witness.cost(q.to) > p.cost + q.cost).map(|q| (*p, *q)));
        }
    }

    /// Contracts a subgoal: removes the arcs that lead to it, and adds the shortcuts in `shortcuts`.
    fn contract(&mut self, id: u32) {
        for i in 0..self.arcs[id as usize].len() {
            let neighbor = self.arcs[id as usize][i].to;
            self.arcs[neighbor as usize].retain(|back| back.to != id);
        }
        self.contracted[id as usize] = true;
        for (p, q) in std::mem::take(&mut self.shortcuts) {
            let cost = p.cost + q.cost;
            self.add(p.to, OverlayArc { cost, to: q.to, middle: id, first: p.last, last: q.last });
            self.add(q.to, OverlayArc { cost, to: p.to, middle: id, first: q.last, last: p.last });
        }
    }

    /// Adds a shortcut, unless there is an arc that costs no more; it replaces one that costs more.
    fn add(&mut self, from: u32, arc: OverlayArc) {
        let arcs = &mut self.arcs[from as usize];
        match arcs.iter_mut().find(|known| known.to == arc.to) {
            Some(known) if known.cost <= arc.cost => {}
            Some(known) => *known = arc,
            None => arcs.push(arc),
        }
    }
}

/// Searches for paths that avoid a subgoal: witnesses that it needs no shortcut.
struct WitnessSearch {
    nodes: Vec<WitnessNode>,
    generation: u32,
    queue: BinaryHeap<Reverse<(u128, u32)>>,
    /// The number of targets that are not closed.
    targets: usize,
    /// The largest cost at which a target must be reached.
    max_cost: u128,
    /// The number of arcs that all searches scanned.
    arcs_scanned: u64,
}

#[derive(Clone, Copy, Default)]
struct WitnessNode {
    cost: u128,
    /// The last search that reached it.
    generation: u32,
    /// The last search that had it as a target.
    target: u32,
}

impl WitnessSearch {
    fn new(count: usize) -> Self {
        Self {
            nodes: vec![WitnessNode::default(); count],
            generation: 0,
            queue: BinaryHeap::new(),
            targets: 0,
            max_cost: 0,
            arcs_scanned: 0,
        }
    }

    /// Starts a search from a subgoal to targets, each with the cost at which it must be reached.
    fn start(&mut self, from: u32, targets: impl Iterator<Item = (u32, u128)>) {
        self.generation = self.generation.wrapping_add(1);
        if self.generation == 0 {
            self.nodes.fill(WitnessNode::default());
            self.generation = 1;
        }
        (self.targets, self.max_cost) = (0, 0);
        self.queue.clear();
        for (to, cost) in targets {
            self.nodes[to as usize].target = self.generation;
            self.targets += 1;
            self.max_cost = self.max_cost.max(cost);
        }
        self.reach(from, 0);
    }

    fn reach(&mut self, at: u32, cost: u128) {
        if cost < self.cost(at) {
            let node = &mut self.nodes[at as usize];
            (node.cost, node.generation) = (cost, self.generation);
            self.queue.push(Reverse((cost, at)));
        }
    }

    /// Dijkstra's algorithm, until every target is closed or `limit` arcs are scanned.
    fn run(&mut self, arcs: &[Vec<OverlayArc>], without: u32, limit: u64) {
        let limit = self.arcs_scanned.saturating_add(limit);
        while self.targets > 0 && self.arcs_scanned < limit {
            let Some(Reverse((cost, at))) = self.queue.pop() else { return };
            if cost > self.max_cost {
                return;
            }
            if cost > self.cost(at) {
                continue;
            }
            self.arcs_scanned += arcs[at as usize].len() as u64;
            if self.nodes[at as usize].target == self.generation {
                self.targets -= 1;
            }
            for arc in &arcs[at as usize] {
                if arc.to != without && cost + arc.cost <= self.max_cost {
                    self.reach(arc.to, cost + arc.cost);
                }
            }
        }
    }

    /// The cost of the best path found.
    fn cost(&self, to: u32) -> u128 {
        let node = self.nodes[to as usize];
        if node.generation == self.generation { node.cost } else { u128::MAX }
    }
}
