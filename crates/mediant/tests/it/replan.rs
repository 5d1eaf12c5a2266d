//! Paths that live while the map changes, against new searches.

use std::sync::Arc;

use mediant::{
    Answer, Change, CornerRule, DiagonalGap, Engine, Error, K, Map, Motion, Planner, Replanned, Rules,
};
use mediant_oracle::{Rng, on_all_cores, random_change, random_free_vertex, random_grid, seeds};

/// Motions with an engine whose paths are shortest.
fn motions() -> [(Motion, Engine); 6] {
    [
        (Motion::centers(K::N8), Engine::JpsBlock),
        (Motion::new(K::N4, Rules::Center(CornerRule::Always)), Engine::AStar),
        (Motion::new(K::N16, Rules::Center(CornerRule::One)), Engine::Canonical),
        (Motion::corners(K::ANY), Engine::Anya),
        (Motion::new(K::ANY, Rules::Corner(DiagonalGap::Closed)), Engine::Anya),
        (Motion::new(K::N8, Rules::Corner(DiagonalGap::Closed)), Engine::Subgoal),
    ]
}

/// A change of a random map, and a path that was shortest before it.
fn case(seed: u64, motion: Motion, engine: Engine) -> Option<(Change, mediant::Path, Planner)> {
    let mut rng = Rng::new(seed);
    let map = Map::from(random_grid(seed).0);
    let kind = motion.rules.placement();
    let ends = [(); 2].map(|()| random_free_vertex(&mut rng, map.grid(), kind));
    let space = map.space(motion).expect("a motion that is searched");
    let path = space.planner(engine).expect("it takes the motion").path(ends[0]?, ends[1]?).ok()??;
    let change = random_change(&mut rng, map.grid());
    let after = Map::from(Arc::clone(change.after())).space(motion).expect("a motion that is searched");
    let change = Change::between(&space, &after).expect("one motion");
    let planner = change.after().planner(engine).expect("it takes the motion");
    Some((change, path, planner))
}

#[test]
fn a_path_is_kept_while_it_is_a_shortest_one() {
    let told = on_all_cores(seeds(120), |seed| {
        let mut told = [0; 4];
        for (motion, engine) in motions() {
            let Some((change, path, mut planner)) = case(seed, motion, engine) else { continue };
            let message = format!("seed {seed}, {motion:?}, {:?}: {path}", change.cells());
            let (start, goal) = (path[0], path[path.len() - 1]);
            let new = planner.path(start, goal);
            let replanned = match planner.replan(&path, &change) {
                Ok(replanned) => replanned,
                Err(Error::Query(error)) => {
                    assert_eq!(new, Err(error), "{message}");
                    told[0] += 1;
                    continue;
                }
                Err(error) => panic!("{message}: {error}"),
            };
            let cost = new.expect("no error").map(|path| path.cost());
            let close = |one: f64| cost.is_some_and(|cost| (one - cost).abs() < 1e-6);
            match replanned {
                Replanned::Kept => {
                    assert_eq!(change.after().check(&path), Ok(()), "{message}");
                    assert!(close(path.cost()), "{message}: {cost:?}");
                    told[1] += 1;
                }
                Replanned::Replaced(new) => {
                    assert_eq!(change.after().check(&new), Ok(()), "{message}");
                    assert!(close(new.cost()), "{message}: {cost:?}, {new}");
                    let is_shorter = new.cost() < path.cost();
                    assert!(is_shorter || change.after().check(&path).is_err(), "{message}: {new}");
                    told[2] += 1;
                }
                Replanned::Unreachable => {
                    assert_eq!(cost, None, "{message}");
                    told[3] += 1;
                }
            }
        }
        told
    });
    let told = told.into_iter().fold([0; 4], |all, one| std::array::from_fn(|i| all[i] + one[i]));
    assert!(told.iter().all(|&count| count > 5), "{told:?}");
}

#[test]
fn a_mended_path_holds_wherever_there_is_one() {
    on_all_cores(seeds(120), |seed| {
        for (motion, engine) in motions() {
            let Some((change, path, mut planner)) = case(seed, motion, engine) else { continue };
            let message = format!("seed {seed}, {motion:?}, {:?}: {path}", change.cells());
            let (start, goal) = (path[0], path[path.len() - 1]);
            match (planner.path(start, goal), planner.mend(&path)) {
                (Ok(Some(_)), Ok(Answer::Found(mended))) => {
                    assert_eq!(change.after().check(&mended), Ok(()), "{message}: {mended}");
                    assert_eq!((mended[0], mended[mended.len() - 1]), (start, goal), "{message}: {mended}");
                }
                (Ok(None), Ok(Answer::Unreachable)) => {}
                (Err(new), Err(mended)) => assert_eq!(new, mended, "{message}"),
                (new, mended) => panic!("{message}: {new:?}, {mended:?}"),
            }
        }
    });
}

#[test]
fn a_planner_of_another_space_does_not_replan() {
    let space = Map::new(5, 5).expect("a map").space(Motion::default()).expect("it is searched");
    let path = space.path((0, 0), (4, 4)).expect("free ends").expect("a way");
    let change = space.edit_cells([((2, 2), true)]).expect("on the map");
    let mut planner = space.planner(Engine::AStar).expect("it takes the motion");
    assert!(matches!(planner.replan(&path, &change), Err(Error::Mismatch(_))));
}
