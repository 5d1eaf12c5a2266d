//! Hammoud & Lupin 2023: jump point search on the street maps, tables I and II and figures 8 to 13.
//!
//! **The key decision: each engine answers under each corner rule.** The paper compares an A* that cuts no
//! corners with a JPS that does, so that its two columns are lengths of two different problems. Here each
//! column is compared under its own rule, and the two rules with each other.

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

/// Figures 8 to 13, with engines and rules that they leave out.
pub(super) const FIGURES: Experiment = Experiment {
    id: "hammoud2023-figures",
    page: Page::Hammoud2023,
    title: "Figures 8 to 13: all street maps",
    sets: &["street"],
    measure: figures::measure,
    show: figures::pages::show,
};
