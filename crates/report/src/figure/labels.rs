//! Places texts beside points.

use super::{
    geometry::{Point, Rect},
    text::{SMALL, text_width},
};

const HEIGHT: f64 = 11.0;
/// The distances from the marker that are tried. From all but the first, a thin line leads to the point.
const DISTANCES: [f64; 4] = [3.0, 12.0, 22.0, 34.0];
/// The directions that are tried: right, left, above, below, and the diagonals, as a reader looks for a
/// label.
const SIDES: [Point; 8] =
    [(1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0), (0.8, -0.8), (0.8, 0.8), (-0.8, -0.8), (-0.8, 0.8)];
/// How often each label is placed; from the second time on, all others have places.
const ROUNDS: usize = 3;

// The costs of a place. A hidden marker is worse than a crossed line, which can still be followed.
const ON_MARKER: f64 = 20.0;
const ON_LABEL: f64 = 8.0;
const ON_LINE: f64 = 1.0;
const OUTSIDE: f64 = 1000.0;
const LEADER_ON_BOX: f64 = 10.0;
const FAR: f64 = 4.0;

/// A text that is to be placed beside a marker.
#[derive(Clone, Debug)]
pub(super) struct Label<'a> {
    pub(super) at: Point,
    pub(super) radius: f64,
    pub(super) text: &'a str,
}

/// The place of a text, and whether it is so far that a line has to lead to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) rect: Rect,
    pub(super) far: bool,
}

/// Gives each label the cheapest of a few places, in the order of the labels, then again with all others in
/// place.
///
/// To place as many labels as possible without overlaps is NP-hard; this heuristic is enough for the few
/// labels of a figure.
#[derive(Clone, Debug)]
pub(super) struct Placer {
    inside: Rect,
    boxes: Vec<(Rect, f64)>,
    lines: Vec<[Point; 2]>,
}

impl Placer {
    pub(super) const fn new(inside: Rect) -> Self {
        Self { inside, boxes: Vec::new(), lines: Vec::new() }
    }

    /// Labels should not cover this marker.
    pub(super) fn avoid_marker(&mut self, at: Point, radius: f64) {
        self.boxes.push((Rect::around(at, radius + 1.0), ON_MARKER));
    }

    /// Labels should not cover this line.
    pub(super) fn avoid_line(&mut self, points: &[Point]) {
        self.lines.extend(points.windows(2).map(|ends| [ends[0], ends[1]]));
    }

    pub(super) fn place(&self, labels: &[Label<'_>]) -> Vec<Place> {
        let mut places: Vec<Option<Place>> = vec![None; labels.len()];
        // A little wider than the text, since fonts differ.
        let widths: Vec<f64> = labels.iter().map(|label| text_width(label.text, SMALL) + 3.0).collect();
        let reach =
            |(label, width): (&Label<'_>, &f64)| Rect::around(label.at, DISTANCES[3] + label.radius + width);
        let areas: Vec<Rect> = labels.iter().zip(&widths).map(reach).collect();
        let nearby: Vec<Self> = areas.iter().map(|&area| self.within(area)).collect();
        for _ in 0..ROUNDS {
            for (i, label) in labels.iter().enumerate() {
                let others = places.iter().enumerate().filter(|(j, _)| *j != i);
                let others = others.filter_map(|(_, place)| Some((place.as_ref()?.rect, ON_LABEL)));
                let others = others.filter(|(rect, _)| rect.overlap(areas[i]) > 0.0);
                let mut near = nearby[i].clone();
                near.boxes.extend(others);
                places[i] = Some(near.best(label, widths[i]));
            }
        }
        places.into_iter().flatten().collect()
    }

    fn best(&self, label: &Label<'_>, width: f64) -> Place {
        let mut best = (f64::INFINITY, Place { rect: Rect::around(label.at, HEIGHT), far: false });
        let tried = DISTANCES.iter().enumerate().flat_map(|(ring, d)| SIDES.map(|side| (ring, d, side)));
        for (ring, distance, side) in tried {
            let rect = beside(label.at, label.radius + distance, side, width);
            let mut cost = self.cost(rect) + FAR * ring as f64;
            if ring > 0 && cost < best.0 {
                cost += self.leader_cost(label, rect);
            }
            // Cheaper by more than rounding errors: of equal places, the first one wins.
            if cost < best.0 - 1e-6 {
                best = (cost, Place { rect, far: ring > 0 });
            }
        }
        best.1
    }

    /// The same placer with only the boxes and lines in that area.
    fn within(&self, area: Rect) -> Self {
        let boxes = self.boxes.iter().filter(|(rect, _)| rect.overlap(area) > 0.0).copied().collect();
        let lines = self.lines.iter().filter(|line| area.clip(**line).is_some()).copied().collect();
        Self { inside: self.inside, boxes, lines }
    }

    fn cost(&self, rect: Rect) -> f64 {
        let outside = rect.width * rect.height - rect.overlap(self.inside);
        let boxes = self.boxes.iter().map(|(taken, weight)| weight * rect.overlap(*taken));
        let lines = self.lines.iter().map(|line| ON_LINE * length_in(rect, *line));
        boxes.sum::<f64>() + lines.sum::<f64>() + OUTSIDE * outside
    }

    /// The cost of what the line from the marker to a far text crosses.
    fn leader_cost(&self, label: &Label<'_>, rect: Rect) -> f64 {
        let (x, y) = label.at;
        let (to_x, to_y) = rect.nearest(label.at);
        // The line starts outside the marker's own box.
        let start = (label.radius + 4.0) / (to_x - x).hypot(to_y - y).max(label.radius + 4.0);
        let leader = [(x + start * (to_x - x), y + start * (to_y - y)), (to_x, to_y)];
        self.boxes.iter().map(|(taken, _)| LEADER_ON_BOX * length_in(*taken, leader)).sum()
    }
}

fn length_in(rect: Rect, line: [Point; 2]) -> f64 {
    rect.clip(line).map_or(0.0, |[(x, y), (to_x, to_y)]| (to_x - x).hypot(to_y - y))
}

/// The rectangle of a text on one side of a point, at that distance.
fn beside((x, y): Point, distance: f64, (right, down): Point, width: f64) -> Rect {
    let side = |toward: f64| if toward == 0.0 { 0.0 } else { toward.signum() };
    let center_x = x + right * distance + side(right) * width / 2.0;
    let center_y = y + down * distance + side(down) * HEIGHT / 2.0;
    Rect::new(center_x - width / 2.0, center_y - HEIGHT / 2.0, width, HEIGHT)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn label(at: Point) -> Label<'static> {
        Label { at, radius: 4.0, text: "k = 3" }
    }

    #[test]
    fn labels_leave_each_other_and_markers_alone_while_there_is_room() {
        let mut placer = Placer::new(Rect::new(0.0, 0.0, 300.0, 300.0));
        let at: Vec<Point> = (0..10).map(|i| (100.0 + 9.0 * f64::from(i), 150.0)).collect();
        at.iter().for_each(|&at| placer.avoid_marker(at, 4.0));
        let labels: Vec<Label<'_>> = at.iter().map(|&at| label(at)).collect();
        let places = placer.place(&labels);
        assert_eq!(places.len(), 10);
        for (i, a) in places.iter().enumerate() {
            for b in &places[..i] {
                assert!(a.rect.overlap(b.rect) < 0.5, "{a:?} covers {b:?}");
            }
            for &at in &at {
                assert!(a.rect.overlap(Rect::around(at, 4.0)) < 0.5, "{a:?} covers {at:?}");
            }
        }
    }

    #[test]
    fn the_first_choice_is_to_the_right_and_off_the_line() {
        let at = (50.0, 50.0);
        let mut placer = Placer::new(Rect::new(0.0, 0.0, 100.0, 100.0));
        for i in 0..200 {
            let at = (20.0 + 0.123 * f64::from(i), 30.0 + 0.217 * f64::from(i));
            let place = placer.place(&[label(at)])[0];
            assert!(place.rect.x > at.0 && !place.far, "{at:?}: {place:?}");
        }
        placer.avoid_line(&[(0.0, 50.0), at, (100.0, 50.0)]);
        let place = placer.place(&[label(at)])[0];
        assert!(place.rect.bottom() < at.1 && !place.far, "{place:?}");
    }

    #[test]
    fn labels_stay_inside() {
        for at in [(0.0, 0.0), (99.0, 1.0), (50.0, 99.0), (99.0, 99.0)] {
            let inside = Rect::new(0.0, 0.0, 100.0, 100.0);
            let Place { rect, .. } = Placer::new(inside).place(&[label(at)])[0];
            assert!((rect.overlap(inside) - rect.width * rect.height).abs() < 1e-9, "{at:?}: {rect:?}");
        }
    }
}
