//! A copy of the project with all mutants in its sources, compiled once.

use std::{
    collections::{BTreeMap, BTreeSet, HashMap},
    fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use mediant_sets::root;
use serde_json::Value;
use sha2::{Digest, Sha256};

use super::{
    hex,
    list::Mutant,
    schema::{Schema, Site, schema},
};
use crate::{Error, Tree, project::LIBRARIES};

/// The crate by which code asks for the active mutant.
const RUNTIME: &str = include_str!("runtime.txt");
const RUNTIME_MANIFEST: &str = "[package]\nname = \"mutant\"\nversion = \"0.0.0\"\nedition = \"2024\"\n";
/// The crates with mutants.
const MUTATED: [&str; 6] = ["moves", "grid", "search", "subgoal", "hierarchy", "costs"];

/// The copy.
pub(super) struct MutatedProject {
    pub(super) folder: PathBuf,
    sources: BTreeMap<String, String>,
}

/// A program of tests.
#[derive(Clone, Debug)]
pub(super) struct Program {
    pub(super) path: PathBuf,
    /// The folder of its crate, in the copy.
    pub(super) folder: PathBuf,
    pub(super) name: String,
}

/// The copy, compiled.
pub(super) struct Built {
    /// For each mutant that compiles, the first of its place.
    pub(super) places: HashMap<u32, u32>,
    pub(super) programs: Vec<Program>,
    /// A digest of the programs.
    pub(super) digest: String,
}

fn digest(programs: &[Program]) -> Result<String, Error> {
    let mut digest = Sha256::new();
    for Program { path, name, .. } in programs {
        digest.update(name);
        digest.update(fs::read(path).map_err(Error::at(path))?);
    }
    Ok(hex(digest))
}

impl MutatedProject {
    /// Copies the project to target/mutants/tree, but for the sources that will have these mutants.
    pub(super) fn new(mutants: &[Mutant]) -> Result<Self, Error> {
        let changed: BTreeSet<&str> = mutants.iter().map(|mutant| &*mutant.file).collect();
        let folder = root().join("target/mutants/tree");
        let mut sources = BTreeMap::new();
        let manifests = MUTATED.map(|name| format!("crates/{name}/Cargo.toml"));
        for (path, bytes) in Tree::read(&root())?.files() {
            let (name, text) = (path.to_string_lossy().into_owned(), String::from_utf8_lossy(bytes));
            if changed.contains(&*name) {
                sources.insert(name, text.into_owned());
            } else if manifests.contains(&name) {
                let with = "[dependencies]\nmutant = { path = \"../mutant\" }\n";
                write(&folder.join(path), text.replacen("[dependencies]\n", with, 1).as_bytes())?;
            } else {
                write(&folder.join(path), bytes)?;
            }
        }
        write(&folder.join("crates/mutant/Cargo.toml"), RUNTIME_MANIFEST.as_bytes())?;
        write(&folder.join("crates/mutant/src/lib.rs"), RUNTIME.as_bytes())?;
        Ok(Self { folder, sources })
    }

    /// Puts all mutants into the sources, but for those that do not compile, and compiles the tests.
    pub(super) fn build(&self, mutants: &[Mutant]) -> Result<Built, Error> {
        let mut of_file: BTreeMap<&str, Vec<&Mutant>> = BTreeMap::new();
        for mutant in mutants {
            of_file.entry(&mutant.file).or_default().push(mutant);
        }
        let mut left_out = self.known(mutants);
        let mut round = 0;
        loop {
            round += 1;
            let mut schemata = BTreeMap::new();
            for (file, mutants) in &of_file {
                let wanted: Vec<&Mutant> =
                    mutants.iter().filter(|mutant| !left_out.contains(&mutant.id)).copied().collect();
                schemata.insert(*file, self.put(file, &wanted, &mut left_out)?);
            }
            let before = left_out.len();
            let faults = self.faults(&schemata, &mut left_out)?;
            println!("round {round} of compiling: {} mutants do not compile", left_out.len());
            if faults == 0 {
                let sites = schemata.values().flat_map(|schema| &schema.sites);
                let of_site = |site: &Site| {
                    let first = site.arms.first().map_or(0, |(id, _)| *id);
                    site.arms.iter().map(move |(id, _)| (*id, first)).collect::<Vec<_>>()
                };
                let places = sites.flat_map(of_site).collect();
                let programs = self.programs()?;
                return Ok(Built { places, digest: digest(&programs)?, programs });
            }
            if left_out.len() == before {
                return Err(Error::Step { command: "cargo check, with mutants".to_owned() });
            }
            self.keep(mutants, &left_out)?;
        }
    }

    /// Writes a source with these mutants. One that has no place in it is left out.
    fn put(&self, file: &str, mutants: &[&Mutant], left_out: &mut BTreeSet<u32>) -> Result<Schema, Error> {
        let source = self.sources.get(file).map_or("", String::as_str);
        let step = |error: syn::Error| Error::Step { command: format!("reading {file}: {error}") };
        let schema = schema(source, mutants).map_err(step)?;
        let placed: BTreeSet<u32> =
            schema.sites.iter().flat_map(|site| site.arms.iter().map(|(id, _)| *id)).collect();
        left_out.extend(mutants.iter().map(|mutant| mutant.id).filter(|id| !placed.contains(id)));
        write(&self.folder.join(file), schema.text.as_bytes())?;
        Ok(schema)
    }

    /// Checks the libraries with their tests, and leaves out the mutants in which errors are. Gives the
    /// number of errors.
    fn faults(&self, of: &BTreeMap<&str, Schema>, left_out: &mut BTreeSet<u32>) -> Result<usize, Error> {
        let messages = self.cargo(&["check", "--lib", "--tests", "--keep-going"])?;
        let mut faults = 0;
        for message in errors(&messages) {
            let spans = message.get("spans").and_then(Value::as_array).cloned().unwrap_or_default();
            let text = message.get("rendered").and_then(Value::as_str).unwrap_or_default();
            if spans.is_empty() {
                continue;
            }
            faults += 1;
            let before = left_out.len();
            let is_first = |span: &&Value| span.get("is_primary").and_then(Value::as_bool) == Some(true);
            let (first, others): (Vec<&Value>, Vec<&Value>) = spans.iter().partition(is_first);
            for span in first.into_iter().chain(others) {
                leave_out(span, of, left_out);
                if left_out.len() > before {
                    break;
                }
            }
            if left_out.len() == before {
                println!("{text}");
            }
        }
        Ok(faults)
    }

    /// The programs of all tests of the libraries.
    fn programs(&self) -> Result<Vec<Program>, Error> {
        let messages = self.cargo(&["test", "--no-run", "--lib", "--tests"])?;
        if errors(&messages).next().is_some() {
            return Err(Error::Step { command: "cargo test --no-run, with mutants".to_owned() });
        }
        let programs = messages.iter().filter_map(|message| {
            let path = PathBuf::from(message.get("executable")?.as_str()?);
            let folder = Path::new(message.get("manifest_path")?.as_str()?).parent()?.to_owned();
            let target = message.get("target")?;
            let kind = target.get("kind")?.get(0)?.as_str()?;
            let name = format!("{} {kind} {}", folder.file_name()?.to_str()?, target.get("name")?.as_str()?);
            Some(Program { path, folder, name })
        });
        let mut programs: Vec<Program> = programs.collect();
        programs.sort_by(|one, other| one.name.cmp(&other.name));
        Ok(programs)
    }

    /// The messages of cargo, run in the copy over all libraries.
    fn cargo(&self, arguments: &[&str]) -> Result<Vec<Value>, Error> {
        let step = || Error::Step { command: format!("cargo {}", arguments.join(" ")) };
        let mut command = Command::new("cargo");
        for name in ["CARGO", "CARGO_MANIFEST_DIR", "CARGO_TARGET_DIR"] {
            command.env_remove(name);
        }
        command.current_dir(&self.folder).args(arguments).arg("--message-format=json");
        command.args(LIBRARIES.iter().flat_map(|library| ["-p", library]));
        command.env("RUSTC_BOOTSTRAP", "1").env("RUSTFLAGS", "--cap-lints=allow");
        command.env("CARGO_TARGET_DIR", root().join("target/mutants/build"));
        command.env("CARGO_PROFILE_DEV_DEBUG", "none").env("CARGO_INCREMENTAL", "1");
        let output = command.stderr(Stdio::inherit()).output().map_err(|_| step())?;
        let messages: Vec<Value> = output
            .stdout
            .split(|byte| *byte == b'\n')
            .filter_map(|line| serde_json::from_slice(line).ok())
            .collect();
        // An error without a message of the compiler is of cargo itself.
        let has_message = messages.iter().any(|message| message.get("message").is_some());
        if output.status.success() || has_message { Ok(messages) } else { Err(step()) }
    }

    /// The file with the mutants of before that do not compile, by their words.
    fn list(&self) -> PathBuf {
        self.folder.with_file_name("not-compiled.txt")
    }

    fn known(&self, mutants: &[Mutant]) -> BTreeSet<u32> {
        let text = fs::read_to_string(self.list()).unwrap_or_default();
        let known: BTreeSet<&str> = text.lines().collect();
        mutants.iter().filter(|mutant| known.contains(&*mutant.key())).map(|mutant| mutant.id).collect()
    }

    fn keep(&self, mutants: &[Mutant], left_out: &BTreeSet<u32>) -> Result<(), Error> {
        let keys = mutants.iter().filter(|mutant| left_out.contains(&mutant.id)).map(Mutant::key);
        write(&self.list(), keys.collect::<Vec<_>>().join("\n").as_bytes())
    }
}

/// The errors among the messages of cargo.
fn errors(messages: &[Value]) -> impl Iterator<Item = &Value> {
    let of_compiler = messages.iter().filter_map(|message| message.get("message"));
    of_compiler.filter(|message| message.get("level").and_then(Value::as_str) == Some("error"))
}

/// Leaves out the mutant at a place where the compiler found a fault; or all mutants of the site, where the
/// fault is in what all of them share.
fn leave_out(span: &Value, of: &BTreeMap<&str, Schema>, left_out: &mut BTreeSet<u32>) {
    let number = |name: &str| span.get(name).and_then(Value::as_u64).unwrap_or(0) as usize;
    let file = span.get("file_name").and_then(Value::as_str).unwrap_or_default();
    let (start, end) = (number("byte_start"), number("byte_end"));
    // The text of a macro is in another file.
    if let Some(outer) = span.get("expansion").and_then(|expansion| expansion.get("span")) {
        leave_out(outer, of, left_out);
    }
    let Some(schema) = of.get(file) else { return };
    let site = schema.sites.iter().find(|site| site.whole.start <= start && end <= site.whole.end);
    let Some(site) = site else { return };
    let arms = site.arms.iter().filter(|(_, arm)| arm.start <= start && end <= arm.end);
    let of_arm: Vec<u32> = arms.map(|(id, _)| *id).collect();
    let all = site.arms.iter().map(|(id, _)| *id);
    if of_arm.is_empty() { left_out.extend(all) } else { left_out.extend(of_arm) }
}

/// Writes a file, unless it is so already: cargo looks at its time.
fn write(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    if fs::read(path).is_ok_and(|known| known == bytes) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(Error::at(folder))?;
    }
    fs::write(path, bytes).map_err(Error::at(path))
}
