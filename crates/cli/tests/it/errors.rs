//! Bad input: one clear line on stderr and the right exit status, never a panic.

use mediant_formats::MapFile;

use crate::common::{Files, Ran, check_mismatch, mediant, mediant_with, run};

/// Runs a command line that fails before there is any output, and checks all that it says.
#[track_caller]
pub(crate) fn check(line: &str, message: &str) {
    let Ran { status, stdout, stderr } = run(line);
    assert_eq!(
        (stderr.as_str(), stdout.as_str(), status),
        (&*format!("error: {message}\n"), "", Some(2)),
        "{line}"
    );
}

const MAP: &str = "type octile\nheight 2\nwidth 3\nmap\n.@.\n...\n";
const SCENARIO: &str = "version 1\n0\tyard.map\t3\t2\t0\t0\t2\t0\t4\n";

#[test]
fn arguments_that_make_no_sense() {
    check("run", "the following required arguments were not provided: <MAP>; see --help");
    check(
        "run builtin:cave --from 1,2",
        "the following required arguments were not provided: <--to <X,Y>|--distances <FILE>>; see --help",
    );
    check(
        "run builtin:cave --k 1",
        "invalid value '1' for '--k <N|any>': k = 1 is too small: the smallest 2^k neighborhood is the \
         4-connected one, k = 2; see --help",
    );
    check(
        "run builtin:cave --k 13",
        "no engine searches center, corners never, k = 13: choose a k from 2 to 12 (4 to 4096 neighbors), or any",
    );
    check(
        "run builtin:cave --k -3",
        "invalid value '-3' for '--k <N|any>': expected an integer of 2 or more, or 'any', found -3; see --help",
    );
    check(
        "run builtin:cave --engine astar --k any",
        "astar needs a k from 2 to 12; for any choose anya, subgoal",
    );
    check(
        "run builtin:cave --every 0",
        "invalid value '0' for '--every <N>': expected a whole number from 1 up; see --help",
    );
    check(
        "run builtin:cave --limit -1",
        "invalid value '-1' for '--limit <N>': expected a whole number from 1 up; see --help",
    );
    check(
        "run builtin:cave --repeat x",
        "invalid value 'x' for '--repeat <N>': expected a whole number from 1 up; see --help",
    );
    check(
        "run builtin:cave --repeat 99999999999",
        "invalid value '99999999999' for '--repeat <N>': expected a whole number from 1 to 4294967295; see --help",
    );
    check(
        "moves",
        "give --k or --neighbors to list the moves of a neighborhood, --ratio to find the smallest k for a bound, \
         or both",
    );
    check(
        "moves --k 48",
        "invalid value '48' for '--k <K>': k = 48 is too large: at most k = 47 fits here; see --help",
    );
    check(
        "moves --ratio 0.9",
        "invalid value '0.9' for '--ratio <R>': expected a number from 1 up, such as 1.01: \
         no path is shorter than an any-angle path; see --help",
    );
    check("fly", "unrecognized subcommand 'fly'; see --help");
}

#[test]
fn engines_and_values_that_do_not_exist() {
    check(
        "run builtin:cave --engine warp",
        "invalid value 'warp' for '--engine <ENGINE>' [possible values: auto, astar, dijkstra, wavefront, \
         canonical, jps, jps-block, \
         jps-plus, theta, lazy-theta, anya, subgoal, subgoal-theta, hpa, chpa, landmarks]; see --help",
    );
    check(
        "run builtin:cave --engine canonical --variant best",
        "invalid value 'best' for '--variant <exact|complete|paper>' [possible values: exact, complete, paper]; \
         see --help",
    );
    check(
        "run builtin:cave --heuristic manhattan",
        "invalid value 'manhattan' for '--heuristic <HEURISTIC>' [possible values: hk, euclidean, zero, \
         squared]; see --help",
    );
    check(
        "run builtin:cave --engine jps --jump-limit 0",
        "invalid value '0' for '--jump-limit <N>': expected an integer of 1 or more, found 0; see --help",
    );
    check(
        "build builtin:cave --engine jps-plus",
        "the following required arguments were not provided: --output <FILE>; see --help",
    );
}

#[test]
fn arguments_that_are_no_vertices() {
    check(
        "run builtin:cave --from 3 --to 4,5",
        "invalid value '3' for '--from <X,Y>': expected two numbers, such as 3,14; see --help",
    );
    check(
        "run builtin:cave --from 3,y --to 4,5",
        "invalid value '3,y' for '--from <X,Y>': `y` is no number; write X,Y such as 3,14; see --help",
    );
    check(
        "run builtin:cave --from 1,2,3 --to 4,5",
        "invalid value '1,2,3' for '--from <X,Y>': expected two numbers, such as 3,14, found 3 parts; see --help",
    );
    check(
        "run builtin:cave --from 2147483648,0 --to 4,5",
        "invalid value '2147483648,0' for '--from <X,Y>': `2147483648` is too large: coordinates go up to \
         2147483647; see --help",
    );
    check(
        "run builtin:cave --from 1,2 --to 4,-99999999999",
        "invalid value '4,-99999999999' for '--to <X,Y>': `-99999999999` is too small: coordinates go down \
         to -2147483648; \
         see --help",
    );
}

#[test]
fn options_that_do_not_go_together() {
    check(
        "run builtin:cave --placement center --gap open",
        "--gap: at centers it is for k = any; else there is corners in its place: never, one or always",
    );
    check(
        "run builtin:cave --placement corner --corners never",
        "--corners: at corners there is gap in its place: open or closed",
    );
    check(
        "run builtin:cave --from 1,2 --to 3,4 --every 2",
        "the argument '--from <X,Y>' cannot be used with '--every <N>'; see --help",
    );
    check(
        "run builtin:cave --scen builtin:cave --from 1,2 --to 3,4",
        "the argument '--scen <FILE>' cannot be used with: --from <X,Y>; --to <X,Y>; see --help",
    );
    check(
        "run builtin:cave --distances -",
        "the following required arguments were not provided: --from <X,Y>; see --help",
    );
    check(
        "run builtin:cave --from 1,2 --to 3,4 --distances -",
        "the argument '--to <X,Y>' cannot be used with '--distances <FILE>'; see --help",
    );
    check(
        "run builtin:cave --from 1,2 --distances - --format jsonl",
        "the argument '--distances <FILE>' cannot be used with '--format <FORMAT>'; see --help",
    );
    check(
        "run builtin:cave --trace t.json",
        "--trace follows a single query: give --from and --to, or --limit 1",
    );
    check("run builtin:cave --draw", "--draw shows a single query: give --from and --to, or --limit 1");
    check(
        "run builtin:cave --limit 1 --draw --format jsonl",
        "--draw on the screen goes with --format table alone: give it a FILE, or choose that format",
    );
}

#[test]
fn what_an_engine_does_not_take() {
    let jumpers = "leave it out, or choose jps, jps-block";
    let indexed = "jps-plus, subgoal, subgoal-theta, hpa, chpa, landmarks";
    for (options, message) in [
        (
            "--engine dijkstra --heuristic hk",
            "dijkstra takes no heuristic: leave it out, or choose astar, canonical, jps, jps-block, \
             jps-plus, theta, lazy-theta, chpa"
                .to_owned(),
        ),
        (
            "--engine jps --variant paper",
            "jps takes no variant: leave it out, or choose canonical, chpa".to_owned(),
        ),
        ("--engine astar --jump-limit 3", format!("astar takes no jump limit: {jumpers}")),
        ("--engine jps-plus --jump-limit 3", format!("jps-plus takes no jump limit: {jumpers}")),
        (
            "--engine canonical --keep-intermediate",
            format!("canonical takes no intermediate jump points: {jumpers}, jps-plus"),
        ),
        ("--engine jps-block --k 4", "jps-block needs a k from 2 to 3, found 4 (16 neighbors)".to_owned()),
        ("--engine jps-plus --k 12", "jps-plus needs a k from 2 to 3, found 12 (4096 neighbors)".to_owned()),
        (
            "--engine jps-plus --k any",
            "jps-plus needs a k from 2 to 3; for any choose anya, subgoal".to_owned(),
        ),
        ("--engine jps --index x.idx", format!("jps has no index: choose {indexed}")),
        (
            "--engine astar --from 2,5 --distances -",
            "astar has no distances to all vertices: choose dijkstra, wavefront".to_owned(),
        ),
    ] {
        check(&format!("run builtin:cave {options}"), &message);
    }
    check(
        "build builtin:cave --engine canonical -o x.idx",
        "canonical has no index: choose jps-plus, subgoal, subgoal-theta, hpa, chpa, landmarks",
    );
    check(
        "build builtin:cave --engine jps-plus --placement center --gap open -o x.idx",
        "--gap: at centers it is for k = any; else there is corners in its place: never, one or always",
    );
}

#[test]
fn an_index_for_something_else_is_refused() {
    let files = Files::new();
    let index = files.path("cave.idx");
    let built = mediant(&["build", "builtin:cave", "--engine", "jps-plus", "-o", &index]);
    assert_eq!((built.status, built.stderr.as_str()), (Some(0), ""));
    let refused = |line: &str, path: &str| {
        let args: Vec<&str> = line.split(' ').chain(["--engine", "jps-plus", "--index", path]).collect();
        let Ran { status, stdout, stderr } = mediant(&args);
        assert_eq!((stdout.as_str(), status), ("", Some(2)), "{line}");
        files.strip(&stderr)
    };
    let map = refused("run builtin:maze", &index);
    let built = " of 72 columns and 36 rows, center, corners never, k = 3";
    check_mismatch(&map, "cave.idx", [built, " of 69 columns and 33 rows, center, corners never, k = 3"]);
    check_mismatch(&refused("run builtin:cave --k 2", &index), "cave.idx", [built, "corners never, k = 2"]);
    let rules = refused("run builtin:cave --corners one", &index);
    check_mismatch(&rules, "cave.idx", [built, " of 72 columns and 36 rows, center, corners one, k = 3"]);
    assert_eq!(
        refused("run builtin:cave", &files.path("none.idx")),
        "error: none.idx: no such file; check the path and the folder that you are in\n"
    );
    let mut bytes = std::fs::read(&index).expect("the index");
    bytes.pop();
    let cut = refused("run builtin:cave", &files.add("cut.idx", &bytes));
    assert!(
        cut.starts_with("error: cut.idx: expected an index of ") && cut.contains("copy the file again"),
        "{cut}"
    );
}

#[test]
fn files_that_cannot_be_written() {
    let files = Files::new();
    let check = |args: &[&str], message: &str| {
        let Ran { status, stdout, stderr } = mediant(args);
        assert_eq!((stdout.as_str(), status), ("", Some(2)), "{args:?}");
        assert_eq!(files.strip(&stderr), format!("error: {message}\n"), "{args:?}");
    };
    let nowhere = files.path("no/where");
    let missing = format!(
        "no/where: there is no folder {}: make it first, or choose another one",
        nowhere.trim_end_matches("/where")
    );
    let missing = missing.replace(&files.path(""), "");
    check(&["run", "builtin:cave", "--limit", "1", "--trace", &nowhere], &missing);
    check(
        &["run", "builtin:cave", "--engine", "dijkstra", "--from", "2,5", "--distances", &nowhere],
        &missing,
    );
    check(&["build", "builtin:cave", "--engine", "jps-plus", "-o", &nowhere], &missing);
}

#[test]
fn distances_from_a_blocked_start_are_an_error() {
    let files = Files::new();
    let (map, csv) = (files.add("yard.map", MAP), files.path("yard.csv"));
    let Ran { status, stdout, stderr } =
        mediant(&["run", &map, "--engine", "wavefront", "--from", "1,0", "--distances", &csv]);
    let message = "error: the start (1, 0) is blocked: choose a free vertex; the nearest one is (0, 0)\n";
    assert_eq!((stdout.as_str(), stderr.as_str(), status), ("", message, Some(1)));
    assert!(!std::path::Path::new(&csv).exists(), "nothing was found, nothing is written");
}

#[test]
fn files_that_are_no_maps() {
    let files = Files::new();
    #[track_caller]
    fn check(files: &Files, path: &str, message: &str) {
        let Ran { status, stdout, stderr } = mediant(&["run", path, "--from", "0,0", "--to", "1,1"]);
        let stderr = files.strip(&stderr);
        assert_eq!(
            (stderr.as_str(), stdout.as_str(), status),
            (&*format!("error: {message}\n"), "", Some(2))
        );
    }
    let path = files.path("nowhere.map");
    check(&files, &path, "nowhere.map: no such file; check the path and the folder that you are in");
    check(&files, &files.path(""), ": expected a file, found a directory; name a file in it");
    // The parser says what is wrong inside a file; the program says it in one line, with the file's name.
    let junk: Vec<u8> = (0..4_096_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let contents: [(&str, Vec<u8>); 5] = [
        ("empty.map", Vec::new()),
        ("junk.map", junk),
        ("truncated.map", MAP[..MAP.len() - 3].into()),
        ("wide.map", MAP.replace("width 3", "width 2").into()),
        ("high.map", MAP.replace("height 2", "height 3").into()),
    ];
    for (name, content) in contents {
        let error = MapFile::parse(&content).expect_err("the content is wrong");
        check(&files, &files.add(name, &content), &format!("{name}: {error}"));
    }
    let message = "there is no bundled map `atlantis`; there are archipelago, cave, maze, town";
    check(&files, "builtin:atlantis", message);
}

#[test]
fn files_that_are_no_scenarios_of_this_map() {
    let files = Files::new();
    let map = files.add("yard.map", MAP);
    let check = |path: &str, message: &str| {
        let Ran { status, stdout, stderr } = mediant(&["run", &map, "--scen", path]);
        let stderr = files.strip(&stderr);
        assert_eq!(
            (stderr.as_str(), stdout.as_str(), status),
            (&*format!("error: {message}\n"), "", Some(2))
        );
    };
    check(&files.path("no.scen"), "no.scen: no such file; check the path and the folder that you are in");
    let empty = files.add("empty.scen", "");
    check(
        &empty,
        "empty.scen: line 1, column 1: expected a MovingAI scenario, found an empty file; is this the file \
         that you meant?",
    );
    check(
        &files.add("none.scen", "version 1\n"),
        "the scenario `none.scen` has no instance: is it cut short?",
    );
    let other_size = SCENARIO.replace("yard.map\t3\t2", "maps/barn.map\t5\t7");
    check(
        &files.add("size.scen", other_size),
        "instance 0 of the scenario: expected the map `maps/barn.map` of 5 × 7 cells, found `yard.map` of 3 × 2 \
         cells; take the scenario that was made for this map",
    );
    // Of the same size, but another map: a blocked goal shows it.
    let misfit = SCENARIO.replace("yard.map", "maps/barn.map").replace("\t2\t0\t4", "\t1\t0\t4");
    check(
        &files.add("misfit.scen", misfit),
        "the scenario is for the map `barn.map` and does not fit `yard.map`, where the goal (1, 0) of \
         instance 0 is blocked; \
         give the map that it was made for, under that name",
    );
}

#[test]
fn a_renamed_map_is_still_the_map() {
    let files = Files::new();
    let map = files.add("renamed.map", MAP);
    let Ran { status, stderr, .. } = mediant(&["run", &map, "--scen", &files.add("yard.scen", SCENARIO)]);
    let warning = "warning: the scenario names the map `yard.map`, not `renamed.map`; every query fits, so \
                   it is used\n";
    assert_eq!((stderr.as_str(), status), (warning, Some(0)));
}

#[test]
fn each_query_that_cannot_be_answered_is_an_error() {
    let files = Files::new();
    let map = files.add("yard.map", MAP);
    let single = |from: &str, to: &str, placement: &str, message: &str| {
        for format in ["table", "jsonl"] {
            let args =
                ["run", &map, "--from", from, "--to", to, "--placement", placement, "--format", format];
            let Ran { status, stdout, stderr } = mediant(&args);
            // The table says only `error`; the line of JSON has the message, too.
            assert_eq!(stdout.contains(message), format == "jsonl", "{stdout}");
            assert!(stdout.contains("error"), "{stdout}");
            assert_eq!(
                (stderr.as_str(), status),
                (&*format!("error: {message}\n"), Some(1)),
                "{from} {to} {format}"
            );
        }
    };
    single(
        "-1,3",
        "0,0",
        "center",
        "the start (-1, 3) is outside the map, whose vertices run from (0, 0) to (2, 1)",
    );
    single(
        "0,0",
        "4,0",
        "corner",
        "the goal (4, 0) is outside the map, whose vertices run from (0, 0) to (3, 2)",
    );
    single(
        "0,0",
        "2147483647,-2147483648",
        "corner",
        "the goal (2147483647, -2147483648) is outside the map, whose vertices run from (0, 0) to (3, 2)",
    );
    let blocked = "the start (1, 0) is blocked: choose a free vertex; the nearest one is (0, 0)";
    single("1,0", "0,0", "center", blocked);

    let scenario = files.add(
        "yard.scen",
        format!("{SCENARIO}0\tyard.map\t3\t2\t1\t0\t2\t0\t4\n0\tyard.map\t3\t2\t0\t0\t9\t0\t4\n"),
    );
    let Ran { status, stdout, stderr } = mediant(&["run", &map, "--scen", &scenario]);
    let message = format!("error: 2 queries of 3 cannot be answered; the first, index 1: {blocked}\n");
    assert_eq!((stderr, status), (message, Some(1)));
    assert!(stdout.contains("3: 1 found, 0 unreachable, 2 errors"), "{stdout}");
}

#[test]
#[cfg(unix)]
fn names_send_no_codes_to_the_terminal() {
    let files = Files::new();
    let name = "\u{1b}]0;title\u{7}\u{1b}[31mred\r.map";
    let shown = r"\u{1b}]0;title\u{7}\u{1b}[31mred\r.map";
    // With colors, since without them all escape sequences are removed from the output.
    let color = [("CLICOLOR_FORCE", "1")];
    let single = |path: &str| mediant_with(&["run", path, "--from", "0,0", "--to", "2,0"], &color);
    let missing = single(&files.path(name));
    assert!(missing.stderr.contains(&format!("{shown}: no such file")), "{missing:?}");
    let found = single(&files.add(name, MAP));
    assert_eq!(found.status, Some(0), "{found:?}");
    assert!(found.stdout.contains(&format!("{shown}\u{1b}[0m · 3 × 2 cells")), "{found:?}");
    for text in [missing.stderr, found.stdout] {
        assert!(!text.contains(['\u{7}', '\r']), "{text:?}");
        assert!(!text.contains("\u{1b}]") && !text.contains("\u{1b}[31mred"), "{text:?}");
    }
}

#[test]
fn no_path_is_an_answer() {
    let files = Files::new();
    let map = files.add("walls.map", "type octile\nheight 1\nwidth 3\nmap\n.@.\n");
    let Ran { status, stdout, stderr } = mediant(&["run", &map, "--from", "0,0", "--to", "2,0"]);
    assert_eq!((stderr.as_str(), status), ("", Some(0)));
    assert!(stdout.contains("unreachable"), "{stdout}");
}

#[test]
#[cfg(unix)]
fn a_reader_that_stops_is_no_failure() {
    use std::process::{Command, Stdio};
    let mut command = Command::new(env!("CARGO_BIN_EXE_mediant"));
    // More output than any pipe holds.
    command.args("run builtin:archipelago --format jsonl --k 12 --every 1".split(' '));
    let mut child =
        command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!((output.status.code(), String::from_utf8_lossy(&output.stderr).as_ref()), (Some(0), ""));
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_a_failure() {
    use std::{fs::File, process::Command};
    for line in ["engines", "--help", "--version", "run --help", "run builtin:cave --format jsonl"] {
        let full = File::options().write(true).open("/dev/full").expect("the device that is always full");
        let mut command = Command::new(env!("CARGO_BIN_EXE_mediant"));
        let output = command.args(line.split(' ')).stdout(full).output().expect("the program starts");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{line}");
        assert!(stderr.starts_with("error: cannot write the output: "), "{line}: {stderr}");
    }
}
