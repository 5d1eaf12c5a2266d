//! `mediant engines`: the catalog as a table.

use mediant_engines::{About, Engine};
use mediant_search::Guarantee;

use crate::{
    failure::Failure,
    screen::Screen,
    text::{Align, Table},
};

/// A guarantee in one word: `optimal(3)`, `optimal(any)`, `suboptimal`.
pub(crate) fn guarantee_name(guarantee: Guarantee) -> String {
    match guarantee {
        Guarantee::Optimal(k) => format!("optimal({k})"),
        Guarantee::OptimalAnyAngle => "optimal(any)".to_owned(),
        Guarantee::Suboptimal => "suboptimal".to_owned(),
    }
}

/// Runs the command.
pub(crate) fn list(screen: &mut Screen) -> Result<(), Failure> {
    let heads = ["engine", "placements", "k", "guarantee", "paper"].map(|head| (head, Align::Left));
    let mut table = Table::new(heads);
    for engine in Engine::ALL {
        let About { max_k, guarantee, paper, .. } = engine.about();
        let k = format!("2 … {max_k}");
        table.row([engine.name(), "center, corner", &k, guarantee, paper].map(str::to_owned));
    }
    Ok(table.write(screen)?)
}
