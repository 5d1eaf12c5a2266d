//! The lists of arcs of a few subgoals, at any time while levels are made.

use mediant_grid::{Corners, Vertex};

use super::{Bounds, Edges, LevelRecord, NONE};
use crate::{
    arc::UpwardArc,
    contract::{Overlay, OverlayArc, Shortcuts, SubgoalGeometry as _, add, both_ways, remove},
    graph::SubgoalGraph,
    placement::BuildContext,
};

/// A subgoal that is contracted: the arcs that it had, and its shortcuts.
#[derive(Clone, Debug)]
pub(super) struct Contracted {
    pub(super) around: Vec<OverlayArc>,
    pub(super) shortcuts: Shortcuts,
}

impl Contracted {
    /// Its offers to each neighbor, in order: first the loss of the arc to it, then shortcuts.
    pub(super) fn offers(&self, id: u32) -> Vec<(u32, OverlayArc)> {
        let loss = OverlayArc { cost: 0, to: id, middle: NONE, first: NONE, last: NONE };
        let mut offers: Vec<_> = self.around.iter().map(|arc| (arc.to, loss)).collect();
        offers.extend(self.shortcuts.iter().flat_map(|&pair| both_ways(id, &self.around, pair)));
        offers.sort_by_key(|&(to, _)| to);
        offers
    }
}

/// The graph of the map after an edit while its levels are made: the lists that are asked for, from their
/// edges and from the decisions about the subgoals in them.
pub(super) struct Replay<'m> {
    /// The graph of the earlier map, and its record.
    pub(super) then: (&'m SubgoalGraph<Corners>, &'m LevelRecord),
    pub(super) context: BuildContext<'m, Corners>,
    pub(super) edges: &'m Edges,
    /// The number that each earlier subgoal has now, and the reverse; [`NONE`] for none.
    pub(super) now_of: &'m [u32],
    pub(super) then_of: &'m [u32],
    /// The level that leaves each subgoal out. Of decisions that are still to be made, that of the earlier
    /// map.
    pub(super) level: Vec<u32>,
    /// The number of the list of each subgoal, and of what contracting it did; [`NONE`] if nobody asked.
    lists_of: Vec<u32>,
    lists: Vec<Vec<OverlayArc>>,
    made_of: Vec<u32>,
    made: Vec<Contracted>,
    /// Decisions before this time are seen.
    pub(super) time: u64,
    /// All that was read.
    pub(super) read: Bounds,
}

impl<'m> Replay<'m> {
    pub(super) fn new(
        then: (&'m SubgoalGraph<Corners>, &'m LevelRecord),
        context: BuildContext<'m, Corners>,
        edges: &'m Edges,
        [now_of, then_of]: [&'m [u32]; 2],
    ) -> Self {
        let level_of = |&id: &u32| if id == NONE { NONE } else { then.1.level[id as usize] };
        let none = vec![NONE; then_of.len()];
        Self {
            then,
            context,
            edges,
            now_of,
            then_of,
            level: then_of.iter().map(level_of).collect(),
            lists_of: none.clone(),
            lists: Vec::new(),
            made_of: none,
            made: Vec::new(),
            time: 0,
            read: Bounds::EMPTY,
        }
    }

    /// When a subgoal is contracted.
    pub(super) fn time_of(&self, id: u32) -> u64 {
        time(self.level[id as usize], id)
    }

    /// A subgoal as it was contracted on the earlier map, by the numbers of now.
    pub(super) fn contracted_then(&self, id: u32) -> Contracted {
        let (graph, record) = self.then;
        let then = self.then_of[id as usize];
        let around = graph.up(then).iter().map(|arc| self.overlay_arc(then, arc)).collect();
        Contracted { around, shortcuts: record.shortcuts(then).to_vec() }
    }

    /// An arc of the earlier graph, by the numbers of now.
    fn overlay_arc(&self, from: u32, arc: &UpwardArc) -> OverlayArc {
        let now = |id: u32| self.now_of.get(id as usize).copied().unwrap_or(NONE);
        let &UpwardArc { cost, to, middle, first, last } = arc;
        let graph = self.then.0;
        // No subgoal lies on the rim of the map, so all steps fit.
        let at = |vertex: Option<Vertex>| vertex.and_then(|at| graph.subgoals.id(at)).map_or(NONE, now);
        let first = at(first.vector().map(|step| graph.subgoals.vertex(from) + step));
        let last = at(last.vector().map(|step| graph.subgoals.vertex(to) + -step));
        OverlayArc { cost: cost.into(), to: now(to), middle: now(middle), first, last }
    }

    /// Notes what contracting a subgoal does now.
    pub(super) fn set(&mut self, id: u32, contracted: Contracted) {
        self.made_of[id as usize] = self.made.len() as u32;
        self.made.push(contracted);
    }

    /// A subgoal as it is contracted now.
    pub(super) fn contracted(&mut self, id: u32) -> &Contracted {
        if self.made_of[id as usize] == NONE {
            let then = self.contracted_then(id);
            self.set(id, then);
        }
        &self.made[self.made_of[id as usize] as usize]
    }

    /// The shortcuts of a subgoal that is contracted now.
    pub(super) fn shortcuts(&self, id: u32) -> &[(u32, u32)] {
        match self.made.get(self.made_of[id as usize] as usize) {
            Some(made) => &made.shortcuts,
            None => self.then.1.shortcuts(self.then_of[id as usize]),
        }
    }

    /// The list of a subgoal as it is when it is contracted, or in the end.
    pub(super) fn last_list(&mut self, id: u32) -> &[OverlayArc] {
        // Subgoals that no level leaves out stay.
        self.time = self.time_of(id).min(time(NONE, 0));
        self.around(id)
    }
}

/// The time at which a level decides about a subgoal.
pub(super) const fn time(level: u32, id: u32) -> u64 {
    (level as u64) << 32 | id as u64
}

impl Overlay for Replay<'_> {
    fn around(&mut self, id: u32) -> &[OverlayArc] {
        let context = self.context;
        self.read.add(context.vertex(id));
        if self.lists_of[id as usize] == NONE {
            self.lists_of[id as usize] = self.lists.len() as u32;
            let arc = |&to: &u32| OverlayArc {
                cost: context.distance(id, to),
                to,
                middle: NONE,
                first: to,
                last: id,
            };
            self.lists.push(self.edges.of(id).iter().map(arc).collect());
        }
        let number = self.lists_of[id as usize] as usize;
        let mut list = std::mem::take(&mut self.lists[number]);
        // Contracting a subgoal adds none that was contracted before it.
        while let Some((at, next)) = list.iter().map(|arc| (self.time_of(arc.to), arc.to)).min()
            && at < self.time
        {
            let contracted = self.contracted(next);
            remove(&mut list, next);
            for (from, arc) in
                contracted.shortcuts.iter().flat_map(|&pair| both_ways(next, &contracted.around, pair))
            {
                if from == id {
                    add(&mut list, arc);
                }
            }
        }
        self.lists[number] = list;
        &self.lists[number]
    }
}
