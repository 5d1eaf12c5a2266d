//! The programs that take part.

use std::{
    fs,
    path::{Path, PathBuf},
};

use mediant::Setup;
use serde::Deserialize;

use super::super::CompareError;

/// The file in the folder of the programs.
const FILE: &str = "peers.json";

/// A program of others.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Peer {
    /// Its name in the tables.
    pub(super) name: String,
    /// Its version or revision, and how it was compiled.
    pub(super) version: String,
    /// The program and its first arguments; a program in the folder by its name there.
    pub(super) command: Vec<String>,
    /// Our setup beside it, as `ENGINE:K:RULE,OPTION…`: it has the same motion.
    pub(super) beside: String,
    /// The maps that it can do; all without.
    #[serde(default)]
    pub(super) maps: Vec<String>,
}

/// A program of others, or an engine of ours.
#[derive(Clone, Debug)]
pub(super) enum Runner {
    /// Ours, with the words of its setup.
    Ours(Setup, String),
    /// Another, with the setup beside it.
    Theirs(Peer, Setup),
}

impl Runner {
    pub(super) fn name(&self) -> &str {
        match self {
            Self::Ours(_, name) => name,
            Self::Theirs(peer, _) => &peer.name,
        }
    }

    pub(super) const fn is_ours(&self) -> bool {
        matches!(self, Self::Ours(..))
    }

    /// Our setup: itself, or the one beside it.
    pub(super) const fn setup(&self) -> Setup {
        match self {
            Self::Ours(setup, _) | Self::Theirs(_, setup) => *setup,
        }
    }

    /// Whether it can do a map.
    pub(super) fn takes(&self, map: &String) -> bool {
        match self {
            Self::Ours(..) => true,
            Self::Theirs(peer, _) => peer.maps.is_empty() || peer.maps.contains(map),
        }
    }
}

/// The programs of a folder.
///
/// # Errors
/// [`CompareError::Read`] without the list, [`CompareError::Peers`] for one that is none.
pub(super) fn read(folder: &Path) -> Result<Vec<Peer>, CompareError> {
    let path: PathBuf = folder.join(FILE);
    let text = fs::read_to_string(&path).map_err(CompareError::at_read(&path))?;
    let wrong = |wrong: String| CompareError::Peers { path: path.clone(), wrong };
    let peers: Vec<Peer> = serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
    match peers.iter().find(|peer| peer.command.is_empty()) {
        Some(peer) => Err(wrong(format!("the command of {} is empty", peer.name))),
        None if peers.is_empty() => Err(wrong("it names no program".to_owned())),
        None => Ok(peers),
    }
}

/// Our setups beside the programs, each once, and the programs.
///
/// # Errors
/// [`CompareError::Peers`] for a setup that is none.
pub(super) fn runners(peers: &[Peer]) -> Result<Vec<Runner>, CompareError> {
    let mut ours: Vec<Runner> = Vec::new();
    let mut theirs = Vec::new();
    for peer in peers {
        let setup: Setup = peer.beside.parse().map_err(|error| CompareError::Peers {
            path: PathBuf::from(FILE),
            wrong: format!("`beside` of {}: {error}", peer.name),
        })?;
        if !ours.iter().any(|runner| runner.setup() == setup) {
            ours.push(Runner::Ours(setup, setup.to_string()));
        }
        theirs.push(Runner::Theirs(peer.clone(), setup));
    }
    Ok(ours.into_iter().chain(theirs).collect())
}
