//! The files of each world, and their first use.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use mediant_sets::root;

use super::{World, page::first_block};
use crate::{
    Error, c,
    ci::step,
    package,
    project::{PROGRAM, cargo},
    web,
};

/// Makes the files of a world in `into`.
///
/// # Errors
/// As for the chores that make them.
pub(super) fn make(world: World, into: &Path, version: &str) -> Result<(), Error> {
    match world {
        // The program needs the other crates, too.
        World::Rust | World::Shell => package::pack(into),
        World::Python => {
            let arguments = ["-m", "pip", "wheel", "--quiet", "--no-deps", "./crates/python", "--wheel-dir"];
            let mut command = Command::new("python3");
            step(
                command.current_dir(root()).args(arguments).arg(into),
                "python3 -m pip wheel ./crates/python",
            )
        }
        World::Web => {
            web::run(web::Options { package: true, tools: false })?;
            let package = root().join("target/web/package");
            let mut command = Command::new("npm");
            command.args(["pack", "--silent", "--pack-destination"]).arg(into).current_dir(&package);
            step(&mut command, "npm pack")
        }
        World::C => library(into, version),
    }
}

/// The installed library for C, in a folder of its name, as an archive.
fn library(into: &Path, version: &str) -> Result<(), Error> {
    let folder = tempfile::tempdir().map_err(Error::at(&env::temp_dir()))?;
    let name = name_of_library(version);
    let prefix = folder.path().join(&name);
    c::run(&c::Options { prefix: prefix.clone(), libdir: PathBuf::from("lib"), built: None })?;
    let license = prefix.join("LICENSE");
    fs::copy(root().join("LICENSE"), &license).map_err(Error::at(&license))?;
    let mut command = Command::new("tar");
    command.arg("-czf").arg(into.join(format!("{name}.tar.gz"))).arg(&name).current_dir(folder.path());
    step(&mut command, &format!("tar -czf {name}.tar.gz"))
}

fn name_of_library(version: &str) -> String {
    format!("libmediant-{version}-{}-{}", env::consts::ARCH, env::consts::OS)
}

/// Installs the files of a world in an empty folder, runs the first example of its page, and returns what it
/// said.
///
/// # Errors
/// [`Error::Step`] for a command that failed, [`Error::Said`] if the example says something else than its
/// page, [`Error::Io`] for a file.
pub(super) fn first_example(
    world: World,
    files: &Path,
    folder: &Path,
    version: &str,
) -> Result<String, Error> {
    let (mut command, expected) = match world {
        World::Rust => (rust(files, folder)?, first_block("start/rust.md", "text")?),
        World::Shell => (shell(files, folder)?, "drawn path.svg".to_owned()),
        World::Python => (python(files, folder, version)?, "12.485".to_owned()),
        World::Web => (javascript(files, folder, version)?, "Int32Array(12)".to_owned()),
        World::C => (in_c(files, folder, version)?, "3 points, length 6.513".to_owned()),
    };
    let output = command.current_dir(folder).stderr(Stdio::inherit()).output();
    let output = output.ok().filter(|output| output.status.success());
    let failed = || Error::Step { command: format!("the first example, {world:?}") };
    let said = String::from_utf8_lossy(&output.ok_or_else(failed)?.stdout).into_owned();
    if said.contains(&*expected) { Ok(said) } else { Err(Error::Said { said, expected }) }
}

/// A crate that depends on the packages.
fn rust(files: &Path, folder: &Path) -> Result<Command, Error> {
    let members = package::unpack(files, folder)?;
    let about = "[package]\nname = \"first\"\nversion = \"0.0.0\"\nedition = \"2024\"\n";
    let patches = package::patches(&members);
    package::write_manifest(folder, &format!("{about}\n[dependencies]\nmediant = \"*\"\n\n{patches}"))?;
    let source = folder.join("src");
    fs::create_dir(&source).map_err(Error::at(&source))?;
    write(&source.join("main.rs"), &first_block("start/rust.md", "rust")?)?;
    step(cargo().args(["build", "--quiet"]).current_dir(folder), "cargo build")?;
    Ok(Command::new(folder.join("target/debug/first")))
}

/// The program, from its package.
fn shell(files: &Path, folder: &Path) -> Result<Command, Error> {
    let members = package::unpack(files, folder)?;
    package::write_workspace(folder, &members)?;
    let program = members.iter().find(|(name, _)| name == PROGRAM).map_or("", |(_, folder)| folder);
    let mut command = cargo();
    command.args(["install", "--quiet", "--debug", "--no-track", "--path", program, "--root", "installed"]);
    step(command.current_dir(folder), &format!("cargo install --path {program}"))?;
    write(&folder.join("first.sh"), &first_block("start/shell.md", "sh")?)?;
    let path = env::var_os("PATH").unwrap_or_default();
    let paths = [folder.join("installed/bin")].into_iter().chain(env::split_paths(&path));
    let mut command = Command::new("sh");
    command.args(["-e", "first.sh"]).env("PATH", env::join_paths(paths).unwrap_or(path));
    Ok(command)
}

/// The wheel in a virtual environment.
fn python(files: &Path, folder: &Path, version: &str) -> Result<Command, Error> {
    let wheel = beginning(files, &format!("mediant-{version}-"))?;
    step(Command::new("python3").args(["-m", "venv", "venv"]).current_dir(folder), "python3 -m venv")?;
    let python = folder.join(if cfg!(windows) { "venv/Scripts/python.exe" } else { "venv/bin/python" });
    let mut pip = Command::new(&python);
    step(pip.args(["-m", "pip", "install", "--quiet"]).arg(wheel).current_dir(folder), "pip install")?;
    write(&folder.join("first.py"), &first_block("start/python.md", "python")?)?;
    let mut command = Command::new(python);
    command.arg("first.py");
    Ok(command)
}

/// The package by npm.
fn javascript(files: &Path, folder: &Path, version: &str) -> Result<Command, Error> {
    let package = beginning(files, &format!("mediant-{version}.tgz"))?;
    let mut npm = Command::new("npm");
    npm.args(["install", "--silent", "--no-audit", "--no-fund"]).arg(package).current_dir(folder);
    step(&mut npm, "npm install")?;
    write(&folder.join("first.mjs"), &first_block("start/web.md", "js")?)?;
    let mut command = Command::new("node");
    command.arg("first.mjs");
    Ok(command)
}

/// The library, by pkg-config.
fn in_c(files: &Path, folder: &Path, version: &str) -> Result<Command, Error> {
    let name = name_of_library(version);
    let mut tar = Command::new("tar");
    step(tar.arg("-xzf").arg(files.join(format!("{name}.tar.gz"))).current_dir(folder), "tar -xzf")?;
    write(&folder.join("path.c"), &first_block("start/c.md", "c")?)?;
    let lib = folder.join(name).join("lib");
    let mut compile = Command::new("sh");
    compile.args(["-c", "cc path.c $(pkg-config --cflags --libs mediant) -o path"]);
    compile.env("PKG_CONFIG_PATH", lib.join("pkgconfig")).current_dir(folder);
    step(&mut compile, "cc path.c $(pkg-config --cflags --libs mediant) -o path")?;
    let mut command = Command::new(folder.join("path"));
    command.env("LD_LIBRARY_PATH", &lib);
    Ok(command)
}

/// The file whose name begins so.
fn beginning(folder: &Path, beginning: &str) -> Result<PathBuf, Error> {
    let entries = fs::read_dir(folder).map_err(Error::at(folder))?;
    let mut paths = entries.filter_map(|entry| entry.ok().map(|entry| entry.path()));
    let begins =
        |path: &PathBuf| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(beginning));
    paths.find(begins).ok_or_else(|| Error::Lacking {
        what: format!("{} has no file {beginning}…", folder.display()),
        mend: "run this without --only".to_owned(),
    })
}

fn write(path: &Path, text: &str) -> Result<(), Error> {
    fs::write(path, text).map_err(Error::at(path))
}
