//! Drawings of the moves of N(k), and of what they reach.

use mediant_moves::{FiniteK, KError, Neighborhood, Vector, bound_at_corners, level};

use super::{
    canvas::{Anchor, Canvas, MARGIN, WIDTH},
    geometry::Point,
    text::LINE,
};

const GAP: f64 = 18.0;
/// Between a panel's border and what is drawn in it.
const INSET: f64 = 5.0;

/// The content of the panels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Content {
    Moves,
    Reach,
}

/// A drawing of neighborhoods side by side, a panel for each k.
///
/// ```
/// use mediant_moves::FiniteK;
/// use mediant_report::NeighborhoodDrawing;
/// let drawing = NeighborhoodDrawing::moves("Moves", [FiniteK::N4, FiniteK::N8])?;
/// assert!(drawing.svg().contains("N(3): 8 moves"));
/// # Ok::<(), mediant_moves::KError>(())
/// ```
#[derive(Clone, Debug)]
pub struct NeighborhoodDrawing {
    title: String,
    note: Option<String>,
    content: Content,
    panels: Vec<(Neighborhood, i32)>,
}

impl NeighborhoodDrawing {
    /// The moves of each N(k): in color those that are new at this k, each the sum of the two beside it.
    ///
    /// # Errors
    /// [`KError`] for a k whose moves have no 32-bit coordinates.
    pub fn moves(title: impl Into<String>, ks: impl IntoIterator<Item = FiniteK>) -> Result<Self, KError> {
        Self::new(title.into(), Content::Moves, ks)
    }

    /// The places that a path of one length reaches over each N(k) on an empty map, within the circle of
    /// those that a straight line of that length reaches.
    ///
    /// # Errors
    /// As for [`moves`](Self::moves).
    pub fn reach(title: impl Into<String>, ks: impl IntoIterator<Item = FiniteK>) -> Result<Self, KError> {
        Self::new(title.into(), Content::Reach, ks)
    }

    fn new(title: String, content: Content, ks: impl IntoIterator<Item = FiniteK>) -> Result<Self, KError> {
        let panels = ks.into_iter().map(|k| Ok((Neighborhood::new(k)?, k.radius()?)));
        Ok(Self { title, note: None, content, panels: panels.collect::<Result<_, KError>>()? })
    }

    /// The same drawing with a line under the title.
    #[must_use]
    pub fn note(self, note: impl Into<String>) -> Self {
        Self { note: Some(note.into()), ..self }
    }

    /// The drawing as a whole SVG file.
    #[must_use]
    pub fn svg(&self) -> String {
        let mut canvas = Canvas::default();
        let top = canvas.header(&self.title, self.note.as_deref(), WIDTH) + 4.0;
        let count = self.panels.len().max(1) as f64;
        let size = (WIDTH - 2.0 * MARGIN - GAP * (count - 1.0)) / count;
        for ((moves, radius), number) in self.panels.iter().zip(0..) {
            let center = (MARGIN + f64::from(number) * (size + GAP) + size / 2.0, top + size / 2.0);
            match self.content {
                Content::Moves => {
                    draw_moves(&mut canvas, moves, center, (size / 2.0 - INSET) / f64::from(*radius));
                }
                Content::Reach => draw_reach(&mut canvas, moves, center, size / 2.0 - INSET),
            }
            let caption = (center.0, top + size + LINE);
            canvas.text("strong", Anchor::Middle, caption, &self.caption(moves));
            canvas.text("muted small", Anchor::Middle, (caption.0, caption.1 + LINE), &self.beneath(moves));
        }
        canvas.finish(&self.title, &self.description(), WIDTH, top + size + 2.0 * LINE + MARGIN)
    }

    fn caption(&self, moves: &Neighborhood) -> String {
        match self.content {
            Content::Moves => format!("N({}): {} moves", moves.k().get(), moves.len()),
            Content::Reach => format!("k = {}", moves.k().get()),
        }
    }

    fn beneath(&self, moves: &Neighborhood) -> String {
        match self.content {
            Content::Moves => {
                let new = moves.iter().filter(|&step| is_new(moves, step)).count();
                format!("{new} of them new")
            }
            Content::Reach => {
                format!("at worst {:.2} % longer", 100.0 * (bound_at_corners(moves.k()) - 1.0))
            }
        }
    }

    fn description(&self) -> String {
        let panels = self.panels.iter().map(|(moves, _)| match self.content {
            Content::Moves => {
                let quadrant: Vec<String> =
                    moves.quadrant().iter().map(|step| format!("({}, {})", step.x, step.y)).collect();
                format!("{}; between two axes {}", self.caption(moves), quadrant.join(" "))
            }
            Content::Reach => {
                let (caption, corners) = (self.caption(moves), moves.len());
                format!("{caption}: a figure of {corners} corners on the circle, {}", self.beneath(moves))
            }
        });
        panels.collect::<Vec<_>>().join(". ")
    }
}

/// Whether N(k) has this move and N(k − 1) does not.
fn is_new(moves: &Neighborhood, step: Vector) -> bool {
    level(step) == Some(moves.k().get())
}

fn at(center: Point, scale: f64, step: Vector) -> Point {
    (center.0 + scale * f64::from(step.x), center.1 + scale * f64::from(step.y))
}

/// The moves from the center, in cells of so many pixels. New ones are drawn over the others.
fn draw_moves(canvas: &mut Canvas, moves: &Neighborhood, center: Point, scale: f64) {
    for is_drawn_new in [false, true] {
        let class = if is_drawn_new { "s1" } else { "r" };
        for step in moves.iter().filter(|&step| is_new(moves, step) == is_drawn_new) {
            let tip = at(center, scale, step);
            canvas.path(&format!("curve {class}"), &[center, tip], false, Some(1.25));
            canvas.circle(&format!("mark {class}"), tip, (scale / 6.0).min(3.0));
        }
    }
    canvas.circle("mark r", center, 3.0);
}

/// The circle of this radius in pixels, and in it the figure whose corners are the moves, drawn out or in to
/// the circle.
fn draw_reach(canvas: &mut Canvas, moves: &Neighborhood, center: Point, radius: f64) {
    canvas.circle("outline curve thin r d2", center, radius);
    let mut steps: Vec<Vector> = moves.iter().collect();
    let angle = |step: &Vector| f64::from(step.y).atan2(f64::from(step.x));
    steps.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    let corners: Vec<Point> = steps
        .into_iter()
        .map(|step| at(center, radius / f64::from(step.x).hypot(f64::from(step.y)), step))
        .collect();
    canvas.path("curve s0", &corners, true, None);
    for corner in corners.iter().filter(|_| corners.len() <= 32) {
        canvas.circle("mark s0", *corner, 2.5);
    }
}
