//! The tables of a search graph that depend on its rules of motion and k alone, shared by all maps.

use std::sync::{Arc, Mutex, PoisonError};

use mediant_moves::{Cost, FiniteK, KError, Neighborhood, Vector};

use crate::{
    PerMotion, Placement,
    footprint::Footprint,
    tree::{Octant, Tree},
};

/// The tables of all rules and k that were asked for.
static KNOWN: PerMotion<Result<Tables, KError>> = PerMotion::new();

/// The tables that all search graphs of one placement, rule of motion and k share.
#[derive(Debug)]
pub(crate) struct Tables {
    moves: Box<[(Vector, Cost)]>,
    /// For each pattern of cells around a vertex, the legal moves of N(min(k, 3)).
    short: Box<[u8]>,
    /// The moves of an octant beyond N(3); none up to k = 3.
    tree: Tree,
    /// The octants of the last map. Octants of more maps are not kept, so the number of rules and k bounds
    /// the memory of the process.
    last: Mutex<Option<Placed>>,
}

/// The octants of all maps with so many bits a row and a column.
#[derive(Debug)]
struct Placed {
    bits_per_row: [i32; 2],
    octants: Arc<[Octant]>,
}

impl Tables {
    /// The tables of a rule and k: computed by the first that asks for them.
    pub(crate) fn of<P: Placement>(rule: P::Rule, k: FiniteK) -> Result<&'static Self, KError> {
        let tables = KNOWN.get(P::rules(rule), k, || Self::new::<P>(rule, k))?;
        tables.as_ref().map_err(|&error| error)
    }

    fn new<P: Placement>(rule: P::Rule, k: FiniteK) -> Result<Self, KError> {
        let moves = Neighborhood::new(k)?;
        let moves: Box<[_]> = moves.iter().map(|v| (v, Cost::of_move(v))).collect();
        Ok(Self {
            short: short::<P>(rule, &moves),
            tree: Tree::new::<P>(rule, &moves),
            moves,
            last: Mutex::new(None),
        })
    }

    /// The moves of N(k) with their costs, by index.
    pub(crate) const fn moves(&self) -> &[(Vector, Cost)] {
        &self.moves
    }

    /// For each pattern of cells around a vertex, the legal moves of N(min(k, 3)), one bit each.
    pub(crate) const fn short(&self) -> &[u8] {
        &self.short
    }

    /// The trees over the moves beyond N(3), for a map and a transposed map with so many bits a row.
    pub(crate) fn octants<P: Placement>(&self, bits_per_row: [i32; 2]) -> Arc<[Octant]> {
        // No masks, no width.
        let bits_per_row = if self.tree.is_empty() { [0; 2] } else { bits_per_row };
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(Placed { octants, .. }) = last.as_ref().filter(|last| last.bits_per_row == bits_per_row) {
            return Arc::clone(octants);
        }
        let octants = self.tree.octants::<P>(&self.moves, bits_per_row);
        *last = Some(Placed { bits_per_row, octants: Arc::clone(&octants) });
        octants
    }
}

/// For each pattern of cells around a vertex, the legal moves of N(min(k, 3)), one bit each.
fn short<P: Placement>(rule: P::Rule, moves: &[(Vector, Cost)]) -> Box<[u8]> {
    // Between two neighbors of N(3), N(k) has 2^(k − 3) − 1 moves more.
    let short = moves.iter().step_by((moves.len() / 8).max(1));
    let footprints: Vec<Footprint> = short.map(|&(v, _)| Footprint::new::<P>(rule, v)).collect();
    let legal = |pattern: usize| {
        footprints.iter().zip(0..).fold(0, |set, (footprint, bit)| {
            let legal = footprint.is_legal(|(dx, dy)| !P::pattern_is_blocked(pattern, dx, dy));
            set | u8::from(legal) << bit
        })
    };
    (0..P::PATTERNS).map(legal).collect()
}
