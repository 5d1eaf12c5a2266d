//! Tables 1 and 2 of Rivera, Hernández & Baier 2017 as printed.

use super::searches::{Algorithm, Heuristic, KS, Measure, SearchKey};

/// The sets by their names here and in the paper.
pub(super) const SETS: [(&str, &str); 3] = [("sc1", "StarCraft"), ("bg512", "BG"), ("wc3maps512", "WC3")];

/// Table 1: for each set and k the cost, the moves, and for each heuristic expansions, percolations and
/// milliseconds.
const TABLE_1: [[[f64; 8]; 6]; 3] = [
    [
        [804.2, 804.0, 55_501.0, 313_662.0, 10.59, 110_911.0, 918_104.0, 25.42],
        [668.0, 570.0, 52_840.0, 595_331.0, 12.98, 69_373.0, 619_202.0, 17.40],
        [642.5, 425.0, 52_884.0, 607_963.0, 17.17, 58_182.0, 601_855.0, 18.56],
        [637.0, 335.0, 53_147.0, 621_548.0, 24.16, 55_165.0, 618_450.0, 24.87],
        [635.4, 273.0, 53_217.0, 657_585.0, 37.94, 54_161.0, 650_121.0, 38.12],
        [634.8, 230.0, 53_279.0, 690_190.0, 60.32, 53_769.0, 685_635.0, 60.84],
    ],
    [
        [304.6, 305.0, 8_025.0, 37_310.0, 1.55, 16_161.0, 109_059.0, 3.46],
        [247.4, 207.0, 6_881.0, 62_412.0, 1.67, 9_943.0, 73_383.0, 2.40],
        [239.0, 159.0, 6_818.0, 65_002.0, 2.07, 8_066.0, 69_749.0, 2.42],
        [237.1, 128.0, 6_771.0, 65_910.0, 2.89, 7_370.0, 70_011.0, 3.12],
        [236.5, 105.0, 6_711.0, 70_723.0, 4.50, 7_052.0, 72_990.0, 4.69],
        [236.3, 88.0, 6_694.0, 75_605.0, 7.49, 6_895.0, 77_309.0, 7.69],
    ],
    [
        [245.3, 245.0, 6_979.0, 33_532.0, 1.37, 14_160.0, 99_299.0, 3.19],
        [206.8, 179.0, 6_696.0, 64_297.0, 1.65, 9_102.0, 69_477.0, 2.23],
        [199.8, 139.0, 6_772.0, 68_030.0, 2.14, 7_684.0, 69_219.0, 2.40],
        [198.1, 113.0, 6_803.0, 69_741.0, 3.05, 7_192.0, 71_280.0, 3.19],
        [197.5, 93.0, 6_770.0, 75_119.0, 4.84, 6_987.0, 75_450.0, 4.95],
        [197.3, 80.0, 6_764.0, 80_179.0, 8.05, 6_889.0, 80_515.0, 8.15],
    ],
];

/// Table 2: for each set and k, and each heuristic, expansions, percolations and milliseconds.
const TABLE_2: [[[f64; 6]; 6]; 3] = [
    [
        [58_617.0, 195_956.0, 8.79, 110_941.0, 888_288.0, 23.67],
        [53_620.0, 587_413.0, 10.72, 69_386.0, 557_109.0, 14.28],
        [53_174.0, 516_861.0, 11.65, 58_191.0, 473_421.0, 12.53],
        [53_259.0, 495_083.0, 12.56, 55_173.0, 467_565.0, 12.59],
        [53_304.0, 505_937.0, 13.80, 54_166.0, 490_821.0, 12.62],
        [53_335.0, 546_201.0, 15.29, 53_774.0, 535_795.0, 14.20],
    ],
    [
        [10_859.0, 28_767.0, 1.60, 16_192.0, 105_458.0, 3.39],
        [7_950.0, 68_281.0, 1.51, 9_957.0, 65_254.0, 2.00],
        [7_223.0, 55_004.0, 1.49, 8_079.0, 52_756.0, 1.66],
        [6_946.0, 51_589.0, 1.53, 7_382.0, 50_600.0, 1.58],
        [6_785.0, 52_365.0, 1.63, 7_062.0, 52_457.0, 1.57],
        [6_752.0, 57_027.0, 1.89, 6_903.0, 56_930.0, 1.69],
    ],
    [
        [8_283.0, 23_617.0, 1.25, 14_183.0, 97_017.0, 3.08],
        [7_089.0, 62_609.0, 1.37, 9_112.0, 61_797.0, 1.84],
        [6_926.0, 54_974.0, 1.46, 7_692.0, 52_467.0, 1.61],
        [6_859.0, 52_956.0, 1.53, 7_198.0, 51_358.0, 1.55],
        [6_810.0, 54_515.0, 1.62, 6_992.0, 53_671.0, 1.55],
        [6_792.0, 59_054.0, 1.88, 6_893.0, 58_432.0, 1.67],
    ],
];

impl SearchKey {
    /// A printed number; none where the paper prints none.
    pub(super) fn published(self, set: &str, measure: Measure) -> Option<f64> {
        let Self { algorithm, heuristic, k } = self;
        let set = SETS.iter().position(|(name, _)| *name == set)?;
        let row = KS.iter().position(|&known| known == k)?;
        let column = match measure {
            // Printed once for both heuristics, which find paths of the same cost.
            Measure::Cost => return (algorithm == Algorithm::AStar).then(|| TABLE_1[set][row][0]),
            Measure::Moves => return (algorithm == Algorithm::AStar).then(|| TABLE_1[set][row][1]),
            Measure::Expanded => 0,
            Measure::Percolations => 1,
            Measure::Time => 2,
        } + match heuristic {
            Heuristic::Hk => 0,
            Heuristic::Euclidean => 3,
        };
        match algorithm {
            Algorithm::AStar => Some(TABLE_1[set][row][column + 2]),
            Algorithm::Paper => Some(TABLE_2[set][row][column]),
            Algorithm::Exact => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_where_they_are_printed() {
        use Algorithm::{AStar, Exact, Paper};
        use Heuristic::{Euclidean, Hk};
        let cases = [
            ("sc1", AStar, Hk, 2, Measure::Cost, Some(804.2)),
            ("wc3maps512", AStar, Euclidean, 7, Measure::Moves, Some(80.0)),
            ("bg512", AStar, Hk, 5, Measure::Expanded, Some(6_771.0)),
            ("bg512", AStar, Euclidean, 5, Measure::Percolations, Some(70_011.0)),
            ("wc3maps512", AStar, Euclidean, 7, Measure::Time, Some(8.15)),
            ("sc1", Paper, Hk, 2, Measure::Expanded, Some(58_617.0)),
            ("wc3maps512", Paper, Euclidean, 6, Measure::Time, Some(1.55)),
            ("sc1", Paper, Hk, 3, Measure::Cost, None),
            ("sc1", Exact, Hk, 3, Measure::Time, None),
            ("sc1", AStar, Hk, 8, Measure::Time, None),
            ("bundled", AStar, Hk, 3, Measure::Time, None),
        ];
        for (set, algorithm, heuristic, k, measure, expected) in cases {
            let found = SearchKey { algorithm, heuristic, k }.published(set, measure);
            assert_eq!(found, expected, "{set} {algorithm:?} {heuristic:?} {k} {measure:?}");
        }
    }

    /// Sums over the columns, added up apart from the tables.
    #[test]
    fn columns_add_up() {
        let sum = |rows: &[f64]| rows.iter().sum::<f64>();
        let column = |set: usize, column: usize| sum(&TABLE_1[set].map(|row| row[column]));
        assert!((column(0, 0) - 4_021.9).abs() < 1e-9 && (column(1, 0) - 1_500.9).abs() < 1e-9);
        assert!((column(2, 0) - 1_244.8).abs() < 1e-9);
        // A longer way has no fewer moves, and each column falls or rises with k as the paper says of it.
        for table in TABLE_1 {
            let falls = |column: usize| table.windows(2).all(|rows| rows[0][column] > rows[1][column]);
            assert!([0, 1, 5].into_iter().all(falls));
        }
        for table in TABLE_2 {
            assert!(table.windows(2).all(|rows| rows[0][3] > rows[1][3]));
        }
    }
}
