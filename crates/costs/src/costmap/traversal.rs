//! From a costmap to a cost surface: how length and cost add up.

use mediant_grid::Interrupt;

use super::Costmap;
use crate::{error::CostsError, surface::CostSurface};

/// The cells of a [`Costmap`] that can be crossed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traversal {
    /// The side of a cell: 1, or the resolution of the map for costs in meters.
    pub cell_size: f64,
    /// The byte that an unknown cell is taken for; `None` blocks it. nav2's planners, with `allow_unknown`,
    /// take it for about the dearest free one, 252.
    pub unknown: Option<u8>,
    /// Whether inscribed cells can be crossed, at the cost of byte 253. The robot touches obstacles there.
    pub inscribed: bool,
}

/// Cells of side 1; unknown and inscribed cells are blocked.
impl Default for Traversal {
    fn default() -> Self {
        Self { cell_size: 1.0, unknown: None, inscribed: false }
    }
}

impl Costmap {
    /// The weight with which [`to_costs`](Self::to_costs) adds up length and cost as nav2's NavFn does: it
    /// gives a cell 50 + 0.8 · cost, cut to an integer, where a free one has 50.
    pub const NAVFN: f64 = 0.8 * 252.0 / 50.0;

    /// The surface on which a cell costs 1 + `weight` · byte / 252 a unit of length: 1 where it is free, and
    /// 1 + `weight` next to inscribed cells. Lethal cells are blocked; inscribed and unknown ones as
    /// `traversal` says.
    ///
    /// So the cost of a path is its length + `weight` · the integral of the cost along it. nav2's planners
    /// have the same but for the integral: they take the cost of the cell that a move enters.
    ///
    /// | planner | what it gives a cell of cost c | here |
    /// |---|---|---|
    /// | Smac 2D | length · (1 + `cost_travel_multiplier` · c / 252) | `weight` is that multiplier |
    /// | NavFn | 50 + 0.8 · c | `weight` is [`NAVFN`](Self::NAVFN), 4.032 |
    /// | Theta* | `w_euc_cost` · length, `w_traversal_cost` · ((26 + 0.9 c) / 252)² a cell | [`to_costs_by`](Self::to_costs_by) |
    ///
    /// Such a path keeps off walls all along, as far as the weight pays for. `Clearance::widest` of
    /// `mediant-grid` finds a path that comes as little near as any does, and is the shortest of these. In
    /// `tests/it/robots.rs`, with a narrow door and a wide gate, the three paths are
    ///
    /// | path | length | least distance to a wall | in the mean |
    /// |---|---|---|---|
    /// | the shortest, by the door | 43.0 | 1.5 | 6.9 |
    /// | with soft costs, by the gate | 58.8 | 5.5 | 9.5 |
    /// | of the widest disc, by the gate | 55.1 | 5.5 | 8.6 |
    ///
    /// ```
    /// use mediant_costs::{Costmap, Traversal};
    /// use mediant_grid::Interrupt;
    ///
    /// let costmap = Costmap::from_bytes(5, 1, [0, 126, 253, 254, 255])?;
    /// let rooms = Traversal { unknown: Some(252), ..Traversal::default() };
    /// let costs = costmap.to_costs(2.0, &rooms, &Interrupt::NEVER)?;
    /// let costs = [0, 1, 2, 3, 4].map(|x| costs.cost(x, 0));
    /// assert_eq!(costs, [Some(1.0), Some(2.0), None, None, Some(3.0)]);
    /// # Ok::<(), mediant_costs::CostsError>(())
    /// ```
    ///
    /// # Errors
    /// [`CostsError::Setting`] for a weight that is negative or not finite; [`CostsError::CellSize`];
    /// [`CostsError::Range`] for one above 65,535; [`CostsError::Interrupted`].
    pub fn to_costs(
        &self,
        weight: f64,
        traversal: &Traversal,
        interrupt: &Interrupt,
    ) -> Result<CostSurface, CostsError> {
        if !(weight.is_finite() && weight >= 0.0) {
            let name = "weight";
            return Err(CostsError::Setting { name, value: weight, expected: "a number from 0 on" });
        }
        let cost = |byte: u8| 1.0 + weight * f64::from(byte) / f64::from(Self::DEAREST);
        self.to_costs_by(traversal.cell_size, interrupt, |byte| match byte {
            Self::UNKNOWN => traversal.unknown.map(cost),
            Self::LETHAL => None,
            Self::INSCRIBED => traversal.inscribed.then(|| cost(byte)),
            _ => Some(cost(byte)),
        })
    }

    /// The surface on which a cell costs `cost(byte)` a unit of length, or is blocked. It is asked once for
    /// each of the 256 bytes.
    ///
    /// ```
    /// use mediant_costs::Costmap;
    /// use mediant_grid::Interrupt;
    ///
    /// // As Theta* of nav2 weighs costs, but for a cell's length where it counts cells.
    /// let (w_euc_cost, w_traversal_cost) = (1.0, 2.0);
    /// let cost = |byte| {
    ///     let shade = (26.0 + 0.9 * f64::from(byte)) / 252.0;
    ///     (byte <= Costmap::DEAREST).then_some(w_euc_cost + w_traversal_cost * shade * shade)
    /// };
    /// let costmap = Costmap::from_bytes(2, 1, [0, 252])?;
    /// let costs = costmap.to_costs_by(1.0, &Interrupt::NEVER, cost)?;
    /// assert!(costs.cost(1, 0) > costs.cost(0, 0));
    /// # Ok::<(), mediant_costs::CostsError>(())
    /// ```
    ///
    /// # Errors
    /// As those of [`CostSurface::with_cells`].
    pub fn to_costs_by(
        &self,
        cell_size: f64,
        interrupt: &Interrupt,
        cost: impl Fn(u8) -> Option<f64>,
    ) -> Result<CostSurface, CostsError> {
        let costs = std::array::from_fn(|byte| cost(byte as u8));
        CostSurface::of_bytes((self.width, self.height), &self.bytes, &costs, cell_size, interrupt)
    }
}
