//! Contracting the subgoals of a graph: by levels, one after another, or by priority, in rounds.
//!
//! To contract a subgoal is to remove it, and to add a shortcut between two neighbors where every other path
//! is longer than the one over it. A search for a *witness*, a path that is as short, is cut off after some
//! work: then the shortcut is superfluous, and as long as the path over the subgoal. So distances stay,
//! however little is searched.

mod arc_lists;
mod evaluate;
mod overlay_arc;
mod priority;
mod rounds;
#[cfg(test)]
mod tests;
mod witness;

use mediant_grid::{Interrupt, Interrupted, Vector, Vertex, room_for};

pub(crate) use self::{arc_lists::ArcLists, overlay_arc::OverlayArc};

use self::witness::{WitnessGraph, WitnessSearch};
use crate::{arc::NONE, bends::BendRule, bounds::Bounds};

/// The geometry of the subgoals that are contracted.
pub(crate) trait SubgoalGeometry {
    /// The vertex of a subgoal.
    fn vertex(&self, id: u32) -> Vertex;

    /// How the paths whose distances are kept may bend at a subgoal; `None` if nothing is known.
    fn bends(&self, id: u32) -> Option<BendRule>;

    /// The cost from one subgoal to another where no obstacle is in the way: the least that a path can cost.
    fn distance(&self, from: u32, to: u32) -> u128;
}

/// A graph whose subgoals are contracted one after another. The distances between those that remain do not
/// change.
pub(crate) struct Contraction<G> {
    /// The arcs of the subgoals that are not contracted, to one another.
    arcs: ArcLists,
    /// The arcs of a contracted subgoal are those that it had when it was contracted.
    upward: ArcLists,
    contracted: Vec<bool>,
    order: Vec<u32>,
    geometry: G,
    /// The subgoals of the current round, which are contracted in the order of their numbers.
    in_round: Vec<bool>,
    interrupt: Interrupt,
}

/// The stage that an interrupted call names.
const DURING: &str = "contracting subgoals";

/// The graph as it is while subgoals are contracted.
pub(crate) trait Overlay {
    /// The arcs of a subgoal that is not contracted.
    fn around(&mut self, id: u32) -> &[OverlayArc];
}

/// The arcs of all subgoals, and the box around those that were looked at.
struct AllArcs<'c, G> {
    arcs: &'c ArcLists,
    geometry: &'c G,
    read: Bounds,
}

impl<G: SubgoalGeometry> Overlay for AllArcs<'_, G> {
    fn around(&mut self, id: u32) -> &[OverlayArc] {
        self.read.add(self.geometry.vertex(id));
        &self.arcs[id as usize]
    }
}

/// Scratch memory for finding shortcuts.
#[derive(Default)]
pub(crate) struct ShortcutFinder {
    around: Vec<OverlayArc>,
    witness: WitnessSearch,
    /// The displacements along the first edges of a subgoal's arcs.
    steps: Vec<Vector>,
    /// The numbers of the arcs by which a path may go on that arrives by one arc.
    onward: Vec<u32>,
}

/// The shortcuts that contracting a subgoal takes: pairs of its arcs, by their numbers.
pub(crate) type Shortcuts = Vec<(u32, u32)>;

/// A subgoal that a level was asked about: the level, counted from 0, its number, the box around what was
/// looked at, and its shortcuts if it was contracted.
pub(crate) type Decision<'c> = (u32, u32, Bounds, Option<&'c Shortcuts>);

/// The graph after contraction.
pub(crate) struct ContractedGraph {
    /// The arcs of a contracted subgoal to those that were contracted later or not at all; the arcs of each
    /// of the others to one another.
    pub(crate) arcs: ArcLists,
    /// Which subgoals were contracted.
    pub(crate) contracted: Vec<bool>,
    /// The contracted subgoals, first contracted first.
    #[cfg(test)]
    pub(crate) order: Vec<u32>,
}

impl<G: SubgoalGeometry> Contraction<G> {
    pub(crate) fn new(
        count: usize,
        edges: &[(u32, u32)],
        geometry: G,
        interrupt: Interrupt,
    ) -> Result<Self, Interrupted> {
        room_for::<OverlayArc>(2 * edges.len() + count, DURING)?;
        let mut counts = vec![0; count];
        for (number, &(a, b)) in edges.iter().enumerate() {
            interrupt.check_every(1 << 14, number, DURING)?;
            counts[a as usize] += 1;
            counts[b as usize] += 1;
        }
        let mut arcs = ArcLists::with_room(counts.into_iter());
        for (number, &(a, b)) in edges.iter().enumerate() {
            interrupt.check_every(1 << 14, number, DURING)?;
            let cost = geometry.distance(a, b);
            arcs.push(a, OverlayArc { cost, to: b, middle: NONE, first: b, last: a });
            arcs.push(b, OverlayArc { cost, to: a, middle: NONE, first: a, last: b });
        }
        let [contracted, in_round] = [(); 2].map(|()| vec![false; count]);
        let upward = ArcLists::with_room(std::iter::repeat_n(0, count));
        Ok(Self { arcs, upward, contracted, order: Vec::new(), geometry, in_round, interrupt })
    }

    pub(crate) fn finish(mut self) -> ContractedGraph {
        for (id, around) in (0..).zip(self.arcs.iter()) {
            if !self.contracted[id as usize] {
                self.upward.set(id, around);
            }
        }
        ContractedGraph {
            arcs: self.upward,
            contracted: self.contracted,
            #[cfg(test)]
            order: self.order,
        }
    }

    /// Makes as many levels above the first one, or all that differ.
    pub(crate) fn contract_levels(
        &mut self,
        most: u32,
        progress: &mut dyn FnMut(usize),
        decided: &mut dyn FnMut(Decision<'_>),
    ) -> Result<(), Interrupted> {
        for level in 0..most {
            if !self.contract_level(progress, &mut |id, read, made| decided((level, id, read, made)))? {
                break;
            }
        }
        Ok(())
    }

    /// Makes the next level. In the order of their numbers, contracts all subgoals that need no shortcut, or
    /// only shortcuts between subgoals that are h_k-reachable from one another. Returns whether there was
    /// one.
    fn contract_level(
        &mut self,
        progress: &mut dyn FnMut(usize),
        decided: &mut dyn FnMut(u32, Bounds, Option<&Shortcuts>),
    ) -> Result<bool, Interrupted> {
        let mut finder = ShortcutFinder::default();
        let mut any = false;
        for id in 0..self.arcs.len() as u32 {
            progress(id as usize);
            if self.contracted[id as usize] {
                continue;
            }
            let (shortcuts, read) = self.find_shortcuts(&mut finder, id, u64::MAX)?;
            let is_contracted = are_reachable(&self.geometry, &self.arcs[id as usize], &shortcuts);
            decided(id, read, is_contracted.then_some(&shortcuts));
            if is_contracted {
                self.contract(id, &shortcuts);
                any = true;
            }
        }
        Ok(any)
    }

    /// The shortcuts of a subgoal, and the box around what was looked at.
    fn find_shortcuts(
        &self,
        finder: &mut ShortcutFinder,
        id: u32,
        limit: u64,
    ) -> Result<(Shortcuts, Bounds), Interrupted> {
        let Self { arcs, geometry, in_round, interrupt, .. } = self;
        let mut all = AllArcs { arcs, geometry, read: Bounds::EMPTY };
        let shortcuts =
            ShortcutRule { geometry, in_round, interrupt, limit }.shortcuts(&mut all, finder, id)?;
        Ok((shortcuts, all.read))
    }

    /// Contracts a subgoal: removes the arcs that lead to it, and adds its shortcuts.
    fn contract(&mut self, id: u32, shortcuts: &Shortcuts) {
        let around = self.arcs[id as usize].to_vec();
        self.arcs.clear(id);
        for arc in &around {
            self.arcs.remove(arc.to, id);
        }
        for (from, arc) in shortcuts.iter().flat_map(|&pair| both_ways(id, &around, pair)) {
            self.arcs.add(from, arc);
        }
        self.upward.set(id, &around);
        self.contracted[id as usize] = true;
        self.order.push(id);
    }
}

/// The rule by which the shortcuts of a subgoal are found.
pub(crate) struct ShortcutRule<'c, G> {
    pub(crate) geometry: &'c G,
    /// The subgoals of the current round.
    pub(crate) in_round: &'c [bool],
    pub(crate) interrupt: &'c Interrupt,
    /// The arcs that a witness search scans.
    pub(crate) limit: u64,
}

impl<G: SubgoalGeometry> ShortcutRule<'_, G> {
    /// Finds the pairs of neighbors between which every path is longer than the one over the subgoal, as far
    /// as witness searches that scan `limit` arcs each can tell.
    pub(crate) fn shortcuts(
        &self,
        overlay: &mut impl Overlay,
        finder: &mut ShortcutFinder,
        id: u32,
    ) -> Result<Shortcuts, Interrupted> {
        let &Self { geometry, in_round, interrupt, limit } = self;
        let ShortcutFinder { around, witness, steps, onward } = finder;
        let mut shortcuts = Vec::new();
        around.clear();
        around.extend_from_slice(overlay.around(id));
        let (at, bends) = (geometry.vertex(id), geometry.bends(id));
        steps.clear();
        steps.extend(around.iter().map(|arc| at.to(geometry.vertex(arc.first))));
        for (i, p) in around.iter().enumerate() {
            onward.clear();
            let later = i as u32 + 1..around.len() as u32;
            match bends {
                Some(bends) => bends.after(-steps[i]).keep(steps, later, onward),
                None => onward.extend(later),
            }
            if onward.is_empty() {
                continue;
            }
            let targets = onward.iter().map(|&j| &around[j as usize]);
            interrupt.check(DURING)?;
            witness.start(in_round.len(), p.to, targets.map(|q| (q.to, p.cost + q.cost)))?;
            let graph = WitnessGraph { overlay, in_round, without: id };
            witness.run(graph, limit, |from, to| geometry.distance(from, to));
            let needed = onward.iter().filter(|&&j| !witness.has_witness(around[j as usize].to));
            shortcuts.extend(needed.map(|&j| (i as u32, j)));
        }
        Ok(shortcuts)
    }
}

/// Whether the ends of each shortcut are h_k-reachable from one another.
pub(crate) fn are_reachable(
    geometry: &impl SubgoalGeometry,
    around: &[OverlayArc],
    shortcuts: &Shortcuts,
) -> bool {
    shortcuts.iter().all(|&(p, q)| {
        let (p, q) = (around[p as usize], around[q as usize]);
        p.cost + q.cost == geometry.distance(p.to, q.to)
    })
}

/// A shortcut over a subgoal as an arc from each of its ends.
pub(crate) fn both_ways(id: u32, around: &[OverlayArc], (p, q): (u32, u32)) -> [(u32, OverlayArc); 2] {
    let (p, q) = (around[p as usize], around[q as usize]);
    let cost = p.cost + q.cost;
    [
        (p.to, OverlayArc { cost, to: q.to, middle: id, first: p.last, last: q.last }),
        (q.to, OverlayArc { cost, to: p.to, middle: id, first: q.last, last: p.last }),
    ]
}

/// Removes the arc to a subgoal.
pub(crate) fn remove(arcs: &mut Vec<OverlayArc>, id: u32) {
    if let Some(number) = arcs.iter().position(|arc| arc.to == id) {
        arcs.swap_remove(number);
    }
}

/// Adds a shortcut, unless there is an arc that costs no more; it replaces one that costs more.
pub(crate) fn add(arcs: &mut Vec<OverlayArc>, arc: OverlayArc) {
    match arcs.iter_mut().find(|known| known.to == arc.to) {
        Some(known) if known.cost <= arc.cost => {}
        Some(known) => *known = arc,
        None => arcs.push(arc),
    }
}
