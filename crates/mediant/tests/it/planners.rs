//! Planners that threads share answer as one planner does.

use mediant::{
    Answer, Ends, Engine, K, Map, Motion, Planners, Setup, errors::QueryError, search::BatchProgress,
};
use mediant_grid::{Rules, Vertex};
use mediant_oracle::{Rng, random_grid};

use super::{NEVER, OPEN};

/// Queries from anywhere to anywhere, off the map and on blocked cells too.
fn queries(map: &Map, count: usize, rng: &mut Rng) -> Vec<Ends> {
    let (width, height) = (map.width() + 2, map.height() + 2);
    let mut any = || Vertex::new(rng.below(width) as i32 - 1, rng.below(height) as i32 - 1);
    (0..count).map(|_| Ends::new(any(), any())).collect()
}

fn check(k: K, rules: Rules, seed: u64) {
    let map = Map::from(random_grid(seed).0);
    let queries = queries(&map, 40, &mut Rng::new(seed));
    for setup in Setup::all(Motion::new(k, rules)) {
        let index = setup.space(&map).and_then(|space| setup.prepare(&space)).expect("a setup of the suite");
        let mut planner = index.planner();
        let expected: Vec<_> = queries.iter().map(|&query| planner.find(query)).collect();
        let planners = Planners::new(index);
        assert_eq!(planners.find_all(&queries), expected, "{setup}, seed {seed}");
        let threads = 3;
        std::thread::scope(|scope| {
            for _ in 0..threads {
                scope.spawn(|| {
                    for (&query, expected) in queries.iter().zip(&expected) {
                        assert_eq!(&planners.find(query), expected, "{setup}, seed {seed}");
                    }
                });
            }
        });
    }
}

#[test]
fn answers_of_shared_planners_are_those_of_one() {
    for seed in 0..4 {
        check(K::N8, NEVER, seed);
        check(K::N16, OPEN, seed);
        check(K::ANY, OPEN, seed);
    }
}

fn planners() -> (Planners, Vec<Ends>) {
    let map = Map::from_fn(40, 30, |x, y| x % 7 == 3 && y % 5 != 2).expect("a map");
    let index = map.space(Motion::centers(K::N8)).and_then(|space| space.prepare(Engine::Subgoal));
    (Planners::new(index.expect("subgoals")), queries(&map, 2 * Planners::CHUNK + 17, &mut Rng::new(5)))
}

#[test]
fn chunks_come_in_order() {
    let (planners, queries) = planners();
    let add = |chunk: &mut Vec<_>, answer| chunk.push(answer);
    let progress = BatchProgress::default();
    let chunks = planners.find_in_chunks(queries.len(), |index| queries[index], &progress, add);
    assert_eq!(chunks.iter().map(Vec::len).collect::<Vec<_>>(), [Planners::CHUNK, Planners::CHUNK, 17]);
    assert_eq!(chunks.concat(), planners.find_all(&queries));
    assert_eq!((progress.done(), planners.find_all::<Ends>(&[])), (queries.len(), Vec::new()));
}

#[test]
fn a_cancelled_batch_stops() {
    let (planners, queries) = planners();
    let progress = BatchProgress::default();
    let add = |count: &mut usize, _: Result<Answer, QueryError>| {
        *count += 1;
        progress.cancel();
    };
    let chunks = planners.find_in_chunks(queries.len(), |index| queries[index], &progress, add);
    // Each chunk that had begun answers one query.
    assert!(progress.is_cancelled() && chunks.iter().all(|&count| count <= 1));
    assert_eq!(progress.done(), chunks.iter().sum::<usize>());
    assert!(progress.done() > 0);
}
