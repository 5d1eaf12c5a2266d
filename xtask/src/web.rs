//! `cargo xtask web`: the npm package `mediant`, and the page that shows it.
//!
//! It compiles `mediant-web` to WebAssembly, has the program `wasm-bindgen` write its JavaScript, and puts
//! two folders together, in `target/web`: `package`, which `npm publish` and `npm install` take, and `page`,
//! which any web server takes. Cargo has the tools of the package besides Rust; npm has the page's bundler,
//! esbuild.

mod bundle;
mod page;
mod parts;
mod tools;

use std::{fs, io::Write, path::Path};

use clap::Args;
use flate2::{Compression, write::GzEncoder};
use mediant_sets::root;
use serde::Deserialize;

use crate::{
    Error,
    ci::step,
    project::{self, Package},
};
use parts::{File, write_folder};

/// The crate.
const CRATE: &str = "mediant-web";

/// A module of the package.
struct Module {
    /// Its folder in the package.
    folder: &'static str,
    profile: &'static str,
    features: &'static [&'static str],
    /// The most bytes, compressed as web servers do, and the reason.
    most: (usize, &'static str),
}

/// The whole one, and the light one: the engines that prepare little, and what a game needs of the rest.
const MODULES: [Module; 2] = [
    Module {
        folder: "",
        profile: "web",
        features: &[],
        most: (1_118_000, "the page is whole when it has come"),
    },
    Module {
        folder: "light",
        profile: "web-light",
        features: &["--no-default-features"],
        most: (294_500, "games load it before they begin, and the page before its first path"),
    },
];

/// The options of `cargo xtask web`.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct Options {
    /// Only provide what builds them: Rust for WebAssembly, the program wasm-bindgen, esbuild
    #[arg(long)]
    pub tools: bool,
    /// Only the package, which needs no npm
    #[arg(long)]
    pub package: bool,
}

/// Builds both folders, or only provides the tools.
///
/// # Errors
/// [`Error::Lacking`] if the target or a program cannot be had, [`Error::Step`] for a command that failed,
/// [`Error::Io`] for a file, [`Error::Large`] if the module or the page weighs too much.
pub fn run(options: Options) -> Result<(), Error> {
    tools::provide_target()?;
    let program = tools::wasm_bindgen()?;
    let bundler = if options.package { None } else { Some(tools::esbuild()?) };
    if options.tools {
        for tool in [Some(&program), bundler.as_ref()].into_iter().flatten() {
            println!("{}", tool.display());
        }
        return Ok(());
    }
    let crates = project::packages()?;
    let found = crates.iter().find(|package| package.name == CRATE);
    let found = found.ok_or_else(|| Error::Lacking {
        what: format!("the workspace has no crate {CRATE}"),
        mend: "run this in a clone of the whole project".to_owned(),
    })?;
    let web = root().join("target/web");
    let (package, bound) = (web.join("package"), web.join("bound"));
    // Files of an older version would be taken for a part of the package.
    if bound.exists() {
        fs::remove_dir_all(&bound).map_err(Error::at(&bound))?;
    }
    for module in &MODULES {
        let compiled = tools::compile(CRATE, module.profile, module.features)?;
        bind(&program, &compiled, &bound.join(module.folder))?;
    }
    write_folder(&package, &package_files(found, &bound)?)?;
    MODULES.iter().try_for_each(|module| report(&package, module))?;
    println!("The package: target/web/package");
    let Some(bundler) = bundler else { return Ok(()) };
    let version = page::write(&bundler, &web)?;
    println!("The page, version {version}: target/web/page");
    println!("To see it: node crates/web/serve.mjs, or python3 -m http.server --directory target/web/page");
    Ok(())
}

/// Runs `wasm-bindgen` on the compiled module.
fn bind(program: &Path, module: &Path, out: &Path) -> Result<(), Error> {
    let mut command = std::process::Command::new(program);
    command.args(["--target", "web", "--out-name", "mediant"]);
    // Names of functions, which only a debugger reads, are a tenth of the module.
    command.args(["--remove-name-section", "--remove-producers-section", "--out-dir"]);
    step(command.arg(out).arg(module), "wasm-bindgen --target web --out-name mediant …")
}

/// The files that `package.json` names, and itself. They lie beside it, or `wasm-bindgen` wrote them.
fn package_files(package: &Package, bound: &Path) -> Result<Vec<File>, Error> {
    let folder = root().join("crates/web");
    let about = File::read(&folder.join("package.json"), "package.json")?;
    let names = named(&about.bytes, &package.version)?;
    let mut files = vec![about];
    for name in &names {
        let written = bound.join(name);
        // Both modules are loaded alike in Node.js.
        let beside = folder.join(name.strip_prefix("light/").unwrap_or(name));
        files.push(File::read(&if written.is_file() { written } else { beside }, name)?);
    }
    Ok(files)
}

/// The files that a `package.json` names, if its version is that of the crates.
fn named(about: &[u8], version: &str) -> Result<Vec<String>, Error> {
    #[derive(Deserialize)]
    struct About {
        version: String,
        files: Vec<String>,
    }
    let wrong =
        |mend: String| Error::Lacking { what: "crates/web/package.json is not as it must be".into(), mend };
    let about: About = serde_json::from_slice(about).map_err(|error| wrong(error.to_string()))?;
    if about.version == version {
        Ok(about.files)
    } else {
        Err(wrong(format!("its version is {}, that of the crates {version}", about.version)))
    }
}

/// Prints what a module weighs.
fn report(package: &Path, module: &Module) -> Result<(), Error> {
    let path = package.join(module.folder).join("mediant_bg.wasm");
    let name = path.strip_prefix(package).unwrap_or(&path).display().to_string();
    let bytes = fs::read(&path).map_err(Error::at(&path))?;
    let mut packed = GzEncoder::new(Vec::new(), Compression::best());
    let packed = packed.write_all(&bytes).and_then(|()| packed.finish()).map_err(Error::at(&path))?;
    println!("{name}: {} bytes, {} by gzip -9", bytes.len(), packed.len());
    let (limit, reason) = module.most;
    if packed.len() > limit {
        return Err(Error::Large {
            what: format!("{name}, by gzip -9,"),
            bytes: packed.len(),
            limit,
            reason,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::named;

    #[test]
    fn the_package_has_the_version_of_the_crates() {
        let about = br#"{"name": "mediant", "version": "0.1.0", "files": ["mediant.js"]}"#;
        assert_eq!(named(about, "0.1.0").unwrap(), ["mediant.js"]);
        assert!(named(about, "0.2.0").unwrap_err().to_string().contains("0.1.0, that of the crates 0.2.0"));
        assert!(named(b"{", "0.1.0").is_err());
    }
}
