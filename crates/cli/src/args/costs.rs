//! The argument that gives cells a cost.

use std::path::PathBuf;

use clap::Args;

#[derive(Args, Clone, Debug, Default)]
pub(crate) struct CostsArgs {
    /// Cells have a cost a unit of length: a raster with a number for each cell of the map (NPY, ESRI ASCII
    /// grid, GeoTIFF, PGM or PNG). Cells without data are blocked, too. Paths cost the sum of length times
    /// cost in each cell, with k = 2 to 8
    #[arg(long, value_name = "FILE", help_heading = "Agent and map")]
    pub(crate) costs: Option<PathBuf>,
    /// The band of a GeoTIFF with several, from 1
    #[arg(long, value_name = "N", help_heading = "Agent and map", allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) band: Option<u16>,
}
