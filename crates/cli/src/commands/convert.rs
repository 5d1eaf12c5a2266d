//! `mediant convert`: writes a map in another format.

use std::{io::Write as _, path::Path};

use mediant::grid::Grid;
use mediant_formats::{MapFile, Raster, RasterFormat, RosError, RosMap, Surface, SurfaceFormat};

use crate::{
    args::{ConvertArgs, CostsArgs},
    failure::Failure,
    map::{
        NamedMap, file_name,
        numbers::{is_surface, read},
    },
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
    /// Numbers of cells.
    Numbers(SurfaceFormat),
}

impl Form {
    /// The format that a file's name stands for.
    fn of(path: &Path) -> Result<Self, Failure> {
        use SurfaceFormat::{EsriAscii, GeoTiff, Npy};
        match (extension(path).as_str(), RasterFormat::of_path(path), SurfaceFormat::of_path(path)) {
            ("map", ..) => Ok(Self::MovingAi),
            ("yaml" | "yml", ..) => Ok(Self::Ros),
            (_, Some(format), _) => Ok(Self::Picture(format)),
            (_, None, Some(format @ (Npy | EsriAscii | GeoTiff))) => Ok(Self::Numbers(format)),
            _ => {
                let known = ".map, .png, .pgm, .pbm, .yaml, .npy, .asc or .tif";
                Err(Failure::Extension { path: path.to_owned(), known })
            }
        }
    }

    /// The form of numbers, if the map's cells have some and the format has room for them.
    fn of_numbers(self, args: &ConvertArgs) -> Self {
        let CostsArgs { costs, inflation, .. } = &args.costs;
        let has_numbers =
            costs.is_some() || inflation.inflation_radius.is_some() || is_surface(&args.map.map);
        match (self, SurfaceFormat::of_path(&args.output)) {
            (Self::Picture(_), Some(format)) if has_numbers => Self::Numbers(format),
            _ => self,
        }
    }
}

/// Runs the command.
pub(crate) fn convert(args: &ConvertArgs, screen: &mut Screen) -> Result<(), Failure> {
    let (path, form) = (args.output.as_path(), Form::of(&args.output)?.of_numbers(args));
    let motion = args.motion.0.motion()?;
    if !matches!(form, Form::Ros) {
        let given = [("--resolution", args.resolution.is_some()), ("--origin", args.origin.is_some())];
        if let Some((option, _)) = given.into_iter().find(|(_, is_given)| *is_given) {
            return Err(Failure::NoRosMap { option });
        }
    }
    if let Form::Numbers(format) = form {
        return convert_numbers(args, format, screen);
    }
    let map = NamedMap::load_ground(&args.map, args.costs.reading)?.with_costs(&args.map, &args.costs)?;
    let map = map.for_agent(&args.map, motion)?;
    let image = path.with_extension("pgm");
    let written = match form {
        Form::Ros => vec![path, image.as_path()],
        _ => vec![path],
    };
    check_outputs(&args.map.map, args.costs.inputs(), &written)?;
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
        // Nothing would read it.
        Form::MovingAi if map.grid.is_long() => {
            let size = (u64::from(map.grid.width()), u64::from(map.grid.height()));
            Ok(Grid::check_size(size.0, size.1).map_err(mediant::Error::from)?)
        }
        // The characters of tiles say nothing of an agent.
        Form::MovingAi if args.map.radius.is_some() => {
            write_file(path, |file| MapFile::from_grid(&map.grid).write(file))
        }
        Form::MovingAi => write_file(path, |file| map.tiles().write(file)),
        Form::Numbers(_) => Err(Failure::NoNumbers { map: map.name.clone() }),
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

/// Writes the numbers of a raster, or the costs of a map.
fn convert_numbers(args: &ConvertArgs, format: SurfaceFormat, screen: &mut Screen) -> Result<(), Failure> {
    if args.map.radius.is_some() {
        return Err(Failure::NotOnCosts { option: "--radius" });
    }
    let surface = for_format(numbers(args)?, format)?;
    let path = args.output.as_path();
    check_outputs(&args.map.map, args.costs.inputs(), &[path])?;
    surface.save(path)?;
    let known = || surface.iter().flatten();
    let (least, greatest) =
        (known().fold(f64::INFINITY, f64::min), known().fold(f64::NEG_INFINITY, f64::max));
    let (cells, without) =
        (surface.iter().len() as u64, surface.iter().len() as u64 - known().count() as u64);
    let name = screen.paint(BOLD, printable(&file_name(path))).to_string();
    write!(screen, "{name} · {} × {} numbers", surface.width(), surface.height())?;
    if without < cells {
        write!(screen, " from {least} to {greatest}")?;
    }
    writeln!(screen, " · {} of {} cells without data", grouped(without), grouped(cells))?;
    Ok(())
}

/// The numbers: those of the costs, if there are some, else those of the file itself.
fn numbers(args: &ConvertArgs) -> Result<Surface, Failure> {
    let CostsArgs { costs, reading, inflation } = &args.costs;
    if costs.is_none() && inflation.inflation_radius.is_none() {
        let is_picture = SurfaceFormat::of_path(&args.map.map).is_some();
        return match is_picture || is_surface(&args.map.map) {
            true => read(&args.map.map, *reading),
            false => Err(Failure::NoNumbers { map: file_name(&args.map.map) }),
        };
    }
    let map = NamedMap::load_ground(&args.map, *reading)?.with_costs(&args.map, &args.costs)?;
    let Some(costs) = &map.costs else { return Err(Failure::NoNumbers { map: map.name }) };
    let (width, height) = (map.grid.width(), map.grid.height());
    let numbers: Vec<f64> = map.cells_by_row().map(|at| costs.cost(at).unwrap_or(NO_DATA)).collect();
    let surface = Surface::new(width, height, numbers).map_err(Failure::Surface)?;
    Ok(surface.with_no_data(Some(NO_DATA)).with_georeference(map.georeference.unwrap_or_default()))
}

/// No cost is negative, and every program reads it.
const NO_DATA: f64 = -9999.0;

/// The numbers as a format has them: it may have no word for cells without data.
fn for_format(surface: Surface, format: SurfaceFormat) -> Result<Surface, Failure> {
    let without = match format {
        SurfaceFormat::Pgm | SurfaceFormat::Png => 0.0,
        SurfaceFormat::Npy => f64::NAN,
        _ => return Ok(surface),
    };
    if surface.iter().all(|number| number.is_some()) {
        return Ok(surface);
    }
    let numbers: Vec<f64> = surface.iter().map(|number| number.unwrap_or(without)).collect();
    let written = Surface::new(surface.width(), surface.height(), numbers).map_err(Failure::Surface)?;
    Ok(written.with_no_data(Some(without)))
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
