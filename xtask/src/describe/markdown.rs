//! Tables in Markdown.

use std::fmt::Write as _;

use super::{Description, Engine, Parameter};

/// The table of engines.
pub(super) fn engines(description: &Description) -> String {
    let mut text = "| engine | vertices | k | guarantee | paper |\n|---|---|---|---|---|\n".to_owned();
    for engine in &description.engines {
        let Engine { name, title, max_k, promise, papers, .. } = engine;
        let places: Vec<String> = engine.placements.iter().map(|place| format!("{place}s")).collect();
        // An engine that takes both placements may take fewer k at one of them.
        let places = if engine.few_k_at_centers && places.len() > 1 {
            "corners; centers at k = 2, 3".to_owned()
        } else {
            places.join(", ")
        };
        let k = match max_k {
            3 => "2, 3".to_owned(),
            max if engine.any => format!("2 … {max}, any angle"),
            max if engine.any_angle => format!("2 … {max}, segments at any angle"),
            max => format!("2 … {max}"),
        };
        _ = writeln!(text, "| {title} (`{name}`) | {places} | {k} | {promise} | {papers} |");
    }
    text
}

/// The table of parameters: how each language writes them.
pub(super) fn parameters(description: &Description) -> String {
    let mut text =
        "| program | Python | JavaScript | takes | by default | |\n|---|---|---|---|---|---|\n".to_owned();
    for parameter in &description.parameters {
        let Parameter { name, default, help, .. } = parameter;
        let default = default.as_deref().map_or(String::new(), |default| format!("`{default}`"));
        let packages = match parameter.published {
            true => "– | –".to_owned(),
            false => format!("`{}` | `{}`", parameter.snake(), parameter.camel()),
        };
        let takes = takes(parameter);
        // A bar would end the cell.
        let help = help.replace('|', "\\|");
        _ = writeln!(text, "| `--{name}` | {packages} | {takes} | {default} | {help} |");
    }
    text
}

fn takes(parameter: &Parameter) -> String {
    let name = |name: &String| match !parameter.published && parameter.published_names.contains(name) {
        true => format!("`{name}` (the program alone)"),
        false => format!("`{name}`"),
    };
    let names = || parameter.names.iter().map(name).collect::<Vec<_>>().join(", ");
    match (&*parameter.kind, parameter.unit.as_deref()) {
        ("flag", _) => "true or false".to_owned(),
        ("integer or name", _) => format!("an integer, or {}", names()),
        ("integer or text", _) => "bytes, or a text as `8MB`".to_owned(),
        ("name", _) => names(),
        (_, Some("time")) => "milliseconds; in Python seconds".to_owned(),
        (_, Some(unit)) => unit.to_owned(),
        _ => "an integer".to_owned(),
    }
}
