//! Links of Markdown files to other files.

use std::path::{Component, Path, PathBuf};

use super::finding::Finding;
use crate::tree::Tree;

pub(super) fn check(tree: &Tree, findings: &mut Vec<Finding>) {
    for (path, text) in tree.texts(&["md"]) {
        let folder = path.parent().unwrap_or(Path::new(""));
        for (line, target) in targets(text) {
            if resolve(folder, target).is_none_or(|target| !tree.holds(&target)) {
                let message = format!("`{target}` is no file of the project: readers follow links");
                findings.push(Finding { file: path.to_owned(), line, message });
            }
        }
    }
}

/// The targets of relative links with their lines, without their fragments (`#…`). Code has no links.
pub(super) fn targets(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut code = false;
    let lines = (1..).zip(text.lines()).filter(move |(_, line)| {
        let fence = line.trim_start().starts_with("```");
        code ^= fence;
        !code && !fence
    });
    lines.flat_map(|(number, line)| in_line(line).into_iter().map(move |target| (number, target)))
}

fn in_line(line: &str) -> Vec<&str> {
    // Every second part between backticks is code. A link's text may hold code, its target does not.
    let inline = line.split('`').step_by(2).flat_map(|part| {
        part.match_indices("](").filter_map(|(at, mark)| part[at + mark.len()..].split(')').next())
    });
    let definition = line.strip_prefix('[').and_then(|rest| rest.split_once("]: ")).map(|(_, target)| target);
    inline.chain(definition).filter_map(relative).collect()
}

/// The path of a target, unless it leads to another site or stays in the file.
fn relative(target: &str) -> Option<&str> {
    let target = target.split_whitespace().next()?.trim_start_matches('<').trim_end_matches('>');
    let path = target.split('#').next().filter(|path| !path.is_empty())?;
    (!path.contains("://") && !path.starts_with("mailto:")).then_some(path)
}

/// The path from the root; none for one that leads out of it.
fn resolve(folder: &Path, target: &str) -> Option<PathBuf> {
    let mut resolved = PathBuf::new();
    for part in folder.join(target).components() {
        match part {
            Component::Normal(name) => resolved.push(name),
            Component::CurDir => {}
            Component::ParentDir => {
                if !resolved.pop() {
                    return None;
                }
            }
            Component::RootDir | Component::Prefix(_) => return None,
        }
    }
    Some(resolved)
}
