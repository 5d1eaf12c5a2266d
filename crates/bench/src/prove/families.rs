//! Families: the same instances under some rules of motion, by every exact engine that these have.

use std::fmt;

use mediant::{
    CornerRule, DiagonalGap, Ends, Engine, Error, FiniteK, K, Motion, PlacementKind, Rules, Setup, Space,
    options::{ConfiguredEngine, Levels, SubgoalOptions},
};
use mediant_formats::scenario_tolerance;
use sha2::{Digest, Sha256};

use super::{
    Pace,
    outcome::{Asker, Outcome, number, takes},
    tally::Tally,
    terrain::{Instance, Terrain},
};

/// A family of problems: all rules of motion of a placement at one k. At k = 3 between centers the rule of
/// the scenario files, which most engines solve, is a family of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Family {
    placement: PlacementKind,
    k: K,
    /// Whether it is the rule of the scenario files alone, or all others.
    is_scenarios: bool,
}

impl Family {
    /// All families, in the order in which they are proven.
    pub(super) fn all() -> Vec<Self> {
        let of = |placement, k, is_scenarios| Self { placement, k, is_scenarios };
        let (center, corner) = (PlacementKind::Center, PlacementKind::Corner);
        let ks = || (2..=8).filter_map(|k| K::new(k).ok()).chain([K::Any]);
        let mut all = vec![of(center, K::N8, true)];
        all.extend(ks().map(|k| of(corner, k, false)));
        all.push(of(center, K::Any, false));
        all.extend(ks().filter(|&k| k != K::Any).map(|k| of(center, k, false)));
        all
    }

    /// Whether a vertex has so many moves that tables of them take seconds to make.
    pub(super) fn is_of_many_moves(self) -> bool {
        self.k.finite().is_some_and(|k| k > FiniteK::N64)
    }

    /// Whether subgoals are prepared for it.
    pub(super) fn has_subgoals(self) -> bool {
        let solves = |&motion: &Motion| Setup::new(Engine::Subgoal, motion).check().is_ok();
        self.motions().iter().any(solves)
    }

    /// Its rules of motion.
    pub(super) fn motions(self) -> Vec<Motion> {
        let rules: Vec<Rules> = match (self.placement, self.k) {
            (PlacementKind::Corner, _) => DiagonalGap::ALL.map(Rules::Corner).to_vec(),
            (PlacementKind::Center, K::Any) => DiagonalGap::ALL.map(Rules::CenterGap).to_vec(),
            (PlacementKind::Center, K::Finite(_)) => CornerRule::ALL.map(Rules::Center).to_vec(),
        };
        let motions = rules.into_iter().map(|rules| Motion::new(self.k, rules));
        motions.filter(|motion| self.k != K::N8 || self.is_scenarios == is_of_scenarios(*motion)).collect()
    }
}

/// As `centers-3`, `centers-3-cut`, `corners-5`, `corners-any`.
impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_cut = self.placement == PlacementKind::Center && self.k == K::N8 && !self.is_scenarios;
        f.pad(&format!("{}s-{}{}", self.placement, self.k, if is_cut { "-cut" } else { "" }))
    }
}

/// Whether scenario files state the lengths of its shortest paths.
fn is_of_scenarios(motion: Motion) -> bool {
    motion.k == K::N8 && motion.rules == Rules::Center(CornerRule::Never)
}

/// A way to find costs.
#[derive(Clone, Copy)]
enum Way {
    Engine(ConfiguredEngine),
    /// The distances from a start to all vertices.
    Field,
}

/// Answers, each with its instance's place among all.
type Answers = Vec<(usize, Outcome)>;

/// A way to find costs that takes part.
#[derive(Clone, Copy)]
struct Contestant {
    name: &'static str,
    way: Way,
    /// Whether it takes so long that it is asked fewer instances.
    is_slow: bool,
    /// Whether its paths may be longer than the shortest.
    may_be_longer: bool,
}

/// The names of all contestants, in the order in which they are asked.
pub(super) const CONTESTANTS: [&str; 11] = [
    "labels",
    "graph",
    "jps-block",
    "jps-plus",
    "jps",
    "canonical",
    "anya",
    "dijkstra",
    "astar",
    "wavefront",
    "field",
];

impl Contestant {
    /// The contestant of a name under a motion; `None` if it does not solve it.
    fn new(name: &'static str, motion: Motion) -> Option<Self> {
        let subgoals = |levels| ConfiguredEngine::Subgoal(SubgoalOptions { levels, memory: None });
        let way = match name {
            "labels" => Way::Engine(subgoals(None)),
            "graph" => Way::Engine(subgoals(Some(Levels::Contracted))),
            "field" => Way::Field,
            name => Way::Engine(name.parse::<Engine>().ok()?.into()),
        };
        let is_large = motion.k.finite().is_none_or(|k| k > FiniteK::N8);
        let is_slow = match name {
            "dijkstra" | "astar" | "wavefront" => true,
            "field" => is_large,
            // They look at each move of N(k) by itself.
            "jps" | "canonical" => motion.k.finite().is_some_and(|k| k > FiniteK::N32),
            _ => false,
        };
        let mut own = Self { name, way, is_slow, may_be_longer: false };
        if let Way::Engine(engine) = way {
            let setup = Setup::new(engine, motion);
            setup.check().ok()?;
            own.may_be_longer = setup.optimal_over() != Some(motion.k);
            // It is held to the rule of the scenario files alone.
            if own.may_be_longer && !is_of_scenarios(motion) {
                return None;
            }
        }
        Some(own)
    }

    /// Its answers to the instances that it is asked: each with the instance's place among all. And a number
    /// that they decide.
    fn answers(
        self,
        space: &Space,
        instances: &[Instance],
        step: usize,
    ) -> Result<Option<(Answers, u64)>, Error> {
        let asked = instances.iter().enumerate().step_by(step);
        match self.way {
            Way::Field => {
                let answers = of_fields(space, asked)?;
                let words = answers.iter().map(|(_, outcome)| outcome.to_string());
                let digest = words.fold(Sha256::new(), |digest, word| digest.chain_update(word));
                Ok(Some((answers, number(digest))))
            }
            Way::Engine(engine) => {
                let mut asker = Asker::new(space, engine)?;
                // Where subgoals are not worth their memory another engine searches, which is asked itself.
                if asker.planner.index().searched_by() != engine.kind() {
                    return Ok(None);
                }
                let is_subgoal = engine.kind() == Engine::Subgoal;
                let ask = |(at, instance): (usize, &Instance)| match is_subgoal {
                    true => (at, asker.cost_twice(instance.ends)),
                    false => (at, asker.cost(instance.ends)),
                };
                let answers = asked.map(ask).collect();
                Ok(Some((answers, asker.digest())))
            }
        }
    }
}

/// The answers by one field for each distinct start.
fn of_fields<'a>(
    space: &Space,
    asked: impl Iterator<Item = (usize, &'a Instance)>,
) -> Result<Answers, Error> {
    let mut sorted: Vec<(usize, Ends)> = asked.map(|(at, instance)| (at, instance.ends)).collect();
    sorted.sort_by_key(|(_, ends)| (ends.start.y, ends.start.x));
    let mut fields = space.fields()?;
    let mut last = None;
    let mut answers = Vec::with_capacity(sorted.len());
    for (at, ends) in sorted {
        if !takes(space, ends) {
            answers.push((at, Outcome::Refused));
            continue;
        }
        let field = match last.take().filter(|(start, _)| *start == ends.start) {
            Some((_, field)) => field,
            None => fields.field([ends.start])?,
        };
        answers.push((at, Outcome::of_field(&field, space.motion(), ends)));
        last = Some((ends.start, field));
    }
    Ok(answers)
}

/// Proves a family on one terrain. `of` names the map.
pub(super) fn prove(
    motions: &[Motion],
    (of, terrain): (&str, &Terrain),
    pace: Pace,
    tally: &mut Tally,
) -> Result<(), Error> {
    for &motion in motions {
        let space = terrain.map.space(motion)?;
        let contestants = CONTESTANTS.into_iter().filter_map(|name| Contestant::new(name, motion));
        let mut known: Option<(&str, Answers)> = None;
        for contestant in contestants {
            // With the first all others are compared.
            let step = if contestant.is_slow && known.is_some() { pace.at(motion.k) } else { 1 };
            let Some((answers, digest)) = contestant.answers(&space, &terrain.instances, step)? else {
                continue;
            };
            tally.digest(digest);
            tally.count_many(contestant.name, answers.len() as u64);
            match &known {
                None => {
                    against_scenario((of, terrain), motion, (contestant.name, &answers), tally);
                    known = Some((contestant.name, answers));
                }
                Some(known) => compare((of, terrain), motion, (contestant, &answers), known, tally),
            }
        }
    }
    Ok(())
}

/// An instance in words.
pub(super) fn words(of: &str, instance: &Instance, motion: Motion) -> String {
    let Ends { start, goal, .. } = instance.ends;
    format!("{of} instance {}, {start} → {goal}, {motion}", instance.index)
}

/// Compares a contestant with the first one, which was asked every instance.
fn compare(
    (of, terrain): (&str, &Terrain),
    motion: Motion,
    (contestant, answers): (Contestant, &[(usize, Outcome)]),
    (first, known): &(&str, Answers),
    tally: &mut Tally,
) {
    for (at, outcome) in answers {
        let (_, other) = &known[*at];
        let agrees = match contestant.may_be_longer {
            true => other.is_at_most(1.0, outcome) && other.is_path() == outcome.is_path(),
            false => outcome.agrees(other),
        };
        tally.expect(agrees, || {
            let instance = words(of, &terrain.instances[*at], motion);
            format!("{instance}: {} finds {outcome}, {first} {other}", contestant.name)
        });
    }
}

/// Counts the instances, and compares with what the scenario states, if it states anything of this motion.
fn against_scenario(
    (of, terrain): (&str, &Terrain),
    motion: Motion,
    (name, answers): (&str, &[(usize, Outcome)]),
    tally: &mut Tally,
) {
    for (instance, (_, outcome)) in terrain.instances.iter().zip(answers) {
        match outcome {
            Outcome::Refused => tally.count("refused"),
            Outcome::NoPath => tally.count("unreachable"),
            Outcome::Broken(wrong) => tally.wrong(format!("{}: {name} {wrong}", words(of, instance, motion))),
            Outcome::Exact(_) | Outcome::Length(_) => {}
        }
        tally.count("problems");
        if !is_of_scenarios(motion) {
            continue;
        }
        // Of other maps a scenario may state what is not so there: `verify` counts in which way.
        let found = outcome.is_path().then(|| outcome.cells());
        let agrees = match (found, instance.stated) {
            (Some(found), Some(stated)) => (found - stated).abs() <= scenario_tolerance(stated),
            (None, None) => true,
            _ => false,
        };
        match agrees || !terrain.is_of_other_map {
            true => tally.count("scenario"),
            false => tally.count("incomparable"),
        }
        tally.expect(agrees || terrain.is_of_other_map, || {
            let stated = instance.stated.map_or("no path".to_owned(), |stated| stated.to_string());
            format!("{}: {name} finds {outcome}, the scenario {stated}", words(of, instance, motion))
        });
    }
}
