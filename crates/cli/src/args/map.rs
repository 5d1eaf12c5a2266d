//! The arguments that name a map, and the agent that moves on it.

use std::path::PathBuf;

use clap::Args;
use mediant::files::{Fraction, ImageOptions, Unknown};

use super::value::parse_amount;

#[derive(Args, Debug)]
pub(crate) struct MapArgs {
    /// A map: a MovingAI map, a PNG, PGM or PBM picture, the YAML file of a ROS map, or builtin:NAME
    /// (archipelago, cave, maze, town)
    pub(crate) map: PathBuf,

    /// The agent is a disc of this radius, in cells (with --world in meters): it keeps this distance to all
    /// obstacles
    #[arg(long, value_name = "R", help_heading = "Agent and map", allow_hyphen_values = true)]
    #[arg(value_parser = |text: &str| parse_amount(text, "cells"))]
    pub(crate) radius: Option<f64>,
    /// Coordinates and the radius are in meters, in the frame of a ROS map
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
}

impl MapArgs {
    /// How a picture becomes a map.
    pub(crate) fn image_options(&self) -> ImageOptions {
        let plain = ImageOptions::default();
        ImageOptions {
            threshold: self.threshold.unwrap_or(plain.threshold),
            invert: self.invert,
            unknown: if self.unknown_free { Unknown::Free } else { plain.unknown },
        }
    }
}
