//! The costs between the nodes of a cluster of an upper level, from those within the clusters below.
//!
//! Two clusters side by side become one: the costs between the nodes along their common border are closed
//! over paths that cross it any number of times, and every other path is one to the border, one along it, and
//! one from it. So two clusters make a half, and two halves the cluster above. A search from each node would
//! find the same costs, many times more slowly.
//!
//! The work is sums and minima of short rows of numbers. They are taken in eights, which a machine does a few
//! at once, and no join allocates memory.

use mediant_grid::Grid;

use super::{
    fixed_cost::FixedCost,
    level::{ABOVE, BELOW, Bounds, LEFT, Level, RIGHT},
};

/// The costs to several nodes.
///
/// Costs are in units of 2⁻¹⁶ cells. Integers of this size are exact as `f64`, whose sums and minima are
/// single instructions on every machine.
type Lanes = [f64; LANES];

const LANES: usize = 8;

/// There is no path. No sum with it is less.
const NONE: f64 = u32::MAX as f64;

/// The cost of the step across a border.
const STEP: f64 = 65_536.0;

/// One or several clusters of a level: those of their nodes from which a step leads out.
#[derive(Clone, Copy)]
struct Part<'p> {
    /// Of each node, the sides of the part across which a step leads from it.
    sides: &'p [u8],
    /// The costs between the nodes within the part, row by row.
    costs: &'p [FixedCost],
}

/// A part that was made of two.
#[derive(Default)]
struct Joined {
    sides: Vec<u8>,
    costs: Vec<FixedCost>,
}

/// Joins of clusters, with their memory.
#[derive(Default)]
pub(crate) struct Joins {
    /// Of the nodes of two clusters.
    sides: [Vec<u8>; 2],
    halves: [Joined; 2],
    whole: Joined,
    scratch: Scratch,
}

/// The memory of a join.
#[derive(Default)]
struct Scratch {
    /// The steps from one part to the other: the numbers of the nodes at either end.
    border: Vec<(usize, usize)>,
    /// The numbers that the nodes of the joined part had.
    kept: Vec<usize>,
    /// The costs between the near ends of the steps across the border, within both parts, row by row.
    closed: Vec<Lanes>,
    /// By eights of nodes, and then by steps: the costs from the near end of the step to the nodes, within
    /// one part but for that step.
    direct: Vec<Lanes>,
    /// The same by any path, by nodes and then by steps.
    any: Vec<f64>,
    /// The numbers that the nodes of the joined part had in each of the two.
    numbers: [Vec<[usize; LANES]>; 2],
}

impl<'p> Part<'p> {
    fn row(self, node: usize) -> &'p [FixedCost] {
        let count = self.sides.len();
        &self.costs[node * count..][..count]
    }

    /// The nodes from which a step leads across one of these sides.
    fn on(self, sides: u8) -> impl Iterator<Item = usize> {
        (0..).zip(self.sides).filter_map(move |(node, of_node)| (of_node & sides != 0).then_some(node))
    }
}

impl Joined {
    fn part(&self) -> Part<'_> {
        Part { sides: &self.sides, costs: &self.costs }
    }

    fn copy(&mut self, part: Part<'_>) {
        self.sides.clear();
        self.sides.extend_from_slice(part.sides);
        self.costs.clear();
        self.costs.extend_from_slice(part.costs);
    }
}

impl Joins {
    /// The costs between the nodes of a cluster with these bounds, row by row.
    pub(crate) fn find(&mut self, below: &Level, grid: &Grid, bounds: Bounds) -> &[FixedCost] {
        let Self { sides, halves, whole, scratch } = self;
        let mut rows = 0;
        for (half, row) in halves.iter_mut().zip(below.within(bounds)) {
            let mut children = sides.iter_mut().zip(row).map(|(sides, child)| {
                let bounds = below.bounds(child, grid);
                sides.clear();
                sides.extend(below.nodes_of(child).iter().map(|node| below.sides(node, bounds)));
                Part { sides, costs: &below.cluster(child).costs }
            });
            match (children.next(), children.next()) {
                (Some(left), Some(right)) => half.join([left, right], [RIGHT, LEFT], scratch),
                (left, _) => left.into_iter().for_each(|left| half.copy(left)),
            }
            rows += 1;
        }
        if rows < 2 {
            return &halves[0].costs;
        }
        whole.join([halves[0].part(), halves[1].part()], [BELOW, ABOVE], scratch);
        &whole.costs
    }
}

impl Joined {
    /// Makes this one of two parts side by side, with those nodes from which a step leads out of both.
    /// `sides` are those across which steps lead from each part to the other.
    ///
    /// In both parts the nodes along a border come in its order, so that the ends of a step have the same
    /// place among them.
    fn join(&mut self, parts: [Part<'_>; 2], sides: [u8; 2], scratch: &mut Scratch) {
        let Scratch { border, kept, closed, direct, any, numbers } = scratch;
        let [one, other] = parts;
        border.clear();
        border.extend(one.on(sides[0]).zip(other.on(sides[1])));
        kept.clear();
        self.sides.clear();
        let [of_one, count] = [0, 1].map(|part| {
            for node in parts[part].on(!sides[part]) {
                kept.push(node);
                self.sides.push(parts[part].sides[node] & !sides[part]);
            }
            kept.len()
        });
        let (steps, width) = (border.len(), count.div_ceil(LANES));
        close(parts, border, closed);
        // Here and below all is written anew but what fills up eights, which nothing reads.
        direct.resize(width * steps, [NONE; LANES]);
        for (node, &number) in kept.iter().enumerate() {
            let lanes = direct[node / LANES * steps..].iter_mut().map(|lanes| &mut lanes[node % LANES]);
            if node < of_one {
                let row = one.row(number);
                lanes.zip(&*border).for_each(|(cost, &(here, _))| *cost = row[here].to_f64());
            } else {
                let row = other.row(number);
                lanes.zip(&*border).for_each(|(cost, &(_, there))| *cost = row[there].to_f64() + STEP);
            }
        }
        any.resize(width * LANES * steps, NONE);
        for eights in 0..width {
            let direct = &direct[eights * steps..][..steps];
            let any = &mut any[eights * LANES * steps..][..LANES * steps];
            for step in 0..steps {
                let along = closed[step * steps.div_ceil(LANES)..].as_flattened();
                let costs = least([NONE; LANES], along, direct);
                (0..LANES).for_each(|lane| any[lane * steps + step] = costs[lane]);
            }
        }
        // The numbers that nodes had in one part, and nothing for those of the other.
        numbers.iter_mut().zip([0..of_one, of_one..count]).for_each(|(numbers, part)| {
            numbers.clear();
            numbers.resize(width, [usize::MAX; LANES]);
            numbers.as_flattened_mut()[part.clone()].copy_from_slice(&kept[part]);
        });
        self.costs.resize(count * count, FixedCost::NONE);
        for (node, &number) in kept.iter().enumerate() {
            let (part, numbers) = if node < of_one { (one, &numbers[0]) } else { (other, &numbers[1]) };
            let (within, any) = (part.row(number), &any[node * steps..][..steps]);
            let row = &mut self.costs[node * count..][..count];
            let eights = numbers.iter().zip(row.chunks_mut(LANES)).enumerate().skip(node / LANES);
            for (eights, (numbers, costs)) in eights {
                let known = numbers.map(|number| within.get(number).map_or(NONE, |cost| cost.to_f64()));
                let direct = &direct[eights * steps..][..steps];
                let found = least(known, any, direct).map(FixedCost::from_f64);
                if let Some(costs) = costs.first_chunk_mut() {
                    *costs = found;
                } else {
                    costs.iter_mut().zip(found).for_each(|(cost, found)| *cost = found);
                }
            }
        }
        self.mirror(count);
    }

    /// Costs hold in both directions: those from smaller to larger numbers of so many nodes are known.
    fn mirror(&mut self, count: usize) {
        for node in 1..count {
            let (above, row) = self.costs.split_at_mut(node * count);
            let mut place = node;
            for cost in &mut row[..node] {
                *cost = above[place];
                place += count;
            }
        }
    }
}

/// Writes to `closed` the costs between the near ends of the steps across a border, within both parts.
fn close([one, other]: [Part<'_>; 2], border: &[(usize, usize)], closed: &mut Vec<Lanes>) {
    let steps = border.len();
    let width = steps.div_ceil(LANES);
    closed.resize(steps * width, [NONE; LANES]);
    for (step, &(here, there)) in border.iter().enumerate() {
        let (within, beyond) = (one.row(here), other.row(there));
        let row = closed[step * width..][..width].as_flattened_mut();
        for (cost, &(to, far)) in row.iter_mut().zip(border) {
            *cost = within[to].to_f64().min(beyond[far].to_f64() + 2.0 * STEP);
        }
    }
    for by in 0..steps {
        for from in 0..steps {
            let to_it = closed[from * width + by / LANES][by % LANES];
            for eights in 0..width {
                let through = closed[by * width + eights];
                let costs = &mut closed[from * width + eights];
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
            if costs[lane] < found { costs[lane] } else { found }
        })
    })
}
