//! The legend of an SVG picture.

use super::{
    Picture,
    color::{self, Rgb, hex},
    markup::{escape, number},
    vertex_colors::range,
};

/// The height of a line.
const LINE: f64 = 22.0;
/// The width of a character, about, and of the sample before a name.
const CHARACTER: f64 = 6.4;
const SAMPLE: f64 = 28.0;
const GAP: f64 = 18.0;
/// The length of the bar that shows a field's colors.
const BAR: f64 = 120.0;

/// The sign before a name.
enum Sample {
    Line(usize, f64),
    Square(Rgb),
    Badge(&'static str),
    Bar,
}

/// The legend and the caption below a map of this width, from `top` on: their SVG and the y below them.
pub(super) fn legend(picture: &Picture<'_>, left: f64, top: f64, width: f64) -> (String, f64) {
    let (mut svg, mut x, mut y) = (String::new(), left, top);
    for (sample, name) in entries(picture) {
        let size = if matches!(sample, Sample::Bar) { BAR + 10.0 } else { SAMPLE };
        let room = size + CHARACTER * name.chars().count() as f64;
        if x > left && x + room > left + width {
            (x, y) = (left, y + LINE);
        }
        svg += &sign(&sample, x, y + LINE / 2.0);
        svg += &text(x + size, y + LINE / 2.0 + 4.0, &name);
        x += room + GAP;
    }
    if !svg.is_empty() {
        y += LINE;
    }
    let most = (width / CHARACTER).max(16.0) as usize;
    for line in wrapped(&picture.caption, most) {
        svg += &text(left, y + LINE / 2.0 + 4.0, &line);
        y += LINE - 4.0;
    }
    (svg, y)
}

fn entries(picture: &Picture<'_>) -> Vec<(Sample, String)> {
    let (layout, count) = (picture.layout(), picture.paths.len());
    let named = picture.paths.iter().zip(0..).filter(|(path, _)| !path.name.is_empty());
    let mut entries: Vec<_> = named
        .map(|(path, index)| (Sample::Line(index, layout.line_width(index, count)), path.name.clone()))
        .collect();
    let mut ends: Vec<_> = picture.ends().map(|(letter, _)| letter.name()).collect();
    ends.reverse();
    // One sign stands for all starts.
    ends.dedup();
    entries.extend(ends.into_iter().map(|name| (Sample::Badge(name), name.to_owned())));
    if !picture.expanded.is_empty() {
        entries
            .push((Sample::Square(color::of_expanded(0.7)), format!("expanded: {}", picture.expanded.len())));
    }
    if !picture.open.is_empty() {
        entries.push((Sample::Square(color::OPEN), format!("open: {}", picture.open.len())));
    }
    if let Some((least, greatest)) = range(&picture.field) {
        entries.push((Sample::Bar, format!("{} to {}", number(least.into()), number(greatest.into()))));
    }
    entries
}

fn sign(sample: &Sample, x: f64, y: f64) -> String {
    let [at, end, middle, line] = [x, x + 20.0, x + 10.0, y].map(number);
    match sample {
        Sample::Line(index, width) => {
            let width = number(*width);
            format!("<path class=\"p{index}\" stroke-width=\"{width}\" d=\"M{at} {line}H{end}\"/>\n")
        }
        Sample::Square(ink) => {
            let (top, ink) = (number(y - 6.0), hex(*ink));
            format!("<rect x=\"{at}\" y=\"{top}\" width=\"20\" height=\"12\" rx=\"2\" fill=\"{ink}\"/>\n")
        }
        Sample::Badge(name) => {
            let letter = if *name == "start" { "S" } else { "G" };
            let base = number(y + 4.0);
            format!(
                "<circle class=\"badge\" cx=\"{middle}\" cy=\"{line}\" r=\"8\"/>\
                 <text class=\"on\" x=\"{middle}\" y=\"{base}\">{letter}</text>\n"
            )
        }
        Sample::Bar => {
            let top = number(y - 6.0);
            let stops: String = color::SCALE
                .iter()
                .zip(0..)
                .map(|(&ink, i)| {
                    let offset = number(f64::from(i) / (color::SCALE.len() - 1) as f64);
                    format!("<stop offset=\"{offset}\" stop-color=\"{}\"/>", hex(ink))
                })
                .collect();
            format!(
                "<linearGradient id=\"scale\">{stops}</linearGradient>\
                 <rect x=\"{at}\" y=\"{top}\" width=\"{BAR}\" height=\"12\" rx=\"2\" fill=\"url(#scale)\"/>\n"
            )
        }
    }
}

fn text(x: f64, y: f64, text: &str) -> String {
    format!("<text x=\"{}\" y=\"{}\">{}</text>\n", number(x), number(y), escape(text))
}

/// Lines of at most so many characters, broken at spaces. A longer word has a line of its own.
fn wrapped(text: &str, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
