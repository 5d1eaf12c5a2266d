//! `mediant convert`: writes a map in another format.

use std::{io::Write, path::Path};

use mediant::grid::Grid;
use mediant_formats::{MapFile, Raster, RasterFormat, RosError, RosMap};

use crate::{
    args::ConvertArgs,
    failure::Failure,
    map::{NamedMap, file_name},
    terminal::{
        numbers::grouped,
        screen::{BOLD, Screen},
        text::printable,
    },
    write::{check_outputs, extension, write_file},
};

/// A format that maps are written in.
#[derive(Clone, Copy, Debug)]
enum Form {
    MovingAi,
    Picture(RasterFormat),
    Ros,
}

impl Form {
    /// The format that a file's name stands for.
    fn of(path: &Path) -> Result<Self, Failure> {
        match (extension(path).as_str(), RasterFormat::of_path(path)) {
            ("map", _) => Ok(Self::MovingAi),
            ("yaml" | "yml", _) => Ok(Self::Ros),
            (_, Some(format)) => Ok(Self::Picture(format)),
            _ => Err(Failure::Extension { path: path.to_owned(), known: ".map, .png, .pgm, .pbm or .yaml" }),
        }
    }
}

/// Runs the command.
pub(crate) fn convert(args: &ConvertArgs, screen: &mut Screen) -> Result<(), Failure> {
    let (path, form) = (args.output.as_path(), Form::of(&args.output)?);
    let motion = args.motion.0.motion()?;
    if !matches!(form, Form::Ros) {
        let given = [("--resolution", args.resolution.is_some()), ("--origin", args.origin.is_some())];
        if let Some((option, _)) = given.into_iter().find(|(_, is_given)| *is_given) {
            return Err(Failure::NoRosMap { option });
        }
    }
    let map = NamedMap::load_with_tiles(&args.map)?.for_agent(&args.map, motion)?;
    let image = path.with_extension("pgm");
    let written = match form {
        Form::Ros => vec![path, image.as_path()],
        _ => vec![path],
    };
    check_outputs(&args.map.map, &written)?;
    write(args, form, &map, &image)?;
    let names: Vec<String> =
        written.iter().map(|path| screen.paint(BOLD, printable(&file_name(path))).to_string()).collect();
    let (grid, names) = (&map.grid, names.join(" and "));
    writeln!(screen, "{names} · {} × {} cells · {}", grid.width(), grid.height(), blocked(grid))?;
    Ok(())
}

/// Writes the map; the picture of a ROS map has the path `image`.
fn write(args: &ConvertArgs, form: Form, map: &NamedMap, image: &Path) -> Result<(), Failure> {
    let path = args.output.as_path();
    let wrong = |source: RosError| Failure::RosMap { path: path.to_owned(), source };
    match form {
        // The characters of tiles say nothing of an agent.
        Form::MovingAi if args.map.radius.is_some() => {
            write_file(path, |file| MapFile::from_grid(&map.grid).write(file))
        }
        Form::MovingAi => write_file(path, |file| map.tiles().write(file)),
        Form::Picture(format) => {
            let raster = Raster::from_grid(&map.grid).map_err(|source| wrong(source.into()))?;
            write_file(path, |file| raster.write(format, file))
        }
        Form::Ros => {
            let resolution = args.resolution.or(map.place.map(|place| place.resolution()));
            let resolution = resolution.ok_or_else(|| Failure::NoResolution { map: map.name.clone() })?;
            let origin = args.origin.or(map.place.map(|place| place.origin())).unwrap_or_default();
            let ros = RosMap::from_grid(&map.grid, file_name(image), resolution, origin).map_err(wrong)?;
            Ok(ros.save(path)?)
        }
    }
}

/// The number and the share of blocked cells, in words.
fn blocked(grid: &Grid) -> String {
    let cells = u64::from(grid.width()) * u64::from(grid.height());
    let blocked = cells - grid.free_cells();
    format!(
        "{} of {} cells blocked, {:.1} %",
        grouped(blocked),
        grouped(cells),
        100.0 * blocked as f64 / cells as f64
    )
}
