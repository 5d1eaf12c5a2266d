//! Finding the labels of vertices, as many as a budget of memory allows.
//!
//! The blocks take turns. Those come first whose labels save the most work by their memory: where few of the
//! subgoals that are seen from the block are seen from each of its vertices.

use mediant_grid::{FreeSpace, Interrupt, Interrupted, Vertex};

use super::{BLOCK, NONE, Span, VertexLabels};
use crate::{
    chunks::in_chunks,
    error::SubgoalError,
    labels::{
        HubLabels,
        candidates::{Candidates, Joint, Step},
        chain::Chains,
        many::ROUNDED,
        pack::PathStep,
    },
    placement::SubgoalPlacement,
    progress::{Progress, Stage},
    seen::SIDE,
};

/// The stage that an interrupted call names.
const DURING: &str = "finding the labels of vertices";

/// The blocks whose labels are found at a time: so there are never many more than what is kept.
const PIECE: usize = 1 << 10;

impl<P: SubgoalPlacement> HubLabels<P> {
    /// The same labels, and labels of vertices besides, as many as fit if all take at most `most` bytes: with
    /// them a query takes down to a third of the time. Its paths are as short, but of several that are it may
    /// be another. Labels of vertices that these labels had are found anew.
    ///
    /// # Errors
    /// [`SubgoalError::Mismatch`] for another free space, [`SubgoalError::Interrupted`].
    pub fn with_vertices(
        mut self,
        space: &FreeSpace<P>,
        most: usize,
        progress: &(impl Fn(Progress) + Sync),
        interrupt: &Interrupt,
    ) -> Result<Self, SubgoalError> {
        self.check(space)?;
        self.vertices = VertexLabels::default();
        let blocks = self.geometry.seen.len();
        if let Some(rest) = most.checked_sub(self.memory_bytes() + blocks * size_of::<u32>()) {
            let order = self.geometry.seen.blocks_by_scatter(space, interrupt)?;
            self.vertices = find(&self, space, (&order, rest), progress, interrupt)?;
        }
        Ok(self)
    }
}

/// The labels of the vertices of blocks in an order, as many as fit in so many bytes.
fn find<P: SubgoalPlacement>(
    index: &HubLabels<P>,
    space: &FreeSpace<P>,
    (order, rest): (&[u32], usize),
    progress: &(impl Fn(Progress) + Sync),
    interrupt: &Interrupt,
) -> Result<VertexLabels, Interrupted> {
    let mut found = Found::new(index.geometry.seen.len(), rest);
    let mut done = 0;
    for piece in order.chunks(PIECE) {
        let finder = || Finder::new(index);
        let made = in_chunks(piece.len(), finder, &|_| {}, |finder, numbers| {
            let blocks = piece[numbers.start as usize..numbers.end as usize].iter();
            let labels = blocks.map(|&block| {
                interrupt.check(DURING)?;
                Ok((block, finder.block(index, space, block)))
            });
            labels.collect::<Result<Vec<_>, _>>()
        })?;
        let is_full = made.into_iter().flatten().any(|(block, own)| !found.add(block, &own));
        done += piece.len();
        progress(Progress { stage: Stage::Vertices, done, total: order.len() });
        if is_full {
            break;
        }
    }
    Ok(found.finish())
}

/// The labels of the vertices of a block, or of several.
#[derive(Default)]
struct Labels {
    /// By vertex.
    spans: Vec<Span>,
    words: Vec<u64>,
}

impl Labels {
    fn memory_bytes(&self) -> usize {
        size_of_val(&*self.spans) + size_of_val(&*self.words)
    }
}

/// The labels that have been found, and the room that is left.
struct Found {
    /// The bytes that are left.
    rest: usize,
    blocks: Box<[u32]>,
    all: Labels,
}

impl Found {
    fn new(blocks: usize, rest: usize) -> Self {
        let rest = rest.saturating_sub(size_of::<Span>());
        Self { rest, blocks: vec![NONE; blocks].into(), all: Labels::default() }
    }

    /// Adds the labels of a block; `false` if they do not fit.
    fn add(&mut self, block: u32, own: &Labels) -> bool {
        let Self { rest, blocks, all } = self;
        let begin = all.words.len();
        let Some(left) = rest.checked_sub(own.memory_bytes()) else { return false };
        if begin + own.words.len() >= u32::MAX as usize {
            return false;
        }
        blocks[block as usize] = all.spans.len() as u32;
        let moved = |span: &Span| Span { word: span.word + begin as u32, ..*span };
        all.spans.extend(own.spans.iter().map(moved));
        all.words.extend(&own.words);
        *rest = left;
        true
    }

    fn finish(self) -> VertexLabels {
        let Self { blocks, all: Labels { mut spans, words }, .. } = self;
        if spans.is_empty() {
            return VertexLabels::default();
        }
        spans.push(Span { word: words.len() as u32, leading: 0 });
        VertexLabels { blocks, spans: spans.into(), words: words.into() }
    }
}

/// The best known way to a hub.
#[derive(Clone, Copy)]
struct Way {
    /// Its cost; [`NEVER`] if there is none.
    cost: u64,
    /// Its first subgoal.
    first: u32,
}

/// The cost of what has no known way: no sum with it overflows.
const NEVER: u64 = u64::MAX / 2;

/// Scratch memory for finding the labels of vertices.
struct Finder {
    candidates: Candidates<Step>,
    /// By hub.
    ways: Vec<Way>,
    /// The hubs with a known way.
    hubs: Vec<u32>,
}

impl Finder {
    fn new<P: SubgoalPlacement>(index: &HubLabels<P>) -> Self {
        let candidates = Candidates::new(index.geometry.seen.most + 1);
        let ways = vec![Way { cost: NEVER, first: 0 }; index.subgoals()];
        Self { candidates, ways, hubs: Vec::new() }
    }

    /// The labels of the vertices of a block.
    fn block<P: SubgoalPlacement>(
        &mut self,
        index: &HubLabels<P>,
        space: &FreeSpace<P>,
        block: u32,
    ) -> Labels {
        let mut found = Labels::default();
        let columns = index.geometry.seen.columns;
        let [x, y] = [block % columns, block / columns].map(|corner| corner as i32 * SIDE);
        for number in 0..BLOCK as i32 {
            let word = found.words.len() as u32;
            let at = Vertex::new(x + number % SIDE, y + number / SIDE);
            let leading = if space.is_free(at) {
                self.find_ways(index, space, at);
                self.take(index, at, &mut found.words)
            } else {
                0
            };
            found.spans.push(Span { word, leading });
        }
        found
    }

    /// Finds the best ways from a vertex to its hubs.
    fn find_ways<P: SubgoalPlacement>(&mut self, index: &HubLabels<P>, space: &FreeSpace<P>, at: Vertex) {
        let Self { candidates, ways, hubs } = self;
        let mut reach = |hub: u32, cost: u64, first: u32| {
            let known = &mut ways[hub as usize];
            if known.cost == NEVER {
                hubs.push(hub);
            }
            if cost < known.cost {
                *known = Way { cost, first };
            }
        };
        candidates.find(index, space, at);
        let leading = candidates.find_leading(index);
        for (slot, &step) in candidates.slots[..candidates.count].iter().zip(&candidates.steps) {
            let id = slot / P::SIDES;
            reach(id, step.cost(index), id);
        }
        for &i in &candidates.leading[..leading] {
            let (slot, step) = (candidates.slots[i as usize], candidates.steps[i as usize]);
            index.visit(slot, step, |hub, cost| reach(hub, cost, slot / P::SIDES));
        }
    }

    /// Writes the labels of a vertex whose ways are known, and forgets these. Returns how many have a first
    /// step.
    fn take<P: SubgoalPlacement>(&mut self, index: &HubLabels<P>, at: Vertex, words: &mut Vec<u64>) -> u32 {
        let Self { ways, hubs, .. } = self;
        let (packed, subgoals) = (&index.packed, &index.geometry.subgoals);
        let way = |hub: u32| ways[hub as usize];
        let is_outdone = |hub: u32| {
            let groups = packed.groups(hub * P::SIDES, P::SIDES);
            let labels = &packed.labels[packed.begin(groups.start)..packed.begin(groups.end)];
            let most = way(hub).cost;
            labels.iter().any(|&label| way(packed.hub(label)).cost + packed.cost(label) + ROUNDED < most)
        };
        let is_seen = |hub: u32| way(hub).first == hub;
        let mut kept: Vec<_> = hubs
            .iter()
            .filter(|&&hub| is_seen(hub) || !is_outdone(hub))
            .map(|&hub| (is_seen(hub), way(hub).cost, hub))
            .collect();
        kept.sort_unstable();
        let chains = Chains::<P>::new(packed, subgoals, index.k);
        let mut leading = 0;
        for (is_seen, cost, hub) in kept {
            let label = packed.label(hub, cost);
            if is_seen {
                words.push(label);
                continue;
            }
            let (first, at_first) = (way(hub).first, subgoals.vertex(way(hub).first));
            if let Some(on) = chains.label_after((at.to(at_first), first), hub) {
                words.extend([label, PathStep::new(at_first, on).to_word()]);
                leading += 1;
            }
        }
        for hub in hubs.drain(..) {
            ways[hub as usize].cost = NEVER;
        }
        leading
    }
}
