//! Which vertices are subgoals, and their numbers.

use mediant_grid::{BitMatrix, Interrupt, Interrupted, Vertex, room_for, room_in};

/// The subgoals of a map, numbered row by row.
#[derive(Clone, Debug)]
pub(crate) struct Subgoals {
    marks: BitMatrix,
    /// The number of subgoals before each word of the marks.
    before: Box<[u32]>,
    /// Their coordinates: 16 bits hold each, since no map has more than 2¹⁵ cells along a side.
    places: Box<[[u16; 2]]>,
}

/// The stage that an interrupted call names.
const DURING: &str = "finding subgoals";

impl Subgoals {
    /// The subgoals that are marked by a bit for each vertex, in a frame of zeros.
    pub(crate) fn new(marks: BitMatrix, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        let mut places = Vec::new();
        for y in 0..marks.height() as i32 {
            interrupt.check(DURING)?;
            room_in(&mut places, marks.width() as usize, DURING)?;
            let row = marks.row(y);
            for x in (0..marks.width() as i32).step_by(64) {
                let mut bits = row.word(x);
                // Bits beyond the row's end belong to the frame or to the next row.
                bits &= !0 >> (64 - (marks.width() as i32 - x).min(64));
                while bits != 0 {
                    places.push([x as u16 + bits.trailing_zeros() as u16, y as u16]);
                    bits &= bits - 1;
                }
            }
        }
        room_for::<u32>(marks.words().len(), DURING)?;
        let mut sum = 0;
        let counted = |word: &u64| {
            let before = sum;
            sum += word.count_ones();
            before
        };
        let before = marks.words().iter().map(counted).collect();
        Ok(Self { marks, before, places: places.into_boxed_slice() })
    }

    /// The number of subgoals.
    pub(crate) const fn len(&self) -> usize {
        self.places.len()
    }

    /// A bit for each vertex, in a frame of zeros.
    pub(crate) const fn marks(&self) -> &BitMatrix {
        &self.marks
    }

    /// The vertex of subgoal `id`.
    #[inline]
    pub(crate) fn vertex(&self, id: u32) -> Vertex {
        let [x, y] = self.places[id as usize];
        Vertex::new(x.into(), y.into())
    }

    /// The number of the subgoal at a vertex, if there is one.
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

    /// The memory used, in bytes.
    pub(crate) fn memory_bytes(&self) -> usize {
        let Self { marks, before, places } = self;
        size_of_val(marks.words()) + size_of_val(&**before) + size_of_val(&**places)
    }
}
