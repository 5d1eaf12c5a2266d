//! The cells that a polygon meets, against separating lines.

use mediant_grid::{Centers, Corners, Placement, PlacementKind, Vertex, sight::PolygonCells};
use mediant_oracle::{Rng, random_grid};

/// In half cells, how far a vertex is from the corner of its cell.
fn half<P: Placement>() -> i32 {
    i32::from(P::KIND == PlacementKind::Center)
}

/// Whether the triangle and cell (x, y) meet, by separating lines, in half cells: at corners their interiors,
/// at centers both with their rims.
fn meets<P: Placement>(triangle: [Vertex; 3], x: i32, y: i32) -> bool {
    let t = triangle.map(|at| (i64::from(2 * at.x + half::<P>()), i64::from(2 * at.y + half::<P>())));
    let (x, y) = (i64::from(2 * x), i64::from(2 * y));
    let square = [(x, y), (x + 2, y), (x, y + 2), (x + 2, y + 2)];
    let mut normals = vec![(1, 0), (0, 1)];
    normals.extend([(0, 1), (1, 2), (2, 0)].map(|(i, j)| (t[j].1 - t[i].1, t[i].0 - t[j].0)));
    normals.into_iter().all(|(u, v)| {
        let range = |points: &[(i64, i64)]| {
            let along = points.iter().map(|&(x, y)| u * x + v * y);
            (along.clone().min().expect("a point"), along.max().expect("a point"))
        };
        let (one, other) = (range(&t), range(&square));
        match P::KIND {
            PlacementKind::Corner => one.0 < other.1 && other.0 < one.1,
            PlacementKind::Center => one.0 <= other.1 && other.0 <= one.1,
        }
    })
}

fn check<P: Placement>(seed: u64) -> [usize; 2] {
    let (grid, _) = random_grid(seed);
    let (width, height) = P::vertices(&grid);
    let mut rng = Rng::new(seed ^ 0xC0);
    let mut counts = [0; 2];
    for _ in 0..20 {
        let mut vertex = || Vertex::new(rng.below(width) as i32, rng.below(height) as i32);
        let [a, b, c] = [vertex(), vertex(), vertex()];
        if a.to(b).det(a.to(c)) == 0 {
            continue;
        }
        let mut polygon = PolygonCells::default();
        let low = Vertex::new(a.x.min(b.x).min(c.x), a.y.min(b.y).min(c.y));
        let high = Vertex::new(a.x.max(b.x).max(c.x), a.y.max(b.y).max(c.y));
        polygon.set::<P>(low, high, &[[a, b], [b, c], [c, a]]);
        // Rows are columns of the map where the polygon is higher than wide.
        let transposed = high.y - low.y > high.x - low.x;
        let cells = (0..grid.height() as i32).flat_map(|y| (0..grid.width() as i32).map(move |x| (x, y)));
        let blocked: Vec<(i32, i32)> =
            cells.filter(|&(x, y)| grid.is_blocked(x, y) && meets::<P>([a, b, c], x, y)).collect();
        let case = format!("seed {seed}: {a} {b} {c}");
        assert_eq!(polygon.is_free(&grid), blocked.is_empty(), "{case}");
        // Each extreme corner is one of a blocked cell, and in its row, or column, none lies beyond it.
        let corners: Vec<Vertex> = polygon.extremes::<Corners>(&grid).collect();
        let all = blocked.iter().flat_map(|&(x, y)| [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)]);
        let all: Vec<Vertex> = all.map(Vertex::from).collect();
        assert!(corners.iter().all(|at| all.contains(at)), "{case}");
        for at in all {
            let beyond = corners.iter().filter(|p| if transposed { p.x == at.x } else { p.y == at.y });
            let along = |p: &Vertex| if transposed { p.y } else { p.x };
            assert!(beyond.clone().any(|p| along(p) <= along(&at)), "{case}: {at}");
            assert!(beyond.clone().any(|p| along(p) >= along(&at)), "{case}: {at}");
        }
        counts[usize::from(blocked.is_empty())] += 1;
    }
    counts
}

#[test]
fn a_triangle_covers_what_no_line_separates_from_it() {
    let mut counts = [0; 4];
    for seed in 0..300 {
        let seen = [check::<Corners>(seed), check::<Centers>(seed)];
        counts.iter_mut().zip(seen.as_flattened()).for_each(|(count, seen)| *count += seen);
    }
    assert!(counts.iter().all(|&count| count > 200), "{counts:?}");
}
