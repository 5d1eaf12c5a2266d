//! Fields that follow an edit of their surface.
//!
//! A field is the least costs that satisfy all moves, and costs are integers. So whatever finds them finds
//! the same ones. A move and its reverse cost the same. Two passes, each in the order of costs:
//!
//! 1. **Raising.** A state *is supported* if it is a source, or if a move leads to it from a state that is
//!    not raised, whose cost and that of the move are together no more than its own. The states near the
//!    changed cells that are not supported are raised: they have no cost any more. Then follow those that had
//!    no other support than raised ones. A support costs less than what it supports, so a state is looked at
//!    after all that may support it. Along supports a path leads from a source to each state that is not
//!    raised: it costs no more than the state, whose old cost is not too small.
//! 2. **Lowering.** Dijkstra's algorithm from the raised states and those near the changed cells, as far as a
//!    neighbor makes them cheaper. What it ends with is too small nowhere, and no move makes it smaller:
//!    elsewhere the old costs were so already. These are the least costs. ∎
//!
//! *Near* a cell are the ends of all moves that depend on it. Moves become dearer only by cells that cost
//! more, or are blocked: near these states are raised. By the others moves become cheaper.
//!
//! **Allocation.** With it a label is a cost and the number of a source, and the lesser of two labels is that
//! of the lesser cost, then of the lesser number. A move adds to the cost alone. All of the above holds for
//! these labels.
//!
//! A state takes several times as long as in a new field, whose queue is made of buckets. So a repair gives
//! up once it has looked at more than a small part of the states.

use std::{cmp::Reverse, collections::BinaryHeap, sync::Arc};

use mediant_grid::{Identity, Interrupt, Interrupted, VersionEdit};
use mediant_search::End;

use super::{CostField, search::NONE, starts};
use crate::{error::CostFieldError, graph::CostGraph, near::ends_near, scan::Visit};

/// One in so many states of the field may be looked at before it is made anew. Measured so that even then
/// both together mostly take at most 1.5 times as long: see `docs/measurements/costs.md`.
const SHARE: usize = 6;
/// One in so many states of the graph may be looked at before that is found out: a new field writes to all.
const FIRST_SHARE: usize = 256;
/// So many are always looked at.
const AT_LEAST: usize = 256;
/// So many states tell how many are in the field.
const SAMPLE: usize = 1024;
/// The looks between two questions of an interrupt.
const LOOK: usize = 1 << 12;
const STAGE: &str = "repairing the costs of a field";

impl CostField {
    /// The field of the same sources and limit on the surface after an edit: to the last bit the one made
    /// anew. `cells` are the cells that changed, and others as one likes. The work follows the vertices whose
    /// cost changes. `None` where it is quicker to make it [anew](Self::new): where they are many, where the
    /// surface has other units, and where closed gaps came or went. This field stays as it is; the next
    /// repair takes its memory, if it is given up by then.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use mediant_costs::{CostField, CostFieldQuery, CostGraph, CostSurface};
    /// use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
    /// use mediant_moves::FiniteK;
    ///
    /// let map = CostSurface::from_fn(9, 1, |x, _| Some(if x < 5 { 1.0 } else { 3.0 }))?;
    /// let graph = CostGraph::new(Arc::new(map), Rules::Center(CornerRule::Never), FiniteK::N8)?;
    /// let graph = Arc::new(graph);
    /// let query = CostFieldQuery::new(&[Vertex { x: 0, y: 0 }]);
    /// let field = CostField::new(Arc::clone(&graph), query, &Interrupt::NEVER)?;
    /// // A road to the end.
    /// let map = graph.map().edit([(7, 0, Some(1.0)), (8, 0, Some(1.0))])?;
    /// let cells = [(7, 0), (8, 0)];
    /// let after = Arc::new(graph.after(Arc::new(map), &cells)?);
    /// let repaired = field.repaired(&after, &cells, &Interrupt::NEVER)?.expect("a small change");
    /// assert_eq!((field.get((8, 0).into()), repaired.get((8, 0).into())), (Some(15.0), Some(12.0)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`CostFieldError::Mismatch`] for a graph under other rules or of another k, or if other cells changed
    /// than these; [`CostFieldError::Query`] for the first source that is now blocked;
    /// [`CostFieldError::Interrupted`].
    pub fn repaired(
        &self,
        after: &Arc<CostGraph>,
        cells: &[(u32, u32)],
        interrupt: &Interrupt,
    ) -> Result<Option<Self>, CostFieldError> {
        interrupt.check(STAGE)?;
        let before = &self.graph;
        let on_any_map = Identity { map: None, ..self.identity() };
        on_any_map.check("the field", ("the graph", after.identity()))?;
        self.sources.iter().try_for_each(|&at| after.check(End::Start, at))?;
        let has_same_states = before.size() == after.size()
            && before.map().scale() == after.map().scale()
            && before.scanner().gaps.is_same_as(&after.scanner().gaps);
        if !has_same_states {
            return Ok(None);
        }
        let changed = Identity { map: Some(before.map().id_with(cells, after.map())), ..self.identity() };
        changed.check_equal("the change", ("the graph", after.identity()))?;
        let Some(near) = near(before, after, cells) else { return Ok(None) };
        let mut repair = Repair {
            graph: after,
            costs: self.costs.edit_if_room(STAGE)?,
            numbers: self.allocation.as_ref().map(|numbers| numbers.edit_if_room(STAGE)).transpose()?,
            limit: after.greatest_cost(self.limit),
            open: BinaryHeap::new(),
            looks: after.states() / FIRST_SHARE + AT_LEAST,
            is_sampled: false,
            ask: Ask::Lower(0),
            interrupt,
        };
        let mut starts: Vec<(usize, u32)> = starts(after, &self.sources).collect();
        // Of several at one place the first is the least.
        starts.sort_unstable();
        starts.dedup_by_key(|&mut (state, _)| state);
        let is_done = repair.run(&near, &starts);
        // The memory that is given up is that of the next one.
        let Repair { costs, numbers, open, .. } = repair;
        let repaired = Self {
            graph: Arc::clone(after),
            costs: costs.finish(),
            allocation: numbers.map(VersionEdit::finish),
            sources: self.sources.clone(),
            limit: self.limit,
            queue_bytes: open.capacity() * size_of::<Reverse<(u64, u32)>>(),
        };
        Ok(is_done?.then_some(repaired))
    }
}

/// The change. Gaps that stay gaps but turn have cells around them that rose, and others that fell.
struct Near {
    /// Cells that are now blocked, by position.
    blocked: Vec<usize>,
    /// Cells that are now free.
    freed: Vec<usize>,
    /// The states near cells that cost more or are blocked: their moves may have become dearer.
    risen: Vec<usize>,
    /// The states near cells that cost less or are freed: their moves may have become cheaper.
    fallen: Vec<usize>,
}

/// `None` if it is too much.
fn near(before: &CostGraph, after: &CostGraph, cells: &[(u32, u32)]) -> Option<Near> {
    let (layout, width, height) = (after.layout(), after.map().width(), after.map().height());
    let position = |(x, y): (u32, u32)| layout.position(x as i32, y as i32);
    let weights = |at: usize| [before, after].map(|graph| graph.map().weights()[at]);
    // A blocked cell is dearer than any.
    let costs = |at: usize| weights(at).map(|weight| weight.wrapping_sub(1));
    let is_on = |&(x, y): &(u32, u32)| x < width && y < height;
    let cells = || cells.iter().copied().filter(is_on);
    let are = |is: fn([u32; 2]) -> bool| cells().filter(move |&cell| is(costs(position(cell))));
    let most = after.states() / SHARE + AT_LEAST;
    Some(Near {
        blocked: are(|[was, is]| was != is && is == u32::MAX).map(position).collect(),
        freed: are(|[was, is]| was == u32::MAX && is < was).map(position).collect(),
        risen: ends_near(after, are(|[was, is]| is > was), most)?,
        fallen: ends_near(after, are(|[was, is]| is < was), most)?,
    })
}

/// A cost and the number of a source, which is 0 without allocation.
type Label = (u64, u32);

/// The purpose of a scan.
#[derive(Clone, Copy)]
enum Ask {
    /// The least label that a move leads to, if it is at most this one, and whether there is any.
    Least(Label, bool),
    /// To queue what a state of this number may support.
    Supported(u32),
    /// To lower what a state of this number makes cheaper.
    Lower(u32),
}

struct Repair<'r> {
    graph: &'r CostGraph,
    costs: VersionEdit<u64>,
    numbers: Option<VersionEdit<u32>>,
    /// The greatest cost in the field.
    limit: u64,
    /// States by cost.
    open: BinaryHeap<Reverse<(u64, u32)>>,
    /// The number of states that may be looked at yet.
    looks: usize,
    /// Whether these are all that may be.
    is_sampled: bool,
    ask: Ask,
    interrupt: &'r Interrupt,
}

impl Repair<'_> {
    /// Returns false if it gives up.
    fn run(&mut self, near: &Near, starts: &[(usize, u32)]) -> Result<bool, Interrupted> {
        if self.graph.is_center() {
            // All that a blocked cell supported is near.
            near.blocked.iter().for_each(|&at| self.set(at, (0, u32::MAX)));
            near.freed.iter().for_each(|&at| self.set(at, (NONE, u32::MAX)));
        }
        match self.raise(&near.risen, starts)? {
            Some(raised) => self.lower(near.fallen.iter().copied().chain(raised), starts),
            None => Ok(false),
        }
    }

    /// Raises what is not supported any more, and returns it; `None` if it gives up.
    fn raise(&mut self, near: &[usize], starts: &[(usize, u32)]) -> Result<Option<Vec<usize>>, Interrupted> {
        for &state in near {
            let label = self.label(state);
            if label.0 != NONE {
                if !self.may_look()? {
                    return Ok(None);
                }
                if !self.is_supported(state, label, starts) {
                    self.open.push(Reverse((label.0, state as u32)));
                }
            }
        }
        let mut raised = Vec::new();
        let mut last = None;
        while let Some(Reverse(entry)) = self.open.pop() {
            // Several states may have queued it: by the same cost, so one after the other.
            if last.replace(entry) == Some(entry) {
                continue;
            }
            if !self.may_look()? {
                return Ok(None);
            }
            let (cost, state) = (entry.0, entry.1 as usize);
            let label = self.label(state);
            if self.is_supported(state, label, starts) {
                continue;
            }
            self.set(state, (NONE, u32::MAX));
            raised.push(state);
            self.ask = Ask::Supported(label.1);
            self.graph.scan((state, cost), &mut *self);
        }
        Ok(Some(raised))
    }

    /// Lowers these states, sources, and all that they make cheaper. Returns false if it gives up.
    fn lower(
        &mut self,
        states: impl Iterator<Item = usize>,
        starts: &[(usize, u32)],
    ) -> Result<bool, Interrupted> {
        for &(state, number) in starts {
            let number = if self.numbers.is_some() { number } else { 0 };
            if (0, number) < self.label(state) {
                self.set(state, (0, number));
                self.open.push(Reverse((0, state as u32)));
            }
        }
        for state in states {
            if !self.may_look()? {
                return Ok(false);
            }
            let label = self.label(state);
            if let Some(less) = self.least(state, label.min((self.limit.min(NONE - 1), u32::MAX)))
                && less < label
            {
                self.set(state, less);
                self.open.push(Reverse((less.0, state as u32)));
            }
        }
        while let Some(Reverse((cost, state))) = self.open.pop() {
            let label = self.label(state as usize);
            if label.0 != cost {
                continue;
            }
            if !self.may_look()? {
                return Ok(false);
            }
            self.ask = Ask::Lower(label.1);
            self.graph.scan((state as usize, cost), &mut *self);
        }
        Ok(true)
    }

    /// Whether a state has its label still, as a source or by a move.
    fn is_supported(&mut self, state: usize, label: Label, starts: &[(usize, u32)]) -> bool {
        if label.0 > 0 {
            return self.least(state, label).is_some();
        }
        let known = starts.binary_search_by_key(&state, |&(start, _)| start);
        known.is_ok_and(|at| self.numbers.is_none() || starts[at].1 == label.1)
    }

    /// The least label that a move makes of a state, if it is at most this one.
    fn least(&mut self, state: usize, most: Label) -> Option<Label> {
        self.ask = Ask::Least(most, false);
        self.graph.scan((state, 0), &mut *self);
        match self.ask {
            Ask::Least(least, true) => Some(least),
            _ => None,
        }
    }

    /// Counts a look. Returns whether there may be one.
    #[inline]
    fn may_look(&mut self) -> Result<bool, Interrupted> {
        if self.looks == 0 && !std::mem::replace(&mut self.is_sampled, true) {
            self.looks = self.reached() / SHARE;
        }
        self.interrupt.check_every(LOOK, self.looks, STAGE)?;
        let may = self.looks > 0;
        self.looks -= usize::from(may);
        Ok(may)
    }

    /// The number of states in the field, about.
    fn reached(&self) -> usize {
        let costs = self.costs.words();
        // Odd, so that it meets every place of a tile.
        let step = (costs.len() / SAMPLE) | 1;
        let sample = costs.iter().enumerate().step_by(step);
        sample.filter(|&(at, &cost)| cost != NONE && !(cost == 0 && self.graph.is_blocked(at))).count() * step
    }

    #[inline]
    fn number(&self, state: usize) -> u32 {
        self.numbers.as_ref().map_or(0, |numbers| numbers.words()[state])
    }

    #[inline]
    fn label(&self, state: usize) -> Label {
        (self.costs.words()[state], self.number(state))
    }

    #[inline]
    fn set(&mut self, state: usize, (cost, number): Label) {
        self.costs.set(state, cost);
        if let Some(numbers) = &mut self.numbers {
            numbers.set(state, number);
        }
    }
}

impl Visit for Repair<'_> {
    #[inline]
    fn known(&self, to: usize) -> u64 {
        let cost = self.costs.words()[to];
        match self.ask {
            // A blocked cell has cost 0.
            Ask::Least((most, _), _) if cost > most || cost == 0 && self.graph.is_blocked(to) => 0,
            Ask::Least((most, _), _) => most - cost + 1,
            Ask::Supported(_) if cost == NONE => 0,
            Ask::Supported(_) => cost + 1,
            Ask::Lower(_) if cost > self.limit => self.limit + 1,
            Ask::Lower(number) if 0 < cost && cost < NONE && number < self.number(to) => cost + 1,
            Ask::Lower(_) => cost,
        }
    }

    fn relax(&mut self, _: usize, to: usize, cost: u64) {
        match self.ask {
            Ask::Least(most, _) => {
                let label = (self.costs.words()[to] + cost, self.number(to));
                if label <= most {
                    self.ask = Ask::Least(label, true);
                }
            }
            Ask::Supported(number) => {
                let label = self.label(to);
                if (cost, number) <= label {
                    self.open.push(Reverse((label.0, to as u32)));
                }
            }
            Ask::Lower(number) => {
                self.set(to, (cost, number));
                self.open.push(Reverse((cost, to as u32)));
            }
        }
    }
}
