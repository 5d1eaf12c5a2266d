//! The samples of a TIFF, out of its strips or tiles.

use std::io;

use tiff::{
    TiffError,
    decoder::{Decoder, Limits},
};

use super::{
    super::{READING, Samples, samples::each, source::Source},
    Directory, Layout, SurfaceError, error,
    layout::PHOTOMETRIC,
    overlay::Overlay,
};

impl From<TiffError> for SurfaceError {
    fn from(found: TiffError) -> Self {
        match found {
            TiffError::IoError(found) => match found.kind() {
                io::ErrorKind::UnexpectedEof => error("all samples of a strip or tile", "fewer"),
                io::ErrorKind::InvalidData | io::ErrorKind::InvalidInput | io::ErrorKind::Other => {
                    error("strips or tiles that can be unpacked", found.to_string())
                }
                _ => found.into(),
            },
            found => error("a raster of numbers", format!("what the reader calls '{found}'")),
        }
    }
}

/// Reads the samples of the band. Cells of chunks that are not in the file, as GDAL leaves them out, have no
/// data, or are 0.
pub(super) fn read(
    directory: &Directory,
    layout: &Layout,
    no_data: Option<f64>,
    source: &mut Source<'_>,
) -> Result<Samples, SurfaceError> {
    // The crate reads gray of 'white is 0', palettes and colours as they are, if they are called gray.
    let patch = directory.patch(PHOTOMETRIC, 1);
    source.reader.seek(io::SeekFrom::Start(0))?;
    let file = Overlay { file: &mut *source.reader, at: 0, patch };
    // All sizes were compared with the file and the budget.
    let mut decoder = Decoder::new(file)?.with_limits(Limits::unlimited());
    let stated = (decoder.dimensions()?, decoder.chunk_dimensions());
    let chunk_rows =
        |rows: u64| rows.min(layout.height.into()) == layout.chunks.height.min(layout.height.into());
    if stated.0 != (layout.width, layout.height)
        || u64::from(stated.1.0) != layout.chunks.width
        || !chunk_rows(stated.1.1.into())
    {
        return Err(error("sides that are stated once", "different ones"));
    }
    let mut samples = layout.number.none();
    if layout.is_stored && layout.chunks.places.iter().all(|&place| place != (0, 0)) {
        let cells = u64::from(layout.width) * u64::from(layout.height);
        let cells = usize::try_from(cells).map_err(|_| SurfaceError::Memory)?;
        each!(&mut samples, all => all.try_reserve_exact(cells)?);
    }
    let empty = layout.number.to_bytes(no_data.unwrap_or(0.0));
    let (mut chunk, mut rows) = (Vec::new(), Vec::new());
    for down in 0..layout.chunks.down {
        let size = layout.rows(down) * u64::from(layout.width) * layout.number.bytes() as u64;
        resize(&mut rows, size)?;
        for across in 0..layout.chunks.across {
            source.interrupt.check(READING)?;
            let at = layout.first + down * layout.chunks.across + across;
            let place = layout.chunks.places.get(at as usize);
            if place == Some(&(0, 0)) {
                put(layout, &mut rows, (across, down), |_, cells| {
                    cells.chunks_exact_mut(empty.len()).for_each(|cell| cell.copy_from_slice(&empty));
                });
                continue;
            }
            let columns = layout.chunks.width.min(u64::from(layout.width) - across * layout.chunks.width);
            let row_bytes = layout.row_bytes(columns);
            resize(&mut chunk, row_bytes * layout.rows(down))?;
            // No loss: there are not more chunks than bytes of tags, of which each has at least two.
            decoder.read_chunk_bytes(at as u32, &mut chunk)?;
            if layout.chunks.across == 1 && layout.bands == 1 && layout.bits >= 8 {
                std::mem::swap(&mut chunk, &mut rows);
                continue;
            }
            put(layout, &mut rows, (across, down), |row, cells| {
                take(layout, &chunk[row * row_bytes as usize..][..row_bytes as usize], cells);
            });
        }
        layout.number.extend(&mut samples, &mut rows, cfg!(target_endian = "big"), layout.width)?;
    }
    each!(&mut samples, all => all.shrink_to_fit());
    Ok(samples)
}

fn resize(bytes: &mut Vec<u8>, size: u64) -> Result<(), SurfaceError> {
    let size = usize::try_from(size).map_err(|_| SurfaceError::Memory)?;
    bytes.clear();
    bytes.try_reserve_exact(size)?;
    bytes.resize(size, 0);
    Ok(())
}

/// Gives the cells of each row of a chunk to a function: their place among all rows of the chunks beside it.
fn put(layout: &Layout, rows: &mut [u8], (across, down): (u64, u64), mut put: impl FnMut(usize, &mut [u8])) {
    // No loss: all lie inside of `rows`.
    let [width, left, columns] = [u64::from(layout.width), across * layout.chunks.width, layout.chunks.width]
        .map(|cells| cells as usize * layout.number.bytes());
    for row in 0..layout.rows(down) as usize {
        let start = row * width + left;
        put(row, &mut rows[start..(start + columns).min((row + 1) * width)]);
    }
}

/// Takes the samples of the band out of the bytes of a row.
fn take(layout: &Layout, row: &[u8], cells: &mut [u8]) {
    let size = layout.number.bytes();
    if layout.bits < 8 {
        let bits = layout.bits as usize;
        for (x, cell) in cells.iter_mut().enumerate() {
            *cell = row[x * bits / 8] >> (8 - bits - x * bits % 8) & ((1 << bits) - 1);
        }
    } else if layout.bands == 1 {
        cells.copy_from_slice(row);
    } else {
        let pixels = row.chunks_exact(size * usize::from(layout.bands));
        for (cell, pixel) in cells.chunks_exact_mut(size).zip(pixels) {
            cell.copy_from_slice(&pixel[usize::from(layout.band) * size..][..size]);
        }
    }
}
