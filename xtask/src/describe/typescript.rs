//! The interfaces of TypeScript.

use std::fmt::Write as _;

use super::{Description, Parameter, wrapped};

/// The interfaces of a call, and the unions of an answer's words.
pub(super) fn interfaces(description: &Description) -> String {
    let mut text = String::new();
    for (group, name, about) in [
        ("motion", "Motion", "The motion of an agent."),
        ("wishes", "Wishes", "Wishes beyond the ends of a path."),
        ("options", "Options", "The options of engines; `engines()` says which engine takes which."),
    ] {
        _ = writeln!(text, "/** {about} */\nexport interface {name} {{");
        for parameter in description.of(group) {
            key(&mut text, parameter);
        }
        text.push_str("}\n\n");
    }
    text.push_str(
        "/** All that `Grid.path` takes. */\nexport interface How extends Motion, Wishes, Options {\n",
    );
    for parameter in description.of("engine") {
        key(&mut text, parameter);
    }
    text.push_str("}\n\n");
    for (name, about, words) in [
        ("Status", "The kinds of answers.", &description.statuses),
        ("Limit", "The limits that stop a search.", &description.limits),
        ("Stage", "The stages of a preparation that reports progress.", &description.stages),
        ("Origin", "The ways in which an index came about.", &description.origins),
    ] {
        _ = writeln!(text, "/** {about} */\nexport type {name} = {};\n", union(words));
    }
    text.truncate(text.trim_end().len() + 1);
    text
}

/// The engines and the words of a motion, for the page.
pub(super) fn page(description: &Description) -> String {
    let mut text =
        "/** @type {Record<string, { name: string, how: string }>} */\nexport const ENGINES = {\n".to_owned();
    for engine in &description.engines {
        let key =
            if engine.name.contains('-') { format!("\"{}\"", engine.name) } else { engine.name.clone() };
        // A space ends each part but the last.
        let how = wrapped(&engine.how, 96).join(" \" +\n      \"");
        let begin = if how.contains('\n') { "\n      " } else { " " };
        _ = writeln!(text, "  {key}: {{\n    name: \"{}\",\n    how:{begin}\"{how}\",\n  }},", engine.title);
    }
    let words = |name: &str| {
        let parameter = description.parameters.iter().find(|parameter| parameter.name == name);
        let names = parameter.map_or(&[][..], |parameter| &parameter.names);
        names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ")
    };
    let largest = description.engines.iter().map(|engine| engine.max_k).max().unwrap_or_default();
    _ = writeln!(text, "}};\n\n/** The largest k that an engine takes. Beyond it there is only \"any\". */");
    _ = writeln!(
        text,
        "export const LARGEST_K = {largest};\n\n/** The words that each field of a lane may be. */"
    );
    text.push_str("export const CHOICES = Object.freeze({\n");
    for name in ["placement", "corners", "gap"] {
        _ = writeln!(text, "  {name}: [{}],", words(name));
    }
    _ = writeln!(text, "  smooth: [\"\", {}],\n}});", words("smooth"));
    text
}

/// A key with its comment.
fn key(text: &mut String, parameter: &Parameter) {
    let unit = if parameter.unit.as_deref() == Some("time") { ", in milliseconds" } else { "" };
    let default = match &parameter.default {
        Some(default) => format!(" {default} by default."),
        None => String::new(),
    };
    let about = format!("{}{unit}.{default}", parameter.help);
    if about.chars().count() <= 100 {
        _ = writeln!(text, "  /** {about} */");
    } else {
        let lines = wrapped(&about, 104).join("\n   * ");
        _ = writeln!(text, "  /**\n   * {lines}\n   */");
    }
    _ = writeln!(text, "  readonly {}?: {};", parameter.camel(), of(parameter));
}

fn of(parameter: &Parameter) -> String {
    match &*parameter.kind {
        "flag" => "boolean".to_owned(),
        "integer or name" => format!("number | {}", union(&parameter.names)),
        "integer or text" => "number | string".to_owned(),
        // People write names of engines in several ways.
        "name" if parameter.names.len() > 8 => "string".to_owned(),
        "name" => union(&parameter.names),
        _ => "number".to_owned(),
    }
}

fn union(words: &[String]) -> String {
    words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(" | ")
}
