//! Files that are written whole, or not at all.

use std::{
    fs::{self, File, OpenOptions},
    io::{self, BufWriter, Seek, SeekFrom, Write},
    path::{Path, PathBuf},
};

use mediant_grid::Interrupted;
use tempfile::{NamedTempFile, TempPath};

/// Why a file cannot be written. An older file is still there.
///
/// Needs the feature `save`.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The folder of the file does not exist.
    #[error("{}: there is no folder {}: make it first, or choose another one", path.display(), folder.display())]
    NoFolder {
        /// The file that was asked for.
        path: PathBuf,
        /// Its folder.
        folder: PathBuf,
    },
    /// No file can be made in the folder. A file is written beside the old one first, and then takes its
    /// place.
    #[error(
        "{}: cannot be written: no file can be made in the folder {}: {source}; choose another folder",
        path.display(), folder.display()
    )]
    Folder {
        /// The file that was asked for.
        path: PathBuf,
        /// Its folder.
        folder: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// The path names a directory or a device, which must not be replaced by a file.
    #[error("{}: expected a regular file or none, found a directory or device; name a file to be made", path.display())]
    NotRegular {
        /// The file that was asked for.
        path: PathBuf,
    },
    /// The file would be longer than the longest that can be read,
    /// [`MAX_FILE_BYTES`](crate::MAX_FILE_BYTES).
    #[error(
        "{}: expected an index of at most {} bytes, found {found}; split the map",
        path.display(), crate::MAX_FILE_BYTES
    )]
    TooLarge {
        /// The file that was asked for.
        path: PathBuf,
        /// The number of bytes that it would have.
        found: u64,
    },
    /// The name is none for the picture of a ROS map.
    #[error("{}: no name for the picture of a ROS map; end it in .pgm", path.display())]
    ImageName {
        /// The picture.
        path: PathBuf,
    },
    /// The name is none for a raster of numbers. Needs the feature `surface`.
    #[cfg(feature = "surface")]
    #[error("{}: no name for a raster; end it in .npy, .asc, .pgm{}{}", path.display(),
        if cfg!(feature = "png") { ", .png" } else { "" },
        if cfg!(feature = "geotiff") { ", .tif" } else { "" }
    )]
    SurfaceName {
        /// The file that was asked for.
        path: PathBuf,
    },
    /// The operating system refuses to write the file.
    #[error("{}: cannot be written: {source}", path.display())]
    Unwritable {
        /// The file that was asked for.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// An interrupt stopped the writing.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

/// A file that is being written. It takes the place of an older file of its name when it is whole, at
/// [`replace`](Self::replace); until then the older one stays, and it stays for good if anything fails. So
/// there is never half a file.
///
/// It is written to another file in the same folder, `.mediant-….part`, which is then renamed. It keeps the
/// permissions of the older file. A symbolic link stays one, and what it leads to is replaced. A device or
/// a pipe (`/dev/stdout`) has no content to lose: it is written at once.
///
/// Needs the feature `save`.
///
/// ```
/// use std::io::Write;
/// use mediant_formats::NewFile;
///
/// let path = std::env::temp_dir().join("mediant-notes.txt");
/// std::fs::write(&path, "older")?;
/// let mut file = NewFile::create(&path)?;
/// file.write_all(b"newer")?;
/// assert_eq!(std::fs::read_to_string(&path)?, "older");
/// file.replace()?;
/// assert_eq!(std::fs::read_to_string(&path)?, "newer");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct NewFile {
    /// As it was asked for.
    path: PathBuf,
    file: BufWriter<File>,
    /// The name of the new file until it is whole, and the one that it gets; `None` for a device.
    rename: Option<(TempPath, PathBuf)>,
}

impl NewFile {
    /// Checks that a file can be written, as far as this can be known before: its folder exists, and there is
    /// no directory of its name, and no file that is read-only.
    ///
    /// # Errors
    /// [`WriteError`] says which of these is not so.
    pub fn check(path: impl AsRef<Path>) -> Result<(), WriteError> {
        let path = path.as_ref();
        match fs::metadata(path) {
            Ok(older) if older.is_dir() => return Err(WriteError::NotRegular { path: path.to_owned() }),
            // This changes nothing of what is there.
            Ok(older) if older.is_file() => {
                return OpenOptions::new().write(true).open(path).map(drop).map_err(unwritable(path));
            }
            // A pipe that is opened and closed again has ended for its reader.
            Ok(_) => return Ok(()),
            Err(_) => {}
        }
        let folder = folder_of(path);
        if folder.is_dir() {
            Ok(())
        } else {
            Err(WriteError::NoFolder { path: path.to_owned(), folder: folder.to_owned() })
        }
    }

    /// Begins a file.
    ///
    /// # Errors
    /// As for [`check`](Self::check), and [`WriteError::Folder`] for a folder in which no file can be made.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, WriteError> {
        let path = path.as_ref();
        Self::check(path)?;
        let older = fs::metadata(path).ok();
        if older.as_ref().is_some_and(|older| !older.is_file()) {
            let device = OpenOptions::new().write(true).open(path).map_err(unwritable(path))?;
            return Ok(Self { path: path.to_owned(), file: BufWriter::new(device), rename: None });
        }
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        // The crate `tempfile` would add the name of the temporary file to all errors.
        let (file, temporary) = temporary_in(folder_of(&target))
            .map_err(|error| WriteError::Folder {
                path: path.to_owned(),
                folder: folder_of(path).to_owned(),
                source: error.kind().into(),
            })?
            .into_parts();
        if let Some(older) = older {
            file.set_permissions(older.permissions()).map_err(unwritable(path))?;
        }
        let rename = Some((temporary, target));
        Ok(Self { path: path.to_owned(), file: BufWriter::new(file), rename })
    }

    /// Writes a file by a function, and puts it in the place of an older one if the function succeeds.
    ///
    /// # Errors
    /// Errors of [`create`](Self::create), of the function, and of [`replace`](Self::replace).
    pub fn write_with(
        path: impl AsRef<Path>,
        write: impl FnOnce(&mut Self) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        let mut file = Self::create(path)?;
        write(&mut file).map_err(unwritable(&file.path))?;
        file.replace()
    }

    /// Ends the file, and puts it in the place of an older one.
    ///
    /// # Errors
    /// [`WriteError::Unwritable`] if the operating system refuses; the older file is still there then.
    pub fn replace(self) -> Result<(), WriteError> {
        let Self { path, file, rename } = self;
        let replaced = file.into_inner().map_err(io::IntoInnerError::into_error).and_then(|file| {
            let Some((temporary, target)) = rename else { return Ok(()) };
            // Else the rename may reach the disk before the bytes do.
            file.sync_all()?;
            temporary.persist(target).map_err(|error| error.error)
        });
        replaced.map_err(unwritable(&path))
    }
}

impl Write for NewFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Goes to another place of the file; a pipe has none.
impl Seek for NewFile {
    fn seek(&mut self, place: SeekFrom) -> io::Result<u64> {
        self.file.seek(place)
    }
}

/// Adds the path of the file that cannot be written to an error.
pub(crate) fn unwritable(path: &Path) -> impl FnOnce(io::Error) -> WriteError + use<> {
    let path = path.to_owned();
    move |source| WriteError::Unwritable { path, source }
}

/// The folder of a file.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A new file of a unique name with the usual permissions. By default, tempfile keeps other users from
/// reading it.
fn temporary_in(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".mediant-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The system removes the bits of the process's umask.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
