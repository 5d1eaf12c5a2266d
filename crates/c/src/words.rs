//! Parameters of calls, as a text of names and values: `"k=any gap=closed nearest"`.

#![allow(unsafe_code, reason = "texts of C")]

use std::{ffi::c_char, time::Duration};

use library::{
    Limits, Query,
    call::{Call, Group, Parameter, Spelling, Value},
    errors::absent,
};

use crate::{failure::Failure, memory, watch::Watch};

/// The groups of parameters that a function takes.
pub(crate) type Takes = &'static [Group];

pub(crate) const ALL: Takes = &Group::ALL;
pub(crate) const MOTION: Takes = &[Group::Motion];
pub(crate) const WISHES: Takes = &[Group::Wishes];
pub(crate) const PREPARATION: Takes = &[Group::Engine, Group::Options];
pub(crate) const OPTIONS: Takes = &[Group::Options];

/// Reads the parameters of a call. Null is a text without any.
///
/// # Safety
/// As for [`memory::text`].
pub(crate) unsafe fn read(name: &str, words: *const c_char, takes: Takes) -> Result<Call, Failure> {
    // SAFETY: the caller promises it.
    let words = unsafe { memory::text(name, words) }?;
    let mut call = Call::default();
    for word in words.unwrap_or_default().split_whitespace() {
        let (key, value) = word.split_once('=').map_or((word, None), |(key, value)| (key, Some(value)));
        let parameter =
            Parameter::find(key, Spelling::Snake, takes).ok_or_else(|| unknown(name, key, takes))?;
        // A name alone is a flag that is set.
        let value = match value {
            None | Some("true") => Value::Flag(true),
            Some("false") => Value::Flag(false),
            Some(text) => parameter.value(text),
        };
        call.set(parameter, value)?;
    }
    Ok(call)
}

fn unknown(name: &str, key: &str, takes: Takes) -> Failure {
    let why = absent(key).map_or(String::new(), |why| format!(" ({why})"));
    let known: Vec<_> = Parameter::names(takes, Spelling::Snake).collect();
    let known = known.join(", ");
    Failure::argument(name, &format!("no parameter '{key}' is known{why}; the parameters are {known}"))
}

/// The query of a call. Its time begins now.
pub(crate) fn query(
    call: &Call,
    starts: &[library::Point],
    goals: &[library::Point],
    watch: &Watch,
) -> Query {
    let limits = timed(call, watch.limit(call.wishes().limits()));
    call.wishes().query(starts, goals, limits)
}

/// The limits of preparing what a call needs. Its time begins now.
pub(crate) fn preparing(call: &Call, watch: &Watch) -> Limits {
    timed(call, limits(watch))
}

/// Limits with the time that a call may take, from now on.
fn timed(call: &Call, limits: Limits) -> Limits {
    match call.wishes().timeout.and_then(milliseconds) {
        Some(most) => limits.time(most),
        None => limits,
    }
}

/// A time in milliseconds. More than a clock can count is no limit.
fn milliseconds(time: f64) -> Option<Duration> {
    Duration::try_from_secs_f64(time / 1000.0).ok()
}

/// The limits of what is no search.
pub(crate) fn limits(watch: &Watch) -> Limits {
    watch.limit(Limits::new())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_in_milliseconds() {
        assert_eq!(milliseconds(1500.0), Some(Duration::from_millis(1500)));
        assert_eq!(milliseconds(0.25), Some(Duration::from_micros(250)));
        assert_eq!(milliseconds(f64::MAX), None);
    }
}
