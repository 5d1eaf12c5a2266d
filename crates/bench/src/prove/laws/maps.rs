//! The same problem on another map: mirrored, turned, larger.

use mediant::{Ends, Error, Map, Motion, PlacementKind, Vertex};

use super::{CASES, Case, all_motions, asker, at_corners, is_closed_gap};
use crate::prove::tally::Tally;

/// A map that shows the same from another side.
#[derive(Clone, Copy, Debug)]
enum View {
    /// Left and right are swapped.
    Mirrored,
    /// It is turned by a quarter.
    Turned,
}

impl View {
    fn of_map(self, map: &Map) -> Result<Map, Error> {
        let (width, height) = (map.width(), map.height());
        let blocked = |x: u32, y: u32| map.is_blocked((x as i32, y as i32));
        match self {
            Self::Mirrored => Map::from_fn(width, height, |x, y| blocked(width - 1 - x, y)),
            Self::Turned => Map::from_fn(height, width, |x, y| blocked(y, height - 1 - x)),
        }
    }

    /// The place of a vertex there. Between centers a side has one vertex less than at corners.
    fn of_vertex(self, map: &Map, motion: Motion, at: Vertex) -> Vertex {
        let less = i32::from(motion.rules.placement() == PlacementKind::Center);
        match self {
            Self::Mirrored => (map.width() as i32 - less - at.x, at.y).into(),
            Self::Turned => (map.height() as i32 - less - at.y, at.x).into(),
        }
    }
}

/// On the mirrored and the turned map paths cost the same.
pub(super) fn mirrored(case: Case<'_>, tally: &mut Tally) -> Result<(), Error> {
    let map = &case.terrain.map;
    let motions = all_motions();
    for view in [View::Mirrored, View::Turned] {
        let seen = view.of_map(map)?;
        for (number, &motion) in motions.iter().enumerate() {
            let (mut here, mut there) = (asker(map, motion)?, asker(&seen, motion)?);
            for instance in case.share(number, motions.len()) {
                let Ends { start, goal, .. } = instance.ends;
                // An end on a closed gap belongs to the cell right below it, which is another one there.
                if is_closed_gap(map, motion, start) || is_closed_gap(map, motion, goal) {
                    continue;
                }
                let ends = [start, goal].map(|at| view.of_vertex(map, motion, at));
                let (own, other) = (here.cost(instance.ends), there.cost(Ends::new(ends[0], ends[1])));
                tally.count(CASES);
                tally.expect(own.agrees(&other), || {
                    format!("{}: {own}, {view:?} {other}", case.words(instance, motion))
                });
            }
        }
    }
    Ok(())
}

/// At corners of a map that is two and three times as large, paths cost two and three times as much.
pub(super) fn scaled(case: Case<'_>, tally: &mut Tally) -> Result<(), Error> {
    let map = &case.terrain.map;
    let motions = at_corners();
    for factor in [2, 3] {
        let blocked = |x: u32, y: u32| map.is_blocked(((x / factor) as i32, (y / factor) as i32));
        let large = Map::from_fn(map.width() * factor, map.height() * factor, blocked)?;
        for (number, &motion) in motions.iter().enumerate() {
            let (mut here, mut there) = (asker(map, motion)?, asker(&large, motion)?);
            for instance in case.share(number, motions.len()) {
                let times = |at: Vertex| Vertex::from((at.x * factor as i32, at.y * factor as i32));
                let (own, ends) = (here.cost(instance.ends), instance.ends);
                let other = there.cost(Ends::new(times(ends.start), times(ends.goal)));
                tally.count(CASES);
                tally.expect(own.scaled(factor).agrees(&other), || {
                    format!("{}: {own}, {factor} times as large {other}", case.words(instance, motion))
                });
            }
        }
    }
    Ok(())
}
