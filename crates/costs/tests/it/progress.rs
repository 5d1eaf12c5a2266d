//! The progress of fields and landmarks.

use std::{
    num::NonZeroUsize,
    sync::{Arc, Mutex},
    thread,
};

use mediant_costs::{
    CostField, CostFieldQuery, CostSurface, Heading, Landmarks, Pace, WalkingField, WalkingGraph, WalkingMap,
};
use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
use mediant_moves::FiniteK;
use mediant_oracle::{Rng, random_free_vertex};

use crate::common::{for_random_maps, graph, vertices};

/// The progress that some work tells: on the thread that called it, always of the same total, first 0, then
/// never less.
fn told<T>(about: &str, work: impl FnOnce(&Interrupt) -> T) -> (T, Vec<(usize, usize)>) {
    let (told, caller) = (Arc::new(Mutex::new(Vec::new())), thread::current().id());
    let listens = Arc::clone(&told);
    let interrupt = Interrupt::new().progress(move |done, total| {
        assert_eq!(thread::current().id(), caller);
        listens.lock().expect("no thread has ended").push((done, total));
    });
    let result = work(&interrupt);
    let told = told.lock().expect("no thread has ended").clone();
    let &(_, total) = told.first().unwrap_or_else(|| panic!("nothing is told: {about}"));
    assert!(told.len() >= 2 && told[0].0 == 0, "{told:?}: {about}");
    assert!(told.iter().all(|&(done, of)| done <= total && of == total), "{told:?}: {about}");
    assert!(told.is_sorted(), "{told:?}: {about}");
    (result, told)
}

fn threads(count: usize) -> NonZeroUsize {
    NonZeroUsize::new(count).expect("not 0")
}

#[test]
fn a_field_tells_how_many_vertices_have_their_cost() {
    let mut parts = 0;
    for_random_maps(40, |map, surface, rules, k, about| {
        let graph = graph(surface, rules, k);
        let Some(source) = random_free_vertex(&mut Rng::new(3), map.grid(), rules.placement()) else {
            return;
        };
        let (sources, limit) = ([source], if k == 3 { 9.0 } else { f64::INFINITY });
        let query = CostFieldQuery::new(&sources).within(limit);
        let query = if k == 4 { query.with_allocation() } else { query };
        for count in [1, 2] {
            let work =
                |interrupt: &_| CostField::on_threads(Arc::clone(&graph), query, threads(count), interrupt);
            let (field, told) = told(about, work);
            let field = field.expect("the source is free");
            let is_in = |at: &Vertex| field.cost(*at).is_some();
            let (done, total) = told[told.len() - 1];
            let is_open = |at: &Vertex| matches!(rules, Rules::Corner(_)) || graph.is_free(*at);
            assert_eq!(total, vertices(&graph).filter(is_open).count(), "{about}");
            let known = vertices(&graph).filter(is_in).count();
            // Closed gaps count twice, as do some vertices where costs differ much; and the last
            // bucket reaches beyond the limit. Nothing is scanned for a source that is alone: on a closed
            // gap, beside whose own cell, which is blocked, no path begins.
            assert!(done >= known || known == 1, "{done} of {known}: {about}");
            parts += usize::from(done < total);
        }
    });
    assert!(parts > 20, "only {parts}");
}

#[test]
fn a_large_field_tells_it_now_and_then() {
    let surface =
        CostSurface::from_fn(300, 200, |x, y| (x != 250).then(|| f64::from(1 + (7 * x + 3 * y) % 5)));
    let graph = graph(&Arc::new(surface.expect("good costs")), Rules::Center(CornerRule::Never), 3);
    let sources = [Vertex::new(0, 0)];
    for count in [1, 2, 3] {
        let field = |interrupt: &_| {
            CostField::on_threads(
                Arc::clone(&graph),
                CostFieldQuery::new(&sources),
                threads(count),
                interrupt,
            )
        };
        let (field, told) = told("300 × 200", field);
        assert!(field.is_ok());
        assert!((8..=130).contains(&told.len()), "{told:?}");
        assert_eq!(told.last(), Some(&(50_000, 59_800)));
    }
    let (landmarks, told) = told("8 landmarks", |interrupt| Landmarks::new(&graph, 8, interrupt));
    assert!(landmarks.is_ok());
    assert_eq!(told, (0..=8).map(|done| (done, 8)).collect::<Vec<_>>());
}

#[test]
fn a_field_over_elevation_tells_it_too() {
    let height = |x: u32, y: u32| (x != 7 || y > 50).then(|| f64::from((x * y) % 11));
    let map = WalkingMap::new((120, 90), (20.0, 20.0), &Pace::Tobler, &Interrupt::NEVER, height);
    let (map, rules) = (Arc::new(map.expect("good heights")), Rules::Center(CornerRule::Never));
    let graph = Arc::new(WalkingGraph::new(map, rules, FiniteK::N16).expect("a small k"));
    let sources = [Vertex::new(60, 60)];
    for count in [1, 2] {
        let field = |interrupt: &_| {
            let query = CostFieldQuery::new(&sources);
            WalkingField::on_threads(Arc::clone(&graph), Heading::ToSources, query, threads(count), interrupt)
        };
        let (field, told) = told("over elevation", field);
        let known = field.expect("the source is free").iter().count();
        assert_eq!(told.last(), Some(&(known, known)), "{told:?}");
        assert!(told.len() > 3, "{told:?}");
    }
}
