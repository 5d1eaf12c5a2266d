//! Rivera, Hernández & Baier 2017: Tables 1 and 2, Figure 3, the comparison with Theta*, and causes of
//! differences.

mod alternatives;
mod causes;
mod charts;
mod published;
mod searches;
mod tables;
mod theta;

pub(crate) use alternatives::CAUSES;

use crate::experiment::{Experiment, Page};

/// A* and canonical A* on random problems.
pub(super) const TABLES: Experiment = Experiment {
    id: "rivera2017-tables",
    page: Page::Rivera2017,
    title: "Tables 1 and 2, Figure 3: A* and canonical A*",
    sets: &["sc1", "bg512", "wc3maps512"],
    measure: tables::measure,
    show: tables::pages::show,
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

/// Choices that the paper leaves open.
pub(super) const ALTERNATIVES: Experiment = Experiment {
    id: "rivera2017-causes",
    page: Page::Rivera2017,
    title: "Choices that the paper leaves open",
    sets: &["sc1", "bg512", "wc3maps512"],
    measure: alternatives::measure,
    show: alternatives::show,
};
