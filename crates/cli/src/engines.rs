//! `mediant engines`: the catalog as a table.

use mediant_engines::{About, Engine};
use mediant_moves::Knob;
use mediant_search::Guarantee;

use crate::{
    failure::Failure,
    screen::Screen,
    text::{Align, Table},
};

/// A guarantee in a word or two: `optimal(3)`, `at most optimal(3)`, `optimal(any)`, `suboptimal`.
pub(crate) fn guarantee_name(guarantee: Guarantee) -> String {
    match guarantee {
        Guarantee::Optimal(k) => format!("optimal({k})"),
        Guarantee::AtMost(k) => format!("at most optimal({k})"),
        Guarantee::OptimalAnyAngle => "optimal(any)".to_owned(),
        Guarantee::Suboptimal => "suboptimal".to_owned(),
    }
}

/// Runs the command.
pub(crate) fn list(screen: &mut Screen) -> Result<(), Failure> {
    let heads = ["engine", "placements", "k", "guarantee", "paper"].map(|head| (head, Align::Left));
    let mut table = Table::new(heads);
    for engine in Engine::ALL {
        let About { placements, max_k, any, guarantee, paper, .. } = engine.about();
        let placements: Vec<String> = placements.iter().map(ToString::to_string).collect();
        let ks = [max_k.map(|max| format!("2 … {max}")), any.then(|| Knob::Any.to_string())];
        let ks: Vec<String> = ks.into_iter().flatten().collect();
        table.row(
            [engine.name(), &placements.join(", "), &ks.join(", "), guarantee, paper].map(str::to_owned),
        );
    }
    Ok(table.write(screen)?)
}
