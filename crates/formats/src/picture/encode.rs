//! PNG files, and files inside of SVG.

use std::io::{self, Write};

use png::{BitDepth, ColorType, DeflateCompression, Encoder, EncodingError, Filter};

use super::{color::Rgb, raster::Image, vertex_colors::VertexColors};

/// Writes an image as PNG: with a palette if it has at most 256 colors.
pub(super) fn png(image: &Image, out: impl Write) -> io::Result<()> {
    let mut palette = Palette::default();
    let indexes: Option<Vec<u8>> = image.pixels.iter().map(|&pixel| palette.index(pixel)).collect();
    let mut encoder = Encoder::new(out, image.width, image.height);
    let bytes = if let Some(indexes) = indexes {
        let bits = match palette.colors.len() {
            0..=2 => BitDepth::One,
            3..=4 => BitDepth::Two,
            5..=16 => BitDepth::Four,
            _ => BitDepth::Eight,
        };
        encoder.set_color(ColorType::Indexed);
        encoder.set_depth(bits);
        encoder.set_palette(palette.colors.concat());
        packed(&indexes, image.width as usize, bits as usize)
    } else {
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        image.pixels.concat()
    };
    write(encoder, &bytes)
}

/// Writes the colors of vertices, a pixel each; those without a color are transparent.
pub(super) fn png_of_colors(painted: &VertexColors, out: impl Write) -> io::Result<()> {
    let mut encoder = Encoder::new(out, painted.columns, painted.rows);
    encoder.set_color(ColorType::Rgba);
    encoder.set_depth(BitDepth::Eight);
    let pixels = painted.rows().flatten();
    let bytes: Vec<u8> = pixels.flat_map(|color| color.map_or([0; 4], |[r, g, b]| [r, g, b, 255])).collect();
    write(encoder, &bytes)
}

fn write(mut encoder: Encoder<'_, impl Write>, bytes: &[u8]) -> io::Result<()> {
    let error = |error: EncodingError| match error {
        EncodingError::IoError(error) => error,
        error => io::Error::other(error),
    };
    // Of 2000 × 2000 cells of noise, level 6 takes three times as long, for files a twentieth smaller.
    encoder.set_deflate_compression(DeflateCompression::Level(3));
    encoder.set_filter(Filter::NoFilter);
    let mut writer = encoder.write_header().map_err(error)?;
    writer.write_image_data(bytes).map_err(error)?;
    writer.finish().map_err(error)
}

/// The colors of an image in the order in which they first appear, and where to find them.
struct Palette {
    colors: Vec<Rgb>,
    /// An open hash table: color and index.
    slots: Vec<Option<(Rgb, u8)>>,
    last: Option<(Rgb, u8)>,
}

impl Default for Palette {
    fn default() -> Self {
        Self { colors: Vec::new(), slots: vec![None; Self::SLOTS], last: None }
    }
}

impl Palette {
    const SLOTS: usize = 1024;

    /// The index of a color; `None` if there are more than 256.
    #[inline]
    fn index(&mut self, color: Rgb) -> Option<u8> {
        if let Some((last, index)) = self.last
            && last == color
        {
            return Some(index);
        }
        let [r, g, b] = color.map(usize::from);
        let mut at = (r * 37 + g * 101 + b * 197) % Self::SLOTS;
        // At most a quarter of the slots is taken.
        while let Some(Some((other, index))) = self.slots.get(at) {
            if *other == color {
                self.last = Some((color, *index));
                return Some(*index);
            }
            at = (at + 1) % Self::SLOTS;
        }
        let index = u8::try_from(self.colors.len()).ok()?;
        self.colors.push(color);
        if let Some(slot) = self.slots.get_mut(at) {
            *slot = Some((color, index));
        }
        self.last = Some((color, index));
        Some(index)
    }
}

/// Indexes of few bits, the first in the highest bits; each row begins a byte.
fn packed(indexes: &[u8], width: usize, bits: usize) -> Vec<u8> {
    if bits == 8 {
        return indexes.to_vec();
    }
    let byte = |some: &[u8]| {
        some.iter().zip(1..).fold(0, |byte, (&index, place)| byte | index << (8 - bits * place))
    };
    indexes.chunks(width.max(1)).flat_map(|row| row.chunks(8 / bits).map(byte)).collect()
}

/// The bytes of a file as text (RFC 4648, section 4), for a `data:` address.
pub(super) fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for part in bytes.chunks(3) {
        let word =
            part.iter().zip([16, 8, 0]).fold(0, |word, (&byte, shift)| word | u32::from(byte) << shift);
        for (shift, place) in [18, 12, 6, 0].into_iter().zip(0..) {
            let letter = LETTERS[(word >> shift & 63) as usize];
            text.push(if place <= part.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_of_bytes() {
        // The test vectors of RFC 4648, section 10.
        let texts = ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"];
        for (text, length) in texts.into_iter().zip(0..) {
            assert_eq!(base64(&b"foobar"[..length]), text);
        }
    }

    #[test]
    fn few_bits_are_packed_by_rows() {
        assert_eq!(packed(&[1, 0, 1, 1, 1, 1], 3, 1), [0b1010_0000, 0b1110_0000]);
        assert_eq!(packed(&[1, 2, 3, 0, 1], 5, 2), [0b0110_1100, 0b0100_0000]);
        assert_eq!(packed(&[1, 15, 7], 3, 4), [0x1f, 0x70]);
    }

    #[test]
    fn a_palette_ends_at_256_colors() {
        let mut palette = Palette::default();
        let indexes = (0..=255).map(|i| palette.index([i, 3, 255 - i])).collect::<Vec<_>>();
        assert!(indexes.iter().zip(0..).all(|(&index, i)| index == u8::try_from(i).ok()));
        assert_eq!(palette.index([9, 3, 246]), Some(9));
        assert_eq!(palette.index([9, 9, 9]), None);
    }
}
