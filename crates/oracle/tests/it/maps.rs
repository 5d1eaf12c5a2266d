//! The generators: the same map for the same seed, the promised sizes, and every kind of trouble among the
//! seeds.

use std::collections::BTreeSet;

use mediant_grid::{AsciiMap, CornerRule, DiagonalGap, Grid, PlacementKind, Rules, Vertex};
use mediant_moves::FiniteK;
use mediant_oracle::{
    Case, Explicit, Rng, adversarial, caves, describe, is_gap, maze, noise, random_free_vertex, random_grid,
    random_vertex, rooms, vertex_is_free,
};

#[test]
fn seeds_decide_and_every_kind_occurs() {
    let (mut kinds, mut sizes) = (BTreeSet::new(), BTreeSet::new());
    let (mut gaps, mut full, mut lines) = (0, 0, 0);
    for seed in 0..2000 {
        let (grid, kind) = random_grid(seed);
        assert_eq!(random_grid(seed), (grid.clone(), kind.clone()), "seed {seed}");
        let (w, h) = (grid.width(), grid.height());
        assert!((1..=24).contains(&w) && (1..=24).contains(&h), "seed {seed}: {w} × {h}");
        sizes.extend([w, h]);
        let corners = (0..=h as i32).flat_map(|y| (0..=w as i32).map(move |x| Vertex::new(x, y)));
        gaps += u32::from(corners.into_iter().any(|at| is_gap(&grid, at)));
        full += u32::from(grid.free_cells() == 0);
        lines += u32::from(w == 1 || h == 1);
        let name = kind.split(',').next().unwrap_or_default();
        kinds.insert(name.split(" of ").next().unwrap_or_default().to_owned());
    }
    assert_eq!(sizes.len(), 24, "{sizes:?}");
    // 11 patterns, noise, rooms, maze, caves.
    assert_eq!(kinds.len(), 15, "{kinds:?}");
    assert_eq!((gaps > 500, full > 20, lines > 200), (true, true, true), "{gaps}, {full}, {lines}");
}

#[test]
fn generators_keep_to_the_size_and_clamp_it() {
    type Generator = fn(&mut Rng, u32, u32) -> Grid;
    let dense: Generator = |rng, w, h| noise(rng, w, h, 50);
    for (name, generator) in
        [("noise", dense), ("rooms", rooms), ("maze", maze), ("caves", caves), ("adversarial", adversarial)]
    {
        for seed in 0..60 {
            let mut rng = Rng::new(seed);
            let grid = generator(&mut rng, 31, 17);
            assert_eq!((grid.width(), grid.height()), (31, 17), "{name}, seed {seed}");
            let least = generator(&mut rng, 0, 0);
            assert_eq!((least.width(), least.height()), (1, 1), "{name}, seed {seed}");
        }
        assert_eq!(generator(&mut Rng::new(7), u32::MAX, 1).width(), Grid::MAX_SIDE, "{name}");
    }
    assert_eq!(noise(&mut Rng::new(3), 20, 20, 0).free_cells(), 400);
    assert_eq!(noise(&mut Rng::new(3), 20, 20, 100).free_cells(), 0);
}

#[test]
fn mazes_are_connected_where_carved() {
    let rules = Rules::Center(CornerRule::Never);
    for seed in 0..20 {
        let grid = maze(&mut Rng::new(seed), 21, 15);
        let graph = Explicit::new(&grid, rules, Some(FiniteK::N4));
        let costs = graph.costs_from(Vertex::new(0, 0));
        for y in (0..15).step_by(2) {
            for x in (0..21).step_by(2) {
                let at = Vertex::new(x, y);
                assert!(costs.to(at).is_some(), "{}", describe(&grid, rules, Vertex::new(0, 0), at, seed));
            }
        }
    }
}

#[test]
fn drawn_vertices_lie_on_the_map() {
    for placement in [PlacementKind::Center, PlacementKind::Corner] {
        for seed in 0..300 {
            let (grid, _) = random_grid(seed);
            let mut rng = Rng::new(seed);
            let extra = i32::from(placement == PlacementKind::Corner);
            let any = random_vertex(&mut rng, &grid, placement);
            let (w, h) = (grid.width() as i32 + extra, grid.height() as i32 + extra);
            assert!((0..w).contains(&any.x) && (0..h).contains(&any.y), "seed {seed}: {any}");
            let free = random_free_vertex(&mut rng, &grid, placement);
            assert_eq!(free.is_some(), grid.free_cells() > 0, "seed {seed}");
            assert!(free.is_none_or(|at| vertex_is_free(&grid, placement, at)), "seed {seed}: {free:?}");
        }
    }
}

#[test]
fn a_description_can_be_read_back() {
    let mut read = 0;
    for seed in 0..200 {
        let Some(case) = Case::random(seed, Rules::Corner(DiagonalGap::Closed)) else { continue };
        let text = case.to_string();
        let (head, drawing) = text.split_once('\n').unwrap();
        let expected =
            format!("seed {seed}; rules: corner, gap closed; from {} to {}; the map:", case.start, case.goal);
        assert_eq!(head, expected);
        let map = AsciiMap::parse(drawing).unwrap();
        assert_eq!((&map.grid, random_grid(seed).0), (&case.grid, case.grid.clone()), "{case}");
        let is_own_cell_free = case.grid.is_free(case.start.x, case.start.y);
        assert_eq!(map.mark('s'), is_own_cell_free.then_some(case.start), "{case}");
        read += 1;
    }
    assert!(read > 150, "{read} read");
}
