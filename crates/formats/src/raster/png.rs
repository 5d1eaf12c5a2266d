//! Reads and writes PNG, by the crate `png`.

use std::io::{self, Cursor};

use mediant_grid::Interrupt;
use png::{
    BitDepth, ColorType, Decoder, DecodingError, Encoder, EncodingError, Limits, Reader, Transformations,
};

use super::{
    Opacities, READING, Raster, RasterError,
    error::check_sides,
    samples::{Samples, pack_bits, push_sample, scaled},
};

/// The most bytes that the decoder may allocate: for a row at a time, and for chunks that are not read here.
const DECODER_BYTES: usize = 16 << 20;

/// The passes of an interlaced picture: of each 8 × 8 pixels the first column and row, and the distance to
/// the next (PNG specification, section 8.2, Adam7).
const PASSES: [[u32; 4]; 7] =
    [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];

impl From<DecodingError> for RasterError {
    fn from(error: DecodingError) -> Self {
        let message = match error {
            DecodingError::IoError(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                "the file ends early".to_owned()
            }
            // No full stop: the message of this crate goes on.
            error => error.to_string().trim_end_matches('.').to_owned(),
        };
        Self::Png { message }
    }
}

/// A decoder with a limit on its memory.
fn decoder(bytes: &[u8]) -> Decoder<Cursor<&[u8]>> {
    Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: DECODER_BYTES })
}

/// The sides that the header states.
pub(super) fn size(bytes: &[u8]) -> Result<(u32, u32), RasterError> {
    let mut decoder = decoder(bytes);
    let header = decoder.read_header_info()?;
    check_sides(u64::from(header.width), u64::from(header.height))
}

/// The sides and the largest shade that the header states of a picture of gray; `None` for others.
#[cfg(feature = "surface")]
pub(super) fn gray(bytes: &[u8]) -> Result<Option<super::gray::Stated>, RasterError> {
    let mut decoder = decoder(bytes);
    let header = decoder.read_header_info()?;
    let largest = (1 << header.bit_depth as u32) - 1;
    let sides = (u64::from(header.width), u64::from(header.height));
    Ok((header.color_type == ColorType::Grayscale).then_some((sides, largest)))
}

/// Reads a PNG whose sides pass a check, row by row: the decoder keeps a row, and the samples grow with what
/// was decoded.
pub(super) fn read(
    bytes: &[u8],
    check: impl Fn(u64, u64) -> Result<(u32, u32), RasterError>,
    interrupt: &Interrupt,
) -> Result<Raster, RasterError> {
    let mut decoder = decoder(bytes);
    // Palettes become colours, and gray of less than 8 bits becomes gray of 8, which changes no fraction of
    // white: 255 is a multiple of 1, 3 and 15.
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let header = decoder.read_header_info()?;
    let (width, height) = check(u64::from(header.width), u64::from(header.height))?;
    let interlaced = header.interlaced;
    let mut reader = decoder.read_info()?;
    check_palette(&reader)?;
    let mut raster = read_rows(&mut reader, (width, height), interrupt)?;
    let expected = width as usize * height as usize;
    let decoded = raster.opacities.iter().map(|opacities| &opacities.samples);
    let decoded = decoded.chain(&raster.lumas).chain([&raster.shades]).map(Samples::len);
    if decoded.into_iter().any(|found| found != expected) {
        return Err(RasterError::Png { message: "it has fewer pixels than its header states".to_owned() });
    }
    // The end of the file belongs to the picture: without it the file was cut short.
    reader.finish()?;
    if interlaced {
        let sides = (width, height);
        raster.shades = in_order(&raster.shades, sides, raster.white, interrupt)?;
        if let Some(Opacities { opaque, samples }) = &mut raster.opacities {
            *samples = in_order(samples, sides, *opaque, interrupt)?;
        }
        if let Some(lumas) = &mut raster.lumas {
            *lumas = in_order(lumas, sides, 0xff, interrupt)?;
        }
    }
    Ok(raster)
}

/// Checks that a palette is one of whole colours: `png` 0.18.1 panics where it is not (image-png, issue 694).
fn check_palette(reader: &Reader<Cursor<&[u8]>>) -> Result<(), RasterError> {
    let bytes = reader.info().palette.as_ref().map_or(0, |palette| palette.len());
    if bytes.is_multiple_of(3) && bytes <= 3 * 256 {
        return Ok(());
    }
    Err(RasterError::Png {
        message: format!("its palette of {bytes} bytes has a part of a colour, or too many"),
    })
}

/// The picture, with its samples in the order of the file.
fn read_rows(
    reader: &mut Reader<Cursor<&[u8]>>,
    (width, height): (u32, u32),
    interrupt: &Interrupt,
) -> Result<Raster, RasterError> {
    let (color, depth) = reader.output_color_type();
    let channels = color.samples();
    let has_opacity = matches!(color, ColorType::GrayscaleAlpha | ColorType::Rgba);
    let colors = channels - usize::from(has_opacity);
    let (opaque, bytes) = if depth == BitDepth::Sixteen { (0xffff, 2) } else { (0xff, 1) };
    let white = opaque * colors as u32;
    let sample = |bytes: &[u8]| bytes.iter().fold(0, |sample, &byte| sample << 8 | u32::from(byte));
    let mut shades = Samples::up_to(white);
    let mut opacities = has_opacity.then(|| Opacities { opaque, samples: Samples::up_to(opaque) });
    let mut lumas = (colors == 3).then(|| Samples::up_to(0xff));
    while let Some(row) = reader.next_row()? {
        interrupt.check(READING)?;
        let pixels = row.data().chunks_exact(channels * bytes);
        if let (1, 1, false) = (bytes, colors, has_opacity) {
            shades.extend(pixels.map(|pixel| pixel.iter().copied().map(u32::from).sum()))?;
            continue;
        }
        shades
            .extend(pixels.clone().map(|pixel| pixel.chunks_exact(bytes).take(colors).map(sample).sum()))?;
        if let Some(lumas) = &mut lumas {
            let channel = |pixel: &[u8], at: usize| sample(&pixel[at * bytes..][..bytes]);
            let luma = |pixel: &[u8]| luma([0, 1, 2].map(|at| channel(pixel, at)), opaque);
            lumas.extend(pixels.clone().map(luma))?;
        }
        if let Some(opacities) = &mut opacities {
            opacities.samples.extend(pixels.map(|pixel| sample(&pixel[colors * bytes..])))?;
        }
    }
    Ok(Raster { width, height, white, shades, opacities, lumas })
}

/// The luma of red, green and blue, in 8 bits: the intensity of GraphicsMagick, which weighs samples of 16
/// bits as they are and then cuts off the lower 8. (Some of its builds round elsewhere, and find one more or
/// less of 255 in some colours; for gray all agree.)
fn luma([red, green, blue]: [u32; 3], white: u32) -> u32 {
    let luma = (306 * red + 601 * green + 117 * blue) >> 10;
    if white == 0xffff { luma / 257 } else { luma }
}

/// The samples of an interlaced picture, row by row.
fn in_order(
    samples: &Samples,
    (width, height): (u32, u32),
    largest: u32,
    interrupt: &Interrupt,
) -> Result<Samples, RasterError> {
    // For each pass, the number of its columns and the samples before it.
    let mut before = 0;
    let passes = PASSES.map(|[x, y, step_x, step_y]| {
        let [columns, rows] = [(width, x, step_x), (height, y, step_y)]
            .map(|(n, first, step)| n.saturating_sub(first).div_ceil(step));
        let start = before;
        before += columns as usize * rows as usize;
        (columns as usize, start)
    });
    // Of a pixel, by its column of 8 and its row: where the row of its pass begins, and each how many columns
    // the pass has one.
    let row_of_pass = |x: u32, y: u32| {
        let fits =
            |[first_x, first_y, step_x, step_y]: [u32; 4]| x % step_x == first_x && y % step_y == first_y;
        let pass = PASSES.iter().position(|&pass| fits(pass)).unwrap_or(0);
        let ([_, _, step_x, step_y], (columns, start)) = (PASSES[pass], passes[pass]);
        (start + (y / step_y) as usize * columns, step_x.ilog2())
    };
    let mut ordered = Samples::up_to(largest);
    for y in 0..height {
        interrupt.check(READING)?;
        let rows = [0, 1, 2, 3, 4, 5, 6, 7].map(|x| row_of_pass(x, y));
        let row = (0..width as usize).map(|x| {
            let (start, step_bits) = rows[x % 8];
            samples.get(start + (x >> step_bits)).unwrap_or(0)
        });
        ordered.extend(row)?;
    }
    Ok(ordered)
}

/// Writes a PNG of gray: 1 bit where white is 1, 8 bits where it is at most 255, else 16; with opacity, if
/// the picture has it, in 8 or 16 bits.
pub(super) fn write(raster: &Raster, out: impl io::Write) -> io::Result<()> {
    let opaque = raster.opaque();
    let (depth, largest) = match raster.white.max(opaque.unwrap_or(1)) {
        1 if opaque.is_none() => (BitDepth::One, 1),
        0..=0xff => (BitDepth::Eight, 0xff),
        _ => (BitDepth::Sixteen, 0xffff),
    };
    let mut encoder = Encoder::new(out, raster.width, raster.height);
    encoder.set_depth(depth);
    encoder.set_color(if opaque.is_some() { ColorType::GrayscaleAlpha } else { ColorType::Grayscale });
    let mut writer = encoder.write_header().map_err(io_error)?;
    let mut rows = writer.stream_writer().map_err(io_error)?;
    let mut row = Vec::new();
    for y in 0..raster.height {
        row.clear();
        let shades = (0..raster.width).map(|x| raster.scaled_shade(x, y, largest));
        if depth == BitDepth::One {
            pack_bits(&mut row, shades.map(|shade| shade == 1));
        } else {
            for (x, shade) in (0..).zip(shades) {
                push_sample(&mut row, shade, largest);
                if let Some((opaque, opacity)) = opaque.zip(raster.opacity(x, y)) {
                    push_sample(&mut row, scaled(opacity, opaque, largest), largest);
                }
            }
        }
        io::Write::write_all(&mut rows, &row)?;
    }
    rows.finish().map_err(io_error)?;
    writer.finish().map_err(io_error)
}

/// Writes a PNG of gray of 8 or 16 bits, of rows that `write` gives.
#[cfg(feature = "surface")]
pub(crate) fn write_gray(
    out: impl io::Write,
    (width, height): (u32, u32),
    is_wide: bool,
    write: impl FnOnce(&mut dyn io::Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut encoder = Encoder::new(out, width, height);
    encoder.set_depth(if is_wide { BitDepth::Sixteen } else { BitDepth::Eight });
    encoder.set_color(ColorType::Grayscale);
    let mut writer = encoder.write_header().map_err(io_error)?;
    let mut rows = writer.stream_writer().map_err(io_error)?;
    write(&mut rows)?;
    rows.finish().map_err(io_error)?;
    writer.finish().map_err(io_error)
}

fn io_error(error: EncodingError) -> io::Error {
    match error {
        EncodingError::IoError(error) => error,
        error => io::Error::other(error),
    }
}
