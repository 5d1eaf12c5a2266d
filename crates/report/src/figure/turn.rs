//! Parts of a figure that come forward one after another.

use super::canvas::Canvas;

/// The seconds for which each part stands alone.
const SECONDS: f64 = 1.6;
/// The share of a turn in which one part goes and the next one comes.
const FADE: f64 = 0.2;
/// The opacity of the others.
const FAINT: f64 = 0.1;

/// The class of the part of this number.
pub(super) fn class(index: usize) -> String {
    format!("turn turn{index}")
}

/// The rules of so many parts: a turn for each, and two more for all of them together. Who wants nothing to
/// move sees all of them.
pub(super) fn rules(canvas: &mut Canvas, count: usize) {
    let turns = (count + 2) as f64;
    let seconds = SECONDS * turns;
    canvas.rule(&format!(".turn{{animation-duration:{seconds:.1}s;animation-iteration-count:infinite}}"));
    for index in 0..count {
        let percent = |turn: f64| format!("{:.1}%", 100.0 * turn / turns);
        let (from, to) = (index as f64, (index + 1) as f64);
        // Coming and going at the two borders of its turn; the last turns are everybody's.
        let begin = if index == 0 {
            format!("0%,{}{{opacity:1}}", percent(to))
        } else {
            let (before, own) = (percent(from), percent(from + FADE));
            format!("0%,{before}{{opacity:{FAINT}}}{own},{}{{opacity:1}}", percent(to))
        };
        let all = count as f64;
        let (after, again, end) = (percent(to + FADE), percent(all), percent(all + FADE));
        let rest = if index + 1 == count {
            "100%{opacity:1}".to_owned()
        } else {
            format!("{after},{again}{{opacity:{FAINT}}}{end},100%{{opacity:1}}")
        };
        canvas.rule(&format!(
            "@keyframes turn{index}{{{begin}{rest}}}.turn{index}{{animation-name:turn{index}}}"
        ));
    }
    canvas.rule("@media (prefers-reduced-motion:reduce){.turn{animation:none}}");
}
