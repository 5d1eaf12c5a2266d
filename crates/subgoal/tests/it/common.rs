//! Helpers of several suites.
#![allow(dead_code, reason = "each test program uses a part")]

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{DiagonalGap, FreeSpace, Grid, Identity, Placement};
use mediant_moves::{FiniteK, K};
use mediant_subgoal::{Hierarchy, SubgoalGraph, SubgoalPlacement};

pub(crate) const GAPS: [DiagonalGap; 2] = [DiagonalGap::Open, DiagonalGap::Closed];

/// Every hierarchy: contracted, and of one level, two, three and all.
pub(crate) const HIERARCHIES: [Hierarchy; 5] =
    [Hierarchy::Contracted, levels(1), levels(2), levels(3), Hierarchy::AllLevels];

pub(crate) const fn levels(count: u32) -> Hierarchy {
    Hierarchy::Levels(NonZeroU32::new(count).expect("there is a level at least"))
}

pub(crate) fn k(number: u32) -> K {
    FiniteK::new(number).expect("k is at least 2").into()
}

/// k = 2, …, 8, and any angle.
pub(crate) fn all_ks() -> impl Iterator<Item = K> {
    (2..=8).map(k).chain([K::Any])
}

pub(crate) fn space<P: Placement>(grid: &Grid, rule: P::Rule) -> FreeSpace<P> {
    FreeSpace::new(Arc::new(grid.clone()), rule)
}

/// The identity of a graph of this space.
pub(crate) fn identity<P: Placement>(space: &FreeSpace<P>, k: K) -> Identity {
    Identity { k: Some(k), ..space.identity() }
}

pub(crate) fn graph<P: SubgoalPlacement>(
    space: &FreeSpace<P>,
    k: K,
    hierarchy: Hierarchy,
) -> SubgoalGraph<P> {
    SubgoalGraph::new(space, k, hierarchy).expect("there is a graph for this k")
}
