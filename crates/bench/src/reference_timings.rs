//! Times of other programs: `benchdata/reference_timings.json`.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Deserializer, de::Error as _};

use mediant::Setup;
use mediant_moves::K;

/// The times of other programs on the instances of our comparison.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReferenceTimings {
    /// A description of the file, in a sentence.
    pub about: String,
    /// Where, when and how the times were taken.
    pub measured: Measured,
    /// The rule that picks a map's instances.
    pub instances: Instances,
    /// How the times are scaled to another machine.
    pub scaling: String,
    /// The programs that are measured here as well, in the order of [`Baseline::ALL`](crate::Baseline::ALL).
    pub baselines: Vec<ReferenceProgram>,
    /// The programs that were measured only there.
    pub programs: Vec<ReferenceProgram>,
    /// The times, map by map.
    pub maps: Vec<MapTimings>,
    /// Figures on other instances, as their authors published them.
    pub published: Vec<Published>,
}

/// Where, when and how times were taken.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// The day, year first.
    pub date: String,
    /// The machine.
    pub machine: String,
    /// The definition of the times, with their unit.
    pub time: String,
}

/// The rule that picks a map's instances.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Instances {
    /// An instance of a scenario is picked if this divides its index.
    pub every: usize,
    /// The number of picked instances of all maps.
    pub count: usize,
}

/// Another program.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReferenceProgram {
    /// Its name in the tables.
    pub name: String,
    /// The problem that it solves.
    pub problem: SolvedProblem,
    /// Whether its paths are shortest.
    pub optimal: bool,
    /// Its language, where not C++ or Rust.
    pub language: Option<String>,
    /// The vertices of its paths: `cells` or `turning points`.
    pub returns: Option<String>,
    /// Its version.
    pub version: Option<String>,
    /// The function that is called.
    pub call: Option<String>,
    /// Anything else.
    pub note: Option<String>,
    /// Whether it has run beside Mediant on one machine since (`docs/performance.md`), which tells more.
    #[serde(default)]
    pub has_run_beside: bool,
}

/// The problem that a program solves, in the words of the `mediant` program.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SolvedProblem {
    /// The directions that its paths may take: a number or `any`.
    #[serde(deserialize_with = "number_or_any")]
    pub k: K,
    /// `center` or `corner`.
    pub placement: String,
    /// The corner rule or gap rule, where it is known.
    pub rule: Option<String>,
}

fn number_or_any<'de, D: Deserializer<'de>>(deserializer: D) -> Result<K, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum NumberOrWord {
        Number(u32),
        Word(String),
    }
    let text = match NumberOrWord::deserialize(deserializer)? {
        NumberOrWord::Number(k) => k.to_string(),
        NumberOrWord::Word(word) => word,
    };
    text.parse().map_err(D::Error::custom)
}

/// The figures on one map.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MapTimings {
    /// Its name, without extension.
    pub map: String,
    /// The benchmark set that it belongs to.
    pub set: String,
    /// Each program's mean time of a query in microseconds; `None` where it could not be measured.
    pub micros: BTreeMap<String, Option<f64>>,
    /// The preprocessing of the programs that do any; `None` where it could not be measured.
    pub preprocessing: BTreeMap<String, Option<Preprocessing>>,
}

/// The preprocessing of a program on a map.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Preprocessing {
    /// Its time in seconds.
    pub seconds: f64,
    /// Whether it was broken off at that time.
    #[serde(default)]
    pub unfinished: bool,
    /// The size of the index on disk in 10⁶ bytes; `None` if the index stays in memory.
    pub megabytes: Option<f64>,
}

/// Figures from a publication.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Published {
    /// The program.
    pub name: String,
    /// Its language.
    pub language: String,
    /// Whose figures these are.
    pub source: String,
    /// The machine.
    pub machine: String,
    /// The instances.
    pub maps: String,
    /// The figures.
    pub rows: Vec<PublishedRow>,
}

/// One variant of a published program.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PublishedRow {
    /// How it differs from the others.
    pub variant: String,
    /// Its neighborhood.
    pub k: u32,
    /// The mean time of a query in microseconds.
    pub micros: f64,
    /// By how much its paths exceed the any-angle optimum, in percent.
    pub excess_percent: Option<f64>,
}

/// A text that is no list of reference timings.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReferenceTimingsError {
    /// Not JSON, or not of the form above.
    #[error("the reference timings cannot be read: {0}")]
    Form(#[from] serde_json::Error),
    /// The programs of a map's times are not those of the list.
    #[error(
        "the reference timings of map `{map}`: each program of the list needs one entry, and no other may \
         have one"
    )]
    Programs {
        /// The map.
        map: String,
    },
}

impl ReferenceTimings {
    /// The reference timings of `benchdata/reference_timings.json`, which are part of this crate.
    ///
    /// # Errors
    /// [`ReferenceTimingsError`] if that file has been damaged.
    pub fn bundled() -> Result<Self, ReferenceTimingsError> {
        Self::parse(include_str!("../../../benchdata/reference_timings.json"))
    }

    /// Reads reference timings from a JSON text.
    ///
    /// # Errors
    /// [`ReferenceTimingsError`] says what is wrong.
    pub fn parse(text: &str) -> Result<Self, ReferenceTimingsError> {
        let references: Self = serde_json::from_str(text)?;
        let names: BTreeSet<&String> = references.all_programs().map(|program| &program.name).collect();
        match references.maps.iter().find(|row| !row.micros.keys().eq(names.iter().copied())) {
            Some(row) => Err(ReferenceTimingsError::Programs { map: row.map.clone() }),
            None => Ok(references),
        }
    }

    /// The baselines and the other programs.
    pub fn all_programs(&self) -> impl Iterator<Item = &ReferenceProgram> {
        self.baselines.iter().chain(&self.programs)
    }

    /// The times on a map, by its name without extension; `None` if there are none.
    #[must_use]
    pub fn map(&self, name: &str) -> Option<&MapTimings> {
        self.maps.iter().find(|row| row.map == name)
    }
}

impl ReferenceProgram {
    /// Whether the program solves the very problem of a setup, so that their times may be compared without a
    /// remark: both find shortest paths over the same directions under the same rules, or both find paths
    /// over the same directions that may be longer. In the second case the program's rule need not be known,
    /// since the lengths of its paths are not compared.
    #[must_use]
    pub fn solves(&self, setup: Setup) -> bool {
        let SolvedProblem { k, placement, rule } = &self.problem;
        let optimal = setup.optimal_over().is_some();
        self.optimal == optimal
            && *k == setup.paths()
            && *placement == setup.rules().placement().to_string()
            && rule.as_ref().map_or(!optimal, |rule| *rule == setup.rule_name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bundled() -> ReferenceTimings {
        ReferenceTimings::bundled().unwrap()
    }

    #[test]
    fn all_figures_are_there_but_for_those_marked_missing() {
        let references = bundled();
        assert_eq!(
            (references.maps.len(), references.baselines.len(), references.programs.len()),
            (18, 2, 13)
        );
        assert_eq!((references.instances.every, references.instances.count), (20, 2203));
        let maps: BTreeSet<&str> = references.maps.iter().map(|row| row.map.as_str()).collect();
        assert_eq!(maps.len(), 18);
        let missing: Vec<(&str, &str)> = references
            .maps
            .iter()
            .flat_map(|row| row.micros.iter().map(|(program, micros)| (&*row.map, &**program, micros)))
            .filter(|(.., micros)| micros.is_none())
            .map(|(map, program, _)| (map, program))
            .collect();
        let marked = [
            ("random512-10-0", "2019-SGCH-JPD"),
            ("random512-10-0", "EPS_MCDT"),
            ("random512-40-0", "EPS_MCDT"),
        ];
        assert_eq!(missing, marked);
        assert!(
            references.maps.iter().flat_map(|row| row.micros.values()).flatten().all(|&micros| micros > 0.0)
        );
        for row in &references.maps {
            assert_eq!(row.preprocessing.len(), 6, "{}", row.map);
            for (program, figures) in &row.preprocessing {
                let Some(figures) = figures else {
                    assert!(program == "EPS_MCDT" && row.set == "random", "{} of {program}", row.map);
                    continue;
                };
                assert!(figures.seconds > 0.0);
                assert_eq!(figures.megabytes.is_none(), program == "ENLSVG", "{} of {program}", row.map);
            }
        }
    }

    #[test]
    fn figures_stand_where_they_belong() {
        let references = bundled();
        let micros = |map: &str, program: &str| references.map(map).unwrap().micros[program];
        assert_eq!(micros("arena2", "pathfinding"), Some(1522.0));
        assert_eq!(micros("Moscow_2_1024", "grid_pathfinding"), Some(10_788.0));
        assert_eq!(micros("Cauldron", "Warthog A*"), Some(18_853.0));
        assert_eq!(micros("random512-40-0", "2019-SGCH-JPD"), Some(40.3));
        assert_eq!(micros("8room_000", "warthog-jps 0.5.1 jps2+"), Some(326.0));
        assert_eq!(micros("32room_000", "EPS_MCDT"), Some(6.6));
        assert_eq!(micros("Moscow_2_1024", "ENLSVG"), Some(520.0));
        let built = |map: &str, program: &str| references.map(map).unwrap().preprocessing[program].unwrap();
        let unfinished = Preprocessing { seconds: 292.0, unfinished: true, megabytes: Some(18.42) };
        assert_eq!(built("random512-10-0", "2019-SGCH-JPD"), unfinished);
        let in_memory = Preprocessing { seconds: 0.026, unfinished: false, megabytes: None };
        assert_eq!(built("orz900d", "ENLSVG"), in_memory);
        assert_eq!(built("TheFrozenSea", "EPS_MCDT").seconds, 365.732);
        let central: Vec<f64> = references.published[0].rows.iter().map(|row| row.micros).collect();
        assert_eq!(central, [848.0, 1637.0, 2879.0, 4967.0, 293.0, 530.0, 968.0, 1960.0, 816.0]);
    }

    #[test]
    fn only_programs_that_solve_the_same_problem_compare() {
        let references = bundled();
        let comparable = |setup: &str| {
            let setup = setup.parse().unwrap();
            references
                .all_programs()
                .filter(|program| program.solves(setup))
                .map(|program| &*program.name)
                .collect()
        };
        let octile: Vec<&str> = comparable("astar:3:never");
        assert_eq!(octile.len(), 7);
        assert!(octile.contains(&"pathfinding") && !octile.contains(&"grid_pathfinding"));
        assert_eq!((comparable("jps-plus"), comparable("canonical,paper").len()), (octile, 0));
        assert!(comparable("astar:4:never").is_empty() && comparable("astar:3:open").is_empty());
        for engine in ["anya", "subgoal"] {
            let closed = ["Anya16", "Polyanya_MCDT", "RayScan", "EPS_MCDT"];
            assert_eq!(comparable(&format!("{engine}:any:closed")), closed);
            assert_eq!(comparable(&format!("{engine}:any:open")), ["ENLSVG"]);
        }
        assert_eq!((comparable("subgoal").len(), comparable("subgoal:3:open").len()), (7, 0));
        for suboptimal in ["theta:3:open", "lazy-theta:5:closed", "subgoal-theta", "astar:4:open,smooth"] {
            assert_eq!(comparable(suboptimal), ["Theta*", "Lazy Theta*"], "{suboptimal}");
        }
        assert!(comparable("theta:3:never").is_empty() && comparable("wavefront:3:always").len() == 1);
    }

    #[test]
    fn damaged_references_are_refused() {
        assert!(matches!(ReferenceTimings::parse("{"), Err(ReferenceTimingsError::Form(_))));
        let damaged = |whole: &str, damaged: &str| {
            let text = include_str!("../../../benchdata/reference_timings.json");
            assert!(text.contains(whole), "{whole}");
            ReferenceTimings::parse(&text.replacen(whole, damaged, 1)).unwrap_err().to_string()
        };
        let error = damaged("\"RayScan\": 47.7, ", "");
        assert!(error.contains("`arena2`"), "{error}");
        let error = damaged("\"k\": \"any\"", "\"k\": \"some\"");
        assert!(error.contains("choose a number from 2 up, or any"), "{error}");
        let error = damaged("\"k\": 3", "\"k\": 1");
        assert!(error.contains("k = 1 is too small"), "{error}");
    }
}
