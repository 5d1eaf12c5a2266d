//! libFuzzer's lines, such as
//! `#2048 NEW cov: 812 ft: 1733 corp: 101/9Kb lim: 21 exec/s: 1024 rss: 60Mb L: 17/21 MS: 2 …`.

use std::time::Duration;

use super::record::Turn;

/// The sum of the lines so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Log {
    executions: u64,
    edges: u64,
    features: u64,
    inputs: u64,
    /// When an edge was new.
    last_new: Duration,
    /// Whether the inputs to begin with have been run.
    is_ready: bool,
    tail: Vec<String>,
}

/// The lines that are kept for a message.
const TAIL: usize = 12;

impl Log {
    /// Reads a line that came after so long.
    pub(super) fn line(&mut self, line: &str, after: Duration) {
        if self.tail.len() == TAIL {
            self.tail.remove(0);
        }
        self.tail.push(line.to_owned());
        if let Some(count) = line.strip_prefix("stat::number_of_executed_units:") {
            self.executions = count.trim().parse().unwrap_or(self.executions);
        }
        let Some((count, rest)) = line.strip_prefix('#').and_then(|line| line.split_once(['\t', ' '])) else {
            return;
        };
        let Ok(executions) = count.parse() else { return };
        self.executions = self.executions.max(executions);
        let mut words = rest.split_whitespace();
        let event = words.next().unwrap_or_default();
        let words: Vec<&str> = words.collect();
        let after_word = |name: &str| {
            let at = words.iter().position(|word| *word == name)?;
            words.get(at + 1)?.split('/').next()?.parse::<u64>().ok()
        };
        let edges = after_word("cov:").unwrap_or(self.edges);
        if edges > self.edges || !self.is_ready {
            self.last_new = after;
        }
        self.is_ready |= event == "INITED";
        self.edges = self.edges.max(edges);
        self.features = self.features.max(after_word("ft:").unwrap_or(0));
        self.inputs = after_word("corp:").unwrap_or(self.inputs);
    }

    /// Whether no edge was new for so long.
    pub(super) fn is_quiet_for(&self, quiet: Duration, now: Duration) -> bool {
        self.is_ready && now.saturating_sub(self.last_new) >= quiet
    }

    pub(super) fn tail(&self) -> String {
        self.tail.join("\n")
    }

    pub(super) fn turn(&self, took: Duration, found: usize) -> Turn {
        Turn {
            executions: self.executions,
            hours: took.as_secs_f64() / 3600.0,
            edges: self.edges,
            features: self.features,
            inputs: self.inputs,
            quiet_minutes: took.saturating_sub(self.last_new).as_secs_f64() / 60.0,
            found: found as u64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_counted_and_silence_is_measured() {
        let mut log = Log::default();
        let seconds = Duration::from_secs;
        log.line("INFO: Seed: 1", seconds(0));
        log.line("#2\tINITED cov: 12 ft: 13 corp: 1/1b exec/s: 0 rss: 30Mb", seconds(1));
        log.line(
            "#2048\tNEW    cov: 812 ft: 1733 corp: 101/9Kb lim: 21 exec/s: 1024 rss: 60Mb L: 17/21",
            seconds(60),
        );
        log.line("#4096\tREDUCE cov: 812 ft: 1740 corp: 101/8Kb lim: 21 exec/s: 1024 rss: 60Mb", seconds(90));
        log.line(
            "#9000\tpulse  cov: 812 ft: 1740 corp: 102/8Kb lim: 21 exec/s: 1024 rss: 60Mb",
            seconds(150),
        );
        assert!(log.is_quiet_for(seconds(90), seconds(150)) && !log.is_quiet_for(seconds(91), seconds(150)));
        log.line("stat::number_of_executed_units: 9500", seconds(180));
        let turn = log.turn(seconds(180), 1);
        assert_eq!((turn.executions, turn.edges, turn.features, turn.inputs), (9500, 812, 1740, 102));
        assert_eq!((turn.quiet_minutes, turn.hours, turn.found), (2.0, 0.05, 1));
    }
}
