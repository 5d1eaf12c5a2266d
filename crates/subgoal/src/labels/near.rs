//! Goals by place: those that may be near a vertex.

use mediant_grid::Vertex;

/// Goals in strips of rows, each sorted by column.
#[derive(Clone, Debug)]
pub(super) struct Strips {
    /// The first row, and the rows of a strip.
    top: i32,
    height: i32,
    /// By strip, the number of its first entry, and one more that ends the last.
    first: Vec<u32>,
    entries: Vec<Entry>,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    at: Vertex,
    /// The number of the goal.
    goal: u32,
}

impl Strips {
    pub(super) fn new(goals: &[Vertex]) -> Self {
        let rows = || goals.iter().map(|at| at.y);
        let columns = || goals.iter().map(|at| at.x);
        let (top, bottom) = (rows().min().unwrap_or(0), rows().max().unwrap_or(0));
        let width = columns().max().unwrap_or(0) - columns().min().unwrap_or(0) + 1;
        let area = f64::from(bottom - top + 1) * f64::from(width);
        // About as many goals in a strip as there are strips, if they are spread evenly.
        let height = ((area / goals.len().max(1) as f64).sqrt() as i32).max(1);
        let strip = |at: Vertex| ((at.y - top) / height) as usize;
        let mut first = vec![0_u32; ((bottom - top) / height) as usize + 2];
        goals.iter().for_each(|&at| first[strip(at) + 1] += 1);
        for number in 1..first.len() {
            first[number] += first[number - 1];
        }
        let mut entries: Vec<Entry> = goals.iter().zip(0..).map(|(&at, goal)| Entry { at, goal }).collect();
        entries.sort_unstable_by_key(|&Entry { at, goal }| (strip(at), at.x, goal));
        Self { top, height, first, entries }
    }

    /// Writes the numbers of the goals whose straight lines to a vertex are at most `most` cells long, in
    /// order.
    pub(super) fn near(&self, from: Vertex, most: i32, found: &mut Vec<u32>) {
        found.clear();
        let strip = |y: i32| ((y - self.top).max(0) / self.height) as usize;
        let last = self.first.len() - 1;
        let strips = strip(from.y - most).min(last)..(strip(from.y + most) + 1).min(last);
        let square = u64::from(most.unsigned_abs()).pow(2);
        for ends in strips.map(|strip| [self.first[strip], self.first[strip + 1]]) {
            let strip = &self.entries[ends[0] as usize..ends[1] as usize];
            let begin = strip.partition_point(|entry| entry.at.x < from.x - most);
            let near = strip[begin..].iter().take_while(|entry| entry.at.x <= from.x + most);
            found.extend(near.filter(|entry| entry.at.to(from).norm_squared() <= square).map(|e| e.goal));
        }
        found.sort_unstable();
    }
}

#[cfg(test)]
mod tests;
