//! The tests: how long each takes, and to which places with mutants it comes.

use std::{
    collections::BTreeSet,
    fs,
    io::{self, BufRead, BufReader},
    path::{Path, PathBuf},
    process::{Child, Command, ExitStatus, Stdio},
    thread,
    time::{Duration, Instant},
};

use serde::{Deserialize, Serialize};

use super::tree::Program;
use crate::Error;

/// The most bytes of addresses that a test may have: a mutant may ask for more and more.
const MEMORY: &str = "6000000";

/// The number of maps of a random suite in its short form: the first ones kill most mutants that are killed.
const FEW: &str = "3";

/// A test, or a random suite in its short form.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Test {
    /// The number of its program.
    pub(super) program: usize,
    pub(super) name: String,
    pub(super) form: Form,
    /// The place where its short form fails without a mutant, since it counts what it finds on its maps.
    pub(super) fails_at: Option<String>,
    /// Of a processor.
    pub(super) seconds: f64,
    /// The places to which it comes, each by its first mutant.
    pub(super) places: BTreeSet<u32>,
}

/// The maps of a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) enum Form {
    /// A few.
    Short,
    /// All; there is no short form.
    Only,
    /// All, where there is a short form, which is tried before.
    Whole,
}

/// The end of a run of tests.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum End {
    Passed,
    /// In this test, and at this place of the sources.
    Failed(String, String),
    /// Not within its time: in this test.
    Late(String),
}

/// Runs tests of a program, one after the other, until one fails.
pub(super) fn run(
    program: &Program,
    (names, form): (&[&str], Form),
    variable: (&str, &str),
    longest: Duration,
) -> Result<End, Error> {
    run_by("exec \"$0\" \"$@\"", program, (names, form), variable, longest)
}

/// [`run`] by a line of the shell, which sets the limit of memory.
fn run_by(
    line: &str,
    program: &Program,
    (names, form): (&[&str], Form),
    (variable, value): (&str, &str),
    longest: Duration,
) -> Result<End, Error> {
    let mut command = Command::new("sh");
    command.arg("-c").arg(format!("ulimit -v {MEMORY}; {line}")).arg(&program.path);
    command.args(["-Zunstable-options", "--fail-fast", "--test-threads=1", "--exact"]).args(names);
    command.env("RUSTC_BOOTSTRAP", "1").env("RUST_BACKTRACE", "0").env("INSTA_UPDATE", "no");
    command.env("CARGO_MANIFEST_DIR", &program.folder).env(variable, value).current_dir(&program.folder);
    if form == Form::Short {
        command.env("MEDIANT_GRIDS", FEW);
    }
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null());
    let mut child = command.spawn().map_err(Error::at(&program.path))?;
    let out = child.stdout.take().map(BufReader::new);
    let told = thread::spawn(move || {
        let lines = out.into_iter().flat_map(|out| out.split(b'\n')).map_while(Result::ok);
        last_and_place(lines.map(|line| String::from_utf8_lossy(&line).into_owned()))
    });
    let status = status(&mut child, longest).map_err(Error::at(&program.path))?;
    let (last, place) = told.join().unwrap_or_default();
    Ok(match status {
        Some(status) if status.success() => End::Passed,
        Some(_) => End::Failed(last, place),
        None => End::Late(last),
    })
}

/// The last test that a program names, which it does before it runs it; and the first place of a panic.
fn last_and_place(lines: impl Iterator<Item = String>) -> (String, String) {
    let (mut last, mut place) = (String::new(), String::new());
    for line in lines {
        if let Some((name, _)) = line.strip_prefix("test ").and_then(|line| line.split_once(" ... ")) {
            name.clone_into(&mut last);
        }
        if let (true, Some((_, at))) = (place.is_empty(), line.split_once(" panicked at ")) {
            at.trim_end_matches(':').clone_into(&mut place);
        }
    }
    (last, place)
}

/// The status of a process that ends in time; another one is killed.
fn status(child: &mut Child, longest: Duration) -> io::Result<Option<ExitStatus>> {
    let (begin, mut pause) = (Instant::now(), Duration::from_millis(1));
    while begin.elapsed() <= longest {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        thread::sleep(pause);
        pause = (2 * pause).min(Duration::from_millis(20));
    }
    child.kill()?;
    child.wait()?;
    Ok(None)
}

/// The names of a program's tests.
fn names(program: &Program) -> Result<Vec<String>, Error> {
    let listed = Command::new(&program.path).args(["--list", "--format", "terse"]).output();
    let text = listed.map_err(Error::at(&program.path))?.stdout;
    let text = String::from_utf8_lossy(&text);
    Ok(text.lines().filter_map(|line| line.strip_suffix(": test")).map(str::to_owned).collect())
}

/// All tests, each run once without a mutant; those that fail so are left out, and are told.
pub(super) fn tests(programs: &[Program], folder: &Path, threads: usize) -> Result<Vec<Test>, Error> {
    let mut all = Vec::new();
    for (number, program) in programs.iter().enumerate() {
        all.extend(names(program)?.into_iter().map(|name| (number, name)));
    }
    let tests = super::in_parallel(threads, &all, |worker, (number, name)| {
        let of = |form| measured((*number, &programs[*number]), (name, form), folder, worker);
        let whole = of(Form::Only)?;
        if whole.fails_at.is_some() {
            println!("left out, since it fails without a mutant: {} {name}", programs[*number].name);
            return Ok(Vec::new());
        }
        let short = if whole.seconds > 0.2 { Some(of(Form::Short)?) } else { None };
        Ok(match short.filter(|short| 2.0 * short.seconds < whole.seconds) {
            Some(short) => vec![short, Test { form: Form::Whole, ..whole }],
            None => vec![whole],
        })
    })?;
    Ok(tests.into_iter().flatten().collect())
}

/// A test that is run once without a mutant.
fn measured(
    (number, program): (usize, &Program),
    (name, form): (&str, Form),
    folder: &Path,
    worker: usize,
) -> Result<Test, Error> {
    let reached = folder.join(format!("reached-{worker}")).to_string_lossy().into_owned();
    let times = format!("{reached}.times");
    [&reached, &times].into_iter().for_each(|file| _ = fs::remove_file(file));
    let line = r#""$0" "$@"; code=$?; times >"$MUTANT_REACH.times"; exit $code"#;
    let variable = ("MUTANT_REACH", &*reached);
    let end = run_by(line, program, (&[name], form), variable, Duration::from_secs(1200))?;
    let read = |file: &str| fs::read_to_string(file).unwrap_or_default();
    let places = read(&reached).lines().filter_map(|line| line.parse().ok()).collect();
    let seconds = of_processor(&read(&times));
    let fails_at = match end {
        End::Passed => None,
        End::Failed(_, place) => Some(place),
        End::Late(_) => Some(String::new()),
    };
    Ok(Test { program: number, name: name.to_owned(), form, fails_at, seconds, places })
}

/// The seconds of a processor that a shell's children had, by its command `times`: on a busy machine they are
/// the same. Its second line is `0m1.25s 0m0.50s`.
fn of_processor(times: &str) -> f64 {
    let of = |part: &str| {
        let (minutes, seconds) = part.trim_end_matches('s').split_once('m')?;
        Some(60.0 * minutes.parse::<f64>().ok()? + seconds.parse::<f64>().ok()?)
    };
    times.lines().nth(1).unwrap_or_default().split_whitespace().filter_map(of).sum()
}

/// The file of known tests, for programs that are the same.
pub(super) fn file(folder: &Path, digest: &str) -> PathBuf {
    folder.join(format!("tests-{digest}.json"))
}

#[cfg(test)]
mod tests {
    use super::{last_and_place, of_processor};

    #[test]
    fn the_times_of_a_shell() {
        assert_eq!(of_processor("0m0.01s 0m0.00s\n1m1.25s 0m0.50s\n"), 61.75);
        assert_eq!(of_processor(""), 0.0);
    }

    #[test]
    fn the_place_where_a_test_fails() {
        let told = [
            "running 2 tests",
            "test a::passes ... ok",
            "test a::fails ... FAILED",
            "---- a::fails stdout ----",
            "thread 'a::fails' (7) panicked at crates/a/src/a.rs:12:5:",
            "thread 'a::fails' (7) panicked at crates/a/src/b.rs:1:1:",
        ];
        let expected = ("a::fails".to_owned(), "crates/a/src/a.rs:12:5".to_owned());
        assert_eq!(last_and_place(told.into_iter().map(str::to_owned)), expected);
        assert_eq!(last_and_place(std::iter::empty()), Default::default());
    }
}
