//! The keywords of Python: types of the stub, and the signatures that Python shows.

use std::{fmt::Write as _, path::PathBuf};

use super::{Description, Parameter};
use crate::tree::Tree;

/// The names of types that stand for a list of words, by the parameter that has it first.
fn alias(parameter: &Parameter) -> String {
    format!("{}{}", parameter.name[..1].to_uppercase(), &parameter.name[1..])
}

/// The types and keywords of the stub.
pub(super) fn keywords(description: &Description) -> String {
    let mut text = String::new();
    let mut known: Vec<&Parameter> = Vec::new();
    for parameter in description.parameters.iter().filter(|parameter| parameter.kind == "name") {
        if known.iter().all(|other| other.names != parameter.names) {
            let names: Vec<String> = parameter.names.iter().filter(|name| *name != "auto").cloned().collect();
            literal(&mut text, &alias(parameter), &names);
            known.push(parameter);
        }
    }
    let statuses = [description.statuses.clone(), vec!["invalid".to_owned()]].concat();
    for (name, words) in [
        ("Status", &statuses),
        ("Limit", &description.limits),
        ("Stage", &description.stages),
        ("Origin", &description.origins),
    ] {
        literal(&mut text, name, words);
    }
    for (group, name, about) in [
        ("motion", "Motion", "The motion of an agent."),
        ("wishes", "Wishes", "Wishes beyond the ends of a path."),
        ("options", "Options", "The options of engines. Each engine takes some of them."),
    ] {
        _ = writeln!(text, "\nclass {name}(TypedDict, total=False):\n    \"\"\"{about}\"\"\"\n");
        for parameter in description.of(group) {
            _ = writeln!(text, "    {}: {} | None", parameter.snake(), of(parameter, &known));
        }
    }
    text.push_str(
        "\nclass FromGrid(Motion, Wishes, Options, total=False):\n    \"\"\"All of them, with the engine.\"\"\"\n\n",
    );
    for parameter in description.of("engine") {
        _ = writeln!(text, "    {}: {} | Literal[\"auto\"] | None", parameter.snake(), alias(parameter));
    }
    // The formatter wants it after a class.
    text.push('\n');
    text
}

fn literal(text: &mut String, name: &str, words: &[String]) {
    let words: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
    let line = format!("{name}: TypeAlias = Literal[{}]", words.join(", "));
    if line.len() <= 110 {
        _ = writeln!(text, "{line}");
    } else {
        _ = writeln!(text, "{name}: TypeAlias = Literal[\n    {},\n]", words.join(",\n    "));
    }
}

fn of(parameter: &Parameter, known: &[&Parameter]) -> String {
    match &*parameter.kind {
        "flag" => "bool".to_owned(),
        "integer" => "SupportsIndex".to_owned(),
        "integer or text" => "SupportsIndex | str".to_owned(),
        "integer or name" => {
            let names: Vec<String> = parameter.names.iter().map(|name| format!("\"{name}\"")).collect();
            format!("SupportsIndex | Literal[{}]", names.join(", "))
        }
        "name" => known
            .iter()
            .find(|other| other.names == parameter.names)
            .map_or(String::new(), |other| alias(other)),
        _ => "SupportsFloat".to_owned(),
    }
}

/// The groups that a function's `**name` stands for.
const GROUPS: [(&str, &[&str]); 5] = [
    ("preparation", &["motion", "options"]),
    ("how", &["motion", "wishes", "engine", "options"]),
    ("motion", &["motion"]),
    ("wishes", &["wishes"]),
    ("options", &["options"]),
];

/// The sources of the compiled module in which a signature does not show all keywords, as they should be.
pub(super) fn signatures(description: &Description, tree: &Tree) -> Result<Vec<(PathBuf, String)>, String> {
    let mut changed = Vec::new();
    for (path, text) in tree.texts(&["rs"]).filter(|(path, _)| path.starts_with("crates/python/src")) {
        let mut written = String::new();
        let mut rest = text;
        while let Some(at) = rest.find("#[pyo3(") {
            let end = at + rest[at..].find(")]\n").ok_or_else(|| format!("{}: no end", path.display()))? + 3;
            written.push_str(&rest[..at]);
            written.push_str(&shown(&rest[at..end], description).unwrap_or_else(|| rest[at..end].to_owned()));
            rest = &rest[end..];
        }
        written.push_str(rest);
        if written != text {
            changed.push((path.to_owned(), written));
        }
    }
    Ok(changed)
}

/// An attribute with a signature that shows all keywords; `None` if it has none to show.
fn shown(attribute: &str, description: &Description) -> Option<String> {
    let signature = attribute.split_once("signature = (")?.1;
    let signature = &signature[..signature.find(')')?];
    let groups = GROUPS.iter().find(|(name, _)| signature.ends_with(&format!("**{name}")))?.1;
    let own: Vec<&str> = signature.split(", ").filter(|part| !part.starts_with("**")).collect();
    let name = |part: &str| part.split(" = ").next().unwrap_or_default().to_owned();
    let is_own = |parameter: &Parameter| own.iter().any(|part| name(part) == parameter.snake());
    let defaults = attribute.split_once("text_signature = ").map(|(_, text)| text.replace("\\\n", ""));
    let mut shown: Vec<String> = if attribute.contains("$self") || !attribute.contains("(k,") {
        vec!["$self".to_owned()]
    } else {
        Vec::new()
    };
    shown.extend(own.iter().map(|part| {
        let name = name(part);
        // The default that was shown before: `points='waypoints'`, where the signature has None.
        let known = defaults.as_deref().and_then(|text| {
            let at = text.find(&format!(" {name}="))? + 1;
            Some(text[at..].split([',', ')', '"']).next()?.trim().to_owned())
        });
        if part.contains(" = ") { known.unwrap_or(format!("{name}=None")) } else { name }
    }));
    if !own.contains(&"*") {
        shown.push("*".to_owned());
    }
    let parameters = groups.iter().flat_map(|group| description.of(group)).filter(|known| !is_own(known));
    shown.extend(parameters.map(|parameter| {
        let default = match (&*parameter.kind, parameter.default.as_deref()) {
            ("flag", _) => "False",
            (_, Some("auto")) => "'auto'",
            _ => "None",
        };
        format!("{}={default}", parameter.snake())
    }));
    let mut lines: Vec<String> = Vec::new();
    for part in super::wrapped(&format!("({})", shown.join(", ")), 96) {
        lines.push(part);
    }
    let text = lines.join(" \\\n            ");
    Some(format!(
        "#[pyo3(\n        signature = ({signature}),\n        text_signature = \"{text}\"\n    )]\n"
    ))
}
