//! The values of arguments: how each kind is read, and what is said of a wrong one.

use std::{
    ffi::OsStr,
    fmt::Display,
    num::{IntErrorKind, ParseIntError},
    str::FromStr,
};

use clap::{
    Arg, Command,
    builder::{PossibleValue, PossibleValuesParser, TypedValueParser},
};
use mediant::{FiniteK, Vertex, errors::UnknownName};

/// Reads one of these values by its name, or as people write it (`A*`). Any other text gets clap's error,
/// which suggests the one that is most like it.
pub(super) fn one_of<T: Named>(all: Vec<T>, name: fn(T) -> &'static str) -> OneOf<T> {
    OneOf { names: PossibleValuesParser::new(all.iter().cloned().map(name)), all }
}

/// The parser of [`one_of`].
pub(super) trait Named:
    FromStr<Err = UnknownName> + Clone + PartialEq + Send + Sync + 'static
{
}

impl<T: FromStr<Err = UnknownName> + Clone + PartialEq + Send + Sync + 'static> Named for T {}

#[derive(Clone)]
pub(super) struct OneOf<T> {
    names: PossibleValuesParser,
    all: Vec<T>,
}

impl<T: Named> TypedValueParser for OneOf<T> {
    type Value = T;

    fn parse_ref(&self, command: &Command, arg: Option<&Arg>, text: &OsStr) -> Result<T, clap::Error> {
        let value = text.to_str().and_then(|text| text.parse().ok());
        match value.filter(|value| self.all.contains(value)) {
            Some(value) => Ok(value),
            None => self.names.clone().try_map(|name| name.parse()).parse_ref(command, arg, text),
        }
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        self.names.possible_values()
    }
}

/// Reads `X,Y`.
pub(super) fn parse_vertex(text: &str) -> Result<Vertex, String> {
    const EXPECTED: &str = "expected two numbers, such as 3,14";
    let parts: Vec<&str> = text.split(',').collect();
    match parts[..] {
        [x, y] => Ok(Vertex::new(parse_coordinate(x)?, parse_coordinate(y)?)),
        [_] => Err(EXPECTED.to_owned()),
        _ => Err(format!("{EXPECTED}, found {} parts", parts.len())),
    }
}

/// A place that an argument names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Place {
    /// Two whole numbers: a vertex, or a point in the world.
    Vertex(Vertex),
    /// Two numbers: a point of the map, in cells, or of the world, in meters.
    Point(f64, f64),
}

impl Place {
    /// As a point in the world.
    pub(crate) fn point(self) -> (f64, f64) {
        match self {
            Self::Vertex(at) => (f64::from(at.x), f64::from(at.y)),
            Self::Point(x, y) => (x, y),
        }
    }
}

/// Reads `X,Y`: whole numbers, or decimals, in cells or meters. The error of other texts is that of a vertex.
pub(crate) fn parse_place(text: &str) -> Result<Place, String> {
    let error = match parse_vertex(text) {
        Ok(at) => return Ok(Place::Vertex(at)),
        Err(error) => error,
    };
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    let is_decimal = text.contains(['.', 'e', 'E']);
    let point = text.split_once(',').and_then(|(x, y)| number(x).zip(number(y))).filter(|_| is_decimal);
    point.map(|(x, y)| Place::Point(x, y)).ok_or(error)
}

/// Reads `X1,Y1,X2,Y2`: the places of a start and a goal.
pub(crate) fn parse_pair(text: &str) -> Result<[Place; 2], String> {
    let commas: Vec<usize> = text.match_indices(',').map(|(at, _)| at).collect();
    match commas[..] {
        [_, middle, _] => Ok([parse_place(&text[..middle])?, parse_place(&text[middle + 1..])?]),
        _ => Err(format!("expected x1,y1,x2,y2 such as 1,11,40,30, found {} parts", commas.len() + 1)),
    }
}

/// Reads `X,Y,YAW`: three finite numbers.
pub(super) fn parse_pose(text: &str) -> Result<[f64; 3], String> {
    let numbers: Option<Vec<f64>> = text
        .split(',')
        .map(|part| part.trim().parse().ok().filter(|number: &f64| number.is_finite()))
        .collect();
    let pose = numbers.and_then(|numbers| numbers.try_into().ok());
    pose.ok_or_else(|| "expected three numbers, such as -1.5,2,0: meters, meters and radians".to_owned())
}

/// Reads a finite number.
pub(super) fn parse_number(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| "expected a number, such as -9999".to_owned())
}

/// Reads a coordinate.
fn parse_coordinate(text: &str) -> Result<i32, String> {
    text.trim().parse().map_err(|error: ParseIntError| match error.kind() {
        IntErrorKind::PosOverflow => format!("`{text}` is too large: coordinates go up to {}", i32::MAX),
        IntErrorKind::NegOverflow => format!("`{text}` is too small: coordinates go down to {}", i32::MIN),
        _ => format!("`{text}` is no number; write X,Y such as 3,14"),
    })
}

/// Reads a whole number from 1 to `max`.
pub(super) fn parse_count<N: FromStr<Err = ParseIntError> + Display>(
    text: &str,
    max: &N,
) -> Result<N, String> {
    text.parse().map_err(|error: ParseIntError| match error.kind() {
        IntErrorKind::PosOverflow => format!("expected a whole number from 1 to {max}"),
        _ => "expected a whole number from 1 up".to_owned(),
    })
}

/// Reads a number of these units, 0 or more.
pub(super) fn parse_amount(text: &str, units: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(amount) if amount >= 0.0 && amount.is_finite() => Ok(amount),
        _ => Err(format!("expected a number of {units}, 0 or more, such as 2.5")),
    }
}

/// Reads a k whose moves can be computed, even if no grid graph takes it.
pub(super) fn parse_any_k(text: &str) -> Result<FiniteK, String> {
    let max = FiniteK::MAX_MOVES;
    let form = format!("choose a number from 2 to {max}");
    let k =
        FiniteK::new(text.parse().map_err(|_| form.clone())?).map_err(|error| format!("{error}; {form}"))?;
    match k.radius() {
        Ok(_) => Ok(k),
        Err(error) => Err(error.to_string()),
    }
}

/// Reads the number of moves of a neighborhood whose moves can be computed.
pub(super) fn parse_any_neighbors(text: &str) -> Result<FiniteK, String> {
    let moves = text.parse().map_err(|_| "expected a number of moves: 4, 8, 16, …".to_owned())?;
    let k = FiniteK::from_neighbors(moves).map_err(|error| error.to_string())?;
    k.radius().map_or_else(|error| Err(error.to_string()), |_| Ok(k))
}

/// Reads a ratio of lengths, at least 1.
pub(super) fn parse_ratio(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(ratio) if ratio >= 1.0 && ratio.is_finite() => Ok(ratio),
        _ => {
            Err("expected a number from 1 up, such as 1.01: no path is shorter than an any-angle path"
                .to_owned())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_may_be_negative_and_spaced() {
        assert_eq!(parse_vertex("-1, 3"), Ok(Vertex::new(-1, 3)));
        assert!(parse_vertex("3").is_err() && parse_vertex("3,").is_err() && parse_vertex("1,2,3").is_err());
        assert!(parse_vertex("99999999999,0").is_err());
    }

    #[test]
    fn places_may_be_decimals() {
        assert_eq!(parse_place("2.5,-1"), Ok(Place::Point(2.5, -1.0)));
        assert_eq!(parse_place("1e3,0"), Ok(Place::Point(1000.0, 0.0)));
        for wrong in ["nan,1", "inf,0.5", "2.5", "1.5,2,3", "e,1"] {
            assert!(parse_place(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn poses_are_three_finite_numbers() {
        assert_eq!(parse_pose("-1.5, 2,0"), Ok([-1.5, 2.0, 0.0]));
        for wrong in ["1,2", "1,2,3,4", "1,2,nan", "inf,0,0", "a,b,c", ""] {
            assert!(parse_pose(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn amounts_are_finite_and_not_negative() {
        assert_eq!([parse_amount("2.5", "cells"), parse_amount("0", "cells")], [Ok(2.5), Ok(0.0)]);
        for wrong in ["-1", "nan", "NaN", "inf", "1e999", "-1e-9", "two", ""] {
            assert!(parse_amount(wrong, "cells").is_err(), "{wrong}");
        }
    }
}
