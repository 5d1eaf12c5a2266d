//! Experiments, their findings, and the sections of the pages.

use mediant_report::{Claim, Column, Record, Row, Table};

use crate::{Error, context::Context};

/// The folder of the figures, in that of the pages.
pub(crate) const FIGURES: &str = "figures";

/// Something to measure, and how to show it.
pub(super) struct Experiment {
    /// A word that names it on the command line, its record and its figures.
    pub(super) id: &'static str,
    /// The page that it stands on.
    pub(super) page: Page,
    /// The heading of its section.
    pub(super) title: &'static str,
    /// The benchmark sets that it runs on.
    pub(super) sets: &'static [&'static str],
    /// Measures on the maps that the context gives.
    pub(super) measure: fn(&Context<'_>) -> Result<Findings, Error>,
    /// Draws the section of the page.
    pub(super) show: fn(&Record) -> Section,
}

/// The pages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Page {
    Rivera2017,
    Hormazabal2017,
    Kramm2018,
    Hammoud2023,
    Teleisa2023,
    Beyond,
    Compared,
}

impl Page {
    pub(super) const ALL: [Self; 7] = [
        Self::Rivera2017,
        Self::Hormazabal2017,
        Self::Kramm2018,
        Self::Hammoud2023,
        Self::Teleisa2023,
        Self::Beyond,
        Self::Compared,
    ];

    /// The name of its file, without extension.
    pub(super) const fn file(self) -> &'static str {
        match self {
            Self::Rivera2017 => "rivera2017",
            Self::Hormazabal2017 => "hormazabal2017",
            Self::Kramm2018 => "kramm2018",
            Self::Hammoud2023 => "hammoud2023",
            Self::Teleisa2023 => "teleisa2023",
            Self::Beyond => "beyond",
            Self::Compared => "compared",
        }
    }

    /// Its heading.
    pub(super) const fn title(self) -> &'static str {
        match self {
            Self::Rivera2017 => "Rivera, Hernández & Baier 2017: Grid Pathfinding on the 2^k Neighborhoods",
            Self::Hormazabal2017 => {
                "Hormazábal, Díaz, Hernández & Baier 2017: Fast and Almost Optimal Any-Angle Pathfinding \
                 Using the 2^k Neighborhoods"
            }
            Self::Kramm2018 => {
                "Kramm, Rivera, Hernández & Baier 2018: A Suboptimality Bound for 2^k Grid Path Planning"
            }
            Self::Hammoud2023 => "Hammoud & Lupin 2023: Pruning-based path planning on street maps",
            Self::Teleisa2023 => "Teleiša & Čalnerytė 2023: Convolutional hierarchical pathfinding (CHPA*)",
            Self::Beyond => "Beyond the papers: every engine",
            Self::Compared => "Beside other programs",
        }
    }
}

/// The results of an experiment; with their provenance they become a record.
pub(super) struct Findings {
    /// The columns of the rows.
    pub(super) columns: Vec<Column>,
    pub(super) rows: Vec<Row>,
    /// The numbers of maps and of queries (or other cases) that the figures are over.
    pub(super) maps: usize,
    pub(super) instances: u64,
    /// How the queries were chosen, in words.
    pub(super) drawn: String,
    /// Whether the seed has a part in that choice.
    pub(super) seeded: bool,
}

/// A section of a page in the making.
#[derive(Default)]
pub(super) struct Section {
    pub(super) markdown: String,
    /// The figures: name of the file, and SVG.
    pub(super) figures: Vec<(String, String)>,
    pub(super) claims: Vec<Claim>,
}

impl Section {
    /// Adds a paragraph.
    pub(super) fn text(&mut self, text: impl AsRef<str>) {
        self.markdown.push_str(text.as_ref().trim());
        self.markdown.push_str("\n\n");
    }

    /// Adds a heading below that of the section.
    pub(super) fn heading(&mut self, heading: &str) {
        self.text(format!("### {heading}"));
    }

    /// Adds a table; one without rows is left out.
    pub(super) fn table(&mut self, table: &Table) {
        if !table.is_empty() {
            self.text(table.markdown());
        }
    }

    /// Adds a figure. `name` is that of its file, without extension: begin it with the experiment's id.
    pub(super) fn figure(&mut self, name: &str, alternative: &str, svg: String) {
        self.text(format!("![{alternative}]({FIGURES}/{name}.svg)"));
        self.figures.push((format!("{name}.svg"), svg));
    }

    /// Adds claims to those that are judged and listed; and, if `shown`, a table of them to the section.
    pub(super) fn claims(&mut self, claims: Vec<Claim>, shown: bool) {
        if shown {
            let mut table = Table::new(["where", "what", "published", "here", "difference", ""]).names(2);
            for claim in &claims {
                table.row([
                    claim.source.clone(),
                    claim.what.clone(),
                    claim.text(claim.published),
                    claim.ours.map_or("–".to_owned(), |ours| claim.text(ours)),
                    claim.difference().map_or(String::new(), percent),
                    claim.verdict().mark().to_owned(),
                ]);
            }
            self.table(&table);
        }
        self.claims.extend(claims);
    }
}

/// A relative difference in percent, with its sign unless it is rounded to 0.
pub(super) fn percent(difference: f64) -> String {
    if difference.abs() < 5e-4 { "0.0 %".to_owned() } else { format!("{:+.1} %", 100.0 * difference) }
}
