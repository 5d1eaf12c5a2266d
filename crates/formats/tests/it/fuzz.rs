//! Valid files mutated at random: parsing never panics, and what it accepts is written back byte for byte.

use mediant_formats::{DynamicEvent, DynamicScenario, MapFile, Patch, Scenario};

const ROUNDS: u64 = 20_000;
const SEED: u64 = 0x4d41_5046;

/// SplitMix64 (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

/// The text after one to four edits, each of which changes, removes, doubles or inserts bytes, or cuts off
/// the end.
fn mutated(random: &mut Random, text: &[u8]) -> Vec<u8> {
    const PIECES: [&[u8]; 16] = [
        b"\n",
        b"\r\n",
        b"\r",
        b"\t",
        b" ",
        b"\0",
        b"\xff",
        b"9",
        b"-",
        b"0",
        b"e",
        b".",
        b"@",
        b"99999999999",
        b"width 3\n",
        b"map\n",
    ];
    let mut text = text.to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(text.len());
        let end = (at + 1 + random.below(6)).min(text.len());
        let piece = PIECES[random.below(PIECES.len())];
        match random.below(6) {
            0 => drop(text.splice(at..end, piece.iter().copied())),
            1 => drop(text.splice(at..at, piece.iter().copied())),
            2 => drop(text.drain(at..end)),
            3 => drop(text.splice(at..at, text[at..end].to_vec())),
            4 if !text.is_empty() => text[at] = random.next() as u8,
            _ => text.truncate(text.len() - random.below(8).min(text.len())),
        }
    }
    text
}

fn rounds(texts: &[&str], mut check: impl FnMut(&[u8], &str) -> bool) {
    let mut random = Random(SEED);
    let mut accepted = 0;
    for round in 0..ROUNDS {
        let text = texts[random.below(texts.len())].as_bytes();
        let text = mutated(&mut random, text);
        let context = format!("seed {SEED:#x}, round {round}: {:?}", text.escape_ascii().to_string());
        accepted += u64::from(check(&text, &context));
    }
    // If nearly all were refused or accepted, the rounds would show nothing.
    assert!((ROUNDS / 50..ROUNDS / 2).contains(&accepted), "seed {SEED:#x}: {accepted} of {ROUNDS} accepted");
}

#[test]
fn mutated_maps() {
    let texts = [
        "type octile\nheight 3\nwidth 4\nmap\n..@T\nSWG.\n@@@.\n",
        "type octile\r\nwidth 2\r\nheight 2\r\nmap\r\n..\r\n@.\r\n\r\n",
        "type octile\nheight 1\nwidth 1\nmap\n.",
    ];
    rounds(&texts, |text, context| {
        let map = match MapFile::parse(text) {
            Ok(map) => map,
            Err(error) => {
                check_place(text, &error.to_string(), context);
                return false;
            }
        };
        assert_eq!(map.as_bytes(), text, "{context}");
        assert!(map.rows().all(|row| row.len() == map.width() as usize), "{context}");
        let grid = map.to_grid();
        let again = MapFile::parse(MapFile::from_grid(&grid).as_bytes()).expect(context);
        assert_eq!(again.to_grid(), grid, "{context}");
        true
    });
}

#[test]
fn mutated_scenarios() {
    let texts = [
        "version 1\n0\tmaps/a.map\t4\t3\t0\t0\t3\t2\t3.41421\n12\tmaps/a.map\t4\t3\t1\t1\t0\t0\t2\n",
        "version 1.0\r\n3 b.map 512 512 7 9 11 13 5.65\r\n",
        "version 1\n0\ta b.map\t4\t3\t0\t0\t3\t2\t3.41421356",
    ];
    rounds(&texts, |text, context| {
        let scenario = match Scenario::parse(text) {
            Ok(scenario) => scenario,
            Err(error) => {
                check_place(text, &error.to_string(), context);
                return false;
            }
        };
        assert_eq!(scenario.as_bytes(), text, "{context}");
        let written = Scenario::from_instances(scenario.instances().to_vec()).expect(context);
        let again = Scenario::parse(written.as_bytes()).expect(context);
        assert_eq!(again.instances(), scenario.instances(), "{context}");
        true
    });
}

#[test]
fn mutated_patches() {
    let texts = [
        "type patch\npatches 2\npatch 0\nheight 2\nwidth 3\nmap\n..@\nSW.\npatch 1\nheight 1\nwidth 1\nmap\nT\n",
        "type patch\r\npatches 1\r\n\r\npatch 0\r\nwidth 2\r\nheight 1\r\nmap\r\n.@\r\n\r\n",
        "type patch\npatches 0",
    ];
    rounds(&texts, |text, context| match Patch::parse_all(text) {
        Ok(patches) => {
            for patch in &patches {
                assert_eq!(patch.rows().len(), patch.height() as usize, "{context}");
                let cells: Vec<bool> = patch.rows().flatten().copied().collect();
                assert_eq!(Patch::new(patch.width(), cells), **patch, "{context}");
            }
            true
        }
        Err(error) => {
            check_place(text, &error.to_string(), context);
            false
        }
    });
}

#[test]
fn mutated_scenarios_of_maps_that_change() {
    let patches = b"type patch\npatches 2\npatch 0\nheight 2\nwidth 3\nmap\n..@\nSW.\npatch 1\nheight 1\nwidth 1\nmap\nT\n";
    let patches = Patch::parse_all(patches).expect("two patches");
    let texts = [
        "version 2\nheight 3\nwidth 4\ncost 1 octile\npatch a.patch\ncommands\nP 0 0 1 1\nQ 0 0 0 3 2 3.41\nP 7 1 3 2\n",
        "version 2\r\nwidth 4\r\nheight 3\r\npatch my a.patch\r\ncommands\r\nQ 0 0 0 -1 2\r\nP 0 1 3 2\r\n",
        "version 2\nheight 2\nwidth 3\ncost 2 moves octile\npatch a.patch\ncommands\nQ 1 0 0 2 1 9 -1",
    ];
    rounds(&texts, |text, context| match DynamicScenario::parse(text, &patches) {
        Ok(scenario) => {
            let size = (scenario.width(), scenario.height());
            assert!(!DynamicScenario::patch_file(text).expect(context).is_empty(), "{context}");
            for event in scenario.events() {
                let DynamicEvent::Patch(placed) = event else { continue };
                let at = placed.rectangle();
                assert!(at.x + at.width <= size.0 && at.y + at.height <= size.1, "{context}");
            }
            // Sides of any size may be stated, but here they are few digits.
            if size.0 < 1_000 && size.1 < 1_000 {
                let grid = scenario.grid();
                assert_eq!((grid.width(), grid.height()), size, "{context}");
            }
            true
        }
        Err(error) => {
            check_place(text, &error.to_string(), context);
            false
        }
    });
}

/// Checks that a message begins with a line and column of the file, or with those right behind its end.
fn check_place(text: &[u8], message: &str, context: &str) {
    let numbers = message.strip_prefix("line ").and_then(|rest| rest.split_once(", column "));
    let (line, rest) = numbers.expect(context);
    let line: usize = line.parse().expect(context);
    let column: usize = rest.split(':').next().and_then(|column| column.parse().ok()).expect(context);
    let lines: Vec<&[u8]> = text.split(|&byte| byte == b'\n').chain([&b""[..]]).collect();
    assert!((1..=lines.len()).contains(&line), "{context}: {message}");
    assert!((1..=lines[line - 1].len() + 1).contains(&column), "{context}: {message}");
}
