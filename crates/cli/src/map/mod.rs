//! Maps and scenarios that the arguments name: from files, or bundled.

pub(crate) mod numbers;

use std::{
    fs::{self, File},
    io::Read,
    path::Path,
    sync::Arc,
};

use mediant::{
    Costs, Disc, K, Motion, PlacementKind, Point, Vertex, Walking,
    files::{Tiles, WorldFrame},
    grid::Grid,
};
use mediant_formats::{DynamicScenario, Georeference, Ground, MapFile, ReadError, Scenario, read_map};

use self::numbers::{Raster, is_surface};
use crate::{
    args::{MapArgs, Place, ReadingArgs},
    builtin::Builtin,
    check::file::{bytes, shown},
    draw::theme::Theme,
    failure::Failure,
    terminal::{message::say_warning, numbers::rounded},
};

/// A map with the name that reports give it.
#[derive(Clone)]
pub(crate) struct NamedMap {
    /// The file's name, without its folders.
    pub(crate) name: String,
    /// The map that is searched: the agent's.
    pub(crate) grid: Arc<Grid>,
    /// The map as it was read.
    pub(crate) ground: Arc<Grid>,
    /// The radius of the agent in cells; 0 for a point.
    pub(crate) radius: f64,
    pub(crate) theme: Theme,
    /// Where it is in the world, if its file says so and the arguments are in meters.
    pub(crate) frame: Option<WorldFrame>,
    /// Where it is in the world, if its file says so.
    pub(crate) place: Option<WorldFrame>,
    /// The characters of a MovingAI map, where they are needed: a byte a cell.
    tiles: Option<MapFile>,
    /// The agent's map with its obstacles, if it has a radius.
    pub(crate) disc: Option<Disc>,
    /// The costs of its cells, if they have any.
    pub(crate) costs: Option<Costs>,
    /// Their elevations and the pace, if they have any.
    pub(crate) walking: Option<Walking>,
    /// The raster that is its file, as long as its numbers are nothing.
    pub(crate) raster: Option<Raster>,
    /// Where the raster of these is on the earth, if its file says so.
    pub(crate) georeference: Option<Georeference>,
    /// The scenario, if the map is that of a scenario of a map that changes.
    pub(crate) scenario: Option<Arc<DynamicScenario>>,
}

impl NamedMap {
    /// The map without its characters.
    pub(crate) fn without_tiles(self) -> Self {
        Self { tiles: None, ..self }
    }

    /// Reads a map file, or parses the bundled map that `builtin:NAME` names, with the characters of a
    /// MovingAI map, to draw or to write them. It is not known yet what the numbers of a raster are, which is
    /// read as these arguments say.
    pub(crate) fn load_ground(args: &MapArgs, reading: ReadingArgs) -> Result<Self, Failure> {
        let options = args.options()?;
        if let Some(builtin) = Builtin::of_path(&args.map) {
            let map = Self::bundled(builtin?, options.tiles)?;
            return if args.world { Err(Failure::NoWorld { map: map.name }) } else { Ok(map) };
        }
        let name = file_name(&args.map);
        if is_surface(&args.map) {
            if args.world {
                return Err(Failure::RasterWorld { map: name });
            }
            if let Some(option) = args.tiles_option() {
                return Err(Failure::NoTiles { map: name, option });
            }
            return Self::of_raster(name, &args.map, reading);
        }
        let (grid, tiles, place, scenario) = match changing(&args.map)? {
            Some(scenario) => (scenario.grid(), None, None, Some(Arc::new(scenario))),
            None => {
                let source = read_map(&args.map, &options)?;
                (source.grid, source.tiles, source.frame, None)
            }
        };
        if let Some(option) = args.tiles_option().filter(|_| tiles.is_none()) {
            return Err(Failure::NoTiles { map: name, option });
        }
        if args.world && place.is_none() {
            return Err(Failure::NoWorld { map: name });
        }
        let frame = place.filter(|_| args.world);
        Ok(Self { frame, place, scenario, ..Self::new(name, Arc::new(grid), tiles, Theme::Plain) })
    }

    /// Parses a bundled map, of these tiles.
    pub(crate) fn bundled(builtin: &Builtin, tiles: Tiles) -> Result<Self, Failure> {
        let file = builtin.map(tiles)?;
        Ok(Self::new(builtin.map_name(), Arc::new(file.to_grid()), Some(file), builtin.theme))
    }

    fn new(name: String, grid: Arc<Grid>, tiles: Option<MapFile>, theme: Theme) -> Self {
        Self { tiles, theme, ..Self::plain(name, grid) }
    }

    /// A map of which nothing more is known.
    pub(crate) fn plain(name: String, grid: Arc<Grid>) -> Self {
        Self {
            name,
            ground: Arc::clone(&grid),
            grid,
            radius: 0.0,
            theme: Theme::Plain,
            frame: None,
            place: None,
            tiles: None,
            disc: None,
            costs: None,
            walking: None,
            raster: None,
            georeference: None,
            scenario: None,
        }
    }

    /// Whether it is a MovingAI map that was loaded [with its characters](Self::load_with_tiles).
    pub(crate) fn has_tiles(&self) -> bool {
        self.tiles.is_some()
    }

    /// The map on which the cells of all grounds of a MovingAI map are free. It knows the radius of the
    /// agent, but not where it fits, which depends on the ground.
    pub(crate) fn on_all_grounds(self, args: &MapArgs) -> Result<Self, Failure> {
        let Some(tiles) = &self.tiles else {
            return Err(Failure::NoTiles { map: self.name, option: "--grounds" });
        };
        let grid =
            Grid::from_fn(tiles.width(), tiles.height(), |x, y| tiles.ground(x as i32, y as i32).is_none());
        let grid = Arc::new(grid.map_err(mediant::Error::from)?);
        let radius = args.radius.map_or(0.0, |radius| self.cells(radius));
        Ok(Self { ground: Arc::clone(&grid), grid, radius, ..self })
    }

    /// The ground of a MovingAI map that somebody stands on at a vertex: that of its own cell, else that of
    /// the first of the other cells around it at corners, else land.
    pub(crate) fn ground_at(&self, placement: PlacementKind, at: Point) -> Ground {
        // A point between vertices stands on the cell that it is in.
        let at = match (placement, at.vertex()) {
            (_, Some(at)) => at,
            (PlacementKind::Center, None) => at.at_corners().floor(),
            (PlacementKind::Corner, None) => at.floor(),
        };
        let around: &[(i32, i32)] = match placement {
            PlacementKind::Center => &[(0, 0)],
            PlacementKind::Corner => &[(0, 0), (-1, 0), (0, -1), (-1, -1)],
        };
        let tiles = self.tiles.as_ref();
        let ground = |&(dx, dy): &(i32, i32)| tiles?.ground(at.x.checked_add(dx)?, at.y.checked_add(dy)?);
        around.iter().find_map(ground).unwrap_or(Ground::Land)
    }

    /// The map of one ground, on which all others are blocked.
    pub(crate) fn on_ground(&self, ground: Ground) -> Result<Self, Failure> {
        let Some(tiles) = &self.tiles else {
            return Err(Failure::NoTiles { map: self.name.clone(), option: "--grounds" });
        };
        let tiles = MapFile::from_bytes(tiles.as_bytes().to_vec(), ground.tiles());
        let tiles = tiles.map_err(|source| ReadError::Map { path: self.name.clone().into(), source })?;
        let grid = Arc::new(tiles.to_grid());
        Ok(Self { ground: Arc::clone(&grid), grid, tiles: Some(tiles), ..self.clone() })
    }

    /// The map for the agent that the arguments name, which moves like this.
    pub(crate) fn for_agent(mut self, args: &MapArgs, motion: Motion) -> Result<Self, Failure> {
        if let Some(radius) = args.radius {
            self.refuse_on_costs("--radius", true)?;
            self.radius = self.cells(radius);
            let disc = mediant::Map::from(Arc::clone(&self.ground)).disc(self.radius, motion)?;
            self.grid = Arc::clone(disc.map().grid());
            self.disc = Some(disc);
            if self.radius > 0.0 && self.grid == self.ground {
                say_warning(&self.radius_without_effect());
            }
        }
        Ok(self)
    }

    /// The warning about a disc that fits wherever a point may be, as half a cell and less does between
    /// centers: somebody who asks for one may have meant meters.
    fn radius_without_effect(&self) -> String {
        let advice = match (self.place, self.frame) {
            (Some(_), None) => "; with --world it is in meters",
            _ => "",
        };
        format!(
            "a radius of {:.4} cells changes nothing: such a disc fits wherever a point may be{advice}",
            self.radius
        )
    }

    /// Takes the maps after an edit: of the obstacles, and that of the agent. The file's characters are of
    /// the past then.
    pub(crate) fn take_edited(&mut self, ground: &Arc<Grid>, grid: &Arc<Grid>) {
        (self.ground, self.grid, self.tiles) = (Arc::clone(ground), Arc::clone(grid), None);
    }

    /// The map as the library searches it.
    pub(crate) fn to_library(&self) -> mediant::Map {
        mediant::Map::from(Arc::clone(&self.grid))
    }

    /// A length of the command line in cells.
    pub(crate) fn cells(&self, length: f64) -> f64 {
        self.frame.map_or(length, |frame| frame.cells(length))
    }

    /// The map's characters: those of its file, or `.` and `@`.
    pub(crate) fn tiles(&self) -> MapFile {
        self.tiles.clone().unwrap_or_else(|| MapFile::from_grid(&self.ground))
    }

    /// All cells, row by row.
    pub(crate) fn cells_by_row(&self) -> impl Iterator<Item = (i32, i32)> + use<> {
        let (width, height) = (self.grid.width() as i32, self.grid.height() as i32);
        (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
    }

    /// The end of a path at a place of the command line: a vertex, at any angle any point.
    pub(crate) fn end(&self, motion: Motion, place: Place) -> Result<Point, Failure> {
        let placement = motion.rules.placement();
        if motion.k != K::Any {
            return Ok(self.vertex(placement, place)?.into());
        }
        let (x, y) = place.point();
        let at = match (self.frame, place) {
            (None, Place::Vertex(at)) => Some(at.into()),
            (None, Place::Point(x, y)) => Point::nearest(x, y),
            (Some(frame), _) => frame.place_at(placement, x, y),
        };
        at.ok_or_else(|| self.outside(x, y))
    }

    /// The error for a place outside the map.
    fn outside(&self, x: f64, y: f64) -> Failure {
        let Some(frame) = self.frame else { return Failure::NoVertex { x, y } };
        let corners = [(0, frame.height()), (frame.width(), 0)];
        let corners =
            corners.map(|(x, y)| frame.point_of(PlacementKind::Corner, Vertex::new(x as i32, y as i32)));
        Failure::OutsideWorld { x, y, corners }
    }

    /// The vertex at a place of the command line.
    pub(crate) fn vertex(&self, placement: PlacementKind, place: Place) -> Result<Vertex, Failure> {
        match (self.frame, place) {
            (None, Place::Vertex(at)) => Ok(at),
            (None, Place::Point(x, y)) => {
                Point::nearest(x, y).and_then(Point::vertex).ok_or(Failure::NoVertex { x, y })
            }
            (Some(frame), place) => {
                let (x, y) = place.point();
                frame.vertex_at(placement, x, y).ok_or_else(|| self.outside(x, y))
            }
        }
    }

    /// The greatest distance of places of the world from the [ends](Self::end) of paths there, in meters;
    /// `None` without `--world`.
    pub(crate) fn moved(
        &self,
        placement: PlacementKind,
        places: &[Place],
        at: &[impl Into<Point> + Copy],
    ) -> Option<f64> {
        let frame = self.frame?;
        let moved = places.iter().zip(at).map(|(place, &at)| {
            let ((x, y), (to_x, to_y)) = (place.point(), frame.point_of(placement, at));
            rounded((to_x - x).hypot(to_y - y))
        });
        Some(moved.fold(0.0, f64::max))
    }
}

/// Reads a scenario file, or parses that of the bundled map that `builtin:NAME` names. Returns the name that
/// reports give it, too.
pub(crate) fn load_scenario(path: &Path) -> Result<(String, Scenario), Failure> {
    match Builtin::of_path(path) {
        None if path == Path::new("-") => {
            let wrong = |source| ReadError::Scenario { path: shown(path), source };
            Ok(("stdin".to_owned(), Scenario::from_bytes(bytes(path)?).map_err(wrong)?))
        }
        None => Ok((file_name(path), Scenario::read(path)?)),
        Some(builtin) => {
            let builtin = builtin?;
            Ok((builtin.scenario_name(), builtin.scenario()?))
        }
    }
}

/// The scenario of a map that changes in a file; `None` for other files.
fn changing(path: &Path) -> Result<Option<DynamicScenario>, Failure> {
    // Opening a pipe may never return.
    if !fs::metadata(path).is_ok_and(|metadata| metadata.is_file()) {
        return Ok(None);
    }
    let mut first = Vec::new();
    let read = File::open(path).and_then(|file| file.take(64).read_to_end(&mut first));
    if read.is_err() || !DynamicScenario::is_one(&first) {
        return Ok(None);
    }
    Ok(Some(DynamicScenario::read(path)?))
}

/// The last part of a path. It may hold control characters.
pub(crate) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
