//! Serde: round trips, the forms as others see them, and data that is refused.

use std::fmt::Debug;

use mediant::{
    CornerRule, DiagonalGap, Ends, Engine, FiniteK, K, Map, Motion, Path, PlacementKind, Point, Rectangle,
    Rules, Setup, Vertex,
    options::{EngineName, Levels, Memory},
};
use serde::{Serialize, de::DeserializeOwned};
use serde_json::{Value, json};

use super::k;

/// A value is written in this form, and read from it, as from a format of bytes.
#[track_caller]
fn check<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T, form: &Value) {
    assert_eq!(&serde_json::to_value(value).expect("it can be written"), form);
    let read = |text: &str| serde_json::from_str::<T>(text);
    assert_eq!(&read(&form.to_string()).expect("it can be read"), value);
    let mut bytes = Vec::new();
    ciborium::into_writer(value, &mut bytes).expect("it can be written");
    assert_eq!(&ciborium::from_reader::<T, _>(&bytes[..]).expect("it can be read"), value);
}

#[track_caller]
fn check_refused<T: DeserializeOwned + Debug>(form: &Value, why: &str) {
    let error = serde_json::from_value::<T>(form.clone()).expect_err("it is refused").to_string();
    assert!(error.contains(why), "{form}: {error}");
}

#[test]
fn places_are_arrays() {
    check(&Vertex::new(3, -1), &json!([3, -1]));
    check(&Ends::new((0, 0), (7, 2)), &json!({ "start": [0, 0], "goal": [7, 2] }));
    check(&Rectangle::new(4, 1, 3, 2), &json!({ "x": 4, "y": 1, "width": 3, "height": 2 }));
    check(&Point::from(Vertex::new(3, i32::MIN)), &json!([3, i32::MIN]));
    for (x, y) in [(2.5, -0.25), (7.0, 0.000_976_562_5), (f64::from(i32::MAX), 0.5)] {
        let point = Point::nearest(x, y).expect("two numbers");
        assert_eq!((point.x(), point.y()), (x, y), "{point}");
        let form = if x.fract() == 0.0 { json!([x as i32, y]) } else { json!([x, y]) };
        check(&point, &form);
    }
    check_refused::<Point>(&json!([2_147_483_648.0, 0]), "beyond those of all vertices");
    check(&Path::new(Vec::new()), &json!([]));
    let path = Path::new(vec![(0, 0).into(), (3, 0).into(), (5, 2).into()]);
    check(&path, &json!([[0, 0], [3, 0], [5, 2]]));
    let read: Path = serde_json::from_str("[[0,0],[3,4]]").expect("a path");
    assert_eq!(read.cost(), 5.0);
}

#[test]
fn motion_is_a_k_and_rules() {
    for n in [2, 3, 12, 99, u32::MAX] {
        check(&k(n), &json!(n));
        check(&K::Finite(k(n)), &json!(n));
    }
    check(&K::ANY, &json!("any"));
    for (text, k) in [("\"3\"", K::N8), ("\"inf\"", K::ANY)] {
        assert_eq!(serde_json::from_str::<K>(text).ok(), Some(k));
    }
    check(&PlacementKind::Center, &json!("center"));
    check(&PlacementKind::Corner, &json!("corner"));
    for rule in [CornerRule::Never, CornerRule::One, CornerRule::Always] {
        check(&rule, &json!(rule.to_string()));
        check(&Rules::Center(rule), &json!({ "center": rule.to_string() }));
    }
    for gap in [DiagonalGap::Open, DiagonalGap::Closed] {
        check(&gap, &json!(gap.to_string()));
        check(&Rules::Corner(gap), &json!({ "corner": gap.to_string() }));
    }
    check(&Motion::default(), &json!({ "k": 3, "rules": { "center": "never" } }));
    check(&Motion::corners(K::ANY), &json!({ "k": "any", "rules": { "corner": "open" } }));
}

#[test]
fn names_and_setups_are_texts() {
    for engine in Engine::ALL {
        check(&engine, &json!(engine.name()));
        check(&EngineName::Engine(engine), &json!(engine.name()));
    }
    check(&EngineName::Auto, &json!("auto"));
    let mut setups = 0;
    for rules in Rules::ALL {
        for k in [K::N8, K::N16, K::ANY] {
            for setup in Setup::all(Motion::new(k, rules)) {
                check(&setup, &json!(setup.to_string()));
                setups += 1;
            }
        }
    }
    assert!(setups > 100, "{setups}");
    for text in ["8MB", "1500kB", "1"] {
        check(&text.parse::<Memory>().expect("an amount"), &json!(text));
    }
    for text in ["1", "7", "all", "contracted", "labels"] {
        check(&text.parse::<Levels>().expect("levels"), &json!(text));
    }
}

/// Serde reads only values that a constructor could have made.
#[test]
fn invalid_data_is_refused() {
    for wrong in [json!(0), json!(1)] {
        check_refused::<FiniteK>(&wrong, "is too small");
        check_refused::<K>(&wrong, "is too small");
        check_refused::<Motion>(&json!({ "k": wrong, "rules": { "center": "never" } }), "is too small");
    }
    check_refused::<FiniteK>(&json!(-3), "-3");
    check_refused::<K>(&json!(-3), "k = -3 is too small");
    check_refused::<K>(&json!(1_u64 << 32), "k = 4294967296 is too large");
    check_refused::<K>(&json!("some"), "choose a number from 2 up, or any");
    check_refused::<K>(&json!(null), "a k: a number from 2 up, or \"any\"");
    check_refused::<CornerRule>(&json!("Never"), "unknown variant");
    check_refused::<Rules>(&json!({ "center": "open" }), "unknown variant");
    check_refused::<Rules>(&json!({ "corner": "never" }), "unknown variant");
    check_refused::<Motion>(&json!({ "k": 3 }), "missing field `rules`");
    check_refused::<Vertex>(&json!([1]), "invalid length");
    check_refused::<Vertex>(&json!([1, 1_u64 << 31]), "2147483648");
    check_refused::<Vertex>(&json!([0.5, 1]), "0.5");
    check_refused::<Path>(&json!([[1, 2], [3]]), "invalid length");
    check_refused::<Ends>(&json!({ "start": [0, 0], "goal": [1, 1], "nearest": true }), "nearest");
    check_refused::<Rectangle>(&json!({ "x": -1, "y": 0, "width": 1, "height": 1 }), "-1");
    check_refused::<Engine>(&json!("warp"), "expected one of");
    check_refused::<EngineName>(&json!("warp"), "auto, ");
    check_refused::<Setup>(&json!("astar:1"), "expected ENGINE");
    check_refused::<Setup>(&json!("anya:3:never"), "needs placement corner");
    check_refused::<Memory>(&json!("0"), "whole number of bytes");
    check_refused::<Levels>(&json!("0"), "whole number from 1");

    // A number that is no k of bytes, and one of a motion that was made with it.
    let mut bytes = Vec::new();
    ciborium::into_writer(&1_u32, &mut bytes).expect("a number");
    assert!(ciborium::from_reader::<K, _>(&bytes[..]).is_err());
    let error = serde_json::to_string(&Motion::centers(0)).expect_err("no k");
    assert!(error.to_string().contains("k = 0 is too small"), "{error}");
    // A k that no engine searches is a k; the map says so.
    let far: Motion =
        serde_json::from_value(json!({ "k": 99, "rules": { "center": "never" } })).expect("a k");
    assert!(Map::new(2, 2).and_then(|map| map.space(far)).is_err());
}
