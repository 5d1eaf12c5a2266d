//! The pages, drawn from the records alone.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use mediant_report::{Claim, ColumnKind, Provenance, Record, Table, Verdict, thousands, verdicts};

use crate::{
    Error,
    catalog::EXPERIMENTS,
    experiment::{Experiment, FIGURES, Page, Section},
    explained::explained,
    records::{DATA, records, write},
    wrap::wrapped,
};

/// The legend of the marks in tables.
const MARKS: &str = "✓ as published: to the printed digits if the instances are the same, else within 3 % or \
                     the stated tolerance. ≈ within two standard errors of the difference, as another draw \
                     of the instances could be. ✗ differs: [deviations](deviations.md) says why. – not \
                     measured.";

/// Draws the pages of a folder from the records in it, and writes those that changed.
///
/// # Errors
/// [`Error::Reproduce`] for a damaged record, and for a deviation whose cause is not said; errors of files.
pub(super) fn write_all(out: &Path) -> Result<(), Error> {
    let records = records(out)?;
    if records.is_empty() {
        let folder = out.join(DATA);
        return Err(Error::Reproduce(format!("{}: no records to draw: measure first", folder.display())));
    }
    let drawn = draw(&records)?;
    let figures = out.join(FIGURES);
    // Figures of experiments that were removed or renamed.
    if figures.is_dir() {
        for entry in fs::read_dir(&figures).map_err(Error::at(&figures))? {
            let path = entry.map_err(Error::at(&figures))?.path();
            let name = path.file_name().unwrap_or_default();
            if !drawn.contains_key(&Path::new(FIGURES).join(name)) {
                fs::remove_file(&path).map_err(Error::at(&path))?;
            }
        }
    }
    drawn.iter().try_for_each(|(path, text)| write(&out.join(path), text))
}

/// All files, by their paths within the folder.
pub(super) fn draw(records: &[(&'static Experiment, Record)]) -> Result<BTreeMap<PathBuf, String>, Error> {
    let mut files = BTreeMap::new();
    let mut shown: Vec<(&Experiment, &Record, Section)> = Vec::new();
    for (experiment, record) in records {
        let mut section = (experiment.show)(record);
        for (name, svg) in section.figures.drain(..) {
            files.insert(Path::new(FIGURES).join(name), svg);
        }
        if record.provenance.bundled {
            // The published values are of other maps.
            section.claims.clear();
            for verdict in [Verdict::Matched, Verdict::WithinSampling, Verdict::Deviates] {
                section.markdown = section.markdown.replace(verdict.mark(), "");
            }
        }
        let known = |id: &str| records.iter().map(|(_, record)| record).find(|record| record.id == id);
        for claim in &mut section.claims {
            claim.cause = explained(&claim.cause, known);
        }
        let unexplained = |claim: &&Claim| claim.verdict() == Verdict::Deviates && claim.cause.is_empty();
        // A sample or other maps may deviate for no reason that could be given.
        if let Some(claim) = section.claims.iter().find(unexplained)
            && !is_partial(&record.provenance)
        {
            let (published, ours) = (claim.text(claim.published), claim.text(claim.ours.unwrap_or_default()));
            let place = format!("{}, {}: {}", record.id, claim.source, claim.what);
            return Err(Error::Reproduce(format!("{place} is {ours}, published {published}: why?")));
        }
        shown.push((experiment, record, section));
    }
    for page in Page::ALL {
        let sections = || shown.iter().filter(|(experiment, ..)| experiment.page == page);
        if sections().next().is_none() {
            continue;
        }
        let mut text = format!("# {}\n\n[All results](README.md). {MARKS}\n\n", page.title());
        for (experiment, record, section) in sections() {
            text += &format!("## {}\n\n{}\n\n{}", experiment.title, about(record), section.markdown);
        }
        files.insert(format!("{}.md", page.file()).into(), wrapped(text.trim_end()));
    }
    files.insert("deviations.md".into(), wrapped(&deviations(&shown)));
    files.insert("README.md".into(), wrapped(&index(&shown)));
    Ok(files)
}

const fn is_partial(provenance: &Provenance) -> bool {
    provenance.quick || provenance.bundled
}

/// A paragraph on what a record's figures are over and where they come from.
fn about(record: &Record) -> String {
    let Provenance { revision, machine, sets, maps, instances, drawn, seed, quick, bundled, passes } =
        &record.provenance;
    let mut text = String::new();
    if *bundled {
        text += "> **Not the paper's maps.** The benchmark sets were not there, so this was measured on the \
                 maps that come with the project.\n\n";
    }
    if *quick {
        text += "> A quick run, on an even sample.\n\n";
    }
    text += &format!("{} instances", thousands(*instances as f64));
    if *maps > 0 {
        text += &format!(" on {maps} maps");
    }
    if !sets.is_empty() && !*bundled && *maps > 0 {
        text += &format!(" of {}", sets.join(", "));
    }
    text += &format!(": {drawn}.");
    if let Some(seed) = seed {
        text += &format!(" Seed {seed}.");
    }
    if let Some(passes) = passes {
        let cpu = machine.cpu.as_deref().unwrap_or(&machine.arch);
        text += &format!(
            " Times: one thread, warm, paths included, reading and preprocessing excluded, median of \
             {passes} passes, on {cpu}."
        );
    } else if record.columns.iter().any(|column| column.kind == ColumnKind::Time) {
        text += " No times were taken.";
    }
    let short = revision.get(..12).unwrap_or(revision);
    let dirty = if revision.ends_with("-dirty") && !short.ends_with("-dirty") { "-dirty" } else { "" };
    text + &format!(" Revision {short}{dirty}. [All figures]({DATA}/{}.json).", record.id)
}

/// The page of the deviations and their causes.
fn deviations(shown: &[(&Experiment, &Record, Section)]) -> String {
    let mut text = "# Where our numbers differ from the published ones\n\n[All results](README.md). Each \
                    row belongs to one table column, figure or sentence of a paper; below a table are its \
                    causes. The difference is our number over the published one, less 1. The pages of the \
                    papers have each number.\n\n"
        .to_owned();
    for page in Page::ALL {
        let mut groups: Vec<(&str, &str, Vec<&Claim>)> = Vec::new();
        let sections = shown
            .iter()
            .filter(|(experiment, record, _)| experiment.page == page && !is_partial(&record.provenance));
        for claim in sections.flat_map(|(.., section)| &section.claims) {
            if claim.verdict() != Verdict::Deviates {
                continue;
            }
            let group = groups
                .iter_mut()
                .find(|(source, cause, _)| (*source, *cause) == (&claim.source, &claim.cause));
            match group {
                Some((.., claims)) => claims.push(claim),
                None => groups.push((&claim.source, &claim.cause, vec![claim])),
            }
        }
        if groups.is_empty() {
            continue;
        }
        text += &format!("## [{}]({}.md)\n\n", page.title(), page.file());
        // A cause that several groups have in common is written once.
        let mut causes: Vec<&str> = Vec::new();
        let mut table = Table::new(["causes", "where", "what", "differs by"]).names(3);
        for (source, cause, claims) in groups {
            let numbers: Vec<String> = cause
                .lines()
                .map(|line| {
                    let known = causes.iter().position(|known| *known == line);
                    let at = known.unwrap_or_else(|| {
                        causes.push(line);
                        causes.len() - 1
                    });
                    (at + 1).to_string()
                })
                .collect();
            let numbers = numbers.join(", ");
            for (what, by) in listed(&claims) {
                table.row([numbers.clone(), source.to_owned(), what, by]);
            }
        }
        text += &format!("{}\nCauses:\n\n", table.markdown());
        for (at, cause) in causes.iter().enumerate() {
            text += &format!("{}. {}\n", at + 1, cause.trim());
        }
        text += "\n";
    }
    text.trim_end().to_owned() + "\n"
}

/// Claims with their differences: one by one if there are few, else by their range.
fn listed(claims: &[&Claim]) -> Vec<(String, String)> {
    let by = |claim: &Claim| 100.0 * claim.difference().unwrap_or_default();
    if claims.len() <= 4 {
        let one = |claim: &&Claim| {
            let (published, ours) = (claim.text(claim.published), claim.text(claim.ours.unwrap_or_default()));
            let what = format!("{}: published {published}, here {ours}", claim.what);
            (what, format!("{:+.1} %", by(claim)))
        };
        return claims.iter().map(one).collect();
    }
    let (least, most) = claims
        .iter()
        .fold((f64::MAX, f64::MIN), |(least, most), claim| (least.min(by(claim)), most.max(by(claim))));
    vec![(format!("{} numbers", claims.len()), format!("{least:+.1} to {most:+.1} %"))]
}

/// The columns of the table of all experiments: verdicts of counts, then of times.
const COLUMNS: [&str; 13] =
    ["page", "what", "instances", "✓", "≈", "✗", "–", "times: ✓", "≈", "✗", "–", "revision", "`--only`"];

/// The page `README.md`: a table of all experiments.
fn index(shown: &[(&Experiment, &Record, Section)]) -> String {
    let mut text = "# Results\n\nEvery table and figure of the five papers, measured by `cargo xtask \
                    reproduce-tables`, beside the published values.\n\n"
        .to_owned();
    if shown.iter().any(|(_, record, _)| record.provenance.bundled) {
        text += "> **Not the papers' maps.** Some benchmark sets were not there: `cargo xtask download` \
                 fetches them.\n\n";
    }
    if shown.iter().any(|(_, record, _)| record.provenance.quick) {
        text += "> A quick run, on an even sample.\n\n";
    }
    let mut table = Table::new(COLUMNS).names(2);
    let mut total = [0; 8];
    for (experiment, record, section) in shown {
        let page = experiment.page;
        let of = |is_time| verdicts(section.claims.iter().filter(move |claim| claim.is_time == is_time));
        let counts: Vec<usize> = [of(false), of(true)].concat();
        total.iter_mut().zip(&counts).for_each(|(total, count)| *total += count);
        let mut cells = vec![
            format!("[{0}]({0}.md)", page.file()),
            experiment.title.to_owned(),
            thousands(record.provenance.instances as f64),
        ];
        cells.extend(counts.iter().map(|count| if *count == 0 { String::new() } else { count.to_string() }));
        cells.push(record.provenance.revision.get(..8).unwrap_or("unknown").to_owned());
        cells.push(format!("`{}`", experiment.id));
        table.row(cells);
    }
    let mut cells = vec!["**together**".to_owned(), String::new(), String::new()];
    cells.extend(total.map(|count| count.to_string()));
    table.row(cells);
    text += &table.markdown();
    text += &format!(
        "\n{MARKS}\n\n\
         The first four columns count costs, lengths and numbers of nodes; the others times, which another \
         program on another machine cannot have alike.\n\n\
         The pages are drawn from the records in [`{DATA}/`]({DATA}): JSON, one row on a line, each column \
         with its unit, with revision, machine, number of instances and seed. Lengths and numbers of nodes \
         are the same on every machine; times are not, so only their ratios can be compared.\n\n\
         ```sh\n\
         cargo xtask reproduce-tables                      # everything, {} experiments\n\
         cargo xtask reproduce-tables --quick              # an even sample, into docs/results/quick\n\
         cargo xtask reproduce-tables --only kramm2018     # one page, or one experiment\n\
         cargo xtask reproduce-tables --render             # the pages again, from the records\n\
         cargo xtask reproduce-tables --check              # whether the counts are still the same\n\
         ```\n\n\
         A run that is interrupted goes on where it was. Benchmark sets that are not there are downloaded, \
         or taken from `--mirror`; without them the experiments run on the maps that come with the project, \
         and say so.\n",
        EXPERIMENTS.len()
    );
    if shown.iter().all(|(_, record, _)| !record.provenance.quick) {
        text += "\nTwo studies go beyond the papers: [maps that change](changes.md), by `cargo xtask compare \
                 --changes`, and [cost surfaces](costs.md), by `--costs`.\n";
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn claim(ours: f64, cause: &str) -> Claim {
        Claim::new("Table 1", format!("cost {ours}"), 2.0, Some(ours)).because(cause)
    }

    #[test]
    fn few_claims_are_listed_and_many_are_summed_up() {
        let claims: Vec<Claim> = [2.2, 2.4, 1.0, 3.0, 2.5].map(|ours| claim(ours, "x")).to_vec();
        let few: Vec<&Claim> = claims.iter().take(2).collect();
        let pair = |what: &str, by: &str| (what.to_owned(), by.to_owned());
        assert_eq!(
            listed(&few),
            [
                pair("cost 2.2: published 2.00, here 2.20", "+10.0 %"),
                pair("cost 2.4: published 2.00, here 2.40", "+20.0 %")
            ]
        );
        let many: Vec<&Claim> = claims.iter().collect();
        assert_eq!(listed(&many), [pair("5 numbers", "-50.0 to +50.0 %")]);
    }

    fn record(quick: bool) -> Record {
        let provenance = Provenance { quick, ..Provenance::default() };
        let (id, title) = ("sample".to_owned(), "a sample".to_owned());
        Record { id, title, provenance, columns: Vec::new(), rows: Vec::new() }
    }

    #[test]
    fn causes_in_common_are_said_once() {
        let claims = vec![
            claim(2.2, "ties\ndraw"),
            Claim { source: "Table 2".to_owned(), ..claim(3.0, "draw") },
            claim(2.01, "no deviation"),
        ];
        let section = || Section { claims: claims.clone(), ..Section::default() };
        let whole = record(false);
        let text = deviations(&[(&EXPERIMENTS[0], &whole, section())]);
        assert!(
            text.contains("| 1, 2 | Table 1 | cost 2.2: published 2.00, here 2.20 | +10.0 % |\n"),
            "{text}"
        );
        assert!(text.contains("| 2 | Table 2 | cost 3: published 2.00, here 3.00 | +50.0 % |\n"), "{text}");
        assert!(text.contains("1. ties\n2. draw\n") && !text.contains("no deviation"), "{text}");
        // A sample says nothing about the paper.
        let quick = record(true);
        assert!(!deviations(&[(&EXPERIMENTS[0], &quick, section())]).contains("cost 3"));
    }

    #[test]
    fn a_deviation_without_a_cause_is_no_result() {
        let show = |_: &Record| Section { claims: vec![claim(3.0, "")], ..Section::default() };
        let experiment: &'static Experiment = Box::leak(Box::new(Experiment { show, ..EXPERIMENTS[0] }));
        let wrong = draw(&[(experiment, record(false))]).unwrap_err().to_string();
        assert!(wrong.contains("sample, Table 1: cost 3 is 3.00, published 2.00: why?"), "{wrong}");
        assert!(draw(&[(experiment, record(true))]).is_ok());
    }
}
