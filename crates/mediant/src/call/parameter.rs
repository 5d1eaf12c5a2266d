//! The table of all parameters.

use std::num::{IntErrorKind, ParseIntError};

use mediant_grid::{CornerRule, DiagonalGap, PlacementKind};
use mediant_search::Smoothing;

use super::Value;
#[cfg(feature = "publications")]
use crate::option::published;
use crate::{
    engine_name::EngineName,
    option::{EngineOption, ValueKind, table as option_table},
};

/// The spelling of names of several words in a language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Spelling {
    /// `max-cost`: the program.
    Kebab,
    /// `max_cost`: Python and Rust.
    Snake,
    /// `maxCost`: JavaScript.
    Camel,
}

impl Spelling {
    /// A kebab-case name as the language spells it: `max-cost`, `max_cost`, `maxCost`.
    #[must_use]
    pub fn spell(self, name: &str) -> String {
        self.letters(name).collect()
    }

    fn letters(self, name: &str) -> impl Iterator<Item = char> {
        let mut is_capital = false;
        name.chars().filter_map(move |letter| match (letter, self) {
            ('-', Self::Camel) => {
                is_capital = true;
                None
            }
            ('-', Self::Snake) => Some('_'),
            (letter, _) if std::mem::take(&mut is_capital) => Some(letter.to_ascii_uppercase()),
            (letter, _) => Some(letter),
        })
    }
}

/// The groups of parameters: a call takes whole groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Group {
    /// The motion of the agent.
    Motion,
    /// Wishes beyond the ends of a path.
    Wishes,
    /// The engine.
    Engine,
    /// The options of engines, and how paths are smoothed.
    Options,
}

impl Group {
    /// All groups, in the order of help.
    pub const ALL: [Self; 4] = [Self::Motion, Self::Wishes, Self::Engine, Self::Options];
}

/// The kinds of value that parameters take, for the types of a language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Kind {
    /// True or false.
    Flag,
    /// A whole number from 0 up.
    Count,
    /// A whole number from 1 up.
    Number,
    /// A number of 0 or more.
    Length,
    /// A whole number, or one of some names.
    NumberOrName,
    /// A whole number, or a text.
    NumberOrText,
    /// One of some names.
    Name,
}

/// The unit of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unit {
    /// Sides of cells.
    Cells,
    /// Seconds in Python, milliseconds in the program and in JavaScript.
    Time,
}

/// A parameter of calls.
#[derive(Debug, PartialEq)]
pub struct Parameter {
    /// Its name, in kebab-case: that of the program's flag.
    pub name: &'static str,
    /// The group that it belongs to.
    pub group: Group,
    /// The kind of its value.
    pub kind: Kind,
    /// The unit of its number, if it has one.
    pub unit: Option<Unit>,
    /// Its default, in words, if that is one value.
    pub default: Option<&'static str>,
    /// Its effect, in one to three sentences.
    pub help: &'static str,
    pub(super) meaning: Meaning,
}

/// The part of a [`Call`](super::Call) that a parameter sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Meaning {
    K,
    Neighbors,
    Placement,
    Corners,
    Gap,
    Nearest,
    Snap,
    Tolerance,
    MaxCost,
    MaxExpansions,
    Timeout,
    Engine,
    Option(&'static EngineOption),
    Smooth,
}

const fn motion(name: &'static str, kind: Kind, meaning: Meaning, help: &'static str) -> Parameter {
    Parameter { name, group: Group::Motion, kind, unit: None, default: None, help, meaning }
}

const fn wish(name: &'static str, kind: Kind, meaning: Meaning, help: &'static str) -> Parameter {
    Parameter { name, group: Group::Wishes, kind, unit: None, default: None, help, meaning }
}

const fn option(option: &'static EngineOption) -> Parameter {
    let kind = match option.kind {
        ValueKind::Flag => Kind::Flag,
        ValueKind::Number => Kind::Number,
        ValueKind::Heuristic => Kind::Name,
        #[cfg(feature = "publications")]
        ValueKind::Variant => Kind::Name,
        ValueKind::Levels => Kind::NumberOrName,
        ValueKind::Memory => Kind::NumberOrText,
    };
    let (name, help, meaning) = (option.name, option.help, Meaning::Option(option));
    Parameter { name, group: Group::Options, kind, unit: None, default: None, help, meaning }
}

/// All parameters of calls, in the order of help.
pub static PARAMETERS: [Parameter; if cfg!(feature = "publications") { 25 } else { 18 }] = [
    Parameter {
        default: Some("3"),
        ..motion(
            "k",
            Kind::NumberOrName,
            Meaning::K,
            "The neighborhood, of 2^k moves: k = 3 has 8, k = 8 has 256. From 2 to 12, or any, which is every \
             direction",
        )
    },
    motion(
        "neighbors",
        Kind::Count,
        Meaning::Neighbors,
        "The neighborhood by its number of moves, instead of k: 4, 8, 16, … 4096",
    ),
    Parameter {
        default: Some("center"),
        ..motion(
            "placement",
            Kind::Name,
            Meaning::Placement,
            "Where the vertices of paths are: at centers or at corners of cells. Corner (x, y) is the top left \
             one of cell (x, y). Corners by default for k = any, and for engines that search only there",
        )
    },
    Parameter {
        default: Some("never"),
        ..motion(
            "corners",
            Kind::Name,
            Meaning::Corners,
            "At centers, where a move touches a corner of cells: never cuts it (both cells beside it must be \
             free), one of them must be free, or it always may. Without a placement it means centers",
        )
    },
    Parameter {
        default: Some("open"),
        ..motion(
            "gap",
            Kind::Name,
            Meaning::Gap,
            "At corners, whether a path may pass where two blocked cells touch diagonally: open or closed. \
             Without a placement it means corners. At centers it is for any angle, and closed by default",
        )
    },
    wish(
        "nearest",
        Kind::Flag,
        Meaning::Nearest,
        "If there is no path, the path to the reachable vertex that is nearest to the goal",
    ),
    wish(
        "snap",
        Kind::Flag,
        Meaning::Snap,
        "Moves a start or goal that is blocked, or outside the map, to the nearest free vertex",
    ),
    Parameter {
        unit: Some(Unit::Cells),
        ..wish(
            "tolerance",
            Kind::Length,
            Meaning::Tolerance,
            "The path may end within this many cells of the goal, in a straight line, exactly so many included",
        )
    },
    Parameter {
        unit: Some(Unit::Cells),
        ..wish(
            "max-cost",
            Kind::Length,
            Meaning::MaxCost,
            "The greatest length of a path, in cells, or its cost where cells have costs; a path that is exactly as \
         long is within it. An engine that guarantees nothing may miss a path that is nearly as long",
        )
    },
    wish(
        "max-expansions",
        Kind::Count,
        Meaning::MaxExpansions,
        "The greatest number of expansions of the search",
    ),
    Parameter {
        unit: Some(Unit::Time),
        ..wish("timeout", Kind::Length, Meaning::Timeout, "The most time that the answer may take")
    },
    Parameter {
        name: "engine",
        group: Group::Engine,
        kind: Kind::Name,
        unit: None,
        default: Some("auto"),
        help: "The engine. auto is the one that is best for what is asked",
        meaning: Meaning::Engine,
    },
    option(&option_table::HEURISTIC),
    #[cfg(feature = "publications")]
    option(&published::VARIANT),
    #[cfg(feature = "publications")]
    option(&published::JUMP_LIMIT),
    #[cfg(feature = "publications")]
    option(&published::KEEP_INTERMEDIATE),
    option(&option_table::LEVELS),
    option(&option_table::MEMORY),
    option(&option_table::SIDE),
    option(&option_table::LANDMARKS),
    #[cfg(feature = "publications")]
    option(&published::UNSTRAIGHTENED),
    #[cfg(feature = "publications")]
    option(&published::SECOND),
    #[cfg(feature = "publications")]
    option(&published::STEP),
    #[cfg(feature = "publications")]
    option(&published::DETOUR),
    Parameter {
        name: "smooth",
        group: Group::Options,
        kind: Kind::Name,
        unit: None,
        default: None,
        help: "Shortens paths after the search, by straight segments at any angle: linear looks for the next \
               vertex in sight along the path, taut pulls the path tight around the corners",
        meaning: Meaning::Smooth,
    },
];

/// An integer; the largest for one that is larger.
fn integer(text: &str) -> Option<i64> {
    text.parse().map_or_else(
        |error: ParseIntError| match error.kind() {
            IntErrorKind::PosOverflow => Some(i64::MAX),
            IntErrorKind::NegOverflow => Some(i64::MIN),
            _ => None,
        },
        Some,
    )
}

impl Parameter {
    /// The parameter of these groups that a language spells like this.
    #[must_use]
    pub fn find(name: &str, spelling: Spelling, groups: &[Group]) -> Option<&'static Self> {
        PARAMETERS.iter().find(|parameter| {
            groups.contains(&parameter.group) && spelling.letters(parameter.name).eq(name.chars())
        })
    }

    /// The name as a language spells it.
    #[must_use]
    pub fn spelled(&self, spelling: Spelling) -> String {
        spelling.spell(self.name)
    }

    /// The names of all parameters of these groups, as a language spells them.
    pub fn names(groups: &[Group], spelling: Spelling) -> impl Iterator<Item = String> {
        PARAMETERS
            .iter()
            .filter(|parameter| groups.contains(&parameter.group))
            .map(move |parameter| parameter.spelled(spelling))
    }

    /// The engine's option that it is, if it is one.
    #[must_use]
    pub const fn option(&self) -> Option<&'static EngineOption> {
        match self.meaning {
            Meaning::Option(option) => Some(option),
            _ => None,
        }
    }

    /// A text as a value: a number where it takes one and the text is one.
    #[must_use]
    pub fn value<'a>(&self, text: &'a str) -> Value<'a> {
        let number = || text.parse().ok().map(Value::Number);
        let value = match self.kind {
            Kind::Flag | Kind::Name => None,
            Kind::Length => number(),
            // A number that is no integer gets its own error.
            _ => integer(text).map(Value::Integer).or_else(number),
        };
        value.unwrap_or_else(|| text.into())
    }

    /// The names that its value may have; empty where it is no name.
    #[must_use]
    pub fn values(&self) -> Vec<&'static str> {
        match self.meaning {
            Meaning::K => vec!["any"],
            Meaning::Placement => PlacementKind::ALL.map(PlacementKind::name).to_vec(),
            Meaning::Corners => CornerRule::ALL.map(CornerRule::name).to_vec(),
            Meaning::Gap => DiagonalGap::ALL.map(DiagonalGap::name).to_vec(),
            Meaning::Engine => EngineName::all().into_iter().map(EngineName::name).collect(),
            Meaning::Smooth => Smoothing::ALL.map(Smoothing::name).to_vec(),
            Meaning::Option(option) => option.names(),
            _ => Vec::new(),
        }
    }

    /// The parameter with a meaning.
    pub(super) fn of(meaning: Meaning) -> &'static Self {
        PARAMETERS.iter().find(|parameter| parameter.meaning == meaning).unwrap_or(&PARAMETERS[0])
    }
}
