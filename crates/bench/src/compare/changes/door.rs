//! Part 4: a door is the only way between the two halves of a large map.

use std::time::Instant;

use mediant::{Engine, Map, Motion, Setup};
use mediant_grid::Vertex;
use mediant_moves::K;
use mediant_report::{Row, stats::median};

use super::{
    Part,
    contestant::Follower,
    maps::{Kind, PITCH},
    text,
};
use crate::compare::CompareError;

const SIDE: u32 = 2_048;
const TIMES: usize = 40;

/// The rows of open ground, noise and rooms.
pub(super) fn measure() -> Result<Vec<Row>, CompareError> {
    let mut rows = Vec::new();
    for kind in [None, Some(Kind::Noise), Some(Kind::Rooms)] {
        let ground = kind.map(|kind| kind.map(SIDE)).transpose()?;
        // A wall of the rooms is there already.
        let (wall, door) = ((SIDE / 2) as i32, (SIDE / 2 + PITCH / 2) as i32);
        let map = Map::from_fn(SIDE, SIDE, |x, y| {
            let [x, y] = [x as i32, y as i32];
            let is_beside_door = (x - wall).abs() <= 1 && (y - door).abs() <= 1;
            let is_blocked = ground.as_ref().is_some_and(|ground| ground.is_blocked((x, y)));
            if x == wall { y != door } else { is_blocked && !is_beside_door }
        })?;
        let name = kind.map_or_else(|| format!("open-{SIDE}"), |kind| kind.name(SIDE));
        for (engine, motion) in [
            (Engine::Canonical, Motion::centers(K::N8)),
            (Engine::JpsBlock, Motion::centers(K::N8)),
            (Engine::Subgoal, Motion::centers(K::N8)),
            (Engine::Anya, Motion::corners(K::ANY)),
        ] {
            // Labels take more than a minute to make there.
            if engine == Engine::Subgoal && kind == Some(Kind::Noise) {
                continue;
            }
            rows.extend(of_engine(&name, &map, Setup::new(engine, motion), (wall, door).into())?);
        }
    }
    Ok(rows)
}

fn of_engine(name: &str, map: &Map, setup: Setup, door: Vertex) -> Result<[Row; 2], CompareError> {
    let mut follower = Follower::new(map, setup)?;
    let mut times = [Vec::new(), Vec::new()];
    for round in 0..=2 * TIMES {
        let opens = round % 2 == 1;
        let start = Instant::now();
        follower.set(door, !opens)?;
        let time = start.elapsed().as_secs_f64() * 1e6;
        // Both sides of the door know whether it is open.
        let ends = [(door.x - 1, door.y), (door.x + 2, door.y)];
        if follower.planner.path(ends[0], ends[1])?.is_some() != opens {
            let (engine, map) = (setup.to_string(), name.to_owned());
            return Err(CompareError::Lengths { engine, map, expected: 3.0, found: f64::NAN });
        }
        // The first one makes what others take turns in.
        if round > 0 {
            times[usize::from(opens)].push(time);
        }
    }
    let row = |opens: bool| {
        let times = &times[usize::from(opens)];
        Part::Door
            .row(name, map)
            .key("motion", text(setup.motion))
            .key("engine", setup.engine.kind())
            .key("size", if opens { "opens" } else { "closes" })
            .with("edit", median(times))
            .with("worst", times.iter().copied().reduce(f64::max))
    };
    Ok([row(true), row(false)])
}
