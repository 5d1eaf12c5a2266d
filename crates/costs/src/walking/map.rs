//! Maps to walk on: an elevation for each cell, a pace, and friction.

use std::fmt;

use mediant_grid::{Interrupt, MapId, room_for};

use super::{
    Pace, WalkingError,
    table::{PaceTable, clip},
};
use crate::{
    error::CostsError,
    layout::Layout,
    scale::{check_cell_size, exp2, exponent, floor_log2, is_amount},
};

/// A map to walk on: cells with an elevation, which is that of their centers, and the pace by the slope.
/// Cells without an elevation are blocked.
///
/// ```
/// use mediant_costs::{Pace, WalkingMap};
/// use mediant_grid::Interrupt;
///
/// // A hillside of 20 %, in cells of 30 m, with a lake.
/// let map = WalkingMap::new((8, 5), (30.0, 30.0), &Pace::Tobler, &Interrupt::NEVER, |x, y| {
///     ((x, y) != (4, 2)).then_some(6.0 * f64::from(x))
/// })?;
/// assert_eq!((map.elevation(3, 0), map.elevation(4, 2)), (Some(18.0), None));
/// # Ok::<(), mediant_costs::WalkingError>(())
/// ```
///
/// **Integers.** Elevations are kept as integers of 30 binary digits above the lowest one: exactly, where all
/// are multiples of a power of two above the difference between the highest and the lowest times 2⁻³⁰;
/// otherwise rounded once. The slope of a piece of a move is a multiple of 2⁻⁴⁰, the time of a unit of length
/// an integer of 44 digits, and the cost of a move is rounded once, to the map's [unit](Self::unit).
#[derive(Clone)]
pub struct WalkingMap {
    layout: Layout,
    cell_size: (f64, f64),
    /// By position, above the lowest; `BLOCKED` for none.
    heights: Vec<i32>,
    lowest: f64,
    /// The unit of heights is 2 to this.
    height_exponent: i32,
    friction: Option<Friction>,
    pace: PaceTable,
    /// The unit of times a unit of length is 2 to this.
    time_exponent: i32,
    /// The unit of costs is 2 to this.
    exponent: i32,
    bounds: WalkingBounds,
    id: MapId,
}

/// The bounds of the elevations and of the frictions of a map to walk on, as they were given. All its units
/// follow from them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WalkingBounds {
    /// The lowest and the highest elevation.
    pub elevation: (f64, f64),
    /// The least and the greatest friction.
    pub friction: (f64, f64),
}

impl WalkingBounds {
    fn are_numbers(&self) -> bool {
        let is_range = |(least, greatest): (f64, f64)| least <= greatest && (greatest - least).is_finite();
        is_range(self.elevation) && is_range(self.friction) && self.friction.0 >= 0.0
    }
}

/// The number of a range that is nearest.
const fn within((least, greatest): (f64, f64), number: f64) -> f64 {
    number.max(least).min(greatest)
}

/// The friction of the cells.
#[derive(Clone)]
struct Friction {
    /// By position.
    of: Vec<u32>,
    /// The unit is 2 to this of the times.
    shift: u32,
    /// The bounds, in the unit of the times.
    least: u64,
    greatest: u64,
}

/// In place of the height of a blocked cell.
pub(super) const BLOCKED: i32 = i32::MIN;
/// The binary digits of heights, and of times.
const DIGITS: (i32, i32) = (30, 44);
/// The binary digits of the least unit of heights below 1.
const FINEST: i32 = 32;
/// The greatest ratio of two times: each has 23 digits or more.
const GREATEST_RATIO: f64 = (1_u64 << 20) as f64;
/// The steepest slope that has an integer.
const STEEPEST: f64 = (1_u64 << 20) as f64;

/// The cells of a map that is made.
struct Cells<'i, G> {
    layout: Layout,
    interrupt: &'i Interrupt,
    ground: G,
}

impl<G: Fn(u32, u32) -> Option<(f64, f64)>> Cells<'_, G> {
    /// Calls `visit` for all cells that are not blocked, row by row, with the elevation and the friction.
    fn visit(
        &self,
        mut visit: impl FnMut((u32, u32), (f64, f64)) -> Result<(), WalkingError>,
    ) -> Result<(), WalkingError> {
        for y in 0..self.layout.height() {
            self.interrupt.check("reading the elevations")?;
            for x in 0..self.layout.width() {
                if let Some(ground) = (self.ground)(x, y) {
                    visit((x, y), ground)?;
                }
            }
        }
        Ok(())
    }

    /// The bounds of the elevations and of the frictions.
    fn bounds(&self) -> Result<WalkingBounds, WalkingError> {
        let mut bounds = None;
        self.visit(|(x, y), (elevation, friction)| {
            if !elevation.is_finite() {
                return Err(WalkingError::Elevation { x, y, elevation });
            }
            if !(friction == 0.0 || is_amount(friction)) {
                return Err(WalkingError::Friction { x, y, friction });
            }
            let [elevations, frictions] =
                bounds.unwrap_or([elevation, friction].map(|number| (number, number)));
            let widen =
                |(least, greatest): (f64, f64), number: f64| (least.min(number), greatest.max(number));
            bounds = Some([widen(elevations, elevation), widen(frictions, friction)]);
            Ok(())
        })?;
        let [elevation, friction] = bounds.unwrap_or_default();
        Ok(WalkingBounds { elevation, friction })
    }

    /// A number for each position, `blocked` where there is no cell.
    fn numbers<T: Copy>(&self, blocked: T, number: impl Fn(f64, f64) -> T) -> Result<Vec<T>, WalkingError> {
        room_for::<T>(self.layout.len(), "filling memory")?;
        let mut numbers = vec![blocked; self.layout.len()];
        self.visit(|(x, y), (elevation, friction)| {
            numbers[self.layout.position(x as i32, y as i32)] = number(elevation, friction);
            Ok(())
        })?;
        Ok(numbers)
    }
}

impl Friction {
    /// The frictions of cells between two bounds, with 32 digits, or as many as the times have.
    fn new<G: Fn(u32, u32) -> Option<(f64, f64)>>(
        cells: &Cells<'_, G>,
        (smooth, rough): (f64, f64),
        time_exponent: i32,
    ) -> Result<Self, WalkingError> {
        let shift = (floor_log2(rough) - 31 - time_exponent).max(0) as u32;
        let unit = exp2(-time_exponent - shift as i32);
        let whole = |friction: f64| (within((smooth, rough), friction) * unit).round() as u32;
        let of = cells.numbers(0, |_, friction| whole(friction))?;
        let [least, greatest] = [smooth, rough].map(|friction| u64::from(whole(friction)) << shift);
        Ok(Self { of, shift, least, greatest })
    }
}

/// The bounds of the times of knots; the first that can be no time, if there is one.
fn times_of(knots: &[(f64, f64)]) -> Result<(f64, f64), f64> {
    knots.iter().try_fold((f64::INFINITY, 0.0_f64), |(least, greatest), &(_, time)| {
        if is_amount(time) { Ok((time.min(least), time.max(greatest))) } else { Err(time) }
    })
}

impl WalkingMap {
    /// The longest side, in cells.
    pub const MAX_SIDE: u32 = Layout::MAX_SIDE;

    /// The map of `width` × `height` cells, for which `elevation(x, y)` is the elevation, or `None` for a
    /// blocked cell. It is asked twice for each cell. Elevations and the width and the height of a cell have
    /// the same unit.
    ///
    /// # Errors
    /// [`WalkingError::Costs`] for sizes, or when it is interrupted; [`WalkingError::Elevation`] for the
    /// first one, row by row, that is no number; [`WalkingError::Table`], [`WalkingError::Pace`] and
    /// [`WalkingError::Range`] for a pace that is not one on the slopes of the map.
    pub fn new(
        size: (u32, u32),
        cell_size: (f64, f64),
        pace: &Pace,
        interrupt: &Interrupt,
        elevation: impl Fn(u32, u32) -> Option<f64>,
    ) -> Result<Self, WalkingError> {
        Self::with_friction(size, cell_size, pace, interrupt, |x, y| Some((elevation(x, y)?, 0.0)))
    }

    /// [`new`](Self::new) with a friction for each cell: the time that a unit of length takes there beyond
    /// that of the pace, from 0 on. It counts by the length in each cell, as costs do. The cost of a straight
    /// or diagonal move is then that of `r.walk` of GRASS: the time of the pace, plus the mean friction of
    /// both cells times the length (the friction is that of `r.walk` times its `lambda`). `ground(x, y)` is
    /// the elevation and the friction of a cell. It is asked three times for each.
    ///
    /// # Errors
    /// As for [`new`](Self::new); [`WalkingError::Friction`].
    pub fn with_friction(
        size: (u32, u32),
        cell_size: (f64, f64),
        pace: &Pace,
        interrupt: &Interrupt,
        ground: impl Fn(u32, u32) -> Option<(f64, f64)>,
    ) -> Result<Self, WalkingError> {
        Self::made(size, (cell_size, pace), None, interrupt, ground)
    }

    /// The map that had these [bounds](Self::ground_bounds), from the elevations and frictions that it has: a
    /// copy that was sent elsewhere, equal to the first one. Bounds that are none count as not given, numbers
    /// beyond them as the nearest one within.
    ///
    /// # Errors
    /// As for [`with_friction`](Self::with_friction).
    pub fn with_bounds(
        size: (u32, u32),
        cell_size: (f64, f64),
        pace: &Pace,
        bounds: WalkingBounds,
        interrupt: &Interrupt,
        ground: impl Fn(u32, u32) -> Option<(f64, f64)>,
    ) -> Result<Self, WalkingError> {
        Self::made(size, (cell_size, pace), Some(bounds), interrupt, ground)
    }

    fn made(
        (width, height): (u32, u32),
        (cell_size, pace): ((f64, f64), &Pace),
        bounds: Option<WalkingBounds>,
        interrupt: &Interrupt,
        ground: impl Fn(u32, u32) -> Option<(f64, f64)>,
    ) -> Result<Self, WalkingError> {
        let size = CostsError::Size { width: width.into(), height: height.into() };
        let layout = Layout::new(width.into(), height.into()).ok_or(size)?;
        check_cell_size(cell_size)?;
        let cells = Cells { layout, interrupt, ground };
        let found = cells.bounds()?;
        let bounds = bounds.filter(WalkingBounds::are_numbers).unwrap_or(found);
        let ((lowest, highest), (smooth, rough)) = (bounds.elevation, bounds.friction);
        let height_exponent = (floor_log2(highest - lowest) + 1 - DIGITS.0).max(-FINEST);
        let height = |elevation: f64| within(bounds.elevation, elevation) - lowest;
        let above = |elevation: f64| (height(elevation) * exp2(-height_exponent)).round() as i32;
        let heights = cells.numbers(BLOCKED, |elevation, _| above(elevation))?;
        let steepest = steepest(layout, &heights, cell_size, interrupt)? * exp2(height_exponent);
        let knots = clip(&pace.knots(steepest)?, steepest);
        let (least, greatest) = times_of(&knots).map_err(|time| WalkingError::Pace { steepest, time })?;
        let (least, greatest) = (least + smooth, greatest + rough);
        let range = WalkingError::Range { least, greatest, steepest };
        if steepest > STEEPEST || greatest > least * GREATEST_RATIO {
            return Err(range);
        }
        let time_exponent = floor_log2(greatest) + 1 - DIGITS.1;
        let vertices = u64::from(layout.width()) * u64::from(layout.height());
        let exponent = exponent(vertices, [least, greatest], cell_size).ok_or(range)?;
        let friction =
            if rough > 0.0 { Some(Friction::new(&cells, (smooth, rough), time_exponent)?) } else { None };
        let pace = PaceTable::new(&knots, steepest, time_exponent);
        let id = MapId::of_size(layout.width(), layout.height());
        let mut map = Self {
            layout,
            cell_size,
            heights,
            lowest,
            height_exponent,
            friction,
            pace,
            time_exponent,
            exponent,
            bounds,
            id,
        };
        map.id = map.identity(interrupt)?;
        Ok(map)
    }

    fn identity(&self, interrupt: &Interrupt) -> Result<MapId, WalkingError> {
        let mut id = self.id;
        let (x, y) = self.cell_size;
        let exponents = [self.height_exponent, self.time_exponent, self.exponent].map(|of| of as u64);
        let numbers = [x, y, self.lowest].map(f64::to_bits).into_iter().chain(exponents);
        for (at, word) in (0..).zip(numbers.chain(self.pace.words().map(|word| word as u64))) {
            id = id.with_term(u64::MAX - at, [0, word]);
        }
        for (band, heights) in self.heights.chunks(1 << 16).enumerate() {
            interrupt.check("digesting the elevations")?;
            for (at, &height) in (band << 16..).zip(heights).filter(|(_, height)| **height != BLOCKED) {
                let friction = self.friction_of(at);
                id = id.with_term(at as u64, [0, u64::from(friction) << 32 | u64::from(height as u32)]);
            }
        }
        Ok(id)
    }

    /// The number of columns.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.layout.width()
    }

    /// The number of rows.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.layout.height()
    }

    /// The width and the height of a cell.
    #[must_use]
    pub const fn cell_size(&self) -> (f64, f64) {
        self.cell_size
    }

    /// The elevation of a cell, as it is kept; `None` for a blocked cell and outside.
    #[must_use]
    pub fn elevation(&self, x: u32, y: u32) -> Option<f64> {
        let height = self.heights[self.position(x, y)?];
        (height != BLOCKED).then(|| self.lowest + f64::from(height) * exp2(self.height_exponent))
    }

    /// The friction of a cell, as it is kept; `None` for a blocked cell and outside.
    #[must_use]
    pub fn friction(&self, x: u32, y: u32) -> Option<f64> {
        let at = self.position(x, y)?;
        let shift = self.friction.as_ref().map_or(0, |friction| friction.shift);
        let unit = exp2(self.time_exponent + shift as i32);
        (self.heights[at] != BLOCKED).then(|| f64::from(self.friction_of(at)) * unit)
    }

    /// Whether a cell is blocked; those outside the map are.
    #[must_use]
    pub fn is_blocked(&self, x: i32, y: i32) -> bool {
        u32::try_from(x).ok().zip(u32::try_from(y).ok()).is_none_or(|(x, y)| self.elevation(x, y).is_none())
    }

    /// The bounds of the time of a unit of length on the slopes of the map, friction included.
    #[must_use]
    pub fn bounds(&self) -> (f64, f64) {
        let (least, greatest) = self.times();
        let unit = exp2(self.time_exponent);
        (least as f64 * unit, greatest as f64 * unit)
    }

    /// The bounds of the elevations and frictions, as given, for [`with_bounds`](Self::with_bounds).
    #[must_use]
    pub const fn ground_bounds(&self) -> WalkingBounds {
        self.bounds
    }

    /// The unit of the integer costs of moves and paths on it: a power of two.
    #[must_use]
    pub fn unit(&self) -> f64 {
        exp2(self.exponent)
    }

    /// The identity of the map: the same for all with the same cells, elevations, frictions and pace.
    #[must_use]
    pub const fn id(&self) -> MapId {
        self.id
    }

    /// The memory used, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let friction = self.friction.as_ref().map_or(0, |friction| size_of_val(&*friction.of));
        size_of_val(&*self.heights) + friction + self.pace.memory_bytes()
    }

    fn position(&self, x: u32, y: u32) -> Option<usize> {
        (x < self.width() && y < self.height()).then(|| self.layout.position(x as i32, y as i32))
    }

    fn friction_of(&self, at: usize) -> u32 {
        self.friction.as_ref().map_or(0, |friction| friction.of[at])
    }

    pub(super) const fn layout(&self) -> Layout {
        self.layout
    }

    /// By position; `BLOCKED` for none.
    #[inline]
    pub(super) fn heights(&self) -> &[i32] {
        &self.heights
    }

    /// By position, with the binary digits between its unit and that of the times.
    #[inline]
    pub(super) fn frictions(&self) -> Option<(&[u32], u32)> {
        self.friction.as_ref().map(|friction| (&*friction.of, friction.shift))
    }

    pub(super) const fn pace(&self) -> &PaceTable {
        &self.pace
    }

    /// The bounds of the times of a unit of length, in their unit.
    pub(super) fn times(&self) -> (u64, u64) {
        let (least, greatest) =
            self.friction.as_ref().map_or((0, 0), |friction| (friction.least, friction.greatest));
        (self.pace.least as u64 + least, self.pace.greatest as u64 + greatest)
    }

    /// A length, in units of costs a unit of time a unit of length.
    pub(super) fn units(&self, length: f64) -> f64 {
        length * exp2(self.time_exponent - self.exponent)
    }

    /// The unit of heights.
    pub(super) fn height_unit(&self) -> f64 {
        exp2(self.height_exponent)
    }
}

/// A bound of the slopes of pieces of moves, in units of height a unit of length.
///
/// Between four free cells the slope of a bilinear surface is within those of its edges, along x and along y.
/// Where cells are blocked, a piece may lead past some lines. Of three lines in a row two are of one kind, so
/// that it is a cell long at least. From end to end there is a way over the cells that it crosses, from one
/// to the next: as long as the piece along x and along y, and half a cell more, there and back, at each end.
/// One of the steps may lead over a corner.
fn steepest(
    layout: Layout,
    heights: &[i32],
    (width, height): (f64, f64),
    interrupt: &Interrupt,
) -> Result<f64, WalkingError> {
    let [mut along_x, mut along_y, mut diagonal] = [0_u32; 3];
    let mut is_open = true;
    for y in 0..layout.height() as i32 {
        interrupt.check("measuring the slopes")?;
        for x in 0..layout.width() as i32 {
            let at = |dx: i32, dy: i32| heights[layout.position(x + dx, y + dy)];
            let own = at(0, 0);
            is_open &= own != BLOCKED;
            let difference = |other: i32| {
                if own == BLOCKED || other == BLOCKED { 0 } else { own.abs_diff(other) }
            };
            along_x = along_x.max(difference(at(1, 0)));
            along_y = along_y.max(difference(at(0, 1)));
            diagonal = diagonal.max(difference(at(1, 1))).max(difference(at(-1, 1)));
        }
    }
    let [x, y, diagonal] = [along_x, along_y, diagonal].map(f64::from);
    let norm = |x: f64, y: f64| (x * x + y * y).sqrt();
    let bilinear = norm(x / width, y / height);
    let beyond = (2.0 * x.max(y) + (diagonal - x - y).max(0.0)) / width.min(height);
    let bound = if is_open { bilinear } else { (bilinear + beyond).max(diagonal / norm(width, height)) };
    // More than roundings take away.
    Ok(bound * (1.0 + exp2(-50)))
}

/// Maps with the same cells, elevations, frictions and pace are one.
impl PartialEq for WalkingMap {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id && self.heights == other.heights
    }
}

impl fmt::Debug for WalkingMap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("WalkingMap")
            .field("id", &self.id)
            .field("bounds", &self.bounds())
            .finish_non_exhaustive()
    }
}
