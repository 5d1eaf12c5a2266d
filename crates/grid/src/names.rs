//! Enums whose values have names that people type: the one place where a word stands.

/// The error for a text that is none of an enum's names.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected one of {known}, found `{found}`")]
pub struct UnknownName {
    /// The text.
    pub found: String,
    /// All names, separated by commas.
    pub known: String,
}

/// A name as it is compared: small letters, without hyphens, underscores and spaces, `+` and `*` as words.
#[must_use]
pub fn letters(text: &str) -> String {
    let mut letters = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '-' | '_' | ' ' => {}
            '+' => letters.push_str("plus"),
            '*' => letters.push_str("star"),
            letter => letters.extend(letter.to_lowercase()),
        }
    }
    letters
}

/// Whether a text means a name: they are the same but for capitals, hyphens, underscores and spaces, `+` for
/// `plus` and `*` for `star`. People write the star of an algorithm that the name leaves out (`Theta*`).
#[must_use]
pub fn means(text: &str, name: &str) -> bool {
    if text == name {
        return true;
    }
    let (text, name) = (letters(text), letters(name));
    text == name || text.strip_suffix("star") == Some(&*name)
}

/// Gives an enum `ALL`, `name`, [`Display`](std::fmt::Display) and [`FromStr`](std::str::FromStr) by the name
/// of each variant, or what [`means`](crate::names::means) it, or another name that is read, too.
#[macro_export]
#[doc(hidden)]
macro_rules! names {
    ($type:ident: $($(#[$attribute:meta])* $variant:ident => $name:literal $(| $other:literal)*),+ $(,)?) => {
        impl $type {
            /// All values.
            pub const ALL: [Self; [$($(#[$attribute])* $name),+].len()] = [$($(#[$attribute])* Self::$variant),+];

            /// All values, one after the other.
            pub fn all() -> impl Iterator<Item = Self> {
                Self::ALL.into_iter()
            }

            /// The name, as people and scripts write it.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $($(#[$attribute])* Self::$variant => $name),+ }
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(self.name())
            }
        }

        impl std::str::FromStr for $type {
            type Err = $crate::names::UnknownName;

            fn from_str(text: &str) -> Result<Self, $crate::names::UnknownName> {
                let means = $crate::names::means;
                $(
                    $(#[$attribute])*
                    {
                        if means(text, $name) $(|| means(text, $other))* {
                            return Ok(Self::$variant);
                        }
                    }
                )+
                let known = Self::ALL.map(Self::name).join(", ");
                Err($crate::names::UnknownName { found: text.to_owned(), known })
            }
        }
    };
}
