//! The tools that build the package and the page: Rust for WebAssembly, the programs `wasm-bindgen` and
//! esbuild.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use mediant_sets::root;
use serde_json::Value;

use crate::{Error, ci::step, project};

const TARGET: &str = "wasm32-unknown-unknown";

/// Installs the standard library for WebAssembly, unless it is there.
pub(super) fn provide_target() -> Result<(), Error> {
    if has_target() {
        return Ok(());
    }
    let mut rustup = Command::new("rustup");
    let done = step(rustup.args(["target", "add", TARGET]), &format!("rustup target add {TARGET}"));
    if done.is_ok() && has_target() {
        return Ok(());
    }
    Err(Error::Lacking {
        what: format!("this Rust cannot compile for {TARGET}"),
        mend: format!(
            "`rustup target add {TARGET}` gets it (rustup is at https://rustup.rs), or the package of your \
             system that has Rust's standard library for WebAssembly"
        ),
    })
}

fn has_target() -> bool {
    let mut rustc = Command::new(env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
    let output = rustc.args(["--print", "target-libdir", "--target", TARGET]).output();
    output.is_ok_and(|output| {
        let folder = String::from_utf8_lossy(&output.stdout).trim().to_owned();
        output.status.success() && fs::read_dir(folder).is_ok_and(|mut files| files.next().is_some())
    })
}

/// The program `wasm-bindgen` of exactly the version that `Cargo.lock` has of the crate: the two speak a
/// language of their own, which changes with every version. It is looked for on the path, then in
/// `target/tools`, where it is otherwise installed.
pub(super) fn wasm_bindgen() -> Result<PathBuf, Error> {
    let lock = root().join("Cargo.lock");
    let text = fs::read_to_string(&lock).map_err(Error::at(&lock))?;
    let version = locked(&text, "wasm-bindgen").ok_or_else(|| Error::Lacking {
        what: "Cargo.lock has no crate wasm-bindgen".to_owned(),
        mend: "`cargo update --workspace` adds it".to_owned(),
    })?;
    let tools = root().join("target/tools");
    let own = tools.join("bin").join(format!("wasm-bindgen{}", env::consts::EXE_SUFFIX));
    for program in [PathBuf::from("wasm-bindgen"), own.clone()] {
        if is_of(&program, version) {
            return Ok(program);
        }
    }
    install(&tools, version);
    if is_of(&own, version) {
        return Ok(own);
    }
    Err(Error::Lacking {
        what: format!("there is no program wasm-bindgen {version}, neither on PATH nor in target/tools/bin"),
        mend: format!("`cargo install wasm-bindgen-cli --version {version}` gets it"),
    })
}

/// The bundler, of exactly the version that `crates/web/page/package.json` names. npm installs it into
/// `target/tools/page`.
pub(super) fn esbuild() -> Result<PathBuf, Error> {
    let wanted = root().join("crates/web/page/package.json");
    let about = fs::read(&wanted).map_err(Error::at(&wanted))?;
    let about: Value = serde_json::from_slice(&about).unwrap_or_default();
    let version = about["devDependencies"]["esbuild"].as_str().ok_or_else(|| Error::Lacking {
        what: "crates/web/page/package.json names no version of esbuild".to_owned(),
        mend: "name one among its `devDependencies`".to_owned(),
    })?;
    let folder = root().join("target/tools/page");
    let suffix = if cfg!(windows) { ".cmd" } else { "" };
    let program = folder.join(format!("node_modules/.bin/esbuild{suffix}"));
    if says(&program, version) {
        return Ok(program);
    }
    fs::create_dir_all(&folder).map_err(Error::at(&folder))?;
    fs::copy(&wanted, folder.join("package.json")).map_err(Error::at(&wanted))?;
    let mut npm = Command::new(format!("npm{suffix}"));
    npm.args(["install", "--ignore-scripts", "--no-audit", "--no-fund", "--no-package-lock"]);
    let done = step(npm.arg("--loglevel=error").current_dir(&folder), "npm install esbuild");
    if done.is_ok() && says(&program, version) {
        return Ok(program);
    }
    Err(Error::Lacking {
        what: format!("npm cannot install esbuild {version}, which bundles the page"),
        mend: "install Node.js 20 or newer with npm, or take `--package` for the package alone".to_owned(),
    })
}

/// Whether a program says this version and no more.
fn says(program: &Path, version: &str) -> bool {
    let output = Command::new(program).arg("--version").stderr(Stdio::null()).output();
    output.is_ok_and(|output| String::from_utf8_lossy(&output.stdout).trim() == version)
}

/// The version of a crate in a `Cargo.lock`.
fn locked<'a>(lock: &'a str, name: &str) -> Option<&'a str> {
    let at = lock.find(&format!("\nname = \"{name}\"\n"))?;
    lock[at..].lines().find_map(|line| line.strip_prefix("version = \"")?.strip_suffix('"'))
}

fn is_of(program: &Path, version: &str) -> bool {
    let output = Command::new(program).arg("--version").stderr(Stdio::null()).output();
    output.is_ok_and(|output| {
        String::from_utf8_lossy(&output.stdout).split_whitespace().nth(1) == Some(version)
    })
}

/// Installs the program, and the one that runs tests. First with the crates that its authors tested it with;
/// a registry that lacks one of them may have a later one. Whether it worked is seen by the program itself.
fn install(tools: &Path, version: &str) {
    println!("The first time, the program wasm-bindgen {version} is compiled, which takes some minutes.");
    for locked in [&["--locked"][..], &[]] {
        let mut command = project::cargo();
        command.args(["install", "wasm-bindgen-cli", "--force", "--version", version]).args(locked);
        // It runs for seconds, and optimizing it would take minutes.
        command.args(["--profile", "dev", "--bin", "wasm-bindgen", "--bin", "wasm-bindgen-test-runner"]);
        command.env("CARGO_PROFILE_DEV_OPT_LEVEL", "0").env("CARGO_PROFILE_DEV_DEBUG", "false");
        let shown = format!("cargo install wasm-bindgen-cli --version {version} {}", locked.join(" "));
        if step(command.arg("--root").arg(tools), shown.trim_end()).is_ok() {
            return;
        }
    }
}

/// Compiles the crate to WebAssembly by a profile, and returns the module.
pub(super) fn compile(package: &str, profile: &str, features: &[&str]) -> Result<PathBuf, Error> {
    let mut arguments =
        vec!["build", "--package", package, "--lib", "--target", TARGET, "--profile", profile];
    arguments.extend(features);
    let shown = format!("cargo {}", arguments.join(" "));
    println!("$ {shown}");
    let mut cargo = project::cargo();
    // Cargo itself says where the module is: the folder depends on the user's settings.
    cargo.args(arguments).args(["--message-format", "json-render-diagnostics"]).stderr(Stdio::inherit());
    if let Some(registry) = registry() {
        // Messages of panics name files; where those lie on this machine is nobody's business.
        cargo.env("CARGO_ENCODED_RUSTFLAGS", format!("--remap-path-prefix={}=crates.io", registry.display()));
    }
    let output = cargo.output().ok().filter(|output| output.status.success());
    let messages = output.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
    let messages = messages.ok_or_else(|| Error::Step { command: shown.clone() })?;
    let mut modules = messages.lines().filter_map(|line| {
        let message: Value = serde_json::from_str(line).ok()?;
        let files = message.get("filenames")?.as_array()?;
        files
            .iter()
            .filter_map(Value::as_str)
            .find(|file| file.ends_with("mediant_web.wasm"))
            .map(PathBuf::from)
    });
    modules.next_back().ok_or(Error::Step { command: shown })
}

/// The folder of the sources that cargo downloaded.
fn registry() -> Option<PathBuf> {
    let home = env::var_os("CARGO_HOME").map(PathBuf::from);
    Some(home.or_else(|| Some(env::home_dir()?.join(".cargo")))?.join("registry").join("src"))
}

#[cfg(test)]
mod tests {
    use super::locked;

    #[test]
    fn versions_in_a_lock() {
        let lock = "version = 4\n\n[[package]]\nname = \"wasm-bindgen-macro\"\nversion = \"0.2.1\"\n\n\
                    [[package]]\nname = \"wasm-bindgen\"\nversion = \"0.2.130\"\n";
        assert_eq!(locked(lock, "wasm-bindgen"), Some("0.2.130"));
        assert_eq!(locked(lock, "wasm-bindgen-macro"), Some("0.2.1"));
        assert_eq!(locked(lock, "wasm"), None);
    }
}
