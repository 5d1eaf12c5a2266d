//! Heuristics: lower bounds of the cost from a state to the goal.

use std::sync::Arc;

use mediant_grid::{Mismatch, Vertex};
use mediant_moves::Cost;

use crate::{
    graph::CostGraph,
    landmarks::{Landmarks, Numbers},
};

/// The heuristic of a planner: one of three, each consistent.
#[derive(Debug)]
pub(crate) enum Guide {
    Zero,
    /// h_k over cells of the least cost.
    LeastCost,
    /// The greatest of this and the bounds of landmarks.
    Landmarks {
        landmarks: Arc<Landmarks>,
        /// The distances of the goal.
        numbers: Box<Numbers>,
    },
}

impl Guide {
    pub(crate) fn by(landmarks: Arc<Landmarks>, graph: &CostGraph) -> Result<Self, Mismatch> {
        landmarks.identity().check_equal("the landmarks", ("the graph", graph.identity()))?;
        Ok(Self::Landmarks { landmarks, numbers: Box::default() })
    }

    /// Forgets landmarks of another graph.
    pub(crate) fn follow(&mut self, graph: &CostGraph) {
        if let Self::Landmarks { landmarks, .. } = self
            && landmarks.identity() != graph.identity()
        {
            *self = Self::LeastCost;
        }
    }

    /// Begins a search for a state.
    pub(crate) fn aim(&mut self, goal: usize) {
        if let Self::Landmarks { landmarks, numbers } = self {
            **numbers = landmarks.numbers(goal);
        }
    }

    /// The lower bound of the cost from a state to the goal.
    #[inline]
    pub(crate) fn bound(&self, graph: &CostGraph, (at, state): (Vertex, usize), goal: Vertex) -> Cost {
        match self {
            Self::Zero => Cost::ZERO,
            Self::LeastCost => graph.least_cost(at.to(goal)),
            Self::Landmarks { landmarks, numbers } => {
                graph.least_cost(at.to(goal)).max(landmarks.bound(state, numbers))
            }
        }
    }
}
