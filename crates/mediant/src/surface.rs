//! The costs of paths in a space whose cells have costs or elevations.

use std::sync::Arc;

#[cfg(feature = "costs")]
use mediant_grid::Vertex;
use mediant_grid::{Identity, Interrupt};
use mediant_search::{Path, PathCosts, Smoothing};

#[cfg(not(feature = "costs"))]
pub(crate) use self::absent::Surface;
#[cfg(feature = "costs")]
pub(crate) use self::given::Surface;
use crate::{
    engine::Engine, error::Error, motion::Motion, setup::Setup, setup_error::SetupError, space::Space,
};

/// Numbers of cells by which paths cost something else than their length.
pub(crate) trait Weighed {
    fn identity(&self) -> Identity;

    fn memory_bytes(&self) -> usize;

    fn path_costs(&self) -> Arc<dyn PathCosts>;

    /// The cost of a path; `None` if one of its moves is not legal or none of N(k).
    fn cost(&self, path: &Path) -> Option<f64>;
}

#[cfg(feature = "costs")]
mod given {
    use std::sync::Arc;

    use mediant_costs::{CostGraph, smooth};
    use mediant_grid::{Identity, Rectangle};
    use mediant_search::{Path, PathCosts};

    use super::Weighed;
    use crate::{costs::Costs, error::Error};

    /// Costs of cells, and their search graph.
    #[derive(Clone, Debug)]
    pub(crate) struct Surface {
        pub(crate) costs: Costs,
        pub(crate) graph: Arc<CostGraph>,
    }

    impl Surface {
        /// The same rules and k on other costs, which differ in these places.
        pub(crate) fn after(&self, costs: &Costs, places: &[Rectangle]) -> Result<Self, Error> {
            let rows = |at: &Rectangle| at.y..at.y + at.height;
            let cells = places.iter().flat_map(|at| {
                let columns = at.x..at.x + at.width;
                rows(at).flat_map(move |y| columns.clone().map(move |x| (x, y)))
            });
            let cells: Vec<_> = cells.collect();
            let graph = Arc::new(self.graph.after(Arc::clone(costs.surface()), &cells)?);
            Ok(Self { costs: costs.alone(), graph })
        }
    }

    impl Weighed for Surface {
        fn identity(&self) -> Identity {
            self.graph.identity()
        }

        fn memory_bytes(&self) -> usize {
            self.graph.map().memory_bytes() + self.graph.memory_bytes()
        }

        fn path_costs(&self) -> Arc<dyn PathCosts> {
            Arc::<CostGraph>::clone(&self.graph)
        }

        fn cost(&self, path: &Path) -> Option<f64> {
            self.graph.segments_cost(path).map(|cost| self.graph.to_f64(cost))
        }
    }

    impl Surface {
        /// A path of straight segments that costs no more.
        pub(crate) fn smooth(&self, path: &Path) -> Path {
            smooth(&self.graph, path).map_or_else(|| path.clone(), |(smoothed, _)| smoothed)
        }
    }
}

#[cfg(not(feature = "costs"))]
mod absent {
    use std::sync::Arc;

    use mediant_grid::Identity;
    use mediant_search::{Path, PathCosts};

    use super::Weighed;

    /// Without the feature `costs` no space has a surface.
    #[derive(Clone, Debug)]
    pub(crate) enum Surface {}

    impl Weighed for Surface {
        fn identity(&self) -> Identity {
            match *self {}
        }

        fn memory_bytes(&self) -> usize {
            match *self {}
        }

        fn path_costs(&self) -> Arc<dyn PathCosts> {
            match *self {}
        }

        fn cost(&self, _: &Path) -> Option<f64> {
            match *self {}
        }
    }

    impl Surface {
        pub(crate) fn smooth(&self, _: &Path) -> Path {
            match *self {}
        }
    }
}

impl Space {
    /// Whether its paths have costs: its cells have costs or elevations.
    pub(crate) fn has_costs(&self) -> bool {
        self.weighed().is_some()
    }

    /// The costs of its paths, where they are not lengths.
    pub(crate) fn weighed(&self) -> Option<&dyn Weighed> {
        let walk = self.walk().map(|walk| walk as &dyn Weighed);
        self.surface().map(|surface| surface as &dyn Weighed).or(walk)
    }

    /// The cost of a path in this space: its length, but where cells have costs the cost by these. `None` if
    /// the path has no cost by them, since one of its segments is not legal.
    ///
    /// A [rest](Path::rest) of a path has to be measured so, and so has a path after an edit of costs.
    #[must_use]
    pub fn cost(&self, path: &Path) -> Option<f64> {
        match self.weighed() {
            Some(of) => of.cost(path),
            None => Some(path.length()),
        }
    }

    /// The cells that a path crosses in a space of costs, in their order on the way, each with the length of
    /// the path in it, in the unit of the [cell size](crate::Costs::cell_size). The sum of length times cost
    /// is the cost of the path. Along a line between two cells it is the one whose cost counts; a cell that
    /// is touched in a corner alone is left out. Empty for a path with a segment that is not legal.
    ///
    /// ```
    /// use mediant::{Map, Motion};
    ///
    /// let space = Map::new(3, 2)?.costs([1, 2, 4, 8, 8, 8])?.space(Motion::centers(4))?;
    /// let path = space.path((0, 0), (2, 0))?.expect("there is a way");
    /// let crossed = space.crossings(&path)?;
    /// assert_eq!(crossed, [((0, 0).into(), 0.5), ((1, 0).into(), 1.0), ((2, 0).into(), 0.5)]);
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`SetupError::WithoutCosts`] where cells have no costs.
    #[cfg(feature = "costs")]
    pub fn crossings(&self, path: &Path) -> Result<Vec<(Vertex, f64)>, Error> {
        let surface = self.surface().ok_or(SetupError::WithoutCosts)?;
        let crossed = surface.graph.crossings(path).into_iter();
        Ok(crossed.map(|((x, y), length)| (Vertex::new(x as i32, y as i32), length)).collect())
    }

    /// A path with its cost in this space. One without a cost costs more than any other.
    pub(crate) fn measured(&self, path: Path) -> Path {
        match self.weighed() {
            Some(of) => {
                let cost = of.cost(&path).unwrap_or(f64::INFINITY);
                Path::with_cost(path.into_waypoints(), cost)
            }
            None => path,
        }
    }

    /// The costs of its paths, where they are not lengths.
    pub(crate) fn path_costs(&self) -> Option<Arc<dyn PathCosts>> {
        self.weighed().map(|of| of.path_costs())
    }

    /// A cost of a search in this space as a number.
    #[cfg(feature = "trace")]
    pub(crate) fn to_f64(&self, cost: mediant_moves::Cost) -> f64 {
        self.path_costs().map_or_else(|| cost.to_f64(), |costs| cost.to_bits() as f64 * costs.unit())
    }

    /// Checks that a setup is one for this space.
    pub(crate) fn check_setup(&self, setup: &Setup) -> Result<(), SetupError> {
        let engine = setup.engine.kind();
        if self.walk().is_some() && !SetupError::OVER_ELEVATION.contains(&engine) {
            let others = SetupError::OVER_ELEVATION.map(Engine::name).join(", ");
            return Err(SetupError::Costs { engine, others });
        }
        if self.has_costs() {
            if !engine.capabilities().costs {
                return Err(SetupError::on_costs(engine));
            }
            if setup.smoothing == Some(Smoothing::Taut) {
                return Err(SetupError::TAUT_ON_COSTS);
            }
        }
        if self.walk().is_some() && setup.smoothing.is_some() {
            return Err(SetupError::SMOOTHING_OVER_ELEVATION);
        }
        setup.check()?;
        self.check_sides(setup)
    }

    /// Refuses edits where cells have elevations.
    pub(crate) fn check_is_without_elevations(&self) -> Result<(), SetupError> {
        if self.walk().is_some() { Err(SetupError::EDITS_OVER_ELEVATION) } else { Ok(()) }
    }

    /// Refuses what there is not on costs of cells.
    pub(crate) fn check_is_without_costs(&self, refused: SetupError) -> Result<(), SetupError> {
        if self.has_costs() { Err(refused) } else { Ok(()) }
    }

    /// The space of the same map, or the same costs, with another motion.
    pub(crate) fn with_motion(&self, motion: Motion, interrupt: &Interrupt) -> Result<Self, Error> {
        #[cfg(feature = "costs")]
        if let Some(surface) = self.surface() {
            return Self::of_costs(&surface.costs, motion, interrupt);
        }
        #[cfg(feature = "walking")]
        if let Some(walking) = self.walking() {
            return Self::of_walking(walking, motion, interrupt);
        }
        Self::new(self.map(), motion, interrupt)
    }
}
