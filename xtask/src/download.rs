//! `cargo xtask download`: the benchmark sets, fetched, unpacked and verified.

use std::path::Path;

use clap::Args;
use indicatif::HumanCount;
use mediant_sets::{Cache, DIGEST, Error as SetError, Manifest, Report, Set, Source, cache, root};

use crate::Error;

/// The options of `cargo xtask download`.
#[derive(Args, Clone, Debug, Default)]
pub struct Options {
    /// The sets to fetch; all when none is named
    #[arg(long = "set", value_name = "NAME", num_args = 1..)]
    pub sets: Vec<String>,
    /// A folder or an address that holds the archives (SET-map.zip, SET-scen.zip) instead of the public site
    #[arg(long, value_name = "DIR|URL", env = "MEDIANT_MIRROR")]
    pub mirror: Option<String>,
    /// Record the digests of the maps instead of comparing them
    #[arg(long, hide = true)]
    pub write_manifest: bool,
}

/// Fetches the sets that the options name into the project's cache, and prints a line for each.
///
/// # Errors
/// As for [`run_in`].
pub fn run(options: &Options) -> Result<(), Error> {
    run_in(&root(), options)
}

/// [`run`] in the project at `root`. Sets that a mirror does not hold are passed over, unless they were
/// named.
///
/// # Errors
/// The first [`Error`] ends the run; sets that were complete before stay.
pub fn run_in(root: &Path, options: &Options) -> Result<(), Error> {
    let path = Manifest::path(root);
    let manifest = Manifest::read(&path)?;
    let names = match &options.sets[..] {
        [] => manifest.sets.iter().map(|set| set.name.clone()).collect(),
        named => named.to_vec(),
    };
    for name in &names {
        manifest.set(name)?;
    }
    let source = Source::from_mirror(options.mirror.as_deref());
    let may_lack = options.sets.is_empty() && source != Source::Site;
    let cache = Cache { folder: cache(root), source };
    let mut reports = Vec::new();
    for name in &names {
        let set = manifest.set(name)?;
        let provided = if options.write_manifest {
            cache.install(&Set { maps: None, instances: None, ..set.clone() })
        } else {
            cache.provide(set)
        };
        match provided {
            Err(SetError::Absent { place }) if may_lack => {
                println!("{name:12} passed over: {place} is not there");
            }
            Err(error) => return Err(error.into()),
            Ok(report) => {
                println!("{report}");
                reports.push(report);
            }
        }
    }
    if reports.is_empty() {
        return Err(Error::NoSet { mirror: options.mirror.clone().unwrap_or_default() });
    }
    let maps: usize = reports.iter().map(|report| report.contents.maps.len()).sum();
    let instances = reports.iter().map(|report| report.contents.instances).sum();
    println!("{:12} {maps} maps, {} instances", "together", HumanCount(instances));
    if options.write_manifest {
        record(manifest, reports).write(&path)?;
    }
    Ok(())
}

/// The manifest with what was found in the sets.
fn record(mut manifest: Manifest, reports: Vec<Report>) -> Manifest {
    DIGEST.clone_into(&mut manifest.digest);
    for Report { name, contents, .. } in reports {
        for set in manifest.sets.iter_mut().filter(|set| set.name == name) {
            set.instances = Some(contents.instances);
            set.maps = Some(contents.maps.clone());
        }
    }
    manifest
}
