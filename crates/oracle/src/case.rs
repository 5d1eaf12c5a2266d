//! Cases of random tests, and the messages of failing ones.

use std::{
    fmt,
    num::NonZero,
    ops::Range,
    panic::resume_unwind,
    thread::{self, ScopedJoinHandle},
};

use mediant_grid::{Grid, Rules, Vertex};

use crate::{Rng, generate::draw_grid, random_free_vertex};

/// A query on a map, and its origin. Its text form is that of [`describe`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// The map.
    pub grid: Grid,
    /// The kind and size of the map, in words.
    pub kind: String,
    /// The rules of motion.
    pub rules: Rules,
    /// The start, a free vertex.
    pub start: Vertex,
    /// The goal, a free vertex.
    pub goal: Vertex,
    /// The seed from which all this was drawn.
    pub seed: u64,
}

impl Case {
    /// The map of [`random_grid`](crate::random_grid) for this seed, and two of its free vertices; `None` if
    /// it has no free vertex.
    #[must_use]
    pub fn random(seed: u64, rules: Rules) -> Option<Self> {
        let mut rng = Rng::new(seed);
        let (grid, kind) = draw_grid(&mut rng);
        let start = random_free_vertex(&mut rng, &grid, rules.placement())?;
        let goal = random_free_vertex(&mut rng, &grid, rules.placement())?;
        Some(Self { grid, kind, rules, start, goal, seed })
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&describe(&self.grid, self.rules, self.start, self.goal, self.seed))
    }
}

/// The seeds of a random suite, counted from 0. There are `default` of them, unless the environment variable
/// `MEDIANT_GRIDS` says otherwise: a number, or how many times as many, as `10x`.
///
/// # Panics
/// If `MEDIANT_GRIDS` is neither: otherwise the suite would silently run on fewer maps than it was asked
/// for.
#[must_use]
pub fn seeds(default: u64) -> Range<u64> {
    let asked = std::env::var_os("MEDIANT_GRIDS").map(|text| {
        let number = text.to_str().and_then(|text| count(text, default));
        number.unwrap_or_else(|| panic!("MEDIANT_GRIDS is {text:?}, neither a number nor one with an x"))
    });
    0..asked.unwrap_or(default)
}

/// A number of maps, absolute or, with an `x`, relative to the suite's own number.
fn count(text: &str, default: u64) -> Option<u64> {
    match text.strip_suffix('x') {
        Some(times) => times.parse::<u64>().ok()?.checked_mul(default),
        None => text.parse().ok(),
    }
}

/// Whether the environment variable `MEDIANT_EXHAUSTIVE` is set: suites over all there is then leave nothing
/// out.
#[must_use]
pub fn is_exhaustive() -> bool {
    std::env::var_os("MEDIANT_EXHAUSTIVE").is_some()
}

/// The step by which a suite goes through all there is: 1 [if that is asked](is_exhaustive). Through maps it
/// is odd, so that those of a sample differ in all cells.
#[must_use]
pub fn every(step: usize) -> usize {
    if is_exhaustive() { 1 } else { step }
}

/// Every `step`-th map of 3 × 3 cells, or [all](every), with its number, whose bits are its cells: the
/// smallest maps hold the oddest cases.
///
/// # Panics
/// If the step is 0.
pub fn maps_of_nine_cells(step: usize) -> impl Iterator<Item = (u64, Grid)> {
    (0..1_u64 << 9).step_by(every(step)).map(|cells| {
        let grid = Grid::from_fn(3, 3, |x, y| cells >> (3 * y + x) & 1 == 1);
        (cells, grid.expect("a valid size"))
    })
}

/// Calls `part` with each seed, on all cores, and returns the results, in no particular order.
///
/// # Panics
/// If `part` does.
pub fn on_all_cores<R: Send>(seeds: Range<u64>, part: impl Fn(u64) -> R + Sync) -> Vec<R> {
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    let part = |first: usize| seeds.clone().skip(first).step_by(threads).map(&part).collect::<Vec<R>>();
    thread::scope(|scope| {
        let parts: Vec<_> = (0..threads).map(|first| scope.spawn(move || part(first))).collect();
        let said = |part: ScopedJoinHandle<'_, Vec<R>>| part.join().unwrap_or_else(|why| resume_unwind(why));
        parts.into_iter().flat_map(said).collect()
    })
}

/// The rules, the query, the seed, and the map in a form that
/// [`AsciiMap::parse`](mediant_grid::AsciiMap::parse) reads.
///
/// `s` and `g` mark the cells of start and goal; under corner placement, the cells to the lower right of
/// these vertices. A blocked cell is not marked. The coordinates of both stand above the map.
#[must_use]
pub fn describe(grid: &Grid, rules: Rules, start: Vertex, goal: Vertex, seed: u64) -> String {
    let mut text = format!("seed {seed}; rules: {rules}; from {start} to {goal}; the map:\n");
    for y in 0..grid.height() as i32 {
        for x in 0..grid.width() as i32 {
            let at = Vertex::new(x, y);
            text.push(match () {
                () if grid.is_blocked(x, y) => '#',
                () if at == start => 's',
                () if at == goal => 'g',
                () => '.',
            });
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::count;

    #[test]
    fn a_suite_is_as_long_as_asked_or_so_many_times_as_long() {
        assert_eq!((count("120", 40), count("3x", 40), count("0x", 40)), (Some(120), Some(120), Some(0)));
        for text in ["", "x", "1.5x", "-1", "3 x", "99999999999999999999x", "18446744073709551615x"] {
            assert_eq!(count(text, 40), None, "{text}");
        }
    }
}
