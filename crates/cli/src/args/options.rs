//! The flags of the engines' options, made from the catalog: each of its options is a flag here.

use clap::{
    Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches,
    builder::{PossibleValuesParser, ValueParser},
    error::ErrorKind,
};
use mediant::{EngineOption, OptionValue, ValueKind};

/// The options that were given, of those that a command takes: all, or only those that decide what an index
/// holds.
#[derive(Debug)]
pub(crate) struct Options<const OF_INDEX: bool>(Given);

/// Options that were given, with their values.
pub(crate) type Given = Vec<(&'static EngineOption, OptionValue)>;

/// The options of `mediant run`: all.
pub(crate) type AllOptions = Options<false>;

/// The options of `mediant build`: those that decide what an index holds.
pub(crate) type IndexOptions = Options<true>;

impl<const OF_INDEX: bool> Options<OF_INDEX> {
    /// The options that the command takes.
    fn taken() -> impl Iterator<Item = &'static EngineOption> {
        EngineOption::ALL.into_iter().filter(|option| !OF_INDEX || option.is_index_option)
    }

    /// The options that were given.
    pub(super) fn given(&self) -> Given {
        self.0.clone()
    }
}

impl<const OF_INDEX: bool> Args for Options<OF_INDEX> {
    fn augment_args(command: Command) -> Command {
        command.args(Self::taken().map(flag))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<const OF_INDEX: bool> FromArgMatches for Options<OF_INDEX> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut given = Vec::new();
        for option in Self::taken() {
            let text = match option.kind {
                ValueKind::Flag => matches.get_flag(option.name).then_some(""),
                _ => matches.get_one::<String>(option.name).map(String::as_str),
            };
            if let Some(text) = text {
                // The flag's parser has accepted the text already.
                let value = option.parse(text);
                given.push((
                    option,
                    value.map_err(|wrong| clap::Error::raw(ErrorKind::ValueValidation, wrong))?,
                ));
            }
        }
        Ok(Self(given))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// The flag of an option.
fn flag(option: &'static EngineOption) -> Arg {
    let arg = Arg::new(option.name).long(option.name).help(option.help);
    let checked = ValueParser::new(move |text: &str| option.parse(text).map(|_| text.to_owned()));
    match option.kind {
        ValueKind::Flag => arg.action(ArgAction::SetTrue),
        ValueKind::Number => arg.value_name("N").allow_negative_numbers(true).value_parser(checked),
        ValueKind::Memory => arg.value_name("BYTES").value_parser(checked),
        ValueKind::Levels => {
            arg.value_name("N|all|contracted|labels").allow_negative_numbers(true).value_parser(checked)
        }
        ValueKind::Heuristic | ValueKind::Variant => {
            let name = if option.kind == ValueKind::Variant { "VARIANT" } else { "HEURISTIC" };
            arg.value_name(name).value_parser(PossibleValuesParser::new(option.names()))
        }
    }
}
