//! Edits of costs, and what follows them.

use mediant::{
    Answer, Change, Costs, Engine, Error, ErrorCode, Map, Motion, PlacementKind, Replanned, Vertex,
};
use mediant_oracle::{Rng, random_free_vertex, random_vertex, seeds};

use super::{World, plain_space, space};

/// Random edits: costs within the bounds and beyond, walls, and cells that are freed.
pub(super) fn random_edit(world: &Costs, rng: &mut Rng) -> Vec<(Vertex, Option<f64>)> {
    let (least, greatest) = world.bounds();
    (0..1 + rng.below(6))
        .map(|_| {
            let costs = [None, None, Some(least), Some(greatest), Some(greatest), Some(greatest + 1.0)];
            let cost = costs[rng.below(6) as usize].filter(|&cost| cost < 4e9);
            (random_vertex(rng, world.map().grid(), PlacementKind::Center), cost)
        })
        .collect()
}

#[test]
fn what_was_prepared_follows_edits_of_costs() {
    let mut searched = 0;
    for seed in seeds(60) {
        let world = World::new(seed);
        let motion = world.space.motion();
        let mut rng = Rng::new(seed);
        let (mut costs, mut space) = (world.costs.clone(), world.space.clone());
        let mut planners = world.all_planners();
        let sources = world.free(&mut rng, 2);
        let mut field = world.space.field(sources.clone()).expect("the sources are free");
        for edit in 0..5 {
            let about = format!("edit {edit}: {}", world.about);
            let cells = random_edit(&costs, &mut rng);
            let Ok(next) = costs.edit_cells(cells.iter().copied()) else { continue };
            let change = if rng.chance(50) {
                space.edit_costs(cells.iter().copied()).expect("these costs can be")
            } else {
                Change::between(&space, &next.space(motion).expect("the same k")).expect("the same motion")
            };
            let after = change.after().clone();
            assert_eq!(after.identity(), next.space(motion).expect("the same k").identity(), "{about}");
            assert_eq!((after.costs(), after.map()), (Some(&next), next.map()), "{about}");
            for &(cell, cost) in &cells {
                let changed = costs.cost(cell) != next.cost(cell);
                let (x, y) = (cell.x as u32, cell.y as u32);
                let is_in = change
                    .cells()
                    .iter()
                    .any(|at| (at.x..at.x + at.width).contains(&x) && (at.y..at.y + at.height).contains(&y));
                assert!(is_in || !changed, "{cell} {cost:?}: {about}");
                assert_eq!(next.map().is_free(cell), next.cost(cell).is_some(), "{about}");
            }
            for planner in &mut planners {
                let before = planner.index().clone();
                let index = before.repair(&change).expect("a change of its space");
                planner.follow(&index).expect("the same engine");
                let kind = index.setup().engine.kind();
                let mut new = after.planner(kind).expect("it knows costs");
                for _ in 0..3 {
                    let at =
                        |rng: &mut Rng| random_free_vertex(rng, next.map().grid(), motion.rules.placement());
                    let (Some(start), Some(goal)) = (at(&mut rng), at(&mut rng)) else { continue };
                    let [one, other] = [&mut *planner, &mut new]
                        .map(|planner| planner.find_counted((start, goal)).expect("both are free"));
                    match kind {
                        Engine::Landmarks => assert_eq!(one.0.cost(), other.0.cost(), "{about}"),
                        _ => assert_eq!(one, other, "{start} → {goal}: {about}"),
                    }
                    searched += usize::from(one.0.path().is_some());
                }
            }
            let anew = after.field(sources.clone());
            match field.repair(&change) {
                Ok(repaired) => {
                    let anew = anew.expect("the same sources");
                    assert_eq!(repaired.lengths(), anew.lengths(), "{about}");
                    assert_eq!(repaired.allocation(), anew.allocation(), "{about}");
                    assert!(anew.iter().all(|(at, _)| repaired.next(at) == anew.next(at)), "{about}");
                    field = repaired;
                }
                Err(error) => {
                    assert_eq!(error.code(), anew.expect_err("it is blocked").code(), "{about}");
                    break;
                }
            }
            (costs, space) = (next, after);
        }
    }
    assert!(searched > 300, "only {searched}");
}

#[test]
fn cells_are_blocked_but_not_freed_without_a_cost() {
    let space = space();
    let blocked = space.edit_cells([((2, 0), true), ((3, 0), false)]).expect("none is freed");
    assert!(blocked.after().map().is_blocked((2, 0)));
    assert_eq!(blocked.after().costs().and_then(|costs| costs.cost((2, 0))), None);
    assert_eq!(blocked.cells().len(), 1);
    let freed = space.edit_cells([((1, 1), false)]).expect_err("it has no cost");
    assert!(matches!(freed, Error::Freed { cell } if cell == (1, 1).into()), "{freed}");
    assert!(freed.code() == ErrorCode::Cost && freed.to_string().contains("edit_costs"), "{freed}");
    let whole = mediant::Rectangle::new(0, 0, 9, 9);
    assert!(space.edit(whole, |_, _| false).is_err());
    let walls = space.edit(whole, |x, _| x == 1).expect("none is freed");
    assert!(walls.after().map().is_blocked((1, 2)) && walls.cells().len() == 2, "{:?}", walls.cells());
    // The last word counts.
    let kept = space.edit_cells([((1, 1), false), ((1, 1), true), ((0, 0), true), ((0, 0), false)]);
    assert_eq!(kept.expect("none is freed").after().identity(), space.identity());
    let opened = space.edit_costs([((1, 1), Some(2.0))]).expect("a cost").edit_cells([((1, 1), false)]);
    assert_eq!(opened.expect("it is free").after().costs().and_then(|costs| costs.cost((1, 1))), Some(2.0));
    assert_eq!(plain_space().edit_costs([((0, 0), Some(2.0))]).unwrap_err().code(), ErrorCode::Cost);
}

#[test]
fn changes_between_costs_and_none() {
    let (plain, space) = (plain_space(), space());
    let index = space.prepare(Engine::AStar).expect("it knows costs");
    let change = Change::between(&space, &plain).expect("the same motion");
    let lengths = index.repair(&change).expect("A* prepares it anew");
    assert_eq!(lengths.planner().distance([(0, 0), (3, 0)]), Ok(Some(3.0)));
    assert_eq!(Change::to(&space, plain.map()).after().identity(), plain.identity());
    let field = space.field([(0, 0)]).expect("it is free");
    assert_eq!(field.repair(&change).unwrap_err().code(), ErrorCode::Mismatch);
    let back = Change::between(&plain, &space).expect("the same motion");
    let index = lengths.repair(&back).expect("A* prepares it anew");
    let mut planner = lengths.planner();
    planner.follow(&index).expect("the same engine");
    assert_eq!(
        planner.distance([(0, 0), (3, 0)]),
        space.planner(Engine::AStar).unwrap().distance([(0, 0), (3, 0)])
    );
    let jps = plain.prepare(Engine::JpsBlock).expect("k = 3");
    assert_eq!(jps.repair(&back).unwrap_err().code(), ErrorCode::EngineWithout);
    let field = plain.field([(0, 0)]).expect("it is free");
    assert_eq!(field.repair(&back).unwrap_err().code(), ErrorCode::Mismatch);
    let further = change.edit_cells([((0, 0), true)]).expect("a cell of the map");
    assert!(index.repair(&further).is_ok());
    assert_eq!(jps.repair(&Change::new(&space)).unwrap_err().code(), ErrorCode::Mismatch);
}

#[test]
fn paths_are_replanned_and_mended_by_their_costs() {
    let map = Map::new(9, 5).expect("a map");
    let space = map.costs([1.0; 45]).expect("costs").space(Motion::default()).expect("k = 3");
    let path = space.path((0, 2), (8, 2)).expect("free").expect("there is a way");
    assert_eq!((path.cost(), path.length()), (8.0, 8.0));
    // Far from the path.
    let far = space.edit_costs([((8, 0), Some(3.0))]).expect("a cost");
    let mut planner = far.after().planner(Engine::AStar).expect("it knows costs");
    assert_eq!(planner.replan(&path, &far).expect("of its space"), Replanned::Kept);
    // On it: it holds, and is no longer the cheapest.
    let swamp = space.edit_costs([((4, 2), Some(30.0)), ((4, 1), Some(30.0))]).expect("a cost");
    let mut planner = swamp.after().planner(Engine::AStar).expect("it knows costs");
    let Replanned::Replaced(new) = planner.replan(&path, &swamp).expect("of its space") else {
        panic!("kept")
    };
    assert!(new.cost() < 10.0 && swamp.after().cost(&path) == Some(37.0));
    let Answer::Found(held) = planner.mend(&path).expect("free") else { panic!("it holds") };
    assert_eq!((held.waypoints(), held.cost()), (path.waypoints(), 37.0));
    let wall = space.edit_costs([((4, 2), None), ((0, 2), Some(2.0))]).expect("a wall");
    let mut planner = wall.after().planner(Engine::AStar).expect("it knows costs");
    let Answer::Found(mended) = planner.mend(&path).expect("free") else { panic!("there is a way") };
    let cost = wall.after().cost(&mended).expect("it is legal");
    assert!((mended.cost() - cost).abs() < 1e-9 && mended.length() < cost, "{mended}");
    assert_eq!(wall.least_by_freed(&path), 0.0);
}
