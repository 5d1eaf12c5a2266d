//! The answer to an instance, as far as it is compared.

use std::fmt;

use mediant::{Cost, Ends, Error, Field, K, Motion, Path, Planner, Space, options::ConfiguredEngine};
use sha2::{Digest, Sha256};

/// The relative error that lengths at any angle may have: that of fixed-point costs.
const ERROR: f64 = 1.0 / (1_u64 << 31) as f64;

/// The answer to an instance.
#[derive(Clone, Debug)]
pub(super) enum Outcome {
    /// The ends are no free vertices.
    Refused,
    /// There is no path.
    NoPath,
    /// The cost of a path over N(k): an integer.
    Exact(Cost),
    /// The length of a path at any angle, in cells.
    Length(f64),
    /// An answer that no engine may give: a path that does not hold on the map, or an error.
    Broken(String),
}

impl Outcome {
    /// Whether two engines agree: over N(k) on the same integer, at any angle on the length up to 2⁻³¹ of it.
    pub(super) fn agrees(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Refused, Self::Refused) | (Self::NoPath, Self::NoPath) => true,
            (Self::Exact(a), Self::Exact(b)) => a == b,
            (Self::Length(a), Self::Length(b)) => (a - b).abs() <= ERROR * a.max(*b),
            _ => false,
        }
    }

    /// Whether this cost is at most another one times `factor`, integers exactly if the factor is 1. No path
    /// costs more than any.
    pub(super) fn is_at_most(&self, factor: f64, other: &Self) -> bool {
        match (self, other) {
            (Self::Broken(_), _) | (_, Self::Broken(_)) => false,
            (Self::Refused, _) | (_, Self::Refused) => self.agrees(other),
            (_, Self::NoPath) => true,
            (Self::NoPath, _) => false,
            (Self::Exact(a), Self::Exact(b)) if factor == 1.0 => a <= b,
            _ => self.cells() <= other.cells() * factor * (1.0 + ERROR),
        }
    }

    /// The same cost on a map that is `factor` times as large.
    pub(super) fn scaled(&self, factor: u32) -> Self {
        match self {
            Self::Exact(cost) => Self::Exact(Cost::from_bits(cost.to_bits() * u64::from(factor))),
            Self::Length(length) => Self::Length(length * f64::from(factor)),
            other => other.clone(),
        }
    }

    /// The cost of one path after another; none if one of them is not there.
    pub(super) fn plus(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::Exact(a), Self::Exact(b)) => Self::Exact(*a + *b),
            (Self::Length(a), Self::Length(b)) => Self::Length(a + b),
            (Self::Broken(_), _) => self.clone(),
            (_, Self::Broken(_)) => other.clone(),
            (Self::Refused, _) | (_, Self::Refused) => Self::Refused,
            _ => Self::NoPath,
        }
    }

    /// Whether a path was found.
    pub(super) const fn is_path(&self) -> bool {
        matches!(self, Self::Exact(_) | Self::Length(_))
    }

    /// The cost in cells; infinite without a path.
    pub(super) fn cells(&self) -> f64 {
        match self {
            Self::Exact(cost) => cost.to_f64(),
            Self::Length(length) => *length,
            _ => f64::INFINITY,
        }
    }

    /// A length in cells that a field or a planner tells. Over N(k) it is an integer of [`Cost`] units.
    pub(super) fn of_cells(k: K, cells: f64) -> Self {
        match k {
            K::Finite(_) => {
                Self::Exact(Cost::from_bits((cells * (1_u64 << Cost::FRACTION_BITS) as f64) as u64))
            }
            K::Any => Self::Length(cells),
        }
    }

    /// The distance that a field from the instance's start has at its goal.
    pub(super) fn of_field(field: &Field, motion: Motion, ends: Ends) -> Self {
        field.get(ends.goal).map_or(Self::NoPath, |cells| Self::of_cells(motion.k, cells))
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused => f.write_str("refused"),
            Self::NoPath => f.write_str("no path"),
            Self::Exact(cost) => write!(f, "{} ({} units)", cost.to_f64(), cost.to_bits()),
            Self::Length(length) => write!(f, "{length}"),
            Self::Broken(wrong) => write!(f, "broken: {wrong}"),
        }
    }
}

/// Whether both ends are free vertices, so that a query is none that must be refused.
pub(super) fn takes(space: &Space, ends: Ends) -> bool {
    space.is_free(ends.start) && space.is_free(ends.goal)
}

/// A planner that is asked for costs.
pub(super) struct Asker {
    pub(super) space: Space,
    pub(super) planner: Planner,
    digest: Sha256,
}

/// A number by which the same answers are known on another platform.
pub(super) fn number(digest: Sha256) -> u64 {
    digest.finalize().iter().take(8).fold(0, |number, &byte| number << 8 | u64::from(byte))
}

impl Asker {
    pub(super) fn new(space: &Space, engine: impl Into<ConfiguredEngine>) -> Result<Self, Error> {
        Ok(Self::of(space.planner(engine)?))
    }

    pub(super) fn of(planner: Planner) -> Self {
        Self { space: planner.index().space().clone(), planner, digest: Sha256::new() }
    }

    /// A number that all its answers decide: each point of each path.
    pub(super) fn digest(self) -> u64 {
        number(self.digest)
    }

    /// The cost of the path that it finds, which must hold on the map, consist of moves of N(k) and join both
    /// ends.
    pub(super) fn cost(&mut self, ends: Ends) -> Outcome {
        self.path(ends).0
    }

    /// [`cost`](Self::cost), which must also be the distance that the planner tells without a path: labels
    /// find it in another way.
    pub(super) fn cost_twice(&mut self, ends: Ends) -> Outcome {
        let outcome = self.cost(ends);
        let k = self.space.motion().k;
        let told = match self.planner.distance(ends) {
            Ok(Some(cells)) => Outcome::of_cells(k, cells),
            Ok(None) => Outcome::NoPath,
            Err(_) => Outcome::Refused,
        };
        match outcome.agrees(&told) || matches!(outcome, Outcome::Broken(_)) {
            true => outcome,
            false => Outcome::Broken(format!("a path that costs {outcome}, and the distance {told}")),
        }
    }

    /// [`cost`](Self::cost), with the path.
    pub(super) fn path(&mut self, ends: Ends) -> (Outcome, Option<Path>) {
        let (outcome, path) = self.judged_path(ends);
        self.digest.update(outcome.to_string());
        for (x, y) in path.iter().flat_map(Path::points).map(mediant::Point::parts) {
            self.digest.update(x.to_le_bytes());
            self.digest.update(y.to_le_bytes());
        }
        (outcome, path)
    }

    fn judged_path(&mut self, ends: Ends) -> (Outcome, Option<Path>) {
        let found = self.planner.path(ends.start, ends.goal);
        if !takes(&self.space, ends) {
            let outcome = match found {
                Err(_) => Outcome::Refused,
                Ok(_) => Outcome::Broken("it answers a query whose end is not free".to_owned()),
            };
            return (outcome, None);
        }
        let path = match found {
            Ok(Some(path)) => path,
            Ok(None) => return (Outcome::NoPath, None),
            Err(error) => return (Outcome::Broken(error.to_string()), None),
        };
        let motion = self.space.motion();
        let joins = path.start() == Some(ends.start.into()) && path.goal() == Some(ends.goal.into());
        if let Err(broken) = self.space.check(&path) {
            return (Outcome::Broken(format!("{broken}: {path}")), None);
        }
        if !joins || !path.is_over(motion.k) {
            return (Outcome::Broken(format!("no path over k = {} from end to end: {path}", motion.k)), None);
        }
        let outcome = match motion.k {
            K::Finite(k) => Outcome::Exact(mediant::Guarantee::Optimal(k).cost(&path)),
            K::Any => Outcome::Length(path.length()),
        };
        (outcome, Some(path))
    }
}
