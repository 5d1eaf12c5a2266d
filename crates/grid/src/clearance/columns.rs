//! The first pass: how many rows each point is from the nearest site of its column.
//!
//! Rows are handled in bands, so that the distances of a band stay in the cache and bands can be handled on
//! different cores. A band first says how far its first and last row are from its own sites; sums of these
//! tell each band how far the sites beyond it are.

use super::sites::Sites;
use crate::interrupt::Interrupted;

/// The rows of a band. (32 rows of 2048 columns are 128 KiB.)
pub(super) const BAND: usize = 32;

/// The distance where a column has no site. Others are at most 32,769.
pub(super) const NONE: u16 = u16::MAX;

/// For each pattern of eight sites: no bit set at the sites, all bits set elsewhere.
const KEEP: [[u16; 8]; 256] = {
    let mut keep = [[0; 8]; 256];
    let mut at = 0;
    while at < 8 * 256 {
        keep[at / 8][at % 8] = if (at / 8) >> (at % 8) & 1 == 1 { 0 } else { !0 };
        at += 1;
    }
    keep
};

/// A row of distances in whole words of 64 columns. Values beyond the last column mean nothing.
pub(super) type Distances = Vec<u16>;

/// The distances of the row y from those of the row before it in the direction of a pass.
fn advance(sites: Sites<'_>, y: usize, before: &[u16], row: &mut [u16]) {
    let lanes = before.chunks_exact(64).zip(row.chunks_exact_mut(64));
    for (word, (before, row)) in lanes.enumerate() {
        let bytes = sites.word(word, y).to_le_bytes();
        for (byte, (before, row)) in bytes.iter().zip(before.chunks_exact(8).zip(row.chunks_exact_mut(8))) {
            let keep = &KEEP[usize::from(*byte)];
            for ((row, before), keep) in row.iter_mut().zip(before).zip(keep) {
                *row = before.saturating_add(1) & keep;
            }
        }
    }
}

/// How far the rows just beyond a band are from the nearest sites before or after them.
#[derive(Clone)]
pub(super) struct Beyond {
    /// From the row above the band, upwards.
    pub(super) above: Distances,
    /// From the row below the band, downwards.
    pub(super) below: Distances,
}

/// A band by itself: how far its last row is from its sites upwards, and its first one downwards.
pub(super) fn ends(sites: Sites<'_>, band: usize) -> Beyond {
    let pass = |rows: &mut dyn Iterator<Item = usize>| {
        let (mut row, mut before) = (vec![0; 64 * sites.words()], vec![NONE; 64 * sites.words()]);
        for y in rows {
            advance(sites, y, &before, &mut row);
            std::mem::swap(&mut row, &mut before);
        }
        before
    };
    let rows = rows(sites, band);
    Beyond { above: pass(&mut rows.clone()), below: pass(&mut rows.rev()) }
}

/// The rows of a band.
pub(super) fn rows(sites: Sites<'_>, band: usize) -> std::ops::Range<usize> {
    band * BAND..sites.size().1.min((band + 1) * BAND)
}

/// The distances just beyond each band, carried from band to band; `outside` is the one at the map's edge.
///
/// `check` is asked before each band.
pub(super) fn beyond(
    sites: Sites<'_>,
    mut bands: Vec<Beyond>,
    outside: u16,
    check: impl Fn() -> Result<(), Interrupted>,
) -> Result<Vec<Beyond>, Interrupted> {
    // Replaces a band's own distances by those carried from before it; `carried` then includes the band.
    fn carry(own: &mut Distances, carried: &mut Distances, rows: usize) {
        for (own, carried) in own.iter_mut().zip(carried.iter_mut()) {
            let through = carried.saturating_add(rows as u16).min(*own);
            *own = std::mem::replace(carried, through);
        }
    }
    let edge = vec![outside; 64 * sites.words()];
    let mut carried = edge.clone();
    for (band, own) in bands.iter_mut().enumerate() {
        check()?;
        carry(&mut own.above, &mut carried, rows(sites, band).len());
    }
    carried = edge;
    for (band, own) in bands.iter_mut().enumerate().rev() {
        check()?;
        carry(&mut own.below, &mut carried, rows(sites, band).len());
    }
    Ok(bands)
}

/// The rows of a band from the last to the first, with the distance of each point to the nearest site of its
/// column.
///
/// `upwards` is scratch memory. The first error of `row` ends it.
pub(super) fn for_each_row(
    sites: Sites<'_>,
    band: usize,
    beyond: &Beyond,
    upwards: &mut Distances,
    mut row: impl FnMut(usize, &[u16]) -> Result<(), Interrupted>,
) -> Result<(), Interrupted> {
    let (stride, rows) = (64 * sites.words(), rows(sites, band));
    // The row above the band comes first.
    upwards.clear();
    upwards.extend_from_slice(&beyond.above);
    upwards.resize((rows.len() + 1) * stride, 0);
    for (i, y) in rows.clone().enumerate() {
        let (before, after) = upwards.split_at_mut((i + 1) * stride);
        advance(sites, y, &before[i * stride..], &mut after[..stride]);
    }
    let (mut below, mut downwards) = (beyond.below.clone(), vec![0; stride]);
    for (y, nearest) in rows.zip(upwards.chunks_exact_mut(stride).skip(1)).rev() {
        advance(sites, y, &below, &mut downwards);
        std::mem::swap(&mut below, &mut downwards);
        for (nearest, below) in nearest.iter_mut().zip(&below) {
            *nearest = (*nearest).min(*below);
        }
        row(y, &nearest[..sites.size().0])?;
    }
    Ok(())
}
