//! Indexes as bytes: an index that was written is read again, and no other bytes lead to an illegal path.

use crate::common::{
    Setting, any_clustering, any_grid_graph, ask, check_path, chpa, clusters, describe_query, grid_graph,
    hpa, k, map, random_queries, segments,
};
use mediant_grid::{AsciiMap, Centers, CornerRule, Grid, GridGraph, Identity, Rectangle};
use mediant_hierarchy::{ClusterGraph, Clustering, HierarchyError, SegmentGraph};
use mediant_oracle::{Rng, on_all_cores, seeds};
use mediant_search::{Answer, Ends, QueryError};

#[test]
fn a_loaded_index_is_the_one_that_was_written() {
    let check = |seed: u64| {
        let (grid, mut rng) = (map(seed), Rng::new(seed ^ 0x10AD));
        let grid_graph = any_grid_graph(&mut rng, &grid);
        let (clustering, side, setting) =
            (any_clustering(&mut rng), 1 + rng.below(9), Setting::any(&mut rng));
        let case = || format!("{clustering:?}, segments of {side}, k = {}, seed {seed}", grid_graph.k());

        let of_clusters = clusters(&grid_graph, clustering);
        let read_clusters = ClusterGraph::from_bytes(&grid_graph, &of_clusters.to_bytes());
        let read_clusters = read_clusters.expect("these are its bytes");
        assert!(read_clusters == of_clusters, "{}", case());
        let facts = |graph: &ClusterGraph| {
            (graph.clustering(), graph.clusters(), graph.nodes(), graph.memory_bytes(), graph.to_bytes())
        };
        assert_eq!(facts(&read_clusters), facts(&of_clusters), "{}", case());
        assert_eq!(read_clusters.clustering(), clustering, "{}", case());

        let of_segments = segments(&grid_graph, side);
        let read_segments = SegmentGraph::from_bytes(&grid_graph, &of_segments.to_bytes());
        let read_segments = read_segments.expect("these are its bytes");
        assert!(read_segments == of_segments, "{}", case());
        let facts = |graph: &SegmentGraph| {
            (graph.side(), graph.segments(), graph.edges(), graph.memory_bytes(), graph.to_bytes())
        };
        assert_eq!(facts(&read_segments), facts(&of_segments), "{}", case());
        assert_eq!(read_segments.side(), side, "{}", case());

        let mut pairs = [
            [hpa(&grid_graph, &of_clusters, true), hpa(&grid_graph, &read_clusters, true)],
            [chpa(&grid_graph, &of_segments, setting), chpa(&grid_graph, &read_segments, setting)],
        ];
        let queries = random_queries(&mut rng, &grid, 6);
        for &query in &queries {
            for [made, read] in &mut pairs {
                assert_eq!(ask(read, query), ask(made, query), "{query:?}, {setting:?}, {}", case());
            }
        }
        queries.len()
    };
    let counts = on_all_cores(seeds(200), check);
    assert!(counts.iter().sum::<usize>() > 5 * counts.len(), "too few queries on {} maps", counts.len());
}

/// A change of these bytes needs another version.
#[test]
fn the_versions_are_those_of_the_bytes_below() {
    let grid = AsciiMap::parse("..#\n...\n").expect("the drawing is a map").grid;
    let grid_graph = grid_graph(&grid, k(3), CornerRule::Never);
    let words = |bytes: &[u8]| -> Vec<u32> {
        bytes
            .chunks(4)
            .map(|word| u32::from_le_bytes(word.try_into().expect("words of four bytes")))
            .collect()
    };
    assert_eq!((ClusterGraph::VERSION, SegmentGraph::VERSION), (2, 2));
    let one = clusters(&grid_graph, Clustering { side: 2, levels: 2 }).to_bytes();
    let (identity, rest) = one.split_at(Identity::BYTES);
    assert_eq!(identity, grid_graph.identity().to_bytes());
    // Side, levels; two clusters with one node each; on level 1 one cluster without nodes.
    assert_eq!(words(rest), [2, 2, 1, 1, 0]);
    let other = segments(&grid_graph, 1).to_bytes();
    let (identity, rest) = other.split_at(Identity::BYTES);
    assert_eq!(identity, grid_graph.identity().to_bytes());
    let (side, edges) = rest.split_at(4);
    assert_eq!(words(side), [1]);
    // East 1, south 2, south-east 4, south-west 8.
    assert_eq!(edges, [1 + 2 + 4, 2 + 4 + 8, 8, 1, 1, 0]);
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

/// For k = 2 and 3: the grid graph of the rooms, and its indexes of several sizes.
fn indexes() -> Vec<(GridGraph<Centers>, Vec<ClusterGraph>, Vec<SegmentGraph>)> {
    let of = |number: u32| {
        let grid_graph = grid_graph(&rooms(), k(number), CornerRule::Never);
        let clusterings = [(12, 1), (4, 1), (3, 2), (2, 4)];
        let of_clusters =
            clusterings.map(|(side, levels)| clusters(&grid_graph, Clustering { side, levels })).to_vec();
        let of_segments = [1, 2, 3, 5, 12].map(|side| segments(&grid_graph, side)).to_vec();
        (grid_graph, of_clusters, of_segments)
    };
    vec![of(2), of(3)]
}

#[test]
fn an_edge_to_no_segment_is_refused() {
    for (grid_graph, _, of_segments) in indexes() {
        for graph in of_segments {
            let (columns, rows) = (12_u32.div_ceil(graph.side()), 8_u32.div_ceil(graph.side()));
            let (bytes, has_diagonals) = (graph.to_bytes(), grid_graph.k() == k(3));
            for (segment, bit) in
                (0..graph.segments()).flat_map(|segment| (0..8).map(move |bit| (segment, bit)))
            {
                let (x, y) = (segment as u32 % columns, segment as u32 / columns);
                let (has_right, has_below) = (x + 1 < columns, y + 1 < rows);
                let is_possible = match bit {
                    0 => has_right,
                    1 => has_below,
                    2 => has_diagonals && has_right && has_below,
                    3 => has_diagonals && x > 0 && has_below,
                    _ => false,
                };
                let mut other = bytes.clone();
                other[Identity::BYTES + 4 + segment] |= 1 << bit;
                let read = SegmentGraph::from_bytes(&grid_graph, &other);
                assert_eq!(read.is_ok(), is_possible, "bit {bit} of segment {x}, {y}: {read:?}");
            }
        }
    }
}

/// How often planners on an index that may be wrong found a path, and how often they gave up.
#[derive(Clone, Copy, Debug, Default)]
struct Answers {
    found: usize,
    gave_up: usize,
}

fn check_answers(
    grid_graph: &GridGraph<Centers>,
    planner: &mut crate::common::Solve<'_>,
    queries: &[Ends],
    may_give_up: bool,
    case: &impl Fn() -> String,
    answers: &mut Answers,
) {
    for &query in queries {
        let case = || format!("{}; {}", case(), describe_query(grid_graph, query, 0));
        let is_connected = grid_graph.connected(query.start, query.goal);
        match ask(planner, query).0 {
            Ok(Answer::Found(path)) => {
                check_path(grid_graph, query, &path, &case);
                answers.found += 1;
            }
            Ok(Answer::Unreachable) => assert!(!is_connected, "{}", case()),
            Err(QueryError::GaveUp { .. }) => {
                assert!(may_give_up && is_connected, "{}", case());
                answers.gave_up += 1;
            }
            other => panic!("{other:?}; {}", case()),
        }
    }
}

fn check_clusters(
    grid_graph: &GridGraph<Centers>,
    graph: &ClusterGraph,
    queries: &[Ends],
    case: &impl Fn() -> String,
    answers: &mut Answers,
) {
    for straightens in [true, false] {
        check_answers(grid_graph, &mut hpa(grid_graph, graph, straightens), queries, true, case, answers);
    }
}

fn check_segments(
    grid_graph: &GridGraph<Centers>,
    graph: &SegmentGraph,
    queries: &[Ends],
    case: &impl Fn() -> String,
    (complete, published): (&mut Answers, &mut Answers),
) {
    let setting = Setting::any(&mut Rng::new(graph.edges() as u64));
    check_answers(grid_graph, &mut chpa(grid_graph, graph, setting), queries, false, case, complete);
    let mut paper = chpa(grid_graph, graph, setting.of_the_paper());
    check_answers(grid_graph, &mut paper, queries, true, case, published);
}

#[test]
fn part_of_the_bytes_is_no_index_and_neither_is_more() {
    for (grid_graph, of_clusters, of_segments) in indexes() {
        let all = |bytes: Vec<u8>, is_read: &dyn Fn(&[u8]) -> bool| {
            assert!(is_read(&bytes));
            for end in 0..bytes.len() {
                assert!(!is_read(&bytes[..end]), "{end} of {}", bytes.len());
            }
            for more in 1..9 {
                assert!(!is_read(&[&bytes[..], &vec![0; more]].concat()), "{more} more");
            }
        };
        for graph in of_clusters {
            all(graph.to_bytes(), &|bytes| ClusterGraph::from_bytes(&grid_graph, bytes).is_ok());
        }
        for graph in of_segments {
            all(graph.to_bytes(), &|bytes| SegmentGraph::from_bytes(&grid_graph, bytes).is_ok());
        }
    }
}

/// Bytes that are nearly right are refused, or give an index of legal paths.
#[test]
fn no_flipped_bit_makes_an_illegal_path() {
    let [mut of_hpa, mut complete, mut published] = [Answers::default(); 3];
    let (mut refused, mut read) = ([0; 2], [0; 2]);
    for (grid_graph, of_clusters, of_segments) in indexes() {
        let queries = random_queries(&mut Rng::new(0xB17), grid_graph.grid(), 12);
        let flipped = |bytes: &[u8], bit: usize| {
            let mut flipped = bytes.to_vec();
            flipped[bit / 8] ^= 1 << (bit % 8);
            flipped
        };
        for graph in of_clusters {
            let bytes = graph.to_bytes();
            for bit in 0..8 * bytes.len() {
                let case = || format!("bit {bit}, {:?}", graph.clustering());
                match ClusterGraph::from_bytes(&grid_graph, &flipped(&bytes, bit)) {
                    Err(_) => refused[0] += 1,
                    Ok(graph) => {
                        read[0] += 1;
                        check_clusters(&grid_graph, &graph, &queries, &case, &mut of_hpa);
                    }
                }
            }
        }
        for graph in of_segments {
            let bytes = graph.to_bytes();
            for bit in 0..8 * bytes.len() {
                let case = || format!("bit {bit}, segments of {}", graph.side());
                match SegmentGraph::from_bytes(&grid_graph, &flipped(&bytes, bit)) {
                    Err(_) => refused[1] += 1,
                    Ok(graph) => {
                        read[1] += 1;
                        let tallies = (&mut complete, &mut published);
                        check_segments(&grid_graph, &graph, &queries, &case, tallies);
                    }
                }
            }
        }
    }
    assert!(refused.iter().chain(&read).all(|&count| count > 100), "{refused:?} refused, {read:?} read");
    assert!(
        of_hpa.found > 1000 && complete.found > 1000 && published.found > 1000,
        "{of_hpa:?}, {complete:?}"
    );
    assert!(published.gave_up > 0, "{published:?}");
}

/// Random bytes; and random costs or edges behind a header that is right.
#[test]
fn random_bytes_make_no_illegal_path() {
    let check = |seed: u64| {
        let (grid, mut rng) = (map(seed), Rng::new(seed ^ 0x4A4D));
        let grid_graph = any_grid_graph(&mut rng, &grid);
        let queries = random_queries(&mut rng, &grid, 6);
        let case = || format!("seed {seed}");
        let mut read = [0; 2];
        let any: Vec<u8> = (0..rng.below(80)).map(|_| rng.below(256) as u8).collect();
        let is_read = ClusterGraph::from_bytes(&grid_graph, &any).is_ok();
        assert!(!is_read && SegmentGraph::from_bytes(&grid_graph, &any).is_err(), "{}", case());

        let of_clusters = clusters(&grid_graph, any_clustering(&mut rng));
        let mut bytes = of_clusters.to_bytes();
        for _ in 0..1 + rng.below(20) {
            // Wrong numbers of nodes are refused. Small words may be such and stay, so that many indexes are
            // read.
            let words = ((bytes.len() - Identity::BYTES) / 4) as u32;
            let at = Identity::BYTES + 4 * (2 + rng.below(words - 2)) as usize;
            let word: [u8; 4] = bytes[at..at + 4].try_into().expect("four bytes");
            if u32::from_le_bytes(word) >= 1 << 12 {
                let new = [0, 1, rng.below(1 << 24), u32::MAX, u32::MAX - 1][rng.below(5) as usize];
                bytes[at..at + 4].copy_from_slice(&new.to_le_bytes());
            }
        }
        let mut answers = [Answers::default(); 3];
        if let Ok(graph) = ClusterGraph::from_bytes(&grid_graph, &bytes) {
            read[0] += 1;
            check_clusters(&grid_graph, &graph, &queries, &case, &mut answers[0]);
        }
        let mut bytes = segments(&grid_graph, 1 + rng.below(9)).to_bytes();
        bytes[Identity::BYTES + 4..].iter_mut().for_each(|edges| *edges &= rng.below(16) as u8);
        if let Ok(graph) = SegmentGraph::from_bytes(&grid_graph, &bytes) {
            read[1] += 1;
            let [_, complete, published] = &mut answers;
            check_segments(&grid_graph, &graph, &queries, &case, (complete, published));
        }
        (read, answers)
    };
    let checked = on_all_cores(seeds(300), check);
    let maps = seeds(300).end as usize;
    for index in 0..2 {
        let read: usize = checked.iter().map(|(read, _)| read[index]).sum();
        assert!(2 * read > maps, "only {read} of {maps} indexes were read");
    }
    for index in 0..3 {
        let found: usize = checked.iter().map(|(_, answers)| answers[index].found).sum();
        assert!(found > maps, "only {found} paths on {maps} maps");
    }
}

/// Bytes with a wrong identity, that of the map that they are read for.
#[test]
fn an_index_of_another_map_makes_no_illegal_path() {
    let (mut read, mut answers) = ([0; 2], [Answers::default(); 3]);
    for (grid_graph, of_clusters, of_segments) in indexes() {
        for seed in 0..40 {
            let mut rng = Rng::new(seed ^ 0x0DD);
            let (percent, rooms) = (rng.below(40), rooms());
            // Few cells differ, so that the clusters sometimes have as many nodes as before.
            let at = Rectangle { x: rng.below(12), y: rng.below(8), width: 3, height: 3 };
            let grid = rooms.with_rectangle(at, |_, _| rng.chance(percent));
            let other = crate::common::grid_graph(&grid, grid_graph.k(), CornerRule::Never);
            let queries = random_queries(&mut rng, &grid, 10);
            let case = || format!("seed {seed}");
            let forged = |mut bytes: Vec<u8>| {
                bytes[..Identity::BYTES].copy_from_slice(&other.identity().to_bytes());
                bytes
            };
            for graph in &of_clusters {
                if let Ok(graph) = ClusterGraph::from_bytes(&other, &forged(graph.to_bytes())) {
                    read[0] += 1;
                    check_clusters(&other, &graph, &queries, &case, &mut answers[0]);
                }
            }
            for graph in &of_segments {
                let graph =
                    SegmentGraph::from_bytes(&other, &forged(graph.to_bytes())).expect("any edges may be");
                read[1] += 1;
                let [_, complete, published] = &mut answers;
                check_segments(&other, &graph, &queries, &case, (complete, published));
            }
        }
    }
    assert!(read[0] > 50 && read[1] == 400, "{read:?} were read");
    assert!(answers.iter().all(|answers| answers.found > 500), "{answers:?}");
}

#[test]
fn there_is_no_index_for_other_moves() {
    for (number, rule) in [(3, CornerRule::One), (3, CornerRule::Always), (4, CornerRule::Never)] {
        let other = grid_graph(&rooms(), k(number), rule);
        let expected = Err(HierarchyError::Moves { k: k(number), rules: other.rules() });
        assert_eq!(ClusterGraph::new(&other, Clustering::default()).map(|_| ()), expected);
        assert_eq!(SegmentGraph::new(&other, 3).map(|_| ()), expected);
    }
}
