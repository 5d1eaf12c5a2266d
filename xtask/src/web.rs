//! `cargo xtask web`: the npm package `mediant`, and the page that shows it.
//!
//! It compiles `mediant-web` to WebAssembly, has the program `wasm-bindgen` write its JavaScript, and puts two
//! folders together, in `target/web`: `package`, which `npm publish` and `npm install` take, and `page`, which
//! any web server takes. What it needs besides Rust is had from Cargo. There is no bundler: the page is what
//! `crates/web/page` holds, with the package and the maps beside it.

mod modules;
mod page;
mod parts;
mod tools;

use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
};

use flate2::{Compression, write::GzEncoder};
use mediant_sets::root;

use crate::{
    Error,
    ci::step,
    project::{self, Package},
};
use parts::{File, write_folder};

/// The crate.
const CRATE: &str = "mediant-web";
/// What the module may weigh when it was compressed as web servers do, in bytes.
const LARGEST: usize = 600_000;

/// Builds both folders.
///
/// # Errors
/// [`Error::Lacking`] if the target or the program `wasm-bindgen` cannot be had, [`Error::Step`] for a command
/// that failed, [`Error::Io`] for a file, [`Error::Large`] if the module weighs too much.
pub fn run() -> Result<(), Error> {
    let crates = project::packages()?;
    let found = crates.iter().find(|package| package.name == CRATE);
    let found = found.ok_or_else(|| Error::Lacking {
        what: format!("the workspace has no crate {CRATE}"),
        mend: "run this in a clone of the whole project".to_owned(),
    })?;
    tools::provide_target()?;
    let program = tools::wasm_bindgen()?;
    let module = tools::compile(CRATE)?;

    let web = root().join("target/web");
    let package = web.join("package");
    bind(&program, &module, &web.join("bound"))?;
    write_folder(&package, &package_files(found, &web.join("bound"))?)?;
    let version = page::write(&package, &web.join("page"))?;
    report(&package)?;
    println!("The package: target/web/package. The page, version {version}: target/web/page");
    println!("To see it: node crates/web/serve.mjs, or python3 -m http.server --directory target/web/page");
    Ok(())
}

/// Runs `wasm-bindgen` on the compiled module.
fn bind(program: &Path, module: &Path, out: &Path) -> Result<(), Error> {
    // What an older version wrote there would be taken for a part of the package.
    if out.exists() {
        fs::remove_dir_all(out).map_err(Error::at(out))?;
    }
    let mut command = std::process::Command::new(program);
    command.args(["--target", "web", "--out-name", "mediant"]);
    // Names of functions, which only a debugger reads, are a tenth of the module.
    command.args(["--remove-name-section", "--remove-producers-section", "--out-dir"]);
    step(command.arg(out).arg(module), "wasm-bindgen --target web --out-name mediant …")
}

/// The files of the package: those that `wasm-bindgen` wrote, what is to be known of them, and the licence.
fn package_files(package: &Package, bound: &Path) -> Result<Vec<File>, Error> {
    let mut files = parts::read_folder(bound)?;
    let folder = root().join("crates/web");
    for name in ["README.md", "LICENSE"] {
        files.push(File::read(&folder.join(name), name)?);
    }
    let mut named: Vec<&str> = files.iter().map(|file| &*file.path).collect();
    named.sort_unstable();
    let about = about(&package.version, &named);
    files.push(File { path: "package.json".to_owned(), bytes: about.into_bytes() });
    Ok(files)
}

/// The `package.json`, as text: of what is exported, programs take the first that they know.
fn about(version: &str, files: &[&str]) -> String {
    format!(
        r#"{{
  "name": "mediant",
  "version": "{version}",
  "description": "Pathfinding on grids in 4, 8, 16, 32, … directions or at any angle, in WebAssembly",
  "license": "MIT",
  "keywords": ["pathfinding", "grid", "a-star", "any-angle", "jps", "wasm"],
  "type": "module",
  "main": "mediant.js",
  "types": "mediant.d.ts",
  "exports": {{
    ".": {{ "types": "./mediant.d.ts", "default": "./mediant.js" }},
    "./mediant_bg.wasm": "./mediant_bg.wasm",
    "./package.json": "./package.json"
  }},
  "sideEffects": false,
  "files": {files:?}
}}
"#
    )
}

/// Prints what the module weighs.
fn report(package: &Path) -> Result<(), Error> {
    let path: PathBuf = package.join("mediant_bg.wasm");
    let bytes = fs::read(&path).map_err(Error::at(&path))?;
    let mut packed = GzEncoder::new(Vec::new(), Compression::best());
    let packed = packed.write_all(&bytes).and_then(|()| packed.finish()).map_err(Error::at(&path))?;
    println!("mediant_bg.wasm: {} bytes, {} by gzip -9", bytes.len(), packed.len());
    if packed.len() > LARGEST {
        return Err(Error::Large {
            what: "mediant_bg.wasm, by gzip -9,".to_owned(),
            bytes: packed.len(),
            limit: LARGEST,
            reason: "the page is to be there within a second",
        });
    }
    Ok(())
}
