//! Serde's forms: motion by its parts; engines, setups and options by their text.

use mediant_grid::Rules;
use mediant_moves::K;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de, ser};

use crate::{
    engine::Engine,
    engine_name::EngineName,
    motion::Motion,
    option::{Levels, Memory},
    setup::Setup,
};

/// A motion, without what is wrong with it.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Motion", deny_unknown_fields)]
struct Parts {
    k: K,
    rules: Rules,
}

/// As `{"k": 3, "rules": {"center": "never"}}`. A motion that was made with a number that is no k cannot be
/// written.
impl Serialize for Motion {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.check_k().map_err(ser::Error::custom)?;
        Parts { k: self.k, rules: self.rules }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Motion {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Parts::deserialize(deserializer).map(|Parts { k, rules }| Self::of(k, rules))
    }
}

/// Types that are written as their text, and read from it.
macro_rules! by_text {
    ($($type:ty),+) => {
        $(
            /// As its text.
            impl Serialize for $type {
                fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                    serializer.collect_str(self)
                }
            }

            impl<'de> Deserialize<'de> for $type {
                fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                    String::deserialize(deserializer)?.parse().map_err(de::Error::custom)
                }
            }
        )+
    };
}

by_text!(Engine, EngineName, Setup, Memory, Levels);
