//! The page: its own files, the package, the maps, and the list that it needs to work offline.

use std::path::Path;

use base64::{Engine, engine::general_purpose::STANDARD};
use mediant_sets::root;
use serde_json::{Map, Value, json};
use sha2::{Digest, Sha256};

use super::{
    modules,
    parts::{self, File, write_folder},
};
use crate::Error;

/// The service worker; it is not in its own list.
const WORKER: &str = "offline.js";
/// Where the service worker says its version. A browser looks for a new one by comparing the file.
const UNVERSIONED: &str = "const VERSION = \"\";";
/// Files beside the sources of the page that are no part of it, or are put there anew.
const LEFT_OUT: [&str; 4] = ["types.d.ts", "files.json", "mediant/", "maps/"];

/// Writes the page, and returns its version.
pub(super) fn write(package: &Path, page: &Path) -> Result<String, Error> {
    let mut files = Vec::new();
    take(
        &root().join("crates/web/page"),
        "",
        |path| !LEFT_OUT.iter().any(|out| path.starts_with(out)),
        &mut files,
    )?;
    take(package, "mediant/", is_run, &mut files)?;
    take(&root().join("crates/cli/maps"), "maps/", |path| path.ends_with(".map"), &mut files)?;
    modules::announce(&mut files);
    let version = finish(&mut files)?;
    write_folder(page, &files)?;
    Ok(version)
}

/// Whether a browser needs this file of the package, or its licence wants it there.
fn is_run(path: &str) -> bool {
    !path.ends_with(".d.ts") && !["README.md", "package.json", "node.js"].contains(&path)
}

fn take(
    folder: &Path,
    prefix: &str,
    wanted: impl Fn(&str) -> bool,
    files: &mut Vec<File>,
) -> Result<(), Error> {
    for path in parts::list(folder)?.into_iter().filter(|path| wanted(path)) {
        files.push(File::read(&folder.join(&path), &format!("{prefix}{path}"))?);
    }
    Ok(())
}

/// Adds the list of all files with their digests, and tells the service worker the version, which is a digest
/// of all that the page holds.
fn finish(files: &mut Vec<File>) -> Result<String, Error> {
    let mut all = Sha256::new();
    let mut list = Map::new();
    for file in &*files {
        let digest = Sha256::digest(&file.bytes);
        all.update(format!("{}\0", file.path));
        all.update(digest);
        if file.path != WORKER {
            list.insert(file.path.clone(), Value::String(format!("sha256-{}", STANDARD.encode(digest))));
        }
    }
    let version: String = all.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect();
    for worker in files.iter_mut().filter(|file| file.path == WORKER) {
        let text = String::from_utf8_lossy(&worker.bytes);
        if !text.contains(UNVERSIONED) {
            return Err(Error::Lacking {
                what: format!("crates/web/page/{WORKER} has no line `{UNVERSIONED}`"),
                mend: "browsers see by its version that the page is a new one".to_owned(),
            });
        }
        worker.bytes = text.replace(UNVERSIONED, &format!("const VERSION = \"{version}\";")).into_bytes();
    }
    let list = json!({ "version": version, "files": list });
    files.push(File { path: "files.json".to_owned(), bytes: parts::pretty(&list) });
    Ok(version)
}

#[cfg(test)]
mod tests {
    use super::{File, UNVERSIONED, WORKER, finish};

    /// A page of one module besides its service worker; its version, and its files by their order.
    fn finished(module: &str) -> (String, Vec<String>) {
        let file = |path: &str, text: &str| File { path: path.to_owned(), bytes: text.into() };
        let mut files = vec![file("main.js", module), file(WORKER, UNVERSIONED)];
        let version = finish(&mut files).unwrap();
        (version, files.iter().map(|file| String::from_utf8_lossy(&file.bytes).into_owned()).collect())
    }

    #[test]
    fn the_version_is_that_of_the_contents() {
        let (version, files) = finished("1");
        assert_eq!(files[1], format!("const VERSION = \"{version}\";"));
        assert!(files[2].contains(&version), "{}", files[2]);
        // `printf 1 | openssl dgst -sha256 -binary | base64`
        assert!(files[2].contains("sha256-a4ayc/80/OGda4BO/1o/V0etpOqiLx1JwB5S3beHW0s="), "{}", files[2]);
        assert!(!files[2].contains(WORKER), "the service worker would keep an old version of itself");
        assert_ne!(finished("2").0, version);
        assert_eq!(finished("1").0, version);
    }

    #[test]
    fn a_service_worker_without_a_version_is_an_error() {
        let mut files = vec![File { path: WORKER.to_owned(), bytes: b"// nothing".to_vec() }];
        assert!(finish(&mut files).unwrap_err().to_string().contains("has no line"));
    }
}
