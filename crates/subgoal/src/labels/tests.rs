//! The labels themselves: what every pair of subgoals shares, and where each label leads.

use mediant_grid::{
    Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, Interrupt, Vertex, uninterrupted,
};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{Explicit, Rng, describe, on_all_cores, random_grid, seeds};

use super::{
    HubLabels,
    build::whole_labels,
    join::Join,
    lists::{Form, LabelLists},
    merge::Label,
    whole::keep_whole,
};
use crate::{
    arc::NONE,
    build::Ground,
    contract::{ContractedGraph, OverlayArc, SubgoalGeometry},
    hierarchy::Hierarchy,
    placement::{BuildContext, EdgeCriterion, SubgoalPlacement},
};

/// The length that a query reads from a label: the cost over N(k), or of the line.
fn length(k: K, criterion_is_taut: bool, cost: u128) -> f64 {
    match (criterion_is_taut, k) {
        (false, _) => cost as f64 / 2_f64.powi(32),
        (true, K::Any) => cost as f64 / 2_f64.powi(64),
        (true, K::Finite(_)) => (cost >> 64) as f64 / 2_f64.powi(32),
    }
}

/// The numbers of pairs with a path, of those whose labels are exact, and of labels.
type Counts = [usize; 3];

/// The labels of a subgoal, as they are listed.
fn all_of(labels: &LabelLists, id: u32) -> Vec<Label> {
    let own = labels.of(id);
    (0..own.words[0].len()).map(|number| own.get(number)).collect()
}

/// These labels, in the order in which they are given.
fn listed(labels: &[Vec<Label>]) -> LabelLists {
    let mut lists = LabelLists::new(labels.len(), Form::new(labels.len(), 0));
    for (own, id) in labels.iter().zip(0..) {
        let words = own.iter().map(|&label| lists.form.words(label).expect("their costs fit"));
        let (kept, rest): (Vec<_>, Vec<_>) = words.map(|[kept, rest]| (kept, rest)).unzip();
        lists.add(id, [&kept, &rest]);
    }
    lists
}

struct Merged<'t, P: SubgoalPlacement> {
    space: &'t FreeSpace<P>,
    ground: Ground<P>,
    contracted: ContractedGraph,
    labels: Vec<Vec<Label>>,
    k: K,
    seed: u64,
}

impl<'t, P: SubgoalPlacement> Merged<'t, P> {
    fn new(space: &'t FreeSpace<P>, k: K, seed: u64) -> Self {
        let never = &Interrupt::NEVER;
        let ground = Ground::new(space, k, Hierarchy::Contracted, never).expect("there is a graph");
        let contracted =
            uninterrupted(|never| ground.contracted(space, Hierarchy::Contracted, &|_| {}, never));
        let labels = whole_labels(ground.context(space), &contracted, usize::MAX, &mut |_| {}, never);
        let labels = labels.expect("their costs fit").expect("there is no core");
        let labels = (0..labels.len() as u32).map(|id| {
            let mut own = all_of(&labels, id);
            assert!(own.is_sorted_by_key(|label| labels.form.kept(label.cost())), "not sorted: {own:?}");
            own.sort_by_key(|label| label.hub);
            own
        });
        let labels = labels.collect();
        Self { space, ground, contracted, labels, k, seed }
    }

    fn is_taut(&self) -> bool {
        self.ground.criterion == EdgeCriterion::Taut
    }

    fn of(&self, id: u32, hub: u32) -> Option<&Label> {
        self.labels[id as usize].iter().find(|label| label.hub == hub)
    }

    fn vertex(&self, id: u32) -> Vertex {
        self.ground.subgoals.vertex(id)
    }

    fn case(&self, a: u32, b: u32) -> String {
        let map = describe(self.space.grid(), self.space.rules(), self.vertex(a), self.vertex(b), self.seed);
        format!("k = {}; {map}", self.k)
    }

    /// Each label leads to its hub, edge by edge, and costs what these edges cost.
    fn check_paths(&self) -> usize {
        let context = self.ground.context(self.space);
        for (own, id) in self.labels.iter().zip(0..) {
            assert!(
                own.windows(2).all(|two| two[0].hub < two[1].hub),
                "a hub comes twice: {}",
                self.case(id, id)
            );
            for label in own {
                let case = || format!("{label:?}; {}", self.case(id, label.hub));
                assert_ne!(label.hub, id, "{}", case());
                let (mut at, mut rest, mut sum) = (id, label.cost() + 1, 0);
                while at != label.hub {
                    let next = self.of(at, label.hub).unwrap_or_else(|| panic!("at {at}: {}", case()));
                    assert!(next.cost() < rest, "{next:?} at {at}: {}", case());
                    let edge = self.arc_cost(context, at, next.next);
                    (rest, sum, at) = (next.cost(), sum + edge, next.next);
                }
                assert!(sum <= label.cost(), "{sum}: {}", case());
            }
        }
        self.labels.iter().map(Vec::len).sum()
    }

    /// The cost of an edge of the graph, which must exist.
    fn arc_cost(&self, context: BuildContext<'_, P>, a: u32, b: u32) -> u128 {
        let arcs = |from: u32, to: u32| {
            let is_edge = move |arc: &&OverlayArc| arc.to == to && arc.middle == NONE;
            self.contracted.arcs[from as usize].iter().find(is_edge).map(|arc| arc.cost)
        };
        let stored = arcs(a, b).or_else(|| arcs(b, a));
        // A better shortcut may have taken the place of an edge.
        let sees = self.space.sees(self.vertex(a), self.vertex(b));
        assert!(stored.is_some() || sees, "no edge: {}", self.case(a, b));
        let distance = context.distance(a, b);
        assert!(stored.is_none_or(|stored| stored == distance), "{}", self.case(a, b));
        distance
    }

    /// The least sum over a common hub is never less than the distance; it is the distance where a shortest
    /// path between the two can be part of a longer one.
    fn check_pairs(&self) -> Counts {
        let count = self.labels.len() as u32;
        let explicit = Explicit::new(self.space.grid(), self.space.rules(), self.k.finite());
        let mut counts = [0, 0, self.check_paths()];
        for a in 0..count {
            let costs = explicit.costs_from(self.vertex(a));
            for b in 0..count {
                let own = |id: u32| {
                    let itself = Label::new(id, id, 0);
                    self.labels[id as usize].iter().copied().chain([itself]).collect::<Vec<_>>()
                };
                let others = own(b);
                let common = own(a).into_iter().flat_map(|one| {
                    others
                        .iter()
                        .filter(move |other| other.hub == one.hub)
                        .map(move |other| one.cost() + other.cost())
                });
                let found = common.min().map(|cost| length(self.k, self.is_taut(), cost));
                let expected = costs.to(self.vertex(b));
                let case = || format!("{found:?}, {expected:?}; {}", self.case(a, b));
                let Some(expected) = expected else {
                    assert_eq!(found, None, "{}", case());
                    continue;
                };
                counts[0] += 1;
                let is_exact = found.is_some_and(|found| (found - expected).abs() < 1e-6);
                counts[1] += usize::from(is_exact);
                assert!(found.is_none_or(|found| found > expected - 1e-6), "{}", case());
                if !self.is_taut() || self.is_part(a, b, costs.path_to(self.vertex(b)).as_deref()) {
                    assert!(is_exact, "{}", case());
                }
            }
        }
        counts
    }

    /// Whether the shortest path between two subgoals that are not joined by a line leaves and arrives along
    /// edges that a taut path can follow; then the graph has it.
    fn is_part(&self, a: u32, b: u32, path: Option<&[Vertex]>) -> bool {
        let Some(path) = path.filter(|_| self.k == K::Any && a != b) else { return false };
        let taut = |at: Vertex, other: Vertex| {
            let v = at.to(other);
            let corner = [(1, 1), (1, -1), (-1, 1), (-1, -1)]
                .into_iter()
                .find(|&(x, y)| self.space.grid().is_blocked(at.x + (x - 1) / 2, at.y + (y - 1) / 2));
            // Not into the quadrant across from the blocked cell.
            corner.is_some_and(|(x, y)| v.x * v.y * x * y <= 0)
        };
        taut(path[0], path[1]) && taut(path[path.len() - 1], path[path.len() - 2])
    }
}

fn check<P: SubgoalPlacement>(seed: u64, rule: P::Rule, k: K) -> Counts {
    let grid = random_grid(seed).0;
    if grid.width() * grid.height() > 150 {
        return [0; 3];
    }
    let space = FreeSpace::<P>::new(std::sync::Arc::new(grid), rule);
    Merged::new(&space, k, seed).check_pairs()
}

#[test]
fn every_pair_has_a_common_hub_and_every_label_leads_to_its_hub() {
    let k = |k: u32| K::Finite(FiniteK::new(k).expect("at least 2"));
    let of = |seed: u64| {
        let gap = [DiagonalGap::Open, DiagonalGap::Closed][seed as usize % 2];
        [
            check::<Corners>(seed, gap, K::Any),
            check::<Corners>(seed, gap, k(2 + seed as u32 % 5)),
            check::<Centers>(seed, CornerRule::Never, k(2)),
            check::<Centers>(seed, CornerRule::Never, k(3)),
        ]
    };
    let mut all = on_all_cores(seeds(60), of);
    // Here some labels lead nowhere after merging.
    all.extend([402, 1235].map(of));
    let sums = [0, 1, 2, 3]
        .map(|case| [0, 1, 2].map(|part| all.iter().map(|counts| counts[case][part]).sum::<usize>()));
    let maps = seeds(60).end as usize;
    assert!(
        sums.iter().all(|&[pairs, exact, labels]| exact > 40 * maps && pairs >= exact && labels > 6 * maps),
        "{sums:?}"
    );
}

/// A label that leads to a dropped one is dropped, too; so is one that costs less than its edges.
#[test]
fn labels_that_lead_nowhere_are_dropped_one_after_another() {
    let label = Label::new;
    let chain = |of_last: Option<Label>, first| {
        let mut labels = vec![vec![first], vec![label(4, 2, 30)], vec![label(4, 3, 20)], vec![], vec![]];
        labels[3].extend(of_last);
        let mut lists = listed(&labels);
        uninterrupted(|never| keep_whole(&mut lists, never, |_, _| 10));
        (0..5).map(|id| all_of(&lists, id).len()).collect::<Vec<_>>()
    };
    let whole = Some(label(4, 4, 10));
    assert_eq!(chain(whole, label(4, 1, 40)), [1, 1, 1, 1, 0]);
    assert_eq!(chain(whole, label(4, 1, 41)), [1, 1, 1, 1, 0], "the way that it leads costs less");
    assert_eq!(chain(whole, label(4, 1, 39)), [0, 1, 1, 1, 0], "it costs less than its way");
    assert_eq!(chain(None, label(4, 1, 40)), [0, 0, 0, 0, 0]);
    assert_eq!(chain(Some(label(4, 4, 11)), label(4, 1, 40)), [0, 0, 0, 1, 0]);
}

/// A label is what its words say: over N(k) the rest of a cost has 64 bits. What does not fit has no words.
#[test]
fn labels_are_their_words() {
    let mut rng = Rng::new(7);
    for rest_bits in [0, 32, 64] {
        for count in [2, 3, 1000, 1 << 20] {
            let form = Form::new(count, rest_bits);
            let bits = 63 - (count - 1).ilog2();
            for _ in 0..100 {
                let mut below = |most: u64| rng.bits() % most;
                let (hub, next) = (below(count as u64) as u32, below(count as u64) as u32);
                let kept = below(1 << bits.min(56));
                let rest = if rest_bits == 0 { 0 } else { below(1 << bits.min(rest_bits)) };
                let label = Label::new(hub, next, u128::from(kept) << rest_bits | u128::from(rest));
                let words = form.words(label).expect("it fits");
                assert_eq!((form.label(words), form.kept(label.cost())), (label, kept));
                let packed = u64::from(hub) << bits | kept;
                assert_eq!((form.packed(words[0]), form.unpacked(packed)), (packed, words[0]));
            }
            let of = |cost| form.words(Label::new(1, 1, cost));
            assert_eq!(of(1 << (rest_bits + bits.min(56))), None, "{rest_bits} {count}");
            assert!(rest_bits < 64 || of(1 << bits).is_none(), "{count}");
        }
    }
}

/// Each hub of an end comes once, with the least cost.
#[test]
fn the_hubs_of_an_end_are_found_once() {
    let grid = mediant_oracle::rooms(&mut mediant_oracle::Rng::new(5), 30, 30);
    let space = FreeSpace::<Corners>::new(std::sync::Arc::new(grid), DiagonalGap::Open);
    let labels =
        HubLabels::within(&space, K::Any, usize::MAX, &|_| {}, &Interrupt::NEVER).expect("there is memory");
    let (mut join, mut hubs, mut total) = (Join::new(&labels), Vec::new(), 0);
    for at in (0..30).map(|i| Vertex::new(i, (7 * i) % 31)).filter(|&at| space.is_free(at)) {
        join.hubs_of(&labels, &space, at, &mut hubs);
        let (found, times) =
            (hubs.iter().map(|&(hub, _)| hub).collect::<std::collections::BTreeSet<_>>(), hubs.len());
        assert_eq!(found.len(), times, "a hub comes twice at {at}");
        total += times;
    }
    assert!(total > 300, "{total}");
}

/// The steps beside labels lead to the hub, and cost no more than the label says. Returns the numbers of
/// labels, of those whose steps cost as much as they say, and of steps.
fn check_steps<P: SubgoalPlacement>(grid: &Grid, rule: P::Rule, k: K) -> [usize; 3] {
    let space = FreeSpace::<P>::new(std::sync::Arc::new(grid.clone()), rule);
    let labels =
        HubLabels::within(&space, k, usize::MAX, &|_| {}, &Interrupt::NEVER).expect("there is memory");
    let (packed, subgoals) = (&labels.packed, &labels.geometry.subgoals);
    let mut counts = [0; 3];
    for id in 0..subgoals.len() as u32 {
        let own = packed.groups(id * P::SIDES, P::SIDES);
        for label in packed.begin(own.start)..packed.begin(own.end) {
            let hub = packed.hub(packed.labels[label]);
            let mut rest = packed.cost(packed.labels[label]) as i64;
            let (mut at, mut step) = (subgoals.vertex(id), packed.steps[label]);
            loop {
                rest -= labels.metric.estimate(at.to(step.at())).to_bits() as i64;
                at = step.at();
                counts[2] += 1;
                let context = format!("from {id} to {hub} at {at}, k = {k}: {rest}");
                if step.is_last() {
                    assert!(at == subgoals.vertex(hub) && rest > -64, "{context}");
                    break;
                }
                step = step.next(&packed.steps).expect(&context);
            }
            counts[0] += 1;
            counts[1] += usize::from(rest < 64);
        }
    }
    counts
}

#[test]
fn steps_beside_labels_lead_to_their_hubs() {
    let grid = mediant_oracle::rooms(&mut mediant_oracle::Rng::new(5), 60, 60);
    let noise = mediant_oracle::noise(&mut mediant_oracle::Rng::new(5), 130, 130, 26);
    let k = |k: u32| K::Finite(FiniteK::new(k).expect("at least 2"));
    for [labels, exact, steps] in [
        check_steps::<Corners>(&grid, DiagonalGap::Open, K::Any),
        check_steps::<Corners>(&grid, DiagonalGap::Closed, k(5)),
        check_steps::<Centers>(&grid, CornerRule::Never, k(3)),
        check_steps::<Centers>(&grid, CornerRule::Never, k(2)),
        check_steps::<Corners>(&noise, DiagonalGap::Closed, K::Any),
    ] {
        let is_most = 100 * exact > 95 * labels;
        assert!(labels > 1000 && is_most && steps > 2 * labels, "{steps} steps, {exact} of {labels} labels");
    }
}
