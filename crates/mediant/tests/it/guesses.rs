//! First guesses of people who have read nothing: each compiles, and means what it says.

use mediant::{
    Answer, CornerRule, DiagonalGap, Ends, Engine, Error, ErrorCode, FiniteK, K, Limits, Map, Motion, Path,
    Planner, Planners, Query, Rectangle, Setup, Vertex, grid::Vector, search::IntoK,
};

/// A map with a way around its wall.
fn hall() -> Result<Map, Error> {
    "....\n.##.\n....".parse()
}

fn planner() -> Result<Planner, Error> {
    hall()?.space(Motion::default())?.planner(Engine::AStar)
}

#[track_caller]
fn check_error<T>(result: Result<T, Error>, code: ErrorCode) {
    assert_eq!(result.err().map(|error| error.code()), Some(code));
}

/// 1 to 5: a vertex is a pair or an array of whatever integers are at hand.
#[test]
fn vertices_are_pairs_of_any_integers() -> Result<(), Box<dyn std::error::Error>> {
    let map = hall()?;
    let expected = map.path(Vertex::new(0, 0), Vertex::new(3, 2))?;
    assert!(expected.is_some());
    assert_eq!(map.path((0, 0), (3, 2))?, expected);
    assert_eq!(map.path((0_i32, 0_i32), (3_i32, 2_i32))?, expected);
    assert_eq!(map.path([0, 0], [3, 2])?, expected);
    assert_eq!(map.path((0_u32, 0_u32), [3_u32, 2_u32])?, expected);
    assert_eq!(map.path((0_usize, 0_usize), [3_usize, 2_usize])?, expected);
    assert_eq!(map.path((0_i64, 0_i64), [3_i64, 2_i64])?, expected);
    assert_eq!(map.path((0_u8, 0_i16), (3_u64, 2_isize))?, expected);
    // Sizes of maps are u32, indexes usize.
    assert_eq!(map.path((0, 0), (map.width() - 1, map.height() - 1))?, expected);

    let at = Vertex::from((3, 2));
    let (pair, array): ((i32, i32), [i32; 2]) = (at.into(), at.into());
    let (sizes, indexes): ((u32, u32), (usize, usize)) = (at.try_into()?, at.try_into()?);
    assert_eq!((pair, array, sizes, indexes), ((3, 2), [3, 2], (3, 2), (3, 2)));
    assert!(<(u32, u32)>::try_from(Vertex::new(0, -1)).is_err());
    assert!(<(usize, usize)>::try_from(Vertex::new(-1, 0)).is_err());
    Ok(())
}

/// A number that is too large stays too large: by its low bits it would be a cell of the map.
#[test]
fn vertices_saturate() -> Result<(), Error> {
    let map = hall()?;
    let far: [Vertex; 9] = [
        (u32::MAX, 0).into(),
        (0, usize::MAX).into(),
        (i64::MIN, 0).into(),
        (0, i64::MAX).into(),
        (1_u64 << 32, 0).into(),
        (0, -(1_i64 << 32)).into(),
        [u64::MAX, u64::MAX].into(),
        (isize::MIN, isize::MAX).into(),
        (1_i64 << 31, 0).into(),
    ];
    for at in far {
        check_error(map.path(at, (0, 0)), ErrorCode::StartOutside);
        check_error(map.path((0, 0), at), ErrorCode::GoalOutside);
        assert!(map.is_blocked(at));
    }
    check_error(map.path((u32::MAX, u32::MAX), (0, 0)), ErrorCode::StartOutside);
    check_error(map.path((usize::MAX, 0), (0, 0)), ErrorCode::StartOutside);
    check_error(map.path((0, i64::MIN), (0, 0)), ErrorCode::StartOutside);
    Ok(())
}

/// 6 and 7: a path is walked in a loop, and has a length.
#[test]
fn paths_are_walked() -> Result<(), Error> {
    let path: Path = hall()?.path((0, 0), (3, 2))?.expect("there is a way");
    let mut seen = Vec::new();
    for waypoint in &path {
        assert!(hall()?.is_free(waypoint));
        seen.push(*waypoint);
    }
    assert_eq!((seen.as_slice(), path.len(), path.is_empty()), (path.waypoints(), seen.len(), false));
    assert_eq!((path[0], path.iter().last()), ((0, 0).into(), Some(&Vertex::new(3, 2))));
    let moves: Vec<Vector> = path.moves().collect();
    assert_eq!(moves.len(), 5);
    let mut taken = Vec::new();
    for waypoint in path {
        taken.push(waypoint);
    }
    assert_eq!(taken, seen);
    Ok(())
}

/// 8 to 11: a map is new, read from text, asked for a cell, and changed at one.
#[test]
fn maps_are_made_and_asked() -> Result<(), Error> {
    let map = Map::new(2, 2)?;
    assert!(
        map.is_free((1, 1)) && !map.is_blocked((1, 1)) && !map.is_free((2, 1)) && map.is_blocked((0, -1))
    );
    let walled = map.set((1, 0), true)?.set((0, 1), true)?.set((0, 1), false)?;
    assert_eq!(walled.to_string(), ".#\n..");
    assert_eq!(walled.to_string().parse::<Map>()?, walled);
    assert!(map.is_free((1, 0)), "a map never changes");
    for text in [".#\n..", "\n\n.#\n..\n\n", ".#\r\n..\r\n", "\r\n\r\n  .#  \r\n\t..\r\n", ".@\nGS"] {
        assert_eq!(text.parse::<Map>()?, walled, "{text:?}");
    }
    check_error(map.set((2, 0), true), ErrorCode::EditOutside);
    check_error(map.set((0, usize::MAX), true), ErrorCode::EditOutside);
    check_error(Map::new(0, 1), ErrorCode::MapSize);
    check_error(Map::new(u32::MAX, 1), ErrorCode::MapSize);
    check_error("".parse::<Map>(), ErrorCode::MapSize);
    check_error(" \n \r\n".parse::<Map>(), ErrorCode::MapSize);
    check_error("..\n\n..".parse::<Map>(), ErrorCode::MapRagged);
    check_error("..\n.".parse::<Map>(), ErrorCode::MapRagged);
    check_error("..\n.?".parse::<Map>(), ErrorCode::MapTile);
    Ok(())
}

/// 12 to 14: k is a number.
#[test]
fn k_is_a_number() -> Result<(), Error> {
    assert_eq!((K::new(5)?, K::try_from(5)?, K::try_from(5_usize)?), (K::N32, K::N32, K::N32));
    assert_eq!((K::try_from(5_u8)?, K::try_from(5_u32)?, K::try_from(5_u64)?), (K::N32, K::N32, K::N32));
    assert_eq!((Motion::centers(3), Motion::corners(4)), (Motion::centers(K::N8), Motion::corners(K::N16)));
    assert_eq!(Motion::new(3, CornerRule::One), Motion::new(FiniteK::N8, CornerRule::One));
    assert_eq!((Motion::default(), Motion::from(3), Motion::from(K::N8)), (3.into(), 3.into(), 3.into()));
    let map = hall()?;
    assert_eq!(map.space(4)?.motion(), map.space(Motion::centers(4_usize))?.motion());
    assert!(map.space(K::N16)?.path((0, 0), (3, 2))?.is_some());
    Ok(())
}

/// A bad k is refused where the motion is used, in all ways of using it.
#[test]
fn a_bad_k_is_kept_until_it_is_used() -> Result<(), Error> {
    #[track_caller]
    fn check(k: impl IntoK + Copy, code: ErrorCode, text: &str) {
        let (map, limits) = (hall().expect("a map"), Limits::new());
        let motions = [Motion::centers(k), Motion::corners(k), Motion::new(k, DiagonalGap::Closed)];
        for motion in motions {
            check_error(map.space(motion), code);
            check_error(map.within(&limits).space(motion), code);
            // The k alone is one that no engine takes.
            let error = Setup::new(Engine::AStar, motion).planner(&map).map(drop);
            check_error(error, ErrorCode::EngineK);
            let shown = map.space(motion).err().map(|error| error.to_string()).unwrap_or_default();
            assert!(shown.contains(text) && motion.to_string().ends_with(text), "{shown}; {motion}");
        }
    }
    check(0, ErrorCode::K, "k = 0");
    check(1, ErrorCode::K, "k = 1");
    check(-3, ErrorCode::K, "k = -3");
    check(i64::MIN, ErrorCode::K, "k = -9223372036854775808");
    check(99, ErrorCode::Motion, "k = 99");
    check(u64::MAX, ErrorCode::Motion, "k = 18446744073709551615");

    let map = hall()?;
    for disc in [map.for_disc(0.5, 1), map.within(Limits::new()).for_disc(0.5, 1)] {
        check_error(disc, ErrorCode::K);
    }
    check_error(map.disc(0.5, Motion::corners(0)), ErrorCode::K);
    assert_ne!(Motion::centers(0), Motion::centers(1));
    // Another k in its place counts.
    let mut motion = Motion::corners(0);
    motion.k = K::ANY;
    assert!(map.space(motion).is_ok());
    Ok(())
}

/// 15: a rectangle has a place and a size.
#[test]
fn rectangles_are_new() -> Result<(), Error> {
    let wall = Rectangle::new(1, 1, 2, 1);
    assert_eq!((wall.x, wall.y, wall.width, wall.height), (1, 1, 2, 1));
    assert_eq!([Rectangle::spanning((1, 1), (2, 1)), Rectangle::spanning((2, 1), (1, 1))], [wall; 2]);
    assert_eq!(Map::new(4, 3)?.edit(wall, |_, _| true)?, hall()?);
    let whole = Rectangle::spanning((0, 0), (u32::MAX, u32::MAX));
    assert_eq!((whole.width, whole.height), (u32::MAX, u32::MAX));
    Ok(())
}

/// 16 and 17: a planner is asked for a path, and a pair of pairs is a query.
#[test]
fn planners_take_pairs() -> Result<(), Error> {
    let mut planner = planner()?;
    let path: Option<Path> = planner.path((0, 0), (3, 2))?;
    let expected = planner.find(Query::new((0, 0), (3, 2)))?;
    assert_eq!(path.as_ref(), expected.path());
    assert_eq!(planner.find(((0, 0), (3, 2)))?, expected);
    assert_eq!(planner.find([(0, 0), (3, 2)])?, expected);
    assert_eq!(planner.find([[0_u32, 0], [3, 2]])?, expected);
    assert_eq!(planner.find(Ends::from(((0, 0), (3, 2))).nearest())?, expected);
    assert_eq!(planner.find(Query::from([(0, 0), (3, 2)]))?, expected);
    let planners = Planners::new(planner.index().clone());
    assert_eq!(planners.path((0, 0), (3, 2))?, path);
    assert_eq!(planners.find(((0, 0), (3, 2)))?, expected);
    let outside = planner.path((0, 0), (9, 9)).map_err(Error::from);
    check_error(outside, ErrorCode::GoalOutside);
    check_error(planner.path((1, 1), (0, 0)).map_err(Error::from), ErrorCode::StartBlocked);
    assert_eq!(hall()?.set((2, 0), true)?.set((2, 2), true)?.path((0, 0), (3, 0))?, None);
    Ok(())
}

/// 18 to 20: what is printed can be read.
#[test]
fn values_are_printed() -> Result<(), Error> {
    assert_eq!(hall()?.to_string(), "....\n.##.\n....");
    assert_eq!(Ends::new((0, 0), (7, 0)).to_string(), "(0, 0) → (7, 0)");
    assert_eq!(Rectangle::new(4, 1, 3, 2).to_string(), "3 × 2 cells at (4, 1)");
    let mut planner = planner()?;
    let path = planner.path((0, 0), (3, 0))?.expect("there is a way");
    assert_eq!(path.to_string(), "(0, 0) → (3, 0)");
    let mut check = |query: Query, expected: &str| {
        assert_eq!(planner.find(query).expect("a valid query").to_string(), expected);
    };
    let around = Ends::new((0, 1), (3, 1));
    check(around.into(), "found: 4 waypoints, 5.00 cells");
    check(Ends::new((0, 0), (0, 0)).into(), "found: 1 waypoint, 0.00 cells");
    check(
        around.within(Limits::new().expansions(1)),
        "stopped by its limit on expansions: 1 waypoint, 0.00 cells so far, at least 4.41",
    );
    check(
        around.within(Limits::new().cost(1.0)),
        "stopped by its limit on the cost: 1 waypoint, 0.00 cells so far, at least 3.00",
    );
    check(
        around.within(Limits::new().deadline(|| true)),
        "stopped by its timeout: 1 waypoint, 0.00 cells so far, at least 3.00",
    );
    check(Query::new((0, 0), (1, 1)).nearest(), "unreachable, the nearest is: 2 waypoints, 1.00 cells");
    assert_eq!(Answer::Unreachable.to_string(), "unreachable");
    Ok(())
}

/// `main` prints the Debug form of the first error that a newcomer makes.
#[test]
fn an_error_says_what_is_wrong_by_debug() -> Result<(), Error> {
    let error = hall()?.path((1, 1), (0, 0)).expect_err("it is blocked");
    assert_eq!(format!("{error:?}"), "start-blocked: the start (1, 1) is blocked: choose a free vertex");
    let error = planner()?.path((1, 1), (0, 0)).expect_err("it is blocked");
    assert_eq!(format!("{error:?}"), "the start (1, 1) is blocked: choose a free vertex");
    let error =
        Setup::new(Engine::Anya, Motion::new(K::N8, CornerRule::Never)).check().expect_err("at corners");
    assert_eq!(format!("{error:?}"), error.to_string());
    Ok(())
}

/// One `Planners` serves all threads of a program.
#[test]
fn planners_can_be_shared() {
    fn resource<T: Send + Sync + 'static>() {}
    resource::<Planners>();
}

/// A limit on the time is a duration. It begins anew with each query that it is given to.
#[test]
fn a_limit_can_be_a_duration() -> Result<(), Box<dyn std::error::Error>> {
    use std::time::Duration;
    let (mut planner, ends) = (planner()?, Ends::new((0, 0), (3, 2)));
    let ample = Limits::new().time(Duration::from_secs(600));
    for _ in 0..2 {
        assert!(planner.find(ends.within(&ample))?.path().is_some());
    }
    assert!(matches!(planner.find(ends.within(Limits::new().time(Duration::ZERO)))?, Answer::Stopped(_)));
    // The flag and an own deadline stay.
    let late = Limits::new().deadline(|| true).time(Duration::from_secs(600));
    assert!(matches!(planner.find(ends.within(late))?, Answer::Stopped(_)));
    let stopped = hall()?.within(Limits::new().time(Duration::ZERO)).space(Motion::default());
    check_error(stopped, ErrorCode::Stopped);
    Ok(())
}

/// All values of an enum with names.
#[test]
fn all_engines_can_be_asked_for() {
    assert!(Engine::all().eq(Engine::ALL));
    assert_eq!(CornerRule::all().map(CornerRule::name).collect::<Vec<_>>(), ["never", "one", "always"]);
}
