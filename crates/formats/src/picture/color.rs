//! The colors of pictures.

/// Red, green, blue.
pub(super) type Rgb = [u8; 3];

pub(super) const PAGE: Rgb = [0xff, 0xff, 0xff];
pub(super) const FREE: Rgb = [0xff, 0xff, 0xff];
pub(super) const WALL: Rgb = [0x8c, 0x95, 0x9f];
/// Walls between colors, darker than all of them.
pub(super) const WALL_IN_FIELD: Rgb = [0x3d, 0x44, 0x4d];
pub(super) const INK: Rgb = [0x1f, 0x23, 0x28];
pub(super) const FRAME: Rgb = [0x81, 0x8b, 0x98];

/// How much ink is in grid lines and in contour lines, of 255.
pub(super) const GRID_LINE: u8 = 26;
pub(super) const CONTOUR: u8 = 70;
/// How much of the page is in the rim of a path.
pub(super) const RIM: u8 = 200;
/// How much of a path's color is in the way of an agent.
pub(super) const WAY: u8 = 60;

/// The colors of paths: those of Okabe and Ito, but yellow is darker and black lighter, to
/// be visible on white and on dark pages.
pub(super) const PATHS: [Rgb; 8] = [
    [0x00, 0x72, 0xb2],
    [0xd5, 0x5e, 0x00],
    [0x00, 0x9e, 0x73],
    [0xcc, 0x79, 0xa7],
    [0xe6, 0x9f, 0x00],
    [0x56, 0xb4, 0xe9],
    [0x59, 0x63, 0x6e],
    [0xb3, 0xa5, 0x00],
];

/// Paths over the colors of a field or of what was searched, which hold most blues and greens.
pub(super) const PATHS_IN_FIELD: [Rgb; 8] = [
    [0xd5, 0x2b, 0x1e],
    [0x00, 0x00, 0x00],
    [0xff, 0x7a, 0x00],
    [0xc0, 0x2f, 0x8f],
    [0x00, 0x72, 0xb2],
    [0xff, 0xc2, 0x0a],
    [0x00, 0x5f, 0x46],
    [0x7a, 0x4a, 0x1e],
];

/// The colors of vertices expanded first and last, and of open ones.
const EXPANDED: [Rgb; 2] = [[0xdc, 0xee, 0xf9], [0x7d, 0xb8, 0xdf]];
pub(super) const OPEN: Rgb = [0xff, 0xce, 0x7a];

/// The scale of a field: through all hues from yellow to purple, while the lightness falls steadily from 0.96
/// to 0.40 (in OKLab), so that the order of values is seen without hues. In between it is linear.
pub(super) const SCALE: [Rgb; 17] = [
    [250, 241, 199],
    [230, 233, 182],
    [207, 226, 170],
    [181, 219, 162],
    [152, 212, 160],
    [120, 204, 161],
    [84, 195, 166],
    [41, 185, 172],
    [8, 172, 176],
    [5, 158, 177],
    [7, 143, 178],
    [9, 129, 180],
    [25, 113, 182],
    [51, 96, 174],
    [66, 80, 163],
    [75, 64, 148],
    [80, 49, 130],
];

/// The color of a field at `t` from 0 to 1.
pub(super) fn of_field(t: f32) -> Rgb {
    let at = t.clamp(0.0, 1.0) * (SCALE.len() - 1) as f32;
    let index = (at as usize).min(SCALE.len() - 2);
    let part = ((at - index as f32) * 255.0 + 0.5) as u8;
    mixed(SCALE[index], SCALE[index + 1], part)
}

/// The color of the vertex that was expanded at `t` from 0 to 1.
pub(super) fn of_expanded(t: f32) -> Rgb {
    mixed(EXPANDED[0], EXPANDED[1], (t.clamp(0.0, 1.0) * 255.0 + 0.5) as u8)
}

/// `part` / 255 of color b in color a.
pub(super) fn mixed(a: Rgb, b: Rgb, part: u8) -> Rgb {
    let part = u32::from(part);
    let mix = |a: u8, b: u8| ((u32::from(a) * (255 - part) + u32::from(b) * part + 127) / 255) as u8;
    [mix(a[0], b[0]), mix(a[1], b[1]), mix(a[2], b[2])]
}

/// As in style sheets: `#1f2328`.
pub(super) fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance, times 10,000.
    fn luminance(color: Rgb) -> u32 {
        let [r, g, b] = color.map(|c| (f64::from(c) / 255.0).powf(2.2));
        ((0.2126 * r + 0.7152 * g + 0.0722 * b) * 1e4) as u32
    }

    #[test]
    fn a_field_grows_darker_and_stays_apart_from_walls_and_page() {
        let scale: Vec<_> = (0..=1000).map(|i| luminance(of_field(i as f32 / 1000.0))).collect();
        assert!(scale.windows(2).all(|two| two[1] <= two[0] + 20), "{scale:?}");
        assert!(SCALE.windows(2).all(|two| luminance(two[1]) < luminance(two[0])));
        assert!(scale[0] < luminance(FREE) && scale.iter().all(|&l| l > 0));
        assert_eq!(of_field(0.0), SCALE[0]);
        assert_eq!(of_field(1.0), SCALE[16]);
        assert_eq!(of_field(f32::NAN).len(), 3);
    }
}
