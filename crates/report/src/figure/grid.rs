//! Drawings of small maps with paths.

use std::{collections::BTreeMap, fmt::Write};

use mediant_grid::Grid;

use super::{
    canvas::{Canvas, MARGIN, WIDTH},
    geometry::{Point, Rect},
    legend::{Legend, Sample, badge},
    style::Style,
    turn,
};

const TALLEST: f64 = 560.0;
const LARGEST_CELL: f64 = 40.0;
/// With smaller cells, neither the cells are outlined nor the points of the paths marked.
const OUTLINED: f64 = 8.0;

/// A drawing of a map with paths. Blocked cells are filled, free ones outlined. S and G mark where paths
/// begin and end.
///
/// Paths that share a segment all stay visible: the first is the widest, and each is drawn over those before
/// it.
///
/// ```
/// use mediant_grid::AsciiMap;
/// use mediant_report::GridDrawing;
/// let map = AsciiMap::parse("
///     .#.
///     ...
/// ")?;
/// let drawing = GridDrawing::new("A bend", &map.grid).path("A*", [(0.5, 0.5), (0.5, 1.5), (2.5, 1.5)]);
/// assert!(drawing.svg().contains("A bend"));
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Debug)]
pub struct GridDrawing {
    title: String,
    note: Option<String>,
    width: f64,
    height: f64,
    blocked: String,
    paths: Vec<(String, Vec<Point>)>,
    is_in_turn: bool,
}

impl GridDrawing {
    /// A map without paths.
    pub fn new(title: impl Into<String>, grid: &Grid) -> Self {
        let (width, height) = (f64::from(grid.width()), f64::from(grid.height()));
        let (title, blocked) = (title.into(), rectangles(grid));
        Self { title, note: None, width, height, blocked, paths: Vec::new(), is_in_turn: false }
    }

    /// The same drawing with a line under the title.
    #[must_use]
    pub fn note(self, note: impl Into<String>) -> Self {
        Self { note: Some(note.into()), ..self }
    }

    /// The same drawing with a path through these points, in cells: (0, 0) is the upper left corner of the
    /// map, (0.5, 0.5) the center of its first cell. A point that is not finite is left out; a point outside
    /// the map is moved to its border.
    #[must_use]
    pub fn path(mut self, name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let finite = points.into_iter().filter(|(x, y)| x.is_finite() && y.is_finite());
        let inside = finite.map(|(x, y)| (x.clamp(0.0, self.width), y.clamp(0.0, self.height)));
        let path = (name.into(), inside.collect());
        self.paths.push(path);
        self
    }

    /// The same drawing, in which the paths come forward one after another, and then all of them, over and
    /// over. Where nothing may move, it is the drawing that it was.
    #[must_use]
    pub fn in_turn(self) -> Self {
        Self { is_in_turn: true, ..self }
    }

    /// The drawing as a whole SVG file.
    #[must_use]
    pub fn svg(&self) -> String {
        let cell = self.cell();
        let size = (cell * self.width, cell * self.height);
        let page = WIDTH.max(size.0 + 2.0 * MARGIN);
        let mut canvas = Canvas::default();
        let top = canvas.header(&self.title, self.note.as_deref(), page);
        let frame = Rect::new(MARGIN, top, size.0, size.1);
        self.cells(&mut canvas, frame, cell);
        let room = page - 2.0 * MARGIN;
        let legend = Legend::new(self.entries(), room);
        for (i, (_, points)) in self.paths.iter().enumerate() {
            let points: Vec<Point> =
                points.iter().map(|(x, y)| (frame.x + cell * x, top + cell * y)).collect();
            if self.is_in_turn {
                canvas.begin_group(&turn::class(i));
            }
            self.path_on(&mut canvas, i, &points, cell);
            if self.is_in_turn {
                canvas.end_group();
            }
        }
        if self.is_in_turn {
            turn::rules(&mut canvas, self.paths.len());
        }
        for (letter, (x, y)) in self.ends() {
            badge(&mut canvas, (frame.x + cell * x, top + cell * y), letter);
        }
        let beside = frame.width + 24.0 + legend.width <= room;
        let height = if beside {
            legend.draw(&mut canvas, (frame.right() + 24.0, top), 1);
            size.1.max(legend.height(1))
        } else {
            let columns = legend.columns(room);
            legend.draw(&mut canvas, (MARGIN, frame.bottom() + 12.0), columns);
            size.1 + 12.0 + legend.height(columns)
        };
        canvas.finish(&self.title, &self.description(), page, top + height + MARGIN)
    }

    /// The side of a cell in pixels: a whole number if it is at least 1, so that lines are sharp.
    fn cell(&self) -> f64 {
        let most = ((WIDTH - 2.0 * MARGIN) / self.width).min(TALLEST / self.height).min(LARGEST_CELL);
        if most >= 1.0 { most.floor() } else { ((most * 100.0).floor() / 100.0).max(0.01) }
    }

    fn cells(&self, canvas: &mut Canvas, frame: Rect, cell: f64) {
        if cell >= OUTLINED {
            for i in 1..self.width as u32 {
                let x = frame.x + cell * f64::from(i);
                canvas.line("grid", (x, frame.y), (x, frame.bottom()));
            }
            for i in 1..self.height as u32 {
                let y = frame.y + cell * f64::from(i);
                canvas.line("grid", (frame.x, y), (frame.right(), y));
            }
        }
        if !self.blocked.is_empty() {
            canvas.scaled_path("wall", &self.blocked, (frame.x, frame.y), cell);
        }
        let corners = [
            (frame.x, frame.y),
            (frame.right(), frame.y),
            (frame.right(), frame.bottom()),
            (frame.x, frame.bottom()),
        ];
        canvas.path("axis outline", &corners, true, None);
    }

    fn line_width(&self, index: usize) -> f64 {
        (2.0 + 1.75 * (self.paths.len() - 1 - index) as f64).min(6.0)
    }

    /// The radius of the markers, which are wider than their line.
    fn marker(&self, index: usize, cell: f64) -> f64 {
        (cell / 6.0).clamp(2.5, 4.0).max(0.7 * self.line_width(index) + 1.0)
    }

    fn path_on(&self, canvas: &mut Canvas, index: usize, points: &[Point], cell: f64) {
        let style = Style(index);
        let width = self.line_width(index);
        if points.len() > 1 {
            canvas.path(&style.solid_line(), points, false, Some(width));
        }
        if cell >= OUTLINED {
            for &at in points {
                style.marker().draw(canvas, &style.mark(false), at, self.marker(index, cell));
            }
        }
    }

    /// The ends of the paths, each place once. A place that is both start and goal is marked as a start.
    fn ends(&self) -> Vec<(&'static str, Point)> {
        let starts = self.paths.iter().filter_map(|(_, points)| Some(("S", *points.first()?)));
        let goals = self.paths.iter().filter_map(|(_, points)| Some(("G", *points.last()?)));
        let mut ends: Vec<(&str, Point)> = Vec::new();
        for end in starts.chain(goals) {
            if !ends.iter().any(|(_, at)| *at == end.1) {
                ends.push(end);
            }
        }
        ends
    }

    fn entries(&self) -> impl Iterator<Item = (String, Sample)> {
        let paths = self.paths.iter().enumerate().map(|(i, (name, _))| {
            let marker = (self.cell() >= OUTLINED).then(|| (Style(i).marker(), Style(i).mark(false)));
            let (line, width) = (Some(Style(i).solid_line()), Some(self.line_width(i)));
            (name.clone(), Sample::Curve { line, width, marker })
        });
        let ends = [("S", "start"), ("G", "goal")].into_iter();
        let ends = ends.filter(|(letter, _)| self.ends().iter().any(|(end, _)| end == letter));
        paths.chain(ends.map(|(letter, name)| (name.to_owned(), Sample::Badge(letter))))
    }

    fn description(&self) -> String {
        let names: Vec<&str> = self.paths.iter().map(|(name, _)| &**name).collect();
        let note = self.note.as_deref().map_or(String::new(), |note| format!(" {note}"));
        format!("Map of {} × {} cells. Paths: {}.{note}", self.width, self.height, names.join("; "))
    }
}

/// The blocked cells as an SVG path of rectangles, in cells. Equal runs of cells in consecutive rows make one
/// rectangle.
fn rectangles(grid: &Grid) -> String {
    let mut d = String::new();
    let mut open: BTreeMap<(i32, i32), i32> = BTreeMap::new();
    let (width, height) = (grid.width() as i32, grid.height() as i32);
    for y in 0..=height {
        let runs = if y < height { runs(grid, y, width) } else { Vec::new() };
        let (kept, closed): (BTreeMap<_, _>, BTreeMap<_, _>) =
            open.into_iter().partition(|(run, _)| runs.contains(run));
        for ((from, to), top) in closed {
            let _ = write!(d, "M{from},{top}H{to}V{y}H{from}Z");
        }
        open = kept;
        for run in runs {
            open.entry(run).or_insert(y);
        }
    }
    d
}

/// The runs of blocked cells in a row, as half-open intervals from left to right.
fn runs(grid: &Grid, y: i32, width: i32) -> Vec<(i32, i32)> {
    let mut runs = Vec::new();
    let mut x = 0;
    while x < width {
        let from = x;
        while x < width && grid.is_blocked(x, y) {
            x += 1;
        }
        if x > from {
            runs.push((from, x));
        }
        x += 1;
    }
    runs
}
