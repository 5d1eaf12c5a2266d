//! The colors of maps and paths.

use anstyle::RgbColor as Rgb;

/// The scenery of a map, which decides its colors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Theme {
    /// Unknown: each tile has the color of its kind.
    Plain,
    /// Free cells are water, blocked cells are land.
    Sea,
    /// Free cells are the floor of a cave, blocked cells are rock.
    Cave,
    /// Free cells are gravel paths, blocked cells are hedges.
    Hedges,
    /// Free cells are streets; blocked cells are houses, trees and a canal.
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
    /// The color of free ground far from blocked ground.
    pub(crate) const fn ground(self) -> Rgb {
        self.color(b'.', true, u32::MAX)
    }

    /// The color of ground by its tile, by whether it is free, and by its depth: its distance, from 1 up,
    /// from the nearest ground of the other kind.
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
        // The last color serves all greater depths.
        colors[if i < colors.len() { i } else { colors.len() - 1 }]
    }
}

/// The ends of the scale of costs and elevations, on which bright lines are seen.
const SCALE: [Rgb; 2] = [Rgb(0x16, 0x26, 0x2e), Rgb(0x9a, 0x62, 0x2c)];

/// The color of a share from 0 to 1.
pub(super) fn of_share(share: f64) -> Rgb {
    let [Rgb(r, g, b), end] = SCALE;
    let mix = |from: u8, to: u8| (f64::from(from) + (f64::from(to) - f64::from(from)) * share).round() as u8;
    Rgb(mix(r, end.0), mix(g, end.1), mix(b, end.2))
}

/// The colors of what is drawn on the map: bright, and unlike each other and the colors of every theme.
pub(crate) struct Inks {
    /// The path of a run, and of k = ∞ in the demo.
    pub(crate) best: Rgb,
    /// The path of k = 3 in the demo.
    pub(crate) eight: Rgb,
    /// The path of k = 2 in the demo.
    pub(crate) four: Rgb,
    pub(crate) start: Rgb,
    pub(crate) goal: Rgb,
}

/// The colors of what is drawn on the map.
pub(crate) const INKS: Inks = Inks {
    best: Rgb(0xff, 0xff, 0xff),
    eight: Rgb(0xff, 0xd0, 0x40),
    four: Rgb(0xff, 0x9c, 0x9c),
    start: Rgb(0x7d, 0xff, 0x9a),
    goal: Rgb(0xff, 0x5c, 0x50),
};
