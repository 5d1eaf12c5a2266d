//! The library's description of itself: `docs/description.json`. The tables, stubs and interfaces of all
//! languages are written from it (`cargo xtask describe`), and `tidy` compares them with it.

use mediant::{
    Engine, ErrorCode, Limit, Origin, Status,
    call::{Kind, PARAMETERS, Parameter, Unit},
    options::{ConfiguredEngine, HeuristicName},
    search::Stage,
};
use serde_json::{Value, json};

const FILE: &str = "../../docs/description.json";

fn description() -> Value {
    let parameters = PARAMETERS.iter().map(|parameter| {
        json!({
            "name": parameter.name,
            "group": format!("{:?}", parameter.group).to_lowercase(),
            "kind": match parameter.kind {
                Kind::Flag => "flag",
                Kind::Count | Kind::Number => "integer",
                Kind::Length => "number",
                Kind::NumberOrName => "integer or name",
                Kind::NumberOrText => "integer or text",
                Kind::Name => "name",
                _ => panic!("a new kind"),
            },
            "unit": parameter.unit.map(|unit| match unit {
                Unit::Cells => "cells",
                Unit::Time => "time",
                _ => panic!("a new unit"),
            }),
            "default": parameter.default,
            "names": parameter.values(),
            // Only with the feature `publications`, which these tests have.
            "published": parameter.option().is_some_and(|option| option.is_published),
            "published_names": published_names(parameter),
            "help": parameter.help,
        })
    });
    let engines = Engine::ALL.into_iter().map(|engine| {
        let can = engine.capabilities();
        let options = ConfiguredEngine::from(engine).options().into_iter().map(|option| option.name);
        json!({
            "name": engine.name(),
            "placements": can.placements.iter().map(|placement| placement.name()).collect::<Vec<_>>(),
            "max_k": can.max_k,
            "any": can.any,
            "any_angle": can.any_angle,
            "few_k_at_centers": can.few_k_at_centers,
            "title": can.title,
            "how": can.how,
            "guarantee": can.guarantee.name(),
            "promise": can.promise,
            "paper": can.paper,
            "papers": can.papers,
            "index": can.index.is_some(),
            "options": options.collect::<Vec<_>>(),
        })
    });
    json!({
        "parameters": parameters.collect::<Vec<_>>(),
        "engines": engines.collect::<Vec<_>>(),
        "statuses": Status::ALL.map(Status::name),
        "limits": Limit::ALL.map(Limit::name),
        "stages": Stage::ALL.map(Stage::name),
        "origins": Origin::ALL.map(Origin::name),
        "codes": ErrorCode::ALL.map(ErrorCode::name).to_vec(),
    })
}

/// The names of a parameter that only the feature `publications` knows.
fn published_names(parameter: &Parameter) -> Vec<&'static str> {
    let is_published = |name: &HeuristicName| name.overestimates();
    let names = HeuristicName::ALL.into_iter().filter(is_published).map(HeuristicName::name);
    names.filter(|name| parameter.values().contains(name)).collect()
}

#[test]
fn the_file_says_what_the_library_says() {
    let found = serde_json::to_string_pretty(&description()).expect("JSON") + "\n";
    if std::env::var_os("MEDIANT_WRITE").is_some() {
        std::fs::write(FILE, &found).expect("the description");
    }
    let known = std::fs::read_to_string(FILE).expect("the description");
    assert_eq!(known, found, "MEDIANT_WRITE=1 writes it; then `cargo xtask describe`");
}
