use std::sync::Arc;

use mediant_grid::{AsciiMap, DiagonalGap, Grid, Vertex};

use super::*;

fn space(drawing: &str, gap: DiagonalGap) -> FreeSpace<Corners> {
    FreeSpace::new(Arc::new(AsciiMap::parse(drawing).expect("the drawing is a map").grid), gap)
}

fn opened(space: &FreeSpace<Corners>) -> Opened {
    Opened::new(Arc::new(DeadEnds::new(space)))
}

/// The map with `x` for closed dead ends.
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
    dead_ends.open(space.grid(), [Vertex::new(0, 0), Vertex::new(2, 7)]);
    assert!(!draw(&dead_ends, space.grid()).contains('x'));
    // The way up is shut.
    dead_ends.open(space.grid(), [Vertex::new(0, 6), Vertex::new(2, 7)]);
    assert_eq!(draw(&dead_ends, space.grid()), ".....\n.#.#.\nxxxxx\n#.###\n...##\n.#.##\n...##");
    dead_ends.open(space.grid(), [Vertex::new(0, 0), Vertex::new(5, 3)]);
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
    dead_ends.open(space.grid(), [Vertex::new(4, 0), Vertex::new(5, 4)]);
    let open = "##..####xxx\n#...####..x\nx......x#.x\nx.##...x..x\nx.##...x#.x\nx......x..x";
    assert_eq!(draw(&dead_ends, space.grid()), open);
    dead_ends.open(space.grid(), [Vertex::new(9, 3), Vertex::new(9, 4)]);
    assert_eq!(draw(&dead_ends, space.grid()), closed);
    // From the one obstacle to the other one: the column that parts them is open.
    dead_ends.open(space.grid(), [Vertex::new(5, 3), Vertex::new(8, 4)]);
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
