//! The occupancies of pixels, by the rules of two generations of `map_server`: `RosVersion` says which.

use std::cmp::Ordering;

use mediant_grid::{Grid, Interrupt, Interrupted, uninterrupted};

use super::{RosMap, RosMode};
use crate::{MapOptions, RosVersion, Unknown};

impl RosMap {
    /// The grid: cells that are more occupied than `options.threshold` allows are blocked, unknown ones as
    /// `options.unknown` says, all by the rules of `options.ros`. See [`MapOptions`].
    #[must_use]
    pub fn to_grid(&self, options: &MapOptions) -> Grid {
        uninterrupted(|never| self.to_grid_interruptible(options, never))
    }

    pub(crate) fn to_grid_interruptible(
        &self,
        options: &MapOptions,
        interrupt: &Interrupt,
    ) -> Result<Grid, Interrupted> {
        let unknown = options.unknown == Unknown::Blocked;
        let (numerator, denominator) = options.threshold.parts();
        // p / 100 > 1 − threshold, in whole numbers.
        let limit = 100 * u64::from(denominator - numerator);
        let blocked = |occupancy: Option<u8>| {
            occupancy.map_or(unknown, |p| u64::from(p) * u64::from(denominator) > limit)
        };
        match options.ros {
            RosVersion::Ros1 => self.grid_of_ros1(interrupt, unknown, blocked),
            RosVersion::Ros2 => {
                let mut table = [unknown; 256];
                for (gray, cell) in (0..=u8::MAX).zip(&mut table) {
                    *cell = blocked(self.of_luma(gray));
                }
                let hidden = (self.settings.mode != RosMode::Raw).then_some(unknown);
                self.raster.grid_of_lumas(interrupt, &table, hidden)
            }
        }
    }

    /// The occupancy of cell (x, y), 0 to 100; `None` if it is unknown, and outside the map.
    #[must_use]
    pub fn occupancy(&self, x: u32, y: u32, ros: RosVersion) -> Option<u8> {
        self.occupancy_by(x, y, ros, |gray| self.of_luma(gray), |shade| self.of_shade(shade))
    }

    /// The occupancies of all cells, 0 to 100, row by row from the top; `None` for unknown ones. In trinary
    /// mode they are 0 or 100; in scale mode they rise between the thresholds; in raw mode they are the
    /// picture's own numbers.
    ///
    /// ```
    /// use mediant_formats::{Raster, RosMap, RosMode, RosSettings, RosVersion};
    /// let picture = Raster::parse(b"P2 4 1 255  255 128 0 99")?;
    /// let mut settings = RosSettings::new("depot.pgm", 0.05, [0.0; 3]);
    /// settings.mode = RosMode::Scale;
    /// let scale = RosMap::new(settings.clone(), picture.clone())?;
    /// let numbers = |map: &RosMap| map.occupancies(RosVersion::Ros2).collect::<Vec<_>>();
    /// assert_eq!(numbers(&scale), [Some(0), Some(67), Some(100), Some(92)]);
    /// settings.mode = RosMode::Raw;
    /// let raw = RosMap::new(settings, picture)?;
    /// assert_eq!(numbers(&raw), [None, None, Some(0), Some(99)]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn occupancies(&self, ros: RosVersion) -> impl ExactSizeIterator<Item = Option<u8>> {
        // Lumas and shades are few, and pixels many.
        let (lumas, shades) = match ros {
            RosVersion::Ros1 => (0, self.raster.white() + 1),
            RosVersion::Ros2 => (256, 0),
        };
        let lumas: Vec<_> = (0..lumas).map(|gray| self.of_luma(gray as u8)).collect();
        let shades: Vec<_> = (0..shades).map(|shade| self.of_shade(shade)).collect();
        let (width, height) = (self.raster.width() as usize, self.raster.height() as usize);
        (0..width * height).map(move |at| {
            let (x, y) = ((at % width) as u32, (at / width) as u32);
            self.occupancy_by(x, y, ros, |gray| lumas[usize::from(gray)], |shade| shades[shade as usize])
        })
    }

    fn occupancy_by(
        &self,
        x: u32,
        y: u32,
        ros: RosVersion,
        of_luma: impl Fn(u8) -> Option<u8>,
        of_shade: impl Fn(u32) -> Option<u8>,
    ) -> Option<u8> {
        let opacity = self.raster.opaque().zip(self.raster.opacity(x, y));
        match ros {
            RosVersion::Ros1 => self.of_ros1(self.raster.shade(x, y)?, opacity, of_shade),
            RosVersion::Ros2 => {
                let is_hidden = opacity.is_some_and(|(opaque, opacity)| opacity < opaque);
                let counts = self.settings.mode != RosMode::Raw;
                self.raster.luma(x, y).filter(|_| !(is_hidden && counts)).and_then(of_luma)
            }
        }
    }

    /// The occupancy of an opaque pixel, by ROS 2: in single precision, as there, since 'at the threshold' is
    /// decided by its rounding.
    fn of_luma(&self, gray: u8) -> Option<u8> {
        if self.settings.mode == RosMode::Raw {
            return Some(gray).filter(|&gray| gray <= 100);
        }
        let shade = f32::from(gray) / 255.0;
        let p = if self.settings.negate { shade } else { 1.0 - shade };
        let [free, full] = [self.settings.free_thresh, self.settings.occupied_thresh].map(|at| {
            let (numerator, denominator) = at.parts();
            f64::from(numerator) / f64::from(denominator)
        });
        if p <= free as f32 {
            Some(0)
        } else if p >= full as f32 {
            Some(100)
        } else if self.settings.mode == RosMode::Trinary {
            None
        } else {
            // The difference of the thresholds is taken in double precision there.
            Some(((p - free as f32) / ((full - free) as f32) * 100.0).round() as u8)
        }
    }

    fn grid_of_ros1(
        &self,
        interrupt: &Interrupt,
        unknown: bool,
        blocked: impl Fn(Option<u8>) -> bool,
    ) -> Result<Grid, Interrupted> {
        match self.raster.opaque() {
            Some(opaque) if self.settings.mode == RosMode::Trinary => {
                let of_four = |shade, opacity| self.trinary_of_four(shade, opacity, opaque);
                self.raster.grid_where(interrupt, |shade, opacity| blocked(of_four(shade, opacity)))
            }
            opaque => {
                // Shades are few, and pixels many.
                let table: Vec<bool> =
                    (0..=self.raster.white()).map(|shade| blocked(self.of_shade(shade))).collect();
                let hidden = opaque.filter(|_| self.settings.mode == RosMode::Scale);
                self.raster.grid_where(interrupt, |shade, opacity| match hidden {
                    Some(opaque) if opacity < opaque => unknown,
                    _ => table.get(shade as usize).copied().unwrap_or(unknown),
                })
            }
        }
    }

    /// The occupancy of a pixel, by ROS 1; of one with an opacity it is given after that of opaque pixels.
    fn of_ros1(
        &self,
        shade: u32,
        opacity: Option<(u32, u32)>,
        of_shade: impl Fn(u32) -> Option<u8>,
    ) -> Option<u8> {
        match (self.settings.mode, opacity) {
            (RosMode::Trinary, Some((opaque, opacity))) => self.trinary_of_four(shade, opacity, opaque),
            (RosMode::Scale, Some((opaque, opacity))) if opacity < opaque => None,
            _ => of_shade(shade),
        }
    }

    /// The occupancy of an opaque pixel, by ROS 1.
    fn of_shade(&self, shade: u32) -> Option<u8> {
        let (shade, white) = (u64::from(shade), u64::from(self.raster.white()));
        match self.settings.mode {
            RosMode::Trinary => match self.threshold(shade, white) {
                Ordering::Less => Some(0),
                Ordering::Equal => None,
                Ordering::Greater => Some(100),
            },
            RosMode::Scale => Some(self.scale(shade, white)),
            RosMode::Raw => {
                // The nearest of 255 shades, half up.
                let sample = (2 * 255 * shade + white) / (2 * white);
                u8::try_from(sample).ok().filter(|&sample| sample <= 100)
            }
        }
    }

    /// The trinary occupancy of a pixel whose opacity is the fourth channel of the mean.
    fn trinary_of_four(&self, shade: u32, opacity: u32, opaque: u32) -> Option<u8> {
        let [shade, opacity, opaque, white] = [shade, opacity, opaque, self.raster.white()].map(u64::from);
        match self.threshold(3 * shade * opaque + opacity * white, 4 * white * opaque) {
            Ordering::Less => Some(0),
            Ordering::Equal => None,
            Ordering::Greater => Some(100),
        }
    }

    /// A pixel against both thresholds: `Less` if it is free, `Equal` between them, `Greater` if occupied.
    fn threshold(&self, shade: u64, white: u64) -> Ordering {
        let occupied = if self.settings.negate { shade } else { white - shade };
        if self.settings.occupied_thresh.compare(occupied, white) == Ordering::Greater {
            Ordering::Greater
        } else if self.settings.free_thresh.compare(occupied, white) == Ordering::Less {
            Ordering::Less
        } else {
            Ordering::Equal
        }
    }

    /// 0 to 100, by proportion between the thresholds, rounded to the nearest, half to even.
    fn scale(&self, shade: u64, white: u64) -> u8 {
        match self.threshold(shade, white) {
            Ordering::Less => return 0,
            Ordering::Greater => return 100,
            Ordering::Equal => {}
        }
        let occupied = if self.settings.negate { shade } else { white - shade };
        let wide = |(n, d): (u32, u32)| (u128::from(n), u128::from(d));
        let (free, free_by) = wide(self.settings.free_thresh.parts());
        let (full, full_by) = wide(self.settings.occupied_thresh.parts());
        let (occupied, white) = (u128::from(occupied), u128::from(white));
        // 100 · (occupied / white − free) / (full − free); below 2²⁰ · 2³² · 2³² · 2⁷. Neither difference is
        // negative, since free ≤ occupied / white, and the latter is not 0.
        let over = 100 * (occupied * free_by - free * white) * full_by;
        let under = white * (full * free_by - free * full_by);
        let (whole, rest) = (over / under, over % under);
        let up = match (2 * rest).cmp(&under) {
            Ordering::Less => false,
            Ordering::Equal => whole % 2 == 1,
            Ordering::Greater => true,
        };
        // At most 100, which occupied = full gives.
        (whole as u8).saturating_add(u8::from(up))
    }
}
