//! Subgoal graphs at corners, over N(k) and at any angle.

use mediant_grid::{
    BitMatrix, Corners, FreeSpace, Placement, Vertex, load,
    sight::{Quadrants, RowSummary, Targets, VisibilitySweep},
};
use mediant_moves::{Cost, K};

use crate::{
    Hierarchy, SubgoalError, SubgoalPlacement,
    direct::DirectFilter,
    placement::{BuildContext, EdgeKind, Edges, Prepared},
};

/// Scratch memory at corners.
#[derive(Debug, Default)]
#[doc(hidden)]
pub struct Seen {
    fan: VisibilitySweep,
    direct: DirectFilter,
}

/// What fans need.
#[derive(Clone, Debug)]
#[doc(hidden)]
pub struct Views {
    bands: RowSummary,
    /// The subgoals that taut paths pass in directions in which x and y have the same sign, and in which they have opposite ones.
    tangents: [BitMatrix; 2],
}

impl Prepared for Views {
    fn memory_bytes(&self) -> usize {
        self.bands.memory_bytes()
            + self.tangents.iter().map(|marks| size_of_val(marks.words())).sum::<usize>()
    }
}

impl SubgoalPlacement for Corners {
    type Scratch = Seen;
    type Prepared = Views;

    fn check(_: &FreeSpace<Self>, _: K) -> Result<(), SubgoalError> {
        Ok(())
    }

    /// The convex corners of obstacles: of the four cells around one is blocked, or, where a path may pass between them, two that meet
    /// diagonally. (Hormazábal 2017: a corner of an obstacle at which both ways along a diagonal are legal.)
    fn prepare(space: &FreeSpace<Self>) -> (BitMatrix, Views) {
        let cells = space.grid().rows();
        let (width, height) = Self::vertices(space.grid());
        let gaps_open = !Self::closes_gaps(space.rule());
        let around = |x, y| {
            [(-1, -1), (0, -1), (-1, 0), (0, 0)]
                .map(|(dx, dy)| load(cells.words(), cells.index(x + dx, y + dy)))
        };
        let convex = |[nw, ne, sw, se]: [u64; 4]| {
            let odd = nw ^ ne ^ sw ^ se;
            let one = odd & !(nw & ne | sw & se);
            let two = (nw ^ ne) & !(nw ^ se) & !(ne ^ sw);
            if gaps_open { one | two } else { one }
        };
        let made = |marks: &dyn Fn([u64; 4]) -> u64| {
            BitMatrix::from_words(width, height, false, |x, y| marks(around(x, y)))
        };
        // A taut path comes and goes through the quadrants beside the blocked cell's.
        let same = |cells: [u64; 4]| convex(cells) & (cells[1] | cells[2]);
        let opposite = |cells: [u64; 4]| convex(cells) & (cells[0] | cells[3]);
        let views = Views { bands: RowSummary::new(space.grid()), tangents: [made(&same), made(&opposite)] };
        (made(&convex), views)
    }

    fn links(
        map: BuildContext<'_, Self>,
        scratch: &mut Seen,
        from: Vertex,
        which: EdgeKind,
        mut tell: impl FnMut(u32, Cost),
    ) {
        let BuildContext { space, subgoals, norm, k, edges } = map;
        let Views { bands, tangents } = subgoals.prepared();
        let tangents = (edges == Edges::Taut).then_some(tangents);
        let quadrants = match (which, tangents) {
            (EdgeKind::Edges, Some([same, _])) => {
                let tangent = if same.get(from.x, from.y) { 1 } else { -1 };
                Quadrants::only(tangent, 1).and(Quadrants::LINE)
            }
            (EdgeKind::Edges, None) => Quadrants::only(1, 1).and(Quadrants::only(-1, 1)),
            // From a gap a path sets out into the quadrant of its own cell.
            (EdgeKind::All, _) if space.is_closed_gap(from) => Quadrants::only(1, 1),
            (EdgeKind::All, _) => Quadrants::ALL,
        };
        let Seen { fan, direct } = scratch;
        match (k, tangents) {
            (_, Some([same, opposite])) => {
                fan.seen(space, bands, Targets { same, opposite }, from, quadrants, |at| {
                    let to = from.to(at);
                    if let Some(id) = subgoals.id(at).filter(|_| which.holds(to)) {
                        tell(id, norm.length(to));
                    }
                });
            }
            (K::Finite(k), None) => {
                direct.clear();
                fan.seen(space, bands, subgoals.marks(), from, quadrants, |at| {
                    if let Some(id) = subgoals.id(at) {
                        direct.push(from.to(at), k.depth(), id);
                    }
                });
                direct.direct(|id| {
                    let to = from.to(subgoals.vertex(id));
                    if which.holds(to) {
                        tell(id, norm.length(to));
                    }
                });
            }
            // Every subgoal that is seen is directly reachable at any angle; the taut ones are enough.
            (K::Any, None) => {}
        }
    }

    fn edges(k: K, hierarchy: Hierarchy) -> Edges {
        if k == K::Any || hierarchy == Hierarchy::Contracted { Edges::Taut } else { Edges::Direct }
    }
}
