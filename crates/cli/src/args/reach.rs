//! The arguments of `mediant reach`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use mediant::DirectionCode;

use super::{
    costs::{CostsArgs, WalkingArgs},
    flags::{Flags, MOTION},
    map::MapArgs,
    value::{Place, parse_amount, parse_place},
};

#[derive(Args, Debug)]
#[command(after_help = REACH_HELP)]
pub(crate) struct ReachArgs {
    #[command(flatten)]
    pub(crate) map: MapArgs,
    #[command(flatten)]
    pub(crate) costs: CostsArgs,
    #[command(flatten)]
    pub(crate) walking: WalkingArgs,

    /// A source: a place from which distances are measured. Of several (repeat it) the nearest one counts
    #[arg(long, value_name = "X,Y", required_unless_present = "to")]
    #[arg(allow_hyphen_values = true, value_parser = parse_place)]
    pub(crate) from: Vec<Place>,
    /// In place of --from: a place to which distances are measured, which is another time over elevation
    #[arg(long, value_name = "X,Y")]
    #[arg(allow_hyphen_values = true, value_parser = parse_place)]
    pub(crate) to: Vec<Place>,
    /// Write the cost of the best path from a --from to a --to over each vertex; those with little more than
    /// the least are a corridor
    #[arg(long, requires_all = ["from", "to"], conflicts_with_all = ["directions", "allocation"])]
    pub(crate) corridor: bool,
    /// Go no further than this, in cells (with --world in meters); where cells have costs, in costs, and over
    /// elevation in seconds
    #[arg(long, value_name = "COST", allow_negative_numbers = true)]
    #[arg(value_parser = |text: &str| parse_amount(text, "cells"))]
    pub(crate) within: Option<f64>,
    #[command(flatten)]
    pub(crate) motion: Flags<MOTION>,
    /// Write the directions to the nearest source instead of distances, as numbers that other programs read
    #[arg(long, value_name = "CODE", conflicts_with = "allocation")]
    pub(crate) directions: Option<Directions>,
    /// Write the number of the nearest source instead of distances: 0 is the first --from
    #[arg(long)]
    pub(crate) allocation: bool,
    /// Write the distances to this file (repeat it for several): .png and .svg are pictures, .csv has x, y
    /// and distance of all that is reached, .npy is an array for NumPy, .asc and .tif are rasters (ESRI ASCII
    /// grid, GeoTIFF) at the place of the costs; - prints the CSV
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Vec<PathBuf>,
}

/// The code of directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Directions {
    /// Back links of ArcGIS, for k = 2 and 3: 1 to 8 clockwise from east, 0 at a source
    Arcgis,
    /// Back directions of ArcGIS: degrees clockwise from north, above 0 to 360, 0 at a source
    Degrees,
    /// Movement directions of GRASS: degrees counterclockwise from east, above 0 to 360
    Grass,
}

impl From<Directions> for DirectionCode {
    fn from(code: Directions) -> Self {
        match code {
            Directions::Arcgis => Self::ArcGisBackLink,
            Directions::Degrees => Self::ArcGisDegrees,
            Directions::Grass => Self::Grass,
        }
    }
}

const REACH_HELP: &str = "\
Distances are those of the shortest paths over N(k); with k = any, at corners, those of the shortest paths \
at any angle.

Files have vertices and distances in cells, with --world too; distances are costs where cells have \
costs. The array has a row for each row of vertices, and is infinite where nothing was reached. \
A picture shows the map that was read, also for an \
agent with a radius.

Exit status: 0, 1 if a source or goal is blocked or outside the map, 2 for bad arguments, or a file that cannot be \
read or written.

With --costs, or where the map itself is a raster of numbers (NPY, ESRI ASCII grid, GeoTIFF), cells have \
costs, and distances are the least costs: an accumulated cost surface.

With --elevation they are the least times to walk from the sources, in seconds where the raster is in \
meters; with --to in place of --from, the times to walk to them.

With --corridor they are the costs of the best paths from --from to --to over each vertex, the sum of those from the \
one and to the other; --within keeps those up to it.

With --directions or --allocation files and pictures have these in place of distances. Where there is none \
(outside what is reached; with grass at sources) the array has 'not a number', rasters no data, and the CSV no \
line.

Examples:
  mediant reach builtin:cave --from 2,5 --within 40
  mediant reach arena.map --from 1,11 --from 40,30 -o arena.png
  mediant reach arena.map --from 1,11 --k any --gap closed -o arena.svg -o arena.csv -o arena.npy
  mediant reach arena.map --from 1,11 --radius 1.5 --within 20 -o -
  mediant reach friction.tif --from 100,200 --k 4 --corners always -o cost.tif
  mediant reach dem.tif --elevation --from 100,200 --within 3600 --k 4 -o hour.tif
  mediant reach dem.tif --elevation --pace langmuir --to 100,200 -o back.asc
  mediant reach friction.tif --from 100,200 --from 9,9 --allocation -o nearest.tif
  mediant reach friction.tif --from 100,200 --directions arcgis -o links.tif
  mediant reach friction.tif --from 100,200 --to 9,9 --corridor -o corridor.tif
  mediant reach depot.yaml --world --from 0.5,0.5 --within 1.5 --radius 0.1";
