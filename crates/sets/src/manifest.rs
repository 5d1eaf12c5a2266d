//! `benchdata/manifest.json`: what each benchmark set holds, and how that is checked.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use mediant_formats::{MapFile, Scenario};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::{Error, files};

/// All sets.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// The form of the digests, in words.
    pub digest: String,
    /// The sets, in the order of their download.
    pub sets: Vec<Set>,
}

/// One benchmark set.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Set {
    /// The name in file names: archives are `NAME-map.zip` and `NAME-scen.zip`.
    pub name: String,
    /// Where the maps come from.
    pub title: String,
    /// The public address of the maps.
    pub maps_url: String,
    /// The public address of the scenarios.
    pub scenarios_url: String,
    /// The number of instances of all scenarios; none if the set was never at hand.
    pub instances: Option<u64>,
    /// The digest of each map, by file name; none if the set was never at hand.
    pub maps: Option<BTreeMap<String, String>>,
}

/// The maps and instances of a set's folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Contents {
    /// The digest of each map, by file name.
    pub maps: BTreeMap<String, String>,
    /// The number of instances of all scenarios.
    pub instances: u64,
}

impl Manifest {
    /// Its path in the project at `root`.
    #[must_use]
    pub fn path(root: &Path) -> PathBuf {
        root.join("benchdata").join("manifest.json")
    }

    /// Reads a manifest.
    ///
    /// # Errors
    /// [`Error::Io`] or [`Error::Manifest`].
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = fs::read(path).map_err(Error::at(path))?;
        serde_json::from_slice(&text).map_err(|source| Error::Manifest { path: path.to_owned(), source })
    }

    /// Writes a manifest, one map on a line.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        let text = serde_json::to_string_pretty(self)
            .map_err(|source| Error::Manifest { path: path.to_owned(), source })?;
        fs::write(path, text + "\n").map_err(Error::at(path))
    }

    /// The entry of a set.
    ///
    /// # Errors
    /// [`Error::UnknownSet`] lists the known ones.
    pub fn set(&self, name: &str) -> Result<&Set, Error> {
        self.sets.iter().find(|set| set.name == name).ok_or_else(|| {
            let known: Vec<&str> = self.sets.iter().map(|set| &*set.name).collect();
            Error::UnknownSet { name: name.to_owned(), known: known.join(", ") }
        })
    }
}

impl Set {
    /// Compares contents with the entry: `true` for verified, `false` where the manifest knows no digests.
    ///
    /// # Errors
    /// [`Error::Differs`] names the first difference.
    pub fn check(&self, contents: &Contents) -> Result<bool, Error> {
        let differs = |why| Err(Error::Differs { set: self.name.clone(), why });
        let Some(expected) = &self.maps else {
            return if contents.maps.is_empty() { differs("there is no map".to_owned()) } else { Ok(false) };
        };
        for (map, digest) in expected {
            match contents.maps.get(map) {
                None => return differs(format!("map {map} is missing")),
                Some(found) if found != digest => {
                    return differs(format!("map {map}: expected digest {digest}, found {found}"));
                }
                Some(_) => {}
            }
        }
        if let Some(map) = contents.maps.keys().find(|map| !expected.contains_key(*map)) {
            return differs(format!("map {map} does not belong to it"));
        }
        match self.instances {
            Some(expected) if expected != contents.instances => {
                differs(format!("expected {expected} instances, found {}", contents.instances))
            }
            _ => Ok(true),
        }
    }
}

impl Contents {
    /// Parses every map and scenario of a folder. `tick` is called after each file.
    ///
    /// # Errors
    /// [`Error::Io`], [`Error::Format`], and [`Error::OtherMap`] for a scenario `M.scen` beside a map `M` of
    /// other sides.
    pub fn of(folder: &Path, tick: impl Fn()) -> Result<Self, Error> {
        let mut sides = BTreeMap::new();
        let mut contents = Self { maps: BTreeMap::new(), instances: 0 };
        for path in files(folder, ".map")? {
            let name = name(&path);
            let map = MapFile::read(path)?;
            sides.insert(name.clone(), (map.width(), map.height()));
            contents.maps.insert(name, map_digest(&map));
            tick();
        }
        for path in files(folder, ".scen")? {
            let file = name(&path);
            let scenario = Scenario::read(path)?;
            let map = file.trim_end_matches(".scen");
            if let Some(&sides) = sides.get(map) {
                scenario.check_size(sides, map).map_err(|source| Error::OtherMap { file, source })?;
            }
            contents.instances += scenario.instances().len() as u64;
            tick();
        }
        Ok(contents)
    }
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// The form of [`map_digest`], as [`Manifest::digest`] states it.
pub const DIGEST: &str = "sha256 of: width and height, each as 4 bytes, lowest first; then a bit a cell, row \
                          by row without padding, 1 = blocked, the first cell in the lowest bit of the first \
                          byte, zeros after the last";

/// The digest of a map's cells, whatever the line ends and headers of its file: SHA-256, in hexadecimal, over
/// the form [`DIGEST`].
#[must_use]
pub fn map_digest(map: &MapFile) -> String {
    let cells = map.width() as usize * map.height() as usize;
    let mut bits = vec![0_u8; cells.div_ceil(8)];
    for (at, &tile) in map.rows().flatten().enumerate() {
        bits[at / 8] |= u8::from(!map.is_free(tile)) << (at % 8);
    }
    let digest = Sha256::new()
        .chain_update(map.width().to_le_bytes())
        .chain_update(map.height().to_le_bytes())
        .chain_update(bits)
        .finalize();
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}
