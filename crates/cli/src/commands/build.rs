//! `mediant build`: what an engine preprocesses, saved.

use std::{io::Write, path::Path, time::Instant};

use mediant_engines::{Index, SearchSpace, Setup, SharedRules};
use mediant_formats::{IndexFile, IndexKey};
use mediant_grid::Grid;
use mediant_moves::FiniteK;

use crate::{
    args::BuildArgs,
    failure::Failure,
    map::{Map, file_name},
    terminal::{
        progress::BuildProgress,
        screen::{BOLD, Screen},
        text::{grouped, printable, time},
    },
};

/// Runs the command.
pub(crate) fn build(args: &BuildArgs, screen: &mut Screen) -> Result<(), Failure> {
    let setup = args.setup()?;
    let version = setup.index_version()?;
    let map = Map::load(&args.map)?;
    let progress = BuildProgress::new();
    let begin = Instant::now();
    let built = SearchSpace::new(setup, &map.grid).and_then(|space| {
        Index::with_progress(setup, &space, &SharedRules::new(), &|step| progress.tell(step))?.to_bytes()
    });
    let took = begin.elapsed();
    progress.clear();
    let payload = built?;
    let key = key(setup, version, &map.grid).map_err(refused(&args.output))?;
    let bytes = grouped(payload.len() as u64);
    IndexFile::new(key, payload).write(&args.output)?;
    let name = file_name(&args.output);
    let name = screen.paint(BOLD, printable(&name)).to_string();
    let took = time(took.as_nanos() as f64);
    writeln!(
        screen,
        "{name} · {} of {} · {bytes} bytes · built in {took}",
        setup.engine.kind(),
        printable(&map.name)
    )?;
    Ok(())
}

/// The bytes of a saved index, if it is the one for this setup and map.
pub(crate) fn load(path: &Path, setup: Setup, grid: &Grid) -> Result<Vec<u8>, Failure> {
    let version = setup.index_version()?;
    let file = IndexFile::read(path)?;
    let expected = key(setup, version, grid).map_err(refused(path))?;
    file.check(&expected).map_err(refused(path))?;
    Ok(file.into_payload())
}

fn key(setup: Setup, version: u32, grid: &Grid) -> Result<IndexKey, mediant_formats::IndexError> {
    IndexKey::new(setup.engine.kind().name(), version, setup.rules, setup.k.finite().map(FiniteK::get), grid)
}

fn refused(path: &Path) -> impl FnOnce(mediant_formats::IndexError) -> Failure {
    move |source| Failure::Index { path: path.to_owned(), source }
}
