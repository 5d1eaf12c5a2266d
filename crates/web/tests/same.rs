//! The same paths and counts on every platform: one function over all setups and the maps of the shared
//! suite, and one table of digests. `cargo test` checks it natively, and under node in WebAssembly.
//!
//! A change of an engine that changes its paths or its counts changes the table: the failure prints the new
//! one.

use mediant::{
    Answer, CornerRule, DiagonalGap, Engine, FiniteK, K, Map, Motion, Query, Rules, Setup, errors::QueryError,
};
use mediant_oracle::{Rng, caves, maze, noise, random_free_vertex, random_weighted, rooms, suite_grid};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test;

/// The seeds of the maps.
const SEEDS: std::ops::Range<u64> = 0..20;
/// The neighborhoods and the rules, of which each map has one pair.
const KS: [K; 4] = [K::N4, K::N8, K::N16, K::ANY];
const RULES: [Rules; 5] = [
    Rules::Center(CornerRule::Never),
    Rules::Corner(DiagonalGap::Open),
    Rules::Corner(DiagonalGap::Closed),
    Rules::Center(CornerRule::One),
    Rules::Center(CornerRule::Always),
];
/// The queries on each map with each setup.
const QUERIES: usize = 2;

/// A digest of what an engine answered, and of how many queries.
type Row = (&'static str, u64, u64);

/// The digests that every platform finds.
const EXPECTED: [Row; 16] = [
    ("astar", 0x3d56_eb4b_53f4_3c19, 168),
    ("dijkstra", 0x4dbe_ae31_28fa_7f5b, 28),
    ("wavefront", 0x2679_c4ef_36ad_8486, 28),
    ("canonical", 0x1ff7_3243_612b_300a, 112),
    ("jps", 0x216b_197d_19e9_576c, 140),
    ("jps-block", 0xba80_bacd_a4de_10a2, 90),
    ("jps-plus", 0x563b_b9b2_7057_0de7, 72),
    ("theta", 0x3880_030b_93ba_717a, 112),
    ("lazy-theta", 0xcfda_da1f_f9dd_07cb, 84),
    ("anya", 0xcbcb_e940_8aa3_ec10, 28),
    ("subgoal", 0xc9b0_cbd7_1e85_055a, 198),
    ("subgoal-theta", 0xd632_2226_40f1_a03e, 40),
    ("hpa", 0x1f2e_ab71_0e82_1128, 72),
    ("chpa", 0x3eab_8a9f_86f9_3910, 88),
    ("landmarks", 0xc518_b47f_154e_e151, 56),
    ("costs", 0x4ad9_eb9f_9f82_55f9, 114),
];

/// The map of a seed: of the suite, or every fourth time a larger one.
fn map(seed: u64) -> Map {
    let rng = &mut Rng::new(seed);
    let (width, height) = (70, 50);
    let grid = match seed % 16 {
        3 => noise(rng, width, height, 25),
        7 => rooms(rng, width, height),
        11 => maze(rng, width, height),
        15 => caves(rng, width, height),
        _ => suite_grid(seed).0,
    };
    grid.into()
}

/// FNV-1a of 64 bits.
struct Digest(u64);

impl Digest {
    fn add(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

/// Adds what a setup answers on a map to the digest of its engine.
fn answer(setup: Setup, map: &Map, seed: u64, (digest, asked): (&mut Digest, &mut u64)) {
    let Ok(mut planner) = setup.planner(map) else { return };
    let mut rng = Rng::new(seed);
    let mut free = || random_free_vertex(&mut rng, map.grid(), setup.rules().placement());
    for _ in 0..QUERIES {
        let (Some(start), Some(goal)) = (free(), free()) else { return };
        digest.add(format!("{setup} {seed} {start} {goal}").as_bytes());
        match planner.find_counted(Query::new(start, goal)) {
            Ok((Answer::Found(path), counters)) => {
                let points = path.waypoints().iter().flat_map(|at| [at.x, at.y]);
                points.for_each(|number| digest.add(&number.to_le_bytes()));
                digest.add(&path.cost().to_bits().to_le_bytes());
                digest.add(format!("{counters:?}").as_bytes());
            }
            // Its text may be worded better; what became of the query stays.
            Err(QueryError::GaveUp { why }) => {
                digest.add(format!("Err(GaveUp {{ why: {why:?} }})").as_bytes());
            }
            other => digest.add(format!("{other:?}").as_bytes()),
        }
        *asked += 1;
    }
}

/// The table as it is on this platform.
fn table() -> Vec<Row> {
    let mut rows: Vec<_> =
        Engine::ALL.iter().map(|engine| (*engine, Digest(0xcbf2_9ce4_8422_2325), 0)).collect();
    for seed in SEEDS {
        let map = map(seed);
        // 4 and 5 have no common divisor, so that each k meets each rule.
        let (k, rules) = (KS[seed as usize % KS.len()], RULES[seed as usize % RULES.len()]);
        for setup in Setup::all(Motion::new(k, rules)) {
            let engine = setup.engine.kind();
            if let Some((_, digest, asked)) = rows.iter_mut().find(|(of, ..)| *of == engine) {
                answer(setup, &map, seed, (digest, asked));
            }
        }
    }
    let rows = rows.into_iter().map(|(engine, digest, asked)| (engine.name(), digest.0, asked));
    rows.chain([on_costs()]).collect()
}

/// The paths, counts and fields on random costs of cells, for each k.
fn on_costs() -> Row {
    let (mut digest, mut asked) = (Digest(0xcbf2_9ce4_8422_2325), 0);
    for seed in SEEDS {
        let (costs, _) = random_weighted(seed);
        let (x, y) = costs.cell_size();
        let map = Map::from(costs.grid().clone());
        let rules = RULES[seed as usize % RULES.len()];
        let space = map
            .costs(costs.weights().iter().copied())
            .and_then(|costs| costs.with_cell_size(x, y))
            .and_then(|costs| costs.space(Motion::new(FiniteK::new(2 + seed as u32 % 7)?, rules)));
        let space = space.unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        let mut rng = Rng::new(seed);
        let mut vertex = || random_free_vertex(&mut rng, map.grid(), rules.placement());
        for engine in [Engine::AStar, Engine::Landmarks, Engine::LazyTheta] {
            let mut planner = space.planner(engine).unwrap_or_else(|error| panic!("seed {seed}: {error}"));
            for _ in 0..QUERIES {
                let (Some(start), Some(goal)) = (vertex(), vertex()) else { continue };
                let found = planner.find_counted((start, goal));
                digest.add(format!("{engine} {seed} {start} {goal} {found:?}").as_bytes());
                asked += 1;
            }
        }
        if let Some(field) = vertex().and_then(|source| space.field([source]).ok()) {
            field.lengths().iter().for_each(|cost| digest.add(&cost.to_bits().to_le_bytes()));
        }
    }
    ("costs", digest.0, asked)
}

#[cfg_attr(target_arch = "wasm32", wasm_bindgen_test)]
#[cfg_attr(not(target_arch = "wasm32"), test)]
fn the_same_paths_and_counts_on_every_platform() {
    let found = table();
    let lines: String = found
        .iter()
        .map(|(name, digest, asked)| format!("    (\"{name}\", {digest:#018x}, {asked}),\n"))
        .collect();
    assert!(
        found == EXPECTED,
        "the paths or the counts differ from those that are written here; found:\n{lines}"
    );
}
