//! Distance fields over N(k) against Dijkstra's algorithm on the explicit graph, against each other, and
//! against single queries.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::sync::Arc;

use mediant_grid::{
    AsciiMap, Centers, CornerRule, Corners, DiagonalGap, Grid, GridGraph, Placement, Rules, Vertex,
};
use mediant_moves::{Cost, FiniteK, K};
use mediant_oracle::{Explicit, Rng, describe, random_free_vertex, seeds, suite_grid, validate};
use mediant_search::{
    AStar, CanonicalRule, End, Ends, Field, FieldError, FieldQuery, Fields, Hk, Path, Planner, Pruning,
    QueryError,
};

/// Checks a field with all its paths against the oracle. Returns the number of vertices in it.
fn check_field<P: Placement>(
    field: &Field<&GridGraph<P>>,
    oracle: &Explicit,
    sources: &[Vertex],
    case: &dyn Fn(Vertex) -> String,
) -> u64 {
    let graph = field.graph();
    let costs: Vec<_> = sources.iter().map(|&source| oracle.costs_from(source)).collect();
    let mut known = 0;
    for y in -1..=field.height() as i32 {
        for at in (-1..=field.width() as i32).map(|x| Vertex::new(x, y)) {
            let best = costs.iter().filter_map(|costs| costs.to(at)).min_by(f64::total_cmp);
            let found = field.get(at).map(Cost::to_f64);
            let is_equal = match (found, best) {
                (Some(found), Some(best)) => (found - best).abs() <= 1e-9 * best,
                (None, None) => true,
                _ => false,
            };
            assert!(is_equal, "{found:?}, not {best:?}; {}", case(at));
            known += u64::from(found.is_some());
            let path = field.path_from(at);
            assert_eq!(path.is_some(), found.is_some(), "{}", case(at));
            let Some((path, found)) = path.zip(found) else { continue };
            let last = *path.waypoints().last().unwrap();
            assert!(sources.contains(&last), "{path} ends at no source; {}", case(at));
            assert_eq!(field.nearest_source(at), Some(last));
            let k = Some(graph.k());
            let fault = validate(graph.grid(), graph.rules(), k, at, last, path.waypoints(), found);
            assert_eq!(fault, Ok(()), "{path}; {}", case(at));
            assert_eq!(field.direction(at).is_none(), found == 0.0);
            assert_eq!(field.next(at), field.direction(at).map(|v| at + v));
        }
    }
    let (all, listed) = (field.lengths().filter(|length| length.is_finite()).count(), field.iter().count());
    assert_eq!([all as u64, listed as u64], [known; 2]);
    assert!(field.iter().all(|(at, cost)| field.get(at) == Some(cost)));
    known
}

/// Some sources on a map, their fields with and without limits, and some single queries.
fn check<P: Placement>(
    grid: &Arc<Grid>,
    canonical: &Arc<CanonicalRule<P>>,
    rule: P::Rule,
    seed: u64,
) -> [u64; 2] {
    let Some(K::Finite(k)) = canonical.identity().k else { panic!("a rule has a k") };
    let graph = &GridGraph::<P>::new(Arc::clone(grid), k, rule).unwrap();
    let (rules, mut rng) = (graph.rules(), Rng::new(seed ^ 0xF1E1D));
    let oracle = Explicit::new(grid, rules, Some(k));
    let pruning = Arc::new(Pruning::with_rule(graph, Arc::clone(canonical)).unwrap());
    let (mut fields, mut astar) = (Fields::with_pruning(graph, pruning).unwrap(), AStar::new(graph, Hk));
    let mut sums = [0; 2];
    for count in [1, 3] {
        let mut free = || random_free_vertex(&mut rng, grid, P::KIND);
        let sources: Vec<Vertex> = (0..count).filter_map(|_| free()).collect();
        let (Some(&first), Some(far)) = (sources.first(), free()) else { return sums };
        let case = |at| format!("k = {k}, sources {sources:?}; {}", describe(grid, rules, first, at, seed));
        let query = FieldQuery::new(&sources);
        let field = fields.field(query).unwrap();
        assert_eq!(field.identity(), graph.identity());
        sums[0] += check_field(&field, &oracle, &sources, &case);
        let best = sources.iter().filter_map(|&source| {
            let answer = astar.solve(Ends::new(far, source)).unwrap();
            answer.into_path().map(|path| path.cost())
        });
        let (best, found) = (best.min_by(f64::total_cmp), field.path_from(far));
        let found = found.as_ref().map(Path::cost);
        let is_equal = best.zip(found).map_or(best == found, |(a, b)| (a - b).abs() <= 1e-9 * a);
        assert!(is_equal, "{found:?}, by a single query {best:?}; {}", case(far));

        // Limits: at a distance, as the field and as a path measures it, just below it, and at that of a
        // vertex where the field may end early.
        let (Some(limit), Some(length)) = (field.get(far), found) else { continue };
        sums[1] += 1;
        let at_most = Cost::from_bits(limit.to_bits() + (limit.to_bits() >> 31));
        let within = |limit: Cost| -> Vec<_> { field.iter().filter(|&(_, cost)| cost <= limit).collect() };
        let below = Cost::from_bits(limit.to_bits().saturating_sub((limit.to_bits() >> 30) + 2));
        for (query, limit) in [
            (query.within(limit.to_f64()), at_most),
            (query.within(length), at_most),
            (query.within(below.to_f64()), below),
            (query.until(&[far]), at_most),
            (query.until(&[far, first]).within(below.to_f64()), below),
        ] {
            let range = fields.field(query).unwrap();
            assert!(range.iter().eq(within(limit)), "within {limit} by {query:?}; {}", case(far));
            let again = fields.field_in(query, range.clone()).unwrap();
            assert!(again.costs() == range.costs(), "in memory that was used; {}", case(far));
        }
    }
    sums
}

/// Checks maps under one rule and k. The pruning rule takes long to prepare, so it is made once.
fn check_maps(maps: &[(Arc<Grid>, u64)], rules: Rules, k: u32) -> [u64; 2] {
    fn on<P: Placement>(maps: &[(Arc<Grid>, u64)], rule: P::Rule, k: u32) -> [u64; 2] {
        let canonical = Arc::new(CanonicalRule::new(FiniteK::new(k).unwrap(), rule));
        let sums = maps.iter().map(|(grid, seed)| check::<P>(grid, &canonical, rule, *seed));
        sums.fold([0; 2], |[a, b], [c, d]| [a + c, b + d])
    }
    match rules {
        Rules::Center(rule) => on::<Centers>(maps, rule, k),
        Rules::Corner(rule) | Rules::CenterGap(rule) => on::<Corners>(maps, rule, k),
    }
}

fn suite(seeds: impl Iterator<Item = u64>) -> Vec<(Arc<Grid>, u64)> {
    seeds.map(|seed| (Arc::new(suite_grid(seed).0), seed)).collect()
}

#[test]
fn fields_hold_the_distances_of_the_explicit_graph() {
    let mut sums = [0; 2];
    let maps = suite(seeds(60));
    for rules in Rules::ALL {
        for (k, step) in [(2, 1), (3, 1), (4, 2), (5, 4)] {
            let maps: Vec<_> = maps.iter().step_by(step).cloned().collect();
            let [vertices, limits] = check_maps(&maps, rules, k);
            sums = [sums[0] + vertices, sums[1] + limits];
        }
    }
    let maps = maps.len() as u64;
    assert!(sums[0] > 1_000 * maps && sums[1] > 15 * maps, "{sums:?} on {maps} maps");
}

#[test]
fn fields_of_large_k() {
    let (closed, always) = (Rules::Corner(DiagonalGap::Closed), Rules::Center(CornerRule::Always));
    for (rules, k) in [(Rules::Corner(DiagonalGap::Open), 6), (always, 6), (closed, 7)] {
        check_maps(&suite(0..seeds(4).end.min(100)), rules, k);
    }
}

/// k = 9, where the pruning rule is not tabulated, and in longer runs k = 8, whose rule takes seconds.
#[test]
fn fields_of_the_largest_k() {
    let maps = suite(0..seeds(3).end.min(50));
    for rules in [Rules::Corner(DiagonalGap::Closed), Rules::Center(CornerRule::Never)] {
        check_maps(&maps, rules, 9);
        if maps.len() > 3 {
            check_maps(&maps, rules, 8);
        }
    }
}

/// All maps of nine cells: the smallest hold the oddest gaps.
#[test]
fn fields_on_every_map_of_nine_cells() {
    let map = |cells: u32| Grid::from_fn(3, 3, |x, y| cells >> (3 * y + x) & 1 == 1).unwrap();
    let maps: Vec<_> = (0..1 << 9).map(|cells| (Arc::new(map(cells)), cells.into())).collect();
    let sample: Vec<_> = maps.iter().step_by(5).cloned().collect();
    let mut vertices = 0;
    for rules in Rules::ALL {
        for (maps, k) in [(&maps, 2), (&maps, 3), (&sample, 4)] {
            vertices += check_maps(maps, rules, k)[0];
        }
    }
    assert!(vertices > 50_000, "{vertices}");
}

#[test]
fn odd_maps() {
    let sizes = [(1, 1), (1, 90), (130, 1), (64, 2), (2, 65)];
    let grids = sizes.iter().flat_map(|&(width, height)| {
        [false, true].map(|blocked| (Arc::new(Grid::from_fn(width, height, |_, _| blocked).unwrap()), 7))
    });
    let maps: Vec<_> = grids.collect();
    for rules in Rules::ALL {
        check_maps(&maps, rules, 4);
    }
}

/// On open ground and over wide streets: runs, words and buckets.
#[test]
fn large_maps_by_distance() {
    let grid = Arc::new(Grid::from_fn(300, 200, |_, _| false).unwrap());
    for k in (2..=6).map(|k| FiniteK::new(k).unwrap()) {
        let graph = GridGraph::<Corners>::new(Arc::clone(&grid), k, DiagonalGap::Open).unwrap();
        let from = Vertex::new(37, 101);
        let field = Fields::new(&graph).field(FieldQuery::new(&[from])).unwrap();
        assert_eq!(field.iter().count(), 301 * 201);
        assert!(field.iter().all(|(at, cost)| cost == graph.costs().distance(at.to(from))), "k = {k}");
    }
}

/// The distance of a vertex as a limit reaches that vertex, and no vertex that is farther.
#[test]
fn a_limit_includes_what_lies_exactly_there() {
    let two = Arc::new(Grid::from_fn(2, 2, |_, _| false).unwrap());
    let graph = GridGraph::<Centers>::new(two, FiniteK::N8, CornerRule::Never).unwrap();
    let mut fields = Fields::new(&graph);
    let range = fields.field(FieldQuery::new(&[Vertex::new(0, 0)]).within(2_f64.sqrt())).unwrap();
    assert_eq!(range.iter().count(), 4);
    for k in (2..=7).map(|k| FiniteK::new(k).unwrap()) {
        let open = Arc::new(Grid::from_fn(9, 9, |_, _| false).unwrap());
        let graph = GridGraph::<Centers>::new(open, k, CornerRule::Never).unwrap();
        let (mut fields, mut astar) = (Fields::new(&graph), AStar::new(&graph, Hk));
        let from = Vertex::new(0, 0);
        let field = fields.field(FieldQuery::new(&[from])).unwrap();
        for (at, cost) in field.iter() {
            let query = Ends::new(from, at);
            let length = astar.solve(query).unwrap().cost().unwrap();
            for limit in [length, cost.to_f64(), astar.distance(query).unwrap().unwrap()] {
                let range = fields.field(FieldQuery::new(&[from]).within(limit)).unwrap();
                assert_eq!(range.get(at), Some(cost), "k = {k}, {at} within {limit}");
                let farther = range.iter().find(|(_, other)| other.to_f64() > cost.to_f64() + 1e-8);
                assert_eq!(farther, None, "k = {k}, within {limit}");
            }
        }
    }
}

#[test]
fn what_is_wrong_with_a_field() {
    let map = AsciiMap::parse("..\n.#").unwrap();
    let graph = GridGraph::<Centers>::new(Arc::new(map.grid), FiniteK::N8, CornerRule::Never).unwrap();
    let mut fields = Fields::new(&graph);
    let [free, blocked, outside] = [(0, 0), (1, 1), (2, 0)].map(Vertex::from);
    let (end, last) = (End::Start, Vertex::new(1, 1));
    let refused = |error| Some(FieldError::Query(error));
    let found = fields.field(FieldQuery::new(&[free, blocked])).err();
    assert_eq!(found, refused(QueryError::Blocked { end, at: blocked.into() }));
    let found = fields.field(FieldQuery::new(&[outside])).err();
    assert_eq!(found, refused(QueryError::Outside { end, at: outside.into(), last }));
    let found = fields.field(FieldQuery::new(&[free]).until(&[blocked])).err();
    assert_eq!(found, refused(QueryError::Blocked { end: End::Goal, at: blocked.into() }));
    for limit in [f64::NAN, -1.0, -f64::MIN_POSITIVE, f64::NEG_INFINITY] {
        let found = fields.field(FieldQuery::new(&[free]).within(limit)).err();
        assert!(matches!(found, Some(FieldError::Limit { .. })), "{limit}");
    }
    // No source, an empty field; no distance, the sources alone.
    assert_eq!(fields.field(FieldQuery::new(&[])).unwrap().iter().count(), 0);
    for limit in [0.0, -0.0, 0.999] {
        let field = fields.field(FieldQuery::new(&[free, free]).within(limit)).unwrap();
        assert!(field.iter().eq([(free, Cost::ZERO)]));
        assert_eq!(field.path_from(free).unwrap().waypoints(), [free]);
        assert_eq!((field.direction(free), field.direction(outside)), (None, None));
    }
    // A rule of another map.
    let other = Arc::new(Grid::from_fn(2, 2, |_, _| false).unwrap());
    let other = GridGraph::<Centers>::new(other, FiniteK::N8, CornerRule::Never).unwrap();
    assert!(Fields::with_pruning(&graph, Arc::new(Pruning::new(&other))).is_err());
    assert!(Fields::with_pruning(&other, Arc::new(Pruning::new(&other))).is_ok());
}
