//! Fields, and spaces where all cells cost 1.

use std::num::NonZeroUsize;

use mediant::{DirectionCode, Engine, ErrorCode, K, Limits, Map, Motion, Path, Point, Rules, Vertex};
use mediant_oracle::{Rng, random_free_vertex, random_weighted, seeds};

use super::{World, ends};
use crate::k;

#[test]
fn fields_are_those_of_the_oracle() {
    let mut reached = 0;
    for seed in seeds(120) {
        let world = World::new(seed);
        let about = &world.about;
        let mut rng = Rng::new(seed);
        let count = 1 + rng.below(3);
        let sources = world.free(&mut rng, count);
        let expected = world.oracle.nearest(&sources, world.rounded());
        let field = world.space.field(sources.clone()).expect("the sources are free");
        assert_eq!(field.identity(), world.space.identity());
        let mut listed = field.iter();
        let lengths = field.lengths();
        let (width, height) = (field.width() as usize, field.height() as usize);
        assert_eq!((width * height, lengths.len()), (expected.len(), expected.len()), "{about}");
        let mut planner = world.space.planner(Engine::AStar).expect("it knows costs");
        for ((at, expected), length) in world.vertices().into_iter().zip(&expected).zip(&lengths) {
            let Some((cost, source)) = *expected else {
                assert_eq!((field.get(at), field.nearest_source(at), *length), (None, None, f64::INFINITY));
                assert!(field.path_from(at).is_none() && field.next(at).is_none(), "{at}: {about}");
                continue;
            };
            reached += 1;
            let told = world.to_f64(cost);
            assert_eq!((field.get(at), *length), (Some(told), told), "{at}: {about}");
            assert_eq!(listed.next(), Some((at, told)), "{about}");
            assert_eq!(field.nearest_source(at), Some(sources[source].into()), "{at}: {about}");
            let path = field.path_from(at).expect("it is in the field");
            world.check_path(&path, cost);
            assert!(sources.contains(&ends(&path).1), "{path}: {about}");
            let next = path.vertices().nth(1).filter(|_| cost > 0);
            assert_eq!(field.next(at), next.map(Point::from), "{path}: {about}");
            if let (Some(next), Some((x, y))) = (next, field.direction(at)) {
                let d = at.to(next);
                assert!((x * d.norm() - f64::from(d.x)).abs() + (y * d.norm() - f64::from(d.y)).abs() < 1e-9);
            }
            if rng.chance(3) && sources.len() == 1 {
                assert_eq!(planner.distance((at, sources[0])), Ok(Some(told)), "{at}: {about}");
            }
        }
        let greatest = expected.iter().flatten().map(|&(cost, _)| cost).max().unwrap_or(0);
        let limit = world.to_f64(greatest) * 0.6;
        let within = world.space.within(Limits::new()).field_within(sources.clone(), limit);
        let within = within.expect("the sources are free");
        for at in world.vertices() {
            let expected = field.get(at).filter(|&cost| cost <= limit * (1.0 + 1e-9));
            assert_eq!(within.get(at), expected, "{at} within {limit}: {about}");
        }
        let corridor = field.corridor(&within).expect("the same space");
        for ((one, other), sum) in lengths.iter().zip(within.lengths()).zip(corridor) {
            assert!(sum == one + other || (sum - one - other).abs() < 1e-9 * sum, "{about}");
        }
        if let &[source] = &sources[..] {
            let all = world.space.distances(Engine::Dijkstra, source).expect("it is free");
            assert!(field.iter().eq(all), "{about}");
        }
    }
    assert!(reached > 5_000, "only {reached}");
}

#[test]
fn costs_of_1_are_lengths_and_another_space() {
    for seed in seeds(60) {
        let (map, about) = random_weighted(seed);
        let map = Map::from(map.grid().clone());
        // The pruning that fields without costs need takes long for large k.
        let (rules, k) = (Rules::ALL[(seed % 5) as usize], k(2 + ((seed / 5) % 4) as u32));
        let motion = Motion::new(k, rules);
        let cells = map.width() as usize * map.height() as usize;
        let costs = map.costs(vec![1_u8; cells]).expect("costs of 1");
        let (plain, space) = (map.space(motion).expect("a small k"), costs.space(motion).expect("a small k"));
        assert_ne!(plain.identity(), space.identity());
        let mut planners = [&plain, &space].map(|space| space.planner(Engine::AStar).expect("it takes all"));
        let mut rng = Rng::new(seed);
        let ends = |rng: &mut Rng| random_free_vertex(rng, map.grid(), rules.placement());
        for _ in 0..4 {
            let (Some(start), Some(goal)) = (ends(&mut rng), ends(&mut rng)) else { continue };
            let [one, other] = planners.each_mut().map(|planner| planner.distance((start, goal)));
            assert_eq!(one, other, "seed {seed}: {start} → {goal}, {motion}: {about}\n{map}");
            let [one, other] = [&plain, &space].map(|space| space.field([start]).expect("it is free"));
            assert_eq!(one.lengths(), other.lengths(), "seed {seed}: {start}, {motion}: {about}\n{map}");
            assert_eq!(one.corridor(&other).unwrap_err().code(), ErrorCode::Mismatch);
        }
    }
}

/// Rows of allocation, directions and lengths are those of single vertices; so are fields on threads.
#[test]
fn rows_are_those_of_single_vertices() {
    let (mut reached, mut crossed) = (0, 0);
    for seed in seeds(60) {
        let world = World::new(seed);
        let about = &world.about;
        let mut rng = Rng::new(seed);
        let count = 1 + rng.below(4);
        let sources = world.free(&mut rng, count);
        let plain =
            world.space.map().space(Motion::new(k(2 + (seed % 3) as u32), world.rules)).expect("a small k");
        for space in [&world.space, &plain] {
            let field = space.field(sources.clone()).expect("the sources are free");
            assert_eq!(field.sources(), sources);
            let (allocation, lengths) = (field.allocation(), field.lengths());
            let codes = [DirectionCode::ArcGisBackLink, DirectionCode::ArcGisDegrees, DirectionCode::Grass];
            let directions = codes.map(|code| field.directions(code));
            assert_eq!((allocation.len(), directions[0].len()), (lengths.len(), lengths.len()), "{about}");
            for (number, at) in world.vertices().into_iter().enumerate() {
                let source = allocation[number].map(|source| sources[source as usize]);
                assert_eq!(source.map(Point::from), field.nearest_source(at), "{at}: {about}");
                // Of equal sources it is the first.
                assert!(source.is_none_or(|source| sources.iter().position(|&at| at == source)
                    == allocation[number].map(|source| source as usize)));
                let next = field.next(at).and_then(Point::vertex);
                for (code, row) in codes.into_iter().zip(&directions) {
                    let told = Some(row[number]).filter(|number| !number.is_nan());
                    let expected = match next {
                        Some(next) => code.of(at.to(next)),
                        None => field.get(at).and_then(|_| code.of_source()),
                    };
                    assert_eq!(told, expected, "{code:?} at {at}: {about}");
                }
                reached += usize::from(next.is_some());
            }
            let two = NonZeroUsize::new(2).expect("it is not 0");
            let on_two =
                space.fields().expect("a space").on_threads(two).field(sources.clone()).expect("free");
            assert_eq!((on_two.lengths(), on_two.allocation()), (lengths.clone(), allocation), "{about}");
            assert_eq!(field.into_lengths(), lengths, "{about}");
        }
        // The cells of a path, by their costs.
        let (Some(&start), Some(&goal)) = (sources.first(), sources.last()) else { continue };
        for engine in [Engine::AStar, Engine::Theta] {
            let mut planner = world.space.planner(engine).expect("it knows costs");
            let Some(path) = planner.path(start, goal).expect("both are free") else { continue };
            let cells = world.space.crossings(&path).expect("cells have costs");
            let cost = |(cell, length): (Vertex, f64)| length * world.costs.cost(cell).expect("it is free");
            let sum: f64 = cells.iter().copied().map(cost).sum();
            assert!(
                (sum - path.cost()).abs() <= 1e-6 * (1.0 + sum),
                "{path}: {sum}, not {}: {about}",
                path.cost()
            );
            crossed += cells.len();
        }
        assert_eq!(plain.crossings(&Path::new(vec![start])).unwrap_err().code(), ErrorCode::Cost);
    }
    assert!(reached > 3_000 && crossed > 150, "{reached} reached, {crossed} crossed");
}

/// At any angle a vertex has the source to which its path leads, too.
#[test]
fn allocation_at_any_angle() {
    let map = Map::from_fn(12, 9, |x, y| (x * 5 + y * 3) % 7 == 0).expect("a map");
    let space = map.space(Motion::corners(K::ANY)).expect("a space");
    let sources: Vec<Vertex> = [(0, 9), (12, 0), (6, 4)].map(Into::into).into();
    let sources: Vec<Vertex> = sources.into_iter().filter(|&at| space.is_free(at)).collect();
    let field = space.field(sources.clone()).expect("the sources are free");
    let (mut found, allocation) = (0, field.allocation());
    for (number, source) in allocation.into_iter().enumerate() {
        let at = Vertex::new(number as i32 % 13, number as i32 / 13);
        assert_eq!(source.map(|source| sources[source as usize].into()), field.nearest_source(at), "{at}");
        found += usize::from(source.is_some());
    }
    assert!(found > 60, "{found}");
}
