//! Ends anywhere: points between vertices against the oracle of points, on seeded random maps.

use std::sync::Arc;

use mediant_grid::{Change, Corners, DiagonalGap, FreeSpace, Grid, GridGraph, Obstruction, Point, Vertex};
use mediant_moves::FiniteK;
use mediant_oracle::{
    PointKind, PointVisibility, Rng, describe_points, point_is_free, random_change, random_free_point,
    random_point, seeds, segment_between_points_is_legal, suite_grid, validate_between_points,
};
use mediant_search::{
    Answer, AnyAngleField, AnyAngleFields, Anya, End, FieldError, FieldQuery, Fields, Planner, PointEnds,
    QueryError,
};

const GAPS: [DiagonalGap; 2] = [DiagonalGap::Open, DiagonalGap::Closed];

fn point((x, y): (i64, i64)) -> Point {
    Point::from_parts(x, y)
}

/// Points of every kind, some of them blocked or outside the map.
fn points(rng: &mut Rng, grid: &Grid) -> Vec<(i64, i64)> {
    PointKind::ALL.into_iter().map(|kind| random_point(rng, grid, kind)).collect()
}

fn for_each_map(maps: u64, mut check: impl FnMut(&Arc<Grid>, DiagonalGap, u64, &mut Rng)) {
    for seed in seeds(maps) {
        let grid = Arc::new(suite_grid(seed).0);
        for gap in GAPS {
            check(&grid, gap, seed, &mut Rng::new(seed));
        }
    }
}

#[test]
fn points_are_free_and_see_each_other_as_the_oracle_says() {
    let mut counts = [0; 2];
    for_each_map(300, |grid, gap, seed, rng| {
        let space = FreeSpace::<Corners>::new(Arc::clone(grid), gap);
        let points = points(rng, grid);
        for &from in &points {
            assert_eq!(space.point_is_free(point(from)), point_is_free(grid, from), "{from:?}, seed {seed}");
            for &to in &points {
                let case = || describe_points(grid, gap, from, to, seed);
                let free = [from, to].iter().all(|&at| point_is_free(grid, at));
                let expected = free && segment_between_points_is_legal(grid, gap, from, to);
                assert_eq!(space.point_sees(point(from), point(to)), expected, "{}", case());
                let found = space.point_obstruction(point(from), point(to));
                assert_eq!(found.is_none(), expected, "{found:?}: {}", case());
                counts[usize::from(expected)] += 1;
                match found {
                    Some(Obstruction::Cell { x, y }) => assert!(grid.is_blocked(x, y), "{}", case()),
                    Some(Obstruction::Between { cells }) => {
                        assert!(cells.iter().all(|&(x, y)| grid.is_blocked(x, y)), "{}", case());
                    }
                    _ => {}
                }
            }
        }
    });
    assert!(counts.iter().all(|&count| count > 5_000), "{counts:?}");
}

/// Whether there is a way, and how far it is, with the dead ends of the map and without them.
#[test]
fn anya_between_points_finds_the_shortest_paths() {
    let mut answers = [0; 2];
    for_each_map(600, |grid, gap, seed, rng| {
        let space = FreeSpace::<Corners>::new(Arc::clone(grid), gap);
        let oracle = PointVisibility::new(grid, gap);
        let mut planners = [Anya::new(&space), Anya::new(&space).without_dead_ends()];
        for _ in 0..12 {
            let Some((from, to)) = random_free_point(rng, grid).zip(random_free_point(rng, grid)) else {
                break;
            };
            let case = || describe_points(grid, gap, from, to, seed);
            let expected = oracle.cost(from, to);
            let ends = PointEnds::new(point(from), point(to));
            assert_eq!(space.points_connected(ends.start, ends.goal), expected.is_some(), "{}", case());
            for anya in &mut planners {
                let answer = anya.solve_at(ends).expect("any angle").expect("both ends are free");
                match (&answer, expected) {
                    (Answer::Unreachable, None) => {}
                    (Answer::Found(path), Some(best)) => {
                        assert!((path.cost() - best).abs() <= 1e-9 * best, "{path}, best {best}; {}", case());
                        let points: Vec<_> = path.points().map(Point::parts).collect();
                        let fault = validate_between_points(grid, gap, from, to, &points, path.cost());
                        assert_eq!(fault, Ok(()), "{path}; {}", case());
                        assert_eq!(path.check(&space), Ok(()), "{path}; {}", case());
                    }
                    _ => panic!("{answer:?}, not {expected:?}; {}", case()),
                }
            }
            answers[usize::from(expected.is_some())] += 1;
        }
    });
    assert!(answers.iter().all(|&count| count > 1_000), "{answers:?}");
}

/// All vertices of corner placement.
fn vertices(grid: &Grid) -> impl Iterator<Item = Vertex> + use<> {
    let (width, height) = (grid.width() as i32, grid.height() as i32);
    (0..=height).flat_map(move |y| (0..=width).map(move |x| Vertex::new(x, y)))
}

/// Checks what a field says of a point, whose true distance is `best`. Returns whether it is in the field.
fn check_point(
    (field, space): (&AnyAngleField<&FreeSpace<Corners>>, &FreeSpace<Corners>),
    sources: &[(i64, i64)],
    at: Point,
    best: Option<f64>,
    case: &dyn Fn() -> String,
) -> bool {
    let (found, path) = (field.get(at), field.path_from(at));
    let is_close = found.zip(best).map_or(found == best, |(a, b)| (a - b).abs() <= 1e-9 * b);
    assert!(is_close, "{found:?}, not {best:?}: {at}; {}", case());
    assert_eq!(path.is_some(), found.is_some(), "{at}; {}", case());
    let Some((path, length)) = path.zip(found) else {
        assert_eq!((field.next(at), field.nearest_source(at)), (None, None), "{at}; {}", case());
        return false;
    };
    let points: Vec<_> = path.points().map(Point::parts).collect();
    let last = points.last().copied().expect("a path has a point");
    assert!(sources.contains(&last), "{path} ends at no source; {}", case());
    let fault = validate_between_points(space.grid(), space.rule(), at.parts(), last, &points, length);
    assert_eq!(fault, Ok(()), "{path}, {length}; {}", case());
    assert_eq!(field.nearest_source(at), Some(point(last)), "{path}; {}", case());
    assert_eq!(field.next(at).is_none(), points.len() == 1, "{path}; {}", case());
    let direction = field.direction(at).map_or(1.0, |(x, y)| x.hypot(y));
    assert!((direction - 1.0).abs() < 1e-12, "{path}; {}", case());
    true
}

/// From every vertex, and from points of every kind.
#[test]
fn fields_from_points_hold_the_shortest_distances() {
    let mut counts = [0; 2];
    for_each_map(60, |grid, gap, seed, rng| {
        let space = &FreeSpace::<Corners>::new(Arc::clone(grid), gap);
        let oracle = PointVisibility::new(grid, gap);
        let mut fields = AnyAngleFields::new(space);
        for count in [1, 1, 3] {
            let sources: Vec<_> = (0..count).filter_map(|_| random_free_point(rng, grid)).collect();
            let Some(&first) = sources.first() else { break };
            let from: Vec<Point> = sources.iter().copied().map(point).collect();
            let costs: Vec<_> = sources.iter().map(|&source| oracle.costs_from(source)).collect();
            let best =
                |at: Point| costs.iter().filter_map(|costs| costs.to(at.parts())).min_by(f64::total_cmp);
            let case = || format!("from {sources:?}: {}", describe_points(grid, gap, first, first, seed));
            let query = FieldQuery::from_points(&from);
            let field = fields.field(query).expect("free sources");
            let asked: Vec<Point> = (0..6).filter_map(|_| random_free_point(rng, grid)).map(point).collect();
            let kinds = points(rng, grid);
            let all = vertices(grid).map(Point::from);
            let all: Vec<Point> = all.chain(asked.clone()).chain(kinds.into_iter().map(point)).collect();
            for &at in all.iter().chain(&from) {
                let is_in = check_point((&field, space), &sources, at, best(at), &case);
                counts[usize::from(at.vertex().is_none())] += usize::from(is_in);
            }
            // Lengths that differ in the last digits are at the limit, too.
            let Some(limit) = asked.first().and_then(|&at| field.get(at)) else { continue };
            for limit in [limit, 0.7 * limit] {
                let range = fields.field(query.within(limit)).expect("free sources");
                for &at in &all {
                    let within = field.get(at).filter(|&length| length <= limit * (1.0 + 2_f64.powi(-31)));
                    assert_eq!(range.get(at), within, "{at} within {limit}; {}", case());
                }
            }
            let Some(far) = asked.iter().find_map(|at| at.vertex().filter(|&at| field.get(at).is_some()))
            else {
                continue;
            };
            let range = fields.field(query.until(&[far])).expect("free ends");
            let limit = field.get(far).unwrap_or(0.0) * (1.0 + 2_f64.powi(-31));
            for &at in &all {
                let within = field.get(at).filter(|&length| length <= limit);
                assert_eq!(range.get(at), within, "{at} up to {far}; {}", case());
            }
        }
    });
    assert!(counts.iter().all(|&count| count as u64 > 30 * seeds(60).end), "{counts:?}");
}

/// Sources that are points and vertices give the same field as vertices alone.
#[test]
fn vertices_are_points() {
    for_each_map(60, |grid, gap, seed, rng| {
        let space = &FreeSpace::<Corners>::new(Arc::clone(grid), gap);
        let sources: Vec<Vertex> = vertices(grid).filter(|&at| space.is_free(at) && rng.chance(5)).collect();
        let from: Vec<Point> = sources.iter().map(Point::from).collect();
        let [by_vertices, by_points] =
            [FieldQuery::new(&sources), FieldQuery::from_points(&from)].map(|query| {
                let field = AnyAngleFields::new(space).field(query).expect("free sources");
                assert!(field.query().all_sources().eq(from.iter().copied()));
                let next: Vec<_> = vertices(grid).map(|at| field.next(at)).collect();
                (field.lengths().to_vec(), next)
            });
        assert!(by_vertices == by_points, "seed {seed}, {gap:?}: {sources:?}");
        let graph = GridGraph::<Corners>::new(Arc::clone(grid), FiniteK::N8, gap).expect("a small k");
        let [by_vertices, by_points] =
            [FieldQuery::new(&sources), FieldQuery::from_points(&from)].map(|query| {
                let field = Fields::new(&graph).field(query).expect("free sources");
                assert_eq!(field.query().sources, sources);
                field.costs().to_vec()
            });
        assert!(by_vertices == by_points, "seed {seed}, {gap:?}: {sources:?}");
    });
}

#[test]
fn fields_over_k_take_no_points_between_vertices() {
    let grid = Arc::new(Grid::from_fn(5, 4, |x, y| (x, y) == (2, 2)).expect("a small map"));
    let graph = GridGraph::<Corners>::new(Arc::clone(&grid), FiniteK::N8, DiagonalGap::Open).expect("k = 3");
    let space = FreeSpace::<Corners>::new(grid, DiagonalGap::Open);
    let at = Point::from((0.5, 0.0));
    let sources = [Point::from((1, 0)), at];
    let query = FieldQuery::from_points(&sources);
    let expected = FieldError::Query(QueryError::Between { end: End::Start, at });
    assert_eq!(Fields::new(&graph).field(query).map(|_| ()), Err(expected));
    let mut fields = AnyAngleFields::new(&space);
    assert_eq!(fields.field(query).map(|field| field.get((0, 0))), Ok(Some(0.5)));
    for (at, is_outside) in [((2.5, 2.5), false), ((5.001, 0.0), true), ((-0.5, 0.0), true)] {
        let sources = [Point::from(at)];
        match fields.field(FieldQuery::from_points(&sources)).map(|_| ()) {
            Err(FieldError::Query(QueryError::Outside { .. })) => assert!(is_outside, "{at:?}"),
            Err(FieldError::Query(QueryError::Blocked { .. })) => assert!(!is_outside, "{at:?}"),
            other => panic!("{at:?}: {other:?}"),
        }
    }
}

/// A field from points that is kept after a change is the one made anew, at points too.
#[test]
fn fields_from_points_are_kept_where_no_path_comes_near() {
    let mut kept = 0;
    for_each_map(60, |grid, gap, seed, rng| {
        let mut space = Arc::new(FreeSpace::<Corners>::new(Arc::clone(grid), gap));
        let sources: Vec<Point> = (0..2)
            .filter_map(|_| random_free_point(rng, grid))
            .map(point)
            .take(1 + seed as usize % 2)
            .collect();
        let limit = f64::from(rng.below(20)) * 0.2;
        let query = FieldQuery::from_points(&sources).within(limit);
        let Ok(mut field) = AnyAngleFields::new(Arc::clone(&space)).field(query) else { return };
        for _ in 0..20 {
            let change: Change = random_change(rng, space.grid());
            let after = Arc::new(space.after(&change));
            let case = format!("seed {seed}, {gap:?}, {query:?}: {:?}", change.cells());
            let new = AnyAngleFields::new(Arc::clone(&after)).field(query);
            match (field.repaired(Arc::clone(&after), &change), new) {
                (Ok(repaired), Ok(new)) => {
                    if let Some(found) = repaired {
                        assert!(found.lengths() == new.lengths(), "{case}");
                        for at in points(rng, after.grid()).into_iter().map(point) {
                            assert_eq!(
                                (found.get(at), found.next(at)),
                                (new.get(at), new.next(at)),
                                "{case}"
                            );
                        }
                        kept += 1;
                    }
                    (field, space) = (new, after);
                }
                (found, new) => assert_eq!(found.err(), new.err(), "{case}"),
            }
        }
    });
    assert!(kept > seeds(60).end, "{kept}");
}

/// A change far from a point in one direction alone is far from it.
#[test]
fn a_change_in_the_columns_or_rows_of_a_point_is_not_near() {
    let grid = Arc::new(Grid::from_fn(30, 30, |_, _| false).unwrap());
    let space = Arc::new(FreeSpace::<Corners>::new(Arc::clone(&grid), DiagonalGap::Open));
    let sources = [Point::nearest(2.5, 2.5).unwrap()];
    let query = FieldQuery::from_points(&sources).within(3.0);
    let field = AnyAngleFields::new(Arc::clone(&space)).field(query).unwrap();
    for (x, y, is_kept) in [(2, 25, true), (25, 2, true), (25, 25, true), (4, 4, false)] {
        let change = Change::new(Arc::clone(&grid)).edit_cells([(x, y, true)]);
        let after = Arc::new(space.after(&change));
        let repaired = field.repaired(after, &change).unwrap();
        assert_eq!(repaired.is_some(), is_kept, "({x}, {y})");
    }
}
