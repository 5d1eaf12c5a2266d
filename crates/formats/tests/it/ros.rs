//! ROS maps: the text of the YAML file, occupancies, saved maps, and the message of every error.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::fs;

use mediant_formats::{
    Fraction, MapOptions, Raster, ReadError, RosError, RosMap, RosMode, RosSettings, RosVersion, Unknown,
    WriteError, read_map,
};
use mediant_grid::Vertex;
use mediant_oracle::{Rng, random_grid, seeds};

const YAML: &str = "image: a.pgm\nresolution: 0.05\norigin: [-1, 2.5, 0]\nnegate: 0\noccupied_thresh: 0.65\n\
                    free_thresh: 0.196\n";

const IN_BRACES: &str = "{image: a.pgm, resolution: 0.05, origin: [-1, 2.5, 0], negate: 0, \
                         occupied_thresh: 0.65, free_thresh: 0.196}\n";

fn parse(yaml: &str) -> Result<RosSettings, RosError> {
    RosSettings::parse(yaml.as_bytes())
}

/// The settings of [`YAML`] with another line for one of its keys.
fn with(line: &str) -> String {
    let key = line.split(':').next().unwrap_or_default().trim_matches([' ', '"']);
    let kept: String =
        YAML.lines().filter(|kept| !kept.starts_with(key)).map(|kept| format!("{kept}\n")).collect();
    format!("{line}\n{kept}")
}

#[test]
fn forms_of_yaml() {
    let expected = parse(YAML).unwrap();
    assert_eq!(expected, RosSettings::new("a.pgm", 0.05, [-1.0, 2.5, 0.0]));
    let forms = [
        with("origin: [ -1.0 , 2.5,0.0, ] # a comment"),
        with("origin: [-1,\n  2.5, # y\n  0]"),
        with("origin:\n- -1\n- 2.5\n\n- 0"),
        with("origin:   # below\n  - -1.0\n  - '2.5'\n  # yaw\n  - 0.0"),
        with("origin:\n  [-1, 2.5, 0]"),
        with("image: 'a.pgm'"),
        with("\"image\" : \"a.p\\x67m\" # c"),
        with("image:\n  a.pgm"),
        with("image: a.pgm#"),
        with("resolution: 5e-2"),
        with("resolution: +.05"),
        with("negate: false"),
        with("negate: No"),
        with("negate: OFF"),
        with("mode: trinary"),
        YAML.lines().map(|line| format!("  {line}\n")).collect(),
        with("origin:\n- -1\n- 2.5\n- 0").lines().map(|line| format!(" {line}\n")).collect(),
        format!(
            "---\n# here\n{}",
            with("origin: [-1,\n 2.5,\n 0]").replace('\n', "\n  ").replace("origin", "  origin")
        ),
        IN_BRACES.to_owned(),
        format!("# {{\n%YAML 1.2\n--- {}\n...\nimage: b.pgm", IN_BRACES.replace(", ", ",\n")),
        IN_BRACES.replace("a.pgm", "\"a.pgm\"").replace("{", "{nested: {image: [b, '}'], c: d}, \"#\":1, "),
        IN_BRACES
            .replace("0.05", "0.05 # 5 cm, [not {more}\n")
            .replace("[-1", "[-1 # x ]\n")
            .replace("}", ",}"),
        IN_BRACES.replace(": ", " : ").replace("image :", "'image':").replace('\n', "\r\n"),
        with("occupied_thresh: 0.65000000000000002"),
        with(
            "frame_id: map\nnested:\n  image: b.pgm\n  list:\n  - 1\n- { x: [1, 2\n}\nother: |\n  text: here",
        ),
        with("# only a comment: here"),
        format!("%YAML 1.2\n---\n{YAML}...\nimage: twice.pgm\n"),
        format!("\u{feff}--- # begin\n{YAML}"),
        YAML.replace('\n', "\r\n"),
        YAML.trim_end().to_owned(),
    ];
    for form in forms {
        let read = parse(&form).unwrap_or_else(|error| panic!("{error}\n{form}"));
        let image = if form.contains("pgm#") { "a.pgm#" } else { "a.pgm" };
        assert_eq!(read, RosSettings { image: image.to_owned(), ..expected.clone() }, "{form}");
    }
    assert!(parse(&with("negate: 1")).unwrap().negate && parse(&with("negate: True")).unwrap().negate);
    let scale = parse(&with("mode: \"scale\"")).unwrap();
    assert_eq!(scale.mode, RosMode::Scale);
    let spaced = parse(&with("image: my maps/it's one.pgm")).unwrap();
    assert_eq!(spaced.image, "my maps/it's one.pgm");
}

#[test]
fn lines_that_are_none() {
    let cases = [
        ("image a.pgm", 1, "image a.pgm"),
        ("image:a.pgm", 1, "image:a.pgm"),
        ("{image a.pgm}", 1, "image a.pgm}"),
        ("{image:a.pgm}", 1, "image:a.pgm}"),
        ("{image: a.pgm", 1, "image: a.pgm"),
        ("{image: a.pgm\n,\n: 1}", 3, ": 1}"),
        ("{image: a.pgm} x", 1, "x"),
        ("{image: ]}", 1, "image: ]}"),
        ("{\"image\": \"a}", 1, "\\\"image\\\": \\\"a}"),
        // Keys that are not indented alike.
        ("  image: a.pgm\nresolution: 1", 2, "resolution: 1"),
        ("  image: a.pgm\n resolution: 1", 2, " resolution: 1"),
        ("\timage: a.pgm", 1, "\\timage: a.pgm"),
        ("image: a.pgm\n---\nimage: b.pgm", 2, "---"),
        // A line that begins so is no item of a list, and no key.
        ("origin:\n- 1\n-2\n- 3", 3, "-2"),
    ];
    for (yaml, line, found) in cases {
        let message = format!(
            "line {line}: expected `key: value`, found `{found}`; write each key on a line of its own, with a \
             colon and a space, all indented alike"
        );
        assert_eq!(parse(yaml).expect_err(yaml).to_string(), message);
    }
    let error = RosSettings::parse(b"image: a.pgm\nresolution: \xff\n").expect_err("no text");
    assert_eq!(error, RosError::NoText { line: 2 });
}

#[test]
fn values_that_are_none() {
    let keys = [
        ("image", "the name of a picture", "map.pgm"),
        ("resolution", "more than 0 meters a pixel", "0.05"),
        ("origin", "a list of three numbers, x, y and yaw", "[-10.0, -10.0, 0.0]"),
        ("negate", "0 or 1", "0"),
        ("mode", "`trinary`, `scale` or `raw`", "trinary"),
        ("free_thresh", "a number of 0 to 1", "0.196"),
        ("occupied_thresh", "a number of 0 to 1", "0.65"),
    ];
    let values: [(&str, &[&str]); 7] = [
        ("image", &["", "\"\"", "\"a", "'a", "\"a\\q\"", "&a b", "a: b", "[a]", "- a", "a\n  b"]),
        ("resolution", &["-0.05", "0", "nan", ".inf", "1e999", "5 cm", "", "0x1", "1_0", "[1]"]),
        (
            "origin",
            &[
                "[-1, 2]",
                "[1, 2, 3, 4]",
                "[1, 2, 3",
                "1, 2, 3",
                "[[1, 2], 3]",
                "[1, 2, x]",
                "",
                "[]",
                "[1,,2,3]",
            ],
        ),
        ("negate", &["maybe", "tRUE", "2", "-1", "", "é"]),
        ("mode", &["Trinary", "SCALE", ""]),
        ("free_thresh", &["1.5", "-0.1", "nan", "", "50%"]),
        ("occupied_thresh", &["-0.1", "65"]),
    ];
    for ((key, expected, example), (_, values)) in keys.into_iter().zip(values) {
        for value in values {
            let found = match *value {
                "" => "nothing".to_owned(),
                value => format!("`{}`", value.escape_default().to_string().replace("\\u{e9}", "\\xc3\\xa9")),
            };
            let message = format!(
                "line 1: expected for `{key}` {expected}, found {found}; write `{key}: {example}`, for example"
            )
            .replace("\\'", "'");
            let error = parse(&with(&format!("{key}: {value}"))).expect_err(value);
            assert_eq!(error.to_string().replace("\\'", "'"), message);
        }
    }
}

#[test]
fn keys_that_do_not_belong_together() {
    for (free, occupied) in [("0.65", "0.65"), ("0.7", "0.65")] {
        let yaml = YAML.replace("0.196", free);
        let message = format!(
            "line 6: expected a `free_thresh` below `occupied_thresh`, found {free} and {occupied}; 0.196 and 0.65 \
             are usual"
        );
        assert_eq!(parse(&yaml).expect_err(free).to_string(), message);
    }
    let twice = format!("{YAML}negate: 0\n");
    assert_eq!(
        parse(&twice).expect_err("twice").to_string(),
        "line 7: the key `negate` is in line 4 already; remove one of them"
    );
    for line in YAML.lines() {
        let key = line.split(':').next().unwrap();
        let message = parse(&YAML.replace(&format!("{line}\n"), "")).expect_err(key).to_string();
        assert!(
            message.starts_with(&format!("line 6: the file ends without the key `{key}`; add")),
            "{message}"
        );
    }
    assert_eq!(
        parse("").expect_err("empty").to_string(),
        "line 1: the file ends without the key `free_thresh`; add `free_thresh: 0.196`"
    );
}

#[test]
fn settings_are_read_as_written() {
    let names = [
        "a.pgm",
        "true",
        "12",
        "a b.png",
        "it's.pgm",
        "\"q\".pgm",
        "a\\b",
        "no",
        "~",
        "ü.pgm",
        "a\nb",
        "- x",
        "a: b",
        "/m/a.pgm",
        "x#y.pgm",
        " ",
    ];
    for seed in seeds(500) {
        let mut rng = Rng::new(seed);
        let mut number = || f64::from_bits(rng.bits());
        let numbers: Vec<f64> =
            std::iter::repeat_with(&mut number).filter(|number| number.is_finite()).take(4).collect();
        let parts = [rng.below(500_000_000), 500_000_000 + rng.below(500_000_001)];
        let [free, occupied] = parts.map(|parts| Fraction::new(parts, 1_000_000_000).unwrap());
        let settings = RosSettings {
            image: (*rng.pick(&names).unwrap()).to_owned(),
            resolution: numbers[0].abs().max(f64::MIN_POSITIVE),
            origin: [numbers[1], numbers[2], numbers[3]],
            occupied_thresh: occupied,
            free_thresh: free,
            negate: rng.chance(50),
            mode: *rng.pick(&[RosMode::Trinary, RosMode::Scale, RosMode::Raw]).unwrap(),
        };
        let yaml = settings.to_yaml();
        assert_eq!(parse(&yaml), Ok(settings), "seed {seed}:\n{yaml}");
    }
}

#[test]
fn saved_and_read_again() {
    let folder = tempfile::tempdir().unwrap();
    for seed in seeds(60) {
        let (grid, kind) = random_grid(seed);
        for image in ["m.pgm", "m.png", "m"] {
            let path = folder.path().join("m.yaml");
            let map = RosMap::from_grid(&grid, image, 0.05, [1.0, -2.0, 0.25]).unwrap();
            map.save(&path).unwrap();
            let read = RosMap::read(&path).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(read, map, "seed {seed}, {kind}, {image}");
            let source = read_map(&path, &MapOptions::default()).unwrap();
            assert_eq!((source.grid, source.frame), (grid.clone(), Some(map.frame())), "seed {seed}, {kind}");
        }
    }
    let (grid, _) = random_grid(1);
    for image in ["m.yaml", "m.pbm"] {
        let map = RosMap::from_grid(&grid, image, 0.05, [0.0; 3]).unwrap();
        let error = map.save(folder.path().join("m.yaml")).expect_err(image);
        assert!(
            error.to_string().ends_with(": no name for the picture of a ROS map; end it in .pgm"),
            "{error}"
        );
    }
    let map = RosMap::from_grid(&grid, "no/m.pgm", 0.05, [0.0; 3]).unwrap();
    let error = map.save(folder.path().join("n.yaml")).expect_err("no folder");
    assert!(error.to_string().contains("m.pgm: there is no folder "), "{error}");
    assert!(!folder.path().join("n.yaml").exists());
    // If one of the two cannot be written, the other one stays as it was.
    let picture = folder.path().join("kept.pgm");
    fs::write(&picture, "older").unwrap();
    fs::create_dir(folder.path().join("kept.yaml")).unwrap();
    let map = RosMap::from_grid(&grid, "kept.pgm", 0.05, [0.0; 3]).unwrap();
    let error = map.save(folder.path().join("kept.yaml")).expect_err("a directory");
    assert!(matches!(error, WriteError::NotRegular { .. }), "{error}");
    assert_eq!(fs::read(&picture).unwrap(), b"older");
}

/// The map of a row of shades of 255, with other settings.
fn row(shades: &[u32], change: impl FnOnce(&mut RosSettings)) -> RosMap {
    let raster = Raster::from_fn(shades.len() as u32, 1, 255, |x, _| shades[x as usize]).unwrap();
    let mut settings = RosSettings::new("a.pgm", 0.05, [0.0; 3]);
    change(&mut settings);
    RosMap::new(settings, raster).unwrap()
}

/// The occupancies of the first row by the rules of ROS 1.
fn occupancies(map: &RosMap) -> Vec<i64> {
    occupancies_of(map, RosVersion::Ros1)
}

fn occupancies_of(map: &RosMap, ros: RosVersion) -> Vec<i64> {
    (0..map.raster().width()).map(|x| map.occupancy(x, 0, ros).map_or(-1, i64::from)).collect()
}

fn blocked(map: &RosMap, options: &MapOptions) -> Vec<bool> {
    let grid = map.to_grid(options);
    (0..grid.width() as i32).map(|x| grid.is_blocked(x, 0)).collect()
}

#[test]
fn modes() {
    let shades = [0, 89, 90, 205, 206, 254];
    // Occupied to more than 0.65 means a shade below 89.25; free to less than 0.196, one above 205.02.
    assert_eq!(occupancies(&row(&shades, |_| {})), [100, 100, -1, -1, 0, 0]);
    let negated = row(&shades, |settings| settings.negate = true);
    assert_eq!(occupancies(&negated), [0, -1, -1, 100, 100, 100]);
    let raw = row(&[0, 1, 100, 101, 255], |settings| {
        settings.mode = RosMode::Raw;
        settings.negate = true;
    });
    assert_eq!(occupancies(&raw), [0, 1, 100, -1, -1]);
    // 25.5 of 255, and 25.245.
    let fine = Raster::from_fn(2, 1, 1000, |x, _| [100, 99][x as usize]).unwrap();
    let settings = RosSettings { mode: RosMode::Raw, ..RosSettings::new("a.pgm", 0.05, [0.0; 3]) };
    assert_eq!(occupancies(&RosMap::new(settings, fine).unwrap()), [26, 25]);
    let scale = |free: &str, occupied: &str| {
        row(&[0, 51, 52, 128, 153, 254, 255], |settings| {
            settings.mode = RosMode::Scale;
            settings.free_thresh = free.parse().unwrap();
            settings.occupied_thresh = occupied.parse().unwrap();
        })
    };
    // Occupied to 204/255 = 0.8 is 100 of 100 here, and to 102/255 = 0.4 it is 0.
    assert_eq!(occupancies(&scale("0.4", "0.8")), [100, 100, 99, 25, 0, 0, 0]);
    assert_eq!(occupancies(&scale("0", "1")), [100, 80, 80, 50, 40, 0, 0]);
    // A half is rounded to the even neighbor: 1/2 − 1/8 and 1/2 − 3/8 of 100 between 0.25 and 0.75 …
    let half = Raster::from_fn(2, 1, 400, |x, _| [199, 197][x as usize]).unwrap();
    let mut settings = RosSettings::new("a.pgm", 0.05, [0.0; 3]);
    (settings.mode, settings.free_thresh) = (RosMode::Scale, Fraction::HALF);
    settings.occupied_thresh = Fraction::ONE;
    // … here 0.5 and 1.5 of 100.
    assert_eq!(occupancies(&RosMap::new(settings, half).unwrap()), [0, 2]);
}

/// [`row`] with these thresholds.
fn between(shades: &[u32], free: &str, occupied: &str) -> RosMap {
    row(shades, |settings| {
        settings.free_thresh = free.parse().unwrap();
        settings.occupied_thresh = occupied.parse().unwrap();
    })
}

#[test]
fn ros_2_counts_what_is_at_a_threshold() {
    let read = |map: &RosMap| occupancies_of(map, RosVersion::Ros2);
    assert_eq!(read(&between(&[255, 254, 1, 0], "0.0", "1.0")), [0, -1, -1, 100]);
    assert_eq!(occupancies(&between(&[255, 0], "0.0", "1.0")), [-1, -1]);
    // 1 − 153/255 is 0.4, but less in single precision; 1 − 51/255 is 0.8, and so it is there.
    assert_eq!(read(&between(&[153, 152], "0.1", "0.4")), [-1, 100]);
    assert_eq!(read(&between(&[51, 52], "0.1", "0.8")), [100, -1]);
    assert_eq!(read(&between(&[204, 203], "0.2", "0.8")), [0, -1]);
    let mut scale = between(&[255, 192, 191, 128, 64, 63, 0], "0.25", "0.75").settings().clone();
    scale.mode = RosMode::Scale;
    let raster = Raster::from_fn(5, 1, 255, |x, _| [192, 191, 127, 64, 63][x as usize]).unwrap();
    assert_eq!(read(&RosMap::new(scale.clone(), raster.clone()).unwrap()), [0, 0, 50, 100, 100]);
    scale.negate = true;
    assert_eq!(read(&RosMap::new(scale, raster).unwrap()), [100, 100, 50, 0, 0]);
    let raw = row(&[0, 100, 101, 127, 128, 255], |settings| settings.mode = RosMode::Raw);
    assert_eq!(read(&raw), [0, 100, -1, -1, -1, -1]);
}

/// The map of a row of colours, red, green, blue and opacity, from a PNG.
fn colours(pixels: &[[u8; 4]], change: impl FnOnce(&mut RosSettings)) -> RosMap {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, pixels.len() as u32, 1);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().unwrap().write_image_data(pixels.as_flattened()).unwrap();
    let mut settings = RosSettings::new("a.png", 0.05, [0.0; 3]);
    change(&mut settings);
    RosMap::new(settings, Raster::parse(&file).unwrap()).unwrap()
}

#[test]
fn ros_2_reads_the_luma_of_colours_and_opacity_only_as_unknown() {
    let read = |map: &RosMap| occupancies_of(map, RosVersion::Ros2);
    let gray = |shade: u8, opacity: u8| [shade, shade, shade, opacity];
    let opaque = colours(&[gray(254, 255), gray(205, 255), gray(0, 255), gray(254, 255)], |_| {});
    assert_eq!(read(&opaque), [0, -1, 100, 0]);
    assert_eq!(blocked(&opaque, &MapOptions::default()), [false, true, true, false]);
    // By ROS 1 the opacity of 255 is a channel of the mean, in which 205 becomes 217.5.
    assert_eq!(occupancies(&opaque), [0, 0, 100, 0]);
    let options = MapOptions { ros: RosVersion::Ros1, ..MapOptions::default() };
    assert_eq!(blocked(&opaque, &options), [false, false, true, false]);
    assert_eq!(read(&colours(&[gray(254, 254), gray(0, 0), gray(0, 255)], |_| {})), [-1, -1, 100]);
    let wide = |settings: &mut RosSettings| settings.free_thresh = "0.25".parse().unwrap();
    // 225, 76, 149 and 29 of 255.
    let colored = [[255, 255, 0, 255], [255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255]];
    assert_eq!(read(&colours(&colored, wide)), [0, 100, -1, 100]);
    // Of samples of 16 bits the luma is taken first, here 21,535 of 65,535, and then cut to 8 bits.
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 1, 1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Sixteen);
    let samples = [0x80ff_u16, 0x40ff, 0x40ff].map(u16::to_be_bytes);
    encoder.write_header().unwrap().write_image_data(samples.as_flattened()).unwrap();
    let settings = RosSettings { mode: RosMode::Raw, ..RosSettings::new("a.png", 0.05, [0.0; 3]) };
    let (luma, map) =
        ((306 * 0x80ff + 718 * 0x40ff) >> 10, RosMap::new(settings, Raster::parse(&file).unwrap()).unwrap());
    assert_eq!((read(&map), luma / 257), (vec![83], 83));
    let raw = colours(&[[200, 10, 30, 3], [10, 200, 30, 255]], |settings| settings.mode = RosMode::Raw);
    assert_eq!(read(&raw), [69, -1]);
}

#[test]
fn exactly_at_the_thresholds() {
    // 35 of 100 is occupied to 0.65, 80 to 0.2: neither is beyond its threshold, which floating point might
    // find.
    let raster = Raster::from_fn(4, 1, 100, |x, _| [34, 35, 80, 81][x as usize]).unwrap();
    let mut settings = RosSettings::new("a.pgm", 0.05, [0.0; 3]);
    settings.free_thresh = "0.2".parse().unwrap();
    assert_eq!(occupancies(&RosMap::new(settings, raster).unwrap()), [100, -1, -1, 0]);
}

#[test]
fn grids_of_occupancies() {
    let map = row(&[0, 100, 254], |_| {});
    assert_eq!(blocked(&map, &MapOptions::default()), [true, true, false]);
    let free = MapOptions { unknown: Unknown::Free, ..MapOptions::default() };
    assert_eq!(blocked(&map, &free), [true, false, false]);
    // The file says what is negated.
    assert_eq!(blocked(&map, &MapOptions { invert: true, ..free.clone() }), [true, false, false]);
    let raw = row(&[50, 51, 100, 200], |settings| settings.mode = RosMode::Raw);
    assert_eq!(blocked(&raw, &MapOptions::default()), [false, true, true, true]);
    assert_eq!(blocked(&raw, &free), [false, true, true, false]);
    let cautious = MapOptions { threshold: "0.51".parse().unwrap(), ..free };
    assert_eq!(blocked(&raw, &cautious), [true, true, true, false]);
}

#[test]
fn grids_follow_occupancies() {
    for seed in seeds(400) {
        let mut rng = Rng::new(seed);
        let white = *rng.pick(&[1, 100, 255, 765, 0xffff]).unwrap();
        let mut raster = Raster::from_fn(40, 3, white, |_, _| rng.below(white + 1)).unwrap();
        if rng.chance(50) {
            raster = raster.with_opacity(255, |_, _| [0, 254, 255, 255][rng.below(4) as usize]).unwrap();
        }
        let mut settings = RosSettings::new("a.png", 0.05, [0.0; 3]);
        settings.mode = *rng.pick(&[RosMode::Trinary, RosMode::Scale, RosMode::Raw]).unwrap();
        settings.negate = rng.chance(50);
        let map = RosMap::new(settings, raster).unwrap();
        let threshold = Fraction::new(rng.below(101), 100).unwrap();
        let unknown = *rng.pick(&[Unknown::Blocked, Unknown::Free]).unwrap();
        let ros = *rng.pick(&[RosVersion::Ros1, RosVersion::Ros2]).unwrap();
        let options = MapOptions { threshold, unknown, ros, invert: rng.chance(50), ..MapOptions::default() };
        let grid = map.to_grid(&options);
        let limit = i64::from(100 * (threshold.parts().1 - threshold.parts().0));
        for (x, y) in (0..40).flat_map(|x| (0..3).map(move |y| (x, y))) {
            let expected = map.occupancy(x, y, ros).map_or(unknown == Unknown::Blocked, |p| {
                i64::from(p) * i64::from(threshold.parts().1) > limit
            });
            assert_eq!(grid.is_blocked(x as i32, y as i32), expected, "seed {seed}, ({x}, {y})");
        }
    }
}

#[test]
fn the_first_row_is_the_highest() {
    let raster = Raster::parse(b"P1 2 3  10 00 00").unwrap();
    let map = RosMap::new(RosSettings::new("a.pgm", 2.0, [0.0; 3]), raster).unwrap();
    let grid = map.to_grid(&MapOptions::default());
    let cell = map.frame().cell_at(1.0, 5.0).unwrap();
    assert_eq!(cell, Vertex::new(0, 0));
    assert!(grid.is_blocked(cell.x, cell.y) && grid.free_cells() == 5);
}

#[test]
fn messages_of_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.yaml");
    let read = || {
        let error = RosMap::read(&path).expect_err("an error");
        (error.to_string().replace(&format!("{}/", folder.path().display()), ""), error)
    };
    assert_eq!(read().0, "a.yaml: no such file; check the path and the folder that you are in");
    fs::write(&path, YAML).unwrap();
    let (message, error) = read();
    assert_eq!(
        message,
        "a.yaml: the picture that the key `image` names: a.pgm: no such file; check the path \
         and the folder that you are in"
    );
    assert!(matches!(error, ReadError::RosImage { .. }));
    fs::write(folder.path().join("a.pgm"), "P5 1 1 255 ").unwrap();
    assert_eq!(
        read().0,
        "a.yaml: the picture that the key `image` names: a.pgm: expected 1 bytes of pixels \
         after the header, found 0; is the file cut short, or a side in the header too large?"
    );
    fs::write(&path, YAML.replace("[-1, ", "[")).unwrap();
    let (message, error) = read();
    assert!(message.starts_with("a.yaml: line 3: expected for `origin`"), "{message}, {error:?}");
    let (raster, mut settings) =
        (Raster::parse(b"P1 1 1 0").unwrap(), RosSettings::new("a.pgm", -1.0, [0.0; 3]));
    let error = RosMap::new(settings.clone(), raster.clone()).expect_err("resolution");
    assert_eq!(
        error.to_string(),
        "the place of the map: expected a resolution of more than 0 meters a cell, found -1; write for instance 0.05"
    );
    settings.free_thresh = Fraction::ONE;
    let error = RosMap::new(settings, raster).expect_err("thresholds");
    assert!(error.to_string().starts_with("settings: expected a `free_thresh` below"), "{error}");
}
