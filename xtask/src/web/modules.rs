//! The modules of the page, announced in its head.
//!
//! A browser sees what a module imports once it has the module. Over a graph of some depth that is one wait for
//! the network after another. So the head lists all modules that `src/main.js` imports, of themselves or by
//! others, and the engines, and all are fetched at once. The sources of the page need no such list to work.

use std::{collections::BTreeSet, path::Path};

use super::parts::File;

const HEAD: &str = "index.html";
const FIRST: &str = "src/main.js";
const ENGINES: &str = "mediant/mediant_bg.wasm";
/// The element that starts the page.
const SCRIPT: &str = "<script type=\"module\" src=\"src/main.js\">";

/// Writes the list before the element that starts the page, if there is one.
pub(super) fn announce(files: &mut [File]) {
    let mut found = BTreeSet::new();
    follow(files, FIRST, &mut found);
    found.remove(FIRST);
    // As `fetch` in a module asks for it; anything else would be fetched a second time.
    let mut links = format!("<link rel=\"preload\" href=\"{ENGINES}\" as=\"fetch\" crossorigin>\n");
    links.extend(found.iter().map(|path| format!("<link rel=\"modulepreload\" href=\"{path}\">\n")));
    for head in files.iter_mut().filter(|file| file.path == HEAD) {
        let text = String::from_utf8_lossy(&head.bytes);
        head.bytes = text.replacen(SCRIPT, &format!("{links}{SCRIPT}"), 1).into_bytes();
    }
}

/// Adds a module and all that it imports.
fn follow(files: &[File], path: &str, found: &mut BTreeSet<String>) {
    let Some(file) = files.iter().find(|file| file.path == path) else { return };
    if !found.insert(path.to_owned()) {
        return;
    }
    let text = String::from_utf8_lossy(&file.bytes);
    for import in text.lines().filter_map(imported) {
        follow(files, &beside(path, import), found);
    }
}

/// The relative path in a line that ends an import or a re-export, or is one without names.
fn imported(line: &str) -> Option<&str> {
    let line = line.trim();
    let is_code = ["import ", "export ", "}"].iter().any(|begin| line.starts_with(begin));
    let (before, rest) = line.strip_suffix("\";")?.rsplit_once('"')?;
    let names = before.trim_end();
    (is_code && (names.ends_with("from") || names == "import") && rest.starts_with('.')).then_some(rest)
}

/// What a relative path means in a module.
fn beside(module: &str, relative: &str) -> String {
    let mut parts: Vec<&str> = Path::new(module)
        .parent()
        .map_or("", |folder| folder.to_str().unwrap_or(""))
        .split('/')
        .filter(|part| !part.is_empty())
        .collect();
    for part in relative.split('/') {
        match part {
            "." => {}
            ".." => {
                parts.pop();
            }
            name => parts.push(name),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::{File, SCRIPT, announce, imported};

    #[test]
    fn lines_that_import() {
        assert_eq!(imported("import { a } from \"./a.js\";"), Some("./a.js"));
        assert_eq!(imported("} from \"../b/c.js\";"), Some("../b/c.js"));
        assert_eq!(imported("export * from \"./d.js\";"), Some("./d.js"));
        assert_eq!(imported("import \"./e.js\";"), Some("./e.js"));
        assert_eq!(imported("import { a } from \"elsewhere\";"), None);
        assert_eq!(imported("const a = \"./a.js\";"), None);
        assert_eq!(imported("// import { a } from \"./a.js\";"), None);
    }

    #[test]
    fn all_that_main_imports_is_announced_once() {
        let file = |path: &str, text: &str| File { path: path.to_owned(), bytes: text.into() };
        let mut files = [
            file("index.html", SCRIPT),
            file("src/main.js", "import { a } from \"./a/a.js\";\nimport { b } from \"./b.js\";"),
            file("src/a/a.js", "import { b } from \"../b.js\";"),
            file("src/b.js", "import { a } from \"./a/a.js\";\nimport m from \"../mediant/mediant.js\";"),
            file("src/c.js", ""),
            file("mediant/mediant.js", ""),
        ];
        announce(&mut files);
        let text = String::from_utf8_lossy(&files[0].bytes).into_owned();
        let links = ["mediant/mediant.js", "src/a/a.js", "src/b.js"]
            .map(|path| format!("<link rel=\"modulepreload\" href=\"{path}\">\n"));
        let (engines, rest) = text.split_once('\n').unwrap();
        assert!(engines.contains("as=\"fetch\" crossorigin"), "{engines}");
        assert_eq!(rest, links.concat() + SCRIPT);
    }
}
