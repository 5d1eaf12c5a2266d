//! The knob as text.

use mediant_moves::{K, KError, Knob, KnobError};

#[test]
fn it_is_a_number_or_any() {
    for n in [2, 3, 12, u32::MAX] {
        let k = K::new(n).expect("k is at least 2");
        assert_eq!((n.to_string().parse(), Knob::from(k).finite()), (Ok(Knob::K(k)), Some(k)));
        assert_eq!(Knob::K(k).to_string(), n.to_string());
    }
    assert_eq!(
        ("any".parse(), Knob::Any.finite(), Knob::Any.to_string().as_str()),
        (Ok(Knob::Any), None, "any")
    );
    assert_eq!(
        (format!("{:>5}|", Knob::Any), format!("{:>5}|", Knob::K(K::FOUR_CONNECTED))),
        ("  any|".into(), "    2|".into())
    );
    assert!(Knob::K(K::MAX_MOVES) < Knob::Any && Knob::K(K::FOUR_CONNECTED) < Knob::K(K::EIGHT_CONNECTED));
}

#[test]
fn what_is_neither_is_told_so() {
    for wrong in ["", "three", "-3", "2.5", " 3", "Any", "∞", "4294967296"] {
        assert_eq!(wrong.parse::<Knob>(), Err(KnobError::Form), "{wrong}");
    }
    assert_eq!("1".parse::<Knob>(), Err(KnobError::K(KError::TooSmall { k: 1 })));
    let said = ["x", "0"].map(|text| text.parse::<Knob>().expect_err("no knob").to_string());
    assert_eq!(said[0], "choose a number from 2 up, or any");
    assert!(
        said[1].starts_with("k = 0 is too small") && said[1].ends_with("; choose a number from 2 up, or any")
    );
}
