//! Files that other programs wrote, against what these programs read in them.

use std::{collections::HashMap, fs};

use mediant_formats::{Surface, read_surface, surface_size};

use super::{files, options};

#[test]
fn as_others_read_them() {
    let all = fs::read_to_string(files()[0].with_file_name("numbers.txt")).unwrap();
    let known: HashMap<&str, &str> =
        all.split("\n\n").map(|text| text.strip_prefix("file ").unwrap().split_once('\n').unwrap()).collect();
    assert_eq!(known.len(), files().len());
    for path in files() {
        let name = path.file_name().unwrap().to_str().unwrap();
        let text = known[name];
        let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split(' ').collect()).collect();
        let surface = read_surface(&path, &options(&path)).unwrap_or_else(|error| panic!("{error}"));
        let sides: Vec<u32> = lines[0].iter().map(|side| side.parse().unwrap()).collect();
        assert_eq!([surface.width(), surface.height()], sides[..], "{name}");
        assert_eq!(surface_size(&path).unwrap(), (sides[0], sides[1]), "{name}");
        let pair = |words: &[&str]| match words[1] {
            "none" => None,
            x => Some((x.parse().unwrap(), words[2].parse().unwrap())),
        };
        assert_eq!(surface.cell_size(), pair(&lines[1]), "{name}");
        assert_eq!(surface.georeference().lower_left(), pair(&lines[2]), "{name}");
        assert_eq!(surface.is_in_degrees(), lines[3][1] == "yes", "{name}");
        for (y, row) in (0..).zip(&lines[4..]) {
            assert_eq!(row.len(), sides[0] as usize, "{name}");
            for (x, word) in (0..).zip(row) {
                let expected = if *word == "none" { None } else { Some(word.parse().unwrap()) };
                assert_eq!(surface.get(x, y), expected, "{name}: cell ({x}, {y})");
            }
        }
        assert_eq!(lines.len(), sides[1] as usize + 4, "{name}");
        assert_eq!(Surface::size(&fs::read(&path).unwrap()).unwrap(), (sides[0], sides[1]), "{name}");
    }
}
