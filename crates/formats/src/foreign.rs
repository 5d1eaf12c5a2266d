//! Files of kinds that are not read here, by their first bytes.

use crate::text::{Lines, quote, words};

/// The first bytes of files, with what they are and what to do.
const SIGNATURES: [(&[u8], &str); 12] = [
    (b"\xff\xd8\xff", "a JPEG picture (convert it to PNG)"),
    (b"II*\0", "a TIFF picture (convert it to PNG)"),
    (b"MM\0*", "a TIFF picture (convert it to PNG)"),
    (b"GIF87a", "a GIF picture (convert it to PNG)"),
    (b"GIF89a", "a GIF picture (convert it to PNG)"),
    (b"\x1f\x8b", "a file compressed by gzip (unpack it first)"),
    (b"\xfd7zXZ\0", "a file compressed by xz (unpack it first)"),
    (b"BZh", "a file compressed by bzip2 (unpack it first)"),
    (b"PK\x03\x04", "a ZIP archive (unpack it first)"),
    (b"\x93NUMPY", "an array of NumPy (load it there, and make the map of the array)"),
    (b"%PDF-", "a PDF document (convert it to PNG)"),
    (b"version https://git-lfs", "a pointer of Git LFS (fetch the file itself by `git lfs pull`)"),
];

/// The kind of a file that is no map here, and the way out; `None` for an unknown kind.
pub(crate) fn kind(bytes: &[u8]) -> Option<&'static str> {
    if let Some((_, what)) = SIGNATURES.iter().find(|(signature, _)| bytes.starts_with(signature)) {
        return Some(what);
    }
    // Two letters may begin a text, too: the four bytes at 6 are reserved, and 0.
    if bytes.starts_with(b"BM") && bytes.get(6..10) == Some(&[0; 4]) {
        return Some("a BMP picture (convert it to PNG)");
    }
    if bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP") {
        return Some("a WebP picture (convert it to PNG)");
    }
    let first = Lines::new(bytes).find(|line| !line.is_blank())?.text;
    if words(first).next().is_some_and(|(_, word)| word == b"voxel") {
        return Some("a 3-D map, `voxel` (only flat maps are read)");
    }
    let page = |begin: &[u8]| first.get(..begin.len()).is_some_and(|is| is.eq_ignore_ascii_case(begin));
    (page(b"<!doctype html") || page(b"<html")).then_some("an HTML page (download the file itself)")
}

/// The name of a file's kind for an error message; if it is unknown, the first bytes.
pub(crate) fn kind_or_quote(bytes: &[u8]) -> String {
    kind(bytes).map_or_else(|| quote(bytes), str::to_owned)
}
