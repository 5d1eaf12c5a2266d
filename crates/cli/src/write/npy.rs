//! Tables of numbers as NumPy reads them, `.npy`: format 1.0 of NumPy's enhancement proposal 1.

use std::io::{self, Write};

/// The header is as long as a multiple of this, so that the numbers are aligned.
const ALIGNMENT: usize = 64;

/// Writes numbers, row by row, as a table of `rows` × `columns`: little-endian, of 64 bits.
pub(crate) fn write(
    (rows, columns): (u32, u32),
    numbers: impl IntoIterator<Item = f64>,
    out: &mut impl Write,
) -> io::Result<()> {
    out.write_all(&header(rows, columns))?;
    numbers.into_iter().try_for_each(|number| out.write_all(&number.to_le_bytes()))
}

/// The magic bytes, the version, the length of the rest, and the description, which spaces fill up.
fn header(rows: u32, columns: u32) -> Vec<u8> {
    const BEGIN: &[u8] = b"\x93NUMPY\x01\x00";
    let mut text = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({rows}, {columns}), }}");
    let before = BEGIN.len() + size_of::<u16>();
    let unpadded = before + text.len() + 1;
    text += &" ".repeat(unpadded.next_multiple_of(ALIGNMENT) - unpadded);
    text.push('\n');
    let mut header = BEGIN.to_vec();
    // Far below 65,536: two numbers are all that varies.
    header.extend((text.len() as u16).to_le_bytes());
    header.extend(text.bytes());
    header
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_aligned_and_say_their_length() {
        for (rows, columns) in [(1, 1), (12, 345), (u32::MAX, u32::MAX), (1, 1_234_567)] {
            let header = header(rows, columns);
            assert_eq!((header.len() % ALIGNMENT, header.last()), (0, Some(&b'\n')));
            let length = usize::from(u16::from_le_bytes([header[8], header[9]]));
            assert_eq!(length, header.len() - 10);
            let text = std::str::from_utf8(&header[10..]).expect("ASCII");
            assert!(text.contains(&format!("'shape': ({rows}, {columns}), }}")), "{text}");
        }
    }
}
