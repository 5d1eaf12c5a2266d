//! The checkpoints between the two phases of CHPA*.

use std::num::NonZeroU32;

use mediant_grid::{Centers, GridGraph, Vertex};

use super::segments::SegmentGraph;

impl SegmentGraph {
    /// Appends the checkpoints of a path over segments: for each `step`-th segment the cell at which the path
    /// enters it. There is none in the goal's segment: the goal itself stands for it.
    pub(crate) fn append_checkpoints(
        &self,
        grid_graph: &GridGraph<Centers>,
        segments: &[u32],
        goal: Vertex,
        step: NonZeroU32,
        checkpoints: &mut Vec<Vertex>,
    ) {
        let step = step.get() as usize;
        let edges = segments.windows(2).skip(step - 1).step_by(step);
        let edges = edges.filter(|edge| edge[1] != self.segment_at(goal));
        checkpoints.extend(edges.filter_map(|edge| self.checkpoint(grid_graph, edge[0], edge[1])));
    }

    /// The cell at which a path enters the segment `target` from its neighbor `origin`: of the free cells
    /// along the wall between the two, the one nearest to the middle; of two equally near, the left or upper
    /// one. `None` if no cell is free.
    fn checkpoint(&self, grid_graph: &GridGraph<Centers>, origin: u32, target: u32) -> Option<Vertex> {
        let at = self.position(target);
        let d = self.position(origin).to(at);
        let side = self.side as i32;
        // The coordinate along one axis, of the cells at the wall, or of the cell that is `along` cells from
        // its beginning.
        let coordinate = |first: i32, d: i32, along: i32, cells: u32| {
            let at = match d {
                1 => first,
                -1 => first + side - 1,
                _ => first + along,
            };
            // Beyond the map, the nearest cell on it.
            at.min(cells as i32 - 1)
        };
        from_the_middle(side)
            .map(|along| {
                let x = coordinate(at.x * side, d.x, along, self.size.0);
                Vertex::new(x, coordinate(at.y * side, d.y, along, self.size.1))
            })
            .find(|&cell| grid_graph.is_free(cell))
    }
}

/// The numbers below `length`: the middle one first, then outward from it, the lower one of two first.
fn from_the_middle(length: i32) -> impl Iterator<Item = i32> {
    (0..length).map(move |i| length / 2 + if i % 2 == 1 { -(i + 1) / 2 } else { i / 2 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_cell_of_a_wall_is_tried_once_the_middle_one_first() {
        assert_eq!(from_the_middle(1).collect::<Vec<_>>(), [0]);
        assert_eq!(from_the_middle(3).collect::<Vec<_>>(), [1, 0, 2]);
        assert_eq!(from_the_middle(4).collect::<Vec<_>>(), [2, 1, 3, 0]);
        for length in 1..=63 {
            let mut order: Vec<i32> = from_the_middle(length).collect();
            order.sort_unstable();
            assert_eq!(order, (0..length).collect::<Vec<_>>());
        }
    }
}
