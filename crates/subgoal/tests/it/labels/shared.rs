//! Labels within a budget of memory, in any number of threads; and the reports while they are built.

use std::{
    sync::{Arc, Mutex},
    thread,
};

use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, Interrupt, Vertex};
use mediant_moves::K;
use mediant_oracle::{Rng, caves, noise};
use mediant_search::{Answer, Ends, Planner};
use mediant_subgoal::{
    Goals, Hierarchy, HubLabelSearch, HubLabels, PreparedSubgoals, Progress, Stage, SubgoalAStar,
    SubgoalError, SubgoalPlacement,
};

use crate::common::{GAPS, graph, k, labels, space, work_of_jumps};

fn cave(gap: DiagonalGap) -> FreeSpace<Corners> {
    space(&caves(&mut Rng::new(7), 60, 50), gap)
}

fn queries(space: &FreeSpace<Corners>, every: usize) -> Vec<Ends> {
    let vertices = (0..=50).flat_map(|y| (0..=60).map(move |x| Vertex::new(x, y)));
    let free: Vec<Vertex> = vertices.filter(|&at| space.is_free(at)).step_by(every).collect();
    free.iter().flat_map(|&a| free.iter().map(move |&b| Ends::new(a, b))).collect()
}

#[test]
fn planners_in_many_threads_answer_as_one() {
    for (gap, k) in GAPS.into_iter().zip([k(4), K::Any]) {
        let space = Arc::new(cave(gap));
        let labels = Arc::new(labels(&space, k));
        let queries = queries(&space, 137);
        let solve_all = |queries: &[Ends]| -> Vec<Answer> {
            let mut planner = HubLabelSearch::new(Arc::clone(&space), Arc::clone(&labels)).expect("they fit");
            queries.iter().map(|&query| planner.solve(query).expect("both ends are free")).collect()
        };
        let expected = solve_all(&queries);
        assert!(expected.iter().filter(|answer| answer.path().is_some()).count() > 50);
        // Each thread begins with another query, so that they do not run in step.
        let from = |first: usize| {
            let mut turned = queries.clone();
            turned.rotate_left(first);
            let mut found = solve_all(&turned);
            found.rotate_right(first);
            found
        };
        thread::scope(|scope| {
            let threads: Vec<_> = (0..4).map(|part| scope.spawn(move || from(part * 31))).collect();
            for thread in threads {
                assert_eq!(thread.join().expect("a thread failed"), expected, "k = {k}");
            }
        });
    }
}

#[test]
fn labels_and_goals_are_shared_and_planners_sent() {
    const fn assert_send_sync<T: Send + Sync>() {}
    const fn assert_send<T: Send>() {}
    assert_send_sync::<HubLabels<Corners>>();
    assert_send_sync::<PreparedSubgoals<Centers>>();
    assert_send_sync::<Goals>();
    assert_send::<HubLabelSearch<Arc<FreeSpace<Corners>>, Arc<HubLabels<Corners>>>>();
}

/// The prepared index, with its progress reports in order.
fn told<P: SubgoalPlacement>(
    space: &FreeSpace<P>,
    k: K,
    most: usize,
) -> (PreparedSubgoals<P>, Vec<Progress>) {
    let told = Mutex::new(Vec::new());
    let tell = |progress| told.lock().expect("no one panicked").push(progress);
    let never = &Interrupt::NEVER;
    let jumps = &mut *work_of_jumps(space, k, never);
    let prepared = PreparedSubgoals::within(space, k, None, most, (&tell, never), jumps);
    let prepared = prepared.expect("k is in range");
    (prepared, told.into_inner().expect("no one panicked"))
}

#[test]
fn progress_is_told_to_the_end() {
    let space = cave(DiagonalGap::Open);
    let (prepared, told) = told(&space, K::Any, usize::MAX);
    let PreparedSubgoals::Labels(labels) = prepared else { panic!("there is memory for labels") };
    let total = labels.subgoals();
    assert!(total > 300, "only {total} subgoals");
    assert!(told.iter().all(|progress| progress.total == total && progress.done <= total), "{told:?}");
    let stages = [Stage::Edges, Stage::Hierarchy, Stage::Sight, Stage::Labels];
    let place = |progress: &Progress| stages.iter().position(|&stage| stage == progress.stage);
    assert!(told.iter().map(place).is_sorted(), "one stage after another: {told:?}");
    for stage in stages {
        let most = told.iter().filter(|progress| progress.stage == stage).map(|progress| progress.done).max();
        assert_eq!(most, Some(total), "{stage:?}");
    }
}

/// Labels where they fit, a hierarchy or nothing where they do not: to the byte.
fn check_budget<P: SubgoalPlacement>(space: &FreeSpace<P>, k: K) {
    let exact = labels(space, k).memory_bytes();
    for (most, is_labels) in
        [(0, false), (1, false), (exact / 2, false), (exact - 1, false), (exact, true), (10 * exact, true)]
    {
        match told(space, k, most).0 {
            PreparedSubgoals::Labels(made) => {
                assert!(is_labels && made.memory_bytes() <= most, "{} of {most} bytes", made.memory_bytes());
                assert_eq!(made.to_bytes(), labels(space, k).to_bytes(), "{most} bytes");
            }
            // Up to k = 3 jumps may be faster.
            PreparedSubgoals::Nothing(_) => assert!(!is_labels && k <= self::k(3), "a contraction pays"),
            PreparedSubgoals::Contracted(made) => {
                assert!(!is_labels, "{exact} bytes fit in {most}");
                assert_eq!(
                    made.to_bytes(),
                    graph(space, k, Hierarchy::Contracted).to_bytes(),
                    "{most} bytes"
                );
            }
        }
    }
}

#[test]
fn labels_keep_within_their_budget() {
    for k in [k(2), k(3), k(6), K::Any] {
        check_budget(&cave(DiagonalGap::Closed), k);
    }
    for number in [2, 3] {
        let space = space::<Centers>(&noise(&mut Rng::new(4), 40, 30, 20), CornerRule::Never);
        check_budget(&space, k(number));
    }
}

/// Another k beside labels is as if it were alone, and at corners does not look again at what is seen.
fn check_beside<P: SubgoalPlacement>(space: &FreeSpace<P>, k: K, other: K, looks: bool) {
    let first = labels(space, k);
    let looked = Mutex::new(false);
    let tell = |progress: Progress| {
        *looked.lock().expect("no one panicked") |= progress.stage == Stage::Sight;
    };
    let second =
        first.for_k(space, other, usize::MAX, &tell, &Interrupt::NEVER).expect("there are labels for this k");
    assert_eq!((second.k(), second.to_bytes()), (other, labels(space, other).to_bytes()));
    assert_eq!(looked.into_inner().ok(), Some(looks), "k = {k}, {other}");
    let exact = second.memory_bytes();
    for (most, fits) in [(exact, true), (exact - 1, false), (0, false)] {
        assert_eq!(
            first.for_k(space, other, most, &|_| {}, &Interrupt::NEVER).is_ok(),
            fits,
            "{most} of {exact} bytes"
        );
        let quiet = (&|_| {}, &Interrupt::NEVER);
        let prepared = PreparedSubgoals::within(space, other, Some(&first), most, quiet, &mut |_| Ok(None))
            .expect("any");
        assert_eq!(matches!(prepared, PreparedSubgoals::Labels(_)), fits);
    }
}

#[test]
fn labels_for_another_k_share_what_is_seen() {
    for gap in GAPS {
        check_beside(&cave(gap), K::Any, k(3), false);
        check_beside(&cave(gap), k(2), k(5), false);
        check_beside(&cave(gap), k(4), K::Any, false);
    }
    let grid = noise(&mut Rng::new(4), 40, 30, 20);
    check_beside(&space::<Centers>(&grid, CornerRule::Never), k(2), k(3), true);
    // Another map, and another rule.
    let first = labels(&cave(DiagonalGap::Open), K::Any);
    for other in [cave(DiagonalGap::Closed), space(&grid, DiagonalGap::Open)] {
        let error = first
            .for_k(&other, k(3), usize::MAX, &|_| {}, &Interrupt::NEVER)
            .expect_err("they do not belong together");
        assert!(matches!(error, SubgoalError::Mismatch(_)), "{error}");
        let quiet = (&|_| {}, &Interrupt::NEVER);
        let error =
            PreparedSubgoals::within(&other, k(3), Some(&first), usize::MAX, quiet, &mut |_| Ok(None));
        assert!(matches!(error, Err(SubgoalError::Mismatch(_))));
    }
}

/// Of the same map the labels are always the same bytes.
#[test]
fn building_again_gives_the_same_bytes() {
    let build = || {
        let of_corners = [k(3), K::Any].map(|k| labels(&cave(DiagonalGap::Open), k).to_bytes());
        let centers = space::<Centers>(&noise(&mut Rng::new(4), 70, 60, 20), CornerRule::Never);
        (of_corners, labels(&centers, k(3)).to_bytes())
    };
    let made = build();
    assert!(made.0.iter().all(|bytes| bytes.len() > 10_000), "small maps");
    assert_eq!(build(), made);
    #[cfg(feature = "parallel")]
    for threads in [1, 2, 3] {
        let pool =
            rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started");
        assert!(pool.install(build) == made, "{threads} threads");
    }
    // The sum tells whether one thread and several, which are other programs, agree.
    let sum = |bytes: &[u8]| {
        bytes.iter().fold(0_u64, |sum, &byte| sum.rotate_left(5).wrapping_mul(3) ^ u64::from(byte))
    };
    let sums = made.0.iter().map(|bytes| sum(bytes)).fold(sum(&made.1), |a, b| a.rotate_left(1) ^ b);
    insta::assert_snapshot!("bytes_of_labels", format!("{sums:016x}"));
}

/// A map without obstacles has no subgoals; on a map without free cells every query is an error.
#[test]
fn maps_without_subgoals_have_labels() {
    for (width, height, cells) in [(5, 4, false), (5, 4, true), (1, 1, false), (1, 1, true), (300, 1, false)]
    {
        let grid = Grid::from_fn(width, height, |_, _| cells).expect("a valid size");
        for k in [k(2), k(3), K::Any] {
            let space = space::<Corners>(&grid, DiagonalGap::Open);
            let made = labels(&space, k);
            assert_eq!((made.subgoals(), made.labels()), (0, 0));
            let read = HubLabels::from_bytes(&space, k, &made.to_bytes()).expect("these are its bytes");
            let query = Ends::new((0, 0), (width as i32, height as i32));
            for labels in [&made, &read] {
                let mut planner = HubLabelSearch::new(&space, labels).expect("they fit");
                let answer = planner.solve(query);
                assert_eq!(answer.is_ok(), !cells);
                let theirs = graph(&space, k, Hierarchy::Contracted);
                let theirs = SubgoalAStar::new(&space, &theirs).expect("it fits").solve(query);
                assert_eq!(answer.ok().and_then(Answer::into_path), theirs.ok().and_then(Answer::into_path));
                let goals = labels.goals(&space, (!cells).then_some(query.goal)).expect("the goal is free");
                assert_eq!(
                    planner.nearest(query.start, &goals).is_ok_and(|nearest| nearest.is_some()),
                    !cells
                );
            }
        }
    }
}
