//! Maps with a weight for each cell.

use std::fmt;

use mediant_grid::{Grid, PlacementKind, Vertex};

use super::{Integral, Shares};

/// A map whose free cells have a weight each: their cost a unit of length. Its text form, after a line with
/// the size of cells, is that of [`parse`](Self::parse).
#[derive(Clone, Debug, PartialEq)]
pub struct WeightedMap {
    grid: Grid,
    weights: Vec<u32>,
    cell_size: (f64, f64),
}

impl WeightedMap {
    /// A map with the weight `weight(x, y)` for cell (x, y), and cells of size (1, 1). Blocked cells have a
    /// weight too, which says nothing.
    ///
    /// # Panics
    /// If a weight is 0.
    #[must_use]
    pub fn from_fn(grid: Grid, mut weight: impl FnMut(u32, u32) -> u32) -> Self {
        let cells = (0..grid.height()).flat_map(|y| (0..grid.width()).map(move |x| (x, y)));
        let weights: Vec<u32> = cells.map(|(x, y)| weight(x, y)).collect();
        assert!(weights.iter().all(|&weight| weight > 0), "a weight is 0");
        Self { grid, weights, cell_size: (1.0, 1.0) }
    }

    /// A map from a drawing: a line for each row, in which weights, or `#` for blocked cells, stand between
    /// spaces. Cells have size (1, 1).
    ///
    /// # Panics
    /// If the drawing is none.
    #[must_use]
    pub fn parse(drawing: &str) -> Self {
        let lines = drawing.lines().filter(|line| !line.trim().is_empty());
        let rows: Vec<Vec<&str>> = lines.map(|line| line.split_whitespace().collect()).collect();
        let width = rows.first().map_or(0, Vec::len);
        assert!(rows.iter().all(|row| row.len() == width), "rows differ in length:\n{drawing}");
        let cell = |x: u32, y: u32| rows[y as usize][x as usize];
        let grid = Grid::from_fn(width as u32, rows.len() as u32, |x, y| cell(x, y) == "#");
        let weight = |text: &str| text.parse().unwrap_or_else(|_| panic!("{text} is no weight:\n{drawing}"));
        Self::from_fn(grid.expect("a valid size"), |x, y| match cell(x, y) {
            "#" => 1,
            text => weight(text),
        })
    }

    /// The same map with cells of another size in x and y.
    #[must_use]
    pub fn with_cell_size(self, x: f64, y: f64) -> Self {
        Self { cell_size: (x, y), ..self }
    }

    /// The same map with other weights, `change(w)` instead of w.
    ///
    /// # Panics
    /// If a weight is 0.
    #[must_use]
    pub fn map_weights(&self, change: impl Fn(u32) -> u32) -> Self {
        let weight = |x, y| change(self.weights[y as usize * self.grid.width() as usize + x as usize]);
        Self { cell_size: self.cell_size, ..Self::from_fn(self.grid.clone(), weight) }
    }

    /// Which cells are blocked.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The weights, row by row. Blocked cells have one too, which says nothing.
    #[must_use]
    pub fn weights(&self) -> &[u32] {
        &self.weights
    }

    /// The weight of a free cell; `None` for a blocked one and outside the map.
    #[must_use]
    pub fn weight(&self, x: i32, y: i32) -> Option<u32> {
        let at = || y as usize * self.grid.width() as usize + x as usize;
        self.grid.is_free(x, y).then(|| self.weights[at()])
    }

    /// The size of a cell in x and in y.
    #[must_use]
    pub fn cell_size(&self) -> (f64, f64) {
        self.cell_size
    }

    /// The integral along the straight segment between any two vertices; `None` if the segment has a piece
    /// in or along blocked cells alone. Whether it is legal is a question for
    /// [`segment_is_legal`](crate::segment_is_legal).
    #[must_use]
    pub fn integral(&self, placement: PlacementKind, a: Vertex, b: Vertex) -> Option<Integral> {
        Shares::new(placement, a.to(b)).integral(self, a)
    }
}

impl fmt::Display for WeightedMap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (width, height) = (self.grid.width() as i32, self.grid.height() as i32);
        writeln!(f, "cells of {} by {}, with weights", self.cell_size.0, self.cell_size.1)?;
        for y in 0..height {
            let weight = |x| self.weight(x, y).map_or_else(|| "#".to_owned(), |weight| weight.to_string());
            writeln!(f, "{}", (0..width).map(weight).collect::<Vec<_>>().join(" "))?;
        }
        Ok(())
    }
}
