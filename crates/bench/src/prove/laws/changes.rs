//! The same answers in another way: after repairs, on costs that are all 1, by several threads.

use mediant::{
    Change, CornerRule, DiagonalGap, Engine, Error, FiniteK, Index, K, Map, Motion, Path, Planners, Query,
    Rules, Space,
};
use mediant_oracle::{Rng, random_change};

use super::{CASES, Case, asker};
use crate::prove::{outcome::Asker, parts::on_threads, tally::Tally};

/// The sense in which a repaired index equals a new one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Same {
    /// Saved, it has the same bytes.
    Bytes,
    /// It finds the same paths.
    Paths,
    /// Its paths cost the same.
    Costs,
}

/// The engines whose indexes are repaired, each with a motion and what is promised.
fn repaired_engines() -> [(Engine, Motion, Same); 10] {
    let (open, closed) = (Rules::Corner(DiagonalGap::Open), Rules::Corner(DiagonalGap::Closed));
    let never = Rules::Center(CornerRule::Never);
    [
        (Engine::AStar, Motion::new(3, never), Same::Paths),
        (Engine::Canonical, Motion::new(5, open), Same::Paths),
        (Engine::Jps, Motion::new(4, CornerRule::One), Same::Paths),
        (Engine::JpsBlock, Motion::new(3, never), Same::Costs),
        (Engine::JpsPlus, Motion::new(3, closed), Same::Costs),
        (Engine::Anya, Motion::new(K::Any, closed), Same::Costs),
        (Engine::Subgoal, Motion::new(K::Any, open), Same::Costs),
        (Engine::Subgoal, Motion::new(3, never), Same::Costs),
        (Engine::Hpa, Motion::new(3, never), Same::Bytes),
        (Engine::Chpa, Motion::new(3, never), Same::Bytes),
    ]
}

/// The edits that are made one after another.
const EDITS: usize = 3;

/// The instances that each edit puts something in the way of: few, since after large edits all is made anew.
const DISTURBED: usize = 3;

/// A repaired index equals a new one.
pub(super) fn repaired(case: Case<'_>, tally: &mut Tally) -> Result<(), Error> {
    for (engine, motion, same) in repaired_engines() {
        let mut rng = Rng::new(seed(case));
        let mut space = case.terrain.map.space(motion)?;
        let mut index = space.prepare(engine)?;
        for edit in 0..EDITS {
            let grid = random_change(&mut rng, space.map().grid()).after().clone();
            let map = disturbed(case, &grid.into(), &mut rng)?;
            let change = Change::to(&space, &map);
            index = index.repair(&change)?;
            space = change.after().clone();
            let anew = space.map().space(motion)?.prepare(engine)?;
            let what = format!("{engine}, edit {edit} by the seed {}", seed(case));
            same_index(case, (&index, &anew), same, &what, tally)?;
        }
    }
    Ok(())
}

/// A seed of the map, the same on every machine.
fn seed(case: Case<'_>) -> u64 {
    case.of
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}

/// The map with noise on the ways of some instances, so that an edit concerns those that are asked.
fn disturbed(case: Case<'_>, map: &Map, rng: &mut Rng) -> Result<Map, Error> {
    let mut asker = asker(map, Motion::centers(FiniteK::N8))?;
    let mut cells = Vec::new();
    for _ in 0..DISTURBED {
        let Some(instance) = rng.pick(&case.terrain.instances) else { continue };
        let Some(path) = asker.path(instance.ends).1 else { continue };
        let ways: Vec<_> = path.vertices().collect();
        let Some(middle) = rng.pick(&ways) else { continue };
        for cell in (0..25).map(|cell| (middle.x + cell % 5 - 2, middle.y + cell / 5 - 2)) {
            let is_inside =
                (0..map.width() as i32).contains(&cell.0) && (0..map.height() as i32).contains(&cell.1);
            if is_inside && rng.chance(30) {
                cells.push((cell, !map.is_blocked(cell)));
            }
        }
    }
    map.edit_cells(cells)
}

fn same_index(
    case: Case<'_>,
    (repaired, anew): (&Index, &Index),
    same: Same,
    what: &str,
    tally: &mut Tally,
) -> Result<(), Error> {
    let motion = repaired.space().motion();
    if same == Same::Bytes {
        tally.count(CASES);
        let agree = repaired.to_bytes()? == anew.to_bytes()?;
        tally.expect(agree, || format!("{}, {motion}: {what}: other bytes than anew", case.of));
        return Ok(());
    }
    let mut askers = [repaired, anew].map(|index| Asker::of(index.planner()));
    for instance in &case.terrain.instances {
        let [(ours, path), (theirs, other)] = askers.each_mut().map(|asker| asker.path(instance.ends));
        let agree = ours.agrees(&theirs) && (same == Same::Costs || path == other);
        tally.count(CASES);
        tally.expect(agree, || {
            format!("{}: {what}: {ours} repaired, {theirs} anew", case.words(instance, motion))
        });
    }
    Ok(())
}

/// Where each cell costs 1, paths cost their length.
pub(super) fn unit_costs(case: Case<'_>, tally: &mut Tally) -> Result<(), Error> {
    let map = &case.terrain.map;
    let cells = (map.width() * map.height()) as usize;
    let costs = map.costs(std::iter::repeat_n(1.0, cells))?;
    for motion in [Motion::centers(3), Motion::new(4, CornerRule::One), Motion::new(5, DiagonalGap::Open)] {
        let mut uniform = asker(map, motion)?;
        let mut weighed = Asker::new(&costs.space(motion)?, Engine::AStar)?;
        for instance in &case.terrain.instances {
            let (own, (other, path)) = (uniform.cost(instance.ends), weighed.path(instance.ends));
            // The cost that the surface tells, beside the length of its path.
            let told = path.as_ref().map_or(own.cells(), Path::cost);
            let agree = own.agrees(&other) && (told - own.cells()).abs() <= own.cells() / f64::from(1 << 30);
            tally.count(CASES);
            tally.expect(agree || (!own.is_path() && own.agrees(&other)), || {
                format!("{}: {own}, on costs of 1 {other}, told {told}", case.words(instance, motion))
            });
        }
    }
    Ok(())
}

/// Several threads find the same paths as one.
pub(super) fn threads(case: Case<'_>, tally: &mut Tally) -> Result<(), Error> {
    let never = Motion::new(FiniteK::N8, CornerRule::Never);
    let several = [
        (Engine::JpsBlock, never),
        (Engine::Subgoal, never),
        (Engine::Anya, Motion::new(K::Any, DiagonalGap::Closed)),
    ];
    for (engine, motion) in several {
        let space: Space = case.terrain.map.space(motion)?;
        let index = space.prepare(engine)?;
        let queries: Vec<Query> = case
            .terrain
            .instances
            .iter()
            .map(|instance| Query::new(instance.ends.start, instance.ends.goal))
            .collect();
        let planners = Planners::new(index.clone());
        let together = on_threads(4, || planners.find_all(&queries));
        let mut alone = index.planner();
        for ((instance, query), answer) in case.terrain.instances.iter().zip(queries).zip(together) {
            let own = alone.find(query);
            let agree = match (&own, &answer) {
                (Ok(own), Ok(answer)) => own == answer,
                (own, answer) => own.is_err() && answer.is_err(),
            };
            tally.count(CASES);
            tally.expect(agree, || {
                format!("{}: {engine} alone {own:?}, on threads {answer:?}", case.words(instance, motion))
            });
        }
    }
    Ok(())
}
