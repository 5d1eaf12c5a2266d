//! Costs against the optima that scenarios state.

use std::{io, path::Path};

use mediant::{Engine, Error, Motion, Planner, Setup};
use mediant_formats::{Ground, Scenario, scenario_tolerance};
use mediant_moves::FiniteK;
use mediant_search::Ends;
use mediant_sets::{Manifest, progress, root};
use rayon::prelude::*;

use super::{Options, Relation, Tally, VerifyError, cost};
use crate::grounds::{Grounds, OTHER_MAPS};

/// The setup of an engine for the problem of the scenario files: k = 3 between centers, no corner cut.
fn scenarios_for(engine: Engine) -> Result<(Setup, Relation), VerifyError> {
    let setup = Setup::new(engine, Motion::centers(FiniteK::N8));
    let unknown = || {
        VerifyError::Wrong(format!(
            "{engine} finds no paths over the moves of k = 3: their costs are not known"
        ))
    };
    Relation::of(setup).map(|relation| (setup, relation)).ok_or_else(unknown)
}

pub(super) fn against_scenarios(
    cache: &Path,
    options: &Options,
    engine: Engine,
    out: &mut dyn io::Write,
) -> Result<Tally, VerifyError> {
    let (setup, relation) = scenarios_for(engine)?;
    let manifest = Manifest::read(&Manifest::path(&root()))?;
    let asked = |name: &String| options.set.is_empty() || options.set.contains(name);
    for name in &options.set {
        manifest.set(name)?;
    }
    let mut total = Tally::default();
    for set in manifest.sets.iter().filter(|set| asked(&set.name)) {
        let folder = cache.join(&set.name);
        if !folder.is_dir() {
            if !options.set.is_empty() {
                return Err(VerifyError::Wrong(format!(
                    "set {0} is not there: cargo xtask download --set {0}",
                    set.name
                )));
            }
            continue;
        }
        let maps = options.maps(&folder)?;
        let bar = progress(&set.name, maps.len());
        let tallies: Vec<Tally> = maps
            .par_iter()
            .map(|map| {
                scenario_of(setup, relation, (map, &set.name), options.every.get()).inspect(|_| bar.inc(1))
            })
            .collect::<Result<_, _>>()?;
        bar.finish_and_clear();
        let tally = tallies.into_iter().fold(Tally::default(), Tally::add);
        let others = [tally.blocked, tally.shorter, tally.longer];
        let seen = tally.compared + others.iter().sum::<u64>();
        if options.is_whole() && set.instances.is_some_and(|instances| instances != seen) {
            return Err(VerifyError::Wrong(format!(
                "set {}: {seen} instances, not all that it has",
                set.name
            )));
        }
        // An engine that is not optimal finds other lengths.
        let is_known = tally.blocked == KNOWN[0] && (relation == Relation::AtLeast || others == KNOWN);
        if options.is_whole() && set.name == OTHER_MAPS && !is_known {
            let wrong = format!("in {OTHER_MAPS} {others:?} instances are not compared, expected {KNOWN:?}");
            return Err(VerifyError::Wrong(wrong));
        }
        writeln!(
            out,
            "{:<12} {:>3} maps, {:>7} costs compared with the scenarios' optima: {}",
            set.name,
            maps.len(),
            tally.compared,
            tally.distance(relation),
        )?;
        if others.iter().any(|&count| count > 0) {
            writeln!(
                out,
                "{:<12} not compared, since made on other maps: {} instances with a blocked end, {} with a \
                 shorter reference, {} with a longer one",
                "", tally.blocked, tally.shorter, tally.longer
            )?;
        }
        total = total.add(tally);
    }
    writeln!(out, "{:<12} {} costs compared", "in all", total.compared)?;
    Ok(total)
}

/// The instances of [`OTHER_MAPS`] that are not compared: whose end is blocked, on a cliff line `@` one cell
/// wide; whose reference is shorter than every path on the map; whose reference is longer than one (377 among
/// trees, 1 in water).
const KNOWN: [u64; 3] = [411, 5_182, 378];

/// A map and its planners, one for each ground that was stood on; of other sets one.
struct Planners {
    setup: Setup,
    grounds: Grounds,
    planners: Vec<(Option<Ground>, Planner)>,
}

impl Planners {
    /// The cost of the answer to a query; `None` where there is no path.
    fn cost(&mut self, query: Ends) -> Result<Option<f64>, Error> {
        let ground = self.grounds.ground(query.start);
        let known = self.planners.iter().position(|(of, _)| *of == ground);
        let at = match known {
            Some(at) => at,
            None => {
                self.planners.push((ground, self.setup.planner(&self.grounds.map(ground))?));
                self.planners.len() - 1
            }
        };
        Ok(cost(&mut self.planners[at].1, query)?)
    }
}

/// Compares the costs of one map with its scenario. Scenarios state lengths with as few as six digits, and 0
/// where there is no path (173 instances of set dao).
fn scenario_of(
    setup: Setup,
    relation: Relation,
    (path, set): (&Path, &str),
    every: usize,
) -> Result<Tally, VerifyError> {
    let grounds = Grounds::read(path, set)?;
    let other_map = grounds.are_of_other_maps();
    let scenario = Scenario::read(path.with_extension("map.scen"))?;
    let mut planners = Planners { setup, grounds, planners: Vec::new() };
    let mut tally = Tally::default();
    for (index, instance) in scenario.instances().iter().enumerate().step_by(every) {
        let reachable = instance.optimal > 0.0 || instance.start == instance.goal;
        let optimal = reachable.then_some(instance.optimal);
        let tolerance = scenario_tolerance(instance.optimal);
        let what = || format!("{setup}, {} instance {index}", path.display());
        let found = match planners.cost(Ends::new(instance.start, instance.goal)) {
            Ok(found) => found,
            Err(Error::Query(_)) if other_map => {
                tally.blocked += 1;
                continue;
            }
            Err(Error::Query(_)) => None,
            Err(wrong) => return Err(VerifyError::Wrong(format!("{}: {wrong}", path.display()))),
        };
        match found.filter(|_| other_map) {
            Some(cost) if relation == Relation::Equal && cost > instance.optimal + 2.0 * tolerance => {
                tally.shorter += 1;
            }
            Some(cost) if cost < instance.optimal - 2.0 * tolerance => tally.longer += 1,
            _ => tally.compare(relation, what, found, optimal, tolerance),
        }
    }
    Ok(tally)
}
