//! Pictures of maps with paths, fields and searches, as PNG and SVG.

mod badge;
mod color;
mod contour;
mod encode;
mod error;
mod layout;
mod legend;
mod markup;
mod outline;
mod paint;
mod raster;
mod svg;
mod vertex_colors;

use std::{fmt, io, io::Write, path::Path as FilePath};

use mediant_grid::{Grid, PlacementKind, Point, Vertex};

pub use error::PictureError;

use layout::Layout;

use crate::save::NewFile;

/// A picture of a map, for maps of any size: written as PNG or as SVG.
///
/// From back to front it has the free cells, a field as colors, the vertices that a search touched, the
/// blocked cells, contour lines of the field, an agent's way, the paths, and the start and the goal. Small
/// maps get large cells with grid lines. Large ones get a pixel a cell; those that exceed the
/// [largest side](Self::largest_side) get one for several cells, in their mean color.
///
/// Paths have the colors of Okabe and Ito in the order in which they are added: blue, vermilion, green,
/// purple, and so on. The first is the widest and each is drawn over those before it, so that paths that
/// share a segment all stay visible. The colors of a field grow darker with the value, so that they can be
/// told apart without seeing hues.
///
/// The same picture gives the same pixels on every platform.
///
/// ```
/// use mediant_formats::Picture;
/// use mediant_grid::{AsciiMap, PlacementKind};
/// let map = AsciiMap::parse("
///     .#.
///     ...
/// ")?;
/// let picture = Picture::new(&map.grid, PlacementKind::Center)
///     .field(|at| Some(f64::from(at.x + at.y)))
///     .path("A*", [(0.0, 0.0), (0.0, 1.0), (2.0, 1.0), (2.0, 0.0)])
///     .start((0, 0))
///     .goal((2, 0));
/// assert!(picture.svg().starts_with("<svg"));
/// let mut png = Vec::new();
/// picture.write_png(&mut png)?;
/// assert_eq!(&png[1..4], b"PNG");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Needs the feature `picture`.
#[derive(Clone)]
pub struct Picture<'g> {
    grid: &'g Grid,
    placement: PlacementKind,
    /// The value of each vertex, row by row; NaN where there is none. Empty without a field.
    field: Vec<f32>,
    has_contours: bool,
    expanded: Vec<Vertex>,
    open: Vec<Vertex>,
    paths: Vec<Line>,
    starts: Vec<Point>,
    goals: Vec<Point>,
    radius: f64,
    caption: String,
    largest_side: u32,
}

/// A path of a picture: its points in cells of the map.
#[derive(Clone, Debug)]
struct Line {
    name: String,
    points: Vec<(f64, f64)>,
}

impl<'g> Picture<'g> {
    /// A map. The placement says where vertices are.
    #[must_use]
    pub fn new(grid: &'g Grid, placement: PlacementKind) -> Self {
        Self {
            grid,
            placement,
            field: Vec::new(),
            has_contours: true,
            expanded: Vec::new(),
            open: Vec::new(),
            paths: Vec::new(),
            starts: Vec::new(),
            goals: Vec::new(),
            radius: 0.0,
            caption: String::new(),
            largest_side: 4096,
        }
    }

    /// The same picture with a field: a value for each vertex, such as its distance from the start. `None`
    /// and values that are not finite leave the vertex without color. Contour lines join equal values. Takes
    /// four bytes a vertex.
    #[must_use]
    pub fn field(mut self, mut value: impl FnMut(Vertex) -> Option<f64>) -> Self {
        let (columns, rows) = self.vertices();
        let vertices = (0..rows as i32).flat_map(|y| (0..columns as i32).map(move |x| Vertex::new(x, y)));
        let values = vertices.map(|at| value(at).map_or(f32::NAN, |value| value as f32));
        self.field = values.map(|value| if value.is_finite() { value } else { f32::NAN }).collect();
        self
    }

    /// The same picture without contour lines: for values that are no distances, such as costs of cells,
    /// which change from cell to cell.
    #[must_use]
    pub const fn without_contours(mut self) -> Self {
        self.has_contours = false;
        self
    }

    /// The same picture with the vertices that a search expanded, in this order: the later, the darker.
    /// Vertices outside the map are left out.
    #[must_use]
    pub fn expanded(mut self, vertices: impl IntoIterator<Item = Vertex>) -> Self {
        self.expanded = vertices.into_iter().collect();
        self
    }

    /// The same picture with the vertices that a search reached and did not expand: its open list at the end.
    #[must_use]
    pub fn open(mut self, vertices: impl IntoIterator<Item = Vertex>) -> Self {
        self.open = vertices.into_iter().collect();
        self
    }

    /// The same picture with one more path, through these points, as vertices: between centers (0, 0) is the
    /// middle of the first cell, at corners its upper left corner. SVG shows its name in the legend, unless
    /// it is empty. A point that is not finite is left out; a point outside the map is moved to its border.
    #[must_use]
    pub fn path(mut self, name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let finite = points.into_iter().filter(|(x, y)| x.is_finite() && y.is_finite());
        let points = finite.map(|at| self.place(at)).collect();
        self.paths.push(Line { name: name.into(), points });
        self
    }

    /// The same picture with a badge S at this vertex.
    #[must_use]
    pub fn start(self, at: impl Into<Point>) -> Self {
        self.starts([at])
    }

    /// The same picture with a badge S at each of these vertices.
    #[must_use]
    pub fn starts<V: Into<Point>>(self, at: impl IntoIterator<Item = V>) -> Self {
        Self { starts: at.into_iter().map(Into::into).collect(), ..self }
    }

    /// The same picture with a badge G at this vertex, if it is not the start.
    #[must_use]
    pub fn goal(self, at: impl Into<Point>) -> Self {
        self.goals([at])
    }

    /// The same picture with a badge G at each of these vertices that is no start.
    #[must_use]
    pub fn goals<V: Into<Point>>(self, at: impl IntoIterator<Item = V>) -> Self {
        Self { goals: at.into_iter().map(Into::into).collect(), ..self }
    }

    /// The same picture with the way of an agent of this radius, in cells, along each path. A radius that is
    /// not finite or not above 0 shows none.
    #[must_use]
    pub fn radius(self, radius: f64) -> Self {
        Self { radius: if radius.is_finite() { radius.clamp(0.0, 1e5) } else { 0.0 }, ..self }
    }

    /// The same picture with a line of text below, in SVG alone.
    #[must_use]
    pub fn caption(self, text: impl Into<String>) -> Self {
        Self { caption: text.into(), ..self }
    }

    /// The same picture with the map's longer side at most this long, in pixels (4096 without; 64 to 16,384).
    /// Where the map has more cells, a pixel covers several of them.
    #[must_use]
    pub fn largest_side(self, pixels: u32) -> Self {
        Self { largest_side: pixels.clamp(64, 16_384), ..self }
    }

    /// Writes the picture as PNG.
    ///
    /// # Errors
    /// Errors of the writer.
    pub fn write_png(&self, out: impl Write) -> io::Result<()> {
        encode::png(&self.pixels(), out)
    }

    /// The picture as SVG. It adapts to dark pages.
    #[must_use]
    pub fn svg(&self) -> String {
        svg::document(self)
    }

    /// Writes the picture as SVG.
    ///
    /// # Errors
    /// Errors of the writer.
    pub fn write_svg(&self, mut out: impl Write) -> io::Result<()> {
        out.write_all(self.svg().as_bytes())
    }

    /// Writes the picture to a file, which it replaces as a whole: as PNG or SVG, after the end of the
    /// file's name.
    ///
    /// # Errors
    /// [`PictureError::Extension`] if the name ends otherwise, [`PictureError::Write`] if the file cannot be
    /// written.
    pub fn write_to(&self, path: impl AsRef<FilePath>) -> Result<(), PictureError> {
        let path = path.as_ref();
        let extension = path.extension().map(|end| end.to_string_lossy().to_ascii_lowercase());
        let is_png = match extension.as_deref() {
            Some("png") => true,
            Some("svg") => false,
            _ => return Err(PictureError::Extension { path: path.to_owned() }),
        };
        Ok(NewFile::write_with(
            path,
            |file| if is_png { self.write_png(file) } else { self.write_svg(file) },
        )?)
    }

    /// The number of columns and rows of vertices.
    fn vertices(&self) -> (u32, u32) {
        let extra = u32::from(self.placement == PlacementKind::Corner);
        (self.grid.width() + extra, self.grid.height() + extra)
    }

    /// From a vertex to its place on the map, in cells, at least on its border.
    fn place(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let shift = if self.placement == PlacementKind::Center { 0.5 } else { 0.0 };
        let (width, height) = (f64::from(self.grid.width()), f64::from(self.grid.height()));
        ((x + shift).clamp(0.0, width), (y + shift).clamp(0.0, height))
    }

    fn layout(&self) -> Layout {
        Layout::new(self.grid, self.largest_side)
    }

    /// The ends that are marked, with their letters.
    fn ends(&self) -> impl Iterator<Item = (badge::Letter, (f64, f64))> {
        let goals = self.goals.iter().filter(|goal| !self.starts.contains(goal));
        let goals = goals.map(|&at| (badge::Letter::G, at));
        let starts = self.starts.iter().map(|&at| (badge::Letter::S, at));
        let place = |at: Point| self.place((at.x(), at.y()));
        goals.chain(starts).map(move |(letter, at)| (letter, place(at)))
    }
}

impl fmt::Debug for Picture<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Picture")
            .field("map", &self.grid.id())
            .field("placement", &self.placement)
            .field("paths", &self.paths)
            .finish_non_exhaustive()
    }
}
