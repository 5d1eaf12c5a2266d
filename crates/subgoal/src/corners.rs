//! Subgoals and edges at corners, for N(k) and at any angle.

use mediant_grid::{
    BitMatrix, Corners, FreeSpace, Interrupt, Interrupted, Placement, Vector, Vertex, load,
    sight::{Place, Quadrants, RowSummary, Targets, VisibilitySweep},
    uninterrupted,
};
use mediant_moves::{Cost, K};

use crate::{
    bends::{ConvexCorner, SideDepartures},
    bounds::Bounds,
    direct_reachability::DirectFilter,
    error::SubgoalError,
    hierarchy::Hierarchy,
    placement::{
        BuildContext, CellRun, EdgeCriterion, EdgeFinder, EdgeKind, EdgeTables, SubgoalPlacement, VertexRun,
    },
};

/// Scratch memory for finding edges at corners.
#[derive(Debug, Default)]
pub struct CornerScratch {
    sweep: VisibilitySweep,
    direct: DirectFilter,
}

/// Row summary and tangent subgoals, for visibility sweeps.
#[derive(Clone, Debug)]
pub struct SightTables {
    row_summary: RowSummary,
    /// The subgoals that taut paths pass in directions in which x and y have the same sign, and in directions
    /// in which they have opposite signs.
    tangents: [BitMatrix; 2],
}

/// Sight of ends that need not be vertices: tables of a map, and scratch memory.
#[derive(Debug)]
pub(crate) struct PointSight {
    tables: SightTables,
    sweep: VisibilitySweep,
}

impl PointSight {
    /// The tables of a map: two bits a vertex, and two for each band of eight rows and a column.
    pub(crate) fn new(space: &FreeSpace<Corners>, subgoals: &BitMatrix) -> Self {
        let tables = uninterrupted(|never| Corners::tables(space, subgoals, never));
        Self { tables, sweep: VisibilitySweep::default() }
    }

    /// Calls `visit` with the subgoals at which a shortest path at any angle may bend first that starts at a
    /// place, vertex or not.
    pub(crate) fn seen_from(&mut self, space: &FreeSpace<Corners>, from: Place, visit: impl FnMut(Vertex)) {
        let SightTables { row_summary, tangents: [same, opposite] } = &self.tables;
        let is_gap = from.vertex().is_some_and(|at| space.is_closed_gap(at));
        let quadrants = if is_gap { Quadrants::only(1, 1) } else { Quadrants::ALL };
        self.sweep.seen(space, row_summary, Targets { same, opposite }, from, quadrants, visit);
    }
}

impl EdgeTables for SightTables {
    fn memory_bytes(&self) -> usize {
        self.row_summary.memory_bytes()
            + self.tangents.iter().map(|marks| size_of_val(marks.words())).sum::<usize>()
    }
}

impl SubgoalPlacement for Corners {}

impl EdgeFinder for Corners {
    const SHARES_SIGHT: bool = true;

    const SIDES: u32 = 2;

    type Scratch = CornerScratch;
    type Tables = SightTables;

    fn check(_: &FreeSpace<Self>, _: K) -> Result<(), SubgoalError> {
        Ok(())
    }

    /// The subgoals are the convex corners of obstacles: vertices that touch one blocked cell, or two that
    /// meet diagonally, if a path may pass between them. (Hormazábal et al. 2017: a corner of an obstacle
    /// that a path can pass along a diagonal.)
    fn subgoals(space: &FreeSpace<Self>, interrupt: &Interrupt) -> Result<BitMatrix, Interrupted> {
        marks(space, interrupt, |convex, _| convex)
    }

    fn tables(
        space: &FreeSpace<Self>,
        _: &BitMatrix,
        interrupt: &Interrupt,
    ) -> Result<SightTables, Interrupted> {
        // A taut path arrives and leaves through the quadrants beside that of the blocked cell.
        let same = marks(space, interrupt, |convex, [_, ne, sw, _]| convex & (ne | sw))?;
        let opposite = marks(space, interrupt, |convex, [nw, _, _, se]| convex & (nw | se))?;
        Ok(SightTables { row_summary: RowSummary::new(space.grid()), tangents: [same, opposite] })
    }

    fn edge_criterion(k: K, hierarchy: Hierarchy) -> EdgeCriterion {
        if k == K::Any || hierarchy == Hierarchy::Contracted {
            EdgeCriterion::Taut
        } else {
            EdgeCriterion::Direct
        }
    }

    fn edges_from(
        context: BuildContext<'_, Self>,
        scratch: &mut CornerScratch,
        from: Vertex,
        kind: EdgeKind,
        mut visit: impl FnMut(u32, Cost),
    ) {
        let BuildContext { space, subgoals, tables, metric, k, criterion } = context;
        let SightTables { row_summary, tangents } = tables;
        let tangents = (criterion == EdgeCriterion::Taut).then_some(tangents);
        let quadrants = match (kind, tangents) {
            (EdgeKind::Graph, Some([same, _])) => {
                let tangent = if same.get(from.x, from.y) { 1 } else { -1 };
                Quadrants::only(tangent, 1).union(Quadrants::LINE)
            }
            (EdgeKind::Graph, None) => BELOW,
            // A path leaves a closed gap through the quadrant of the vertex's own cell.
            (EdgeKind::Query, _) if space.is_closed_gap(from) => Quadrants::only(1, 1),
            (EdgeKind::Query, _) => Quadrants::ALL,
        };
        let CornerScratch { sweep, direct } = scratch;
        match (k, tangents) {
            (_, Some([same, opposite])) => {
                sweep.seen(space, row_summary, Targets { same, opposite }, from, quadrants, |at| {
                    let to = from.to(at);
                    if let Some(id) = subgoals.id(at).filter(|_| kind.includes(to)) {
                        visit(id, metric.distance(to));
                    }
                });
            }
            (K::Finite(k), None) => {
                direct.clear();
                sweep.seen(space, row_summary, subgoals.marks(), from, quadrants, |at| {
                    if let Some(id) = subgoals.id(at) {
                        direct.push(from.to(at), k.depth(), id);
                    }
                });
                direct.for_each_direct(|id| {
                    let to = from.to(subgoals.vertex(id));
                    if kind.includes(to) {
                        visit(id, metric.distance(to));
                    }
                });
            }
            // Does not occur: at any angle the edges are taut.
            (K::Any, None) => {}
        }
    }

    type Departures = SideDepartures;

    const SORTED: bool = true;

    fn bend_bits(space: &FreeSpace<Self>, at: Vertex, side: u32) -> u32 {
        ConvexCorner::at(space.grid(), at).bits(side)
    }

    #[inline]
    fn departures(_: K, bits: u32, arrival: Vector) -> SideDepartures {
        SideDepartures::new(bits, arrival)
    }

    fn class(_: Vector) -> u32 {
        0
    }

    #[inline]
    fn allows(departures: SideDepartures, edge: impl Fn() -> Vector, _: u32) -> bool {
        departures.allows(edge())
    }

    /// The [half plane](SideDepartures::half_plane) of arrivals from which a path may leave along the first
    /// edge: where it may not, it may not leave along any.
    fn summary(bits: u32, mut edges: impl Iterator<Item = Vector>) -> u32 {
        let first = edges.next();
        first.map_or(SideDepartures::NO_ARRIVALS, |first| SideDepartures::half_plane(bits, first))
    }

    #[inline]
    fn leads_on(_: K, _: u32, arrival: Vector, summary: u32) -> bool {
        SideDepartures::is_in(arrival, summary)
    }

    fn side(space: &FreeSpace<Self>, at: Vertex, edge: Vector) -> (u32, f64) {
        ConvexCorner::at(space.grid(), at).side_and_slope(edge)
    }

    fn runs_to(
        context: BuildContext<'_, Self>,
        scratch: &mut CornerScratch,
        subgoal: Vertex,
        mut visit: impl FnMut(VertexRun),
        mut cells: impl FnMut(CellRun),
    ) {
        let BuildContext { space, tables: SightTables { row_summary, tangents }, .. } = context;
        let [same, opposite] = tangents;
        let Vertex { x, y } = subgoal;
        // The quadrants from which a taut path comes, to the left and to the right.
        let tangent = if same.get(x, y) { 1 } else { -1 };
        for (is_right, sign) in [(false, -1), (true, 1)] {
            let quadrant = Quadrants::only(sign, sign * tangent);
            let targets = Targets { same, opposite };
            let run = |line, first, last| {
                let length = last - first + 1;
                visit(VertexRun { first: Vertex::new(first, line), length, is_column: false, is_right });
            };
            let cells = |row, first, end| cells(CellRun { row, first, end, is_right });
            scratch.sweep.runs_and_cells(space, row_summary, targets, subgoal, quadrant, run, cells);
        }
    }
}

/// A box that holds all that decides which edges of the graph lead from a subgoal to larger numbers: where
/// the cells around each of its vertices are the same on another map, so are these edges and their order.
/// For edges between directly reachable subgoals.
pub(crate) fn edge_bounds(
    context: BuildContext<'_, Corners>,
    scratch: &mut CornerScratch,
    from: Vertex,
) -> Bounds {
    let BuildContext { space, subgoals, tables, .. } = context;
    let sweep = &mut scratch.sweep;
    Bounds::around(sweep.bounds(space, &tables.row_summary, subgoals.marks(), from, BELOW))
}

/// The quadrants in which subgoals have larger numbers.
const BELOW: Quadrants = Quadrants::only(1, 1).union(Quadrants::only(-1, 1));

/// Some of the convex corners of obstacles: `some` is handed which of 64 vertices are such corners, and which
/// of the cells to the north-west, north-east, south-west and south-east of each are blocked.
fn marks(
    space: &FreeSpace<Corners>,
    interrupt: &Interrupt,
    some: impl Fn(u64, [u64; 4]) -> u64,
) -> Result<BitMatrix, Interrupted> {
    let cells = space.grid().rows();
    let (size, stop) = (Corners::vertices(space.grid()), (interrupt, "finding subgoals"));
    let gaps_open = !Corners::closes_gaps(space.rule());
    BitMatrix::from_words_interruptible(size, false, stop, |x, y| {
        let around @ [nw, ne, sw, se] = [(-1, -1), (0, -1), (-1, 0), (0, 0)]
            .map(|(dx, dy)| load(cells.words(), cells.index(x + dx, y + dy)));
        let odd = nw ^ ne ^ sw ^ se;
        let one = odd & !(nw & ne | sw & se);
        let two = (nw ^ ne) & !(nw ^ se) & !(ne ^ sw);
        some(if gaps_open { one | two } else { one }, around)
    })
}
