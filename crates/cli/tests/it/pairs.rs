//! Own queries in bulk, and what shells and `man` read.

use serde_json::Value;

use crate::{
    common::{Files, Ran, bundled, run_on, succeeds, told},
    errors::check,
};

/// The starts, goals and costs of a run's queries.
fn answers(queries: &[Value]) -> Vec<[&Value; 3]> {
    queries.iter().map(|query| [&query["start"], &query["goal"], &query["cost"]]).collect()
}

#[test]
fn pairs_are_queries() {
    let files = Files::new();
    let text = "2,5,62,33\n\n 2, 5 ,28,21\r\n62,33,2,5\n";
    let csv = files.add("pairs.csv", text);
    let (run, queries, summary) = told(&format!("run builtin:cave --pairs {csv}"));
    assert_eq!(
        (&run["scenario"], &run["queries"], &summary["found"]),
        (&"pairs.csv".into(), &3.into(), &3.into())
    );
    assert_eq!((&run["engine"], &queries[1]["reference"]), (&"jps-block".into(), &Value::Null));
    for (query, ends) in
        queries.iter().zip(["--from 2,5 --to 62,33", "--from 2,5 --to 28,21", "--from 62,33 --to 2,5"])
    {
        let (_, alone, _) = told(&format!("run builtin:cave {ends}"));
        assert_eq!(query["goal"], alone[0]["goal"]);
        let costs = [query, &alone[0]].map(|query| query["cost"].as_f64().expect("a path"));
        assert!((costs[0] - costs[1]).abs() < 1e-9, "{ends}");
    }
    // With a heading, from stdin, and some of them.
    let piped = run_on("run builtin:cave --pairs - --format jsonl", &format!("x1,y1,x2,y2\n{text}"));
    assert_eq!((piped.stderr.as_str(), piped.status), ("", Some(0)));
    let records: Vec<Value> =
        piped.stdout.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(records[0]["scenario"], "stdin");
    assert_eq!(answers(&records[1..4]), answers(&queries));
    let (_, some, _) = told(&format!("run builtin:cave --pairs {csv} --every 2 --limit 1"));
    assert_eq!(answers(&some), answers(&queries[..1]));
    let Ran { stdout, .. } = run_on("run builtin:cave --pairs -", text);
    assert!(stdout.contains("\n  queries    3: 3 found, 0 unreachable, 0 errors\n"), "{stdout}");
}

#[test]
fn pairs_in_meters() {
    let files = Files::new();
    let yaml = files.path("town.yaml");
    succeeds(&format!("convert builtin:town -o {yaml} --resolution 0.5"));
    let csv = files.add("pairs.csv", "5.25,14.75,29.25,8.75\n");
    let (_, queries, _) = told(&format!("run {yaml} --world --pairs {csv}"));
    assert_eq!((&queries[0]["start"], &queries[0]["goal"]), (&[10, 6].into(), &[58, 18].into()));
}

#[test]
fn what_is_no_pair_is_told_with_its_line() {
    let files = Files::new();
    for (text, problem) in [
        ("1,2,3,4\n1,2,3\n", "line 2: expected x1,y1,x2,y2 such as 1,11,40,30, found 3 parts"),
        ("1,2,3,4,5\n", "line 1: expected x1,y1,x2,y2 such as 1,11,40,30, found 5 parts"),
        ("1,2,3,4\n1,b,3,4\n", "line 2: `b` is no number; write X,Y such as 3,14"),
        (
            "1,2,0.5,4\n",
            "line 1: (0.5, 4) is no vertex: write whole numbers, such as 3,14, or --k any, or meters with --world",
        ),
        ("x1,y1,x2,y2\n", "no pair in it: write a line x1,y1,x2,y2 for each query"),
        ("", "no pair in it: write a line x1,y1,x2,y2 for each query"),
    ] {
        let csv = files.add("pairs.csv", text);
        check(&format!("run builtin:cave --pairs {csv}"), &format!("{csv}: {problem}"));
    }
    check(
        "run builtin:cave --pairs a.csv --from 1,2 --to 3,4",
        "the argument '--pairs <FILE>' cannot be used with: --from <X,Y>; --to <X,Y>; see --help",
    );
}

#[test]
fn a_scenario_can_be_piped() {
    let text = std::fs::read_to_string(bundled("cave.map.scen")).expect("our own scenario");
    let Ran { stdout, stderr, status } = run_on("run builtin:cave --scen - --every 8 --format jsonl", &text);
    assert_eq!((stderr.as_str(), status), ("", Some(0)));
    let records: Vec<Value> = stdout.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let (_, queries, _) = told("run builtin:cave --every 8");
    assert_eq!(answers(&records[1..=queries.len()]), answers(&queries));
    let Ran { stderr, status, .. } = run_on("run builtin:cave --scen -", "junk");
    assert!(stderr.starts_with("error: stdin: ") && status == Some(2), "{stderr}");
}

#[test]
fn shells_and_man_can_read_the_arguments() {
    for (shell, sign) in
        [("bash", "complete -F"), ("zsh", "#compdef mediant"), ("fish", "complete -c mediant")]
    {
        let text = succeeds(&format!("completions {shell}"));
        assert!(text.contains(sign) && text.contains("lazy-theta") && text.contains("neighbors"), "{shell}");
    }
    let page = succeeds("man");
    assert!(page.contains(".TH mediant 1") && page.contains("completions"), "{page}");
    let page = succeeds("man run");
    assert!(page.contains(".TH mediant-run 1") && page.contains("neighbors"), "{page}");
    check(
        "man warp",
        "there is no command `warp`; there are run, table, reach, check, convert, build, moves, engines, demo, \
         completions, man, help",
    );
}
