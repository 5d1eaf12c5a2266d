//! The parameters of calls as flags, made from the library's table: each parameter is a flag here.

use std::ffi::OsStr;

use clap::{
    Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches,
    builder::{PossibleValue, PossibleValuesParser, StringValueParser, TypedValueParser},
    error::ErrorKind,
};
use mediant::call::{Call, CallError, Group, Kind, PARAMETERS, Parameter, Unit};

/// The motion of the agent.
pub(crate) const MOTION: u8 = 1;
/// Wishes beyond the ends of a path.
pub(crate) const WISHES: u8 = 2;
/// The engine.
pub(crate) const ENGINE: u8 = 4;
/// The options of engines that decide what an index holds.
pub(crate) const INDEX_OPTIONS: u8 = 8;
/// All options of engines.
pub(crate) const OPTIONS: u8 = 16 | INDEX_OPTIONS;
/// The smoothing of paths.
pub(crate) const SMOOTH: u8 = 32;

/// The parameters that were given, of those that a command takes.
#[derive(Clone, Debug)]
pub(crate) struct Flags<const TAKES: u8>(pub(crate) Call);

impl<const TAKES: u8> Flags<TAKES> {
    /// The parameters that the command takes.
    fn taken() -> impl Iterator<Item = &'static Parameter> {
        PARAMETERS.iter().filter(|parameter| {
            let needed = match (parameter.group, parameter.option()) {
                (Group::Motion, _) => MOTION,
                (Group::Wishes, _) => WISHES,
                (Group::Engine, _) => ENGINE,
                (Group::Options, Some(option)) if option.is_index_option => INDEX_OPTIONS,
                (Group::Options, Some(_)) => OPTIONS,
                (Group::Options, None) => SMOOTH,
            };
            TAKES & needed == needed
        })
    }
}

impl<const TAKES: u8> Args for Flags<TAKES> {
    fn augment_args(command: Command) -> Command {
        command.args(Self::taken().map(flag))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<const TAKES: u8> FromArgMatches for Flags<TAKES> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut call = Call::default();
        for parameter in Self::taken() {
            let set = match parameter.kind {
                Kind::Flag => call.set(parameter, matches.get_flag(parameter.name).into()),
                _ => match matches.get_one::<String>(parameter.name) {
                    Some(text) => call.set(parameter, parameter.value(text)),
                    None => Ok(()),
                },
            };
            // The flag's parser has accepted the text already.
            set.map_err(|error| clap::Error::raw(ErrorKind::ValueValidation, error))?;
        }
        Ok(Self(call))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// The flag of a parameter.
fn flag(parameter: &'static Parameter) -> Arg {
    let arg = Arg::new(parameter.name).long(parameter.name).help(help(parameter));
    let arg = match parameter.name {
        // The names that these limits had first.
        "max-expansions" => arg.alias("max-nodes"),
        "timeout" => arg.alias("deadline"),
        // `--smooth` alone is `--smooth=linear`.
        "smooth" => arg.num_args(0..=1).require_equals(true).default_missing_value("linear"),
        _ => arg,
    };
    if parameter.kind == Kind::Flag {
        return arg.action(ArgAction::SetTrue);
    }
    let names = parameter.values();
    let value_name = match (parameter.kind, parameter.unit) {
        (_, Some(Unit::Cells)) => "CELLS".to_owned(),
        (_, Some(Unit::Time)) => "MS".to_owned(),
        (Kind::Name, _) if names.len() <= 3 => names.join("|"),
        (Kind::Name, _) => parameter.name.to_uppercase(),
        (Kind::NumberOrText, _) => "BYTES".to_owned(),
        (Kind::NumberOrName, _) => format!("N|{}", names.join("|")),
        _ => "N".to_owned(),
    };
    let arg = arg.value_name(value_name).value_parser(OfParameter(parameter));
    if parameter.kind == Kind::Name { arg } else { arg.allow_negative_numbers(true) }
        .hide_possible_values(names.len() <= 3)
}

/// The help text of a parameter.
fn help(parameter: &Parameter) -> String {
    let unit = match parameter.unit {
        Some(Unit::Time) => ", in milliseconds, for each query",
        _ => "",
    };
    let default = parameter.default.map_or(String::new(), |default| format!(" [default: {default}]"));
    format!("{}{unit}{default}", parameter.help)
}

/// Reads the value of a parameter. A value that it does not take gets the library's error; a name that does
/// not exist gets clap's, which suggests the one that is most like it.
#[derive(Clone)]
struct OfParameter(&'static Parameter);

impl TypedValueParser for OfParameter {
    type Value = String;

    fn parse_ref(&self, command: &Command, arg: Option<&Arg>, text: &OsStr) -> Result<String, clap::Error> {
        let parameter = self.0;
        let read = move |text: String| Call::default().set(parameter, parameter.value(&text)).map(|()| text);
        match text.to_str().map(|text| read(text.to_owned())) {
            Some(Err(CallError::Name { .. })) if parameter.kind == Kind::Name => {
                PossibleValuesParser::new(parameter.values()).parse_ref(command, arg, text)
            }
            _ => {
                let read = move |text| read(text).map_err(|error| error.wrong());
                StringValueParser::new().try_map(read).parse_ref(command, arg, text)
            }
        }
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let values = if self.0.kind == Kind::Name { self.0.values() } else { Vec::new() };
        (!values.is_empty()).then(|| Box::new(values.into_iter().map(PossibleValue::new)) as Box<_>)
    }
}
