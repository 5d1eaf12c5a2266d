//! The ends of the moves that depend on cells.

use crate::graph::CostGraph;

/// The states at the ends of all moves that depend on some cells, by their cost or whether they are legal, in
/// increasing order, but for blocked cells; `None` for more than so many. Cells outside the map are left out.
pub(crate) fn ends_near(
    graph: &CostGraph,
    cells: impl Iterator<Item = (u32, u32)>,
    most: usize,
) -> Option<Vec<usize>> {
    let layout = graph.layout();
    let reach = graph.scanner().moves.all().iter().map(|of| of.vector.x).max().unwrap_or_default();
    // The corners of a cell lie at it and beyond.
    let beyond = reach + i32::from(!graph.is_center());
    let (width, height) = graph.size();
    let is_on = |x, y| x < graph.map().width() && y < graph.map().height();
    let mut states = Vec::new();
    for (x, y) in cells.filter(|&(x, y)| is_on(x, y)).map(|(x, y)| (x as i32, y as i32)) {
        // Cells near one another have ends in common.
        if states.len() / 2 > most {
            states.sort_unstable();
            states.dedup();
            if states.len() > most {
                return None;
            }
        }
        for y in (y - reach).max(0)..=(y + beyond).min(height as i32 - 1) {
            for x in (x - reach).max(0)..=(x + beyond).min(width as i32 - 1) {
                let at = layout.position(x, y);
                states.push(at);
                states.extend(graph.scanner().gaps.upper(at));
            }
        }
    }
    states.sort_unstable();
    states.dedup();
    states.retain(|&state| !graph.is_blocked(state));
    (states.len() <= most).then_some(states)
}
