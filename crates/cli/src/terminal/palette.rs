//! The palette of terminals that have only 256 colors.

use anstyle::RgbColor as Rgb;

/// The color of the 256-color palette that is nearest: in the cube of 6 × 6 × 6 colors, or on the ramp of 24
/// grays.
pub(super) fn nearest_of_256(Rgb(r, g, b): Rgb) -> u8 {
    const LEVELS: [u8; 6] = [0, 95, 135, 175, 215, 255];
    let level = |c: u8| (0..6_u8).min_by_key(|&i| LEVELS[usize::from(i)].abs_diff(c)).unwrap_or(0);
    let distance = |(x, y, z): (u8, u8, u8)| {
        [(x, r), (y, g), (z, b)].map(|(p, q)| u32::from(p.abs_diff(q)).pow(2)).iter().sum::<u32>()
    };
    let [i, j, k] = [r, g, b].map(level);
    let cube = (LEVELS[usize::from(i)], LEVELS[usize::from(j)], LEVELS[usize::from(k)]);
    let gray_of = |n: u8| 8 + 10 * n;
    let gray = (0..24).min_by_key(|&n| distance((gray_of(n), gray_of(n), gray_of(n)))).unwrap_or(0);
    if distance((gray_of(gray), gray_of(gray), gray_of(gray))) < distance(cube) {
        232 + gray
    } else {
        16 + 36 * i + 6 * j + k
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn palette_colors_are_found() {
        let found = [Rgb(0, 0, 0), Rgb(255, 255, 255), Rgb(95, 135, 175), Rgb(38, 38, 38), Rgb(250, 3, 2)]
            .map(nearest_of_256);
        assert_eq!(found, [16, 231, 67, 235, 196]);
    }
}
