//! Pictures as SVG.

use std::{collections::BTreeMap, fmt::Write};

use mediant_grid::PlacementKind;

use super::{
    Picture, badge,
    color::{self, Rgb, hex},
    contour, encode,
    layout::{Layout, MARGIN},
    legend::legend,
    markup::{escape, number},
    outline::outlines,
    vertex_colors::VertexColors,
};

/// Longer outlines, in bytes, are replaced by pixels.
const LONGEST_OUTLINE: usize = 400_000;
/// So many vertices have colors as shapes; more have pixels.
const MOST_SHAPES: u64 = 4096;
/// So many pieces of contour lines are drawn at most.
const MOST_CONTOURS: usize = 20_000;
/// A legend has this width at least.
const NARROWEST: f64 = 300.0;

const SHEET: &str = r#".page,.free{fill:#fff}
.wall{fill:#8c959f}.dark{fill:#3d444d}
.grid{fill:none;stroke:#1f2328;stroke-opacity:.1}
.contour{fill:none;stroke:#1f2328;stroke-opacity:.27}
.frame{fill:none;stroke:#818b98}
.rim{fill:none;stroke:#fff;stroke-opacity:.78;stroke-linejoin:round;stroke-linecap:round}
.way{fill:none;stroke-opacity:.235;stroke-linejoin:round;stroke-linecap:round}
.badge{fill:#1f2328;stroke:#fff;stroke-width:1.25}
.letter{fill:none;stroke:#fff;stroke-linejoin:round;stroke-linecap:round}
text{fill:#1f2328;font:12px system-ui,-apple-system,"Segoe UI",Roboto,Helvetica,Arial,sans-serif}
.on{fill:#fff;font-size:11px;font-weight:700;text-anchor:middle}
.pixels{image-rendering:pixelated}
@media (prefers-color-scheme:dark){
.page,.plain .free{fill:#0d1117}
.plain .wall{fill:#59616b}
.plain .grid{stroke:#e6edf3}
.plain .rim{stroke:#0d1117}
text{fill:#e6edf3}
.badge{stroke:#818b98}
text.on{fill:#fff}
}
"#;

/// The whole file.
pub(super) fn document(picture: &Picture<'_>) -> String {
    let layout = picture.layout();
    let margin = f64::from(MARGIN);
    let (map_width, map_height) = (f64::from(layout.width), f64::from(layout.height));
    let room = map_width.max(NARROWEST);
    let mut body = String::new();
    let is_plain = map(picture, layout, &mut body);
    paths(picture, layout, &mut body);
    ends(picture, layout, &mut body);
    let (legend, bottom) = legend(picture, margin, margin + map_height + 8.0, room);
    body += &legend;
    let bottom = if legend.is_empty() { margin + map_height } else { bottom };
    let [width, height] = [room + 2.0 * margin, bottom + margin].map(number);
    let (columns, rows) = (picture.grid.width(), picture.grid.height());
    let names: Vec<&str> =
        picture.paths.iter().map(|path| &*path.name).filter(|name| !name.is_empty()).collect();
    let title = if names.is_empty() { String::new() } else { format!(": {}", names.join(", ")) };
    let class = if is_plain { " class=\"plain\"" } else { "" };
    let lines: String = (0..picture.paths.len())
        .map(|index| {
            let ink = hex(picture.path_color(index));
            format!(
                ".p{index}{{fill:none;stroke:{ink};stroke-linejoin:round;stroke-linecap:round}}\
                 .d{index}{{fill:{ink}}}\n"
            )
        })
        .collect();
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\"{class} width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\">\n\
         <title>Map of {columns} × {rows} cells{}</title>\n<style>\n{SHEET}{lines}</style>\n\
         <rect class=\"page\" width=\"{width}\" height=\"{height}\"/>\n{body}</svg>\n",
        escape(&title)
    )
}

/// The map with its field and search, in cells. The result is whether it is without colors, so that a dark
/// page can make it dark.
fn map(picture: &Picture<'_>, layout: Layout, body: &mut String) -> bool {
    let (columns, rows) = (picture.grid.width(), picture.grid.height());
    let Layout { width, height, .. } = layout;
    let painted = VertexColors::of(picture);
    let walls = if layout.cells > 1 { None } else { outlines(picture.grid, LONGEST_OUTLINE) };
    let is_plain = painted.is_none() && walls.is_some();
    // The last pixels of a map can lie across its border.
    let reach = |pixels: u32| pixels / layout.cell * layout.cells;
    let size = (reach(width), reach(height));
    let pixel = format!("{:.4}", 1.0 / layout.scale());
    _ = writeln!(
        body,
        "<svg x=\"{MARGIN}\" y=\"{MARGIN}\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {} {}\" \
         preserveAspectRatio=\"none\">",
        size.0, size.1
    );
    if let Some(walls) = walls {
        _ = writeln!(body, "<rect class=\"free\" width=\"{columns}\" height=\"{rows}\"/>");
        if let Some(painted) = &painted {
            colors(picture.placement, painted, body);
        }
        if layout.is_outlined() {
            let lines = (1..columns).map(|x| format!("M{x} 0v{rows}"));
            let lines: String = lines.chain((1..rows).map(|y| format!("M0 {y}h{columns}"))).collect();
            _ = writeln!(body, "<path class=\"grid\" stroke-width=\"{pixel}\" d=\"{lines}\"/>");
        }
        if !walls.is_empty() {
            let class = if picture.wall() == color::WALL { "wall" } else { "dark" };
            _ = writeln!(body, "<path class=\"{class}\" d=\"{walls}\"/>");
        }
    } else {
        let pixel_a_cell =
            Layout { cell: 1, width: width / layout.cell, height: height / layout.cell, ..layout };
        let base = picture.base(painted.as_ref(), pixel_a_cell, 0);
        pixels((0.0, 0.0), size, |out| encode::png(&base, out), body);
    }
    let contours = contour::lines(picture);
    if !contours.is_empty() && contours.len() <= MOST_CONTOURS {
        let lines = contours.iter().map(|[a, b]| {
            let [ax, ay, bx, by] = [a.0, a.1, b.0, b.1].map(number);
            format!("M{ax} {ay}L{bx} {by}")
        });
        _ = writeln!(
            body,
            "<path class=\"contour\" stroke-width=\"{pixel}\" d=\"{}\"/>",
            lines.collect::<String>()
        );
    }
    ways(picture, body);
    body.push_str("</svg>\n");
    let [x, y] = [f64::from(MARGIN) - 0.5; 2].map(number);
    _ = writeln!(
        body,
        "<rect class=\"frame\" x=\"{x}\" y=\"{y}\" width=\"{}\" height=\"{}\"/>",
        width + 1,
        height + 1
    );
    is_plain
}

/// The colors of vertices, as squares around them.
fn colors(placement: PlacementKind, painted: &VertexColors, body: &mut String) {
    let shift = if placement == PlacementKind::Center { 0.0 } else { -0.5 };
    let size = (painted.columns, painted.rows);
    if u64::from(size.0) * u64::from(size.1) > MOST_SHAPES {
        pixels((shift, shift), size, |out| encode::png_of_colors(painted, out), body);
        return;
    }
    let mut shapes: BTreeMap<Rgb, String> = BTreeMap::new();
    for (row, y) in painted.rows().zip(0..) {
        let mut x = 0;
        for run in row.chunk_by(|a, b| a == b) {
            if let Some(ink) = run.first().copied().flatten() {
                let [left, top] = [f64::from(x) + shift, f64::from(y) + shift].map(number);
                let length = run.len();
                let shape = shapes.entry(ink).or_default();
                _ = write!(shape, "M{left} {top}h{length}v1h-{length}z");
            }
            x += run.len() as u32;
        }
    }
    for (ink, shape) in shapes {
        let ink = hex(ink);
        // Strokes as wide as a seam, so that there are none.
        _ = writeln!(body, "<path fill=\"{ink}\" stroke=\"{ink}\" stroke-width=\".02\" d=\"{shape}\"/>");
    }
}

/// Pixels of one cell or more, from a PNG file.
fn pixels(
    (x, y): (f64, f64),
    (width, height): (u32, u32),
    png: impl FnOnce(&mut Vec<u8>) -> std::io::Result<()>,
    body: &mut String,
) {
    let mut file = Vec::new();
    // Writing to memory does not fail; without the file, the rest is still a picture.
    if png(&mut file).is_ok() {
        let ([x, y], data) = ([x, y].map(number), encode::base64(&file));
        _ = writeln!(
            body,
            "<image class=\"pixels\" x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
             preserveAspectRatio=\"none\" href=\"data:image/png;base64,{data}\"/>"
        );
    }
}

/// The ways of an agent along the paths, in cells.
fn ways(picture: &Picture<'_>, body: &mut String) {
    if picture.radius <= 0.0 {
        return;
    }
    let width = number(2.0 * picture.radius);
    for (path, index) in picture.paths.iter().zip(0..) {
        if let Some(data) = line(&path.points, |at| at) {
            let ink = hex(picture.path_color(index));
            _ = writeln!(
                body,
                "<path class=\"way\" stroke=\"{ink}\" stroke-width=\"{width}\" d=\"{data}\"/>"
            );
        }
    }
}

fn paths(picture: &Picture<'_>, layout: Layout, body: &mut String) {
    let count = picture.paths.len();
    let lines: Vec<_> = picture
        .paths
        .iter()
        .zip(0..)
        .filter_map(|(path, index)| Some((line(&path.points, |at| layout.pixel(at))?, &path.points, index)))
        .collect();
    // Below all paths: a rim must not hide a path that shares the segment.
    for (data, _, index) in &lines {
        let width = number(layout.line_width(*index, count) + 2.0);
        _ = writeln!(body, "<path class=\"rim\" stroke-width=\"{width}\" d=\"{data}\"/>");
    }
    for (data, points, index) in lines {
        let width = layout.line_width(index, count);
        let thin = number(width);
        _ = writeln!(body, "<path class=\"p{index}\" stroke-width=\"{thin}\" d=\"{data}\"/>");
        if layout.is_outlined() {
            let radius = number(0.8 * width + 0.75);
            for &at in points {
                let at = layout.pixel(at);
                let [x, y] = [at.0, at.1].map(number);
                _ = writeln!(body, "<circle class=\"d{index}\" cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"/>");
            }
        }
    }
}

/// A line from point to point; of a single point, one to itself, which shows its round ends.
fn line(points: &[(f64, f64)], place: impl Fn((f64, f64)) -> (f64, f64)) -> Option<String> {
    let mut data = String::new();
    let ends = [points.first()?, points.last()?];
    let points = if points.len() == 1 { &ends.map(|&at| at)[..] } else { points };
    for (&at, index) in points.iter().zip(0..) {
        let at = place(at);
        let [x, y] = [at.0, at.1].map(number);
        _ = write!(data, "{}{x} {y}", if index == 0 { 'M' } else { 'L' });
    }
    Some(data)
}

fn ends(picture: &Picture<'_>, layout: Layout, body: &mut String) {
    let radius = layout.badge();
    for (letter, at) in picture.ends() {
        let at = layout.pixel(at);
        let [x, y, r, width] = [at.0, at.1, radius, 2.0 * badge::stroke(radius)].map(number);
        let points: Vec<String> =
            letter.on(at, radius).into_iter().map(|(x, y)| format!("{} {}", number(x), number(y))).collect();
        _ = writeln!(
            body,
            "<circle class=\"badge\" cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>\
             <path class=\"letter\" stroke-width=\"{width}\" d=\"M{}\"/>",
            points.join("L")
        );
    }
}
