//! The colors of maps and paths.

use anstyle::RgbColor as Rgb;

/// What a map is drawn as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Theme {
    /// A file of which nothing is known: by its tiles.
    Plain,
    /// Free is water, blocked is land.
    Sea,
    /// Free is the floor of a cave.
    Cave,
    /// Free are the gravel paths between hedges.
    Hedges,
    /// Free are streets; blocked are houses, trees and a canal.
    Town,
}

const WATER: [Rgb; 6] = [
    Rgb(0x2a, 0x97, 0xb8),
    Rgb(0x22, 0x80, 0xa8),
    Rgb(0x1b, 0x6c, 0x98),
    Rgb(0x16, 0x5d, 0x89),
    Rgb(0x12, 0x52, 0x82),
    Rgb(0x10, 0x48, 0x7a),
];
const LAND: [Rgb; 6] = [
    Rgb(0xe2, 0xcf, 0x9c),
    Rgb(0x98, 0xbf, 0x62),
    Rgb(0x74, 0xa5, 0x51),
    Rgb(0x5a, 0x8f, 0x47),
    Rgb(0x4a, 0x7b, 0x3e),
    Rgb(0x77, 0x75, 0x58),
];
const ROCK: [Rgb; 5] = [
    Rgb(0x8d, 0x73, 0x5b),
    Rgb(0x6b, 0x56, 0x45),
    Rgb(0x50, 0x3f, 0x34),
    Rgb(0x3d, 0x30, 0x28),
    Rgb(0x2f, 0x25, 0x20),
];
const FLOOR: [Rgb; 3] = [Rgb(0x19, 0x16, 0x14), Rgb(0x20, 0x1c, 0x19), Rgb(0x26, 0x21, 0x1d)];
const HEDGE: [Rgb; 1] = [Rgb(0x4f, 0x85, 0x4a)];
const GRAVEL: [Rgb; 1] = [Rgb(0x29, 0x26, 0x20)];
const STREET: [Rgb; 1] = [Rgb(0x2c, 0x2e, 0x35)];
const ROOF: [Rgb; 2] = [Rgb(0xb8, 0x74, 0x54), Rgb(0x9c, 0x5c, 0x43)];
const TREE: [Rgb; 1] = [Rgb(0x5b, 0x96, 0x4e)];
const SWAMP: [Rgb; 1] = [Rgb(0x2c, 0x40, 0x3c)];

impl Theme {
    /// The color of free ground far from all else.
    pub(crate) const fn ground(self) -> Rgb {
        self.color(b'.', true, u32::MAX)
    }

    /// The color of a place by its tile, whether it is free, and how far it is from the next place that is not (or
    /// that is), from 1.
    pub(crate) const fn color(self, tile: u8, free: bool, depth: u32) -> Rgb {
        let colors: &[Rgb] = match (self, free, tile) {
            (Self::Sea, true, _) => &WATER,
            (Self::Sea, false, _) => &LAND,
            (Self::Cave, true, _) => &FLOOR,
            (Self::Cave, false, _) => &ROCK,
            (Self::Hedges, true, _) => &GRAVEL,
            (Self::Hedges, false, _) => &HEDGE,
            (Self::Plain, true, b'S') => &SWAMP,
            (Self::Plain | Self::Town, true, _) => &STREET,
            (Self::Plain | Self::Town, false, b'T') => &TREE,
            (Self::Plain | Self::Town, false, b'W') => &WATER,
            (Self::Town, false, _) => &ROOF,
            (Self::Plain, false, _) => &ROCK,
        };
        let i = (depth as usize).saturating_sub(1);
        // Beyond the last color, the last.
        colors[if i < colors.len() { i } else { colors.len() - 1 }]
    }
}

/// The colors of what is drawn on the map: bright, and apart from each other and from every theme.
pub(crate) struct Inks {
    pub(crate) best: Rgb,
    pub(crate) eight: Rgb,
    pub(crate) four: Rgb,
    pub(crate) start: Rgb,
    pub(crate) goal: Rgb,
}

/// See [`Inks`].
pub(crate) const INKS: Inks = Inks {
    best: Rgb(0xff, 0xff, 0xff),
    eight: Rgb(0xff, 0xd0, 0x40),
    four: Rgb(0xff, 0x9c, 0x9c),
    start: Rgb(0x7d, 0xff, 0x9a),
    goal: Rgb(0xff, 0x5c, 0x50),
};

/// The color of the 256-color palette that is nearest: in the cube of 6 × 6 × 6 colors, or on the ramp of 24 grays.
pub(crate) fn nearest_of_256(Rgb(r, g, b): Rgb) -> u8 {
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
