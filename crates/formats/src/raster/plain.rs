//! Reads the pixels of plain PGM and PBM: numbers in text.

use mediant_grid::Interrupt;

use super::{READING, RasterError, cursor::Cursor, samples::Samples};

/// Bits, which need no space between them; 1 is black.
pub(super) fn bits(
    cursor: &mut Cursor<'_>,
    sides: (u32, u32),
    interrupt: &Interrupt,
) -> Result<Samples, RasterError> {
    read(cursor, sides, 1, interrupt, |cursor| {
        let bit = cursor.peek().filter(|byte| matches!(byte, b'0' | b'1'))?;
        cursor.at += 1;
        Some(u32::from(bit == b'0'))
    })
}

/// Numbers with white space between them.
pub(super) fn samples(
    cursor: &mut Cursor<'_>,
    sides: (u32, u32),
    white: u32,
    interrupt: &Interrupt,
) -> Result<Samples, RasterError> {
    read(cursor, sides, white, interrupt, |cursor| {
        let number = cursor.digits()?;
        u32::try_from(number).ok().filter(|&number| number <= white)
    })
}

/// Reads rows of samples; `next` returns the sample at the cursor, if it is one.
fn read(
    cursor: &mut Cursor<'_>,
    (width, height): (u32, u32),
    white: u32,
    interrupt: &Interrupt,
    next: impl Fn(&mut Cursor<'_>) -> Option<u32>,
) -> Result<Samples, RasterError> {
    let mut shades = Samples::up_to(white);
    let expected = u64::from(width) * u64::from(height);
    let unit = "samples";
    let mut row = Vec::new();
    for _ in 0..height {
        interrupt.check(READING)?;
        row.clear();
        for x in 0..width {
            cursor.skip_space();
            let start = cursor.at;
            if cursor.peek().is_none() {
                let found = shades.len() as u64 + u64::from(x);
                return Err(RasterError::Short { unit, expected, found });
            }
            let Some(sample) = next(cursor) else {
                let (line, column) = cursor.place(start);
                let place = format!("line {line}, column {column}");
                return Err(RasterError::Sample { place, max: white, found: cursor.word(start) });
            };
            row.push(sample);
        }
        shades.extend(row.iter().copied())?;
    }
    cursor.skip_space();
    match cursor.peek() {
        None => Ok(shades),
        Some(_) => Err(RasterError::Long { unit, expected, found: cursor.word(cursor.at) }),
    }
}
