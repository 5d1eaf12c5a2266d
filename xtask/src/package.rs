//! `cargo xtask package`: the published crates as others get them.
//!
//! It proves that each crate can be packaged, and that the packages need nothing besides: not a file of the
//! repository, not a feature that only another crate of the workspace turns on. So they are unpacked in a
//! folder that is otherwise empty, and compiled there from these files, first each crate alone with its
//! default features, then all with all features. Nothing is published.
//!
//! `cargo package` can compile what it packed. That is not used: from the second run on it takes crates of
//! the same version that the first run unpacked, so that it answers for files of yesterday.

use std::{
    fmt::Write,
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use mediant_sets::root;

use crate::{
    Error,
    ci::step,
    project::{self, Package, published},
};

/// The files of every package.
const FILES: [&str; 2] = ["LICENSE", "README.md"];

/// Packs, unpacks and compiles.
///
/// # Errors
/// [`Error::Step`] names the command that failed, [`Error::Missing`] the file that a package lacks;
/// [`Error::Io`] if there is no room for a temporary folder.
pub fn run() -> Result<(), Error> {
    let folder = tempfile::tempdir().map_err(Error::at(&std::env::temp_dir()))?;
    let folder = folder.path();
    pack(folder)?;
    let members = unpack(folder, folder)?;
    write_workspace(folder, &members)?;
    for name in published() {
        compile(folder, &["check", "--package", name])?;
    }
    compile(folder, &["check", "--workspace", "--all-features"])
}

/// Packs all published crates into files of this folder, `NAME-VERSION.crate`.
///
/// It takes all at once, since none of them is in a registry yet. That takes cargo 1.90 or newer.
///
/// # Errors
/// [`Error::Step`] if cargo fails, [`Error::Io`] for a file.
pub(crate) fn pack(into: &Path) -> Result<(), Error> {
    let packages = published().flat_map(|name| ["--package", name]);
    // Not asked for our own crates, no index is needed. `cargo xtask tidy` checks the metadata.
    let options = ["package", "--offline", "--no-verify", "--no-metadata", "--allow-dirty"];
    let arguments: Vec<&str> = options.into_iter().chain(packages).collect();
    let scratch = tempfile::tempdir().map_err(Error::at(&std::env::temp_dir()))?;
    let mut command = project::cargo();
    command.args(&arguments).arg("--target-dir").arg(scratch.path());
    step(&mut command, &format!("cargo {}", arguments.join(" ")))?;
    for package in published_packages()? {
        let file = archive(&package);
        let to = into.join(&file);
        fs::copy(scratch.path().join("package").join(&file), &to).map_err(Error::at(&to))?;
    }
    Ok(())
}

fn published_packages() -> Result<impl Iterator<Item = Package>, Error> {
    let is_published = |package: &Package| published().any(|name| name == package.name);
    Ok(project::packages()?.into_iter().filter(is_published))
}

fn archive(Package { name, version, .. }: &Package) -> String {
    format!("{name}-{version}.crate")
}

/// Unpacks the packages that are in one folder into another, and returns their names, each with its folder's.
///
/// # Errors
/// [`Error::Step`] if one cannot be unpacked, [`Error::Missing`] names a file that it lacks.
pub(crate) fn unpack(from: &Path, folder: &Path) -> Result<Vec<(String, String)>, Error> {
    let mut members = Vec::new();
    for package in published_packages()? {
        let (file, unpacked) = (archive(&package), format!("{}-{}", package.name, package.version));
        let to = folder.join(&file);
        if from != folder {
            fs::copy(from.join(&file), &to).map_err(Error::at(&to))?;
        }
        // A relative path: the `tar` of some systems takes what is before a colon for another machine.
        step(Command::new("tar").arg("-xzf").arg(&file).current_dir(folder), &format!("tar -xzf {file}"))?;
        if let Some(file) = FILES.into_iter().find(|file| !folder.join(&unpacked).join(file).is_file()) {
            return Err(Error::Missing { package: package.name, file });
        }
        members.push((package.name, unpacked));
    }
    Ok(members)
}

/// Makes the folder a workspace of these packages.
///
/// # Errors
/// [`Error::Io`] for its files.
pub(crate) fn write_workspace(folder: &Path, members: &[(String, String)]) -> Result<(), Error> {
    write_manifest(folder, &workspace(members))
}

/// Writes the `Cargo.toml` of a folder, and a lock beside it: the versions of other crates that the project
/// is tested with, so that no network is needed.
///
/// # Errors
/// [`Error::Io`] for these files.
pub(crate) fn write_manifest(folder: &Path, text: &str) -> Result<(), Error> {
    let (manifest, lock) = (folder.join("Cargo.toml"), folder.join("Cargo.lock"));
    fs::write(&manifest, text).map_err(Error::at(&manifest))?;
    fs::copy(root().join("Cargo.lock"), &lock).map_err(Error::at(&lock)).map(drop)
}

fn workspace(members: &[(String, String)]) -> String {
    let folders: Vec<&str> = members.iter().map(|(_, folder)| &**folder).collect();
    format!("[workspace]\nresolver = \"3\"\nmembers = {folders:?}\n\n{}", patches(members))
}

/// The lines by which packages depend on one another, and not on what a registry has.
pub(crate) fn patches(members: &[(String, String)]) -> String {
    let mut text = "[patch.crates-io]\n".to_owned();
    for (name, folder) in members {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name} = {{ path = {folder:?} }}");
    }
    text + "\n[profile.dev]\ndebug = false\n"
}

fn compile(folder: &Path, arguments: &[&str]) -> Result<(), Error> {
    let mut command = project::cargo();
    command.args(arguments).arg("--target-dir").arg(target(folder)).current_dir(folder);
    step(&mut command, &format!("cargo {}", arguments.join(" ")))
}

fn target(folder: &Path) -> PathBuf {
    folder.join("target")
}

#[cfg(test)]
mod tests {
    use super::workspace;

    #[test]
    fn packages_use_one_another() {
        let names = ["a", "b"].map(|name| (name.to_owned(), format!("{name}-0.1.0")));
        let expected = "[workspace]\nresolver = \"3\"\nmembers = [\"a-0.1.0\", \"b-0.1.0\"]\n\n\
                        [patch.crates-io]\na = { path = \"a-0.1.0\" }\nb = { path = \"b-0.1.0\" }\n\n\
                        [profile.dev]\ndebug = false\n";
        assert_eq!(workspace(&names), expected);
    }
}
