//! Distances to marked vertices, after a change of the map.
//!
//! A distance d > 0 is *held up* by a neighbor at distance d − 1. Where marks are gone, distances that
//! nothing holds up any more are raised, level by level: whether a vertex at d + 1 is held up is known once
//! all of those at d are raised that must be. Then the raised vertices take what their neighbors offer, new
//! marks come in at 0, and distances are handed on from the least to the greatest, as in a new transform.

use mediant_grid::{Change, Grid, Interrupt, Interrupted, Placement, VersionEdit, Vertex};

use super::{DURING, Layer};

/// Of so many vertices one may change; beyond that a new transform is quicker.
const SHARE: usize = 16;

/// A layer of distances while it follows a change.
pub(super) struct Repair<'v> {
    values: &'v mut VersionEdit<[u8; 2]>,
    layer: Layer,
    width: i32,
    height: i32,
    /// The vertices that still hand on their distance, by distance.
    levels: Vec<Vec<Vertex>>,
    /// The number of vertices that may still change.
    left: usize,
}

impl<'v> Repair<'v> {
    pub(super) fn new<P: Placement>(values: &'v mut VersionEdit<[u8; 2]>, grid: &Grid, layer: Layer) -> Self {
        let (width, height) = P::vertices(grid);
        let left = values.words().len() / SHARE;
        Self { values, layer, width: width as i32, height: height as i32, levels: Vec::new(), left }
    }

    /// Whether the distances follow: if not, too many would change.
    pub(super) fn follow<P: Placement>(
        mut self,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<bool, Interrupted> {
        let Some((gone, new)) = self.marks::<P>(change) else { return Ok(false) };
        let Some(raised) = self.raise(gone, interrupt)? else { return Ok(false) };
        for at in raised {
            let offered = self.around(at).fold(self.beyond(at), |least, next| least.min(self.get(next)));
            self.lower(at, offered.saturating_add(1));
        }
        for at in new {
            self.lower(at, 0);
        }
        self.hand_on(interrupt)
    }

    /// The vertices whose marks are gone, with the greatest distance, and those that are marked now; `None`
    /// for too large a change.
    fn marks<P: Placement>(&mut self, change: &Change) -> Option<(Vec<Vertex>, Vec<Vertex>)> {
        let (mut gone, mut new) = (Vec::new(), Vec::new());
        for at in change.cells() {
            // Cells up to one away from a vertex decide about its mark.
            let side = |first: u32, count: u32, side: i32| {
                (first as i32 - 1).max(0)..((first + count) as i32 + 1).min(side)
            };
            let (columns, rows) = (side(at.x, at.width, self.width), side(at.y, at.height, self.height));
            self.left = self.left.checked_sub(columns.len() * rows.len())?;
            for at in rows.flat_map(|y| columns.clone().map(move |x| Vertex::new(x, y))) {
                let is_marked = self.layer.marked::<P>(change.after(), (at.x, at.y)) & 1 == 1;
                match (self.get(at) == 0, is_marked) {
                    (true, false) => {
                        self.set(at, u8::MAX);
                        gone.push(at);
                    }
                    (false, true) => new.push(at),
                    _ => {}
                }
            }
        }
        Some((gone, new))
    }

    /// Gives all vertices the greatest distance that nothing holds up without those whose marks are gone, and
    /// returns them all; `None` if these are too many.
    fn raise(
        &mut self,
        gone: Vec<Vertex>,
        interrupt: &Interrupt,
    ) -> Result<Option<Vec<Vertex>>, Interrupted> {
        let (mut raised, mut first) = (gone, 0);
        for distance in 0..u8::MAX - 1 {
            let level = first..raised.len();
            if level.is_empty() {
                break;
            }
            interrupt.check(DURING)?;
            first = level.end;
            for i in level {
                for at in self.around(raised[i]) {
                    if self.get(at) == distance + 1 && !self.is_held_up(at, distance) {
                        self.set(at, u8::MAX);
                        raised.push(at);
                    }
                }
            }
            if raised.len() > self.left {
                return Ok(None);
            }
        }
        Ok(Some(raised))
    }

    /// Whether a vertex has a neighbor at this distance.
    fn is_held_up(&self, at: Vertex, distance: u8) -> bool {
        self.beyond(at) == distance || self.around(at).any(|next| self.get(next) == distance)
    }

    /// Hands distances on, from the least to the greatest. Whether not too many vertices changed.
    fn hand_on(&mut self, interrupt: &Interrupt) -> Result<bool, Interrupted> {
        for distance in 0..u8::MAX - 1 {
            let Some(level) = self.levels.get_mut(usize::from(distance)) else { break };
            let level = std::mem::take(level);
            interrupt.check(DURING)?;
            let Some(left) = self.left.checked_sub(level.len()) else { return Ok(false) };
            self.left = left;
            for from in level {
                // Some have come closer since they were listed.
                if self.get(from) == distance {
                    self.around(from).for_each(|at| self.lower(at, distance + 1));
                }
            }
        }
        Ok(true)
    }

    /// Gives a vertex a distance, unless it has one that is as small.
    fn lower(&mut self, at: Vertex, distance: u8) {
        if distance >= self.get(at) {
            return;
        }
        self.set(at, distance);
        let level = usize::from(distance);
        if level >= self.levels.len() {
            self.levels.resize_with(level + 1, Vec::new);
        }
        self.levels[level].push(at);
    }

    /// The distance of the positions next to a vertex that are not on the map; the greatest if all are.
    const fn beyond(&self, at: Vertex) -> u8 {
        let is_inside = at.x > 0 && at.y > 0 && at.x + 1 < self.width && at.y + 1 < self.height;
        if is_inside { u8::MAX } else { self.layer.outside() }
    }

    /// The vertices at a distance of at most 1 from a vertex.
    fn around(&self, at: Vertex) -> impl Iterator<Item = Vertex> + use<> {
        let side = |at: i32, side: i32| (at - 1).max(0)..(at + 2).min(side);
        let columns = side(at.x, self.width);
        side(at.y, self.height).flat_map(move |y| columns.clone().map(move |x| Vertex::new(x, y)))
    }

    const fn index(&self, at: Vertex) -> usize {
        at.y as usize * self.width as usize + at.x as usize
    }

    fn get(&self, at: Vertex) -> u8 {
        self.values.words()[self.index(at)][self.layer as usize]
    }

    fn set(&mut self, at: Vertex, distance: u8) {
        let index = self.index(at);
        let mut value = self.values.words()[index];
        value[self.layer as usize] = distance;
        self.values.set(index, value);
    }
}
