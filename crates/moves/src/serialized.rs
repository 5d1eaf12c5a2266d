//! k as serde reads and writes it.

use core::fmt;

use serde::{
    Deserialize, Deserializer, Serialize, Serializer,
    de::{Error, Visitor},
};

use crate::{FiniteK, K};

/// As its number.
impl Serialize for FiniteK {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u32(self.get())
    }
}

impl<'de> Deserialize<'de> for FiniteK {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::new(u32::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}

/// As its number, or `"any"`. Formats that people do not read have an optional number.
impl Serialize for K {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            _ if !serializer.is_human_readable() => self.finite().serialize(serializer),
            Self::Finite(k) => k.serialize(serializer),
            Self::Any => serializer.serialize_str("any"),
        }
    }
}

impl<'de> Deserialize<'de> for K {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        if deserializer.is_human_readable() {
            return deserializer.deserialize_any(NumberOrText);
        }
        Ok(Option::<FiniteK>::deserialize(deserializer)?.map_or(Self::Any, Self::Finite))
    }
}

struct NumberOrText;

impl Visitor<'_> for NumberOrText {
    type Value = K;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a k: a number from 2 up, or \"any\"")
    }

    fn visit_u64<E: Error>(self, k: u64) -> Result<K, E> {
        K::try_from(k).map_err(E::custom)
    }

    fn visit_i64<E: Error>(self, k: i64) -> Result<K, E> {
        K::try_from(k).map_err(E::custom)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<K, E> {
        text.parse().map_err(E::custom)
    }
}
