//! The engine for a map that changes.
//!
//! The numbers are those of the study `docs/results/changes.md`, which `cargo xtask compare --changes` makes.
//! A test of `mediant-bench` holds the choice beside the best engine of each map, motion and number of paths.

use mediant_grid::{DiagonalGap, PlacementKind, Rules, Vertex, sight::line_of_sight_under};
use mediant_moves::K;

use crate::{choice::Choice, engine::Engine, map::Map, motion::Motion, setup::Setup};

/// On a map of more cells a search takes so long that preparing pays sooner: JPS+ from the first path on
/// (rooms of 2048 × 2048 cells: block-based JPS took 1.5 times as long), and labels from 41.
const MOST_CELLS_OF_SMALL: u64 = 1 << 20;

/// From so many convex corners a cell on a map is noise: 0.41 where 20 % of the cells are blocked. In rooms
/// and on maps of games and cities it was 0.006 to 0.023. In noise no jump is long.
const CORNERS_OF_NOISE: f64 = 0.1;

/// From so large a share of free lines on, obstacles stand alone on a map of at most so many cells. It was
/// 0.64 and 0.75 there, and 0.52 at most in caves, in rooms and in noise. Paths are so direct that what takes
/// longer to repair pays later. On larger maps (Cauldron: 0.72) they are long all the same.
const FREE_LINES_OF_ALONE: f64 = 0.6;
const MOST_CELLS_OF_ALONE: u64 = 1 << 19;

/// Up to so many paths between two edits, between centers, block-based JPS. JPS+ takes longer to repair and
/// less to search: it was as fast at 1 to 12 paths on most maps, where obstacles stand alone at 30 to 270.
const MOST_PATHS_OF_BLOCKS: u64 = 3;

/// The same between corners: 1 to 48 paths, and 176.
const MOST_PATHS_OF_BLOCKS_AT_CORNERS: u64 = 30;

/// Up to so many paths between two edits JPS+ (in noise block-based JPS): labels made anew after every 40
/// edits were as fast at 41 to 530 paths on most maps, where obstacles stand alone later.
const MOST_PATHS_WITHOUT_LABELS: u64 = 300;

/// The same at k = 2, where labels take half the time to make: 30 to 150.
const MOST_PATHS_WITHOUT_LABELS_AT_K_2: u64 = 80;

/// The same where obstacles stand alone.
const MOST_PATHS_WITHOUT_LABELS_ALONE: u64 = 3_000;

/// The same for Anya: 15 to 70 paths. And for JPS+ on large maps: 41.
const MOST_PATHS_OF_ANYA: u64 = 30;

/// The same where obstacles stand alone: 150 to 330.
const MOST_PATHS_OF_ANYA_ALONE: u64 = 200;

/// The places of a map that are looked at.
const SAMPLE: u32 = 4_096;

impl Choice {
    /// For a map that changes, with so many paths between two edits.
    pub(crate) fn for_changing_map(motion: Motion, map: &Map, paths: u64) -> Self {
        let cells = u64::from(map.width()) * u64::from(map.height());
        let is_large = cells > MOST_CELLS_OF_SMALL;
        let Look { corners, free_lines } = Look::at(map);
        let is_noise = corners > CORNERS_OF_NOISE;
        let is_alone = free_lines > FREE_LINES_OF_ALONE && !is_noise && cells <= MOST_CELLS_OF_ALONE;
        let (without_labels, anya) = match (is_alone, motion.k) {
            (true, _) => (MOST_PATHS_WITHOUT_LABELS_ALONE, MOST_PATHS_OF_ANYA_ALONE),
            (false, K::N4) => (MOST_PATHS_WITHOUT_LABELS_AT_K_2, MOST_PATHS_OF_ANYA),
            (false, _) => (MOST_PATHS_WITHOUT_LABELS, MOST_PATHS_OF_ANYA),
        };
        let at_corners = motion.rules.placement() == PlacementKind::Corner;
        let choice = |engine, why| Self { engine, why };
        let canonical = choice(Engine::Canonical, "it follows an edit at once, and jumps are short in noise");
        match motion.k.finite().map(|k| k.get()) {
            Some(2 | 3) if is_noise && at_corners => canonical,
            Some(2 | 3) if is_noise && paths <= MOST_PATHS_WITHOUT_LABELS => Self::for_some_paths(motion),
            Some(4 | 5) if is_noise && at_corners && !is_large => {
                choice(Engine::Jps, "it follows an edit at once, and Anya is slow in noise")
            }
            Some(2 | 3) => {
                let (blocks, lists) = match (is_large, at_corners || is_alone) {
                    (true, _) => (0, MOST_PATHS_OF_ANYA),
                    (false, true) => (MOST_PATHS_OF_BLOCKS_AT_CORNERS, without_labels),
                    (false, false) => (MOST_PATHS_OF_BLOCKS, without_labels),
                };
                let has_lists = Setup::new(Engine::JpsPlus, motion).check().is_ok();
                match paths {
                    _ if paths > lists => Self::for_many_paths(motion, map),
                    _ if paths > blocks && has_lists => {
                        choice(Engine::JpsPlus, "its jumps are kept, and follow an edit")
                    }
                    _ => Self::for_some_paths(motion),
                }
            }
            Some(_) if !at_corners && is_noise => canonical,
            Some(_) if !at_corners => Self::for_many_paths(motion, map),
            _ if paths <= anya || is_noise && !is_large => {
                choice(Engine::Anya, "what it prepares follows an edit at once")
            }
            _ => Self::for_many_paths(motion, map),
        }
    }
}

/// A map, as a sample of places all over it shows it.
struct Look {
    /// The convex corners of blocked cells, by the cells of the map.
    corners: f64,
    /// Of the free cells, those from which a straight line to 16 columns and 5 rows beyond is free.
    free_lines: f64,
}

impl Look {
    fn at(map: &Map) -> Self {
        let (width, height) = (u64::from(map.width()), u64::from(map.height()));
        // Multiples of two irrational numbers spread evenly: 2^32 / 1.3247… and 2^32 / 1.3247…².
        let spread = |at: u32, step: u32, side: u64| ((u64::from(at.wrapping_mul(step)) * side) >> 32) as i32;
        let places = (0..SAMPLE)
            .map(|at| Vertex::new(spread(at, 3_242_174_889, width), spread(at, 2_447_445_414, height)));
        let (mut corners, mut free, mut lines) = (0, 0, 0);
        for at @ Vertex { x, y } in places {
            let around = [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)];
            corners += u32::from(around.into_iter().filter(|&cell| map.is_blocked(cell)).count() == 1);
            if map.is_free(at) {
                let open = Rules::Corner(DiagonalGap::Open);
                free += 1;
                lines += u32::from(line_of_sight_under(map.grid(), open, at, Vertex::new(x + 16, y + 5)));
            }
        }
        let share = |part: u32, all: u32| f64::from(part) / f64::from(all.max(1));
        Self { corners: share(corners, SAMPLE), free_lines: share(lines, free) }
    }
}
