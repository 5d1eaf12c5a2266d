//! The page: its bundled scripts, the engines, the maps, and the list that it needs to work offline.

use std::{fs, path::Path};

use mediant_sets::root;
use serde_json::{Map, Value, json};
use sha2::{Digest, Sha256};

use super::{
    bundle::{self, digest, packed, replace_once},
    parts::{self, File, write_folder},
};
use crate::Error;

/// The page that the browser loads first.
const HEAD: &str = "index.html";
/// Where the head says its version, which goes into the addresses of all other files.
const UNVERSIONED_HEAD: &str = "data-version=\"\"";
/// The service worker; it is not in its own list.
const WORKER: &str = "offline.js";
/// Where the service worker says its version. A browser looks for a new one by comparing the file.
const UNVERSIONED: &str = "const VERSION = \"\";";
/// The ending of source maps, which only a browser's debugger needs.
const SOURCE_MAP: &str = ".js.map";
/// The files beside the sources that go into the page as they are.
const AS_IT_IS: [&str; 3] = ["icon.svg", "manifest.webmanifest", WORKER];
/// The light module: the engines that the first path needs.
const LIGHT: &str = "light_bg.wasm";
/// All engines, which are fetched after the first path.
const WHOLE: &str = "mediant_bg.wasm";
/// The most bytes of all files that the first path needs, as they travel from any server of files.
const LARGEST: usize = 405_000;

/// Bundles the page with the package that lies in the folder `web`, and writes it there. Returns its version.
pub(super) fn write(esbuild: &Path, web: &Path) -> Result<String, Error> {
    let (package, sources, bundled) = (web.join("package"), web.join("sources"), web.join("bundled"));
    let mut files = Vec::new();
    let own = root().join("crates/web/page");
    take(&own, "", |path| !["mediant/", "maps/"].iter().any(|out| path.starts_with(out)), &mut files)?;
    take(&package, "mediant/", |path| path.ends_with("mediant.js"), &mut files)?;
    write_folder(&sources, &files)?;
    if bundled.exists() {
        fs::remove_dir_all(&bundled).map_err(Error::at(&bundled))?;
    }
    bundle::run(esbuild, &sources, &bundled)?;

    let mut files = vec![File { path: HEAD.to_owned(), bytes: head(&own, &bundled)?.into_bytes() }];
    take(&own, "", |path| AS_IT_IS.contains(&path), &mut files)?;
    for name in ["page.js", "worker.js"] {
        files.push(packed(&File::read(&bundled.join(name), name)?)?);
    }
    for (from, name) in [("light/mediant_bg.wasm", LIGHT), ("mediant_bg.wasm", WHOLE)] {
        files.push(packed(&File::read(&package.join(from), name)?)?);
    }
    for name in ["page.js.map", "worker.js.map"] {
        files.push(File::read(&bundled.join(name), name)?);
    }
    take(&package, "", |path| path == "LICENSE", &mut files)?;
    take(&root().join("crates/cli/maps"), "maps/", |path| path.ends_with(".map"), &mut files)?;
    let version = finish(&mut files)?;
    weigh(&files)?;
    write_folder(&web.join("page"), &files)?;
    Ok(version)
}

/// The text of `index.html`, with the first script and the styles in it.
fn head(own: &Path, bundled: &Path) -> Result<String, Error> {
    let read = |path: &Path| fs::read_to_string(path).map_err(Error::at(path));
    let (script, style) = (read(&bundled.join("start.js"))?, read(&bundled.join("page.css"))?);
    bundle::inline(&read(&own.join(HEAD))?, script.trim_end(), style.trim_end())
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

/// Tells the head and the service worker the version, which is a digest of all that the page holds, and adds
/// the list of the files that a browser needs, with their digests.
fn finish(files: &mut Vec<File>) -> Result<String, Error> {
    let mut all = Sha256::new();
    for file in &*files {
        all.update(format!("{}\0", file.path));
        all.update(Sha256::digest(&file.bytes));
    }
    let version: String = all.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect();
    set_version(files, HEAD, UNVERSIONED_HEAD, &format!("data-version=\"{version}\""))?;
    set_version(files, WORKER, UNVERSIONED, &format!("const VERSION = \"{version}\";"))?;
    let needed = files.iter().filter(|file| file.path != WORKER && !file.path.ends_with(SOURCE_MAP));
    let list: Map<_, _> =
        needed.map(|file| (file.path.clone(), Value::String(digest(&file.bytes)))).collect();
    let list = json!({ "version": version, "files": list });
    files.push(File { path: "files.json".to_owned(), bytes: parts::pretty(&list) });
    Ok(version)
}

fn set_version(files: &mut [File], path: &str, mark: &str, versioned: &str) -> Result<(), Error> {
    for file in files.iter_mut().filter(|file| file.path == path) {
        let text = String::from_utf8_lossy(&file.bytes);
        file.bytes = replace_once(path, &text, mark, versioned)?.into_bytes();
    }
    Ok(())
}

/// Prints what the first path needs: the head, the scripts and the light module.
fn weigh(files: &[File]) -> Result<(), Error> {
    let is_late = |path: &str| path.strip_suffix(".gz") == Some(WHOLE);
    let is_needed = |path: &str| path == HEAD || (path.ends_with(".gz") && !is_late(path));
    let needed = files.iter().filter(|file| is_needed(&file.path));
    let bytes = needed.map(|file| file.bytes.len()).sum();
    println!("The page: {bytes} bytes until the first path");
    if bytes > LARGEST {
        return Err(Error::Large {
            what: "the page, as it travels,".to_owned(),
            bytes,
            limit: LARGEST,
            reason: "it is to be there within a second",
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{File, HEAD, UNVERSIONED, UNVERSIONED_HEAD, WORKER, finish};

    /// A page of one file besides its head and its service worker; its version, and its files by their order.
    fn finished(script: &str) -> (String, Vec<String>) {
        let file = |path: &str, text: &str| File { path: path.to_owned(), bytes: text.into() };
        let head = format!("<html {UNVERSIONED_HEAD}>");
        let mut files = vec![
            file("main.js", script),
            file(WORKER, UNVERSIONED),
            file(HEAD, &head),
            file("main.js.map", "elsewhere"),
        ];
        let version = finish(&mut files).unwrap();
        (version, files.iter().map(|file| String::from_utf8_lossy(&file.bytes).into_owned()).collect())
    }

    #[test]
    fn the_version_is_that_of_the_contents() {
        let (version, files) = finished("1");
        assert_eq!(files[1], format!("const VERSION = \"{version}\";"));
        assert_eq!(files[2], format!("<html data-version=\"{version}\">"));
        let list = &files[4];
        assert!(list.contains(&version), "{list}");
        // `printf 1 | openssl dgst -sha256 -binary | base64`
        assert!(list.contains("sha256-a4ayc/80/OGda4BO/1o/V0etpOqiLx1JwB5S3beHW0s="), "{list}");
        assert!(!list.contains(WORKER), "the service worker would keep an old version of itself");
        assert!(!list.contains("main.js.map"), "only debuggers want it");
        assert_ne!(finished("2").0, version);
        assert_eq!(finished("1").0, version);
    }

    #[test]
    fn a_service_worker_without_a_version_is_an_error() {
        let mut files = vec![File { path: WORKER.to_owned(), bytes: b"// nothing".to_vec() }];
        assert!(finish(&mut files).unwrap_err().to_string().contains("has no `const VERSION"));
    }
}
