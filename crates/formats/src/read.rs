//! Reads files from disk.

use std::{
    fs::{self, File},
    io::{self, Read},
    path::{Path, PathBuf},
};

use mediant_grid::{Grid, GridError, Interrupt, Interrupted};

#[cfg(feature = "surface")]
use crate::SurfaceError;
#[cfg(feature = "index")]
use crate::index::error::IndexError;
use crate::{
    dynamic::error::{DynamicError, PatchError},
    map::error::MapError,
    raster::error::RasterError,
    ros::error::RosError,
    scenario::error::ScenarioError,
};

/// The size of the largest file that is read, in bytes: twice that of the largest map, of [`Grid::MAX_SIDE`]
/// rows and columns.
///
/// [`Grid::MAX_SIDE`]: mediant_grid::Grid::MAX_SIDE
pub const MAX_FILE_BYTES: u64 = 2 << 30;

/// The bytes between two questions to an interrupt.
pub(crate) const PIECE: usize = 1 << 20;

/// A file that cannot be read or parsed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// There is no such file.
    #[error("{}: no such file; check the path and the folder that you are in", path.display())]
    Missing {
        /// The file that was asked for.
        path: PathBuf,
    },
    /// The path names a directory.
    #[error("{}: expected a file, found a directory; name a file in it", path.display())]
    Directory {
        /// The path that was asked for.
        path: PathBuf,
    },
    /// The path names a device, a pipe or a socket.
    #[error("{}: expected a regular file, found a device or pipe; save its content to a file first", path.display())]
    NotRegular {
        /// The path that was asked for.
        path: PathBuf,
    },
    /// The file is longer than [`MAX_FILE_BYTES`].
    #[error(
        "{}: expected at most {MAX_FILE_BYTES} bytes, found more; is this the file that you meant?",
        path.display()
    )]
    TooLarge {
        /// The file that was asked for.
        path: PathBuf,
    },
    /// The operating system refuses to read the file, or there is not enough memory for it.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The file that was asked for.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// The file is no map.
    #[error("{}: {source}", path.display())]
    Map {
        /// The file.
        path: PathBuf,
        /// The fault in the file.
        source: MapError,
    },
    /// The file is no picture.
    #[error("{}: {source}", path.display())]
    Raster {
        /// The file.
        path: PathBuf,
        /// The fault in the file.
        source: RasterError,
    },
    /// The file is no YAML file of a ROS map.
    #[error("{}: {source}", path.display())]
    Ros {
        /// The file.
        path: PathBuf,
        /// The fault in the file.
        source: RosError,
    },
    /// The picture that the YAML file of a ROS map names cannot be read.
    #[error("{}: the picture that the key `image` names: {source}", path.display())]
    RosImage {
        /// The YAML file.
        path: PathBuf,
        /// The error of the picture.
        source: Box<ReadError>,
    },
    /// The file is none of the kinds of maps, by its content and by its name.
    #[error(
        "{}: expected a map, a MovingAI `.map`, a PNG, PGM or PBM, or the YAML file of a ROS map, found \
         {found}; is this the file that you meant? Convert other pictures to PNG", path.display()
    )]
    NoMap {
        /// The file.
        path: PathBuf,
        /// How it begins, quoted.
        found: String,
    },
    /// The file is no scenario.
    #[error("{}: {source}", path.display())]
    Scenario {
        /// The file.
        path: PathBuf,
        /// The fault in the file.
        source: ScenarioError,
    },
    /// The file is no scenario of a map that changes.
    #[error("{}: {source}", path.display())]
    Dynamic {
        /// The file.
        path: PathBuf,
        /// The fault in the file.
        source: DynamicError,
    },
    /// The file that a scenario of a map that changes names has no patches.
    #[error("{}: {source}", path.display())]
    Patches {
        /// The file.
        path: PathBuf,
        /// The fault in the file.
        source: PatchError,
    },
    /// The file is no index. Needs the feature `index`.
    #[cfg(feature = "index")]
    #[error("{}: {source}", path.display())]
    Index {
        /// The file.
        path: PathBuf,
        /// The fault in the file.
        // An error that can name two maps is large, and all that read files return this one.
        source: Box<IndexError>,
    },
    /// The file is no raster of numbers. Needs the feature `surface`.
    #[cfg(feature = "surface")]
    #[error("{}: {source}", path.display())]
    Surface {
        /// The file.
        path: PathBuf,
        /// The fault in the file.
        source: Box<SurfaceError>,
    },
    /// An interrupt stopped the reading.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

impl ReadError {
    /// This error of the picture in a file.
    pub(crate) fn of_raster(path: &Path, error: RasterError) -> Self {
        match error {
            RasterError::Interrupted(interrupted) => interrupted.into(),
            source => Self::Raster { path: path.to_owned(), source },
        }
    }

    /// This error of the map in a file.
    pub(crate) fn of_map(path: &Path, error: MapError) -> Self {
        match error {
            MapError::Interrupted(interrupted) => interrupted.into(),
            source => Self::Map { path: path.to_owned(), source },
        }
    }

    /// This error of the raster of numbers in a file.
    #[cfg(feature = "surface")]
    pub(crate) fn of_surface(path: &Path, error: SurfaceError) -> Self {
        let path = path.to_owned();
        match error {
            SurfaceError::Interrupted(interrupted) => interrupted.into(),
            SurfaceError::Io(source) => Self::Unreadable { path, source },
            source => Self::Surface { path, source: Box::new(source) },
        }
    }

    /// This error of the picture that a YAML file names.
    pub(crate) fn of_image(self, yaml: &Path) -> Self {
        match self {
            Self::Interrupted(interrupted) => interrupted.into(),
            source => Self::RosImage { path: yaml.to_owned(), source: Box::new(source) },
        }
    }
}

/// The bytes of a regular file.
pub(crate) fn read_regular(path: &Path) -> Result<Vec<u8>, ReadError> {
    read_regular_interruptible(path, &Interrupt::NEVER)
}

/// [`read_regular`], which an interrupt can stop; it asks for each mebibyte.
pub(crate) fn read_regular_interruptible(path: &Path, interrupt: &Interrupt) -> Result<Vec<u8>, ReadError> {
    let unreadable = |source: io::Error| ReadError::Unreadable { path: path.to_owned(), source };
    let (file, length) = open_regular(path)?;
    if length > MAX_FILE_BYTES {
        return Err(ReadError::TooLarge { path: path.to_owned() });
    }
    let mut bytes = Vec::new();
    // MAX_FILE_BYTES + 1 fits in 32 bits. The extra byte is for the read that finds the end of the file.
    bytes.try_reserve_exact(length as usize + 1).map_err(|error| unreadable(error.into()))?;
    // The file may have grown since: one byte too many tells.
    let mut file = file.take(MAX_FILE_BYTES + 1);
    loop {
        interrupt.check("reading the file")?;
        if file.by_ref().take(PIECE as u64).read_to_end(&mut bytes).map_err(unreadable)? == 0 {
            break;
        }
    }
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(ReadError::TooLarge { path: path.to_owned() });
    }
    Ok(bytes)
}

/// A regular file, and its length. A device or pipe is refused before it is opened, since opening a pipe may
/// never return.
pub(crate) fn open_regular(path: &Path) -> Result<(File, u64), ReadError> {
    let unreadable = |source: io::Error| match source.kind() {
        io::ErrorKind::NotFound => ReadError::Missing { path: path.to_owned() },
        _ => ReadError::Unreadable { path: path.to_owned(), source },
    };
    let metadata = fs::metadata(path).map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(ReadError::Directory { path: path.to_owned() });
    }
    if !metadata.is_file() {
        return Err(ReadError::NotRegular { path: path.to_owned() });
    }
    Ok((File::open(path).map_err(unreadable)?, metadata.len()))
}

/// The grid of a map that was read, whose sides were checked then.
pub(crate) fn grid_of_checked_sides(
    (width, height): (u32, u32),
    interrupt: &Interrupt,
    blocked: impl FnMut(u32, u32) -> bool,
) -> Result<Grid, Interrupted> {
    Grid::from_fn_interruptible(width, height, interrupt, blocked).map_err(|error| match error {
        GridError::Interrupted(interrupted) => interrupted,
        other => unreachable!("the sides were checked: {other}"),
    })
}
