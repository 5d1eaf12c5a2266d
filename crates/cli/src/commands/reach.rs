//! `mediant reach`: what lies within a cost of one or many sources.

use std::{
    io::{self, Write},
    path::Path,
};

use mediant::{Error, Field, K, Motion, Point, Vertex, errors::QueryError, search::End};
use mediant_formats::{Picture, Surface, SurfaceFormat};

use crate::{
    args::{Directions, Place, ReachArgs},
    failure::{Ending, Failure},
    map::NamedMap,
    run::{
        distances::{csv, furthest},
        query_error::explain,
        report::{ends_in_words, motion_in_words},
    },
    terminal::{
        numbers::{count, grouped, hours, rounded},
        screen::{BOLD, Screen},
        text::printable,
    },
    write::{check_outputs, extension, npy, write_file},
};

/// The form of an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// CSV on stdout.
    Printed,
    Csv,
    Npy,
    Surface(SurfaceFormat),
    Picture,
}

impl Form {
    /// The form that a file's name stands for.
    fn of(path: &Path) -> Result<Self, Failure> {
        if path == Path::new("-") {
            return Ok(Self::Printed);
        }
        match extension(path).as_str() {
            "csv" => Ok(Self::Csv),
            "npy" => Ok(Self::Npy),
            "asc" => Ok(Self::Surface(SurfaceFormat::EsriAscii)),
            "tif" | "tiff" => Ok(Self::Surface(SurfaceFormat::GeoTiff)),
            "png" | "svg" => Ok(Self::Picture),
            _ => {
                let known = ".png, .svg, .csv, .npy, .asc or .tif (- prints CSV)";
                Err(Failure::Extension { path: path.to_owned(), known })
            }
        }
    }
}

/// Runs the command.
pub(crate) fn reach(args: &ReachArgs, screen: &mut Screen) -> Result<Ending, Failure> {
    let motion = args.motion.0.motion()?;
    if !args.corridor && !args.from.is_empty() && !args.to.is_empty() {
        return Err(Failure::NoCorridor);
    }
    if args.directions == Some(Directions::Arcgis) && !matches!(motion.k, K::N4 | K::N8) {
        return Err(Failure::BackLinks { k: motion.k });
    }
    let outputs = args.output.iter().map(|path| Ok((path.as_path(), Form::of(path)?)));
    let outputs = outputs.collect::<Result<Vec<_>, Failure>>()?;
    let map = NamedMap::load_ground(&args.map, args.costs.reading)?.without_tiles();
    let map = map.for_agent(&args.map, motion)?.with_numbers(&args.map, &args.costs, &args.walking)?;
    let written: Vec<&Path> =
        outputs.iter().filter(|(_, form)| *form != Form::Printed).map(|(path, _)| *path).collect();
    check_outputs(&args.map.map, args.costs.inputs().chain(args.walking.inputs()), &written)?;
    let placement = motion.rules.placement();
    let ends = |places: &[Place]| -> Result<Vec<Point>, Failure> {
        places.iter().map(|&place| map.end(motion, place)).collect()
    };
    let (from, to) = (ends(&args.from)?, ends(&args.to)?);
    let limit = args.within.map(|cost| if map.has_costs() { cost } else { map.cells(cost) });
    let space = map.space(motion)?;
    let greatest = limit.unwrap_or(f64::INFINITY);
    let leads_to = || space.field_within(to.iter().copied(), greatest).map_err(of_goals);
    let fields = match args.from.is_empty() {
        true => leads_to().map(|field| (field, None)),
        false => space.field_from_within(from.iter().copied(), greatest).and_then(|field| {
            let other = args.corridor.then(leads_to).transpose()?;
            Ok((field, other))
        }),
    };
    let (field, other) = match fields {
        Ok(fields) => fields,
        Err(Error::Query(error)) => {
            return Ok(Ending::QueryErrors(explain(error, &map, placement)));
        }
        Err(error) => return Err(error.into()),
    };
    let values = match &other {
        Some(other) => Values::of_corridor(&field, other, greatest)?,
        None => Values::of(args, &field),
    };
    for (path, form) in &outputs {
        match form {
            Form::Printed => csv(values.name, values.iter(&field), screen)?,
            Form::Csv => write_file(path, |file| csv(values.name, values.iter(&field), file))?,
            Form::Npy => {
                let shape = (field.height(), field.width());
                write_file(path, |file| npy::write(shape, values.rows.iter().copied(), file))?;
            }
            Form::Surface(_) => surface(&map, &field, &values)?.save(path)?,
            Form::Picture => {
                picture(&map, motion, &field, &values).goals(to.iter().copied()).write_to(path)?;
            }
        }
    }
    // A summary would spoil the CSV on stdout.
    if outputs.iter().all(|(_, form)| *form != Form::Printed) {
        match args.corridor {
            true => corridor_summary(&map, motion, &values, [&from, &to], screen)?,
            false if to.is_empty() => summary(&map, motion, &field, ("from", &from), limit, screen)?,
            false => summary(&map, motion, &field, ("to", &to), limit, screen)?,
        }
        let (places, sources) = ([&args.from[..], &args.to].concat(), [from, to].concat());
        if let Some(moved) = map.moved(placement, &places, &sources).filter(|&moved| moved > 0.0) {
            writeln!(screen, "  moved to {}: the sources by at most {moved:.3} m", ends_in_words(motion.k))?;
        }
    }
    Ok(Ending::Answered)
}

/// The error of sources that are goals.
fn of_goals(error: Error) -> Error {
    let end = End::Goal;
    match error {
        Error::Query(QueryError::Blocked { at, .. }) => QueryError::Blocked { end, at }.into(),
        Error::Query(QueryError::Outside { at, last, .. }) => QueryError::Outside { end, at, last }.into(),
        error => error,
    }
}

/// The numbers of all vertices that are written, row by row.
struct Values {
    name: &'static str,
    rows: Vec<f64>,
}

impl Values {
    fn of(args: &ReachArgs, field: &Field) -> Self {
        let source = |number: Option<u32>| number.map_or(f64::NAN, f64::from);
        match args.directions {
            Some(code) => Self { name: "direction", rows: field.directions(code.into()) },
            None if args.allocation => {
                Self { name: "source", rows: field.allocation().into_iter().map(source).collect() }
            }
            None => Self { name: "distance", rows: field.lengths() },
        }
    }

    /// The costs of the best paths over each vertex, up to the greatest.
    fn of_corridor(from: &Field, to: &Field, greatest: f64) -> Result<Self, Error> {
        // The room that limits of fields leave for rounding.
        let most = greatest * (1.0 + 1.0 / f64::from(1_u32 << 31));
        let mut rows = from.corridor(to)?;
        rows.iter_mut().filter(|cost| **cost > most).for_each(|cost| *cost = f64::INFINITY);
        Ok(Self { name: "cost", rows })
    }

    fn get(&self, field: &Field, at: Vertex) -> Option<f64> {
        let row = usize::try_from(at.y).ok()? * field.width() as usize;
        self.rows.get(row + usize::try_from(at.x).ok()?).copied().filter(|number| number.is_finite())
    }

    /// Each vertex that has a number.
    fn iter(&self, field: &Field) -> impl Iterator<Item = (Vertex, f64)> {
        let width = field.width() as usize;
        let vertex = move |number: usize| Vertex::new((number % width) as i32, (number / width) as i32);
        let numbered = self.rows.iter().enumerate().filter(|(_, number)| number.is_finite());
        numbered.map(move |(number, &value)| (vertex(number), value))
    }
}

/// The numbers as a raster, at the place of the costs.
fn surface(map: &NamedMap, field: &Field, values: &Values) -> Result<Surface, Failure> {
    /// None of them is negative, and every program reads it.
    const NO_DATA: f64 = -9999.0;
    let rows = values.rows.iter().map(|&number| if number.is_finite() { number } else { NO_DATA });
    let surface =
        Surface::new(field.width(), field.height(), rows.collect::<Vec<f64>>()).map_err(Failure::Surface)?;
    let surface = surface.with_no_data(Some(NO_DATA));
    Ok(match &map.georeference {
        Some(place) => surface.with_georeference(place.clone()),
        None => surface,
    })
}

/// The map with the numbers as colors.
fn picture<'m>(map: &'m NamedMap, motion: Motion, field: &Field, values: &Values) -> Picture<'m> {
    Picture::new(&map.ground, motion.rules.placement())
        .field(|at| values.get(field, at))
        .starts(field.sources())
        .caption(format!("{}: {motion}", printable(&map.name)))
}

/// One place in words, or how many there are.
fn in_words(places: &[Point], name: &str) -> String {
    match places {
        [only] => only.to_string(),
        _ => format!("{} {name}", grouped(places.len() as u64)),
    }
}

/// Writes how many vertices are in the corridor, and what the best path costs.
fn corridor_summary(
    map: &NamedMap,
    motion: Motion,
    values: &Values,
    [from, to]: [&[Point]; 2],
    screen: &mut Screen,
) -> io::Result<()> {
    let known = || values.rows.iter().copied().filter(|cost| cost.is_finite());
    let least = known().fold(f64::INFINITY, f64::min);
    let name = screen.paint(BOLD, printable(&map.name)).to_string();
    let (motion, from, to) = (motion_in_words(motion), in_words(from, "sources"), in_words(to, "goals"));
    if least.is_infinite() {
        return writeln!(screen, "{name} · {motion} · no way from {from} to {to}");
    }
    let vertices = count(known().count() as u64, "vertex", "vertices");
    let unit = if map.walking.is_some() { " s" } else { "" };
    writeln!(screen, "{name} · {motion} · {vertices} on ways from {from} to {to}, the best {least:.4}{unit}")
}

/// Writes how many vertices are reached, and which is the furthest.
fn summary(
    map: &NamedMap,
    motion: Motion,
    field: &Field,
    (way, sources): (&str, &[Point]),
    limit: Option<f64>,
    screen: &mut Screen,
) -> io::Result<()> {
    let Some(&first) = sources.first() else { return Ok(()) };
    let from = in_words(sources, "sources");
    let frame = map.frame.filter(|_| !map.has_costs());
    let meters = |cells: f64| frame.map(|frame| rounded(cells * frame.resolution()));
    let unit = if map.walking.is_some() { " s" } else { "" };
    let how = limit.map_or_else(
        || match way {
            "to" => format!("reach {from}"),
            _ => format!("reached from {from}"),
        },
        |limit| match meters(limit) {
            Some(meters) => format!("within {meters} m of {from}"),
            None => format!("within {limit}{unit} of {from}"),
        },
    );
    let (at, distance) = furthest((first, 0.0), field.iter());
    let vertices = count(field.iter().count() as u64, "vertex", "vertices");
    let name = screen.paint(BOLD, printable(&map.name)).to_string();
    let motion_words = motion_in_words(motion);
    write!(screen, "{name} · {motion_words} · {vertices} {how}, the furthest {at} at {distance:.4}{unit}")?;
    if map.walking.is_some() && distance >= 60.0 {
        write!(screen, " ({})", hours(distance))?;
    }
    if let (Some(frame), Some(meters)) = (frame, meters(distance)) {
        let (x, y) = frame.point_of(motion.rules.placement(), at);
        write!(screen, " cells: in the world ({x:.3}, {y:.3}) at {meters:.3} m")?;
    }
    writeln!(screen)
}
