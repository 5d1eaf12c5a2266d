//! The book: its pages and figures in the repository, and what mdBook makes of them.

use std::{
    collections::BTreeSet,
    fs,
    path::{Component, Path, PathBuf},
    process::Command,
};

use crate::{GuideError, figures};

/// The pages, from the root.
pub const PAGES: &str = "docs/guide/src";
/// The book as it is built, from the root.
pub const BOOK: &str = "target/guide/book";

/// Writes the figures. With `is_check` it compares them only.
///
/// # Errors
/// [`GuideError::Old`] for figures that differ from the files, [`GuideError::Io`] for files.
pub fn draw(root: &Path, is_check: bool) -> Result<(), GuideError> {
    let folder = root.join(PAGES).join("figures");
    fs::create_dir_all(&folder).map_err(GuideError::at(&folder))?;
    let mut old = Vec::new();
    for (name, svg) in figures::all()? {
        let file = folder.join(name);
        if fs::read_to_string(&file).is_ok_and(|text| text == svg) {
            continue;
        }
        if is_check {
            old.push(name);
        } else {
            fs::write(&file, svg).map_err(GuideError::at(&file))?;
        }
    }
    if old.is_empty() { Ok(()) } else { Err(GuideError::Old(old.join(", "))) }
}

/// Copies the pages and figures into the folder `to`. Links that leave the book lead to the files of the
/// repository at this address there.
///
/// # Errors
/// [`GuideError::Links`] for links to no file, and for pages that the table of contents leaves out;
/// [`GuideError::Io`] for files.
pub fn copy(root: &Path, to: &Path, files_at: &str) -> Result<(), GuideError> {
    let pages = root.join(PAGES);
    let contents = pages.join("SUMMARY.md");
    let listed = listed(&contents)?;
    let mut wrong = Vec::new();
    for file in files(&pages)? {
        let name = file.strip_prefix(&pages).unwrap_or(&file);
        let to = to.join(name);
        let folder = to.parent().unwrap_or(&to);
        fs::create_dir_all(folder).map_err(GuideError::at(folder))?;
        if name.extension().is_none_or(|ending| ending != "md") {
            fs::copy(&file, &to).map_err(GuideError::at(&file))?;
            continue;
        }
        if file != contents && !listed.contains(name) {
            wrong.push(format!("{}: not in SUMMARY.md", name.display()));
        }
        let text = fs::read_to_string(&file).map_err(GuideError::at(&file))?;
        let text = with_addresses(&text, |link| {
            let target = normal(&file.parent().unwrap_or(&pages).join(link));
            if !target.exists() {
                wrong.push(format!("{}: no {link}", name.display()));
            }
            let in_repository = target.strip_prefix(root).unwrap_or(&target);
            (!target.starts_with(&pages)).then(|| format!("{files_at}/{}", in_repository.display()))
        });
        fs::write(&to, text).map_err(GuideError::at(&to))?;
    }
    if wrong.is_empty() { Ok(()) } else { Err(GuideError::Links(wrong.join("\n"))) }
}

/// Builds the book into [`BOOK`], from a [`copy`].
///
/// # Errors
/// As for [`copy`]; [`GuideError::NoMdbook`] where mdBook is not installed, [`GuideError::Mdbook`] if it
/// fails.
pub fn build(root: &Path, files_at: &str) -> Result<PathBuf, GuideError> {
    let folder = root.join("target/guide");
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(GuideError::at(&folder))?;
    }
    copy(root, &folder.join("src"), files_at)?;
    for name in ["book.toml", "guide.css"] {
        let from = root.join("docs/guide").join(name);
        fs::copy(&from, folder.join(name)).map_err(GuideError::at(&from))?;
    }
    match Command::new("mdbook").arg("build").arg(&folder).arg("--dest-dir").arg(root.join(BOOK)).status() {
        Err(_) => Err(GuideError::NoMdbook),
        Ok(status) if status.success() => Ok(root.join(BOOK)),
        Ok(_) => Err(GuideError::Mdbook),
    }
}

/// The files of a folder and of those in it.
fn files(folder: &Path) -> Result<Vec<PathBuf>, GuideError> {
    let mut all = Vec::new();
    for entry in fs::read_dir(folder).map_err(GuideError::at(folder))? {
        let path = entry.map_err(GuideError::at(folder))?.path();
        if path.is_dir() {
            all.extend(files(&path)?);
        } else {
            all.push(path);
        }
    }
    all.sort();
    Ok(all)
}

/// The pages of the table of contents.
fn listed(contents: &Path) -> Result<BTreeSet<PathBuf>, GuideError> {
    let text = fs::read_to_string(contents).map_err(GuideError::at(contents))?;
    let mut pages = BTreeSet::new();
    with_addresses(&text, |link| {
        pages.insert(normal(Path::new(link)));
        None
    });
    Ok(pages)
}

/// A text whose links to files are handed to `address`, without what follows `#`; a link for which it has
/// another address gets that. Links to pages elsewhere, and to a place on the page itself, stay.
fn with_addresses(text: &str, mut address: impl FnMut(&str) -> Option<String>) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find("](") {
        let (before, after) = rest.split_at(at + 2);
        out.push_str(before);
        let end = after.find(')').unwrap_or(after.len());
        let (link, further) = after.split_at(end);
        let (file, place) = link.split_at(link.find('#').unwrap_or(link.len()));
        let is_elsewhere = file.is_empty() || file.contains("://") || file.contains(char::is_whitespace);
        match (!is_elsewhere).then(|| address(file)).flatten() {
            Some(other) => out.extend([other.as_str(), place]),
            None => out.push_str(link),
        }
        rest = further;
    }
    out + rest
}

/// The path without `..` and `.`.
fn normal(path: &Path) -> PathBuf {
    path.components().fold(PathBuf::new(), |mut normal, component| {
        match component {
            Component::ParentDir => drop(normal.pop()),
            Component::CurDir => {}
            other => normal.push(other),
        }
        normal
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_that_leave_the_book_become_addresses() {
        let text = "[a](../x.md#b), ![p](f.svg), [c](https://d.org/e.md), [here](#g), [end](h";
        let mut seen = Vec::new();
        let out = with_addresses(text, |link| {
            seen.push(link.to_owned());
            link.starts_with("..").then(|| "https://r/x.md".to_owned())
        });
        assert_eq!(out, text.replace("../x.md", "https://r/x.md"));
        assert_eq!(seen, ["../x.md", "f.svg", "h"]);
        assert_eq!(normal(Path::new("/a/b/../c/./d.md")), Path::new("/a/c/d.md"));
    }

    #[test]
    fn every_page_with_examples_is_tested() -> Result<(), GuideError> {
        let pages = mediant_sets::root().join(PAGES);
        let tested = include_str!("pages.rs");
        for file in files(&pages)?.iter().filter(|file| file.extension().is_some_and(|end| end == "md")) {
            let text = fs::read_to_string(file).map_err(GuideError::at(file))?;
            let name = format!("\"{}\"", file.strip_prefix(&pages).unwrap_or(file).display());
            assert_eq!(text.contains("```rust"), tested.contains(&name), "{name}");
        }
        Ok(())
    }

    #[test]
    fn every_page_is_listed_and_every_link_leads_somewhere() -> Result<(), GuideError> {
        let folder = tempfile::tempdir().map_err(GuideError::at("a folder"))?;
        let root = mediant_sets::root();
        copy(&root, folder.path(), "https://r")?;
        let page = folder.path().join("introduction.md");
        let text = fs::read_to_string(&page).map_err(GuideError::at(&page))?;
        assert!(text.contains("](https://r/docs/proof.md)") && text.contains("](idea.md)"), "{text}");
        Ok(())
    }

    /// The figures in the repository are those of today's engines.
    #[test]
    fn the_figures_are_drawn_by_these_engines() {
        let drawn = draw(&mediant_sets::root(), true);
        assert!(drawn.is_ok(), "{}", drawn.unwrap_err());
    }
}
