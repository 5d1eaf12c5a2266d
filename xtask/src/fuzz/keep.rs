//! Which inputs are kept in `crates/fuzz/corpus`: a few small ones that together reach most.

use std::{
    cmp::Reverse,
    collections::BinaryHeap,
    fs,
    path::{Path, PathBuf},
};

use mediant_sets::root;

use super::{Fuzzer, files, io};
use crate::Error;

/// The most inputs of a target that are kept.
const INPUTS: usize = 60;
/// The most bytes of one of them, and of all of a target: they are in the history for ever.
const BYTES: (u64, u64) = (1024, 40_000);

/// An input, and what it reaches.
#[derive(Clone, Debug, Default, PartialEq)]
struct Input {
    path: PathBuf,
    bytes: u64,
    /// Whether a person can read it.
    is_text: bool,
    /// Edges, by how often each is passed, as libFuzzer numbers them: those that no smaller input reaches.
    features: Vec<u32>,
}

/// Replaces the kept inputs of a target, once all is there that replaces them.
///
/// # Errors
/// [`Error::Step`] if libFuzzer does not say what each input reaches; [`Error::Io`] for files.
pub(super) fn keep(fuzzer: &Fuzzer, name: &str) -> Result<(), Error> {
    let kept = root().join("crates/fuzz/corpus").join(name);
    let inputs = reached(fuzzer, name, &kept)?;
    let chosen = chosen(&inputs, (INPUTS, BYTES.1));
    let (new, old) = (kept.with_extension("new"), kept.with_extension("old"));
    for folder in [&new, &old] {
        remove(folder)?;
    }
    fs::create_dir_all(&new).map_err(io(&new))?;
    for input in &chosen {
        let to = new.join(input.path.file_name().unwrap_or_default());
        fs::copy(&input.path, &to).map_err(io(&to))?;
    }
    if kept.is_dir() {
        fs::rename(&kept, &old).map_err(io(&old))?;
    }
    fs::rename(&new, &kept).map_err(io(&kept))?;
    let bytes: u64 = chosen.iter().map(|input| input.bytes).sum();
    println!("{name}: {} of {} inputs are kept, {bytes} bytes", chosen.len(), inputs.len());
    remove(&old)
}

fn remove(folder: &Path) -> Result<(), Error> {
    if folder.is_dir() { fs::remove_dir_all(folder).map_err(io(folder)) } else { Ok(()) }
}

/// The small inputs that were found or kept. libFuzzer's merge runs them from the smallest to the largest,
/// and tells of each what no smaller one reaches. (Its cover of sets takes minutes for thousands.)
fn reached(fuzzer: &Fuzzer, name: &str, kept: &Path) -> Result<Vec<Input>, Error> {
    let merged = fuzzer.folder.join("merged").join(name);
    let (small, reach) = (merged.join("small"), merged.join("reach"));
    remove(&merged)?;
    for folder in [&small, &merged.join("all")] {
        fs::create_dir_all(folder).map_err(io(folder))?;
    }
    let known = if kept.is_dir() { files(kept)? } else { Vec::new() };
    for file in files(&fuzzer.corpus(name))?.into_iter().chain(known) {
        let to = small.join(file.file_name().unwrap_or_default());
        if fs::metadata(&file).map_err(io(&file))?.len() <= BYTES.0 {
            fs::copy(&file, &to).map_err(io(&to))?;
        }
    }
    let mut command = fuzzer.command(name);
    command.arg("-merge=1").arg(format!("-merge_control_file={}", reach.display()));
    command.args(["-max_len=4096", "-timeout=20"]).arg(merged.join("all")).arg(&small);
    let output = command.output().map_err(io(&fuzzer.program))?;
    if !output.status.success() {
        println!("{}", String::from_utf8_lossy(&output.stderr));
        return Err(Error::Step { command: format!("{name}: a merge by libFuzzer") });
    }
    let text = fs::read_to_string(&reach).map_err(io(&reach))?;
    let mut inputs = parsed(&text);
    for input in &mut inputs {
        let bytes = fs::read(&input.path).map_err(io(&input.path))?;
        input.bytes = bytes.len() as u64;
        input.is_text = std::str::from_utf8(&bytes).is_ok_and(|text| !text.contains(is_binary));
    }
    Ok(inputs)
}

fn is_binary(letter: char) -> bool {
    letter.is_control() && !letter.is_ascii_whitespace()
}

/// libFuzzer's file of a merge: how many inputs, how many of them come first, their paths; then lines
/// `FT 3 17 20 …`, the features of an input. Inputs that were not run to their end are left out.
fn parsed(text: &str) -> Vec<Input> {
    let mut lines = text.lines();
    let count = lines.next().and_then(|line| line.parse().ok()).unwrap_or(0);
    let mut inputs: Vec<Input> = lines
        .by_ref()
        .skip(1)
        .take(count)
        .map(|path| Input { path: path.into(), ..Input::default() })
        .collect();
    for line in lines.filter_map(|line| line.strip_prefix("FT ")) {
        let mut numbers = line.split_whitespace().filter_map(|number| number.parse::<u32>().ok());
        let input = numbers.next().and_then(|at| inputs.get_mut(at as usize));
        if let Some(input) = input {
            input.features = numbers.collect();
        }
    }
    inputs.retain(|input| !input.features.is_empty());
    inputs
}

/// One after another the input that reaches most that none before it does; of several those that are text,
/// then the smallest. So many inputs and bytes at most.
fn chosen(inputs: &[Input], (most, most_bytes): (usize, u64)) -> Vec<&Input> {
    let features = inputs.iter().flat_map(|input| &input.features).max().map_or(0, |&last| last as usize + 1);
    let mut is_reached = vec![false; features];
    let (mut chosen, mut bytes) = (Vec::new(), 0);
    let rated = |new: usize, at: usize| (new, inputs[at].is_text, Reverse((inputs[at].bytes, at)));
    let mut rest: BinaryHeap<_> = (0..inputs.len()).map(|at| rated(inputs[at].features.len(), at)).collect();
    while chosen.len() < most
        && let Some((known, _, Reverse((_, at)))) = rest.pop()
    {
        let input = &inputs[at];
        let new = input.features.iter().filter(|&&at| !is_reached[at as usize]).count();
        if new == 0 || bytes + input.bytes > most_bytes {
            continue;
        }
        // It may have reached more when it was rated; none that is left reaches more than its own rating.
        if new < known {
            rest.push(rated(new, at));
            continue;
        }
        input.features.iter().for_each(|&at| is_reached[at as usize] = true);
        bytes += input.bytes;
        chosen.push(input);
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_small_inputs_that_reach_most_are_chosen() {
        let text = "5\n0\na\nb\nc\nd\ne\nSTARTED 0 4\nFT 0 1 2 3\nCOV 0 7\nSTARTED 1 2\nFT 1 3 4\nCOV 1\n\
                    STARTED 2 9\nFT 2 4 3\nCOV 2\nSTARTED 3 1\nFT 3 1\nCOV 3\nSTARTED 4 1\n";
        let mut inputs = parsed(text);
        let about = |input: &Input| (input.path.display().to_string(), input.features.len());
        let found: Vec<_> = inputs.iter().map(about).collect();
        assert_eq!(found, [("a", 3), ("b", 2), ("c", 2), ("d", 1)].map(|(path, n)| (path.to_owned(), n)));
        for (input, bytes) in inputs.iter_mut().zip([4, 2, 9, 1]) {
            input.bytes = bytes;
        }
        let names = |inputs: &[Input], most| {
            chosen(inputs, most).iter().map(|input| input.path.display().to_string()).collect::<String>()
        };
        assert_eq!(names(&inputs, (9, 99)), "ab", "c and d reach nothing of their own");
        assert_eq!(names(&inputs, (1, 99)), "a");
        assert_eq!(names(&inputs, (9, 3)), "bd", "a is too large");
        inputs[2].is_text = true;
        assert_eq!(names(&inputs, (9, 99)), "ac");
    }
}
