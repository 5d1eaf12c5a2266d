//! Hormazábal, Díaz, Hernández & Baier 2017: subgoal graphs over N(k), and h_k by iteration.

pub(crate) mod branching;
pub(crate) mod distance;
mod planners;

use crate::experiment::{Experiment, Page};

/// Sub2-A*(k) against Sub2-Theta* and Anya.
pub(crate) const PLANNERS: Experiment = Experiment {
    id: "hormazabal2017-planners",
    page: Page::Hormazabal2017,
    title: "Sub2-A*(k) against Sub2-Theta* and Anya (Figures 2 to 4)",
    sets: &["bg512", "dao", "sc1", "random", "room"],
    measure: planners::measure,
    show: planners::pages::show,
};
