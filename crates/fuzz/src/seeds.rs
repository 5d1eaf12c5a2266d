//! Inputs to begin with: valid ones, which the library itself writes, and those that were kept.

use std::{fs, io::Cursor, path::PathBuf};

use mediant_formats::{GeoTiffOptions, Raster, RasterFormat, RosSettings, Samples, Surface, TiffCompression};
use mediant_grid::AsciiMap;
use mediant_oracle::Rng;

use crate::{Target, indexes::SAVED};

/// The inputs of a target that are kept in `corpus`, each with its file's name, sorted.
#[must_use]
pub fn kept(target: &Target) -> Vec<(String, Vec<u8>)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target.name);
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut files: Vec<(String, Vec<u8>)> = entries
        .filter_map(|entry| Some((entry.file_name().into_string().ok()?, fs::read(entry.path()).ok()?)))
        .collect();
    files.sort();
    files
}

/// Valid inputs of a target.
#[must_use]
pub fn seeds(target: &Target) -> Vec<Vec<u8>> {
    match target.name {
        "map" => maps(),
        "picture" => pictures(),
        "ros" => ros(),
        "raster" => rasters().into_iter().map(|raster| [&[0], &raster[..]].concat()).collect(),
        "scenario" => scenarios(),
        "questions" => questions(),
        "words" => words(),
        "serialized" => serialized(),
        "index" => (0..).zip(SAVED.iter()).map(|(at, saved)| [&[at], saved.payload()].concat()).collect(),
        "index-file" => {
            (0..).zip(SAVED.iter()).map(|(at, saved)| [&[at][..], &saved.whole()].concat()).collect()
        }
        "sequence" => {
            let between_centers = (24..40).map(|number| [vec![BETWEEN_CENTERS], drawn(number)].concat());
            (0..24).map(drawn).chain([PAST_A_GAP.to_vec()]).chain(between_centers).collect()
        }
        // Any bytes are numbers, or a program.
        _ => (0..24).map(drawn).collect(),
    }
}

/// The first byte of a program between centers, at any angle.
const BETWEEN_CENTERS: u8 = 208;

/// A program of points: lines between the middles of two cells pass a closed gap, others end there, and
/// another way leads around. Few lines that are drawn meet a gap exactly.
const PAST_A_GAP: &[u8] = &[
    224, 0o123, 0, 0, 0, 0, 0, 0, 1, 0b10_0000, 1, 0, 0, 0, 3, 129, 131, 131, 133, 131, 133, 129, 131, 129,
    131, 1, 2, 1, 2, 131, 133,
];

/// Bytes of a seed.
fn drawn(seed: u64) -> Vec<u8> {
    let mut rng = Rng::new(seed);
    (0..40 + 4 * seed).map(|_| rng.bits() as u8).collect()
}

fn text(parts: &[&str]) -> Vec<u8> {
    parts.concat().into_bytes()
}

fn maps() -> Vec<Vec<u8>> {
    let rows = "type octile\nheight 3\nwidth 5\nmap\n..T.@\n.WWS.\n.G.O.\n";
    vec![
        text(&["\0", rows]),
        text(&["W T\0", rows]),
        text(&["\0", &rows.replace('\n', "\r\n")]),
        text(&["\0..#\n.s.\n#.g\n"]),
        text(&["abc xyz\0type octile\nwidth 3\nheight 1\nmap\nabz\n"]),
    ]
}

fn pictures() -> Vec<Vec<u8>> {
    let grid = AsciiMap::parse("..#.\n#...\n..##\n").expect("a map").grid;
    let raster = Raster::from_grid(&grid).expect("a picture");
    let gray = Raster::from_fn(3, 2, 1000, |x, y| 300 * x + 100 * y).expect("a picture");
    let mut all = vec![text(&["P1\n# a comment\n3 2\n0 1 0\n1 0 1\n"]), text(&["P2 2 2 15\n1 15\n7 0\n"])];
    for (raster, format) in [RasterFormat::Png, RasterFormat::Pgm, RasterFormat::Pbm]
        .into_iter()
        .flat_map(|format| [(&raster, format), (&gray, format)])
    {
        let mut bytes = Vec::new();
        raster.write(format, &mut bytes).expect("memory");
        all.push(bytes);
    }
    all
}

fn ros() -> Vec<Vec<u8>> {
    let settings = RosSettings::new("a.pgm", 0.05, [-1.0, 2.5, 0.0]).to_yaml();
    let braces = "{image: 'a.pgm', resolution: 0.05, # [m\norigin: [-1, \"2\", 0], negate: 1, nested: {a: [b]},\
                  \"occupied_thresh\":0.65,\nfree_thresh : 0.196}\n";
    let blocks = "image: a.pgm\nmode: raw\nresolution: 1e-1\norigin:\n- 1\n- -2.5\n- 0.5\nnegate: 0\n\
                  occupied_thresh: 0.65\nfree_thresh: 0.25\n";
    [settings.as_str(), braces, blocks].map(|yaml| text(&[yaml, "\0P2 3 1 255\n0 205 254\n"])).to_vec()
}

fn rasters() -> Vec<Vec<u8>> {
    let floats =
        Surface::new(3, 2, Samples::F32(vec![1.0, 2.5, -3.0, 0.0, f32::NAN, 6.0])).expect("six numbers");
    let bytes = Surface::new(3, 2, Samples::U8(vec![1, 2, 3, 4, 5, 255])).expect("six numbers");
    let bytes = bytes.with_no_data(Some(255.0));
    let mut all = vec![
        text(&[
            "ncols 3\nnrows 2\nxllcorner 10\nyllcorner -5\ncellsize 2.5\nNODATA_value -1\n1 2 3\n4 -1 6\n",
        ]),
        text(&["P2 2 2 4000\n1 4000\n7 0\n"]),
    ];
    for surface in [floats, bytes] {
        let mut npy = Vec::new();
        surface.to_npy(&mut npy).expect("memory");
        all.push(npy);
        for compression in [TiffCompression::None, TiffCompression::Deflate, TiffCompression::Lzw] {
            let mut tiff = Cursor::new(Vec::new());
            let options = GeoTiffOptions { compression, ..GeoTiffOptions::default() };
            surface.to_geotiff(&mut tiff, &options).expect("memory");
            all.push(tiff.into_inner());
        }
    }
    all
}

fn scenarios() -> Vec<Vec<u8>> {
    let patches = "type patch\npatches 2\npatch 0\nheight 1\nwidth 2\nmap\n@.\npatch 1\nheight 4\nwidth 4\nmap\n\
                   ....\n....\n....\n....\n";
    vec![
        text(&["version 1\n0\tmaps/yard.map\t3\t2\t0\t0\t2\t1\t2.41421\n1 a.map 8 8 1 2 3 4 5.5\n"]),
        text(&[
            patches,
            "\0version 2\npatch a.patch\nwidth 4\nheight 4\nP 1 0 0\nQ 0 0 3 3 4.24\nP 0 1 1\nQ 0 0 1 0 -1\n",
        ]),
    ]
}

fn questions() -> Vec<Vec<u8>> {
    let run = "{\"type\":\"run\",\"engine\":\"jps\",\"k\":3,\"placement\":\"center\",\"corners\":\"never\",\
               \"gap\":\"open\"}\n";
    let edit = "{\"type\":\"edit\",\"x\":1,\"y\":2,\"rows\":[\"#.\",\"..\"],\"more\":true}\n";
    let path = "{\"type\":\"query\",\"index\":0,\"path\":[[0,0],[1,1]],\"cost\":1.5}\n";
    let query = "{\"type\":\"query\",\"start\":[0,0],\"goal\":[8,5]}\n";
    let costs = "{\"type\":\"edit\",\"x\":0,\"y\":0,\"costs\":[[1.5,null]]}\n";
    [
        ("\0", [run, edit, path]),
        ("\0", ["x,y\n", "3,4\n-5,4\n", "0.5,2\n"]),
        ("\u{1}", ["x1,y1,x2,y2\n", "0,0,8,5\n", "1,1,3,4\n"]),
        ("\u{2}", [query, edit, query]),
        ("\u{2}", [edit, costs, query]),
    ]
    .map(|(what, lines)| [what, &lines.concat()].concat().into_bytes())
    .to_vec()
}

fn words() -> Vec<Vec<u8>> {
    let one = |what: u8, word: &str| [&[what], word.as_bytes()].concat();
    let mut all: Vec<Vec<u8>> = [
        (0, "inf"),
        (0, "12"),
        (1, "never"),
        (2, "closed"),
        (3, "centers"),
        (4, "jps-plus"),
        (5, "auto"),
        (6, "all"),
        (7, "10MB"),
        (8, "0.65"),
        (9, "astar, center, corners never, k = 3"),
        (10, "timeout"),
        (11, "tobler"),
        (11, "langmuir"),
    ]
    .map(|(what, word)| one(what, word))
    .to_vec();
    let call = "k=5\nplacement=corner\ngap=closed\nengine=subgoal\nmemory=1MB\nmax-cost=12.5\nsmooth=taut\n";
    all.extend([12, 28, 44].map(|what| one(what, call)));
    all.push(one(
        12,
        "neighbors=16\ncorners=one\nheuristic=octile\nlevels=2\nside=3\nnearest=true\ntolerance=2\n",
    ));
    all
}

fn serialized() -> Vec<Vec<u8>> {
    let forms = [
        "3",
        "3",
        "[3,-1]",
        "[2.5,-0.25]",
        r#"{"x":4,"y":1,"width":3,"height":2}"#,
        r#"{"start":[0,0],"goal":[7,2]}"#,
        r#"{"center":"never"}"#,
        r#""one""#,
        r#""open""#,
        r#""corner""#,
        r#"{"k":3,"placement":"center","corners":"never"}"#,
        "[[0,0],[3,0],[5,2]]",
        r#"{"engine":"astar","k":3,"placement":"center","corners":"never"}"#,
        r#""jps""#,
        r#""auto""#,
        r#""all""#,
        r#""10MB""#,
    ];
    let mut all = Vec::new();
    for (what, form) in (0_u8..).zip(forms) {
        all.push([&[what], form.as_bytes()].concat());
        let value: serde_json::Value = serde_json::from_str(form).expect("JSON");
        let mut cbor = vec![(128..=255).find(|byte| byte % 17 == what).unwrap_or(128)];
        ciborium::into_writer(&value, &mut cbor).expect("memory");
        all.push(cbor);
    }
    all
}
