//! The colors of vertices: what a field and a search paint on them.

use mediant_grid::Vertex;

use super::{
    Picture,
    color::{self, Rgb},
};

/// A color for some vertices, row by row.
pub(super) struct VertexColors {
    pub(super) columns: u32,
    pub(super) rows: u32,
    colors: Vec<Option<Rgb>>,
}

impl VertexColors {
    /// `None` if nothing is painted.
    pub(super) fn of(picture: &Picture<'_>) -> Option<Self> {
        if picture.field.is_empty() && picture.expanded.is_empty() && picture.open.is_empty() {
            return None;
        }
        let (columns, rows) = picture.vertices();
        let mut painted = Self { columns, rows, colors: vec![None; columns as usize * rows as usize] };
        if let Some((least, greatest)) = range(&picture.field) {
            let width = (greatest - least).max(f32::MIN_POSITIVE);
            for (color_of_vertex, value) in painted.colors.iter_mut().zip(&picture.field) {
                if !value.is_nan() {
                    *color_of_vertex = Some(color::of_field((value - least) / width));
                }
            }
        }
        for &at in &picture.open {
            painted.paint(at, color::OPEN);
        }
        let last = picture.expanded.len().saturating_sub(1).max(1) as f32;
        for (&at, index) in picture.expanded.iter().zip(0_u32..) {
            painted.paint(at, color::of_expanded(index as f32 / last));
        }
        Some(painted)
    }

    /// A search over a field leaves some of the field's color.
    fn paint(&mut self, at: Vertex, ink: Rgb) {
        let Some(index) = self.index(at.x, at.y) else { return };
        if let Some(known) = self.colors.get_mut(index) {
            *known = Some(known.map_or(ink, |below| color::mixed(below, ink, 150)));
        }
    }

    fn index(&self, x: i32, y: i32) -> Option<usize> {
        let inside = (x as u32) < self.columns && (y as u32) < self.rows;
        inside.then(|| y as usize * self.columns as usize + x as usize)
    }

    /// The color of a vertex; none outside.
    #[inline]
    pub(super) fn get(&self, x: u32, y: u32) -> Option<Rgb> {
        self.index(x as i32, y as i32).and_then(|index| *self.colors.get(index)?)
    }

    /// The rows of colors.
    pub(super) fn rows(&self) -> impl Iterator<Item = &[Option<Rgb>]> {
        self.colors.chunks(self.columns as usize)
    }
}

/// The least and the greatest value of a field, if it has any.
pub(super) fn range(field: &[f32]) -> Option<(f32, f32)> {
    let mut values = field.iter().copied().filter(|value| !value.is_nan());
    let first = values.next()?;
    Some(values.fold((first, first), |(low, high), value| (low.min(value), high.max(value))))
}
