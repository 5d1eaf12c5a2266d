//! `cargo xtask c`: installs the library for C, with its headers, and what pkg-config and CMake find it by.
//!
//! The shared library is linked here, from the static one. Rust's own shared library exports the same
//! functions and needs nothing else at run time; but it has no version of its interface, neither in its name
//! nor at its symbols, since Rust hands the linker a list of symbols that cannot be joined with versions.

use std::{
    env,
    ffi::OsString,
    fs,
    path::{Component, Path, PathBuf},
    process::Command,
};

use clap::Args;
use mediant_sets::root;
use serde::Deserialize;

use crate::{
    Error,
    ci::step,
    project::{self, Package, run_cargo},
};

mod names;

use names::Names;

/// The options of `cargo xtask c`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// The folder to install into; where DESTDIR is set, below that
    #[arg(long, value_name = "FOLDER", default_value = "/usr/local")]
    pub prefix: PathBuf,
    /// The folder of libraries in it, such as lib/x86_64-linux-gnu
    #[arg(long, value_name = "FOLDER", default_value = "lib")]
    pub libdir: PathBuf,
    /// Install what `cargo build --release -p mediant-c` left in this folder, instead of building it
    #[arg(long, value_name = "FOLDER")]
    pub built: Option<PathBuf>,
}

/// Builds and installs.
///
/// # Errors
/// [`Error::Step`] for a command that failed, [`Error::Io`] for a file or folder that the system refuses,
/// [`Error::Lacking`] for a folder of libraries that is not below the prefix.
pub fn run(options: &Options) -> Result<(), Error> {
    if !options.libdir.components().all(|part| matches!(part, Component::Normal(_))) {
        return Err(Error::Lacking {
            what: format!("--libdir {} is no folder below the prefix", options.libdir.display()),
            mend: "name one as lib64".to_owned(),
        });
    }
    let built = match &options.built {
        Some(folder) => folder.clone(),
        None => build()?,
    };
    let version = version()?;
    let names = Names::here(&version);
    let prefix = below(env::var_os("DESTDIR"), &options.prefix);
    let library = Installed { prefix: &prefix, libdir: &options.libdir, names: &names };
    library.libraries(&built)?;
    library.headers()?;
    for (folder, file) in [
        ("pkgconfig", "mediant.pc"),
        ("cmake/Mediant", "MediantConfig.cmake"),
        ("cmake/Mediant", "MediantConfigVersion.cmake"),
    ] {
        library.description(folder, file, &version)?;
    }
    println!("libmediant {version} is in {}", prefix.display());
    Ok(())
}

/// Where packagers want the files: the prefix, below a folder of theirs.
fn below(folder: Option<OsString>, prefix: &Path) -> PathBuf {
    match folder.filter(|folder| !folder.is_empty()) {
        Some(folder) => {
            let parts = prefix.components().filter(|part| matches!(part, Component::Normal(_)));
            PathBuf::from(folder).join(parts.collect::<PathBuf>())
        }
        // Cargo runs this in the folder where it was called.
        None => prefix.to_owned(),
    }
}

/// Builds both libraries, and returns their folder.
fn build() -> Result<PathBuf, Error> {
    #[derive(Deserialize)]
    struct Metadata {
        target_directory: PathBuf,
    }
    let arguments = ["build", "--release", "--package", "mediant-c"];
    step(project::cargo().args(arguments), &format!("cargo {}", arguments.join(" ")))?;
    let arguments = ["metadata", "--no-deps", "--format-version", "1"];
    let metadata = serde_json::from_str::<Metadata>(&run_cargo(&arguments)?);
    metadata
        .map(|metadata| metadata.target_directory.join("release"))
        .map_err(|error| Error::Step { command: format!("cargo {}: {error}", arguments.join(" ")) })
}

fn version() -> Result<String, Error> {
    let is_c = |package: &Package| package.name == "mediant-c";
    let package = project::packages()?.into_iter().find(is_c);
    package.map(|package| package.version).ok_or_else(|| Error::Lacking {
        what: "there is no crate mediant-c".to_owned(),
        mend: "look into Cargo.toml".to_owned(),
    })
}

/// The installed library.
struct Installed<'a> {
    prefix: &'a Path,
    libdir: &'a Path,
    names: &'a Names,
}

impl Installed<'_> {
    fn libraries(&self, built: &Path) -> Result<(), Error> {
        let names = self.names;
        let folder = self.prefix.join(self.libdir);
        copy(&built.join(names.built_static), &folder.join(names.static_))?;
        if let Some(implib) = names.implib {
            copy(&built.join(implib), &folder.join(implib))?;
            return copy(&built.join(&names.shared), &self.prefix.join("bin").join(&names.shared));
        }
        let scratch = tempfile::tempdir().map_err(Error::at(&env::temp_dir()))?;
        let script = scratch.path().join("mediant.map");
        fs::write(&script, names.script()).map_err(Error::at(&script))?;
        let shared = folder.join(&names.shared);
        let arguments = names.link(&script, &folder.join(names.static_));
        let linker = env::var_os("CC").unwrap_or_else(|| "cc".into());
        let shown = format!("{} {}", linker.to_string_lossy(), arguments.join(" "));
        step(Command::new(linker).args(&arguments).arg("-o").arg(&shared), &shown)?;
        for link in &names.links {
            link_to(&names.shared, &folder.join(link))?;
        }
        Ok(())
    }

    fn headers(&self) -> Result<(), Error> {
        let from = root().join("crates/c/include");
        let to = self.prefix.join("include");
        for folder in ["", "mediant"] {
            let at = from.join(folder);
            for entry in fs::read_dir(&at).map_err(Error::at(&at))? {
                let entry = entry.map_err(Error::at(&at))?;
                if entry.path().is_file() {
                    copy(&entry.path(), &to.join(folder).join(entry.file_name()))?;
                }
            }
        }
        Ok(())
    }

    /// Writes what pkg-config or CMake reads.
    fn description(&self, folder: &str, file: &str, version: &str) -> Result<(), Error> {
        let template = root().join("crates/c/install").join(format!("{file}.in"));
        let template = fs::read_to_string(&template).map_err(Error::at(&template))?;
        let place = self.libdir.join(folder);
        let to = self.prefix.join(&place).join(file);
        create(&to)?;
        fs::write(&to, fill(&template, &place, self.libdir, self.names, version)).map_err(Error::at(&to))
    }
}

/// A template with its words replaced: for a file in this folder, below the prefix.
fn fill(template: &str, place: &Path, libdir: &Path, names: &Names, version: &str) -> String {
    let mut numbers = version.split('.');
    let up = vec![".."; place.components().count()].join("/");
    let libdir = slashes(libdir);
    let folder = if names.implib.is_some() { "bin" } else { &*libdir };
    let shared = format!("{folder}/{}", names.shared);
    let property = |file| format!("\n    IMPORTED_IMPLIB \"${{_mediant}}/{libdir}/{file}\"");
    let implib = names.implib.map(property).unwrap_or_default();
    let needs: Vec<&str> = names.needs.iter().map(|need| need.trim_start_matches("-l")).collect();
    let words = [
        ("@up@", &*up),
        ("@shared@", &shared),
        ("@implib@", &implib),
        ("@static@", &format!("{libdir}/{}", names.static_)),
        ("@libdir@", &libdir),
        ("@version@", version),
        ("@major@", numbers.next().unwrap_or_default()),
        ("@minor@", numbers.next().unwrap_or_default()),
        ("@soname@", &names.soname),
        ("@flags@", &names.needs.join(" ")),
        ("@needs@", &needs.join(";")),
    ];
    words.iter().fold(template.to_owned(), |text, (word, value)| text.replace(word, value))
}

fn slashes(path: &Path) -> String {
    let parts: Vec<_> = path.components().map(|part| part.as_os_str().to_string_lossy()).collect();
    parts.join("/")
}

/// Copies a file, into a folder that is made for it. Old files go first: a program may be using one.
fn copy(from: &Path, to: &Path) -> Result<(), Error> {
    create(to)?;
    fs::copy(from, to).map(|_| ()).map_err(Error::at(from))
}

/// Makes room for a file: its folder is there, and it is not.
fn create(file: &Path) -> Result<(), Error> {
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder).map_err(Error::at(folder))?;
    }
    if file.symlink_metadata().is_ok() {
        fs::remove_file(file).map_err(Error::at(file))?;
    }
    Ok(())
}

#[cfg(unix)]
fn link_to(name: &str, link: &Path) -> Result<(), Error> {
    create(link)?;
    std::os::unix::fs::symlink(name, link).map_err(Error::at(link))
}

/// Windows knows its libraries by their names alone.
#[cfg(not(unix))]
fn link_to(_: &str, _: &Path) -> Result<(), Error> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{below, fill, names::Names};

    #[test]
    fn packagers_folder_comes_first() {
        assert_eq!(below(Some("made".into()), Path::new("/usr")), Path::new("made/usr"));
        assert_eq!(below(Some("".into()), Path::new("/usr")), Path::new("/usr"));
        assert_eq!(below(None, Path::new("here")), Path::new("here"));
    }

    #[test]
    fn descriptions_lead_from_their_place() {
        let (place, libdir) = (Path::new("lib/a/cmake/Mediant"), Path::new("lib/a"));
        let text =
            fill("@up@ @libdir@ @version@ @major@.@minor@", place, libdir, &Names::here("3.2.1"), "3.2.1");
        assert_eq!(text, "../../../.. lib/a 3.2.1 3.2");
    }
}
