//! The table of calls that every language answers alike: see `crates/mediant/tests/calls.json`.

use serde_json::Value;

use crate::common::{Files, Ran, mediant};

/// The flags of a call; `None` if a command line cannot say it.
fn flags(call: &Value) -> Option<Vec<String>> {
    let mut flags = Vec::new();
    for (name, value) in call.as_object()? {
        let is_flag = matches!(&**name, "nearest" | "snap" | "keep-intermediate" | "unstraightened");
        match value {
            Value::Bool(true) if is_flag => flags.push(format!("--{name}")),
            Value::Bool(false) if is_flag => {}
            Value::Number(number) if !is_flag => flags.push(format!("--{name}={number}")),
            Value::String(text) if !is_flag => flags.push(format!("--{name}={text}")),
            _ => return None,
        }
    }
    Some(flags)
}

fn place(at: &Value) -> String {
    format!("{},{}", at[0], at[1])
}

/// Holds a call to what the table says of it.
fn check(case: &Value, map: &str, flags: &[String]) {
    let ends = [format!("--from={}", place(&case["start"])), format!("--to={}", place(&case["goal"]))];
    let mut args = vec!["run".to_owned(), map.to_owned(), "--format=jsonl".to_owned()];
    args.extend(ends.into_iter().chain(flags.iter().cloned()));
    let Ran { status, stdout, stderr } = mediant(&args);
    let expected = &case["expected"];
    let lines: Vec<Value> = stdout.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    if let Some(code) = expected.get("code") {
        assert_ne!(status, Some(0), "{case}");
        match lines.get(1) {
            Some(query) => assert_eq!((&query["status"], &query["code"]), (&"error".into(), code), "{case}"),
            // Before any query. The text is the library's, unless clap knows a name that is meant.
            None => {
                let error = expected["error"].as_str().expect("a text");
                let wrong = error.split_once(": ").map_or(error, |(_, wrong)| wrong);
                // A point that is no vertex is refused with its argument.
                let is_known = stderr.contains("[possible values: ")
                    || code == "between-vertices" && stderr.contains("is no vertex");
                assert!(stderr.contains(wrong) || is_known, "{case}: {stderr}");
            }
        }
        return;
    }
    assert_eq!((status, &*stderr), (Some(0), ""), "{case}");
    let (run, query) = (&lines[0], &lines[1]);
    assert_eq!((&run["setup"], &query["status"]), (&expected["setup"], &expected["status"]), "{case}");
    assert_eq!(query.get("stopped_by"), expected.get("stopped_by"), "{case}");
    if let Some(path) = expected.get("path") {
        assert_eq!(&query["path"], path, "{case}");
        let [found, known] =
            [&query["cost"], &expected["distance"]].map(|cost| cost.as_f64().expect("a cost"));
        assert!((found - known).abs() < 1e-8, "{case}: {found}");
    }
}

#[test]
fn every_call_of_the_table_is_answered_as_it_says() {
    let table = std::fs::read_to_string("../mediant/tests/calls.json").expect("the table");
    let table: Value = serde_json::from_str(&table).expect("JSON");
    let files = Files::new();
    let map = |name: &str| {
        let rows: Vec<&str> = table["maps"][name]
            .as_array()
            .expect("rows")
            .iter()
            .map(|row| row.as_str().expect("a row"))
            .collect();
        let size = format!("height {}\nwidth {}", rows.len(), rows[0].len());
        files.add(&format!("{name}.map"), format!("type octile\n{size}\nmap\n{}\n", rows.join("\n")))
    };
    let [yard, hall] = ["yard", "hall"].map(map);
    let mut tried = 0;
    for case in table["cases"].as_array().expect("calls") {
        if let Some(flags) = flags(&case["call"]) {
            check(case, if case["map"] == "yard" { &yard } else { &hall }, &flags);
            tried += 1;
        }
    }
    assert!(tried >= 120, "{tried} calls");
}
