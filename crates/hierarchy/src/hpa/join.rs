//! The costs between the nodes of a cluster of an upper level, from those within the clusters below.
//!
//! Two clusters side by side become one: the costs between the nodes along their common border are closed
//! over paths that cross it any number of times, and every other path is one to the border, one along it, and
//! one from it. So two clusters make a half, and two halves the cluster above. A search from each node would
//! find the same costs, many times more slowly.
//!
//! The work is sums and minima of short rows of numbers. They are kept in fours, which a machine adds and
//! compares at once, and no join allocates memory.

use mediant_grid::Grid;

use super::{
    fixed_cost::FixedCost,
    level::{ABOVE, BELOW, Bounds, Cluster, LEFT, Level, RIGHT},
};

/// The costs to several nodes.
///
/// Costs are in units of 2⁻¹⁶ cells. Integers of this size are exact as `f64`, whose sums and minima are
/// single instructions on every machine.
type Lanes = [f64; LANES];

const LANES: usize = 4;

/// There is no path. No sum with it is less, and none is rounded to less.
const NONE: f64 = u32::MAX as f64;

/// The cost of the step across a border.
const STEP: f64 = 65_536.0;

/// One or several clusters of a level: those of their nodes from which a step leads out, and the costs
/// between these within them.
#[derive(Default)]
struct Part {
    /// Of each node, the sides of the part across which a step leads from it.
    sides: Vec<u8>,
    /// Row by row. Each row ends with its last four.
    costs: Vec<Lanes>,
}

/// Joins of parts, with their memory.
#[derive(Default)]
pub(crate) struct Joins {
    /// Parts that are no longer needed.
    spare: Vec<Part>,
    /// The steps from one part to the other: the numbers of the nodes at either end.
    border: Vec<(usize, usize)>,
    /// The numbers that the nodes of the joined part had.
    kept: Vec<usize>,
    /// The costs between the near ends of the steps across the border, within both parts, row by row.
    closed: Vec<Lanes>,
    /// By fours of nodes, and then by steps: the costs from the near end of the step to the nodes, within one
    /// part but for that step.
    direct: Vec<Lanes>,
    /// The same by any path.
    any: Vec<Lanes>,
    /// The costs from one node to the steps.
    to_border: Vec<f64>,
}

impl Part {
    fn count(&self) -> usize {
        self.sides.len()
    }

    fn row(&self, node: usize) -> &[f64] {
        let width = self.count().div_ceil(LANES);
        self.costs[node * width..][..width].as_flattened()
    }

    /// The nodes from which a step leads across a side.
    fn on(&self, side: u8) -> impl Iterator<Item = usize> {
        (0..).zip(&self.sides).filter_map(move |(node, sides)| (sides & side != 0).then_some(node))
    }
}

impl Joins {
    /// Writes to `costs` those between the nodes of a cluster with these bounds, row by row.
    pub(crate) fn find(&mut self, below: &Level, grid: &Grid, bounds: Bounds, costs: &mut Vec<FixedCost>) {
        let mut whole: Option<Part> = None;
        for row in below.within(bounds) {
            let mut half: Option<Part> = None;
            for child in row {
                let part = self.cluster(below, child, below.bounds(child, grid));
                half = Some(match half {
                    Some(left) => self.joined([left, part], [RIGHT, LEFT]),
                    None => part,
                });
            }
            whole = match (whole, half) {
                (Some(upper), Some(lower)) => Some(self.joined([upper, lower], [BELOW, ABOVE])),
                (upper, lower) => upper.or(lower),
            };
        }
        costs.clear();
        let Some(whole) = whole else { return };
        // The low bits of 2⁵² + n are those of n.
        let bits = |cost: f64| (cost.min(NONE) + (1_u64 << 52) as f64).to_bits();
        for node in 0..whole.count() {
            let row = &whole.row(node)[..whole.count()];
            costs.extend(row.iter().map(|&cost| FixedCost::from_bits(bits(cost) as u32)));
        }
        self.spare.push(whole);
    }

    /// A cluster.
    fn cluster(&mut self, level: &Level, cluster: u32, bounds: Bounds) -> Part {
        let mut part = self.spare.pop().unwrap_or_default();
        let Cluster { count, costs, .. } = level.cluster(cluster);
        part.sides.clear();
        part.sides.extend(level.nodes_of(cluster).iter().map(|node| level.sides(node, bounds)));
        let count = *count as usize;
        let width = count.div_ceil(LANES);
        part.costs.clear();
        part.costs.resize(count * width, [NONE; LANES]);
        for node in 0..count {
            let row = part.costs[node * width..][..width].as_flattened_mut();
            for (cost, known) in row.iter_mut().zip(&costs[node * count..][..count]) {
                *cost = f64::from(known.to_bits());
            }
        }
        part
    }

    /// Two parts side by side as one, with those nodes from which a step leads out of both. `sides` are those
    /// across which steps lead from each part to the other.
    ///
    /// In both parts the nodes along a border come in its order, so that the ends of a step have the same
    /// place among them.
    fn joined(&mut self, [one, other]: [Part; 2], sides: [u8; 2]) -> Part {
        let mut joined = self.spare.pop().unwrap_or_default();
        let Self { border, kept, closed, direct, any, to_border, .. } = self;
        border.clear();
        border.extend(one.on(sides[0]).zip(other.on(sides[1])));
        kept.clear();
        joined.sides.clear();
        let mut of_one = 0;
        for (part, side) in [(&one, sides[0]), (&other, sides[1])] {
            // When the second part begins, the first is done.
            of_one = kept.len();
            for node in part.on(!side) {
                kept.push(node);
                joined.sides.push(part.sides[node] & !side);
            }
        }
        let (count, steps) = (kept.len(), border.len());
        let width = count.div_ceil(LANES);
        close([&one, &other], border, closed);
        direct.clear();
        direct.resize(width * steps, [NONE; LANES]);
        for (node, &number) in kept.iter().enumerate() {
            let lanes =
                direct[node / LANES * steps..][..steps].iter_mut().map(|lanes| &mut lanes[node % LANES]);
            if node < of_one {
                let row = one.row(number);
                lanes.zip(&*border).for_each(|(cost, &(here, _))| *cost = row[here]);
            } else {
                let row = other.row(number);
                lanes.zip(&*border).for_each(|(cost, &(_, there))| *cost = row[there] + STEP);
            }
        }
        any.clear();
        for nodes in 0..width {
            let direct = &direct[nodes * steps..][..steps];
            let along = closed.chunks_exact(steps.div_ceil(LANES).max(1));
            any.extend(along.map(|along| least([NONE; LANES], along.as_flattened(), direct)));
        }
        joined.costs.clear();
        joined.costs.resize(count * width, [NONE; LANES]);
        for (node, row) in joined.costs.chunks_exact_mut(width.max(1)).enumerate() {
            // The costs within one part.
            let (part, end) = if node < of_one { (&one, of_one) } else { (&other, count) };
            let within = part.row(kept[node]);
            for (cost, &to) in row.as_flattened_mut()[..end].iter_mut().zip(&*kept).skip(node) {
                *cost = within[to];
            }
            to_border.clear();
            to_border.extend(any[node / LANES * steps..][..steps].iter().map(|lanes| lanes[node % LANES]));
            for (nodes, costs) in row.iter_mut().enumerate().skip(node / LANES) {
                *costs = least(*costs, to_border, &direct[nodes * steps..][..steps]);
            }
        }
        // Costs hold in both directions.
        let (costs, width) = (joined.costs.as_flattened_mut(), width * LANES);
        for from in 1..count {
            for to in 0..from {
                costs[from * width + to] = costs[to * width + from];
            }
        }
        self.spare.extend([one, other]);
        joined
    }
}

/// Writes to `closed` the costs between the near ends of the steps across a border, within both parts.
fn close([one, other]: [&Part; 2], border: &[(usize, usize)], closed: &mut Vec<Lanes>) {
    let steps = border.len();
    let width = steps.div_ceil(LANES);
    closed.clear();
    closed.resize(steps * width, [NONE; LANES]);
    for (&(here, there), row) in border.iter().zip(closed.chunks_exact_mut(width.max(1))) {
        let (within, beyond) = (one.row(here), other.row(there));
        for (cost, &(to, far)) in row.as_flattened_mut().iter_mut().zip(border) {
            *cost = within[to].min(beyond[far] + 2.0 * STEP);
        }
    }
    for by in 0..steps {
        for from in (0..steps).filter(|&from| from != by) {
            let to_it = closed[from * width + by / LANES][by % LANES];
            for lanes in 0..width {
                let through = closed[by * width + lanes];
                let costs = &mut closed[from * width + lanes];
                *costs = least(*costs, &[to_it], &[through]);
            }
        }
    }
}

/// The least of `costs` and of the sums of one of `first` and of what follows it.
#[inline]
fn least(costs: Lanes, first: &[f64], rest: &[Lanes]) -> Lanes {
    first.iter().zip(rest).fold(costs, |costs, (first, rest)| {
        std::array::from_fn(|lane| {
            let found = first + rest[lane];
            if found < costs[lane] { found } else { costs[lane] }
        })
    })
}
