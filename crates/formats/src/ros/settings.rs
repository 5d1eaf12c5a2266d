//! The YAML file of a ROS map.

use std::{fmt, fmt::Write as _};

use super::{
    RosError, flat,
    yaml::{self, YamlEntry},
};
use crate::{
    Fraction,
    text::{decimal, quote},
};

/// How the shades of the picture become occupancies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum RosMode {
    /// Occupied, free, or between the thresholds unknown.
    #[default]
    Trinary,
    /// Occupied, free, or between the thresholds 0 to 100 by proportion.
    Scale,
    /// The samples themselves, as of 8 bits: 0 to 100, all others unknown.
    Raw,
}

const MODES: [(&str, RosMode); 3] =
    [("trinary", RosMode::Trinary), ("scale", RosMode::Scale), ("raw", RosMode::Raw)];

/// As in the file.
impl fmt::Display for RosMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(MODES.iter().find(|(_, mode)| mode == self).map_or("", |(name, _)| name))
    }
}

/// The settings of a ROS map's YAML file, as `map_server` reads and `map_saver` writes them.
///
/// ```
/// use mediant_formats::{RosMode, RosSettings};
/// let yaml = "image: depot.pgm\nresolution: 0.05 # meters\norigin: [-10, -10.0, 0.0]\nnegate: 0\n\
///             occupied_thresh: 0.65\nfree_thresh: 0.196\n";
/// let settings = RosSettings::parse(yaml.as_bytes())?;
/// assert_eq!((settings.resolution, settings.mode), (0.05, RosMode::Trinary));
/// assert_eq!(RosSettings::parse(settings.to_yaml().as_bytes())?, settings);
/// # Ok::<(), mediant_formats::RosError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RosSettings {
    /// The file of the picture. A relative path starts at the folder of the YAML file.
    pub image: String,
    /// The side of a pixel, in meters.
    pub resolution: f64,
    /// The pose of the lower left corner of the picture: x and y in meters, yaw in radians.
    pub origin: [f64; 3],
    /// A pixel that is occupied to at least this is occupied; in ROS 1, to more than this.
    pub occupied_thresh: Fraction,
    /// A pixel that is occupied to at most this is free; in ROS 1, to less than this.
    pub free_thresh: Fraction,
    /// Whether light pixels are the occupied ones.
    pub negate: bool,
    /// How the shades become occupancies.
    pub mode: RosMode,
}

/// The keys that are read, each with a value that it could have.
const KEYS: [(&str, &str); 7] = [
    ("image", "map.pgm"),
    ("resolution", "0.05"),
    ("origin", "[-10.0, -10.0, 0.0]"),
    ("negate", "0"),
    ("occupied_thresh", "0.65"),
    ("free_thresh", "0.196"),
    ("mode", "trinary"),
];

impl RosSettings {
    /// The settings that savers write, for a picture: trinary, not negated, thresholds of 0.65 and 0.196. At
    /// the latter, the gray of 205 that savers write for unknown pixels is read as unknown.
    #[must_use]
    pub fn new(image: impl Into<String>, resolution: f64, origin: [f64; 3]) -> Self {
        Self {
            image: image.into(),
            resolution,
            origin,
            occupied_thresh: Fraction::new(65, 100).unwrap_or(Fraction::ONE),
            free_thresh: Fraction::new(196, 1000).unwrap_or(Fraction::ZERO),
            negate: false,
            mode: RosMode::Trinary,
        }
    }

    /// Reads the text of a YAML file.
    ///
    /// The keys are `image`, `resolution`, `origin`, `negate`, `occupied_thresh`, `free_thresh` and `mode`.
    /// All must be there, once, but `mode`, which is `trinary` if it is not. Other keys, such as those that
    /// extensions of `map_server` add, are ignored with their values. The file must have its keys at the
    /// start of lines, all indented alike, or in braces, `{image: a.pgm, …}`; values may be quoted, `origin`
    /// may be a list in brackets or one of a line each.
    ///
    /// # Errors
    /// [`RosError`] names the line and the key.
    pub fn parse(yaml: &[u8]) -> Result<Self, RosError> {
        let (entries, lines) = flat::entries(yaml, |key| KEYS.iter().any(|(known, _)| *known == key))?;
        let find = |name: &'static str| Value::find(&entries, lines, name);
        let mode = match entries.iter().any(|entry| entry.key == "mode") {
            true => find("mode")?.mode()?,
            false => RosMode::default(),
        };
        let (free, occupied) = (find("free_thresh")?, find("occupied_thresh")?);
        let settings = Self {
            image: find("image")?.image()?,
            resolution: find("resolution")?.resolution()?,
            origin: find("origin")?.origin()?,
            occupied_thresh: occupied.fraction()?,
            free_thresh: free.fraction()?,
            negate: find("negate")?.switch()?,
            mode,
        };
        settings.check_thresholds(|| format!("line {}", free.line.max(occupied.line)))?;
        Ok(settings)
    }

    pub(super) fn check_thresholds(&self, place: impl Fn() -> String) -> Result<(), RosError> {
        let (free, occupied) = (self.free_thresh, self.occupied_thresh);
        if free < occupied { Ok(()) } else { Err(RosError::Crossed { place: place(), free, occupied }) }
    }

    /// The text of a YAML file with these settings, in the order of `map_saver`.
    #[must_use]
    pub fn to_yaml(&self) -> String {
        let mut yaml = format!("image: {}\nmode: {}\n", yaml::quoted(&self.image), self.mode);
        let [x, y, yaw] = self.origin;
        // Writing to a string cannot fail.
        let _ = write!(
            yaml,
            "resolution: {}\norigin: [{x}, {y}, {yaw}]\nnegate: {}\noccupied_thresh: {}\nfree_thresh: {}\n",
            self.resolution,
            u8::from(self.negate),
            self.occupied_thresh,
            self.free_thresh,
        );
        yaml
    }
}

/// The value of a key that is there once.
struct Value<'a> {
    line: usize,
    key: &'static str,
    example: &'static str,
    text: &'a str,
}

impl<'a> Value<'a> {
    fn find(entries: &[YamlEntry<'a>], lines: usize, key: &'static str) -> Result<Self, RosError> {
        let example = KEYS.iter().find(|(name, _)| *name == key).map_or("", |(_, example)| *example);
        let mut found = entries.iter().filter(|entry| entry.key == key);
        let first = found.next().ok_or(RosError::MissingKey { line: lines + 1, key, example })?;
        match found.next() {
            None => Ok(Self { line: first.line, key, example, text: first.value }),
            Some(entry) => Err(RosError::Twice { line: entry.line, key, first: first.line }),
        }
    }

    fn error(&self, expected: &'static str) -> RosError {
        let found = quote(self.text.trim().as_bytes());
        RosError::Value { line: self.line, key: self.key, expected, found, example: self.example }
    }

    /// The value as one scalar, converted by `read`.
    fn scalar<T>(&self, expected: &'static str, read: impl FnOnce(&str) -> Option<T>) -> Result<T, RosError> {
        yaml::scalar(self.text).and_then(|text| read(&text)).ok_or_else(|| self.error(expected))
    }

    fn image(&self) -> Result<String, RosError> {
        self.scalar("the name of a picture", |text| (!text.is_empty()).then(|| text.to_owned()))
    }

    fn resolution(&self) -> Result<f64, RosError> {
        self.scalar("more than 0 meters a pixel", |text| decimal(text).filter(|&number| number > 0.0))
    }

    fn origin(&self) -> Result<[f64; 3], RosError> {
        let numbers: Option<Vec<f64>> =
            yaml::list(self.text).and_then(|items| items.iter().map(|item| decimal(item)).collect());
        let origin = numbers.and_then(|numbers| numbers.try_into().ok());
        origin.ok_or_else(|| self.error("a list of three numbers, x, y and yaw"))
    }

    fn fraction(&self) -> Result<Fraction, RosError> {
        self.scalar("a number of 0 to 1", |text| text.parse().ok())
    }

    fn switch(&self) -> Result<bool, RosError> {
        self.scalar("0 or 1", |text| match text {
            "0" => Some(false),
            "1" => Some(true),
            _ => switch(text),
        })
    }

    fn mode(&self) -> Result<RosMode, RosError> {
        self.scalar("`trinary`, `scale` or `raw`", |text| {
            MODES.iter().find(|(name, _)| *name == text).map(|&(_, mode)| mode)
        })
    }
}

/// A truth value in the words of YAML 1.1: in small letters, in capitals, or with one capital.
fn switch(text: &str) -> Option<bool> {
    const WORDS: [(&str, bool); 6] =
        [("true", true), ("false", false), ("yes", true), ("no", false), ("on", true), ("off", false)];
    let rest = text.get(1..)?;
    let even = rest == rest.to_ascii_lowercase() || text == text.to_ascii_uppercase();
    let word = text.to_ascii_lowercase();
    WORDS.iter().find(|(name, _)| even && *name == word).map(|&(_, value)| value)
}
