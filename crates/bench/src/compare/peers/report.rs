//! The words that a program takes and says.
//!
//! It is called as `PROGRAM … MAP SCENARIO PASSES SECONDS`. MAP is a MovingAI map of `.` and `@` alone,
//! SCENARIO has its queries; between corners, (x, y) is the corner at the top left of that cell. The program
//! prepares what it needs, and answers all queries in their order, with their paths, pass after pass: PASSES
//! times after the first pass, and until SECONDS have passed since the end of the first. It prints
//!
//! * `prepared SECONDS BYTES`, if it prepares something: the time, and the memory or the size of the file;
//! * `pass MICROSECONDS` for each pass, the time of all queries together; the first one finds empty caches;
//! * `cost LENGTH` for each query in its order: the length of its path in cells, or -1 if it found none.
//!
//! A program that cannot do a map ends with another status than 0; the last line of its errors says why.

use std::{fmt, str::FromStr};

/// The answer of a program on a map.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in super::super) struct Report {
    /// The seconds of its preparation, and the bytes that it takes.
    pub(super) prepared: Option<(f64, Option<f64>)>,
    /// The microseconds of each pass.
    pub(super) passes: Vec<f64>,
    /// The length of each path.
    pub(super) costs: Vec<f64>,
}

impl FromStr for Report {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut report = Self::default();
        for line in text.lines() {
            let mut words = line.split_whitespace();
            let kind = words.next();
            let number = |word: Option<&str>| {
                let number =
                    word.and_then(|word| word.parse::<f64>().ok()).filter(|number| number.is_finite());
                number.ok_or_else(|| format!("expected a number in the line `{line}`"))
            };
            match kind {
                Some("prepared") => {
                    let seconds = number(words.next())?;
                    let bytes = words.next().map(|word| number(Some(word))).transpose()?;
                    report.prepared = Some((seconds, bytes));
                }
                Some("pass") => report.passes.push(number(words.next())?),
                Some("cost") => report.costs.push(number(words.next())?),
                _ => {
                    return Err(format!(
                        "expected a line that begins by prepared, pass or cost, found `{line}`"
                    ));
                }
            }
        }
        Ok(report)
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((seconds, bytes)) = self.prepared {
            write!(f, "prepared {seconds}")?;
            bytes.map_or(Ok(()), |bytes| write!(f, " {bytes}"))?;
            writeln!(f)?;
        }
        self.passes.iter().try_for_each(|pass| writeln!(f, "pass {pass}"))?;
        self.costs.iter().try_for_each(|cost| writeln!(f, "cost {cost}"))
    }
}

impl Report {
    /// Whether it has a warm pass, and a length for each query.
    ///
    /// # Errors
    /// In words, what it lacks.
    pub(super) fn check(self, queries: usize) -> Result<Self, String> {
        if self.passes.len() < 2 {
            return Err(format!("expected a first pass and others, found {}", self.passes.len()));
        }
        if self.costs.len() != queries {
            return Err(format!("expected {queries} lines of cost, found {}", self.costs.len()));
        }
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::Report;

    #[test]
    fn a_report_is_read_as_it_is_written() {
        let text = "prepared 0.5 1200\npass 12.5\npass 3\ncost 4\ncost -1\n";
        let report: Report = text.parse().unwrap();
        assert_eq!(report.prepared, Some((0.5, Some(1200.0))));
        assert_eq!(report.to_string(), text);
        assert_eq!(report.clone().check(2), Ok(report.clone()));
        assert_eq!(report.check(3), Err("expected 3 lines of cost, found 2".to_owned()));
        let without: Report = "pass 1\nprepared 2\n".parse().unwrap();
        assert_eq!(without.prepared, Some((2.0, None)));
        assert!(without.check(0).unwrap_err().contains("a first pass and others, found 1"));
    }

    #[test]
    fn other_lines_are_refused() {
        for line in ["hello", "pass", "pass x", "pass inf", "cost NaN", "prepared 1 y", ""] {
            let read = format!("pass 1\n{line}\ncost 1\n").parse::<Report>();
            assert!(read.unwrap_err().contains(&format!("`{line}`")), "{line}");
        }
    }
}
