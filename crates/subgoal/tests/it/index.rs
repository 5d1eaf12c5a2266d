//! Graphs as bytes: what was written is read back; other bytes are refused, or make a graph of legal paths.

use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace, Grid, Identity, PlacementKind, Vertex};
use mediant_moves::K;
use mediant_oracle::{Rng, every, on_all_cores, random_free_vertex, seeds, suite_grid, validate};
use mediant_search::{Answer, Ends, Planner};
use mediant_subgoal::{SubgoalAStar, SubgoalError, SubgoalGraph, SubgoalTheta};

use crate::common::{GAPS, HIERARCHIES, graph, identity, k, levels, space};

type Graph = SubgoalGraph<Corners>;

/// The answers of both planners.
fn answers(space: &FreeSpace<Corners>, graph: &Graph, queries: &[Ends]) -> Vec<[Answer; 2]> {
    let mut a_star = SubgoalAStar::new(space, graph).expect("the graph is for this space");
    let mut theta = SubgoalTheta::new(space, graph).expect("the graph is for this space");
    let mut solve =
        |&query| [a_star.solve(query), theta.solve(query)].map(|answer| answer.expect("both ends are free"));
    queries.iter().map(&mut solve).collect()
}

fn queries(grid: &Grid, seed: u64) -> Vec<Ends> {
    let mut rng = Rng::new(seed ^ 0x10AD);
    let mut free = || random_free_vertex(&mut rng, grid, PlacementKind::Corner);
    (0..6).filter_map(|_| Some(Ends::new(free()?, free()?))).collect()
}

#[test]
fn a_loaded_graph_is_the_one_that_was_written() {
    let check = |seed: u64| {
        let (grid, gap) = (suite_grid(seed).0, GAPS[seed as usize % 2]);
        let space = space::<Corners>(&grid, gap);
        let queries = queries(&grid, seed);
        for hierarchy in HIERARCHIES.into_iter().chain([levels(u32::MAX)]) {
            let k = [k(2), k(3), k(4), k(7), K::Any][seed as usize / 2 % 5];
            let made = graph(&space, k, hierarchy);
            let bytes = made.to_bytes();
            let loaded = Graph::from_bytes(&space, k, &bytes).expect("these are its bytes");
            let case = || format!("{hierarchy:?}, k = {k}, {gap:?}, seed {seed}");
            assert_eq!(loaded.to_bytes(), bytes, "{}", case());
            let facts = |graph: &Graph| {
                (graph.k(), graph.subgoals(), graph.arcs(), graph.core(), graph.memory_bytes())
            };
            assert_eq!(facts(&loaded), facts(&made), "{}", case());
            assert!(loaded.edges().eq(made.edges()), "{}", case());
            assert_eq!(answers(&space, &loaded, &queries), answers(&space, &made, &queries), "{}", case());
        }
        queries.len()
    };
    let counts = on_all_cores(seeds(100), check);
    assert!(counts.iter().sum::<usize>() > 4 * counts.len(), "too few queries: {counts:?}");
}

const ROOMS: &str = "
    .......#....
    .##....#....
    .##.........
    .......#..#.
    ###.####..#.
    .......#.##.
    ...#........
    .......#....
";

fn rooms() -> Grid {
    AsciiMap::parse(ROOMS).expect("the drawing is a map").grid
}

/// Queries from each of some free vertices to each.
fn all_queries(space: &FreeSpace<Corners>) -> Vec<Ends> {
    let vertices = (0..=8).flat_map(|y| (0..=12).map(move |x| Vertex::new(x, y)));
    let free: Vec<Vertex> = vertices.filter(|&at| space.is_free(at)).step_by(9).collect();
    free.iter().flat_map(|&a| free.iter().map(move |&b| Ends::new(a, b))).collect()
}

#[test]
fn part_of_the_bytes_is_no_graph_and_neither_is_more() {
    let space = space::<Corners>(&rooms(), DiagonalGap::Open);
    for k in [k(3), K::Any] {
        for hierarchy in HIERARCHIES {
            let bytes = graph(&space, k, hierarchy).to_bytes();
            for end in 0..bytes.len() {
                let error = Graph::from_bytes(&space, k, &bytes[..end]).expect_err("there are too few");
                assert!(matches!(error, SubgoalError::Bytes(_)), "{error:?}");
            }
            for more in 1..9 {
                let longer = [&bytes[..], &vec![0; more]].concat();
                assert!(Graph::from_bytes(&space, k, &longer).is_err(), "{more} more");
            }
        }
    }
}

/// Checks that a graph, whatever it was made for, answers with legal paths or none.
fn check_answers(space: &FreeSpace<Corners>, graph: &Graph, queries: &[Ends], case: &str) {
    for (&Ends { start, goal, .. }, answers) in queries.iter().zip(answers(space, graph, queries)) {
        for (answer, k) in answers.into_iter().zip([graph.k().finite(), None]) {
            let Answer::Found(path) = answer else { continue };
            let (rules, way) = (space.rules(), path.waypoints());
            let fault = validate(space.grid(), rules, k, start, goal, way, path.cost());
            assert_eq!(fault, Ok(()), "{case}: {way:?} from {start} to {goal}");
        }
    }
}

/// Bytes that are nearly right are refused, or give a graph of legal paths.
#[test]
fn no_flipped_bit_makes_an_illegal_path() {
    let space = space::<Corners>(&rooms(), DiagonalGap::Open);
    let queries = all_queries(&space);
    let mut counts = [0; 2];
    for (k, hierarchy) in [k(3), K::Any].into_iter().flat_map(|k| HIERARCHIES.map(|h| (k, h))) {
        let bytes = graph(&space, k, hierarchy).to_bytes();
        for bit in (0..8 * bytes.len()).step_by(every(7)) {
            let mut flipped = bytes.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            let read = Graph::from_bytes(&space, k, &flipped);
            counts[usize::from(read.is_ok())] += 1;
            if let Ok(graph) = read {
                check_answers(&space, &graph, &queries, &format!("bit {bit}, {hierarchy:?}, k = {k}"));
            }
        }
    }
    assert!(counts.iter().all(|&count| count > 140), "{counts:?} refused, and read");
}

/// Bytes with a wrong identity, that of the space and k that they are read for.
#[test]
fn bytes_of_another_map_or_k_make_no_illegal_path() {
    let (mut refused, mut read) = (0, 0);
    let rooms = rooms();
    let width = rooms.width() as i32;
    // Has as many subgoals, at other places.
    let mirrored =
        Grid::from_fn(rooms.width(), rooms.height(), |x, y| rooms.is_blocked(width - 1 - x as i32, y as i32));
    let mirrored = mirrored.expect("a valid size");
    for (gap, hierarchy) in GAPS.into_iter().flat_map(|gap| HIERARCHIES.map(|h| (gap, h))) {
        let own = space::<Corners>(&rooms, gap);
        let others = [space(&mirrored, gap), space(&rooms, gap), space(&suite_grid(3).0, gap)];
        for (made, k) in [(k(3), k(3)), (k(3), k(5)), (k(5), k(3)), (k(3), K::Any), (K::Any, k(2))] {
            let mut bytes = graph(&own, made, hierarchy).to_bytes();
            for space in &others {
                bytes[..Identity::BYTES].copy_from_slice(&identity(space, k).to_bytes());
                match Graph::from_bytes(space, k, &bytes) {
                    Err(error) => {
                        assert!(matches!(error, SubgoalError::Bytes(_)), "{error:?}");
                        refused += 1;
                    }
                    Ok(graph) => {
                        let case = format!("{hierarchy:?}, made for k = {made}, read for {k}");
                        check_answers(space, &graph, &all_queries(space), &case);
                        read += 1;
                    }
                }
            }
        }
    }
    assert!(refused > 60 && read > 20, "{refused} refused, {read} read");
}

/// The bytes of these numbers, as those of a graph of this space.
fn bytes_of(space: &FreeSpace<Corners>, k: K, numbers: Vec<u32>) -> Vec<u8> {
    let numbers = numbers.into_iter().flat_map(u32::to_le_bytes);
    identity(space, k).to_bytes().into_iter().chain(numbers).collect()
}

/// The numbers of a made-up graph: subgoals in a random order, shortcuts over any two arcs of a subgoal,
/// sometimes an arc that is wrong.
fn made_up(rng: &mut Rng, count: usize, edges: &[(u32, u32)]) -> Vec<u32> {
    let rank: Vec<u64> = (0..count).map(|_| rng.bits()).collect();
    let above = |a: u32, b: u32| if rank[a as usize] < rank[b as usize] { (a, b) } else { (b, a) };
    let mut up = vec![Vec::new(); count];
    for &(a, b) in edges {
        let (low, high) = above(a, b);
        up[low as usize].push((high, u32::MAX));
    }
    let core = rng.below(count as u32) as usize;
    for _ in 0..rng.below(20) {
        let middle = rng.below(count as u32);
        let arcs = &up[middle as usize];
        if let Some((&(p, _), &(q, _))) = rng.pick(arcs).zip(rng.pick(arcs)) {
            let (low, high) = above(p, q);
            up[low as usize].push((high, middle));
        }
    }
    if rng.chance(20) {
        let id = rng.below(count as u32) as usize;
        up[id]
            .push((rng.below(count as u32), if rng.chance(50) { u32::MAX } else { rng.below(count as u32) }));
    }
    let arcs: usize = up.iter().map(Vec::len).sum();
    let mut numbers = vec![rng.below(3), count as u32, arcs as u32];
    let highest = |id: usize| rank.iter().filter(|&&other| other > rank[id]).count() < core;
    numbers.extend(up.iter().enumerate().map(|(id, up)| 2 * up.len() as u32 + u32::from(highest(id))));
    numbers.extend(up.iter().flatten().flat_map(|&(to, middle)| [to, middle]));
    numbers
}

#[test]
fn a_made_up_graph_is_refused_or_one_of_legal_paths() {
    let mut counts = [0; 2];
    for seed in 0..3000 {
        let (mut rng, k) = (Rng::new(seed), [k(2), k(3), k(6), K::Any][seed as usize % 4]);
        let space = space::<Corners>(&rooms(), GAPS[seed as usize / 4 % 2]);
        let queries: Vec<Ends> = all_queries(&space).into_iter().skip(seed as usize % 7).step_by(7).collect();
        let made = graph(&space, k, levels(1));
        let place = |at: Vertex| made.vertices().position(|other| other == at).expect("a subgoal") as u32;
        let edges: Vec<(u32, u32)> = made.edges().map(|(a, b)| (place(a), place(b))).collect();
        let bytes = bytes_of(&space, k, made_up(&mut rng, made.subgoals(), &edges));
        let read = Graph::from_bytes(&space, k, &bytes);
        counts[usize::from(read.is_ok())] += 1;
        if let Ok(graph) = read {
            check_answers(&space, &graph, &queries, &format!("seed {seed}, k = {k}"));
        }
    }
    assert!(counts.iter().all(|&count| count > 300), "{counts:?} refused, and read");
}

/// Shortcuts over shortcuts, each twice as long as those that it consists of.
#[test]
fn ways_there_and_back_are_refused() {
    let grid = Grid::from_fn(40, 2, |x, y| y == 1 && x % 2 == 1).expect("a valid size");
    let space = space::<Corners>(&grid, DiagonalGap::Open);
    let count = graph(&space, K::Any, levels(1)).subgoals() as u32;
    assert_eq!(count, 39);
    let bytes = |depth: u32| {
        let up = |id: u32| if id < depth { id + 1..count } else { 0..0 };
        let mut numbers = vec![0, count, (0..count).map(|id| up(id).len() as u32).sum()];
        numbers.extend((0..count).map(|id| 2 * up(id).len() as u32));
        numbers.extend((0..count).flat_map(|id| up(id).flat_map(move |to| [to, id.wrapping_sub(1)])));
        bytes_of(&space, K::Any, numbers)
    };
    assert!(Graph::from_bytes(&space, K::Any, &bytes(1)).is_ok(), "edges from the first to all");
    assert!(Graph::from_bytes(&space, K::Any, &bytes(2)).is_ok(), "shortcuts over the first");
    for depth in [12, 20, 30, count - 1] {
        let error = Graph::from_bytes(&space, K::Any, &bytes(depth)).expect_err("the shortcuts are too long");
        assert_eq!(error, SubgoalError::Bytes("a shortcut is too long"), "{depth}");
    }
}
