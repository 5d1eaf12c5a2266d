//! The ways around a pair of moves: legal in its stead, they make it superfluous.

use mediant_grid::{CellOffset, Footprint, Placement};
use mediant_moves::{Cost, FiniteK, Neighborhood, Vector, decompose};

/// The order among last moves: even ones first, then by index. Of two equally cheap ways to a vertex, the one whose last move comes first
/// is the earlier; of two with the same last move, the one whose way to that move is.
pub(crate) const fn rank(index: usize) -> usize {
    (index & 1) << 16 | index
}

/// The moves of N(k), what they cost, and what they ask of the map.
pub(crate) struct MoveTable<P: Placement> {
    pub(crate) vectors: Vec<Vector>,
    pub(crate) footprints: Vec<Footprint>,
    costs: Vec<Cost>,
    neighborhood: Neighborhood,
    rule: P::Rule,
}

/// What a path asks of the map, by offsets from one vertex.
#[derive(Clone, Debug, Default)]
pub(crate) struct Requirements {
    pub(crate) free: Vec<CellOffset>,
    pub(crate) either: Vec<[CellOffset; 2]>,
    /// The vertices that it passes, where no path may pass a gap.
    pub(crate) passed: Vec<Vector>,
}

impl<P: Placement> MoveTable<P> {
    pub(crate) fn new(rule: P::Rule, neighborhood: Neighborhood) -> Self {
        let vectors: Vec<Vector> = neighborhood.iter().collect();
        let footprints = vectors.iter().map(|&v| Footprint::new::<P>(rule, v)).collect();
        let costs = vectors.iter().map(|&v| Cost::of_move(v)).collect();
        Self { vectors, footprints, costs, neighborhood, rule }
    }

    pub(crate) fn len(&self) -> usize {
        self.vectors.len()
    }

    fn k(&self) -> FiniteK {
        self.neighborhood.k()
    }

    fn index_of(&self, v: Vector) -> Option<usize> {
        self.neighborhood.index_of(v).map(|index| index as usize)
    }

    /// Calls `each` with sequences of moves of the same displacement as move `a` and then move `b`, that are cheaper, or as cheap and
    /// earlier: single moves, pairs, and the cheapest path on an empty grid in its plainest orders. Opposite moves have the empty
    /// sequence. None for a = b.
    pub(crate) fn alternatives(&self, a: usize, b: usize, mut each: impl FnMut(&[usize])) {
        let d = self.vectors[a] + self.vectors[b];
        let cost = self.costs[a] + self.costs[b];
        if d == Vector::new(0, 0) {
            return each(&[]);
        }
        if let Some(c) = self.index_of(d) {
            each(&[c]);
        }
        for first in (0..self.len()).filter(|&first| first != a) {
            let Some(last) = self.index_of(d + -self.vectors[first]) else { continue };
            let instead = self.costs[first] + self.costs[last];
            if instead < cost || instead == cost && rank(last) < rank(b) {
                each(&[first, last]);
            }
        }
        let Some([(u, m), (v, n)]) = decompose(d, self.k()).map(mediant_moves::Decomposition::canonical)
        else {
            return;
        };
        let (Some(u), Some(v)) = (self.index_of(u), self.index_of(v)) else { return };
        if m + n <= 2 || self.costs[u] * m + self.costs[v] * n >= cost {
            return;
        }
        let (m, n) = (m as usize, n as usize);
        each(&[vec![u; m], vec![v; n]].concat());
        each(&[vec![v; n], vec![u; m]].concat());
        each(&[vec![u; m / 2], vec![v; n], vec![u; m - m / 2]].concat());
        each(&[vec![v; n / 2], vec![u; m], vec![v; n - n / 2]].concat());
    }

    /// What a sequence of moves asks of the map when it begins at `start`.
    pub(crate) fn requirements(&self, start: Vector, sequence: &[usize]) -> Requirements {
        let mut required = Requirements::default();
        let mut at = start;
        for (i, &index) in sequence.iter().enumerate() {
            if i > 0 && P::closes_gaps(self.rule) {
                required.passed.push(at);
            }
            let cell = |(x, y): CellOffset| (x + at.x, y + at.y);
            required.free.extend(self.footprints[index].free.iter().map(|&offset| cell(offset)));
            required.either.extend(self.footprints[index].either.iter().map(|pair| pair.map(cell)));
            at = at + self.vectors[index];
        }
        required
    }
}

impl Requirements {
    /// The pairs of cells beside one another around a vertex at `at`. With one of them free, two blocked cells do not meet
    /// there diagonally.
    pub(crate) fn beside(at: Vector) -> [[CellOffset; 2]; 4] {
        let [nw, ne, sw, se] = [(-1, -1), (0, -1), (-1, 0), (0, 0)].map(|(x, y)| (at.x + x, at.y + y));
        [[nw, ne], [sw, se], [nw, sw], [ne, se]]
    }
}
