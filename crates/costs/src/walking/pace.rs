//! The pace: how long a unit of length takes, by the slope.

use std::str::FromStr;

use mediant_grid::names::{UnknownName, means};

use super::WalkingError;

/// The time that a unit of horizontal length takes, by the slope: the rise over the horizontal length, below
/// 0 downhill.
///
/// Costs are then times, in the unit of the pace: seconds, where it is seconds a meter, as those here are.
///
/// ```
/// use mediant_costs::{Langmuir, Pace};
///
/// assert_eq!(Pace::Langmuir(Langmuir::default()).time(0.5), 0.72 + 6.0 * 0.5);
/// // 6 km/h, gently downhill.
/// assert!((Pace::Tobler.time(-0.05) - 3.6 / 6.0).abs() < 1e-12);
/// let wheels = Pace::Table(vec![(-0.1, 0.4), (0.0, 0.5), (0.1, 1.5)]);
/// assert!((wheels.time(0.05) - 1.0).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Pace {
    /// Tobler's hiking function (1993): the speed is 6 exp(−3.5 |slope + 0.05|) km/h. Costs are seconds where
    /// lengths are meters. On steeper slopes than 3 (72°) the pace is that of 3.
    Tobler,
    /// The walking times of Langmuir (1984), as `r.walk` of GRASS has them.
    Langmuir(Langmuir),
    /// Slopes in increasing order, each with its time, which is a positive number. It is linear between them,
    /// and stays as it is beyond the first and the last. Where the same slope stands twice the time jumps: at
    /// the slope itself it is the second one.
    Table(Vec<(f64, f64)>),
}

/// The numbers of [`Pace::Langmuir`]. A unit of length takes `a`, and to it comes: uphill `b` for each unit
/// of height; downhill `c` for each unit of height that is lost, subtracted, and on slopes below
/// `slope_factor` `d`, subtracted as well, so that it is negative where that takes longer.
///
/// These are the parameters `walk_coeff` and `slope_factor` of `r.walk`, whose default they have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Langmuir {
    /// On the flat: 0.72 s/m is 5 km/h.
    pub a: f64,
    /// Uphill.
    pub b: f64,
    /// Downhill, as long as it is not steep.
    pub c: f64,
    /// Steeply downhill.
    pub d: f64,
    /// The slope below which it is steep: −0.2125 is 12° downhill.
    pub slope_factor: f64,
}

impl Default for Langmuir {
    fn default() -> Self {
        Self { a: 0.72, b: 6.0, c: 1.9998, d: -1.9998, slope_factor: -0.2125 }
    }
}

/// The slope beyond which Tobler's function stays as it is, either way.
const STEEPEST: f64 = 3.0;
/// The slope of the greatest speed.
const FASTEST: f64 = -0.05;
/// Tobler's function is kept at multiples of 1 over this, and linear between: by 1.5·10⁻⁶ too slow at most.
const STEPS: f64 = 1024.0;

/// `tobler`, or `langmuir` with its usual numbers.
///
/// ```
/// use mediant_costs::Pace;
/// assert_eq!("Tobler".parse(), Ok(Pace::Tobler));
/// assert_eq!(Pace::Tobler.name(), Some("tobler"));
/// let error = "naismith".parse::<Pace>().unwrap_err();
/// assert_eq!(error.to_string(), "expected one of tobler, langmuir, found `naismith`");
/// ```
impl FromStr for Pace {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        match Self::NAMES.iter().position(|name| means(text, name)) {
            Some(0) => Ok(Self::Tobler),
            Some(_) => Ok(Self::Langmuir(Langmuir::default())),
            None => Err(UnknownName { found: text.to_owned(), known: Self::NAMES.join(", ") }),
        }
    }
}

impl Pace {
    /// The names of the paces that have one.
    pub const NAMES: [&'static str; 2] = ["tobler", "langmuir"];

    /// Its name; `None` for a table, and for Langmuir's rule with other numbers than the usual ones.
    #[must_use]
    pub fn name(&self) -> Option<&'static str> {
        let [tobler, langmuir] = Self::NAMES;
        match self {
            Self::Tobler => Some(tobler),
            Self::Langmuir(of) => (*of == Langmuir::default()).then_some(langmuir),
            Self::Table(_) => None,
        }
    }

    /// The time of a unit of horizontal length on a slope. Maps have it as integers, and Tobler's function at
    /// multiples of 1/1024, linear between.
    #[must_use]
    pub fn time(&self, slope: f64) -> f64 {
        match self {
            // 6 km/h are 0.6 s/m.
            Self::Tobler => 0.6 * libm::exp(3.5 * (slope.clamp(-STEEPEST, STEEPEST) - FASTEST).abs()),
            Self::Langmuir(of) => of.a + of.coefficient(slope) * slope,
            Self::Table(knots) => {
                let next = knots.partition_point(|&(known, _)| known <= slope);
                match (next.checked_sub(1).and_then(|last| knots.get(last)), knots.get(next)) {
                    (Some(&(from, time)), Some(&(to, later))) => {
                        time + (later - time) * ((slope - from) / (to - from))
                    }
                    (Some(&(_, time)), None) | (None, Some(&(_, time))) => time,
                    (None, None) => f64::NAN,
                }
            }
        }
    }

    /// The slopes between which the pace is linear, in increasing order, with their times; the same slope
    /// twice where it jumps. The first and the last are as steep as `steepest` either way, unless the pace
    /// stays as it is from there on.
    pub(super) fn knots(&self, steepest: f64) -> Result<Vec<(f64, f64)>, WalkingError> {
        let knots = match self {
            Self::Tobler => {
                let last = (steepest.min(STEEPEST) * STEPS).ceil() as i32;
                let mut slopes: Vec<f64> = (-last..=last).map(|step| f64::from(step) / STEPS).collect();
                slopes.insert(slopes.partition_point(|&slope| slope < FASTEST), FASTEST);
                slopes.into_iter().map(|slope| (slope, self.time(slope))).collect()
            }
            Self::Langmuir(of) if of.slope_factor.is_nan() => {
                return Err(WalkingError::Pace { steepest, time: f64::NAN });
            }
            Self::Langmuir(of) => of.knots(steepest),
            Self::Table(knots) => knots.clone(),
        };
        let is_ordered = knots.is_sorted_by(|(one, _), (other, _)| one <= other);
        let is_table = !knots.is_empty() && is_ordered && knots.iter().all(|(slope, _)| slope.is_finite());
        if is_table { Ok(knots) } else { Err(WalkingError::Table) }
    }
}

impl Langmuir {
    /// The time that a unit of height adds on a slope.
    fn coefficient(&self, slope: f64) -> f64 {
        if slope >= 0.0 {
            self.b
        } else if slope < self.slope_factor {
            self.d
        } else {
            self.c
        }
    }

    fn knots(&self, steepest: f64) -> Vec<(f64, f64)> {
        let Self { a, b, c, d, slope_factor } = *self;
        let downhill = if (-steepest..0.0).contains(&slope_factor) {
            vec![(-steepest, d), (slope_factor, d), (slope_factor, c), (0.0, c)]
        } else {
            // None of it is steep, or all.
            let by = if slope_factor < 0.0 { c } else { d };
            vec![(-steepest, by), (0.0, by)]
        };
        let knots = downhill.into_iter().chain([(0.0, b), (steepest, b)]);
        knots.map(|(slope, by)| (slope, a + by * slope)).collect()
    }
}
