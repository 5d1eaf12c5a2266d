//! Options: which engines take them, and how they are read, written and reported.

use mediant::{ConfiguredEngine, Engine, EngineOption, OptionValue, SetupError, ValueKind};

use super::{NEVER, k, setup};

#[test]
fn every_engine_takes_the_options_that_it_says() {
    let mut pairs = 0;
    for kind in Engine::ALL {
        let plain = ConfiguredEngine::from(kind);
        assert_eq!((plain.kind(), plain.chosen()), (kind, Vec::new()));
        for option in EngineOption::ALL {
            let text = match option.kind {
                ValueKind::Flag => "",
                ValueKind::Number | ValueKind::Levels => "7",
                ValueKind::Heuristic => "zero",
                ValueKind::Variant => "paper",
            };
            let value = option.parse(text).expect("a value of its kind");
            let mut engine = plain;
            let takes = plain.options().iter().any(|taken| taken.name == option.name);
            match engine.set(option, value) {
                Ok(()) => {
                    assert!(takes, "{kind}, {}", option.name);
                    assert_eq!(engine.chosen(), [(option, value)]);
                    assert_eq!(engine.value(option), Some(value), "{kind}, {}", option.name);
                    pairs += 1;
                }
                Err(error) => {
                    assert!(!takes && engine == plain, "{kind}, {}", option.name);
                    assert!(matches!(error, SetupError::Option { engine, .. } if engine == kind), "{error}");
                }
            }
        }
    }
    // The engines that take heuristic, variant, jump limit, intermediate jump points, levels, side and
    // unstraightened; second, step and detour.
    assert_eq!(pairs, 8 + 2 + 2 + 3 + 3 + 2 + 1 + 3);
}

#[test]
fn a_value_of_another_kind_is_refused() {
    let step = EngineOption::ALL.into_iter().find(|option| option.name == "step").expect("an option");
    let mut engine = ConfiguredEngine::from(Engine::Chpa);
    assert!(engine.set(step, OptionValue::Flag).is_err());
    assert_eq!(engine, ConfiguredEngine::from(Engine::Chpa));
}

#[test]
fn wrong_values_are_refused_in_words() {
    let option =
        |name: &str| EngineOption::ALL.into_iter().find(|option| option.name == name).expect("an option");
    for (name, text, expected) in [
        ("step", "0", "expected a whole number from 1 up"),
        ("step", "x", "expected a whole number from 1 up"),
        ("side", "5000000000", "expected a whole number from 1 to 4294967295"),
        ("levels", "none", "expected a whole number from 1 to 4294967295, or all"),
        ("heuristic", "best", "expected one of hk, euclidean, zero, squared, found `best`"),
        ("unstraightened", "yes", "expected no value"),
    ] {
        assert_eq!(option(name).parse(text), Err(expected.to_owned()), "{name}");
    }
}

#[test]
fn reports_say_what_each_option_is() {
    let described = |text: &str| {
        let engine = setup(text).engine;
        let all =
            EngineOption::ALL.into_iter().filter_map(|option| Some(option.describe(engine.value(option)?)));
        all.collect::<Vec<_>>().join(", ")
    };
    assert_eq!(described("astar"), "heuristic hk");
    assert_eq!(described("anya"), "");
    assert_eq!(
        described("jps,limit=16,intermediate"),
        "heuristic hk, jumps up to 16, intermediate jump points kept"
    );
    assert_eq!(described("subgoal"), "a contraction hierarchy");
    assert_eq!(described("hpa,levels=1,unstraightened"), "1 level, side 10, paths not straightened");
    assert_eq!(
        described("chpa,squared"),
        "heuristic squared, variant complete, side 3, second heuristic squared, step 2, detours up to 3"
    );
    assert_eq!(described("chpa,paper"), "heuristic hk, variant paper, side 3, second heuristic hk, step 2");
}

#[test]
fn only_subgoal_graphs_have_a_contraction_hierarchy() {
    assert_eq!(setup("subgoal,levels=contracted").engine.levels(), setup("subgoal").engine.levels());
    let said = "hpa,levels=contracted".parse::<mediant::Setup>().expect_err("clusters have levels");
    assert!(
        said.to_string().ends_with("hpa takes no contraction hierarchy: leave it out, or choose subgoal")
    );
    assert!(mediant::Setup::new(Engine::Hpa, k(3), NEVER).check().is_ok());
}
