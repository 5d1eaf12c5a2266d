//! Scans along diagonals by words: 64 vertices a step, as [`axial`](super::axial) does along the axes.
//!
//! A diagonal jump *stops* where its move is not legal, at a vertex with a forced successor, and at an
//! intermediate jump point, where one of the two axial jumps beside it comes to a jump point. All of that
//! depends on the map alone. So it is computed once and stored: for each odd move a bit plane of the vertices
//! that stop a jump which enters them, and one for each of the two axial jumps that says from which vertices
//! it comes to a jump point. From those where it comes to [dead ends](super::dead_ends) alone that is stored
//! as well, but they stop a jump only near the goal. (Where the goal lies beside the jump is known from its
//! coordinates.)
//!
//! In a plane the bits of a diagonal follow one another, in the order of the jump. Diagonals that leave the
//! map on one side go on at the other: so there are as many lines as columns, each as long as a column, and
//! no bit is wasted. A jump stops at the edge, because no move leads there from outside.
//!
//! The planes are computed in rows, 64 vertices at a time, and then turned, 64 × 64 bits at a time. They take
//! twelve bits a vertex, on top of the byte of [`AxialStops`](super::axial::AxialStops).

use mediant_grid::{
    GridGraph, Interrupt, Interrupted, Placement, Vector, VersionEdit, Versioned, Vertex, room_for,
};
use mediant_moves::FiniteK;

use super::{
    DURING,
    stop_rows::{EnterRows, Leads, StopRows, Stops},
};
use crate::canonical::Pruning;

/// Where diagonal jumps stop, for each vertex of a grid graph with k ≤ 3.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct DiagonalStops {
    planes: [Plane; 4],
    words: Versioned<Stops>,
    lines: u64,
    /// 2⁴⁰ / `lines`, rounded up.
    reciprocal: u64,
}

/// Where the bits of one odd move are: that of vertex (x, y) in the line (`across` · (x, y) + `shift`) modulo
/// the number of lines, at the place `along` · (x, y) + `start`, counted from the plane's first bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Plane {
    across: Vector,
    shift: i32,
    along: Vector,
    start: i32,
    first: u64,
    /// The bits of a line.
    length: u64,
}

impl DiagonalStops {
    /// The number of lines of a plane, and their length.
    fn lines<P: Placement>(graph: &GridGraph<P>) -> (u32, u32) {
        let (width, height) = P::vertices(graph.grid());
        if graph.k() == FiniteK::N4 { (height, width) } else { (width, height) }
    }

    /// The number of words. A scan reads two.
    fn words<P: Placement>(graph: &GridGraph<P>) -> usize {
        let (lines, length) = Self::lines(graph);
        graph.steps().len() / 2 * lines as usize * (length / 64 + 1) as usize + 1
    }

    /// The memory that the planes of a grid graph use, in bytes.
    pub(crate) fn bytes<P: Placement>(graph: &GridGraph<P>) -> usize {
        Self::words(graph).saturating_mul(size_of::<Stops>())
    }

    /// Computes the planes of a grid graph. `enters` says where diagonal moves lead, `leads` from which
    /// vertices axial jumps come to jump points, and from which they do where they pass dead ends.
    pub(super) fn new<P: Placement>(
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        (enters, leads): (&EnterRows, [&Leads; 2]),
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let (width, height) = P::vertices(graph.grid());
        let odd: Vec<usize> = (1..graph.steps().len()).step_by(2).collect();
        let (lines, length) = Self::lines(graph);
        let per_line = (length / 64 + 1) as usize;
        let per_plane = lines as usize * per_line;
        let words = Self::words(graph);
        room_for::<Stops>(words, DURING)?;
        let mut all = Self {
            planes: [Plane::default(); 4],
            words: vec![[0; 3]; words].into(),
            lines: u64::from(lines),
            reciprocal: (1 << 40) / u64::from(lines) + 1,
        };
        let to = all.words.make_mut();
        for (i, &index) in odd.iter().enumerate() {
            let first = i * per_plane;
            all.planes[i] =
                Plane::new(graph.step(index).vector(), (width as i32, height as i32), first as u64 * 64);
            let plane = &mut to[first..first + per_plane];
            StopRows::new(graph, pruning, index, (enters, leads)).put((plane, per_line), interrupt)?;
            for line in plane.chunks_exact_mut(per_line) {
                if let Some(last) = line.last_mut() {
                    // Beyond the end of the line.
                    last[0] |= !0 << (length % 64);
                }
            }
        }
        to[words - 1][0] = !0;
        Ok(all)
    }

    /// Begins an edit of these planes, which stay as they are.
    pub(super) fn edit(&self) -> Result<DiagonalEdit<'_>, Interrupted> {
        Ok(DiagonalEdit { before: self, words: self.words.edit_if_room(DURING)? })
    }

    /// The place of the bit of a vertex of the map for jumps by the odd move `index`.
    #[inline]
    pub(crate) fn place(&self, at: Vertex, index: usize) -> u64 {
        self.plane(index).place(at)
    }

    #[inline]
    const fn plane(&self, index: usize) -> Lines {
        Lines { plane: self.planes[index >> 1 & 3], lines: self.lines, reciprocal: self.reciprocal }
    }

    /// The scan of a diagonal jump from a vertex of the map by the odd move `index`.
    #[inline]
    pub(super) fn scan(&self, from: Vertex, index: usize) -> DiagonalScan<'_> {
        let (place, words) = (self.place(from, index), &*self.words);
        // Before the first word is loaded.
        DiagonalScan { words, place: place.wrapping_sub(63), first: 0u32.wrapping_sub(63), stops: 0 }
    }

    /// Whether a diagonal jump from a vertex of the map can enter so many vertices. `can_enter` says it of
    /// those that stop it and from which no axial jump leads on, by the number of steps to them.
    #[inline]
    pub(super) fn can_make(
        &self,
        from: Vertex,
        index: usize,
        steps: u32,
        can_enter: impl Fn(u32) -> bool,
    ) -> bool {
        let (mut at, mut made) = (self.place(from, index) + 1, 0);
        while made < steps {
            let (word, shift) = ((at >> 6) as usize, at & 63);
            let Some(&[low, high]) = self.words.get(word..word + 2) else { return false };
            let [low, high] = [low, high].map(|[stops, first, second]| stops & !(first | second));
            let mut left = low >> shift | high << 1 << (63 - shift);
            if steps - made < 64 {
                left &= (1 << (steps - made)) - 1;
            }
            while left != 0 {
                if !can_enter(made + left.trailing_zeros() + 1) {
                    return false;
                }
                left &= left - 1;
            }
            (at, made) = (at + 64, made + 64);
        }
        true
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        size_of_val(&*self.words)
    }
}

/// The next version of planes while it is made.
pub(super) struct DiagonalEdit<'s> {
    before: &'s DiagonalStops,
    words: VersionEdit<Stops>,
}

impl DiagonalEdit<'_> {
    /// The places of the bits of an odd move.
    pub(super) const fn plane(&self, index: usize) -> Lines {
        self.before.plane(index)
    }

    /// Changes what is said of the vertex at a place: whether it stops the jump, and whether the first and
    /// the second axial jump come to a jump point from there.
    #[inline]
    pub(super) fn change(&mut self, place: u64, next: impl FnOnce([bool; 3]) -> [bool; 3]) {
        let (word, bit) = ((place >> 6) as usize, place & 63);
        let known = self.words.words()[word].map(|word| word >> bit & 1 == 1);
        let next = next(known);
        if next != known {
            let changed = self.words.word_mut(word);
            for i in 0..3 {
                changed[i] ^= u64::from(known[i] != next[i]) << bit;
            }
        }
    }

    /// The next version.
    pub(super) fn finish(self) -> DiagonalStops {
        let &DiagonalStops { planes, lines, reciprocal, .. } = self.before;
        DiagonalStops { planes, words: self.words.finish(), lines, reciprocal }
    }
}

/// The lines of the plane of an odd move.
#[derive(Clone, Copy)]
pub(super) struct Lines {
    plane: Plane,
    lines: u64,
    reciprocal: u64,
}

impl Lines {
    /// The place of the bit of a vertex of the map.
    #[inline]
    pub(super) const fn place(self, at: Vertex) -> u64 {
        let Self { plane, lines, reciprocal } = self;
        let line = plane.across.x * at.x + plane.across.y * at.y + plane.shift;
        // A division by a multiplication, exact below 2²⁰ lines.
        let line = line as u32 as u64;
        let line = line - lines * ((line * reciprocal) >> 40);
        let place = plane.along.x * at.x + plane.along.y * at.y + plane.start;
        plane.first + line * plane.length + place as u32 as u64
    }
}

/// A diagonal jump, from stop to stop.
pub(super) struct DiagonalScan<'s> {
    words: &'s [Stops],
    /// The bit of the first of 64 vertices, and after how many steps the jump enters it.
    place: u64,
    first: u32,
    /// The stops among these vertices that are still to come, as a mask.
    stops: u64,
}

impl DiagonalScan<'_> {
    /// After how many steps it stops next, and which of the two axial jumps come to a jump point from there;
    /// if none does, either it cannot enter that vertex, or that has a forced successor.
    ///
    /// `near_goal` says of 64 vertices, the first of them after so many steps, from which of them dead ends
    /// count as jump points, for the first and for the second axial jump; `None` for none.
    #[inline]
    pub(super) fn next(&mut self, near_goal: impl Fn(u32) -> Option<[u64; 2]>) -> (u32, [bool; 2]) {
        while self.stops == 0 {
            self.place = self.place.wrapping_add(64);
            self.first = self.first.wrapping_add(64);
            let (word, shift) = ((self.place >> 6) as usize, self.place & 63);
            let Some([low, high]) = self.words.get(word..word + 2) else {
                return (self.first, [false; 2]);
            };
            // Shifting in two steps avoids a shift by 64 where `shift` is 0.
            let from_here = |i: usize| low[i] >> shift | high[i] << 1 << (63 - shift);
            self.stops = from_here(0);
            if let Some([first, second]) = near_goal(self.first) {
                self.stops |= from_here(1) & first | from_here(2) & second;
            }
        }
        let n = self.stops.trailing_zeros();
        self.stops &= self.stops - 1;
        let at = self.place + u64::from(n);
        let leads = self.words.get((at >> 6) as usize).copied().unwrap_or_default();
        (self.first + n, [1, 2].map(|i| leads[i] >> (at & 63) & 1 == 1))
    }
}

impl Plane {
    fn new(v: Vector, (width, height): (i32, i32), first: u64) -> Self {
        let length = |length: i32| (length as u64 / 64 + 1) * 64;
        if v.y == 0 {
            let start = if v.x > 0 { 0 } else { width - 1 };
            let (across, along) = (Vector::new(0, 1), v);
            return Self { across, shift: 0, along, start, first, length: length(width) };
        }
        // The place is y, or counted from the last row. The line is x − v.x · place, plus a multiple of the
        // width so that it is no less than 0.
        let (along, start) = (Vector::new(0, v.y), if v.y > 0 { 0 } else { height - 1 });
        let whole = (height + width - 1) / width * width;
        let (across, shift) = (Vector::new(1, -v.x * v.y), whole - v.x * start);
        Self { across, shift, along, start, first, length: length(height) }
    }
}
