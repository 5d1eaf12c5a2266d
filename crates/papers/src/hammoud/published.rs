//! Tables I and II as printed, but for the names of the maps: the captions are swapped, and so are the sizes
//! in the names.

/// A row of a table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Published {
    /// I or II.
    pub(super) table: &'static str,
    /// The map on which the query is one of the scenario's, with the printed optimum.
    pub(super) map: &'static str,
    pub(super) start: (i32, i32),
    pub(super) goal: (i32, i32),
    /// Lengths in cells.
    pub(super) optimum: f64,
    pub(super) astar: f64,
    pub(super) jps: f64,
    /// Times in seconds.
    pub(super) astar_seconds: f64,
    pub(super) jps_seconds: f64,
}

impl Published {
    /// The ratio of the times.
    pub(super) fn ratio(&self) -> f64 {
        self.astar_seconds / self.jps_seconds
    }

    /// Whether its JPS time must be a misprint: it is longer than that of A* on any row.
    pub(super) fn is_misprinted(&self) -> bool {
        self.jps_seconds > 100.0
    }
}

/// The maps of both tables.
pub(super) const MAPS: [&str; 8] = [
    "Boston_0_512",
    "Paris_0_512",
    "London_0_512",
    "Moscow_0_512",
    "Boston_0_256",
    "Paris_0_256",
    "London_0_256",
    "Moscow_0_256",
];

type Cell = (i32, i32);

/// Table, map, start, goal, then as printed: benchmark, A* length and seconds, JPS length and seconds.
#[rustfmt::skip]
const PRINTED: [(&str, &str, Cell, Cell, [f64; 5]); 16] = [
    ("I",  "Boston_0_512", (352, 0),   (0, 407),   [752.3595, 752.3595, 11.3571, 751.7737, 0.9301]),
    ("I",  "Boston_0_512", (268, 10),  (24, 482),  [752.0530, 752.0530, 10.4115, 751.4672, 0.6380]),
    ("I",  "Paris_0_512",  (495, 503), (24, 85),   [722.0509, 722.0509, 16.7910, 720.2935, 2.9828]),
    ("I",  "Paris_0_512",  (509, 48),  (12, 495),  [720.8570, 720.8570, 14.8685, 717.3423, 1.7216]),
    ("I",  "London_0_512", (214, 26),  (51, 199),  [828.5311, 828.5311, 12.3035, 825.6022, 2.7474]),
    ("I",  "London_0_512", (244, 40),  (507, 502), [828.1930, 828.1930, 16.9394, 828.1930, 2.0201]),
    ("I",  "Moscow_0_512", (5, 499),   (510, 20),  [729.1829, 729.1829, 15.0875, 728.5971, 1.0276]),
    ("I",  "Moscow_0_512", (67, 499),  (502, 6),   [731.8692, 731.8692, 4.7098,  729.5260, 167.0]),
    ("II", "Boston_0_256", (4, 227),   (181, 7),   [379.1564, 379.1564, 3.8948,  377.3991, 1.1406]),
    ("II", "Boston_0_256", (125, 1),   (26, 233),  [376.4113, 376.4113, 1.0783,  375.2397, 0.2997]),
    ("II", "Paris_0_256",  (242, 243), (6, 18),    [390.3036, 390.3036, 2.5419,  387.3747, 0.6335]),
    ("II", "Paris_0_256",  (239, 253), (7, 10),    [389.4752, 389.4752, 1.6995,  387.1320, 0.6477]),
    ("II", "London_0_256", (153, 13),  (49, 254),  [397.6001, 397.6001, 4.1897,  395.8427, 1.1271]),
    ("II", "London_0_256", (31, 108),  (132, 25),  [397.8305, 397.8305, 2.4166,  394.3158, 1.0736]),
    ("II", "Moscow_0_256", (247, 4),   (7, 247),   [361.0559, 361.0559, 1.6264,  359.8843, 0.4414]),
    ("II", "Moscow_0_256", (20, 241),  (246, 0),   [360.0854, 360.0854, 2.5279,  357.1564, 0.4946]),
];

/// Both tables.
pub(super) fn rows() -> impl Iterator<Item = Published> {
    PRINTED.into_iter().map(|(table, map, start, goal, [optimum, astar, astar_seconds, jps, jps_seconds])| {
        Published { table, map, start, goal, optimum, astar, jps, astar_seconds, jps_seconds }
    })
}

/// The sums of the columns, added up apart: they find typing errors in the tables above.
#[cfg(test)]
mod tests {
    use super::*;

    fn sum(table: &str, column: impl Fn(Published) -> f64) -> f64 {
        rows().filter(|row| row.table == table).map(column).sum()
    }

    #[test]
    fn columns_sum_to_what_the_tables_do() {
        let columns: [fn(Published) -> f64; 9] = [
            |row| row.start.0.into(),
            |row| row.start.1.into(),
            |row| row.goal.0.into(),
            |row| row.goal.1.into(),
            |row| row.optimum,
            |row| row.astar,
            |row| row.astar_seconds,
            |row| row.jps,
            |row| row.jps_seconds,
        ];
        let sums: [(&str, [f64; 9]); 2] = [
            ("I", [2154.0, 1625.0, 1630.0, 2196.0, 6065.0966, 6065.0966, 102.4683, 6052.795, 179.0676]),
            ("II", [1061.0, 1090.0, 654.0, 794.0, 3051.9184, 3051.9184, 19.9751, 3034.3447, 5.8582]),
        ];
        for (table, sums) in sums {
            assert_eq!(rows().filter(|row| row.table == table).count(), 8);
            for (at, (column, expected)) in columns.into_iter().zip(sums).enumerate() {
                let sum = sum(table, column);
                assert!((sum - expected).abs() < 1e-6, "table {table}, column {at}: {sum}, not {expected}");
            }
        }
    }

    #[test]
    fn rows_are_of_the_maps() {
        assert!(rows().all(|row| MAPS.contains(&row.map)));
        let of = |map: &str| rows().filter(|row| row.map == map).count();
        assert_eq!(MAPS.map(of), [2; 8]);
        assert_eq!(rows().filter(Published::is_misprinted).count(), 1);
    }
}
