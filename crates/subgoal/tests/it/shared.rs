//! One graph for any number of planners, in any number of threads; and the progress reports while it is
//! built.

use std::{
    sync::{Arc, Mutex},
    thread,
};

use mediant_grid::{Centers, Corners, DiagonalGap, FreeSpace, Interrupt, Vertex};
use mediant_moves::K;
use mediant_oracle::{Rng, caves};
use mediant_search::{Answer, Ends, Planner};
use mediant_subgoal::{Hierarchy, Progress, Stage, SubgoalAStar, SubgoalGraph, SubgoalTheta};

use crate::common::{GAPS, HIERARCHIES, graph, k, levels};

fn cave(gap: DiagonalGap) -> FreeSpace<Corners> {
    FreeSpace::new(Arc::new(caves(&mut Rng::new(7), 60, 50)), gap)
}

fn queries(space: &FreeSpace<Corners>) -> Vec<Ends> {
    let vertices = (0..=50).flat_map(|y| (0..=60).map(move |x| Vertex::new(x, y)));
    let free: Vec<Vertex> = vertices.filter(|&at| space.is_free(at)).step_by(137).collect();
    free.iter().flat_map(|&a| free.iter().map(move |&b| Ends::new(a, b))).collect()
}

type Shared = (Arc<FreeSpace<Corners>>, Arc<SubgoalGraph<Corners>>);

fn solve_all((space, graph): &Shared, queries: &[Ends]) -> Vec<[Answer; 2]> {
    let mut a_star =
        SubgoalAStar::new(Arc::clone(space), Arc::clone(graph)).expect("the graph is for this space");
    let mut theta =
        SubgoalTheta::new(Arc::clone(space), Arc::clone(graph)).expect("the graph is for this space");
    let mut solve =
        |&query| [a_star.solve(query), theta.solve(query)].map(|answer| answer.expect("both ends are free"));
    queries.iter().map(&mut solve).collect()
}

#[test]
fn planners_in_many_threads_answer_as_one() {
    for (gap, k) in GAPS.into_iter().zip([k(4), K::Any]) {
        let space = Arc::new(cave(gap));
        let queries = queries(&space);
        for hierarchy in [Hierarchy::Contracted, levels(2)] {
            let shared = (Arc::clone(&space), Arc::new(graph(&space, k, hierarchy)));
            let expected = solve_all(&shared, &queries);
            let found = expected.iter().filter(|[answer, _]| answer.path().is_some()).count();
            assert!(found > 50, "only {found} paths");
            // Each thread begins with another query, so that they do not run in step.
            let from = |first: usize| {
                let mut turned = queries.clone();
                turned.rotate_left(first);
                let mut found = solve_all(&shared, &turned);
                found.rotate_right(first);
                found
            };
            thread::scope(|scope| {
                let threads: Vec<_> = (0..4).map(|part| scope.spawn(move || from(part * 31))).collect();
                for thread in threads {
                    assert_eq!(thread.join().expect("a thread failed"), expected, "{hierarchy:?}, k = {k}");
                }
            });
        }
    }
}

#[test]
fn graphs_are_shared_and_planners_sent() {
    const fn assert_send_sync<T: Send + Sync>() {}
    const fn assert_send<T: Send>() {}
    assert_send_sync::<SubgoalGraph<Corners>>();
    assert_send_sync::<SubgoalGraph<Centers>>();
    assert_send::<SubgoalAStar<Arc<FreeSpace<Corners>>, Arc<SubgoalGraph<Corners>>, Corners>>();
    assert_send::<SubgoalTheta<Arc<FreeSpace<Centers>>, Arc<SubgoalGraph<Centers>>, Centers>>();
}

/// A graph, and the progress reports of building it, in order.
fn told(space: &FreeSpace<Corners>, k: K, hierarchy: Hierarchy) -> (SubgoalGraph<Corners>, Vec<Progress>) {
    let told = Mutex::new(Vec::new());
    let tell = |progress| told.lock().expect("no one panicked").push(progress);
    let graph =
        SubgoalGraph::with_progress(space, k, hierarchy, &tell, &Interrupt::NEVER).expect("k is in range");
    (graph, told.into_inner().expect("no one panicked"))
}

#[test]
fn progress_is_told_to_the_end() {
    let space = cave(DiagonalGap::Open);
    for (k, hierarchy) in [k(3), K::Any].into_iter().flat_map(|k| HIERARCHIES.map(|h| (k, h))) {
        let (made, told) = told(&space, k, hierarchy);
        assert_eq!(made.to_bytes(), graph(&space, k, hierarchy).to_bytes());
        let total = made.subgoals();
        assert!(total > 300, "only {total} subgoals");
        assert!(told.iter().all(|progress| progress.total == total && progress.done <= total), "{told:?}");
        let of =
            |stage| told.iter().filter(move |progress| progress.stage == stage).map(|progress| progress.done);
        assert_eq!(of(Stage::Edges).max(), Some(total), "{hierarchy:?}");
        let edges = of(Stage::Edges).count();
        // First all edges, then the hierarchy.
        assert!(told[..edges].iter().all(|progress| progress.stage == Stage::Edges), "{told:?}");
        assert_eq!(of(Stage::Hierarchy).count() == 0, hierarchy == levels(1), "{hierarchy:?}");
    }
}

/// A map without obstacles has no subgoals; on a map without free cells every query is an error.
#[test]
fn maps_without_subgoals_have_graphs() {
    for cells in [false, true] {
        let grid = mediant_grid::Grid::from_fn(5, 4, |_, _| cells).expect("a valid size");
        let space = FreeSpace::<Corners>::new(Arc::new(grid), DiagonalGap::Open);
        for (k, hierarchy) in [k(3), K::Any].into_iter().flat_map(|k| HIERARCHIES.map(|h| (k, h))) {
            let (made, _) = told(&space, k, hierarchy);
            assert_eq!((made.subgoals(), made.arcs(), made.core()), (0, 0, 0));
            let query = Ends::new((0, 0), (5, 3));
            let [a_star, theta] = [
                SubgoalAStar::new(&space, &made).expect("the graph is for this space").solve(query),
                SubgoalTheta::new(&space, &made).expect("the graph is for this space").solve(query),
            ];
            assert_eq!(theta.is_ok(), !cells);
            assert_eq!(
                a_star.map(|answer| answer.path().is_some()),
                theta.map(|answer| answer.path().is_some())
            );
        }
    }
}
