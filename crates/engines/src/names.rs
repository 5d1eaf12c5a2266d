//! Closed enums with the names that people type.

/// A name that is none of those that there are.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected one of {known}, found `{found}`")]
pub struct UnknownName {
    /// What was found.
    pub found: String,
    /// All names.
    pub known: String,
}

/// Gives a closed enum its list and its names.
macro_rules! names {
    ($type:ident: $($variant:ident => $name:literal),+ $(,)?) => {
        impl $type {
            /// All of them.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$variant),+];

            /// The name, as options and tables have it.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),+ }
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(self.name())
            }
        }

        impl std::str::FromStr for $type {
            type Err = $crate::UnknownName;

            fn from_str(text: &str) -> Result<Self, $crate::UnknownName> {
                Self::ALL.into_iter().find(|value| value.name() == text).ok_or_else(|| $crate::UnknownName {
                    found: text.to_owned(),
                    known: Self::ALL.map(Self::name).join(", "),
                })
            }
        }
    };
}

pub(crate) use names;

/// What guides a search.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum HeuristicName {
    /// The cost on an empty grid.
    #[default]
    Hk,
    /// The straight-line distance.
    Euclidean,
    /// None.
    Zero,
    /// The square of the straight-line distance, which overestimates.
    SquaredEuclidean,
}

names!(HeuristicName: Hk => "hk", Euclidean => "euclidean", Zero => "zero", SquaredEuclidean => "squared");

/// Of an engine that was published with a flaw, which.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Variant {
    /// The rule that is optimal.
    Exact,
    /// The search that finds a path whenever there is one.
    Complete,
    /// As published.
    Paper,
}

names!(Variant: Exact => "exact", Complete => "complete", Paper => "paper");
