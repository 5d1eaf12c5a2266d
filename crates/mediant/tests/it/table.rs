//! Tables of distances are the lengths of single paths.

use mediant::{Engine, Error, ErrorCode, K, Map, Motion, Query, Setup};
use mediant_grid::{Rules, Vertex};
use mediant_oracle::{Rng, random_grid};

use super::{NEVER, OPEN};

fn check(k: K, rules: Rules, seed: u64) {
    let rng = &mut Rng::new(seed);
    let map = Map::from(random_grid(seed).0);
    for setup in Setup::all(Motion::new(k, rules)) {
        let space = setup.space(&map).expect("a setup of the suite");
        let index = setup.prepare(&space).expect("a setup of the suite");
        let free: Vec<Vertex> = (0..=map.height() as i32)
            .flat_map(|y| (0..=map.width() as i32).map(move |x| Vertex::new(x, y)))
            .filter(|&at| space.is_free(at))
            .collect();
        if free.is_empty() {
            return;
        }
        let mut some = |count| -> Vec<Vertex> {
            (0..count).map(|_| free[rng.below(free.len() as u32) as usize]).collect()
        };
        let (starts, goals) = (some(3), some(4));
        let table = match index.table(starts.iter().copied(), goals.iter().copied()) {
            // CHPA* as published may fail, then for single paths, too.
            Err(error) => {
                assert_eq!(error.code(), ErrorCode::GaveUp, "{setup}, seed {seed}");
                continue;
            }
            Ok(table) => table,
        };
        let mut planner = index.planner();
        for (row, &start) in starts.iter().enumerate() {
            assert_eq!(table.row(row).len(), goals.len());
            for (column, &goal) in goals.iter().enumerate() {
                let cost = planner.find(Query::new(start, goal)).expect("free ends").cost();
                let expected = cost.unwrap_or(f64::INFINITY);
                let found = table.get(row, column).expect("a cell of the table");
                // Hub labels round lengths otherwise than paths.
                let is_same = found == expected || (found - expected).abs() < 1e-9 * expected;
                assert!(is_same, "{setup}, seed {seed}: {start} to {goal}: {found}, {expected}");
            }
        }
        assert_eq!((table.get(0, 4), table.get(3, 0), table.row(3).len()), (None, None, 0));
    }
}

#[test]
fn tables_are_single_paths() {
    for seed in 0..6 {
        check(K::N8, NEVER, seed);
        check(K::N16, OPEN, seed);
        check(K::ANY, OPEN, seed);
    }
}

#[test]
fn bad_ends_and_no_ends() {
    let map = Map::from_rows(["..#"]).expect("a map");
    let index = map.space(Motion::centers(K::N8)).and_then(|space| space.prepare(Engine::AStar)).expect("A*");
    let code = |starts: &[(i32, i32)], goals: &[(i32, i32)]| {
        index.table(starts.iter().copied(), goals.iter().copied()).map_err(|error: Error| error.code())
    };
    assert_eq!(code(&[(0, 0), (2, 0)], &[]), Err(ErrorCode::StartBlocked));
    assert_eq!(code(&[], &[(0, 0), (3, 0)]), Err(ErrorCode::GoalOutside));
    let [nothing, no_goals] = [code(&[], &[(0, 0)]), code(&[(0, 0)], &[])].map(|table| table.expect("free"));
    assert_eq!((nothing.values(), no_goals.values(), no_goals.row(0)), (&[][..], &[][..], &[][..]));
}
