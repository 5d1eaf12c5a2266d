//! The arguments that give cells a number: a cost or an elevation.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use mediant::{Langmuir, Pace};

use super::value::{parse_amount, parse_number};

#[derive(Args, Clone, Debug, Default)]
pub(crate) struct CostsArgs {
    /// Cells have a cost a unit of length: a raster with a number for each cell of the map (NPY, ESRI ASCII
    /// grid, GeoTIFF, PGM or PNG). Cells without data are blocked, too. Paths cost the sum of length times
    /// cost in each cell, with k = 2 to 8
    #[arg(long, value_name = "FILE", help_heading = "Agent and map")]
    pub(crate) costs: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) reading: ReadingArgs,
    #[command(flatten)]
    pub(crate) inflation: InflationArgs,
}

/// The options by which a raster of costs or elevations is read.
#[derive(Args, Clone, Copy, Debug, Default)]
pub(crate) struct ReadingArgs {
    /// The band of a raster with several, from 1: a GeoTIFF, or an NPY of bands, rows and columns
    #[arg(long, value_name = "N", help_heading = "Agent and map", allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) band: Option<u16>,
    /// In a raster of costs or elevations, cells of this number have no data and are blocked, whatever the
    /// file says; NPY, PGM and PNG say nothing
    #[arg(long, value_name = "VALUE", help_heading = "Agent and map", allow_negative_numbers = true)]
    #[arg(value_parser = parse_number)]
    pub(crate) no_data: Option<f64>,
}

impl ReadingArgs {
    /// An option that was given.
    pub(crate) const fn given(self) -> Option<&'static str> {
        match self {
            Self { band: Some(_), .. } => Some("--band"),
            Self { no_data: Some(_), .. } => Some("--no-data"),
            Self { band: None, no_data: None } => None,
        }
    }
}

/// Costs around obstacles, in the words of nav2.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct InflationArgs {
    /// Cells near obstacles cost more, up to this distance, in cells (with --world in meters), as in nav2's
    /// inflation layer; occupancies of a ROS map of mode scale or raw are costs, too. A cell costs 1 + weight
    /// · byte / 252 a cell of length
    #[arg(long, value_name = "R", help_heading = "Agent and map", allow_hyphen_values = true)]
    #[arg(value_parser = |text: &str| parse_amount(text, "cells"), conflicts_with_all = ["costs", "radius"])]
    pub(crate) inflation_radius: Option<f64>,
    /// With --inflation-radius, the radius of the robot in the same unit: cells whose centers are as near to
    /// that of an obstacle are blocked [default: 0]
    #[arg(long, value_name = "R", help_heading = "Agent and map", allow_hyphen_values = true)]
    #[arg(value_parser = |text: &str| parse_amount(text, "cells"), requires = "inflation_radius")]
    pub(crate) inscribed_radius: Option<f64>,
    /// With --inflation-radius, the rate at which costs fall: 252 · exp(−rate · distance from the inscribed
    /// radius) [default: so that they fall to 1]
    #[arg(long, value_name = "RATE", help_heading = "Agent and map", allow_hyphen_values = true)]
    #[arg(value_parser = |text: &str| parse_amount(text, "a unit of length"), requires = "inflation_radius")]
    pub(crate) cost_scaling_factor: Option<f64>,
    /// With --inflation-radius, how much the costs count: the dearest cells cost 1 + weight [default: 2]
    #[arg(long, value_name = "WEIGHT", help_heading = "Agent and map", allow_hyphen_values = true)]
    #[arg(value_parser = |text: &str| parse_amount(text, "times the length"), requires = "inflation_radius")]
    pub(crate) weight: Option<f64>,
}

#[derive(Args, Clone, Debug, Default)]
pub(crate) struct WalkingArgs {
    /// Paths lead over elevation, and cost time: seconds, where elevations and cells are in meters. FILE is a
    /// raster as for --costs; without it the map itself is one. A way and the way back take different times;
    /// k = 2 to 8, between centers
    #[arg(long, value_name = "FILE", num_args = 0..=1, help_heading = "Agent and map")]
    #[arg(conflicts_with_all = ["costs", "inflation_radius", "radius"])]
    pub(crate) elevation: Option<Option<PathBuf>>,
    /// With --elevation, how fast one walks on a slope
    #[arg(long, value_enum, default_value_t, help_heading = "Agent and map", requires = "elevation")]
    pub(crate) pace: PaceName,
    /// With --elevation, a raster of the seconds that a meter takes in each cell beyond the pace, from 0 on
    #[arg(long, value_name = "FILE", help_heading = "Agent and map", requires = "elevation")]
    pub(crate) friction: Option<PathBuf>,
    /// With --elevation, the side of a cell in meters; needed where the raster does not state it
    #[arg(long, value_name = "M", help_heading = "Agent and map", allow_negative_numbers = true)]
    #[arg(value_parser = |text: &str| parse_amount(text, "meters"), requires = "elevation")]
    pub(crate) cell_size: Option<f64>,
}

/// A pace that has a name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum PaceName {
    /// Tobler's hiking function: 6 km/h gently downhill
    #[default]
    Tobler,
    /// Langmuir's walking times, as r.walk of GRASS has them: 5 km/h on the flat
    Langmuir,
}

impl PaceName {
    /// The pace.
    pub(crate) fn pace(self) -> Pace {
        match self {
            Self::Tobler => Pace::Tobler,
            Self::Langmuir => Pace::Langmuir(Langmuir::default()),
        }
    }
}

impl CostsArgs {
    /// The files that are read.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = &PathBuf> {
        self.costs.iter()
    }
}

impl WalkingArgs {
    /// The files that are read.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = &PathBuf> {
        self.elevation.iter().flatten().chain(&self.friction)
    }
}
