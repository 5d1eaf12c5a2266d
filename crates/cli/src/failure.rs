//! The end of the program: its exit status, and its message if it failed.

use std::{io, path::PathBuf, process::ExitCode};

use mediant::{
    Vertex,
    call::CallError,
    errors::{CostsError, SetupError},
};
use mediant_formats::{MapMismatch, PictureError, ReadError, RosError, SurfaceError, TilesError, WriteError};

use crate::terminal::message::say_error;

/// Exit status 1: some query could not be answered, or some path does not hold.
const QUERY_ERROR: u8 = 1;
/// Exit status 2: bad arguments, or a file that cannot be read.
pub(crate) const FAILURE: u8 = 2;

/// Exit status 3: with `--require-path`, some query has no path.
const NO_PATH: u8 = 3;

/// The end of a command that could do what it was asked to.
#[derive(Debug)]
pub(crate) enum Ending {
    /// Every query was answered, if only by 'there is no path'.
    Answered,
    /// Some query could not be answered; this says why.
    QueryErrors(String),
    /// Some path does not hold; the output says which.
    BrokenPaths,
    /// Some query has no path, and paths were required; this says how many.
    NoPaths(String),
}

/// Why a command cannot do what it was asked to.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    #[error(transparent)]
    Read(#[from] ReadError),
    #[error("there is no command `{name}`; there are {known}")]
    NoCommand { name: String, known: String },
    #[error(transparent)]
    OtherMap(#[from] MapMismatch),
    #[error(
        "the scenario is for the map `{expected}` and does not fit `{found}`, where the {end} {at} of \
         instance {index} is blocked; give the map that it was made for, under that name"
    )]
    MisfitScenario { expected: String, found: String, end: mediant::search::End, at: Vertex, index: usize },
    #[error("there is no bundled map `{name}`; there are {known}")]
    NoSuchMap { name: String, known: String },
    #[error("the map {map} has no place in the world: leave --world out, or give the YAML file of a ROS map")]
    NoWorld { map: String },
    #[error(
        "{map} is a raster, on which places are columns and rows of cells: leave --world out, and count them \
         from 0, from the left and from the top"
    )]
    RasterWorld { map: String },
    #[error("the map {map} has no characters for tiles: leave {option} out, or give a MovingAI map")]
    NoTiles { map: String, option: &'static str },
    #[error(transparent)]
    Surface(SurfaceError),
    #[error("{option} is for a raster of costs or elevations: leave it out, or give one")]
    NoRaster { option: &'static str },
    #[error("back links of ArcGIS are for k = 2 and 3, not for k = {k}: choose --directions degrees")]
    BackLinks { k: mediant::K },
    #[error(
        "--from cannot be used with --to but for the paths between them: leave one of the two out, or give --corridor"
    )]
    NoCorridor,
    #[error("{option} does not go with costs: leave it out, or leave the costs out")]
    NotOnCosts { option: &'static str },
    #[error("{option} does not go with --elevation: leave one of the two out")]
    NotOverElevation { option: &'static str },
    #[error("{}: {source}{}", path.display(), cure(source))]
    Numbers { path: PathBuf, source: Box<mediant::Error> },
    #[error("{option} {} for {map}, whose cells have numbers of their own: leave one of the two out", path.display())]
    TwoNumbers { option: &'static str, path: PathBuf, map: String },
    #[error(
        "the cells of {map} have no numbers: give --elevation a FILE, or a raster of elevations as the map"
    )]
    NoElevation { map: String },
    #[error("{}: it does not say how large a cell is: give --cell-size METERS", path.display())]
    NoCellSize { path: PathBuf },
    #[error("{}: it says how large a cell is: leave --cell-size out", path.display())]
    HasCellSize { path: PathBuf },
    #[error(
        "the cells of {map} have no costs: give --costs FILE or --inflation-radius R, or choose a format for maps"
    )]
    NoNumbers { map: String },
    #[error(
        "{}: its paths are on the grounds of a MovingAI map, and {map} has none: give the map that they were \
         made on", path.display()
    )]
    NoGrounds { path: PathBuf, map: String },
    #[error(transparent)]
    Tiles(#[from] TilesError),
    #[error("({x}, {y}) is no vertex: write whole numbers, such as 3,14, or --k any, or meters with --world")]
    NoVertex { x: f64, y: f64 },
    #[error(
        "({x}, {y}) is outside the map, which lies between ({:.3}, {:.3}) and ({:.3}, {:.3}) in the world",
        corners[0].0, corners[0].1, corners[1].0, corners[1].1
    )]
    OutsideWorld { x: f64, y: f64, corners: [(f64, f64); 2] },
    #[error("no queries: give --scen FILE, --pairs FILE, --edits FILE, or --from X,Y and --to X,Y")]
    NoQueries,
    #[error("{}: no pair in it: write a line x1,y1,x2,y2 for each query", path.display())]
    NoPairs { path: PathBuf },
    #[error(
        "{}: nothing in it: write a line {{\"type\":\"query\",\"start\":[x,y],\"goal\":[x,y]}} for each query, and \
         {{\"type\":\"edit\",\"x\":x,\"y\":y,\"rows\":[\"..#\"]}} for each edit", path.display()
    )]
    NoEvents { path: PathBuf },
    #[error("the scenario `{scenario}` has no instance: is it cut short?")]
    NoInstances { scenario: String },
    #[error("{}{}", if .0.parameter().is_some() { "--" } else { "" }, .0)]
    Call(#[from] CallError),
    #[error(transparent)]
    Setup(#[from] SetupError),
    #[error("{}", in_words(.0))]
    Library(#[from] mediant::Error),
    #[error(transparent)]
    Write(#[from] WriteError),
    #[error("{}: expected a name that ends in {known}", path.display())]
    Extension { path: PathBuf, known: &'static str },
    #[error(transparent)]
    Picture(#[from] PictureError),
    #[error("{}: line {line}: {problem}", path.display())]
    PathFile { path: PathBuf, line: usize, problem: String },
    #[error(
        "{}: no path in it: give what `mediant run --format jsonl` prints of queries that have one, or a CSV \
         with the columns x and y",
        path.display()
    )]
    NoPaths { path: PathBuf },
    #[error(
        "the map {map} has no place in the world: give --resolution METERS, the side of a cell, or choose \
         another format"
    )]
    NoResolution { map: String },
    #[error("{option} is for a ROS map: leave it out, or give -o a name that ends in .yaml")]
    NoRosMap { option: &'static str },
    #[error("{}: would be overwritten, and the map is read from it: choose another name", path.display())]
    SameFile { path: PathBuf },
    #[error("{}: {source}", path.display())]
    RosMap { path: PathBuf, source: RosError },
    #[error("--draw shows a single query: give --from and --to, or --limit 1")]
    DrawMany,
    #[error("--draw on the screen goes with --format table alone: give it a FILE, or choose that format")]
    DrawAmongLines,
    #[error("--trace follows a single query: give --from and --to, or --limit 1")]
    TraceMany,
    #[error("--trace follows a single search: give --from and --to once")]
    TraceEnds,
    #[error("--distances begin at one vertex: give --from once")]
    DistancesEnds,
    #[error("no {ends}: give {option} X,Y, or {option}-file a file with one x,y a line")]
    NoEnds { ends: &'static str, option: &'static str },
    #[error("--distance is for one start and one goal: for several there is mediant table")]
    DistanceEnds,
    #[error(
        "give --k or --neighbors to list the moves of a neighborhood, --ratio to find the smallest k for a bound, \
         or both"
    )]
    NoK,
    #[error(transparent)]
    K(#[from] mediant::moves::KError),
    #[error("cannot write the output: {0}")]
    Output(#[from] io::Error),
}

/// An error of the library, whose cure may be an option here.
fn in_words(error: &mediant::Error) -> String {
    match error {
        mediant::Error::Freed { cell } => format!(
            "cell {cell} is blocked and has no cost, so that it cannot be freed: leave --unblock and --free-ends \
             out, or give it a cost in the raster"
        ),
        error => error.to_string(),
    }
}

/// The cure for the numbers of a raster, beyond what the library knows of it.
fn cure(error: &mediant::Error) -> &'static str {
    match error {
        mediant::Error::Costs(CostsError::Cost { .. }) => {
            ": in a raster it has no data (NaN in NPY, or --no-data VALUE); for heights there is --elevation"
        }
        _ => "",
    }
}

/// Writes what failed on stderr, and returns the exit status. If the reader of stdout has left (`| head`),
/// nothing failed.
pub(crate) fn finish(ending: Result<Ending, Failure>) -> ExitCode {
    match ending {
        Ok(Ending::Answered) => ExitCode::SUCCESS,
        Ok(Ending::QueryErrors(text)) => {
            say_error(&text);
            ExitCode::from(QUERY_ERROR)
        }
        Ok(Ending::BrokenPaths) => ExitCode::from(QUERY_ERROR),
        Ok(Ending::NoPaths(text)) => {
            say_error(&text);
            ExitCode::from(NO_PATH)
        }
        Err(Failure::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(failure) => {
            say_error(&failure.to_string());
            ExitCode::from(FAILURE)
        }
    }
}
