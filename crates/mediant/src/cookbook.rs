//! Whole programs for common jobs, to be copied and changed. All of them are compiled and run as tests, but
//! for those that read a file of yours.
//!
//! - Maps: [a file](#a-map-from-a-file), [doors](#doors-that-open-and-close),
//!   [two sizes of agents](#agents-of-two-sizes), [a robot's meters](#a-ros-map-in-meters).
//! - Paths: [step by step](#walk-a-path), [any angle](#any-angle),
//!   [as near as possible](#as-near-as-possible), [of several goals](#the-nearest-of-several-goals),
//!   [around others](#around-others-this-once), [still right](#does-the-path-still-hold).
//! - Many paths: [threads](#many-threads), [one goal for all](#one-goal-for-many-agents),
//!   [a table](#from-many-to-many), [a saved index](#save-an-index-and-load-it), [a server](#a-small-server).
//! - Time: [a budget a frame](#a-budget-a-frame), [a deadline](#a-deadline),
//!   [a search in steps](#a-search-in-steps), [what it does](#watch-a-search).
//! - Data: [to JSON and back](#to-json-and-back).
//!
//! # A map from a file
//!
//! The file is a `MovingAI` map, a picture in which dark pixels are blocked, or a ROS map.
//!
//! ```no_run
//! use mediant::{Error, Map};
//!
//! fn main() -> Result<(), Error> {
//!     let map = Map::open("depot.png")?;
//!     println!("{} × {} cells", map.width(), map.height());
//!     match map.path((2, 3), (map.width() - 1, 0))? {
//!         Some(path) => println!("{:.1} cells: {path}", path.cost()),
//!         None => println!("there is no way"),
//!     }
//!     Ok(())
//! }
//! ```
//!
//! # Walk a path
//!
//! Waypoints are where a path turns; `vertices` has every cell on which an agent stands between them.
//!
//! ```
//! use mediant::Map;
//!
//! let map: Map = "
//!     .....
//!     .###.
//!     .....
//! ".parse()?;
//! let path = map.path((0, 1), (4, 1))?.expect("there is a way");
//! for step in path.vertices() {
//!     println!("now at {step}");
//!     assert!(map.is_free(step));
//! }
//! for (waypoint, heading) in path.iter().zip(path.headings()) {
//!     println!("at {waypoint} turn to {:.0}°", heading.to_degrees());
//! }
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # Any angle
//!
//! Between the corners of cells paths go straight in every direction, and no legal path is shorter.
//!
//! ```
//! use mediant::{K, Map, Motion};
//!
//! let map = Map::from_fn(40, 30, |x, y| (10..20).contains(&x) && y > 4)?;
//! let eight = map.space(Motion::corners(3))?.path((0, 30), (40, 20))?.expect("there is a way");
//! let any = map.space(Motion::corners(K::ANY))?.path((0, 30), (40, 20))?.expect("there is a way");
//! println!("eight directions {:.2}, all {:.2}", eight.cost(), any.cost());
//! assert!(any.cost() < eight.cost() && any.len() == 4);
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # Many threads
//!
//! Threads share the index; [`Planners`](crate::Planners) lends each query a planner.
//!
//! ```
//! use std::thread;
//! use mediant::{Map, Motion, Planners};
//!
//! let space = Map::from_fn(64, 64, |x, y| x % 9 == 4 && y % 7 != 3)?.space(Motion::default())?;
//! let planners = Planners::new(space.prepare(space.engine())?);
//! thread::scope(|scope| {
//!     for row in 0..4 {
//!         let planners = &planners;
//!         scope.spawn(move || match planners.path((0, row), (60, 50)) {
//!             Ok(path) => println!("{:?}", path.map(|path| path.cost())),
//!             Err(error) => println!("{error}"),
//!         });
//!     }
//! });
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # A budget a frame
//!
//! A game spends a fixed number of expansions in each frame, and goes on with the search in the next one.
//!
//! ```
//! use mediant::{Engine, Map, Motion, Query};
//!
//! let space = Map::from_fn(64, 64, |x, y| x % 9 == 4 && y % 7 != 3)?.space(Motion::default())?;
//! let mut planner = space.planner(Engine::AStar)?;
//! planner.begin(Query::new((0, 0), (60, 50)))?;
//! let mut frame = 0;
//! let answer = loop {
//!     frame += 1;
//!     if let Some(answer) = planner.step(200)? {
//!         break answer;
//!     }
//!     // Here the rest of the frame is drawn.
//! };
//! println!("frame {frame}: {answer}");
//! # assert!(frame > 1 && answer.path().is_some());
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # A deadline
//!
//! The search stops in time; its answer has the best path so far, and how long the right one is at least.
//!
//! ```
//! use std::time::{Duration, Instant};
//! use mediant::{Answer, Engine, Limits, Map, Motion, Query};
//!
//! let space = Map::new(64, 64)?.space(Motion::default())?;
//! let mut planner = space.planner(Engine::AStar)?;
//! let end = Instant::now() + Duration::from_millis(5);
//! let limits = Limits::new().deadline(move || Instant::now() > end);
//! match planner.find(Query::new((0, 0), (60, 50)).within(limits))? {
//!     Answer::Found(path) => println!("in time: {path}"),
//!     Answer::Stopped(stopped) => println!("{stopped}: go on to {:?}", stopped.best.iter().last()),
//!     other => println!("{other}"),
//! }
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # A search in steps
//!
//! Between the steps it says how far it is: the best path so far, and a lower bound that grows.
//!
//! ```
//! use mediant::{Engine, Map, Motion};
//!
//! let space = Map::from_fn(64, 64, |x, y| x == 30 && y != 60)?.space(Motion::default())?;
//! let mut planner = space.planner(Engine::AStar)?;
//! planner.begin([(0, 0), (60, 0)])?;
//! while planner.step(500)?.is_none() {
//!     let (least, so_far) = (planner.lower_bound(), planner.best());
//!     let at = so_far.and_then(|path| path.iter().last().copied());
//!     println!("after {} expansions at {at:?}, at least {least:.2} cells", planner.expansions());
//! }
//! println!("{}", planner.finish()?);
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # Watch a search
//!
//! An observer is told each event: here it draws the cells that were expanded. With the feature `trace` there
//! is an observer that writes files for the Posthoc visualizer.
//!
//! ```
//! use mediant::{Engine, Map, Motion, Query, Vertex, search::{NodeEvent, Observer}};
//!
//! struct Seen(Vec<Vertex>);
//!
//! impl Observer for Seen {
//!     fn expanded(&mut self, node: NodeEvent) {
//!         self.0.push(node.at);
//!     }
//! }
//!
//! let space = Map::from_rows(["......", ".###..", "......"])?.space(Motion::default())?;
//! let (mut planner, mut seen) = (space.planner(Engine::AStar)?, Seen(Vec::new()));
//! planner.find_observed(Query::new((0, 1), (5, 1)), &mut seen)?;
//! for y in 0..space.map().height() {
//!     let drawn = |x| if seen.0.contains(&(x, y).into()) { 'o' } else { '.' };
//!     println!("{}", (0..space.map().width()).map(drawn).collect::<String>());
//! }
//! # assert!(!seen.0.is_empty());
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # Agents of two sizes
//!
//! Each size has a map of its own, on which its middle moves; all else is as for a point.
//!
//! ```
//! use mediant::{Map, Motion};
//!
//! let motion = Motion::default();
//! // A wall with a narrow gap in row 3, and a wide one below.
//! let map = Map::from_fn(20, 15, |x, y| x == 10 && y != 3 && y < 9)?;
//! for (name, radius) in [("the scout", 0.4), ("the tank", 1.5)] {
//!     let space = map.for_disc(radius, motion)?.space(motion)?;
//!     let path = space.path((3, 3), (17, 3))?.expect("there is a way");
//!     println!("{name}: {:.1} cells", path.cost());
//! }
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # Doors that open and close
//!
//! A map never changes: an edit makes the next one, and an index is repaired for it. Clusters (`hpa`) are
//! repaired around the door alone, and a planner follows with the memory that it has.
//!
//! ```
//! use mediant::{Engine, Map, Motion, Rectangle};
//!
//! let mut space = Map::from_fn(64, 64, |x, _| x == 30)?.space(Motion::default())?;
//! let mut index = space.prepare(Engine::Hpa)?;
//! let mut planner = index.planner();
//! let door = Rectangle::new(30, 20, 1, 2);
//! for is_closed in [false, true] {
//!     let change = space.edit(door, |_, _| is_closed)?;
//!     index = index.repair(&change)?;
//!     space = change.after().clone();
//!     planner.follow(&index)?;
//!     let path = planner.path((0, 0), (60, 50))?;
//!     println!("{:?}: {}", index.origin(), if path.is_some() { "a way" } else { "no way" });
//!     assert_eq!(path.is_none(), is_closed);
//! }
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # Around others, this once
//!
//! Cells that others stand on count as blocked for one query, and the cell that an agent blocks itself as
//! free.
//!
//! ```
//! use mediant::{Engine, Exceptions, Map, Motion, Query};
//!
//! let space = Map::from_rows(["@....", ".....", "....."])?.space(Motion::default())?;
//! let mut planner = space.planner(Engine::Subgoal)?;
//! let others = Exceptions::new().blocked([(2, 0), (2, 1)]).free_ends();
//! let answer = planner.find_except(Query::new((0, 0), (4, 0)), &others)?;
//! println!("{}", answer.answer);
//! # assert!(answer.answer.cost() > Some(4.0));
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # One goal for many agents
//!
//! A field has the distance of every cell to the goal; each agent follows its direction, without a search.
//!
//! ```
//! use mediant::{Map, Motion};
//!
//! let space = Map::from_fn(20, 10, |x, y| x == 10 && y > 1)?.space(Motion::default())?;
//! let field = space.field([(18, 8)])?;
//! let mut agents = [(1, 8), (4, 4), (15, 2)].map(mediant::Point::from);
//! for _frame in 0..5 {
//!     for agent in &mut agents {
//!         *agent = field.next(*agent).unwrap_or(*agent);
//!     }
//! }
//! println!("{agents:?}, {:?} cells to go", field.get(agents[0]));
//! println!("the flow there: {:?}", field.direction(agents[0]));
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # As near as possible
//!
//! Where there is no way to the goal, the path leads to the reachable cell that is nearest to it.
//!
//! ```
//! use mediant::{Answer, Engine, Map, Motion, Query};
//!
//! let space = Map::from_rows(["...#.", "...#.", "...#."])?.space(Motion::default())?;
//! let mut planner = space.planner(Engine::AStar)?;
//! match planner.find(Query::new((0, 0), (4, 2)).nearest())? {
//!     Answer::Found(path) => println!("there: {path}"),
//!     Answer::Nearest(path) => println!("as near as possible: {path}"),
//!     other => println!("{other}"),
//! }
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # The nearest of several goals
//!
//! Goals are prepared once, and any start finds the nearest by its path, not as the crow flies.
//!
//! ```
//! use mediant::{Engine, Map, Motion};
//!
//! let space = Map::from_fn(20, 10, |x, y| x == 10 && y > 1)?.space(Motion::default())?;
//! let index = space.prepare(Engine::Subgoal)?;
//! let exits = index.goals([(0, 9), (12, 9), (19, 0)])?;
//! let mut planner = index.planner();
//! if let Some((number, cells)) = planner.nearest((9, 9), &exits)? {
//!     println!("exit {number} at {}, {cells:.1} cells", exits.points()[number]);
//!     assert_eq!(number, 0);
//! }
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # From many to many
//!
//! A table has the length of each path from each start to each goal, for instance to hand out jobs.
//!
//! ```
//! use mediant::{Engine, Map, Motion};
//!
//! let space = Map::from_fn(20, 10, |x, y| x == 10 && y > 1)?.space(Motion::default())?;
//! let (robots, shelves) = ([(0, 0), (19, 9)], [(9, 9), (11, 9), (5, 5)]);
//! let table = space.prepare(Engine::Subgoal)?.table(robots, shelves)?;
//! for (robot, at) in robots.iter().enumerate() {
//!     let nearest = (0..shelves.len()).min_by(|&a, &b| table.row(robot)[a].total_cmp(&table.row(robot)[b]));
//!     println!("robot at {at:?} to shelf {nearest:?}");
//! }
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # Does the path still hold?
//!
//! After an edit a path is checked before anything is searched again; the error says how far it holds.
//!
//! ```
//! use mediant::{Map, Motion};
//!
//! let before = Map::new(9, 3)?;
//! let path = before.path((0, 1), (8, 1))?.expect("there is a way");
//! let after = before.set((5, 1), true)?.space(Motion::default())?;
//! match after.check(&path) {
//!     Ok(()) => println!("go on"),
//!     Err(broken) => {
//!         println!("{broken}; it can be followed to waypoint {}", broken.holds_up_to());
//!         println!("instead: {:?}", after.path(path[0], (8, 1))?.map(|path| path.to_string()));
//!     }
//! }
//! # assert!(after.check(&path).is_err());
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # A ROS map, in meters
//!
//! A robot asks in meters and drives in meters; the frame of its map leads from them to cells and back.
//!
//! ```no_run
//! use mediant::{Map, Motion, PlacementKind, files::MapOptions};
//!
//! let (map, frame) = Map::open_with("depot.yaml", &MapOptions::default())?;
//! let frame = frame.expect("a ROS map has a place in the world");
//! let motion = Motion::default();
//! let space = map.for_disc(0.30 / frame.resolution(), motion)?.space(motion)?;
//! if let (Some(start), Some(goal)) = (frame.cell_at(1.5, -2.0), frame.cell_at(12.0, 4.25)) {
//!     for waypoint in space.path(start, goal)?.into_iter().flatten() {
//!         let (x, y) = frame.point_of(PlacementKind::Center, waypoint);
//!         println!("{x:.2} m, {y:.2} m");
//!     }
//! }
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # Save an index, and load it
//!
//! An index that took long to prepare is saved in a file. The file knows its map, its rules and its k: with
//! another one it is refused.
//!
//! ```
//! use mediant::{Engine, ErrorCode, K, Map, Motion};
//!
//! let map = Map::from_fn(64, 64, |x, y| x % 9 == 4 && y % 7 != 3)?;
//! let file = std::env::temp_dir().join(format!("cookbook-{}.idx", std::process::id()));
//! map.space(Motion::corners(K::ANY))?.prepare(Engine::Subgoal)?.save(&file)?;
//!
//! let mut planner = map.load(&file)?.planner();
//! println!("{:?}", planner.path((0, 0), (60, 50))?.map(|path| path.cost()));
//! let refused = map.set((0, 0), true)?.load(&file).unwrap_err();
//! assert_eq!(refused.code(), ErrorCode::Mismatch);
//! # std::fs::remove_file(file).unwrap();
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # A small server
//!
//! Requests come in, answers go out; what went wrong is told by the error's code, which stays the same from
//! version to version.
//!
//! ```
//! use mediant::{Error, ErrorCode, Map, Motion, Planners};
//!
//! /// Answers a line such as `0 0 7 2`.
//! fn answer(planners: &Planners, line: &str) -> String {
//!     let numbers: Vec<i64> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
//!     let [x, y, to_x, to_y] = numbers[..] else { return "form: give four whole numbers".to_owned() };
//!     match planners.path((x, y), (to_x, to_y)).map_err(Error::from) {
//!         Ok(Some(path)) => format!("path: {path}"),
//!         Ok(None) => "path: none".to_owned(),
//!         Err(error) => match error.code() {
//!             ErrorCode::StartOutside | ErrorCode::GoalOutside => format!("outside: {error}"),
//!             code => format!("{code}: {error}"),
//!         },
//!     }
//! }
//!
//! let space = Map::from_rows([".#.", "..."])?.space(Motion::default())?;
//! let planners = Planners::new(space.prepare(space.engine())?);
//! for line in ["0 0 2 0", "0 0 1 0", "0 0 9 9", "hello"] {
//!     println!("{}", answer(&planners, line));
//! }
//! # assert!(answer(&planners, "0 0 1 0").starts_with("goal-blocked: "));
//! # assert!(answer(&planners, "0 0 2 0").starts_with("path: (0, 0)"));
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # To JSON and back
//!
//! With the feature `serde` what is asked and answered goes into files and over the net.
//!
#![cfg_attr(feature = "serde", doc = "```")]
#![cfg_attr(not(feature = "serde"), doc = "```ignore")]
//! use mediant::{Ends, Map, Motion, Path, Setup};
//!
//! let query: Ends = serde_json::from_str(r#"{ "start": [0, 0], "goal": [2, 0] }"#)?;
//! let setup: Setup = serde_json::from_str(r#""subgoal:3:never""#)?;
//! let map = Map::from_rows([".#.", "..."])?;
//! let path = setup.planner(&map)?.path(query.start, query.goal)?.expect("there is a way");
//! let text = serde_json::to_string(&path)?;
//! assert_eq!(text, "[[0,0],[0,1],[2,1],[2,0]]");
//! assert_eq!(serde_json::from_str::<Path>(&text)?, path);
//! println!("{}", serde_json::to_string(&Motion::default())?);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
