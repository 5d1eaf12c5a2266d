//! Rivera, Hernández & Baier 2017: Tables 1 and 2, Figure 3, and the comparison with Theta*.

mod causes;
mod charts;
mod published;
mod tables;
mod theta;

use mediant_report::Record;

use super::experiment::{Experiment, Page};

/// A* and canonical A* on random problems.
pub(super) const TABLES: Experiment = Experiment {
    id: "rivera2017-tables",
    page: Page::Rivera2017,
    title: "Tables 1 and 2, Figure 3: A* and canonical A*",
    sets: &["sc1", "bg512", "wc3maps512"],
    measure: tables::measure,
    show: tables::show,
};

/// A* and Theta* on scenarios.
pub(super) const THETA: Experiment = Experiment {
    id: "rivera2017-theta",
    page: Page::Rivera2017,
    title: "A* over N(k) and Theta*",
    sets: &["dao"],
    measure: theta::measure,
    show: theta::show,
};

/// A search of the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Algorithm {
    AStar,
    /// Canonical A* as published.
    Paper,
    /// Canonical A* with the rule that keeps an optimal path.
    Exact,
}

impl Algorithm {
    const ALL: [Self; 3] = [Self::AStar, Self::Paper, Self::Exact];

    const fn name(self) -> &'static str {
        match self {
            Self::AStar => "astar",
            Self::Paper => "canonical-paper",
            Self::Exact => "canonical",
        }
    }

    /// As a sentence has it.
    const fn words(self) -> &'static str {
        match self {
            Self::AStar => "A*",
            Self::Paper => "canonical A*",
            Self::Exact => "exact canonical A*",
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Heuristic {
    Hk,
    Euclidean,
}

impl Heuristic {
    const ALL: [Self; 2] = [Self::Hk, Self::Euclidean];

    const fn name(self) -> &'static str {
        match self {
            Self::Hk => "hk",
            Self::Euclidean => "euclidean",
        }
    }

    /// As a sentence has it.
    const fn words(self) -> &'static str {
        match self {
            Self::Hk => "h_k",
            Self::Euclidean => "Euclidean",
        }
    }
}

/// A column of the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Measure {
    Cost,
    Moves,
    Expanded,
    Percolations,
    Time,
}

impl Measure {
    const ALL: [Self; 5] = [Self::Cost, Self::Moves, Self::Expanded, Self::Percolations, Self::Time];

    /// The column of the record.
    const fn column(self) -> &'static str {
        match self {
            Self::Cost => "cost",
            Self::Moves => "moves",
            Self::Expanded => "expanded",
            Self::Percolations => "percolations",
            Self::Time => "micros",
        }
    }

    /// As the paper's heading has it, in full.
    const fn words(self) -> &'static str {
        match self {
            Self::Cost => "cost",
            Self::Moves => "moves",
            Self::Expanded => "expansions",
            Self::Percolations => "percolations",
            Self::Time => "time",
        }
    }
}

/// One search: a row of the record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Cell {
    algorithm: Algorithm,
    heuristic: Heuristic,
    k: u32,
}

impl Cell {
    /// All searches; those of one k follow each other.
    fn all() -> impl Iterator<Item = Self> {
        published::KS.into_iter().flat_map(|k| {
            Algorithm::ALL
                .into_iter()
                .flat_map(move |algorithm| Heuristic::ALL.map(|heuristic| Self { algorithm, heuristic, k }))
        })
    }

    fn setup(self) -> String {
        let engine = if self.algorithm == Algorithm::AStar { "astar" } else { "canonical" };
        let variant = if self.algorithm == Algorithm::Paper { ",paper" } else { "" };
        let heuristic = if self.heuristic == Heuristic::Euclidean { ",euclidean" } else { "" };
        format!("{engine}:{}:never{variant}{heuristic}", self.k)
    }

    /// The search whose numbers these are divided by, since the instances are not the paper's: that of k = 3 in the same column; of k = 3, that of
    /// the other heuristic or of A*. None for one, whose numbers stand for themselves.
    fn reference(self) -> Option<Self> {
        if self.k != published::BASE {
            Some(Self { k: published::BASE, ..self })
        } else if self.heuristic == Heuristic::Euclidean {
            Some(Self { heuristic: Heuristic::Hk, ..self })
        } else if self.algorithm != Algorithm::AStar {
            Some(Self { algorithm: Algorithm::AStar, ..self })
        } else {
            None
        }
    }

    /// A number of its row.
    fn number(self, record: &Record, set: &str, column: &str) -> Option<f64> {
        let k = self.k.to_string();
        let keys = [
            ("set", set),
            ("algorithm", self.algorithm.name()),
            ("heuristic", self.heuristic.name()),
            ("k", &k),
        ];
        record.number(&keys, column)
    }

    fn published(self, set: &str, measure: Measure) -> Option<f64> {
        published::published(set, self.algorithm, self.heuristic, self.k, measure)
    }
}
