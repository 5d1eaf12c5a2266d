//! Repaired jump tables against new ones, through chains of random edits.

use std::sync::Arc;

use mediant_grid::{
    Centers, Change, CornerRule, Grid, GridGraph, Identity, Interrupt, Placement, Rectangle, Vertex,
    uninterrupted,
};
use mediant_oracle::{Rng, caves, describe, maze, noise, random_free_vertex, rooms, seeds};

use super::{Repair, Test, dead_ends, edit, graph, grid, on_all, planes, rows_of};
use crate::{
    AStar, Ends, Hk, JpsPlus, JumpError, JumpTable, Path, Planner,
    canonical::Pruning,
    jps::{
        BlockFinder,
        dead_ends::{DeadEndRows, REACH},
        lists::{JumpLists, Recorder},
        planes::JumpPlanes,
    },
};

/// The lists that a new table would have on the planes of another one.
fn new_lists<P: Placement>(graph: &GridGraph<P>, pruning: &Pruning<P>, table: &JumpTable) -> JumpLists {
    let blocks = table.blocks();
    let rows = rows_of(graph, &dead_ends(graph, blocks.axial_stops()));
    uninterrupted(|never| JumpLists::new(&Recorder { graph, pruning, blocks }, &rows, never))
}

/// A list, by the number of its place and its bit there.
type Listed = (usize, u32, Vec<u32>);

/// Whether repaired lists are new ones. `was_full` says whether not all found room once: from then on some
/// may be missing.
fn are_new<P: Placement>(
    graph: &GridGraph<P>,
    (is, new): (&[Listed], &[Listed]),
    was_full: &mut bool,
) -> bool {
    let words = |lists: &[Listed]| lists.iter().map(|(.., list)| list.len() + 1).sum::<usize>();
    let is_full = words(is).max(words(new)) > 60_000;
    *was_full |= is_full;
    // On larger maps a new table may have no lists at all, or begin to have them.
    if graph.vertex_count() > 1 << 12 && is.is_empty() != new.is_empty() {
        return true;
    }
    if !*was_full {
        return is == new;
    }
    // Where a new table has no room for a list, the repaired one may have it.
    let place = |&(place, bit, _): &Listed| (place, bit);
    let found = |list| new.binary_search_by_key(&place(list), place);
    is.iter().all(|list| found(list).map_or(is_full, |at| new[at] == *list))
}

fn is_repaired(table: &JumpTable) -> bool {
    let bytes = table.to_bytes();
    bytes.len() == Identity::BYTES + 4 && bytes.ends_with(&[0xff; 4])
}

/// A map on which edits change much, and jumps are long on some.
fn large_grid(seed: u64) -> Grid {
    let rng = &mut Rng::new(seed);
    match seed % 8 {
        0 => rooms(rng, 130, 70),
        1 => caves(rng, 100, 80),
        2 => noise(rng, 200, 20, 1),
        3 => noise(rng, 20, 200, 1),
        4 => noise(rng, 100, 65, 2),
        5 => maze(rng, 90, 70),
        // Large rooms.
        6 => Grid::from_fn(150, 100, |x, y| (x % 40 == 0 || y % 30 == 0) && (x + y) % 13 != 5).unwrap(),
        _ => noise(rng, 64, 64, 5),
    }
}

/// An edit of many scattered cells or of a large rectangle.
fn large_edit(rng: &mut Rng, map: &Arc<Grid>) -> Change {
    let change = Change::new(Arc::clone(map));
    let (width, height) = (map.width(), map.height());
    let cell = |rng: &mut Rng| (rng.below(width), rng.below(height));
    let (at, kind) = (Rectangle::spanning(cell(rng), cell(rng)), rng.below(8));
    let (dx, dy, percent) = (rng.below(9), rng.below(9), [1, 20][rng.below(2) as usize]);
    match kind {
        0..=3 => {
            let cells: Vec<_> = (0..20 + rng.below(200)).map(|_| cell(rng)).collect();
            // Cells mostly open, so that the map does not fill.
            let blocked = |rng: &mut Rng, x: u32, y: u32| map.is_free(x as i32, y as i32) && rng.chance(30);
            let cells: Vec<_> = cells.into_iter().map(|(x, y)| (x, y, blocked(rng, x, y))).collect();
            change.edit_cells(cells)
        }
        4 => change.edit(at, |_, _| false),
        5 => change.edit(at, |x, y| map.is_blocked((x + dx) as i32, (y + dy) as i32)),
        6 => change.edit(at, |_, _| rng.chance(percent)),
        // Closed, then opened in part.
        _ => {
            let inner = Rectangle { width: at.width.min(30), height: at.height.min(30), ..at };
            change.edit(inner, |_, _| true).edit(Rectangle { width: 1, ..inner }, |_, _| false)
        }
    }
}

/// Repaired lists are those that a new table has on the same planes, however large the changes are.
#[derive(Default)]
struct Lists {
    /// Whether the edits are large.
    is_large: bool,
    repaired: u64,
    anew: u64,
    lists: usize,
    replaced: usize,
}

impl Test for Lists {
    fn on<P: Placement>(&mut self, rule: P::Rule, k: u32, seed: u64) {
        let (rng, never) = (&mut Rng::new(seed), &Interrupt::NEVER);
        let mut was_full = false;
        let (steps, first) = if self.is_large { (6, large_grid(seed)) } else { (20, grid(seed)) };
        let mut map = Arc::new(first);
        let reach = [0, REACH, 3][rng.below(3) as usize];
        let new = |graph: &GridGraph<P>, pruning: &Pruning<P>| {
            let mut planes = planes(graph, pruning, reach);
            let rows = std::mem::take(&mut planes.dead_ends);
            let blocks = BlockFinder::with_planes(graph, planes);
            let lists = JumpLists::new(&Recorder { graph, pruning, blocks: &blocks }, &rows, never).unwrap();
            (blocks, lists)
        };
        let first = graph::<P>(&map, rule, k);
        let (mut blocks, mut lists) = new(&first, &Pruning::new(&first));
        for step in 0..steps {
            let change = if self.is_large { large_edit(rng, &map) } else { edit(rng, &map) };
            let graph = &graph::<P>(change.after(), rule, k);
            let pruning = &Pruning::new(graph);
            let stops = (blocks.axial_stops(), blocks.diagonal_stops(), reach);
            let repair = Repair::new(graph, pruning.table().unwrap(), stops, never).without_limit();
            let repaired = repair.follow(&change).and_then(|(axial, diagonals, altered)| {
                let planes = JumpPlanes { axial, diagonals, dead_ends: DeadEndRows::default(), reach };
                let next = BlockFinder::with_planes(graph, planes);
                let recorder = Recorder { graph, pruning, blocks: &next };
                let altered = (blocks.axial_stops(), &altered);
                let repaired = lists.repaired_within([usize::MAX; 2], &recorder, altered, never)?;
                Ok((next, repaired))
            });
            if let Ok((next, repaired)) = repaired {
                let recorder = Recorder { graph, pruning, blocks: &next };
                let [was, is] = [&lists, &repaired].map(JumpLists::listed);
                let rows = rows_of(graph, &dead_ends(graph, next.axial_stops()));
                let new = JumpLists::new(&recorder, &rows, never).unwrap().listed();
                let case = || {
                    let at = Vertex::default();
                    let name = describe(change.before(), P::rules(rule), at, at, seed);
                    format!("step {step}, k = {k}, reach {reach}, {:?}, {name}", change.cells())
                };
                assert!(are_new(graph, (&is, &new), &mut was_full), "{}", case());
                self.lists += is.len();
                self.replaced += is.iter().filter(|list| was.binary_search(list).is_err()).count();
                self.repaired += 1;
                (blocks, lists) = (next, repaired);
            } else {
                (blocks, lists) = new(graph, pruning);
                self.anew += 1;
            }
            map = Arc::clone(change.after());
        }
    }
}

#[test]
fn repaired_lists_are_new_ones() {
    let mut test = Lists::default();
    on_all(seeds(8), &mut test);
    let Lists { repaired, anew, lists, replaced, .. } = test;
    assert!(repaired > 1_200 && anew > 10, "{repaired} repaired, {anew} anew");
    assert!(lists > 200_000 && replaced > 20_000, "{lists} lists, {replaced} of them replaced");
}

#[test]
fn lists_repaired_after_large_edits_are_new_ones() {
    let mut test = Lists { is_large: true, ..Lists::default() };
    on_all(seeds(8), &mut test);
    let Lists { repaired, lists, replaced, .. } = test;
    assert!(repaired > 300, "{repaired} repaired");
    assert!(lists > 100_000 && replaced > 40_000, "{lists} lists, {replaced} of them replaced");
}

/// Tables that follow large edits as far as that is quicker, and then are made anew, have the lists of new
/// ones on their planes, and lead to the costs of A\*.
#[derive(Default)]
struct Large {
    /// The edits after which lists were repaired, and made anew.
    repaired: u64,
    anew: u64,
    found: u64,
}

impl Test for Large {
    fn on<P: Placement>(&mut self, rule: P::Rule, k: u32, seed: u64) {
        let rng = &mut Rng::new(seed);
        let mut map = Arc::new(large_grid(seed));
        let mut table = JumpTable::new(&graph::<P>(&map, rule, k)).unwrap();
        let mut was_full = false;
        for step in 0..6 {
            // Of two edits one is small.
            let change = if rng.chance(50) { large_edit(rng, &map) } else { edit(rng, &map) };
            let graph = &graph::<P>(change.after(), rule, k);
            let pruning = Arc::new(Pruning::new(graph));
            table = table.repaired(graph, &pruning, &change, &Interrupt::NEVER).unwrap();
            let new = new_lists(graph, &pruning, &table);
            // Repaired lists have room for others.
            let is_new = table.lists().memory_bytes() == new.memory_bytes();
            *if is_new { &mut self.anew } else { &mut self.repaired } += 1;
            let [is, new] = [table.lists(), &new].map(JumpLists::listed);
            let case = |start, goal| {
                let name = describe(graph.grid(), P::rules(rule), start, goal, seed);
                format!("step {step}, k = {k}, {:?}, {name}", change.cells())
            };
            assert!(
                are_new(graph, (&is, &new), &mut was_full),
                "{}",
                case(Vertex::default(), Vertex::default())
            );
            let mut jps = JpsPlus::with_finder(graph, pruning, Arc::new(table.clone()), Hk).unwrap();
            let mut free = || random_free_vertex(rng, graph.grid(), P::KIND);
            if let (Some(start), Some(goal)) = (free(), free()) {
                let length = |path: Option<&Path>| path.map(|path| (path.cost() * 1e9).round());
                let query = Ends::new(start, goal);
                let expected = length(AStar::new(graph, Hk).solve(query).unwrap().path());
                assert_eq!(length(jps.solve(query).unwrap().path()), expected, "{}", case(start, goal));
                self.found += u64::from(expected.is_some());
            }
            map = Arc::clone(change.after());
        }
    }
}

#[test]
fn tables_follow_large_edits() {
    let mut test = Large::default();
    on_all(seeds(8), &mut test);
    let Large { repaired, anew, found } = test;
    assert!(repaired > 50 && anew > 50, "{repaired} repaired, {anew} anew");
    assert!(found > 150, "{found} paths");
}

/// Searches by a table that was repaired again and again find what A\* finds, and its bytes give a new table.
#[derive(Default)]
struct Costs {
    repaired: u64,
    anew: u64,
    queries: u64,
    found: u64,
    read: u64,
}

impl Test for Costs {
    fn on<P: Placement>(&mut self, rule: P::Rule, k: u32, seed: u64) {
        let rng = &mut Rng::new(seed);
        let mut map = Arc::new(match seed % 4 {
            0 => rooms(rng, 130, 70),
            1 => caves(rng, 66, 60),
            2 => noise(rng, 63, 64, 2),
            _ => grid(seed / 4),
        });
        let mut table = JumpTable::new(&graph::<P>(&map, rule, k)).unwrap();
        for step in 0..20 {
            let change = edit(rng, &map);
            let graph = &graph::<P>(change.after(), rule, k);
            let pruning = Arc::new(Pruning::new(graph));
            table = table.repaired(graph, &pruning, &change, &Interrupt::NEVER).unwrap();
            *if is_repaired(&table) { &mut self.repaired } else { &mut self.anew } += 1;
            if rng.below(20) == 0 {
                let read = JumpTable::from_bytes(graph, &table.to_bytes());
                assert_eq!(read, Ok(JumpTable::new(graph).unwrap()), "seed {seed}, step {step}, k = {k}");
                self.read += 1;
            }
            let mut jps = JpsPlus::with_finder(graph, pruning, Arc::new(table.clone()), Hk).unwrap();
            let mut astar = AStar::new(graph, Hk);
            for _ in 0..3 {
                let mut free = || random_free_vertex(rng, graph.grid(), P::KIND);
                let (Some(start), Some(goal)) = (free(), free()) else { continue };
                let length = |path: Option<&Path>| path.map(|path| (path.cost() * 1e9).round());
                let query = Ends::new(start, goal);
                let expected = length(astar.solve(query).unwrap().path());
                let found = length(jps.solve(query).unwrap().path());
                let case = || describe(graph.grid(), P::rules(rule), start, goal, seed);
                assert_eq!(found, expected, "step {step}, k = {k}, {}", case());
                self.queries += 1;
                self.found += u64::from(expected.is_some());
            }
            map = Arc::clone(change.after());
        }
    }
}

#[test]
fn repaired_tables_lose_no_path() {
    let mut test = Costs::default();
    on_all(seeds(4), &mut test);
    // There a large edit leaves so few jump points that a new table would look for dead ends.
    test.on::<Centers>(CornerRule::Never, 2, 102);
    let Costs { repaired, anew, queries, found, read } = test;
    assert!(repaired > 300 && anew > 10 && read > 20, "{repaired} repaired, {anew} anew, {read} read");
    assert!(queries > 1_500 && found > 1_000, "{found} of {queries}");
}

/// The edits of single cells on a map of rooms, one after another, with about as many blocked all the time.
/// Calls `check` with each number and table.
fn chain(edits: usize, mut table: JumpTable, mut check: impl FnMut(usize, &GridGraph<Centers>, &JumpTable)) {
    let (rng, first) = (&mut Rng::new(8), Arc::new(town()));
    let mut map = Arc::clone(&first);
    for edit in 0..edits {
        let (x, y) = (rng.below(map.width()), rng.below(map.height()));
        let was_blocked = first.is_blocked(x as i32, y as i32);
        let change = Change::new(Arc::clone(&map)).edit_cells([(x, y, was_blocked != rng.chance(10))]);
        let graph = graph::<Centers>(change.after(), CornerRule::Never, 3);
        table = table.repaired(&graph, &Pruning::new(&graph), &change, &Interrupt::NEVER).unwrap();
        check(edit, &graph, &table);
        map = Arc::clone(change.after());
    }
}

fn town() -> Grid {
    rooms(&mut Rng::new(8), 85, 45)
}

fn first_table() -> JumpTable {
    JumpTable::new(&graph::<Centers>(&Arc::new(town()), CornerRule::Never, 3)).unwrap()
}

/// Whatever comes and goes, lists are put together again before they take much more memory than they need.
#[test]
fn lists_stay_small() {
    let (mut last, mut together) = (0, 0);
    chain(2_000, first_table(), |edit, graph, table| {
        let used = table.lists().memory_bytes();
        together += u32::from(used != last);
        last = used;
        if edit % 50 == 0 {
            let new = new_lists(graph, &Pruning::new(graph), table);
            let needed = new.memory_bytes();
            assert!(used < needed + needed / 2 + 8_000, "{used} bytes, edit {edit}, {needed} are needed");
            assert!(table.lists().listed() == new.listed(), "edit {edit}");
        }
    });
    assert!((5..200).contains(&together), "{together}");
}

/// Beyond the limit no list is added, and jumps are scanned.
#[test]
fn lists_stay_within_their_limit() {
    let words = |lists: &[Listed]| lists.iter().map(|(.., list)| list.len() + 1).sum::<usize>();
    let first = first_table();
    let most = words(&first.lists().listed()) / 2;
    let (mut last, mut fewer, mut longest) = (usize::MAX, 0, 0.0_f64);
    chain(1_200, first.with_list_limit(most), |edit, graph, table| {
        let lists = table.lists().listed();
        let used = words(&lists);
        assert!(used <= last.max(most), "edit {edit}: {used}, {last}");
        last = used;
        if edit % 20 == 0 {
            let pruning = Pruning::new(graph);
            let new = new_lists(graph, &pruning, table).listed();
            assert!(lists.iter().all(|list| new.binary_search(list).is_ok()), "edit {edit}");
            fewer += u32::from(lists.len() < new.len());
            let mut jps = JpsPlus::new(graph, Arc::new(table.clone()), Hk).unwrap();
            let query = Ends::new((1, 1), (83, 43));
            let expected = AStar::new(graph, Hk).solve(query).unwrap().path().map_or(0.0, Path::cost);
            let found = jps.solve(query).unwrap().path().map_or(0.0, Path::cost);
            assert!((found - expected).abs() < 1e-9 * (1.0 + expected), "edit {edit}: {found}, {expected}");
            longest = longest.max(found);
        }
    });
    assert!(last <= most && fewer > 10 && longest > 80.0, "{last} of {most}, {fewer}, {longest}");
}

#[test]
fn changes_of_other_maps_are_refused() {
    let map = Arc::new(town());
    let change = Change::new(Arc::clone(&map)).edit_cells([(3, 3, map.is_free(3, 3))]);
    let [before, after] =
        [change.before(), change.after()].map(|map| graph::<Centers>(map, CornerRule::Never, 3));
    let [old, new] = [&before, &after].map(Pruning::new);
    let (table, never) = (first_table(), &Interrupt::NEVER);
    let nothing = Change::new(Arc::clone(&map));
    let refused = |result| assert!(matches!(result, Err(JumpError::Mismatch(_))), "{result:?}");
    refused(table.repaired(&after, &old, &change, never));
    refused(table.repaired(&before, &old, &change, never));
    refused(table.repaired(&after, &new, &nothing, never));
    assert_eq!(table.repaired(&before, &old, &nothing, never), Ok(table.clone()));
    assert_eq!(table.repaired(&after, &new, &change, never).unwrap().identity(), after.identity());
}

/// A list of cells changes, first one of them, then two, and so on. Counts the changes that jump lists
/// follow. After all others they are made anew, and are equal: only these counts show when a repair is given
/// up.
#[test]
fn the_number_of_repairs_is_pinned() {
    fn repaired<P: Placement>(rule: P::Rule, k: u32) -> usize {
        let (rng, never) = (&mut Rng::new(11), &Interrupt::NEVER);
        let map = Arc::new(noise(rng, 250, 200, 1));
        let cells: Vec<(u32, u32)> = (0..40).map(|_| (rng.below(250), rng.below(200))).collect();
        let first = &graph::<P>(&map, rule, k);
        let pruning = &Pruning::new(first);
        let blocks = BlockFinder::with_planes(first, planes(first, pruning, 0));
        let recorder = Recorder { graph: first, pruning, blocks: &blocks };
        let lists = JumpLists::new(&recorder, &DeadEndRows::default(), never).unwrap();
        let stops = (blocks.axial_stops(), blocks.diagonal_stops(), 0);
        let is_repaired = |&count: &usize| {
            let cells = cells[..count].iter().map(|&(x, y)| (x, y, map.is_free(x as i32, y as i32)));
            let change = Change::new(Arc::clone(&map)).edit_cells(cells);
            let graph = &graph::<P>(change.after(), rule, k);
            let pruning = &Pruning::new(graph);
            let repair = Repair::new(graph, pruning.table().unwrap(), stops, never).without_limit();
            let (axial, diagonals, altered) = repair.follow(&change).unwrap();
            let planes = JumpPlanes { axial, diagonals, dead_ends: DeadEndRows::default(), reach: 0 };
            let next = BlockFinder::with_planes(graph, planes);
            let recorder = Recorder { graph, pruning, blocks: &next };
            lists.repaired(&recorder, blocks.axial_stops(), &altered, never).is_ok()
        };
        (1..=cells.len()).filter(is_repaired).count()
    }
    let found = [2, 3]
        .map(|k| [repaired::<Centers>(CornerRule::Never, k), repaired::<Centers>(CornerRule::Always, k)]);
    assert_eq!(found, [[8, 8], [10, 11]]);
}
