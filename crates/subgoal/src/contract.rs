//! Taking subgoals out of the graph, one after another.

use std::{cmp::Reverse, collections::BinaryHeap};

use mediant_grid::{Vector, Vertex};

use crate::taut::Bend;

/// No subgoal.
pub(crate) const NONE: u32 = u32::MAX;

/// A way to a neighbor: an edge, or a shortcut over `mid`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Arc {
    pub(crate) cost: u128,
    pub(crate) to: u32,
    /// [`NONE`] for an edge.
    pub(crate) mid: u32,
    /// The neighbor in the graph of edges that the way leads to first.
    pub(crate) first: u32,
    /// The one from which it comes to its end.
    pub(crate) last: u32,
}

/// What the subgoals are to the graph.
pub(crate) trait Rules {
    /// Where a subgoal is.
    fn vertex(&self, id: u32) -> Vertex;

    /// How the lightest paths may bend at a subgoal, as far as that is known.
    fn bend(&self, id: u32) -> Option<Bend>;

    /// What the way between two subgoals costs where nothing is in the way.
    fn weight(&self, from: u32, to: u32) -> u128;
}

/// How many arcs a search for a witness looks at.
const WITNESS_LIMIT: u64 = 800;
/// How many arcs more than it had may take the place of a subgoal.
const MAX_GROWTH: i64 = 200;

/// How many arcs the searches for witnesses look at altogether, before what is left stays as it is. In noise, where it
/// is used up, preparing takes 0.7 to 0.8 s.
const BUDGET: u64 = 1 << 26;

/// A graph from which subgoals are taken out. Those that are left keep their distances.
pub(crate) struct Contraction<R> {
    /// Of a subgoal that was taken out, the arcs that it had then.
    arcs: Vec<Vec<Arc>>,
    taken: Vec<bool>,
    rules: R,
    witness: Witness,
    /// What the last [`find_needed`](Self::find_needed) found.
    needed: Vec<(Arc, Arc)>,
    /// Scratch memory: the first steps to the neighbors.
    steps: Vec<Vector>,
}

/// What becomes of the graph.
pub(crate) struct Contracted {
    pub(crate) arcs: Vec<Vec<Arc>>,
    /// The subgoals that were taken out.
    pub(crate) taken: Vec<bool>,
}

impl<R: Rules> Contraction<R> {
    pub(crate) fn new(count: usize, edges: &[(u32, u32)], rules: R) -> Self {
        let mut arcs: Vec<Vec<Arc>> = vec![Vec::new(); count];
        for &(a, b) in edges {
            let cost = rules.weight(a, b);
            arcs[a as usize].push(Arc { cost, to: b, mid: NONE, first: b, last: a });
            arcs[b as usize].push(Arc { cost, to: a, mid: NONE, first: a, last: b });
        }
        Self {
            arcs,
            taken: vec![false; count],
            rules,
            witness: Witness::new(count),
            needed: Vec::new(),
            steps: Vec::new(),
        }
    }

    pub(crate) fn finish(self) -> Contracted {
        Contracted { arcs: self.arcs, taken: self.taken }
    }

    /// Takes out, in the order of their numbers, all subgoals that are needed by no others, or only by pairs that are h_k-reachable and are
    /// given a shortcut. Whether there was one.
    pub(crate) fn take_out_a_level(&mut self, progress: &mut dyn FnMut(usize)) -> bool {
        let mut any = false;
        for id in 0..self.arcs.len() as u32 {
            progress(id as usize);
            if self.taken[id as usize] {
                continue;
            }
            self.find_needed(id, u64::MAX);
            if self.needed_are_reachable() {
                self.take_out(id);
                any = true;
            }
        }
        any
    }

    fn needed_are_reachable(&self) -> bool {
        self.needed.iter().all(|(p, q)| p.cost + q.cost == self.rules.weight(p.to, q.to))
    }

    /// Takes out what costs least, until what is left is too dense.
    pub(crate) fn take_out_most(&mut self, progress: &mut dyn FnMut(usize)) {
        let count = self.arcs.len();
        let mut depth = vec![0_u32; count];
        let mut queue = BinaryHeap::with_capacity(count);
        // At first the price is a guess: the more neighbors, the dearer.
        queue.extend(self.arcs.iter().zip(0..).map(|(arcs, id)| Reverse((arcs.len() as i64, id))));
        let mut done = 0;
        while let Some(Reverse((_, id))) = queue.pop() {
            let price = self.price(id, &depth);
            if queue.peek().is_some_and(|&Reverse((next, _))| price > next) {
                queue.push(Reverse((price, id)));
                continue;
            }
            let growth = self.needed.len() as i64 - self.arcs[id as usize].len() as i64;
            if self.witness.looked_at > BUDGET || growth > MAX_GROWTH {
                break;
            }
            for arc in &self.arcs[id as usize] {
                let (next, neighbor) = (depth[id as usize] + 1, &mut depth[arc.to as usize]);
                *neighbor = (*neighbor).max(next);
            }
            self.take_out(id);
            done += 1;
            progress(done);
        }
    }

    /// What taking a subgoal out costs. Leaves the shortcuts in `needed`.
    fn price(&mut self, id: u32, depth: &[u32]) -> i64 {
        self.find_needed(id, WITNESS_LIMIT);
        let (added, removed) = (self.needed.len() as i64, self.arcs[id as usize].len() as i64);
        2 * added - removed + i64::from(depth[id as usize])
    }

    /// Finds the pairs of neighbors between which no way is as short as over the subgoal, as far as searches that look at `limit` arcs
    /// each can tell.
    fn find_needed(&mut self, id: u32, limit: u64) {
        let Self { arcs, rules, witness, needed, steps, .. } = self;
        needed.clear();
        let around = &arcs[id as usize];
        let (at, bend) = (rules.vertex(id), rules.bend(id));
        steps.clear();
        steps.extend(around.iter().map(|arc| at.to(rules.vertex(arc.first))));
        for (i, p) in around.iter().enumerate() {
            let others = || around.iter().zip(&*steps).skip(i + 1);
            let onward = bend.map(|bend| bend.after(-steps[i]));
            let may_pass = |step: Vector| onward.is_none_or(|onward| onward.allows(step));
            let pairs = || others().filter(|&(_, &step)| may_pass(step)).map(|(q, _)| q);
            witness.start(p.to, pairs().map(|q| (q.to, p.cost + q.cost)));
            witness.run(arcs, id, limit);
            needed.extend(pairs().filter(|q| witness.cost(q.to) > p.cost + q.cost).map(|q| (*p, *q)));
        }
    }

    /// Takes a subgoal out and adds the shortcuts `needed`.
    fn take_out(&mut self, id: u32) {
        for i in 0..self.arcs[id as usize].len() {
            let neighbor = self.arcs[id as usize][i].to;
            self.arcs[neighbor as usize].retain(|back| back.to != id);
        }
        self.taken[id as usize] = true;
        for (p, q) in std::mem::take(&mut self.needed) {
            let cost = p.cost + q.cost;
            self.add(p.to, Arc { cost, to: q.to, mid: id, first: p.last, last: q.last });
            self.add(q.to, Arc { cost, to: p.to, mid: id, first: q.last, last: p.last });
        }
    }

    /// Adds a shortcut in the place of a longer way between the same two.
    fn add(&mut self, from: u32, arc: Arc) {
        let arcs = &mut self.arcs[from as usize];
        match arcs.iter_mut().find(|known| known.to == arc.to) {
            Some(known) if known.cost <= arc.cost => {}
            Some(known) => *known = arc,
            None => arcs.push(arc),
        }
    }
}

/// Looks for ways that go around a subgoal.
struct Witness {
    labels: Vec<Label>,
    generation: u32,
    queue: BinaryHeap<Reverse<(u128, u32)>>,
    /// The targets that are not settled, and the largest of the costs that matter.
    targets: usize,
    /// How many arcs all searches looked at.
    looked_at: u64,
    most: u128,
}

#[derive(Clone, Copy, Default)]
struct Label {
    cost: u128,
    generation: u32,
    target: u32,
}

impl Witness {
    fn new(count: usize) -> Self {
        Self {
            labels: vec![Label::default(); count],
            generation: 0,
            queue: BinaryHeap::new(),
            targets: 0,
            looked_at: 0,
            most: 0,
        }
    }

    /// Begins at a subgoal, on the way to targets that must be reached at these costs.
    fn start(&mut self, from: u32, targets: impl Iterator<Item = (u32, u128)>) {
        self.generation += 1;
        (self.targets, self.most) = (0, 0);
        self.queue.clear();
        for (to, cost) in targets {
            self.labels[to as usize].target = self.generation;
            self.targets += 1;
            self.most = self.most.max(cost);
        }
        self.reach(from, 0);
    }

    fn reach(&mut self, at: u32, cost: u128) {
        if cost < self.cost(at) {
            let label = &mut self.labels[at as usize];
            (label.cost, label.generation) = (cost, self.generation);
            self.queue.push(Reverse((cost, at)));
        }
    }

    fn run(&mut self, arcs: &[Vec<Arc>], without: u32, limit: u64) {
        let limit = self.looked_at.saturating_add(limit);
        while self.targets > 0 && self.looked_at < limit {
            let Some(Reverse((cost, at))) = self.queue.pop() else { return };
            if cost > self.most {
                return;
            }
            if cost > self.cost(at) {
                continue;
            }
            self.looked_at += arcs[at as usize].len() as u64;
            if self.labels[at as usize].target == self.generation {
                self.targets -= 1;
            }
            for arc in &arcs[at as usize] {
                if arc.to != without && cost + arc.cost <= self.most {
                    self.reach(arc.to, cost + arc.cost);
                }
            }
        }
    }

    /// The cost of the best way found.
    fn cost(&self, to: u32) -> u128 {
        let label = self.labels[to as usize];
        if label.generation == self.generation { label.cost } else { u128::MAX }
    }
}
