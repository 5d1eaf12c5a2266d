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
//! cut off at 2⁻³² cells; only sums that could be as small are added again as they are. A list of labels is
//! in the order of their costs, and those that cost more than the way to the hub are not looked at.
//!
//! **Order.** A level of the hierarchy depends on those above it alone. Its subgoals are merged on all cores,
//! with the same result.

use mediant_grid::{Interrupt, Interrupted, room_for};

use super::lists::{Form, LabelLists};
use crate::{
    contract::{ContractedGraph, SubgoalGeometry},
    error::SubgoalError,
};

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

/// The labels of all subgoals, each subgoal's in the order of their costs; no subgoal is its own hub. `None`
/// if the contraction left a core, or if there are more than `most` labels. `progress` is told how many
/// subgoals have theirs.
///
/// # Errors
/// [`SubgoalError::Labels`] if a cost is too large; [`SubgoalError::Interrupted`].
pub(super) fn merge(
    graph: &ContractedGraph,
    geometry: &(impl SubgoalGeometry + Sync),
    form: Form,
    most: usize,
    progress: &mut dyn FnMut(usize),
    interrupt: &Interrupt,
) -> Result<Option<LabelLists>, SubgoalError> {
    if graph.contracted.contains(&false) {
        return Ok(None);
    }
    let mut labels = LabelLists::new(graph.arcs.len(), form);
    let mut pool = Pool { count: graph.arcs.len(), free: Vec::new() };
    let (mut total, mut done) = (0, 0);
    for level in levels(graph, interrupt)? {
        // So that there are never many more than that.
        for part in level.chunks(PART) {
            labels.check_room(DURING)?;
            let threads = pool.merge(part, (graph, geometry), &labels, interrupt)?;
            for (turn, &id) in part.iter().enumerate() {
                let own = pool.free[turn % threads].made.list(turn / threads);
                total += own[0].len();
                labels.add(id, own);
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
const PART: usize = 1 << 12;

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
    free: Vec<Scratch>,
}

impl Pool {
    /// Makes the labels of some subgoals of one level. They are left to several threads in turn, as many as
    /// it returns: the subgoals of one level differ much in their work.
    fn merge<G: SubgoalGeometry + Sync>(
        &mut self,
        part: &[u32],
        graph: (&ContractedGraph, &G),
        labels: &LabelLists,
        interrupt: &Interrupt,
    ) -> Result<usize, SubgoalError> {
        let threads = threads(part.len());
        let more = threads.saturating_sub(self.free.len());
        room_for::<(u64, (u128, u32), (u32, bool))>(more * self.count, DURING)?;
        self.free.resize_with(self.free.len().max(threads), || Scratch::new(self.count));
        let work = |(thread, scratch): (usize, &mut Scratch)| {
            scratch.made.clear();
            let mut own = part.iter().skip(thread).step_by(threads);
            own.try_for_each(|&id| scratch.merge(id, graph, labels, interrupt))
        };
        #[cfg(feature = "parallel")]
        if threads > 1 {
            use rayon::prelude::*;
            self.free[..threads].par_iter_mut().enumerate().try_for_each(work)?;
            return Ok(threads);
        }
        self.free[..threads].iter_mut().enumerate().try_for_each(work)?;
        Ok(threads)
    }
}

/// The threads for so many subgoals.
#[cfg(feature = "parallel")]
fn threads(subgoals: usize) -> usize {
    /// Subgoals for which waking another thread pays.
    const LEAST: usize = 64;
    let there = if mediant_grid::threads::are_there() { rayon::current_num_threads() } else { 1 };
    there.min(subgoals.div_ceil(LEAST)).max(1)
}

#[cfg(not(feature = "parallel"))]
const fn threads(_: usize) -> usize {
    1
}

/// Scratch memory of a merge.
struct Scratch {
    /// By hub, the part that is kept of the cost of the best known way to it; the largest number if there is
    /// none.
    rough: Vec<u64>,
    /// The same as it is, and the next subgoal on the way.
    best: Vec<(u128, u32)>,
    /// The hubs with a known way.
    hubs: Vec<u32>,
    /// These as first words of labels.
    sorted: Vec<u64>,
    allowed: Allowed,
    made: Made,
}

/// The labels that a thread made.
#[derive(Default)]
struct Made {
    /// Of each subgoal, the number of the label after its last one.
    ends: Vec<usize>,
    words: [Vec<u64>; 2],
}

impl Made {
    fn clear(&mut self) {
        self.ends.clear();
        self.words.iter_mut().for_each(Vec::clear);
    }

    fn push(&mut self, words: [u64; 2]) {
        self.words.iter_mut().zip(words).for_each(|(all, word)| all.push(word));
    }

    /// The words of the labels of one subgoal.
    fn list(&self, number: usize) -> [&[u64]; 2] {
        let first = number.checked_sub(1).map_or(0, |before| self.ends[before]);
        self.words.each_ref().map(|words| &words[first..self.ends[number]])
    }
}

/// By which edges paths may leave a subgoal. Few edges have many labels.
struct Allowed {
    /// By the subgoal to which the edge leads: the number of the last question, and its answer.
    known: Vec<(u32, bool)>,
    question: u32,
}

impl Allowed {
    /// Begins with another arrival.
    fn start(&mut self) {
        self.question = self.question.wrapping_add(1);
        if self.question == 0 {
            self.known.fill((0, false));
            self.question = 1;
        }
    }

    #[inline]
    fn ask(&mut self, next: u32, is_allowed: impl FnOnce() -> bool) -> bool {
        let known = &mut self.known[next as usize];
        if known.0 != self.question {
            *known = (self.question, is_allowed());
        }
        known.1
    }
}

/// The cost of what has no known way: no sum with it overflows.
const NEVER: u64 = u64::MAX / 2;

impl Scratch {
    fn new(count: usize) -> Self {
        let (rough, best) = (vec![NEVER; count], vec![(0, 0); count]);
        let allowed = Allowed { known: vec![(0, false); count], question: 0 };
        Self { rough, best, hubs: Vec::new(), sorted: Vec::new(), allowed, made: Made::default() }
    }

    /// Makes the labels of a subgoal, from those of the subgoals above it.
    fn merge<G: SubgoalGeometry>(
        &mut self,
        id: u32,
        (graph, geometry): (&ContractedGraph, &G),
        labels: &LabelLists,
        interrupt: &Interrupt,
    ) -> Result<(), SubgoalError> {
        interrupt.check(DURING)?;
        self.reach(id, (graph, geometry), labels);
        let Self { rough, best, hubs, sorted, made, .. } = self;
        let form = labels.form;
        sorted.clear();
        sorted.extend(hubs.iter().map(|&hub| form.first_word(hub, rough[hub as usize])));
        sorted.sort_unstable();
        for &word in &*sorted {
            let hub = form.id(word);
            let (cost, next) = best[hub as usize];
            // Cutting off takes less than 1 from each of the three.
            let most = rough[hub as usize] + 1;
            let above = labels.of(hub);
            let cheap = above.words[0].iter().take_while(|&&word| form.part(word) <= most);
            let is_between = |(number, &word): (usize, &u64)| {
                let way = form.id(word) as usize;
                rough[way] + form.part(word) <= most && best[way].0 + above.get(number).cost() <= cost
            };
            if !cheap.enumerate().any(is_between) {
                let label = Label::new(hub, next, cost);
                made.push(form.words(label).ok_or(SubgoalError::Labels)?);
            }
        }
        made.ends.push(made.words[0].len());
        for hub in hubs.drain(..) {
            rough[hub as usize] = NEVER;
        }
        Ok(())
    }

    /// Finds the best ways from a subgoal to the hubs of those above it.
    fn reach<G: SubgoalGeometry>(
        &mut self,
        id: u32,
        (graph, geometry): (&ContractedGraph, &G),
        labels: &LabelLists,
    ) {
        let Self { rough, best, hubs, allowed, .. } = self;
        let form = labels.form;
        let mut reach = |hub: u32, cost: u128, next: u32| {
            let (rough, known) = (&mut rough[hub as usize], &mut best[hub as usize]);
            let kept = form.kept(cost);
            if kept > *rough {
                return;
            }
            if *rough == NEVER {
                hubs.push(hub);
            } else if *known <= (cost, next) {
                return;
            }
            (*rough, *known) = (kept, (cost, next));
        };
        for arc in &graph.arcs[id as usize] {
            reach(arc.to, arc.cost, arc.first);
            let at = geometry.vertex(arc.to);
            let departures =
                geometry.bends(arc.to).map(|bends| bends.after(geometry.vertex(arc.last).to(at)));
            allowed.start();
            let above = labels.of(arc.to);
            let [kept, rest] = above.words;
            for (&kept, &rest) in kept.iter().zip(rest) {
                let edge = || at.to(geometry.vertex(form.id(rest)));
                if departures
                    .is_none_or(|departures| allowed.ask(form.id(rest), || departures.allows(edge())))
                {
                    reach(form.id(kept), arc.cost + form.cost([kept, rest]), arc.first);
                }
            }
        }
    }
}
