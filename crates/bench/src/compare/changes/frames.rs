//! Part 3: a game loop. Doors open and close, a door a frame, and agents walk.

use std::time::Instant;

use mediant::{Change, Engine, Map, Motion, Path, Replanned, Setup};
use mediant_grid::Vertex;
use mediant_moves::K;
use mediant_oracle::Rng;
use mediant_report::{
    Row,
    stats::{mean, median},
};
use mediant_search::Ends;

use super::{
    Part,
    contestant::Follower,
    maps::{Kind, PITCH},
    text,
    timelines::connected_ends,
};
use crate::{Baseline, baseline::BoolMap, compare::CompareError};

const SIDE: u32 = 512;
const AGENTS: usize = 100;
const FRAMES: usize = 300;

/// The way of a loop to its paths after a door has changed.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    /// Everything follows the change.
    Follow,
    /// Space, index and planner are made anew each frame.
    Anew,
    /// `pathfinding::astar` over an array of `bool`.
    Other,
}

/// The rows of all ways.
pub(super) fn measure() -> Result<Vec<Row>, CompareError> {
    let map = Kind::Rooms.map(SIDE)?;
    let (centers, corners) = (Motion::centers(K::N8), Motion::corners(K::ANY));
    let mut rows = Vec::new();
    for (engine, motion, way) in [
        (Engine::JpsBlock, centers, Way::Follow),
        (Engine::JpsBlock, centers, Way::Anew),
        (Engine::Canonical, centers, Way::Follow),
        (Engine::Canonical, centers, Way::Anew),
        (Engine::Subgoal, centers, Way::Follow),
        (Engine::Canonical, centers, Way::Other),
        (Engine::Anya, corners, Way::Follow),
        (Engine::Anya, corners, Way::Anew),
        (Engine::Subgoal, corners, Way::Follow),
    ] {
        let frames = frames(&map, Setup::new(engine, motion), way)?;
        let of = |time: fn(&Frame) -> f64| frames.iter().map(time).collect::<Vec<_>>();
        let whole = of(|frame| frame.edit + frame.paths);
        let (engine, way) = match way {
            Way::Follow => (engine.to_string(), "follows"),
            Way::Anew => (engine.to_string(), "anew"),
            Way::Other => (Baseline::Pathfinding.name().to_owned(), "follows"),
        };
        let row = Part::Frames.row(&Kind::Rooms.name(SIDE), &map).key("motion", text(motion));
        rows.push(
            row.key("engine", engine)
                .key("way", way)
                .with("edit", mean(&of(|frame| frame.edit)))
                .with("query", mean(&of(|frame| frame.paths)))
                .with("frame", mean(&whole))
                .with("median", median(&whole))
                .with("worst", whole.iter().copied().reduce(f64::max))
                .with("asked", mean(&of(|frame| frame.asked))),
        );
    }
    Ok(rows)
}

/// The microseconds of a frame, and the agents that needed a path.
struct Frame {
    edit: f64,
    paths: f64,
    asked: f64,
}

/// The cells of doors: free ones in the line of a wall.
fn doors(map: &Map) -> Vec<Vertex> {
    let cells = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
    let is_door = |&(x, y): &(u32, u32)| {
        x.is_multiple_of(PITCH) != y.is_multiple_of(PITCH) && map.is_free((x as i32, y as i32))
    };
    cells.filter(is_door).map(|(x, y)| (x as i32, y as i32).into()).collect()
}

/// An agent: the rest of its way, and how far it is to the next vertex of that.
struct Agent {
    path: Path,
    left: f64,
}

impl Agent {
    fn new(path: Path) -> Self {
        let mut agent = Self { path, left: 0.0 };
        agent.left = agent.step().map_or(0.0, |(_, length)| length);
        agent
    }

    /// The next vertex, and how far it is.
    fn step(&self) -> Option<(Vertex, f64)> {
        let ends: Vec<Vertex> = self.path.vertices().take(2).collect();
        let [from, to] = <[Vertex; 2]>::try_from(ends).ok()?;
        Some((to, Path::new(vec![from, to]).cost()))
    }

    fn at(&self) -> Option<Vertex> {
        self.path.waypoints().first().copied()
    }

    /// Walks a cell far. Whether it is on its way still.
    fn walk(&mut self) -> bool {
        self.left -= 1.0;
        while self.left <= 0.0 {
            let Some(rest) = self.step().and_then(|(to, _)| self.path.rest(to)) else { return false };
            let Self { path, left } = Self::new(rest);
            (self.path, self.left) = (path, self.left + left);
            if left == 0.0 {
                return false;
            }
        }
        true
    }
}

/// Whether a change asks for a new search: the rule of [`Planner::replan`](mediant::Planner::replan).
fn is_concerned(path: &Path, change: &Change) -> bool {
    change.check(path).is_err() || path.cost() > change.least_by_freed(path)
}

/// The loop of one way.
struct Loop {
    follower: Follower,
    other: BoolMap,
    setup: Setup,
    way: Way,
}

impl Loop {
    /// The map follows a door. Returns the change, and the time that it took.
    fn set(&mut self, door: Vertex) -> Result<(Change, f64), CompareError> {
        let blocked = self.follower.space.map().is_free(door);
        let edit = || self.follower.space.edit_cells([(door, blocked)]);
        if self.way == Way::Follow {
            let start = Instant::now();
            let change = edit()?;
            self.follower.follow(&change)?;
            return Ok((change, micros(start)));
        }
        let change = edit()?;
        let _ = change.after();
        let start = Instant::now();
        if self.way == Way::Anew {
            let map = self.follower.space.map().edit_cells([(door, blocked)])?;
            self.follower = Follower::new(&map, self.setup)?;
            return Ok((change, micros(start)));
        }
        self.other.set(door, blocked);
        let time = micros(start);
        self.follower.follow(&change)?;
        Ok((change, time))
    }

    fn path(&mut self, ends: Ends) -> Result<Option<Path>, CompareError> {
        if self.way != Way::Other {
            return Ok(self.follower.planner.path(ends.start, ends.goal)?);
        }
        let cells = self.other.solve(ends).map(|(cells, _)| cells);
        let vertices =
            cells.map(|cells| cells.into_iter().map(|(x, y)| (i32::from(x), i32::from(y)).into()).collect());
        Ok(vertices.map(Path::new))
    }

    fn replan(&mut self, path: &Path, change: &Change) -> Result<Replanned, CompareError> {
        if self.way != Way::Other {
            return Ok(self.follower.planner.replan(path, change)?);
        }
        if !is_concerned(path, change) {
            return Ok(Replanned::Kept);
        }
        let (first, last) = (path.waypoints()[0], path.waypoints()[path.len() - 1]);
        Ok(self.path(Ends::new(first, last))?.map_or(Replanned::Unreachable, Replanned::Replaced))
    }
}

fn micros(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e6
}

fn frames(map: &Map, setup: Setup, way: Way) -> Result<Vec<Frame>, CompareError> {
    let (follower, other) = (Follower::new(map, setup)?, BoolMap::new(map.grid()));
    let mut game = Loop { follower, other, setup, way };
    let (mut rng, doors) = (Rng::new(super::SEED), doors(map));
    let mut agents: Vec<Agent> = Vec::new();
    for _ in 0..AGENTS {
        let ends = connected_ends(&game.follower.space, &mut rng);
        agents.extend(game.path(ends)?.map(Agent::new));
    }
    let mut frames = Vec::new();
    for _ in 0..FRAMES {
        let door = loop {
            let door = doors[rng.below(doors.len() as u32) as usize];
            let is_end = |agent: &Agent| {
                [agent.path.waypoints().first(), agent.path.waypoints().last()].contains(&Some(&door))
            };
            if !agents.iter().any(is_end) {
                break door;
            }
        };
        let (change, edit) = game.set(door)?;
        let mut frame = Frame { edit, paths: 0.0, asked: 0.0 };
        for agent in &mut agents {
            frame.asked += f64::from(u8::from(is_concerned(&agent.path, &change)));
            let start = Instant::now();
            let replanned = game.replan(&agent.path, &change)?;
            frame.paths += micros(start);
            match replanned {
                Replanned::Kept => {}
                Replanned::Replaced(path) => *agent = Agent::new(path),
                Replanned::Unreachable => *agent = Agent::new(Path::new(agent.at().into_iter().collect())),
            }
        }
        for agent in &mut agents {
            // One that has arrived, or cannot, wants to go elsewhere.
            if agent.walk() {
                continue;
            }
            let Some(at) = agent.at() else { continue };
            let goal = loop {
                let goal = connected_ends(&game.follower.space, &mut rng).goal;
                if at != goal && game.follower.space.connected(at, goal) {
                    break goal;
                }
            };
            let start = Instant::now();
            let path = game.path(Ends::new(at, goal))?;
            frame.paths += micros(start);
            frame.asked += 1.0;
            *agent = Agent::new(path.unwrap_or_else(|| Path::new(vec![at])));
        }
        frames.push(frame);
    }
    Ok(frames)
}
