//! Encodes and decodes the header of an index file.

use std::ops::Range;

use mediant_grid::{Identity, Interrupt, Interrupted};
use sha2::{Digest, Sha256};

use super::{
    error::IndexError,
    key::IndexKey,
    layout::{DIGEST_BYTES, FORMAT_VERSION, HEADER_BYTES, MAGIC, NAME_BYTES, NAME_FORM, is_engine_name},
};
use crate::{read::PIECE, text::quote};

/// The header of an index with a payload of this many bytes.
pub(super) fn encode(key: &IndexKey, payload: usize) -> Vec<u8> {
    let mut name = [0; NAME_BYTES];
    // A key's name has at most NAME_BYTES.
    name[..key.engine.len()].copy_from_slice(key.engine.as_bytes());
    [
        &MAGIC[..],
        &FORMAT_VERSION.to_le_bytes(),
        &name,
        &key.version.to_le_bytes(),
        &key.identity.to_bytes(),
        &(payload as u64).to_le_bytes(),
    ]
    .concat()
}

/// The key in the header, and where the payload is. Checks length and checksum of the whole file.
pub(super) fn decode(bytes: &[u8], interrupt: &Interrupt) -> Result<(IndexKey, Range<usize>), IndexError> {
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
    if digest_of(&[content], interrupt, "checking the file of an index")? != digest {
        return Err(IndexError::Damaged);
    }
    Ok((header.key()?, HEADER_BYTES..content.len()))
}

/// The checksum of these parts in a row.
pub(super) fn digest_of(
    parts: &[&[u8]],
    interrupt: &Interrupt,
    during: &'static str,
) -> Result<[u8; DIGEST_BYTES], Interrupted> {
    let mut digest = Sha256::new();
    for piece in parts.iter().flat_map(|part| part.chunks(PIECE)) {
        interrupt.check(during)?;
        digest.update(piece);
    }
    Ok(digest.finalize().into())
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
    identity: [u8; Identity::BYTES],
    payload: u64,
}

impl Header {
    fn take(fields: &mut Fields<'_>) -> Option<Self> {
        // A struct expression evaluates its fields in the order in which they are written.
        Some(Self {
            name: fields.take()?,
            version: fields.number()?,
            identity: fields.take()?,
            payload: fields.take().map(u64::from_le_bytes)?,
        })
    }

    fn key(&self) -> Result<IndexKey, IndexError> {
        let field = |expected, found: &[u8]| IndexError::Field { expected, found: quote(found) };
        let end = self.name.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1);
        let name = std::str::from_utf8(&self.name[..end]).ok().filter(|name| is_engine_name(name.as_bytes()));
        let engine = name.ok_or_else(|| field(NAME_FORM, &self.name))?.to_owned();
        let identity = Identity::from_bytes(self.identity)
            .ok_or_else(|| field("a map with the codes of its rules and k", &self.identity))?;
        Ok(IndexKey { engine, version: self.version, identity })
    }
}
