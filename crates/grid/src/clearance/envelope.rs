//! The second pass: the squared distances of a row from the distances along its columns.
//!
//! Each column is a parabola over the row: what is nearest in that column is so far away, seen from any point
//! of the row. The answer is the lower envelope of all parabolas, found from left to right with a stack
//! (Meijster, Roerdink & Hesselink 2000; Felzenszwalb & Huttenlocher 2012), in integers and linear time.
//!
//! * **Corner vertices** are points, and so are centers that are measured to centers; so are their sites:
//!   F_e(x) = (x − e)² + g_e² for a column e whose nearest site is g_e rows away.
//! * **Centers** measure to squares in half cells. The edges of columns are the sites, since the nearest
//!   point of a blocked square in another column lies on an edge of that column: F_e(x) = (2x + 1 − 2e)² +
//!   h_e, where h_e is that of the nearer one of the two columns beside edge e. Seen from a center, a blocked
//!   square g > 0 rows away begins at 2g − 1 half cells: h = (2g − 1)², and 0 for g = 0. The column of x
//!   itself is straight above and below x, at h, and is compared at the end.
//!
//! Where columns differ at random, most parabolas are nowhere lowest, and which ones cannot be predicted. So
//! most of these are left out beforehand, without branches: those that near ones hide.

use super::{columns::NONE, sites::Measure};

/// A parabola of the envelope, F(x) = (A·x + B)² + constant − 2A²·site·x.
#[derive(Clone, Copy, Default)]
struct Parabola {
    constant: i64,
    site: u32,
    /// The first point at which it is the lowest.
    start: u32,
}

/// The scratch memory of a thread.
#[derive(Default)]
pub(super) struct Envelope {
    /// The distance at each site, [`NONE`] for those that are left out.
    distances: Vec<u16>,
    heights: Vec<i16>,
    /// The sites that are left.
    sites: Vec<(u32, u16)>,
    stack: Vec<Parabola>,
}

impl Envelope {
    /// Squared distances from distances along columns; [`u32::MAX`] where there is no site or none as near.
    /// Centers also take the distances along the columns just beyond the first and the last one.
    pub(super) fn row(&mut self, measure: Measure, beyond: [u16; 2], columns: &[u16], squared: &mut [u32]) {
        self.distances.clear();
        match measure {
            Measure::CornersToSquares | Measure::CentersToCenters => {
                self.distances.extend_from_slice(columns);
                self.write::<1, 0>(|g| u32::from(g) * u32::from(g), squared);
            }
            Measure::CentersToSquares => {
                let [first, last] = [(columns.first(), beyond[0]), (columns.last(), beyond[1])]
                    .map(|(g, beyond)| beyond.min(*g.unwrap_or(&beyond)));
                self.distances.push(first);
                self.distances.extend(columns.windows(2).map(|pair| pair[0].min(pair[1])));
                self.distances.push(last);
                self.write::<2, 1>(half_rows, squared);
                for (squared, &g) in squared.iter_mut().zip(columns) {
                    let own = if g == NONE { u32::MAX } else { half_rows(g) };
                    *squared = (*squared).min(own);
                }
            }
        }
    }

    /// The lower envelope of the parabolas (A·(x − e) + B)² + height of the distance at e.
    #[inline(always)]
    fn write<const A: i32, const B: i32>(&mut self, height: impl Fn(u16) -> u32, squared: &mut [u32]) {
        leave_out_hidden(&mut self.distances, &mut self.heights, A, &height);
        let sites = collect(&self.distances, &mut self.sites);
        self.stack.resize(self.distances.len(), Parabola::default());
        let sites = sites.iter().map(|&(site, g)| (site, height(g)));
        let (a, b) = (i64::from(A), i64::from(B));
        envelope(a, b, &mut self.stack, sites, squared);
    }
}

/// The squared rows between a center and a square g rows away, in half cells; at least so for g > 32,768.
#[inline]
fn half_rows(g: u16) -> u32 {
    let half = (2 * u32::from(g)).saturating_sub(1).min(u32::from(u16::MAX));
    half * half
}

/// Greater heights than this are taken for it where hidden sites are looked for, which only leaves more in.
const HIGH: i16 = 32_000;

/// Leaves out sites that two near ones hide: one to the left, within three columns, which is as low at the
/// site's own place and so everywhere to the left, and one to the right. In 16 bits, eight at a time.
#[inline(always)]
fn leave_out_hidden(distances: &mut [u16], heights: &mut Vec<i16>, a: i32, height: impl Fn(u16) -> u32) {
    heights.clear();
    heights.resize(3, HIGH);
    heights.extend(distances.iter().map(|&g| height(g).min(HIGH as u32) as i16));
    heights.resize(distances.len() + 6, HIGH);
    let [one, two, three] = [1, 2, 3].map(|apart: i32| (a * a * apart * apart) as i16);
    for (distance, at) in distances.iter_mut().zip(heights.windows(7)) {
        let left = (at[0] + three).min(at[1] + two).min(at[2] + one);
        let right = (at[6] + three).min(at[5] + two).min(at[4] + one);
        *distance |= if left.max(right) <= at[3] { NONE } else { 0 };
    }
}

/// The sites that are left, with their distances; without branches.
fn collect<'s>(distances: &[u16], sites: &'s mut Vec<(u32, u16)>) -> &'s [(u32, u16)] {
    sites.resize(distances.len(), (0, 0));
    let mut count = 0;
    for (site, &g) in (0..).zip(distances) {
        sites[count] = (site, g);
        count += usize::from(g != NONE);
    }
    &sites[..count]
}

/// The lower envelope of the parabolas F_e(x) = (a·(x − e) + b)² + height, given by e and height in the order
/// of e. `stack` has room for all.
#[inline(always)]
fn envelope(
    a: i64,
    b: i64,
    stack: &mut [Parabola],
    sites: impl Iterator<Item = (u32, u32)>,
    squared: &mut [u32],
) {
    let last = squared.len() as i64 - 1;
    let mut count = 0;
    'sites: for (site, height) in sites {
        let e = i64::from(site);
        let constant = a * a * e * e - 2 * a * b * e + i64::from(height);
        let mut start = 0;
        // It is as low as one before from the first x on with 2a²·(e − its e)·x ≥ constant − its constant.
        while let Some(top) = stack[..count].last() {
            let (apart, rise) = (i64::from(site - top.site), constant - top.constant);
            let slope = 2 * a * a * apart;
            if rise > slope * last {
                // Only the first one looked at can say so: where others were removed, this one is lower.
                continue 'sites;
            }
            if rise > slope * i64::from(top.start) {
                start = if apart == 1 {
                    // Neighbors are the usual case, and a division by this constant is a shift.
                    ((rise + 2 * a * a - 1) / (2 * a * a)) as u32
                } else {
                    ((rise + slope - 1) as u64 / slope as u64) as u32
                };
                break;
            }
            count -= 1;
        }
        stack[count] = Parabola { constant, site, start };
        count += 1;
    }
    let mut end = squared.len();
    for &Parabola { constant, site, start } in stack[..count].iter().rev() {
        let slope = 2 * a * a * i64::from(site);
        for (x, squared) in (i64::from(start)..).zip(&mut squared[start as usize..end]) {
            let value = (a * x + b) * (a * x + b) + constant - slope * x;
            *squared = value.min(i64::from(u32::MAX)) as u32;
        }
        end = start as usize;
    }
    if count == 0 {
        squared.fill(u32::MAX);
    }
}
