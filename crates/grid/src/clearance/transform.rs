//! Squared distances of all cell centers or corner vertices.

use super::{
    Outside,
    columns::{self, BAND, NONE},
    envelope::Envelope,
    sites::Sites,
};
use crate::{
    interrupt::{Interrupt, Interrupted},
    room::room_for,
};

/// A thread's scratch memory, kept from band to band.
#[derive(Default)]
struct Scratch {
    upwards: columns::Distances,
    envelope: Envelope,
}

/// The squared distance of each point to the nearest obstacle, row by row: for corner vertices in cells, for
/// centers in half cells. [`u32::MAX`] stands for all that do not fit, and for none.
///
/// Linear time. With the feature `parallel` on all cores of rayon's current pool, with the same result.
pub(super) fn squared_distances(sites: Sites<'_>, interrupt: &Interrupt) -> Result<Box<[u32]>, Interrupted> {
    let check = || interrupt.check("measuring clearances");
    let (width, height) = sites.size();
    // The row beyond the map: of centers, it is blocked itself. Vertices know their cells outside.
    let outside = if sites.outside == Outside::Blocked { 0 } else { NONE };
    room_for::<u32>(width * height, "measuring clearances")?;
    let mut squared = vec![0; width * height].into_boxed_slice();
    let band = |scratch: &mut Scratch, (band, (squared, beyond)): (usize, (&mut [u32], &columns::Beyond))| {
        columns::for_each_row(sites, band, beyond, &mut scratch.upwards, |y, distances| {
            let start = (y - band * BAND) * width;
            check()?;
            scratch.envelope.row(sites.measure, [outside; 2], distances, &mut squared[start..start + width]);
            Ok(())
        })
    };
    let ends = |band| check().map(|()| columns::ends(sites, band));
    let bands = 0..height.div_ceil(BAND);
    #[cfg(feature = "parallel")]
    if crate::threads::are_there() {
        use rayon::prelude::*;
        let ends = bands.into_par_iter().map(ends).collect::<Result<_, _>>()?;
        let beyond = columns::beyond(sites, ends, outside, check)?;
        let parts = squared.par_chunks_mut(BAND * width).zip(&beyond).enumerate();
        parts.try_for_each_init(Scratch::default, band)?;
        return Ok(squared);
    }
    let ends = bands.map(ends).collect::<Result<_, _>>()?;
    let beyond = columns::beyond(sites, ends, outside, check)?;
    let mut scratch = Scratch::default();
    let mut parts = squared.chunks_mut(BAND * width).zip(&beyond).enumerate();
    parts.try_for_each(|part| band(&mut scratch, part))?;
    Ok(squared)
}
