//! Long calls can be stopped anywhere.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use mediant_grid::{
    Clearance, Components, Connectivity, Corners, DiagonalGap, Fit, FreeSpace, Grid, GridError, Interrupt,
    Interrupted, Outside, SizeError, StoppedBy,
};
use mediant_moves::K;
use mediant_oracle::check_interrupts;

/// Most rows ask once; a part of the work asks by more than one row.
const SIDE: u32 = 300;
const ROWS: usize = SIDE as usize;

fn blocked(x: u32, y: u32) -> bool {
    (x * x + 3 * y * x + 7 * y) % 11 < 2
}

fn grid() -> Arc<Grid> {
    Arc::new(Grid::from_fn(SIDE, SIDE, blocked).expect("a map"))
}

fn by(error: &Interrupted) -> Option<StoppedBy> {
    Some(error.by)
}

fn of_size(error: &SizeError) -> Option<StoppedBy> {
    if let SizeError::Interrupted(error) = error { by(error) } else { None }
}

fn of_grid(error: &GridError) -> Option<StoppedBy> {
    if let GridError::Interrupted(error) = error { by(error) } else { None }
}

#[test]
fn maps_stop() {
    // The rows, the digest, the columns.
    let least = 2 * ROWS + ROWS / 64;
    check_interrupts("a map", least, |i| Grid::from_fn_interruptible(SIDE, SIDE, i, blocked), of_grid);
    let word = |x: u32, y: u32| u64::from(x * y);
    check_interrupts("words", least, |i| Grid::from_words_interruptible(SIDE, SIDE, i, word), of_grid);
    let grid = grid();
    check_interrupts("a square", least, |i| grid.for_square_interruptible(3, i), of_size);
}

#[test]
fn components_and_gaps_stop() {
    let grid = grid();
    let components = |i: &Interrupt| Components::interruptible(&grid, Connectivity::Four, i);
    check_interrupts("components", ROWS + 2, components, by);
    let space = |i: &Interrupt| {
        FreeSpace::<Corners>::interruptible(Arc::clone(&grid), DiagonalGap::Closed, K::Any, i)
    };
    check_interrupts("a free space", 2 * ROWS, space, by);
}

#[test]
fn clearances_stop() {
    let grid = grid();
    check_interrupts("centers", ROWS, |i| grid.squared_center_distances(i), by);
    for fit in [Fit::Centers, Fit::WholeCells] {
        let measure = |i: &Interrupt| Clearance::interruptible(Arc::clone(&grid), fit, Outside::Blocked, i);
        check_interrupts("clearances", ROWS, measure, by);
        let clearance = measure(&Interrupt::NEVER).expect("nothing stops it");
        check_interrupts("a disc", 2 * ROWS, |i| clearance.for_disc_interruptible(1.5, i), of_size);
        // The radii, and the maps of a bisection.
        let search = |map: &Arc<Grid>| {
            let is_wide = map.free_cells() > 100;
            Ok::<_, Interrupted>(is_wide.then_some(()))
        };
        let widest = |i: &Interrupt| clearance.widest_interruptible(f64::INFINITY, i, search);
        check_interrupts("the widest path", 3 * ROWS, widest, by);
    }
}

#[test]
fn a_flag_comes_before_a_deadline() {
    let flag = Arc::new(AtomicBool::new(false));
    let interrupt = Interrupt::new().cancel(Arc::clone(&flag)).deadline(|| true);
    let stopped = |by| Err(Interrupted { by, during: "waiting" });
    assert_eq!(interrupt.check("waiting"), stopped(StoppedBy::Deadline));
    flag.store(true, Ordering::Relaxed);
    assert_eq!(interrupt.check("waiting"), stopped(StoppedBy::Cancelled));
    let [cancelled, late] = [StoppedBy::Cancelled, StoppedBy::Deadline]
        .map(|by| Interrupted { by, during: "measuring clearances" }.to_string());
    assert_eq!(cancelled, "cancelled while measuring clearances");
    assert_eq!(late, "out of time while measuring clearances");
    assert_eq!(Interrupt::NEVER.check("waiting"), Ok(()));
    assert_eq!(interrupt.check_every(8, 7, "waiting"), Ok(()));
    assert!(interrupt.check_every(8, 16, "waiting").is_err());
}
