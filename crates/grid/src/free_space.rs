//! The free space, which no k changes: vertices, sight, gaps, components.

use std::sync::Arc;

use mediant_moves::{FiniteK, K};

use crate::{
    BitMatrix, Change, Components, Connectivity, Grid, Identity, Placement, Rectangle, Rules, Vertex,
    VertexId,
    interrupt::{Interrupt, Interrupted, uninterrupted},
    line_of_sight::line_of_sight,
};

/// A grid with placement `P` and a rule of motion: what any-angle searches need, and what the grid graphs of
/// all k have in common. It never changes; planners share it, and so do its clones.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace, Vertex};
/// let map = AsciiMap::parse("
///     .#
///     #.
/// ")?;
/// let [start, goal] = [(0, 0), (2, 2)].map(Vertex::from);
/// let grid = Arc::new(map.grid);
/// let open = FreeSpace::<Corners>::new(Arc::clone(&grid), DiagonalGap::Open);
/// assert!(open.sees(start, goal) && open.connected(start, goal));
/// let closed = FreeSpace::<Corners>::new(grid, DiagonalGap::Closed);
/// assert!(closed.is_closed_gap(Vertex::new(1, 1)) && !closed.connected(start, goal));
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Debug)]
pub struct FreeSpace<P: Placement> {
    grid: Arc<Grid>,
    rule: P::Rule,
    width: u32,
    height: u32,
    /// The gaps that no path may pass through, if there are any.
    gaps: Option<Arc<Gaps>>,
    connectivity: Connectivity,
    components: Arc<Components>,
}

impl<P: Placement> FreeSpace<P> {
    /// The free space of a grid under a rule of motion, for paths at any angle.
    #[must_use]
    pub fn new(grid: Arc<Grid>, rule: P::Rule) -> Self {
        Self::for_k(grid, rule, K::Any)
    }

    /// The free space of a grid under a rule of motion, for paths over N(k). It differs from that of all
    /// other k only at k = 2 where corners are always cut: there are more components then.
    #[must_use]
    pub fn for_k(grid: Arc<Grid>, rule: P::Rule, k: K) -> Self {
        uninterrupted(|never| Self::interruptible(grid, rule, k, never))
    }

    /// [`for_k`](Self::for_k), which an interrupt can stop; it asks before each row.
    ///
    /// # Errors
    /// [`Interrupted`].
    pub fn interruptible(
        grid: Arc<Grid>,
        rule: P::Rule,
        k: K,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let (width, height) = P::vertices(&grid);
        let connectivity = P::connectivity(rule, k.finite());
        let gaps = if P::closes_gaps(rule) { Gaps::of(&grid, interrupt)? } else { None };
        Ok(Self {
            gaps: gaps.map(Arc::new),
            components: Arc::new(Components::interruptible(&grid, connectivity, interrupt)?),
            connectivity,
            grid,
            rule,
            width,
            height,
        })
    }

    /// The free space after a change of its map, by work that follows the change; that of the map after the
    /// change, if the change is one of another map.
    #[must_use]
    pub fn after(&self, change: &Change) -> Self {
        let grid = Arc::clone(change.after());
        if change.before().id() != self.grid.id() {
            let k = if self.identity().k.is_some() { K::N4 } else { K::Any };
            return Self::for_k(grid, self.rule, k);
        }
        let gaps = match &self.gaps {
            Some(gaps) => gaps.after(change),
            None if P::closes_gaps(self.rule) => Gaps::new_after(change),
            None => None,
        };
        let components = Arc::new(self.components.after(change));
        Self { grid, gaps: gaps.map(Arc::new), components, ..*self }
    }

    /// This, if it serves N(k); else the free space that does.
    pub(crate) fn serving(&self, k: FiniteK) -> Self {
        if P::connectivity(self.rule, Some(k)) == self.connectivity {
            self.clone()
        } else {
            Self::for_k(Arc::clone(&self.grid), self.rule, k.into())
        }
    }

    /// The identity: its map and rules, and every k; or k = 2 alone, where that has components of its own
    /// ([`for_k`](Self::for_k)).
    #[must_use]
    pub fn identity(&self) -> Identity {
        let is_for_all = self.connectivity == P::connectivity(self.rule, None);
        let k = (!is_for_all).then_some(K::N4);
        Identity { map: Some(self.grid.id()), rules: self.rules(), k }
    }

    /// The map.
    #[must_use]
    #[inline]
    pub const fn grid(&self) -> &Arc<Grid> {
        &self.grid
    }

    /// The rule of motion.
    #[must_use]
    pub const fn rule(&self) -> P::Rule {
        self.rule
    }

    /// Placement and rule as a value.
    #[must_use]
    pub fn rules(&self) -> Rules {
        P::rules(self.rule)
    }

    /// The number of vertices, free or not. All ids are below it.
    #[must_use]
    pub const fn vertex_count(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// The id of a vertex; `None` outside the map.
    #[must_use]
    pub const fn id(&self, at: Vertex) -> Option<VertexId> {
        if at.x as u32 >= self.width || at.y as u32 >= self.height {
            return None;
        }
        Some(VertexId(at.y as u32 * self.width + at.x as u32))
    }

    /// The vertex with this id.
    #[must_use]
    #[inline]
    pub const fn vertex(&self, id: VertexId) -> Vertex {
        Vertex::new((id.0 % self.width) as i32, (id.0 / self.width) as i32)
    }

    /// Whether a path may stand on this vertex; false outside the map. A vertex on a
    /// [closed gap](Self::is_closed_gap) is free, too, but a path starts or ends there only through the
    /// vertex's own cell, and if that is blocked, not at all: see [`may_turn`](Self::may_turn).
    #[must_use]
    pub fn is_free(&self, at: Vertex) -> bool {
        P::is_free(&self.grid, at)
    }

    /// Whether a path leads from one free vertex to another, in constant time.
    #[must_use]
    pub fn connected(&self, from: Vertex, to: Vertex) -> bool {
        if from == to {
            return self.is_free(from);
        }
        let component = |at| {
            let free = self.is_free(at);
            free.then(|| self.components.of(P::representative(&self.grid, self.rule, at))).flatten()
        };
        component(from).is_some_and(|label| component(to) == Some(label))
    }

    /// The components of cells in which [`connected`](Self::connected) looks vertices up.
    #[must_use]
    pub fn components(&self) -> &Components {
        &self.components
    }

    /// The memory used beyond the map, in bytes: mostly that of the components.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let gaps = self.gaps.as_ref().map_or(0, |gaps| size_of_val(gaps.at.words()));
        gaps + self.components.memory_bytes()
    }

    /// Whether the straight segment between two vertices obeys the rules of motion: see [`line_of_sight`]. It
    /// is judged for itself: a closed gap at which it begins or ends is not in its way.
    #[must_use]
    pub fn sees(&self, from: Vertex, to: Vertex) -> bool {
        line_of_sight::<P>(&self.grid, self.rule, from, to)
    }

    /// Whether `at` is a [gap](Grid::is_gap) that no path may pass through. Always false unless the rule is
    /// [`DiagonalGap::Closed`](crate::DiagonalGap::Closed).
    #[must_use]
    #[inline]
    pub fn is_closed_gap(&self, at: Vertex) -> bool {
        self.gaps.as_ref().is_some_and(|gaps| gaps.at.get(at.x, at.y))
    }

    /// A set of vertices, as one bit each in an empty frame; `contains` is asked once for each vertex, row by
    /// row. Sets are the targets of a [`VisibilitySweep`](crate::sight::VisibilitySweep).
    #[must_use]
    pub fn vertex_set(&self, mut contains: impl FnMut(Vertex) -> bool) -> BitMatrix {
        BitMatrix::from_words(self.width, self.height, false, |x, y| {
            let vertices = (x..self.width as i32).take(64).map(|x| Vertex::new(x, y));
            vertices.zip(0..).fold(0, |word, (at, bit)| word | u64::from(contains(at)) << bit)
        })
    }

    /// Whether there is any [closed gap](Self::is_closed_gap).
    #[must_use]
    #[inline]
    pub const fn has_closed_gaps(&self) -> bool {
        self.gaps.is_some()
    }

    /// Whether [closed gaps](Self::is_closed_gap) allow a path to come straight from `before` to the free
    /// vertex `at` and to go straight on to `after`. `None` stands for the start or end of the path at `at`.
    ///
    /// At a closed gap a path must stay in one free quadrant; if it starts or ends there, in the quadrant of
    /// the vertex's own cell. Whether the two segments are legal is not tested.
    #[must_use]
    #[inline]
    pub fn may_turn(&self, before: Option<Vertex>, at: Vertex, after: Option<Vertex>) -> bool {
        !self.is_closed_gap(at) || self.stays_in_quadrant(before, at, after)
    }

    fn stays_in_quadrant(&self, before: Option<Vertex>, at: Vertex, after: Option<Vertex>) -> bool {
        let is_end = before.is_none() || after.is_none();
        [(1, 1), (1, -1), (-1, 1), (-1, -1)].into_iter().take(if is_end { 1 } else { 4 }).any(|(sx, sy)| {
            let holds = |other: Option<Vertex>| {
                other.is_none_or(|other| (other.x - at.x) * sx >= 0 && (other.y - at.y) * sy >= 0)
            };
            self.grid.is_free(at.x + (sx - 1) / 2, at.y + (sy - 1) / 2) && holds(before) && holds(after)
        })
    }
}

/// The gaps of a map that has any.
#[derive(Debug)]
struct Gaps {
    at: BitMatrix,
    count: u64,
}

impl Gaps {
    /// The gaps of a map; `None` if there are none.
    fn of(grid: &Grid, interrupt: &Interrupt) -> Result<Option<Self>, Interrupted> {
        let (size, stop) = ((grid.width() + 1, grid.height() + 1), (interrupt, "finding closed gaps"));
        let at = BitMatrix::from_words_interruptible(size, false, stop, |x, y| grid.rows().gaps(x, y))?;
        let count = at.words().iter().map(|word| u64::from(word.count_ones())).sum();
        Ok(Self { at, count }.if_any())
    }

    /// The gaps after a change of a map that had none.
    fn new_after(change: &Change) -> Option<Self> {
        let grid = change.after();
        let is_gap = |at: &Rectangle| {
            let (first, last) = (at.x as i32, (at.x + at.width) as i32);
            (at.y..=at.y + at.height).any(|y| grid.rows().any_gap(y as i32, first, last))
        };
        if !change.cells().iter().any(is_gap) {
            return None;
        }
        let none = BitMatrix::from_words(grid.width() + 1, grid.height() + 1, false, |_, _| 0);
        Self { at: none, count: 0 }.after(change)
    }

    /// The gaps after a change.
    fn after(&self, change: &Change) -> Option<Self> {
        let (rows, width) = (change.after().rows(), self.at.width());
        let (mut at, mut count) = (self.at.edit(), self.count);
        for cells in change.cells() {
            for y in cells.y..=cells.y + cells.height {
                for x in (cells.x & !63..=cells.x + cells.width).step_by(64) {
                    let within = !0_u64 >> (64 - (width - x).min(64));
                    let [before, after] = at.set_bits((x, y), within, rows.gaps(x as i32, y as i32));
                    count = count - u64::from(before.count_ones()) + u64::from(after.count_ones());
                }
            }
        }
        Self { at: at.finish(), count }.if_any()
    }

    fn if_any(self) -> Option<Self> {
        (self.count > 0).then_some(self)
    }
}
