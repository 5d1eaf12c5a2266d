//! `cargo xtask fuzz`: runs the targets of `crates/fuzz` by libFuzzer, and adds up what ran.
//!
//! The targets take turns. Each begins with its kept inputs, with valid ones that the library writes, and
//! with what earlier runs on this machine found, in `target/fuzz`. A turn ends when the target's share of
//! the time is over, or when it was quiet: when it has reached no new edge of the code for so long. The
//! record, `docs/proof/fuzzing.json`, adds up the executions, so that fuzzing goes on from day to day.

mod keep;
mod log;
mod record;

use std::{
    env, fs,
    io::{BufRead, BufReader, Read},
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    sync::mpsc::{self, Receiver, RecvTimeoutError},
    thread,
    time::{Duration, Instant},
};

use clap::Args;
use mediant_sets::root;

use self::{log::Log, record::Turn};
use crate::Error;

/// The options of `cargo xtask fuzz`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// The targets; all without any
    targets: Vec<String>,
    /// The minutes of all targets together; 0 to keep what was found
    #[arg(long, value_name = "N", default_value = "10")]
    minutes: f64,
    /// Ends a target's turn when it has reached no new edge for so many minutes
    #[arg(long, value_name = "N", default_value = "30")]
    quiet: f64,
    /// Add what ran to the record, docs/proof/fuzzing.json
    #[arg(long)]
    record: bool,
    /// Keep a few small inputs that together reach most, in crates/fuzz/corpus
    #[arg(long)]
    keep: bool,
    /// Take the program as it was built last
    #[arg(long)]
    built: bool,
    /// Watch memory by a sanitizer of Rust: address, leak
    #[arg(long, value_name = "NAME", default_value = "none")]
    sanitizer: String,
}

/// From one look at the time to the next, where libFuzzer says nothing.
const LOOK: Duration = Duration::from_secs(1);

/// Runs the targets.
///
/// # Errors
/// [`Error::Lacking`] without nightly Rust or cargo-fuzz; [`Error::Step`] if the program cannot be built;
/// [`Error::Found`] for an input that a target treats wrongly, whose file is named; [`Error::Io`] for files.
pub fn run(options: &Options) -> Result<(), Error> {
    let program = if options.built { Fuzzer::built() } else { Fuzzer::build(&options.sanitizer)? };
    let known = program.targets()?;
    let asked = if options.targets.is_empty() { &known } else { &options.targets };
    if let Some(unknown) = asked.iter().find(|name| !known.contains(name)) {
        let known = known.join(", ");
        return Err(Error::Lacking {
            what: format!("no target is called {unknown}"),
            mend: format!("one of {known}"),
        });
    }
    let share = Duration::from_secs_f64(options.minutes * 60.0 / asked.len() as f64);
    let mut found = Vec::new();
    for name in asked {
        if !share.is_zero() {
            let (turn, inputs) = program.turn(name, share, Duration::from_secs_f64(options.quiet * 60.0))?;
            println!("{name}: {turn}");
            found.extend(inputs);
            if options.record {
                record::add(name, &turn)?;
            }
        }
        if options.keep {
            keep::keep(&program, name)?;
        }
    }
    if found.is_empty() { Ok(()) } else { Err(Error::Found { files: found }) }
}

/// The program of all targets, built for libFuzzer.
struct Fuzzer {
    program: PathBuf,
    folder: PathBuf,
}

fn io(path: &Path) -> impl FnOnce(std::io::Error) -> Error + '_ {
    |source| Error::Io { path: path.to_owned(), source }
}

impl Fuzzer {
    /// The program that was built last, of these sources or of others.
    fn built() -> Self {
        let folder = root().join("target/fuzz");
        let host = env::consts::ARCH;
        let program = folder.join(format!("{host}-unknown-linux-gnu/release/targets"));
        Self { program, folder }
    }

    /// Builds it by `cargo fuzz`, which knows the flags of libFuzzer. The program is linked once.
    fn build(sanitizer: &str) -> Result<Self, Error> {
        let has = |arguments: &[&str]| {
            let command =
                Command::new("cargo").args(arguments).stdout(Stdio::null()).stderr(Stdio::null()).status();
            command.is_ok_and(|status| status.success())
        };
        let lacking =
            |what: &str, mend: &str| Error::Lacking { what: what.to_owned(), mend: mend.to_owned() };
        if !has(&["+nightly", "--version"]) {
            return Err(lacking("no nightly Rust", "rustup toolchain install nightly"));
        }
        if !has(&["fuzz", "--version"]) {
            return Err(lacking("no cargo-fuzz", "cargo install cargo-fuzz --locked"));
        }
        let fuzzer = Self::built();
        let mut command = Command::new("cargo");
        command.current_dir(root().join("crates/fuzz")).env("CARGO_TARGET_DIR", &fuzzer.folder);
        // Cargo has said to its own children which Rust it is.
        for name in ["CARGO", "RUSTUP_TOOLCHAIN", "RUSTFLAGS"] {
            command.env_remove(name);
        }
        command.args(["+nightly", "fuzz", "build", "--fuzz-dir", ".", "--features", "fuzzer"]);
        command.args(["--sanitizer", sanitizer, "--target-dir"]).arg(&fuzzer.folder).arg("targets");
        if !command.status().is_ok_and(|status| status.success()) {
            return Err(Error::Step { command: "cargo +nightly fuzz build".to_owned() });
        }
        Ok(fuzzer)
    }

    /// The names of all targets, as the program tells them.
    fn targets(&self) -> Result<Vec<String>, Error> {
        let mut command = self.command("?");
        // It ends, which libFuzzer holds for a finding.
        command.arg("-runs=0").arg(format!("-artifact_prefix={}/", self.folder.display()));
        let text = command.output().map_err(io(&self.program))?.stderr;
        let text = String::from_utf8_lossy(&text);
        let names = text.lines().find_map(|line| line.split_once("MEDIANT_FUZZ is `?`: "));
        let names = names.map(|(_, names)| names.split(", ").map(str::to_owned).collect());
        names.ok_or_else(|| Error::Step { command: self.program.display().to_string() })
    }

    /// The inputs that earlier turns found.
    fn corpus(&self, name: &str) -> PathBuf {
        self.folder.join("corpus").join(name)
    }

    fn command(&self, name: &str) -> Command {
        let mut command = Command::new(&self.program);
        command.env("MEDIANT_FUZZ", name);
        // A message with a backtrace takes longer than the run of an input.
        command.env("RUST_BACKTRACE", "0");
        command
    }

    /// Fuzzes a target until its share of the time is over, or it was quiet for so long; and the files of
    /// inputs that it treats wrongly.
    fn turn(&self, name: &str, share: Duration, quiet: Duration) -> Result<(Turn, Vec<PathBuf>), Error> {
        let corpus = self.corpus(name);
        let findings = self.folder.join("found").join(name);
        for folder in [&corpus, &findings] {
            fs::create_dir_all(folder).map_err(io(folder))?;
        }
        let before = files(&findings)?;
        let begin = Instant::now();
        let mut child = self
            .command(name)
            .env("MEDIANT_FUZZ_SEEDS", &corpus)
            .arg(format!("-max_total_time={}", share.as_secs().max(1)))
            .arg(format!("-artifact_prefix={}/", findings.display()))
            .args(["-timeout=20", "-rss_limit_mb=2048", "-max_len=4096", "-print_final_stats=1", "-reload=0"])
            .arg(&corpus)
            .args(Some(root().join("crates/fuzz/corpus").join(name)).filter(|kept| kept.is_dir()))
            .stderr(Stdio::piped())
            .stdout(Stdio::null())
            .spawn()
            .map_err(io(&self.program))?;
        let lines = child.stderr.take().map(lines);
        let (log, is_quiet) = watched(&mut child, lines.as_ref(), begin, quiet);
        let status = child.wait().map_err(io(&self.program))?;
        let found: Vec<PathBuf> =
            files(&findings)?.into_iter().filter(|file| !before.contains(file)).collect();
        // It ends otherwise than by its time only with an input that is wrong, whose file it writes.
        if !is_quiet && !status.success() && found.is_empty() {
            println!("{name}: {status}\n{}", log.tail());
            return Err(Error::Step { command: self.program.display().to_string() });
        }
        for file in &found {
            println!("{name}: wrong on {}\n{}", file.display(), log.tail());
        }
        Ok((log.turn(begin.elapsed(), found.len()), found))
    }
}

/// Reads lines until there are none. libFuzzer may be silent for hours: it speaks at each power of two of
/// executions, and at each input that reaches something new.
fn lines(from: impl Read + Send + 'static) -> Receiver<String> {
    let (sender, lines) = mpsc::channel();
    thread::spawn(move || {
        let lines = BufReader::new(from).lines().map_while(Result::ok);
        lines.map(|line| sender.send(line)).take_while(Result::is_ok).for_each(drop);
    });
    lines
}

/// Sums up what libFuzzer says until it ends; asks it to end once it was quiet for so long, and says so.
fn watched(
    child: &mut Child,
    lines: Option<&Receiver<String>>,
    begin: Instant,
    quiet: Duration,
) -> (Log, bool) {
    let (mut log, mut is_quiet) = (Log::default(), false);
    let Some(lines) = lines else { return (log, is_quiet) };
    loop {
        match lines.recv_timeout(LOOK) {
            Ok(line) => log.line(&line, begin.elapsed()),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return (log, is_quiet),
        }
        if !is_quiet && log.is_quiet_for(quiet, begin.elapsed()) {
            is_quiet = true;
            end(child);
        }
    }
}

/// Asks a process to end. libFuzzer still tells how many inputs it has run then.
fn end(child: &mut Child) {
    let asked = Command::new("kill").args(["-TERM", &child.id().to_string()]).status();
    if !asked.is_ok_and(|status| status.success()) {
        let _ = child.kill();
    }
}

/// The files of a folder, sorted.
fn files(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let entries = fs::read_dir(folder).map_err(io(folder))?;
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.sort();
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn silence_ends_a_turn_by_time_alone() {
        let begin = Instant::now();
        let says = "echo '#2 INITED cov: 12 ft: 13 corp: 1/1b' >&2; exec sleep 600";
        let mut child =
            Command::new("sh").args(["-c", says]).stderr(Stdio::piped()).spawn().expect("a shell");
        let lines = child.stderr.take().map(lines);
        let (log, is_quiet) = watched(&mut child, lines.as_ref(), begin, Duration::from_millis(100));
        assert!(is_quiet && !child.wait().expect("a process of our own").success());
        assert!(begin.elapsed() < Duration::from_secs(300), "it slept to its end");
        assert_eq!(log.turn(begin.elapsed(), 0).edges, 12);
    }
}
