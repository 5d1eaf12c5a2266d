//! Any-angle fields against the visibility graph, against single queries of Anya, and against each other.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::sync::Arc;

use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace, Grid, PlacementKind, Rules, Vertex};
use mediant_oracle::{
    Rng, Visibility, caves, describe, maze, noise, random_free_vertex, rooms, seeds, suite_grid, validate,
};
use mediant_search::{AnyAngleField, AnyAngleFields, Anya, Ends, FieldError, FieldQuery, Planner};

const GAPS: [DiagonalGap; 2] = [DiagonalGap::Open, DiagonalGap::Closed];

fn is_close(found: Option<f64>, best: Option<f64>) -> bool {
    found.zip(best).map_or(found == best, |(a, b)| (a - b).abs() <= 1e-9 * b)
}

/// Checks all distances of a field, and every `every`-th path. `best` is the true distance of a vertex.
/// Returns the number of vertices in the field.
fn check_field(
    field: &AnyAngleField<&FreeSpace<Corners>>,
    space: &FreeSpace<Corners>,
    sources: &[Vertex],
    best: &mut dyn FnMut(Vertex) -> Option<f64>,
    case: &dyn Fn(Vertex) -> String,
    every: usize,
) -> usize {
    let (width, height) = (field.width() as i32, field.height() as i32);
    let mut known = 0;
    for at in (-1..=height).flat_map(|y| (-1..=width).map(move |x| Vertex::new(x, y))) {
        let (found, best) = (field.get(at), best(at));
        assert!(is_close(found, best), "{found:?}, not {best:?}; {}", case(at));
        let path = field.path_from(at);
        assert_eq!(path.is_some(), found.is_some(), "{}", case(at));
        let Some((path, found)) = path.zip(found) else { continue };
        known += 1;
        if known % every != 0 {
            continue;
        }
        let last = *path.waypoints().last().unwrap();
        assert!(sources.contains(&last), "{path} ends at no source; {}", case(at));
        assert_eq!(field.nearest_source(at), Some(last.into()));
        let fault = validate(space.grid(), space.rules(), None, at, last, path.waypoints(), found);
        assert_eq!(fault, Ok(()), "{path}; {}", case(at));
        assert_eq!(field.next(at).is_none(), found == 0.0);
        let length = field.direction(at).map(|(x, y)| x.hypot(y));
        assert!(is_close(length, field.next(at).map(|_| 1.0)), "{}", case(at));
    }
    assert_eq!(field.iter().count(), known);
    assert!(field.iter().all(|(at, length)| field.get(at) == Some(length)));
    known
}

/// Fields from `counts` sources against the visibility graph, and their parts within limits.
fn check_all(grid: &Arc<Grid>, gap: DiagonalGap, counts: &[usize], seed: u64) -> usize {
    let visibility = Visibility::new(grid, gap);
    let graph = visibility.over(None);
    let space = &FreeSpace::<Corners>::new(Arc::clone(grid), gap);
    let (mut fields, mut rng, mut known) = (AnyAngleFields::new(space), Rng::new(seed ^ 0xF1E1D), 0);
    for &count in counts {
        let mut free = || random_free_vertex(&mut rng, grid, PlacementKind::Corner);
        let sources: Vec<Vertex> = (0..count).filter_map(|_| free()).collect();
        let (Some(&first), Some(far)) = (sources.first(), free()) else { return known };
        let case = |at| format!("sources {sources:?}; {}", describe(grid, space.rules(), first, at, seed));
        let costs: Vec<_> = sources.iter().map(|&source| graph.costs_from(source)).collect();
        let mut best = |at| costs.iter().filter_map(|costs| costs.to(at)).min_by(f64::total_cmp);
        let query = FieldQuery::new(&sources);
        let field = fields.field(query).unwrap();
        known += check_field(&field, space, &sources, &mut best, &case, 1);
        let Some(limit) = field.get(far) else { continue };
        let all: Vec<_> = field.iter().collect();
        for (query, limit) in [
            (query.within(limit), limit),
            (query.within(0.7 * limit), 0.7 * limit),
            (query.until(&[far]), limit),
            (query.until(&[first, far]).within(0.5 * limit), 0.5 * limit),
        ] {
            let range = fields.field(query).unwrap();
            // The same paths, so the same sums. Lengths that differ in the last digits are at the limit, too.
            let within = all.iter().copied().filter(|&(_, length)| length <= limit * (1.0 + 2_f64.powi(-31)));
            assert!(range.iter().eq(within), "{query:?}; {}", case(far));
        }
        if let Some(path) = Anya::new(space).solve(Ends::new(far, first)).unwrap().into_path() {
            let range = fields.field(FieldQuery::new(&[first]).within(path.cost())).unwrap();
            assert!(range.get(far).is_some(), "within {}; {}", path.cost(), case(far));
        }
    }
    known
}

#[test]
fn any_angle_fields_hold_the_distances_of_the_visibility_graph() {
    let known: usize = seeds(60)
        .map(|seed| {
            let grid = Arc::new(suite_grid(seed).0);
            GAPS.map(|gap| check_all(&grid, gap, &[1, 1, 3], seed)).iter().sum::<usize>()
        })
        .sum();
    assert!(known as u64 > 150 * seeds(60).end, "{known} vertices");
}

#[test]
fn any_angle_fields_on_every_map_of_nine_cells() {
    let mut known = 0;
    for (width, height, step) in [(3, 3, 1_usize), (4, 3, 13), (1, 9, 7), (9, 1, 7)] {
        for cells in (0..1_u32 << (width * height)).step_by(step) {
            let grid = Grid::from_fn(width, height, |x, y| cells >> (width * y + x) & 1 == 1).unwrap();
            let grid = Arc::new(grid);
            known += GAPS.map(|gap| check_all(&grid, gap, &[1, 2, 1], cells.into())).iter().sum::<usize>();
        }
    }
    assert!(known > 30_000, "{known} vertices");
}

/// Every vertex of larger maps against a query of Anya.
#[test]
fn any_angle_fields_agree_with_anya() {
    // A query a vertex takes long.
    for seed in 0..seeds(6).end.min(60) {
        let mut rng = Rng::new(seed);
        let grid = match seed % 6 {
            0 => noise(&mut rng, 90, 60, 5),
            1 => noise(&mut rng, 60, 50, 30),
            2 => rooms(&mut rng, 70, 60),
            3 => caves(&mut rng, 80, 70),
            4 => maze(&mut rng, 41, 61),
            _ => noise(&mut rng, 140, 50, 1),
        };
        let grid = Arc::new(grid);
        for gap in GAPS {
            let space = &FreeSpace::<Corners>::new(Arc::clone(&grid), gap);
            let Some(source) = random_free_vertex(&mut rng, &grid, PlacementKind::Corner) else { continue };
            let field = AnyAngleFields::new(space).field(FieldQuery::new(&[source])).unwrap();
            let mut anya = Anya::new(space);
            let mut best = |at| anya.solve(Ends::new(source, at)).ok().and_then(|answer| answer.cost());
            let case = |at| describe(&grid, space.rules(), source, at, seed);
            check_field(&field, space, &[source], &mut best, &case, 31);
        }
    }
}

#[test]
fn odd_any_angle_fields() {
    let open = Arc::new(Grid::from_fn(200, 150, |_, _| false).unwrap());
    for gap in GAPS {
        let space = &FreeSpace::<Corners>::new(Arc::clone(&open), gap);
        let mut fields = AnyAngleFields::new(space);
        let from = Vertex::new(3, 149);
        let field = fields.field(FieldQuery::new(&[from])).unwrap();
        assert_eq!(field.iter().count(), 201 * 151);
        assert!(field.iter().all(|(at, length)| length == at.distance(from)));
        assert_eq!(field.identity(), Anya::new(space).identity());
        for limit in [f64::NAN, -1.0] {
            let found = fields.field(FieldQuery::new(&[from]).within(limit)).err();
            assert!(matches!(found, Some(FieldError::Limit { .. })));
        }
        let outside = Vertex::new(201, 0);
        let found = fields.field(FieldQuery::new(&[from, outside])).err();
        assert!(matches!(found, Some(FieldError::Query(_))));
        assert_eq!(fields.field(FieldQuery::new(&[])).unwrap().iter().count(), 0);
        let field = fields.field(FieldQuery::new(&[from, from]).within(0.0)).unwrap();
        assert!(field.iter().eq([(from, 0.0)]));
        // All blocked, and a single cell.
        let full = Arc::new(Grid::from_fn(3, 2, |_, _| true).unwrap());
        let space = &FreeSpace::<Corners>::new(full, gap);
        assert!(AnyAngleFields::new(space).field(FieldQuery::new(&[(1, 1).into()])).is_err());
        let map = AsciiMap::parse("###\n#.#\n###").unwrap();
        let space = &FreeSpace::<Corners>::new(Arc::new(map.grid), gap);
        let field = AnyAngleFields::new(space).field(FieldQuery::new(&[(1, 1).into()])).unwrap();
        assert_eq!(field.lengths().iter().filter(|length| length.is_finite()).count(), 4);
        assert_eq!(space.rules(), Rules::Corner(gap));
    }
}
