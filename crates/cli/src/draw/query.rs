//! The picture of a single query: on the screen, or in a file.

use std::{
    io::{self, Write},
    path::Path,
};

use mediant::{
    Planner, Point, Query, Setup, Vertex,
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
    /// Draws the map with the path on the screen.
    pub(crate) fn on_screen(&self, waypoints: &[Vertex], screen: &mut Screen) -> io::Result<()> {
        let placement = self.setup.rules().placement();
        let mut canvas = Canvas::fit(&self.map.tiles(), self.map.theme, placement, screen);
        if let Some(land) = Land::of(self.map) {
            canvas.shade(|x, y| land.share(x, y));
        }
        canvas.path(waypoints, Stroke::Solid, INKS.best);
        canvas.ends(&vertices(self.query.starts()), &vertices(self.query.goals()));
        writeln!(screen)?;
        canvas.write(screen)
    }

    /// Draws the map, the vertices that the search expands, and the path to a file. Where cells have costs or
    /// elevations it has these, which would not be seen below what was searched.
    pub(crate) fn to_file(
        &self,
        path: &Path,
        planner: &mut Planner,
        waypoints: &[Vertex],
    ) -> Result<(), Failure> {
        let placement = self.setup.rules().placement();
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
            (Some(&start), Some(&goal)) => picture.start(start).goal(goal),
            _ => picture.starts(vertices(self.query.starts())).goals(vertices(self.query.goals())),
        };
        let points = waypoints.iter().map(|at| (f64::from(at.x), f64::from(at.y)));
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

/// The ends of a query, which on a command line are vertices.
fn vertices(ends: &[Point]) -> Vec<Vertex> {
    ends.iter().filter_map(|at| at.vertex()).collect()
}
