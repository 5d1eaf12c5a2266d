//! The setting of a run, and what an experiment sees of it.

use std::{
    fs,
    path::{Path, PathBuf},
    sync::atomic::{AtomicBool, Ordering},
};

use mediant_oracle::Rng;
use mediant_sets::{Cache, Error as SetError, Manifest, Source, cache, files, progress};
use rayon::prelude::*;
use serde::{Serialize, de::DeserializeOwned};
use sha2::{Digest, Sha256};

use crate::{
    Error,
    maps::{Map, evenly},
};

/// The timed passes over the queries of a map, of which the median counts.
const PASSES: u32 = 3;

/// The options of a run.
#[derive(Clone, Debug)]
pub(super) struct Request {
    /// Whether an even sample of everything is enough.
    pub(super) quick: bool,
    /// Whether times are taken.
    pub(super) timed: bool,
    /// The seed of what is drawn at random.
    pub(super) seed: u64,
    /// The only sets to run on; all if there are none.
    pub(super) sets: Vec<String>,
}

/// A request with the project, the threads and the folder that a run needs for it.
pub(super) struct Setting {
    pub(super) root: PathBuf,
    pub(super) request: Request,
    /// The threads of experiments that take no time.
    pool: rayon::ThreadPool,
    /// Holds the results of each map until the run is complete, so that an interrupted run goes on where it
    /// was.
    parts: PathBuf,
}

/// The order in which the maps of a step are measured: at once or in turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum How {
    /// Several at once: nothing in it is timed.
    Counted,
    /// One after the other.
    Timed,
}

impl Setting {
    /// The setting of a request in the project at `root`, on so many threads; 0 stands for one a core.
    ///
    /// # Errors
    /// [`SetError::UnknownSet`], and the errors of the manifest.
    pub(super) fn new(root: &Path, request: Request, threads: usize) -> Result<Self, Error> {
        let manifest = Manifest::read(&Manifest::path(root))?;
        for name in &request.sets {
            manifest.set(name)?;
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|wrong| Error::Reproduce(format!("no threads: {wrong}")))?;
        // Parts that another program or another request measured must not be mixed with those of this run.
        let program = std::env::current_exe().and_then(fs::read).unwrap_or_default();
        let key = Sha256::new().chain_update(program).chain_update(format!("{request:?}")).finalize();
        let key: String = key.iter().take(8).map(|byte| format!("{byte:02x}")).collect();
        let parts = cache(root).join(".reproduce").join(key);
        Ok(Self { root: root.to_owned(), request, pool, parts })
    }

    fn folder(&self, set: &str) -> PathBuf {
        cache(&self.root).join(set)
    }

    /// Whether a set is asked for.
    fn asks(&self, set: &str) -> bool {
        let sets = &self.request.sets;
        sets.is_empty() || sets.iter().any(|asked| asked == set)
    }

    /// Whether a set is asked for and there.
    fn has(&self, set: &str) -> bool {
        self.asks(set) && self.folder(set).is_dir()
    }

    /// Downloads the sets that are missing. One that cannot be downloaded is named on stderr, and is no
    /// error.
    pub(super) fn provide<'a>(
        &self,
        sets: impl Iterator<Item = &'a str>,
        mirror: Option<&str>,
    ) -> Result<(), Error> {
        let manifest = Manifest::read(&Manifest::path(&self.root))?;
        let cache = Cache { folder: cache(&self.root), source: Source::from_mirror(mirror) };
        let mut seen = Vec::new();
        for name in sets {
            if !self.asks(name) || seen.contains(&name) || self.folder(name).is_dir() {
                continue;
            }
            seen.push(name);
            match cache.provide(manifest.set(name)?) {
                Ok(report) => eprintln!("{report}"),
                Err(error @ SetError::Network { .. }) => {
                    // Without a network for one set, there is none for the others.
                    eprintln!("no download: {error}");
                    return Ok(());
                }
                Err(error @ (SetError::Absent { .. } | SetError::Status { .. })) => {
                    eprintln!("{name}: {error}");
                }
                Err(error) => return Err(error.into()),
            }
        }
        Ok(())
    }

    /// Removes the parts, once the run is complete.
    pub(super) fn forget(&self) -> Result<(), Error> {
        if self.parts.is_dir() {
            fs::remove_dir_all(&self.parts).map_err(Error::at(&self.parts))?;
        }
        Ok(())
    }
}

/// A run's setting, for one experiment.
pub(super) struct Context<'a> {
    setting: &'a Setting,
    /// The experiment.
    id: &'static str,
    /// Its benchmark sets.
    sets: &'static [&'static str],
}

impl<'a> Context<'a> {
    /// The setting for the experiment `id`, which runs on `sets`.
    pub(super) const fn new(setting: &'a Setting, id: &'static str, sets: &'static [&'static str]) -> Self {
        Self { setting, id, sets }
    }

    /// `quick` in a quick run, else `full`.
    pub(super) fn quick_or<T>(&self, quick: T, full: T) -> T {
        if self.setting.request.quick { quick } else { full }
    }

    /// The number of timed passes: 0 in a run without times.
    pub(super) fn passes(&self) -> u32 {
        if self.setting.request.timed { PASSES } else { 0 }
    }

    /// The random numbers of a map.
    pub(super) fn rng(&self, map: &Map) -> Rng {
        map.rng(self.setting.request.seed)
    }

    /// Whether the experiment runs on the maps that come with the project.
    pub(super) fn is_bundled(&self) -> bool {
        let sets = self.sets;
        !sets.is_empty() && !sets.iter().any(|set| self.setting.has(set))
    }

    /// The experiment's sets that are there and asked for; `bundled` if there are none.
    pub(super) fn sets(&self) -> Vec<&'static str> {
        let sets: Vec<&str> = self.sets.iter().copied().filter(|set| self.setting.has(set)).collect();
        if sets.is_empty() && !self.sets.is_empty() { vec!["bundled"] } else { sets }
    }

    /// The maps of a set, sorted; in a quick run, an even sample of `quick` maps.
    pub(super) fn maps(&self, set: &str, quick: usize) -> Result<Vec<Map>, Error> {
        let folder = match set {
            "bundled" => self.setting.root.join("crates/cli/maps"),
            set => self.setting.folder(set),
        };
        let paths = files(&folder, ".map")?;
        let all: Vec<Map> = paths.iter().map(|path| Map::new(set, path)).collect();
        Ok(evenly(&all, self.quick_or(quick, usize::MAX)))
    }

    /// The maps of a set that have these names; all bundled maps if the set is not there.
    pub(super) fn named(&self, set: &str, names: &[&str]) -> Result<Vec<Map>, Error> {
        if !self.setting.has(set) {
            return self.maps("bundled", usize::MAX);
        }
        let mut maps = Vec::new();
        for name in names {
            let path = self.setting.folder(set).join(format!("{name}.map"));
            if !path.is_file() {
                return Err(Error::Reproduce(format!("set {set} has no map `{name}`: download it anew")));
            }
            maps.push(Map::new(set, &path));
        }
        Ok(maps)
    }

    /// Calls `work` for each map, and shows on a bar how long the rest will take. Maps that an interrupted
    /// run completed in this step are not measured again.
    pub(super) fn each<T: Serialize + DeserializeOwned + Send>(
        &self,
        step: &str,
        how: How,
        maps: &[Map],
        work: impl Fn(&Map) -> Result<T, Error> + Sync,
    ) -> Result<Vec<T>, Error> {
        let bar = progress(&format!("{} {step}", self.id), maps.len());
        let folder = self.setting.parts.join(self.id).join(step);
        let failed = AtomicBool::new(false);
        let part = |map: &Map| {
            let path = folder.join(format!("{}-{}.json", map.set, map.name));
            let known = fs::read(&path).ok().and_then(|text| serde_json::from_slice(&text).ok());
            let done = match known {
                Some(known) => Ok(Some(known)),
                // After an error, the other maps are not worth measuring.
                None if failed.load(Ordering::Relaxed) => Ok(None),
                None => work(map).and_then(|done| {
                    save(&path, &done)?;
                    Ok(Some(done))
                }),
            };
            failed.fetch_or(done.is_err(), Ordering::Relaxed);
            bar.inc(1);
            done
        };
        let done: Vec<Result<Option<T>, Error>> = match how {
            How::Timed if self.setting.request.timed => maps.iter().map(part).collect(),
            _ => self.setting.pool.install(|| maps.par_iter().map(part).collect()),
        };
        bar.finish_and_clear();
        done.into_iter().filter_map(Result::transpose).collect()
    }
}

/// Writes a part under another name first, so that a file of its final name is always complete.
fn save(path: &Path, part: &impl Serialize) -> Result<(), Error> {
    let text = serde_json::to_vec(part).map_err(|wrong| Error::Reproduce(wrong.to_string()))?;
    let partial = path.with_extension("partial");
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(Error::at(folder))?;
    }
    fs::write(&partial, text).map_err(Error::at(&partial))?;
    fs::rename(&partial, path).map_err(Error::at(path))
}
