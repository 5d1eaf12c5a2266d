//! Weighted maps from a seed.

use super::WeightedMap;
use crate::{Rng, suite_grid};

/// Weights of cells from their places.
type Weights<'r> = Box<dyn FnMut(u32, u32) -> u32 + 'r>;

/// The map of [`suite_grid`] for this seed with random weights, and a description of both. Blocked cells have
/// weights like the others. The kinds of weights are: one number, few numbers, several ranges, and stripes
/// and patches of two numbers. One map in three has cells that are not of size (1, 1).
#[must_use]
pub fn random_weighted(seed: u64) -> (WeightedMap, String) {
    let (grid, kind) = suite_grid(seed);
    let mut rng = Rng::new(seed ^ 0x00C0_575E_ED00);
    let sizes = [(1.0, 2.0), (2.0, 1.0), (0.5, 0.3), (30.0, 25.0), (0.1, 0.1)];
    let (x, y) = if rng.below(3) == 0 { *rng.pick(&sizes).unwrap_or(&sizes[0]) } else { (1.0, 1.0) };
    let (weight, weights) = weights(&mut rng);
    let map = WeightedMap::from_fn(grid, weight).with_cell_size(x, y);
    (map, format!("{kind} of {x} by {y}, {weights}"))
}

fn weights(rng: &mut Rng) -> (Weights<'_>, String) {
    let name = |text: &str| format!("weights {text}");
    match rng.below(10) {
        0 => (Box::new(|_, _| 1), name("1")),
        1 => {
            let number = 2 + rng.below(1000);
            (Box::new(move |_, _| number), name(&format!("{number}")))
        }
        2 => (Box::new(|_, _| [1, 2, 5][rng.below(3) as usize]), name("1, 2, 5")),
        3 => uniform(rng, 1, 9),
        4 => uniform(rng, 16, 159),
        5 => uniform(rng, 1, 65_535),
        6 => {
            let bits = [8, 16, 32][rng.below(3) as usize];
            let draw = move |_, _| {
                let power = 1 << rng.below(bits);
                power + rng.below(power)
            };
            (Box::new(draw), name(&format!("of up to {bits} bits, any number of bits as often")))
        }
        kind => two(rng, kind),
    }
}

fn uniform(rng: &mut Rng, low: u32, high: u32) -> (Weights<'_>, String) {
    (Box::new(move |_, _| low + rng.below(high - low + 1)), format!("weights {low} to {high}"))
}

/// Two numbers: stripes along rows, columns or diagonals, square patches, or single cells among others.
fn two(rng: &mut Rng, kind: u32) -> (Weights<'_>, String) {
    let low = 1 + rng.below(3);
    let high = low * [2, 10, 100, 10_000][rng.below(4) as usize];
    let (low, high) = if rng.chance(50) { (low, high) } else { (high, low) };
    let width = 1 + rng.below(4);
    match kind {
        7 => {
            let slope = [(1, 0), (0, 1), (1, 1), (1, 2)][rng.below(4) as usize];
            let is_low = move |x: u32, y: u32| ((slope.0 * x + slope.1 * y) / width).is_multiple_of(2);
            (
                Box::new(move |x, y| if is_low(x, y) { low } else { high }),
                format!("stripes {low}, {high}, {width} wide, across {slope:?}"),
            )
        }
        8 => {
            let salt = rng.bits();
            let is_low = move |x: u32, y: u32| {
                let patch = u64::from(x / width) << 32 | u64::from(y / width);
                Rng::new(salt ^ patch.wrapping_mul(0x9E37_79B9)).chance(50)
            };
            (
                Box::new(move |x, y| if is_low(x, y) { low } else { high }),
                format!("patches {low}, {high}, {width} wide"),
            )
        }
        _ => (
            Box::new(move |_, _| if rng.chance(90) { low } else { high }),
            format!("weights {low}, one in ten {high}"),
        ),
    }
}
