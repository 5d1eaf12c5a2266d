//! The header of an ESRI ASCII grid.

use super::{
    super::{
        SurfaceError,
        georeference::{Georeference, Origin},
    },
    token::Tokens,
};

/// A key of the header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Key {
    Columns,
    Rows,
    CornerX,
    CornerY,
    CenterX,
    CenterY,
    CellSize,
    CellWidth,
    CellHeight,
    NoData,
}

impl Key {
    const NAMES: [(&'static str, Self); 10] = [
        ("ncols", Self::Columns),
        ("nrows", Self::Rows),
        ("xllcorner", Self::CornerX),
        ("yllcorner", Self::CornerY),
        ("xllcenter", Self::CenterX),
        ("yllcenter", Self::CenterY),
        ("cellsize", Self::CellSize),
        ("dx", Self::CellWidth),
        ("dy", Self::CellHeight),
        ("nodata_value", Self::NoData),
    ];

    /// The key of a word, in letters of either case.
    pub(in super::super) fn of(word: &[u8]) -> Option<Self> {
        let is = |name: &&(&str, Self)| word.eq_ignore_ascii_case(name.0.as_bytes());
        Self::NAMES.iter().find(is).map(|&(_, key)| key)
    }
}

/// The grid, as its header describes it.
pub(super) struct Header {
    pub(super) width: u64,
    pub(super) height: u64,
    pub(super) no_data: f64,
    cell_size: Option<(f64, f64)>,
    origin: Option<Origin>,
}

/// By the documentation of ArcGIS, where the header has none.
const NO_DATA: f64 = -9999.0;

const FORM: &str = "the header has the lines `ncols N`, `nrows N`, `xllcorner X`, `yllcorner Y`, `cellsize S` and \
                    `NODATA_value V`, and the rows follow";

impl Header {
    /// Reads the header. The first word after it is taken then.
    pub(super) fn read(tokens: &mut Tokens<'_, '_>) -> Result<Self, SurfaceError> {
        let mut values = [None; Key::NAMES.len()];
        tokens.next()?;
        while let Some(key) = Key::of(tokens.token()) {
            let value = &mut values[key as usize];
            if value.is_some() {
                return Err(tokens.error("each key once", FORM));
            }
            tokens.next()?;
            *value = Some(match key {
                Key::Columns | Key::Rows => tokens
                    .digits()
                    .map(|side| side as f64)
                    .ok_or_else(|| tokens.error("the number of columns or rows", FORM))?,
                Key::CellSize | Key::CellWidth | Key::CellHeight => tokens
                    .float()
                    .filter(|size| size.is_finite() && *size > 0.0)
                    .ok_or_else(|| tokens.error("a positive number, the size of a cell", FORM))?,
                Key::NoData => tokens.number("the number that stands for 'no data'")?,
                _ => tokens
                    .float()
                    .filter(|place| place.is_finite())
                    .ok_or_else(|| tokens.error("a coordinate", FORM))?,
            });
            tokens.next()?;
        }
        let value = |key: Key| values[key as usize];
        let (Some(width), Some(height)) = (value(Key::Columns), value(Key::Rows)) else {
            return Err(tokens.error("the keys `ncols` and `nrows` before the first number", FORM));
        };
        if !tokens.token().is_empty() && tokens.float().is_none() {
            return Err(tokens.error("a key of the header, or the first number", FORM));
        }
        let size = value(Key::CellSize);
        let place = |x, y, is_center| Some(Origin { x: value(x)?, y: value(y)?, is_center });
        Ok(Self {
            // No loss: what is beyond 2⁵³ is beyond all sides.
            width: width as u64,
            height: height as u64,
            no_data: value(Key::NoData).unwrap_or(NO_DATA),
            cell_size: value(Key::CellWidth).or(size).zip(value(Key::CellHeight).or(size)),
            origin: place(Key::CornerX, Key::CornerY, false)
                .or_else(|| place(Key::CenterX, Key::CenterY, true)),
        })
    }

    pub(super) fn georeference(&self) -> Georeference {
        Georeference { cell_size: self.cell_size, origin: self.origin, ..Georeference::default() }
    }
}
