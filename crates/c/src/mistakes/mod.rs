//! Hundreds of thousands of calls, right and mistaken, in random order: none does harm, no answer is wrong.
//!
//! A program of calls has a seed. Each call draws its arguments, most of them right: handles that are alive,
//! freed, null, of another kind, made up; pointers that are null or misaligned; points that are blocked,
//! outside, between vertices, no numbers; texts that mean nothing; watchers that stop, or that call the
//! library themselves. While it draws, it notes which codes the call may return. What comes back is held
//! against the oracle, which shares no code with the engines, and against what the program has made so far.
//!
//! A program can be drawn from bytes instead of a seed ([`run_bytes`]): so a fuzzer chooses each argument.
//!
//! `MEDIANT_CALLS=1000000` makes so many calls, `MEDIANT_SEED=7` begins with that program, and
//! `MEDIANT_SAY=1` names each program before it runs: after a crash the last one did it.

#![allow(unsafe_code, reason = "calls of functions of C")]
#![allow(clippy::print_stderr, reason = "seeds of programs that crash")]

mod draw;
mod fields;
mod indexes;
mod maps;
mod model;
mod planners;
mod queries;
mod spaces;
mod watchers;
mod world;

use std::{
    env,
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    thread,
};

use mediant_oracle::Rng;

use self::world::World;
use crate::about::mediant_objects;

/// Calls a function of C.
macro_rules! ask {
    ($call:expr) => {
        // SAFETY: a pointer that is drawn is null, misaligned, or leads to what the header asks for, in
        // memory that has exactly so much room; arrays that no memory can hold have counts that say so.
        unsafe { $call }
    };
}
pub(crate) use ask;

/// The number that a variable of the environment has.
fn number(name: &str) -> Option<u64> {
    env::var(name).ok().map(|text| text.parse().unwrap_or_else(|_| panic!("{name}={text}: not a number")))
}

/// The calls of a program at most: so many that its objects have a history.
const LENGTH: u64 = 400;

/// Runs the program of a seed, and returns the numbers of its calls and of those that did what they should.
fn run(seed: u64, is_alone: bool, length: u64) -> (u64, u64) {
    let name = format!("MEDIANT_SEED={seed}");
    if env::var_os("MEDIANT_SAY").is_some() {
        eprintln!("{name}");
    }
    run_drawn(Rng::new(seed), &name, is_alone, |world| world.calls < length)
}

/// Runs the program that is drawn from these bytes until they end, at most [`LENGTH`] calls: what a fuzzer
/// calls, alone in its process.
pub(crate) fn run_bytes(bytes: &[u8]) {
    let goes_on = |world: &World| world.rng.has_bytes() && world.calls < LENGTH;
    run_drawn(Rng::of_bytes(bytes), &format!("bytes {}", bytes.escape_ascii()), true, goes_on);
}

/// Runs a program as long as it goes on, and returns the numbers of its calls and of those that did what they
/// should.
fn run_drawn(rng: Rng, name: &str, is_alone: bool, goes_on: impl Fn(&World) -> bool) -> (u64, u64) {
    let mut world = World::new(rng, is_alone);
    let work = catch_unwind(AssertUnwindSafe(|| {
        while goes_on(&world) {
            step(&mut world);
            if is_alone {
                assert_eq!(mediant_objects(), world.held(), "objects");
            }
        }
        world.free_all();
        if is_alone {
            assert_eq!(mediant_objects(), 0, "objects at the end");
        }
    }));
    if let Err(broke) = work {
        let last = world.log.len().saturating_sub(40);
        eprintln!("{name}, after {} calls:\n  {}", world.calls, world.log[last..].join("\n  "));
        resume_unwind(broke);
    }
    (world.calls, world.done)
}

/// A call, of which kind follows what there is: a program makes maps before it asks for paths.
fn step(world: &mut World) {
    let (few, more) = (6, 9);
    match world.rng.below(100) {
        _ if world.maps.is_empty() => maps::make(world),
        _ if world.spaces.is_empty() => spaces::make(world),
        _ if world.indexes.is_empty() && world.rng.chance(70) => indexes::prepare(world),
        _ if world.planners.is_empty() && world.rng.chance(70) => planners::make(world),
        0..6 if world.maps.len() < more => maps::make(world),
        6..20 => maps::any(world),
        20..24 if world.spaces.len() < few => spaces::make(world),
        24..38 => spaces::any(world),
        38..42 if world.indexes.len() < more => indexes::prepare(world),
        42..56 => indexes::any(world),
        56..60 if world.planners.len() < few => planners::make(world),
        60..82 => planners::any(world),
        82..93 => fields::any(world),
        _ => world.free_any(),
    }
}

/// Programs, one after another, until so many calls are made.
fn programs(first: u64, calls: u64, is_alone: bool) -> (u64, u64) {
    let (mut made, mut done, mut seed) = (0, 0, first);
    while made < calls {
        let (of_program, right) = run(seed, is_alone, LENGTH.min(calls));
        (made, done, seed) = (made + of_program, done + right, seed + 1);
    }
    (made, done)
}

/// First alone, with all objects counted; then on threads, each with objects of its own in the same tables.
#[test]
fn no_call_does_harm_and_no_answer_is_wrong() {
    let calls = number("MEDIANT_CALLS").unwrap_or(20_000);
    let first = number("MEDIANT_SEED").unwrap_or(0);
    let (made, done) = programs(first, calls * 3 / 4, true);
    // Neither kind is seldom: a program without mistakes tests none, one of mistakes alone makes nothing.
    assert!(made < 4000 || (made / 3..made * 9 / 10).contains(&done), "{done} right calls of {made}");
    for seed in 0..20 {
        let mut rng = Rng::new(first + seed);
        let drawn: Vec<u8> = (0..100 + 20 * seed).map(|_| rng.bits() as u8).collect();
        run_bytes(&drawn);
    }
    thread::scope(|scope| {
        for number in [1, 2] {
            scope.spawn(move || programs(first + (number << 32), calls / 8, false));
        }
    });
    assert_eq!(mediant_objects(), 0, "objects of all threads");
}
