//! The memory of a search: roots, nodes, the open list.

use std::{cmp::Reverse, collections::BinaryHeap};

use mediant_grid::{Corners, FreeSpace, Vertex, sight::Ray};
use mediant_moves::Cost;

use crate::path::Path;

/// The start, or a vertex at which paths turn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    pub(super) at: Vertex,
    /// The length of the best known path to it.
    pub(super) g: f64,
    /// The number of the root before it; its own for the start.
    parent: u32,
}

/// A search node: the part of a line that a root sees.
///
/// A *cone node* is the interval between two rays on a line other than the root's. A *flat node* is a vertex
/// at which a path may turn on the root's own line; `left.dx` is its distance to the right.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) root: u32,
    pub(super) line: i32,
    pub(super) left: Ray,
    pub(super) right: Ray,
}

/// The best root at a vertex, and the search in which it became one.
#[derive(Clone, Copy, Debug, Default)]
struct RootEntry {
    generation: u32,
    root: u32,
}

/// The roots and nodes of a search, with its open list. The next [`start`](Self::start) clears it and keeps
/// the memory.
#[derive(Clone, Debug)]
pub(super) struct Frontier {
    roots: Vec<Root>,
    /// The root history: for each vertex its best root.
    best_roots: Box<[RootEntry]>,
    generation: u32,
    nodes: Vec<Node>,
    open: BinaryHeap<Reverse<Entry>>,
}

/// An entry of the open list, ordered by f, then by h (nearer to the goal first), then by the age of the
/// node.
///
/// The bits of non-negative floats are ordered like the floats; h has the precision of an `f32`. The order is
/// total, and the same on every platform, since IEEE 754 defines sums, products, quotients and roots exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Entry(u128);

impl Entry {
    #[inline]
    fn new(f: f64, h: f64, number: u32) -> Self {
        let h = (h as f32).to_bits();
        Self(u128::from(f.to_bits()) << 64 | u128::from(h) << 32 | u128::from(number))
    }

    #[inline]
    const fn f(self) -> f64 {
        f64::from_bits((self.0 >> 64) as u64)
    }

    #[inline]
    const fn number(self) -> u32 {
        self.0 as u32
    }
}

/// A length in fixed point, rounded down.
pub(super) fn fixed(length: f64) -> Cost {
    const ONE: f64 = (1_u64 << Cost::FRACTION_BITS) as f64;
    Cost::from_bits((length * ONE) as u64)
}

impl Frontier {
    /// A frontier for vertex ids below `vertices`.
    pub(super) fn new(vertices: usize) -> Self {
        Self {
            roots: Vec::new(),
            best_roots: vec![RootEntry::default(); vertices].into_boxed_slice(),
            generation: 0,
            nodes: Vec::new(),
            open: BinaryHeap::new(),
        }
    }

    /// Forgets the last search, in constant time (but for one call in 2³²), and makes a vertex the first
    /// root, number 0.
    pub(super) fn start(&mut self, space: &FreeSpace<Corners>, at: Vertex) {
        self.roots.clear();
        self.nodes.clear();
        self.open.clear();
        self.generation = self.generation.wrapping_add(1);
        if self.generation == 0 {
            self.best_roots.fill(RootEntry::default());
            self.generation = 1;
        }
        self.roots.push(Root { at, g: 0.0, parent: 0 });
        if let Some(id) = space.id(at) {
            self.best_roots[id.index()] = RootEntry { generation: self.generation, root: 0 };
        }
    }

    /// The root with this number.
    #[inline]
    pub(super) fn root(&self, number: u32) -> Root {
        self.roots[number as usize]
    }

    /// The vertex of the root before it; `None` for the start.
    pub(super) fn parent(&self, number: u32) -> Option<Vertex> {
        (number != 0).then(|| self.root(self.root(number).parent).at)
    }

    /// Makes a vertex that another root sees a root, and returns its number; `None` if another path to it is
    /// as short. (Paths that go on from there are no shorter than by that other path. If they are as short,
    /// they are taut by it too, and so among its nodes.)
    #[inline]
    pub(super) fn add_root(&mut self, space: &FreeSpace<Corners>, parent: u32, at: Vertex) -> Option<u32> {
        let id = space.id(at)?;
        let from = self.root(parent);
        let g = from.g + from.at.distance(at);
        let best = &mut self.best_roots[id.index()];
        if best.generation == self.generation {
            let known = self.roots[best.root as usize];
            if known.g <= g {
                return (known.g == g && known.parent == parent).then_some(best.root);
            }
        }
        let number = self.roots.len() as u32;
        *best = RootEntry { generation: self.generation, root: number };
        self.roots.push(Root { at, g, parent });
        Some(number)
    }

    /// Puts a node on the open list.
    #[inline]
    pub(super) fn push(&mut self, node: Node, f: f64, h: f64) {
        let number = self.nodes.len() as u32;
        self.nodes.push(node);
        self.open.push(Reverse(Entry::new(f, h, number)));
    }

    /// The best node and its f.
    #[inline]
    pub(super) fn best(&self) -> Option<(f64, Node)> {
        let Reverse(entry) = self.open.peek()?;
        Some((entry.f(), self.nodes[entry.number() as usize]))
    }

    /// Takes the best node from the open list.
    #[inline]
    pub(super) fn pop(&mut self) {
        self.open.pop();
    }

    /// Whether no shorter path to the root's vertex was found since it became a root.
    pub(super) fn is_current(&self, space: &FreeSpace<Corners>, number: u32) -> bool {
        space.id(self.root(number).at).is_some_and(|id| self.best_roots[id.index()].root == number)
    }

    /// The best known path to a root.
    pub(super) fn path_to_root(&self, space: &FreeSpace<Corners>, at: Vertex) -> Option<Path> {
        let best = self.best_roots[space.id(at)?.index()];
        let root = (best.generation == self.generation).then(|| self.roots.get(best.root as usize))??;
        Some(if best.root == 0 { Path::new(vec![at]) } else { self.path(root.parent, at) })
    }

    /// The path to the goal by a root that sees it. Allocates nothing but its waypoints.
    pub(super) fn path(&self, last: u32, goal: Vertex) -> Path {
        let roots =
            std::iter::successors(Some(last), |&number| (number != 0).then(|| self.root(number).parent));
        let mut waypoints = Vec::with_capacity(roots.clone().count() + 1);
        waypoints.push(goal);
        for at in roots.map(|number| self.root(number).at) {
            // Where the path goes straight on, there is no waypoint.
            if let [.., before, last] = waypoints[..] {
                let (u, v) = (at.to(last), last.to(before));
                if i64::from(u.x) * i64::from(v.y) == i64::from(u.y) * i64::from(v.x) {
                    waypoints.pop();
                }
            }
            waypoints.push(at);
        }
        waypoints.reverse();
        Path::new(waypoints)
    }
}
