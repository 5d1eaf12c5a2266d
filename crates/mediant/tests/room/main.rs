//! Memory that grows with the map is asked for before it is taken: where there is no room, a call returns an
//! error, and nothing aborts. Each call is made in a program of its own, since an allocation that fails
//! without being asked for ends the program.
#![allow(unsafe_code, reason = "an allocator with a limit implements an unsafe trait")]
#![allow(clippy::print_stdout, reason = "the program of a case tells by it how that ended")]

mod cases;

use std::{
    alloc::{GlobalAlloc, Layout, System},
    process::Command,
    sync::{
        Mutex,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
};

use mediant::ErrorCode;

use self::cases::Case;

/// The bytes of all large pieces that are allocated, by all threads.
static BYTES: AtomicUsize = AtomicUsize::new(0);
/// The most bytes of large pieces that there are.
static LIMIT: AtomicUsize = AtomicUsize::new(usize::MAX);
/// Smaller pieces can always be had, and are not counted.
static LARGE: AtomicUsize = AtomicUsize::new(64 << 10);
/// The bytes after each large piece.
static HEIGHTS: Mutex<Vec<usize>> = Mutex::new(Vec::new());
static IS_WATCHED: AtomicBool = AtomicBool::new(false);

struct Limited;

/// The bytes that count.
fn counted(size: usize) -> usize {
    if size >= LARGE.load(Ordering::Relaxed) { size } else { 0 }
}

// SAFETY: every call goes to the system's allocator unchanged, or fails as an allocator may; there is room in
// `HEIGHTS` for what is added.
unsafe impl GlobalAlloc for Limited {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if counted(layout.size()) > 0 {
            let bytes = BYTES.load(Ordering::Relaxed).saturating_add(layout.size());
            if bytes > LIMIT.load(Ordering::Relaxed) {
                return std::ptr::null_mut();
            }
            BYTES.store(bytes, Ordering::Relaxed);
            if IS_WATCHED.load(Ordering::Relaxed)
                && let Ok(mut heights) = HEIGHTS.lock()
                && heights.len() < heights.capacity()
            {
                heights.push(bytes);
            }
        }
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        BYTES.fetch_sub(counted(layout.size()), Ordering::Relaxed);
        // SAFETY: the caller keeps the contract of `dealloc`, and `at` came from `System`.
        unsafe { System.dealloc(at, layout) }
    }

    /// A piece shrinks where it is. It grows by a copy, for which both must have room.
    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if size <= layout.size() {
            BYTES.fetch_sub(counted(layout.size()) - counted(size), Ordering::Relaxed);
            // SAFETY: the caller keeps the contract of `realloc`, and `at` came from `System`.
            return unsafe { System.realloc(at, layout, size) };
        }
        // SAFETY: the caller promises that the size is one for this alignment.
        let new = unsafe { self.alloc(Layout::from_size_align_unchecked(size, layout.align())) };
        if !new.is_null() {
            // SAFETY: both pieces have as many bytes as the old one, which the caller gives up.
            unsafe {
                std::ptr::copy_nonoverlapping(at, new, layout.size());
                self.dealloc(at, layout);
            }
        }
        new
    }
}

#[global_allocator]
static LIMITED: Limited = Limited;

/// The bytes that count as allocated before: more than is freed of them.
const BASE: usize = 1 << 30;
/// The case of a program, and the most bytes beyond those before.
const ASKED: &str = "MEDIANT_ROOM";
/// The limits that are tried of each case, unless `MEDIANT_EXHAUSTIVE` is set.
const LIMITS: usize = 2;

#[test]
fn what_grows_with_the_map_is_asked_for_first() {
    if let Ok(asked) = std::env::var(ASKED) {
        return in_this_program(&asked);
    }
    let most = if std::env::var_os("MEDIANT_EXHAUSTIVE").is_some() { usize::MAX } else { LIMITS };
    let (mut refused, mut faults) = (0, Vec::new());
    for name in cases::names() {
        let (_, text) = in_a_program(&format!("{name}/"));
        let heights = text.lines().find_map(|line| line.strip_prefix("heights"));
        let heights = heights.unwrap_or_else(|| panic!("{name}: {text}")).split_whitespace();
        let mut heights: Vec<usize> = heights.map(|word| word.parse().expect("a number")).collect();
        heights.sort_unstable();
        heights.dedup();
        let step = heights.len().div_ceil(most).max(1);
        for height in heights.into_iter().rev().step_by(step) {
            let (is_whole, text) = in_a_program(&format!("{name}/{}", height - 1));
            refused += usize::from(text.contains("refused: "));
            if !is_whole {
                faults.push(format!("{name}, less than {height} bytes: {text}"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    println!("{refused} calls were refused");
    assert!(refused > 40, "{refused}");
}

/// Runs a case in a program of its own. Returns whether that ended well, and what it printed.
fn in_a_program(asked: &str) -> (bool, String) {
    let program = std::env::current_exe().expect("the test's program");
    let output = Command::new(program)
        .args(["--exact", "what_grows_with_the_map_is_asked_for_first", "--nocapture"])
        .env(ASKED, asked)
        .output()
        .expect("it runs");
    let text = [output.stdout, output.stderr].concat();
    (output.status.success(), String::from_utf8_lossy(&text).into_owned())
}

/// A case without a limit prints the heights of its memory; one with a limit must end, or be refused.
fn in_this_program(asked: &str) {
    let (name, bytes) = asked.rsplit_once('/').expect("a name and bytes");
    let Case { least, work } = cases::ready(name);
    *HEIGHTS.lock().expect("no panics") = Vec::with_capacity(1 << 16);
    // Before anything that counts is freed.
    LARGE.store(least, Ordering::Relaxed);
    BYTES.store(BASE, Ordering::Relaxed);
    if bytes.is_empty() {
        IS_WATCHED.store(true, Ordering::Relaxed);
        let result = work();
        IS_WATCHED.store(false, Ordering::Relaxed);
        result.unwrap_or_else(|error| panic!("{name}: {error}"));
        let heights = HEIGHTS.lock().expect("no panics").clone();
        let heights: Vec<String> = heights.iter().map(|height| (height - BASE).to_string()).collect();
        println!("\nheights {}", heights.join(" "));
        return;
    }
    LIMIT.store(BASE + bytes.parse::<usize>().expect("a number"), Ordering::Relaxed);
    let result = work();
    LIMIT.store(usize::MAX, Ordering::Relaxed);
    if let Err(error) = result {
        assert_eq!(error.code(), ErrorCode::Memory, "{name}: {error}");
        println!("refused: {error}");
    }
}
