//! Words as people type them: engines, k, numbers of moves.

use crate::{
    common::{shown, succeeds, told},
    errors::check,
};

#[test]
fn engines_are_read_as_people_write_them() {
    for (engine, typed) in [
        ("astar", &["A*", "a*", "AStar", "a-star", "A_STAR"][..]),
        ("jps", &["JPS", "Jps"]),
        ("jps-plus", &["jps+", "JPS+", "jpsplus", "jps_plus", "JPS-Plus"]),
        ("jps-block", &["jps_block", "JPSBlock"]),
        ("theta", &["Theta*", "theta*", "thetastar", "THETA"]),
        ("lazy-theta", &["Lazy-Theta*", "lazytheta"]),
        ("dijkstra", &["Dijkstra"]),
    ] {
        for name in typed {
            let (run, ..) = told(&format!("run builtin:cave --from 2,5 --to 9,9 --engine {name}"));
            assert_eq!(run["engine"], engine, "{name}");
        }
    }
}

#[test]
fn what_is_no_engine_is_told_with_those_that_are() {
    check(
        "run builtin:cave --engine jps++",
        "invalid value 'jps++' for '--engine <ENGINE>' [possible values: auto, astar, dijkstra, wavefront, canonical, \
         jps, jps-block, jps-plus, theta, lazy-theta, anya, subgoal, subgoal-theta, hpa, chpa, landmarks]; tip: a similar \
         value exists: 'jps'; see --help",
    );
    // Only engines whose paths are the shortest at any angle are references.
    check(
        "run builtin:cave --reference A*",
        "invalid value 'A*' for '--reference <ENGINE>' [possible values: anya, subgoal]; see --help",
    );
}

#[test]
fn infinity_has_its_names() {
    for k in ["any", "inf", "Infinity", "∞"] {
        let (run, ..) = told(&format!("run builtin:cave --from 2,5 --to 9,9 --engine anya --k {k}"));
        assert_eq!(run["k"], "any", "{k}");
    }
}

#[test]
fn neighbors_stand_for_k() {
    for (neighbors, k) in [(4, 2), (8, 3), (16, 4), (4096, 12)] {
        let (run, queries, _) =
            told(&format!("run builtin:cave --from 2,5 --to 62,33 --neighbors {neighbors}"));
        let (_, same, _) = told(&format!("run builtin:cave --from 2,5 --to 62,33 --k {k}"));
        assert_eq!((&run["k"], &queries[0]["path"]), (&k.into(), &same[0]["path"]));
    }
    for line in [
        "reach builtin:cave --from 2,5 {}",
        "moves {}",
        "table builtin:town --from 10,3 --to 6,6 --placement corner {}",
        "check builtin:cave /dev/null --placement corner {}",
    ] {
        let with =
            |words: &str| crate::common::redact_times(&crate::common::run(&line.replace("{}", words)).stdout);
        assert_eq!(with("--neighbors 16"), with("--k 4"), "{line}");
    }
    check(
        "run builtin:cave --neighbors 6",
        "invalid value '6' for '--neighbors <N>': no 2^k neighborhood has 6 moves: choose 4 or 8; see --help",
    );
    check(
        "run builtin:cave --neighbors 8192",
        "no engine searches center, corners never, k = 13: choose a k from 2 to 12 (4 to 4096 neighbors), or any",
    );
    for command in [
        "run builtin:cave",
        "reach builtin:cave --from 2,5",
        "table builtin:cave --from 2,5 --to 2,5",
        "build builtin:cave -o x",
    ] {
        check(
            &format!("{command} --k 3 --neighbors 8"),
            "--neighbors: it names the neighborhood, as k does: give one",
        );
    }
    check(
        "moves --k 3 --neighbors 8",
        "the argument '--k <K>' cannot be used with '--neighbors <N>'; see --help",
    );
}

#[test]
fn the_moves_stand_beside_k() {
    assert!(
        shown("run builtin:cave --from 2,5 --to 9,9 --k 8 --engine astar")
            .contains("k = 8 (256 moves) · center")
    );
    assert!(shown("run builtin:cave --from 2,5 --to 9,9 --k any --engine anya").contains("k = any · corner"));
    assert!(succeeds("reach builtin:cave --from 2,5").contains("corners never, k = 3 (8 moves) · "));
    assert!(shown("table builtin:town --from 10,3 --to 6,6 --k 2").contains("k = 2 (4 moves)"));
    for command in ["run", "reach", "table", "build", "moves"] {
        let help = succeeds(&format!("help {command}"));
        let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains("k = 3 has 8, k = 8 has 256") && words.contains("--neighbors"), "{command}");
    }
}
