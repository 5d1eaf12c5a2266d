use std::sync::Arc;

use mediant_grid::{AsciiMap, Change, DiagonalGap, Grid, Rectangle, Vertex, sight::Place};
use mediant_oracle::{Rng, caves, maze, noise, rooms, seeds};

use super::{parts::Link, *};

fn space(drawing: &str, gap: DiagonalGap) -> FreeSpace<Corners> {
    FreeSpace::new(Arc::new(AsciiMap::parse(drawing).expect("the drawing is a map").grid), gap)
}

fn opened(space: &FreeSpace<Corners>) -> Opened {
    Opened::new(Arc::new(DeadEnds::new(space)))
}

/// The map with `x` for closed dead ends.
fn ends(start: (i32, i32), goal: (i32, i32)) -> [Place; 2] {
    [start, goal].map(|at| Place::of(at.into()))
}

fn draw(dead_ends: &Opened, grid: &Grid) -> String {
    let cell = |x, y| match (grid.is_blocked(x, y), dead_ends.rows().row(y).is_blocked(x)) {
        (true, _) => '#',
        (false, true) => 'x',
        (false, false) => '.',
    };
    let (width, height) = (grid.width() as i32, grid.height() as i32);
    let lines = (0..height).map(|y| (0..width).map(|x| cell(x, y)).collect());
    lines.collect::<Vec<String>>().join("\n")
}

/// A room behind a corridor is open only if a path starts or ends there; what is before it is then open
/// only if it is needed.
#[test]
fn parts_that_are_not_on_the_way_are_shut() {
    let space = space(".....\n.#.#.\n.....\n#.###\n...##\n.#.##\n...##", DiagonalGap::Closed);
    let mut dead_ends = opened(&space);
    let closed = ".....\n.#.#.\n.....\n#x###\n...##\n.#.##\n...##";
    assert_eq!(draw(&dead_ends, space.grid()), closed);
    dead_ends.open(space.grid(), ends((0, 0), (2, 7)));
    assert!(!draw(&dead_ends, space.grid()).contains('x'));
    // The way up is shut.
    dead_ends.open(space.grid(), ends((0, 6), (2, 7)));
    assert_eq!(draw(&dead_ends, space.grid()), ".....\n.#.#.\nxxxxx\n#.###\n...##\n.#.##\n...##");
    dead_ends.open(space.grid(), ends((0, 0), (5, 3)));
    assert_eq!(draw(&dead_ends, space.grid()), closed);
}

/// A bay on the left, an edge that is rough, and a gap.
const BAYS: &str = "
    ##..####...
    #...####...
    ........#..
    ..##.......
    ..##....#..
    ...........
";

#[test]
fn only_the_ways_around_obstacles_are_left() {
    let space = space(BAYS, DiagonalGap::Open);
    let mut dead_ends = opened(&space);
    let closed = "##xx####xxx\n#xxx####..x\nx.....x.#.x\nx.##..x...x\nx.##..x.#.x\nx.....x...x";
    assert_eq!(draw(&dead_ends, space.grid()), closed);
    // From a corner of the bay to a place that is in no dead end; the way to the other obstacle is shut.
    dead_ends.open(space.grid(), ends((4, 0), (5, 4)));
    let open = "##..####xxx\n#...####..x\nx......x#.x\nx.##...x..x\nx.##...x#.x\nx......x..x";
    assert_eq!(draw(&dead_ends, space.grid()), open);
    dead_ends.open(space.grid(), ends((9, 3), (9, 4)));
    assert_eq!(draw(&dead_ends, space.grid()), closed);
    // From the one obstacle to the other one: the column that parts them is open.
    dead_ends.open(space.grid(), ends((5, 3), (8, 4)));
    let open = "##xx####xxx\n#xxx####..x\nx.......#.x\nx.##......x\nx.##....#.x\nx.........x";
    assert_eq!(draw(&dead_ends, space.grid()), open);
}

/// Where paths may pass a gap, what is behind it is no dead end.
#[test]
fn an_open_gap_leads_on() {
    let blocked = |gap| {
        let space = space("..##\n..##\n##..\n##..", gap);
        draw(&opened(&space), space.grid())
    };
    assert_eq!(blocked(DiagonalGap::Open), "xx##\nx.##\n##.x\n##xx");
    assert_eq!(blocked(DiagonalGap::Closed), "xx##\nx.##\n##xx\n##x.");
}

/// Checks that the bridges are the only ways to what hangs on them, by a look at all cells.
fn check_bridges(lines: &BitMatrix, parts: &Parts, gaps_are_open: bool, case: &str) {
    let (width, height) = (lines.width() as i32, lines.height() as i32);
    let is_free =
        |x: i32, y: i32| (0..width).contains(&x) && (0..height).contains(&y) && !lines.row(y).is_blocked(x);
    let steps = [(1, 0), (0, 1), (1, 1), (-1, 1)];
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        for (dx, dy) in steps {
            let is_diagonal = dx != 0 && dy != 0;
            let touches = !is_diagonal || gaps_are_open && !is_free(x + dx, y) && !is_free(x, y + dy);
            if !is_free(x, y) || !is_free(x + dx, y + dy) || !touches {
                continue;
            }
            let (mut a, mut b) = (parts.of(x, y), parts.of(x + dx, y + dy));
            while a != b {
                let part = parts.part(a.max(b));
                let cells = if a > b { [(x, y), (x + dx, y + dy)] } else { [(x + dx, y + dy), (x, y)] };
                let is_in = |run: CellRun, (x, y): (i32, i32)| y == run.line && run.first <= x && x < run.end;
                let is_door = is_in(part.inner, cells[0]) && is_in(part.outer, cells[1]) && !is_diagonal;
                assert!(part.link == Link::Joined || is_door, "{part:?} at ({x}, {y}); {case}");
                *(if a > b { &mut a } else { &mut b }) = part.parent;
            }
        }
    }
    for part in parts.parts.iter().filter(|part| part.link == Link::Bridge) {
        for run in [part.inner, part.outer] {
            let row = lines.row(run.line);
            let is_run = row.first_free(run.first, width) == run.first
                && row.first_blocked(run.first, width) == run.end
                && !is_free(run.first - 1, run.line);
            assert!(is_run, "{run:?} of {part:?}; {case}");
        }
    }
}

/// Whether the dead ends can be blocked in some order, each while it is one.
fn check_order(dead_ends: &DeadEnds, space: &FreeSpace<Corners>, case: &str) {
    let grid = space.grid();
    let mut search = DeadEndSearch::new(space);
    let cells = || (0..grid.height() as i32).flat_map(|y| (0..grid.width() as i32).map(move |x| (x, y)));
    let is_left = |rows: &BitMatrix, (x, y): (i32, i32)| {
        dead_ends.rows.row(y).is_blocked(x) && !rows.row(y).is_blocked(x)
    };
    let mut is_done = false;
    while !is_done {
        is_done = true;
        for (x, y) in cells() {
            if !is_left(&search.rows, (x, y)) {
                continue;
            }
            let run = dead_ends.run_of(grid, x, y);
            let at = if run.is_vertical { y } else { x };
            let side = dead_ends.line_behind_door(run) - run.line;
            if search.run_at(run.is_vertical, run.line, at) == Some(run)
                && search.door(run).is_some_and(|(found, _)| found == side)
            {
                search.block(run, side);
                is_done = false;
            }
        }
    }
    for (x, y) in cells() {
        let [is_blocked, is_open] = [dead_ends.rows.row(y), grid.rows().row(y)].map(|row| row.is_blocked(x));
        assert!(is_blocked || !is_open, "({x}, {y}) is open; {case}");
        assert_eq!(is_blocked, search.rows.row(y).is_blocked(x), "({x}, {y}); {case}");
        assert_eq!(is_blocked, dead_ends.columns.row(x).is_blocked(y), "({x}, {y}); {case}");
        let Kinds { vertical, vertical_columns, beyond } = &dead_ends.kinds;
        let is_dead_end = is_blocked && !is_open;
        assert_eq!(
            vertical.row(y).is_blocked(x),
            vertical_columns.row(x).is_blocked(y),
            "({x}, {y}); {case}"
        );
        let is_marked = vertical.row(y).is_blocked(x) || beyond.row(y).is_blocked(x);
        assert!(is_dead_end || !is_marked, "({x}, {y}); {case}");
    }
}

/// Blocked cells and bridges of dead ends.
fn count(dead_ends: &DeadEnds) -> [usize; 2] {
    let closed: u32 = dead_ends.rows.words().iter().map(|word| word.count_ones()).sum();
    let parts = dead_ends.parts.iter().flat_map(|parts| parts.parts.iter());
    [closed as usize, parts.filter(|part| part.link == Link::Bridge).count()]
}

/// Cells are blocked and freed by any edit, doors closed and opened, and all that the proofs need is looked
/// at. Returns the counts of repaired dead ends in the end, and those of new ones.
fn check_chain(seed: u64) -> [[usize; 2]; 2] {
    let rng = &mut Rng::new(seed ^ 0xDEAD);
    let (width, height) = (4 + rng.below(30), 4 + rng.below(30));
    let grid = match rng.below(5) {
        0 => maze(rng, width, height),
        1 => caves(rng, width, height),
        2 => noise(rng, width, height, 25),
        _ => rooms(rng, width, height),
    };
    let (gap, mut grid) = (DiagonalGap::ALL[rng.below(2) as usize], Arc::new(grid));
    let mut dead_ends = Arc::new(DeadEnds::new(&FreeSpace::new(Arc::clone(&grid), gap)));
    let mut followed = Opened::new(Arc::clone(&dead_ends));
    let mut last = (0, 0);
    for edit in 0..20 {
        let at = Rectangle { x: rng.below(width), y: rng.below(height), width: 1, height: 1 };
        let flip = |change: Change, x: u32, y: u32| {
            let is_blocked = change.after().is_blocked(x as i32, y as i32);
            change.edit_cells([(x, y, !is_blocked)])
        };
        let change = Change::new(Arc::clone(&grid));
        let change = match rng.below(6) {
            0 => flip(change, last.0, last.1),
            1 => {
                let at = Rectangle { width: 1 + rng.below(6), height: 1 + rng.below(6), ..at };
                let percent = [0, 50, 100][rng.below(3) as usize];
                change.edit(at, |_, _| rng.below(100) < percent)
            }
            2 => flip(flip(change, at.x, at.y), rng.below(width), rng.below(height)),
            _ => flip(change, at.x, at.y),
        };
        last = (at.x, at.y);
        let space = FreeSpace::new(Arc::clone(change.after()), gap);
        let case = format!("seed {seed}, edit {edit}");
        dead_ends = Arc::new(uninterrupted(|never| dead_ends.repaired(&space, &change, never)));
        grid = Arc::clone(change.after());
        check_order(&dead_ends, &space, &case);
        let [of_rows, of_columns] = &dead_ends.parts;
        check_bridges(&dead_ends.rows, of_rows, gap == DiagonalGap::Open, &case);
        check_bridges(&dead_ends.columns, of_columns, gap == DiagonalGap::Open, &case);
        if rng.below(4) == 0 {
            continue;
        }
        let end = |rng: &mut Rng| Place::of(Vertex::new(rng.below(width) as i32, rng.below(height) as i32));
        followed.follow(Arc::clone(&dead_ends));
        let mut new = Opened::new(Arc::clone(&dead_ends));
        assert!(followed.is_same(&new), "{case}");
        let ends = [end(rng), end(rng)];
        followed.open(&grid, ends);
        new.open(&grid, ends);
        assert!(followed.is_same(&new), "{case}");
    }
    [count(&dead_ends), count(&DeadEnds::new(&FreeSpace::new(grid, gap)))]
}

#[test]
fn repairs_keep_what_the_proofs_need() {
    let counts = seeds(60).map(check_chain);
    let add = |a: [usize; 2], b: [usize; 2]| [a[0] + b[0], a[1] + b[1]];
    let [[closed, bridges], [new_closed, new_bridges]] =
        counts.fold([[0; 2]; 2], |sums, counts| [add(sums[0], counts[0]), add(sums[1], counts[1])]);
    assert!(closed * 100 >= new_closed * 99, "{closed} cells are blocked, {new_closed} by new ones");
    // On such small maps most edits make ways around, and new bridges.
    assert!(bridges * 12 >= new_bridges, "{bridges} bridges, {new_bridges} of new ones");
}

/// The blocked cells and the bridges that are left after chains of edits: no path shows that more could have
/// been kept.
#[test]
fn the_number_of_kept_dead_ends_is_pinned() {
    let counts = (0..40).map(|seed| check_chain(seed)[0]);
    assert_eq!(counts.fold([0; 2], |sums, counts| [sums[0] + counts[0], sums[1] + counts[1]]), [55_850, 20]);
}
