//! Runs the built program.

use std::{
    fs::File,
    path::PathBuf,
    process::{Command, Stdio},
};

use mediant_formats::{Georeference, Surface};
use serde_json::Value;
use tempfile::TempDir;

/// The output of the program, and its exit status.
#[derive(Debug)]
pub(crate) struct Ran {
    pub(crate) status: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

/// Runs `mediant` with these arguments, without a terminal.
pub(crate) fn mediant<S: AsRef<str>>(args: &[S]) -> Ran {
    mediant_with(args, &[])
}

/// Runs `mediant` with these arguments and environment variables, without a terminal.
pub(crate) fn mediant_with<S: AsRef<str>>(args: &[S], variables: &[(&str, &str)]) -> Ran {
    let mut command = Command::new(env!("CARGO_BIN_EXE_mediant"));
    for name in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE", "COLORTERM", "COLUMNS"] {
        command.env_remove(name);
    }
    command.envs(variables.iter().copied());
    let output = command.args(args.iter().map(AsRef::as_ref)).stdin(Stdio::null()).output();
    let output = output.expect("the program starts");
    Ran {
        status: output.status.code(),
        stdout: String::from_utf8(output.stdout).expect("stdout is UTF-8"),
        stderr: String::from_utf8(output.stderr).expect("stderr is UTF-8"),
    }
}

/// [`mediant`] for a command line of words without spaces.
pub(crate) fn run(line: &str) -> Ran {
    mediant(&line.split(' ').collect::<Vec<_>>())
}

/// [`run`], with this text on stdin.
pub(crate) fn run_on(line: &str, stdin: &str) -> Ran {
    let folder = Files::new();
    let file = File::open(folder.add("stdin", stdin)).expect("it was written");
    let mut command = Command::new(env!("CARGO_BIN_EXE_mediant"));
    let output = command.args(line.split(' ')).stdin(file).output().expect("the program starts");
    Ran {
        status: output.status.code(),
        stdout: String::from_utf8(output.stdout).expect("stdout is UTF-8"),
        stderr: String::from_utf8(output.stderr).expect("stderr is UTF-8"),
    }
}

/// A folder of files for one test.
pub(crate) struct Files(TempDir);

impl Files {
    pub(crate) fn new() -> Self {
        Self(TempDir::new().expect("a temporary folder"))
    }

    /// Writes a file and returns its path.
    pub(crate) fn add(&self, name: &str, content: impl AsRef<[u8]>) -> String {
        let path = self.path(name);
        std::fs::write(&path, content).expect("a file in the temporary folder");
        path
    }

    /// The path of a file in the folder, whether it exists or not.
    pub(crate) fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_str().expect("a UTF-8 path").to_owned()
    }

    /// Text without the folder's name.
    pub(crate) fn strip(&self, text: &str) -> String {
        let folder = self.path("");
        text.replace(&folder, "")
    }
}

/// Runs a command line whose queries are all answered. Returns the records of the run, of each query, and of
/// the summary.
#[track_caller]
pub(crate) fn told(line: &str) -> (Value, Vec<Value>, Value) {
    let Ran { status, stdout, stderr } = run(&format!("{line} --format jsonl"));
    assert_eq!((stderr.as_str(), status), ("", Some(0)), "{line}");
    let mut records: Vec<Value> =
        stdout.lines().map(|line| serde_json::from_str(line).expect("each line is JSON")).collect();
    let summary = records.pop().expect("a summary");
    (records.remove(0), records, summary)
}

/// Builds an index of a bundled map, and returns its path.
#[track_caller]
pub(crate) fn built(files: &Files, name: &str, options: &str) -> String {
    let path = files.path(name);
    let Ran { status, stderr, .. } = run(&format!("build {options} -o {path}"));
    assert_eq!((stderr.as_str(), status), ("", Some(0)), "{options}");
    path
}

/// Runs a command line that fails before there is any output.
#[track_caller]
pub(crate) fn refused(files: &Files, line: &str) -> String {
    let Ran { status, stdout, stderr } = run(line);
    assert_eq!((stdout.as_str(), status), ("", Some(2)), "{line}: {stderr}");
    assert_eq!((stderr.lines().count(), stderr.starts_with("error: ")), (1, true), "{line}: {stderr}");
    files.strip(&stderr)
}

/// A file of this crate's folder `maps`.
pub(crate) fn bundled(name: &str) -> String {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("maps");
    folder.join(name).to_str().expect("a UTF-8 path").to_owned()
}

/// The text with each time, and the spaces before it, replaced by ` TIME`, since times differ from run to
/// run.
pub(crate) fn redact_times(text: &str) -> String {
    let redact_line = |line: &str| {
        let mut words: Vec<&str> = Vec::new();
        for word in line.split(' ') {
            let unit = word.trim_end_matches(',');
            let is_number = |text: &&str| text.parse::<f64>().is_ok();
            if ["ns", "µs", "ms", "s"].contains(&unit) && words.last().is_some_and(is_number) {
                words.pop();
                while words.last().is_some_and(|word| word.is_empty()) {
                    words.pop();
                }
                words.push(if unit.len() < word.len() { "TIME," } else { "TIME" });
            } else {
                words.push(word);
            }
        }
        let line = words.join(" ");
        // The head of a column of times is as far to the right as the times are wide.
        match line.strip_suffix("time") {
            Some(rest) => format!("{} TIME", rest.trim_end()),
            None => line,
        }
    };
    text.lines().map(|line| redact_line(line) + "\n").collect()
}

/// Checks the error for the index in a file that is for something else: what it says that each is for.
#[track_caller]
pub(crate) fn check_mismatch(error: &str, file: &str, [built, needed]: [&str; 2]) {
    let (of_file, of_search) = error.split_once("; the space is for map ").expect(error);
    assert!(of_file.starts_with(&format!("error: {file}: the saved index is for map ")), "{error}");
    assert!(of_file.ends_with(built), "{error}, not {built}");
    let (of_search, advice) = of_search.split_once(": ").expect(error);
    assert!(of_search.ends_with(needed), "{error}, not {needed}");
    assert_eq!(advice, "use the saved index with what it was made for, or make a new one\n");
}

/// The examples in the help of a command, with the files of `add_example_files`: each is to succeed.
#[track_caller]
pub(crate) fn run_examples(files: &Files, command: &str, expected: usize) {
    const ENDS: [&str; 14] = [
        ".idx", ".txt", ".map", ".yaml", ".png", ".pgm", ".pbm", ".svg", ".csv", ".npy", ".jsonl", ".scen",
        ".asc", ".tif",
    ];
    let help = run(&format!("{command} --help")).stdout;
    let (_, examples) = help.split_once("\nExamples:\n").expect("examples");
    let lines: Vec<&str> = examples.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    for example in &lines {
        let words = example.strip_prefix("mediant ").expect("a command line").split(' ');
        let in_folder = |word: &str| {
            if ENDS.iter().any(|end| word.ends_with(end)) { files.path(word) } else { word.into() }
        };
        let Ran { status, stderr, .. } = mediant(&words.map(in_folder).collect::<Vec<_>>());
        assert_eq!((stderr.as_str(), status), ("", Some(0)), "{example}");
    }
    assert_eq!(lines.len(), expected, "{examples}");
}

/// Adds `arena.map`, 49 × 49 cells, `depot.yaml`, 60 × 40 cells of 5 cm, and `friction.tif`, 120 × 220 cells
/// of cost 3, without walls; `dem.tif` has as many cells of 30 m on a slope.
pub(crate) fn add_example_files(files: &Files) {
    let row = ".".repeat(49) + "\n";
    files.add("arena.map", format!("type octile\nheight 49\nwidth 49\nmap\n{}", row.repeat(49)));
    let depot = files.add(
        "depot.map",
        format!("type octile\nheight 40\nwidth 60\nmap\n{}", (".".repeat(60) + "\n").repeat(40)),
    );
    succeeds(&format!(
        "convert {depot} -o {} --resolution 0.05 --origin -0.5,-0.5,0",
        files.path("depot.yaml")
    ));
    let friction = Surface::new(120, 220, vec![3_u8; 120 * 220]).expect("a number for each cell");
    friction.save(files.path("friction.tif")).expect("a file in the temporary folder");
    let heights: Vec<u8> = (0..120 * 220).map(|cell| (cell % 120) as u8).collect();
    let place = Georeference::from_cell_size(30.0, 30.0).expect("a size");
    let heights = Surface::new(120, 220, heights).expect("a number for each cell").with_georeference(place);
    heights.save(files.path("dem.tif")).expect("a file in the temporary folder");
}

/// Runs a command line that succeeds without a word on stderr, and returns what it prints.
#[track_caller]
pub(crate) fn succeeds(line: &str) -> String {
    let Ran { status, stdout, stderr } = run(line);
    assert_eq!((stderr.as_str(), status), ("", Some(0)), "{line}");
    stdout
}

/// The output of a command line that succeeds, without times.
#[track_caller]
pub(crate) fn shown(line: &str) -> String {
    redact_times(&succeeds(line))
}
