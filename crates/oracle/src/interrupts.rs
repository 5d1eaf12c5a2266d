//! A check that work stops when it is interrupted.

use std::{
    fmt,
    sync::{
        Arc,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
};

use mediant_grid::{Interrupt, StoppedBy};

/// An interrupt whose deadline is over from the question with this number on, and the number of questions
/// that were asked.
fn counting(last: usize) -> (Interrupt, Arc<AtomicUsize>) {
    let asked = Arc::new(AtomicUsize::new(0));
    let counter = Arc::clone(&asked);
    (Interrupt::new().deadline(move || counter.fetch_add(1, Ordering::Relaxed) >= last), asked)
}

/// Checks that work can be stopped anywhere. Uninterrupted, it asks at least `least` times. Stopped at the
/// first question, at 1, 10, 50, 90 % of them and at the last, it ends with an error of a deadline, as
/// `stopped_by` says, and asks no more: each thread may be told once.
///
/// # Panics
/// If it is otherwise.
pub fn check_interrupts<T, E: fmt::Debug>(
    name: &str,
    least: usize,
    work: impl Fn(&Interrupt) -> Result<T, E>,
    stopped_by: impl Fn(&E) -> Option<StoppedBy>,
) {
    let (interrupt, asked) = counting(usize::MAX);
    if let Err(error) = work(&interrupt) {
        panic!("{name}: {error:?}");
    }
    let all = asked.load(Ordering::Relaxed);
    assert!(all >= least, "{name} asks {all} times, and should at least {least} times");
    let others = thread::available_parallelism().map_or(1, usize::from);
    for last in [0, all / 100, all / 10, all / 2, all / 10 * 9, all - 1] {
        let (interrupt, asked) = counting(last);
        match work(&interrupt) {
            Ok(_) => panic!("{name} goes on after question {last} of {all}"),
            Err(error) => {
                assert_eq!(stopped_by(&error), Some(StoppedBy::Deadline), "{name}: {error:?}");
            }
        }
        let more = asked.load(Ordering::Relaxed) - last;
        assert!(more <= others + 1, "{name} asks {more} times more after question {last} of {all}");
    }
}
