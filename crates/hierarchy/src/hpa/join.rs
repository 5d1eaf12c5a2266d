//! The costs between the nodes of a cluster of an upper level, from those within the clusters below.
//!
//! Two clusters side by side become one: the costs between the nodes along their common border are closed
//! over paths that cross it any number of times, and every other path is one to the border, one along it, and
//! one from it. So two clusters make a half, and two halves the cluster above. A search from each node would
//! find the same costs, many times more slowly.

use super::{
    fixed_cost::FixedCost,
    level::{Bounds, Cluster, Level},
};

/// One or several clusters of a level: some of their nodes, and the costs between these within them.
///
/// Costs are in units of 2⁻¹⁶ cells. Integers of this size are exact as `f64`, whose sums and minima are
/// single instructions on every machine, and whose infinity needs no care.
pub(crate) struct Part {
    bounds: Bounds,
    /// The numbers of the nodes, in ascending order.
    ids: Vec<u32>,
    /// Row by row.
    costs: Vec<f64>,
}

/// The cost of the step across a border.
const STEP: f64 = 65_536.0;

impl Part {
    /// A cluster.
    pub(crate) fn cluster(level: &Level, cluster: u32, bounds: Bounds) -> Self {
        let Cluster { first, count, costs } = level.cluster(cluster);
        let costs = costs.iter().map(|cost| cost.to_bits());
        Self {
            bounds,
            ids: (*first..first + count).collect(),
            costs: costs.map(|cost| if cost == u32::MAX { f64::INFINITY } else { f64::from(cost) }).collect(),
        }
    }

    /// The costs, as an index stores them.
    pub(crate) fn fixed_costs(&self) -> impl Iterator<Item = FixedCost> {
        // The largest number means that there is no path. The low bits of 2⁵² + n are those of n.
        let bits = |cost: f64| (cost.min(f64::from(u32::MAX)) + (1_u64 << 52) as f64).to_bits();
        self.costs.iter().map(move |&cost| FixedCost::from_bits(bits(cost) as u32))
    }

    fn row(&self, node: usize) -> &[f64] {
        &self.costs[node * self.ids.len()..][..self.ids.len()]
    }

    /// Two parts side by side as one, with those nodes from which a step leads out of both. The nodes of the
    /// other one must have the higher numbers.
    pub(crate) fn joined(&self, other: &Self, level: &Level) -> Self {
        let bounds = self.bounds.around(other.bounds);
        let at = |id: u32| level.node(id).at();
        let across = |id: u32| level.node(id).across();
        // The steps from this part to the other one.
        let border: Vec<(usize, usize)> = (0..)
            .zip(&self.ids)
            .flat_map(|(here, &id)| across(id).map(move |there| (here, there)))
            .filter(|&(_, there)| other.bounds.contains(at(there)))
            .filter_map(|(here, there)| Some((here, other.ids.binary_search(&there).ok()?)))
            .collect();
        let leads_out = |&(_, &id): &(usize, &u32)| across(id).any(|there| !bounds.contains(at(there)));
        let [kept, kept_of_other] =
            [self, other].map(|part| (0..).zip(&part.ids).filter(leads_out).collect::<Vec<_>>());
        let count = kept.len() + kept_of_other.len();
        let closed = self.closed(other, &border);
        // The cost from the near end of each step to each node, within one part but for that step.
        let mut from_border = Vec::with_capacity(border.len() * count);
        for &(here, there) in &border {
            let (row, row_of_other) = (self.row(here), other.row(there));
            from_border.extend(kept.iter().map(|&(node, _)| row[node]));
            from_border.extend(kept_of_other.iter().map(|&(node, _)| row_of_other[node] + STEP));
        }
        let mut costs = vec![f64::INFINITY; count * count];
        let mut to_border = vec![f64::INFINITY; border.len()];
        for from in 0..count {
            let row = &mut costs[from * count..][..count];
            if let Some(&(node, _)) = kept.get(from) {
                let within = self.row(node);
                row.iter_mut().zip(&kept).for_each(|(cost, &(to, _))| *cost = within[to]);
            } else {
                let (row, within) = (&mut row[kept.len()..], other.row(kept_of_other[from - kept.len()].0));
                row.iter_mut().zip(&kept_of_other).for_each(|(cost, &(to, _))| *cost = within[to]);
            }
            to_border.fill(f64::INFINITY);
            for first in 0..border.len() {
                let along = &closed[first * border.len()..][..border.len()];
                relax(&mut to_border, from_border[first * count + from], along);
            }
            for (last, &to_it) in to_border.iter().enumerate().filter(|&(_, &cost)| cost < f64::INFINITY) {
                relax(
                    &mut costs[from * count..][from..count],
                    to_it,
                    &from_border[last * count..][from..count],
                );
            }
        }
        // Costs hold in both directions.
        for from in 0..count {
            for to in 0..from {
                costs[from * count + to] = costs[to * count + from];
            }
        }
        let ids = kept.iter().chain(&kept_of_other).map(|&(_, &id)| id).collect();
        Self { bounds, ids, costs }
    }

    /// The costs between the near ends of the steps across a border, within both parts, row by row.
    fn closed(&self, other: &Self, border: &[(usize, usize)]) -> Vec<f64> {
        let count = border.len();
        let mut costs = Vec::with_capacity(count * count);
        for &(here, there) in border {
            let (row, row_of_other) = (self.row(here), other.row(there));
            costs.extend(border.iter().map(|&(to, far)| row[to].min(row_of_other[far] + 2.0 * STEP)));
        }
        let mut through = vec![0.0; count];
        for by in 0..count {
            through.copy_from_slice(&costs[by * count..][..count]);
            for row in costs.chunks_exact_mut(count) {
                let to_it = row[by];
                relax(row, to_it, &through);
            }
        }
        costs
    }
}

/// Lowers each cost to `first` + `rest`, if that is less.
#[inline]
fn relax(costs: &mut [f64], first: f64, rest: &[f64]) {
    for (cost, rest) in costs.iter_mut().zip(rest) {
        let found = first + rest;
        *cost = if found < *cost { found } else { *cost };
    }
}
