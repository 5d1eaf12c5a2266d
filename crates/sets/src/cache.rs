//! The folder of the downloaded sets, and how a set gets there: fetched, unpacked and verified.

use std::{
    fmt, fs,
    path::{Path, PathBuf},
};

use indicatif::{HumanCount, ProgressBar};

use crate::{Contents, Error, Set, Source, unpack::extract};

/// The state of a set after it was provided.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// The set.
    pub name: String,
    /// Its maps and instances.
    pub contents: Contents,
    /// Whether the manifest knows the digests, and all agree.
    pub verified: bool,
    /// Whether it was unpacked now; otherwise all files were there.
    pub unpacked: bool,
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, contents, verified, unpacked } = self;
        let verdict = if *verified { "verified" } else { "unverified" };
        let (maps, instances) = (contents.maps.len(), HumanCount(contents.instances));
        write!(f, "{name:12} {verdict} {maps} maps, {instances} instances")?;
        f.write_str(if *verified { "" } else { " (the manifest knows no digest)" })?;
        f.write_str(if *unpacked { "" } else { " (all there)" })
    }
}

/// The folder that holds the sets, and where they come from.
#[derive(Clone, Debug)]
pub struct Cache {
    /// Holds `SET/*.map`, `SET/*.map.scen` and `zips/`.
    pub folder: PathBuf,
    /// Where archives come from.
    pub source: Source,
}

impl Cache {
    /// Makes sure that a set is there. If its files agree with the manifest nothing is done, else
    /// [`install`](Self::install).
    ///
    /// # Errors
    /// As for [`install`](Self::install).
    pub fn provide(&self, set: &Set) -> Result<Report, Error> {
        match examine(set, &self.folder.join(&set.name), false) {
            Ok(report) => Ok(report),
            Err(_) => self.install(set),
        }
    }

    /// Fetches the archives of a set (unless they are there), unpacks them beside its place, verifies the
    /// files, and only then replaces the older files by them.
    ///
    /// # Errors
    /// Any [`Error`]. The folder of the set is then unchanged, and bad archives that were downloaded are
    /// removed.
    pub fn install(&self, set: &Set) -> Result<Report, Error> {
        let zips = self.folder.join("zips");
        let fetch =
            |kind: &str, url: &str| self.source.fetch(&format!("{}-{kind}.zip", set.name), url, &zips);
        let archives =
            [(fetch("map", &set.maps_url)?, ".map"), (fetch("scen", &set.scenarios_url)?, ".scen")];
        let beside = self.folder.join(format!(".{}.partial", set.name));
        match unpack(&archives, &beside).and_then(|()| examine(set, &beside, true)) {
            Ok(report) => {
                replace(&beside, &self.folder.join(&set.name))?;
                Ok(report)
            }
            Err(error) => {
                remove_folder(&beside)?;
                let ours: Vec<_> =
                    archives.iter().map(|(zip, _)| zip).filter(|zip| zip.starts_with(&zips)).collect();
                for zip in &ours {
                    fs::remove_file(zip).map_err(Error::at(zip))?;
                }
                Err(if ours.is_empty() { error } else { Error::Discarded(Box::new(error)) })
            }
        }
    }
}

fn unpack(archives: &[(PathBuf, &str)], folder: &Path) -> Result<(), Error> {
    remove_folder(folder)?;
    fs::create_dir_all(folder).map_err(Error::at(folder))?;
    archives.iter().try_for_each(|(zip, ending)| extract(zip, folder, ending))
}

/// Parses all files of a folder and compares them with the manifest.
fn examine(set: &Set, folder: &Path, unpacked: bool) -> Result<Report, Error> {
    let files = fs::read_dir(folder).map_err(Error::at(folder))?.count();
    let bar = ProgressBar::new(files as u64).with_message(set.name.clone());
    let contents = Contents::of(folder, || bar.inc(1));
    bar.finish_and_clear();
    let contents = contents?;
    let verified = set.check(&contents)?;
    Ok(Report { name: set.name.clone(), contents, verified, unpacked })
}

/// Renames a folder to a place, and removes an older folder there.
fn replace(folder: &Path, place: &Path) -> Result<(), Error> {
    remove_folder(place)?;
    fs::rename(folder, place).map_err(Error::at(place))
}

fn remove_folder(folder: &Path) -> Result<(), Error> {
    if folder.exists() { fs::remove_dir_all(folder).map_err(Error::at(folder)) } else { Ok(()) }
}
