//! `auto`: the engine for what is asked, and what is said of it.

use crate::{
    common::{Files, built, redact_times, refused, run, shown, succeeds, told},
    errors::check,
};

#[test]
fn it_knows_how_many_paths_are_asked_for() {
    for (options, engine) in [
        ("--from 2,5 --to 62,33", "canonical"),
        ("--limit 1", "canonical"),
        ("", "jps-block"),
        ("--k any", "anya"),
        ("--k 4", "astar"),
        ("--k 5 --placement corner", "anya"),
    ] {
        for name in ["", " --engine auto", " --engine AUTO"] {
            let (run, queries, _) =
                told(format!("run builtin:cave {options}{name}").replace("  ", " ").trim());
            assert_eq!(
                (&run["engine"], &run["searched_by"], &run["asked"]),
                (&engine.into(), &engine.into(), &"auto".into()),
                "{options}{name}"
            );
            assert!(queries.iter().all(|query| query["status"] == "found"), "{options}{name}");
        }
        let (run, ..) = told(&format!("run builtin:cave {options} --engine {engine}").replace("  ", " "));
        assert!(run.get("asked").is_none(), "who names an engine has not asked for auto");
    }
    // Many queries are worth an index.
    let files = Files::new();
    let query = |i: usize| format!("0\tyard.map\t40\t2\t0\t0\t{}\t1\t0\n", i % 40);
    let map =
        files.add("yard.map", format!("type octile\nheight 2\nwidth 40\nmap\n{0}\n{0}\n", ".".repeat(40)));
    for (queries, engine) in [(1_000, "jps-block"), (1_001, "subgoal")] {
        let scen = format!("version 1\n{}", (0..queries).map(query).collect::<String>());
        let text = run(&format!("run {map} --scen {}", files.add("yard.scen", scen))).stdout;
        assert!(text.contains(&format!("\nauto took {engine}: ")), "{queries}: {text}");
    }
}

#[test]
fn it_says_what_it_took_and_why() {
    let text = shown("run builtin:cave");
    assert!(
        text.contains(
            "\njps-block, heuristic hk · k = 3 (8 moves) · center, corners never\n\
             auto took jps-block: it reads the map by words of 64 cells\noptimal(3) · "
        ),
        "{text}"
    );
    assert!(!shown("run builtin:cave --engine jps-block").contains("auto"));
    let text = shown("table builtin:town --from 10,3 --from 58,18 --to 6,6");
    assert!(text.contains("\nauto took jps-block: "), "{text}");
    let lines = succeeds("table builtin:town --from 10,3 --to 6,6 --format jsonl");
    let head: serde_json::Value = serde_json::from_str(lines.lines().next().expect("a line")).expect("JSON");
    assert_eq!((&head["engine"], &head["asked"]), (&"canonical".into(), &"auto".into()));
}

#[test]
fn an_index_is_of_the_best_engine_that_has_one() {
    let files = Files::new();
    for (options, engine) in [
        ("", "subgoal"),
        ("--k any", "subgoal"),
        ("--k 5 --placement corner", "subgoal"),
        ("--corners one", "jps-plus"),
        ("--side 8", "hpa"),
    ] {
        let line = format!("build builtin:cave {options} -o {}", files.path("cave.idx")).replace("  ", " ");
        let text = redact_times(&succeeds(&line));
        assert!(text.starts_with(&format!("cave.idx · {engine} of cave.map · ")), "{text}");
        assert!(text.contains(&format!("\nauto took {engine}: ")), "{text}");
        // The file says which engine it is of.
        let motion = if options.starts_with("--side") { "" } else { options };
        let (run, ..) =
            told(&format!("run builtin:cave {motion} --index {}", files.path("cave.idx")).replace("  ", " "));
        assert_eq!((&run["engine"], &run["asked"]), (&engine.into(), &"auto".into()), "{options}");
    }
    check(
        &format!("build builtin:cave --k 9 -o {}", files.path("no.idx")),
        "no engine has an index for center, corners never, k = 9: choose k = 2 to 8, or placement corner, or name an \
         engine that needs none",
    );
    let index = built(&files, "hpa.idx", "builtin:cave --engine hpa");
    let wrong = refused(&files, &format!("run builtin:cave --index {index} --jump-limit 3"));
    assert!(wrong.starts_with("error: hpa takes no jump limit: "), "{wrong}");
}

#[test]
fn options_choose_among_engines() {
    for (options, engine) in [
        ("--heuristic euclidean", "jps-block"),
        ("--heuristic zero --k 4", "astar"),
        ("--keep-intermediate --k 5", "jps"),
        ("--levels 2", "subgoal"),
        ("--memory 8MB", "subgoal"),
        ("--step 2", "chpa"),
    ] {
        let (run, ..) = told(&format!("run builtin:cave {options}"));
        assert_eq!(run["engine"], engine, "{options}");
    }
    check(
        "run builtin:cave --step 2 --keep-intermediate",
        "jps-block takes no step: leave it out, or choose chpa",
    );
}

#[test]
fn a_path_can_be_required() {
    let status = |line: &str| {
        let ran = run(line);
        (ran.status, ran.stderr)
    };
    let none = "error: there is no path, and --require-path asks for one\n";
    let to_isle = "run builtin:cave --from 2,5 --to 37,0";
    assert_eq!(status(to_isle).0, Some(1), "the goal is blocked, which is another thing");
    let files = Files::new();
    let map = files.add("yard.map", "type octile\nheight 1\nwidth 5\nmap\n..@..\n");
    let run_yard = |options: &str| status(&format!("run {map} {options}"));
    assert_eq!(run_yard("--from 0,0 --to 4,0"), (Some(0), String::new()));
    assert_eq!(run_yard("--from 0,0 --to 4,0 --require-path"), (Some(3), none.to_owned()));
    assert_eq!(run_yard("--from 0,0 --to 4,0 --distance --require-path"), (Some(3), none.to_owned()));
    assert_eq!(run_yard("--from 0,0 --to 4,0 --nearest --require-path"), (Some(3), none.to_owned()));
    assert_eq!(run_yard("--from 0,0 --to 1,0 --max-nodes 0 --require-path"), (Some(3), none.to_owned()));
    assert_eq!(run_yard("--from 0,0 --to 1,0 --require-path"), (Some(0), String::new()));
    assert_eq!(run_yard("--from 0,0 --to 2,0 --require-path").0, Some(1), "an error stays an error");
    let scen = "version 1\n0\tyard.map\t5\t1\t0\t0\t1\t0\t1\n0\tyard.map\t5\t1\t0\t0\t4\t0\t0\n";
    let scen = files.add("yard.scen", scen);
    assert_eq!(run_yard(&format!("--scen {scen}")).0, Some(0));
    assert_eq!(
        run_yard(&format!("--scen {scen} --require-path")),
        (Some(3), "error: 1 of 2 has no path, and --require-path asks for all\n".to_owned())
    );
    let table =
        |options: &str| status(format!("table {map} --from 0,0 --from 4,0 --to 1,0 {options}").trim());
    assert_eq!(table("").0, Some(0));
    assert_eq!(
        table("--require-path"),
        (Some(3), "error: 1 of 2 has no path, and --require-path asks for all\n".to_owned())
    );
    assert_eq!(table("--to 3,0 --require-path").0, Some(3));
    assert_eq!(table("--to 3,0 --nearest --require-path").0, Some(0));
}

#[test]
fn all_distances_need_no_name_of_an_engine() {
    let named = succeeds("run builtin:cave --from 2,5 --engine dijkstra --distances -");
    assert_eq!(succeeds("run builtin:cave --from 2,5 --distances -"), named);
}
