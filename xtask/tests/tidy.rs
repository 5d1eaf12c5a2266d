//! The rules hold for the project, and each of them finds what it is there to find.

use std::{collections::BTreeMap, path::PathBuf};

use mediant_sets::root;
use xtask::{
    Tree,
    project::{self, Dependency, Kind, Package},
    tidy::{self, COMPILED, Exception, Finding, MOST_CLAUSES},
};

#[test]
fn the_project_is_tidy() {
    let findings = tidy::check(&root()).unwrap();
    let listed: String = findings.iter().map(|finding| format!("{finding}\n")).collect();
    assert!(findings.is_empty(), "{} broken rules:\n{listed}", findings.len());
}

#[test]
fn the_files_of_the_project_are_found() {
    let files = project::files(&root()).unwrap();
    for file in ["Cargo.toml", "xtask/src/lib.rs", "xtask/tests/tidy.rs", "crates/formats/src/text.rs"] {
        assert!(files.contains(&PathBuf::from(file)), "{file}");
    }
    assert!(!files.iter().any(|file| file.starts_with("target") || file.starts_with(".git/")));
}

fn tree(files: &[(&str, &str)]) -> Tree {
    Tree::new(files.iter().map(|(path, text)| (path.into(), text.as_bytes().to_vec())).collect())
}

/// The findings in a tree as lines, without their reasons.
fn found(files: &[(&str, &str)], exceptions: &[Exception]) -> Vec<String> {
    tidy::check_files(&tree(files), exceptions).iter().map(short).collect()
}

fn short(finding: &Finding) -> String {
    let text = finding.to_string();
    let (found, reason) = text.rsplit_once([':', ';']).expect("a reason");
    assert!(reason.len() > 10, "no reason: {text}");
    found.to_owned()
}

/// A function of so many lines, the first and the last included.
fn function(name: &str, lines: usize) -> String {
    format!("fn {name}() {{\n{}}}\n", "    work();\n".repeat(lines - 2))
}

const PACKAGE: (&str, &str) = ("a/Cargo.toml", "");
const STORY: (&str, &str) = ("a/src/lib.rs", "//! Story.\nmod b;\n");

#[test]
fn a_tidy_tree() {
    let files = [
        PACKAGE,
        (
            "a/src/lib.rs",
            "//! Story.\n#![no_std]\nextern crate alloc;\nmod b;\npub mod c;\n#[cfg(test)]\nmod d;\npub use b::B;\n",
        ),
        ("a/src/b.rs", "mod e;\nmod f { mod g; }\n"),
        ("a/src/c/mod.rs", ""),
        ("a/src/d.rs", "//! `todo!()`\nconst S: &str = \"dbg!() #[ignore]\";\n"),
        ("a/src/b/e.rs", &function("long_enough", 70)),
        ("a/src/b/f/g.rs", ""),
        ("a/src/main.rs", ""),
        ("a/src/bin/tool.rs", ""),
        ("a/tests/test.rs", "mod common;\n"),
        ("a/tests/common/mod.rs", ""),
        ("a/benches/bench.rs", ""),
        ("a/build.rs", ""),
        (
            "README.md",
            "[a](a/src/b.rs#L1), [b](a/), [c](#x), ![d](https://example.org/x.png), `[e](gone)`\n```\n[f](gone)\n```\n",
        ),
        ("a/README.md", "[up](../README.md), [here](./src/lib.rs \"title\"), [mail](mailto:a@example.org)\n"),
        ("data.bin", "\u{0}\t "),
    ];
    assert_eq!(found(&files, &[]), [""; 0]);
}

#[test]
fn lengths() {
    let long = format!("#[inline]\n/// Documentation.\n{}", function("long", 71));
    let method = format!("struct S;\nimpl S {{\n{}}}\n", function("method", 80));
    let default = format!("trait T {{\n{}}}\n", function("default", 72));
    let files = [
        PACKAGE,
        ("a/src/main.rs", "mod b;\nmod c;\nmod d;\nmod e;\n"),
        ("a/src/b.rs", &long),
        ("a/src/c.rs", &method),
        ("a/src/d.rs", &default),
        ("a/src/e.rs", &"\n".repeat(501)),
    ];
    let all = [
        "a/src/b.rs:3: `long` has 71 lines, at most 70",
        "a/src/c.rs:3: `method` has 80 lines, at most 70",
        "a/src/d.rs:2: `default` has 72 lines, at most 70",
        "a/src/e.rs: 501 lines, at most 500: a file should have one subject",
    ];
    assert_eq!(found(&files, &[]), all);

    let exception = |file, function, lines| Exception { file, function, lines, reason: "of the test" };
    let exceptions = [
        exception("a/src/b.rs", Some("long"), 71),
        exception("a/src/c.rs", Some("method"), 75),
        exception("a/src/e.rs", None, 501),
    ];
    assert_eq!(found(&files, &exceptions), ["a/src/c.rs:3: `method` has 80 lines, at most 75", all[2]]);
    let unneeded = [
        exception("a/src/b.rs", Some("short"), 90),
        exception("a/src/b.rs", None, 900),
        exception("a/src/gone.rs", None, 900),
    ];
    let expected = [
        "a/src/b.rs: the exception for `short` is not needed any more",
        "a/src/b.rs: the exception is not needed any more",
        all[0],
        all[1],
        all[2],
        all[3],
        "a/src/gone.rs: the exception is not needed any more",
    ];
    assert_eq!(found(&files, &unneeded), expected);
}

#[test]
fn leftovers() {
    let text = "fn f() {\n    assert!(g(todo!()));\n    if dbg!(true) {}\n    std::unimplemented!()\n}\n\
                #[test]\n#[ignore = \"slow\"]\nfn t() {}\n#[cfg_attr(miri, ignore)]\nfn u() {}\nfn h(dbg: bool) -> bool { !dbg }\n";
    let expected = [
        "a/src/main.rs:2: `todo!`",
        "a/src/main.rs:3: `dbg!`",
        "a/src/main.rs:4: `unimplemented!`",
        "a/src/main.rs:7: an ignored test",
        "a/src/main.rs:9: an ignored test",
    ];
    assert_eq!(found(&[PACKAGE, ("a/src/main.rs", text)], &[]), expected);
    let marks = [["FIX", "ME"].concat(), ["X", "XX"].concat()];
    let text = format!("{}: no\n{}\n{}X\n", marks[0], marks[1], marks[1]);
    let expected =
        [1, 2].map(|line| format!("notes.md:{line}: `{}`: mend it, or say what is so", marks[line - 1]));
    assert_eq!(found(&[("notes.md", &text)], &[]), expected);
    let broken = tree(&[PACKAGE, ("a/src/main.rs", "fn f() {\n    let = 1;\n}\n")]);
    let findings = tidy::check_files(&broken, &[]);
    assert_eq!((findings.len(), findings[0].line), (1, 2));
    assert!(findings[0].message.starts_with("cannot be parsed: "), "{}", findings[0]);
}

#[test]
fn files_that_nothing_declares() {
    let files = [
        PACKAGE,
        STORY,
        ("a/src/b.rs", ""),
        ("a/src/dead.rs", "mod alone;\n"),
        ("a/src/dead/alone.rs", ""),
        ("a/tests/common/mod.rs", ""),
        ("elsewhere/src/lib.rs", "//! No package.\n"),
    ];
    let dead = |file| format!("{file}: no `mod` line declares this file");
    let expected =
        ["a/src/dead/alone.rs", "a/src/dead.rs", "a/tests/common/mod.rs", "elsewhere/src/lib.rs"].map(dead);
    assert_eq!(found(&files, &[]), expected);
}

#[test]
fn what_a_lib_rs_holds() {
    let text = "#![no_std]\nuse core::fmt;\nmod b { }\nfn f() {}\npub use fmt::Write;\n";
    let expected = [
        "a/src/lib.rs:1: does not begin with `//!`",
        "a/src/lib.rs:2: an item in lib.rs",
        "a/src/lib.rs:3: an item in lib.rs",
        "a/src/lib.rs:4: an item in lib.rs",
    ];
    assert_eq!(found(&[PACKAGE, ("a/src/lib.rs", text)], &[]), expected);
}

#[test]
fn spaces_tabs_sizes_and_machine_paths() {
    let large = "x".repeat((512 << 10) + 1);
    let folder = |name: &str| format!("see /{name}/me/x, not a/{name}/b nor https://example.org/{name}/c\n");
    let [home, work] = ["home", "work"].map(folder);
    let files = [
        ("a.md", "one \n\ttwo\nthree\r\n"),
        ("a.toml", "key = 1\t\n"),
        ("a.txt", "free \t\n"),
        ("b.txt", &home),
        ("c.sh", &work),
        ("large.csv", &large),
    ];
    let expected = [
        "a.md:1: white space at the end of the line",
        "a.md:2: a tab",
        "a.md:3: white space at the end of the line",
        "a.toml:1: white space at the end of the line",
        "b.txt:1: `/HOME/` is a path of one machine",
        "c.sh:1: `/WORK/` is a path of one machine",
        "large.csv: 512 KiB, at most 512 KiB",
    ];
    let expected = expected.map(|line| line.replace("HOME", "home").replace("WORK", "work"));
    assert_eq!(found(&files, &[]), expected);
}

#[test]
fn links() {
    let files = [
        ("README.md", "[a](gone.md) and [`b`](docs/gone.md#x)\n[c](<docs/b.md>)\n[ref]: docs/none.md\n"),
        ("docs/b.md", "[up](../../README.md), [root](/README.md), [fine](b.md)\n"),
    ];
    let expected = [
        "README.md:1: `docs/gone.md` is no file of the project",
        "README.md:1: `gone.md` is no file of the project",
        "README.md:3: `docs/none.md` is no file of the project",
        "docs/b.md:1: `../../README.md` is no file of the project",
        "docs/b.md:1: `/README.md` is no file of the project",
    ];
    assert_eq!(found(&files, &[]), expected);
}

#[test]
fn comments_that_name_no_thing() {
    let file = |lines: usize| {
        let begins = ["/// What", "    /// Those", "// What", "//What"];
        let lines = begins.iter().cycle().take(lines).map(|begin| format!("{begin} it is.\n"));
        // Code, strings and other words do not count.
        lines.collect::<String>() + "// Whatever.\nfn f() { g(\"// What it is\"); } // What it does.\n"
    };
    let (first, last) = (MOST_CLAUSES / 2, MOST_CLAUSES - MOST_CLAUSES / 2);
    let found_in =
        |first, last| found(&[PACKAGE, ("a/src/main.rs", &file(first)), ("a/build.rs", &file(last))], &[]);
    assert_eq!(found_in(first, last), [""; 0]);
    let expected = format!(
        "xtask/src/tidy/clauses.rs: {} lines of comments begin with `What` or `Those`, at most {MOST_CLAUSES}",
        MOST_CLAUSES + 1
    );
    assert_eq!(found_in(first, last + 1), [expected]);
}

#[test]
fn dependencies() {
    let package = |name: &str, dependencies: &[(&str, Option<Kind>)]| Package {
        name: name.to_owned(),
        dependencies: dependencies
            .iter()
            .map(|&(name, kind)| Dependency { name: name.to_owned(), kind, optional: name == "serde" })
            .collect(),
        ..Package::default()
    };
    let packages = [
        package(
            "mediant-moves",
            &[("libm", None), ("serde", None), ("criterion", Some(Kind::Dev)), ("cc", Some(Kind::Build))],
        ),
        package(
            "mediant-grid",
            &[("mediant-moves", None), ("bitvec", None), ("mediant-oracle", Some(Kind::Dev))],
        ),
        package("mediant-formats", &[("mediant-grid", None), ("mediant-search", None)]),
        package(
            "mediant-search",
            &[("mediant-grid", None), ("mediant-oracle", None), ("mediant", Some(Kind::Dev))],
        ),
        package("mediant-oracle", &[("mediant-grid", None), ("mediant-search", Some(Kind::Dev))]),
        package("mediant", &[("mediant-search", None), ("mediant-report", None)]),
        package("mediant-report", &[("serde", None), ("mediant-search", None)]),
        package("mediant-sets", &[("mediant-formats", None), ("zip", None), ("mediant-bench", None)]),
        package(
            "mediant-bench",
            &[("mediant-search", None), ("mediant-sets", None), ("mediant-papers", None)],
        ),
        package("mediant-papers", &[("mediant-bench", None), ("mediant-oracle", None)]),
        package("xtask", &[("mediant-sets", None), ("syn", None), ("mediant-search", None)]),
        package("mediant-new", &[]),
    ];
    let findings = tidy::check_packages(&packages);
    let expected = [
        "mediant-moves: depends on libm",
        "mediant-moves: depends on cc",
        "mediant-formats: depends on mediant-search",
        "mediant-search: depends on mediant-oracle",
        "mediant-oracle: depends on mediant-search",
        "mediant: depends on mediant-report",
        "mediant-report: depends on mediant-search",
        "mediant-sets: depends on mediant-bench",
        "mediant-bench: depends on mediant-papers",
        "xtask: depends on mediant-search",
        "mediant-new: has no place among the layers",
    ];
    assert_eq!(findings.iter().map(short).collect::<Vec<_>>(), expected);
}

#[test]
fn what_is_published() {
    let package = |name: &str, folder: &str| Package {
        name: name.to_owned(),
        manifest_path: format!("{folder}/Cargo.toml").into(),
        description: Some("What it is".to_owned()),
        readme: Some("README.md".into()),
        ..Package::default()
    };
    let kept_back = Some(Vec::new());
    let features = BTreeMap::from([("parallel".to_owned(), Vec::new())]);
    let documented: serde_json::Value = serde_json::json!({ "docs": { "rs": { "all-features": true } } });
    let packages = [
        Package { features: features.clone(), metadata: documented, ..package("mediant-moves", "good") },
        Package { publish: kept_back.clone(), features, ..package("mediant-grid", "silent") },
        Package { description: None, ..package("mediant-search", "bare") },
        Package { readme: None, ..package("mediant", "nothing") },
        Package { publish: kept_back, readme: None, description: None, ..package("mediant-bench", "ours") },
        package("mediant-new", "new"),
    ];
    let files = tree(&[
        ("LICENSE", "Do what you like.\n"),
        ("good/LICENSE", "Do what you like.\n"),
        ("good/README.md", "[elsewhere](https://example.org), `[code](x)`\n"),
        ("silent/LICENSE", "Do what we like.\n"),
        ("silent/README.md", "\n[license](LICENSE)\n"),
        ("bare/README.md", ""),
        ("nothing/LICENSE", "Do what you like.\n"),
    ]);
    let expected = [
        "silent/Cargo.toml: `publish = false` in a crate that is published",
        "silent/Cargo.toml: no `all-features = true` for docs.rs",
        "silent/LICENSE: differs from the LICENSE at the top",
        "silent/README.md:2: a link to `LICENSE`",
        "bare/Cargo.toml: no `description`",
        "bare/LICENSE: no such file",
        "nothing/Cargo.toml: no README, or one that is not there",
        "new/Cargo.toml: `publish = false` is missing",
    ];
    let findings = tidy::check_published(&packages, &files);
    assert_eq!(findings.iter().map(short).collect::<Vec<_>>(), expected);
}

/// The findings in a list of `cargo tree`, by the rule of a crate.
#[track_caller]
fn compiled(package: &str, tree: &str) -> Vec<String> {
    let rule = COMPILED.iter().find(|rule| rule.package == package).expect("a rule");
    tidy::check_compiled(rule, tree).iter().map(short).collect()
}

#[test]
fn what_a_crate_compiles() {
    let tree = "mediant-search v0.1.0\nbitvec v1.1.1\nserde_core v1.0.229\nrayon-core v1.0.0\n\
                serde v1.0.229 (*)\nserdes v1.0.0\n";
    let expected =
        ["serde_core", "rayon-core", "serde"].map(|name| format!("mediant-search: compiles {name}"));
    assert_eq!(compiled("mediant-search", tree), expected);
    let tree = "mediant-formats v0.1.0\nmediant-grid v0.1.0\nserde_json v1.0.0\nsha2 v0.11.0\n";
    let expected = ["serde_json", "sha2"].map(|name| format!("mediant-formats: compiles {name}"));
    assert_eq!(compiled("mediant-formats", tree), expected);
    let tree =
        "xtask v0.1.0\nmediant-sets v0.1.0\nmediant-formats v0.1.0\nserde v1.0.0\nmediant-subgoal v0.1.0\n";
    assert_eq!(compiled("xtask", tree), ["xtask: compiles mediant-subgoal"]);
}

#[test]
fn long_lines_of_prose() {
    let words = "word ".repeat(30);
    let line = words.trim_end();
    let link = format!("https://example.org/{}", "x".repeat(120));
    let source = format!(
        "//! {line}\n//! | {line} |\n//! ```\n//! {line}\n//! ```\n//! {line}\n//\nfn f() {{\n    \
         g(\"// {line}\", '\"'); // {line}\n    g(\"{line}\n// {line}\n\");\n}}\n/// - {link}\n/// a {link}\nfn h() {{}}\n"
    );
    let page = format!("{line}\n| {line} |\n```\n{line}\n```\n1. {link}\n1. a {link}\n{}\n", "é".repeat(110));
    let files = [
        PACKAGE,
        ("a/src/main.rs", &source),
        ("README.md", &page),
        ("docs/results/README.md", &page),
        ("notes.txt", &page),
    ];
    let columns = |line: &str| line.rsplit_once(": ").expect("a message").1.to_owned();
    let expected = |file: &str, lines: &[usize]| -> Vec<String> {
        lines.iter().map(|line| format!("{file}:{line}")).collect()
    };
    let all = found(&files, &[]);
    let places: Vec<String> =
        all.iter().map(|line| line.rsplit_once(": ").expect("a message").0.to_owned()).collect();
    let all_expected = [expected("README.md", &[1, 7]), expected("a/src/main.rs", &[1, 6, 9, 15])].concat();
    assert_eq!(places, all_expected);
    assert_eq!(columns(&all[0]), "149 columns of prose, at most 110");
    // Exactly as long as a line may be, in characters, not bytes.
    let fits = format!("{} {}\n", "é".repeat(54), "é".repeat(55));
    assert_eq!(found(&[("README.md", &fits)], &[]), [""; 0]);
    let longer = format!("{} {}\n", "é".repeat(55), "é".repeat(55));
    assert_eq!(found(&[("README.md", &longer)], &[]).len(), 1);
}
