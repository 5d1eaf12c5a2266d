//! Progress of building a graph.

use mediant_grid::names;

/// How much of a subgoal graph is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// The current stage.
    pub stage: Stage,
    /// The number of subgoals that this stage has finished.
    pub done: usize,
    /// The number of all subgoals.
    pub total: usize,
}

/// The stages of building a subgoal graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Finding the edges of each subgoal.
    Edges,
    /// Building the hierarchy, one subgoal after another.
    Hierarchy,
    /// Finding what each vertex sees.
    Sight,
    /// Finding the labels of each subgoal.
    Labels,
    /// Finding the labels of vertices, by blocks of them, which are what is counted.
    Vertices,
}

names!(Stage: Edges => "edges", Hierarchy => "hierarchy", Sight => "sight", Labels => "labels", Vertices => "vertices");
