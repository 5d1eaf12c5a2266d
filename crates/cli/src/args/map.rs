//! The arguments that name a map, and the agent that moves on it.

use std::path::PathBuf;

use clap::Args;
use mediant::files::{Fraction, MapOptions, RosVersion, Tiles, Unknown};

use super::value::parse_amount;
use crate::failure::Failure;

#[derive(Args, Debug)]
pub(crate) struct MapArgs {
    /// A map: a MovingAI map, a PNG, PGM or PBM picture, the YAML file of a ROS map, a raster of numbers
    /// (NPY, ESRI ASCII grid, GeoTIFF), whose cells cost that much, a scenario of a map that changes (version
    /// 2), or builtin:NAME (archipelago, cave, maze, town)
    pub(crate) map: PathBuf,

    /// The agent is a disc of this radius, in cells (with --world in meters): it keeps this distance to all
    /// obstacles
    #[arg(long, value_name = "R", help_heading = "Agent and map", allow_hyphen_values = true)]
    #[arg(value_parser = |text: &str| parse_amount(text, "cells"))]
    pub(crate) radius: Option<f64>,
    /// Coordinates and the radius are in meters, in the frame of a ROS map. Ends are moved to the nearest
    /// vertex, and it is said how far
    #[arg(long, help_heading = "Agent and map")]
    pub(crate) world: bool,
    /// In a picture, pixels darker than this fraction are blocked; in a ROS map of mode scale or raw, cells
    /// that are occupied to more than 1 − this fraction [default: 0.5]
    #[arg(long, value_name = "FRACTION", help_heading = "Agent and map")]
    #[arg(value_parser = |text: &str| text.parse::<Fraction>().map_err(|error| error.to_string()))]
    pub(crate) threshold: Option<Fraction>,
    /// In a picture, bright pixels are blocked instead of dark ones
    #[arg(long, help_heading = "Agent and map")]
    pub(crate) invert: bool,
    /// Unknown cells (of a ROS map, or transparent pixels) are free
    #[arg(long, help_heading = "Agent and map")]
    pub(crate) unknown_free: bool,
    /// The picture of a ROS map is read as by the map_server of ROS 2 (nav2 since 2025), or as by that of ROS
    /// 1 [default: 2]
    #[arg(long, value_name = "1|2", help_heading = "Agent and map", allow_negative_numbers = true)]
    #[arg(value_parser = parse_ros)]
    pub(crate) ros: Option<RosVersion>,
    /// In a MovingAI map, the characters of free cells, for example W; all others are blocked. Small letters
    /// count as capitals [default: .GS]
    #[arg(long, value_name = "TILES", help_heading = "Agent and map", allow_hyphen_values = true)]
    pub(crate) free: Option<String>,
    /// In a MovingAI map, the characters of blocked cells; all others are free, or with --free an error
    /// [default: @OTW#]
    #[arg(long, value_name = "TILES", help_heading = "Agent and map", allow_hyphen_values = true)]
    pub(crate) blocked: Option<String>,
}

/// The version of ROS.
fn parse_ros(text: &str) -> Result<RosVersion, String> {
    match text {
        "1" => Ok(RosVersion::Ros1),
        "2" => Ok(RosVersion::Ros2),
        _ => Err("expected 1 or 2".to_owned()),
    }
}

impl MapArgs {
    /// The options for reading the map file.
    pub(crate) fn options(&self) -> Result<MapOptions, Failure> {
        let plain = MapOptions::default();
        Ok(MapOptions {
            threshold: self.threshold.unwrap_or(plain.threshold),
            invert: self.invert,
            unknown: if self.unknown_free { Unknown::Free } else { plain.unknown },
            ros: self.ros.unwrap_or(plain.ros),
            tiles: Tiles::new(self.free.as_deref(), self.blocked.as_deref())?,
        })
    }

    /// The option that says which characters are free, if one does.
    pub(crate) const fn tiles_option(&self) -> Option<&'static str> {
        match (&self.free, &self.blocked) {
            (Some(_), _) => Some("--free"),
            (None, Some(_)) => Some("--blocked"),
            (None, None) => None,
        }
    }
}
