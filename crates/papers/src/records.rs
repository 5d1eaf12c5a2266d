//! The files of a folder of results.

use std::{fs, path::Path};

use mediant_report::Record;

use crate::{Error, catalog::EXPERIMENTS, experiment::Experiment};

/// The folder of the records, in that of the pages.
pub(crate) const DATA: &str = "data";

/// Writes a file, and creates the folder that it is in.
pub(crate) fn write(path: &Path, text: &str) -> Result<(), Error> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(Error::at(folder))?;
    }
    fs::write(path, text).map_err(Error::at(path))
}

/// The records of a folder of results, in the order of the experiments.
pub(crate) fn records(out: &Path) -> Result<Vec<(&'static Experiment, Record)>, Error> {
    let mut found = Vec::new();
    for experiment in EXPERIMENTS {
        let path = out.join(DATA).join(format!("{}.json", experiment.id));
        if path.is_file() {
            let text = fs::read_to_string(&path).map_err(Error::at(&path))?;
            let wrong = |wrong| Error::Reproduce(format!("{}: {wrong}", path.display()));
            found.push((experiment, Record::parse(&text).map_err(wrong)?));
        }
    }
    Ok(found)
}
