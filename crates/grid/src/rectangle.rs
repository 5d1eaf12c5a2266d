//! Rectangles of cells: where a map changes.

/// A rectangle of cells. The part of it that lies beyond a map is ignored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Rectangle {
    /// Its first column.
    pub x: u32,
    /// Its first row.
    pub y: u32,
    /// The number of columns.
    pub width: u32,
    /// The number of rows.
    pub height: u32,
}
