//! Building and reading subgoal graphs and hub labels can be stopped anywhere.

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, Interrupt, StoppedBy};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{Rng, check_interrupts, noise, rooms};
use mediant_search::Anya;
use mediant_subgoal::{Hierarchy, HubLabels, PreparedSubgoals, SubgoalError, SubgoalGraph, SubgoalPlacement};

use crate::common::{work, work_of_jumps};

const SIDE: u32 = 24;

fn by(error: &SubgoalError) -> Option<StoppedBy> {
    if let SubgoalError::Interrupted(error) = error { Some(error.by) } else { None }
}

/// Graphs and labels of a map that has hub labels.
fn check<P: SubgoalPlacement>(grid: Grid, rule: P::Rule, k: K) {
    let space = FreeSpace::<P>::new(Arc::new(grid), rule);
    let graph = SubgoalGraph::new(&space, k, Hierarchy::Contracted).expect("a graph");
    let subgoals = graph.subgoals();
    for hierarchy in
        [Hierarchy::Contracted, Hierarchy::AllLevels, Hierarchy::Levels(NonZeroU32::new(2).expect("not 0"))]
    {
        let build = |i: &Interrupt| SubgoalGraph::with_progress(&space, k, hierarchy, &|_| {}, i);
        check_interrupts("a graph", 2 * subgoals, build, by);
    }
    let bytes = graph.to_bytes();
    let read = |i: &Interrupt| SubgoalGraph::from_bytes_interruptible(&space, k, &bytes, i);
    check_interrupts("a graph's bytes", SIDE as usize, read, by);
    let build = |i: &Interrupt| HubLabels::within(&space, k, usize::MAX, &|_| {}, i);
    check_interrupts("labels", 4 * subgoals, build, by);
    let labels = build(&Interrupt::NEVER).expect("there is no core");
    let bytes = labels.to_bytes();
    let read = |i: &Interrupt| HubLabels::from_bytes_interruptible(&space, k, &bytes, i);
    check_interrupts("labels' bytes", SIDE as usize, read, by);
    // Where labels do not fit, engines are compared.
    let build = |i: &Interrupt| {
        let jumps = &mut *work_of_jumps(&space, k, i);
        PreparedSubgoals::within(&space, k, None, 1000, (&|_| {}, i), jumps)
    };
    check_interrupts("what fits", 2 * subgoals, build, by);
}

#[test]
fn what_is_built_at_corners_stops() {
    let rooms = rooms(&mut Rng::new(3), SIDE, SIDE);
    check::<Corners>(rooms.clone(), DiagonalGap::Open, K::Any);
    check::<Corners>(rooms, DiagonalGap::Closed, FiniteK::N8.into());
}

#[test]
fn what_is_built_at_centers_stops() {
    check::<Centers>(rooms(&mut Rng::new(4), SIDE, SIDE), CornerRule::Never, FiniteK::N8.into());
}

/// In noise a core is left, and the other engine answers queries, too. The same is kept with and without an
/// interrupt.
#[test]
fn comparisons_stop() {
    let grid = Arc::new(noise(&mut Rng::new(5), 30, 30, 12));
    for k in [K::Any, FiniteK::N8.into(), FiniteK::N16.into()] {
        let space = FreeSpace::<Corners>::new(Arc::clone(&grid), DiagonalGap::Open);
        let build = |i: &Interrupt| {
            let mut unprepared = match k {
                K::Any => work(Anya::new(&space), i),
                K::Finite(FiniteK::N16) => work(Anya::over(&space, FiniteK::N16).expect("a small k"), i),
                _ => work_of_jumps(&space, k, i),
            };
            PreparedSubgoals::within(&space, k, None, 1000, (&|_| {}, i), &mut *unprepared)
        };
        check_interrupts("a comparison", 100, build, by);
        let built = |i: &Interrupt| build(i).expect("a graph or nothing").to_bytes();
        assert!(built(&Interrupt::NEVER) == built(&Interrupt::new().deadline(|| false)), "k = {k}");
    }
}
