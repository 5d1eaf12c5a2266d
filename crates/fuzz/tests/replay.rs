//! All kept inputs and all seeds, and changed ones by seed: what libFuzzer does, without its coverage.
//!
//! `MEDIANT_GRIDS=20x` changes each input so many times as often.

use mediant_fuzz::{TARGETS, Target, kept, seeds};
use mediant_oracle::Rng;

/// Changed inputs of each seed and each kept input; of a program, which takes a thousand times as long,
/// fewer.
const CHANGES: (u64, u64) = (300, 40);
/// The most bytes of one kept input, and of all together: they are in the history for ever.
const MOST_BYTES: (usize, usize) = (1024, 600_000);
/// The kept inputs of each target, as `cargo xtask fuzz --keep` tells: so none is left out unseen.
const KEPT: &[(&str, usize)] = &[
    ("sequence", 60),
    ("sequence-costs", 60),
    ("c-calls", 60),
    ("map", 60),
    ("picture", 60),
    ("ros", 60),
    ("raster", 60),
    ("scenario", 60),
    ("questions", 60),
    ("words", 60),
    ("serialized", 60),
    ("numbers", 60),
    ("index-file", 52),
    ("index", 60),
];

fn times() -> u64 {
    let times = std::env::var("MEDIANT_GRIDS").ok();
    times.and_then(|times| times.strip_suffix('x')?.parse().ok()).unwrap_or(1)
}

/// Runs a target; the bytes are in the message of a panic.
fn run(target: &Target, data: &[u8], from: &str) {
    let result = std::panic::catch_unwind(|| (target.run)(data));
    assert!(result.is_ok(), "{}, {from}: {}", target.name, data.escape_ascii());
}

fn changed(rng: &mut Rng, data: &[u8], other: &[u8]) -> Vec<u8> {
    let mut data = data.to_vec();
    for _ in 0..=rng.below(4) {
        let at = rng.below(data.len() as u32 + 1) as usize;
        match rng.below(6) {
            0 => drop(data.splice(at..at, [rng.bits() as u8])),
            1 => data.truncate(at),
            2 => data.truncate(data.len().saturating_sub(1)),
            3 => data.splice(at.., other[at.min(other.len())..].iter().copied()).for_each(drop),
            4 => {
                if let Some(byte) = data.get_mut(at) {
                    *byte = [0, 1, 127, 128, 255, b'9', b'-', b'\n'][rng.below(8) as usize];
                }
            }
            _ => {
                if let Some(byte) = data.get_mut(at) {
                    *byte ^= 1 << rng.below(8);
                }
            }
        }
    }
    data
}

#[test]
fn inputs_and_changed_ones_are_treated_rightly() {
    for target in TARGETS {
        let named = kept(target).into_iter().map(|(name, data)| (format!("corpus/{name}"), data));
        let own = seeds(target).into_iter().enumerate().map(|(at, data)| (format!("seed {at}"), data));
        let inputs: Vec<(String, Vec<u8>)> = named.chain(own).collect();
        assert!(!inputs.is_empty(), "{} has no input", target.name);
        for (at, (name, data)) in (0_u64..).zip(&inputs) {
            run(target, data, name);
            let is_program = target.name.starts_with("sequence") || target.name == "c-calls";
            let changes = if is_program { CHANGES.1 } else { CHANGES.0 };
            for change in 0..changes * times() {
                let mut rng = Rng::new(at << 32 | change);
                let other = rng.pick(&inputs).map_or(&[][..], |(_, other)| other);
                run(target, &changed(&mut rng, data, other), &format!("{name}, change {change}"));
            }
        }
    }
}

#[test]
fn all_kept_inputs_are_there() {
    let found: Vec<_> = TARGETS.iter().map(|target| (target.name, kept(target).len())).collect();
    assert_eq!(found, KEPT);
}

#[test]
fn kept_inputs_are_few_and_small() {
    let all: Vec<(String, Vec<u8>)> = TARGETS.iter().flat_map(kept).collect();
    let bytes: usize = all.iter().map(|(_, data)| data.len()).sum();
    assert!(bytes <= MOST_BYTES.1, "{bytes} bytes of inputs");
    for (name, data) in &all {
        assert!(data.len() <= MOST_BYTES.0, "{name}: {} bytes", data.len());
    }
}
