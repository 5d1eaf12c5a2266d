//! `mediant engines`: the catalog as a table.

use std::io::Write;

use mediant_engines::{About, Engine};
use mediant_moves::K;
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

const NOTES: &str = "\
Both is center and corner. optimal(k) with k = any: the shortest of all paths.
At centers subgoal, hpa and chpa take k = 2, and k = 3 under corners never.";

/// Runs the command.
pub(crate) fn list(screen: &mut Screen) -> Result<(), Failure> {
    let heads = ["engine", "placement", "k", "guarantee", "paper"].map(|head| (head, Align::Left));
    let mut table = Table::new(heads);
    for engine in Engine::ALL {
        let About { placements, max_k, any, guarantee, paper, .. } = engine.about();
        let placement = match placements {
            [one] => one.to_string(),
            _ => "both".to_owned(),
        };
        let ks = [max_k.map(|max| format!("2–{max}")), any.then(|| K::Any.to_string())];
        let ks: Vec<String> = ks.into_iter().flatten().collect();
        table.row([engine.name(), &placement, &ks.join(", "), guarantee, paper].map(str::to_owned));
    }
    table.write(screen)?;
    Ok(writeln!(screen, "\n{NOTES}")?)
}
