//! Pictures of gray as numbers: for those who need the shades themselves, of pictures larger than maps.

use mediant_grid::Interrupt;

#[cfg(feature = "png")]
use super::png;
use super::{PNG_SIGNATURE, Raster, RasterError, netpbm, samples::Samples};
use crate::{SurfaceError, foreign::kind_or_quote};

/// The width and the height that a header states, and the largest shade.
pub(super) type Stated = ((u64, u64), u32);

/// A picture with one gray a pixel, by its header.
pub(crate) struct Gray {
    /// Width and height, whatever they are.
    pub(crate) sides: (u64, u64),
    /// The largest shade.
    pub(crate) largest: u32,
    netpbm: Option<netpbm::Kind>,
}

impl Gray {
    /// The picture that begins so.
    pub(crate) fn of(bytes: &[u8]) -> Result<Self, SurfaceError> {
        if bytes.starts_with(PNG_SIGNATURE) {
            #[cfg(feature = "png")]
            return png::gray(bytes)?
                .map(|(sides, largest)| Self { sides, largest, netpbm: None })
                .ok_or(SurfaceError::NoGray { found: "a PNG with colours or opacity" });
            #[cfg(not(feature = "png"))]
            return Err(SurfaceError::Off { kind: "PNG", feature: "png" });
        }
        let kind =
            netpbm::kind(bytes).ok_or_else(|| SurfaceError::Unknown { found: kind_or_quote(bytes) })?;
        let (sides, largest) = netpbm::gray(kind, bytes)?
            .ok_or(SurfaceError::NoGray { found: "a PBM, whose pixels are black and white" })?;
        Ok(Self { sides, largest, netpbm: Some(kind) })
    }

    /// The shades of the picture, whose sides the caller has checked: each at most 2³² − 1.
    pub(crate) fn read(&self, bytes: &[u8], interrupt: &Interrupt) -> Result<Samples, SurfaceError> {
        let unchecked = |width: u64, height: u64| Ok((width as u32, height as u32));
        let read: Result<Raster, RasterError> = match self.netpbm {
            Some(kind) => netpbm::read(kind, bytes, unchecked, interrupt),
            #[cfg(feature = "png")]
            None => png::read(bytes, unchecked, interrupt),
            #[cfg(not(feature = "png"))]
            None => Err(RasterError::PngIsOff),
        };
        let Raster { shades, opacities, .. } = read.map_err(|error| match error {
            RasterError::Interrupted(interrupted) => interrupted.into(),
            error => SurfaceError::from(error),
        })?;
        if opacities.is_some() {
            return Err(SurfaceError::NoGray { found: "a PNG with a transparent shade" });
        }
        // A PNG of less than 8 bits comes as one of 8.
        Ok(match shades {
            Samples::U8(mut shades) if self.netpbm.is_none() && self.largest < 0xff => {
                let step = 0xff / self.largest as u8;
                shades.iter_mut().for_each(|shade| *shade /= step);
                Samples::U8(shades)
            }
            shades => shades,
        })
    }
}
