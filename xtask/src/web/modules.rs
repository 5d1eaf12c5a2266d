//! The modules of the page, announced in its head.
//!
//! A browser sees what a module imports once it has the module. Over a graph of some depth that is one wait
//! for the network after another. So the head lists the engines and all modules that it starts, each followed
//! by what it imports, of itself or by others. A browser asks for them in this order, a few at a time: what
//! starts the first worker comes before the many that it can do without. The sources need no such list.

use std::path::Path;

use super::parts::File;

const HEAD: &str = "index.html";
const ENGINES: &str = "mediant/mediant_bg.wasm";
/// How an element begins that starts a module.
const SCRIPT: &str = "<script type=\"module\"";

/// Writes the list before the first element that starts a module, if there is one.
pub(super) fn announce(files: &mut [File]) {
    let Some(head) = files.iter().position(|file| file.path == HEAD) else { return };
    let text = String::from_utf8_lossy(&files[head].bytes).into_owned();
    let Some(at) = text.find(SCRIPT) else { return };
    let mut found = Vec::new();
    for path in text.lines().filter_map(started) {
        follow(files, path, &mut found);
    }
    // As `fetch` in a module asks for it; anything else would be fetched a second time.
    let mut links = format!("<link rel=\"preload\" href=\"{ENGINES}\" as=\"fetch\" crossorigin>\n");
    links.extend(found.iter().map(|path| format!("<link rel=\"modulepreload\" href=\"{path}\">\n")));
    files[head].bytes = [&text[..at], &links, &text[at..]].concat().into_bytes();
}

/// The module that a line of the head starts.
fn started(line: &str) -> Option<&str> {
    line.trim().strip_prefix(SCRIPT)?.split_once("src=\"")?.1.split_once('"').map(|(path, _)| path)
}

/// Adds a module and all that it imports.
fn follow(files: &[File], path: &str, found: &mut Vec<String>) {
    let Some(file) = files.iter().find(|file| file.path == path) else { return };
    if found.iter().any(|known| known == path) {
        return;
    }
    found.push(path.to_owned());
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

/// The path that a relative path in a module leads to.
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
    use super::{File, announce, imported};

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
    fn all_that_is_started_or_imported_is_announced_once_in_order() {
        let file = |path: &str, text: &str| File { path: path.to_owned(), bytes: text.into() };
        let head = "<script type=\"module\" async src=\"src/warm.js\"></script>\n\
            <script type=\"module\" src=\"src/main.js\"></script>\n";
        let mut files = [
            file("index.html", &format!("<meta>\n{head}")),
            file("src/main.js", "import { a } from \"./a/a.js\";\nimport { b } from \"./b.js\";"),
            file("src/a/a.js", "import { b } from \"../b.js\";"),
            file("src/b.js", "import { a } from \"./a/a.js\";\nimport m from \"../mediant/mediant.js\";"),
            file("src/c.js", ""),
            file("src/warm.js", "import { d } from \"./d.js\";"),
            file("src/d.js", ""),
            file("mediant/mediant.js", ""),
        ];
        announce(&mut files);
        let text = String::from_utf8_lossy(&files[0].bytes).into_owned();
        let modules =
            ["src/warm.js", "src/d.js", "src/main.js", "src/a/a.js", "src/b.js", "mediant/mediant.js"];
        let links = modules.map(|path| format!("<link rel=\"modulepreload\" href=\"{path}\">\n"));
        let (engines, rest) = text.strip_prefix("<meta>\n").unwrap().split_once('\n').unwrap();
        assert!(engines.contains("as=\"fetch\" crossorigin"), "{engines}");
        assert_eq!(rest, links.concat() + head);
    }
}
