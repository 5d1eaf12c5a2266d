//! The counts of a part.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// The most mismatches that are kept in words; all are counted.
const KEPT: usize = 20;

/// The name of the count of mismatches.
pub(super) const WRONG: &str = "wrong";

/// The counts of a part, or of several, by name, and what was wrong.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Tally {
    counts: BTreeMap<String, u64>,
    wrong: Vec<String>,
    /// The sum of numbers that the answers decide.
    #[serde(default)]
    digest: u64,
}

impl Tally {
    /// Counts one more.
    pub(super) fn count(&mut self, name: &str) {
        self.count_many(name, 1);
    }

    pub(super) fn count_many(&mut self, name: &str, more: u64) {
        match self.counts.get_mut(name) {
            Some(count) => *count += more,
            None => _ = self.counts.insert(name.to_owned(), more),
        }
    }

    /// Counts a mismatch.
    pub(super) fn wrong(&mut self, what: String) {
        self.count(WRONG);
        if self.wrong.len() < KEPT {
            self.wrong.push(what);
        }
    }

    /// Counts a mismatch unless something holds.
    pub(super) fn expect(&mut self, holds: bool, what: impl FnOnce() -> String) {
        if !holds {
            self.wrong(what());
        }
    }

    /// Adds a number that answers decide.
    pub(super) const fn digest(&mut self, more: u64) {
        self.digest = self.digest.wrapping_add(more);
    }

    /// By which the same answers are known on another platform, in whatever order they were given.
    pub(super) const fn digest_of_answers(&self) -> u64 {
        self.digest
    }

    pub(super) fn get(&self, name: &str) -> u64 {
        self.counts.get(name).copied().unwrap_or(0)
    }

    /// The mismatches in words, as far as they are kept.
    pub(super) fn mismatches(&self) -> &[String] {
        &self.wrong
    }

    pub(super) fn counts(&self) -> impl Iterator<Item = (&str, u64)> {
        self.counts.iter().map(|(name, &count)| (&**name, count))
    }

    pub(super) fn add(&mut self, other: &Self) {
        for (name, count) in other.counts() {
            self.count_many(name, count);
        }
        self.digest(other.digest);
        let room = KEPT.saturating_sub(self.wrong.len());
        self.wrong.extend(other.wrong.iter().take(room).cloned());
    }
}
