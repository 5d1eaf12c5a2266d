//! Setups as text.

use std::{fmt, num::NonZeroU32, str::FromStr};

use mediant_grid::{CornerRule, DiagonalGap, Rules};
use mediant_search::Smoothing;

use crate::{About, Engine, HeuristicName, Options, Setup, Variant};

/// A text that is no [`Setup`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected ENGINE[:K[:RULE]][,OPTION…], found `{found}`: {wrong}")]
pub struct TextError {
    found: String,
    wrong: String,
}

/// How the options are written.
const OPTION_NAMES: &str = "hk, euclidean, zero, squared, exact, complete, paper, limit=N, intermediate, levels=N, \
    levels=all, side=N, refined, second=HEURISTIC, step=N, detour=N, smooth, taut";

/// In full but for the options, of which those that were chosen.
impl fmt::Display for Setup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rule = self.rule_name();
        let Options { heuristic, variant, jump_limit, intermediate, levels, .. } = self.options;
        let Options { side, refined, second, step, detour, smoothing, .. } = self.options;
        let options = [
            heuristic.map(|heuristic| heuristic.to_string()),
            variant.map(|variant| variant.to_string()),
            jump_limit.map(|limit| format!("limit={limit}")),
            intermediate.then(|| "intermediate".to_owned()),
            levels.map(|levels| format!("levels={levels}")),
            side.map(|side| format!("side={side}")),
            refined.then(|| "refined".to_owned()),
            second.map(|second| format!("second={second}")),
            step.map(|step| format!("step={step}")),
            detour.map(|detour| format!("detour={detour}")),
            smoothing.map(|smoothing| smoothing_name(smoothing).to_owned()),
        ];
        let options: String = options.into_iter().flatten().map(|option| format!(",{option}")).collect();
        f.pad(&format!("{}:{}:{rule}{options}", self.engine, self.k))
    }
}

impl Setup {
    /// The name of the rule of motion, without its placement.
    #[must_use]
    pub fn rule_name(&self) -> String {
        match self.rules {
            Rules::Center(rule) => rule.to_string(),
            Rules::Corner(gap) => gap.to_string(),
        }
    }
}

impl FromStr for Setup {
    type Err = TextError;

    fn from_str(text: &str) -> Result<Self, TextError> {
        let error = |wrong: String| TextError { found: text.to_owned(), wrong };
        let mut options = text.split(',');
        let mut parts = options.next().unwrap_or_default().split(':');
        let engine: Engine =
            parts.next().unwrap_or_default().parse().map_err(|_| {
                error(format!("the engines are {}", Engine::ALL.map(Engine::name).join(", ")))
            })?;
        let about = engine.about();
        let k = parts
            .next()
            .map_or(Ok(about.default_k()), |k| k.parse().map_err(|_| error(format!("K is {}", ks(about)))))?;
        let rules = parts.next().map_or(Ok(about.default_rules(k)), |rule| {
            rule_named(rule).ok_or_else(|| error("the rules are never, one, always, open, closed".to_owned()))
        })?;
        if parts.next().is_some() {
            return Err(error("nothing but options may follow the rule".to_owned()));
        }
        let mut setup = Self::new(engine, k, rules);
        for option in options {
            choose(&mut setup.options, option)
                .ok_or_else(|| error(format!("the options are {OPTION_NAMES}")))?;
        }
        setup.check().map_err(|wrong| error(wrong.to_string()))?;
        Ok(setup)
    }
}

/// The k that an engine takes, in words.
fn ks(about: About) -> String {
    match about.max_k {
        None => "any".to_owned(),
        Some(max) => format!("a number from 2 to {max}{}", if about.any { ", or any" } else { "" }),
    }
}

fn rule_named(name: &str) -> Option<Rules> {
    Some(match name {
        "never" => Rules::Center(CornerRule::Never),
        "one" => Rules::Center(CornerRule::One),
        "always" => Rules::Center(CornerRule::Always),
        "open" => Rules::Corner(DiagonalGap::Open),
        "closed" => Rules::Corner(DiagonalGap::Closed),
        _ => return None,
    })
}

/// The option of a setup's text; [`Smoothing`] itself is named for its method.
const fn smoothing_name(smoothing: Smoothing) -> &'static str {
    match smoothing {
        Smoothing::Linear => "smooth",
        Smoothing::Taut => "taut",
    }
}

fn smoothing_named(name: &str) -> Option<Smoothing> {
    [Smoothing::Linear, Smoothing::Taut].into_iter().find(|&smoothing| smoothing_name(smoothing) == name)
}

fn choose(options: &mut Options, text: &str) -> Option<()> {
    let number = |name: &str| text.strip_prefix(name).map(str::parse::<NonZeroU32>);
    if let Ok(heuristic) = text.parse::<HeuristicName>() {
        options.heuristic = Some(heuristic);
    } else if let Ok(variant) = text.parse::<Variant>() {
        options.variant = Some(variant);
    } else if text == "intermediate" {
        options.intermediate = true;
    } else if text == "refined" {
        options.refined = true;
    } else if let Some(levels) = text.strip_prefix("levels=") {
        options.levels = Some(levels.parse().ok()?);
    } else if let Some(second) = text.strip_prefix("second=") {
        options.second = Some(second.parse().ok()?);
    } else if let Some(smoothing) = smoothing_named(text) {
        options.smoothing = Some(smoothing);
    } else {
        let Options { jump_limit, side, step, detour, .. } = options;
        let numbers = [("limit=", jump_limit), ("side=", side), ("step=", step), ("detour=", detour)];
        let (option, value) = numbers.into_iter().find_map(|(name, option)| Some((option, number(name)?)))?;
        *option = Some(value.ok()?);
    }
    Some(())
}
