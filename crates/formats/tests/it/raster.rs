//! Pictures: what they say, what is written is read again, and the message of every error.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use mediant_formats::{Fraction, MapOptions, Raster, RasterError, RasterFormat, Unknown};
use mediant_grid::Grid;
use mediant_oracle::{Rng, random_grid, seeds};

use crate::png_chunks;

const FORMATS: [RasterFormat; 5] =
    [RasterFormat::PlainPbm, RasterFormat::PlainPgm, RasterFormat::Pbm, RasterFormat::Pgm, RasterFormat::Png];

fn written(raster: &Raster, format: RasterFormat) -> Vec<u8> {
    let mut file = Vec::new();
    raster.write(format, &mut file).unwrap();
    file
}

fn parse(bytes: &[u8]) -> Raster {
    Raster::parse(bytes).unwrap_or_else(|error| panic!("{error}"))
}

/// The shades of a picture as text, and white.
fn shades(raster: &Raster) -> String {
    let row =
        |y| (0..raster.width()).map(|x| format!("{} ", raster.shade(x, y).unwrap())).collect::<String>();
    let rows: String = (0..raster.height()).map(|y| row(y) + "| ").collect();
    format!("{rows}of {}", raster.white())
}

/// The grid as a row of characters for each row.
fn drawn(grid: &Grid) -> String {
    let row = |y| (0..grid.width() as i32).map(move |x| if grid.is_free(x, y) { '.' } else { '#' });
    (0..grid.height() as i32).flat_map(|y| row(y).chain(['/'])).collect()
}

#[test]
fn maps_in_every_format() {
    for seed in seeds(300) {
        let (grid, kind) = random_grid(seed);
        let raster = Raster::from_grid(&grid).unwrap();
        for format in FORMATS {
            let again = parse(&written(&raster, format)).to_grid(&MapOptions::default());
            assert_eq!(again, grid, "seed {seed}, {kind}, {format:?}");
        }
    }
}

/// A picture with a white that some format has, with opacity or not.
fn random_raster(rng: &mut Rng) -> Raster {
    let (width, height) = (1 + rng.below(40), 1 + rng.below(20));
    let white = *rng.pick(&[1, 3, 15, 100, 255, 765, 1000, 0xffff, Raster::MAX_WHITE]).unwrap();
    let raster = Raster::from_fn(width, height, white, |_, _| rng.below(white + 1)).unwrap();
    let opaque = *rng.pick(&[0, 1, 255, 0xffff]).unwrap();
    if opaque == 0 {
        return raster;
    }
    raster.with_opacity(opaque, |_, _| rng.below(u32::from(opaque) + 1) as u16).unwrap()
}

#[test]
fn pictures_in_every_format() {
    for seed in seeds(300) {
        let mut rng = Rng::new(seed);
        let raster = random_raster(&mut rng);
        let context = format!("seed {seed}, white {}, opaque {:?}", raster.white(), raster.opaque());
        for format in [RasterFormat::PlainPgm, RasterFormat::Pgm, RasterFormat::Png] {
            let again = parse(&written(&raster, format));
            assert_eq!((again.width(), again.height()), (raster.width(), raster.height()), "{context}");
            let with_opacity = raster.opaque().filter(|_| format == RasterFormat::Png);
            assert_eq!(again.opaque().is_some(), with_opacity.is_some(), "{context}, {format:?}");
            let exact = match format {
                RasterFormat::Png => again.white().is_multiple_of(raster.white()),
                _ => raster.white() <= 0xffff,
            };
            for (x, y) in (0..raster.width()).flat_map(|x| (0..raster.height()).map(move |y| (x, y))) {
                let [new, old] = [&again, &raster].map(|raster| i64::from(raster.shade(x, y).unwrap()));
                let [new_white, old_white] = [again.white(), raster.white()].map(i64::from);
                // In units of 1 / (old · new); half a step of the new shades is what rounding may change.
                let off = (new * old_white - old * new_white).abs();
                assert!(off <= if exact { 0 } else { old_white / 2 }, "{context}, {format:?}, ({x}, {y})");
                if let (Some(old), Some(new)) = (with_opacity, again.opaque()) {
                    let [is, was] = [&again, &raster].map(|raster| u64::from(raster.opacity(x, y).unwrap()));
                    let parts = (is * u64::from(old), was * u64::from(new));
                    assert_eq!(parts.0, parts.1, "{context}, {format:?}, opacity of ({x}, {y})");
                }
            }
        }
    }
}

#[test]
fn forms_of_pgm_and_pbm() {
    let cases: [(&[u8], &str); 14] = [
        (b"P1 3 2 010110", "1 0 1 | 0 0 1 | of 1"),
        (b"P1\n# by hand\n3 # wide\n2\n0 1 0\n1 1 0 # end\n", "1 0 1 | 0 0 1 | of 1"),
        (b"P2\n2 2\n15\n0 15\n7 8\n", "0 15 | 7 8 | of 15"),
        (b"P2\r\n2 1\r\n65535\r\n65535 00000000000000000000007\r\n", "65535 7 | of 65535"),
        (b"P2#c\n2#c\r1#c\n9#c\n1#c\n2#c", "1 2 | of 9"),
        (b"P4 3 2 \x5f\xc0", "1 0 1 | 0 0 1 | of 1"),
        (b"P4\n9 1\n\x80\x7f", "0 1 1 1 1 1 1 1 1 | of 1"),
        (b"P5 2 1 255\n\x00\xff", "0 255 | of 255"),
        (b"P5 2 1 255\n\x00\xff\n \r\n", "0 255 | of 255"),
        (b"P5\n# CREATOR: map_saver.cpp 0.050 m/pix\n2 1\n255\n\n#", "10 35 | of 255"),
        (b"P5 2 1 255# the last word\n\x00\xff", "0 255 | of 255"),
        (b"P5 1 2 256 \x00\x09\x01\x00", "9 | 256 | of 256"),
        (b"P5 1 1 100 \x64", "100 | of 100"),
        (b"P5\x0b1\x0c1\t7\r\x05", "5 | of 7"),
    ];
    for (bytes, expected) in cases {
        assert_eq!(shades(&parse(bytes)), expected, "{}", bytes.escape_ascii());
    }
}

#[test]
fn written_text_and_bytes() {
    let raster = parse(b"P2 3 2 255  0 127 128  200 254 255");
    assert_eq!(written(&raster, RasterFormat::PlainPbm), b"P1\n3 2\n110\n000\n");
    assert_eq!(written(&raster, RasterFormat::Pbm), b"P4\n3 2\n\xc0\x00");
    assert_eq!(written(&raster, RasterFormat::Pgm), b"P5\n3 2\n255\n\x00\x7f\x80\xc8\xfe\xff");
    let wide = Raster::from_fn(100, 1, 1000, |x, _| 10 * x).unwrap();
    for format in [RasterFormat::PlainPbm, RasterFormat::PlainPgm] {
        let text = String::from_utf8(written(&wide, format)).unwrap();
        assert!(text.lines().all(|line| line.len() <= 70), "{text}");
        assert!(text.lines().any(|line| line.len() > 60), "{text}");
    }
    assert!(written(&wide, RasterFormat::Pgm).starts_with(b"P5\n100 1\n1000\n\0\0\0\x0a\0\x14"));
    assert_eq!(RasterFormat::of_path("a/b.PNG"), Some(RasterFormat::Png));
    assert_eq!(RasterFormat::of_path("a.pgm"), Some(RasterFormat::Pgm));
    assert_eq!(RasterFormat::of_path("a.pbm"), Some(RasterFormat::Pbm));
    assert_eq!(RasterFormat::of_path("pgm"), None);
}

#[test]
fn dark_is_blocked() {
    let raster = parse(b"P2 5 1 100  0 49 50 51 100");
    let grid = |options| drawn(&raster.to_grid(&options));
    let with =
        |threshold: &str| MapOptions { threshold: threshold.parse().unwrap(), ..MapOptions::default() };
    assert_eq!(grid(MapOptions::default()), "##.../");
    assert_eq!(grid(MapOptions { invert: true, ..MapOptions::default() }), "...##/");
    assert_eq!(grid(with("0")), "...../");
    assert_eq!(grid(with("0.500000001")), "###../");
    assert_eq!(grid(with("0.51")), "###../");
    assert_eq!(grid(with("1")), "####./");
    // One third of 255 is 85 and of 765 is 255, which no binary fraction is.
    let third = MapOptions { threshold: Fraction::new(1, 3).unwrap(), ..MapOptions::default() };
    assert_eq!(drawn(&parse(b"P2 2 1 255 84 85").to_grid(&third)), "#./");
}

#[test]
fn transparent_is_unknown() {
    let raster =
        parse(b"P2 6 1 1  0 1 0 1 0 1").with_opacity(255, |x, _| [0, 127, 128][x as usize / 2]).unwrap();
    let grid = |options| drawn(&raster.to_grid(&options));
    let free = MapOptions { unknown: Unknown::Free, ..MapOptions::default() };
    assert_eq!(grid(MapOptions::default()), "#####./");
    assert_eq!(grid(free.clone()), "....#./");
    assert_eq!(grid(MapOptions { invert: true, ..free }), ".....#/");
    let half = parse(b"P2 1 1 1  1").with_opacity(2, |_, _| 1).unwrap();
    assert_eq!(drawn(&half.to_grid(&MapOptions::default())), "./");
}

/// Bytes, and the message of their error up to `; `.
const CR_LF: &str = "the lines of the header end in CR LF, of which LF would be the first pixel";

const WRONG: [(&[u8], &str); 19] = [
    (b"", "expected a picture, PNG, PGM or PBM, found nothing"),
    (b"BM8", "expected a picture, PNG, PGM or PBM, found `BM8`"),
    (b"P6 1 1 255 abc", "expected a PGM or PBM (P1, P2, P4 or P5), found `P6`"),
    (b"P5", "line 1, column 3: expected the width, found the end of the file"),
    (b"P5\n# c\n3 -2", "line 3, column 3: expected the height, found `-2`"),
    (b"P5 3 2 0 ", "line 1, column 8: expected a maxval, the largest sample, of 1 to 65535, found `0`"),
    (
        b"P2 3 2 65536 ",
        "line 1, column 8: expected a maxval, the largest sample, of 1 to 65535, found `65536`",
    ),
    (b"P5 3 2 255", "line 1, column 11: expected white space after the header, found the end of the file"),
    (
        b"P5 0 2 255 ",
        "the picture is no map: a map of 0 columns and 2 rows: each side must have 1 to 32768 cells",
    ),
    (
        b"P5 99999999999999999999 2 255 ",
        "the picture is no map: a map of 18446744073709551615 columns and 2 rows: each side must have 1 to 32768 cells",
    ),
    (b"P4 32768 32768 ", "a picture of 32768 × 32768 pixels: expected at most 268435456 pixels in all"),
    (b"P5 3 2 255 abcde", "expected 6 bytes of pixels after the header, found 5"),
    (b"P5\r\n3 2\r\n255\r\nabcdef", CR_LF),
    (b"P4\r\n3 1\r\n\xe0\r\n", CR_LF),
    (b"P5 3 2 255 abcdefg", "expected the end of the file after 6 bytes of pixels, found 1 more"),
    (b"P5 3 1 100 abe", "pixel (2, 0): expected a sample of 0 to 100, found 101"),
    (b"P2 3 1 100\n1 2\n101", "line 3, column 1: expected a sample of 0 to 100, found `101`"),
    (b"P1 3 1 01", "expected 3 samples of pixels after the header, found 2"),
    (b"P1 3 1 0102", "expected the end of the file after 3 samples of pixels, found `2`"),
];

#[test]
fn messages() {
    for (bytes, expected) in WRONG {
        let message = Raster::parse(bytes).expect_err(expected).to_string();
        let (what, remedy) = message.split_once("; ").unwrap();
        assert_eq!(what, expected);
        assert!(remedy.len() > 20, "{message}");
    }
    assert_eq!(Raster::from_fn(1, 1, 0, |_, _| 0), Err(RasterError::White { found: 0 }));
    assert!(matches!(Raster::from_fn(0, 1, 1, |_, _| 0), Err(RasterError::Size { .. })));
}

#[test]
fn messages_of_png() {
    let png = written(&parse(b"P2 2 2 255 0 1 2 3"), RasterFormat::Png);
    let message = |bytes: &[u8]| Raster::parse(bytes).expect_err("damaged").to_string();
    let mut flipped = png.clone();
    flipped[17] ^= 1;
    assert!(message(&flipped).starts_with("the PNG cannot be read: CRC error"), "{}", message(&flipped));
    assert_eq!(message(&png[..20]), "the PNG cannot be read: the file ends early; save the picture anew");
    // Bytes after the last chunk are not the picture's.
    assert_eq!(shades(&parse(&[&png[..], b"more"].concat())), "0 1 | 2 3 | of 255");
    // Without its last chunk it is cut short, though all pixels are there.
    assert_eq!(message(&png[..png.len() - 12]), message(&png[..20]));
}

/// The decoder of 0.18.1 panics here.
#[test]
fn a_palette_with_a_part_of_a_colour() {
    let mut png = include_bytes!("../fixtures/pillow-palette4.png").to_vec();
    let at = png.windows(4).position(|name| name == b"PLTE").unwrap();
    let length = png[at - 1];
    png[at - 1] = length - 1;
    png.remove(at + 4 + usize::from(length) - 1);
    png_chunks::mend(&mut png);
    let error = Raster::parse(&png).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the PNG cannot be read: its palette of 38 bytes has a part of a colour, or too many; save the picture anew"
    );
}
