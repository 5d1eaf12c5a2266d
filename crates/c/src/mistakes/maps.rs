//! Calls of maps, and of what needs no object.

use std::ptr;

use library::{PlacementKind, grid::Grid, moves::FiniteK};
use mediant_oracle::neighborhood;

use super::{
    ask,
    draw::untouched,
    model::{LONGEST, MapModel, is_near},
    spaces::{BAD_MOTIONS, MOTIONS, motion},
    world::World,
};
use crate::{
    about::{mediant_bound, mediant_moves},
    code::Code,
    map::{
        MapHandle, mediant_map_cells, mediant_map_clearance, mediant_map_costs, mediant_map_edit,
        mediant_map_edit_cells, mediant_map_edit_costs, mediant_map_for_disc, mediant_map_for_square,
        mediant_map_from_bits, mediant_map_is_blocked, mediant_map_new, mediant_map_open, mediant_map_parse,
        mediant_map_size,
    },
    points::{Area, Cell},
};

impl World {
    /// A map that a call made, if it did.
    fn made_map(
        &mut self,
        name: &str,
        code: Code,
        map: &[MapHandle],
        model: impl FnOnce() -> Option<MapModel>,
    ) {
        if self.ended(name, code) {
            let model = model().expect("a right call has a model");
            self.maps.add(map[0].id, model);
        }
    }
}

/// Makes a map.
pub(super) fn make(world: &mut World) {
    let odd = [0, 32_769, u32::MAX, 1 << 31, 65_536];
    let side = |world: &mut World| match world.rng.below(40) {
        0 => world.rng.pick(&odd).copied().unwrap_or_default(),
        _ => 1 + world.rng.below(LONGEST),
    };
    let (width, height) = (side(world), side(world));
    let is_right = Grid::check_size(width.into(), height.into()).is_ok();
    let percent = [0, 10, 20, 30, 45, 100][world.rng.below(6) as usize];
    let count = if is_right { (width * height) as usize } else { 8 };
    let blocked: Vec<bool> = (0..count).map(|_| world.rng.chance(percent)).collect();
    let model = |blocked: Vec<bool>| MapModel { size: (width, height), blocked, costs: None };
    if !is_right {
        world.wrong(Code::MapSize);
    }
    let place = world.place();
    match world.rng.below(3) {
        0 => {
            let bytes: Vec<u8> = blocked.iter().map(|&blocked| u8::from(blocked) * 7).collect();
            let cells = world.values(&bytes);
            // A pointer that is null is a map without obstacles: no mistake.
            let is_null = cells.at.is_null();
            let model = || model(if is_null { vec![false; count] } else { blocked });
            if is_null {
                world.forgive(Code::Argument);
            }
            let code = ask!(mediant_map_new(width, height, cells.at, place.at));
            world.made_map("map_new", code, &place.values(), || Some(model()));
        }
        1 => {
            let mut bits = vec![0_u8; count.div_ceil(8)];
            blocked
                .iter()
                .enumerate()
                .filter(|(_, is)| !**is)
                .for_each(|(at, _)| bits[at / 8] |= 1 << (at % 8));
            let bits = world.values(&bits);
            let code = ask!(mediant_map_from_bits(width, height, bits.at, place.at));
            world.made_map("map_from_bits", code, &place.values(), || Some(model(blocked)));
        }
        _ => {
            let letter = |&blocked: &bool| if blocked { '@' } else { '.' };
            let rows = blocked.chunks(width.clamp(1, 64) as usize);
            let mut text: String = rows.flat_map(|row| row.iter().map(letter).chain(['\n'])).collect();
            world.forgive(Code::MapSize);
            let code = match world.rng.below(30) {
                _ if !is_right => None,
                0 => Some(("\u{0}..x", Code::MapTile)),
                1 => Some((".", Code::MapRagged)),
                _ => None,
            };
            if let Some((more, code)) = code {
                let more = if width == 1 && code == Code::MapRagged { ".." } else { more };
                text.push_str(more.trim_start_matches('\u{0}'));
                world.wrong(code);
                world.maybe(&[Code::MapRagged, Code::MapTile]);
            }
            let (_text, at) = world.text(if is_right { Some(&text) } else { None });
            if !is_right {
                world.wrong(Code::MapSize);
            }
            let code = ask!(mediant_map_parse(at, place.at));
            world.made_map("map_parse", code, &place.values(), || Some(model(blocked)));
        }
    }
}

/// Any call of a map.
pub(super) fn any(world: &mut World) {
    match world.rng.below(11) {
        0 => whole(world),
        1 => one_cell(world),
        2 => edit(world),
        3 | 4 => edit_cells(world),
        5 => costs(world),
        6 => edit_costs(world),
        7 => agents(world),
        8 => clearance(world),
        9 => library_calls(world),
        _ => open(world),
    }
}

fn whole(world: &mut World) {
    let (id, model) = world.handle(|world| &world.maps);
    let (width, height) = (world.place::<u32>(), world.place::<u32>());
    let code = ask!(mediant_map_size(MapHandle { id }, width.at, height.at));
    if world.ended("map_size", code) {
        assert_eq!(model.as_ref().map(|map| map.size), Some((width.values()[0], height.values()[0])));
    } else {
        assert!(width.is_untouched() && height.is_untouched(), "map_size");
    }
    let (id, model) = world.handle(|world| &world.maps);
    let cells = world.room::<u8>(model.as_ref().map_or(8, |map| map.blocked.len()));
    let code = ask!(mediant_map_cells(MapHandle { id }, cells.at, cells.count));
    if world.ended("map_cells", code) {
        let expected = model.iter().flat_map(|map| map.blocked.iter().map(|&is| u8::from(is)));
        let expected: Vec<u8> = expected.chain([untouched(); 3]).take(cells.values().len()).collect();
        assert_eq!(cells.values(), expected, "map_cells");
    }
}

fn one_cell(world: &mut World) {
    let (id, model) = world.handle(|world| &world.maps);
    let (cell, place) = (world.cell((LONGEST, LONGEST)), world.place::<i32>());
    let code = ask!(mediant_map_is_blocked(MapHandle { id }, cell, place.at));
    if world.ended("map_is_blocked", code) {
        let is_blocked = model.map(|map| map.is_blocked(cell.x.into(), cell.y.into()));
        assert_eq!(is_blocked.map(i32::from), Some(place.values()[0]), "map_is_blocked");
    }
}

fn edit(world: &mut World) {
    let (id, model) = world.handle(|world| &world.maps);
    let small = |world: &mut World| world.rng.below(LONGEST + 1);
    let mut area = Area { x: small(world), y: small(world), width: small(world), height: small(world) };
    match world.rng.below(30) {
        0 => area.width = 32_769,
        1 => area.height = u32::MAX,
        2 => area.x = u32::MAX,
        _ => {}
    }
    let is_long = area.width.max(area.height) > Grid::MAX_SIDE;
    if is_long {
        world.wrong(Code::Argument);
    }
    let count = if is_long { 4 } else { area.width * area.height };
    let bytes: Vec<u8> = (0..count).map(|_| world.rng.below(3) as u8 / 2).collect();
    let edited = model.map(|map| {
        let mut edited = MapModel::clone(&map);
        let mut frees = false;
        for (at, &byte) in (0..).zip(&bytes) {
            let (x, y) = (
                area.x.saturating_add(at % area.width.max(1)),
                area.y.saturating_add(at / area.width.max(1)),
            );
            if let Some(cell) = edited.index(x.into(), y.into()) {
                frees |= edited.blocked[cell] && byte == 0;
                edited.blocked[cell] = byte != 0;
            }
        }
        if area.x >= map.size.0 || area.y >= map.size.1 || area.width == 0 || area.height == 0 {
            world.maybe(&[Code::EditOutside]);
        }
        if frees && edited.costs.is_some() && !is_long {
            world.wrong(Code::Cost);
            world.maybe(&[Code::EditOutside]);
        }
        edited
    });
    let (cells, place) = (world.values(&bytes), world.place());
    let code = ask!(mediant_map_edit(MapHandle { id }, area, cells.at, place.at));
    world.made_map("map_edit", code, &place.values(), || edited);
}

/// Cells to edit, with what they become.
fn cells_of(world: &mut World) -> Vec<Cell> {
    let count = world.rng.below(6);
    (0..count).map(|_| world.cell((LONGEST, LONGEST))).collect()
}

/// The map with some cells edited; notes what is wrong with that.
fn edited<T: Copy>(
    world: &mut World,
    map: &MapModel,
    edits: &[(Cell, T)],
    mut edit: impl FnMut(&mut MapModel, usize, T),
) -> MapModel {
    let mut edited = map.clone();
    for &(cell, value) in edits {
        match edited.index(cell.x.into(), cell.y.into()) {
            Some(at) => edit(&mut edited, at, value),
            None => world.wrong(Code::EditOutside),
        }
    }
    edited
}

fn edit_cells(world: &mut World) {
    let (id, model) = world.handle(|world| &world.maps);
    let cells = cells_of(world);
    let bytes: Vec<u8> = cells.iter().map(|_| world.rng.below(2) as u8 * 255).collect();
    let edits: Vec<_> = cells.iter().copied().zip(bytes.iter().copied()).collect();
    let edited = model.map(|map| {
        let edited = edited(world, &map, &edits, |map, at, byte| map.blocked[at] = byte != 0);
        if map.costs.is_some() {
            // The last edit of a cell counts.
            let frees = map.blocked.iter().zip(&edited.blocked).any(|(&was, &is)| was && !is);
            if frees { world.wrong(Code::Cost) } else { world.maybe(&[Code::Cost]) }
        }
        edited
    });
    let (cells, place) = (world.values(&cells), world.place());
    let bytes = world.beside(&bytes, cells.count);
    let code = ask!(mediant_map_edit_cells(MapHandle { id }, cells.at, bytes.at, cells.count, place.at));
    world.made_map("map_edit_cells", code, &place.values(), || edited);
}

fn costs(world: &mut World) {
    let (id, model) = world.handle(|world| &world.maps);
    let count = model.as_ref().map_or(4, |map| map.blocked.len()) + usize::from(world.rng.below(20) == 0);
    let mut costs: Vec<f64> = (0..count).map(|_| f64::from(1 + world.rng.below(9))).collect();
    let odd = [0.0, -1.0, f64::NAN, f64::INFINITY];
    if world.rng.chance(8) {
        let at = world.rng.below(count as u32) as usize;
        costs[at] = world.rng.pick(&odd).copied().unwrap_or_default();
    }
    if let Some(map) = &model {
        let is_right = |cost: f64| (1.0..=9.0).contains(&cost);
        let wrong = costs.iter().zip(&map.blocked).any(|(&cost, &blocked)| !blocked && !is_right(cost));
        if wrong || count != map.blocked.len() {
            world.wrong(Code::Cost);
        } else if !costs.iter().all(|&cost| is_right(cost)) {
            world.maybe(&[Code::Cost]);
        }
    }
    let priced = model.map(|map| MapModel { costs: Some(costs.clone()), ..MapModel::clone(&map) });
    let (costs, place) = (world.values(&costs), world.place());
    let code = ask!(mediant_map_costs(MapHandle { id }, costs.at, costs.count, place.at));
    world.made_map("map_costs", code, &place.values(), || priced);
}

fn edit_costs(world: &mut World) {
    let (id, model) = world.handle(|world| &world.maps);
    let cells = cells_of(world);
    let mut cost = || match world.rng.below(30) {
        0 => -1.0,
        1 => f64::INFINITY,
        2..9 => f64::NAN,
        _ => f64::from(1 + world.rng.below(9)),
    };
    let costs: Vec<f64> = cells.iter().map(|_| cost()).collect();
    let edits: Vec<_> = cells.iter().copied().zip(costs.iter().copied()).collect();
    let edited = model.map(|map| {
        if map.costs.is_none() {
            world.wrong(Code::Cost);
        }
        // The last edit of a cell counts.
        let is_last = |at: usize| edits[at + 1..].iter().all(|(cell, _)| *cell != edits[at].0);
        let is_wrong = |cost: f64| !cost.is_nan() && !(1.0..=9.0).contains(&cost);
        let wrong = (0..edits.len()).filter(|&at| is_wrong(edits[at].1));
        if wrong.clone().any(is_last) {
            world.wrong(Code::Cost);
        } else if wrong.count() > 0 {
            world.maybe(&[Code::Cost]);
        }
        edited(world, &map, &edits, |map, at, cost| {
            map.blocked[at] = cost.is_nan();
            if let Some(costs) = &mut map.costs {
                costs[at] = if cost.is_nan() { 1.0 } else { cost };
            }
        })
    });
    let (cells, place) = (world.values(&cells), world.place());
    let costs = world.beside(&costs, cells.count);
    let code = ask!(mediant_map_edit_costs(MapHandle { id }, cells.at, costs.at, cells.count, place.at));
    world.made_map("map_edit_costs", code, &place.values(), || edited);
}

/// The square of the distance of a cell's center to the nearest obstacle, in halves of a cell.
fn clearance_of(map: &MapModel, (x, y): (i64, i64)) -> i64 {
    let far = i64::from(LONGEST) + 1;
    let all = (y - far..=y + far).flat_map(|row| (x - far..=x + far).map(move |column| (column, row)));
    let obstacles = all.filter(|&(column, row)| map.is_blocked(column, row));
    let square = |(column, row): (i64, i64)| {
        let halves = |by: i64| (2 * by.abs() - 1).max(0);
        halves(column - x).pow(2) + halves(row - y).pow(2)
    };
    obstacles.map(square).min().unwrap_or(0)
}

fn cells(map: &MapModel) -> impl Iterator<Item = (i64, i64)> {
    let (width, height) = (i64::from(map.size.0), i64::from(map.size.1));
    (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
}

fn agents(world: &mut World) {
    let (id, model) = world.handle(|world| &world.maps);
    let n = [0, 1, 2, 3, 1000, u32::MAX][world.rng.below(6) as usize];
    if n == 0 {
        world.wrong(Code::Number);
    }
    let place = world.place();
    let square = model.map(|map| {
        let side = i64::from(n.min(100));
        let is_free = |(x, y)| (0..side).all(|dy| (0..side).all(|dx| !map.is_blocked(x + dx, y + dy)));
        MapModel { blocked: cells(&map).map(|cell| !is_free(cell)).collect(), costs: None, ..*map }
    });
    let code = ask!(mediant_map_for_square(MapHandle { id }, n, place.at));
    world.made_map("map_for_square", code, &place.values(), || square);

    let (id, model) = world.handle(|world| &world.maps);
    let radius = [0.5, 1.0, 1.5, 0.0, 1e300, -1.0, f64::NAN, f64::INFINITY][world.rng.below(8) as usize];
    let (words, which) = world.words(&MOTIONS, &BAD_MOTIONS);
    if !(radius >= 0.0 && radius.is_finite()) {
        world.wrong(Code::Number);
    }
    let motion = which.map(motion);
    let is_center = motion.is_some_and(|motion| motion.rules.placement() == PlacementKind::Center);
    world.maybe(&[Code::Motion, Code::K, Code::EngineRules]);
    let place = world.place();
    let code = ask!(mediant_map_for_disc(MapHandle { id }, radius, words.as_ptr(), place.at));
    if code != Code::Ok {
        world.made_map("map_for_disc", code, &[], || None);
        return;
    }
    let (handle, map) = (place.values()[0], model.expect("right"));
    let mut blocked = vec![0_u8; map.blocked.len()];
    assert_eq!(ask!(mediant_map_cells(handle, blocked.as_mut_ptr(), blocked.len())), Code::Ok);
    let blocked: Vec<bool> = blocked.iter().map(|&byte| byte != 0).collect();
    // Nowhere a disc that does not fit; under most rules those that fit may be too near to turn there.
    let fits = |cell| clearance_of(&map, cell) as f64 >= 4.0 * radius * radius;
    let is_right = |(cell, &blocked): (_, &bool)| blocked || !is_center || fits(cell);
    assert!(cells(&map).zip(&blocked).all(is_right), "a disc of {radius} under {motion:?} on {map:?}");
    let disc = MapModel { blocked, costs: None, ..*map };
    world.made_map("map_for_disc", code, &[handle], || Some(disc));
}

fn clearance(world: &mut World) {
    let (id, model) = world.handle(|world| &world.maps);
    let place = world.room::<f64>(model.as_ref().map_or(8, |map| map.blocked.len()));
    let code = ask!(mediant_map_clearance(MapHandle { id }, place.at, place.count));
    if world.ended("map_clearance", code) {
        let map = model.expect("right");
        for (cell, found) in cells(&map).zip(place.values()) {
            let is_blocked = map.is_blocked(cell.0, cell.1);
            let expected = if is_blocked { 0.0 } else { (clearance_of(&map, cell) as f64).sqrt() / 2.0 };
            assert!(is_near(found, expected), "{found}, not {expected} at {cell:?} of {map:?}");
        }
    }
}

fn library_calls(world: &mut World) {
    let k = [2, 3, 4, 6, 0, 1, 33, u32::MAX][world.rng.below(8) as usize];
    // More than 2^47 moves are more than numbers of 64 bits hold.
    if !(2..=47).contains(&k) {
        world.wrong(Code::K);
    }
    let (moves, count) = (world.room::<Cell>(70), world.place::<usize>());
    let code = ask!(mediant_moves(k, moves.at, moves.count, count.at));
    if world.ended("moves", code) {
        assert_eq!(count.values()[0] as u64, 1 << k, "moves of k = {k}");
        if k <= 6 {
            let known = neighborhood(FiniteK::new(k).ok(), 40, 40);
            let is_known = |at: &Cell| known.iter().any(|known| (known.x, known.y) == (at.x, at.y));
            assert!(moves.values().iter().take(known.len()).all(is_known), "moves of k = {k}");
        }
    }
    let (words, which) = world.words(&MOTIONS, &BAD_MOTIONS);
    let bound = world.place::<f64>();
    let code = ask!(mediant_bound(words.as_ptr(), bound.at));
    if world.ended("bound", code) {
        let bound = bound.values()[0];
        let is_any = which.map(motion).is_some_and(|motion| motion.k == library::K::Any);
        assert!(if is_any { bound == 1.0 } else { bound.is_nan() || bound > 1.0 }, "bound {bound}");
    }
}

fn open(world: &mut World) {
    // Miri has no disk.
    if cfg!(miri) {
        return;
    }
    let paths = ["/none/at/all.map", "", "/", "Cargo.toml", "src"];
    let path = world.rng.pick(&paths).copied().filter(|_| world.rng.below(20) > 0);
    let (_path, at) = world.text(path);
    match path {
        None => world.wrong(Code::Argument),
        Some(_) => [Code::FileMissing, Code::FileUnreadable, Code::MapFormat]
            .into_iter()
            .for_each(|code| world.wrong(code)),
    }
    let place = world.place();
    let code = ask!(mediant_map_open(if at.is_null() { ptr::null() } else { at }, place.at));
    world.made_map("map_open", code, &place.values(), || None);
}
