//! Sub2-A*(k), Sub2-Theta* and Anya ('Empirical Evaluation', Figures 2 to 4).

pub(super) mod pages;

use mediant_bench::Study;
use mediant_report::{Column, Row};
use serde::{Deserialize, Serialize};

use crate::{
    Error,
    context::{Context, How},
    experiment::Findings,
    maps::Map,
    setups::{Sums, costs, run},
};

/// The paper's range of k, as far as the text tells it.
pub(super) const KS: std::ops::RangeInclusive<u32> = 3..=9;

/// The names of planners in the record.
const SUB2_A_STAR: &str = "Sub2-A*";
const SUB2_THETA: &str = "Sub2-Theta*";
const ANYA: &str = "Anya";
const ANYA_CLOSED: &str = "Anya, gaps closed";
const CONTRACTED: &str = "subgoal";

/// The smoothings: their text in the setup, and the key of the row.
const SMOOTHINGS: [(&str, &str); 3] = [("", "none"), (",smooth", "smooth"), (",taut", "taut")];

/// One planner.
struct Planner {
    engine: &'static str,
    k: String,
    smoothing: &'static str,
    setup: String,
}

/// All planners; those that share an index follow each other. The first gives the optima that the others are
/// compared with.
fn planners() -> Vec<Planner> {
    let one =
        |engine, k: &str, smoothing, setup: String| Planner { engine, k: k.to_owned(), smoothing, setup };
    // A contraction hierarchy, not the hub labels of today: the claims are about searches in subgoal graphs.
    let mut planners = vec![one(CONTRACTED, "any", "none", "subgoal:any:open,levels=contracted".to_owned())];
    for k in KS {
        for (text, smoothing) in SMOOTHINGS {
            planners.push(one(
                SUB2_A_STAR,
                &k.to_string(),
                smoothing,
                format!("subgoal:{k}:open,levels=2{text}"),
            ));
        }
    }
    planners.push(one(SUB2_THETA, "3", "none", "subgoal-theta:3:open,levels=2".to_owned()));
    for k in [3, 6, 9] {
        planners.push(one(CONTRACTED, &k.to_string(), "none", format!("subgoal:{k}:open,levels=contracted")));
    }
    planners.push(one(ANYA, "any", "none", "anya:any:open".to_owned()));
    planners.push(one(ANYA_CLOSED, "any", "none", "anya:any:closed".to_owned()));
    planners
}

/// Whether the map is taken: 2-level graphs of noise with few blocked cells take minutes each, for any k.
fn is_taken(map: &Map) -> bool {
    map.set != "random" || map.name.starts_with("random512-40-")
}

/// The sums of the planners on a map, in their order.
#[derive(Serialize, Deserialize)]
struct Part {
    sums: Vec<Sums>,
}

fn part(map: &Map, every: usize, passes: u32) -> Result<Part, Error> {
    let (grid, queries) = (map.grid()?, map.queries(every)?);
    let mut study = Study::new(&grid, &queries, passes);
    let (mut optima, mut sums) = (Vec::new(), Vec::new());
    for planner in planners() {
        let run = run(&mut study, &planner.setup)?;
        if optima.is_empty() {
            optima = costs(&run);
        }
        // A path that keeps out of gaps cannot be compared with the optimum through open gaps.
        let against = if planner.engine == ANYA_CLOSED { &[] } else { &*optima };
        sums.push(Sums::of(&run, against));
    }
    Ok(Part { sums })
}

pub(super) fn measure(ctx: &Context<'_>) -> Result<Findings, Error> {
    let mut maps = Vec::new();
    for set in ctx.sets() {
        let all: Vec<Map> = ctx.maps(set, usize::MAX)?.into_iter().filter(is_taken).collect();
        let step = match set {
            "sc1" => ctx.quick_or(usize::MAX, 8),
            "random" => ctx.quick_or(usize::MAX, 2),
            "dao" => ctx.quick_or(80, 1),
            _ => ctx.quick_or(30, 2),
        };
        maps.extend(all.into_iter().step_by(step));
    }
    let (every, passes) = (ctx.quick_or(100, 20), ctx.passes());
    let parts = ctx.each("maps", How::Timed, &maps, |map| part(map, every, passes))?;
    let (mut rows, mut queries) = (Vec::new(), 0);
    for set in ctx.sets() {
        for (at, planner) in planners().iter().enumerate() {
            let mut sums = Sums::default();
            let of_set = maps.iter().zip(&parts).filter(|(map, _)| map.set == set);
            of_set.filter_map(|(_, part)| part.sums.get(at)).for_each(|part| sums.add(part));
            queries += if at == 0 { sums.found } else { 0 };
            let row = Row::new().key("set", set).key("engine", planner.engine).key("k", &planner.k);
            rows.push(sums.row(row.key("smoothing", planner.smoothing)).with("maps", sums.maps as f64));
        }
    }
    let mut columns = vec![
        Column::key("set", "the set of maps"),
        Column::key("engine", "the planner"),
        Column::key("k", "paths over the 2^k neighborhood, or at any angle"),
        Column::key(
            "smoothing",
            "none, smooth (Botea et al. 2004: in a straight line where the ends see each other) or taut",
        ),
        Column::count("maps", "", "maps"),
    ];
    columns.extend(Sums::columns());
    Ok(Findings {
        columns,
        rows,
        maps: maps.len(),
        instances: queries,
        drawn: format!(
            "every {every}th instance of each scenario, those with joined ends, vertices at corners, gaps \
             open{}",
            ctx.quick_or(
                "",
                "; of bg512 and room every second map, of sc1 every eighth, of random every second of those \
                 with 40 % blocked, since 2-level graphs of sparser noise take minutes each"
            )
        ),
        seeded: false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setups::setup;

    #[test]
    fn planners_exist_and_differ() {
        let planners = planners();
        let mut keys = Vec::new();
        for planner in &planners {
            setup(&planner.setup).unwrap().check().unwrap();
            let key = (planner.engine, &planner.k, planner.smoothing);
            assert!(!keys.contains(&key), "{key:?}");
            keys.push(key);
        }
        assert_eq!(planners.len(), 1 + 21 + 1 + 3 + 2);
        // The first promises the optima that the others are compared with.
        assert!(setup(&planners[0].setup).unwrap().optimal_over() == Some(mediant_moves::K::Any));
    }
}
