//! `mediant run --distances`: the distances from one vertex to all others.

use std::{
    io::{self, Write},
    path::Path,
};

use mediant::{Demand, Error, Point, Vertex};

use super::query_error::explain;
use crate::{
    args::Asked,
    failure::{Ending, Failure},
    map::{NamedMap, file_name},
    terminal::{
        numbers::{count, rounded},
        screen::{BOLD, Screen},
        text::printable,
    },
    write::write_file,
};

/// Writes the distances from a vertex to a file as CSV; for the path `-`, to the screen.
pub(crate) fn write(
    asked: &Asked,
    map: &NamedMap,
    from: Vertex,
    path: &Path,
    screen: &mut Screen,
) -> Result<Ending, Failure> {
    let space = map.space(asked.motion)?;
    let (setup, _) = space.setup(&asked.call, Demand::Distances)?;
    let found = match space.distances(setup.engine.kind(), from) {
        Ok(found) => found,
        Err(Error::Query(error)) => {
            let placement = setup.rules().placement();
            return Ok(Ending::QueryErrors(explain(error, map, placement)));
        }
        Err(error) => return Err(error.into()),
    };
    if path == Path::new("-") {
        csv("distance", found, screen)?;
        return Ok(Ending::Answered);
    }
    write_file(path, |file| csv("distance", found.iter().copied(), file))?;
    let furthest = furthest((from, 0.0), found.iter().copied());
    let name = file_name(path);
    let (vertices, (at, distance)) = (count(found.len() as u64, "vertex", "vertices"), furthest);
    let name = screen.paint(BOLD, printable(&name)).to_string();
    writeln!(screen, "{name} · {vertices} reached from {from}, the furthest {at} at {}", rounded(distance))?;
    Ok(Ending::Answered)
}

/// The first of the vertices that are furthest away; without a distance above 0 the one that is given.
pub(crate) fn furthest(
    from: (impl Into<Point>, f64),
    distances: impl IntoIterator<Item = (Vertex, f64)>,
) -> (Point, f64) {
    let (from, known) = from;
    let distances = distances.into_iter().map(|(at, distance)| (Point::from(at), distance));
    distances.fold((from.into(), known), |a, b| if b.1 > a.1 { b } else { a })
}

/// Writes numbers with a name, a line for each vertex.
pub(crate) fn csv(
    name: &str,
    numbers: impl IntoIterator<Item = (Vertex, f64)>,
    out: &mut impl Write,
) -> io::Result<()> {
    writeln!(out, "x,y,{name}")?;
    let mut lines = numbers.into_iter();
    lines.try_for_each(|(at, number)| writeln!(out, "{},{},{}", at.x, at.y, rounded(number)))
}
