//! Cells and meters.

use mediant_formats::{WorldError, WorldFrame};
use mediant_grid::{PlacementKind, Vertex};
use mediant_oracle::{Rng, seeds};

#[test]
fn by_hand() {
    // 4 × 2 cells of half a meter, lower left corner at (10, 20).
    let frame = WorldFrame::new(0.5, [10.0, 20.0, 0.0], 4, 2).unwrap();
    let cases = [
        ((10.0, 20.0), Some((0, 1))),
        ((10.49, 20.49), Some((0, 1))),
        ((10.5, 20.5), Some((1, 0))),
        ((11.99, 20.99), Some((3, 0))),
        ((12.0, 20.0), None),
        ((10.0, 21.0), None),
        ((9.99, 20.0), None),
        ((10.0, 19.99), None),
        ((f64::NAN, 20.0), None),
        ((f64::INFINITY, 20.0), None),
    ];
    for ((x, y), cell) in cases {
        assert_eq!(frame.cell_at(x, y), cell.map(Vertex::from), "({x}, {y})");
    }
    assert_eq!(frame.center_of(Vertex::new(0, 1)), (10.25, 20.25));
    assert_eq!(frame.center_of(Vertex::new(3, 0)), (11.75, 20.75));
    let corner = PlacementKind::Corner;
    assert_eq!(frame.point_of(corner, Vertex::new(0, 0)), (10.0, 21.0));
    assert_eq!(frame.point_of(corner, Vertex::new(4, 2)), (12.0, 20.0));
    assert_eq!(frame.vertex_at(corner, 12.2, 19.8), Some(Vertex::new(4, 2)));
    assert_eq!(frame.vertex_at(corner, 12.3, 20.0), None);
    assert_eq!(frame.vertex_at(corner, 10.26, 20.74), Some(Vertex::new(1, 1)));
}

#[test]
fn turned_by_a_quarter() {
    // Columns run up, rows (from the bottom) to the left.
    let frame = WorldFrame::new(1.0, [5.0, 5.0, std::f64::consts::FRAC_PI_2], 3, 2).unwrap();
    let (x, y) = frame.center_of(Vertex::new(2, 1));
    assert!((x - 4.5).abs() < 1e-12 && (y - 7.5).abs() < 1e-12, "({x}, {y})");
    assert_eq!(frame.cell_at(3.5, 5.5), Some(Vertex::new(0, 0)));
}

#[test]
fn there_and_back() {
    for seed in seeds(2000) {
        let mut rng = Rng::new(seed);
        let mut number = |range: f64| range * (f64::from(rng.below(2001)) / 1000.0 - 1.0);
        let (x, y, yaw, resolution) = (number(500.0), number(500.0), number(7.0), 0.01 + number(1.0).abs());
        let (width, height) = (1 + rng.below(50), 1 + rng.below(50));
        let yaw = if rng.chance(30) { 0.0 } else { yaw };
        let frame = WorldFrame::new(resolution, [x, y, yaw], width, height).unwrap();
        for (placement, more) in [(PlacementKind::Center, 0), (PlacementKind::Corner, 1)] {
            let at = Vertex::new(rng.below(width + more) as i32, rng.below(height + more) as i32);
            let (x, y) = frame.point_of(placement, at);
            assert_eq!(frame.vertex_at(placement, x, y), Some(at), "seed {seed}, {placement:?}");
            // Up to just below half a cell away, in any direction, it is the nearest vertex.
            let (right, up) = (resolution * 0.499, resolution * -0.499);
            let (sin, cos) = yaw.sin_cos();
            let (x, y) = (x + right * cos - up * sin, y + right * sin + up * cos);
            assert_eq!(frame.vertex_at(placement, x, y), Some(at), "seed {seed}, {placement:?}, beside");
        }
        // The four corners of a cell are those around its center.
        let cell = Vertex::new(rng.below(width) as i32, rng.below(height) as i32);
        let corners = [(0, 0), (1, 0), (0, 1), (1, 1)]
            .map(|(dx, dy)| frame.point_of(PlacementKind::Corner, Vertex::new(cell.x + dx, cell.y + dy)));
        let mean = |part: fn(&(f64, f64)) -> f64| corners.iter().map(part).sum::<f64>() / 4.0;
        let (x, y) = frame.center_of(cell);
        assert!((mean(|p| p.0) - x).abs() < 1e-9 && (mean(|p| p.1) - y).abs() < 1e-9, "seed {seed}");
    }
}

#[test]
fn numbers_that_place_nothing() {
    for resolution in [0.0, -0.05, f64::NAN, f64::INFINITY] {
        let error = WorldFrame::new(resolution, [0.0; 3], 1, 1);
        assert!(matches!(error, Err(WorldError::Resolution { .. })), "{resolution}");
    }
    assert!(matches!(WorldFrame::new(1.0, [0.0, f64::NAN, 0.0], 1, 1), Err(WorldError::Origin { .. })));
    assert!(matches!(WorldFrame::new(1.0, [0.0; 3], 0, 1), Err(WorldError::Size(_))));
    assert!(matches!(WorldFrame::new(1.0, [0.0; 3], 1, 40_000), Err(WorldError::Size(_))));
    // Extreme numbers answer too.
    let frame = WorldFrame::new(f64::MIN_POSITIVE, [f64::MAX, -f64::MAX, 3.0], 9, 9).unwrap();
    assert_eq!(frame.cell_at(-f64::MAX, f64::MAX), None);
}
