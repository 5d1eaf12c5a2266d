//! Laws that all paths have in common: the way back, ways by a third vertex, parts.

use mediant::{Ends, Error, Path, Vertex};

use super::{CASES, Case, all_motions, asker, is_closed_gap};
use crate::prove::tally::Tally;

/// The way back costs the same.
pub(super) fn symmetry(case: Case<'_>, tally: &mut Tally) -> Result<(), Error> {
    let motions = all_motions();
    for (number, &motion) in motions.iter().enumerate() {
        let mut asker = asker(&case.terrain.map, motion)?;
        for instance in case.share(number, motions.len()) {
            let Ends { start, goal, .. } = instance.ends;
            let (there, back) = (asker.cost(instance.ends), asker.cost(Ends::new(goal, start)));
            tally.count(CASES);
            let what = || format!("{}: {there} there, {back} back", case.words(instance, motion));
            tally.expect(there.agrees(&back), what);
        }
    }
    Ok(())
}

/// A way by the start of another instance costs no less.
pub(super) fn triangle(case: Case<'_>, tally: &mut Tally) -> Result<(), Error> {
    let motions = all_motions();
    for (number, &motion) in motions.iter().enumerate() {
        let mut asker = asker(&case.terrain.map, motion)?;
        for instance in case.share(number, motions.len()) {
            let Ends { start, goal, .. } = instance.ends;
            let Some(third) = case.next(instance).map(|next| next.ends.start) else { continue };
            let straight = asker.cost(instance.ends);
            let detour = asker.cost(Ends::new(start, third)).plus(&asker.cost(Ends::new(third, goal)));
            // An end that is no vertex makes no triangle.
            if !straight.is_path() || !asker.space.is_free(third) {
                continue;
            }
            tally.count(CASES);
            tally.expect(straight.is_at_most(1.0, &detour), || {
                format!("{}: {straight}, by {third} {detour}", case.words(instance, motion))
            });
        }
    }
    Ok(())
}

/// Two vertices within a path: the bend in its middle, and one a third of the way along.
fn within(path: &Path) -> Vec<Vertex> {
    let bends = path.waypoints();
    let vertices: Vec<Vertex> = path.vertices().collect();
    let middle = bends.get(bends.len() / 2).filter(|_| bends.len() > 2);
    middle
        .into_iter()
        .chain(vertices.get(vertices.len() / 3).filter(|_| vertices.len() > 3))
        .copied()
        .collect()
}

/// The parts of a shortest path are shortest paths: their costs add up to its own.
pub(super) fn parts(case: Case<'_>, tally: &mut Tally) -> Result<(), Error> {
    let motions = all_motions();
    for (number, &motion) in motions.iter().enumerate() {
        let mut asker = asker(&case.terrain.map, motion)?;
        for instance in case.share(number, motions.len()) {
            let Ends { start, goal, .. } = instance.ends;
            let (whole, Some(path)) = asker.path(instance.ends) else { continue };
            for at in within(&path) {
                // A path that passes a closed gap within one quadrant may not end there.
                if is_closed_gap(&case.terrain.map, motion, at) {
                    continue;
                }
                let sum = asker.cost(Ends::new(start, at)).plus(&asker.cost(Ends::new(at, goal)));
                tally.count(CASES);
                tally.expect(whole.agrees(&sum), || {
                    format!("{}: {whole}, in parts at {at} {sum}", case.words(instance, motion))
                });
            }
        }
    }
    Ok(())
}
