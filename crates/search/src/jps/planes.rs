//! Where jumps by words stop: what block-based jumps and the table of JPS+ are made from.

use mediant_grid::{GridGraph, Interrupt, Interrupted, Placement};
use mediant_moves::KError;

use super::{
    axial::AxialStops,
    dead_ends::{DeadEndRows, REACH, find::DeadEndFinder},
    diagonals::DiagonalStops,
    stop_rows::Leads,
    zone::Zone,
};
use crate::canonical::Pruning;

/// Where the jumps on a grid graph with k ≤ 3 stop.
pub(super) struct JumpPlanes {
    pub(super) axial: AxialStops,
    pub(super) diagonals: DiagonalStops,
    pub(super) dead_ends: DeadEndRows,
    /// How far dead ends reach; 0 if there are none.
    pub(super) reach: u32,
}

/// On maps with more jump points than one for so many vertices, as in noise, dead ends make searches hardly
/// shorter, and there would be many to find.
const VERTICES_A_JUMP_POINT: u64 = 4;
/// On larger maps it takes longer to find the dead ends than some hundred searches would save.
const MOST_VERTICES: u64 = 1 << 22;

impl JumpPlanes {
    /// The largest k that has jumps by words.
    pub(super) const MAX_K: u32 = 3;

    /// Checks that a grid graph has jumps by words.
    pub(super) fn check_k<P: Placement>(graph: &GridGraph<P>) -> Result<(), KError> {
        let (k, max) = (graph.k().get(), Self::MAX_K);
        if k > max { Err(KError::TooLarge { k: k.into(), max }) } else { Ok(()) }
    }

    /// With dead ends where that pays.
    pub(super) fn new<P: Placement>(
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let axial = AxialStops::new(graph, interrupt)?;
        let reach = if Self::should_have_dead_ends(graph, &axial) { REACH } else { 0 };
        Self::with_dead_ends(graph, pruning, axial, reach, interrupt)
    }

    /// Without dead ends.
    pub(super) fn without_dead_ends<P: Placement>(
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        Self::with_dead_ends(graph, pruning, AxialStops::new(graph, interrupt)?, 0, interrupt)
    }

    /// Whether dead ends are looked for, among these jump points.
    pub(super) fn should_have_dead_ends<P: Placement>(graph: &GridGraph<P>, axial: &AxialStops) -> bool {
        let vertices = graph.vertex_count() as u64;
        Self::may_have_dead_ends(graph) && VERTICES_A_JUMP_POINT * axial.jump_points() <= vertices
    }

    /// Whether dead ends are looked for, if there are not too many jump points.
    pub(super) fn may_have_dead_ends<P: Placement>(graph: &GridGraph<P>) -> bool {
        !graph.has_closed_gaps() && graph.vertex_count() as u64 <= MOST_VERTICES
    }

    /// With dead ends that reach so far; 0 for none.
    pub(super) fn with_dead_ends<P: Placement>(
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        mut axial: AxialStops,
        reach: u32,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let dead_ends = DeadEndRows::default();
        let leads = Leads::new(graph, &dead_ends, interrupt)?;
        let table = pruning.table().filter(|_| reach > 0 && !graph.has_closed_gaps());
        if let Some(table) = table {
            let dead_ends =
                DeadEndFinder { graph, table, leads: Some(&leads), reach }.mark(&mut axial, interrupt)?;
            if !dead_ends.is_empty() {
                let live = Leads::new(graph, &dead_ends, interrupt)?;
                let diagonals = DiagonalStops::new(graph, pruning, [&leads, &live], interrupt)?;
                return Ok(Self { axial, diagonals, dead_ends, reach });
            }
        }
        let diagonals = DiagonalStops::new(graph, pruning, [&leads; 2], interrupt)?;
        Ok(Self { axial, diagonals, dead_ends, reach: 0 })
    }

    /// Where those are the dead ends that the planes of axial jumps say.
    pub(super) fn with_known_dead_ends<P: Placement>(
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        (axial, reach): (AxialStops, u32),
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let map = Zone::map::<P>(graph.grid());
        let mut dead_ends = DeadEndRows::new(P::vertices(graph.grid()));
        for quarter in (0..4).step_by(8 / graph.steps().len()) {
            axial.for_each_jump_point((map, quarter), true, |point| dead_ends.add(point.at, quarter));
        }
        let [leads, live] =
            [&DeadEndRows::default(), &dead_ends].map(|dead| Leads::new(graph, dead, interrupt));
        let diagonals = DiagonalStops::new(graph, pruning, [&leads?, &live?], interrupt)?;
        Ok(Self { axial, diagonals, dead_ends, reach })
    }
}
