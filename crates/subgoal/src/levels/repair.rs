//! The graph of the map after an edit.

use mediant_grid::{Change, Corners, FreeSpace, Interrupt, Rectangle};

use super::{
    Bounds, Edges, LevelRecord, NONE, Replay,
    replay::{Contracted, time},
};
use crate::{
    arc::{Step, UpwardArc},
    build::Ground,
    contract::{Overlay as _, OverlayArc, ShortcutFinder, ShortcutRule, are_reachable},
    corners::{CornerScratch, edge_bounds},
    error::SubgoalError,
    graph::{MAX_ARCS, SubgoalGraph},
    placement::{BuildContext, EdgeFinder as _, EdgeKind},
    subgoals::Subgoals,
};

/// The stage that an interrupted call names.
const DURING: &str = "repairing subgoals";

/// The most rectangles of a change, all of which are compared with all boxes.
const MOST_RECTANGLES: usize = 256;

/// Of so many decisions at most one is made again; of more, all are made anew.
const SHARE: usize = 3;

impl LevelRecord {
    /// The graph and the record of the map after a change, equal to new ones; `None` if they are better made
    /// anew: if the graph is not that of the record or of the map before the change, or if too much has
    /// changed.
    ///
    /// # Errors
    /// As for [`SubgoalGraph::with_progress`].
    pub fn repaired(
        &self,
        graph: &SubgoalGraph<Corners>,
        space: &FreeSpace<Corners>,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Option<(SubgoalGraph<Corners>, Self)>, SubgoalError> {
        let [before, after] = [change.before(), change.after()].map(|map| map.id());
        let follows = graph.identity.map == Some(before)
            && graph.identity.rules == space.identity().rules
            && space.grid().id() == after
            && before.size() == after.size();
        let Some(levels) = graph.hierarchy.levels() else { return Ok(None) };
        if !follows || self.level.len() != graph.subgoals() || change.cells().len() > MOST_RECTANGLES {
            return Ok(None);
        }
        let ground = Ground::new(space, graph.k, graph.hierarchy, interrupt)?;
        let context = ground.context(space);
        let numbers = numbers([&graph.subgoals, &ground.subgoals]);
        let [now_of, then_of] = [&*numbers[0], &*numbers[1]];
        let count = then_of.len();
        let most = count / SHARE + 64;

        let Some(Swept { edges, seen, touched }) =
            self.swept(context, [now_of, then_of], change.cells(), most, interrupt)?
        else {
            return Ok(None);
        };

        let read = then_of.iter().map(|&id| self.read.get(id as usize).copied().unwrap_or(Bounds::EMPTY));
        let mut touches = Touches {
            subgoals: &ground.subgoals,
            read: read.collect(),
            touched: vec![false; count],
            is_open: vec![false; count],
            open: 0,
        };
        touched.into_iter().for_each(|id| touches.touch(id));

        let mut replay = Replay::new((graph, self), context, &edges, [now_of, then_of]);
        let in_round = vec![false; count];
        let rule = ShortcutRule { geometry: &context, in_round: &in_round, interrupt, limit: u64::MAX };
        let mut finder = ShortcutFinder::default();
        let levels_then = self.level.iter().filter(|&&level| level != NONE).max().map_or(0, |&last| last + 1);
        for level in 0..levels - 1 {
            if level > 0 && level >= levels_then && !replay.level.contains(&(level - 1)) {
                break;
            }
            for id in 0..count as u32 {
                if !touches.is_open[id as usize] {
                    continue;
                }
                if touches.open > most {
                    return Ok(None);
                }
                interrupt.check(DURING)?;
                let then = then_of[id as usize];
                let was = then != NONE && self.level[then as usize] == level;
                let is_gone = replay.level[id as usize] < level;
                let mut now = None;
                if !is_gone {
                    (replay.time, replay.read) = (time(level, id), Bounds::EMPTY);
                    let shortcuts = rule.shortcuts(&mut replay, &mut finder, id)?;
                    let around = replay.around(id).to_vec();
                    let read = &mut touches.read[id as usize];
                    if level == 0 {
                        *read = Bounds::EMPTY;
                    }
                    read.join(replay.read);
                    if are_reachable(&context, &around, &shortcuts) {
                        now = Some(Contracted { around, shortcuts });
                        replay.level[id as usize] = level;
                    } else if was {
                        replay.level[id as usize] = NONE;
                    }
                }
                if was != now.is_some() {
                    touches.touch(id);
                }
                let offers = |contracted: &Contracted| contracted.offers(id);
                let before = if was { offers(&replay.contracted_then(id)) } else { Vec::new() };
                let after = now.as_ref().map(offers).unwrap_or_default();
                differences(&before, &after, |other| touches.touch(other));
                if let Some(now) = now {
                    replay.set(id, now);
                }
            }
        }

        let Touches { read, touched, .. } = touches;
        let mut offsets = Vec::with_capacity(count + 1);
        let mut arcs = Vec::with_capacity(graph.arcs());
        let now = |id: u32| now_of.get(id as usize).copied().unwrap_or(NONE);
        for id in 0..count as u32 {
            interrupt.check_every(1 << 10, id as usize, DURING)?;
            offsets.push(2 * arcs.len() as u32 + u32::from(replay.level[id as usize] == NONE));
            if touched[id as usize] {
                arcs.extend(replay.last_list(id).iter().map(|arc| upward(&ground.subgoals, id, arc)));
            } else {
                let same = |arc: &UpwardArc| UpwardArc { to: now(arc.to), middle: now(arc.middle), ..*arc };
                arcs.extend(graph.up(then_of[id as usize]).iter().map(same));
            }
            if arcs.len() > MAX_ARCS as usize {
                return Err(SubgoalError::Arcs { count: arcs.len(), most: MAX_ARCS });
            }
        }
        offsets.push(2 * arcs.len() as u32);
        let is_made = |id: u32| replay.level[id as usize] != NONE;
        let shortcuts = |id: u32| if is_made(id) { replay.shortcuts(id) } else { &[] };
        let made: Vec<_> = (0..count as u32).map(shortcuts).collect();
        let level = replay.level.clone();
        let record = SubgoalGraph::record(edges.clone(), seen, read, level, &made);
        let graph = ground.graph(space, graph.hierarchy, (offsets.into(), arcs.into()));
        Ok(Some((graph, record)))
    }

    /// The edges of the new map; `None` if more than `most` sweeps are to be made.
    fn swept(
        &self,
        context: BuildContext<'_, Corners>,
        [now_of, then_of]: [&[u32]; 2],
        cells: &[Rectangle],
        most: usize,
        interrupt: &Interrupt,
    ) -> Result<Option<Swept>, SubgoalError> {
        let mut scratch = CornerScratch::default();
        let mut touched = Vec::new();
        let mut seen = Vec::with_capacity(then_of.len());
        // The edges that were found anew, and where those of a subgoal begin and end.
        let (mut found, mut parts) = (Vec::new(), vec![None; then_of.len()]);
        let mut sweeps = 0;
        for (id, &then) in (0..).zip(then_of) {
            let known = self.seen.get(then as usize);
            if let Some(&bounds) = known
                && !cells.iter().any(|cells| bounds.touches(cells))
            {
                seen.push(bounds);
                continue;
            }
            interrupt.check(DURING)?;
            sweeps += 1;
            if sweeps > most {
                return Ok(None);
            }
            let at = context.subgoals.vertex(id);
            seen.push(edge_bounds(context, &mut scratch, at));
            let first = found.len();
            Corners::edges_from(context, &mut scratch, at, EdgeKind::Graph, |to, _| found.push(to));
            let is_beside = |cells: &Rectangle| Bounds::around([at, at]).touches(cells);
            let same = |to: &u32| now_of[*to as usize];
            let before = known.map_or(&[][..], |_| self.edges.onward(then)).iter().map(same);
            let after = &found[first..];
            if known.is_none() || cells.iter().any(is_beside) || !before.clone().eq(after.iter().copied()) {
                touched.push(id);
                let mut ends: Vec<_> = before.map(|to| (to, false)).collect();
                ends.extend(after.iter().map(|&to| (to, true)));
                ends.sort_unstable();
                let by_end = ends.chunk_by(|one, other| one.0 == other.0);
                touched.extend(by_end.filter(|same| same.len() == 1).map(|one| one[0].0));
            }
            parts[id as usize] = Some((first, found.len()));
        }
        // The edges of subgoals that are no more.
        for then in (0..).zip(now_of).filter_map(|(then, &now)| (now == NONE).then_some(then)) {
            touched.extend(self.edges.of(then).iter().map(|&to| now_of[to as usize]));
        }
        touched.retain(|&id| id != NONE);
        let onward = |id: u32| {
            let (new, same) = match parts[id as usize] {
                Some((first, end)) => (&found[first..end], &[][..]),
                None => (&[][..], self.edges.onward(then_of[id as usize])),
            };
            new.iter().copied().chain(same.iter().map(|&to| now_of[to as usize]))
        };
        Ok(Some(Swept { edges: Edges::new(then_of.len(), onward), seen, touched }))
    }
}

/// The edges of the new map, what their sweeps read, and the subgoals whose edges have changed.
struct Swept {
    edges: Edges,
    seen: Vec<Bounds>,
    touched: Vec<u32>,
}

/// The lists that may differ from those of the earlier map, and the decisions that may.
struct Touches<'m> {
    subgoals: &'m Subgoals,
    read: Vec<Bounds>,
    touched: Vec<bool>,
    /// The subgoals that must be decided about again.
    is_open: Vec<bool>,
    open: usize,
}

impl Touches<'_> {
    /// Touches the list of a subgoal: whatever read it must be decided again.
    fn touch(&mut self, id: u32) {
        // An end that is no more.
        if id == NONE || std::mem::replace(&mut self.touched[id as usize], true) {
            return;
        }
        let at = self.subgoals.vertex(id);
        for (other, (read, is_open)) in (0..).zip(self.read.iter().zip(&mut self.is_open)) {
            if !*is_open && (other == id || read.contains(at)) {
                *is_open = true;
                self.open += 1;
            }
        }
    }
}

/// The numbers that the subgoals of each of two maps have on the other; [`NONE`] for none. Both are numbered
/// row by row.
fn numbers([then, now]: [&Subgoals; 2]) -> [Vec<u32>; 2] {
    let find = |from: &Subgoals, to: &Subgoals| {
        (0..from.len() as u32).map(|id| to.id(from.vertex(id)).unwrap_or(NONE)).collect()
    };
    [find(then, now), find(now, then)]
}

/// Visits the neighbors to which two subgoals offer different things.
fn differences(before: &[(u32, OverlayArc)], after: &[(u32, OverlayArc)], mut visit: impl FnMut(u32)) {
    let of = |offers: &[(u32, OverlayArc)], to: u32| {
        let first = offers.partition_point(|offer| offer.0 < to);
        first..first + offers[first..].partition_point(|offer| offer.0 == to)
    };
    for offers in [before, after] {
        for same in offers.chunk_by(|one, other| one.0 == other.0) {
            let to = same[0].0;
            if before[of(before, to)] != after[of(after, to)] {
                visit(to);
            }
        }
    }
}

/// An arc with its cost and steps.
fn upward(subgoals: &Subgoals, from: u32, arc: &OverlayArc) -> UpwardArc {
    let &OverlayArc { cost, to, middle, first, last } = arc;
    let step = |from: u32, to: u32| Step::of(subgoals.vertex(from).to(subgoals.vertex(to)));
    // A cost over N(k) is one word.
    UpwardArc { cost: cost as u64, to, middle, first: step(from, first), last: step(last, to) }
}
