//! The exact any-angle field at corners.

use std::{
    cmp::Reverse,
    collections::BinaryHeap,
    ops::Deref,
    sync::{Arc, OnceLock},
};

use mediant_grid::{
    BitMatrix, Corners, DiagonalGap, FreeSpace, Identity, Interrupt, Interrupted, Placement, Point, VertexId,
    load,
    sight::{Place, Ray},
    uninterrupted,
};
use mediant_moves::K;

use super::{
    cone::{Labels, Piece, Root, turns},
    lengths::{AnyAngleField, Known},
    query::{FieldError, FieldQuery, Sources},
    sight::Sight,
};
use crate::filled::filled;
use crate::limit::with_room;

/// Makes exact any-angle distance fields at corners, one after another.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace, Vertex};
/// use mediant_search::{AnyAngleFields, FieldQuery};
///
/// let map = AsciiMap::parse("
///     ....
///     .##.
///     ....
/// ")?;
/// let space = FreeSpace::<Corners>::new(Arc::new(map.grid), DiagonalGap::Open);
/// let field = AnyAngleFields::new(&space).field(FieldQuery::new(&[Vertex::new(0, 0)]))?;
/// // Around the corner (3, 1) of the obstacle.
/// let at = Vertex::new(4, 2);
/// assert_eq!(field.next(at), Some((3, 1).into()));
/// assert_eq!(field.get(at), Some(10_f64.sqrt() + 2_f64.sqrt()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// `S` is how it holds its free space: by reference, or by `Arc`. The fields hold it too.
#[derive(Clone, Debug)]
pub struct AnyAngleFields<S> {
    space: S,
    /// The convex corners of obstacles, and all gaps.
    corners: BitMatrix,
    open: BinaryHeap<Reverse<(u64, u32)>>,
    bends: Vec<(f64, VertexId)>,
    pending: Vec<Piece>,
    /// For points between vertices, in all its fields.
    sight: Arc<OnceLock<Sight>>,
}

impl<S: Deref<Target = FreeSpace<Corners>> + Clone> AnyAngleFields<S> {
    /// Prepares what fields of a free space need: a bit a vertex.
    #[must_use]
    pub fn new(space: S) -> Self {
        uninterrupted(|never| Self::interruptible(space, never))
    }

    /// [`new`](Self::new), which an interrupt can stop.
    ///
    /// # Errors
    /// [`Interrupted`].
    pub fn interruptible(space: S, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        let corners = corners(&space, true, interrupt)?;
        let (open, bends, pending, sight) = Default::default();
        Ok(Self { space, corners, open, bends, pending, sight })
    }

    /// The identity: its map and rules, and k = ∞.
    #[must_use]
    pub fn identity(&self) -> Identity {
        Identity { k: Some(K::Any), ..self.space.identity() }
    }

    /// The memory used beyond the free space, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let queued = self.open.capacity() * size_of::<Reverse<(u64, u32)>>();
        let pieces = self.pending.capacity() * size_of::<Piece>();
        size_of_val(self.corners.words()) + queued + pieces + self.bends.capacity() * size_of::<(f64, u32)>()
    }

    /// The length of a shortest any-angle path from every vertex to the nearest source.
    ///
    /// Sources may be [points](FieldQuery::from_points) between vertices.
    ///
    /// # Errors
    /// [`FieldError`] for a source that is blocked or outside the map, or a limit that is none.
    pub fn field(&mut self, query: FieldQuery<'_>) -> Result<AnyAngleField<S>, FieldError> {
        self.field_interruptible(query, &Interrupt::NEVER)
    }

    /// [`field`](Self::field), which an interrupt can stop: it asks every few thousand vertices. These fields
    /// can be used on.
    ///
    /// # Errors
    /// As for [`field`](Self::field), and [`FieldError::Interrupted`].
    pub fn field_interruptible(
        &mut self,
        query: FieldQuery<'_>,
        interrupt: &Interrupt,
    ) -> Result<AnyAngleField<S>, FieldError> {
        let Sources { vertices, between } = query.check_points(&self.space)?;
        let count = self.space.vertex_count();
        let (mut lengths, mut toward) =
            (filled(f64::INFINITY, count, interrupt)?, filled(0, count, interrupt)?);
        self.open.clear();
        self.bends.clear();
        for &id in &vertices {
            if let (Some(length), Some(toward)) = (lengths.get_mut(id.index()), toward.get_mut(id.index())) {
                if *length > 0.0 {
                    self.open.push(Reverse((0, id.0)));
                }
                (*length, *toward) = (0.0, id.0);
            }
        }
        let beyond = count as u32..;
        self.open.extend(beyond.zip(&between).map(|(number, _)| Reverse((0, number))));
        let targets: Vec<usize> =
            query.until.iter().filter_map(|&at| self.space.id(at)).map(VertexId::index).collect();
        let labels = Labels {
            space: &self.space,
            corners: &self.corners,
            lengths: &mut lengths,
            toward: &mut toward,
            between: &between,
            limit: with_room(query.limit),
            bends: &mut self.bends,
            pending: &mut self.pending,
            interrupt,
            unasked: 0,
        };
        settle(labels, &mut self.open, &targets)?;
        let mut reach = with_room(query.limit);
        if !targets.is_empty() {
            let farthest = targets.iter().filter_map(|&id| lengths.get(id)).copied().fold(0.0, f64::max);
            let farthest = with_room(farthest);
            lengths
                .iter_mut()
                .filter(|length| **length > farthest)
                .for_each(|length| *length = f64::INFINITY);
            reach = reach.min(farthest);
        }
        let between = between.into_iter().map(Point::from).collect();
        let labels = Known { lengths, toward, between, reach };
        Ok(AnyAngleField::new(self.space.clone(), labels, query, Arc::clone(&self.sight)))
    }
}

/// Settles the roots in the order of their distance, until all targets are final or none is left.
fn settle(
    mut labels: Labels<'_>,
    open: &mut BinaryHeap<Reverse<(u64, u32)>>,
    targets: &[usize],
) -> Result<(), Interrupted> {
    while let Some(Reverse((bits, number))) = open.pop() {
        let g = f64::from_bits(bits);
        let is_final = |&id: &usize| labels.lengths.get(id).is_some_and(|&length| with_room(length) <= g);
        if g > labels.limit || !targets.is_empty() && targets.iter().all(is_final) {
            return Ok(());
        }
        let Some((at, parent)) = labels.place(number).zip(labels.parent(number, g)) else { continue };
        let root = &Root { at, number, g };
        if parent == number {
            from_source(&mut labels, root)?;
        } else if let Some(parent) = labels.place(parent) {
            from_bend(&mut labels, root, parent)?;
        }
        open.extend(labels.bends.drain(..).map(|(length, id)| Reverse((length.to_bits(), id.0))));
    }
    Ok(())
}

/// Labels all that a source sees. From a closed gap a path leaves by the quadrant of the vertex's own cell.
fn from_source(labels: &mut Labels<'_>, root: &Root) -> Result<(), Interrupted> {
    if let Some(at) = root.at.vertex().filter(|&at| labels.space.is_closed_gap(at)) {
        if labels.space.grid().is_free(at.x, at.y) {
            labels.in_cone(root, 1, Some(Ray::VERTICAL), None)?;
            labels.along_line(root, 1);
        }
        return Ok(());
    }
    for down in [1, -1] {
        labels.in_half(root, down)?;
    }
    for right in [1, -1] {
        labels.along_line(root, right);
    }
    Ok(())
}

/// Labels what taut paths reach that bend at a corner: what lies between straight on and the edge of the
/// obstacle.
fn from_bend(labels: &mut Labels<'_>, root: &Root, from: Place) -> Result<(), Interrupted> {
    let space = labels.space;
    let u = from.to(root.at);
    let straight = (u.y != 0).then(|| Ray { dx: u.x, dy: u.y.abs() });
    let mut stopped = Ok(());
    turns(space, root.at.floor(), from, |(x, y), to_horizontal| {
        if stopped.is_err() {
            return;
        }
        if to_horizontal {
            let [left, right] = if x > 0 { [straight, None] } else { [None, straight] };
            stopped = labels.in_cone(root, -y, left, right);
            labels.along_line(root, x);
        } else {
            let vertical = Some(Ray::VERTICAL);
            let [left, right] = if x > 0 { [straight, vertical] } else { [vertical, straight] };
            stopped = labels.in_cone(root, y, left, right);
        }
    });
    stopped
}

/// The vertices at which paths may bend: those that touch one blocked cell, or two that meet diagonally, if a
/// path may pass between them.
pub(super) fn bends(space: &FreeSpace<Corners>, interrupt: &Interrupt) -> Result<BitMatrix, Interrupted> {
    corners(space, space.rule() == DiagonalGap::Open, interrupt)
}

/// The vertices that touch one blocked cell, and with `gaps` those that touch two that meet diagonally.
fn corners(space: &FreeSpace<Corners>, gaps: bool, interrupt: &Interrupt) -> Result<BitMatrix, Interrupted> {
    let cells = space.grid().rows();
    let (size, stop) = (Corners::vertices(space.grid()), (interrupt, "finding corners"));
    BitMatrix::from_words_interruptible(size, false, stop, |x, y| {
        let [nw, ne, sw, se] = [(-1, -1), (0, -1), (-1, 0), (0, 0)]
            .map(|(dx, dy)| load(cells.words(), cells.index(x + dx, y + dy)));
        let one = (nw ^ ne ^ sw ^ se) & !(nw & ne | sw & se);
        let gap = (nw ^ ne) & !(nw ^ se) & !(ne ^ sw);
        if gaps { one | gap } else { one }
    })
}
