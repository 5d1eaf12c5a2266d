//! Loading a problem from the files of a benchmark set.

use std::fs;

use mediant_bench::Problem;
use mediant_sets::Archive;

#[test]
fn a_map_with_its_scenario_is_a_problem() {
    let cache = tempfile::tempdir().expect("a folder");
    let archive = Archive::new([cache.path().to_owned()]);
    assert!(Problem::load(&archive, "toy", "yard", 1).expect("nothing unreadable").is_none());

    let set = cache.path().join("toy");
    fs::create_dir(&set).expect("a folder");
    fs::write(set.join("yard.map"), "type octile\nheight 1\nwidth 3\nmap\n...\n").expect("a file");
    let scenario = "version 1\n0\tyard.map\t3\t1\t0\t0\t2\t0\t2\n";
    fs::write(set.join("yard.map.scen"), scenario).expect("a file");
    let problem = Problem::load(&archive, "toy", "yard", 1).expect("a problem").expect("its files");
    assert_eq!((problem.name(), problem.len(), problem.grid().width()), ("yard", 1, 3));

    fs::write(set.join("yard.map"), "no map").expect("a file");
    let error = Problem::load(&archive, "toy", "yard", 1).expect_err("not a map").to_string();
    assert!(error.starts_with("map `yard`: "), "{error}");
}
