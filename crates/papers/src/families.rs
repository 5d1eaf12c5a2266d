//! Families of maps from a seed, on which one engine is far ahead of another: open ground with few obstacles,
//! noise, and mazes.

use std::{path::Path, sync::Arc};

use mediant::Setup;
use mediant_bench::Study;
use mediant_grid::{Grid, Rules, Vertex};
use mediant_oracle::{Rng, maze, noise, sparse};
use mediant_report::{Column, Record, Row, Table, number};
use mediant_search::Ends;

use super::{
    context::{Context, How},
    experiment::{Experiment, Findings, Page, Section},
    maps::{Map, random_queries},
    setups::{Sums, run, setup},
};
use crate::Error;

/// Families of maps, engines side by side.
pub(super) const FAMILIES: Experiment = Experiment {
    id: "families",
    page: Page::Beyond,
    title: "Families of maps: where an engine is far ahead, or far behind",
    sets: &[],
    measure,
    show,
};

/// Maps of one kind and size.
struct Family {
    name: &'static str,
    about: &'static str,
    side: u32,
    grid: fn(&mut Rng, u32) -> Grid,
    /// Whether queries lead from near the first corner of the map to near the last.
    is_crossed: bool,
}

impl Family {
    fn setups(&self) -> impl Iterator<Item = &'static str> {
        let is_large = self.side >= LARGE;
        SETUPS.into_iter().filter(move |setup| !is_large || !SLOW.contains(setup))
    }
}

/// A maze of corridors `wide` cells wide, with walls as thick.
fn wide_maze(rng: &mut Rng, side: u32, wide: u32) -> Grid {
    let narrow = maze(rng, side / wide, side / wide);
    let is_blocked = |x: u32, y: u32| narrow.is_blocked((x / wide) as i32, (y / wide) as i32);
    Grid::from_fn(side, side, is_blocked).expect("the side is that of a map")
}

const fn sparse_family(
    name: &'static str,
    about: &'static str,
    side: u32,
    grid: fn(&mut Rng, u32) -> Grid,
) -> Family {
    Family { name, about, side, grid, is_crossed: true }
}

const fn family(
    name: &'static str,
    about: &'static str,
    side: u32,
    grid: fn(&mut Rng, u32) -> Grid,
) -> Family {
    Family { name, about, side, grid, is_crossed: false }
}

const KINDS: [Family; 9] = [
    sparse_family("sparse-1000", "one cell in 1,000 blocked", 512, |rng, side| sparse(rng, side, 1000)),
    sparse_family("sparse-100", "one cell in 100 blocked", 512, |rng, side| sparse(rng, side, 100)),
    family("noise-10", "each cell blocked with a probability of 10 %", 512, |rng, side| {
        noise(rng, side, side, 10)
    }),
    family("noise-35", "each cell blocked with a probability of 35 %", 512, |rng, side| {
        noise(rng, side, side, 35)
    }),
    family("maze-1", "corridors one cell wide", 512, |rng, side| wide_maze(rng, side, 1)),
    family("maze-8", "corridors eight cells wide", 512, |rng, side| wide_maze(rng, side, 8)),
    sparse_family("sparse-1000-2048", "one cell in 1,000 blocked", 2048, |rng, side| sparse(rng, side, 1000)),
    sparse_family("sparse-1000-4096", "one cell in 1,000 blocked", 4096, |rng, side| sparse(rng, side, 1000)),
    family("maze-32-4096", "corridors 32 cells wide", 4096, |rng, side| wide_maze(rng, side, 32)),
];
/// The families of a quick run: the first, which are small.
const QUICK: usize = 6;

/// From this side on there are a fifth of the queries, and no setups of [`SLOW`].
const LARGE: u32 = 2048;
/// Setups that go vertex by vertex, but for A*, to compare with.
const SLOW: [&str; 2] = ["canonical:3:never", "jps:3:never"];
const SETUPS: [&str; 9] = [
    "astar:3:never",
    "canonical:3:never",
    "jps:3:never",
    "jps-block:3:never",
    "jps-plus:3:never",
    "subgoal:3:never",
    "anya:3:closed",
    "anya:any:closed",
    "subgoal:any:closed",
];

fn measure(context: &Context<'_>) -> Result<Findings, Error> {
    let families = &KINDS[..context.quick_or(QUICK, KINDS.len())];
    let count = context.quick_or(4, 40);
    let maps: Vec<Map> = families.iter().map(|family| Map::new("families", Path::new(family.name))).collect();
    let on_map = |map: &Map| match families.iter().find(|family| family.name == map.name) {
        Some(family) => on_family(context, map, family, count),
        None => Ok(Vec::new()),
    };
    let measured = context.each("maps", How::Timed, &maps, on_map)?;
    let (mut rows, mut instances) = (Vec::new(), 0);
    for (family, of_setups) in families.iter().zip(&measured) {
        for (setup, sums) in family.setups().zip(of_setups) {
            let row = Row::new().key("family", family.name).key("setup", setup);
            rows.push(sums.row(row.with("side", f64::from(family.side))));
        }
        instances += of_setups.first().map_or(0, |sums| sums.queries);
    }
    let mut columns = vec![
        Column::key("family", "the family of maps"),
        Column::key("setup", "the engine with its options"),
        Column::count("side", "cells", "the side of the map"),
    ];
    columns.extend(Sums::columns());
    let drawn = format!(
        "a map of each family, and on it {count} queries that have a path, on large maps a fifth of that: on \
         sparse maps from a corner across the wall to the opposite one, else drawn at random"
    );
    Ok(Findings { columns, rows, maps: families.len(), instances, drawn, seeded: true })
}

fn on_family(context: &Context<'_>, map: &Map, family: &Family, count: usize) -> Result<Vec<Sums>, Error> {
    let count = if family.side < LARGE { count } else { count / 5 };
    let mut rng = context.rng(map);
    let grid = Arc::new((family.grid)(&mut rng, family.side));
    let setups: Vec<Setup> = family.setups().map(setup).collect::<Result<_, _>>()?;
    let library = mediant::Map::from(Arc::clone(&grid));
    let spaces: Vec<mediant::Space> = setups
        .iter()
        .map(|setup| setup.space(&library).map_err(|wrong| Error::Reproduce(wrong.to_string())))
        .collect::<Result<_, _>>()?;
    let connected = |query: Ends| spaces.iter().all(|space| space.connected(query.start, query.goal));
    let queries = if family.is_crossed {
        crossing(&mut rng, family.side, count, connected)
    } else {
        let rules: Rules = setups[0].rules();
        random_queries(&mut rng, &grid, rules, count, connected)
    };
    drop(spaces);
    let mut study = Study::new(&grid, &queries, context.passes());
    family.setups().map(|text| Ok(Sums::of(&run(&mut study, text)?, &[]))).collect()
}

/// Queries from near the first corner of a square map to near the last.
fn crossing(rng: &mut Rng, side: u32, count: usize, connected: impl Fn(Ends) -> bool) -> Vec<Ends> {
    let near = side / 16;
    let mut queries = Vec::with_capacity(count);
    while queries.len() < count {
        let mut draw = || rng.below(near) as i32;
        let start = Vertex::new(draw(), draw());
        let goal = Vertex::new(side as i32 - 1 - draw(), side as i32 - 1 - draw());
        // Almost everything there is free.
        if connected(Ends::new(start, goal)) {
            queries.push(Ends::new(start, goal));
        }
    }
    queries
}

fn show(record: &Record) -> Section {
    let mut section = Section::default();
    section.text(
        "One map of each family, from the seed. *Sparse* maps are open, with a wall along the middle three \
         quarters of one diagonal and a few single blocked cells on both sides of it. Jumps are long there, \
         and many lead to the same places. Between corners the gap is closed, so that paths pass where those \
         between centers do, but not so far from obstacles.",
    );
    let families = record.distinct("family");
    let mut kinds = Table::new(["family", "", "cells"]).names(2);
    for family in KINDS.iter().filter(|family| families.contains(&family.name)) {
        let side = family.side;
        kinds.row([family.name.to_owned(), family.about.to_owned(), format!("{side} × {side}")]);
    }
    section.table(&kinds);
    for (unit, column) in [("mean time of a query, µs", "micros"), ("mean nodes expanded", "expanded")] {
        let heading = [unit.to_owned()].into_iter().chain(families.iter().map(|family| (*family).to_owned()));
        let mut table = Table::new(heading);
        for setup in record.distinct("setup") {
            let value = |family: &&str| {
                let value = record.number(&[("family", family), ("setup", setup)], column);
                value.map_or("–".to_owned(), number)
            };
            table.row([format!("`{setup}`")].into_iter().chain(families.iter().map(value)));
        }
        section.table(&table);
    }
    section
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_stands_between_the_ends_of_crossing_queries() {
        let grid = sparse(&mut Rng::new(1), 64, 100);
        let wall = (8..56).all(|y| grid.is_blocked(63 - y, y) && grid.is_blocked(64 - y, y));
        assert!(wall && grid.is_free(0, 0) && grid.is_free(63, 63));
        let queries = crossing(&mut Rng::new(2), 64, 20, |query| query.start != query.goal);
        assert_eq!(queries.len(), 20);
        assert!(
            queries
                .iter()
                .all(|query| query.start.x + query.start.y < 8 && query.goal.x + query.goal.y > 118)
        );
    }

    #[test]
    fn corridors_are_as_wide_as_asked() {
        let grid = wide_maze(&mut Rng::new(3), 64, 8);
        let same = |x: i32, y: i32| grid.is_blocked(x, y) == grid.is_blocked(x - x % 8, y - y % 8);
        assert!((0..64).all(|y| (0..64).all(|x| same(x, y))));
    }
}
