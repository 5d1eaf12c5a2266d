//! Numbers of cells: costs, elevations, and costs around obstacles.

use std::{
    fs::{self, File},
    io::Read,
    path::{Path, PathBuf},
    sync::Arc,
};

use mediant::{Costmap, Costs, Error, Inflation, Motion, Space, Walking};
use mediant_formats::{Georeference, Surface, SurfaceFormat, SurfaceOptions, read_surface, surface_size};

use super::NamedMap;
use crate::{
    args::{CostsArgs, InflationArgs, MapArgs, ReadingArgs, WalkingArgs},
    failure::Failure,
};

/// A raster that is the map's file.
#[derive(Clone)]
pub(crate) struct Raster {
    path: PathBuf,
    pub(crate) surface: Arc<Surface>,
}

impl NamedMap {
    /// The map of a raster: cells without data are blocked. Its numbers are nothing yet.
    pub(super) fn of_raster(name: String, path: &Path, reading: ReadingArgs) -> Result<Self, Failure> {
        let surface = read_costs(path, reading)?;
        let map = mediant::Map::with_data(&surface).map_err(|error| in_file(path, error))?;
        let raster = Some(Raster { path: path.to_owned(), surface: Arc::new(surface) });
        Ok(Self { raster, ..Self::plain(name, Arc::clone(map.grid())) })
    }

    /// The map with the costs of its own raster, if it is one.
    pub(crate) fn with_own_costs(mut self) -> Result<Self, Failure> {
        match self.raster.take() {
            Some(Raster { path, surface }) => self.with_surface(&path, &surface),
            None => Ok(self),
        }
    }

    /// The map with the costs or the elevations that the arguments name, if they do.
    pub(crate) fn with_numbers(
        mut self,
        map: &MapArgs,
        costs: &CostsArgs,
        walking: &WalkingArgs,
    ) -> Result<Self, Failure> {
        let Some(elevation) = &walking.elevation else { return self.with_costs(map, costs) };
        let own = self.raster.take();
        let (path, surface) = match (elevation, own) {
            (Some(path), None) => (path.clone(), Arc::new(read_costs(path, costs.reading)?)),
            (None, Some(Raster { path, surface })) => (path, surface),
            (Some(path), Some(_)) => {
                let (option, path) = ("--elevation", path.clone());
                return Err(Failure::TwoNumbers { option, path, map: self.name });
            }
            (None, None) => return Err(Failure::NoElevation { map: self.name }),
        };
        if self.disc.is_some() {
            return Err(Failure::NotOnCosts { option: "--radius" });
        }
        let surface = match (surface.cell_size(), walking.cell_size) {
            (None, None) => return Err(Failure::NoCellSize { path }),
            (Some(_), Some(_)) => return Err(Failure::HasCellSize { path }),
            (None, Some(side)) => {
                let place = Georeference::from_cell_size(side, side).map_err(Failure::Surface)?;
                Arc::new(Surface::clone(&surface).with_georeference(place))
            }
            (Some(_), None) => surface,
        };
        let friction = walking
            .friction
            .as_ref()
            .map(|path| Ok::<_, Failure>((path, read_costs(path, ReadingArgs::default())?)));
        let friction = friction.transpose()?;
        let (map, pace) = (self.to_library(), walking.pace.pace());
        let plain = map.walking_of(&surface, None, &pace).map_err(|error| in_file(&path, error))?;
        let walking = match &friction {
            None => plain,
            Some((path, friction)) => {
                map.walking_of(&surface, Some(friction), &pace).map_err(|error| in_file(path, error))?
            }
        };
        let georeference = Some(surface.georeference().clone());
        let grid = Arc::clone(walking.map().grid());
        Ok(Self { ground: Arc::clone(&grid), grid, walking: Some(walking), georeference, ..self })
    }

    /// The map with the costs that the arguments name, if they do.
    pub(crate) fn with_costs(self, map: &MapArgs, args: &CostsArgs) -> Result<Self, Failure> {
        let of_raster = self.raster.is_some();
        if let Some(option) = args.reading.given().filter(|_| !of_raster && args.costs.is_none()) {
            return Err(Failure::NoRaster { option });
        }
        let own = self.with_own_costs()?;
        match (&args.costs, args.inflation.inflation_radius) {
            (Some(path), _) if of_raster => {
                Err(Failure::TwoNumbers { option: "--costs", path: path.clone(), map: own.name })
            }
            (Some(path), _) => own.with_surface(path, &read_costs(path, args.reading)?),
            (None, Some(_)) if of_raster => Err(Failure::NotOnCosts { option: "--inflation-radius" }),
            (None, Some(radius)) => own.inflated(map, &args.inflation, radius),
            (None, None) => Ok(own),
        }
    }

    /// The map with the costs of a raster.
    fn with_surface(self, path: &Path, surface: &Surface) -> Result<Self, Failure> {
        let costs = self.to_library().costs_of(surface).map_err(|error| in_file(path, error))?;
        self.on(costs, Some(surface.georeference().clone()))
    }

    /// The map with costs, whose blocked cells count.
    fn on(self, costs: Costs, georeference: Option<Georeference>) -> Result<Self, Failure> {
        if self.disc.is_some() {
            return Err(Failure::NotOnCosts { option: "--radius" });
        }
        let grid = Arc::clone(costs.map().grid());
        Ok(Self { ground: Arc::clone(&grid), grid, costs: Some(costs), georeference, ..self })
    }

    /// The map with costs around its obstacles; those of a ROS map are costs already where it has shades.
    fn inflated(self, args: &MapArgs, by: &InflationArgs, radius: f64) -> Result<Self, Failure> {
        let costmap = match self.place {
            Some(_) => Costmap::open_with(&args.map, &args.options()?)?.0,
            None => Costmap::from(&self.to_library()),
        };
        let inscribed = by.inscribed_radius.unwrap_or(0.0);
        // Beyond that distance less than 1 of 252 would be left.
        let falling = if radius > inscribed { 252.0_f64.ln() / (radius - inscribed) } else { 0.0 };
        let inflation = Inflation {
            resolution: self.frame.map_or(1.0, |frame| frame.resolution()),
            inscribed_radius: inscribed,
            inflation_radius: radius,
            cost_scaling_factor: by.cost_scaling_factor.unwrap_or(falling),
            ..Inflation::default()
        };
        let costs = costmap.inflated(&inflation)?.costs(by.weight.unwrap_or(DEFAULT_WEIGHT))?;
        let place = self.place.map(|place| {
            let ([x, y, yaw], side) = (place.origin(), (place.resolution(), place.resolution()));
            match yaw == 0.0 {
                true => Georeference::from_lower_left(side, (x, y)),
                false => Georeference::from_cell_size(side.0, side.1),
            }
        });
        let place = place.transpose().map_err(Failure::Surface)?;
        self.on(costs, place)
    }

    /// The search space of the map, or of its numbers.
    pub(crate) fn space(&self, motion: Motion) -> Result<Space, Error> {
        match (&self.costs, &self.walking) {
            (Some(costs), _) => costs.space(motion),
            (None, Some(walking)) => walking.space(motion),
            (None, None) => self.to_library().space(motion),
        }
    }

    /// Whether paths have costs, or times.
    pub(crate) const fn has_costs(&self) -> bool {
        self.costs.is_some() || self.walking.is_some()
    }

    /// The bounds of the costs of a cell a unit of length, or of the times.
    pub(crate) fn cost_bounds(&self) -> Option<(f64, f64)> {
        let times = || self.walking.as_ref().map(Walking::bounds);
        self.costs.as_ref().map(Costs::bounds).or_else(times)
    }

    /// Refuses an option that has no meaning on costs, if it was given.
    pub(crate) fn refuse_on_costs(&self, option: &'static str, is_given: bool) -> Result<(), Failure> {
        if self.has_costs() && is_given { Err(Failure::NotOnCosts { option }) } else { Ok(()) }
    }
}

/// The weight of the bytes of a costmap where none is given.
const DEFAULT_WEIGHT: f64 = 2.0;

/// Whether a map's file is a raster of numbers. A picture is a map of shades.
pub(crate) fn is_surface(path: &Path) -> bool {
    let mut first = Vec::new();
    // Opening a pipe may never return.
    let is_file = fs::metadata(path).is_ok_and(|metadata| metadata.is_file());
    let is_read = is_file && File::open(path).and_then(|file| file.take(64).read_to_end(&mut first)).is_ok();
    let is_kind =
        |kind| matches!(kind, SurfaceFormat::Npy | SurfaceFormat::EsriAscii | SurfaceFormat::GeoTiff);
    is_read && SurfaceFormat::of(&first).is_some_and(is_kind)
}

/// Reads a raster of numbers.
pub(crate) fn read(path: &Path, reading: ReadingArgs) -> Result<Surface, Failure> {
    let options = SurfaceOptions { band: reading.band, ..SurfaceOptions::default() };
    let surface = read_surface(path, &options)?;
    Ok(match reading.no_data {
        None => surface,
        no_data => surface.with_no_data(no_data),
    })
}

/// Reads a raster whose numbers become those of a map, unless its header states more than there is room for.
fn read_costs(path: &Path, reading: ReadingArgs) -> Result<Surface, Failure> {
    let (width, height) = surface_size(path)?;
    Costs::check_size(width, height).map_err(|error| in_file(path, error))?;
    read(path, reading)
}

/// The error of the numbers in a file.
fn in_file(path: &Path, source: Error) -> Failure {
    Failure::Numbers { path: path.to_owned(), source: source.into() }
}
