//! Whole runs on the maps that come with the project; and the committed pages compared with the committed
//! records.

use std::{
    collections::BTreeSet,
    fs,
    path::Path,
    sync::atomic::{AtomicUsize, Ordering},
};

use clap::Parser;

use mediant_report::Record;
use mediant_sets::root;

use crate::{
    Error, Options,
    catalog::{EXPERIMENTS, chosen},
    context::{Context, How, Request, Setting},
    experiment::FIGURES,
    maps, pages,
    records::records,
    run_in,
};

#[derive(Parser)]
struct Cli {
    #[command(flatten)]
    options: Options,
}

fn options(arguments: &[&str]) -> Options {
    Cli::parse_from(["reproduce-tables"].iter().chain(arguments)).options
}

/// A project with the bundled maps and no sets, and a mirror that has none: no network is asked.
fn project_without_sets() -> tempfile::TempDir {
    let (folder, real) = (tempfile::tempdir().unwrap(), root());
    let (benchdata, maps) = (folder.path().join("benchdata"), folder.path().join("crates/cli/maps"));
    for new in [&benchdata, &maps, &folder.path().join("mirror")] {
        fs::create_dir_all(new).unwrap();
    }
    fs::copy(real.join("benchdata/manifest.json"), benchdata.join("manifest.json")).unwrap();
    for entry in fs::read_dir(real.join("crates/cli/maps")).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), maps.join(entry.file_name())).unwrap();
    }
    folder
}

fn reproduce(folder: &Path, arguments: &[&str]) -> Result<(), Error> {
    let mirror = folder.join("mirror").display().to_string();
    run_in(folder, &options(&[&["--mirror", &mirror], arguments].concat()))
}

/// Experiments that are quick on any machine.
const SMALL: [&str; 4] = ["--only", "teleisa2023-runs", "hpa-games", "hammoud2023-tables"];

#[test]
fn without_sets_the_bundled_maps_are_measured_and_it_is_said() {
    let folder = project_without_sets();
    reproduce(folder.path(), &[&SMALL[..], &["--quick"]].concat()).unwrap();
    let out = folder.path().join("docs/results/quick");
    for page in ["README.md", "teleisa2023.md", "hammoud2023.md", "beyond.md"] {
        let text = fs::read_to_string(out.join(page)).unwrap();
        assert!(text.contains("Not the paper") && text.contains("A quick run"), "{page}: {text}");
    }
    // Nothing is judged by published values of other maps.
    let text = fs::read_to_string(out.join("teleisa2023.md")).unwrap();
    let (_, section) = text.split_once("## ").unwrap();
    assert!(section.contains("| 119.0 % |") && !section.contains(['✓', '≈', '✗']), "{section}");
    // Every link leads somewhere.
    for page in ["teleisa2023.md", "beyond.md", "README.md"] {
        let text = fs::read_to_string(out.join(page)).unwrap();
        let links: Vec<&str> = text.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
        assert!(links.len() > 2, "{page}");
        for link in links {
            assert!(out.join(link).exists(), "{page}: {link}");
        }
    }
    let text = fs::read_to_string(out.join("data/teleisa2023-runs.json")).unwrap();
    let record = Record::parse(&text).unwrap();
    assert!(record.provenance.bundled && record.provenance.passes == Some(3));
    // The same from the records alone.
    let before = fs::read_to_string(out.join("teleisa2023.md")).unwrap();
    fs::remove_file(out.join("teleisa2023.md")).unwrap();
    reproduce(folder.path(), &["--render", "--out", &out.display().to_string()]).unwrap();
    assert_eq!(fs::read_to_string(out.join("teleisa2023.md")).unwrap(), before);
    // Nothing is left of a run that came to its end.
    assert_eq!(fs::read_dir(folder.path().join("benchdata/cache/.reproduce")).unwrap().count(), 0);
    insta::assert_snapshot!(record.counts().json());
}

#[test]
fn counts_are_held_against_those_of_the_last_run() {
    let folder = project_without_sets();
    let run = |flag| reproduce(folder.path(), &["--only", "hpa-games", flag]);
    assert!(run("--check").is_err(), "there is nothing to compare with");
    run("--bless").unwrap();
    run("--check").unwrap();
    let counts = folder.path().join("docs/results/quick.json");
    let text = fs::read_to_string(&counts).unwrap();
    let number = text.split("\"nodes\":").nth(1).and_then(|rest| rest.split(',').next()).unwrap();
    fs::write(&counts, text.replacen(number, "1.5", 1)).unwrap();
    let wrong = run("--check").unwrap_err().to_string();
    assert!(wrong.contains("1 numbers are not those of") && wrong.contains("row 0, nodes"), "{wrong}");
    let unknown = reproduce(folder.path(), &["--only", "rivera2018"]).unwrap_err().to_string();
    assert!(unknown.contains("rivera2018") && unknown.contains("rivera2017-tables"), "{unknown}");
    assert!(reproduce(folder.path(), &["--without", "rivera2018"]).is_err());
    let names = |only: &[&str], without: &[&str]| -> Vec<&str> {
        let [only, without] =
            [only, without].map(|names| names.iter().map(ToString::to_string).collect::<Vec<_>>());
        chosen(&only, &without).unwrap().into_iter().map(|experiment| experiment.id).collect()
    };
    assert_eq!(names(&["hpa-games", "engines"], &["engines"]), ["hpa-games"]);
    let most = names(&[], &["hpa-games", "kramm2018"]);
    assert!(!most.is_empty() && most.iter().all(|id| *id != "hpa-games" && !id.starts_with("kramm2018")));
    assert!(reproduce(folder.path(), &["--sets", "dao2"]).is_err());
    let nothing = folder.path().join("nothing");
    let wrong = reproduce(folder.path(), &["--render", "--out", &nothing.display().to_string()]);
    assert!(wrong.is_err_and(|wrong| wrong.to_string().contains("measure first")) && !nothing.exists());
}

#[test]
fn an_interrupted_run_goes_on_where_it_was() {
    let folder = project_without_sets();
    let setting = |seed| {
        let request = Request { quick: false, timed: true, seed, sets: Vec::new() };
        Setting::new(folder.path(), request, 0).unwrap()
    };
    let done = AtomicUsize::new(0);
    let run = |setting: &Setting, until: usize| {
        let context = Context::new(setting, "step", &["nowhere"]);
        let maps = context.maps("bundled", usize::MAX).unwrap();
        let work = |map: &maps::Map| match done.fetch_add(1, Ordering::Relaxed) {
            done if done >= until => Err(Error::Reproduce("interrupted".to_owned())),
            _ => Ok(map.name.clone()),
        };
        context.each("step", How::Timed, &maps, work)
    };
    let first = setting(1);
    assert!(run(&first, 2).is_err());
    assert_eq!(done.swap(0, Ordering::Relaxed), 3, "two maps, and the one at which it failed");
    assert_eq!(run(&first, 9).unwrap(), ["archipelago", "cave", "maze", "town"]);
    assert_eq!(done.swap(0, Ordering::Relaxed), 2, "the other two");
    run(&setting(2), 9).unwrap();
    assert_eq!(done.swap(0, Ordering::Relaxed), 4, "another request is another run");
    first.forget().unwrap();
    run(&first, 9).unwrap();
    assert_eq!(done.load(Ordering::Relaxed), 4);
}

/// The committed pages are drawn from the committed records, which are complete: of each experiment, on all
/// its sets, timed.
#[test]
fn committed_pages_are_drawn_from_the_committed_records() {
    let out = root().join("docs/results");
    let records = records(&out).unwrap();
    for (experiment, (of, record)) in EXPERIMENTS.iter().zip(&records) {
        assert_eq!(experiment.id, of.id, "no record of {}", experiment.id);
        let provenance = &record.provenance;
        assert!(!provenance.quick && !provenance.bundled, "{} is not whole", experiment.id);
        assert_eq!(provenance.sets.is_empty(), experiment.sets.is_empty());
        assert!(experiment.sets.is_empty() || provenance.sets == experiment.sets, "{}", experiment.id);
        let revision = &provenance.revision;
        assert!(revision.len() == 40 && !revision.ends_with("-dirty"), "{}: {revision}", experiment.id);
    }
    assert_eq!(records.len(), EXPERIMENTS.len());
    let drawn = pages::draw(&records).unwrap();
    for (path, text) in &drawn {
        let committed = fs::read_to_string(out.join(path)).unwrap_or_default();
        assert!(committed == *text, "{}: cargo xtask reproduce-tables --render", path.display());
    }
    let figures = fs::read_dir(out.join(FIGURES)).unwrap();
    let figures: BTreeSet<_> =
        figures.map(|entry| Path::new(FIGURES).join(entry.unwrap().file_name())).collect();
    assert!(figures.iter().all(|figure| drawn.contains_key(figure)), "figures of no page");
}
