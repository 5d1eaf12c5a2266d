//! The header of an array of NumPy: a literal of Python.

use super::{Samples, Surface, SurfaceError, number::Number, source::Source};
use crate::text::quote;

/// The array, as its header describes it.
pub(super) struct Header {
    pub(super) width: u64,
    pub(super) height: u64,
    /// Of an array of three dimensions, one after the other.
    pub(super) bands: u16,
    pub(super) number: Number,
    pub(super) big_endian: bool,
    /// Whether the numbers are column by column, 'in Fortran order'.
    pub(super) by_columns: bool,
}

const SAVE: &str = "save the array anew by `numpy.save`";
const TYPE: &str = "convert it, for example by `array.astype('float32')`";
const EXPECTED: &str =
    "a shape of two dimensions, rows and columns, or of three, with 1 to 65535 bands first";
const ORDER: &str = "save it anew by `numpy.save(file, numpy.ascontiguousarray(array))`";
const SHAPE: &str = "save one layer of the array, with its rows and columns";

fn error(expected: &'static str, found: &[u8], remedy: &'static str) -> SurfaceError {
    SurfaceError::Npy { expected, found: quote(found), remedy }
}

impl Header {
    /// Reads the header; the reader is at the first number then.
    pub(super) fn read(source: &mut Source<'_>) -> Result<Self, SurfaceError> {
        // The signature of six bytes, and two of the version.
        let begin = source.read(8)?;
        let length_bytes = match begin.get(6..8) {
            Some([1, _]) => 2,
            Some([2 | 3, _]) => 4,
            other => return Err(error("a version of 1 to 3", other.unwrap_or_default(), SAVE)),
        };
        let length = source.read(length_bytes)?;
        if length.len() < length_bytes as usize {
            return Err(error("its length", &length, SAVE));
        }
        let length = length.iter().rev().fold(0, |length, &byte| length << 8 | u64::from(byte));
        let text = source.read(length)?;
        if (text.len() as u64) < length {
            return Err(error("as many bytes as it states", b"the end of the file", SAVE));
        }
        Self::of(&text)
    }

    fn of(text: &[u8]) -> Result<Self, SurfaceError> {
        let mut literal = Literal { text };
        let (mut kind, mut order, mut shape) = (None, None, None);
        literal.expect(b'{', "a dictionary")?;
        while !literal.takes(b'}') {
            let key = literal.string("the name of a key")?;
            literal.expect(b':', "`:` after a key")?;
            match key {
                b"descr" => kind = Some(number(literal.string("a type of numbers")?)?),
                b"fortran_order" => order = Some(literal.truth()?),
                b"shape" => shape = Some(literal.shape()?),
                _ => return Err(error("the keys `descr`, `fortran_order` and `shape`", key, SAVE)),
            }
            if !literal.takes(b',') && literal.peek() != Some(b'}') {
                return Err(error("`,` or `}` after a value", literal.text, SAVE));
            }
        }
        literal.space();
        let rest = literal.text;
        match (kind, order, shape) {
            // In Fortran order the bands would be mixed, cell by cell.
            (Some(_), Some(true), Some((2.., ..))) => Err(error(EXPECTED, b"bands in Fortran order", ORDER)),
            (Some((number, big_endian)), Some(by_columns), Some((bands, height, width)))
                if rest.is_empty() =>
            {
                Ok(Self { width, height, bands, number, big_endian, by_columns })
            }
            _ if rest.is_empty() => {
                Err(error("the keys `descr`, `fortran_order` and `shape`", b"fewer keys", SAVE))
            }
            _ => Err(error("its end after the dictionary", rest, SAVE)),
        }
    }
}

/// The type of numbers by its name, and whether their highest byte comes first.
fn number(name: &[u8]) -> Result<(Number, bool), SurfaceError> {
    let (order, kind) = name.split_at(name.len().min(1));
    let number = match kind {
        b"b1" | b"u1" => Number::U8,
        b"i1" => Number::I8,
        b"u2" => Number::U16,
        b"i2" => Number::I16,
        b"u4" => Number::U32,
        b"i4" => Number::I32,
        b"u8" => Number::U64,
        b"i8" => Number::I64,
        b"f2" => Number::F16,
        b"f4" => Number::F32,
        b"f8" => Number::F64,
        _ => return Err(error("truth values, integers or floats, of up to 64 bits", name, TYPE)),
    };
    match order {
        b"<" | b"|" => Ok((number, false)),
        b">" => Ok((number, true)),
        _ => Err(error("the order of bytes, `<` or `>`, before the type", name, SAVE)),
    }
}

/// The rest of a literal of Python.
struct Literal<'a> {
    text: &'a [u8],
}

impl<'a> Literal<'a> {
    fn space(&mut self) {
        self.text = self.text.trim_ascii_start();
    }

    fn peek(&mut self) -> Option<u8> {
        self.space();
        self.text.first().copied()
    }

    /// Whether the next byte is this one, which is gone then.
    fn takes(&mut self, byte: u8) -> bool {
        let is = self.peek() == Some(byte);
        if is {
            self.text = &self.text[1..];
        }
        is
    }

    fn expect(&mut self, byte: u8, expected: &'static str) -> Result<(), SurfaceError> {
        if self.takes(byte) { Ok(()) } else { Err(error(expected, self.text, SAVE)) }
    }

    fn string(&mut self, expected: &'static str) -> Result<&'a [u8], SurfaceError> {
        let end_quote = self.peek().filter(|byte| matches!(byte, b'\'' | b'"'));
        let string = end_quote.and_then(|quote| {
            let rest = &self.text[1..];
            let length = rest.iter().position(|&byte| byte == quote)?;
            self.text = &rest[length + 1..];
            Some(&rest[..length])
        });
        // Arrays of records have a list of types.
        string.ok_or_else(|| error(expected, self.text, TYPE))
    }

    fn truth(&mut self) -> Result<bool, SurfaceError> {
        self.space();
        for (word, truth) in [(b"True".as_slice(), true), (b"False", false)] {
            if let Some(rest) = self.text.strip_prefix(word) {
                self.text = rest;
                return Ok(truth);
            }
        }
        Err(error("`True` or `False`", self.text, SAVE))
    }

    /// Bands, of two dimensions one, rows and columns.
    fn shape(&mut self) -> Result<(u16, u64, u64), SurfaceError> {
        self.space();
        let all = self.text;
        let mut sides = Vec::new();
        self.expect(b'(', EXPECTED)?;
        while !self.takes(b')') {
            self.space();
            let digits = self.text.iter().take_while(|byte| byte.is_ascii_digit()).count();
            let (number, rest) = self.text.split_at(digits);
            let number = std::str::from_utf8(number).ok().and_then(|number| number.parse().ok());
            sides.push(number.ok_or_else(|| error(EXPECTED, all, SHAPE))?);
            // Python 2 wrote long integers so.
            self.text = rest.strip_prefix(b"L").unwrap_or(rest);
            if !self.takes(b',') && self.peek() != Some(b')') {
                return Err(error(EXPECTED, all, SHAPE));
            }
        }
        let shape = &all[..all.len() - self.text.len()];
        match sides[..] {
            [height, width] => Ok((1, height, width)),
            [bands @ 1..=0xffff, height, width] => Ok((bands as u16, height, width)),
            _ => Err(error(EXPECTED, shape, SHAPE)),
        }
    }
}

/// The header of a raster, of version 1.
pub(super) fn of(surface: &Surface) -> Vec<u8> {
    let kind = match surface.samples() {
        Samples::U8(_) => "|u1",
        Samples::U16(_) => "<u2",
        Samples::I16(_) => "<i2",
        Samples::U32(_) => "<u4",
        Samples::I32(_) => "<i4",
        Samples::F32(_) => "<f4",
        Samples::F64(_) => "<f8",
    };
    let (height, width) = (surface.height(), surface.width());
    let mut text = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({height}, {width}), }}");
    // Signature, version, length and text fill whole lines of 64 bytes.
    let end = (10 + text.len() + 1).next_multiple_of(64) - 11;
    text.extend(std::iter::repeat_n(' ', end - text.len()));
    text.push('\n');
    let length = text.len() as u16;
    [b"\x93NUMPY\x01\0", &length.to_le_bytes()[..], text.as_bytes()].concat()
}
