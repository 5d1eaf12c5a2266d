//! Fields, against Dijkstra's algorithm with times from the ground.

use std::{num::NonZeroUsize, sync::Arc};

use mediant_costs::{CostFieldQuery, DirectionCode, Heading, WalkingError, WalkingField, WalkingGraph};
use mediant_grid::{Interrupt, Vertex};
use mediant_oracle::Rng;

use super::ground::{Way, for_random_grounds, vertices};

const HEADINGS: [Heading; 2] = [Heading::FromSources, Heading::ToSources];

fn field(graph: &Arc<WalkingGraph>, heading: Heading, query: CostFieldQuery<'_>) -> WalkingField {
    WalkingField::new(Arc::clone(graph), heading, query, &Interrupt::NEVER).expect("the sources are free")
}

#[test]
fn times_and_paths_are_those_of_the_oracle() {
    let (mut reached, mut differ) = (0, 0);
    for_random_grounds(90, |ground, graph, about| {
        let Some(source) = ground.source(&mut Rng::new(7)) else { return };
        let sources = [source];
        let fields = HEADINGS.map(|heading| field(graph, heading, CostFieldQuery::new(&sources)));
        for field in &fields {
            let expected = ground.times(graph.rules(), graph.k().get(), source, field.heading(), Way::Cut);
            for (at, expected) in vertices(graph).zip(expected) {
                let found = field.get(at);
                let about = || format!("{:?}, {at} and {source}: {about}", field.heading());
                assert_eq!(found.is_some(), expected.is_some(), "{}", about());
                let (Some(found), Some(expected)) = (found, expected) else { continue };
                let near = (found - expected).abs() <= expected * ground.tolerance();
                assert!(near, "{found}, not {expected}: {}", about());
                reached += 1;
                let path = field.path(at).expect("it is in the field");
                assert_eq!(graph.path_cost(&path), field.cost(at), "{path}: {}", about());
                assert_eq!(Some(path.cost()), field.get(at), "{path}: {}", about());
                let ends = match field.heading() {
                    Heading::FromSources => [source, at],
                    Heading::ToSources => [at, source],
                };
                assert_eq!([path.waypoints()[0], path.waypoints()[path.len() - 1]], ends, "{}", about());
            }
            let rows: Vec<f64> = vertices(graph).map(|at| field.get(at).unwrap_or(f64::INFINITY)).collect();
            assert_eq!(rows, field.clone().into_rows(), "{about}");
            for (at, code) in vertices(graph).zip(field.directions(DirectionCode::ArcGisDegrees)) {
                assert_eq!(code.is_some(), field.get(at).is_some(), "{at}: {about}");
            }
        }
        let [from, to] = &fields;
        differ += vertices(graph).filter(|&at| from.cost(at) != to.cost(at)).count();
    });
    assert!(reached > 15_000 && differ > 5_000, "{reached} reached, {differ} of them in different times");
}

#[test]
fn limits_allocations_and_threads_agree_with_single_fields() {
    for_random_grounds(40, |ground, graph, about| {
        let mut rng = Rng::new(3);
        let sources: Vec<Vertex> = (0..3).filter_map(|_| ground.source(&mut rng)).collect();
        for heading in HEADINGS {
            let single: Vec<WalkingField> =
                sources.iter().map(|source| field(graph, heading, CostFieldQuery::new(&[*source]))).collect();
            let all = field(graph, heading, CostFieldQuery::new(&sources).with_allocation());
            let limit = vertices(graph).filter_map(|at| all.get(at)).fold(0.0, f64::max) * 0.6;
            let within = field(graph, heading, CostFieldQuery::new(&sources).within(limit));
            let threads = NonZeroUsize::new(3).expect("not 0");
            let query = CostFieldQuery::new(&sources);
            let shared =
                WalkingField::on_threads(Arc::clone(graph), heading, query, threads, &Interrupt::NEVER)
                    .expect("the sources are free");
            for at in vertices(graph) {
                // The first of the least.
                let nearest =
                    (0..).zip(&single).filter_map(|(number, field)| Some((field.cost(at)?, number))).min();
                let found = all.cost(at).zip(all.allocation(at));
                assert_eq!(found, nearest, "{heading:?} {at}: {about}");
                assert_eq!(shared.cost(at), all.cost(at), "{heading:?} {at}: {about}");
                let expected = all.get(at).filter(|&cost| cost <= limit * (1.0 + 1e-9));
                assert_eq!(within.get(at), expected, "{heading:?} {at} within {limit}: {about}");
            }
        }
    });
}

#[test]
fn a_corridor_is_as_cheap_as_the_path_along_its_bottom() {
    let mut joined = 0;
    for_random_grounds(20, |ground, graph, about| {
        let mut rng = Rng::new(9);
        let Some((here, there)) = ground.source(&mut rng).zip(ground.source(&mut rng)) else { return };
        let from = field(graph, Heading::FromSources, CostFieldQuery::new(&[here]));
        let to = field(graph, Heading::ToSources, CostFieldQuery::new(&[there]));
        assert!(matches!(from.corridor(&from), Err(WalkingError::Heading)));
        let corridor = from.corridor(&to).expect("a field each");
        let least = corridor.iter().copied().fold(f64::INFINITY, f64::min);
        assert_eq!(least, from.get(there).unwrap_or(f64::INFINITY), "{about}");
        let Some(path) = from.path(there) else { return };
        joined += 1;
        for at in path.vertices() {
            let place = at.y as usize * graph.size().0 as usize + at.x as usize;
            // The path's vertices between bends of a longer move are no ends of its moves.
            assert!(corridor[place] >= least, "{at}: {about}");
        }
        assert_eq!(to.get(here), Some(least), "{about}");
    });
    assert!(joined > 20, "only {joined}");
}

#[test]
fn each_step_leads_nearer_to_the_source() {
    let mut steps = 0;
    for_random_grounds(20, |ground, graph, about| {
        let Some(source) = ground.source(&mut Rng::new(7)) else { return };
        for heading in HEADINGS {
            let field = field(graph, heading, CostFieldQuery::new(&[source]));
            for at in vertices(graph) {
                let Some(next) = field.next(at) else {
                    assert!(at == source || field.cost(at).is_none(), "{at}: {about}");
                    continue;
                };
                assert!(field.cost(next) < field.cost(at), "{at} to {next}: {about}");
                assert_eq!(field.direction(at), Some(at.to(next)), "{at} to {next}: {about}");
                steps += 1;
            }
        }
    });
    assert!(steps > 1000, "only {steps}");
}
