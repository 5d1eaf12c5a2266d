//! Hammoud & Lupin 2023: jump point search on the street maps, tables I and II and figures 8 to 13.
//!
//! **The key decision: each engine answers under each corner rule.** The paper holds an A* that cuts no corners against a JPS that does, so that
//! its two columns are lengths of two problems. Here each column stands beside the same rule, and the two rules beside each other.

mod figures;
mod published;
mod tables;

use crate::experiment::{Experiment, Page};

/// Tables I and II, row by row.
pub(super) const TABLES: Experiment = Experiment {
    id: "hammoud2023-tables",
    page: Page::Hammoud2023,
    title: "Tables I and II: sixteen queries",
    sets: &["street"],
    measure: tables::measure,
    show: tables::pages::show,
};

/// Figures 8 to 13, and what they leave out.
pub(super) const FIGURES: Experiment = Experiment {
    id: "hammoud2023-figures",
    page: Page::Hammoud2023,
    title: "Figures 8 to 13: all street maps",
    sets: &["street"],
    measure: figures::measure,
    show: figures::pages::show,
};
