//! Costs that other programs found on small surfaces: `MCP_Geometric` of scikit-image 0.26 with
//! `fully_connected=True`, which is k = 3, and `r.cost -k` of GRASS 8.2, which is k = 4. Both cut corners
//! always.

use mediant_grid::{CornerRule, Rules, Vertex};
use mediant_moves::FiniteK;
use mediant_oracle::{WeightedMap, weighted_lengths};

const A: &str = "
    3 # 3 5 9 # 3
    5 3 4 4 # # 1
    6 9 9 7 9 # 5
    6 4 3 7 # 5 1
    2 # 6 8 8 8 #
";

const B: &str = "
    # 20 25 97 33 92
    57 5 7 79 93 27
    20 56 53 # 36 19
    36 51 7 61 89 98
    61 52 28 73 16 38
    47 # 17 52 # 40
";

const C: &str = "
    1 5 2 6 3 6
    4 8 # 3 9 1
    1 4 6 # 6 4
    7 5 3 4 9 9
    6 4 7 7 1 #
";

/// Compares the costs from the sources, at (x, y), with numbers row by row.
#[track_caller]
fn check(map: &WeightedMap, k: u32, sources: &[(i32, i32)], tolerance: f64, expected: &str) {
    let sources: Vec<Vertex> = sources.iter().map(|&at| at.into()).collect();
    let k = FiniteK::new(k).ok();
    let found = weighted_lengths(map, Rules::Center(CornerRule::Always), k, &sources);
    let expected: Vec<&str> = expected.split_whitespace().collect();
    assert_eq!(found.len(), expected.len());
    for (v, (found, expected)) in found.iter().zip(expected).enumerate() {
        let expected: Option<f64> = expected.parse().ok();
        let is_same = match (found, expected) {
            (Some(found), Some(expected)) => (found - expected).abs() <= tolerance,
            (None, None) => true,
            _ => false,
        };
        assert!(is_same, "vertex {v}: {found:?}, not {expected:?}");
    }
}

#[test]
fn scikit_image() {
    check(
        &WeightedMap::parse(A),
        3,
        &[(0, 0)],
        1e-8,
        "
        0.0 # 8.485281374 12.485281374 19.485281374 # 41.834523779
        4.0 4.242640687 7.742640687 11.742640687 # # 39.834523779
        9.5 10.242640687 12.727922061 15.52081528 20.935028843 # 36.834523779
        15.5 16.571067812 18.727922061 22.52081528 # 30.834523779 33.834523779
        19.5 # 23.227922061 26.506096654 33.127416998 37.334523779 #
        ",
    );
    check(
        &WeightedMap::parse(B),
        3,
        &[(2, 3), (5, 5)],
        1e-8,
        "
        # 78.5 76.0 133.539105243 182.195959493 206.63708499
        97.0 66.0 60.0 103.0 167.089357775 147.13708499
        79.204581464 44.547727215 30.0 # 102.589357775 130.089357775
        72.5 29.0 0.0 34.0 92.097979746 107.0
        98.21930009 41.71930009 17.5 56.568542495 39.597979746 39.0
        111.722871427 # 40.0 74.068542495 # 0.0
        ",
    );
    // Its `sampling` is (2.0, 0.5), rows first.
    check(
        &WeightedMap::parse(C).with_cell_size(0.5, 2.0),
        3,
        &[(1, 2)],
        1e-8,
        "
        11.25 12.75 14.5 16.5 17.961646096 20.211646096
        6.25 9.25 # 11.776987658 14.776987658 17.276987658
        1.25 0.0 2.5 # 19.273198909 21.773198909
        9.25 7.434658438 7.215434845 8.965434845 12.215434845 16.715434845
        16.93086969 14.43086969 17.18086969 16.119316877 14.119316877 #
        ",
    );
}

#[test]
fn grass() {
    check(
        &WeightedMap::parse(A),
        4,
        &[(0, 0)],
        1e-8,
        "
        0 # 8.485281374239 12.485281374239 19.485281374239 # 41.834523779156
        4 4.242640687119 7.742640687119 11.742640687119 # # 39.834523779156
        9.5 10.242640687119 12.727922061358 15.520815280171 20.935028842544 # 36.834523779156
        15.5 16.571067811865 17.659048552118 22.520815280171 # 30.834523779156 33.834523779156
        19.5 # 22.159048552118 25.43722314517 32.193490405867 37.334523779156 #
        ",
    );
    check(
        &WeightedMap::parse(B),
        4,
        &[(2, 3), (5, 5)],
        1e-8,
        "
        # 77.516444521871 76 133.539105243401 180.747670784989 206.637084989848
        97 66 60 103 167.089357775095 147.137084989848
        74.908277246243 44.547727214752 30 # 102.589357775095 130.089357775095
        72.5 29 0 34 92.097979746447 107
        95.591906038116 41.719300090006 17.5 56.568542494924 39.597979746447 39
        111.722871427475 # 40 74.068542494924 # 0
        ",
    );
    // With `nsres=2 ewres=0.5`, costs are those of a cell from east to west.
    check(
        &WeightedMap::parse(C).with_cell_size(1.0, 4.0),
        4,
        &[(1, 2)],
        1e-8,
        "
        22.5 25.5 29 33 35.923292192132 40.423292192132
        12.5 18.5 # 23.553975315279 29.553975315279 34.553975315279
        2.5 0 5 # 38.54639781775 43.54639781775
        18.5 14.869316876853 14.430869689662 17.930869689662 24.430869689662 33.430869689662
        33.861739379324 28.861739379324 34.361739379324 32.238633753706 28.238633753706 #
        ",
    );
}
