//! Reads and writes ESRI ASCII grids: a header of keys and numbers, then the rows from the top.
//!
//! The format is that of the documentation of ArcGIS ('ASCII Raster file format'), with the cells that are
//! not square of GDAL's driver `AAIGrid`: `dx` and `dy` in the place of `cellsize`.

mod header;
mod token;
mod write;

use super::{Samples, Surface, SurfaceError, source::Source};
use header::Header;
pub(super) use header::Key;
use token::Tokens;

/// The sides that the header states.
pub(super) fn size(source: &mut Source<'_>) -> Result<(u64, u64), SurfaceError> {
    let header = Header::read(&mut Tokens::new(source))?;
    Ok((header.width, header.height))
}

pub(super) fn read(source: &mut Source<'_>) -> Result<Surface, SurfaceError> {
    let length = source.length;
    let mut tokens = Tokens::new(source);
    let header = Header::read(&mut tokens)?;
    // Numbers that are not whole need more, of which the budget is asked then.
    let (width, height) = tokens.source.check(header.width, header.height, &Samples::I32(Vec::new()))?;
    let expected = header.width * header.height;
    // A digit and a space each, and the last needs no space.
    let most = (length + 1 - tokens.start().min(length)) / 2;
    if most < expected {
        let found = count(&mut tokens)?;
        return Err(SurfaceError::Short { unit: "numbers", expected, found });
    }
    let samples = numbers(&mut tokens, (width, height))?;
    if !tokens.token().is_empty() {
        return Err(SurfaceError::Long { unit: "numbers", expected, found: tokens.quote() });
    }
    let surface = Surface::new(width, height, samples)?.with_no_data(Some(header.no_data));
    Ok(surface.with_georeference(header.georeference()))
}

/// The number of words from this one on.
fn count(tokens: &mut Tokens<'_, '_>) -> Result<u64, SurfaceError> {
    let mut found = 0;
    while !tokens.token().is_empty() {
        found += 1;
        tokens.next()?;
    }
    Ok(found)
}

/// The numbers: whole ones of 32 bits while all are such, else floats of 64 bits. The word after the last is
/// taken then.
fn numbers(tokens: &mut Tokens<'_, '_>, (width, height): (u32, u32)) -> Result<Samples, SurfaceError> {
    let cells = usize::try_from(u64::from(width) * u64::from(height)).map_err(|_| SurfaceError::Memory)?;
    let mut whole: Vec<i32> = Vec::new();
    whole.try_reserve_exact(cells)?;
    while whole.len() < cells {
        let Some(number) = tokens.whole() else { break };
        whole.push(number);
        tokens.next()?;
    }
    if whole.len() == cells {
        return Ok(whole.into());
    }
    let mut floats: Vec<f64> = Vec::new();
    tokens.source.check(width.into(), height.into(), &Samples::F64(Vec::new()))?;
    floats.try_reserve_exact(cells)?;
    floats.extend(whole.iter().copied().map(f64::from));
    drop(whole);
    while floats.len() < cells {
        if tokens.token().is_empty() {
            let (expected, found) = (cells as u64, floats.len() as u64);
            return Err(SurfaceError::Short { unit: "numbers", expected, found });
        }
        floats.push(tokens.number("a number")?);
        tokens.next()?;
    }
    Ok(floats.into())
}
