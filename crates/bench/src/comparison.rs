//! Ratios of the times here to the scaled times of programs that were measured elsewhere.

use mediant_report::stats::geometric_mean;
use serde::Serialize;

use crate::{Baseline, MapRecord, ReferenceTimings, Timing};

/// One competitor's ratios on one map.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// The map's name, without extension.
    pub map: String,
    /// The competitor's name.
    pub competitor: String,
    /// How much slower this machine was than the reference machine on this map: the time here divided by the
    /// time there, the geometric mean over both baselines.
    pub scale: f64,
    /// The competitor's time divided by the scaled time of each program, in the order of
    /// [`ReferenceTimings::programs`]. Below 1, the competitor is faster. `None` where the program has no
    /// figure.
    pub ratios: Vec<Option<f64>>,
    /// The same for the preparation before the first query. `None` where the program has no figure, or did
    /// not finish.
    pub preparation: Vec<Option<PreparationRatio>>,
}

/// The time and memory of a competitor's preparation, divided by those of another program.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PreparationRatio {
    /// The competitor's time divided by the program's scaled time.
    pub time: f64,
    /// The competitor's memory divided by the size of the program's index file; `None` if the program writes
    /// none.
    pub bytes: Option<f64>,
}

/// How much slower one machine was than another on a map: the time of each baseline here divided by its time
/// there, the geometric mean over both baselines. The times are in the same unit. `None` if one is missing.
pub fn machine_ratio(
    here: impl Fn(Baseline) -> Option<f64>,
    there: impl Fn(Baseline) -> Option<f64>,
) -> Option<f64> {
    let ratios: Option<Vec<f64>> =
        Baseline::ALL.into_iter().map(|baseline| Some(here(baseline)? / there(baseline)?)).collect();
    geometric_mean(&ratios?)
}

impl Comparison {
    /// Compares a timing with the reference timings of its map. `None` for a map without them, or a record
    /// without both baselines.
    #[must_use]
    pub fn new(references: &ReferenceTimings, record: &MapRecord, timing: &Timing) -> Option<Self> {
        let row = references.map(&record.map)?;
        let here = |baseline: Baseline| {
            Some(record.timings.iter().find(|timing| timing.competitor == baseline.name())?.micros)
        };
        let scale = machine_ratio(here, |baseline| *row.micros.get(baseline.name())?)?;
        let ratio = |program: &str| Some(timing.micros / ((*row.micros.get(program)?)? * scale));
        let ratios = references.programs.iter().map(|program| ratio(&program.name)).collect();
        let preparation = |program: &str| {
            let theirs = row.preprocessing.get(program).copied().flatten()?;
            let ours = timing.preparation.filter(|_| !theirs.unfinished)?;
            let bytes = theirs.megabytes.map(|megabytes| ours.bytes as f64 / (1e6 * megabytes));
            Some(PreparationRatio { time: ours.seconds / (theirs.seconds * scale), bytes })
        };
        let preparation = references.programs.iter().map(|program| preparation(&program.name)).collect();
        let (map, competitor) = (record.map.clone(), timing.competitor.clone());
        Some(Self { map, competitor, scale, ratios, preparation })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Preparation;

    fn timing(competitor: &str, micros: f64) -> Timing {
        let preparation = Some(Preparation { seconds: 0.016, bytes: 540_000, ..Preparation::default() });
        Timing {
            competitor: competitor.to_owned(),
            micros,
            passes: vec![micros],
            mean_cost: 1.0,
            preparation,
        }
    }

    #[test]
    fn references_are_scaled_by_both_baselines() {
        // arena2: twice and eight times the reference machine's 1522 and 108 µs make a machine that is four
        // times as slow.
        let timings =
            vec![timing("astar", 1464.0), timing("pathfinding", 3044.0), timing("grid_pathfinding", 864.0)];
        let mut record = MapRecord { map: "arena2".to_owned(), set: "dao".to_owned(), instances: 1, timings };
        let references = ReferenceTimings::bundled().unwrap();
        let comparison = Comparison::new(&references, &record, &record.timings[0]).unwrap();
        assert!((comparison.scale - 4.0).abs() < 1e-12);
        // Warthog A* takes 732 µs there, hence 2928 here.
        assert!((comparison.ratios[0].unwrap() - 0.5).abs() < 1e-12);
        assert_eq!(comparison.ratios.len(), 13);
        // 2013-subgoal-fast takes 8 ms and 0.27 MB there; ENLSVG saves nothing, RayScan prepares nothing.
        let prepared = |name: &str| {
            let at = references.programs.iter().position(|program| program.name == name).unwrap();
            comparison.preparation[at].map(|ratio| (ratio.time, ratio.bytes))
        };
        let (time, bytes) = prepared("2013-subgoal-fast").unwrap();
        assert!((time - 0.5).abs() < 1e-12 && (bytes.unwrap() - 2.0).abs() < 1e-12);
        assert!(
            prepared("ENLSVG").is_some_and(|(_, bytes)| bytes.is_none()) && prepared("RayScan").is_none()
        );

        record.map = "random512-10-0".to_owned();
        let comparison = Comparison::new(&references, &record, &record.timings[0]).unwrap();
        let missing = |name: &str| {
            let at = references.programs.iter().position(|program| program.name == name).unwrap();
            comparison.ratios[at].is_none()
        };
        assert!(missing("EPS_MCDT") && missing("2019-SGCH-JPD") && !missing("ENLSVG"));
        // Its preprocessing was broken off.
        let at = references.programs.iter().position(|program| program.name == "2019-SGCH-JPD").unwrap();
        assert_eq!(comparison.preparation[at], None);

        record.timings.pop();
        assert_eq!(Comparison::new(&references, &record, &record.timings[0]), None);
        record.map = "elsewhere".to_owned();
        assert_eq!(Comparison::new(&references, &record, &record.timings[0]), None);
    }
}
