//! The A* that the published times fit: its open list is an unsorted list.

use std::{cmp::Reverse, collections::BinaryHeap, f64::consts::SQRT_2};

use mediant_grid::{Grid, Vertex};
use mediant_search::Ends;

/// The work of a plain A*, and its result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Work {
    /// The length of the path.
    pub(super) cost: f64,
    /// Nodes expanded, without the goal.
    pub(super) expanded: u64,
    /// The lengths of the open list, summed over the nodes that are taken from it: the entries that a program
    /// looks at if it searches an unsorted list for the least one.
    pub(super) looked: u64,
}

/// A textbook A*: eight directions, no corner cut, sums of floating-point lengths, the octile distance as
/// heuristic. Of nodes with equal f it takes the one that has been in the list longer; our engines take the
/// one nearer to the goal, and expand fewer.
///
/// `None` if there is no path. Both ends are free cells.
pub(super) fn plain_astar(grid: &Grid, query: Ends) -> Option<Work> {
    let width = grid.width() as usize;
    let id = |at: Vertex| at.y as usize * width + at.x as usize;
    let ahead = |at: Vertex| {
        let (dx, dy) = (f64::from((at.x - query.goal.x).abs()), f64::from((at.y - query.goal.y).abs()));
        dx.max(dy) + (SQRT_2 - 1.0) * dx.min(dy)
    };
    let mut lengths = vec![f64::INFINITY; width * grid.height() as usize];
    let mut closed = vec![false; lengths.len()];
    // Positive floating-point numbers are ordered as their bits are.
    let mut open =
        BinaryHeap::from([Reverse((ahead(query.start).to_bits(), 0_u64, query.start.x, query.start.y))]);
    lengths[id(query.start)] = 0.0;
    let (mut listed, mut entered, mut work) = (1, 0, Work { cost: 0.0, expanded: 0, looked: 0 });
    while let Some(Reverse((_, _, x, y))) = open.pop() {
        let at = Vertex::new(x, y);
        let length = lengths[id(at)];
        if std::mem::replace(&mut closed[id(at)], true) {
            continue;
        }
        work.looked += listed;
        listed -= 1;
        if at == query.goal {
            return Some(Work { cost: length, ..work });
        }
        work.expanded += 1;
        for (next, step) in neighbors(grid, at) {
            let (known, length) = (lengths[id(next)], length + step);
            if closed[id(next)] || length >= known - 1e-9 {
                continue;
            }
            listed += u64::from(known.is_infinite());
            lengths[id(next)] = length;
            entered += 1;
            open.push(Reverse(((length + ahead(next)).to_bits(), entered, next.x, next.y)));
        }
    }
    None
}

/// The free neighbors of a cell and the steps to them.
fn neighbors(grid: &Grid, at: Vertex) -> impl Iterator<Item = (Vertex, f64)> {
    let free = move |dx: i32, dy: i32| grid.is_free(at.x + dx, at.y + dy);
    let directions = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy)));
    directions.filter(|&direction| direction != (0, 0)).filter_map(move |(dx, dy)| {
        let legal = free(dx, dy) && free(dx, 0) && free(0, dy);
        legal.then(|| (Vertex::new(at.x + dx, at.y + dy), if dx != 0 && dy != 0 { SQRT_2 } else { 1.0 }))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_looked_through_for_each_node() {
        let grid = Grid::from_fn(3, 3, |_, _| false).unwrap();
        // The list holds 1 node, then the start's 3 neighbors, then 4: one was taken, two came.
        let work = plain_astar(&grid, Ends::new((0, 0), (2, 0))).unwrap();
        assert_eq!(work, Work { cost: 2.0, expanded: 2, looked: 8 });
    }

    #[test]
    fn no_corner_is_cut() {
        let grid = Grid::from_fn(3, 3, |x, y| (x, y) == (1, 1)).unwrap();
        assert_eq!(plain_astar(&grid, Ends::new((0, 0), (2, 2))).unwrap().cost, 4.0);
        let wall = Grid::from_fn(3, 3, |x, _| x == 1).unwrap();
        assert_eq!(plain_astar(&wall, Ends::new((0, 0), (2, 2))), None);
    }
}
