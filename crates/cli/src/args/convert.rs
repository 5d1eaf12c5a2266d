//! The arguments of `mediant convert`.

use std::path::PathBuf;

use clap::Args;

use super::{
    costs::CostsArgs,
    flags::{Flags, MOTION},
    map::MapArgs,
    value::{parse_amount, parse_pose},
};

#[derive(Args, Debug)]
#[command(after_help = CONVERT_HELP)]
#[command(mut_arg("k", |arg| arg.requires("radius").help(K_HELP)))]
#[command(mut_arg("neighbors", |arg| arg.requires("radius")))]
#[command(mut_arg("placement", |arg| arg.requires("radius").help(PLACEMENT_HELP)))]
#[command(mut_arg("corners", |arg| arg.requires("radius")))]
#[command(mut_arg("gap", |arg| arg.requires("radius")))]
pub(crate) struct ConvertArgs {
    #[command(flatten)]
    pub(crate) map: MapArgs,
    #[command(flatten)]
    pub(crate) costs: CostsArgs,
    /// The file to write: .map (MovingAI), .png, .pgm, .pbm, or .yaml (ROS, with the .pgm beside it); for
    /// numbers .npy, .asc, .tif, or .pgm and .png of 16 bits
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: PathBuf,
    /// Of a ROS map to write, the side of a cell in meters; by default that of the map that is read
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    #[arg(value_parser = |text: &str| parse_amount(text, "meters"))]
    pub(crate) resolution: Option<f64>,
    /// Of a ROS map to write, where its lower left corner is, in meters, and its yaw in radians; by default
    /// as in the map that is read, else 0,0,0
    #[arg(long, value_name = "X,Y,YAW", allow_hyphen_values = true, value_parser = parse_pose)]
    pub(crate) origin: Option<[f64; 3]>,
    #[command(flatten)]
    pub(crate) motion: Flags<MOTION>,
}

const K_HELP: &str = "With --radius, the k of the agent's paths: 2 to 12, or any. 3 by default";

const PLACEMENT_HELP: &str = "With --radius, where the vertices of its paths are: at cell centers or at cell \
corners. center by default, corner for k = any";

const CONVERT_HELP: &str = "\
A cell is free or blocked in what is written: a picture is black and white, and the unknown cells of a ROS \
map are blocked, or free with --unknown-free. From .map to .map the characters of the tiles stay, but with \
--radius.

With --radius the map of that agent is written: a cell is blocked where the disc does not fit. How closely \
that is measured depends on how it will move, so say --k, --placement and --corners or --gap as for run.

A raster of numbers (NPY, ESRI ASCII grid, GeoTIFF; to .npy, .asc and .tif also PGM and PNG of gray) keeps its \
numbers, its cells without data, and its place in the world, as far as the format has these. In PGM and PNG \
numbers are whole ones of 0 to 65,535, and cells without data are 0; in NPY they are NaN. With --costs or --inflation-radius a \
map's costs are written: a number for each free cell.

Files are replaced, but never one from which the map is read.

Examples:
  mediant convert arena.map -o arena.png
  mediant convert arena.map -o arena.yaml --resolution 0.05 --origin -1,-2,0
  mediant convert depot.yaml -o depot.map --threshold 0.4
  mediant convert depot.yaml -o depot-inflated.yaml --world --radius 0.15
  mediant convert friction.tif -o friction.npy
  mediant convert depot.yaml --world --inscribed-radius 0.1 --inflation-radius 0.5 -o costs.tif
  mediant convert builtin:town -o town.pbm";
