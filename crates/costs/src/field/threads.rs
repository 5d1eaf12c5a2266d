//! The search of a field on several threads.
//!
//! All threads work on one bucket at a time. Each has a queue of its own, and shares the states of its
//! current bucket with the others, by pieces, so that none waits long. A cost is lowered by compare-and-swap.
//! The costs at the end are the least that satisfy all moves, whoever found them when: the same integers as
//! on one thread.

use std::{
    hint::spin_loop,
    sync::{
        RwLock,
        atomic::{
            AtomicBool, AtomicU64, AtomicUsize,
            Ordering::{AcqRel, Acquire, Relaxed, Release},
        },
    },
    thread,
};

use mediant_grid::{Interrupt, Interrupted};

use super::{
    buckets::Buckets,
    search::{STAGE, Search},
};
use crate::scan::{Scanning, Visit};

/// The states that a thread takes at a time.
const PIECE: usize = 256;

/// All that threads share.
struct Shared<'s, M> {
    moves: M,
    costs: &'s [AtomicU64],
    /// For each thread the states of its current bucket, and how many of them are taken.
    states: Box<[(RwLock<Vec<u32>>, AtomicUsize)]>,
    meeting: Meeting,
    /// For rounds in turn: the first bucket in which some thread has queued something.
    first: [AtomicU64; 3],
    limit: u64,
    interrupt: &'s Interrupt,
}

/// A place where threads wait for one another.
struct Meeting {
    threads: AtomicUsize,
    arrived: AtomicUsize,
    round: AtomicUsize,
    is_over: AtomicBool,
}

impl Meeting {
    /// Waits for all others. Returns whether the work goes on.
    fn wait(&self) -> bool {
        let round = self.round.load(Acquire);
        if self.arrived.fetch_add(1, AcqRel) + 1 == self.threads.load(Acquire) {
            self.arrived.store(0, Release);
            self.round.fetch_add(1, AcqRel);
        } else {
            let mut turns = 0_u32;
            while self.round.load(Acquire) == round && !self.is_over.load(Acquire) {
                turns += 1;
                // A core may be needed for another thread of the meeting.
                if turns.is_multiple_of(1 << 10) { thread::yield_now() } else { spin_loop() }
            }
        }
        !self.is_over.load(Acquire)
    }
}

/// Ends the work of the others when a thread ends in the middle of it.
struct EndsAll<'s>(&'s Meeting);

impl Drop for EndsAll<'_> {
    fn drop(&mut self) {
        self.0.is_over.store(true, Release);
    }
}

/// Dijkstra's algorithm from states of cost 0, up to a limit, on so many threads. Fewer, if no more can be
/// had. Returns the memory of the queues, in bytes.
pub(super) fn run<M: Scanning>(
    moves: M,
    costs: &mut Vec<u64>,
    Search { sources, limit, threads, interrupt, .. }: Search<'_>,
) -> Result<usize, Interrupted> {
    // The standard library keeps the memory, there and back.
    let shared_costs: Vec<AtomicU64> = std::mem::take(costs).into_iter().map(AtomicU64::new).collect();
    let shared = Shared {
        moves,
        costs: &shared_costs,
        states: (0..threads.get()).map(|_| Default::default()).collect(),
        meeting: Meeting {
            threads: AtomicUsize::new(usize::MAX),
            arrived: AtomicUsize::new(0),
            round: AtomicUsize::new(0),
            is_over: AtomicBool::new(false),
        },
        first: [u64::MAX; 3].map(AtomicU64::new),
        limit,
        interrupt,
    };
    let results: Vec<Result<usize, Interrupted>> = thread::scope(|scope| {
        let shared = &shared;
        let spawn = |number| {
            let work = move || work(shared, number, &[]);
            thread::Builder::new().spawn_scoped(scope, work).ok()
        };
        let others: Vec<_> = (1..threads.get()).map_while(spawn).collect();
        shared.meeting.threads.store(others.len() + 1, Release);
        let mine = work(shared, 0, sources);
        let others = others.into_iter().map(|other| match other.join() {
            Ok(result) => result,
            Err(panic) => std::panic::resume_unwind(panic),
        });
        std::iter::once(mine).chain(others.collect::<Vec<_>>()).collect()
    });
    *costs = shared_costs.into_iter().map(AtomicU64::into_inner).collect();
    results.into_iter().sum()
}

/// The work of a thread.
fn work<M: Scanning>(
    shared: &Shared<'_, M>,
    number: usize,
    sources: &[(usize, u32)],
) -> Result<usize, Interrupted> {
    let Shared { costs, states, meeting, limit, interrupt, .. } = shared;
    let moves = shared.moves;
    let _ends_all = EndsAll(meeting);
    let (least, greatest) = moves.bounds();
    let mut visit = Lowering { costs, queue: Buckets::new(least, greatest) };
    for &(state, _) in sources {
        visit.relax(0, state, 0);
    }
    let mut stopped = Ok(());
    for round in 0_usize.. {
        let [first, after_next] = [round, round + 2].map(|round| &shared.first[round % 3]);
        first.fetch_min(visit.queue.first().unwrap_or(u64::MAX), AcqRel);
        if !meeting.wait() {
            break;
        }
        let bucket = first.load(Acquire);
        if bucket == u64::MAX || visit.queue.start_of(bucket) > *limit {
            break;
        }
        // All have left the round before, which read it, and none has begun the next.
        after_next.store(u64::MAX, Release);
        let (mine, taken) = &states[number];
        if let Ok(mut mine) = mine.write() {
            mine.clear();
            visit.queue.take_from(bucket, &mut mine);
            taken.store(0, Release);
        }
        if !meeting.wait() {
            break;
        }
        for other in 0..states.len() {
            let (theirs, taken) = &states[(number + other) % states.len()];
            let Ok(theirs) = theirs.read() else { continue };
            while let Some(piece) = next_piece(&theirs, taken) {
                stopped = stopped.and_then(|()| interrupt.check(STAGE));
                if stopped.is_err() {
                    meeting.is_over.store(true, Release);
                }
                for &state in piece {
                    let state = state as usize;
                    let cost = costs[state].load(Relaxed);
                    if visit.queue.of(cost) == bucket {
                        moves.scan((state, cost), &mut visit);
                    }
                }
            }
        }
    }
    stopped.map(|()| visit.queue.memory_bytes())
}

/// Takes the next states of a list.
fn next_piece<'s>(states: &'s [u32], taken: &AtomicUsize) -> Option<&'s [u32]> {
    let from = taken.fetch_add(PIECE, AcqRel);
    states.get(from..states.len().min(from + PIECE)).filter(|piece| !piece.is_empty())
}

/// Costs that several threads lower, with the queue of one.
struct Lowering<'s> {
    costs: &'s [AtomicU64],
    queue: Buckets,
}

impl Visit for Lowering<'_> {
    #[inline]
    fn known(&self, to: usize) -> u64 {
        self.costs[to].load(Relaxed)
    }

    #[inline]
    fn relax(&mut self, _: usize, to: usize, cost: u64) {
        let before = self.costs[to].fetch_min(cost, Relaxed);
        // Of several threads that find the same cost, the first one queues it.
        if cost < before {
            self.queue.push(to, cost, before);
        }
    }
}
