//! The two states of a closed gap.
//!
//! A path that enters a closed gap by one of its two free quadrants leaves it by the same. Where all cells
//! cost the same, no shortest path from k = 3 on touches a gap except with its ends. Where costs differ, one
//! may: the way around the corner, in the same quadrant, may lead over dearer cells. So a gap is two states:
//! its position is that of the lower quadrant, a number beyond all positions that of the upper one. A path
//! ends at a gap only in the quadrant of the vertex's own cell.

use std::sync::Arc;

use mediant_moves::Vector;

use crate::{layout::Steps, surface::CostSurface};

/// The closed gaps of a map.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gaps {
    /// Their positions, in increasing order.
    positions: Arc<[u32]>,
    /// The number of positions of the map.
    len: usize,
}

impl Gaps {
    /// All gaps of a map.
    pub(crate) fn of(map: &CostSurface, steps: &Steps) -> Self {
        let (layout, weights) = (map.layout(), map.weights());
        let corners = (0..=map.height() as i32).flat_map(|y| (0..=map.width() as i32).map(move |x| (x, y)));
        let gaps = corners.map(|(x, y)| layout.position(x, y)).filter(|&at| is_gap(weights, steps, at));
        let mut positions: Vec<u32> = gaps.map(|at| at as u32).collect();
        positions.sort_unstable();
        Self { positions: positions.into(), len: layout.len() }
    }

    /// The gaps after these cells of the map changed: only their corners are looked at.
    pub(crate) fn after(&self, map: &CostSurface, steps: &Steps, cells: &[(u32, u32)]) -> Self {
        let (layout, weights) = (map.layout(), map.weights());
        let corner = |&(x, y): &(u32, u32), (dx, dy)| layout.position(x as i32 + dx, y as i32 + dy) as u32;
        let corners = [(0, 0), (1, 0), (0, 1), (1, 1)];
        let mut looked_at: Vec<u32> =
            cells.iter().flat_map(|cell| corners.map(|by| corner(cell, by))).collect();
        looked_at.sort_unstable();
        looked_at.dedup();
        let is_known = |at: u32| self.positions.binary_search(&at).is_ok();
        let is_now = |at: u32| is_gap(weights, steps, at as usize);
        if looked_at.iter().all(|&at| is_known(at) == is_now(at)) {
            return self.clone();
        }
        let kept = self.positions.iter().copied().filter(|at| looked_at.binary_search(at).is_err());
        let mut positions: Vec<u32> =
            kept.chain(looked_at.iter().copied().filter(|&at| is_now(at))).collect();
        positions.sort_unstable();
        Self { positions: positions.into(), ..*self }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// The number of states beyond the positions.
    pub(crate) fn len(&self) -> usize {
        self.positions.len()
    }

    pub(crate) fn positions(&self) -> impl Iterator<Item = usize> {
        self.positions.iter().map(|&at| at as usize)
    }

    /// The number of a gap; `None` at other positions.
    fn number(&self, at: usize) -> Option<usize> {
        self.positions.binary_search(&(at as u32)).ok()
    }

    /// The upper state of a gap; `None` at other positions.
    pub(crate) fn upper(&self, at: usize) -> Option<usize> {
        if self.is_empty() { None } else { Some(self.len + self.number(at)?) }
    }

    /// Whether both have the same states.
    pub(crate) fn is_same_as(&self, other: &Self) -> bool {
        self.positions == other.positions
    }

    /// The position of a state.
    #[inline]
    pub(crate) fn position(&self, state: usize) -> usize {
        match state.checked_sub(self.len) {
            Some(gap) if !self.is_empty() => self.positions.get(gap).map_or(state, |&at| at as usize),
            _ => state,
        }
    }

    /// The quadrant of a state at a gap: whether it is the lower one. `None` for other states.
    pub(crate) fn quadrant(&self, state: usize) -> Option<bool> {
        if self.is_empty() {
            return None;
        }
        if state >= self.len {
            return Some(false);
        }
        self.number(state).map(|_| true)
    }

    /// The state at a position of a path that leads from there, or comes from there, by a vector.
    #[inline]
    pub(crate) fn state(&self, weights: &[u32], at: usize, v: Vector) -> usize {
        if self.is_empty() {
            return at;
        }
        match self.number(at) {
            Some(gap) if !is_lower(weights, at, v) => self.len + gap,
            _ => at,
        }
    }

    /// The state in which a path may end at a position; `None` at a gap whose own cell is blocked.
    pub(crate) fn end(&self, weights: &[u32], at: usize) -> Option<usize> {
        (self.is_empty() || self.number(at).is_none() || weights[at] > 0).then_some(at)
    }
}

/// Whether two blocked cells meet diagonally at a corner, while the two others are free.
fn is_gap(weights: &[u32], steps: &Steps, at: usize) -> bool {
    let from = steps.from(at);
    let free = |dx, dy| weights[from.to(dx, dy)] > 0;
    let (own, opposite) = (free(0, 0), free(-1, -1));
    own == opposite && free(-1, 0) != own && free(0, -1) != own
}

/// Whether a vector from a gap lies in the lower one of its two free quadrants.
pub(crate) const fn is_lower(weights: &[u32], gap: usize, v: Vector) -> bool {
    v.y > 0 || v.y == 0 && (weights[gap] > 0) == (v.x > 0)
}
