//! The elements of an SVG text, and the style sheet that all figures share.

use std::fmt::Write;

/// In pixels from the upper left corner, x to the right, y down.
pub(super) type Point = (f64, f64);

/// The width of a figure in a page, in pixels.
pub(super) const WIDTH: f64 = 760.0;
/// The empty border around a figure.
pub(super) const MARGIN: f64 = 16.0;
/// The size of most text.
pub(super) const TEXT: f64 = 12.0;
/// The distance of lines of that text.
pub(super) const LINE: f64 = 16.0;
/// The size of the text beside points.
pub(super) const SMALL: f64 = 11.0;
const TITLE: f64 = 16.0;

/// Colors s0 to s7 are Okabe and Ito's. Yellow is darker on white than theirs, blue and black are lighter on black: they would
/// not be seen.
const STYLE: &str = r#".page{fill:#fff}
text{fill:#1f2328;font:12px system-ui,-apple-system,"Segoe UI",Roboto,Helvetica,Arial,sans-serif}
.title{font-size:16px;font-weight:600}
.small{font-size:11px}
.strong{font-weight:600}
.muted{fill:#59636e}
.halo{stroke:#fff;stroke-width:3px;stroke-linejoin:round;paint-order:stroke}
.grid{stroke:#e4e8ec;stroke-width:1}
.axis{stroke:#818b98;stroke-width:1}
.outline{fill:none}
.leader{stroke:#818b98;stroke-width:.75}
.edge{stroke:#818b98;stroke-width:1.25}
.curve{fill:none;stroke:currentColor;stroke-width:1.75;stroke-linejoin:round}
.thin{stroke-width:1.25}
.mark{fill:currentColor;stroke:#fff;stroke-width:.75}
.hollow{fill:#fff;stroke:currentColor;stroke-width:1.5}
.wall{fill:#8c959f}
.badge{fill:#1f2328;stroke:#fff;stroke-width:1.5}
.onbadge{fill:#fff;font-size:11px;font-weight:700}
.node{fill:#fff;stroke:#818b98;stroke-width:1.25}
.leaf{fill:#ddf0fa;stroke:#0072b2;stroke-width:1.75}
.s0{color:#0072b2}.s1{color:#d55e00}.s2{color:#009e73}.s3{color:#cc79a7}
.s4{color:#e69f00}.s5{color:#56b4e9}.s6{color:#000}.s7{color:#b3a500}.r{color:#59636e}
.d1{stroke-dasharray:7 3}.d2{stroke-dasharray:2 2.5}.d3{stroke-dasharray:9 3 2 3}.d4{stroke-dasharray:13 4}
@media (prefers-color-scheme:dark){
.page,.hollow,.node{fill:#0d1117}
text{fill:#e6edf3}
.muted{fill:#9198a1}
.halo,.mark{stroke:#0d1117}
.grid{stroke:#242a32}
.axis,.leader,.edge,.node{stroke:#6e7681}
.wall{fill:#59616b}
.badge{fill:#e6edf3;stroke:#0d1117}
.onbadge{fill:#0d1117}
.leaf{fill:#10304a;stroke:#56b4e9}
.s0{color:#4a9fe0}.s6{color:#f0f6fc}.s7{color:#f0e442}.r{color:#9198a1}
}"#;

/// A rectangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rect {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Rect {
    pub(super) const fn new(x: f64, y: f64, width: f64, height: f64) -> Self {
        Self { x, y, width, height }
    }

    pub(super) fn around((x, y): Point, radius: f64) -> Self {
        Self::new(x - radius, y - radius, 2.0 * radius, 2.0 * radius)
    }

    pub(super) fn right(self) -> f64 {
        self.x + self.width
    }

    pub(super) fn bottom(self) -> f64 {
        self.y + self.height
    }

    pub(super) fn center(self) -> Point {
        (self.x + self.width / 2.0, self.y + self.height / 2.0)
    }

    /// The point of the rectangle that is nearest to another.
    pub(super) fn nearest(self, (x, y): Point) -> Point {
        (x.clamp(self.x, self.right()), y.clamp(self.y, self.bottom()))
    }

    /// The part of a line that is inside (Liang & Barsky 1984).
    pub(super) fn clip(self, [from, to]: [Point; 2]) -> Option<[Point; 2]> {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let borders = [
            (-dx, from.0 - self.x),
            (dx, self.right() - from.0),
            (-dy, from.1 - self.y),
            (dy, self.bottom() - from.1),
        ];
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for (toward, room) in borders {
            if toward < 0.0 {
                enter = enter.max(room / toward);
            } else if toward > 0.0 {
                leave = leave.min(room / toward);
            } else if room < 0.0 {
                return None;
            }
        }
        // An end that is inside stays as it is, to the last bit, so that the next piece begins there.
        let at = |t: f64| if t == 1.0 { to } else { (from.0 + t * dx, from.1 + t * dy) };
        (enter <= leave).then(|| [at(enter), at(leave)])
    }

    /// The area that two rectangles share.
    pub(super) fn overlap(self, other: Self) -> f64 {
        let across = self.right().min(other.right()) - self.x.max(other.x);
        let down = self.bottom().min(other.bottom()) - self.y.max(other.y);
        across.max(0.0) * down.max(0.0)
    }
}

/// Where the given point of a text is.
#[derive(Clone, Copy, Debug)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    /// `start` is SVG's default.
    const fn attribute(self) -> &'static str {
        match self {
            Self::Start => "",
            Self::Middle => r#" text-anchor="middle""#,
            Self::End => r#" text-anchor="end""#,
        }
    }
}

/// An SVG text that grows element by element. Classes are those of [`STYLE`]; an empty one is left out.
#[derive(Clone, Debug, Default)]
pub(super) struct Canvas {
    body: String,
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

    /// A line through the points, closed or not. `width` overrules that of the class.
    pub(super) fn path(&mut self, class: &str, points: &[Point], closed: bool, width: Option<f64>) {
        let mut d = String::new();
        for (i, &(x, y)) in points.iter().enumerate() {
            let _ = write!(d, "{}{},{}", if i == 0 { "M" } else { "L" }, number(x), number(y));
        }
        let end = if closed { "Z" } else { "" };
        let width = width.map_or(String::new(), |w| format!(r#" style="stroke-width:{}""#, number(w)));
        self.element("path", class, &format!(r#" d="{d}{end}"{width}"#));
    }

    /// A path in units of its own, `scale` pixels each, from an origin.
    pub(super) fn scaled_path(&mut self, class: &str, d: &str, origin: Point, scale: f64) {
        let [x, y, scale] = [origin.0, origin.1, scale].map(number);
        self.element("path", class, &format!(r#" transform="translate({x},{y}) scale({scale})" d="{d}""#));
    }

    /// `at` is on the base line.
    pub(super) fn text(&mut self, class: &str, anchor: Anchor, at: Point, text: &str) {
        let [x, y] = [at.0, at.1].map(number);
        let (class, anchor, text) = (attribute(class), anchor.attribute(), escape(text));
        let _ = writeln!(self.body, r#"<text{class}{anchor} x="{x}" y="{y}">{text}</text>"#);
    }

    /// A text turned about `at`, degrees clockwise.
    pub(super) fn turned_text(&mut self, class: &str, anchor: Anchor, at: Point, degrees: f64, text: &str) {
        let [x, y, degrees] = [at.0, at.1, degrees].map(number);
        let (class, anchor, text) = (attribute(class), anchor.attribute(), escape(text));
        let _ = writeln!(
            self.body,
            r#"<text{class}{anchor} transform="translate({x},{y}) rotate({degrees})">{text}</text>"#
        );
    }

    /// The title and the note at the top; the y below them.
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

    /// The whole file. `title` and `description` are what a screen reader says.
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
{STYLE}
</style>
<rect class="page" x="0" y="0" width="{width}" height="{height}"/>
{}</svg>
"#,
            self.body
        )
    }
}

fn attribute(class: &str) -> String {
    if class.is_empty() { String::new() } else { format!(r#" class="{class}""#) }
}

/// A number with at most two decimals: a hundredth of a pixel is not seen, and the last bits of a logarithm, which differ from
/// one machine to the next, are not written.
fn number(value: f64) -> String {
    debug_assert!(value.is_finite(), "{value} in a figure");
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// The text with markup escaped; what XML 1.0, section 2.2, does not allow becomes a space.
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

/// About how wide a text is in the common sans-serif fonts.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    let width = |c: char| match c {
        'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' => 0.28,
        ' ' | 'f' | 't' | 'r' | 'I' | '(' | ')' | '[' | ']' | '/' | '-' | '⁻' => 0.36,
        'm' | 'w' | 'M' | 'W' | '@' | '%' | '…' => 0.9,
        '¹' | '²' | '³' | '⁰'..='⁹' => 0.38,
        c if c.is_uppercase() => 0.7,
        c if (c as u32) < 0x2e80 => 0.58,
        _ => 1.0,
    };
    size * text.chars().map(width).sum::<f64>()
}

/// The text in lines of at most this width, broken at spaces, and within a word that is wider.
pub(super) fn wrap(text: &str, size: f64, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut line = String::new();
    for word in text.split_whitespace() {
        let joined = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
        if text_width(&joined, size) <= width {
            line = joined;
            continue;
        }
        if !line.is_empty() {
            lines.push(std::mem::take(&mut line));
        }
        for c in word.chars() {
            line.push(c);
            if line.chars().count() > 1 && text_width(&line, size) > width {
                line.pop();
                lines.push(std::mem::replace(&mut line, c.to_string()));
            }
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}
