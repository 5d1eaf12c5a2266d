//! Outcomes as the project keeps them, so that a run on another machine goes on where the last one was.
//!
//! `docs/proof/mutants.tsv` has a line for each file: its path, a digest of its code and of its mutants, and
//! a letter for each mutant, in the order of the list. A line counts while its digest is the same. Which test
//! killed a mutant is not kept.

use std::{
    collections::{BTreeMap, HashMap},
    fmt::Write,
    fs, io,
    path::Path,
};

use sha2::{Digest, Sha256};

use super::{hex, list::Mutant, trial::Outcome};

/// The file, from the root.
pub(super) const FILE: &str = "docs/proof/mutants.tsv";

/// The letter of a mutant that was not tried.
const OPEN: char = '.';

/// The outcomes in the file, by the mutants' keys; none if there is no file.
pub(super) fn read(
    path: &Path,
    mutants: &[Mutant],
    sources: &HashMap<&str, String>,
) -> HashMap<String, Outcome> {
    let text = fs::read_to_string(path).unwrap_or_default();
    let lines = text.lines().filter_map(|line| {
        let mut words = line.split('\t');
        Some((words.next()?, (words.next()?, words.next()?)))
    });
    let kept: HashMap<&str, (&str, &str)> = lines.collect();
    let mut outcomes = HashMap::new();
    for (file, own) in by_file(mutants) {
        let Some(&(digest, letters)) = kept.get(file) else { continue };
        if digest == self::digest(&own, sources) {
            let pairs = own.iter().zip(letters.chars());
            outcomes.extend(pairs.filter_map(|(mutant, letter)| Some((mutant.key(), outcome(letter)?))));
        }
    }
    outcomes
}

/// Writes the file.
///
/// # Errors
/// Errors of the file system.
pub(super) fn write(
    path: &Path,
    mutants: &[Mutant],
    sources: &HashMap<&str, String>,
    outcomes: &HashMap<String, Outcome>,
) -> io::Result<()> {
    let mut text = String::new();
    for (file, own) in by_file(mutants) {
        let letters: String = own.iter().map(|mutant| letter(outcomes.get(&mutant.key()))).collect();
        let _ = writeln!(text, "{file}\t{}\t{letters}", digest(&own, sources));
    }
    fs::write(path, text)
}

fn by_file(mutants: &[Mutant]) -> BTreeMap<&str, Vec<&Mutant>> {
    let mut files: BTreeMap<&str, Vec<&Mutant>> = BTreeMap::new();
    for mutant in mutants {
        files.entry(&mutant.file).or_default().push(mutant);
    }
    files
}

/// A digest of a file's code and of its mutants' keys: another version of cargo-mutants may list others.
fn digest(own: &[&Mutant], sources: &HashMap<&str, String>) -> String {
    let code = own.first().and_then(|mutant| sources.get(&*mutant.file)).map_or("", String::as_str);
    hex(own.iter().fold(Sha256::new().chain_update(code), |digest, mutant| digest.chain_update(mutant.key())))
}

fn letter(outcome: Option<&Outcome>) -> char {
    match outcome {
        None => OPEN,
        Some(Outcome::Unviable) => 'n',
        Some(Outcome::Unreached) => 'r',
        Some(Outcome::Killed(_)) => 'k',
        Some(Outcome::Late(_)) => 'l',
        Some(Outcome::Survived(_, true)) => 's',
        Some(Outcome::Survived(_, false)) => 'u',
    }
}

fn outcome(letter: char) -> Option<Outcome> {
    Some(match letter {
        'n' => Outcome::Unviable,
        'r' => Outcome::Unreached,
        'k' => Outcome::Killed(String::new()),
        'l' => Outcome::Late(String::new()),
        's' => Outcome::Survived(0.0, true),
        'u' => Outcome::Survived(0.0, false),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::{super::list::Genre, *};

    fn mutant(id: u32, file: &str) -> Mutant {
        Mutant {
            id,
            file: file.to_owned(),
            line: id as usize,
            column: 1,
            genre: Genre::Binary,
            replacement: String::new(),
            change: "replace + with -".to_owned(),
            group: "bounds",
        }
    }

    #[test]
    fn outcomes_are_kept_while_code_and_mutants_are_the_same() {
        let mutants: Vec<Mutant> = (1..=7).map(|id| mutant(id, "a.rs")).chain([mutant(8, "b.rs")]).collect();
        let mut sources = HashMap::from([("a.rs", "1".to_owned()), ("b.rs", "2".to_owned())]);
        let known = ['n', 'r', 'k', 'l', 's', 'u'].map(|letter| outcome(letter).expect("a letter"));
        let mut outcomes: HashMap<String, Outcome> = mutants.iter().map(Mutant::key).zip(known).collect();
        outcomes.insert(mutants[7].key(), Outcome::Unviable);
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("kept.tsv");
        assert!(read(&path, &mutants, &sources).is_empty());
        write(&path, &mutants, &sources, &outcomes).expect("a file");
        assert_eq!(read(&path, &mutants, &sources), outcomes);

        // Another list of one file, and another code of the other.
        let fewer = &mutants[1..];
        assert_eq!(read(&path, fewer, &sources).into_keys().collect::<Vec<_>>(), [mutants[7].key()]);
        sources.insert("b.rs", "3".to_owned());
        outcomes.remove(&mutants[7].key());
        assert_eq!(read(&path, &mutants, &sources), outcomes);
    }
}
