//! Preparations and fields can be stopped anywhere.

use std::sync::{Arc, atomic::AtomicBool};

use mediant_grid::{
    Centers, Change, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, GridGraph, Interrupt, Interrupted,
    StoppedBy, Vertex,
};
use mediant_moves::FiniteK;
use mediant_oracle::{Rng, caves, check_interrupts, maze, noise};
use mediant_search::{
    AnyAngleFields, CanonicalRule, DeadEnds, FieldError, FieldQuery, Fields, JumpError, JumpTable, Limit,
    Limits, Pruning, parts::BlockFinder,
};

const SIDE: u32 = 200;
const ROWS: usize = SIDE as usize;

/// Ground of each kind: caves, a maze, noise.
fn grids() -> Vec<Arc<Grid>> {
    let rng = &mut Rng::new(7);
    let grids = [caves(rng, SIDE, SIDE), maze(rng, SIDE, SIDE), noise(rng, SIDE, SIDE, 20)];
    grids.into_iter().map(Arc::new).collect()
}

fn graph(grid: &Arc<Grid>, k: u32) -> GridGraph<Centers> {
    let k = FiniteK::new(k).expect("at least 2");
    GridGraph::new(Arc::clone(grid), k, CornerRule::Never).expect("at most 12")
}

fn free(grid: &Grid) -> Vertex {
    let cells = (0..SIDE as i32).flat_map(|y| (0..SIDE as i32).map(move |x| Vertex::new(x, y)));
    cells.into_iter().find(|at| grid.is_free(at.x, at.y)).expect("a free cell")
}

fn by(error: &Interrupted) -> Option<StoppedBy> {
    Some(error.by)
}

fn of_field(error: &FieldError) -> Option<StoppedBy> {
    if let FieldError::Interrupted(error) = error { by(error) } else { None }
}

fn of_jump(error: &JumpError) -> Option<StoppedBy> {
    if let JumpError::Interrupted(error) = error { by(error) } else { None }
}

#[test]
fn pruning_rules_stop() {
    let k = FiniteK::new(5).expect("at least 2");
    let rule = |i: &Interrupt| CanonicalRule::<Centers>::interruptible(k, CornerRule::Never, i);
    // Pairs of moves.
    check_interrupts("a rule", 29 * 32, rule, by);
    let graph = graph(&grids()[0], 5);
    check_interrupts("a rule on a map", 6 * ROWS, |i| Pruning::interruptible(&graph, i), by);
}

#[test]
fn jumps_stop() {
    for grid in grids() {
        for k in [2, 3] {
            let graph = graph(&grid, k);
            let pruning = Pruning::new(&graph);
            let finder = |i: &Interrupt| BlockFinder::interruptible(&graph, &pruning, i);
            check_interrupts("planes", 5 * ROWS, finder, of_jump);
            check_interrupts("a table", 6 * ROWS, |i| JumpTable::interruptible(&graph, i), of_jump);
            let bytes = JumpTable::new(&graph).expect("k ≤ 3").to_bytes();
            let read = |i: &Interrupt| JumpTable::from_bytes_interruptible(&graph, &bytes, i);
            check_interrupts("a table's bytes", 6 * ROWS, read, of_jump);
        }
    }
}

#[test]
fn repairs_of_jumps_stop() {
    for grid in grids() {
        let change = Change::new(Arc::clone(&grid)).edit_cells((0..40).map(|i| (5 * i, 3 * i, i % 2 == 0)));
        let [before, after] = [&grid, change.after()].map(|grid| graph(grid, 3));
        let [old, new] = [&before, &after].map(Pruning::new);
        let finder = BlockFinder::new(&before, &old).expect("k ≤ 3");
        let repaired = |i: &Interrupt| finder.repaired(&after, &new, &change, i);
        check_interrupts("a repair of planes", 20, repaired, of_jump);
    }
}

#[test]
fn dead_ends_stop() {
    for grid in grids() {
        let space = FreeSpace::<Corners>::new(grid, DiagonalGap::Open);
        check_interrupts("dead ends", 4 * ROWS, |i| DeadEnds::interruptible(&space, i), by);
    }
}

/// After they were stopped, they make the same fields as before.
#[test]
fn fields_stop_and_go_on() {
    for grid in grids() {
        let source = [free(&grid)];
        for k in [2, 3, 4, 6] {
            let graph = graph(&grid, k);
            let expected = Fields::new(&graph).field(FieldQuery::new(&source)).expect("a free source");
            let fields = std::cell::RefCell::new(Fields::new(&graph));
            let field = |i: &Interrupt| {
                let mut fields = fields.borrow_mut();
                let found = fields.field_interruptible(FieldQuery::new(&source), i)?;
                assert_eq!(found.costs(), expected.costs());
                Ok(())
            };
            let free = grid.free_cells() as usize;
            check_interrupts("a field", free / 8 / Limits::EXPANSIONS_PER_LOOK as usize, field, of_field);
            field(&Interrupt::NEVER).expect("nothing stops it");
        }
        let space = FreeSpace::<Corners>::new(Arc::clone(&grid), DiagonalGap::Closed);
        let expected = AnyAngleFields::new(&space).field(FieldQuery::new(&source)).expect("a free source");
        let fields = std::cell::RefCell::new(AnyAngleFields::new(&space));
        let field = |i: &Interrupt| {
            let mut fields = fields.borrow_mut();
            let found = fields.field_interruptible(FieldQuery::new(&source), i)?;
            assert_eq!(found.lengths(), expected.lengths());
            Ok(())
        };
        check_interrupts("an any-angle field", 2, field, of_field);
        field(&Interrupt::NEVER).expect("nothing stops it");
    }
}

#[test]
fn limits_hold_an_interrupt() {
    let limits = Limits::new().cancel(Arc::new(AtomicBool::new(true))).deadline(|| true);
    let stopped = limits.interrupt().check("waiting").expect_err("the flag is set");
    assert_eq!(Limit::from(stopped.by), Limit::Cancelled);
    let late = Limits::new().deadline(|| true).interrupt().check("waiting").expect_err("it is late");
    assert_eq!(Limit::from(late.by), Limit::Timeout);
    assert!(Limits::new().cost(3.0).expansions(4).interrupt().is_never());
}
