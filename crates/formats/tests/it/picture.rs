//! Pictures: small ones as text, larger ones by their pixels, and odd ones.

use std::{f64::consts::PI, fs, io::Cursor};

use mediant_formats::{Picture, PictureError};
use mediant_grid::{AsciiMap, Grid, PlacementKind, Vertex};
use mediant_oracle::{Rng, noise, random_grid, seeds};

const MARGIN: u32 = 16;
const WHITE: [u8; 3] = [255; 3];
const WALL: [u8; 3] = [0x8c, 0x95, 0x9f];
const BLUE: [u8; 3] = [0x00, 0x72, 0xb2];
const KINDS: [PlacementKind; 2] = [PlacementKind::Center, PlacementKind::Corner];

/// A decoded PNG file.
struct Pixels {
    width: u32,
    height: u32,
    /// Red, green, blue and opacity.
    rgba: Vec<[u8; 4]>,
}

impl Pixels {
    fn decode(file: &[u8]) -> Self {
        let mut decoder = png::Decoder::new(Cursor::new(file));
        decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::ALPHA);
        let mut reader = decoder.read_info().expect("it has a header");
        let mut bytes = vec![0; reader.output_buffer_size().expect("it fits")];
        let info = reader.next_frame(&mut bytes).expect("it has pixels");
        let rgba = bytes.chunks(4).map(|pixel| [pixel[0], pixel[1], pixel[2], pixel[3]]).collect();
        Self { width: info.width, height: info.height, rgba }
    }

    fn of(picture: &Picture<'_>) -> Self {
        Self::decode(&png(picture))
    }

    fn at(&self, x: u32, y: u32) -> [u8; 3] {
        let [r, g, b, _] = self.rgba[(y * self.width + x) as usize];
        [r, g, b]
    }
}

fn png(picture: &Picture<'_>) -> Vec<u8> {
    let mut file = Vec::new();
    picture.write_png(&mut file).expect("memory takes it");
    file
}

/// The middle of a cell of this many pixels.
fn middle(x: u32, y: u32, cell: u32) -> (u32, u32) {
    (MARGIN + x * cell + cell / 2, MARGIN + y * cell + cell / 2)
}

fn map(text: &str) -> Grid {
    AsciiMap::parse(text).expect("it is a map").grid
}

#[test]
fn a_small_map_with_paths_as_svg() {
    let grid = map("....\n.##.\n....");
    let picture = Picture::new(&grid, PlacementKind::Center)
        .path("k = 2", [(0.0, 0.0), (0.0, 2.0), (3.0, 2.0)])
        .path("A & <B>", [(0.0, 0.0), (3.0, 0.0), (3.0, 2.0)])
        .start((0, 0))
        .goal((3, 2))
        .radius(0.25)
        .caption("length \"5\"\u{7}");
    insta::assert_snapshot!(picture.svg());
}

#[test]
fn a_field_and_a_search_as_svg() {
    let grid = map("...\n.#.");
    let field = |at: Vertex| (at.x < 3).then(|| f64::from(at.x) + f64::from(at.y) / 2.0);
    let picture = Picture::new(&grid, PlacementKind::Corner)
        .field(field)
        .open([(0, 2), (9, 9), (-1, 0)].map(Vertex::from))
        .expanded([(0, 0), (1, 0)].map(Vertex::from));
    insta::assert_snapshot!(picture.svg());
}

#[test]
fn cells_have_their_colors() {
    for seed in seeds(40) {
        let (grid, kind) = random_grid(seed);
        let cell = (200 / grid.width().max(grid.height())).min(40);
        for placement in KINDS {
            let picture = Picture::new(&grid, placement).largest_side(200);
            let pixels = Pixels::of(&picture);
            assert!(png(&picture) == png(&picture.clone()), "the same picture has the same bytes");
            let size = (grid.width() * cell + 2 * MARGIN, grid.height() * cell + 2 * MARGIN);
            assert_eq!((pixels.width, pixels.height), size);
            for (y, x) in (0..grid.height()).flat_map(|y| (0..grid.width()).map(move |x| (y, x))) {
                let (px, py) = middle(x, y, cell);
                let expected = if grid.is_blocked(x as i32, y as i32) { WALL } else { WHITE };
                assert_eq!(pixels.at(px, py), expected, "seed {seed}: {kind}, cell ({x}, {y})");
            }
            assert_eq!(pixels.at(0, 0), WHITE);
        }
    }
}

#[test]
fn paths_are_lines_with_smooth_rims() {
    let grid = Grid::from_fn(300, 200, |_, _| false).expect("it is small");
    let cell = 2;
    let picture = Picture::new(&grid, PlacementKind::Center).largest_side(600);
    let along = Pixels::of(&picture.clone().path("", [(10.0, 20.0), (200.0, 20.0)]));
    let (left, y) = middle(10, 20, cell);
    for x in 10..200 {
        assert_eq!(along.at(middle(x, 20, cell).0, y), BLUE);
    }
    assert_eq!([along.at(left - 8, y), along.at(left + 40, y - 8), along.at(left + 40, y + 8)], [WHITE; 3]);
    // As wide in every direction: the ink of a line grows with its length alone.
    let ink = |angle: f64| {
        let (x, y) = (150.0 + 90.0 * angle.cos(), 100.0 + 90.0 * angle.sin());
        let pixels = Pixels::of(&picture.clone().path("", [(150.0, 100.0), (x, y)]));
        let rows = MARGIN..pixels.height - MARGIN;
        let cells = rows.flat_map(|y| (MARGIN..pixels.width - MARGIN).map(move |x| (x, y)));
        cells.map(|(x, y)| 255.0 - f64::from(pixels.at(x, y)[0])).sum::<f64>()
    };
    let straight = ink(0.0);
    for turn in 1..8 {
        let part = ink(2.0 * PI * f64::from(turn) / 11.0) / straight;
        assert!((0.97..1.03).contains(&part), "{part} at {turn} of 11");
    }
}

#[test]
fn a_path_over_another_leaves_its_rim_to_be_seen() {
    let grid = Grid::from_fn(40, 40, |_, _| false).expect("it is small");
    let points = [(5.0, 20.0), (35.0, 20.0)];
    let picture = Picture::new(&grid, PlacementKind::Center).path("wide", points).path("thin", points);
    let pixels = Pixels::of(&picture);
    let column: Vec<_> = (0..pixels.height).map(|y| pixels.at(MARGIN + 30 * 20, y)).collect();
    let rim = column.iter().position(|&[r, _, b]| b > r.saturating_add(30)).expect("the wide path is there");
    let line = column.iter().position(|&pixel| pixel == [0xd5, 0x5e, 0x00]).expect("the thin path is there");
    assert!(rim < line, "{rim} {line}");
    assert!(column.iter().rev().position(|&[r, _, b]| b > r.saturating_add(30)).is_some_and(|rim| rim > 0));
}

#[test]
fn a_large_map_shows_the_mean_of_cells() {
    // A third of each row, then all of the lower half.
    let grid = Grid::from_fn(9000, 60, |x, y| x % 3 == 0 || y >= 30).expect("it is small");
    for placement in KINDS {
        let pixels = Pixels::of(&Picture::new(&grid, placement).goal((8999, 0)));
        assert_eq!((pixels.width, pixels.height), (3000 + 2 * MARGIN, 20 + 2 * MARGIN));
        let third = WALL.map(|c| ((u32::from(c) + 2 * 255 + 1) / 3) as u8);
        assert_eq!(pixels.at(MARGIN + 500, MARGIN + 5), third);
        assert_eq!(pixels.at(MARGIN + 500, MARGIN + 15), WALL);
        // The same, turned.
        let tall = Grid::from_fn(60, 9000, |x, y| y % 3 == 0 || x >= 30).expect("it is small");
        let turned = Pixels::of(&Picture::new(&tall, placement));
        assert_eq!(
            [turned.at(MARGIN + 5, MARGIN + 500), turned.at(MARGIN + 15, MARGIN + 500)],
            [third, WALL]
        );
        let smaller = Pixels::of(&Picture::new(&grid, placement).largest_side(0));
        // 64 pixels of 141 cells are a little more than the map.
        let svg = Picture::new(&grid, placement).largest_side(0).svg();
        assert!(svg.contains("width=\"64\" height=\"1\" viewBox=\"0 0 9024 141\""), "{svg}");
        assert!(svg.contains("width=\"9024\" height=\"141\" preserve"), "{svg}");
        assert_eq!(smaller.width, 9000_u32.div_ceil(9000_u32.div_ceil(64)) + 2 * MARGIN);
    }
}

#[test]
fn a_vertex_is_a_square_around_its_place() {
    let grid = Grid::from_fn(4, 3, |_, _| false).expect("it is small");
    for (placement, low) in KINDS.into_iter().zip([40, 20]) {
        let pixels = Pixels::of(&Picture::new(&grid, placement).open([Vertex::new(1, 1)]));
        let colored = |x: u32, y: u32| {
            let [r, _, b] = pixels.at(MARGIN + x, MARGIN + y);
            r > b.saturating_add(60)
        };
        let found: Vec<_> = (0..120).filter(|&y| colored(low + 5, y)).collect();
        assert!(found.iter().copied().eq(low..low + 40), "{found:?}");
        let found: Vec<_> = (0..160).filter(|&x| colored(x, low + 5)).collect();
        assert!(found.iter().copied().eq(low..low + 40), "{found:?}");
    }
}

/// The darkness of a field's color.
fn darkness(pixels: &Pixels, at: (u32, u32)) -> u32 {
    let [r, g, b] = pixels.at(at.0, at.1).map(u32::from);
    1000 - (2 * r + 7 * g + b) / 10
}

#[test]
fn a_field_grows_darker_with_its_value() {
    let grid = Grid::from_fn(30, 6, |x, y| (x, y) == (7, 3)).expect("it is small");
    for placement in KINDS {
        let value = |at: Vertex| match (at.x, at.y) {
            (_, 0) => None,
            (_, 1) => Some(f64::NAN),
            (_, 2) => Some(f64::INFINITY),
            (x, _) => Some(f64::from(x) * 1e3 - 7.0),
        };
        let pixels = Pixels::of(&Picture::new(&grid, placement).field(value));
        let shades: Vec<_> =
            (8..30).map(|x| darkness(&pixels, (MARGIN + x * 40 + 3, MARGIN + 5 * 40 - 7))).collect();
        assert!(shades.is_sorted() && shades.first() < shades.last(), "{shades:?}");
        assert_eq!(pixels.at(MARGIN + 70, MARGIN + 10), WHITE);
        let (x, y) = middle(7, 3, 40);
        assert_eq!(pixels.at(x, y), [0x3d, 0x44, 0x4d]);
    }
}

/// The PNG files inside of an SVG file.
fn embedded(svg: &str) -> Vec<Pixels> {
    let letters = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let files = svg.split("href=\"data:image/png;base64,").skip(1);
    let files = files.map(|rest| rest.split('"').next().expect("it ends"));
    let decode = |text: &str| {
        let mut bits = text.bytes().filter(|&c| c != b'=').flat_map(|c| {
            let value = letters.iter().position(|&letter| letter == c).expect("it is base64");
            (0..6).rev().map(move |bit| value >> bit & 1 == 1)
        });
        let mut bytes = Vec::new();
        loop {
            let byte: Vec<bool> = bits.by_ref().take(8).collect();
            if byte.len() < 8 {
                return bytes;
            }
            bytes.push(byte.iter().fold(0, |byte, &bit| byte << 1 | u8::from(bit)));
        }
    };
    files.map(|text| Pixels::decode(&decode(text))).collect()
}

#[test]
fn many_colors_in_svg_are_pixels() {
    let grid = Grid::from_fn(120, 50, |x, y| (x + y) % 7 == 0).expect("it is small");
    for placement in KINDS {
        let value = |at: Vertex| grid.is_free(at.x, at.y).then(|| f64::from(at.x));
        let svg = Picture::new(&grid, placement).field(value).svg();
        let [colors] = &embedded(&svg)[..] else { panic!("one file is embedded") };
        let extra = u32::from(placement == PlacementKind::Corner);
        assert_eq!((colors.width, colors.height), (120 + extra, 50 + extra));
        for (pixel, index) in colors.rgba.iter().zip(0..) {
            let (x, y) = (index % colors.width, index / colors.width);
            let opacity = if grid.is_free(x as i32, y as i32) { 255 } else { 0 };
            assert_eq!(pixel[3], opacity, "vertex ({x}, {y})");
        }
    }
}

#[test]
fn obstacles_of_long_outlines_are_pixels_in_svg() {
    let rng = &mut Rng::new(5);
    let grid = noise(rng, 700, 900, 50);
    let svg = Picture::new(&grid, PlacementKind::Center).path("", [(0.0, 0.0), (600.0, 800.0)]).svg();
    assert!(svg.len() < 300_000, "{}", svg.len());
    let [base] = &embedded(&svg)[..] else { panic!("one file is embedded") };
    assert_eq!((base.width, base.height), (700, 900));
    for (y, x) in (0..900).flat_map(|y| (0..700).map(move |x| (y, x))) {
        assert_eq!(base.at(x, y) == WALL, grid.is_blocked(x as i32, y as i32), "cell ({x}, {y})");
    }
    // Few obstacles are outlines, however large the map is.
    let rooms = Grid::from_fn(2000, 2000, |x, y| (x % 100 == 0 || y % 100 == 0) && (x + y) % 100 > 5);
    let svg = Picture::new(&rooms.expect("it is small"), PlacementKind::Corner).svg();
    assert!(embedded(&svg).is_empty() && svg.len() < 100_000, "{}", svg.len());
}

#[test]
fn odd_maps_and_layers_have_pictures() {
    let sizes = [(1, 1), (1, 70), (70, 1), (32_768, 1), (1, 5000), (3, 2)];
    for ((width, height), placement) in sizes.into_iter().flat_map(|size| KINDS.map(|kind| (size, kind))) {
        for blocked in [false, true] {
            let grid = Grid::from_fn(width, height, |_, _| blocked).expect("it is a size");
            let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e308, -1e308, -0.5, 0.0, 2.0];
            let points = odd.iter().flat_map(|&x| [1e308, f64::NAN, 0.5].map(|y| (x, y)));
            // Few pixels a cell: it is quicker.
            let plain =
                Picture::new(&grid, placement).largest_side(if width + height > 100 { 5000 } else { 200 });
            let full = plain
                .clone()
                .field(|at| Some(odd[(at.x + at.y) as usize % odd.len()]))
                .expanded([(0, 0), (i32::MIN, i32::MAX), (5, 0)].map(Vertex::from))
                .open([Vertex::new(-1, -1)])
                .path("", [])
                .path("one point", [(0.5, 0.5)])
                .path("odd points", points)
                .start((i32::MAX, i32::MIN))
                .goal((0, 0))
                .radius(if width > 1000 { 3.0 } else { 1e9 })
                .caption("a caption that is longer than the narrow map is wide, and so has several lines");
            let flat = plain.clone().field(|_| Some(7.0)).radius(f64::NAN).goal((0, 0)).start((0, 0));
            for picture in [plain, full, flat] {
                let pixels = Pixels::of(&picture);
                assert!(pixels.width.max(pixels.height) <= 5000 + 2 * MARGIN);
                let svg = picture.svg();
                assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
                assert_eq!(svg.matches("<svg").count(), svg.matches("</svg>").count());
            }
        }
    }
}

#[test]
fn files_are_written_by_the_end_of_their_names() {
    let folder = tempfile::tempdir().expect("there is room");
    let grid = map("..\n.#");
    let picture = Picture::new(&grid, PlacementKind::Center);
    for (name, begin) in [("a.png", &b"\x89PNG"[..]), ("b.svg", b"<svg"), ("c.PNG", b"\x89PNG")] {
        let path = folder.path().join(name);
        picture.write_to(&path).expect("it can be written");
        assert!(fs::read(path).expect("it is there").starts_with(begin), "{name}");
    }
    for name in ["d", "d.jpg", ".png"] {
        let error = picture.write_to(folder.path().join(name)).expect_err("it is no known name");
        assert!(matches!(error, PictureError::Extension { .. }), "{error}");
        assert!(error.to_string().contains("expected a name that ends in .png or .svg"), "{error}");
    }
    let error = picture.write_to(folder.path().join("none/a.png")).expect_err("there is no such folder");
    assert!(error.to_string().contains("none/a.png: there is no folder "), "{error}");
}

#[test]
fn each_start_and_each_goal_has_a_badge() {
    let grid = Grid::from_fn(30, 20, |_, _| false).expect("a small grid");
    let picture = Picture::new(&grid, PlacementKind::Center).starts([(1, 1), (20, 4), (9, 9)]).goals([
        (5, 15),
        (20, 4),
        (25, 15),
    ]);
    let svg = picture.svg();
    // Two signs of the legend: it names each kind once.
    assert_eq!(svg.matches("class=\"badge\"").count(), 3 + 2 + 2, "{svg}");
    let [start, goal] = ["start", "goal"].map(|name| svg.matches(&format!(">{name}<")).count());
    assert_eq!((start, goal), (1, 1), "{svg}");
}
