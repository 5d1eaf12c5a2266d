//! How a node knows its parent.

use std::fmt::Debug;

use mediant_grid::{GridGraph, Placement, Step, Vertex, VertexId};

/// How a node knows its parent. Engines that take one move at a time need to store nothing, `()`: the parent
/// is found by the move.
pub trait ParentPointer: Copy + Debug {
    /// A node as it is stored, in words: four, and those of the pointer.
    type Words: Copy + Debug + AsRef<[u32]> + AsMut<[u32]>;

    /// The words of a node that was never reached: zeros.
    const UNKNOWN: Self::Words;

    /// Whether it is that of nodes to which jumps lead: few, and far apart.
    const IS_FOR_JUMPS: bool = false;

    /// The pointer in these words.
    fn read(words: &Self::Words) -> Self;

    /// Writes the pointer into these words.
    fn write(self, words: &mut Self::Words);

    /// The parent, where the pointer says it by itself.
    #[inline]
    fn stored(self) -> Option<VertexId> {
        None
    }

    /// The pointer to a parent.
    fn to(parent: VertexId) -> Self;

    /// The parent of the node (`id`, `at`), which was reached by the move `step`.
    fn parent<P: Placement>(
        self,
        graph: &GridGraph<P>,
        step: &Step,
        id: VertexId,
        at: Vertex,
    ) -> (VertexId, Vertex);
}

/// The parent is one move away.
impl ParentPointer for () {
    type Words = [u32; 4];
    const UNKNOWN: [u32; 4] = [0; 4];

    #[inline]
    fn read(_: &[u32; 4]) {}

    #[inline]
    fn write(self, _: &mut [u32; 4]) {}

    #[inline]
    fn to(_: VertexId) -> Self {}

    #[inline]
    fn parent<P: Placement>(
        self,
        _: &GridGraph<P>,
        step: &Step,
        id: VertexId,
        at: Vertex,
    ) -> (VertexId, Vertex) {
        (step.source(id), at + -step.vector())
    }
}

/// The parent itself.
impl ParentPointer for VertexId {
    type Words = [u32; 5];
    const UNKNOWN: [u32; 5] = [0; 5];

    #[inline]
    fn read(words: &[u32; 5]) -> Self {
        Self(words[4])
    }

    #[inline]
    fn write(self, words: &mut [u32; 5]) {
        words[4] = self.0;
    }

    #[inline]
    fn stored(self) -> Option<VertexId> {
        Some(self)
    }

    #[inline]
    fn to(parent: VertexId) -> Self {
        parent
    }

    #[inline]
    fn parent<P: Placement>(
        self,
        graph: &GridGraph<P>,
        _: &Step,
        _: VertexId,
        _: Vertex,
    ) -> (VertexId, Vertex) {
        (self, graph.vertex(self))
    }
}

/// The parent of a node to which a jump led.
#[derive(Clone, Copy, Debug)]
pub struct JumpParent(pub VertexId);

impl ParentPointer for JumpParent {
    type Words = [u32; 5];
    const UNKNOWN: [u32; 5] = [0; 5];
    const IS_FOR_JUMPS: bool = true;

    #[inline]
    fn read(words: &[u32; 5]) -> Self {
        Self(VertexId::read(words))
    }

    #[inline]
    fn write(self, words: &mut [u32; 5]) {
        self.0.write(words);
    }

    #[inline]
    fn stored(self) -> Option<VertexId> {
        Some(self.0)
    }

    #[inline]
    fn to(parent: VertexId) -> Self {
        Self(parent)
    }

    #[inline]
    fn parent<P: Placement>(
        self,
        graph: &GridGraph<P>,
        step: &Step,
        id: VertexId,
        at: Vertex,
    ) -> (VertexId, Vertex) {
        self.0.parent(graph, step, id, at)
    }
}
