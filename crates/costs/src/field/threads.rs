//! The search of a field on several threads.
//!
//! Each thread owns blocks of tiles, all over the map: it alone lowers costs there, scans the states there,
//! and has a queue of its own. So no cost is written by two, and a plain store does where threads that share
//! their states would need a locked one, which keeps a core from looking ahead. All threads work on one
//! bucket at a time. A better path into another thread's block becomes a message, which that one reads when
//! all are done with the bucket: a bucket is as wide as the least move, so nothing leads from it into itself;
//! where it is wider, it is opened again.
//!
//! The costs at the end are the least that satisfy all moves, whoever found them when: the same integers as
//! on one thread.

use std::{
    hint::spin_loop,
    sync::{
        Mutex, OnceLock, PoisonError,
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
    search::{Progress, STAGE, Search},
};
use crate::{
    layout::TILE,
    scan::{Scanning, Visit},
};

/// The states between two questions of an interrupt.
const PIECE: usize = 1 << 12;
/// The side of a block, in tiles. A smaller one has more moves that leave it, of a larger one fewer lie on
/// the front.
const BLOCK: usize = 4;

/// A better path into a block of another thread: the state and its cost.
type Message = (u32, u64);
/// The messages from one thread to each.
type Outbox = Box<[Mutex<Vec<Message>>]>;

/// All that threads share.
struct Shared<'s, M> {
    moves: M,
    costs: &'s [AtomicU64],
    /// Of each tile the thread that owns it; known once all threads are there.
    owners: OnceLock<Box<[u8]>>,
    /// The messages from each thread to each.
    messages: Box<[Outbox]>,
    meeting: Meeting,
    /// For rounds in turn: the first bucket in which some thread has queued something.
    first: [AtomicU64; 3],
    limit: u64,
    /// The states that were scanned since it was told, if somebody listens.
    scanned: AtomicUsize,
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
    mut progress: Progress<'_>,
    Search { sources, limit, threads, across, interrupt, .. }: Search<'_>,
) -> Result<usize, Interrupted> {
    let threads = threads.get().min(MOST);
    // The standard library keeps the memory, there and back.
    let shared_costs: Vec<AtomicU64> = std::mem::take(costs).into_iter().map(AtomicU64::new).collect();
    let shared = Shared {
        moves,
        costs: &shared_costs,
        owners: OnceLock::new(),
        messages: (0..threads).map(|_| (0..threads).map(|_| Mutex::default()).collect()).collect(),
        meeting: Meeting {
            threads: AtomicUsize::new(usize::MAX),
            arrived: AtomicUsize::new(0),
            round: AtomicUsize::new(0),
            is_over: AtomicBool::new(false),
        },
        first: [u64::MAX; 3].map(AtomicU64::new),
        limit,
        scanned: AtomicUsize::new(0),
        interrupt,
    };
    let results: Vec<Result<usize, Interrupted>> = thread::scope(|scope| {
        let shared = &shared;
        let spawn = |number| {
            let work = move || work(shared, number, sources, None);
            thread::Builder::new().spawn_scoped(scope, work).ok()
        };
        let others: Vec<_> = (1..threads).map_while(spawn).collect();
        let there = others.len() + 1;
        let owner = |tile: usize| ((tile / across / BLOCK + tile % across / BLOCK) % there) as u8;
        shared.owners.get_or_init(|| (0..shared.costs.len().div_ceil(TILE)).map(owner).collect());
        shared.meeting.threads.store(there, Release);
        let mine = work(shared, 0, sources, Some(&mut progress));
        let others = others.into_iter().map(|other| match other.join() {
            Ok(result) => result,
            Err(panic) => std::panic::resume_unwind(panic),
        });
        std::iter::once(mine).chain(others.collect::<Vec<_>>()).collect()
    });
    let queue_bytes = results.into_iter().sum::<Result<usize, _>>()?;
    progress.adds(shared.scanned.into_inner());
    *costs = shared_costs.into_iter().map(AtomicU64::into_inner).collect();
    progress.ends();
    Ok(queue_bytes)
}

/// The most threads: their numbers are bytes.
const MOST: usize = 1 << 8;

/// The work of a thread. One of them tells the progress of all.
fn work<M: Scanning>(
    shared: &Shared<'_, M>,
    number: usize,
    sources: &[(usize, u32)],
    mut progress: Option<&mut Progress<'_>>,
) -> Result<usize, Interrupted> {
    let Shared { costs, messages, meeting, limit, interrupt, .. } = shared;
    let moves = shared.moves;
    let _ends_all = EndsAll(meeting);
    // Then the owners are known.
    if !meeting.wait() {
        return Ok(0);
    }
    let owners = shared.owners.get().map_or(&[][..], |owners| owners);
    let (least, greatest) = moves.bounds();
    let (queue, to_others) = (Buckets::new(least, greatest), vec![Vec::new(); messages.len()]);
    let mut visit = Owned { costs, owners, number: number as u8, queue, to_others };
    for &(state, _) in sources {
        if owners[state / TILE] == visit.number {
            visit.lower(state, 0);
        }
    }
    let (mut states, mut stopped) = (Vec::new(), Ok(()));
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
        states.clear();
        visit.queue.take_from(bucket, &mut states);
        for piece in states.chunks(PIECE) {
            stopped = stopped.and_then(|()| interrupt.check(STAGE));
            if stopped.is_err() {
                meeting.is_over.store(true, Release);
                break;
            }
            for &state in piece {
                let state = state as usize;
                let cost = visit.known(state);
                if visit.queue.of(cost) == bucket {
                    moves.scan((state, cost), &mut visit);
                }
            }
            if interrupt.is_heard() {
                let is_done = |&&state: &&u32| visit.queue.of(visit.known(state as usize)) == bucket;
                shared.scanned.fetch_add(piece.iter().filter(is_done).count(), Relaxed);
            }
        }
        if let Some(progress) = progress.as_mut().filter(|progress| progress.is_heard()) {
            progress.adds(shared.scanned.swap(0, Relaxed));
        }
        visit.send(&messages[number]);
        if !meeting.wait() {
            break;
        }
        messages.iter().for_each(|from| visit.read(&from[number]));
    }
    let of_messages: usize = messages[number]
        .iter()
        .map(|to| to.lock().unwrap_or_else(PoisonError::into_inner).capacity() * size_of::<Message>())
        .sum();
    stopped.map(|()| visit.queue.memory_bytes() + of_messages)
}

/// Costs, of which a thread lowers those in its own blocks.
struct Owned<'s> {
    costs: &'s [AtomicU64],
    owners: &'s [u8],
    number: u8,
    queue: Buckets,
    /// Messages to each thread.
    to_others: Vec<Vec<Message>>,
}

impl Owned<'_> {
    /// Hands the messages over.
    fn send(&mut self, to: &[Mutex<Vec<Message>>]) {
        for (to, mine) in to.iter().zip(&mut self.to_others).filter(|(_, mine)| !mine.is_empty()) {
            // The other one has emptied it.
            std::mem::swap(&mut *to.lock().unwrap_or_else(PoisonError::into_inner), mine);
        }
    }

    fn read(&mut self, messages: &Mutex<Vec<Message>>) {
        for (state, cost) in messages.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
            self.lower(state as usize, cost);
        }
    }

    /// Lowers the cost of a state of this thread, if the new one is less.
    #[inline]
    fn lower(&mut self, state: usize, cost: u64) {
        let before = self.costs[state].load(Relaxed);
        if cost < before {
            self.costs[state].store(cost, Relaxed);
            self.queue.push(state, cost, before);
        }
    }
}

impl Visit for Owned<'_> {
    /// That of another thread's state may be less by now; a message too many does no harm.
    #[inline]
    fn known(&self, to: usize) -> u64 {
        self.costs[to].load(Relaxed)
    }

    #[inline]
    fn relax(&mut self, _: usize, to: usize, cost: u64) {
        let owner = self.owners[to / TILE];
        if owner == self.number {
            self.lower(to, cost);
        } else {
            self.to_others[owner as usize].push((to as u32, cost));
        }
    }
}
