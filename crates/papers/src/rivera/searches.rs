//! The searches of the tables, and the columns.

use mediant_report::Record;

/// The k of the rows.
pub(super) const KS: [u32; 6] = [2, 3, 4, 5, 6, 7];

/// The k that the others are compared with.
pub(super) const BASE: u32 = 3;

/// A search of the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Algorithm {
    AStar,
    /// Canonical A* as published.
    Paper,
    /// Canonical A* with our rule, which keeps an optimal path.
    Exact,
}

impl Algorithm {
    pub(super) const ALL: [Self; 3] = [Self::AStar, Self::Paper, Self::Exact];

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::AStar => "astar",
            Self::Paper => "canonical-paper",
            Self::Exact => "canonical",
        }
    }

    /// The name within a sentence.
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::AStar => "A*",
            Self::Paper => "canonical A*",
            Self::Exact => "exact canonical A*",
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Heuristic {
    Hk,
    Euclidean,
}

impl Heuristic {
    pub(super) const ALL: [Self; 2] = [Self::Hk, Self::Euclidean];

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Hk => "hk",
            Self::Euclidean => "euclidean",
        }
    }

    /// The name within a sentence.
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Hk => "h_k",
            Self::Euclidean => "Euclidean",
        }
    }
}

/// A column of the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    Cost,
    Moves,
    Expanded,
    Percolations,
    Time,
}

impl Measure {
    pub(super) const ALL: [Self; 5] =
        [Self::Cost, Self::Moves, Self::Expanded, Self::Percolations, Self::Time];

    /// The column of the record.
    pub(super) const fn column(self) -> &'static str {
        match self {
            Self::Cost => "cost",
            Self::Moves => "moves",
            Self::Expanded => "expanded",
            Self::Percolations => "percolations",
            Self::Time => "micros",
        }
    }

    /// The heading in the paper, in full.
    pub(super) const fn words(self) -> &'static str {
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
pub(super) struct SearchKey {
    pub(super) algorithm: Algorithm,
    pub(super) heuristic: Heuristic,
    pub(super) k: u32,
}

impl SearchKey {
    /// All searches; those of one k follow each other.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        KS.into_iter().flat_map(|k| {
            Algorithm::ALL
                .into_iter()
                .flat_map(move |algorithm| Heuristic::ALL.map(|heuristic| Self { algorithm, heuristic, k }))
        })
    }

    pub(super) fn setup(self) -> String {
        let engine = if self.algorithm == Algorithm::AStar { "astar" } else { "canonical" };
        let variant = if self.algorithm == Algorithm::Paper { ",paper" } else { "" };
        let heuristic = if self.heuristic == Heuristic::Euclidean { ",euclidean" } else { "" };
        format!("{engine}:{}:never{variant}{heuristic}", self.k)
    }

    /// The search whose numbers this search's are divided by, since the instances are not the paper's: that
    /// of k = 3 in the same column; for k = 3, that of the other heuristic, or that of A*. None for A* with
    /// h_k at k = 3.
    pub(super) fn reference(self) -> Option<Self> {
        if self.k != BASE {
            Some(Self { k: BASE, ..self })
        } else if self.heuristic == Heuristic::Euclidean {
            Some(Self { heuristic: Heuristic::Hk, ..self })
        } else if self.algorithm != Algorithm::AStar {
            Some(Self { algorithm: Algorithm::AStar, ..self })
        } else {
            None
        }
    }

    /// A number of its row on a set.
    pub(super) fn number(self, record: &Record, set: &str, column: &str) -> Option<f64> {
        let k = self.k.to_string();
        let keys = [
            ("set", set),
            ("algorithm", self.algorithm.name()),
            ("heuristic", self.heuristic.name()),
            ("k", &k),
        ];
        record.number(&keys, column)
    }
}
