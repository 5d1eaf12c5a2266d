//! Jump lists: where all jumps from a jump point lead, found beforehand.
//!
//! Where the jumps from a jump point lead depends on the map, but for two things: a goal may lie on one of
//! them, and near the goal they do not pass [dead ends](super::dead_ends). So a list says
//! - by which moves a path goes on from a jump point, and how often each of them can be repeated, which tells
//!   whether the goal is in sight, and
//! - the jump points to which its jumps lead: those that hold everywhere, those that hold near the goal
//!   alone, and those that hold elsewhere alone.
//!
//! Lists are replayed by one loop that scans nothing. They belong to jump points where a path arrives by an
//! even move; that is all of them, unless diagonal moves have forced successors. Jumps without a list are
//! scanned: from the start, from dead ends, and those too long for a word.
//!
//! A list is found by two steps: a bit for each vertex says whether there is one, and its number among those
//! of the same 64 vertices leads to where it starts. So a list can be replaced, and one can come or go, with
//! nothing else moved ([`repair`]).
//!
//! On maps of games there is one list for 20 to 170 cells, of five to ten words. In noise there are so many
//! that there are none: see [`VERTICES_A_LIST`].

mod record;
mod repair;
mod stale;
mod words;

use mediant_grid::{
    Footprint, GridGraph, Interrupt, Interrupted, Placement, Versioned, Vertex, VertexId, room_for, room_in,
};

pub(super) use self::record::Recorder;
use self::words::{Head, Jump, MOST_STEPS, Route, packed};
use super::{
    DURING,
    axial::JumpPointRule,
    block_finder::BlockFinder,
    dead_ends::{DeadEndRows, NearGoal},
    finder::is_cut,
    stop_rows::holds,
    to_goal::ToGoal,
};
use crate::{
    canonical::prunes,
    successors::{ExpandedNode, KnownPath, LookUp, Successor},
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
    routes: [Route; 16],
    /// The columns of vertices.
    width: u32,
    /// For each even move, by 64 vertices.
    places: Versioned<Place>,
    /// The places of a move.
    per_move: usize,
    /// Where lists begin among the words, for the lists of one place one after another.
    starts: Versioned<u32>,
    /// Lists: a [`Head`], how often its moves can be repeated, two to a word, then its [`Jump`]s.
    words: Versioned<u32>,
    size: Size,
}

/// The part of the memory of lists that is in use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Size {
    /// The starts and words from here on were never in use.
    starts: usize,
    words: usize,
    /// The starts and words of lists that there are.
    live: usize,
    /// The most of them; 0 where no jump is made.
    most: usize,
}

/// Which of 64 vertices have a list, and where it is said where their lists start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Place {
    /// 64 bits, the lower half first: so that a place takes 12 bytes instead of 16.
    has: [u32; 2],
    /// The place of the first of them among the starts.
    first: u32,
}

impl Place {
    const fn new(bits: u64, first: u32) -> Self {
        Self { has: [bits as u32, (bits >> 32) as u32], first }
    }

    #[inline]
    const fn bits(self) -> u64 {
        self.has[0] as u64 | (self.has[1] as u64) << 32
    }
}

/// Words for which there is room before the lists of some jump points are made: these take fewer.
const ROOM_AHEAD: usize = 1 << 13;

impl JumpLists {
    /// Finds the jumps from all jump points that are no dead ends; none if they are too many.
    pub(super) fn new<P: Placement>(
        recorder: &Recorder<'_, P>,
        dead_ends: &DeadEndRows,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let graph = recorder.graph;
        let vertices = graph.vertex_count();
        let most = if vertices <= FEW_VERTICES { usize::MAX } else { vertices / VERTICES_A_LIST };
        if !prunes(graph) {
            return Ok(Self::of_no_jumps());
        }
        let Some(points) = jump_points(graph, dead_ends, most, interrupt)? else {
            return Ok(Self::none(Self::most_words(graph)));
        };
        let routes = Route::all(graph);
        let per_move = vertices.div_ceil(64);
        let count = graph.steps().len() / 2 * per_move;
        room_for::<Place>(count, DURING)?;
        let mut places = vec![Place::default(); count];
        let (mut starts, mut words) = (Vec::new(), Vec::new());
        let most = Self::most_words(graph);
        let (width, _) = P::vertices(graph.grid());
        for ((row, by), points) in rows_of_jumps(graph).zip(points.chunks(width.div_ceil(64) as usize)) {
            interrupt.check(DURING)?;
            for (number, x) in columns(points).enumerate() {
                interrupt.check_every(64, number, DURING)?;
                if number.is_multiple_of(64) {
                    room_in(&mut words, ROOM_AHEAD, DURING)?;
                    room_in(&mut starts, 64, DURING)?;
                }
                let at = Vertex::new(x, row);
                let Some(id) = graph.id(at) else { continue };
                let start = words.len();
                if recorder.record(&ExpandedNode { id, at, by: Some(by) }, by, &mut words).is_none() {
                    continue;
                }
                if starts.len() + words.len() + 2 > most {
                    words.truncate(start);
                    continue;
                }
                let id = id.index();
                places[by / 2 * per_move + id / 64].has[id / 32 % 2] |= 1 << (id % 32);
                starts.push(start as u32);
            }
        }
        let mut first = 0;
        for place in &mut places {
            place.first = first;
            first += place.bits().count_ones();
        }
        let size = Size { starts: starts.len(), words: words.len(), live: starts.len() + words.len(), most };
        let (places, starts, words) = (places.into(), starts.into(), words.into());
        Ok(Self { routes, width, places, per_move, starts, words, size })
    }

    /// Where nothing is pruned, no jump is made.
    fn of_no_jumps() -> Self {
        Self::none(0)
    }

    /// No lists, though there might be so many words.
    fn none(most: usize) -> Self {
        Self { size: Size { most, ..Size::default() }, ..Self::default() }
    }

    /// The words from the list of a vertex on, for paths that arrive there by an even move.
    #[inline]
    fn get(&self, id: VertexId, by: usize) -> Option<&[u32]> {
        let place = self.places.get((by >> 1) * self.per_move + id.index() / 64)?;
        // The vertex and those before it, from the highest bit down.
        let bits = place.bits() << (!id.index() & 63);
        if bits >> 63 == 0 {
            return None;
        }
        let list = place.first as usize + bits.count_ones() as usize - 1;
        self.words.get(*self.starts.get(list)? as usize..)
    }

    /// Calls `visit` with all successors of a node at which a path arrived by move `by`, if they are known
    /// and the goal is not in sight.
    #[inline]
    pub(super) fn visit<P: Placement>(
        &self,
        (graph, near, goal): (&GridGraph<P>, &NearGoal, Vertex),
        blocks: &BlockFinder,
        (node, by): (&ExpandedNode, usize),
        visit: &mut impl FnMut(Successor) -> KnownPath,
    ) -> LookUp {
        if by & 1 == 1 {
            return LookUp::Unknown;
        }
        let Some(words) = self.get(node.id, by) else { return LookUp::Unknown };
        let Some(head) = words.first().map(|&word| Head::of(word)) else { return LookUp::Unknown };
        let (index, steps) = ToGoal::first(node.at.to(goal), graph.k());
        if head.moves >> (index & 7) & 1 == 1 {
            let rank = head.rank(index);
            let lengths = words.get(1 + rank / 2).map_or(0, |&lengths| lengths >> (16 * (rank & 1)));
            if steps <= lengths & MOST_STEPS {
                let to_goal = ToGoal::new(node.at.to(goal), graph.k());
                if let Some(goal) = blocks.goal_beyond_turn(graph, node, &to_goal) {
                    return LookUp::Goal(goal);
                }
            }
        }
        let mut left = words.get(head.words as usize..head.length()).unwrap_or_default();
        let from = packed(node.at.x, node.at.y);
        while let Some((&word, rest)) = left.split_first() {
            left = rest;
            let Jump { route, steps, then_steps, holds } = Jump::of(word);
            let route = &self.routes[route as usize];
            let (first, last) = (i64::from(steps), i64::from(then_steps));
            let packed_at = from + route.vectors[0] * first + route.vectors[1] * last;
            let at = Vertex::new(packed_at as i32, (packed_at >> 32) as i32);
            let is_near = near.along((usize::from(route.line), (packed_at >> route.shift) as i32));
            if holds & if is_near { Jump::NEAR_GOAL } else { Jump::ELSEWHERE } == 0 {
                continue;
            }
            let id = VertexId((at.y as u32).wrapping_mul(self.width).wrapping_add(at.x as u32));
            let cost = route.costs[0] * steps + route.costs[1] * then_steps;
            let known = visit(Successor { id, at, cost, by: usize::from(route.by) });
            if route.turns && known != KnownPath::NONE && self.is_cut(graph, known, (at, word)) {
                // The other jumps by this move come later on its way.
                let is_other = |word: &u32| self.routes[Jump::of(*word).route as usize].first == route.first;
                left = &left[left.iter().take_while(|word| is_other(word)).count()..];
            }
        }
        LookUp::Visited
    }

    /// Whether a diagonal jump ends where a path to one of its jump points is known.
    #[inline(never)]
    fn is_cut<P: Placement>(
        &self,
        graph: &GridGraph<P>,
        known: KnownPath,
        (at, word): (Vertex, u32),
    ) -> bool {
        let Jump { route, then_steps, .. } = Jump::of(word);
        is_cut(graph, known, (at, usize::from(self.routes[route as usize].by)), then_steps)
    }

    /// All lists in the order of their moves and vertices, each by its place and bit.
    fn all(&self) -> impl Iterator<Item = (usize, u32, &[u32])> {
        self.places.iter().enumerate().flat_map(move |(number, place)| {
            let mut left = place.bits();
            std::iter::from_fn(move || {
                let bit = (left != 0).then(|| left.trailing_zeros());
                left &= left.wrapping_sub(1);
                bit
            })
            .zip(place.first as usize..)
            .map(move |(bit, start)| (number, bit, list_from(&self.words, self.starts[start])))
        })
    }

    /// Where the lists of a new table begin and end, and then the lists: what is saved.
    pub(super) fn words(&self) -> impl Iterator<Item = u32> {
        let starts = self.all().scan(0, |end, (.., list)| {
            let start = *end;
            *end += list.len() as u32;
            Some(start)
        });
        let (count, end) = (self.starts.len(), self.words.len() as u32);
        starts.chain((count > 0).then_some(end)).chain(self.all().flat_map(|(.., list)| list.iter().copied()))
    }

    /// To which vertex and arriving move one of the [`words`](Self::words) belongs; an end belongs to the
    /// last list.
    pub(super) fn place_of(&self, word: usize) -> (VertexId, usize) {
        let (lists, mut end) = (self.all().count(), 0);
        let is_last = |&(number, (.., list)): &(usize, (usize, u32, &[u32]))| {
            end += list.len();
            number == word || number + 1 == lists || word > lists && word - lists <= end
        };
        let found = self.all().enumerate().find(is_last);
        let (_, (place, bit, _)) = found.unwrap_or_default();
        let per_move = self.per_move.max(1);
        (VertexId((place % per_move) as u32 * 64 + bit), place / per_move * 2)
    }

    /// The number of lists.
    #[cfg(test)]
    pub(super) fn len(&self) -> usize {
        self.all().count()
    }

    /// All lists in order, by the numbers of their places and their bits there.
    #[cfg(test)]
    pub(super) fn listed(&self) -> Vec<(usize, u32, Vec<u32>)> {
        self.all().map(|(place, bit, list)| (place, bit, list.to_vec())).collect()
    }

    /// The same lists, to which none are added beyond so many words.
    #[cfg(test)]
    pub(super) fn with_limit(mut self, most: usize) -> Self {
        self.size.most = most;
        self
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

/// The list that starts at a word.
fn list_from(words: &[u32], start: u32) -> &[u32] {
    let words = words.get(start as usize..).unwrap_or_default();
    let length = words.first().map_or(0, |&word| Head::of(word).length());
    words.get(..length).unwrap_or(words)
}

/// The rows of a map, for each even move.
fn rows_of_jumps<P: Placement>(graph: &GridGraph<P>) -> impl Iterator<Item = (i32, usize)> {
    let (_, height) = P::vertices(graph.grid());
    (0..graph.steps().len()).step_by(2).flat_map(move |by| (0..height as i32).map(move |y| (y, by)))
}

/// The jump points where a path arrives by an even move, but for dead ends: for each of these moves, row by
/// row, a word for 64 vertices. `None` if there are more than so many.
fn jump_points<P: Placement>(
    graph: &GridGraph<P>,
    dead_ends: &DeadEndRows,
    most: usize,
    interrupt: &Interrupt,
) -> Result<Option<Vec<u64>>, Interrupted> {
    let ((width, _), rule) = (P::vertices(graph.grid()), JumpPointRule::of(graph));
    let (rows, mut words, mut count) = (graph.grid().rows(), Vec::new(), 0);
    let mut step = Footprint::default();
    for (y, by) in rows_of_jumps(graph) {
        interrupt.check(DURING)?;
        let (v, quarter) = (graph.step(by).vector(), by >> (graph.k().get() - 2));
        if y == 0 {
            step = Footprint::new::<P>(graph.rule(), v);
        }
        for x in (0..width as i32).step_by(64) {
            let ends = rule.ends_in_row::<P>(rows, (x, y), v);
            let mut points = ends.jump & !ends.dead & !0 >> (64 - (width as i32 - x).min(64));
            if points != 0 {
                // From outside the map no path arrives.
                points &= holds(rows, (x - v.x, y - v.y), &step.free, &step.either);
                points &= !dead_ends.in_row(quarter, (x, y));
                count += points.count_ones() as usize;
            }
            words.push(points);
        }
        if count > most {
            return Ok(None);
        }
    }
    Ok(Some(words))
}

/// The numbers of the bits that are set in words.
fn columns(words: &[u64]) -> impl Iterator<Item = i32> {
    (0..).step_by(64).zip(words).flat_map(|(first, &word)| {
        let mut left = word;
        std::iter::from_fn(move || {
            let bit = (left != 0).then(|| first + left.trailing_zeros() as i32);
            left &= left.wrapping_sub(1);
            bit
        })
    })
}
