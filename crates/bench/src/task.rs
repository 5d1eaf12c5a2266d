//! What can be measured of ours: an engine, with the k, placement and rule of motion that it searches.

use std::{fmt, str::FromStr};

use mediant_grid::{Centers, CornerRule, DiagonalGap, Lattice, Rules};
use mediant_moves::K;

/// Our engines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Engine {
    /// [`AStar`](mediant_search::AStar) with the heuristic h_k.
    AStar,
}

impl Engine {
    /// All of them.
    pub const ALL: [Self; 1] = [Self::AStar];

    /// The name that the `mediant` program gives it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::AStar => "astar",
        }
    }
}

/// An engine on one search graph.
///
/// Written `ENGINE[:K[:RULE]]`: RULE is `never`, `one` or `always` at centers, `open` or `closed` at corners; without it the
/// task is the scenarios' own, k = 3 at centers under `never`.
///
/// ```
/// use mediant_bench::Task;
/// let task: Task = "astar:5:open".parse()?;
/// assert_eq!((task.k.get(), task.to_string().as_str()), (5, "astar:5:open"));
/// assert!(!task.solves_scenarios() && "astar".parse::<Task>()?.solves_scenarios());
/// # Ok::<(), mediant_bench::TaskError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Task {
    /// The engine.
    pub engine: Engine,
    /// The neighborhood.
    pub k: K,
    /// The placement and its rule of motion.
    pub rules: Rules,
}

impl Task {
    /// Whether this is the problem whose optimal lengths the scenario files give.
    #[must_use]
    pub fn solves_scenarios(self) -> bool {
        self.k == K::EIGHT_CONNECTED && self.rules == Rules::Center(CornerRule::Never)
    }

    /// The word for the rule of motion.
    pub(crate) fn rule(self) -> String {
        match self.rules {
            Rules::Center(rule) => rule.to_string(),
            Rules::Corner(gap) => gap.to_string(),
        }
    }
}

impl fmt::Display for Task {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&format!("{}:{}:{}", self.engine.name(), self.k.get(), self.rule()))
    }
}

/// A text that is no [`Task`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected ENGINE[:K[:RULE]], found `{found}`: {wrong}")]
pub struct TaskError {
    found: String,
    wrong: String,
}

impl FromStr for Task {
    type Err = TaskError;

    fn from_str(text: &str) -> Result<Self, TaskError> {
        let error = |wrong: String| TaskError { found: text.to_owned(), wrong };
        let mut parts = text.split(':');
        let name = parts.next().unwrap_or_default();
        let engine = Engine::ALL.into_iter().find(|engine| engine.name() == name).ok_or_else(|| {
            let names: Vec<&str> = Engine::ALL.iter().map(|engine| engine.name()).collect();
            error(format!("the engines are {}", names.join(", ")))
        })?;
        let k = parts.next().map_or(Ok(K::EIGHT_CONNECTED), |k| {
            let k = k.parse().ok().filter(|&k| k <= Lattice::<Centers>::MAX_K).map(K::new);
            k.and_then(Result::ok).ok_or_else(|| error("K is a number from 2 to 12".to_owned()))
        })?;
        let rules = match parts.next() {
            None | Some("never") => Rules::Center(CornerRule::Never),
            Some("one") => Rules::Center(CornerRule::One),
            Some("always") => Rules::Center(CornerRule::Always),
            Some("open") => Rules::Corner(DiagonalGap::Open),
            Some("closed") => Rules::Corner(DiagonalGap::Closed),
            Some(_) => return Err(error("the rules are never, one, always, open, closed".to_owned())),
        };
        match parts.next() {
            None => Ok(Self { engine, k, rules }),
            Some(_) => Err(error("nothing may follow the rule".to_owned())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tasks_are_read_as_they_are_written() {
        for rules in Rules::ALL {
            for k in 2..=12 {
                let task = Task { engine: Engine::AStar, k: K::new(k).unwrap(), rules };
                assert_eq!(task.to_string().parse(), Ok(task));
            }
        }
        assert_eq!("astar".parse(), "astar:3:never".parse::<Task>());
    }

    #[test]
    fn each_wrong_part_is_named() {
        let wrong = |text: &str| text.parse::<Task>().unwrap_err().to_string();
        assert_eq!(wrong("warp"), "expected ENGINE[:K[:RULE]], found `warp`: the engines are astar");
        for k in ["", "x", "1", "13", "-3"] {
            assert!(wrong(&format!("astar:{k}")).ends_with("K is a number from 2 to 12"));
        }
        assert!(wrong("astar:3:sometimes").ends_with("the rules are never, one, always, open, closed"));
        assert!(wrong("astar:3:one:two").ends_with("nothing may follow the rule"));
    }
}
