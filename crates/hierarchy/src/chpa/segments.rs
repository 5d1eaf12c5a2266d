//! The index of CHPA*: made by sliding windows over the map, and repaired where the map changed.

use mediant_grid::{
    Centers, Change, Grid, GridGraph, Identity, Interrupt, Interrupted, Vector, VersionEdit, Versioned,
    Vertex, room_for, uninterrupted,
};
use mediant_moves::FiniteK;

use crate::{
    HierarchyError, check,
    touched::{Squares, touched},
    window::{MAX_SIDE, Rows, Window, low_bits},
};

/// The stage that an interrupted call names.
const DURING: &str = "joining segments";

/// The segments between two questions of an interrupt.
const SEGMENTS: usize = 256;

/// The edges that a segment stores; those to the left and upward are stored by its neighbors.
pub(crate) const EAST: u8 = 1;
pub(crate) const SOUTH: u8 = 2;
pub(crate) const SOUTH_EAST: u8 = 4;
pub(crate) const SOUTH_WEST: u8 = 8;

/// The index of CHPA*: the map in segments, and which neighboring segments are joined (Teleiša & Čalnerytė
/// 2023, Section 3).
///
/// A window that is one cell longer than a segment slides over the map. It joins two segments side by side if
/// a 4-connected path within it leads from its first column to its last, which belongs to the second segment;
/// likewise downward, with the window turned. The paper says 'any valid path along the window', but not
/// between which of its cells. A map whose sides are no multiples of the segment's is padded with copies of
/// its last column and row.
///
/// For k = 3, which the paper leaves open, a window that is one cell longer both ways joins diagonal
/// neighbors: if such a path leads from one of the segment's two far sides to the one cell of the neighbor.
///
/// The index does not tell which cells *within* a segment are connected. So segments may be joined although
/// no path leads through them, or not joined although one does; what a planner then does is its
/// [`FallbackPolicy`](crate::FallbackPolicy). An index is changed only by [`repair`](Self::repair); any
/// number of planners share it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SegmentGraph {
    pub(crate) identity: Identity,
    pub(crate) k: FiniteK,
    pub(crate) side: u32,
    pub(crate) size: (u32, u32),
    pub(crate) columns: u32,
    pub(crate) rows: u32,
    pub(crate) edges: Versioned<u8>,
}

impl SegmentGraph {
    /// The side of the paper's segments.
    pub const PAPER_SIDE: u32 = 3;
    /// The longest side of segments. The window is one cell longer, and each of its rows is one word.
    pub const MAX_SIDE: u32 = MAX_SIDE - 1;

    /// Makes the index of a map, with segments of `side` × `side` cells: 1 to [`MAX_SIDE`](Self::MAX_SIDE).
    /// On maps of 512 × 512 to 1024 × 1024 cells, with the paper's side of 3, that takes 6 to 42 ms.
    ///
    /// # Errors
    /// [`HierarchyError`] for k above 3, for k = 3 where corners may be cut, or a side that is out of range.
    pub fn new(grid_graph: &GridGraph<Centers>, side: u32) -> Result<Self, HierarchyError> {
        Self::interruptible(grid_graph, side, &Interrupt::NEVER)
    }

    /// [`new`](Self::new), which an interrupt can stop; it asks every few segments.
    ///
    /// # Errors
    /// As for [`new`](Self::new), and [`HierarchyError::Interrupted`].
    pub fn interruptible(
        grid_graph: &GridGraph<Centers>,
        side: u32,
        interrupt: &Interrupt,
    ) -> Result<Self, HierarchyError> {
        let mut graph = Self::without_edges(grid_graph, side)?;
        room_for::<u8>(graph.segments_of_map(), DURING)?;
        let mut edges = Vec::with_capacity(graph.segments_of_map());
        for y in 0..graph.rows {
            for x in 0..graph.columns {
                interrupt.check_every(SEGMENTS, x as usize, DURING)?;
                edges.push(graph.edges_of(grid_graph.grid(), x, y));
            }
        }
        graph.edges = edges.into();
        Ok(graph)
    }

    /// An index without edges, for which there is no memory yet.
    pub(crate) fn without_edges(grid_graph: &GridGraph<Centers>, side: u32) -> Result<Self, HierarchyError> {
        check::moves(grid_graph)?;
        if !(1..=Self::MAX_SIDE).contains(&side) {
            return Err(HierarchyError::Side { found: side, min: 1, max: Self::MAX_SIDE });
        }
        let size = (grid_graph.grid().width(), grid_graph.grid().height());
        let (columns, rows) = (size.0.div_ceil(side), size.1.div_ceil(side));
        check::address_space(u64::from(columns) * u64::from(rows))?;
        let (identity, k) = (grid_graph.identity(), grid_graph.k());
        Ok(Self { identity, k, side, size, columns, rows, edges: Versioned::default() })
    }

    /// The number of segments that the map is cut into.
    pub(crate) const fn segments_of_map(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// Repairs the index after a change. The index is then equal to a new one of the map after it, its
    /// identity included. Edges are made anew where a window has a cell that the change alters; the work
    /// follows their number, whatever the size of the map.
    ///
    /// # Errors
    /// [`HierarchyError::Mismatch`] if the map before the change is not that of the index. Nothing is changed
    /// then.
    pub fn repair(&mut self, change: &Change) -> Result<(), HierarchyError> {
        check::change(self.identity, change)?;
        let edges = std::mem::take(&mut self.edges).into_edit();
        self.edges = uninterrupted(|never| self.repaired_edges(edges, change, never));
        self.identity.map = Some(change.after().id());
        Ok(())
    }

    /// The index [repaired](Self::repair), as another one; this one stays as it is. The edges that did not
    /// change are not copied if a version before this one was given up: its memory is used again. An
    /// interrupt can stop it.
    ///
    /// # Errors
    /// As for [`repair`](Self::repair), and [`HierarchyError::Interrupted`].
    pub fn repaired(&self, change: &Change, interrupt: &Interrupt) -> Result<Self, HierarchyError> {
        check::change(self.identity, change)?;
        let edges = self.repaired_edges(self.edges.edit_if_room(DURING)?, change, interrupt)?;
        let identity = Identity { map: Some(change.after().id()), ..self.identity };
        Ok(Self { identity, edges, ..*self })
    }

    fn repaired_edges(
        &self,
        mut edges: VersionEdit<u8>,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Versioned<u8>, Interrupted> {
        // The windows of a segment reach one cell beyond it to the left, to the right, and downward.
        let segments = Squares { side: self.side, beside: 1, above: 0, below: 1 };
        for (number, segment) in touched(change, segments, (interrupt, DURING))?.into_iter().enumerate() {
            interrupt.check_every(SEGMENTS, number, DURING)?;
            let (x, y) = (segment % self.columns, segment / self.columns);
            edges.set(segment as usize, self.edges_of(change.after(), x, y));
        }
        Ok(edges.finish())
    }

    /// The identity of its grid graph: map, rules of motion and k.
    #[must_use]
    pub const fn identity(&self) -> Identity {
        self.identity
    }

    /// The side of the segments, in cells.
    #[must_use]
    pub const fn side(&self) -> u32 {
        self.side
    }

    /// The number of segments.
    #[must_use]
    pub fn segments(&self) -> usize {
        self.edges.len()
    }

    /// The number of edges: pairs of segments that are joined.
    #[must_use]
    pub fn edges(&self) -> usize {
        self.edges.iter().map(|edges| edges.count_ones() as usize).sum()
    }

    /// The memory that the index uses, in bytes: one a segment.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        size_of_val(&*self.edges)
    }

    /// The segment of a vertex.
    pub(crate) const fn segment_at(&self, at: Vertex) -> u32 {
        at.y as u32 / self.side * self.columns + at.x as u32 / self.side
    }

    /// The column and row of a segment.
    pub(crate) const fn position(&self, segment: u32) -> Vertex {
        Vertex::new((segment % self.columns) as i32, (segment / self.columns) as i32)
    }

    /// The cell in the middle of a segment; beyond the map, the nearest cell on it.
    pub(crate) const fn center(&self, segment: u32) -> Vertex {
        let (at, side) = (self.position(segment), self.side as i32);
        let (x, y) = (at.x * side + side / 2, at.y * side + side / 2);
        let (last_x, last_y) = (self.size.0 as i32 - 1, self.size.1 as i32 - 1);
        Vertex::new(if x < last_x { x } else { last_x }, if y < last_y { y } else { last_y })
    }

    /// Calls `visit` with each segment that an edge leads to, and the step there in columns and rows.
    pub(crate) fn for_each_neighbor(&self, segment: u32, mut visit: impl FnMut(u32, Vector)) {
        let at = self.position(segment);
        let own = self.edges[segment as usize];
        let other = |dx: i32, dy: i32| {
            let at = Vertex::new(at.x + dx, at.y + dy);
            let exists = at.x >= 0 && at.y >= 0 && at.x < self.columns as i32 && at.y < self.rows as i32;
            exists.then(|| at.y as u32 * self.columns + at.x as u32)
        };
        for (dx, dy, edge) in [(1, 0, EAST), (0, 1, SOUTH), (1, 1, SOUTH_EAST), (-1, 1, SOUTH_WEST)] {
            if own & edge != 0
                && let Some(to) = other(dx, dy)
            {
                visit(to, Vector::new(dx, dy));
            }
            if let Some(to) = other(-dx, -dy)
                && self.edges[to as usize] & edge != 0
            {
                visit(to, Vector::new(-dx, -dy));
            }
        }
    }

    /// The edges of the segment in column `x` and row `y` that would lead to a segment of the map.
    pub(crate) fn possible_edges(&self, x: u32, y: u32) -> u8 {
        let (has_right, has_left, has_below) = (x + 1 < self.columns, x > 0, y + 1 < self.rows);
        let diagonals = self.k != FiniteK::N4 && has_below;
        let edge = |exists: bool, edge: u8| if exists { edge } else { 0 };
        edge(has_right, EAST)
            | edge(has_below, SOUTH)
            | edge(diagonals && has_right, SOUTH_EAST)
            | edge(diagonals && has_left, SOUTH_WEST)
    }

    /// The edges of the segment in column `x` and row `y`: slides the windows over it.
    fn edges_of(&self, grid: &Grid, x: u32, y: u32) -> u8 {
        let side = self.side;
        let (left, top) = ((x * side) as i32, (y * side) as i32);
        let possible = self.possible_edges(x, y);
        let mut edges = 0;
        let mut add =
            |edge: u8, (left, width, height): (i32, u32, u32), from: fn(u32) -> Rows, to: fn(u32) -> Rows| {
                if possible & edge != 0 {
                    let window = padded(grid, left, top, width, height);
                    let mut start = from(side);
                    start.iter_mut().zip(&window.free).for_each(|(start, free)| *start &= free);
                    let reached = window.flood(&start);
                    if reached.iter().zip(to(side)).any(|(reached, to)| reached & to != 0) {
                        edges |= edge;
                    }
                }
            };
        add(EAST, (left, side + 1, side), first_column, column_beyond);
        add(SOUTH, (left, side, side + 1), first_row, row_beyond);
        add(
            SOUTH_EAST,
            (left, side + 1, side + 1),
            |side| both(first_row(side), first_column(side)),
            |side| one(side, side),
        );
        add(
            SOUTH_WEST,
            (left - 1, side + 1, side + 1),
            |side| both(first_row(side), column_beyond(side)),
            |side| one(0, side),
        );
        edges
    }
}

/// The window of a rectangle of the padded map: a cell beyond the map is free if the nearest cell on it is.
fn padded(grid: &Grid, left: i32, top: i32, width: u32, height: u32) -> Window {
    let mut free = [0; MAX_SIDE as usize];
    let known = width.min((grid.width() as i32 - left) as u32);
    for (free, y) in free[..height as usize].iter_mut().zip(top..) {
        *free = !grid.rows().row(y.min(grid.height() as i32 - 1)).word(left) & low_bits(known);
        if *free >> (known - 1) & 1 == 1 {
            *free |= low_bits(width) & !low_bits(known);
        }
    }
    Window { left, top, width, height, free }
}

fn first_column(_: u32) -> Rows {
    [1; MAX_SIDE as usize]
}

fn column_beyond(side: u32) -> Rows {
    [1 << side; MAX_SIDE as usize]
}

fn first_row(_: u32) -> Rows {
    let mut rows = [0; MAX_SIDE as usize];
    rows[0] = !0;
    rows
}

fn row_beyond(side: u32) -> Rows {
    let mut rows = [0; MAX_SIDE as usize];
    rows[side as usize] = !0;
    rows
}

fn one(x: u32, y: u32) -> Rows {
    let mut rows = [0; MAX_SIDE as usize];
    rows[y as usize] = 1 << x;
    rows
}

fn both(mut a: Rows, b: Rows) -> Rows {
    a.iter_mut().zip(b).for_each(|(a, b)| *a |= b);
    a
}
