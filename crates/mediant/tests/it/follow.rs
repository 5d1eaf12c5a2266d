//! Planners that follow to another index answer as new ones.

use std::sync::{Arc, RwLock};

use mediant::{
    Change, Ends, Engine, Error, ErrorCode, Index, K, Map, Motion, Planner, Planners, Query, Rules, Setup,
    Smoothing, Vertex,
    errors::QueryError,
    options::{ConfiguredEngine, Levels, SubgoalOptions},
};
use mediant_oracle::{Rng, on_all_cores, random_grid, seeds};

use super::{index, levels, setup};

/// A vertex on a map or just beside it.
fn vertex(map: &Map, rng: &mut Rng) -> Vertex {
    let [x, y] = [map.width(), map.height()].map(|side| rng.below(side + 3) as i32 - 1);
    Vertex::new(x, y)
}

fn query(map: &Map, rng: &mut Rng) -> Ends {
    Ends::new(vertex(map, rng), vertex(map, rng))
}

/// The change of some cells to the other value: gaps come and go.
fn changed(index: &Index, rng: &mut Rng) -> Change {
    let map = index.space().map();
    let cells: Vec<(Vertex, bool)> = (0..1 + rng.below(12))
        .map(|_| Vertex::new(rng.below(map.width()) as i32, rng.below(map.height()) as i32))
        .map(|at| (at, !map.is_blocked(at)))
        .collect();
    index.space().edit_cells(cells).expect("cells of the map")
}

/// Asks a planner this and that, and leaves a search in the middle.
fn use_up(planner: &mut Planner, rng: &mut Rng) {
    let map = planner.index().space().map().clone();
    for _ in 0..4 {
        _ = planner.find(query(&map, rng));
    }
    _ = planner.distance(query(&map, rng));
    let goals = (0..9).map(|_| vertex(&map, rng));
    let space = planner.index().space().clone();
    let goals = planner.index().goals(goals.filter(|&at| space.is_free(at))).expect("free goals");
    _ = planner.distances(vertex(&map, rng), &goals);
    let (start, goal) = (vertex(&map, rng), vertex(&map, rng));
    if planner.begin(Query::new(start, goal).nearest().snap()).is_ok() {
        _ = planner.step(u64::from(rng.below(9)));
    }
}

/// Asserts that a planner knows nothing of a search.
fn has_not_begun(planner: &mut Planner, at: Vertex, said: &str) {
    assert_eq!(planner.step(1), Err(QueryError::NotBegun), "{said}");
    assert_eq!((planner.best(), planner.path_to(at)), (None, None), "{said}");
    assert_eq!((planner.expansions(), planner.lower_bound()), (0, 0.0), "{said}");
}

/// Compares a planner that followed with a new one. The number of searches with expansions.
fn compare(planner: &mut Planner, rng: &mut Rng, said: &str) -> usize {
    let index = planner.index().clone();
    let (new, map) = (&mut index.planner(), index.space().map().clone());
    assert_eq!((planner.guarantee(), planner.bound()), (new.guarantee(), new.bound()), "{said}");
    let mut searched = 0;
    for _ in 0..6 {
        let ends = query(&map, rng);
        let answer = new.find_counted(ends);
        assert_eq!(planner.find_counted(ends), answer, "{ends:?}, {said}");
        assert_eq!(planner.find(ends), new.find(ends), "{ends:?}, {said}");
        assert_eq!(planner.distance(ends), new.distance(ends), "{ends:?}, {said}");
        searched += usize::from(answer.is_ok_and(|(_, counters)| counters.expanded > 0));
    }
    let query = Query::between([vertex(&map, rng), vertex(&map, rng)], [vertex(&map, rng)]).nearest().snap();
    assert_eq!(planner.begin(query.clone()), new.begin(query.clone()), "{query:?}, {said}");
    for steps in [1, 3] {
        assert_eq!(planner.step(steps), new.step(steps), "{query:?}, {said}");
        assert_eq!(planner.best(), new.best(), "{query:?}, {said}");
        assert_eq!(planner.lower_bound().to_bits(), new.lower_bound().to_bits(), "{query:?}, {said}");
        for at in (0..20).map(|_| vertex(&map, rng)) {
            assert_eq!(planner.path_to(at), new.path_to(at), "{at}, {query:?}, {said}");
        }
    }
    let goals = (0..9).map(|_| vertex(&map, rng)).filter(|&at| index.space().is_free(at));
    let goals = index.goals(goals).expect("free goals");
    let start = vertex(&map, rng);
    let told = |planner: &mut Planner| (planner.distances(start, &goals), planner.nearest(start, &goals));
    assert_eq!(format!("{:?}", told(planner)), format!("{:?}", told(new)), "{start}, {said}");
    searched
}

/// To the index after an edit, to that of another map, often of another size, and back, and once more.
fn check(motion: Motion, seed: u64) -> usize {
    let rng = &mut Rng::new(seed ^ 0xF0110);
    let [map, other] = [seed, seed + 1_000].map(|seed| Map::from(random_grid(seed).0));
    let mut searched = 0;
    for setup in Setup::all(motion) {
        let [before, elsewhere] = [&map, &other].map(|map| index(setup, map).expect("a setup of the suite"));
        let edited = before.repair(&changed(&before, rng)).expect("its own change");
        let again = edited.repair(&changed(&edited, rng)).expect("its own change");
        let mut planner = before.planner();
        for (number, next) in [&edited, &elsewhere, &before, &again, &again].into_iter().enumerate() {
            let said = format!("{setup}, index {number}, seed {seed}");
            use_up(&mut planner, rng);
            planner.follow(next).unwrap_or_else(|error| panic!("{error}: {said}"));
            has_not_begun(&mut planner, vertex(&map, rng), &said);
            searched += compare(&mut planner, rng, &said);
        }
    }
    searched
}

#[test]
fn a_planner_that_followed_answers_as_a_new_one() {
    let motions = || {
        let finite =
            Rules::ALL.into_iter().flat_map(|rules| [K::N4, K::N8, K::N32].map(|k| Motion::new(k, rules)));
        finite.chain(Rules::ALL.into_iter().map(|rules| Motion::new(K::ANY, rules)))
    };
    let check = |seed: u64| {
        let motions: Vec<Motion> = motions().filter(|&motion| Setup::all(motion).next().is_some()).collect();
        check(motions[seed as usize % motions.len()], seed)
    };
    let searched: usize = on_all_cores(seeds(17), check).into_iter().sum();
    assert!(searched > 40 * seeds(17).end as usize, "only {searched} searches");
}

/// A small map with a room, for the tests below.
fn room() -> Map {
    Map::from_fn(40, 30, |x, y| x == 20 && y != 7).expect("a map")
}

/// Other options, another smoothing, and what is kept of subgoals: all as the index has it.
#[test]
fn a_planner_takes_all_from_the_index() {
    let map = room();
    let index = |text: &str| index(setup(text), &map).expect("a setup");
    let labels = index("subgoal:any:open");
    let graph = SubgoalOptions { levels: Some(Levels::Contracted), memory: None };
    let graph = labels.space().prepare(ConfiguredEngine::Subgoal(graph)).expect("a graph");
    let space = map.space(labels.setup().motion).expect("a space");
    let nothing = space.index_from_bytes(super::labels::nothing(labels.setup(), &map)).expect("an index");
    assert_eq!((labels.searched_by(), nothing.searched_by()), (Engine::Subgoal, Engine::Anya));
    assert_ne!(levels(&labels), levels(&graph));
    let one_path = labels.space().prepare_for_one_path(Engine::Anya).expect("no dead ends");
    let dead_ends = labels.space().prepare(Engine::Anya).expect("dead ends");
    let astar = index("astar:3:never");
    let others = ["astar:3:never,zero", "astar:3:never,taut", "astar:3:never,smooth"];
    let chains = [
        vec![labels, nothing.clone(), nothing, graph],
        vec![one_path.clone(), dead_ends.clone(), one_path, dead_ends],
        others.into_iter().map(index).chain([astar]).collect(),
    ];
    let rng = &mut Rng::new(9);
    for (number, chain) in chains.iter().enumerate() {
        let mut planner = chain[0].planner();
        for next in chain.iter().chain(chain.iter().rev()) {
            use_up(&mut planner, rng);
            planner.follow(next).expect("the same engine and motion");
            compare(&mut planner, rng, &format!("chain {number}, {}", next.setup()));
        }
    }
}

#[test]
fn an_index_of_another_engine_or_motion_is_refused() {
    let map = room();
    let mut planner = index(setup("astar:3:never"), &map).expect("A*").planner();
    planner.begin([(0, 0), (39, 0)]).expect("both ends are free");
    for (text, code, named) in [
        ("dijkstra:3:never", ErrorCode::EngineOption, ["astar", "dijkstra"]),
        ("astar:4:never", ErrorCode::Mismatch, ["k = 3", "k = 4"]),
        ("astar:3:one", ErrorCode::Mismatch, ["never", "one"]),
        ("astar:3:open", ErrorCode::Mismatch, ["never", "open"]),
    ] {
        let other = index(setup(text), &map).expect("a setup");
        let error = planner.follow(&other).expect_err("another setup");
        assert_eq!(error.code(), code, "{error}");
        assert!(named.iter().all(|name| error.to_string().contains(name)), "{error}");
        let mut planners = Planners::new(planner.index().clone());
        planners.make_ready();
        assert_eq!(planners.follow(&other).map_err(|error| error.code()), Err(code));
        assert!(planners.is_ready() && planners.index().setup() == planner.index().setup());
    }
    assert!(planner.finish().expect("the search that was begun").path().is_some());
}

/// The pool keeps its planners; one that is shared hands them on, and answers as before.
#[test]
fn planners_follow_and_hand_on() {
    let rng = &mut Rng::new(4);
    for setup in ["jps-block:3:never", "anya:any:open", "hpa:3:never", "subgoal:3:never,taut"].map(setup) {
        let before = index(setup, &room()).expect("a setup");
        let after = before.repair(&changed(&before, rng)).expect("its own change");
        let queries: Vec<Ends> = (0..20).map(|_| query(before.space().map(), rng)).collect();
        let [of_before, of_after] = [&before, &after].map(|index| {
            let mut planner = index.planner();
            queries.iter().map(|&query| planner.find(query)).collect::<Vec<_>>()
        });
        let mut planners = Planners::new(before.clone());
        assert_eq!(planners.find_all(&queries), of_before);
        planners.follow(&after).expect("the same setup");
        assert!(planners.is_ready());
        assert_eq!(planners.find_all(&queries), of_after);
        let old = planners.hand_on(&before).expect("the same setup");
        assert!(old.is_ready() && !planners.is_ready());
        assert_eq!((old.find_all(&queries), planners.find_all(&queries)), (of_before, of_after));
    }
}

/// Each query of a thread has the answer of the map before or of the one after.
#[test]
fn threads_ask_while_the_map_changes() {
    let before = index(setup("jps-block:3:never"), &room()).expect("a setup");
    let door = before.space().edit_cells([((20, 7), true), ((20, 8), false)]).expect("cells of the map");
    let after = before.repair(&door).expect("its own change");
    let ends = Ends::new((0, 0), (39, 29));
    let answers = [&before, &after].map(|index| index.planner().find(ends));
    assert_ne!(answers[0], answers[1]);
    let shared = RwLock::new(Arc::new(Planners::new(before.clone())));
    let now = || Arc::clone(&shared.read().expect("nobody panics"));
    std::thread::scope(|scope| {
        for _ in 0..3 {
            scope.spawn(|| (0..300).for_each(|_| assert!(answers.contains(&now().find(ends)))));
        }
        for turn in 0..100 {
            let next = now().hand_on([&after, &before][turn % 2]).expect("the same setup");
            *shared.write().expect("nobody panics") = Arc::new(next);
        }
    });
    assert_eq!(now().find(ends), answers[0]);
}

/// Goals are those of a map: a planner that followed refuses those of the map before.
#[test]
fn goals_of_the_map_before_are_refused() {
    let before = index(setup("subgoal:3:never"), &room()).expect("a setup");
    let after = before.repair(&changed(&before, &mut Rng::new(1))).expect("its own change");
    let goals = before.goals([(39, 0)]).expect("a free goal");
    let mut planner = before.planner();
    assert!(planner.distances((0, 0), &goals).is_ok());
    planner.follow(&after).expect("the same setup");
    assert!(matches!(planner.distances((0, 0), &goals), Err(Error::Mismatch(_))));
    let smoothed = after.clone().with_smoothing(Some(Smoothing::Taut));
    planner.follow(&smoothed).expect("smoothing goes with the index");
    assert_eq!(planner.guarantee(), smoothed.setup().guarantee());
}
