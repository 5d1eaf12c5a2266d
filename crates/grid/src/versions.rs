//! Arrays of which each version differs from the last one in few places.

use std::{
    collections::VecDeque,
    fmt,
    ops::Deref,
    sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError},
};

use crate::{interrupt::Interrupted, room::room_for};

/// An array of words that never changes, and of which an [`edit`](Self::edit) makes the next version by work
/// that follows the edit.
///
/// Reading is reading a slice: no version is a list of differences, and none shares pages with another, which
/// every read would pay for. Instead, the words of a version that nobody holds any more are kept as the
/// *spare* of all that descend from one array. The next edit takes the spare, brings it up to date by the
/// words that the edits since then have changed, and changes it further. So where old versions are given up,
/// two arrays take turns, however many edits there are. Who holds on to all versions has a copy for each.
///
/// Readers take no lock; edits, and dropping a version, take one for as long as they work on the spare.
///
/// Hidden: for the crates of this workspace.
#[doc(hidden)]
pub struct Versioned<W> {
    words: Box<[W]>,
    number: u64,
    /// Made by the first edit.
    line: OnceLock<Arc<Line<W>>>,
}

/// The part that all versions which descend from one array have in common.
struct Line<W>(Mutex<Shared<W>>);

struct Shared<W> {
    /// The number of the last version.
    last: u64,
    /// The last edits, by the number of the version that each made.
    edits: VecDeque<Made>,
    /// The places that are listed in these edits.
    places: usize,
    /// The number of the version, and its words.
    spare: Option<(u64, Box<[W]>)>,
}

/// An edit that made a version.
struct Made {
    version: u64,
    from: u64,
    /// `None` if too many changed to list them.
    changed: Option<Box<[u32]>>,
}

/// The next version of an array while it is made.
#[doc(hidden)]
pub struct VersionEdit<W> {
    words: Box<[W]>,
    changed: Vec<u32>,
    /// Whether any word may have changed, listed or not.
    all: bool,
    /// The number of the version before.
    from: u64,
    line: Arc<Line<W>>,
}

/// The most edits that a spare is brought up to date by.
const MOST_EDITS: usize = 64;

impl<W: Clone + PartialEq> Versioned<W> {
    /// Begins an edit. This version stays as it is.
    #[must_use]
    pub fn edit(&self) -> VersionEdit<W> {
        let line = self.line.get_or_init(Arc::default);
        let spare = line.lock().spare_like(self);
        let words = spare.unwrap_or_else(|| self.words.clone());
        VersionEdit { words, changed: Vec::new(), all: false, from: self.number, line: Arc::clone(line) }
    }

    /// Begins an edit of a version that nobody else needs: in place.
    #[must_use]
    pub fn into_edit(mut self) -> VersionEdit<W> {
        let line = self.line.take().unwrap_or_default();
        let words = std::mem::take(&mut self.words);
        VersionEdit { words, changed: Vec::new(), all: false, from: self.number, line }
    }
}

impl<W: Clone + PartialEq> Versioned<W> {
    /// Begins an edit, unless there is no room for a copy of the words where one must be made.
    ///
    /// # Errors
    /// [`Interrupted`] then.
    pub fn edit_if_room(&self, during: &'static str) -> Result<VersionEdit<W>, Interrupted> {
        let has_spare = self.line.get().is_some_and(|line| line.lock().spare.is_some());
        if !has_spare {
            room_for::<W>(self.words.len(), during)?;
        }
        Ok(self.edit())
    }
}

impl<W> Versioned<W> {
    /// The words of a version that nobody else needs, in its own memory.
    #[must_use]
    pub fn into_words(mut self) -> Vec<W> {
        // They are no spare.
        self.line.take();
        std::mem::take(&mut self.words).into_vec()
    }

    /// The words, to be changed in place. The array has no earlier versions from then on.
    pub fn make_mut(&mut self) -> &mut [W] {
        self.line.take();
        &mut self.words
    }
}

impl<W: Clone + PartialEq> VersionEdit<W> {
    /// The words as they are now.
    #[must_use]
    #[inline]
    pub fn words(&self) -> &[W] {
        &self.words
    }

    /// Changes a word.
    #[inline]
    pub fn set(&mut self, at: usize, word: W) {
        if self.words[at] != word {
            self.words[at] = word;
            self.changed.push(at as u32);
        }
    }

    /// A word, to be changed in place: it counts as changed.
    #[must_use]
    #[inline]
    pub fn word_mut(&mut self, at: usize) -> &mut W {
        if self.changed.last() != Some(&(at as u32)) {
            self.changed.push(at as u32);
        }
        &mut self.words[at]
    }

    /// All words, to be changed in place: all count as changed.
    #[must_use]
    pub fn all_mut(&mut self) -> &mut [W] {
        self.all = true;
        &mut self.words
    }

    /// Whether any word was changed.
    #[must_use]
    pub fn is_changed(&self) -> bool {
        self.all || !self.changed.is_empty()
    }

    /// The next version.
    #[must_use]
    pub fn finish(self) -> Versioned<W> {
        let Self { words, changed, all, from, line } = self;
        // A quarter of the words is copied as quickly word by word as all are at once.
        let changed = (!all && changed.len() <= words.len() / 4).then(|| changed.into_boxed_slice());
        let number = line.lock().add(from, (changed, words.len()));
        Versioned { words, number, line: line.into() }
    }
}

impl<W> Default for Line<W> {
    fn default() -> Self {
        Self(Mutex::new(Shared { last: 0, edits: VecDeque::new(), places: 0, spare: None }))
    }
}

impl<W> Line<W> {
    fn lock(&self) -> MutexGuard<'_, Shared<W>> {
        // A thread that panics while it holds the lock leaves what is behind it whole.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<W> Shared<W> {
    /// Adds an edit, and returns the number of its version. Edits are forgotten from which a spare would be
    /// brought up to date no more quickly than by copying all words.
    fn add(&mut self, from: u64, (changed, words): (Option<Box<[u32]>>, usize)) -> u64 {
        self.last += 1;
        self.places += changed.as_ref().map_or(0, |changed| changed.len());
        self.edits.push_back(Made { version: self.last, from, changed });
        while self.edits.len() > MOST_EDITS || self.places > words {
            let forgotten = self.edits.pop_front();
            self.places -= forgotten.and_then(|made| made.changed).map_or(0, |changed| changed.len());
        }
        self.last
    }

    /// The edit that made a version; `None` if it was forgotten.
    fn made(&self, version: u64) -> Option<&Made> {
        let first = self.edits.front()?.version;
        self.edits.get(usize::try_from(version.checked_sub(first)?).ok()?)
    }
}

impl<W: Clone> Shared<W> {
    /// The words of the spare, made those of a version; `None` if there is no spare.
    fn spare_like(&mut self, version: &Versioned<W>) -> Option<Box<[W]>> {
        let (mut one, mut words) = self.spare.take()?;
        let mut other = version.number;
        // Both descend from one array: the edits that made the later of two lead to where they part.
        while one != other {
            let later = one.max(other);
            let Some(&Made { from, changed: Some(ref changed), .. }) = self.made(later) else {
                words.clone_from_slice(&version.words);
                return Some(words);
            };
            for &at in changed {
                words[at as usize].clone_from(&version.words[at as usize]);
            }
            if one == later {
                one = from;
            } else {
                other = from;
            }
        }
        Some(words)
    }
}

impl<W> Drop for Versioned<W> {
    fn drop(&mut self) {
        let Some(line) = self.line.take() else { return };
        let words = std::mem::take(&mut self.words);
        let mut shared = line.lock();
        // Of two spares the later one is kept. What is given up is given up without the lock.
        let given_up = match &mut shared.spare {
            Some((number, _)) if *number > self.number => Some((self.number, words)),
            spare => spare.replace((self.number, words)),
        };
        drop(shared);
        drop(given_up);
    }
}

impl<W> Deref for Versioned<W> {
    type Target = [W];

    #[inline]
    fn deref(&self) -> &[W] {
        &self.words
    }
}

/// The first version of an array.
impl<W> From<Vec<W>> for Versioned<W> {
    fn from(words: Vec<W>) -> Self {
        Self { words: words.into_boxed_slice(), number: 0, line: OnceLock::new() }
    }
}

impl<W> Default for Versioned<W> {
    fn default() -> Self {
        Vec::new().into()
    }
}

/// A copy, which has no earlier versions.
impl<W: Clone> Clone for Versioned<W> {
    fn clone(&self) -> Self {
        self.words.to_vec().into()
    }

    /// The same in the memory of this one, if it has as many words.
    fn clone_from(&mut self, other: &Self) {
        if self.words.len() == other.words.len() {
            self.make_mut().clone_from_slice(other);
        } else {
            *self = other.clone();
        }
    }
}

impl<W: PartialEq> PartialEq for Versioned<W> {
    fn eq(&self, other: &Self) -> bool {
        self.words == other.words
    }
}

impl<W: Eq> Eq for Versioned<W> {}

/// The length and the number of the version alone.
impl<W> fmt::Debug for Versioned<W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Versioned({} words, version {})", self.words.len(), self.number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Versions are edited, held and dropped in any order, and compared with copies of their own.
    #[test]
    fn every_version_keeps_its_words() {
        let mut seed = 0x9e37_79b9_u32;
        let mut random = move |below: usize| {
            seed ^= seed << 13;
            seed ^= seed >> 17;
            seed ^= seed << 5;
            seed as usize % below
        };
        let first: Vec<u32> = (0..200).collect();
        let mut held = vec![(Versioned::from(first.clone()), first)];
        for step in 0..20_000 {
            let at = random(held.len());
            let (mut edit, mut words) = if random(4) > 0 || held.len() == 1 {
                (held[at].0.edit(), held[at].1.clone())
            } else {
                let (version, words) = held.swap_remove(at);
                (version.into_edit(), words)
            };
            assert_eq!(edit.words(), words, "step {step}");
            // Seldom all words, mostly few.
            let most = [3, 3, 3, 80, 300][random(5)];
            for _ in 0..random(most) {
                let (at, word) = (random(200), random(7) as u32);
                match random(60) {
                    0 => edit.all_mut()[at] = word,
                    1..30 => edit.set(at, word),
                    _ => *edit.word_mut(at) = word,
                }
                words[at] = word;
            }
            let next = edit.finish();
            assert_eq!(*next, words, "step {step}");
            held.push((next, words));
            while held.len() > [1, 2, 9][random(3)] {
                held.swap_remove(random(held.len()));
            }
            assert!(held.iter().all(|(version, words)| **version == **words), "step {step}");
        }
    }

    #[test]
    fn a_copy_takes_the_memory_of_another_and_is_no_version() {
        let first = Versioned::from(vec![1, 2, 3]);
        let mut edit = first.edit();
        edit.set(1, 9);
        let mut copy = edit.finish();
        let place = copy.as_ptr();
        copy.clone_from(&first);
        assert_eq!((&*copy, copy.as_ptr()), (&[1, 2, 3][..], place));
        copy.clone_from(&Versioned::from(vec![4]));
        assert_eq!(*copy, [4]);
        // The words that the copy had are no spare of the line.
        drop(copy);
        let mut next = first.edit();
        assert_eq!(next.words(), [1, 2, 3]);
        // Nor are those that were taken.
        next.set(0, 7);
        let next = next.finish();
        let place = next.as_ptr();
        let taken = next.into_words();
        assert_eq!((&taken[..], taken.as_ptr()), (&[7, 2, 3][..], place));
        assert_eq!(first.edit().words(), [1, 2, 3]);
    }

    #[test]
    fn two_arrays_take_turns() {
        let mut version = Versioned::from(vec![0_u64; 1_000]);
        let mut places = Vec::new();
        for step in 0..100 {
            let mut edit = version.edit();
            edit.set(step, 1);
            version = edit.finish();
            places.push(version.as_ptr());
        }
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), 2);
    }
}
