//! Bad costs, and what there is not on costs of cells.

use mediant::{
    Change, Engine, Error, ErrorCode, Exceptions, K, Limits, Map, Motion, Query, Smoothing,
    errors::{QueryError, SetupError},
    options::{ConfiguredEngine, GuidedOptions, HeuristicName},
};

use super::{costs, plain_space, space};

#[test]
fn bad_costs_are_errors_that_say_what_to_do() {
    let map = Map::from_rows(["..", ".#"]).expect("a map");
    let code = |costs: [f64; 4]| map.costs(costs).map_err(|error| (error.code(), error.to_string()));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let (code, text) = code([1.0, bad, 1.0, 1.0]).expect_err("no cost");
        assert!(code == ErrorCode::Cost && text.contains("(1, 0)") && text.contains("blocked"), "{text}");
        // Costs of blocked cells are not looked at.
        assert!(map.costs([1.0, 1.0, 1.0, bad]).is_ok());
        let error = costs().edit_cells([((0, 0), Some(bad))]).expect_err("no cost");
        assert_eq!(error.code(), ErrorCode::Cost, "{error}");
    }
    for wrong in [vec![1_u8; 3], vec![1; 5], Vec::new()] {
        let error = map.costs(wrong).expect_err("another number");
        assert!(error.code() == ErrorCode::Cost && error.to_string().contains("4 cells"), "{error}");
    }
    assert_eq!(code([1e-9, 1.0, 1.5, 1.0]).expect_err("too far apart").0, ErrorCode::Cost);
    assert_eq!(costs().with_cell_size(0.0, 1.0).unwrap_err().code(), ErrorCode::Number);
    assert_eq!(costs().edit_cells([((4, 0), None)]).unwrap_err().code(), ErrorCode::EditOutside);
    let shut = Map::from_rows(["##"]).expect("a map").costs([0, 0]).expect("nothing is looked at");
    let error = shut.space(3).expect("k = 3").path((0, 0), (1, 0)).unwrap_err();
    assert_eq!(error.code(), ErrorCode::StartBlocked);
    let stop = Limits::new().deadline(|| true);
    let Err(error) = map.within(&stop).costs([1; 4]) else { panic!("out of time") };
    assert_eq!(error.code(), ErrorCode::Stopped);
    assert_eq!(space().within(&stop).field([(0, 0)]).unwrap_err().code(), ErrorCode::Stopped);
    assert!(costs().within(Limits::new()).space(3).is_ok());
}

#[test]
fn what_there_is_not_on_costs_is_refused() {
    let (costs, space) = (costs(), space());
    for motion in [Motion::corners(K::ANY), Motion::centers(9), Motion::corners(12), Motion::centers(K::ANY)]
    {
        let error = costs.space(motion).expect_err("too many");
        assert!(matches!(error, Error::Setup(SetupError::CostsK { max: 8, .. })), "{error}");
        assert_eq!(error.code(), ErrorCode::Motion);
    }
    assert_eq!(costs.space(-1).unwrap_err().code(), ErrorCode::K);
    let known = [Engine::AStar, Engine::Dijkstra, Engine::Theta, Engine::LazyTheta, Engine::Landmarks];
    for engine in Engine::ALL.into_iter().filter(|engine| !known.contains(engine)) {
        for motion in [Motion::centers(3), Motion::corners(5)] {
            let error = costs.space(motion).expect("a small k").prepare(engine).expect_err("no costs");
            assert!(matches!(error, Error::Setup(SetupError::Costs { .. })), "{error}");
            assert!(error.to_string().contains("astar, dijkstra, theta, lazy-theta, landmarks"), "{error}");
        }
        assert!(space.make_ready(engine).is_err() && space.distances(engine, (0, 0)).is_err());
    }
    assert!(space.make_ready(Engine::AStar).is_ok());
    let with = |heuristic| {
        let own = GuidedOptions { heuristic: Some(heuristic) };
        let theta = space.planner(ConfiguredEngine::Theta(own)).map(|_| ());
        let a_star = space.planner(ConfiguredEngine::AStar(own)).map(|_| ());
        assert_eq!(theta.is_ok(), a_star.is_ok());
        a_star
    };
    for (heuristic, is_known) in [
        (HeuristicName::Hk, true),
        (HeuristicName::Zero, true),
        (HeuristicName::Euclidean, false),
        (HeuristicName::SquaredEuclidean, false),
    ] {
        assert_eq!(with(heuristic).is_ok(), is_known, "{heuristic}");
    }
    let code = |error: Error| (error.code(), error.to_string().starts_with("on costs of cells there is no"));
    let refused = (ErrorCode::EngineWithout, true);
    let index = space.prepare(Engine::AStar).expect("it knows costs");
    let unsaved = index.to_bytes().unwrap_err();
    assert_eq!((unsaved.code(), &*unsaved.to_string()), (refused.0, "astar has no index: choose landmarks"));
    assert_eq!(code(index.planner().find_except([(0, 0), (2, 0)], &Exceptions::new()).unwrap_err()), refused);
    assert_eq!(code(space.widest_path((0, 0), (2, 0), 0.5).unwrap_err()), refused);
    let smoothed = index.clone().with_smoothing(Some(Smoothing::Taut));
    assert_eq!(code(smoothed.try_planner().unwrap_err()), refused);
    let mut planner = smoothed.planner();
    assert_eq!(planner.find([(0, 0), (2, 0)]), Err(QueryError::Smoothing));
    assert_eq!(planner.distance([(0, 0), (2, 0)]), Err(QueryError::Smoothing));
    assert_eq!(planner.begin(Query::new((0, 0), (2, 0)).nearest()), Err(QueryError::Smoothing));
    assert_eq!(planner.find_counted([(0, 0), (2, 0)]).unwrap_err(), QueryError::Smoothing);
    // The index belongs to the costs alone.
    let plain = plain_space();
    assert!(index.repair(&Change::new(&plain)).is_err());
    let other = index.for_k(K::N16).expect("k = 4");
    assert_eq!(other.space().costs(), Some(&costs));
    assert!(index.for_k(K::ANY).is_err());
    let goals = plain.prepare(Engine::AStar).and_then(|index| index.goals([(0, 0)])).expect("free");
    assert_eq!(index.planner().distances((0, 0), &goals).unwrap_err().code(), ErrorCode::Mismatch);
}
