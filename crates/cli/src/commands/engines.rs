//! `mediant engines`: the catalog as a table.

use std::io::Write;

use mediant::{Engine, options::Capabilities};

use crate::{
    failure::Failure,
    terminal::{
        screen::Screen,
        table::{Align, TextTable},
    },
};

/// The notes under the table.
const NOTES: &str = "\
`both` is center and corner. optimal(k) at k = any: no legal path is shorter.
At centers subgoal, hpa and chpa take k = 2, and k = 3 with corners never.";

/// Runs the command.
pub(crate) fn list(screen: &mut Screen) -> Result<(), Failure> {
    let heads = ["engine", "placement", "k", "guarantee", "paper"].map(|head| (head, Align::Left));
    let mut table = TextTable::new(heads);
    for engine in Engine::ALL {
        let Capabilities { placements, max_k, any, guarantee, paper, .. } = engine.capabilities();
        let placement = match placements {
            [one] => one.to_string(),
            _ => "both".to_owned(),
        };
        let ks = format!("2–{max_k}{}", if any { ", any" } else { "" });
        table.row([engine.name(), &placement, &ks, guarantee.name(), paper].map(str::to_owned));
    }
    table.write(screen)?;
    writeln!(screen, "\n{NOTES}")?;
    let on_costs: Vec<_> =
        Engine::all().filter(|engine| engine.capabilities().costs).map(Engine::name).collect();
    Ok(writeln!(screen, "Costs of cells, with k = 2 to 8: {}.", on_costs.join(", "))?)
}
