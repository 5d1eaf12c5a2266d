//! A mutant is tried: the tests that come to its place run with it, until one fails.

use std::{
    collections::{BTreeMap, HashMap, VecDeque},
    sync::{Mutex, PoisonError},
    time::Duration,
};

use serde::{Deserialize, Serialize};

use super::{
    list::Mutant,
    suite::{self, End, Form, Test},
    tree::Program,
};
use crate::Error;

/// The result of a trial.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Outcome {
    /// It does not compile.
    Unviable,
    /// No test comes to its place: most are computed by the compiler.
    Unreached,
    /// A test fails: one of these.
    Killed(String),
    /// A test does not end.
    Late(String),
    /// All tests pass that there was time for: their seconds, and whether these are all.
    Survived(f64, bool),
}

/// The programs and tests that all trials share.
pub(super) struct Bench<'a> {
    pub(super) programs: &'a [Program],
    /// Short forms and tests without one before all others; of both the shortest first.
    pub(super) tests: &'a [Test],
    /// The first mutant of each mutant's place.
    pub(super) place: HashMap<u32, u32>,
    /// The seconds of tests that a mutant may take.
    pub(super) longest: f64,
    /// The tests that killed the last mutants of a file: the next one is likely to be killed by the same.
    killers: Mutex<HashMap<String, VecDeque<usize>>>,
}

impl<'a> Bench<'a> {
    pub(super) fn new(
        programs: &'a [Program],
        tests: &'a [Test],
        place: HashMap<u32, u32>,
        longest: f64,
    ) -> Self {
        Self { programs, tests, place, longest, killers: Mutex::default() }
    }

    /// Learns from known outcomes, of mutants of a file, which tests kill most there.
    pub(super) fn remember<'k>(&self, known: impl Iterator<Item = (&'k str, &'k Outcome)>) {
        let mut numbers = HashMap::new();
        for (number, test) in self.tests.iter().enumerate() {
            numbers.entry(format!("{} {}", self.programs[test.program].name, test.name)).or_insert(number);
        }
        let mut kills: BTreeMap<(&str, usize), usize> = BTreeMap::new();
        for (file, outcome) in known {
            if let Outcome::Killed(by) = outcome
                && let Some(&number) = numbers.get(by)
            {
                *kills.entry((file, number)).or_default() += 1;
            }
        }
        let mut kills: Vec<((&str, usize), usize)> = kills.into_iter().collect();
        kills.sort_by_key(|&(_, count)| count);
        kills.into_iter().for_each(|((file, number), _)| self.add_killer(file, number));
    }

    /// Tries a mutant.
    pub(super) fn trial(&self, mutant: &Mutant) -> Result<Outcome, Error> {
        let Some(place) = self.place.get(&mutant.id) else { return Ok(Outcome::Unviable) };
        let comes = |number: &usize| self.tests[*number].places.contains(place);
        let numbers: Vec<usize> = (0..self.tests.len()).filter(comes).collect();
        if numbers.is_empty() {
            return Ok(Outcome::Unreached);
        }
        let likely: Vec<usize> = self.likely(&mutant.file).into_iter().filter(comes).collect();
        for number in likely.iter().copied().filter(|&number| self.tests[number].seconds < 3.0) {
            if let Some(outcome) = self.batch(mutant, &[number])? {
                return Ok(outcome);
            }
        }
        // Batches whose time doubles: most mutants are killed in the first.
        let (mut spent, mut batch, mut room) = (0.0, Vec::new(), 0.25);
        let mut in_batch = 0.0;
        for &number in &numbers {
            let seconds = self.tests[number].seconds;
            if spent + in_batch + seconds > self.longest {
                break;
            }
            batch.push(number);
            in_batch += seconds;
            if in_batch >= room {
                if let Some(outcome) = self.batch(mutant, &batch)? {
                    return Ok(outcome);
                }
                (spent, in_batch, room) = (spent + in_batch, 0.0, 3.0 * room);
                batch.clear();
            }
        }
        if let Some(outcome) = self.batch(mutant, &batch)? {
            return Ok(outcome);
        }
        let all: f64 = numbers.iter().map(|&number| self.tests[number].seconds).sum();
        Ok(Outcome::Survived(spent + in_batch, spent + in_batch >= all * 0.999))
    }

    /// Runs tests, by their programs.
    fn batch(&self, mutant: &Mutant, numbers: &[usize]) -> Result<Option<Outcome>, Error> {
        let kinds = [Form::Short, Form::Only, Form::Whole];
        let runs = self.programs.iter().enumerate();
        for (at, program, form) in runs.flat_map(|(at, program)| kinds.map(|form| (at, program, form))) {
            let is_own = |number: &usize| {
                let test = &self.tests[*number];
                (test.program, test.form) == (at, form)
            };
            let own: Vec<usize> = numbers.iter().copied().filter(is_own).collect();
            // Whoever fails without a mutant is run alone.
            let (alone, own): (Vec<usize>, Vec<usize>) =
                own.into_iter().partition(|&number| self.tests[number].fails_at.is_some());
            let runs = alone.into_iter().map(|number| vec![number]).chain([own]);
            for own in runs.filter(|own| !own.is_empty()) {
                if let Some(outcome) = self.run(mutant, (program, form), &own)? {
                    return Ok(Some(outcome));
                }
            }
        }
        Ok(None)
    }

    /// Runs tests of one program and form; one that fails where it fails without a mutant has passed.
    fn run(
        &self,
        mutant: &Mutant,
        (program, form): (&Program, Form),
        own: &[usize],
    ) -> Result<Option<Outcome>, Error> {
        let names: Vec<&str> = own.iter().map(|&number| &*self.tests[number].name).collect();
        let seconds: f64 = own.iter().map(|&number| self.tests[number].seconds).sum();
        let longest = Duration::from_secs_f64(10.0 + 10.0 * seconds);
        let told = |name: &str| format!("{} {name}", program.name);
        Ok(match suite::run(program, (&names, form), ("MUTANT", &mutant.id.to_string()), longest)? {
            End::Passed => None,
            End::Failed(name, place) => {
                let Some(&number) = own.iter().find(|&&number| self.tests[number].name == name) else {
                    return Ok(Some(Outcome::Killed(told(&name))));
                };
                if self.tests[number].fails_at.as_ref() == Some(&place) {
                    return Ok(None);
                }
                self.add_killer(&mutant.file, number);
                Some(Outcome::Killed(told(&name)))
            }
            End::Late(name) => Some(Outcome::Late(told(&name))),
        })
    }

    fn likely(&self, file: &str) -> Vec<usize> {
        let killers = self.killers.lock().unwrap_or_else(PoisonError::into_inner);
        killers.get(file).map(|numbers| numbers.iter().copied().collect()).unwrap_or_default()
    }

    fn add_killer(&self, file: &str, number: usize) {
        let mut killers = self.killers.lock().unwrap_or_else(PoisonError::into_inner);
        let own = killers.entry(file.to_owned()).or_default();
        own.retain(|&known| known != number);
        own.push_front(number);
        own.truncate(6);
    }
}
