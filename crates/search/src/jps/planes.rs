//! Where jumps by words stop: what block-based jumps and the table of JPS+ are made from.

use mediant_grid::{GridGraph, Interrupt, Interrupted, Placement};
use mediant_moves::KError;

use super::{
    axial::AxialStops,
    cell_rows::EndRows,
    dead_ends::{DeadEndRows, REACH, find::DeadEndFinder},
    diagonals::DiagonalStops,
    stop_rows::{EnterRows, Leads},
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

/// The rows by which planes of diagonal jumps, and dead ends, are found: a word for 64 vertices.
pub(super) struct PlaneRows {
    pub(super) ends: EndRows,
    /// From where jumps lead on if they pass no dead ends.
    pub(super) leads: Leads,
    pub(super) enters: EnterRows,
}

impl PlaneRows {
    pub(super) fn new<P: Placement>(
        graph: &GridGraph<P>,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let ends = EndRows::new(graph, interrupt)?;
        let leads = Leads::new(&ends, &DeadEndRows::default(), interrupt)?;
        Ok(Self { ends, leads, enters: EnterRows::new(graph, interrupt)? })
    }
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
        let rows = PlaneRows::new(graph, interrupt)?;
        let table = pruning.table().filter(|_| reach > 0 && !graph.has_closed_gaps());
        let dead_ends = match table {
            Some(table) => {
                DeadEndFinder { graph, table, rows: Some(&rows), reach }.mark(&mut axial, interrupt)?
            }
            None => DeadEndRows::default(),
        };
        let reach = if dead_ends.is_empty() { 0 } else { reach };
        Self::with_known_dead_ends(graph, pruning, (axial, dead_ends, reach), &rows, interrupt)
    }

    /// With these dead ends, which the planes of axial jumps know.
    pub(super) fn with_known_dead_ends<P: Placement>(
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        (axial, dead_ends, reach): (AxialStops, DeadEndRows, u32),
        PlaneRows { ends, leads, enters }: &PlaneRows,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let diagonals = if dead_ends.is_empty() {
            DiagonalStops::new(graph, pruning, (enters, [leads; 2]), interrupt)?
        } else {
            let live = Leads::new(ends, &dead_ends, interrupt)?;
            DiagonalStops::new(graph, pruning, (enters, [leads, &live]), interrupt)?
        };
        Ok(Self { axial, diagonals, dead_ends, reach })
    }
}
