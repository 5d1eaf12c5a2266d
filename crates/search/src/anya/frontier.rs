//! What a search has found and not yet expanded: roots, nodes, the open list.

use std::{cmp::Reverse, collections::BinaryHeap};

use mediant_grid::{Corners, FreeSpace, Vertex, sight::Ray};
use mediant_moves::Cost;

use crate::Path;

/// A vertex at which paths turn, or the start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    pub(super) at: Vertex,
    /// The length of the best known path to it.
    pub(super) g: f64,
    /// The root before it; itself at the start.
    parent: u32,
}

/// A search node: part of a line that is seen from a root.
///
/// A *cone node* is the interval between two rays on another line than the root's. A *flat node* is a vertex on the root's own
/// line, to the right or left, at which a path may turn; `left.dx` is how far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) root: u32,
    pub(super) line: i32,
    pub(super) left: Ray,
    pub(super) right: Ray,
}

/// When a vertex became a root.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    generation: u32,
    root: u32,
}

/// The roots and nodes of a search, with its open list. Forgotten by the next [`start`](Self::start), but for the memory.
#[derive(Clone, Debug)]
pub(super) struct Frontier {
    roots: Vec<Root>,
    /// The root history: for each vertex its best root.
    seen: Box<[Seen]>,
    generation: u32,
    nodes: Vec<Node>,
    open: BinaryHeap<Reverse<Entry>>,
}

/// What the open list orders: f, then h (nearer to the goal first), then the age of the node.
///
/// The bits of floats that are not negative are ordered as the floats; h has the precision of an `f32`. A total order, and, since IEEE 754
/// says what sums, products, quotients and roots are, the same on every platform.
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

/// A length in fixed point, cut off.
pub(super) fn fixed(length: f64) -> Cost {
    const ONE: f64 = (1_u64 << Cost::FRACTION_BITS) as f64;
    Cost::from_bits((length * ONE) as u64)
}

impl Frontier {
    /// A frontier for vertex ids below `vertices`.
    pub(super) fn new(vertices: usize) -> Self {
        Self {
            roots: Vec::new(),
            seen: vec![Seen::default(); vertices].into_boxed_slice(),
            generation: 0,
            nodes: Vec::new(),
            open: BinaryHeap::new(),
        }
    }

    /// Forgets all, in constant time but for once in 2³² calls, and makes a vertex the first root, number 0.
    pub(super) fn start(&mut self, space: &FreeSpace<Corners>, at: Vertex) {
        self.roots.clear();
        self.nodes.clear();
        self.open.clear();
        self.generation = self.generation.wrapping_add(1);
        if self.generation == 0 {
            self.seen.fill(Seen::default());
            self.generation = 1;
        }
        self.roots.push(Root { at, g: 0.0, parent: 0 });
        if let Some(id) = space.id(at) {
            self.seen[id.index()] = Seen { generation: self.generation, root: 0 };
        }
    }

    /// The root with this number.
    #[inline]
    pub(super) fn root(&self, number: u32) -> Root {
        self.roots[number as usize]
    }

    /// Where the root before it is; `None` at the start.
    pub(super) fn parent(&self, number: u32) -> Option<Vertex> {
        (number != 0).then(|| self.root(self.root(number).parent).at)
    }

    /// The number of the root at a vertex that another root sees; `None` when there is another way to it that is as short. (Paths that go on
    /// from there are no shorter than by that other way; if they are as short, they are taut by it too, and so among its nodes.)
    #[inline]
    pub(super) fn reach(&mut self, space: &FreeSpace<Corners>, parent: u32, at: Vertex) -> Option<u32> {
        let id = space.id(at)?;
        let from = self.root(parent);
        let g = from.g + from.at.distance(at);
        let seen = &mut self.seen[id.index()];
        if seen.generation == self.generation {
            let known = self.roots[seen.root as usize];
            if known.g <= g {
                return (known.g == g && known.parent == parent).then_some(seen.root);
            }
        }
        let number = self.roots.len() as u32;
        *seen = Seen { generation: self.generation, root: number };
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
    pub(super) fn pop(&mut self) -> Option<(f64, Node)> {
        let Reverse(entry) = self.open.pop()?;
        Some((entry.f(), self.nodes[entry.number() as usize]))
    }

    /// Whether there is no shorter way to the root's vertex than to the root.
    pub(super) fn is_current(&self, space: &FreeSpace<Corners>, number: u32) -> bool {
        space.id(self.root(number).at).is_some_and(|id| self.seen[id.index()].root == number)
    }

    /// The path to the goal by a root that sees it. Allocates nothing else.
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
