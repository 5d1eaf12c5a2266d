//! An SVG file, element by element.

use std::fmt::Write;

use super::{
    geometry::{Point, Rect},
    sheet::SHEET,
    text::{LINE, TEXT, TITLE, wrap},
};

/// The width of a figure in a page, in pixels.
pub(super) const WIDTH: f64 = 760.0;
/// The empty border around a figure.
pub(super) const MARGIN: f64 = 16.0;

/// Which point of a text is given.
#[derive(Clone, Copy, Debug)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    /// Nothing for `start`, which is SVG's default.
    const fn attribute(self) -> &'static str {
        match self {
            Self::Start => "",
            Self::Middle => r#" text-anchor="middle""#,
            Self::End => r#" text-anchor="end""#,
        }
    }
}

/// The elements of an SVG file. Classes are those of [`SHEET`]; an empty one is left out.
#[derive(Clone, Debug, Default)]
pub(super) struct Canvas {
    body: String,
    /// Rules of this figure alone, beside those of [`SHEET`].
    rules: String,
}

impl Canvas {
    fn element(&mut self, name: &str, class: &str, rest: &str) {
        let _ = writeln!(self.body, "<{name}{}{rest}/>", attribute(class));
    }

    pub(super) fn line(&mut self, class: &str, from: Point, to: Point) {
        let [x1, y1, x2, y2] = [from.0, from.1, to.0, to.1].map(number);
        self.element("line", class, &format!(r#" x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}""#));
    }

    pub(super) fn rect(&mut self, class: &str, at: Rect, rounding: f64) {
        let [x, y, width, height] = [at.x, at.y, at.width, at.height].map(number);
        let rounding = if rounding > 0.0 { format!(r#" rx="{}""#, number(rounding)) } else { String::new() };
        self.element(
            "rect",
            class,
            &format!(r#" x="{x}" y="{y}" width="{width}" height="{height}"{rounding}"#),
        );
    }

    pub(super) fn circle(&mut self, class: &str, center: Point, radius: f64) {
        let [x, y, r] = [center.0, center.1, radius].map(number);
        self.element("circle", class, &format!(r#" cx="{x}" cy="{y}" r="{r}""#));
    }

    /// A line through the points. `width` overrides that of the class.
    pub(super) fn path(&mut self, class: &str, points: &[Point], closed: bool, width: Option<f64>) {
        let mut d = String::new();
        for (i, &(x, y)) in points.iter().enumerate() {
            let _ = write!(d, "{}{},{}", if i == 0 { "M" } else { "L" }, number(x), number(y));
        }
        let end = if closed { "Z" } else { "" };
        let width = width.map_or(String::new(), |w| format!(r#" style="stroke-width:{}""#, number(w)));
        self.element("path", class, &format!(r#" d="{d}{end}"{width}"#));
    }

    /// A path in units of `scale` pixels from `origin`.
    pub(super) fn scaled_path(&mut self, class: &str, d: &str, origin: Point, scale: f64) {
        let [x, y, scale] = [origin.0, origin.1, scale].map(number);
        self.element("path", class, &format!(r#" transform="translate({x},{y}) scale({scale})" d="{d}""#));
    }

    /// A text whose base line goes through `at`.
    pub(super) fn text(&mut self, class: &str, anchor: Anchor, at: Point, text: &str) {
        let [x, y] = [at.0, at.1].map(number);
        let (class, anchor, text) = (attribute(class), anchor.attribute(), escape(text));
        let _ = writeln!(self.body, r#"<text{class}{anchor} x="{x}" y="{y}">{text}</text>"#);
    }

    /// A text that is turned clockwise about `at`, by degrees.
    pub(super) fn turned_text(&mut self, class: &str, anchor: Anchor, at: Point, degrees: f64, text: &str) {
        let [x, y, degrees] = [at.0, at.1, degrees].map(number);
        let (class, anchor, text) = (attribute(class), anchor.attribute(), escape(text));
        let _ = writeln!(
            self.body,
            r#"<text{class}{anchor} transform="translate({x},{y}) rotate({degrees})">{text}</text>"#
        );
    }

    /// The elements that follow belong together, up to [`end_group`](Self::end_group).
    pub(super) fn begin_group(&mut self, class: &str) {
        let _ = writeln!(self.body, "<g{}>", attribute(class));
    }

    pub(super) fn end_group(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// Adds a rule to the style sheet of this figure.
    pub(super) fn rule(&mut self, rule: &str) {
        let _ = write!(self.rules, "\n{rule}");
    }

    /// Writes the title and the note at the top, and returns the y below them.
    pub(super) fn header(&mut self, title: &str, note: Option<&str>, width: f64) -> f64 {
        let room = width - 2.0 * MARGIN;
        let mut y = MARGIN / 2.0;
        for line in wrap(title, TITLE, room) {
            y += 20.0;
            self.text("title", Anchor::Start, (MARGIN, y - 4.0), &line);
        }
        for line in note.map_or(Vec::new(), |note| wrap(note, TEXT, room)) {
            y += LINE;
            self.text("muted", Anchor::Start, (MARGIN, y - 2.0), &line);
        }
        y + 10.0
    }

    /// The whole file, for a figure of this width and height. A screen reader reads `title` and `description`
    /// aloud.
    pub(super) fn finish(self, title: &str, description: &str, width: f64, height: f64) -> String {
        let height = height.ceil();
        let shown = number(WIDTH * height / width);
        let [width, height, page] = [width, height, WIDTH].map(number);
        let (title, description) = (escape(title), escape(description));
        format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" role="img" width="{page}" height="{shown}" viewBox="0 0 {width} {height}">
<title>{title}</title>
<desc>{description}</desc>
<style>
{SHEET}{}
</style>
<rect class="page" x="0" y="0" width="{width}" height="{height}"/>
{}</svg>
"#,
            self.rules, self.body
        )
    }
}

fn attribute(class: &str) -> String {
    if class.is_empty() { String::new() } else { format!(r#" class="{class}""#) }
}

/// A number with at most two decimals. More would not be visible, and the last bits of a logarithm differ
/// between machines, so that the files would too.
fn number(value: f64) -> String {
    debug_assert!(value.is_finite(), "{value} in a figure");
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// The text with markup escaped. Characters that XML 1.0, section 2.2, does not allow become spaces.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}
