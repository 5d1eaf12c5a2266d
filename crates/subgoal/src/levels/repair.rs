//! The graph of the map after an edit.

use mediant_grid::{Change, Corners, FreeSpace, Interrupt, Rectangle};

use super::{
    Bounds, Edges, LevelRecord, NONE, Replay,
    record::pack,
    replay::{Contracted, time},
    touches::Touches,
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
const SHARE: usize = 4;

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
        let mut touches = Touches::new(&ground.subgoals, read.collect(), space.grid());
        touched.into_iter().for_each(|id| touches.touch(id));

        let mut replay = Replay::new((graph, self), context, &edges, [now_of, then_of]);
        if !self.decide_again(&mut replay, &mut touches, (levels - 1, most), interrupt)? {
            return Ok(None);
        }
        let (read, touched) = touches.into_parts();
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
        let (first, shortcuts) = pack(&(0..count as u32).map(shortcuts).collect::<Vec<_>>());
        let level = std::mem::take(&mut replay.level).into();
        let record = Self { edges, seen: seen.into(), read: read.into(), level, first, shortcuts };
        let graph = ground.graph(space, graph.hierarchy, (offsets.into(), arcs.into()));
        Ok(Some((graph, record)))
    }

    /// Makes the decisions again that read something which was touched, of so many levels. Returns false if
    /// they are more than `most`.
    fn decide_again(
        &self,
        replay: &mut Replay<'_>,
        touches: &mut Touches<'_>,
        (levels, most): (u32, usize),
        interrupt: &Interrupt,
    ) -> Result<bool, SubgoalError> {
        let (context, count) = (replay.context, replay.then_of.len());
        let in_round = vec![false; count];
        let rule = ShortcutRule { geometry: &context, in_round: &in_round, interrupt, limit: u64::MAX };
        let mut finder = ShortcutFinder::default();
        let levels_then = self.level.iter().filter(|&&level| level != NONE).max().map_or(0, |&last| last + 1);
        for level in 0..levels {
            if level > 0 && level >= levels_then && !replay.level.contains(&(level - 1)) {
                break;
            }
            for id in 0..count as u32 {
                if !touches.is_open(id) {
                    continue;
                }
                if touches.open() > most {
                    return Ok(false);
                }
                interrupt.check(DURING)?;
                let then = replay.then_of[id as usize];
                let was = then != NONE && self.level[then as usize] == level;
                let is_gone = replay.level[id as usize] < level;
                let mut now = None;
                if !is_gone {
                    (replay.time, replay.read) = (time(level, id), Bounds::EMPTY);
                    let shortcuts = rule.shortcuts(replay, &mut finder, id)?;
                    let around = replay.around(id).to_vec();
                    let read = touches.read_mut(id);
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
        Ok(true)
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

/// The numbers that the subgoals of each of two maps have on the other; [`NONE`] for none. Both are numbered
/// row by row.
fn numbers([then, now]: [&Subgoals; 2]) -> [Vec<u32>; 2] {
    let [mut now_of, mut then_of] = [then, now].map(|subgoals| vec![NONE; subgoals.len()]);
    let place = |subgoals: &Subgoals, id: usize| {
        let at = subgoals.vertex(id as u32);
        (at.y, at.x)
    };
    let (mut one, mut other) = (0, 0);
    while one < then.len() && other < now.len() {
        let order = place(then, one).cmp(&place(now, other));
        if order.is_eq() {
            (now_of[one], then_of[other]) = (other as u32, one as u32);
        }
        one += usize::from(order.is_le());
        other += usize::from(order.is_ge());
    }
    [now_of, then_of]
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
