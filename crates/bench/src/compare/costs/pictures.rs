//! Pictures of paths over the surfaces, for some k.

use std::{fs, path::Path};

use mediant::Vertex;
use mediant_formats::Picture;
use mediant_grid::PlacementKind;

use super::{
    page::PICTURES,
    surfaces::{Kind, space},
};
use crate::compare::CompareError;

/// The cells of a side.
const SIDE: u32 = 96;
/// The first path is the widest, so that those over it show where they are the same.
const KS: [u32; 3] = [2, 3, 5];

/// Writes the pictures into the project at `root`.
pub(super) fn write(root: &Path, surfaces: &[Kind]) -> Result<(), CompareError> {
    for surface in surfaces.iter().filter(|surface| PICTURES.contains(&surface.name())) {
        let costs = surface.surface(SIDE)?;
        let free = |near: [i32; 2]| {
            let cells = (0..SIDE as i32).flat_map(|y| (0..SIDE as i32).map(move |x| Vertex::new(x, y)));
            let distance = |at: &Vertex| (at.x - near[0]).pow(2) + (at.y - near[1]).pow(2);
            cells.filter(|&at| costs.map().is_free(at)).min_by_key(distance)
        };
        let last = SIDE as i32 - 1;
        let (Some(start), Some(goal)) = (free([4, last - 20]), free([last - 4, 12])) else { continue };
        let mut picture = Picture::new(costs.map().grid(), PlacementKind::Center).largest_side(768);
        picture = picture.field(|at| costs.cost(at)).without_contours();
        for k in KS {
            let Some(path) = space(&costs, k)?.path(start, goal)? else { continue };
            let points = path.waypoints().iter().map(|at| (f64::from(at.x), f64::from(at.y)));
            picture = picture.path(format!("k = {k}"), points);
        }
        let path = root.join("docs/results").join(format!("costs/{}.png", surface.name()));
        let write = || {
            path.parent().map_or(Ok(()), fs::create_dir_all)?;
            let mut bytes = Vec::new();
            picture.start(start).goal(goal).write_png(&mut bytes)?;
            fs::write(&path, bytes)
        };
        write().map_err(|source| CompareError::Write { path: path.clone(), source })?;
    }
    Ok(())
}
