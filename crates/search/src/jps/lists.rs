//! Jump lists: where all jumps from a jump point lead, found beforehand.
//!
//! Where the jumps from a jump point lead depends on the map, but for two things: a goal may lie on one of
//! them, and near the goal they do not pass [dead ends](super::dead_ends). So a list says, for each move by
//! which a path goes on from a jump point,
//! - how often the move can be repeated, which tells whether the goal is in sight, and
//! - the jump points to which the jumps by this move lead: those that hold everywhere, those that hold near
//!   the goal alone, and those that hold elsewhere alone.
//!
//! Lists are replayed by one loop that scans nothing. They belong to jump points where a path arrives by an
//! even move; that is all of them, unless diagonal moves have forced successors. Jumps without a list are
//! scanned: from the start, from dead ends, and those too long for a word.
//!
//! On maps of games there is one list for 20 to 170 cells, of five to ten words. In noise there are so many
//! that there are none: see [`VERTICES_A_LIST`].

use mediant_grid::{GridGraph, Interrupt, Interrupted, Placement, Vector, Vertex, VertexId};
use mediant_moves::Cost;

use super::{
    DURING,
    axial::JumpPointRule,
    block_finder::BlockFinder,
    dead_ends::{DeadEndRows, NearGoal},
    finder::{JumpContext, JumpFinder, JumpRules, in_order},
    to_goal::{ToGoal, cross},
};
use crate::{
    canonical::{Pruning, pattern_at, prunes},
    successors::{ExpandedNode, KnownPath, Successor},
};

/// With more lists than one for so many vertices there are none, as in noise: there they take more memory
/// than the processor's caches hold, and are slower than scans.
const VERTICES_A_LIST: usize = 8;
/// Maps with up to so many vertices have lists anyway.
const FEW_VERTICES: usize = 1 << 12;
/// Lists take no more words than the map has vertices, or than this; what more there would be is scanned.
const FEW_WORDS: usize = 1 << 16;

/// The jump lists of a grid graph with k ≤ 3.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct JumpLists {
    legs: [Leg; 8],
    /// Differences from an odd move's index to those of the even moves beside it, and to its own.
    turns: [u8; 4],
    /// For each even move, by 64 vertices.
    places: Vec<Place>,
    /// The places of a move.
    per_move: usize,
    /// Where lists begin among the words, and where the last one ends.
    starts: Vec<u32>,
    /// Groups: a [`Group`], then its [`Jump`]s.
    words: Vec<u32>,
}

/// Which of 64 vertices have a list, and how many lists come before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Place {
    /// 64 bits, the lower half first: so that a place takes 12 bytes instead of 16.
    has: [u32; 2],
    before: u32,
}

impl Place {
    #[inline]
    const fn bits(self) -> u64 {
        self.has[0] as u64 | (self.has[1] as u64) << 32
    }
}

/// The most steps that a word can say.
const MOST_STEPS: u32 = (1 << 13) - 1;

/// The head of the jumps by one move in a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Group {
    index: usize,
    /// How often the move can be repeated.
    length: u32,
    /// The number of jumps.
    count: u32,
}

impl Group {
    fn word(self) -> Option<u32> {
        let fits = self.length <= MOST_STEPS && self.count < 1 << 16;
        fits.then_some(self.length | self.count << 13 | (self.index as u32) << 29)
    }

    #[inline]
    const fn of(word: u32) -> Self {
        Self { index: (word >> 29) as usize, length: word & MOST_STEPS, count: word >> 13 & 0xffff }
    }
}

/// A jump point to which the jumps by one move lead.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Jump {
    /// How often the move is repeated.
    steps: u32,
    /// Which of the two even moves beside it follows; [`NO_TURN`](Self::NO_TURN) for none.
    then: u32,
    /// How often that is repeated.
    then_steps: u32,
    /// Where it leads there: [`NEAR_GOAL`](Self::NEAR_GOAL), [`ELSEWHERE`](Self::ELSEWHERE), or both.
    holds: u32,
}

impl Jump {
    const NO_TURN: u32 = 2;
    /// Where dead ends count as jump points.
    const NEAR_GOAL: u32 = 1;
    /// Where they do not.
    const ELSEWHERE: u32 = 2;

    fn word(self) -> Option<u32> {
        let fits = self.steps <= MOST_STEPS && self.then_steps <= MOST_STEPS;
        fits.then_some(self.steps | self.then_steps << 13 | self.then << 26 | self.holds << 28)
    }

    #[inline]
    const fn of(word: u32) -> Self {
        let (steps, then_steps) = (word & MOST_STEPS, word >> 13 & MOST_STEPS);
        Self { steps, then: word >> 26 & 3, then_steps, holds: word >> 28 & 3 }
    }

    /// Whether both lead the same way, if not as far.
    fn is_along(self, other: Self) -> bool {
        (self.steps, self.then) == (other.steps, other.then)
    }
}

/// A move: what a graph says of it, without checks of its index.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Leg {
    v: Vector,
    /// The difference of vertex ids along the move.
    offset: i32,
    cost: Cost,
}

impl JumpLists {
    /// Finds the jumps from all jump points that are no dead ends; none if they are too many.
    pub(super) fn new<P: Placement>(
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        blocks: &BlockFinder,
        dead_ends: &DeadEndRows,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let vertices = graph.vertex_count();
        let most = if vertices <= FEW_VERTICES { usize::MAX } else { vertices / VERTICES_A_LIST };
        // Where nothing is pruned, no jump is made.
        if !prunes(graph) || has_more_jump_points(graph, dead_ends, most, interrupt)? {
            return Ok(Self::default());
        }
        let mut legs = [Leg::default(); 8];
        for (leg, step) in legs.iter_mut().zip(graph.steps()) {
            let offset = step.target(VertexId(0)).0 as i32;
            *leg = Leg { v: step.vector(), offset, cost: step.cost };
        }
        let turns = [graph.steps().len() as u8 - 1, 1, 0, 0];
        let per_move = vertices.div_ceil(64);
        let places = vec![Place::default(); graph.steps().len() / 2 * per_move];
        let mut lists = Self { legs, turns, places, per_move, ..Self::default() };
        let recorder = Recorder { graph, pruning, blocks };
        let most_words = Self::most_words(graph);
        for (row, by) in rows_of_jumps(graph) {
            interrupt.check(DURING)?;
            for (number, node) in jump_points(graph, dead_ends, row, by).enumerate() {
                interrupt.check_every(64, number, DURING)?;
                let (start, id) = (lists.words.len(), node.id.index());
                let is_said = recorder.record(&node, by, &mut lists.words).is_some();
                if !is_said || lists.starts.len() + lists.words.len() + 2 > most_words {
                    lists.words.truncate(start);
                    continue;
                }
                lists.places[by / 2 * per_move + id / 64].has[id / 32 % 2] |= 1 << (id % 32);
                lists.starts.push(start as u32);
            }
        }
        if lists.words.is_empty() {
            return Ok(Self::default());
        }
        let mut before = 0;
        for place in &mut lists.places {
            place.before = before;
            before += place.bits().count_ones();
        }
        lists.starts.push(lists.words.len() as u32);
        lists.starts.shrink_to_fit();
        lists.words.shrink_to_fit();
        Ok(lists)
    }

    /// The list of a vertex for paths that arrive there by an even move.
    #[inline]
    fn get(&self, id: VertexId, by: usize) -> Option<&[u32]> {
        let (word, bit) = (id.index() / 64, id.index() % 64);
        if word >= self.per_move {
            return None;
        }
        let place = self.places.get((by >> 1) * self.per_move + word)?;
        let bits = place.bits();
        if bits >> bit & 1 == 0 {
            return None;
        }
        let list = place.before as usize + (bits & ((1 << bit) - 1)).count_ones() as usize;
        let &[start, end] = self.starts.get(list..list + 2)? else { return None };
        self.words.get(start as usize..end as usize)
    }

    /// Calls `visit` with all successors of a node at which a path arrived by move `by`; false if they are
    /// not known.
    #[inline]
    pub(super) fn visit<P: Placement>(
        &self,
        context: &JumpContext<'_, P>,
        blocks: &BlockFinder,
        (node, by): (&ExpandedNode, usize),
        visit: &mut impl FnMut(Successor) -> KnownPath,
    ) -> bool {
        if by & 1 == 1 {
            return false;
        }
        let Some(mut list) = self.get(node.id, by) else { return false };
        let last_move = usize::from(self.turns[0]);
        while let Some((&first, rest)) = list.split_first() {
            let Group { index, length, count } = Group::of(first);
            let Some((jumps, rest)) = rest.split_at_checked(count as usize) else { break };
            list = rest;
            let way = &context.to_goal;
            if (way.index == index) & (way.steps <= length)
                && let Some(goal) = blocks.goal_beyond_turn(context, node)
            {
                visit(goal);
                return true;
            }
            let first = &self.legs[index & 7];
            for &word in jumps {
                let Jump { steps, then, then_steps, holds } = Jump::of(word);
                let even = (index + usize::from(self.turns[then as usize & 3])) & last_move;
                let last = &self.legs[even & 7];
                let (n, m) = (steps as i32, then_steps as i32);
                let at = node.at + first.v * n + last.v * m;
                let is_near = context.rules.near.along(at, last.v.x == 0);
                if holds & if is_near { Jump::NEAR_GOAL } else { Jump::ELSEWHERE } == 0 {
                    continue;
                }
                let id = node.id.0.wrapping_add_signed(first.offset * n + last.offset * m);
                let cost = first.cost * steps + last.cost * then_steps;
                let known = visit(Successor { id: VertexId(id), at, cost, by: even });
                if then != Jump::NO_TURN && context.is_cut(known, at, even, then_steps) {
                    break;
                }
            }
        }
        true
    }

    /// Where the lists begin and end, and then the lists.
    pub(super) fn words(&self) -> impl Iterator<Item = u32> {
        self.starts.iter().chain(&self.words).copied()
    }

    /// To which vertex and arriving move one of the [`words`](Self::words) belongs; an end belongs to the
    /// last list.
    pub(super) fn place_of(&self, word: usize) -> (VertexId, usize) {
        let last = self.starts.len().saturating_sub(2);
        let list = match word.checked_sub(self.starts.len()) {
            None => word.min(last),
            Some(word) => {
                self.starts.partition_point(|&start| start as usize <= word).saturating_sub(1).min(last)
            }
        } as u32;
        let place = self.places.partition_point(|place| place.before <= list).saturating_sub(1);
        let (mut bits, mut before) = (self.places[place].bits(), self.places[place].before);
        while before < list {
            bits &= bits.wrapping_sub(1);
            before += 1;
        }
        let id = (place % self.per_move) as u32 * 64 + bits.trailing_zeros();
        (VertexId(id), place / self.per_move * 2)
    }

    /// The number of lists.
    #[cfg(test)]
    pub(super) fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    pub(super) fn memory_bytes(&self) -> usize {
        size_of_val(&*self.places) + size_of_val(&*self.starts) + size_of_val(&*self.words)
    }

    /// The memory that the lists of a grid graph take at most, in bytes.
    pub(super) fn most_bytes<P: Placement>(graph: &GridGraph<P>) -> usize {
        let places = graph.steps().len() / 2 * graph.vertex_count().div_ceil(64);
        (places * size_of::<Place>()).saturating_add(Self::most_words(graph).saturating_mul(4))
    }

    fn most_words<P: Placement>(graph: &GridGraph<P>) -> usize {
        graph.vertex_count().max(FEW_WORDS)
    }
}

/// The rows of a map, for each even move.
fn rows_of_jumps<P: Placement>(graph: &GridGraph<P>) -> impl Iterator<Item = (i32, usize)> {
    let (_, height) = P::vertices(graph.grid());
    (0..graph.steps().len()).step_by(2).flat_map(move |by| (0..height as i32).map(move |y| (y, by)))
}

/// Whether there are more jump points than so many that are no dead ends.
fn has_more_jump_points<P: Placement>(
    graph: &GridGraph<P>,
    dead_ends: &DeadEndRows,
    most: usize,
    interrupt: &Interrupt,
) -> Result<bool, Interrupted> {
    if most == usize::MAX {
        return Ok(false);
    }
    let mut count = 0;
    for (row, by) in rows_of_jumps(graph) {
        interrupt.check(DURING)?;
        count += jump_points(graph, dead_ends, row, by).count();
        if count > most {
            return Ok(true);
        }
    }
    Ok(false)
}

/// The jump points of row y that are no dead ends, where a path arrives by an even move.
fn jump_points<P: Placement>(
    graph: &GridGraph<P>,
    dead_ends: &DeadEndRows,
    y: i32,
    by: usize,
) -> impl Iterator<Item = ExpandedNode> {
    let ((width, _), rule) = (P::vertices(graph.grid()), JumpPointRule::of(graph));
    let (v, quarter) = (graph.step(by).vector(), by >> (graph.k().get() - 2));
    (0..width as i32).step_by(64).flat_map(move |x| {
        let ends = rule.ends_in_row::<P>(graph.grid().rows(), (x, y), v);
        let mut left = ends.jump & !ends.dead & !dead_ends.in_row(quarter, (x, y));
        let bits = std::iter::from_fn(move || {
            let bit = (left != 0).then(|| left.trailing_zeros() as i32);
            left &= left.wrapping_sub(1);
            bit
        });
        bits.filter_map(move |bit| {
            let at = Vertex::new(x + bit, y);
            // From outside the map no path arrives.
            let id = graph.id(at).filter(|_| graph.id(at + -v).is_some() && graph.sees(at + -v, at))?;
            Some(ExpandedNode { id, at, by: Some(by) })
        })
    })
}

/// Finds the jumps of single jump points.
struct Recorder<'r, P: Placement> {
    graph: &'r GridGraph<P>,
    pruning: &'r Pruning<P>,
    blocks: &'r BlockFinder,
}

impl<P: Placement> Recorder<'_, P> {
    /// Adds the list of a node; `None` if a word cannot say it.
    fn record(&self, node: &ExpandedNode, by: usize, words: &mut Vec<u32>) -> Option<()> {
        let table = self.pruning.table()?;
        let moves = table.successors(by, pattern_at(self.graph, node.at));
        for mut left in in_order(moves) {
            while left != 0 {
                let index = left.trailing_zeros() as usize;
                left &= left - 1;
                let jumps = self.jumps(node, index);
                let (length, count) = (self.length(node, index), jumps.len() as u32);
                words.push(Group { index, length, count }.word()?);
                for jump in jumps {
                    words.push(jump.word()?);
                }
            }
        }
        Some(())
    }

    /// The jumps by a move.
    fn jumps(&self, node: &ExpandedNode, index: usize) -> Vec<Jump> {
        let mut elsewhere = self.jumps_that_hold(node, index, Jump::ELSEWHERE).into_iter().peekable();
        let mut jumps = Vec::new();
        // Where a jump leads anywhere, it does near the goal, too, if not as far.
        for near in self.jumps_that_hold(node, index, Jump::NEAR_GOAL) {
            match elsewhere.next_if(|jump| jump.is_along(near)) {
                Some(far) if far.then_steps == near.then_steps => {
                    jumps.push(Jump { holds: near.holds | far.holds, ..near });
                }
                far => jumps.extend([near].into_iter().chain(far)),
            }
        }
        jumps.extend(elsewhere);
        jumps
    }

    /// The jumps by a move, all near the goal or all elsewhere.
    fn jumps_that_hold(&self, node: &ExpandedNode, index: usize, holds: u32) -> Vec<Jump> {
        let near = if holds == Jump::NEAR_GOAL { NearGoal::EVERYWHERE } else { NearGoal::NOWHERE };
        let has_other_nodes = self.pruning.diagonals_may_force();
        let rules = JumpRules { near, has_other_nodes, ..JumpRules::PLAIN };
        let (context, graph) = (self.context(node, &rules), self.graph);
        let mut jumps = Vec::new();
        if index & 1 == 0 {
            if let Some(steps) = self.blocks.axial(&context, node, index, None, &mut 0) {
                jumps.push(Jump { steps, then: Jump::NO_TURN, then_steps: 0, holds });
            }
            return jumps;
        }
        let beside = context.beside(index);
        self.blocks.diagonal(&context, node, index, &mut 0, &mut |next| {
            let (d, v) = (node.at.to(next.at), graph.step(index).vector());
            jumps.push(match beside.iter().position(|&even| even == next.by) {
                Some(then) => {
                    let steps = cross(graph.step(next.by).vector(), d).unsigned_abs();
                    Jump { steps, then: then as u32, then_steps: cross(v, d).unsigned_abs(), holds }
                }
                None => {
                    Jump { steps: d.x.abs().max(d.y.abs()) as u32, then: Jump::NO_TURN, then_steps: 0, holds }
                }
            });
            KnownPath::NONE
        });
        jumps
    }

    /// The context of jumps without a goal.
    fn context<'c>(&'c self, node: &ExpandedNode, rules: &'c JumpRules) -> JumpContext<'c, P> {
        let (graph, pruning, to_goal) = (self.graph, self.pruning, ToGoal::default());
        JumpContext { graph, pruning, goal: node.at, rules, stepwise: false, to_goal }
    }

    /// How often a move can be repeated.
    fn length(&self, node: &ExpandedNode, index: usize) -> u32 {
        let context = self.context(node, &JumpRules::PLAIN);
        if index & 1 == 0 {
            return self.blocks.axial_stops().legal_steps(node.at, context.quarter(index));
        }
        let mut scan = self.blocks.diagonal_stops().scan(node.at, index);
        loop {
            let (steps, leads) = scan.next(|_| None);
            if leads == [false; 2] && !context.can_enter(node, index, steps) {
                return steps - 1;
            }
        }
    }
}
