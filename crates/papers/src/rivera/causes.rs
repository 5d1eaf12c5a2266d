//! Why numbers differ from the published ones.
//!
//! Their figures come from records: those of the tables' own, or, where a name stands for a cause, those of
//! an experiment of its own (`alternatives`). What no experiment measures is called a guess that nobody can
//! check.

use mediant_report::Record;

use super::{
    published::SETS,
    searches::{Algorithm, Heuristic, KS, Measure, SearchKey},
};

/// Of other problems, and of swamp.
pub(super) const DRAW: &str = "rivera2017-causes: draw";
/// Of longer moves.
pub(super) const LONG_MOVES: &str = "rivera2017-causes: long moves";
/// Of ties.
pub(super) const TIES: &str = "rivera2017-causes: ties";
/// Of jump points.
pub(super) const JUMP_POINTS: &str = "rivera2017-causes: jump points";
/// Of ties in canonical A*.
pub(super) const CANONICAL_TIES: &str = "rivera2017-causes: ties of canonical A*";

/// Why a number of the tables differs, where it does.
pub(super) fn of(record: &Record, search: SearchKey, measure: Measure) -> String {
    match (search.algorithm, search.heuristic, measure) {
        (_, _, Measure::Time) => time(record, search),
        (_, _, Measure::Cost | Measure::Moves) => [LONG_MOVES, DRAW].join("\n"),
        (Algorithm::AStar, Heuristic::Euclidean, _) => DRAW.to_owned(),
        (Algorithm::AStar, Heuristic::Hk, _) => [TIES, DRAW].join("\n"),
        (_, Heuristic::Euclidean, _) => [JUMP_POINTS, DRAW].join("\n"),
        (_, Heuristic::Hk, _) => [CANONICAL_TIES, JUMP_POINTS, DRAW].join("\n"),
    }
}

/// The nanoseconds of an expansion by k, on StarCraft, here and as published.
fn expansions(record: &Record, algorithm: Algorithm, heuristic: Heuristic) -> [Vec<(f64, f64)>; 2] {
    let moves = |k: u32| f64::from(1_u32 << k);
    let of = |number: &dyn Fn(SearchKey) -> Option<f64>| {
        let searches = KS.map(|k| SearchKey { algorithm, heuristic, k });
        searches.into_iter().filter_map(|search| Some((moves(search.k), number(search)?))).collect()
    };
    [
        of(&|search| {
            Some(
                1e3 * search.number(record, "sc1", "micros")?
                    / search.number(record, "sc1", "timed_expanded")?,
            )
        }),
        of(&|search| {
            Some(1e6 * search.published("sc1", Measure::Time)? / search.published("sc1", Measure::Expanded)?)
        }),
    ]
}

/// The line a + b · x nearest to points.
fn line(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / n, y + point.1 / n));
    let (xy, xx) = points
        .iter()
        .fold((0.0, 0.0), |(xy, xx), point| (xy + (point.0 - x) * (point.1 - y), xx + (point.0 - x).powi(2)));
    (xx > 0.0).then(|| (y - xy / xx * x, xy / xx))
}

/// Of times, without those that say why.
const NO_TIMES: &str = "The program and the machine are others. StarCraft, on whose maps the time of an \
                        expansion is taken apart, was left out.";

/// Of times: what an expansion takes, a fixed part and a part for each move.
fn time(record: &Record, search: SearchKey) -> String {
    let [ours, theirs] = expansions(record, search.algorithm, search.heuristic);
    let Some((ours, theirs)) = line(&ours).zip(line(&theirs)) else {
        return NO_TIMES.to_owned();
    };
    let why = if search.algorithm == Algorithm::AStar {
        "Each legal move is tried in both programs; what does not depend on k is the smaller part here, so \
         that the whole grows faster with k."
    } else {
        "What does not depend on k is the smaller part here, and jump points pass on all legal moves."
    };
    format!(
        "An expansion on StarCraft takes about {:.0} + {:.1} · 2^k ns here and {:.0} + {:.1} · 2^k ns in the \
         paper, by the line nearest to its six values: {why} The rest of the difference is that of the \
         expansions.",
        ours.0, ours.1, theirs.0, theirs.1
    )
}

/// A* with both heuristics at a k on StarCraft: nanoseconds an expansion and expansions, with h_k over
/// Euclidean.
fn heuristics(record: &Record, algorithm: Algorithm, k: u32) -> Option<[f64; 4]> {
    let ratio = |number: &dyn Fn(SearchKey) -> Option<f64>| {
        let of = |heuristic| number(SearchKey { algorithm, heuristic, k });
        Some(of(Heuristic::Hk)? / of(Heuristic::Euclidean)?)
    };
    let time = ratio(&|search| search.number(record, "sc1", "micros"))?;
    let expanded = ratio(&|search| search.number(record, "sc1", "timed_expanded"))?;
    let published = ratio(&|search| search.published("sc1", Measure::Time))?;
    let theirs = ratio(&|search| search.published("sc1", Measure::Expanded))?;
    Some([expanded, time / expanded, theirs, published / theirs])
}

/// Why h_k is faster up to another k than in the paper.
pub(super) fn faster(record: &Record, algorithm: Algorithm) -> String {
    let of = |k: u32| {
        let Some([expanded, each, theirs, published]) = heuristics(record, algorithm, k) else {
            return String::new();
        };
        format!(
            " With 2^{k} neighbors on StarCraft, h_k takes {expanded:.3} of the expansions here and \
             {theirs:.3} in the paper, and {each:.3} and {published:.3} of the time of each."
        )
    };
    format!(
        "From 32 neighbors on h_k saves few expansions, so that the time of each decides.{}{}",
        of(5),
        of(7)
    )
}

/// Why canonical A* is not faster at some k.
pub(super) fn canonical(record: &Record) -> String {
    let times = |algorithm, searches: &[(&str, Heuristic, u32)]| {
        let each = searches.iter().filter_map(|&(set, heuristic, k)| {
            let search = SearchKey { algorithm, heuristic, k };
            let number = |column| search.number(record, set, column);
            Some(1e3 * number("micros")? / number("timed_expanded")?)
        });
        let (least, most) = each.fold((f64::MAX, f64::MIN), |(a, b), time| (a.min(time), b.max(time)));
        if least <= most { format!("{least:.0} to {most:.0} ns") } else { "– ns".to_owned() }
    };
    let hk: Vec<_> = SETS.iter().map(|(set, _)| (*set, Heuristic::Hk, 2)).collect();
    let both: Vec<_> =
        SETS.iter().map(|(set, _)| (*set, Heuristic::Euclidean, 2)).chain(hk.clone()).collect();
    format!(
        "At 4 neighbors (and at 8 on StarCraft with the Euclidean heuristic) an expansion takes longer here \
         by canonical A* as published than by A*, {} at 4 neighbors against {}: to try four moves costs less \
         than to find out whether a vertex is a jump point. The exact rule, which looks that up in a table, \
         takes {} there.",
        times(Algorithm::Paper, &both),
        times(Algorithm::AStar, &both),
        times(Algorithm::Exact, &hk)
    )
}

/// Why A* is not slower with each k.
pub(super) const SLOWER: &str =
    "At 4 and 8 neighbors the times of an expansion differ little here, and the expansions decide.";

/// Why A* is not as fast beside Theta*.
pub(super) const THETA_TIME: &str = "A guess that nobody can check: Theta* asks for fewer lines of sight here, \
    none for a neighbor that is as \
     cheap already, nor for one that was found hidden. A program that asks for one for each neighbor that is \
     not closed takes longer for the same paths.";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_found() {
        let (a, b) = line(&[(4.0, 11.0), (8.0, 19.0), (16.0, 35.0)]).unwrap();
        assert!((a - 3.0).abs() < 1e-9 && (b - 2.0).abs() < 1e-9, "{a} {b}");
        // Residuals that cancel out.
        let (a, b) = line(&[(0.0, 1.0), (1.0, 0.0), (2.0, 1.0)]).unwrap();
        assert!((a - 2.0 / 3.0).abs() < 1e-9 && b.abs() < 1e-9, "{a} {b}");
        assert_eq!((line(&[]), line(&[(1.0, 1.0)])), (None, None));
    }
}
