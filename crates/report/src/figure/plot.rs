//! Draws a chart: computes its layout, then draws axes, lines, markers, labels and legend, in this order.

use super::{
    axis::Axis,
    canvas::{Anchor, Canvas, MARGIN, WIDTH},
    chart::Chart,
    geometry::{Point, Rect},
    labels::{Label, Placer},
    legend::Legend,
    series::{Styled, styled},
    span::Span,
    text::{LINE, SMALL, TEXT, text_width, wrap},
    ticks::{Ticks, cut, thinned, widest_name, with_ends},
};

const HEIGHT: f64 = 390.0;
/// A legend with more entries is below the plot, not beside it.
const MOST_BESIDE: usize = 14;
const WIDEST_BESIDE: f64 = 210.0;
const TICK: f64 = 5.0;
/// The widest name of a tick: a wider one is cut.
const LONGEST_NAME: f64 = 180.0;

impl Chart {
    /// The chart as a whole SVG file.
    #[must_use]
    pub fn svg(&self) -> String {
        Plot::new(self, &styled(&self.series)).svg()
    }
}

/// A point of a series in the figure.
#[derive(Clone, Copy, Debug)]
struct Placed {
    at: Point,
    clamped: bool,
}

/// A chart with its layout.
struct Plot<'a> {
    chart: &'a Chart,
    series: &'a [Styled<'a>],
    canvas: Canvas,
    legend: Legend,
    beside: bool,
    x: Span,
    y: Span,
    x_ticks: Ticks,
    y_ticks: Ticks,
    turned: bool,
    x_label: Vec<String>,
    y_label: Vec<String>,
    frame: Rect,
}

impl<'a> Plot<'a> {
    fn new(chart: &'a Chart, series: &'a [Styled<'a>]) -> Self {
        let mut canvas = Canvas::default();
        let top = canvas.header(&chart.title, chart.note.as_deref(), WIDTH) + 4.0;
        let beside = series.len() <= MOST_BESIDE;
        let widest = if beside { WIDEST_BESIDE } else { WIDTH - 2.0 * MARGIN };
        let legend = Legend::new(series.iter().map(Styled::entry), widest);
        let points = || series.iter().flat_map(|styled| &styled.series.points);
        let finite = || points().filter(|(x, y)| x.is_finite() && y.is_finite());
        let x = Span::new(&chart.x, finite().map(|(x, _)| *x), false);
        let y = Span::new(&chart.y, finite().map(|(_, y)| *y), true);
        let height = if beside { HEIGHT.max(legend.height(1)) } else { HEIGHT };
        let right = if beside && legend.width > 0.0 { legend.width + 20.0 } else { 8.0 } + MARGIN;
        let mut plot = Self {
            chart,
            series,
            canvas,
            legend,
            beside,
            x,
            y,
            x_ticks: Vec::new(),
            y_ticks: Vec::new(),
            turned: false,
            x_label: Vec::new(),
            y_label: wrap(&chart.y.label, TEXT, height),
            frame: Rect::new(0.0, top, 0.0, height),
        };
        let y_ticks = y.ticks(&chart.y, height, Some(14.0));
        plot.y_ticks = thinned(with_ends(y_ticks, &y, plot.clamps(true), height), height, |_| 14.0);
        let left = MARGIN
            + LINE * plot.y_label.len() as f64
            + 9.0
            + TICK
            + 3.0
            + widest_name(&plot.y_ticks).min(LONGEST_NAME);
        plot.frame.x = left;
        plot.frame.width = (WIDTH - left - right).max(100.0);
        plot.x_label = wrap(&chart.x.label, TEXT, plot.frame.width);
        plot.lay_x_ticks(&chart.x);
        plot
    }

    /// Places the ticks of the x axis. Given names that do not fit side by side are turned upright.
    fn lay_x_ticks(&mut self, axis: &Axis) {
        let width = self.frame.width;
        let ticks = with_ends(self.x.ticks(axis, width, None), &self.x, self.clamps(false), width);
        let along = |name: &str| text_width(name, TEXT) + 8.0;
        let flat = thinned(ticks.clone(), width, along);
        let hidden = |ticks: &Ticks| ticks.iter().filter(|(_, name)| name.is_empty()).count();
        let named = !axis.has_round_ticks();
        self.turned = named && hidden(&flat) > hidden(&ticks) && ticks.len() > 3;
        self.x_ticks = if self.turned { thinned(ticks, width, |_| 13.0) } else { flat };
    }

    /// Whether markers are clamped to the low and to the high end.
    fn clamps(&self, vertical: bool) -> [bool; 2] {
        let span = if vertical { &self.y } else { &self.x };
        let points = self.series.iter().filter(|styled| !styled.is_reference());
        let points = points.flat_map(|styled| &styled.series.points);
        let finite = points.filter(|(x, y)| x.is_finite() && y.is_finite());
        let fractions = finite.map(|&(x, y)| span.fraction(if vertical { y } else { x }));
        fractions.fold([false; 2], |[low, high], at| [low || is_below(at), high || is_above(at)])
    }

    fn svg(mut self) -> String {
        self.axes();
        self.axis_labels();
        let placed: Vec<Vec<Option<Placed>>> = self.series.iter().map(|styled| self.placed(styled)).collect();
        for (styled, points) in self.series.iter().zip(&placed) {
            self.line(styled, points);
        }
        for (styled, points) in self.series.iter().zip(&placed) {
            for point in points.iter().flatten().filter(|_| !styled.is_reference()) {
                let class = styled.marker(point.clamped);
                styled.style().marker().draw(&mut self.canvas, &class, point.at, radius(points.len()));
            }
        }
        self.labels(&placed);
        let below = self.below();
        let height = if self.beside {
            self.legend.draw(&mut self.canvas, (self.frame.right() + 20.0, self.frame.y), 1);
            below
        } else {
            let columns = self.legend.columns(WIDTH - 2.0 * MARGIN);
            self.legend.draw(&mut self.canvas, (MARGIN, below + 6.0), columns);
            below + 6.0 + self.legend.height(columns)
        };
        self.canvas.finish(&self.chart.title, &self.chart.description(), WIDTH, height + MARGIN / 2.0)
    }

    /// The y coordinate below the label of the x axis.
    fn below(&self) -> f64 {
        let names = if self.turned { widest_name(&self.x_ticks).min(LONGEST_NAME) } else { TEXT };
        self.frame.bottom() + TICK + 4.0 + names + 8.0 + LINE * self.x_label.len() as f64
    }

    fn axes(&mut self) {
        let Rect { x, y, width, .. } = self.frame;
        let (right, bottom) = (self.frame.right(), self.frame.bottom());
        for (fraction, _) in &self.x_ticks {
            let at = x + fraction * width;
            self.canvas.line("grid", (at, y), (at, bottom));
        }
        for (fraction, _) in &self.y_ticks {
            let at = bottom - fraction * self.frame.height;
            self.canvas.line("grid", (x, at), (right, at));
        }
        self.canvas.line("axis", (x, y), (x, bottom));
        self.canvas.line("axis", (x, bottom), (right, bottom));
        for (fraction, name) in &self.x_ticks {
            let at = x + fraction * width;
            self.canvas.line("axis", (at, bottom), (at, bottom + TICK));
            if self.turned {
                let place = (at + 4.0, bottom + TICK + 4.0);
                self.canvas.turned_text("muted", Anchor::End, place, -90.0, &cut(name, LONGEST_NAME));
            } else if !name.is_empty() {
                self.canvas.text("muted", Anchor::Middle, (at, bottom + TICK + 4.0 + 10.0), name);
            }
        }
        for (fraction, name) in &self.y_ticks {
            let at = bottom - fraction * self.frame.height;
            self.canvas.line("axis", (x - TICK, at), (x, at));
            if !name.is_empty() {
                self.canvas.text("muted", Anchor::End, (x - TICK - 3.0, at + 4.0), &cut(name, LONGEST_NAME));
            }
        }
    }

    fn axis_labels(&mut self) {
        let (middle, center) = self.frame.center();
        let first = self.below() - LINE * self.x_label.len() as f64 + LINE - 4.0;
        for (line, i) in self.x_label.iter().zip(0_u32..) {
            self.canvas.text("", Anchor::Middle, (middle, first + LINE * f64::from(i)), line);
        }
        for (line, i) in self.y_label.iter().zip(0_u32..) {
            let base = (MARGIN + TEXT + LINE * f64::from(i), center);
            self.canvas.turned_text("", Anchor::Middle, base, -90.0, line);
        }
    }

    fn at(&self, (x, y): Point) -> Point {
        (self.frame.x + x * self.frame.width, self.frame.bottom() - y * self.frame.height)
    }

    /// The places of a series' points; `None` for those that are not finite.
    fn placed(&self, styled: &Styled<'_>) -> Vec<Option<Placed>> {
        let place = |&(x, y): &(f64, f64)| {
            let (x, y) = Some((x, y)).filter(|(x, y)| x.is_finite() && y.is_finite())?;
            let (x, y) = (self.x.fraction(x), self.y.fraction(y));
            let clamped = [x, y].into_iter().any(|at| is_below(at) || is_above(at));
            if styled.is_reference() {
                // A reference is not clamped, but cut later, so that it keeps its slope. A number without a
                // logarithm is at the low end.
                let at = [x, y].map(|at| if at == f64::NEG_INFINITY { 0.0 } else { at });
                return Some(Placed { at: self.at((at[0], at[1])), clamped });
            }
            Some(Placed { at: self.at((x.clamp(0.0, 1.0), y.clamp(0.0, 1.0))), clamped })
        };
        styled.series.points.iter().map(place).collect()
    }

    fn line(&mut self, styled: &Styled<'_>, points: &[Option<Placed>]) {
        let Some(class) = styled.line() else { return };
        for run in runs(points) {
            if !styled.is_reference() && run.len() > 1 {
                self.canvas.path(&class, &run, false, None);
                continue;
            }
            for piece in cut_to(self.frame, &run) {
                self.canvas.path(&class, &piece, false, None);
            }
        }
    }

    fn labels(&mut self, placed: &[Vec<Option<Placed>>]) {
        if self.series.iter().all(|styled| styled.series.labels.is_empty()) {
            return;
        }
        let mut placer = Placer::new(self.frame);
        let mut labels = Vec::new();
        for (styled, points) in self.series.iter().zip(placed) {
            let radius = radius(points.len());
            for point in points.iter().flatten().filter(|_| !styled.is_reference()) {
                placer.avoid_marker(point.at, radius);
            }
            if styled.line().is_some() {
                for run in runs(points) {
                    cut_to(self.frame, &run).iter().for_each(|piece| placer.avoid_line(piece));
                }
            }
            let texts = points.iter().zip(&styled.series.labels).filter(|(_, text)| !text.is_empty());
            // The end of a reference that is cut off is not in the plot.
            let seen = texts.filter_map(|(point, text)| Some((point.as_ref()?, text)));
            let seen = seen.filter(|(point, _)| !(styled.is_reference() && point.clamped));
            labels.extend(seen.map(|(point, text)| Label { at: point.at, radius, text }));
        }
        for (label, place) in labels.iter().zip(placer.place(&labels)) {
            if place.far {
                self.canvas.line("leader", label.at, place.rect.nearest(label.at));
            }
            let (x, y) = place.rect.center();
            self.canvas.text("small halo", Anchor::Middle, (x, y + 0.35 * SMALL), label.text);
        }
    }
}

/// The lines through the points, which break where a point is missing.
fn runs(points: &[Option<Placed>]) -> impl Iterator<Item = Vec<Point>> {
    points.split(Option::is_none).map(|run| run.iter().flatten().map(|point| point.at).collect())
}

/// The radius of the markers of a series: the more points, the smaller.
fn radius(points: usize) -> f64 {
    match points {
        0..=40 => 4.0,
        41..=150 => 3.2,
        _ => 2.4,
    }
}

fn is_below(fraction: f64) -> bool {
    fraction < -1e-9
}

fn is_above(fraction: f64) -> bool {
    fraction > 1.0 + 1e-9
}

/// The pieces of a line inside a rectangle.
fn cut_to(frame: Rect, points: &[Point]) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    for ends in points.windows(2) {
        let Some([from, to]) = frame.clip([ends[0], ends[1]]) else { continue };
        match pieces.last_mut() {
            Some(piece) if piece.last() == Some(&from) => piece.push(to),
            _ => pieces.push(vec![from, to]),
        }
    }
    pieces
}
