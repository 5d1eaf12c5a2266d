//! An index is in memory once, however many planners share it; a planner takes its scratch memory alone.
#![allow(unsafe_code, reason = "a counting allocator implements an unsafe trait")]

use std::{
    alloc::{GlobalAlloc, Layout, System},
    sync::{
        Arc,
        atomic::{AtomicUsize, Ordering},
    },
};

use mediant::{
    Change, Engine, Error, ErrorCode, FiniteK, Index, K, Limits, Map, Motion, Planner, Query, Rules, Space,
    options::{ConfiguredEngine, Levels},
};

/// The bytes that are allocated, by all threads.
static BYTES: AtomicUsize = AtomicUsize::new(0);
/// The bytes that were ever allocated.
static EVER: AtomicUsize = AtomicUsize::new(0);
/// The bytes of the largest piece that can be had.
static ROOM: AtomicUsize = AtomicUsize::new(usize::MAX);

struct Counting;

// SAFETY: every call goes to the system's allocator unchanged, or fails as an allocator may; the count
// touches no heap memory.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if layout.size() > ROOM.load(Ordering::Relaxed) {
            return std::ptr::null_mut();
        }
        BYTES.fetch_add(layout.size(), Ordering::Relaxed);
        EVER.fetch_add(layout.size(), Ordering::Relaxed);
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        BYTES.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: the caller keeps the contract of `dealloc`, and `at` came from `System`.
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

const SIDE: u32 = 256;
const THREADS: usize = 8;
/// Bytes of a planner besides: its open list.
const SLACK: usize = 20 << 10;
/// Bytes of a planner that do not depend on the map.
const OWN: usize = 48 << 10;

/// The result of `make`, and the bytes that it keeps allocated.
fn kept<T>(make: impl FnOnce() -> T) -> (T, usize) {
    let before = BYTES.load(Ordering::Relaxed);
    let made = make();
    (made, BYTES.load(Ordering::Relaxed) - before)
}

/// Eight planners, each warmed by a thread of its own.
fn planners(index: &mediant::Index) -> Vec<Planner> {
    let mut planners: Vec<Planner> = (0..THREADS).map(|_| index.planner()).collect();
    std::thread::scope(|scope| {
        for planner in &mut planners {
            scope.spawn(move || {
                for goal in [(250, 3), (3, 250), (250, 250)] {
                    let answer = planner.find(Query::new((0, 0), goal)).expect("both ends are free");
                    assert!(answer.path().is_some());
                }
            });
        }
    });
    planners
}

/// The bytes that a space and an index that prepares nothing allocate on a small map, with what they free.
fn allocated(width: u32, motion: Motion) -> usize {
    let map = Map::from_fn(width, 4, |x, y| (x, y) == (1, 2)).expect("a map");
    let before = EVER.load(Ordering::Relaxed);
    let index = map.space(motion).and_then(|space| space.prepare(Engine::AStar)).expect("every motion");
    let bytes = EVER.load(Ordering::Relaxed) - before;
    assert!(index.try_planner().is_ok());
    bytes
}

/// The tables that depend on the motion alone are made for the first map of the process.
fn only_the_first_map_makes_tables() {
    for k in (2..=12).map(|k| FiniteK::new(k).expect("k is at least 2")) {
        for motion in Rules::ALL.map(|rules| Motion::new(k, rules)) {
            let (first, second) = (allocated(4, motion), allocated(60, motion));
            // The moves with their offsets, a copy of the costs, and the least that every map takes.
            let moves = 1 << k.get();
            let own = 16 * moves + 8 * (moves / 4 + 1) + 2560;
            assert!(second <= own, "{motion}: {second} bytes, at most {own}");
            let tables = 20 * moves;
            assert!(first >= second + tables, "{motion}: {first} bytes, then {second}");
        }
    }
}

/// One test: the count is of the whole program.
#[test]
fn eight_planners_share_one_index() {
    only_the_first_map_makes_tables();
    // A cell in sixteen is blocked, so that every engine has much to prepare.
    let map = Map::from_fn(SIDE, SIDE, |x, y| x % 4 == 1 && y % 4 == 2).expect("a map");
    let vertices = (SIDE * SIDE) as usize;
    // Bytes of scratch memory a vertex. A planner with a copy of its index would need more.
    for (engine, motion, scratch) in [
        (Engine::AStar, Motion::centers(K::N8), 16),
        (Engine::Canonical, Motion::centers(K::N32), 16),
        (Engine::Jps, Motion::centers(K::N8), 24),
        (Engine::JpsBlock, Motion::centers(K::N8), 24),
        (Engine::JpsPlus, Motion::centers(K::N8), 24),
        (Engine::Subgoal, Motion::centers(K::N8), 16),
        (Engine::Subgoal, Motion::centers(K::N4), 16),
        (Engine::Hpa, Motion::centers(K::N8), 6),
        (Engine::Chpa, Motion::centers(K::N8), 19),
        (Engine::Theta, Motion::centers(K::N8), 26),
        (Engine::LazyTheta, Motion::centers(K::N8), 26),
        // 16 for each cell of the tiles, which have a frame.
        (Engine::Landmarks, Motion::centers(K::N8), 21),
        (Engine::Wavefront, Motion::centers(K::N8), 20),
        // Nodes and blocks of roots, which follow the search, not the map.
        (Engine::Anya, Motion::corners(K::ANY), 16),
        (Engine::Anya, Motion::corners(K::N16), 24),
    ] {
        let (space, bytes) = kept(|| map.space(motion).expect("a space"));
        let stated = space.memory_bytes() as usize;
        assert!(
            stated <= bytes + 4096 && bytes <= stated + stated / 8 + 8192,
            "{motion}: a space is said to take {stated} bytes, and takes {bytes}"
        );
        space.make_ready(engine).expect("it takes the motion");
        let mut configured = ConfiguredEngine::from(engine);
        if let ConfiguredEngine::Subgoal(own) = &mut configured {
            // Left to itself, it keeps nothing of such a map.
            own.levels = Some(Levels::Contracted);
        }
        let (index, bytes) = kept(|| space.prepare(configured).expect("an index"));
        let stated = index.memory_bytes() as usize;
        assert!(
            stated <= bytes + 4096 && bytes <= stated + stated / 8 + 8192,
            "{engine}: {stated} of {bytes}"
        );

        let (planner, of_one) = kept(|| index.planner());
        let stated = index.scratch_bytes() as usize;
        assert!(
            stated <= of_one && of_one <= stated + OWN,
            "{engine}: a planner is said to take {stated} bytes, and takes {of_one}"
        );
        drop(planner);
        let stated = index.memory_bytes() as usize;

        let (shared, of_eight) = kept(|| planners(&index));
        let most = THREADS * (scratch * vertices + SLACK);
        assert!(of_eight <= most, "{engine}: {of_eight} bytes of eight planners, at most {most}");
        assert_eq!(index.memory_bytes() as usize, stated, "{engine}");
        println!(
            "{engine}, {motion}: index {bytes} bytes once, {} each of {THREADS} planners",
            of_eight / THREADS
        );
        // Clones share it too, and the last one that goes frees it.
        let (_clones, of_clones) = kept(|| vec![index.clone(); 64]);
        assert!(of_clones < 64 * 512, "{engine}: {of_clones}");
        drop(shared);
        follows_in_its_memory(&space, &index);
        is_refused(&space, configured, &index);
        keeps_nothing_once_stopped(&space, configured);
    }
}

/// A planner that follows to the map after an edit and back takes no more memory than the paths of its
/// queries: its open list is warm, and so are the pages that it touches.
fn follows_in_its_memory(space: &Space, index: &Index) {
    // A cell that is blocked, so that no subgoal is added.
    let change = space.edit_cells([((1, 2), false)]).expect("a cell of the map");
    let edited = index.repair(&change).expect("its own change");
    let back = Change::between(edited.space(), space).expect("the same motion");
    let index = edited.repair(&back).expect("its own change");
    let (engine, mut planner) = (index.searched_by(), index.planner());
    let turn = |planner: &mut Planner| {
        for next in [&edited, &index] {
            planner.follow(next).expect("the same setup");
            let answer = planner.find(Query::new((0, 0), (250, 250))).expect("both ends are free");
            assert!(answer.path().is_some());
        }
    };
    (0..2).for_each(|_| turn(&mut planner));
    let before = EVER.load(Ordering::Relaxed);
    turn(&mut planner);
    let bytes = EVER.load(Ordering::Relaxed) - before;
    assert!(bytes < SLACK, "{engine}: {bytes} bytes for following twice");
}

/// Preparing again, stopped at 10, 50 and 90 % of its questions, keeps no memory.
fn keeps_nothing_once_stopped(space: &Space, engine: ConfiguredEngine) {
    let asked = Arc::new(AtomicUsize::new(0));
    let stop_after = |questions: usize| {
        let counter = Arc::clone(&asked);
        asked.store(0, Ordering::Relaxed);
        Limits::new().deadline(move || counter.fetch_add(1, Ordering::Relaxed) >= questions)
    };
    assert!(space.within(stop_after(usize::MAX)).prepare(engine).is_ok());
    let all = asked.load(Ordering::Relaxed);
    // An engine that prepares nothing asks nothing.
    for questions in [10, 50, 90].map(|percent| all * percent / 100).into_iter().filter(|_| all > 0) {
        let limits = stop_after(questions);
        let before = BYTES.load(Ordering::Relaxed);
        let code = space.within(&limits).prepare(engine).map_err(|error| error.code()).err();
        let more = BYTES.load(Ordering::Relaxed).saturating_sub(before);
        assert_eq!(code, Some(ErrorCode::Stopped), "{}", engine.kind());
        // Threads of a pool keep their queues.
        assert!(more < 64 << 10, "{}: {more} bytes after question {questions} of {all}", engine.kind());
    }
}

/// Where memory is short, a planner is refused, and so is an index whose size is known.
fn is_refused(space: &Space, engine: ConfiguredEngine, index: &Index) {
    let short = |bytes: u64, work: &mut dyn FnMut() -> Result<(), Error>| {
        ROOM.store(bytes as usize - 1, Ordering::Relaxed);
        let refused = work();
        ROOM.store(usize::MAX, Ordering::Relaxed);
        let error = refused.expect_err("there is no room");
        assert_eq!(error.code(), ErrorCode::Memory, "{}: {error}", engine.kind());
        assert!(error.to_string().contains("no room for the "), "{error}");
    };
    if index.scratch_bytes() > SLACK as u64 {
        short(index.scratch_bytes(), &mut || index.try_planner().map(drop));
    }
    assert!(index.try_planner().is_ok());
    if let Engine::JpsBlock | Engine::JpsPlus = engine.kind() {
        short(2 * u64::from(SIDE * SIDE), &mut || space.prepare(engine).map(drop));
    }
    if engine.kind() == Engine::Anya {
        short(u64::from(SIDE * SIDE / 2), &mut || space.prepare(engine).map(drop));
    }
}
