//! Laws that answers obey whatever the optimum is.

mod changes;
mod maps;
mod order;
mod paths;

use mediant::{CornerRule, DiagonalGap, Engine, Error, FiniteK, K, Map, Motion, Rules, Vertex};
use mediant_grid::names;

use super::{
    outcome::Asker,
    tally::Tally,
    terrain::{Instance, Terrain},
};

/// The name of the count of comparisons.
pub(super) const CASES: &str = "cases";

/// A law. Each instance is asked under one motion of the law's, in turn, but those of `Order…` under all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Law {
    /// At corners more directions make no path longer, fewer at most by the bound, and an open gap none.
    OrderAtCorners,
    /// Between centers more directions make no path longer, nor does a rule that allows more.
    OrderAtCenters,
    /// The way back costs the same.
    Symmetry,
    /// A way by a third vertex costs no less.
    Triangle,
    /// The parts of a shortest path are shortest paths.
    Parts,
    /// On the mirrored and the turned map paths cost the same.
    Mirrored,
    /// On the map of twice and three times the size they cost twice and three times as much.
    Scaled,
    /// A repaired index equals a new one, in the sense that is promised of it.
    Repaired,
    /// Where each cell costs 1, paths cost their length.
    UnitCosts,
    /// Several threads find the same paths as one.
    Threads,
}

names!(Law:
    OrderAtCorners => "order-corners",
    OrderAtCenters => "order-centers",
    Symmetry => "symmetry",
    Triangle => "triangle",
    Parts => "parts",
    Mirrored => "mirrored",
    Scaled => "scaled",
    Repaired => "repaired",
    UnitCosts => "unit-costs",
    Threads => "threads",
);

impl Law {
    /// Of each map, every so-manieth instance is asked: as many as take minutes a set, not hours.
    pub(super) const fn every(self) -> usize {
        match self {
            Self::OrderAtCorners => 1,
            Self::Symmetry | Self::Triangle | Self::Parts | Self::Mirrored | Self::Threads => 2,
            Self::OrderAtCenters | Self::Scaled => 20,
            Self::Repaired | Self::UnitCosts => 100,
        }
    }

    /// Proves the law on one terrain. `of` names the map.
    pub(super) fn prove(self, of: &str, terrain: &Terrain, tally: &mut Tally) -> Result<(), Error> {
        let case = Case { of, terrain };
        match self {
            Self::OrderAtCorners => order::at_corners(case, tally),
            Self::OrderAtCenters => order::at_centers(case, tally),
            Self::Symmetry => paths::symmetry(case, tally),
            Self::Triangle => paths::triangle(case, tally),
            Self::Parts => paths::parts(case, tally),
            Self::Mirrored => maps::mirrored(case, tally),
            Self::Scaled => maps::scaled(case, tally),
            Self::Repaired => changes::repaired(case, tally),
            Self::UnitCosts => changes::unit_costs(case, tally),
            Self::Threads => changes::threads(case, tally),
        }
    }
}

/// A terrain with the name of its map.
#[derive(Clone, Copy)]
struct Case<'a> {
    of: &'a str,
    terrain: &'a Terrain,
}

impl<'a> Case<'a> {
    /// The instances that are asked under motion `number` of `count`.
    fn share(self, number: usize, count: usize) -> impl Iterator<Item = &'a Instance> {
        self.terrain.instances.iter().skip(number).step_by(count)
    }

    /// The instance after this one.
    fn next(self, instance: &Instance) -> Option<&'a Instance> {
        self.terrain.instances.iter().find(|next| next.index > instance.index)
    }

    fn words(self, instance: &Instance, motion: Motion) -> String {
        super::families::words(self.of, instance, motion)
    }
}

/// Every k that the laws ask of, the finite ones in order.
fn ks() -> impl DoubleEndedIterator<Item = K> {
    (2..=8).filter_map(|k| K::new(k).ok()).chain([K::Any])
}

/// The motions at corners.
fn at_corners() -> Vec<Motion> {
    ks().flat_map(|k| DiagonalGap::ALL.map(|gap| Motion::new(k, gap))).collect()
}

/// All motions: at corners, between centers over N(k), and there at any angle.
fn all_motions() -> Vec<Motion> {
    let finite = ks().filter(|&k| k != K::Any);
    let between = finite.flat_map(|k| CornerRule::ALL.map(|rule| Motion::new(k, rule)));
    let any = Rules::BETWEEN_CENTERS.map(|rules| Motion::new(K::Any, rules));
    at_corners().into_iter().chain(between).chain(any).collect()
}

/// An engine that prepares little, is exact, and searches anew in each direction.
fn asker(map: &Map, motion: Motion) -> Result<Asker, Error> {
    let engine = match (motion.rules, motion.k) {
        (Rules::Corner(_) | Rules::CenterGap(_), _) => Engine::Anya,
        (Rules::Center(_), K::Finite(k)) if k <= FiniteK::N8 => Engine::JpsBlock,
        (Rules::Center(_), _) => Engine::Canonical,
    };
    Asker::new(&map.space(motion)?, engine)
}

/// Whether two blocked cells touch at this corner, and the other two are free.
fn is_double_corner(map: &Map, at: Vertex) -> bool {
    let blocked = |dx, dy| map.is_blocked((at.x + dx, at.y + dy));
    let own = blocked(0, 0);
    own == blocked(-1, -1) && blocked(0, -1) == blocked(-1, 0) && own != blocked(0, -1)
}

/// Whether paths of this motion end at a closed gap there, which they may leave only through its own cell.
fn is_closed_gap(map: &Map, motion: Motion, at: Vertex) -> bool {
    motion.rules == Rules::Corner(DiagonalGap::Closed) && is_double_corner(map, at)
}
