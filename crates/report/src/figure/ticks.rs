//! The names of ticks: which are written, and how wide they are.

use super::{
    span::Span,
    text::{TEXT, text_width},
};

/// Places on an axis, from 0 at its low end to 1 at its high end, with their names.
pub(super) type Ticks = Vec<(f64, String)>;

/// The width of the widest name.
pub(super) fn widest_name(ticks: &Ticks) -> f64 {
    ticks.iter().map(|(_, name)| text_width(name, TEXT)).fold(0.0, f64::max)
}

/// The ticks of an axis of that many pixels, with '≤' or '≥' at its low and its high end where markers are
/// clamped there. These replace the ticks nearby.
pub(super) fn with_ends(mut ticks: Ticks, span: &Span, [low, high]: [bool; 2], pixels: f64) -> Ticks {
    let near = 12.0 / pixels.max(1.0);
    if low {
        ticks.retain(|(fraction, _)| *fraction > near);
        ticks.insert(0, (0.0, format!("≤ {}", span.end(false))));
    }
    if high {
        ticks.retain(|(fraction, _)| *fraction < 1.0 - near);
        ticks.push((1.0, format!("≥ {}", span.end(true))));
    }
    ticks
}

/// Removes each name that would overlap the last one kept before it. `along` is the room that a name needs
/// along the axis.
pub(super) fn thinned(mut ticks: Ticks, pixels: f64, along: impl Fn(&str) -> f64) -> Ticks {
    let mut end = f64::NEG_INFINITY;
    for (fraction, name) in &mut ticks {
        let (at, half) = (*fraction * pixels, along(name) / 2.0);
        if at - half < end - 1e-6 {
            name.clear();
        } else {
            end = at + half;
        }
    }
    ticks
}

/// The name, or its beginning and an ellipsis if it is wider than `width`.
pub(super) fn cut(name: &str, width: f64) -> String {
    if text_width(name, TEXT) <= width {
        return name.to_owned();
    }
    let mut short = String::new();
    for c in name.chars() {
        short.push(c);
        if text_width(&short, TEXT) + TEXT > width {
            break;
        }
    }
    short + "…"
}
