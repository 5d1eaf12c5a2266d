//! Setups as text, written and read.

use std::{fmt, str::FromStr};

use mediant_grid::{CornerRule, DiagonalGap, Rules};
use mediant_search::Smoothing;

use crate::{
    capabilities::Capabilities, engine::Engine, motion::Motion, option::EngineOption, setup::Setup,
    setup_error::TextError,
};

/// The names of all rules.
const RULES: &str = "never, one, always, open, closed, center-open, center-closed";

/// Stands before the gap rule of paths at any angle between centers.
const BETWEEN_CENTERS: &str = "center-";

/// All that may be written for an option, for an error.
fn option_forms() -> String {
    let forms = EngineOption::ALL.map(EngineOption::forms);
    let smoothings = [Smoothing::Linear, Smoothing::Taut].map(smoothing_name);
    [forms.join(", "), smoothings.join(", ")].join(", ")
}

/// With k and rule in full, and the options that were chosen: what [`FromStr`] reads.
impl fmt::Display for Setup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rule = match self.rules() {
            Rules::CenterGap(gap) => format!("{BETWEEN_CENTERS}{gap}"),
            _ => self.rule_name(),
        };
        let options = self.engine.chosen().into_iter().map(|(option, value)| option.text(value));
        let smoothing = self.smoothing.map(|smoothing| smoothing_name(smoothing).to_owned());
        let options: String = options.chain(smoothing).map(|option| format!(",{option}")).collect();
        f.pad(&format!("{}:{}:{rule}{options}", self.engine.kind(), self.k()))
    }
}

impl Setup {
    /// The name of the corner rule or gap rule: `never`, `one`, `always`, `open` or `closed`.
    #[must_use]
    pub fn rule_name(&self) -> String {
        match self.rules() {
            Rules::Center(rule) => rule.to_string(),
            Rules::Corner(gap) | Rules::CenterGap(gap) => gap.to_string(),
        }
    }
}

impl FromStr for Setup {
    type Err = TextError;

    fn from_str(text: &str) -> Result<Self, TextError> {
        let error = |wrong: String| TextError { found: text.to_owned(), wrong };
        let mut options = text.split(',');
        let mut parts = options.next().unwrap_or_default().split(':');
        let name = parts.next().unwrap_or_default();
        let engine: Engine = name
            .parse()
            .map_err(|_| error(format!("the engines are {}", Engine::ALL.map(Engine::name).join(", "))))?;
        let capabilities = engine.capabilities();
        let k = parts.next().map_or(Ok(capabilities.default_k), |k| {
            k.parse().map_err(|_| error(format!("K is {}", k_range(capabilities))))
        })?;
        let rules = parts.next().map_or(Ok(capabilities.default_rules(k)), |rule| {
            rules_named(rule).ok_or_else(|| error(format!("the rules are {RULES}")))
        })?;
        if parts.next().is_some() {
            return Err(error("nothing but options may follow the rule".to_owned()));
        }
        let mut setup = Self::new(engine, Motion::new(k, rules));
        for option in options {
            choose(&mut setup, option).map_err(error)?;
        }
        setup.check().map_err(|wrong| error(wrong.to_string()))?;
        Ok(setup)
    }
}

/// The k that an engine takes, in words.
fn k_range(capabilities: Capabilities) -> String {
    format!("a number from 2 to {}{}", capabilities.max_k, if capabilities.any { ", or any" } else { "" })
}

/// The rules of motion with the corner rule or gap rule of this name.
fn rules_named(name: &str) -> Option<Rules> {
    Some(match name {
        "never" => Rules::Center(CornerRule::Never),
        "one" => Rules::Center(CornerRule::One),
        "always" => Rules::Center(CornerRule::Always),
        "open" => Rules::Corner(DiagonalGap::Open),
        "closed" => Rules::Corner(DiagonalGap::Closed),
        _ => Rules::CenterGap(name.strip_prefix(BETWEEN_CENTERS)?.parse().ok()?),
    })
}

/// A smoothing as an option in the text of a setup.
const fn smoothing_name(smoothing: Smoothing) -> &'static str {
    match smoothing {
        Smoothing::Linear => "smooth",
        Smoothing::Taut => "taut",
    }
}

/// The smoothing that an option in the text of a setup names.
fn smoothing_named(name: &str) -> Option<Smoothing> {
    [Smoothing::Linear, Smoothing::Taut].into_iter().find(|&smoothing| smoothing_name(smoothing) == name)
}

/// Chooses the option that a part of a setup's text names; the error says what is wrong.
fn choose(setup: &mut Setup, text: &str) -> Result<(), String> {
    if let Some(smoothing) = smoothing_named(text) {
        setup.smoothing = Some(smoothing);
        return Ok(());
    }
    let option = EngineOption::ALL.into_iter().find_map(|option| Some((option, option.read(text)?)));
    let (option, value) = option.ok_or_else(|| format!("the options are {}", option_forms()))?;
    setup.engine.set(option, value).map_err(|wrong| wrong.to_string())
}
