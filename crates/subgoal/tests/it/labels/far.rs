//! Maps as long as they may be: edges that 16 bits just hold, bends that rounding hardly tells.

use mediant_grid::{Corners, FreeSpace, Grid, Vertex};
use mediant_moves::{Cost, K};
use mediant_oracle::{Rng, on_all_cores, rooms, seeds, wide_grid};
use mediant_search::{Ends, Planner, parts::Metric};
use mediant_subgoal::{Hierarchy, HubLabelSearch, SubgoalAStar};

use super::exact::is_equal;
use crate::common::{GAPS, graph, k, labels, length, levels, space};

/// The distances between the subgoals and some ends, by lines of sight alone.
struct Sight<'s> {
    space: &'s FreeSpace<Corners>,
    metric: Metric,
    subgoals: Vec<Vertex>,
    between: Vec<Vec<Option<Cost>>>,
}

impl<'s> Sight<'s> {
    fn new(space: &'s FreeSpace<Corners>, k: K) -> Self {
        let subgoals: Vec<Vertex> = graph(space, k, levels(1)).vertices().collect();
        let metric = Metric::new(k).expect("a small k");
        let edge = |a: Vertex, b: Vertex| space.sees(a, b).then(|| metric.distance(a.to(b)));
        let mut between: Vec<Vec<Option<Cost>>> =
            subgoals.iter().map(|&a| subgoals.iter().map(|&b| edge(a, b)).collect()).collect();
        // Floyd and Warshall.
        for over in 0..subgoals.len() {
            for from in 0..subgoals.len() {
                let Some(first) = between[from][over] else { continue };
                let rest = between[over].clone();
                for (known, second) in between[from].iter_mut().zip(rest) {
                    let sum = second.map(|second| first + second);
                    *known = known.iter().copied().chain(sum).min();
                }
            }
        }
        Self { space, metric, subgoals, between }
    }

    fn edges(&self, end: Vertex) -> Vec<Option<Cost>> {
        let edge = |&at: &Vertex| {
            let is_free = self.space.may_turn(None, end, Some(at)) && self.space.sees(end, at);
            is_free.then(|| self.metric.distance(end.to(at)))
        };
        self.subgoals.iter().map(edge).collect()
    }

    /// The distance between two ends, given their edges.
    fn distance(&self, [start, goal]: [Vertex; 2], [from, to]: [&[Option<Cost>]; 2]) -> Option<Cost> {
        let (space, metric) = (self.space, &self.metric);
        let may_end = space.may_turn(None, start, Some(goal)) && space.may_turn(Some(start), goal, None);
        let direct =
            (start == goal || may_end && space.sees(start, goal)).then(|| metric.distance(start.to(goal)));
        let over = from.iter().zip(&self.between).flat_map(|(&first, row)| {
            let sum =
                move |(&between, &last): (&Option<Cost>, &Option<Cost>)| Some(first? + between? + last?);
            row.iter().zip(to).filter_map(sum)
        });
        over.chain(direct).min()
    }
}

/// Compares all pairs of some ends. Returns how many paths bend.
fn check(space: &FreeSpace<Corners>, k: K, ends: &[Vertex], case: &str) -> usize {
    let (sight, labels) = (Sight::new(space, k), labels(space, k));
    let mut planner = HubLabelSearch::new(space, &labels).expect("the labels are for this space");
    let edges: Vec<_> = ends.iter().map(|&end| sight.edges(end)).collect();
    let mut bent = 0;
    for (&start, from) in ends.iter().zip(&edges) {
        for (&goal, to) in ends.iter().zip(&edges) {
            let case = || format!("{case}, k = {k}, from {start} to {goal}");
            let expected = sight.distance([start, goal], [from, to]);
            let distance = planner.cost(Ends::new(start, goal)).expect("both ends are free");
            let is_right = distance.zip(expected).map_or(distance == expected, |(a, b)| is_equal(k, a, b));
            assert!(is_right, "{distance:?}, reference {expected:?}; {}", case());
            let answer = planner.solve(Ends::new(start, goal)).expect("both ends are free");
            let way = answer.path().map(mediant_search::Path::waypoints);
            let cost = way.map(|way| length(k, way));
            let is_right = cost.zip(expected).map_or(cost == expected, |(a, b)| is_equal(k, a, b));
            assert!(is_right, "the path costs {cost:?}, reference {expected:?}; {}", case());
            for line in way.unwrap_or(&[]).windows(2) {
                assert!(space.sees(line[0], line[1]), "{way:?}; {}", case());
            }
            bent += way.map_or(0, |way| way.len().saturating_sub(2));
        }
    }
    bent
}

/// Some free vertices: some subgoals, their neighbors, corners of the map and any others.
fn ends(space: &FreeSpace<Corners>, rng: &mut Rng) -> Vec<Vertex> {
    let (width, height) = (space.grid().width(), space.grid().height());
    let subgoals: Vec<Vertex> = graph(space, K::Any, levels(1)).vertices().collect();
    let mut ends: Vec<Vertex> = (0..5).filter_map(|_| rng.pick(&subgoals).copied()).collect();
    let near: Vec<Vertex> = ends.iter().map(|at| Vertex::new(at.x + 1, at.y)).collect();
    ends.extend(near);
    let any = |_| Vertex::new(rng.below(width + 1) as i32, rng.below(height + 1) as i32);
    ends.extend((0..8).map(any));
    ends.extend(
        [(0, 0), (width as i32, height as i32), (width as i32, 0), (0, height as i32)].map(Vertex::from),
    );
    ends.retain(|&at| space.is_free(at));
    ends
}

/// A map with single blocked cells, most of them in pairs with nearly the same direction.
fn sparse(rng: &mut Rng, width: u32, height: u32, count: u32) -> Grid {
    let mut blocked = std::collections::BTreeSet::new();
    for _ in 0..count {
        let (x, y) = (rng.below(width), rng.below(height));
        blocked.insert((x, y));
        if rng.chance(30) {
            blocked.insert((rng.below(width), y));
        }
        if rng.chance(20) {
            blocked.extend((x..(x + rng.below(width)).min(width)).map(|x| (x, y)).take(2000));
        }
    }
    Grid::from_fn(width, height, |x, y| blocked.contains(&(x, y))).expect("the sides are in range")
}

/// A map with blocked cells on both sides of a line, which touch it or nearly do: paths along it hardly bend.
fn along_a_line(rng: &mut Rng, width: u32, height: u32, count: u32) -> Grid {
    let [first, last] = [0, 1].map(|_| i64::from(rng.below(height)));
    let mut blocked = std::collections::BTreeSet::new();
    for _ in 0..count {
        let x = rng.below(width);
        let y = first + (last - first) * i64::from(x) / i64::from(width);
        blocked.extend(u32::try_from(y - 1 + i64::from(rng.below(3))).map(|y| (x, y)));
    }
    Grid::from_fn(width, height, |x, y| blocked.contains(&(x, y))).expect("the sides are in range")
}

#[test]
fn lines_may_be_as_long_as_a_map() {
    let most = Grid::MAX_SIDE;
    let of = |seed: u64| {
        let mut rng = Rng::new(seed ^ 0xFA5);
        let rng = &mut rng;
        let thick = if rng.chance(30) { 40 } else { 7 };
        let [long, short] = [most - rng.below(3), 1 + rng.below(thick)];
        let side = 700 + rng.below(2000);
        let count = rng.below(14);
        let (width, height) = match seed % 4 {
            0 | 1 => (long, short),
            2 => (short, long),
            _ => (side, 100),
        };
        let draw = if (seed / 4).is_multiple_of(2) { sparse } else { along_a_line };
        let space = space::<Corners>(&draw(rng, width, height, count), GAPS[seed as usize % 2]);
        let ends = ends(&space, rng);
        let case = format!("seed {seed}, {width} x {height} cells");
        [k(2), k(3), k(2 + seed as u32 % 7), K::Any]
            .map(|k| check(&space, k, &ends, &case))
            .iter()
            .sum::<usize>()
    };
    let bent: usize = on_all_cores(seeds(8), of).into_iter().sum();
    assert!(bent > 20 * seeds(8).end as usize, "{bent}");
}

/// Obstacles at both ends of an empty corridor: the longest edges that there are.
#[test]
fn corridors_of_the_longest_side_have_labels() {
    let most = Grid::MAX_SIDE;
    for height in 1..=3 {
        let is_end = |x: u32, y: u32| (x == 1 || x == most - 2) && y + 1 < height;
        for turned in [false, true] {
            let (width, height) = if turned { (height, most) } else { (most, height) };
            let grid = Grid::from_fn(width, height, |x, y| if turned { is_end(y, x) } else { is_end(x, y) });
            let space = space::<Corners>(&grid.expect("the sides are in range"), GAPS[0]);
            let (w, h) = (width as i32, height as i32);
            let ends =
                [(0, 0), (w, h), (w, 0), (0, h), (w / 2, 0), (1, 1.min(h)), (w - 1, 0)].map(Vertex::from);
            for k in [k(2), k(3), k(8), K::Any] {
                let bent = check(&space, k, &ends, &format!("{width} x {height} cells"));
                assert!(bent > 0 || width.min(height) == 1, "no bends");
            }
        }
    }
}

/// Maps that are long, not too long for all pairs.
#[test]
fn wide_maps_have_exact_labels() {
    let of = |seed: u64| {
        let space = space::<Corners>(&wide_grid(seed).0, GAPS[seed as usize % 2]);
        let ends = ends(&space, &mut Rng::new(seed));
        let case = format!("wide map of seed {seed}");
        [k(2 + seed as u32 % 7), K::Any].map(|k| check(&space, k, &ends, &case)).iter().sum::<usize>()
    };
    let bent: usize = on_all_cores(seeds(24), of).into_iter().sum();
    assert!(bent > 20 * seeds(24).end as usize, "{bent}");
}

/// Against the contraction hierarchy on a larger map.
#[test]
fn on_large_maps_labels_answer_as_the_hierarchy() {
    let mut rng = Rng::new(11);
    let blocks: Vec<[u32; 4]> =
        (0..300).map(|_| [rng.below(300), rng.below(300), 1 + rng.below(14), 1 + rng.below(14)]).collect();
    let is_in = |x: u32, y: u32| {
        blocks.iter().any(|&[a, b, w, h]| (a..a + w).contains(&x) && (b..b + h).contains(&y))
    };
    let blocks = Grid::from_fn(300, 300, is_in).expect("a valid size");
    for (grid, k) in [(blocks.clone(), K::Any), (blocks, k(3)), (rooms(&mut rng, 150, 150), k(4))] {
        let space = space::<Corners>(&grid, GAPS[1]);
        let (labels, graph) = (labels(&space, k), graph(&space, k, Hierarchy::Contracted));
        assert!(labels.subgoals() > 500, "{}", labels.subgoals());
        let mut ours = HubLabelSearch::new(&space, &labels).expect("the labels are for this space");
        let mut theirs = SubgoalAStar::new(&space, &graph).expect("the graph is for this space");
        let ends: Vec<Vertex> = (0..12).flat_map(|_| ends(&space, &mut rng)).collect();
        for query in ends.iter().zip(ends.iter().skip(7)).map(|(&a, &b)| Ends::new(a, b)) {
            let cost = |answer: mediant_search::Answer| answer.path().map(|path| length(k, path.waypoints()));
            let [own, other] =
                [ours.solve(query), theirs.solve(query)].map(|o| cost(o.expect("both ends are free")));
            assert_eq!(own.is_some(), other.is_some(), "{query:?}");
            assert!(
                own.zip(other).is_none_or(|(a, b)| is_equal(k, a, b)),
                "{own:?}, {other:?}, {query:?}, k = {k}"
            );
        }
    }
}
