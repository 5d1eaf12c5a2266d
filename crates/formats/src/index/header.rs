//! Encodes and decodes the header of an index file.

use std::ops::Range;

use mediant_grid::{CornerRule, DiagonalGap, Rules};
use sha2::{Digest, Sha256};

use super::{
    digest::MapDigest,
    error::IndexError,
    key::IndexKey,
    layout::{DIGEST_BYTES, FORMAT_VERSION, HEADER_BYTES, MAGIC, NAME_BYTES, NAME_FORM, is_engine_name},
};
use crate::text::quote;

/// The rules of motion by the two bytes that stand for them.
const RULES: [([u8; 2], Rules); 5] = [
    ([0, 0], Rules::Center(CornerRule::Never)),
    ([0, 1], Rules::Center(CornerRule::One)),
    ([0, 2], Rules::Center(CornerRule::Always)),
    ([1, 0], Rules::Corner(DiagonalGap::Open)),
    ([1, 1], Rules::Corner(DiagonalGap::Closed)),
];

/// The header of an index with a payload of this many bytes.
pub(super) fn encode(key: &IndexKey, payload: usize) -> Vec<u8> {
    let mut name = [0; NAME_BYTES];
    // A key's name has at most NAME_BYTES.
    name[..key.engine.len()].copy_from_slice(key.engine.as_bytes());
    let code = RULES.iter().find(|(_, rules)| *rules == key.rules).map_or([u8::MAX; 2], |&(code, _)| code);
    [
        &MAGIC[..],
        &FORMAT_VERSION.to_le_bytes(),
        &name,
        &key.version.to_le_bytes(),
        &code,
        &[u8::from(key.k.is_none()), 0],
        &key.k.unwrap_or(0).to_le_bytes(),
        &key.map.width.to_le_bytes(),
        &key.map.height.to_le_bytes(),
        &key.map.digest,
        &(payload as u64).to_le_bytes(),
    ]
    .concat()
}

/// The key in the header, and where the payload is. Checks length and checksum of the whole file.
pub(super) fn decode(bytes: &[u8]) -> Result<(IndexKey, Range<usize>), IndexError> {
    let found = bytes.len() as u64;
    let shortest = (HEADER_BYTES + DIGEST_BYTES) as u64;
    let mut fields = Fields(bytes);
    if fields.take() != Some(MAGIC) {
        return Err(IndexError::NotAnIndex { found: quote(&bytes[..bytes.len().min(MAGIC.len())]) });
    }
    let version = fields.number();
    if let Some(found) = version.filter(|&version| version != FORMAT_VERSION) {
        return Err(IndexError::Format { found });
    }
    let header = Header::take(&mut fields).ok_or(IndexError::Length { expected: shortest, found })?;
    let expected = shortest.saturating_add(header.payload);
    if found != expected {
        return Err(IndexError::Length { expected, found });
    }
    let (content, digest) = bytes.split_at(bytes.len() - DIGEST_BYTES);
    if Sha256::digest(content).as_slice() != digest {
        return Err(IndexError::Damaged);
    }
    Ok((header.key()?, HEADER_BYTES..content.len()))
}

/// The bytes that were not yet decoded.
struct Fields<'a>(&'a [u8]);

impl Fields<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (field, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*field)
    }

    fn number(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }
}

/// The fields behind the format version, not yet checked.
struct Header {
    name: [u8; NAME_BYTES],
    version: u32,
    rules: [u8; 2],
    any_angle: [u8; 2],
    k: u32,
    map: MapDigest,
    payload: u64,
}

impl Header {
    fn take(fields: &mut Fields<'_>) -> Option<Self> {
        // A struct expression evaluates its fields in the order in which they are written.
        Some(Self {
            name: fields.take()?,
            version: fields.number()?,
            rules: fields.take()?,
            any_angle: fields.take()?,
            k: fields.number()?,
            map: MapDigest { width: fields.number()?, height: fields.number()?, digest: fields.take()? },
            payload: fields.take().map(u64::from_le_bytes)?,
        })
    }

    fn key(&self) -> Result<IndexKey, IndexError> {
        let field = |expected, found: &[u8]| IndexError::Field { expected, found: quote(found) };
        let end = self.name.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1);
        let name = std::str::from_utf8(&self.name[..end]).ok().filter(|name| is_engine_name(name.as_bytes()));
        let engine = name.ok_or_else(|| field(NAME_FORM, &self.name))?.to_owned();
        let rules = RULES.iter().find(|(code, _)| *code == self.rules);
        let &(_, rules) = rules.ok_or_else(|| field("the codes of a placement and its rule", &self.rules))?;
        let k = match (self.any_angle, self.k) {
            ([0, 0], k) => Some(k),
            ([1, 0], 0) => None,
            _ => return Err(field("a number k or the mark of any-angle", &self.any_angle)),
        };
        Ok(IndexKey { engine, version: self.version, rules, k, map: self.map })
    }
}
