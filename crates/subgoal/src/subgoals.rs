//! Which vertices are subgoals, and their numbers.

use mediant_grid::{BitMatrix, Vertex};

use crate::placement::Prepared;

/// The subgoals of a map, numbered row by row.
#[derive(Clone, Debug)]
pub(crate) struct Subgoals<T> {
    marks: BitMatrix,
    /// How many subgoals there are before each word of the marks.
    before: Box<[u32]>,
    vertices: Box<[Vertex]>,
    prepared: T,
}

impl<T: Prepared> Subgoals<T> {
    pub(crate) fn new((marks, prepared): (BitMatrix, T)) -> Self {
        let mut vertices = Vec::new();
        for y in 0..marks.height() as i32 {
            let row = marks.row(y);
            for x in (0..marks.width() as i32).step_by(64) {
                let mut bits = row.word(x);
                // What is read beyond the row's end is the next row's frame, or its beginning.
                bits &= !0 >> (64 - (marks.width() as i32 - x).min(64));
                while bits != 0 {
                    vertices.push(Vertex::new(x + bits.trailing_zeros() as i32, y));
                    bits &= bits - 1;
                }
            }
        }
        let mut sum = 0;
        let counted = |word: &u64| {
            let before = sum;
            sum += word.count_ones();
            before
        };
        let before = marks.words().iter().map(counted).collect();
        Self { marks, before, vertices: vertices.into_boxed_slice(), prepared }
    }

    /// How many there are.
    pub(crate) const fn len(&self) -> usize {
        self.vertices.len()
    }

    /// Where they are: a bit for each vertex, in a frame of zeros.
    pub(crate) const fn marks(&self) -> &BitMatrix {
        &self.marks
    }

    /// What makes finding links fast.
    pub(crate) const fn prepared(&self) -> &T {
        &self.prepared
    }

    /// Where subgoal `id` is.
    #[inline]
    pub(crate) fn vertex(&self, id: u32) -> Vertex {
        self.vertices[id as usize]
    }

    /// The number of the subgoal at a vertex.
    #[inline]
    pub(crate) fn id(&self, at: Vertex) -> Option<u32> {
        if at.x as u32 >= self.marks.width() || at.y as u32 >= self.marks.height() {
            return None;
        }
        let bit = self.marks.index(at.x, at.y).0;
        let number = (bit / 64) as usize;
        let (word, one) = (self.marks.words()[number], 1 << (bit % 64));
        (word & one != 0).then(|| self.before[number] + (word & (one - 1)).count_ones())
    }

    /// The memory that this takes.
    pub(crate) fn memory_bytes(&self) -> usize {
        let Self { marks, before, vertices, prepared } = self;
        size_of_val(marks.words())
            + size_of_val(&**before)
            + size_of_val(&**vertices)
            + prepared.memory_bytes()
    }
}
