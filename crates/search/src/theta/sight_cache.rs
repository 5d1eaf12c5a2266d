//! A cache of lines of sight, by whole blocks of vertices.
//!
//! Many nodes that are expanded one after another have the same parent, and it is asked whether that sees
//! their successors. If no obstacle meets the convex hull of a vertex and a block, the vertex sees the whole
//! block: one check for 16 lines of sight. On the maps ArcticStation and AR0011SR this answers 80 % of the
//! questions.

use mediant_grid::{FreeSpace, Placement, Vertex, VertexId, sight::PolygonCells};

/// Which vertices see which blocks. It depends on the map alone, so it is kept from search to search, until
/// the planner follows to another map.
#[derive(Clone, Debug)]
pub(super) struct SightCache {
    /// For each block of vertices the two answers that were asked for last.
    blocks: Box<[[BlockSight; 2]]>,
    /// The blocks of which any was asked for.
    asked: Vec<u32>,
    blocks_per_row: usize,
    /// The last vertex of the map.
    last: Vertex,
    cover: PolygonCells,
}

/// The id of a vertex, shifted left by one, and in the last bit whether it sees the whole block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct BlockSight(u32);

impl BlockSight {
    /// Nothing has been asked yet. No map has so many vertices.
    const UNKNOWN: Self = Self(u32::MAX - 1);
    /// An obstacle stands in the block: no vertex sees the whole block.
    const NEVER: Self = Self(u32::MAX);

    const fn new(from: VertexId, clear: bool) -> Self {
        Self(from.0 << 1 | clear as u32)
    }
}

/// The binary logarithm of a block's side: blocks have 4 × 4 vertices. With 8 × 8, Theta* takes 1.2 times as
/// long on ArcticStation and AR0011SR, and 0.9 to 1.0 times as long on rooms and random maps.
const SHIFT: u32 = 2;

impl SightCache {
    pub(super) fn new<P: Placement>(space: &FreeSpace<P>) -> Self {
        let (width, height) = P::vertices(space.grid());
        let [columns, rows] = [width, height].map(|side| side.div_ceil(1 << SHIFT) as usize);
        Self {
            blocks: vec![[BlockSight::UNKNOWN; 2]; columns * rows].into_boxed_slice(),
            asked: Vec::new(),
            blocks_per_row: columns,
            last: Vertex::new(width as i32 - 1, height as i32 - 1),
            cover: PolygonCells::default(),
        }
    }

    /// Forgets all answers, and takes others on the map of a free space. The memory is kept if that has the
    /// same size.
    pub(super) fn follow<P: Placement>(&mut self, space: &FreeSpace<P>) {
        let (width, height) = P::vertices(space.grid());
        if self.last != Vertex::new(width as i32 - 1, height as i32 - 1) {
            *self = Self::new(space);
        } else if self.asked.len() > self.blocks.len() / 4 {
            // All at once is quicker than so many one by one.
            self.blocks.fill([BlockSight::UNKNOWN; 2]);
            self.asked.clear();
        } else {
            self.asked.drain(..).for_each(|block| self.blocks[block as usize] = [BlockSight::UNKNOWN; 2]);
        }
    }

    /// The bytes that it takes when it is made.
    pub(super) fn bytes<P: Placement>(space: &FreeSpace<P>) -> usize {
        let (width, height) = P::vertices(space.grid());
        let [columns, rows] = [width, height].map(|side| side.div_ceil(1 << SHIFT) as usize);
        (columns * rows).saturating_mul(size_of::<[BlockSight; 2]>())
    }

    /// [`FreeSpace::sees`] for two free vertices.
    #[inline]
    pub(super) fn sees<P: Placement>(
        &mut self,
        space: &FreeSpace<P>,
        id: VertexId,
        from: Vertex,
        to: Vertex,
    ) -> bool {
        let block = (to.y >> SHIFT) as usize * self.blocks_per_row + (to.x >> SHIFT) as usize;
        let [first, second] = self.blocks[block];
        let [clear, hidden] = [true, false].map(|clear| BlockSight::new(id, clear));
        let is_clear = if first == clear || second == clear {
            true
        } else if first == hidden || second == hidden || first == BlockSight::NEVER {
            false
        } else {
            self.look(space, id, from, to, block)
        };
        debug_assert!(!is_clear || space.sees(from, to), "{from} does not see {to}");
        is_clear || space.sees(from, to)
    }

    /// Whether a vertex sees the whole block of `to`; stores the answer.
    #[inline(never)]
    fn look<P: Placement>(
        &mut self,
        space: &FreeSpace<P>,
        id: VertexId,
        from: Vertex,
        to: Vertex,
        block: usize,
    ) -> bool {
        let low = Vertex::new(to.x >> SHIFT << SHIFT, to.y >> SHIFT << SHIFT);
        let side = (1 << SHIFT) - 1;
        let high = Vertex::new((low.x + side).min(self.last.x), (low.y + side).min(self.last.y));
        let [ne, sw] = [Vertex::new(high.x, low.y), Vertex::new(low.x, high.y)];
        let mut edges = [[low, sw], [ne, high], [low, ne], [sw, high], [low, low], [low, low]];
        let is_flat = [low, high, from].iter().all(|at| at.x == low.x)
            || [low, high, from].iter().all(|at| at.y == low.y);
        if is_flat {
            // A hull without interior may run between two obstacles.
            return false;
        }
        if self.blocks[block][0] == BlockSight::UNKNOWN {
            self.asked.push(block as u32);
            self.cover.set::<P>(low, high, &edges);
            if !self.cover.is_free(space.grid()) {
                self.blocks[block] = [BlockSight::NEVER; 2];
                return false;
            }
        }
        let tangents = match (from.x < low.x, from.x > high.x, from.y < low.y, from.y > high.y) {
            (true, _, true, _) | (_, true, _, true) => [ne, sw],
            (true, _, _, true) | (_, true, true, _) => [low, high],
            (true, ..) => [low, sw],
            (_, true, ..) => [ne, high],
            (_, _, true, _) => [low, ne],
            _ => [sw, high],
        };
        edges[4] = [from, tangents[0]];
        edges[5] = [from, tangents[1]];
        let least = Vertex::new(low.x.min(from.x), low.y.min(from.y));
        let greatest = Vertex::new(high.x.max(from.x), high.y.max(from.y));
        self.cover.set::<P>(least, greatest, &edges);
        let clear = self.cover.is_free(space.grid());
        let answers = &mut self.blocks[block];
        *answers = [BlockSight::new(id, clear), answers[0]];
        clear
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, Grid};
    use mediant_oracle::{Rng, random_free_vertex, suite_grid};

    use super::*;

    /// Compares answers. Returns how many came from a block that is seen as a whole, of how many blocks any
    /// was asked for, and how many of these no vertex sees as a whole, or none of the last two.
    fn check<P: Placement>(rule: P::Rule, seed: u64) -> [usize; 4] {
        let space = FreeSpace::<P>::new(Arc::new(suite_grid(seed).0), rule);
        let mut rng = Rng::new(seed ^ 0x51);
        let mut sight = SightCache::new(&space);
        let mut free = |_| random_free_vertex(&mut rng, space.grid(), P::KIND);
        // Few vertices that look, so that answers are remembered, and remembered ones driven out.
        let lookouts: Vec<Vertex> = (0..5).filter_map(&mut free).collect();
        let mut clear = 0;
        for to in (0..400).filter_map(free) {
            let from = lookouts[(to.x + to.y) as usize % lookouts.len()];
            let id = space.id(from).expect("a vertex of the map");
            let seen = sight.sees(&space, id, from, to);
            assert_eq!(seen, space.sees(from, to), "seed {seed}, {}: {from} to {to}", space.rules());
            let block = (to.y >> SHIFT) as usize * sight.blocks_per_row + (to.x >> SHIFT) as usize;
            clear += usize::from(sight.blocks[block].contains(&BlockSight::new(id, true)));
        }
        let count =
            |is: &dyn Fn(&[BlockSight; 2]) -> bool| sight.blocks.iter().filter(|&block| is(block)).count();
        let is_hidden = |answer: &BlockSight| answer.0 < BlockSight::UNKNOWN.0 && answer.0 & 1 == 0;
        let never = count(&|block| block[0] == BlockSight::NEVER);
        let hidden = count(&|block| block.iter().all(is_hidden));
        let asked = sight.asked.len();
        // On another map nothing is known.
        let (width, height) = (space.grid().width(), space.grid().height());
        let open =
            FreeSpace::<P>::new(Arc::new(Grid::from_fn(width, height, |_, _| false).expect("a map")), rule);
        sight.follow(&open);
        assert!(
            sight.asked.is_empty() && sight.blocks.iter().all(|block| *block == [BlockSight::UNKNOWN; 2])
        );
        [clear, asked, never, hidden]
    }

    /// The counts tell how many lines are not looked along: no path does.
    #[test]
    fn what_is_remembered_is_what_is_seen() {
        let mut counts = [[0; 4]; 5];
        for seed in 0..200 {
            let of_map = [
                check::<Corners>(DiagonalGap::Open, seed),
                check::<Corners>(DiagonalGap::Closed, seed),
                check::<Centers>(CornerRule::Never, seed),
                check::<Centers>(CornerRule::One, seed),
                check::<Centers>(CornerRule::Always, seed),
            ];
            counts.iter_mut().zip(of_map).for_each(|(sums, of_map)| {
                sums.iter_mut().zip(of_map).for_each(|(sum, count)| *sum += count);
            });
        }
        let [at_corners, at_centers] = [[15_003, 1_315, 707, 272], [8_434, 968, 682, 133]];
        assert_eq!(counts, [at_corners, at_corners, at_centers, at_centers, at_centers]);
    }
}
