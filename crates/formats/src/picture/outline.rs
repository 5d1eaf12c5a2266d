//! The outlines of a map's obstacles.

use std::fmt::Write;

use mediant_grid::Grid;

/// The outlines of all blocked cells as the data of an SVG path, in cells: closed loops along the edges
/// between blocked and free cells, holes included, to be filled by either rule. `None` if it is longer than
/// `most` bytes.
///
/// Unlike rectangles, outlines show no seams where the picture is scaled.
pub(super) fn outlines(grid: &Grid, most: usize) -> Option<String> {
    let mut tracer = Tracer::new(grid);
    let mut data = String::new();
    for y in 0..grid.height() as i32 {
        for x in 0..grid.width() as i32 {
            if tracer.is_top(x, y) && !tracer.was_seen(x, y) {
                tracer.trace(x, y, &mut data);
                if data.len() > most {
                    return None;
                }
            }
        }
    }
    Some(data)
}

struct Tracer<'g> {
    grid: &'g Grid,
    /// A bit for each cell: whether its upper edge was walked along.
    seen: Vec<u64>,
}

impl<'g> Tracer<'g> {
    fn new(grid: &'g Grid) -> Self {
        let cells = grid.width() as usize * grid.height() as usize;
        Self { grid, seen: vec![0; cells.div_ceil(64)] }
    }

    /// Whether a cell is blocked; cells outside the map are not filled.
    fn is_filled(&self, x: i32, y: i32) -> bool {
        let inside = (x as u32) < self.grid.width() && (y as u32) < self.grid.height();
        inside && self.grid.is_blocked(x, y)
    }

    /// Whether the upper edge of a cell is one between free above and blocked below.
    fn is_top(&self, x: i32, y: i32) -> bool {
        self.is_filled(x, y) && !self.is_filled(x, y - 1)
    }

    fn bit(&self, x: i32, y: i32) -> (usize, u64) {
        let index = y as usize * self.grid.width() as usize + x as usize;
        (index / 64, 1 << (index % 64))
    }

    fn was_seen(&self, x: i32, y: i32) -> bool {
        let (word, bit) = self.bit(x, y);
        self.seen.get(word).is_some_and(|word| word & bit != 0)
    }

    /// Walks around the loop that begins to the right along this upper edge, with blocked cells at its right
    /// hand. Where blocked cells meet diagonally, it stays with the one that it has beside it. Each loop has
    /// an upper edge, since it must come back to its top row.
    fn trace(&mut self, left: i32, top: i32, data: &mut String) {
        let start = (left, top, (1, 0));
        let (mut x, mut y, mut ahead) = start;
        let mut run = 0;
        _ = write!(data, "M{left} {top}");
        loop {
            if ahead == (1, 0) {
                let (word, bit) = self.bit(x, y);
                if let Some(word) = self.seen.get_mut(word) {
                    *word |= bit;
                }
            }
            let (dx, dy) = ahead;
            (x, y, run) = (x + dx, y + dy, run + 1);
            // The cells ahead at the right and left hand. Right of (dx, dy) is (−dy, dx), with y down.
            let cell = |side: i32| (x + (dx - side * dy - 1) / 2, y + (dy + side * dx - 1) / 2);
            let [right, left] = [1, -1].map(|side| {
                let (x, y) = cell(side);
                self.is_filled(x, y)
            });
            ahead = match (right, left) {
                (false, _) => (-dy, dx),
                (true, true) => (dy, -dx),
                (true, false) => (dx, dy),
            };
            if ahead != (dx, dy) {
                if (x, y, ahead) == start {
                    // The last side is closed by `z`.
                    data.push('z');
                    return;
                }
                let (name, length) = if dx == 0 { ('v', dy * run) } else { ('h', dx * run) };
                _ = write!(data, "{name}{length}");
                run = 0;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use mediant_grid::AsciiMap;

    use super::*;

    fn of(map: &str) -> String {
        outlines(&AsciiMap::parse(map).expect("it is a map").grid, usize::MAX).expect("it is short")
    }

    #[test]
    fn loops_go_around_obstacles_and_holes() {
        assert_eq!(of(".#\n.."), "M1 0h1v1h-1z");
        assert_eq!(of("#.\n.#"), "M0 0h1v1h-1zM1 1h1v1h-1z");
        assert_eq!(of("###\n#.#\n###"), "M0 0h3v3h-3zM1 2h1v-1h-1z");
        assert_eq!(of("##\n#."), "M0 0h2v1h-1v1h-1z");
        assert_eq!(of("..\n.."), "");
        assert_eq!(outlines(&AsciiMap::parse("#.#.#").expect("it is a map").grid, 20), None);
    }

    /// Fills the loops by the even-odd rule, from the data.
    #[test]
    fn filled_outlines_are_the_blocked_cells() {
        for seed in mediant_oracle::seeds(200) {
            let (grid, kind) = mediant_oracle::random_grid(seed);
            let (width, height) = (grid.width() as usize, grid.height() as usize);
            let data = outlines(&grid, usize::MAX).expect("there is no limit");
            // Vertical edges, as (x, row).
            let mut edges = vec![vec![false; width + 1]; height];
            for part in data.split('M').skip(1) {
                let steps = part.trim_end_matches('z');
                let at = steps.find(['h', 'v']).expect("a loop has sides");
                let (start, steps) = steps.split_at(at);
                let start: Vec<i32> = start.split(' ').map(|n| n.parse().expect("a number")).collect();
                let (mut x, mut y) = (start[0], start[1]);
                let mut walk = |x: i32, from: i32, to: i32| {
                    (from.min(to)..from.max(to)).for_each(|y| edges[y as usize][x as usize] ^= true);
                };
                for step in steps
                    .split_inclusive(|c: char| c.is_ascii_digit())
                    .collect::<String>()
                    .replace('h', " h")
                    .replace('v', " v")
                    .split_whitespace()
                {
                    let length: i32 = step[1..].parse().expect("a length");
                    if step.starts_with('h') {
                        x += length;
                    } else {
                        walk(x, y, y + length);
                        y += length;
                    }
                }
                walk(x, y, start[1]);
            }
            for (row, y) in edges.iter().zip(0..) {
                let mut inside = false;
                for (edge, x) in row.iter().zip(0..width as i32) {
                    inside ^= edge;
                    assert_eq!(inside, grid.is_blocked(x, y), "seed {seed}: {kind}, cell ({x}, {y}): {data}");
                }
            }
        }
    }
}
