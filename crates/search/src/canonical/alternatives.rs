//! The alternatives to a pair of moves: paths that, where they are legal, make the pair superfluous.

use mediant_grid::{CellOffset, Footprint, Placement};
use mediant_moves::{Cost, FiniteK, Neighborhood, Vector, decompose};

use super::order::rank;

/// The moves of N(k), their costs, and the cells that they require to be free.
pub(crate) struct MoveTable<P: Placement> {
    pub(crate) vectors: Vec<Vector>,
    pub(crate) footprints: Vec<Footprint>,
    costs: Vec<Cost>,
    neighborhood: Neighborhood,
    rule: P::Rule,
}

/// The conditions under which a path is legal, by offsets from one vertex.
#[derive(Clone, Debug, Default)]
pub(crate) struct Requirements {
    /// The cells that must be free.
    pub(crate) free: Vec<CellOffset>,
    /// Pairs of cells of which one must be free.
    pub(crate) either: Vec<[CellOffset; 2]>,
    /// The vertices that it passes and that must not be gaps; empty where paths may pass gaps.
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

    /// Calls `each` with the sequences of moves that have the displacement of move `a` followed by move `b`
    /// and are cheaper, or as cheap and earlier: single moves, pairs, and the cheapest path on an empty grid
    /// in its plainest orders. The alternative to two opposite moves is the empty sequence. There is none for
    /// a = b.
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

    /// The conditions under which a sequence of moves from `start` is legal.
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
    /// The four pairs of adjacent cells around the vertex `at`. If both cells of one pair are free, the
    /// vertex is no gap.
    pub(crate) fn beside(at: Vector) -> [[CellOffset; 2]; 4] {
        let [nw, ne, sw, se] = [(-1, -1), (0, -1), (-1, 0), (0, 0)].map(|(x, y)| (at.x + x, at.y + y));
        [[nw, ne], [sw, se], [nw, sw], [ne, se]]
    }
}
