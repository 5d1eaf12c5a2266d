//! The spaces and planners that costs keep, over edits.

use std::sync::Arc;

use mediant::{
    Ends, Engine, Error, ErrorCode, Ground, Limits, Map, Motion, Query, Rectangle,
    call::{Call, Group, Parameter, Spelling, Value},
};
use mediant_oracle::{Rng, random_free_vertex, seeds};

use super::{World, costs, edits::random_edit};

fn call(named: &[(&str, Value<'_>)]) -> Call {
    let mut call = Call::default();
    for &(name, ref value) in named {
        let parameter = Parameter::find(name, Spelling::Snake, &Group::ALL).expect("a parameter");
        call.set(parameter, value.clone()).expect("a value of it");
    }
    call
}

#[test]
fn kept_planners_of_costs_follow_edits() {
    let mut searched = 0;
    for seed in seeds(40) {
        let world = World::new(seed);
        let motion = world.space.motion();
        let mut rng = Rng::new(seed);
        let mut ground = Ground::from(world.costs.clone());
        let asked = Call::default().with_engine(Some(Engine::AStar));
        let setup = mediant::Setup { motion, ..ground.setup(&asked).expect("A* knows costs") };
        for edit in 0..6 {
            let about = format!("edit {edit}: {}", world.about);
            // Some versions are never asked.
            if rng.chance(70) {
                let planners = ground.keep_planners(&setup, Limits::new()).expect("a small k");
                let space = ground.keep_space(motion, Limits::new()).expect("a small k");
                assert!(ground.kept_space(motion).is_some() && ground.kept_planners(&setup).is_some());
                let costs = ground.costs().expect("costs");
                let anew = costs.space(motion).expect("a small k");
                assert_eq!(space.identity(), anew.identity(), "{about}");
                let mut planner = anew.planner(Engine::AStar).expect("A* knows costs");
                let grid = costs.map().grid();
                let mut at = || random_free_vertex(&mut rng, grid, motion.rules.placement());
                for _ in 0..3 {
                    let (Some(start), Some(goal)) = (at(), at()) else { continue };
                    let query = Query::from(Ends::new(start, goal));
                    let (one, other) = (planners.find(query.clone()), planner.find(query));
                    assert_eq!(one, other, "{start} → {goal}: {about}");
                    searched += usize::from(one.is_ok_and(|answer| answer.path().is_some()));
                }
            }
            let Ground::Costs(costs) = &ground else { unreachable!("costs stay costs") };
            ground = match costs.edit_cells(random_edit(costs, &mut rng)) {
                Ok(next) => next.into(),
                Err(_) => ground,
            };
        }
    }
    assert!(searched > 200, "only {searched}");
}

#[test]
fn costs_that_keep_spaces_give_their_memory_back() {
    let first = costs();
    let setup = first.setup(&call(&[])).expect("k = 3");
    let second = {
        first.keep_planners(&setup, Limits::new()).expect("k = 3");
        first.edit_cells([((2, 2), Some(3.0))]).expect("on the map")
    };
    second.keep_planners(&setup, Limits::new()).expect("k = 3");
    let surfaces = [&first, &second].map(|costs| Arc::downgrade(costs.surface()));
    drop(first);
    assert!(surfaces[1].upgrade().is_some());
    drop(second);
    assert!(surfaces.iter().all(|surface| surface.upgrade().is_none()));
}

#[test]
fn a_ground_is_a_map_or_costs() {
    let (costs, map) = (costs(), costs().map().clone());
    let grounds = [Ground::from(map.clone()), Ground::from(costs.clone())];
    for ground in &grounds {
        assert_eq!(ground.map(), &map);
        let walled = ground.edit(Rectangle::new(0, 0, 1, 2), |_, _| true).expect("on the map");
        assert!(walled.map().is_blocked((0, 1)) && walled.costs().is_some() == ground.costs().is_some());
        assert_eq!(&ground.edit_cells([((0, 0), false)]).expect("it is free"), ground);
        assert!(ground.edit(Rectangle::new(9, 0, 1, 1), |_, _| true).is_err());
        assert!(ground.edit_cells([((0, 9), true)]).is_err());
        assert!(ground.load("no such file", Limits::new()).is_err());
        assert!(ground.index_from_bytes(vec![1, 2, 3], Limits::new()).is_err());
    }
    assert_ne!(grounds[0], grounds[1]);
    assert!(grounds[0].edit_cells([((1, 1), false)]).is_ok());
    let freed = grounds[1].edit_cells([((1, 1), false)]).expect_err("it has no cost");
    assert_eq!(freed.code(), ErrorCode::Cost);
    // Paths of the costs' map are its own.
    let motion = Motion::default();
    let space = costs.keep_space(motion, Limits::new()).expect("k = 3");
    assert!(space.costs().is_some() && costs.map().kept_space(motion).is_none());
    assert_eq!(costs.map().path((0, 0), (2, 0)).expect("free").map(|path| path.cost()), Some(2.0));
    assert!(map.kept_space(motion).is_none());
}

#[test]
fn setups_on_costs_are_those_of_the_call() {
    let costs = costs();
    let setup = costs.setup(&call(&[("k", Value::Integer(4))])).expect("k = 4");
    assert_eq!((setup.engine.kind(), setup.motion), (Engine::AStar, Motion::centers(4)));
    assert!(costs.keep_planners(&setup, Limits::new()).is_ok());
    for (engine, k) in [(Engine::Jps, 3), (Engine::AStar, 9)] {
        let call = call(&[("k", Value::Integer(k))]).with_engine(Some(engine));
        let setup = costs.setup(&call).expect("it is a setup");
        assert!(matches!(costs.keep_planners(&setup, Limits::new()), Err(Error::Setup(_))));
    }
    let map = Map::new(3, 3).expect("a map");
    assert_eq!(map.setup(&Call::default()).map(|setup| setup.engine.kind()), Ok(Engine::Canonical));
}
