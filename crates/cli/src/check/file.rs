//! Files with paths: the lines of `mediant run --format jsonl`, or CSV.

use std::{
    fs::{self, File},
    io::{self, Read},
    path::{Path, PathBuf},
};

use mediant::{K, Point, Setup};
use mediant_formats::{MAX_FILE_BYTES, ReadError};
use serde::{Deserialize, de::IgnoredAny};
use serde_json::Value;

use crate::{
    args::Place,
    edit::{EditCells, EditLine, json_problem},
    failure::Failure,
};

/// An entry of a file; their order counts.
#[derive(Debug)]
pub(crate) enum Entry {
    /// A run begins, with the map as it was read.
    Run,
    /// An edit of the map, for the paths after it, with its line.
    Edit(usize, EditCells),
    Path(Listed),
}

/// A path of a file.
#[derive(Debug)]
pub(crate) struct Listed {
    /// The index of its query; 0 for CSV.
    pub(crate) index: usize,
    pub(crate) waypoints: Waypoints,
    /// Its cost in the file, of a run on costs.
    pub(crate) cost: Option<f64>,
    /// The setup in the line of its run, if there is one.
    pub(crate) said: Option<RunSetup>,
}

/// The waypoints of a path.
#[derive(Debug)]
pub(crate) enum Waypoints {
    /// Points.
    Points(Vec<Point>),
    /// Places as on the command line, in the world if the arguments are in meters; each with its line.
    Places(Vec<(usize, Place)>),
}

/// The setup in the first line of a run, which all its paths share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RunSetup {
    pub(crate) setup: Setup,
    /// The neighborhood whose moves make the segments of the paths.
    pub(crate) over: K,
    /// Whether each path is on the ground of its start.
    pub(crate) grounds: bool,
    /// Whether its paths have costs.
    pub(crate) has_costs: bool,
}

/// The lines of a run that are read; other keys are for others.
#[derive(Debug, Deserialize)]
#[serde(tag = "type", rename_all = "lowercase")]
enum Line {
    Run(RunLine),
    Edit(EditLine),
    Query {
        index: usize,
        #[serde(default)]
        path: Vec<Point>,
        #[serde(default)]
        cost: Option<f64>,
    },
    #[serde(other)]
    Other,
}

#[derive(Debug, Deserialize)]
struct RunLine {
    engine: String,
    k: Value,
    placement: String,
    corners: String,
    gap: String,
    #[serde(default)]
    smooth: bool,
    #[serde(default)]
    grounds: bool,
    #[serde(default)]
    costs: Option<IgnoredAny>,
}

impl RunLine {
    /// The setup in the line; the error is in words.
    fn setup(&self) -> Result<RunSetup, String> {
        let k = self.k.as_str().map_or_else(|| self.k.to_string(), str::to_owned);
        let rule = match (self.placement.as_str(), k.as_str()) {
            ("corner", _) => self.gap.clone(),
            (_, "any") => format!("center-{}", self.gap),
            _ => self.corners.clone(),
        };
        let setup = format!("{}:{k}:{rule}", self.engine).parse::<Setup>();
        let setup = setup.map_err(|error| format!("the run: {error}"))?;
        let over = if self.smooth { K::Any } else { setup.paths() };
        Ok(RunSetup { setup, over, grounds: self.grounds, has_costs: self.costs.is_some() })
    }
}

/// Reads a file with paths; `-` is stdin.
pub(crate) fn read(path: &Path) -> Result<Vec<Entry>, Failure> {
    parse(&bytes(path)?, path)
}

/// Reads the bytes of a file with paths.
pub(crate) fn parse(bytes: &[u8], path: &Path) -> Result<Vec<Entry>, Failure> {
    let is_json = bytes.iter().find(|byte| !byte.is_ascii_whitespace()) == Some(&b'{');
    let mut entries = Vec::new();
    let read = if is_json { jsonl(bytes, &mut entries) } else { csv(bytes, &mut entries) };
    read.map_err(|(line, problem)| Failure::PathFile { path: shown(path), line, problem })?;
    let has_path = entries.iter().any(|entry| matches!(entry, Entry::Path(_)));
    if has_path { Ok(entries) } else { Err(Failure::NoPaths { path: shown(path) }) }
}

/// The name of a file for messages.
pub(crate) fn shown(path: &Path) -> PathBuf {
    if path == Path::new("-") { PathBuf::from("stdin") } else { path.to_owned() }
}

/// The content of a file. Pipes are welcome: paths are often piped.
pub(crate) fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    let owned = || path.to_owned();
    let unreadable = |source: io::Error| match source.kind() {
        io::ErrorKind::NotFound => ReadError::Missing { path: owned() },
        _ => ReadError::Unreadable { path: shown(path), source },
    };
    let mut bytes = Vec::new();
    let read = if path == Path::new("-") {
        io::stdin().lock().take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes)
    } else {
        if fs::metadata(path).map_err(unreadable)?.is_dir() {
            return Err(ReadError::Directory { path: owned() }.into());
        }
        let file = File::open(path).map_err(unreadable)?;
        file.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes)
    };
    read.map_err(unreadable)?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(ReadError::TooLarge { path: shown(path) }.into());
    }
    Ok(bytes)
}

/// A line, from 1, and its error.
type Wrong = (usize, String);

/// The lines that are not empty, with their numbers from 1.
pub(crate) fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let lines = bytes.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii).zip(1..);
    lines.filter(|(line, _)| !line.is_empty()).map(|(line, number)| (number, line))
}

/// Reads the lines of a run; of several runs in one file, each counts for the queries after it.
fn jsonl(bytes: &[u8], entries: &mut Vec<Entry>) -> Result<(), Wrong> {
    let mut said = None;
    for (number, line) in lines(bytes) {
        let wrong = |problem: String| (number, problem);
        let line: Line = serde_json::from_slice(line).map_err(|error| {
            wrong(format!("expected a line of `mediant run --format jsonl`: {}", json_problem(&error)))
        })?;
        match line {
            Line::Run(run) => {
                said = Some(run.setup().map_err(wrong)?);
                entries.push(Entry::Run);
            }
            Line::Edit(_) if said.is_some_and(|said: RunSetup| said.grounds) => {
                return Err(wrong(
                    "a run with --grounds has no edits: they do not say which ground".to_owned(),
                ));
            }
            Line::Edit(edit) => entries.push(Entry::Edit(number, edit.cells().map_err(wrong)?)),
            Line::Query { index, path, cost } if !path.is_empty() => {
                let waypoints = Waypoints::Points(path);
                let cost = cost.filter(|_| said.is_some_and(|said| said.has_costs));
                entries.push(Entry::Path(Listed { index, waypoints, cost, said }));
            }
            Line::Query { .. } | Line::Other => {}
        }
    }
    Ok(())
}

/// Reads the rows of one path.
fn csv(bytes: &[u8], entries: &mut Vec<Entry>) -> Result<(), Wrong> {
    let mut columns = (0, 1);
    let mut places = Vec::new();
    for ((number, line), row) in lines(bytes).zip(0..) {
        let wrong = || {
            let found: String = String::from_utf8_lossy(line).chars().take(40).collect();
            (
                number,
                format!(
                    "expected x,y in the columns {} and {}, found `{found}`",
                    columns.0 + 1,
                    columns.1 + 1
                ),
            )
        };
        // A byte order mark, which spreadsheets write.
        let text = std::str::from_utf8(line).map_err(|_| wrong())?.trim_start_matches('\u{feff}');
        let cells: Vec<&str> = text.split(',').map(|cell| cell.trim().trim_matches('"')).collect();
        let named = |name: &str| cells.iter().position(|cell| cell.eq_ignore_ascii_case(name));
        if let (0, Some(header)) = (row, named("x").zip(named("y"))) {
            columns = header;
            continue;
        }
        let value =
            |column: usize| cells.get(column)?.parse::<f64>().ok().filter(|number| number.is_finite());
        let (x, y) = value(columns.0).zip(value(columns.1)).ok_or_else(wrong)?;
        places.push((number, place(x, y)));
    }
    if !places.is_empty() {
        let waypoints = Waypoints::Places(places);
        entries.push(Entry::Path(Listed { index: 0, waypoints, cost: None, said: None }));
    }
    Ok(())
}

/// Two numbers as a place: whole ones can be a vertex.
fn place(x: f64, y: f64) -> Place {
    let whole = |number: f64| (f64::from(number as i32) == number).then_some(number as i32);
    whole(x).zip(whole(y)).map_or(Place::Point(x, y), |at| Place::Vertex(at.into()))
}

#[cfg(test)]
mod tests {
    use mediant::Vertex;

    use super::*;

    fn places(text: &str) -> Vec<Place> {
        let mut paths = Vec::new();
        csv(text.as_bytes(), &mut paths).expect(text);
        match paths.remove(0) {
            Entry::Path(Listed { waypoints: Waypoints::Places(places), .. }) => {
                places.into_iter().map(|(_, place)| place).collect()
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_header_may_name_the_columns() {
        let expected = [Place::Vertex(Vertex::new(3, 4)), Place::Vertex(Vertex::new(-5, 4))];
        for text in [
            "3,4\n-5,4\n",
            "x,y\n3,4\n\n-5,4",
            "\u{feff}X, Y\r\n3, 4\r\n-5, 4\r\n",
            "y,t,x\n4,9,3\n4,,-5\n",
            "\"x\",\"y\"\n3.000e+00,4.0\n-5.0,4\n",
        ] {
            assert_eq!(places(text), expected, "{text}");
        }
        assert_eq!(places("0.5,2\n"), [Place::Point(0.5, 2.0)]);
    }

    #[test]
    fn the_line_of_a_wrong_row_is_named() {
        for (text, line) in [("x,y\n1,2\n3\n", 3), ("1,2\nx,y\n", 2), ("nan,1\n", 1), ("\n\nhello", 3)] {
            assert_eq!(csv(text.as_bytes(), &mut Vec::new()).unwrap_err().0, line, "{text}");
        }
    }

    #[test]
    fn paths_at_any_angle_are_over_no_finite_k() {
        let said = |engine: &str, k: &str, placement: &str, smooth: bool| {
            let line = RunLine {
                engine: engine.to_owned(),
                k: serde_json::from_str(k).expect("JSON"),
                placement: placement.to_owned(),
                corners: "one".to_owned(),
                gap: "closed".to_owned(),
                smooth,
                grounds: false,
                costs: None,
            };
            line.setup()
        };
        let five: K = "5".parse().expect("a k");
        let plain = said("jps", "5", "center", false).expect("a run");
        assert_eq!((plain.setup.to_string().as_str(), plain.over), ("jps:5:one", five));
        assert_eq!(said("jps", "5", "corner", true).expect("a run").over, K::Any);
        assert_eq!(said("theta", "5", "center", false).expect("a run").over, K::Any);
        let anya = said("anya", "\"any\"", "corner", false).expect("a run");
        assert_eq!((anya.setup.to_string().as_str(), anya.over), ("anya:any:closed", K::Any));
        assert_eq!(said("anya", "5", "corner", false).expect("a run").over, five);
        assert!(said("warp", "3", "center", false).is_err());
    }
}
