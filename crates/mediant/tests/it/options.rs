//! Options: which engines take them, and how they are read, written and reported.

use mediant::{
    Engine, Motion, Setup,
    errors::SetupError,
    options::{ConfiguredEngine, EngineOption, Memory, OptionValue, ValueKind},
};

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
                ValueKind::Memory => "8MB",
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
    // The engines that take heuristic, variant, jump limit, intermediate jump points, levels, memory, side,
    // landmarks and unstraightened; second, step and detour.
    assert_eq!(pairs, 8 + 2 + 2 + 3 + 3 + 1 + 2 + 1 + 1 + 3);
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
        ("levels", "none", "expected a whole number from 1 to 4294967295, all, contracted or labels"),
        ("memory", "8 MB", "expected a whole number of bytes from 1 up, also as 500kB, 8MB or 1GB"),
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
    assert_eq!(described("subgoal"), "");
    assert_eq!(described("subgoal,levels=contracted"), "a contraction hierarchy");
    assert_eq!(described("subgoal,levels=labels,memory=8000kB"), "hub labels, at most 8MB for labels");
    assert_eq!(described("hpa,levels=1,unstraightened"), "1 level, side 10, paths not straightened");
    assert_eq!(
        described("chpa,squared"),
        "heuristic squared, variant complete, side 3, second heuristic squared, step 2, detours up to 3"
    );
    assert_eq!(described("chpa,paper"), "heuristic hk, variant paper, side 3, second heuristic hk, step 2");
}

#[test]
fn only_subgoals_have_a_contraction_hierarchy_and_hub_labels() {
    let said = |text: &str| text.parse::<Setup>().expect_err("levels alone").to_string();
    for engine in ["hpa", "subgoal-theta"] {
        for (levels, name) in [("contracted", "contraction hierarchy"), ("labels", "hub labels")] {
            let said = said(&format!("{engine},levels={levels}"));
            let expected = format!("{engine} takes no {name}: leave it out, or choose subgoal");
            assert!(said.ends_with(&expected), "{said}");
        }
    }
    let said = said("subgoal,levels=2,memory=8MB");
    let expected = "memory is for hub labels, not for 2 levels: leave out the one or the other";
    assert!(said.ends_with(expected), "{said}");
    assert!(Setup::new(Engine::Hpa, Motion::new(k(3), NEVER)).check().is_ok());
}

#[test]
fn amounts_of_memory_are_read_and_written() {
    let read = |text: &str| text.parse::<Memory>().map(Memory::bytes).ok();
    for (text, bytes) in [
        ("1", 1),
        ("999", 999),
        ("1000", 1000),
        ("500kB", 500_000),
        ("8MB", 8_000_000),
        ("1GB", 1_000_000_000),
        ("18446744073GB", 18_446_744_073_000_000_000),
        ("18446744073709551615", u64::MAX),
    ] {
        assert_eq!(read(text), Some(bytes), "{text}");
    }
    for text in [
        "",
        "0",
        "0MB",
        "MB",
        "+8MB",
        "-1",
        "8 MB",
        "8mb",
        "8Mb",
        "8MiB",
        "1.5GB",
        "1e6",
        "8MBMB",
        "18446744074GB",
        "٣",
    ] {
        assert_eq!(read(text), None, "{text}");
    }
    for (bytes, text) in
        [(1, "1"), (1000, "1kB"), (1_500_000, "1500kB"), (8_000_000, "8MB"), (2_000_000_000, "2GB")]
    {
        assert_eq!(Memory::new(bytes).map(|memory| memory.to_string()).as_deref(), Some(text));
    }
    let default = |width, height| Memory::for_labels_of(width, height).bytes();
    let of_maps = [default(1, 1), default(1000, 1000), default(2048, 2048), default(8192, 8192)];
    assert_eq!(of_maps, [48_000_000, 64_000_000, 1 << 28, 1_000_000_000]);
}
