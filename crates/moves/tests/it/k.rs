//! The neighborhood as text.

use mediant_moves::{FiniteK, K, KError, ParseKError};

#[test]
fn it_is_a_number_or_any() {
    for n in [2, 3, 12, u32::MAX] {
        let k = FiniteK::new(n).expect("k is at least 2");
        assert_eq!((n.to_string().parse(), K::from(k).finite()), (Ok(K::Finite(k)), Some(k)));
        assert_eq!(K::Finite(k).to_string(), n.to_string());
    }
    assert_eq!(("any".parse(), K::Any.finite(), K::Any.to_string().as_str()), (Ok(K::Any), None, "any"));
    assert_eq!(
        (format!("{:>5}|", K::Any), format!("{:>5}|", K::Finite(FiniteK::N4))),
        ("  any|".into(), "    2|".into())
    );
    assert!(K::Finite(FiniteK::MAX_MOVES) < K::Any && K::Finite(FiniteK::N4) < K::Finite(FiniteK::N8));
}

#[test]
fn what_is_neither_is_told_so() {
    for wrong in ["", "three", "-3", "2.5", " 3", "Any", "∞", "4294967296"] {
        assert_eq!(wrong.parse::<K>(), Err(ParseKError::Form), "{wrong}");
    }
    assert_eq!("1".parse::<K>(), Err(ParseKError::K(KError::TooSmall { k: 1 })));
    let said = ["x", "0"].map(|text| text.parse::<K>().expect_err("no k").to_string());
    assert_eq!(said[0], "choose a number from 2 up, or any");
    assert!(
        said[1].starts_with("k = 0 is too small") && said[1].ends_with("; choose a number from 2 up, or any")
    );
}
