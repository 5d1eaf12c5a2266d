//! Hub labels as bytes: what was written is read back; damage is found; bytes that somebody made up make no
//! panic and no search without end.

use mediant_grid::{
    AsciiMap, Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, Identity, Mismatch,
};
use mediant_moves::K;
use mediant_oracle::{Rng, on_all_cores, seeds, suite_grid};
use mediant_search::{Answer, Ends, Planner, PointEnds, QueryError};
use mediant_subgoal::{
    Hierarchy, HubLabelSearch, HubLabels, SubgoalAStar, SubgoalError, SubgoalGraph, SubgoalPlacement,
};

use crate::common::{GAPS, graph, identity, k, labels, space, with_checksum, with_vertices};

/// The answers of a planner, however wrong its labels are.
type Answers = Vec<[Result<Option<u64>, QueryError>; 2]>;

/// The answers that labels give to queries between some free vertices.
fn answers<P: SubgoalPlacement>(space: &FreeSpace<P>, labels: &HubLabels<P>) -> Answers {
    let (width, height) = P::vertices(space.grid());
    let all = (0..height as i32).flat_map(|y| (0..width as i32).map(move |x| (x, y).into()));
    let free: Vec<_> = all.filter(|&at| space.is_free(at)).collect();
    let step = 1 + free.len() / 12;
    let ends: Vec<_> = free.into_iter().step_by(step).collect();
    let mut planner = HubLabelSearch::new(space, labels).expect("the labels are for this space");
    let goals = labels.goals(space, ends.iter().copied()).expect("the goals are free");
    let (mut found, mut distances) = (Vec::new(), Vec::new());
    for &start in &ends {
        planner.distances(start, &goals, &mut distances).expect("the start is free");
        planner.nearest(start, &goals).expect("the start is free");
        for (&goal, at_once) in ends.iter().zip(&distances) {
            let query = Ends::new(start, goal);
            let cost = planner.solve(query).map(|answer| answer.cost().map(f64::to_bits));
            let distance = planner.cost(query).map(|cost| cost.map(mediant_moves::Cost::to_bits));
            found.push([cost, distance]);
            let [from, to] = [start, goal].map(|at| (f64::from(at.x) + 0.5, f64::from(at.y) + 0.5));
            let between = planner.solve_at(PointEnds::new(from, to));
            let between = between.map_or(Ok(None), |answer| answer.map(|answer| answer.cost()));
            let between = between.map(|cost| cost.map(f64::to_bits));
            found.push([Ok(at_once.map(mediant_moves::Cost::to_bits)), between]);
        }
    }
    found
}

fn read<P: SubgoalPlacement>(space: &FreeSpace<P>, k: K, bytes: &[u8]) -> Result<HubLabels<P>, SubgoalError> {
    HubLabels::from_bytes(space, k, bytes)
}

fn check<P: SubgoalPlacement>(grid: &Grid, k: K, rule: P::Rule, seed: u64) -> usize {
    let space = space::<P>(grid, rule);
    let made = labels(&space, k);
    let made = match seed % 3 {
        0 => made,
        by_half => with_vertices(&made, &space, by_half == 1),
    };
    let bytes = made.to_bytes();
    let loaded = read(&space, k, &bytes).unwrap_or_else(|error| panic!("{error}: k = {k}, seed {seed}"));
    let case = || format!("k = {k}, {}, seed {seed}", space.rules());
    assert_eq!(loaded.to_bytes(), bytes, "{}", case());
    let facts = |of: &HubLabels<P>| {
        let counts = [of.subgoals(), of.labels(), of.labels_of_vertices(), of.memory_bytes()];
        (of.k(), counts, of.identity())
    };
    assert_eq!(facts(&loaded), facts(&made), "{}", case());
    assert_eq!(made.identity(), identity(&space, k), "{}", case());
    let found = answers(&space, &made);
    assert_eq!(answers(&space, &loaded), found, "{}", case());
    found.len()
}

#[test]
fn loaded_labels_are_those_that_were_written() {
    let of = |seed: u64| {
        let grid = suite_grid(seed).0;
        let any = [k(2), k(3), k(4), k(7), K::Any][seed as usize / 2 % 5];
        check::<Corners>(&grid, any, GAPS[seed as usize % 2], seed)
            + check::<Centers>(&grid, k(2 + seed as u32 % 2), CornerRule::Never, seed)
    };
    let found: usize = on_all_cores(seeds(40), of).into_iter().sum();
    assert!(found > 100 * seeds(40).end as usize, "{found}");
}

const ROOMS: &str = "
    .......#..
    .##....#..
    .##.......
    ...#...#..
    ###.###...
    .......#..
";

fn rooms() -> Grid {
    AsciiMap::parse(ROOMS).expect("the drawing is a map").grid
}

#[test]
fn part_of_the_bytes_is_refused_and_so_is_more() {
    let space = space::<Corners>(&rooms(), DiagonalGap::Open);
    for k in [k(3), K::Any] {
        let bytes = labels(&space, k).to_bytes();
        for end in 0..bytes.len() {
            let error = read(&space, k, &bytes[..end]).expect_err("there are too few");
            assert!(matches!(error, SubgoalError::Bytes(_)), "{error:?}");
        }
        for more in 1..40 {
            let longer = [&bytes[..], &vec![0; more]].concat();
            assert!(read(&space, k, &longer).is_err(), "{more} more");
            // Nor with a checksum that fits.
            let longer = [&bytes[..bytes.len() - 8], &vec![0; more]].concat();
            assert!(read(&space, k, &with_checksum(longer)).is_err(), "{more} more, and a checksum");
        }
        assert!(
            read(&space, k, &with_checksum(bytes[..bytes.len() - 8].to_vec())).is_ok(),
            "the checksum is known"
        );
    }
}

#[test]
fn every_flipped_bit_is_found() {
    let space = space::<Corners>(&rooms(), DiagonalGap::Closed);
    let bytes = labels(&space, K::Any).to_bytes();
    let mut found = 0;
    for bit in 0..8 * bytes.len() {
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        let error = read(&space, K::Any, &flipped).expect_err("it is damaged");
        found += usize::from(error == SubgoalError::Bytes("they are damaged"));
        let is_head = bit < 8 * (Identity::BYTES + 4);
        assert!(is_head || error == SubgoalError::Bytes("they are damaged"), "bit {bit}: {error}");
    }
    assert!(found > 4000, "{found} bits");
}

/// Where the parts of the bytes are: their beginning, the width of their words and the number of words.
fn parts(bytes: &[u8]) -> Vec<(usize, usize, usize)> {
    let (mut at, mut parts) = (Identity::BYTES + 8, Vec::new());
    // Of the seen index five, of the labels of subgoals five, of those of vertices three.
    for width in [4, 4, 8, 4, 8, 4, 4, 4, 8, 4, 4, 4, 8] {
        let count = u64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight bytes")) as usize;
        parts.push((at + 8, width, count));
        at += 8 + (width * count).next_multiple_of(8);
    }
    assert_eq!(at + 8, bytes.len(), "the parts fill the bytes");
    parts
}

/// Words and counts changed by seed, with a checksum that fits.
fn fuzz<P: SubgoalPlacement>(grid: &Grid, k: K, rule: P::Rule, seeds: std::ops::Range<u64>) {
    let space = space::<P>(grid, rule);
    let bytes = with_vertices(&labels(&space, k), &space, true).to_bytes();
    let parts = parts(&bytes);
    let body = &bytes[..bytes.len() - 8];
    let of = |seed: u64| {
        let mut rng = Rng::new(seed);
        let mut changed = body.to_vec();
        for _ in 0..1 + rng.below(5) {
            let (begin, width, count) = parts[rng.below(parts.len() as u32) as usize];
            let is_count = count == 0 || rng.chance(8);
            let at = if is_count { begin - 8 } else { begin + width * rng.below(count as u32) as usize };
            let known = u32::from_le_bytes(changed[at..at + 4].try_into().expect("four bytes"));
            let value = match rng.below(8) {
                0 => rng.bits() as u32,
                1 => u32::MAX,
                2 => 0,
                3 => known.wrapping_add(1),
                4 => known.wrapping_sub(1),
                5 => known ^ 1 << rng.below(32),
                _ => rng.below(40),
            };
            changed[at..at + 4].copy_from_slice(&value.to_le_bytes());
            if width == 8 && rng.chance(50) {
                changed[at..at + 8].copy_from_slice(&(rng.bits() >> rng.below(64)).to_le_bytes());
            }
        }
        let read = read(&space, k, &with_checksum(changed));
        read.is_ok_and(|labels| {
            answers(&space, &labels);
            assert!(labels.memory_bytes() < 1 << 20, "seed {seed}");
            true
        })
    };
    let (count, read) = (seeds.end - seeds.start, on_all_cores(seeds, of));
    let read = read.into_iter().filter(|&is_read| is_read).count() as u64;
    assert!(10 * read > count && 10 * (count - read) > count, "{read} of {count} are read");
}

#[test]
fn crafted_bytes_make_no_panic_and_no_endless_search() {
    for k in [k(2), k(5), K::Any] {
        fuzz::<Corners>(&rooms(), k, GAPS[0], seeds(1500));
        fuzz::<Corners>(&rooms(), k, GAPS[1], seeds(1500));
    }
    fuzz::<Centers>(&rooms(), k(2), CornerRule::Always, seeds(1500));
    fuzz::<Centers>(&rooms(), k(3), CornerRule::Never, seeds(1500));
}

fn mismatch<T>(result: Result<T, SubgoalError>) -> Mismatch {
    match result.map(|_| ()) {
        Err(SubgoalError::Mismatch(mismatch)) => mismatch,
        other => panic!("{other:?}"),
    }
}

#[test]
fn labels_of_something_else_are_refused() {
    let own = space::<Corners>(&rooms(), DiagonalGap::Open);
    let other_rule = space::<Corners>(&rooms(), DiagonalGap::Closed);
    let other_map = space::<Corners>(&suite_grid(3).0, DiagonalGap::Open);
    let centers = space::<Centers>(&rooms(), CornerRule::Never);
    let made = labels(&own, k(3));
    let bytes = made.to_bytes();
    assert!(read(&own, k(3), &bytes).is_ok());
    for (space, other_k) in [(&own, k(2)), (&own, K::Any), (&other_rule, k(3)), (&other_map, k(3))] {
        let wrong = mismatch(read(space, other_k, &bytes));
        assert_eq!((wrong.belongs_to, wrong.other_belongs_to), (made.identity(), identity(space, other_k)));
        // Nor does it matter what else is wrong.
        mismatch(read(space, other_k, &bytes[..Identity::BYTES]));
    }
    mismatch(read(&centers, k(3), &bytes));
    mismatch(read(&own, k(3), &labels(&centers, k(3)).to_bytes()));
    for space in [&other_rule, &other_map] {
        let wrong = HubLabelSearch::new(space, &made).map(|_| ()).expect_err("it is of something else");
        assert_eq!((wrong.prepared, wrong.belongs_to), ("the hub labels", made.identity()));
    }
    let grid_graph = |k| mediant_grid::GridGraph::in_space(&own, k).expect("k is in range");
    let three = mediant_moves::FiniteK::N8;
    assert!(HubLabelSearch::new(&grid_graph(three), &made).is_ok(), "the same k");
    assert!(HubLabelSearch::new(&grid_graph(mediant_moves::FiniteK::N4), &made).is_err(), "another k");
    assert!(HubLabelSearch::new(&own, &made).is_ok_and(|planner| planner.identity() == made.identity()));
}

#[test]
fn labels_are_no_graph_and_a_graph_is_no_labels() {
    let space = space::<Corners>(&rooms(), DiagonalGap::Open);
    let of_labels = labels(&space, K::Any).to_bytes();
    let error =
        SubgoalGraph::from_bytes(&space, K::Any, &of_labels).map(|_| ()).expect_err("they are labels");
    assert_eq!(error, SubgoalError::Bytes("they are hub labels, no graph"));
    let of_graph = graph(&space, K::Any, Hierarchy::Contracted).to_bytes();
    let error = read(&space, K::Any, &of_graph).map(|_| ()).expect_err("they are a graph");
    assert_eq!(error, SubgoalError::Bytes("they are no hub labels"));
    // As many levels as the code of labels would say are all levels.
    let most = graph(&space, K::Any, crate::common::levels(u32::MAX - 1));
    let read = SubgoalGraph::from_bytes(&space, K::Any, &most.to_bytes()).expect("these are its bytes");
    assert_eq!(read.hierarchy(), Hierarchy::AllLevels);
    let mut planner = SubgoalAStar::new(&space, &read).expect("the graph is for this space");
    assert!(matches!(planner.solve(Ends::new((0, 0), (10, 6))), Ok(Answer::Found(_))));
}

/// A label of a hub that is no subgoal, or that costs more than any path, is refused, whatever label it is.
#[test]
fn labels_of_no_subgoal_are_refused() {
    let space = space::<Corners>(&rooms(), DiagonalGap::Open);
    let made = with_vertices(&labels(&space, K::Any), &space, false);
    let bytes = made.to_bytes();
    let bits = 64 - (made.subgoals() as u64 - 1).leading_zeros();
    for wrong in [u64::MAX, (made.subgoals() as u64) << (64 - bits), 1 << (64 - bits - 1)] {
        let all = [8, 12].map(|part| parts(&bytes)[part]);
        for (begin, width, label) in
            all.into_iter().flat_map(|(begin, width, count)| (0..count).map(move |i| (begin, width, i)))
        {
            let mut changed = bytes[..bytes.len() - 8].to_vec();
            changed[begin + width * label..][..8].copy_from_slice(&wrong.to_le_bytes());
            let error = read(&space, K::Any, &with_checksum(changed)).map(|_| ()).expect_err("it is wrong");
            assert_eq!(error, SubgoalError::Bytes("their parts do not fit together"), "{wrong:x}");
        }
    }
}
