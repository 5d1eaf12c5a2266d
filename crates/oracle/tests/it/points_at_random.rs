//! Points anywhere: what must hold on all maps, and the same costs by other ways.

use mediant_grid::{DiagonalGap, Grid, PlacementKind, Rules, Vertex};
use mediant_oracle::{
    Explicit, PARTS_PER_CELL, Parts, PointKind, PointVisibility, Rng, Visibility, adversarial,
    describe_points, is_gap, magnified, maps_of_nine_cells, noise, point_is_free, random_free_point,
    random_point, seeds, segment_between_points_is_legal, segment_is_legal, suite_grid,
    validate_between_points, vertex_is_free,
};

use crate::points::{GAPS, is_same};

/// The vertex of a map magnified `times` that is this point, which must be one.
fn vertex_of((x, y): Parts, times: u32) -> Vertex {
    let part = PARTS_PER_CELL / i64::from(times);
    assert_eq!((x % part, y % part), (0, 0));
    Vertex::new((x / part) as i32, (y / part) as i32)
}

/// All points that are vertices of the map magnified `times`.
fn vertices_of(grid: &Grid, times: u32) -> Vec<Parts> {
    let part = PARTS_PER_CELL / i64::from(times);
    let (columns, rows) = (i64::from(grid.width() * times), i64::from(grid.height() * times));
    (0..=rows).flat_map(|y| (0..=columns).map(move |x| (x * part, y * part))).collect()
}

/// A small map, in which points see each other often enough, yet gaps are many.
fn small_grid(rng: &mut Rng) -> Grid {
    let (width, height) = (1 + rng.below(6), 1 + rng.below(6));
    if rng.chance(30) {
        return adversarial(rng, width, height);
    }
    let percent = 10 + rng.below(50);
    noise(rng, width, height, percent)
}

fn is_gap_at(grid: &Grid, (x, y): Parts) -> bool {
    let on_lines = x % PARTS_PER_CELL == 0 && y % PARTS_PER_CELL == 0;
    on_lines && is_gap(grid, vertex_of((x, y), 1))
}

/// From every corner, center and middle of an edge to every other one, on all maps of 3 × 3 cells, against
/// Dijkstra on the explicit graph of all legal moves of the map with 2 × 2 cells a cell. That graph assumes
/// nothing about optimal paths. Gaps of both maps are the same, and so are their own quadrants.
#[test]
fn exact_between_centers_corners_and_edges_of_nine_cells() {
    let (mut found, mut unreachable, mut closed_end) = (0, 0, 0);
    for (cells, grid) in maps_of_nine_cells(7) {
        let (points, doubled) = (vertices_of(&grid, 2), magnified(&grid, 2));
        for gap in GAPS {
            let visibility = PointVisibility::new(&grid, gap);
            let explicit = Explicit::new(&doubled, Rules::Corner(gap), None);
            for &start in &points {
                let costs = visibility.costs_from(start);
                let expected = explicit.costs_from(vertex_of(start, 2));
                for &goal in &points {
                    let expected = expected.to(vertex_of(goal, 2)).map(|cost| cost / 2.0);
                    let cost = costs.to(goal);
                    let context = || describe_points(&grid, gap, start, goal, cells);
                    assert!(is_same(cost, expected), "{cost:?}, not {expected:?}; {}", context());
                    found += u64::from(cost.is_some());
                    unreachable += u64::from(cost.is_none());
                    let is_at_gap = is_gap_at(&grid, start) && start != goal;
                    closed_end += u64::from(is_at_gap && gap == DiagonalGap::Closed && cost.is_some());
                }
            }
        }
    }
    let enough = found > 100_000 && unreachable > 200_000 && closed_end > 300;
    assert!(enough, "{found} found, {unreachable} not, {closed_end} from a closed gap");
}

/// Between vertices of magnified random maps, against their visibility graph.
#[test]
fn exact_between_vertices_of_magnified_maps() {
    let (mut found, mut unreachable, mut bent) = (0, 0, 0);
    let seeds = seeds(120);
    let maps = seeds.end;
    for seed in seeds {
        let mut rng = Rng::new(seed ^ 0x3A61);
        let grid = small_grid(&mut rng);
        let times = [2, 2, 4, 8][rng.below(4) as usize];
        let (points, larger) = (vertices_of(&grid, times), magnified(&grid, times));
        for gap in GAPS {
            let visibility = PointVisibility::new(&grid, gap);
            let expected = Visibility::new(&larger, gap);
            let expected = expected.over(None);
            for _ in 0..8 {
                let Some(&start) = rng.pick(&points) else { continue };
                let costs = visibility.costs_from(start);
                let expected = expected.costs_from(vertex_of(start, times));
                for _ in 0..25 {
                    let Some(&goal) = rng.pick(&points) else { continue };
                    let expected = expected.to(vertex_of(goal, times)).map(|cost| cost / f64::from(times));
                    let cost = costs.to(goal);
                    let context = || describe_points(&grid, gap, start, goal, seed);
                    assert!(is_same(cost, expected), "{cost:?}, not {expected:?}; {}", context());
                    let bends = costs.path_to(goal).map_or(0, |path| path.len().saturating_sub(2));
                    found += u64::from(cost.is_some());
                    unreachable += u64::from(cost.is_none());
                    bent += u64::from(bends > 0);
                }
            }
        }
    }
    let enough = found >= 100 * maps && unreachable >= 100 * maps && bent >= 20 * maps;
    assert!(enough, "{found} found, {unreachable} not, {bent} bent");
}

/// Segments between vertices of magnified maps, against the rules for vertices.
#[test]
fn legality_is_that_of_magnified_maps() {
    let (mut legal, mut illegal) = (0, 0);
    let seeds = seeds(300);
    let maps = seeds.end;
    for seed in seeds {
        let mut rng = Rng::new(seed ^ 0x1E6A);
        let grid = small_grid(&mut rng);
        let times = [1, 2, 4, 16][rng.below(4) as usize];
        let (points, larger) = (vertices_of(&grid, times), magnified(&grid, times));
        for _ in 0..40 {
            let Some((&a, &b)) = rng.pick(&points).zip(rng.pick(&points)) else { continue };
            let (from, to) = (vertex_of(a, times), vertex_of(b, times));
            assert_eq!(
                point_is_free(&grid, a),
                vertex_is_free(&larger, PlacementKind::Corner, from),
                "{a:?}"
            );
            for gap in GAPS {
                let expected = segment_is_legal(&larger, Rules::Corner(gap), from, to);
                let found = segment_between_points_is_legal(&grid, gap, a, b);
                assert_eq!(found, expected, "{}", describe_points(&grid, gap, a, b, seed));
                *if found { &mut legal } else { &mut illegal } += 1;
            }
        }
    }
    assert!(legal >= 10 * maps && illegal >= 10 * maps, "{legal} legal, {illegal} illegal");
}

/// A segment to test on a map: between any two points, between near ones, or through a vertex at any angle.
fn random_segment(rng: &mut Rng, grid: &Grid) -> (Parts, Parts) {
    let kind = |rng: &mut Rng| rng.pick(&PointKind::ALL).copied().unwrap_or(PointKind::Anywhere);
    let (from, to) = (kind(rng), kind(rng));
    let (a, b) = (random_point(rng, grid, from), random_point(rng, grid, to));
    let small = |rng: &mut Rng| i64::from(rng.below(1201)) - 600;
    match rng.below(3) {
        0 => (a, b),
        1 => (a, (a.0 + 2 * small(rng), a.1 + 2 * small(rng))),
        _ => {
            let kind = if rng.chance(50) { PointKind::Gap } else { PointKind::Vertex };
            let vertex = random_point(rng, grid, kind);
            let by = if rng.chance(20) { (small(rng), 0) } else { (small(rng), small(rng)) };
            let by = if rng.chance(20) { (0, by.1) } else { by };
            let times = i64::from(1 + rng.below(3));
            ((vertex.0 - by.0, vertex.1 - by.1), (vertex.0 + times * by.0, vertex.1 + times * by.1))
        }
    }
}

/// The rules once more: the lines of the grid cut a segment into pieces, and the middle of each has to touch
/// a free cell.
fn is_legal_by_pieces(grid: &Grid, gap: DiagonalGap, a: Parts, b: Parts) -> bool {
    if !point_is_free(grid, a) || !point_is_free(grid, b) {
        return false;
    }
    // The segment is a + d · t / whole, and all coordinates below are multiplied by `whole`.
    let d = [b.0 - a.0, b.1 - a.1].map(i128::from);
    let whole = d.iter().map(|n| n.abs().max(1)).product::<i128>() * 2;
    let unit = whole * i128::from(PARTS_PER_CELL);
    let place = |t: i128| [0, 1].map(|axis| i128::from([a.0, a.1][axis]) * whole + d[axis] * t);
    let mut cuts = vec![0, whole];
    for axis in (0..2).filter(|&axis| d[axis] != 0) {
        let (from, to) = (place(0)[axis], place(whole)[axis]);
        let lines = from.min(to).div_euclid(unit)..=from.max(to).div_euclid(unit) + 1;
        cuts.extend(lines.map(|n| (n * unit - from) / d[axis]).filter(|t| (0..=whole).contains(t)));
    }
    cuts.sort_unstable();
    cuts.dedup();
    let touches_free_cell = |[x, y]: [i128; 2]| {
        let cells = |n: i128| if n % unit == 0 { n / unit - 1..=n / unit } else { n / unit..=n / unit };
        cells(y).any(|y| cells(x).any(|x| grid.is_free(x as i32, y as i32)))
    };
    let is_gap_at = |t: &i128| {
        let [x, y] = place(*t);
        x % unit == 0 && y % unit == 0 && is_gap(grid, Vertex::new((x / unit) as i32, (y / unit) as i32))
    };
    let mut pieces = cuts.windows(2);
    let mut between = cuts.iter().filter(|&&t| t != 0 && t != whole);
    // Cuts are even, since `whole` is twice a multiple of each axis.
    pieces.all(|piece| touches_free_cell(place((piece[0] + piece[1]) / 2)))
        && (gap == DiagonalGap::Open || !between.any(is_gap_at))
}

#[test]
fn legality_is_that_of_all_pieces() {
    let (mut legal, mut illegal, mut cut) = (0, 0, 0);
    let seeds = seeds(400);
    let maps = seeds.end;
    for seed in seeds {
        let mut rng = Rng::new(seed ^ 0x91EC);
        let grid = if seed % 4 == 0 { suite_grid(seed).0 } else { small_grid(&mut rng) };
        for _ in 0..60 {
            let (a, b) = random_segment(&mut rng, &grid);
            let found = GAPS.map(|gap| {
                let found = segment_between_points_is_legal(&grid, gap, a, b);
                let context = || describe_points(&grid, gap, a, b, seed);
                assert_eq!(found, is_legal_by_pieces(&grid, gap, a, b), "{}", context());
                assert_eq!(found, segment_between_points_is_legal(&grid, gap, b, a), "back; {}", context());
                found
            });
            *if found[0] { &mut legal } else { &mut illegal } += 1;
            cut += u64::from(found[0] && !found[1]);
        }
    }
    let enough = legal >= 10 * maps && illegal >= 25 * maps && cut >= maps;
    assert!(enough, "{legal} legal, {illegal} illegal, {cut} cut");
}

/// A segment is legal if and only if both its halves are and the point between them is no closed gap.
#[test]
fn legality_is_that_of_both_halves() {
    let (mut legal, mut illegal, mut at_gap) = (0, 0, 0);
    let seeds = seeds(300);
    let maps = seeds.end;
    for seed in seeds {
        let mut rng = Rng::new(seed ^ 0x4A1F);
        let grid = small_grid(&mut rng);
        for _ in 0..80 {
            let (a, b) = random_segment(&mut rng, &grid);
            // Often moved a little, so that a point between the ends has whole coordinates.
            let parts = i64::from(2 + rng.below(3));
            let middle = (a.0 + (b.0 - a.0) / parts, a.1 + (b.1 - a.1) / parts);
            let times = if rng.chance(50) { parts } else { 1 + i64::from(rng.below(3)) };
            let b = (a.0 + (middle.0 - a.0) * times, a.1 + (middle.1 - a.1) * times);
            if middle == a || middle == b {
                continue;
            }
            for gap in GAPS {
                let is_legal = |a, b| segment_between_points_is_legal(&grid, gap, a, b);
                let is_closed = gap == DiagonalGap::Closed && is_gap_at(&grid, middle);
                let halves = is_legal(a, middle) && is_legal(middle, b);
                let context = || format!("at {middle:?}; {}", describe_points(&grid, gap, a, b, seed));
                assert_eq!(is_legal(a, b), halves && !is_closed, "{}", context());
                *if halves { &mut legal } else { &mut illegal } += 1;
                at_gap += u64::from(halves && is_closed);
            }
        }
    }
    let enough = legal >= 15 * maps && illegal >= 25 * maps && at_gap * 4 >= maps;
    assert!(enough, "{legal} legal, {illegal} illegal, {at_gap} gaps");
}

/// Symmetry, the triangle inequality, paths, and the order of the gap rules, between points of all kinds.
#[test]
fn costs_are_a_metric() {
    let (mut found, mut unreachable, mut triangles, mut dearer) = (0, 0, 0, 0);
    let seeds = seeds(120);
    let maps = seeds.end;
    for seed in seeds {
        let mut rng = Rng::new(seed ^ 0x7E1A);
        let grid = if seed % 3 == 0 { suite_grid(seed).0 } else { small_grid(&mut rng) };
        let points: Vec<Parts> = (0..5).filter_map(|_| random_free_point(&mut rng, &grid)).collect();
        let costs = GAPS.map(|gap| {
            let visibility = PointVisibility::new(&grid, gap);
            let all: Vec<Vec<Option<f64>>> = points
                .iter()
                .map(|&a| {
                    let costs = visibility.costs_from(a);
                    let check = |&b: &Parts| {
                        let (cost, path) = (costs.to(b), costs.path_to(b));
                        let context = || describe_points(&grid, gap, a, b, seed);
                        assert_eq!(cost.is_some(), path.is_some(), "{}", context());
                        if let Some((cost, path)) = cost.zip(path) {
                            let outcome = validate_between_points(&grid, gap, a, b, &path, cost);
                            assert_eq!(outcome, Ok(()), "{path:?}; {}", context());
                        }
                        cost
                    };
                    points.iter().map(check).collect()
                })
                .collect();
            all
        });
        for (gap, costs) in GAPS.into_iter().zip(&costs) {
            for (i, &a) in points.iter().enumerate() {
                for (j, &b) in points.iter().enumerate() {
                    let context = || describe_points(&grid, gap, a, b, seed);
                    let cost = costs[i][j];
                    assert!(is_same(cost, costs[j][i]), "{cost:?}, back {:?}; {}", costs[j][i], context());
                    assert_eq!(cost == Some(0.0), a == b, "{}", context());
                    found += u64::from(cost.is_some());
                    unreachable += u64::from(cost.is_none());
                    for (k, &via) in points.iter().enumerate() {
                        let Some((first, second)) = costs[i][k].zip(costs[k][j]) else { continue };
                        let is_less = cost.is_some_and(|cost| cost <= (first + second) * (1.0 + 1e-12));
                        assert!(is_less, "{cost:?}, {first} + {second} via {via:?}; {}", context());
                        triangles += 1;
                    }
                }
            }
        }
        let [open, closed] = costs;
        for (open, closed) in open.iter().flatten().zip(closed.iter().flatten()) {
            let (open, closed) = (open.unwrap_or(f64::INFINITY), closed.unwrap_or(f64::INFINITY));
            assert!(open <= closed * (1.0 + 1e-12), "{open} open, {closed} closed; seed {seed}");
            dearer += u64::from(open < closed * (1.0 - 1e-9));
        }
    }
    let enough = found >= 25 * maps && unreachable >= 3 * maps && triangles >= 100 * maps && dearer >= maps;
    assert!(enough, "{found} found, {unreachable} not, {triangles} triangles, {dearer} dearer");
}

/// A map turned over at its falling diagonal keeps all costs, and the own quadrants of gaps.
#[test]
fn costs_are_those_of_the_transposed_map() {
    let mut found = 0;
    let seeds = seeds(150);
    let maps = seeds.end;
    for seed in seeds {
        let mut rng = Rng::new(seed ^ 0x7A45);
        let grid = small_grid(&mut rng);
        let transposed =
            Grid::from_fn(grid.height(), grid.width(), |x, y| grid.is_blocked(y as i32, x as i32));
        let transposed = transposed.expect("a valid size");
        for gap in GAPS {
            let visibility = PointVisibility::new(&grid, gap);
            let other = PointVisibility::new(&transposed, gap);
            for _ in 0..12 {
                let mut draw = || random_free_point(&mut rng, &grid);
                let Some((a, b)) = draw().zip(draw()) else { continue };
                let (cost, expected) = (visibility.cost(a, b), other.cost((a.1, a.0), (b.1, b.0)));
                let context = describe_points(&grid, gap, a, b, seed);
                assert!(is_same(cost, expected), "{cost:?}, not {expected:?}; {context}");
                found += u64::from(cost.is_some());
            }
        }
    }
    assert!(found >= 8 * maps, "{found}");
}
