//! The pruning rule of canonical search, for the planners of many maps: it depends on k and the rules of motion alone, and takes a
//! second or two at k = 8.

use std::{
    any::Any,
    sync::{Arc, Mutex, PoisonError},
    time::Instant,
};

use mediant_grid::{Centers, Corners, GridGraph, Placement, Rules};
use mediant_moves::FiniteK;
use mediant_search::{CanonicalRule, Pruning};

use crate::{Engine, Prebuilt, Preprocessing, Setup, Variant};

/// A [`CanonicalRule`] of either placement.
#[derive(Clone, Debug)]
pub struct SharedRule(Arc<dyn Any + Send + Sync>);

impl SharedRule {
    /// The rule for these.
    #[must_use]
    pub fn new(k: FiniteK, rules: Rules) -> Self {
        Self(match rules {
            Rules::Center(corners) => Arc::new(CanonicalRule::<Centers>::new(k, corners)),
            Rules::Corner(gap) => Arc::new(CanonicalRule::<Corners>::new(k, gap)),
        })
    }
}

/// The rules that were asked for, each made once.
#[derive(Debug, Default)]
pub struct SharedRules(Mutex<Vec<(FiniteK, Rules, SharedRule)>>);

impl SharedRules {
    /// None yet.
    #[must_use]
    pub const fn new() -> Self {
        Self(Mutex::new(Vec::new()))
    }

    /// What the planner of a setup can use; nothing for an engine without the rule.
    pub fn prebuilt(&self, setup: Setup) -> Prebuilt {
        let prunes = match setup.engine {
            Engine::AStar
            | Engine::Dijkstra
            | Engine::Wavefront
            | Engine::Theta
            | Engine::LazyTheta
            | Engine::Anya
            | Engine::Subgoal
            | Engine::SubgoalTheta
            | Engine::Hpa
            | Engine::Chpa => false,
            Engine::Canonical | Engine::Jps | Engine::JpsBlock | Engine::JpsPlus => {
                setup.variant() != Some(Variant::Paper)
            }
        };
        let k = setup.k.finite().filter(|_| prunes);
        Prebuilt { index: None, rule: k.map(|k| self.get(k, setup.rules)) }
    }

    fn get(&self, k: FiniteK, rules: Rules) -> SharedRule {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((.., rule)) = known.iter().find(|known| (known.0, known.1) == (k, rules)) {
            return rule.clone();
        }
        let rule = SharedRule::new(k, rules);
        known.push((k, rules, rule.clone()));
        rule
    }
}

/// The pruning of canonical search on a grid graph, and what it took.
pub(crate) fn pruning<P: Placement>(
    grid_graph: &GridGraph<P>,
    shared: Option<SharedRule>,
) -> (Arc<Pruning<P>>, Preprocessing) {
    let begin = Instant::now();
    let rule = shared.and_then(|SharedRule(rule)| rule.downcast().ok());
    let rule = rule.unwrap_or_else(|| Arc::new(CanonicalRule::new(grid_graph.k(), grid_graph.rule())));
    let pruning = Pruning::with_rule(grid_graph, rule);
    let index_bytes = pruning.memory_bytes() as u64;
    (Arc::new(pruning), Preprocessing { time: begin.elapsed(), index_bytes, ..Preprocessing::default() })
}
