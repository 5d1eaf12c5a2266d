//! The operations of a thread, each compared with the reference.

use std::{
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
    time::Duration,
};

use mediant::{Answer, Guarantee, K, Limit, Limits, Planners, Query, Vertex};
use mediant_oracle::Rng;

use super::{
    SoakError,
    kind::Kind,
    timer::Timer,
    world::{Relation, Runner, World},
};

/// The relative difference of equal lengths that are not counted in moves.
const ROUNDING: f64 = 1e-9;

/// The flags by which threads cancel each other's queries: that of each thread's current query.
pub(super) type Flags = [Mutex<Arc<AtomicBool>>];

/// A thread that asks.
#[derive(Debug)]
pub(super) struct Asker<'w> {
    pub(super) world: &'w World,
    pub(super) rng: Rng,
    pub(super) timer: Timer<'w>,
    pub(super) flags: &'w Flags,
    /// The number of its flag.
    pub(super) number: usize,
}

/// The length of an answer's path, as its engine counts it; `None` without a path.
fn length(guarantee: Guarantee, answer: &Answer) -> Option<f64> {
    answer.path().map(|path| guarantee.length(path))
}

/// Checks a length against the reference; `None` stands for no path.
pub(super) fn compare(
    world: &World,
    runner: &Runner,
    what: impl FnOnce() -> String,
    [found, known]: [Option<f64>; 2],
) -> Result<(), SoakError> {
    // Over N(k) where cells cost nothing, lengths are sums of the same moves.
    let is_exact = world.space.motion().k != K::Any && world.space.costs().is_none();
    let room = if is_exact { 0.0 } else { ROUNDING };
    let agrees = match (found, known) {
        (Some(found), Some(known)) => match runner.relation {
            Relation::Equal => (found - known).abs() <= room * known,
            // A path of any kind may have been added up in another order.
            Relation::AtLeast => found >= known * (1.0 - ROUNDING),
            Relation::Alike => true,
        },
        (None, None) => true,
        (Some(_), None) => runner.relation == Relation::Alike,
        (None, Some(_)) => false,
    };
    if agrees {
        return Ok(());
    }
    let what = what();
    Err(SoakError::Wrong(format!("{}, {what}: found {found:?}, the reference is {known:?}", runner.engine)))
}

impl Asker<'_> {
    /// Does the next operation.
    pub(super) fn step(&mut self) -> Result<(), SoakError> {
        let kind = *self.rng.pick(&Kind::ASKED).unwrap_or(&Kind::Path);
        let world = self.world;
        let Some(runner) = self.rng.pick(&world.runners) else { return Ok(()) };
        if self.rng.chance(20) {
            let other = self.rng.below(self.flags.len() as u32) as usize;
            self.flags[other].lock().unwrap_or_else(PoisonError::into_inner).store(true, Ordering::Relaxed);
        }
        let ends = [world.end(&mut self.rng), world.end(&mut self.rng)];
        let is_free = ends.iter().all(|&end| world.space.is_free(end));
        match kind {
            Kind::Wish => self.wish(runner, ends),
            Kind::Path => self.path(runner, ends),
            _ if !is_free => Ok(()),
            Kind::Distance => self.distance(runner, ends),
            Kind::Limit => self.limit(runner, ends),
            Kind::Steps => self.steps(runner, ends),
            Kind::Cancel => self.cancel(runner, ends),
            Kind::Batch => self.batch(runner),
            Kind::Field => self.field(runner, ends),
            _ => self.table(runner),
        }
    }

    /// The length of the reference's path.
    fn known(&self, query: impl Into<Query>) -> Result<Option<f64>, SoakError> {
        let answer = self.world.reference.find(query)?;
        Ok(length(self.guarantee(&self.world.reference), &answer))
    }

    fn guarantee(&self, planners: &Planners) -> Guarantee {
        planners.with(|planner| planner.guarantee())
    }

    fn compare(
        &self,
        runner: &Runner,
        what: impl FnOnce() -> String,
        pair: [Option<f64>; 2],
    ) -> Result<(), SoakError> {
        compare(self.world, runner, what, pair)
    }

    /// The answer to a query, and its length.
    fn ask(&mut self, kind: Kind, runner: &Runner, query: Query) -> Result<(Answer, Option<f64>), SoakError> {
        let planners = &runner.planners;
        let answer = self.timer.time(kind, runner.engine, || planners.find(query))??;
        let length = length(self.guarantee(planners), &answer);
        Ok((answer, length))
    }

    fn path(&mut self, runner: &Runner, [start, goal]: [Vertex; 2]) -> Result<(), SoakError> {
        let space = &self.world.space;
        let is_free = space.is_free(start) && space.is_free(goal);
        let planners = &runner.planners;
        let answer = self.timer.time(Kind::Path, runner.engine, || planners.find((start, goal)))?;
        match answer {
            Err(_) if !is_free => Ok(()),
            Err(error) => Err(error.into()),
            Ok(_) if !is_free => {
                Err(self.timer.wrong(runner.engine, format!("{start} → {goal}: answered at a blocked end")))
            }
            Ok(answer) => {
                if let Some(path) = answer.path()
                    && let Err(broken) = space.check(path)
                {
                    return Err(self.timer.wrong(runner.engine, format!("{start} → {goal}: {broken}")));
                }
                let found = length(self.guarantee(planners), &answer);
                let known = self.known((start, goal))?;
                self.compare(runner, || format!("path {start} → {goal}"), [found, known])
            }
        }
    }

    fn distance(&mut self, runner: &Runner, [start, goal]: [Vertex; 2]) -> Result<(), SoakError> {
        let planners = &runner.planners;
        let measure = || planners.with(|planner| planner.distance((start, goal)));
        let found = self.timer.time(Kind::Distance, runner.engine, measure)??;
        let known = self.known((start, goal))?;
        self.compare(runner, || format!("distance {start} → {goal}"), [found, known])
    }

    fn wish(&mut self, runner: &Runner, [start, goal]: [Vertex; 2]) -> Result<(), SoakError> {
        let query = match self.rng.below(4) {
            0 => Query::new(start, goal).nearest(),
            1 => Query::new(start, goal).tolerance(f64::from(self.rng.below(6)) / 2.0),
            2 => Query::new(start, goal).snap(),
            _ => {
                let more = [0; 2].map(|_| self.world.end(&mut self.rng));
                Query::between([start, more[0]], [goal, more[1]])
            }
        };
        let text = format!("{query:?}");
        let planners = &runner.planners;
        let found = self.timer.time(Kind::Wish, runner.engine, || planners.find(query.clone()))?;
        let (answer, known) = match (found, self.world.reference.find(query)) {
            (Ok(answer), Ok(known)) => (answer, known),
            // A wish that cannot be met by any: a blocked start, say.
            (Err(_), Err(_)) => return Ok(()),
            (Err(error), Ok(_)) | (Ok(_), Err(error)) => {
                return Err(self
                    .timer
                    .wrong(runner.engine, format!("{text}: of the two one fails: {error}")));
            }
        };
        if runner.relation != Relation::Alike && answer.status() != known.status() {
            let (found, known) = (answer.status(), known.status());
            return Err(self
                .timer
                .wrong(runner.engine, format!("{text}: {found}, the reference is {known}")));
        }
        let found = length(self.guarantee(planners), &answer);
        let known = length(self.guarantee(&self.world.reference), &known);
        self.compare(runner, || text, [found, known])
    }

    /// Checks an answer that may have been stopped.
    fn stopped_or(
        &self,
        runner: &Runner,
        what: &str,
        (answer, found): (&Answer, Option<f64>),
        known: Option<f64>,
    ) -> Result<(), SoakError> {
        let Answer::Stopped(stopped) = answer else {
            return self.compare(runner, || what.to_owned(), [found, known]);
        };
        let bound = stopped.lower_bound;
        match known {
            Some(known)
                if runner.relation == Relation::Equal && bound > known * (1.0 + ROUNDING) + ROUNDING =>
            {
                let text = format!("{what}: at least {bound}, the reference is {known}");
                Err(self.timer.wrong(runner.engine, text))
            }
            _ => Ok(()),
        }
    }

    fn limit(&mut self, runner: &Runner, [start, goal]: [Vertex; 2]) -> Result<(), SoakError> {
        let known = self.known((start, goal))?;
        let query = Query::new(start, goal);
        let (limits, what) = match self.rng.below(3) {
            0 => {
                let count = u64::from(self.rng.below(400));
                (Limits::new().expansions(count), format!("{start} → {goal} within {count} expansions"))
            }
            1 => {
                let micros = u64::from(self.rng.below(500));
                (
                    Limits::new().time(Duration::from_micros(micros)),
                    format!("{start} → {goal} in {micros} µs"),
                )
            }
            _ => {
                let factor = *self.rng.pick(&[0.8, 0.95, 1.05, 1.5]).unwrap_or(&1.5);
                // A path of some length, so that the limit is away from it.
                let Some(known) = known.filter(|&known| known >= 1.0) else { return Ok(()) };
                let (answer, found) =
                    self.ask(Kind::Limit, runner, query.within(Limits::new().cost(known * factor)))?;
                let what = format!("{start} → {goal} within {factor} of {known}");
                if runner.relation != Relation::Equal {
                    return Ok(());
                }
                let is_right = match &answer {
                    Answer::Stopped(stopped) => factor < 1.0 && stopped.by == Limit::Cost,
                    _ => factor > 1.0 && found.is_some(),
                };
                if !is_right {
                    return Err(self.timer.wrong(runner.engine, format!("{what}: {answer}")));
                }
                return self.stopped_or(runner, &what, (&answer, found), Some(known));
            }
        };
        let (answer, found) = self.ask(Kind::Limit, runner, query.within(limits))?;
        self.stopped_or(runner, &what, (&answer, found), known)
    }

    fn steps(&mut self, runner: &Runner, [start, goal]: [Vertex; 2]) -> Result<(), SoakError> {
        let (size, most) = (1 + u64::from(self.rng.below(100)), self.rng.below(60));
        let is_forgotten = self.rng.chance(30);
        let work = || {
            runner.planners.with(|planner| {
                planner.begin((start, goal))?;
                for _ in 0..most {
                    if let Some(answer) = planner.step(size)? {
                        return Ok(Some(answer));
                    }
                }
                if is_forgotten { Ok(None) } else { planner.finish().map(Some) }
            })
        };
        let answer: Result<_, mediant::errors::QueryError> =
            self.timer.time(Kind::Steps, runner.engine, work)?;
        let Some(answer) = answer? else { return Ok(()) };
        let found = length(self.guarantee(&runner.planners), &answer);
        let known = self.known((start, goal))?;
        self.compare(runner, || format!("{start} → {goal} in steps of {size}"), [found, known])
    }

    fn cancel(&mut self, runner: &Runner, [start, goal]: [Vertex; 2]) -> Result<(), SoakError> {
        let flag = Arc::new(AtomicBool::new(false));
        *self.flags[self.number].lock().unwrap_or_else(PoisonError::into_inner) = Arc::clone(&flag);
        let looks = AtomicU64::new(u64::from(self.rng.below(20)));
        let is_over =
            move || looks.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1));
        let limits = Limits::new().cancel(flag).deadline(move || is_over().is_err());
        let (answer, found) = self.ask(Kind::Cancel, runner, Query::new(start, goal).within(limits))?;
        let known = self.known((start, goal))?;
        self.stopped_or(runner, &format!("{start} → {goal}, cancelled"), (&answer, found), known)
    }

    fn batch(&mut self, runner: &Runner) -> Result<(), SoakError> {
        let count = 2 + self.rng.below(600);
        // Few different queries, so that the reference is asked seldom.
        let different: Vec<[Vertex; 2]> =
            (0..6).map(|_| [self.world.end(&mut self.rng), self.world.end(&mut self.rng)]).collect();
        let queries: Vec<Query> = (0..count)
            .map(|number| different[number as usize % different.len()])
            .map(|[start, goal]| Query::new(start, goal))
            .collect();
        let planners = &runner.planners;
        let answers = self.timer.time(Kind::Batch, runner.engine, || planners.find_all(&queries))?;
        let guarantee = self.guarantee(planners);
        for (number, [start, goal]) in different.iter().enumerate() {
            let known = match self.world.reference.find((*start, *goal)) {
                Ok(known) => length(self.guarantee(&self.world.reference), &known),
                Err(_) => continue,
            };
            for answer in answers.iter().skip(number).step_by(different.len()) {
                let found = length(guarantee, answer.as_ref().map_err(Clone::clone)?);
                self.compare(runner, || format!("{start} → {goal} in a batch"), [found, known])?;
            }
        }
        Ok(())
    }

    fn field(&mut self, runner: &Runner, [source, _]: [Vertex; 2]) -> Result<(), SoakError> {
        let space = &self.world.space;
        let field = self.timer.time(Kind::Field, runner.engine, || space.field([source]))??;
        if runner.relation != Relation::Equal {
            return Ok(());
        }
        for _ in 0..4 {
            let start = self.world.end(&mut self.rng);
            if space.is_free(start) {
                let found = runner.planners.with(|planner| planner.distance((start, source)))?;
                self.compare(
                    runner,
                    || format!("{start} → {source}, by a field"),
                    [found, field.get(start)],
                )?;
            }
        }
        Ok(())
    }

    fn table(&mut self, runner: &Runner) -> Result<(), SoakError> {
        let mut ends = || {
            let some = (0..4).map(|_| self.world.end(&mut self.rng));
            some.filter(|&end| self.world.space.is_free(end)).collect::<Vec<_>>()
        };
        let (starts, goals) = (ends(), ends());
        let index = runner.planners.index();
        let make = || index.table(starts.iter().copied(), goals.iter().copied());
        let table = self.timer.time(Kind::Table, runner.engine, make)??;
        for (row, &start) in starts.iter().enumerate() {
            for (column, &goal) in goals.iter().enumerate() {
                let found = table.get(row, column).filter(|length| length.is_finite());
                let known = self.known((start, goal))?;
                self.compare(runner, || format!("{start} → {goal} in a table"), [found, known])?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_found() {
        let folder = std::env::temp_dir();
        let mut timer = Timer::new(Duration::MAX, &folder);
        let world = World::draw(0, &mut Rng::new(0), (8, &[]), &mut timer).expect("a world");
        let check = |runner: &Runner, pair| compare(&world, runner, || "this path".to_owned(), pair).is_ok();
        let (mut exact, mut longer) = (0, 0);
        for runner in &world.runners {
            assert!(check(runner, [Some(3.0), Some(3.0)]) && check(runner, [None, None]));
            assert!(!check(runner, [None, Some(3.0)]));
            let is_alike = runner.relation == Relation::Alike;
            assert_eq!(check(runner, [Some(2.9), Some(3.0)]), is_alike, "{runner:?}");
            assert_eq!(check(runner, [Some(3.0), None]), is_alike, "{runner:?}");
            let is_equal = runner.relation == Relation::Equal;
            assert_eq!(check(runner, [Some(3.1), Some(3.0)]), !is_equal, "{runner:?}");
            *(if is_equal { &mut exact } else { &mut longer }) += 1;
        }
        assert!(exact >= 5 && longer >= 3, "{exact} exact engines, {longer} others");
    }
}
