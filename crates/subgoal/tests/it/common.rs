//! Helpers of several suites.
#![allow(dead_code, reason = "each test program uses a part")]

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{
    DiagonalGap, FreeSpace, Grid, GridGraph, Identity, Interrupt, Interrupted, Placement, Vertex,
};
use mediant_moves::{Cost, FiniteK, K};
use mediant_search::{
    BlockJps, Counters, Ends, Hk, Planner,
    parts::{Metric, count_work},
};
use mediant_subgoal::{Hierarchy, HubLabels, SubgoalGraph, SubgoalPlacement};

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

/// Hub labels, however much memory they take.
pub(crate) fn labels<P: SubgoalPlacement>(space: &FreeSpace<P>, k: K) -> HubLabels<P> {
    HubLabels::within(space, k, usize::MAX, &|_| {}, &Interrupt::NEVER).expect("there are labels for this k")
}

/// The same labels with labels of vertices besides, for half of the vertices or for all.
pub(crate) fn with_vertices<P: SubgoalPlacement>(
    labels: &HubLabels<P>,
    space: &FreeSpace<P>,
    is_half: bool,
) -> HubLabels<P> {
    let within = |most: usize| {
        let labels = labels.clone().with_vertices(space, most, &|_| {}, &Interrupt::NEVER);
        labels.expect("they are of this space")
    };
    let (all, without) = (within(usize::MAX), labels.memory_bytes());
    if is_half { within(without + (all.memory_bytes() - without) / 2) } else { all }
}

/// The work of a query, by an engine that prepares nothing.
pub(crate) type Work<'i> = Box<dyn FnMut(Ends) -> Result<Option<Counters>, Interrupted> + 'i>;

/// The work of a planner.
pub(crate) fn work<'i>(mut planner: impl Planner + 'i, interrupt: &'i Interrupt) -> Work<'i> {
    Box::new(move |query| Ok(count_work(&mut planner, query, interrupt)?.ok()))
}

/// The work of block-based JPS up to k = 3; none beyond.
pub(crate) fn work_of_jumps<'i, P: Placement>(
    space: &FreeSpace<P>,
    k: K,
    interrupt: &'i Interrupt,
) -> Work<'i> {
    let graph = k.finite().and_then(|k| GridGraph::in_space(space, k).ok());
    match graph.and_then(|graph| BlockJps::new(Arc::new(graph), Hk).ok()) {
        Some(jps) => work(jps, interrupt),
        None => Box::new(|_| Ok(None)),
    }
}

/// The length of a path whose straight parts are free, in fixed point.
pub(crate) fn length(k: K, waypoints: &[Vertex]) -> Cost {
    let metric = Metric::new(k).expect("a small k");
    waypoints.windows(2).fold(Cost::ZERO, |sum, part| sum + metric.distance(part[0].to(part[1])))
}

/// The bytes with the checksum that they should have, as `labels/codec.rs` says.
pub(crate) fn with_checksum(mut bytes: Vec<u8>) -> Vec<u8> {
    let step = |sum: u64, word: u64| (sum ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29);
    let word = |bytes: &[u8]| {
        let mut word = [0; 8];
        word[..bytes.len()].copy_from_slice(bytes);
        u64::from_le_bytes(word)
    };
    let whole = bytes.len() / 32 * 32;
    let mut sums = [1_u64, 2, 3, 4];
    for (place, part) in bytes[..whole].chunks(8).enumerate() {
        sums[place % 4] = step(sums[place % 4], word(part));
    }
    let mut sum = sums.into_iter().fold(bytes.len() as u64, step);
    sum = bytes[whole..].chunks(8).fold(sum, |sum, part| step(sum, word(part)));
    bytes.extend(step(sum, sum >> 32).to_le_bytes());
    bytes
}
