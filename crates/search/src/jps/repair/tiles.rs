//! A coarse set of vertices: the square tiles in which some of them lie.

use mediant_grid::Vertex;

use super::super::zone::Zone;

/// Tiles of a map, in rows: a bit for each.
#[derive(Debug)]
pub(super) struct Tiles {
    map: Zone,
    /// A side of a tile has 2^`side` vertices.
    side: u32,
    words_a_row: usize,
    words: Vec<u64>,
}

impl Tiles {
    /// None of the tiles of a map with sides of 2^`side` vertices.
    pub(super) fn new(map: Zone, side: u32) -> Self {
        let [width, height] = [map.last.x, map.last.y].map(|last| (last >> side) as usize + 1);
        let words_a_row = width.div_ceil(64);
        Self { map, side, words_a_row, words: vec![0; words_a_row * height] }
    }

    /// Adds those of the tiles that hold a vertex of a zone, as far as it lies in the map.
    pub(super) fn add(&mut self, zone: Zone) {
        let Zone { first, last } = zone.within(self.map);
        if first.x > last.x || first.y > last.y {
            return;
        }
        let [from, to] = [first.x, last.x].map(|x| (x >> self.side) as usize);
        for y in first.y >> self.side..=last.y >> self.side {
            let row = &mut self.words[y as usize * self.words_a_row..][..self.words_a_row];
            for (word, bits) in row.iter_mut().enumerate().take(to / 64 + 1).skip(from / 64) {
                let low = from.saturating_sub(64 * word);
                *bits |= !0 << low & !0 >> (63 - (to - 64 * word).min(63));
            }
        }
    }

    /// Whether the tile of a vertex of the map is one of them.
    pub(super) fn hold(&self, at: Vertex) -> bool {
        let [x, y] = [at.x, at.y].map(|at| (at >> self.side) as usize);
        self.words[y * self.words_a_row + x / 64] >> (x % 64) & 1 == 1
    }

    /// The rectangles of vertices that these tiles are, each as wide as there are tiles side by side, and as
    /// high as these are the same.
    pub(super) fn zones(&self) -> Vec<Zone> {
        let (mut all, mut open): (Vec<Zone>, Vec<Zone>) = (Vec::new(), Vec::new());
        for (row, y) in self.words.chunks_exact(self.words_a_row).zip((0..).step_by(1 << self.side)) {
            let mut next = Vec::new();
            for run in runs(row) {
                let [first, last] = [run.0 << self.side, (run.1 << self.side) - 1].map(|x| x as i32);
                let last_y = y + (1 << self.side) - 1;
                let above = open.iter().position(|above| (above.first.x, above.last.x) == (first, last));
                let first_y = above.map_or(y, |above| open.swap_remove(above).first.y);
                next.push(Zone { first: Vertex::new(first, first_y), last: Vertex::new(last, last_y) });
            }
            all.append(&mut open);
            open = next;
        }
        all.append(&mut open);
        all.into_iter().map(|zone| zone.within(self.map)).collect()
    }
}

/// Vertices near the zones of a change.
#[derive(Debug)]
pub(super) enum Near {
    Zone(Zone),
    Tiles(Tiles),
}

impl Near {
    /// The vertices of a map within a distance of zones; of more than one zone, by tiles with sides of
    /// 2^`side` vertices.
    pub(super) fn new(zones: &[Zone], distance: i32, (map, side): (Zone, u32)) -> Self {
        if let &[zone] = zones {
            return Self::Zone(zone.grown(distance, distance).within(map));
        }
        let mut tiles = Tiles::new(map, side);
        zones.iter().for_each(|zone| tiles.add(zone.grown(distance, distance)));
        Self::Tiles(tiles)
    }

    pub(super) fn zones(&self) -> Vec<Zone> {
        match self {
            Self::Zone(zone) => vec![*zone],
            Self::Tiles(tiles) => tiles.zones(),
        }
    }

    /// Whether a vertex of the map is one of them.
    pub(super) fn holds(&self, at: Vertex) -> bool {
        match self {
            Self::Zone(zone) => zone.holds(at),
            Self::Tiles(tiles) => tiles.hold(at),
        }
    }
}

/// The runs of bits in words, each with the number of its first bit and of the first one after it.
fn runs(words: &[u64]) -> Vec<(usize, usize)> {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for (word, &bits) in words.iter().enumerate() {
        let mut left = bits;
        while left != 0 {
            let first = left.trailing_zeros();
            let length = (left >> first).trailing_ones();
            left &= left.wrapping_add(1 << first);
            let (from, to) = (64 * word + first as usize, 64 * word + (first + length) as usize);
            match runs.last_mut() {
                Some(last) if last.1 == from => last.1 = to,
                _ => runs.push((from, to)),
            }
        }
    }
    runs
}
