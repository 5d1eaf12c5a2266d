//! The memory of a search: roots, nodes, the open list. It grows with the search, not with the map.

use std::{cmp::Reverse, collections::BinaryHeap};

use mediant_grid::{
    Corners, FreeSpace, Vertex,
    sight::{IntervalEnd, Place, Ray},
};

use super::{history::RootHistory, norm::Norm};
use crate::path::Path;

/// The start, or a vertex at which paths turn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root<L> {
    pub(super) at: Place,
    /// The length of the best known path to it.
    pub(super) g: L,
    /// The number of the root before it; its own for the start.
    parent: u32,
    /// Whether no shorter path to its vertex was found since it became a root.
    pub(super) is_current: bool,
}

/// A search node: the part of a line that a root sees.
///
/// A *cone node* is the interval between two rays on a line other than the root's, with the steps of the
/// rays: a search that goes on with it divides nothing. A *flat node* is a vertex at which a path may turn
/// on the root's own line; the ray of `left` leads from the root to it. A node on line
/// [`FINAL`](Self::FINAL) is the goal, between vertices, seen by a root at its row of cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) root: u32,
    pub(super) line: i32,
    pub(super) left: IntervalEnd,
    pub(super) right: IntervalEnd,
}

impl Node {
    /// Stands for a line in a node of the goal.
    const FINAL: i32 = i32::MIN;

    /// The goal, seen by a root.
    pub(super) const fn of_goal(root: u32) -> Self {
        Self::aside(root, Self::FINAL, 0)
    }

    /// A flat node, so many parts of a cell to the right of its root.
    pub(super) const fn aside(root: u32, line: i32, dx: i32) -> Self {
        let mut to = IntervalEnd::standing(0);
        to.ray = Ray { dx, dy: 1 };
        Self { root, line, left: to, right: to }
    }

    pub(super) const fn is_of_goal(self) -> bool {
        self.line == Self::FINAL
    }
}

/// The roots and nodes of a search, with its open list. The next [`start`](Self::start) clears it and keeps
/// the memory.
#[derive(Clone, Debug)]
pub(super) struct Frontier<N: Norm> {
    norm: N,
    roots: Vec<Root<N::Length>>,
    history: RootHistory,
    nodes: Vec<Node>,
    open: BinaryHeap<Reverse<FrontierEntry>>,
    /// Whether the best entry was taken already: the next one that is pushed takes its place, so that the
    /// heap is put in order once for both.
    is_taken: bool,
    /// Scratch memory for a path: its bends, the goal first, and its waypoints.
    bends: Vec<Place>,
    waypoints: Vec<Vertex>,
}

/// An entry of the open list, ordered by its norm's [priority](Norm::priority), then by the age of the node.
///
/// The order is total, and the same on every platform, since IEEE 754 defines sums, products, quotients and
/// roots exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct FrontierEntry(u128);

impl FrontierEntry {
    #[inline]
    fn new((f, tie): (u64, u32), number: u32) -> Self {
        Self(u128::from(f) << 64 | u128::from(tie) << 32 | u128::from(number))
    }

    #[inline]
    const fn f(self) -> u64 {
        (self.0 >> 64) as u64
    }

    #[inline]
    const fn number(self) -> u32 {
        self.0 as u32
    }
}

impl<N: Norm> Frontier<N> {
    /// An empty frontier for a map of so many columns and rows of vertices.
    pub(super) fn new(norm: N, columns: u32, rows: u32) -> Self {
        Self {
            norm,
            roots: Vec::new(),
            history: RootHistory::new(columns, rows),
            nodes: Vec::new(),
            open: BinaryHeap::new(),
            is_taken: false,
            bends: Vec::new(),
            waypoints: Vec::new(),
        }
    }

    /// The norm of segments.
    pub(super) const fn norm(&self) -> &N {
        &self.norm
    }

    /// Forgets the last search, and becomes a frontier for a map of so many columns and rows of vertices.
    pub(super) fn fit(&mut self, columns: u32, rows: u32) {
        self.forget();
        self.history.fit(columns, rows);
    }

    fn forget(&mut self) {
        self.roots.clear();
        self.nodes.clear();
        self.open.clear();
        self.is_taken = false;
    }

    /// Forgets the last search, in constant time (but for one call in 2³²), and makes the start the first
    /// root, number 0.
    pub(super) fn start(&mut self, at: Place) {
        self.forget();
        self.history.clear();
        self.roots.push(Root { at, g: N::ZERO, parent: 0, is_current: true });
        if let Some(at) = at.vertex() {
            self.history.set(at, 0);
        }
    }

    /// The root with this number.
    #[inline]
    pub(super) fn root(&self, number: u32) -> Root<N::Length> {
        self.roots[number as usize]
    }

    /// The vertex of the root before it; `None` for the start. A start between vertices stands for the
    /// nearest one above and to the left.
    pub(super) fn parent(&self, number: u32) -> Option<Vertex> {
        (number != 0).then(|| self.root(self.root(number).parent).at.floor())
    }

    /// Makes a vertex that another root sees a root, and returns its number; `None` if another path to it is
    /// as short. (Paths that go on from there are no shorter than by that other path. If they are as short,
    /// they are taut by it too, and so among its nodes.)
    #[inline]
    pub(super) fn add_root(&mut self, parent: u32, at: Vertex) -> Option<u32> {
        let (from, place) = (self.root(parent), Place::of(at));
        let g = from.g + self.norm.length(from.at.to(place));
        let (best, slot) = self.history.slot(at);
        if let Some(best) = best {
            let known = &mut self.roots[best as usize];
            if known.g <= g {
                return (known.g == g && known.parent == parent).then_some(best);
            }
            known.is_current = false;
        }
        let number = self.roots.len() as u32;
        *slot = number;
        self.roots.push(Root { at: place, g, parent, is_current: true });
        Some(number)
    }

    /// Puts a node on the open list, with a lower bound on what is left from its root. Returns its f.
    #[inline]
    pub(super) fn push(&mut self, node: Node, h: N::Bound) -> u64 {
        let number = self.nodes.len() as u32;
        let priority = N::priority(self.root(node.root).g, h);
        self.nodes.push(node);
        let entry = Reverse(FrontierEntry::new(priority, number));
        if std::mem::take(&mut self.is_taken)
            && let Some(mut best) = self.open.peek_mut()
        {
            *best = entry;
        } else {
            self.open.push(entry);
        }
        priority.0
    }

    /// The best node and its f.
    #[inline]
    pub(super) fn best(&mut self) -> Option<(u64, Node)> {
        if std::mem::take(&mut self.is_taken) {
            self.open.pop();
        }
        let Reverse(entry) = self.open.peek()?;
        Some((entry.f(), self.nodes[entry.number() as usize]))
    }

    /// Takes the best node from the open list.
    #[inline]
    pub(super) fn pop(&mut self) {
        if std::mem::replace(&mut self.is_taken, true) {
            self.open.pop();
        }
    }

    /// The best known path to a root.
    pub(super) fn path_to_root(&mut self, space: &FreeSpace<Corners>, at: Vertex) -> Option<Path> {
        space.id(at)?;
        let best = self.history.get(at)?;
        Some(match best {
            0 => Path::new(vec![at]),
            _ => self.path(space, self.root(best).parent, Place::of(at)),
        })
    }

    /// The path to the goal by a root that sees it. Allocates nothing but its waypoints.
    pub(super) fn path(&mut self, space: &FreeSpace<Corners>, last: u32, goal: Place) -> Path {
        let Self { roots, bends, waypoints, norm, .. } = self;
        bends.clear();
        waypoints.clear();
        bends.push(goal);
        let parent = |&number: &u32| (number != 0).then(|| roots[number as usize].parent);
        for at in std::iter::successors(Some(last), parent).map(|number| roots[number as usize].at) {
            // Where the path goes straight on, there is no bend.
            if let [.., before, last] = bends[..]
                && at.to(last).det(last.to(before)) == 0
            {
                bends.pop();
            }
            bends.push(at);
        }
        if bends.iter().any(|at| at.vertex().is_none()) {
            return Path::through(bends.iter().rev().copied());
        }
        norm.waypoints(space, bends.iter().rev().map(|at| at.floor()), waypoints);
        Path::new(waypoints.clone())
    }
}
