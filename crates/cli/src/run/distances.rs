//! `mediant run --distances`: the distances from one vertex to all others.

use std::{
    fs::File,
    io::{self, BufWriter, Write},
    path::Path,
};

use mediant::{Error, Setup};
use mediant_grid::Vertex;

use super::query_error::explain;
use crate::{
    failure::{Ending, Failure},
    map::{Map, file_name},
    terminal::{
        numbers::count,
        screen::{BOLD, Screen},
        text::printable,
    },
};

/// Writes the distances from a vertex to a file as CSV; for the path `-`, to the screen.
pub(crate) fn write(
    setup: Setup,
    map: &Map,
    from: Vertex,
    path: &Path,
    screen: &mut Screen,
) -> Result<Ending, Failure> {
    let found = match setup.space(&map.to_library())?.distances(setup.engine.kind(), from) {
        Ok(found) => found,
        Err(Error::Query(error)) => {
            let placement = setup.rules.placement();
            return Ok(Ending::QueryErrors(explain(error, map, placement)));
        }
        Err(error) => return Err(error.into()),
    };
    if path == Path::new("-") {
        csv(&found, screen)?;
        return Ok(Ending::Answered);
    }
    let file = File::create(path).map_err(Failure::writing(path))?;
    let mut file = BufWriter::new(file);
    csv(&found, &mut file).and_then(|()| file.flush()).map_err(Failure::writing(path))?;
    let furthest = found.iter().copied().fold((from, 0.0), |a, b| if b.1 > a.1 { b } else { a });
    let name = file_name(path);
    let (vertices, (at, distance)) = (count(found.len() as u64, "vertex", "vertices"), furthest);
    let name = screen.paint(BOLD, printable(&name)).to_string();
    writeln!(screen, "{name} · {vertices} reached from {from}, the furthest {at} at {}", rounded(distance))?;
    Ok(Ending::Answered)
}

/// Writes the distances, a line for each vertex.
fn csv(distances: &[(Vertex, f64)], out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "x,y,distance")?;
    distances.iter().try_for_each(|(at, distance)| writeln!(out, "{},{},{}", at.x, at.y, rounded(*distance)))
}

/// Rounded to billionths of a cell, since a sum of rounded costs is not more exact.
fn rounded(distance: f64) -> f64 {
    (distance * 1e9).round() / 1e9
}
