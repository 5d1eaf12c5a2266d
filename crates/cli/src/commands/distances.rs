//! `mediant run --distances`: how far it is from one vertex to all others.

use std::{
    fs::File,
    io::{self, BufWriter, Write},
    path::Path,
};

use mediant_engines::{EngineError, Setup, distances};
use mediant_grid::Vertex;

use crate::{
    failure::{Ending, Failure},
    map::{Map, file_name},
    run::session::explain,
    terminal::{
        screen::{BOLD, Screen},
        text::{count, printable},
    },
};

/// Writes the distances from a vertex to a file, or to the screen for `-`.
pub(crate) fn write(
    setup: Setup,
    map: &Map,
    from: Vertex,
    path: &Path,
    screen: &mut Screen,
) -> Result<Ending, Failure> {
    let found = match distances(setup, &map.grid, from) {
        Ok(found) => found,
        Err(EngineError::Query(error)) => {
            let placement = setup.rules.placement();
            return Ok(Ending::QueryErrors(explain(error, &map.grid, placement)));
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

fn csv(distances: &[(Vertex, f64)], out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "x,y,distance")?;
    distances.iter().try_for_each(|(at, distance)| writeln!(out, "{},{},{}", at.x, at.y, rounded(*distance)))
}

/// In billionths of a cell: a sum of rounded moves is no more exact than that.
fn rounded(distance: f64) -> f64 {
    (distance * 1e9).round() / 1e9
}
