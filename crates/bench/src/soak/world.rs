//! The maps of a soak, with all engines prepared on them.

use std::{
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

use mediant::{
    Change, CornerRule, DiagonalGap, Engine, Error, Guarantee, Index, K, Map, Motion, PlacementKind, Planner,
    Planners, Rectangle, Rules, Space, Vertex,
};
use mediant_formats::MapFile;
use mediant_grid::Grid;
use mediant_oracle::{Rng, adversarial, caves, maze, noise, rooms};

use super::{SoakError, kind::Kind, timer::Timer};

/// The relation of an engine's paths to those of the reference, by length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Relation {
    /// They are equal.
    Equal,
    /// They are equal or greater.
    AtLeast,
    /// Over another neighborhood: an engine of any-angle paths at a finite k. It finds a path wherever the
    /// reference finds one.
    Alike,
}

/// An engine with its index.
#[derive(Debug)]
pub(super) struct Runner {
    pub(super) engine: Engine,
    pub(super) relation: Relation,
    /// Shared by all threads.
    pub(super) planners: Planners,
    /// A planner that follows from index to index. Locked, since a planner is of one thread at a time.
    follower: Mutex<Planner>,
}

/// The cells of a map: what each costs, or that it is blocked.
#[derive(Clone, Debug)]
struct Cells {
    width: u32,
    height: u32,
    costs: Vec<Option<u8>>,
}

impl Cells {
    fn at(&self, x: u32, y: u32) -> Option<u8> {
        self.costs[(y * self.width + x) as usize]
    }

    /// The space of these cells, made anew.
    fn space(&self, motion: Motion, has_costs: bool) -> Result<Space, Error> {
        let map = Map::from_fn(self.width, self.height, |x, y| self.at(x, y).is_none())?;
        if has_costs {
            map.costs(self.costs.iter().map(|cost| cost.unwrap_or(1)))?.space(motion)
        } else {
            map.space(motion)
        }
    }
}

/// A map with a motion, all engines that take it, and a reference that is made anew after each edit.
#[derive(Debug)]
pub(super) struct World {
    pub(super) name: String,
    cells: Cells,
    has_costs: bool,
    pub(super) space: Space,
    pub(super) runners: Vec<Runner>,
    pub(super) reference: Planners,
}

/// The motions in turn, and whether cells have costs.
fn motions() -> Vec<(Motion, bool)> {
    let mut all = Vec::new();
    for k in 2..=5 {
        for rule in [CornerRule::Never, CornerRule::One, CornerRule::Always] {
            all.push((Motion::new(k, rule), false));
        }
        for gap in [DiagonalGap::Open, DiagonalGap::Closed] {
            all.push((Motion::new(k, gap), false));
        }
        all.push((Motion::centers(k), true));
    }
    for gap in [DiagonalGap::Open, DiagonalGap::Closed] {
        all.push((Motion::new(K::ANY, gap), false));
        all.push((Motion::new(K::ANY, Rules::CenterGap(gap)), false));
    }
    // Any two that follow each other differ in kind: 7 shares no factor with their number.
    let count = all.len();
    (0..count).map(|turn| all[turn * 7 % count]).collect()
}

/// A generated map, or a part of one of the given files.
fn draw(rng: &mut Rng, side: u32, files: &[PathBuf]) -> Result<(Grid, String), SoakError> {
    let width = side / 2 + rng.below(side / 2 + 1);
    let height = side / 2 + rng.below(side / 2 + 1);
    if let (true, Some(file)) = (rng.chance(33), rng.pick(files)) {
        let whole = MapFile::read(file).map_err(|error| SoakError::Wrong(error.to_string()))?.to_grid();
        let (width, height) = (width.min(whole.width()), height.min(whole.height()));
        let left = rng.below(whole.width() - width + 1);
        let top = rng.below(whole.height() - height + 1);
        let is_free = |x: u32, y: u32| whole.is_free((left + x) as i32, (top + y) as i32);
        let part = Grid::from_fn(width, height, |x, y| !is_free(x, y));
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let part = part.map_err(|error| SoakError::Wrong(error.to_string()))?;
        return Ok((part, format!("{name} from ({left}, {top})")));
    }
    Ok(match rng.below(5) {
        0 => (maze(rng, width, height), "maze".to_owned()),
        1 => (rooms(rng, width, height), "rooms".to_owned()),
        2 => (caves(rng, width, height), "caves".to_owned()),
        3 => (adversarial(rng, width, height), "patterns".to_owned()),
        _ => {
            let percent = 5 + rng.below(35);
            (noise(rng, width, height, percent), format!("noise of {percent} %"))
        }
    })
}

/// The relation of a planner's paths to the reference of its motion.
fn relation(planner: &Planner, motion: Motion) -> Relation {
    match planner.guarantee() {
        Guarantee::Optimal(_) | Guarantee::Cheapest(_) | Guarantee::OptimalAnyAngle => Relation::Equal,
        _ if planner.index().space().costs().is_some() => Relation::Alike,
        _ if planner.index().setup().paths() == motion.k => Relation::AtLeast,
        _ => Relation::Alike,
    }
}

/// The engine whose lengths are the reference.
fn reference(space: &Space) -> Result<Planners, Error> {
    let engine = if space.motion().k == K::Any { Engine::Anya } else { Engine::AStar };
    Ok(Planners::new(space.prepare(engine)?))
}

impl World {
    /// The world of a round, with the engines that take its motion; they are saved and loaded, if they can
    /// be.
    pub(super) fn draw(
        round: u64,
        rng: &mut Rng,
        (side, files): (u32, &[PathBuf]),
        timer: &mut Timer<'_>,
    ) -> Result<Self, SoakError> {
        let all = motions();
        let (motion, has_costs) = all[(round % all.len() as u64) as usize];
        let (grid, kind) = draw(rng, side, files)?;
        let (width, height) = (grid.width(), grid.height());
        let mut costs = Vec::new();
        for y in 0..height {
            for x in 0..width {
                let is_free = grid.is_free(x as i32, y as i32);
                costs.push(is_free.then(|| if has_costs { 1 + rng.below(9) as u8 } else { 1 }));
            }
        }
        let cells = Cells { width, height, costs };
        let space = cells.space(motion, has_costs)?;
        let on = if has_costs { " with costs" } else { "" };
        let name = format!("{kind}, {width} × {height}{on}, {motion}");
        let reference = reference(&cells.space(motion, has_costs)?)?;
        let mut world = Self { name, cells, has_costs, space, runners: Vec::new(), reference };
        for engine in Engine::ALL {
            if world.space.make_ready(engine).is_ok() {
                world.add(engine, rng, timer)?;
            }
        }
        Ok(world)
    }

    fn add(&mut self, engine: Engine, rng: &mut Rng, timer: &mut Timer<'_>) -> Result<(), SoakError> {
        let mut index = timer.time(Kind::Prepare, engine, || self.space.prepare(engine))??;
        // Engines without an index of their own refuse, by an error.
        if let Ok(bytes) = timer.time(Kind::Save, engine, || index.to_bytes())? {
            let (length, other) = (bytes.len(), self.cells.space(self.space.motion(), self.has_costs)?);
            let loaded = timer.time(Kind::Load, engine, || other.index_from_bytes(bytes))??;
            if loaded.to_bytes()?.len() != length {
                return Err(timer.wrong(engine, "a loaded index is saved in another length"));
            }
            if rng.chance(50) {
                index = self.space.index_from_bytes(loaded.to_bytes()?)?;
            }
            if rng.chance(25) {
                index = self.through_a_file(&index, timer)?;
            }
        }
        let follower = index.planner();
        let relation = relation(&follower, self.space.motion());
        self.runners.push(Runner {
            engine,
            relation,
            planners: Planners::new(index),
            follower: Mutex::new(follower),
        });
        Ok(())
    }

    /// The index, saved over an older file and loaded again.
    fn through_a_file(&self, index: &Index, timer: &mut Timer<'_>) -> Result<Index, SoakError> {
        let engine = index.setup().engine.kind();
        let file = timer.file();
        timer.time(Kind::Save, engine, || index.save(&file))??;
        timer.time(Kind::Load, engine, || self.space.load_for(engine, &file))?.map_err(Into::into)
    }

    /// Edits the map at a place, so that all indexes and planners follow.
    pub(super) fn edit(&mut self, rng: &mut Rng, timer: &mut Timer<'_>) -> Result<(), SoakError> {
        let Cells { width, height, .. } = self.cells;
        let (x, y) = (rng.below(width), rng.below(height));
        let (columns, rows) = ((1 + rng.below(10)).min(width - x), (1 + rng.below(10)).min(height - y));
        let percent = *rng.pick(&[0, 30, 100]).unwrap_or(&0);
        let mut edited = Vec::new();
        for y in y..y + rows {
            for x in x..x + columns {
                let cost = if self.has_costs { 1 + rng.below(9) as u8 } else { 1 };
                let cost = (!rng.chance(percent)).then_some(cost);
                self.cells.costs[(y * width + x) as usize] = cost;
                edited.push(((x as i32, y as i32), cost.map(f64::from)));
            }
        }
        let change = if self.has_costs {
            self.space.edit_costs(edited)?
        } else {
            self.space.edit(Rectangle::new(x, y, columns, rows), |x, y| self.cells.at(x, y).is_none())?
        };
        self.follow(&change, rng, timer)?;
        self.space = change.after().clone();
        self.reference = reference(&self.cells.space(self.space.motion(), self.has_costs)?)?;
        Ok(())
    }

    fn follow(&mut self, change: &Change, rng: &mut Rng, timer: &mut Timer<'_>) -> Result<(), SoakError> {
        for Runner { engine, planners, follower, .. } in &mut self.runners {
            let followed = follower.get_mut().unwrap_or_else(PoisonError::into_inner);
            let mut index = timer.time(Kind::Repair, *engine, || planners.index().repair(change))??;
            if rng.chance(20) {
                index = timer.time(Kind::Repair, *engine, || index.finish())??;
            }
            timer.time(Kind::Follow, *engine, || followed.follow(&index))??;
            if rng.chance(50) {
                planners.follow(&index)?;
            } else {
                *planners = planners.hand_on(&index)?;
            }
        }
        Ok(())
    }

    /// Ends of queries: mostly free.
    pub(super) fn end(&self, rng: &mut Rng) -> Vertex {
        let extra = u32::from(self.space.motion().rules.placement() == PlacementKind::Corner);
        let mut at = Vertex::new(0, 0);
        for _ in 0..20 {
            let (x, y) = (rng.below(self.cells.width + extra), rng.below(self.cells.height + extra));
            at = Vertex::new(x as i32, y as i32);
            if self.space.is_free(at) {
                break;
            }
        }
        at
    }

    /// Asks each planner that followed every edit one query, beside the reference.
    pub(super) fn ask_followers(
        &mut self,
        rng: &mut Rng,
        mut compare: impl FnMut(&Self, &Runner, [Vertex; 2], Option<f64>) -> Result<(), SoakError>,
    ) -> Result<(), SoakError> {
        let ends = [self.end(rng), self.end(rng)];
        if !ends.iter().all(|&end| self.space.is_free(end)) {
            return Ok(());
        }
        for number in 0..self.runners.len() {
            let follower = self.runners[number].follower.get_mut().unwrap_or_else(PoisonError::into_inner);
            let found = follower.distance((ends[0], ends[1]))?;
            compare(self, &self.runners[number], ends, found)?;
        }
        Ok(())
    }
}

/// The map files of the benchmark sets that were downloaded; none without them.
pub(super) fn map_files(cache: &Path) -> Vec<PathBuf> {
    let folders = std::fs::read_dir(cache).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut found: Vec<PathBuf> = folders
        .filter(|path| path.is_dir())
        .flat_map(|folder| mediant_sets::files(&folder, ".map").unwrap_or_default())
        .collect();
    found.sort();
    found
}
