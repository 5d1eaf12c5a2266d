//! JSON and CBOR.

use std::fmt::Debug;

use mediant::{
    CornerRule, DiagonalGap, Ends, Engine, FiniteK, K, Motion, Path, PlacementKind, Point, Rectangle, Rules,
    Setup, Vertex,
    options::{EngineName, Levels, Memory},
};
use serde::{Serialize, de::DeserializeOwned};

use crate::bytes::Bytes;

/// The first byte chooses the type and the format; the rest is the text, or the bytes.
pub(crate) fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let what = bytes.byte();
    let (form, is_json) = (bytes.rest(), what < 128);
    match what % 17 {
        0 => read::<K>(form, is_json),
        1 => read::<FiniteK>(form, is_json),
        2 => read::<Vertex>(form, is_json),
        3 => read::<Point>(form, is_json),
        4 => read::<Rectangle>(form, is_json),
        5 => read::<Ends>(form, is_json),
        6 => read::<Rules>(form, is_json),
        7 => read::<CornerRule>(form, is_json),
        8 => read::<DiagonalGap>(form, is_json),
        9 => read::<PlacementKind>(form, is_json),
        10 => read::<Motion>(form, is_json),
        11 => read::<Path>(form, is_json),
        12 => read::<Setup>(form, is_json),
        13 => read::<Engine>(form, is_json),
        14 => read::<EngineName>(form, is_json),
        15 => read::<Levels>(form, is_json),
        _ => read::<Memory>(form, is_json),
    }
}

/// A value that is read is written in both formats, and read again.
fn read<T: Serialize + DeserializeOwned + PartialEq + Debug>(form: &[u8], is_json: bool) {
    let value: Option<T> =
        if is_json { serde_json::from_slice(form).ok() } else { ciborium::from_reader(form).ok() };
    let Some(value) = value else { return };
    let json = serde_json::to_string(&value).expect("it can be written");
    assert_eq!(serde_json::from_str::<T>(&json).ok().as_ref(), Some(&value), "{json}");
    let mut cbor = Vec::new();
    ciborium::into_writer(&value, &mut cbor).expect("it can be written");
    assert_eq!(ciborium::from_reader::<T, _>(&cbor[..]).ok().as_ref(), Some(&value), "{json}");
}
