//! The picture of a single query: on the screen, or in a file.

use std::{
    io::{self, Write},
    path::Path,
};

use mediant::{
    PlacementKind, Planner, Point, Query, Rules, Setup, Vertex,
    search::{NodeEvent, Observer},
};
use mediant_formats::{Picture, PictureError};

use super::{braille::Stroke, land::Land, picture::Canvas, theme::INKS};
use crate::{failure::Failure, map::NamedMap, terminal::screen::Screen, write::extension};

/// The picture of a single query.
pub(crate) struct Drawing<'d> {
    pub(crate) map: &'d NamedMap,
    pub(crate) setup: Setup,
    pub(crate) query: Query,
}

/// Checks, before anything is computed, that the name of a picture's file tells its format.
pub(crate) fn check_name(path: &Path) -> Result<(), Failure> {
    match extension(path).as_str() {
        "png" | "svg" => Ok(()),
        _ => Err(PictureError::Extension { path: path.to_owned() }.into()),
    }
}

impl Drawing<'_> {
    /// Whether paths lead between centers by corners: then the search expands corners, and these are drawn.
    fn is_by_corners(&self) -> bool {
        matches!(self.setup.rules(), Rules::CenterGap(_))
    }

    /// The placement of what is drawn.
    fn placement(&self) -> PlacementKind {
        if self.is_by_corners() { PlacementKind::Corner } else { self.setup.rules().placement() }
    }

    /// A point in the coordinates of what is drawn.
    fn drawn(&self, at: Point) -> Point {
        if self.is_by_corners() { at.at_corners() } else { at }
    }

    /// The starts and the goals of the query.
    fn ends(&self) -> [Vec<Point>; 2] {
        [self.query.starts(), self.query.goals()].map(|ends| ends.iter().map(|&at| self.drawn(at)).collect())
    }

    /// Draws the map with the path on the screen.
    pub(crate) fn on_screen(&self, waypoints: &[Point], screen: &mut Screen) -> io::Result<()> {
        let placement = self.placement();
        let mut canvas = Canvas::fit(&self.map.tiles(), self.map.theme, placement, screen);
        if let Some(land) = Land::of(self.map) {
            canvas.shade(|x, y| land.share(x, y));
        }
        let waypoints: Vec<Point> = waypoints.iter().map(|&at| self.drawn(at)).collect();
        canvas.path(&waypoints, Stroke::Solid, INKS.best);
        let [starts, goals] = self.ends();
        canvas.ends(&starts, &goals);
        writeln!(screen)?;
        canvas.write(screen)
    }

    /// Draws the map, the vertices that the search expands, and the path to a file. Where cells have costs or
    /// elevations it has these, which would not be seen below what was searched.
    pub(crate) fn to_file(
        &self,
        path: &Path,
        planner: &mut Planner,
        waypoints: &[Point],
    ) -> Result<(), Failure> {
        let placement = self.placement();
        let mut picture = Picture::new(&self.map.ground, placement);
        picture = match Land::of(self.map) {
            Some(land) => {
                picture = picture.field(|at| land.at(placement, at)).caption(land.caption);
                if land.has_contours() { picture } else { picture.without_contours() }
            }
            None => {
                let mut searched = Searched::default();
                // An error of the query was printed already.
                let _ = planner.find_observed(self.query.clone(), &mut searched);
                picture.expanded(searched.expanded)
            }
        };
        // Where a path was found, its own ends count: those that were asked for may have been moved.
        picture = match (waypoints.first(), waypoints.last()) {
            (Some(&start), Some(&goal)) => picture.start(self.drawn(start)).goal(self.drawn(goal)),
            _ => {
                let [starts, goals] = self.ends();
                picture.starts(starts).goals(goals)
            }
        };
        let points = waypoints.iter().map(|&at| self.drawn(at)).map(|at| (at.x(), at.y()));
        let name = format!("{}, k = {}", self.setup.engine.kind(), self.setup.k());
        Ok(picture.path(name, points).radius(self.map.radius).write_to(path)?)
    }
}

/// Remembers what a search expands.
#[derive(Default)]
struct Searched {
    expanded: Vec<Vertex>,
}

impl Observer for Searched {
    fn expanded(&mut self, node: NodeEvent) {
        self.expanded.push(node.at);
    }
}
