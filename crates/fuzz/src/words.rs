//! Names, and texts of options, setups and calls.

use std::{
    fmt::{Debug, Display},
    str::FromStr,
    sync::LazyLock,
};

use mediant::{
    CornerRule, DiagonalGap, Engine, ErrorCode, K, Map, Pace, PlacementKind, Query, Setup,
    call::{Call, Group, Parameter, Spelling},
    options::{EngineName, Levels, Memory},
};
use mediant_formats::Fraction;

use crate::bytes::Bytes;

/// The first byte chooses: a text of one of the types, or lines `name=value` of a call in one of the
/// spellings.
pub(crate) fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let what = bytes.byte();
    let Ok(text) = std::str::from_utf8(bytes.rest()) else { return };
    match what % 16 {
        0 => read::<K>(text),
        1 => read::<CornerRule>(text),
        2 => read::<DiagonalGap>(text),
        3 => read::<PlacementKind>(text),
        4 => read::<Engine>(text),
        5 => read::<EngineName>(text),
        6 => read::<Levels>(text),
        7 => read::<Memory>(text),
        8 => read::<Fraction>(text),
        9 => read::<Setup>(text),
        10 => read::<ErrorCode>(text),
        11 => pace(text),
        _ => call(text, what),
    }
}

/// A value that is read is written, and read again.
fn read<T: FromStr + Display + PartialEq + Debug>(text: &str) {
    if let Ok(value) = text.parse::<T>() {
        let again = value.to_string().parse::<T>().ok();
        assert_eq!(again.as_ref(), Some(&value), "{value}");
    }
}

fn pace(text: &str) {
    if let Ok(pace) = text.parse::<Pace>() {
        let name = pace.name().expect("a pace by a name has one");
        assert_eq!(name.parse::<Pace>().ok(), Some(pace));
    }
}

/// Lines `name=value`. What no parameter means is not asked for: a search takes a thousand times as long as
/// reading its call.
fn call(text: &str, what: u8) {
    let spelling = [Spelling::Kebab, Spelling::Snake, Spelling::Camel][usize::from(what / 16) % 3];
    let (mut call, mut is_set) = (Call::default(), false);
    for line in text.lines() {
        let Some((name, value)) = line.split_once('=') else { continue };
        let Some(parameter) = Parameter::find(name, spelling, &Group::ALL) else { continue };
        assert_eq!(parameter.spelled(spelling), name);
        match call.set(parameter, parameter.value(value)) {
            Ok(()) => is_set = true,
            Err(error) => {
                assert!(error.text(spelling).contains(name), "{} does not name {name}", error.text(spelling));
                return;
            }
        }
    }
    if is_set {
        asked(&call, Engine::ALL[usize::from(what) % Engine::ALL.len()]);
    }
}

/// A call that has a meaning is asked of a small map, by one engine.
fn asked(call: &Call, engine: Engine) {
    static MAP: LazyLock<Map> = LazyLock::new(|| Map::from_rows(["....", ".##.", "...."]).expect("a map"));
    let Ok(motion) = call.motion() else { return };
    let _ = call.check();
    let Ok(configured) = call.configured(engine) else { return };
    // The tables of canonical search for a greater k take seconds, once a process.
    if motion.k.finite().is_some_and(|k| k.get() > 6) {
        return;
    }
    let Ok(space) = MAP.space(motion) else { return };
    assert_eq!(space.motion(), motion);
    let Ok(mut planner) = space.planner(configured) else { return };
    let answer = planner.find(Query::new((0, 0), (3, 2)));
    let answer = answer.unwrap_or_else(|error| panic!("{engine}, {motion}: {error}"));
    let path = answer.path().unwrap_or_else(|| panic!("{engine}, {motion}: {answer:?}"));
    assert_eq!(space.check(path), Ok(()), "{engine}, {motion}: {path}");
}
