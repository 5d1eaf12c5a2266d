//! The engine for a map that changes.
//!
//! The numbers are those of the study `docs/results/changes.md`, which `cargo xtask compare --changes` makes.
//! A test of `mediant-bench` holds the choice beside the best engine of each map, motion and number of paths.

use mediant_grid::PlacementKind;

use crate::{choice::Choice, engine::Engine, map::Map, motion::Motion, setup::Setup};

/// On a map of more cells a search takes so long that preparing pays sooner: JPS+ from the first path on
/// (rooms of 2048 × 2048 cells: block-based JPS took 1.5 times as long), and labels from 41.
const MOST_CELLS_OF_SMALL: u64 = 1 << 20;

/// From so many convex corners a cell on a map is noise: 0.41 where 20 % of the cells are blocked. In rooms
/// and on maps of games and cities it was 0.006 to 0.023. In noise no jump is long.
const CORNERS_OF_NOISE: f64 = 0.1;

/// Up to so many paths between two edits, between centers, block-based JPS. JPS+ takes longer to repair and
/// less to search: it was as fast at 1 to 12 paths on most maps, where obstacles stand alone at 30 to 270.
const MOST_PATHS_OF_BLOCKS: u64 = 3;

/// The same between corners: 1 to 48 paths, and 176.
const MOST_PATHS_OF_BLOCKS_AT_CORNERS: u64 = 30;

/// Up to so many paths between two edits JPS+ (in noise canonical A\*): labels made anew after every 40 edits
/// were as fast at 41 to 530 paths on most maps, where obstacles stand alone later.
const MOST_PATHS_WITHOUT_LABELS: u64 = 300;

/// The same for Anya: 15 to 235 paths. And for JPS+ on large maps: 41.
const MOST_PATHS_OF_ANYA: u64 = 30;

/// The places that are looked at for corners.
const SAMPLE: u32 = 4_096;

impl Choice {
    /// For a map that changes, with so many paths between two edits.
    pub(crate) fn for_changing_map(motion: Motion, map: &Map, paths: u64) -> Self {
        let cells = u64::from(map.width()) * u64::from(map.height());
        let (is_large, is_noise) = (cells > MOST_CELLS_OF_SMALL, corners(map) > CORNERS_OF_NOISE);
        let at_corners = motion.rules.placement() == PlacementKind::Corner;
        let choice = |engine, why| Self { engine, why };
        let canonical = choice(Engine::Canonical, "it follows an edit at once, and jumps are short in noise");
        match motion.k.finite().map(|k| k.get()) {
            Some(2 | 3) if is_noise && (at_corners || paths <= MOST_PATHS_WITHOUT_LABELS) => canonical,
            Some(4 | 5) if is_noise && at_corners && !is_large => {
                choice(Engine::Jps, "it follows an edit at once, and Anya is slow in noise")
            }
            Some(2 | 3) => {
                let (blocks, lists) = match (is_large, at_corners) {
                    (true, _) => (0, MOST_PATHS_OF_ANYA),
                    (false, true) => (MOST_PATHS_OF_BLOCKS_AT_CORNERS, MOST_PATHS_WITHOUT_LABELS),
                    (false, false) => (MOST_PATHS_OF_BLOCKS, MOST_PATHS_WITHOUT_LABELS),
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
            _ if paths <= MOST_PATHS_OF_ANYA || is_noise && !is_large => {
                choice(Engine::Anya, "what it prepares follows an edit at once")
            }
            _ => Self::for_many_paths(motion, map),
        }
    }
}

/// The convex corners of blocked cells by the cells of a map, from a sample of places all over it.
fn corners(map: &Map) -> f64 {
    let (width, height) = (u64::from(map.width()), u64::from(map.height()));
    // Multiples of two irrational numbers spread evenly: 2^32 / 1.3247… and 2^32 / 1.3247…².
    let spread = |at: u32, step: u32, side: u64| ((u64::from(at.wrapping_mul(step)) * side) >> 32) as i32;
    let is_corner = |at: &u32| {
        let (x, y) = (spread(*at, 3_242_174_889, width), spread(*at, 2_447_445_414, height));
        let around = [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)];
        around.into_iter().filter(|&cell| map.is_blocked(cell)).count() == 1
    };
    (0..SAMPLE).filter(is_corner).count() as f64 / f64::from(SAMPLE)
}
