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
fn infinity_has_several_names() {
    for name in ["any", "Any", "ANY", "inf", "Inf", "infinity", "Infinity", "∞"] {
        assert_eq!(name.parse(), Ok(K::Any), "{name}");
    }
}

#[test]
fn a_neighborhood_is_found_by_its_moves() {
    for k in 2..64 {
        let moves = 1_u64 << k;
        let found = FiniteK::from_neighbors(moves).expect("a power of two");
        assert_eq!(
            (found.get(), found.moves(), K::from_neighbors(moves)),
            (k, Some(moves), Ok(found.into()))
        );
    }
    for (moves, choices) in [
        (0, "4, 8 or another power of two"),
        (1, "4, 8 or another power of two"),
        (3, "4, 8 or another power of two"),
        (5, "4 or 8"),
        (6, "4 or 8"),
        (12, "8 or 16"),
        (257, "256 or 512"),
        (u64::MAX, "9223372036854775808"),
    ] {
        let error = K::from_neighbors(moves).expect_err("no power of two");
        assert_eq!(error, KError::Neighbors { moves });
        assert_eq!(error.to_string(), format!("no 2^k neighborhood has {moves} moves: choose {choices}"));
    }
}

#[test]
fn what_is_neither_is_told_so() {
    for wrong in ["", "three", "-3", "2.5", " 3", "anya", "∞∞", "infinite", "4294967296"] {
        assert_eq!(wrong.parse::<K>(), Err(ParseKError::Form), "{wrong}");
    }
    assert_eq!("1".parse::<K>(), Err(ParseKError::K(KError::TooSmall { k: 1 })));
    let said = ["x", "0"].map(|text| text.parse::<K>().expect_err("no k").to_string());
    assert_eq!(said[0], "choose a number from 2 up, or any");
    assert!(
        said[1].starts_with("k = 0 is too small") && said[1].ends_with("; choose a number from 2 up, or any")
    );
}
