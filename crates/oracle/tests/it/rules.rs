//! The rules of motion, each on a map drawn by hand, and what must hold on all maps.

use mediant_grid::{AsciiMap, CornerRule, DiagonalGap, Grid, PlacementKind, Rules, Vertex};
use mediant_moves::{FiniteK, Vector};
use mediant_oracle::{
    Rng, describe, is_gap, neighborhood, random_free_vertex, random_grid, segment_is_legal, turn_is_legal,
    vertex_is_free,
};

const OPEN: Rules = Rules::Corner(DiagonalGap::Open);
const CLOSED: Rules = Rules::Corner(DiagonalGap::Closed);

fn grid(drawing: &str) -> Grid {
    AsciiMap::parse(drawing).expect("a drawing in a test").grid
}

fn vertex((x, y): (i32, i32)) -> Vertex {
    Vertex::new(x, y)
}

/// Checks a segment both ways under the given rules.
fn check(drawing: &str, a: (i32, i32), b: (i32, i32), expected: &[(Rules, bool)]) {
    let (grid, a, b) = (grid(drawing), vertex(a), vertex(b));
    for &(rules, legal) in expected {
        for (a, b) in [(a, b), (b, a)] {
            assert_eq!(segment_is_legal(&grid, rules, a, b), legal, "{}", describe(&grid, rules, a, b, 0));
        }
    }
}

/// Expectations for corner rules never, one, always.
fn center(legal: [bool; 3]) -> Vec<(Rules, bool)> {
    [CornerRule::Never, CornerRule::One, CornerRule::Always]
        .map(Rules::Center)
        .into_iter()
        .zip(legal)
        .collect()
}

#[test]
fn centers_every_touched_cell_must_be_free() {
    check("...\n#..", (0, 0), (2, 1), &center([true; 3]));
    check(".#.\n...", (0, 0), (2, 1), &center([false; 3]));
    check("...\n.#.", (0, 0), (2, 1), &center([false; 3]));
    check("....", (0, 0), (3, 0), &center([true; 3]));
    check("..#.", (0, 0), (3, 0), &center([false; 3]));
    check("###\n...\n###", (0, 1), (2, 1), &center([true; 3]));
}

#[test]
fn centers_corner_rule() {
    check("..\n..", (0, 0), (1, 1), &center([true, true, true]));
    check(".#\n..", (0, 0), (1, 1), &center([false, true, true]));
    check(".#\n#.", (0, 0), (1, 1), &center([false, false, true]));
    // (3, 1) passes the corner point in its middle, where it only touches the cells (2, 0) and (1, 1).
    check("..#.\n....", (0, 0), (3, 1), &center([false, true, true]));
    check("..#.\n.#..", (0, 0), (3, 1), &center([false, false, true]));
    check(".#..\n....", (0, 0), (3, 1), &center([false, false, false]));
    // One blocked cell at each of two corner points is one too many only when both are at the same.
    check(".#.\n..#\n...", (0, 0), (2, 2), &center([false, true, true]));
    check(".#.\n#..\n...", (0, 0), (2, 2), &center([false, false, true]));
}

#[test]
fn corners_open_interiors_must_be_free() {
    let both = |legal| [(OPEN, legal), (CLOSED, legal)];
    check("..\n##", (0, 0), (2, 1), &both(true));
    check(".#\n..", (0, 0), (2, 1), &both(false));
    check("#.\n..", (0, 0), (2, 1), &both(false));
    check(".#\n#.", (0, 0), (1, 1), &both(true));
    check(".#\n#.", (1, 0), (0, 1), &both(true));
    check(".#\n#.", (1, 0), (2, 1), &both(false));
    // (3, 2) from the corner of a blocked cell touches it in one point only.
    check("#...\n....\n....", (1, 1), (4, 3), &both(true));
    // The diagonal of the free cells grazes blocked ones on both sides, but not at the same vertex.
    check(".#.\n...\n.#.", (0, 0), (3, 3), &both(true));
}

#[test]
fn corners_edges_of_two_blocked_cells_are_closed() {
    let both = |legal| [(OPEN, legal), (CLOSED, legal)];
    check("..\n##", (0, 1), (2, 1), &both(true));
    check(".#\n##", (0, 1), (2, 1), &both(false));
    check(".#\n##", (0, 1), (1, 1), &both(true));
    check("##\n.#", (1, 0), (1, 2), &both(false));
    // The border: outside is blocked.
    check(".#.", (0, 0), (1, 0), &both(true));
    check(".#.", (1, 0), (2, 0), &both(false));
    check(".#.", (0, 1), (3, 1), &both(false));
    check(".\n#\n.", (0, 0), (0, 3), &both(false));
    check(".\n#\n.", (1, 1), (1, 2), &both(false));
    check(".\n.\n.", (1, 0), (1, 3), &both(true));
}

#[test]
fn corners_diagonal_gap() {
    let gap = |open, closed| [(OPEN, open), (CLOSED, closed)];
    let falling = "#.\n.#";
    check(falling, (0, 2), (2, 0), &gap(true, false));
    check(falling, (0, 1), (2, 1), &gap(true, false));
    check(falling, (1, 0), (1, 2), &gap(true, false));
    check(falling, (0, 0), (2, 2), &gap(false, false));
    // Touching the corner with an end is no crossing.
    check(falling, (0, 1), (1, 1), &gap(true, true));
    check(falling, (0, 2), (1, 1), &gap(true, true));
    check(".#\n#.", (0, 0), (2, 2), &gap(true, false));
    // With a third cell blocked or freed there is no gap.
    check("..\n.#", (0, 2), (2, 0), &gap(true, true));
    check("##\n.#", (0, 2), (1, 1), &gap(true, true));
    check("##\n.#", (1, 1), (1, 2), &gap(true, true));
}

#[test]
fn free_vertices() {
    let grid = grid("##.\n##.");
    let free = |placement, at| vertex_is_free(&grid, placement, vertex(at));
    assert!(free(PlacementKind::Center, (2, 1)) && !free(PlacementKind::Center, (1, 1)));
    assert!(!free(PlacementKind::Center, (3, 0)) && !free(PlacementKind::Center, (-1, 0)));
    assert!(free(PlacementKind::Corner, (3, 2)) && free(PlacementKind::Corner, (2, 1)));
    assert!(!free(PlacementKind::Corner, (1, 1)) && !free(PlacementKind::Corner, (0, 0)));
    assert!(!free(PlacementKind::Corner, (4, 2)) && !free(PlacementKind::Corner, (3, -1)));
    for extreme in [(i32::MIN, 0), (0, i32::MAX), (i32::MAX, i32::MIN)] {
        assert!(
            !free(PlacementKind::Corner, extreme) && !free(PlacementKind::Center, extreme),
            "{extreme:?}"
        );
        assert!(!segment_is_legal(&grid, OPEN, vertex(extreme), Vertex::new(2, 1)));
        assert!(!is_gap(&grid, vertex(extreme)));
        assert!(turn_is_legal(&grid, Some(vertex(extreme)), Vertex::new(2, 1), Some(vertex(extreme))));
    }
}

#[test]
fn gaps() {
    for (drawing, expected) in [
        ("#.\n.#", true),
        (".#\n#.", true),
        ("##\n.#", false),
        ("#.\n#.", false),
        ("#.\n..", false),
        ("##\n##", false),
        ("..\n..", false),
    ] {
        assert_eq!(is_gap(&grid(drawing), Vertex::new(1, 1)), expected, "{drawing}");
    }
    // Outside is blocked on two sides at once, so no border vertex has a gap.
    assert!(!is_gap(&grid("#."), Vertex::new(1, 0)));
}

#[test]
fn turns_stay_in_one_free_quadrant() {
    // Blocked to the upper right and lower left; the own cell of (1, 1), to the lower right, is free.
    let own_free = grid(".#\n#.");
    // Mirrored: the own cell is blocked.
    let own_blocked = grid("#.\n.#");
    let check = |grid: &Grid, before: Option<(i32, i32)>, after: Option<(i32, i32)>, expected: bool| {
        let (a, b, at) = (before.map(vertex), after.map(vertex), Vertex::new(1, 1));
        for (a, b) in [(a, b), (b, a)] {
            assert_eq!(
                turn_is_legal(grid, a, at, b),
                expected,
                "{a:?} {b:?}\n{}",
                describe(grid, CLOSED, at, at, 0)
            );
        }
    };
    let (left, right, up, down) = (Some((0, 1)), Some((2, 1)), Some((1, 0)), Some((1, 2)));
    check(&own_free, right, down, true);
    check(&own_free, Some((2, 2)), down, true);
    check(&own_free, left, up, true);
    check(&own_free, left, down, false);
    check(&own_free, left, right, false);
    check(&own_free, up, down, false);
    check(&own_free, Some((0, 0)), Some((2, 2)), false);
    check(&own_free, None, right, true);
    check(&own_free, None, Some((2, 2)), true);
    check(&own_free, None, left, false);
    check(&own_free, None, Some((0, 0)), false);
    check(&own_free, None, None, true);
    check(&own_blocked, left, down, true);
    check(&own_blocked, right, down, false);
    check(&own_blocked, None, left, false);
    check(&own_blocked, None, right, false);
    check(&own_blocked, None, None, true);
    // Where there is no gap, anything goes.
    check(&grid("..\n.#"), Some((0, 2)), Some((2, 0)), true);
    check(&grid("..\n.#"), None, Some((2, 0)), true);
}

#[test]
fn neighborhoods() {
    let k = |k| Some(FiniteK::new(k).unwrap());
    let sorted = |mut moves: Vec<(i32, i32)>| {
        moves.sort_unstable();
        moves.into_iter().map(Vector::from).collect::<Vec<_>>()
    };
    assert_eq!(neighborhood(k(2), 9, 9), sorted(vec![(1, 0), (0, 1), (-1, 0), (0, -1)]));
    let knights = [(1, 2), (2, 1), (1, -2), (2, -1), (-1, 2), (-2, 1), (-1, -2), (-2, -1)];
    let eight = [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)];
    assert_eq!(neighborhood(k(4), 9, 9), sorted([knights, eight].concat()));
    for n in 2..=12 {
        assert_eq!(neighborhood(k(n), 1000, 1000).len(), 1 << n, "|N({n})|");
    }
    // A box cuts moves off, nothing else.
    let all = neighborhood(k(7), 1000, 1000);
    let kept: Vec<_> = all.into_iter().filter(|u| u.x.abs() <= 5 && u.y.abs() <= 2).collect();
    assert_eq!(neighborhood(k(7), 5, 2), kept);
    assert_eq!(neighborhood(k(7), 0, 2), sorted(vec![(0, 1), (0, -1)]));
    let coprime = (-6..=6).flat_map(|x| (-4..=4).map(move |y| Vector::new(x, y))).filter(|u| u.is_move());
    assert_eq!(neighborhood(None, 6, 4), coprime.collect::<Vec<_>>());
}

/// Reversal, mirrored and transposed maps, and the order of the rules, on random maps.
#[test]
fn legality_respects_symmetry_and_the_order_of_rules() {
    let (mut compared, mut gaps) = (0, 0);
    for seed in 0..600 {
        let (grid, _) = random_grid(seed);
        let w = grid.width() as i32;
        let mirrored =
            Grid::from_fn(grid.width(), grid.height(), |x, y| grid.is_blocked(w - 1 - x as i32, y as i32));
        let transposed =
            Grid::from_fn(grid.height(), grid.width(), |x, y| grid.is_blocked(y as i32, x as i32));
        let (mirrored, transposed) = (mirrored.unwrap(), transposed.unwrap());
        let mut rng = Rng::new(seed);
        for rules in [Rules::ALL; 5].into_iter().flatten() {
            let mut draw = || random_free_vertex(&mut rng, &grid, rules.placement());
            let Some((a, b)) = draw().zip(draw()) else { continue };
            let context = describe(&grid, rules, a, b, seed);
            let legal = segment_is_legal(&grid, rules, a, b);
            let last = if rules.placement() == PlacementKind::Center { w - 1 } else { w };
            let mirror = |v: Vertex| Vertex::new(last - v.x, v.y);
            let transpose = |v: Vertex| Vertex::new(v.y, v.x);
            assert_eq!(segment_is_legal(&grid, rules, b, a), legal, "reversed; {context}");
            assert_eq!(
                segment_is_legal(&mirrored, rules, mirror(a), mirror(b)),
                legal,
                "mirrored; {context}"
            );
            let found = segment_is_legal(&transposed, rules, transpose(a), transpose(b));
            assert_eq!(found, legal, "transposed; {context}");
            let weaker = match rules {
                Rules::Center(CornerRule::Never) => Rules::Center(CornerRule::One),
                Rules::Center(_) => Rules::Center(CornerRule::Always),
                Rules::Corner(_) | Rules::CenterGap(_) => OPEN,
            };
            let weakly_legal = segment_is_legal(&grid, weaker, a, b);
            assert!(!legal || weakly_legal, "{weaker} forbids it; {context}");
            compared += 1;
            gaps += u32::from(weakly_legal != legal);
        }
    }
    let enough = compared > 12_500 && gaps > 120;
    assert!(enough, "{compared} segments, {gaps} at which rules differ");
}
