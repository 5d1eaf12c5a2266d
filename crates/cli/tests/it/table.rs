//! `--format table`, and the output of the other commands, pinned. Times are redacted.

use crate::common::{Files, Ran, mediant, mediant_with, redact_times, shown};

#[test]
fn a_few_queries_are_all_listed() {
    insta::assert_snapshot!(shown("run builtin:town --every 2 --limit 6 --engine astar"));
}

#[test]
fn of_many_queries_only_the_summary_is_shown() {
    insta::assert_snapshot!(shown("run builtin:town --k 5 --placement corner --gap closed --engine astar"));
}

#[test]
fn a_single_query_shows_its_path_and_its_picture() {
    insta::assert_snapshot!(shown(
        "run builtin:archipelago --from 1,20 --to 70,20 --k 4 --placement corner --engine astar --draw"
    ));
}

#[test]
fn a_small_map_is_drawn_large() {
    let files = Files::new();
    let map = files.add(
        "yard.map",
        "type octile\nheight 5\nwidth 8\nmap\n........\n..@@@...\n..@.....\n..@..@@@\n........\n",
    );
    let Ran { stdout, .. } =
        mediant(&["run", &map, "--from", "0,4", "--to", "3,2", "--engine", "astar", "--draw"]);
    insta::assert_snapshot!(redact_times(&stdout));
}

#[test]
fn errors_among_many_queries_are_listed() {
    let files = Files::new();
    let map = files.add("yard.map", "type octile\nheight 1\nwidth 9\nmap\n........@\n");
    let query = |i: usize| format!("0\tyard.map\t9\t1\t0\t0\t{}\t0\t{}\n", i % 10, i % 10);
    let scenario = files.add("yard.scen", format!("version 1\n{}", (0..120).map(query).collect::<String>()));
    let Ran { status, stdout, .. } = mediant(&["run", &map, "--scen", &scenario, "--engine", "astar"]);
    assert_eq!(status, Some(1));
    insta::assert_snapshot!(redact_times(&stdout));
}

#[test]
fn the_engines() {
    let text = shown("engines");
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    insta::assert_snapshot!(text);
}

#[test]
fn options_of_the_engine_are_named_and_all_fits_in_80_columns() {
    let text =
        shown("run builtin:town --engine jps --heuristic euclidean --jump-limit 5 --keep-intermediate --k 4");
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    insta::assert_snapshot!(text);
    let paper = shown("run builtin:town --engine canonical --variant paper --limit 1");
    assert!(paper.contains("\ncanonical, heuristic hk, variant paper · k = 3 (8 moves) · "), "{paper}");
    assert!(paper.contains("\nsuboptimal · prepared in TIME\n"), "{paper}");
}

#[test]
fn an_index_is_built_and_its_file_named() {
    let files = Files::new();
    let index = files.path("town.idx");
    let Ran { status, stdout, stderr } =
        mediant(&["build", "builtin:town", "--engine", "jps-plus", "-o", &index]);
    assert_eq!((stderr.as_str(), status), ("", Some(0)));
    // Where jumps lead from the jump points of 72 × 36 cells.
    assert_eq!(redact_times(&stdout), "town.idx · jps-plus of town.map · 14,032 bytes · built in TIME\n");
}

#[test]
fn distances_are_csv() {
    let files = Files::new();
    let map = files.add("yard.map", "type octile\nheight 2\nwidth 4\nmap\n.@..\n...@\n");
    let (map, path) = (map.as_str(), files.path("yard.csv"));
    let distances = |options: &str, file: &str| {
        let options = options.split(' ');
        let args: Vec<&str> = ["run", map, "--distances", file].into_iter().chain(options).collect();
        let Ran { status, stdout, stderr } = mediant(&args);
        assert_eq!((stderr.as_str(), status), ("", Some(0)), "{args:?}");
        stdout
    };
    let dijkstra = distances("--engine dijkstra --from 0,1 --corners one", "-");
    assert_eq!(dijkstra, "x,y,distance\n0,0,1\n2,0,2.414213562\n3,0,3.414213562\n0,1,0\n1,1,1\n2,1,2\n");
    let wavefront = distances("--engine wavefront --from 0,1 --corners one", &path);
    assert_eq!(wavefront, "yard.csv · 6 vertices reached from (0, 1), the furthest (3, 0) at 3\n");
    let written = std::fs::read_to_string(&path).expect("the distances");
    assert_eq!(written, "x,y,distance\n0,0,1\n2,0,2\n3,0,3\n0,1,0\n1,1,1\n2,1,2\n");
}

#[test]
fn the_moves() {
    insta::assert_snapshot!("moves_of_5", shown("moves --k 5"));
    insta::assert_snapshot!("moves_of_12", shown("moves --k 12 --ratio 1.002"));
    let steep = shown("moves --ratio 1e300");
    assert!(steep.starts_with("At most 1e300 of an any-angle path's length\n"), "{steep}");
    let note = "`mediant run` takes k up to 12, or any; `mediant moves` up to 47";
    let close = shown("moves --ratio 1.0000001");
    assert!(close.contains("k = 1121") && close.contains(note), "{close}");
    let ratio_alone = shown("moves --ratio 1.3");
    assert!(!ratio_alone.contains(note), "{ratio_alone}");
    assert!(
        ratio_alone.contains("at corners   k = 3") && ratio_alone.contains("at centers   k = 3"),
        "{ratio_alone}"
    );
}

#[test]
fn the_demo_without_color() {
    insta::assert_snapshot!(shown("demo"));
}

#[test]
fn every_demo_solves_all_its_queries_and_fits_in_80_columns() {
    for name in ["archipelago", "cave", "maze", "town"] {
        let text = shown(&format!("demo {name}"));
        let (corners, centers) = (text.matches(" corners ").count(), text.matches(" centers ").count());
        assert_eq!((corners, centers), (9, 1), "{text}");
        let widest = text.lines().map(|line| line.chars().count()).max();
        assert!(widest <= Some(80), "{widest:?} columns:\n{text}");
    }
}

#[test]
fn colors_are_only_where_they_are_wanted() {
    let demo = |variables: &[(&str, &str)]| mediant_with(&["demo"], variables).stdout;
    let plain = demo(&[]);
    assert!(!plain.contains('\x1b'));
    assert!(!demo(&[("NO_COLOR", "1")]).contains('\x1b'));
    let palette = demo(&[("CLICOLOR_FORCE", "1")]);
    assert!(palette.contains("\x1b[48;5;") && !palette.contains("\x1b[48;2;"));
    let all = demo(&[("CLICOLOR_FORCE", "1"), ("COLORTERM", "truecolor")]);
    assert!(all.contains("\x1b[48;2;") && !all.contains("\x1b[48;5;"));
    // Every line ends with the terminal's own colors.
    let last_codes = all.lines().filter_map(|line| line.rsplit_once("\x1b[")).map(|(_, code)| code);
    assert!(
        last_codes.clone().count() > 20 && last_codes.clone().all(|code| code.starts_with("0m")),
        "{all}"
    );
}
