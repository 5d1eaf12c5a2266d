//! Any-angle engines, smoothing, certificates.

use serde_json::Value;

use crate::common::{self, Files, Ran, mediant, run, told};

/// A number in a record.
fn number(record: &Value, name: &str) -> f64 {
    record[name].as_f64().unwrap_or_else(|| panic!("a number `{name}` in {record}"))
}

/// The straight-line distance of a query's ends.
fn straight(query: &Value) -> f64 {
    let [x, y] =
        [0, 1].map(|i| query["goal"][i].as_f64().zip(query["start"][i].as_f64()).map(|(a, b)| a - b));
    x.zip(y).map(|(x, y)| x.hypot(y)).expect("coordinates")
}

/// The most by which rounding may raise a ratio, as a factor.
const SLACK: f64 = 1.0 + 1e-9;

#[test]
fn anya_needs_no_more_than_its_name() {
    let (run, queries, summary) = told("run builtin:town --engine anya");
    let expected = serde_json::json!({
        "k": "any", "placement": "corner", "gap": "open", "heuristic": null, "guarantee": "optimal(any)", "smooth": false,
        "smoothing": null, "any_angle": null,
    });
    for (key, value) in expected.as_object().expect("an object") {
        assert_eq!(&run[key], value, "{key}");
    }
    let (_, same, _) = told("run builtin:town --engine anya --k any --placement corner --gap open");
    let (_, fine, _) = told("run builtin:town --k 12 --placement corner");
    assert_eq!((queries.len(), same.len(), fine.len()), (22, 22, 22));
    for ((query, same), fine) in queries.iter().zip(&same).zip(&fine) {
        assert_eq!((&query["path"], &query["expanded"]), (&same["path"], &same["expanded"]));
        let (cost, fine) = (number(query, "cost"), number(fine, "cost"));
        // A shortest path over N(12) is at most 0.13 % longer than the shortest at any angle.
        assert!(straight(query) <= cost * SLACK && cost <= fine * SLACK && fine <= 1.0013 * cost, "{query}");
        assert_eq!((number(query, "bound"), number(query, "lower_bound")), (1.0, cost), "{query}");
    }
    assert_eq!(summary["bound"], serde_json::json!({ "mean": 1.0, "worst": 1.0, "worst_index": 0 }));
    assert_eq!(told("run builtin:town --engine anya --gap closed").0["gap"], "closed");
    // The default placement is the engine's: theta takes centers, too.
    assert_eq!(told("run builtin:town --engine theta").0["placement"], "center");
}

/// Over N(k) Anya's paths are as long as those of A*.
#[test]
fn anya_takes_a_finite_k() {
    for k in [2, 5, 12] {
        let (run, found, _) = told(&format!("run builtin:town --engine anya --k {k}"));
        assert_eq!((&run["k"], &run["placement"]), (&k.into(), &"corner".into()));
        assert_eq!(run["guarantee"], format!("optimal({k})"));
        let (_, best, _) = told(&format!("run builtin:town --placement corner --k {k}"));
        assert_eq!((found.len(), best.len()), (22, 22));
        for (found, best) in found.iter().zip(&best) {
            assert!((number(found, "cost") - number(best, "cost")).abs() < 1e-9, "{found}, {best}");
        }
    }
}

/// The certificates of each engine are true of the shortest any-angle paths under the same rules.
#[test]
fn certificates_hold() {
    let mut inexact = 0;
    for (options, worst) in [
        ("--k 2", Some(2.0_f64.sqrt())),
        ("--k 3", Some(1.0824)),
        ("--k 5 --engine jps --gap closed", Some(1.0132)),
        ("--k 5 --engine anya --gap closed", Some(1.0132)),
        ("--k 3 --smooth", Some(1.0824)),
        ("--k 4 --smooth=taut --gap closed", Some(1.0276)),
        ("--engine theta", None),
        ("--engine lazy-theta --k 4 --gap closed", None),
        ("--engine theta --smooth=taut", None),
        ("--engine anya", Some(1.0)),
    ] {
        let (run, queries, summary) =
            told(&format!("run builtin:town --placement corner --reference anya {options}"));
        assert_eq!((&run["any_angle"], queries.len()), (&"anya".into(), 22));
        for query in &queries {
            let [cost, lower, bound] = ["cost", "lower_bound", "bound"].map(|name| number(query, name));
            let [best, ratio] = ["any_angle", "ratio"].map(|name| number(query, name));
            assert!((cost / lower - bound).abs() < 1e-12 && (cost / best - ratio).abs() < 1e-12, "{query}");
            assert!(
                straight(query) <= lower * SLACK && lower <= best * SLACK && best <= cost * SLACK,
                "{query}"
            );
            assert!(1.0 <= bound && ratio <= bound * SLACK, "{options}: {query}");
            match worst {
                Some(worst) => assert!(bound <= worst * SLACK, "{options}: {query}"),
                // A suboptimal engine has only the straight line as a bound.
                None => assert!((lower - straight(query)).abs() < 1e-9 * lower, "{options}: {query}"),
            }
            inexact += u32::from(ratio > SLACK);
        }
        for (name, key) in [("bound", "bound"), ("ratio", "ratio")] {
            let of = |query: &Value| number(query, key);
            let mean = queries.iter().map(of).sum::<f64>() / 22.0;
            let worst = queries.iter().map(of).fold(0.0, f64::max);
            let at = queries.iter().position(|query| of(query) == worst);
            assert!((number(&summary[name], "mean") - mean).abs() < 1e-9, "{options}: {summary}");
            assert!((number(&summary[name], "worst") - worst).abs() < 1e-12, "{options}: {summary}");
            assert_eq!(summary[name]["worst_index"].as_u64(), at.map(|at| at as u64), "{options}");
        }
    }
    assert!(inexact > 100, "only {inexact} paths are longer than the shortest");
}

#[test]
fn centers_have_certificates_too() {
    for options in ["", " --corners one --k 4", " --corners always --k 5"] {
        let (_, queries, summary) = told(&format!("run builtin:cave{options}"));
        let (_, compared, excess) = told(&format!("run builtin:cave{options} --reference anya"));
        assert_eq!((queries.len(), compared.len()), (32, 32));
        for (query, compared) in queries.iter().zip(&compared) {
            assert!(query["any_angle"].is_null() && query["ratio"].is_null());
            // The straight line is all that is known of the shortest path, which bends at corners.
            let (bound, cost) = (number(query, "bound"), number(query, "cost"));
            let best = number(compared, "any_angle");
            assert!(number(query, "lower_bound") <= best * SLACK && bound >= 1.0, "{query}");
            assert!(best <= cost * SLACK && number(compared, "ratio") >= 1.0, "{compared}");
        }
        assert!(summary["ratio"].is_null() && !summary["bound"].is_null());
        assert!(number(&excess["ratio"], "mean") > 1.0 && number(&excess["ratio"], "mean") < 1.2, "{excess}");
    }
}

#[test]
fn between_centers_a_path_at_any_angle_is_its_own_certificate() {
    let (run, queries, _) = told("run builtin:cave --k any --placement center");
    assert_eq!((&run["placement"], &run["gap"]), (&"center".into(), &"closed".into()));
    assert!(queries.iter().all(|query| query["bound"] == 1.0 && query["lower_bound"] == query["cost"]));
    let (_, by_labels, _) = told("run builtin:cave --k any --placement center --engine subgoal --gap closed");
    for (one, other) in queries.iter().zip(&by_labels) {
        assert!((number(one, "cost") - number(other, "cost")).abs() < 1e-8, "{one}, {other}");
    }
}

#[test]
fn a_path_of_length_0_has_a_certificate_and_no_path_has_none() {
    let files = Files::new();
    let map = files.add("walls.map", "type octile\nheight 1\nwidth 5\nmap\n.@@..\n");
    let line = |x: i32, goal: i32| format!("0\twalls.map\t5\t1\t{x}\t0\t{goal}\t0\t1\n");
    let scenario = files.add("walls.scen", format!("version 1\n{}{}", line(4, 4), line(0, 4)));
    let line = format!("run {map} --scen {scenario} --placement corner --reference anya");
    let (_, queries, summary) = told(&line);
    let figures =
        |query: &Value| ["lower_bound", "bound", "any_angle", "ratio"].map(|name| query[name].as_f64());
    assert_eq!(figures(&queries[0]), [0.0, 1.0, 0.0, 1.0].map(Some));
    assert_eq!((&queries[1]["status"], figures(&queries[1])), (&"unreachable".into(), [None; 4]));
    assert_eq!(number(&summary["ratio"], "mean"), 1.0);
    let (_, _, nothing) = told(&format!("run {map} --from 0,0 --to 4,0"));
    assert_eq!((&nothing["bound"], &nothing["ratio"]), (&Value::Null, &Value::Null));
}

#[test]
fn smoothing_makes_paths_no_longer() {
    let sum = |queries: &[Value]| queries.iter().map(|query| number(query, "cost")).sum::<f64>();
    for placement in ["center", "corner"] {
        let smoothed =
            |options: &str| told(&format!("run builtin:cave --k 4 --placement {placement}{options}"));
        let (plain, bare) = (smoothed(""), smoothed(" --smooth"));
        for (option, name) in [("", "linear"), ("=linear", "linear"), ("=taut", "taut")] {
            let (run, queries, _) = smoothed(&format!(" --smooth{option}"));
            assert_eq!((&run["smooth"], &run["smoothing"]), (&true.into(), &name.into()));
            assert_eq!(run["guarantee"], "at most optimal(4)");
            assert!(sum(&queries) < sum(&plain.1), "{placement}{option}");
            for (query, before) in queries.iter().zip(&plain.1) {
                assert!(number(query, "cost") <= number(before, "cost") * SLACK, "{query}");
                assert_eq!(query["expanded"], before["expanded"]);
            }
            let paths =
                |queries: &[Value]| queries.iter().map(|query| query["path"].clone()).collect::<Vec<_>>();
            assert_eq!(paths(&queries) == paths(&bare.1), name == "linear", "{placement}{option}");
        }
    }
}

/// The output of a command line that succeeds, in 80 columns.
#[track_caller]
fn shown(line: &str) -> String {
    let text = common::shown(line);
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    text
}

#[test]
fn a_single_path_is_certified_and_compared() {
    let query = "run builtin:archipelago --from 1,20 --to 70,20 --placement corner";
    insta::assert_snapshot!(
        "a_path_and_its_certificate",
        shown(&format!("{query} --engine astar --k 4 --reference anya"))
    );
    insta::assert_snapshot!("an_any_angle_path", shown(&format!("{query} --engine anya --draw")));
    let best = shown(&format!("{query} --engine anya --reference anya"));
    assert!(best.contains("\n  no path at any angle is shorter (certificate)\n"), "{best}");
    assert!(best.contains("\n  as short as the one that anya finds, of length 71."), "{best}");
    let plain = shown(&format!("{query} --engine astar"));
    assert!(
        plain.contains(" longer than the shortest path at any angle (certificate)\n")
            && !plain.contains("anya")
    );
}

#[test]
fn many_paths_are_summed_up() {
    let theta = "run builtin:archipelago --engine theta --placement corner --smooth=taut --reference anya";
    insta::assert_snapshot!("many_paths_and_their_certificates", shown(theta));
    let anya = shown("run builtin:archipelago --engine anya");
    assert!(
        anya.contains("\n  any angle  every path is a shortest one at any angle (certified)\n"),
        "{anya}"
    );
}

/// Runs a command line that fails, and checks all that it says.
#[track_caller]
fn refused(line: &str, message: &str) {
    let Ran { status, stdout, stderr } = run(line);
    let said = (stderr.as_str(), stdout.as_str(), status);
    assert_eq!(said, (&*format!("error: {message}\n"), "", Some(2)), "{line}");
}

#[test]
fn what_does_not_go_together_is_refused() {
    let centers = "astar, dijkstra, wavefront, canonical, jps, jps-block, jps-plus, theta, lazy-theta, subgoal, hpa, chpa, landmarks";
    for (options, message) in [
        ("--engine theta --k any", "theta needs a k from 2 to 12; for any choose anya, subgoal"),
        (
            "--engine anya --k 4 --placement center",
            &format!("anya needs placement corner; for center choose {centers}"),
        ),
        ("--engine anya --corners one", "--corners: for k = any there is gap in its place: open or closed"),
        (
            "--k any --placement center --corners never",
            "--corners: for k = any there is gap in its place: open or closed",
        ),
        (
            "--k 4 --placement center --gap open",
            "--gap: at centers it is for k = any; else there is corners in its place: never, one or always",
        ),
        (
            "--reference astar",
            "invalid value 'astar' for '--reference <ENGINE>' [possible values: anya, subgoal]; see --help",
        ),
        (
            "--smooth=hard",
            "invalid value 'hard' for '--smooth[=<linear|taut>]' [possible values: linear, taut]; see --help",
        ),
        ("--smooth taut", "unexpected argument 'taut' found; see --help"),
        (
            "--from 1,2 --distances - --engine dijkstra --smooth",
            "the argument '--distances <FILE>' cannot be used with '--smooth[=<linear|taut>]'; see --help",
        ),
        (
            "--from 1,2 --distances - --engine dijkstra --reference anya",
            "the argument '--distances <FILE>' cannot be used with '--reference <ENGINE>'; see --help",
        ),
        (
            "--from 1,2 --distances - --engine anya",
            "anya has no distances to all vertices: choose dijkstra, wavefront",
        ),
        (
            "--engine anya --index x.idx",
            "anya has no index: choose jps-plus, subgoal, subgoal-theta, hpa, chpa, landmarks",
        ),
        (
            "--engine anya --heuristic zero",
            "anya takes no heuristic: leave it out, or choose astar, canonical, jps, jps-block, jps-plus, theta, lazy-theta, chpa",
        ),
    ] {
        refused(&format!("run builtin:cave {options}"), message);
    }
    refused(
        "build builtin:cave --engine anya -o x.idx",
        "anya has no index: choose jps-plus, subgoal, subgoal-theta, hpa, chpa, landmarks",
    );
    refused(
        "build builtin:cave --engine jps-plus --smooth -o x.idx",
        "unexpected argument '--smooth' found; see --help",
    );
}

#[test]
fn an_index_serves_smoothed_runs() {
    let files = Files::new();
    let index = files.path("cave.idx");
    let built = mediant(&["build", "builtin:cave", "--engine", "jps-plus", "-o", &index]);
    assert_eq!((built.status, built.stderr.as_str()), (Some(0), ""));
    let paths = |options: &str| {
        let (_, queries, _) = told(&format!("run builtin:cave --engine jps-plus --smooth{options}"));
        queries.iter().map(|query| query["path"].clone()).collect::<Vec<_>>()
    };
    assert_eq!(paths(&format!(" --index {index}")), paths(""));
}
