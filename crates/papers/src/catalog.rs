//! The list of the experiments.

use crate::{
    Error, centers, central64, compared, engines,
    experiment::{Experiment, Page},
    families, growth, hammoud, hierarchies, hormazabal, kramm, memory, rivera, teleisa,
};

/// All experiments, in the order in which they run and stand on the pages.
pub(crate) const EXPERIMENTS: &[Experiment] = &[
    rivera::TABLES,
    rivera::THETA,
    rivera::ALTERNATIVES,
    hormazabal::PLANNERS,
    hormazabal::branching::BRANCHING,
    hormazabal::distance::DISTANCE,
    kramm::ratios::RATIOS,
    kramm::bounds::BOUNDS,
    hammoud::TABLES,
    hammoud::FIGURES,
    teleisa::RUNS,
    engines::ENGINES,
    growth::GROWTH,
    families::FAMILIES,
    centers::EXCESS,
    hierarchies::HPA,
    compared::PROGRAMS,
    memory::MEMORY,
    central64::CENTRAL64,
];

/// The experiments of these names, or of the pages of these names; all for none.
pub(crate) fn chosen(only: &[String], without: &[String]) -> Result<Vec<&'static Experiment>, Error> {
    let is =
        |experiment: &Experiment, name: &String| experiment.id == name || experiment.page.file() == *name;
    let is_unknown = |name: &&String| !EXPERIMENTS.iter().any(|experiment| is(experiment, name));
    if let Some(name) = only.iter().chain(without).find(is_unknown) {
        let known: Vec<&str> = EXPERIMENTS.iter().map(|experiment| experiment.id).collect();
        let pages = Page::ALL.map(Page::file).join(", ");
        let there = format!("there are {}, and the pages {pages}", known.join(", "));
        return Err(Error::Reproduce(format!("unknown experiment `{name}`: {there}")));
    }
    let is_in = |names: &[String], experiment: &Experiment| names.iter().any(|name| is(experiment, name));
    let is_asked = |experiment: &&Experiment| {
        (only.is_empty() || is_in(only, experiment)) && !is_in(without, experiment)
    };
    Ok(EXPERIMENTS.iter().filter(is_asked).collect())
}
